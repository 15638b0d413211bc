// The registry of shapes.
#include <array>

#include "gnomon/extend/shape.hpp"

namespace gnomon {
namespace {

constexpr std::array kShapes = {
#define GNOMON_SHAPE(name) &shapes::name,
#include "gnomon/shapes.def"
#undef GNOMON_SHAPE
};

}  // namespace

ShapeParameters parameters_in(const glm::dmat4& other_from_this, const Shape& shape,
                              const ShapeParameters& parameters) noexcept {
  return shape.mirrored(parameters, other_from_this[0][0] < 0.0, other_from_this[1][1] < 0.0);
}

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
