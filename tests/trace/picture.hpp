// What a renderer would hand to the tracer, made with rays: positions and normals rounded to single
// precision.
#pragma once

#include "gnomon/camera.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/trace/tracer.hpp"

namespace gnomon::trace {

struct Picture {
  FloatImage positions, normals;
};
[[nodiscard]] Picture picture_of(const Tracer& tracer, const Camera& camera);

}  // namespace gnomon::trace
