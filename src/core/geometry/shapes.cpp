// The registry of shapes.
#include <array>

#include "gnomon/shape.hpp"

namespace gnomon {
namespace {

constexpr std::array kShapes = {
#define GNOMON_SHAPE(name) &shapes::name,
#include "gnomon/shapes.def"
#undef GNOMON_SHAPE
};

}  // namespace

std::span<const Shape* const> all_shapes() noexcept {
  return kShapes;
}

const Shape* find_shape(std::string_view name) noexcept {
  for (const Shape* shape : kShapes) {
    if (shape->name == name) return shape;
  }
  return nullptr;
}

}  // namespace gnomon
