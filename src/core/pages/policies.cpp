// The registry of page policies.
#include <array>

#include "gnomon/pages.hpp"

namespace gnomon {
namespace {

constexpr std::array kPolicies = {
#define GNOMON_PAGE_POLICY(name) &page_policies::name,
#include "gnomon/page_policies.def"
#undef GNOMON_PAGE_POLICY
};

}  // namespace

std::span<const PagePolicy* const> all_page_policies() noexcept {
  return kPolicies;
}

const PagePolicy* find_page_policy(std::string_view name) noexcept {
  for (const PagePolicy* policy : kPolicies) {
    if (policy->name == name) return policy;
  }
  return nullptr;
}

}  // namespace gnomon
