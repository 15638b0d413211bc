// Settings as the shaders want them, and the weights of blurs.
#include "filter/filter_block.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "filter/filter_parts.hpp"
#include "frame/frame_block.hpp"

namespace gnomon::render {
namespace {

bool is_blurred(const FilterSettings& settings) noexcept {
  return settings.filter->info.reads == MapRead::filtered || settings.filter->info.reads == MapRead::joined;
}

/// Steps of an integer per 1 such that no box of this half side overflows 32 bits, and floats hold every
/// step.
double sum_steps(const FilterSettings& settings) noexcept {
  const double radius = settings.unit == KernelUnit::world ? kMaxRadiusTexels : settings.radius;
  const double side = 2.0 * std::ceil(radius + 0.5) + 2.0;
  return std::min(std::floor(4294967295.0 / (side * side)), 0x1p24);
}

}  // namespace

BlurSides blur_sides(const FilterSettings& settings, const ShadowPlan& plan) noexcept {
  BlurSides sides{};
  if (!is_blurred(settings)) return sides;
  for (std::size_t i = 0; i < plan.maps().size(); ++i) {
    double side = settings.radius + 0.5;
    if (settings.unit == KernelUnit::world) {
      const ShadowMap& map = plan.map[i];
      side = kBoxOfDisc * settings.radius / std::max(map.texel_world_max.x, map.texel_world_max.y);
    }
    sides[i] = side > 0.5 ? std::min(side, kMaxRadiusTexels + 0.5) : 0.0;
  }
  return sides;
}

bool wants_mipmaps(const FilterSettings& settings, const ShadowPlan& plan) noexcept {
  if (!settings.filter->info.may_mipmap) return false;
  if (settings.mipmap || settings.unit == KernelUnit::texels) return settings.mipmap;
  constexpr double kAlike = 1.01;  // texels that differ less make no difference that can be seen
  return std::any_of(plan.maps().begin(), plan.maps().end(), [](const ShadowMap& map) {
    const double widest = std::max(map.texel_world_max.x, map.texel_world_max.y);
    return widest > kAlike * std::min(map.texel_world.x, map.texel_world.y) || map.light_world.w != 0.0;
  });
}

int tap_weights(BlurShape shape, double half_side, std::array<double, 4 * kTapVectors>& weights) noexcept {
  weights = {};
  weights[0] = 1.0;
  const double side = std::clamp(half_side, 0.5, kMaxRadiusTexels + 0.5);
  // The last texel counts by its share that is inside of the kernel; less than a thousandth is rounding.
  const int reach = static_cast<int>(std::ceil(side - 0.5 - 1e-3));
  const double deviation = side / 2.0;  // the Gauss is cut where it has fallen to 14 %
  double sum = 0.0;
  for (int i = 0; i <= reach; ++i) {
    const double inside = std::clamp(side + 0.5 - i, 0.0, 1.0);
    const double height =
        shape == BlurShape::gauss ? std::exp(-0.5 * (i / deviation) * (i / deviation)) : 1.0;
    weights[static_cast<std::size_t>(i)] = inside * height;
    sum += (i == 0 ? 1.0 : 2.0) * inside * height;
  }
  for (double& weight : weights) weight /= sum;
  return reach;
}

MapDepths map_depths(const FilterSettings& settings, const ShadowMap& map) noexcept {
  const double kernel = settings.unit == KernelUnit::world
                            ? kBoxOfDisc * settings.radius
                            : (settings.radius + 0.5) * std::max(map.texel_world.x, map.texel_world.y);
  return {map.depth_range_world, kernel};
}

void fit_options(const FilterSettings& settings, const ShadowPlan& plan, FilterBlock& block) noexcept {
  if (settings.filter->hooks.fit_map == nullptr) return;
  for (std::size_t i = 0; i < plan.maps().size(); ++i)
    set_options(settings_for_map(settings, map_depths(settings, plan.map[i])), i, block);
}

void set_options(const FilterSettings& settings, std::size_t map, FilterBlock& block) noexcept {
  for (std::size_t i = 0; i < kMaxFilterOptions; ++i) {
    block.options[map * kOptionVectors + i / 4][static_cast<int>(i % 4)] =
        static_cast<float>(settings.option[i]);
  }
}

double depth_curve(const ShadowPlan& plan, const ShadowMap& map) noexcept {
  if (map.light_world.w == 0.0) return 0.0;
  const glm::dmat4 world_from_gl_clip =
      glm::inverse(map.clip_from_world) * clip_from_gl_clip(plan.clip_space);
  const auto distance = [&](double z) {
    const glm::dvec4 h = world_from_gl_clip * glm::dvec4(0.0, 0.0, z, 1.0);
    return glm::length(glm::dvec3(h) / h.w - glm::dvec3(map.light_world));
  };
  const double near_distance = distance(-1.0), far_distance = distance(1.0);
  const double curve = far_distance / near_distance - 1.0;
  return std::isfinite(curve) ? std::max(curve, 0.0) : 0.0;
}

double even_depth_scale(const ShadowPlan& plan, const ShadowMap& map) noexcept {
  const glm::dmat4 world_from_clip =
      glm::inverse(drawn_from_plan_clip(plan.clip_space) * map.clip_from_world);
  double largest = 0.0, least = std::numeric_limits<double>::infinity();
  for (const glm::dvec2& corner :
       {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(1, 1)}) {
    // On the far plane clip z is w, of which the inverse has the reciprocal.
    const double z = 1.0 / (world_from_clip * glm::dvec4(corner, 1.0, 1.0)).w;
    if (!(z > 0.0)) return 0.0;
    largest = std::max(largest, z);
    least = std::min(least, z);
  }
  // A caster's depth in a bent map comes from weights in floats at each texel. Where w grows across the map,
  // the rounding of a place there grows with it in z, and cancels in z / w alone.
  constexpr double kWidest = 64.0;
  if (!map.shape->affine && largest > kWidest * least) return 0.0;
  const double scale = 1.0 / largest;
  return std::isfinite(scale) ? scale : 0.0;
}

DepthCurves depth_curves(const ShadowPlan& plan, bool even) noexcept {
  DepthCurves curves{};
  for (std::size_t i = 0; i < plan.maps().size(); ++i) {
    const double scale = even ? even_depth_scale(plan, plan.map[i]) : 0.0;
    curves[i] = scale > 0.0 ? -scale : depth_curve(plan, plan.map[i]);
  }
  return curves;
}

void set_depth_curves(const DepthCurves& curves, FilterBlock& block) noexcept {
  for (std::size_t i = 0; i < curves.size(); ++i)
    block.depth_curve[i].x = static_cast<float>(std::max(curves[i], 0.0));
}

FilterBlock filter_block(const FilterSettings& settings, const BlurSides& sides) noexcept {
  FilterBlock block{};
  block.kernel = glm::vec4(glm::dvec4(settings.radius, settings.unit == KernelUnit::world ? 1.0 : 0.0,
                                      settings.mipmap          ? 1.0
                                      : covers_pixel(settings) ? 2.0
                                                               : 0.0,
                                      rounding_of(settings.format)));
  block.sums.y = is_unsigned_unit(settings.format) ? 1.0f : 0.0f;
  block.sums.x = static_cast<float>(sum_steps(settings));
  block.sums.z = static_cast<float>(settings.anisotropy);
  for (std::size_t map = 0; map < kMaxMaps; ++map) {
    set_options(settings, map, block);
    std::array<double, 4 * kTapVectors> weights{};
    block.reach[map].x = tap_weights(settings.blur, sides[map], weights);
    for (std::size_t i = 0; i < weights.size(); ++i) {
      block.weights[map * kTapVectors + i / 4][static_cast<int>(i % 4)] = static_cast<float>(weights[i]);
    }
  }
  return block;
}

int shadow_vectors(const FilterSettings& settings) noexcept {
  return settings.filter->info.channels == nullptr ? 1 : (settings.filter->info.channels(settings) + 3) / 4;
}

}  // namespace gnomon::render
