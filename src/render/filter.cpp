// The registry of filters.
#include "gnomon/render/filter.hpp"

#include <array>

namespace gnomon::render {
namespace {

constexpr std::array kFilters{
#define GNOMON_FILTER(name) &filters::name,
#include "gnomon/render/filters.def"
#undef GNOMON_FILTER
};

}  // namespace

std::span<const Filter* const> all_filters() noexcept {
  return kFilters;
}

const Filter* find_filter(std::string_view name) noexcept {
  for (const Filter* filter : kFilters) {
    if (filter->name == name) return filter;
  }
  return nullptr;
}

}  // namespace gnomon::render
