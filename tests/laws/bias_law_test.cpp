// On a plane under any map: does no texel of the kernel shadow it with the bias given, and is the bias no
// larger than promised? Texels are filled as a rasterizer fills them: the plane's depth along the light ray
// through each centre.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "gnomon/study/bias.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

// Shadowing by less than this share of the bias is rounding: ray and plane are met in double through an
// inverse.
constexpr double kRounding = 1e-6;
// Texels below this share of the coordinates are beyond what a double can place.
constexpr double kFinest = 1e-9;
const BiasOptions kLeast{0.0, 0.5, 0.5, 8.0};  // no more than the laws need: half a texel, no constant

/// A receiver on a random plane in a planned map, in coordinates relative to the camera.
struct Scene {
  Receiver receiver;
  glm::dmat4 world_from_clip{1.0};
  double towards_light;  // sign of ndc depth
  double kappa, depth_range, texel, tangent;
  double rounding;  // of ndc depth, as positions are rounded
};

glm::dvec3 ndc(const glm::dmat4& m, const glm::dvec3& p) {
  const glm::dvec4 h = m * glm::dvec4(p, 1.0);
  return glm::dvec3(h) / h.w;
}

/// Depth that the texel with its centre at these texel coordinates stores of the receiver's plane.
double stored(const Scene& s, const glm::dvec2& centre) {
  const Receiver& r = s.receiver;
  const glm::dvec2 at{2.0 * centre.x / r.texels.width - 1.0, 2.0 * centre.y / r.texels.height - 1.0};
  const glm::dvec3 a = ndc(s.world_from_clip, {at, 0.2}), b = ndc(s.world_from_clip, {at, 0.8});
  const double t = glm::dot(r.normal, r.point - a) / glm::dot(r.normal, b - a);
  return ndc(r.clip_from_world, a + (b - a) * t).z;
}

glm::dvec2 texel_of(const Receiver& r, const glm::dvec3& p) {
  const glm::dvec3 at = ndc(r.clip_from_world, p);
  return {(0.5 * at.x + 0.5) * r.texels.width, (0.5 * at.y + 0.5) * r.texels.height};
}

/// By how much some texel of the kernel shadows the fragment at all, in ndc depth; `bias(offset)` is the ndc
/// change for the texel centre at `offset` texels from the fragment, `at` where the fragment is looked up.
template <typename Bias>
double shadowing(const Scene& s, const glm::dvec3& at, int radius, Bias&& bias) {
  const glm::dvec2 texel = texel_of(s.receiver, at);
  const double depth = ndc(s.receiver.clip_from_world, at).z;
  double worst = -std::numeric_limits<double>::infinity();
  for (int j = -radius; j <= radius; ++j) {
    for (int i = -radius; i <= radius; ++i) {
      const glm::dvec2 centre{std::floor(texel.x) + 0.5 + i, std::floor(texel.y) + 0.5 + j};
      if (centre.x < 0 || centre.y < 0 || centre.x > s.receiver.texels.width ||
          centre.y > s.receiver.texels.height)
        continue;
      worst = std::max(worst, s.towards_light * (stored(s, centre) - depth - bias(centre - texel)));
    }
  }
  return worst;
}

double shadowing_with(BiasKind kind, const Scene& s, int radius) {
  const Receiver& r = s.receiver;
  switch (kind) {
    case BiasKind::constant: {
      const double bias = s.towards_light * 0.05 * s.texel *
                          std::abs(ndc_depth_per_world_unit(r.clip_from_world, r.light_direction, r.point));
      return shadowing(s, r.point, radius, [&](const glm::dvec2&) { return bias; });
    }
    case BiasKind::slope: {
      const double bias = plane_bias_ndc(kLeast, r, radius);
      return shadowing(s, r.point, radius, [&](const glm::dvec2&) { return bias; });
    }
    case BiasKind::normal_offset:
      return shadowing(s, r.point + normal_offset_world(kLeast, r, radius), radius,
                       [](const glm::dvec2&) { return 0.0; });
    case BiasKind::receiver_plane: {
      const ReceiverPlane plane = receiver_plane(r);
      return shadowing(s, r.point, radius,
                       [&](const glm::dvec2& way) { return glm::dot(plane.gradient, way); });
    }
    case BiasKind::adaptive:
      break;
  }
  const double bias = adaptive_bias_ndc(r, 0.0);
  return shadowing(s, r.point, radius, [&](const glm::dvec2&) { return bias; });
}

/// True where texels are about as large over the whole kernel as in its middle, and where an offset along the
/// normal leads: as far as depths slant under a warp, which is farther than the plane's own slope tells.
bool evenly_spaced(const Scene& s, int radius) {
  constexpr double kAbout = 1.2;
  const Receiver& r = s.receiver;
  const double reach = std::max(s.texel * (radius + 1) * (1.0 + s.tangent),
                                glm::length(normal_offset_world(kLeast, r, radius)));
  const glm::dvec3 a = any_across(r.light_direction), b = glm::cross(a, r.light_direction);
  for (int i = 0; i < 8; ++i) {
    const double turn = 0.7853981633974483 * i;
    const glm::dvec3 p = r.point + (a * std::cos(turn) + b * std::sin(turn)) * reach;
    const glm::dvec2 texel = texel_extent_world(r.clip_from_world, r.texels, r.light_direction, p);
    const double there = std::max(texel.x, texel.y);
    if (!(there <= s.texel * kAbout && there * kAbout >= s.texel)) return false;
  }
  return true;
}

Case draw() {
  Case c = draw_case({.max_depth_ratio = 1e4, .max_boxes = 8});
  c.options.clip_space = {static_cast<NdcDepth>(pick(2)), chance(0.5), chance(0.5),
                          static_cast<Handedness>(pick(2))};
  // The widest kernel asked about reads 5 texels away: it must find the map there.
  c.options.filter.texels = 6.0;
  return c;
}

/// Calls `use` with planes through visible points of every map of a random plan.
template <typename Use>
void for_planes(Use&& use) {
  const Case c = draw();
  RC_LOG() << c;
  const ShadowPlan plan = c.plan();
  Random random(11);
  for (const glm::dvec3& p : visible_points(c, random, 6, 2)) {
    const ShadowMap* map = map_for(plan, depth_of(c.camera, p));
    if (map == nullptr) continue;
    Scene s;
    Receiver& r = s.receiver;
    r.clip_from_world = map->clip_from_world;
    r.clip_from_world[3] = map->clip_from_world * glm::dvec4(c.camera.position, 1.0);
    r.texels.width = map->width;
    r.texels.height = map->height;
    r.light_direction = plan.light_direction;
    r.point = p - c.camera.position;
    s.tangent = random.unit() < 0.2 ? 0.0 : kLeast.max_slope * random.unit();
    const double turn = random.between(0.0, 6.3);
    const glm::dvec3 a = any_across(r.light_direction), b = glm::cross(a, r.light_direction);
    r.normal = glm::normalize(s.tangent * (a * std::cos(turn) + b * std::sin(turn)) - r.light_direction);
    const glm::dvec2 texel = texel_extent_world(r.clip_from_world, r.texels, r.light_direction, r.point);
    s.texel = std::max(texel.x, texel.y);
    const double place = glm::length(c.camera.position) + glm::length(r.point) + c.camera.far_depth;
    if (!(std::min(texel.x, texel.y) > kFinest * std::max(place, map->depth_range_world))) continue;
    s.world_from_clip = glm::inverse(r.clip_from_world);
    s.kappa = map->kappa;
    s.depth_range = map->depth_range_world;
    s.towards_light = c.options.clip_space.reversed_z ? 1.0 : -1.0;
    // A point as receiver has next to no depths: the last bits of coordinates are then a share of them.
    constexpr double kLastBits = 0x1p-48;
    s.rounding = kLastBits * place / map->depth_range_world;
    use(s, *map);
  }
}

TEST(BiasLaw, advice_holds_for_every_bias_that_filters_compare_with) {
  // Worst shadowing over the bias that the pair needs, for each pair; a single compare is a kernel of radius
  // 0.
  for (const BiasAdvice& advice : bias_advice()) {
    if (advice.filter == FilterClass::prefiltered) continue;
    int planes = 0, warped = 0, shadowed = 0;
    for_all(250, [&] {
      for_planes([&](const Scene& s, const ShadowMap&) {
        const int radius = advice.filter == FilterClass::single_compare ? 0 : 1 + pick(4);
        // An offset along the normal is measured in the texels of one place.
        if (advice.bias == BiasKind::normal_offset && !evenly_spaced(s, radius)) return;
        const double scale = std::abs(plane_bias_ndc(kLeast, s.receiver, radius));
        const double worst = shadowing_with(advice.bias, s, radius);
        ++planes;
        warped += s.kappa > 0.0;
        const bool shadows = worst > kRounding * scale + s.rounding + 1e-12;
        shadowed += shadows;
        if (advice.safe)
          require(!shadows, advice.reason, "by", worst, "of", scale, "tan", s.tangent, "r", radius);
      });
    });
    EXPECT_GT(planes, of_all_draws(500));
    EXPECT_GT(warped, of_all_draws(100));
    if (!advice.safe) {
      EXPECT_GT(shadowed, planes / 10) << advice.reason;
    }
  }
}

TEST(BiasLaw, the_slope_bias_is_the_least_that_serves_all_fragments) {
  // With a hundredth less, fragments in a texel's corner are shadowed.
  int planes = 0, shadowed = 0;
  for_all(250, [&] {
    for_planes([&](Scene s, const ShadowMap&) {
      const ReceiverPlane plane = receiver_plane(s.receiver);
      if (!plane.valid || s.tangent < 0.1) return;
      // To the corner of the texel that is farthest down the slope from the light.
      const glm::dvec2 texel = texel_of(s.receiver, s.receiver.point);
      const auto corner = [&](double at, double gradient) {
        return std::floor(at) + (gradient * s.towards_light < 0.0 ? 1.0 - 1e-6 : 1e-6);
      };
      const glm::dvec2 to{corner(texel.x, plane.gradient.x), corner(texel.y, plane.gradient.y)};
      const double depth = stored(s, to);
      s.receiver.point = ndc(s.world_from_clip, {2.0 * to.x / s.receiver.texels.width - 1.0,
                                                 2.0 * to.y / s.receiver.texels.height - 1.0, depth});
      const double bias = plane_bias_ndc(kLeast, s.receiver, 0.0);
      ++planes;
      shadowed += shadowing(s, s.receiver.point, 0, [&](const glm::dvec2&) { return 0.99 * bias; }) > 0.0;
    });
  });
  EXPECT_GT(planes, of_all_draws(300));
  EXPECT_GT(shadowed, planes * 9 / 10);
}

TEST(BiasLaw, no_bias_exceeds_the_stated_multiple_of_the_texel) {
  int planes = 0;
  for_all(500, [&] {
    for_planes([&](const Scene& s, const ShadowMap& map) {
      const double radius = pick(5);
      const BiasOptions options{0.05, 0.5, 0.5, 8.0};
      const double bias = plane_bias_world(options, s.receiver, radius);
      const double limit =
          (0.05 + 2.0 * (0.5 + radius) * (s.tangent + s.kappa * s.depth_range)) * s.texel * (1.0 + kRounding);
      require(bias > 0.0 && bias <= limit, map.warp->name, "bias", bias, "limit", limit, "texel", s.texel,
              "tan", s.tangent, "slant", s.kappa * s.depth_range);
      const double adaptive = adaptive_bias_ndc(s.receiver, 0.0);
      require(std::abs(adaptive) <= std::abs(plane_bias_ndc(kLeast, s.receiver, 0.0)) * (1.0 + kRounding),
              "adaptive", adaptive);
      ++planes;
    });
  });
  EXPECT_GT(planes, of_all_draws(1000));
}

TEST(BiasLaw, scaling_the_world_scales_world_units_and_leaves_depth_alone) {
  for_all(200, [&] {
    const double scale = std::pow(10.0, between(-6.0, 6.0));
    for_planes([&](const Scene& s, const ShadowMap&) {
      Receiver scaled = s.receiver;
      scaled.point *= scale;
      for (int column = 0; column < 3; ++column) scaled.clip_from_world[column] /= scale;
      const BiasOptions options;
      const double ndc_was = plane_bias_ndc(options, s.receiver, 1.0),
                   ndc_is = plane_bias_ndc(options, scaled, 1.0);
      require(std::abs(ndc_was - ndc_is) <= kRounding * std::abs(ndc_was), "ndc", ndc_was, ndc_is);
      const double was = plane_bias_world(options, s.receiver, 1.0),
                   is = plane_bias_world(options, scaled, 1.0);
      require(std::abs(was * scale - is) <= kRounding * is, "world", was, is, scale);
      const double offset_was = glm::length(normal_offset_world(options, s.receiver, 1.0));
      const double offset_is = glm::length(normal_offset_world(options, scaled, 1.0));
      require(std::abs(offset_was * scale - offset_is) <= kRounding * offset_is, "offset", offset_was,
              offset_is);
    });
  });
}

}  // namespace
}  // namespace gnomon::test
