// Plan and camera as the shaders want them: float, relative to the camera, computed in double.
#include "frame_block.hpp"

#include <glm/matrix.hpp>

namespace gnomon::render {
namespace {

/// View depth to reversed depth 1..0: keeps its precision with a float depth buffer however far the far plane
/// is.
glm::dmat4 camera_clip_from_relative(const Camera& camera, const CameraAxes& axes) noexcept {
  glm::dmat4 view_from_relative(1.0);
  for (int c = 0; c < 3; ++c) {
    view_from_relative[c][0] = axes.right[c];
    view_from_relative[c][1] = axes.up[c];
    view_from_relative[c][2] = -axes.forward[c];
  }
  glm::dmat4 reversed(1.0);
  reversed[2][2] = -0.5;
  reversed[3][2] = 0.5;
  return reversed * clip_from_view(camera) * view_from_relative;
}

/// Any clip space of a plan to the one all passes are drawn in.
glm::dmat4 drawn_from_plan_clip(const ClipSpace& plan_space) noexcept {
  return clip_from_gl_clip(kOpenGlZeroToOne) * glm::inverse(clip_from_gl_clip(plan_space));
}

}  // namespace

FrameBlock frame_block(const ShadowPlan& plan, const Camera& camera, const FrameOptions& options,
                       int layer_width, int layer_height) noexcept {
  const CameraAxes axes = camera_axes(camera);
  FrameBlock block{};
  block.clip_from_camera_relative = glm::mat4(camera_clip_from_relative(camera, axes));
  block.right =
      glm::vec4(glm::vec3(axes.right), static_cast<float>((camera.right - camera.left) / camera.width));
  block.up = glm::vec4(glm::vec3(axes.up), static_cast<float>((camera.top - camera.bottom) / camera.height));
  block.forward = glm::vec4(glm::vec3(axes.forward), camera.orthographic ? 1.0f : 0.0f);
  block.image_edges = glm::vec4(glm::dvec4(camera.left, camera.right, camera.bottom, camera.top));
  block.light = glm::vec4(glm::vec3(plan.light_direction), static_cast<float>(plan.map_count));
  block.bias = glm::vec4(glm::dvec4(plan.bias.constant_texels, plan.bias.slope_texels,
                                    plan.bias.normal_offset_texels, plan.bias.max_slope));
  block.layer = glm::vec4(
      glm::dvec4(layer_width, layer_height, options.filter_parameters.radius_texels, camera.far_depth));
  const glm::dmat4 drawn_from_plan = drawn_from_plan_clip(plan.clip_space);
  for (std::size_t i = 0; i < plan.maps().size(); ++i) {
    const ShadowMap& map = plan.map[i];
    block.maps[i].clip_from_camera_relative =
        glm::mat4(drawn_from_plan * glm::dmat4(map.clip_from_camera_relative));
    block.maps[i].interval_size =
        glm::vec4(glm::dvec4(map.depth_begin, map.depth_end, map.width, map.height));
  }
  return block;
}

}  // namespace gnomon::render
