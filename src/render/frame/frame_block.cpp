// Plan and camera as the shaders want them: float, relative to the camera, computed in double.
#include "frame/frame_block.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <variant>

#include "base/travel.hpp"
#include "gnomon/motion.hpp"
#include "gnomon/shader.hpp"

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

/// Of a local light. A plan without maps does not have it.
std::optional<glm::dvec3> light_position(const ShadowPlan& plan, const Light* light) noexcept {
  if (plan.map_count > 0) {
    const glm::dvec4& place = plan.map[0].light_world;
    return place.w == 0.0 ? std::nullopt : std::optional(glm::dvec3(place));
  }
  if (light == nullptr || std::holds_alternative<DirectionalLight>(*light)) return std::nullopt;
  return position_of(*light);
}

/// Direction, or position relative to the camera, as light_at of shaders/library/shadow_map.glsl takes it.
glm::vec4 light_place(const ShadowPlan& plan, const Light* light, const Camera& camera) noexcept {
  const std::optional<glm::dvec3> position = light_position(plan, light);
  if (!position) return {glm::vec3(plan.light_direction), 0.0f};
  return {glm::vec3(*position - camera.position), 1.0f};
}

void set_local_light(const Light* light, FrameBlock& block) noexcept {
  constexpr float kNoCone = -1.0f;
  block.light_cone = {0.0f, -1.0f, 0.0f, kNoCone};
  if (light == nullptr) return;
  if (const auto* spot = std::get_if<SpotLight>(light)) {
    block.light_cone = glm::vec4(glm::vec3(glm::normalize(spot->direction)),
                                 static_cast<float>(std::cos(spot->outer_radians)));
    block.layer.z = static_cast<float>(spot->range);
  }
  if (const auto* point = std::get_if<PointLight>(light)) block.layer.z = static_cast<float>(point->range);
}

MapBlock map_block(const ShadowMap& planned, const glm::dmat4& drawn_from_plan, const glm::dvec3& origin,
                   const glm::dvec3& eye, double blur, double curve) noexcept {
  MapBlock block{};
  // A plan of several views, or of an earlier frame, is relative to another place.
  const ShadowMap map = origin == eye ? planned : rebased(planned, eye);
  block.clip_from_camera_relative = glm::mat4(drawn_from_plan * glm::dmat4(map.clip_from_camera_relative));
  block.interval_size = glm::vec4(glm::dvec4(map.depth_begin, map.depth_end, map.width, map.height));
  for (int i = 0; i < kMaxSelectPlanes; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const glm::dvec4 plane =
        i < map.select_plane_count ? map.select_planes[at] : glm::dvec4(0.0, 0.0, 0.0, 1.0);
    block.select_planes[at] =
        glm::vec4(glm::vec3(plane), static_cast<float>(plane.w + glm::dot(glm::dvec3(plane), eye)));
  }
  block.shape = shader_shape(map, drawn_from_plan);
  block.kernel = glm::vec4(glm::dvec4(map.filter_margin_texels, blur, map.overlap, curve));
  return block;
}

/// What moves the noise in this frame: pixels for interleaved gradient noise (Jimenez 2014, whose
/// neighbourhoods stay even), a share of 1 for blue noise, whose frames the golden ratio spreads.
double noise_offset(const FrameOptions& options) noexcept {
  constexpr double kPixelsPerFrame = 5.588238, kGoldenRatio = 0.6180339887498949;
  constexpr std::uint32_t kFrames = 64;
  switch (options.noise) {
    case SampleNoise::still:
      return 0.0;
    case SampleNoise::gradient:
      return kPixelsPerFrame * static_cast<double>(options.frame_index % kFrames);
    case SampleNoise::blue:
      return std::fmod(kGoldenRatio * static_cast<double>(options.frame_index), 1.0);
  }
  return 0.0;
}

}  // namespace

glm::dmat4 drawn_from_plan_clip(const ClipSpace& plan_space) noexcept {
  return clip_from_gl_clip(kOpenGlZeroToOne) * glm::inverse(clip_from_gl_clip(plan_space));
}

FrameBlock frame_block(const ShadowPlan& plan, const Camera& camera, const FrameOptions& options,
                       int layer_width, int layer_height, const BlurSides& blur,
                       const DepthCurves& curves) noexcept {
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
  block.light_place = light_place(plan, options.light, camera);
  block.layer = glm::vec4(layer_width, layer_height, 0.0f, 0.0f);  // the air's depth comes with the scene
  set_local_light(options.light, block);
  block.selection = glm::vec4(shader_selection(plan), static_cast<float>(options.transition),
                              static_cast<float>(options.noise), static_cast<float>(noise_offset(options)));
  const glm::dmat4 drawn_from_plan = drawn_from_plan_clip(plan.clip_space);
  for (std::size_t i = 0; i < plan.maps().size(); ++i) {
    block.maps[i] =
        map_block(plan.map[i], drawn_from_plan, plan.origin_world, camera.position, blur[i], curves[i]);
  }
  return block;
}

}  // namespace gnomon::render
