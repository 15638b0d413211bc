// Moves the texel grids of a plan's maps by shares of a texel.
#include "gnomon/motion.hpp"

#include <algorithm>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "geometry/vector.hpp"

namespace gnomon {
namespace {

/// The digits of a number below kJitterFrames in base 2, mirrored.
constexpr std::uint32_t mirrored(std::uint32_t index) noexcept {
  std::uint32_t value = 0;
  for (std::uint32_t bit = 1; bit < kJitterFrames; bit *= 2) {
    value = 2 * value + index % 2;
    index /= 2;
  }
  return value;
}

double clamped(double offset) noexcept {
  if (!(offset > -kJitterReachTexels)) return offset <= -kJitterReachTexels ? -kJitterReachTexels : 0.0;
  return min_of(offset, kJitterReachTexels);
}

}  // namespace

glm::dvec2 jitter_texels(std::uint32_t frame_index) noexcept {
  // Of the generators of 64 points, one that leaves no long gap along any direction.
  constexpr std::uint32_t kGenerator = 19;
  const std::uint32_t x = mirrored(frame_index % kJitterFrames), y = kGenerator * x % kJitterFrames;
  return glm::dvec2(x + 0.5, y + 0.5) / static_cast<double>(kJitterFrames) - 0.5;
}

ShadowPlan jittered(const ShadowPlan& plan, const glm::dvec2& offset_texels) noexcept {
  ShadowPlan moved = plan;
  const glm::dvec2 offset{clamped(offset_texels.x), clamped(offset_texels.y)};
  const glm::dmat4 plan_from_gl = clip_from_gl_clip(plan.clip_space);
  const glm::dmat4 gl_from_plan = glm::inverse(plan_from_gl);
  for (int i = 0; i < moved.map_count; ++i) {
    ShadowMap& map = moved.map[static_cast<std::size_t>(i)];
    glm::dmat4 step(1.0);  // texels to normalized device coordinates, which are 2 wide
    step[3][0] = 2.0 * offset.x / map.width;
    step[3][1] = 2.0 * offset.y / map.height;
    const glm::dmat4 moved_from_plan = plan_from_gl * step * gl_from_plan;
    map.clip_from_world = moved_from_plan * map.clip_from_world;
    map.clip_from_camera_relative = glm::mat4(moved_from_plan * glm::dmat4(map.clip_from_camera_relative));
    // Points at the border are now up to half a texel nearer to the map's side.
    if (offset != glm::dvec2(0.0)) map.filter_margin_texels = std::max(map.filter_margin_texels - 1, 0);
    map.snap_key.valid = false;
  }
  return moved;
}

}  // namespace gnomon
