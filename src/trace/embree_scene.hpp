// The triangles in Embree's hands, or a refusal where it was not built in.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "gnomon/trace/tracer.hpp"
#include "world_triangles.hpp"

namespace gnomon::trace {

class EmbreeScene {
 public:
  virtual ~EmbreeScene() = default;
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;
  virtual void occluded(std::span<const Ray> rays, std::span<std::uint8_t> out) const = 0;

 protected:
  EmbreeScene() = default;
};

/// Refers to `triangles`, which must outlive it. Throws TraceError.
[[nodiscard]] std::unique_ptr<EmbreeScene> make_embree_scene(const WorldTriangles& triangles);

}  // namespace gnomon::trace
