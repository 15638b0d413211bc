// The uniform block that every pass of a frame reads; shaders/pass/common/frame.glsl mirrors it.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "filter/filter_block.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/render/renderer.hpp"

namespace gnomon::render {

struct MapBlock {
  glm::mat4 clip_from_camera_relative;
  glm::vec4 interval_size;
  std::array<glm::vec4, kMaxSelectPlanes> select_planes;
  glm::mat4 shape;
  glm::vec4 kernel;
};

struct FrameBlock {
  glm::mat4 clip_from_camera_relative;
  glm::vec4 right, up, forward, image_edges, light, light_place, light_cone, bias, layer, selection;
  std::array<MapBlock, kMaxMaps> maps;
};
static_assert(sizeof(FrameBlock) == 64 + 10 * 16 + kMaxMaps * (160 + 16 * kMaxSelectPlanes),
              "std140 has no padding here");

/// Any clip space of a plan to the one that all passes draw in.
[[nodiscard]] glm::dmat4 drawn_from_plan_clip(const ClipSpace& plan_space) noexcept;

/// Everything brought to OpenGL clip space with depth 0..1, whatever the plan was made for. `layer_width` and
/// `layer_height`: texels of the map array's layers. `blur`: of the stored texels.
[[nodiscard]] FrameBlock frame_block(const ShadowPlan& plan, const Camera& camera,
                                     const FrameOptions& options, int layer_width, int layer_height,
                                     const BlurSides& blur, const DepthCurves& curves) noexcept;

}  // namespace gnomon::render
