// Extreme cases of cameras and options.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <set>

#include "case_list.hpp"
#include "gnomon/study/formulas.hpp"
#include "judge.hpp"

namespace gnomon::stress {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

void expect_refused(const Input& input, std::string_view field, Check& check) {
  const ShadowPlan plan = input.plan();
  check.that(plan.status == PlanStatus::invalid_input && plan.map_count == 0 && plan.invalid_field == field,
             "refused: " + std::string(field));
}

bool ascending(std::span<const double> edges) {
  return std::is_sorted(edges.begin(), edges.end()) &&
         std::all_of(edges.begin(), edges.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace

void case_widest_view(Check& check) {
  for (const double degrees : {170.0, 175.0, 179.0, 179.9, 179.999}) {
    const Input input = full_frustum(0.1, 100.0, degrees * kPi / 180.0, 1.2);
    const double none = one_map(input, warps::none, check).storage;
    for (const Warp* warp : all_warps()) {
      const ShadowMap map = one_map(input, *warp, check);
      check.that(!warp->drop_without_gain || map.storage <= none * (1.0 + 1e-9),
                 "no more texels than no warp");
    }
  }
  Input input = plain_input(0);
  input.camera =
      orthographic_camera({0, 2, 0}, {0.2, -0.3, -1}, {0, 1, 0}, 20.0, 1.5, -50.0, 200.0, 900, 600);
  for (const Warp* warp : all_warps())
    check.that(one_map(input, *warp, check).kappa == 0.0, "no warp for an orthographic camera");
}

void case_off_axis(Check& check) {
  double best = 1.0;
  for (const glm::dvec2 shift :
       {glm::dvec2(1.5, 0), glm::dvec2(0, 2), glm::dvec2(-3, 1), glm::dvec2(20, -20)}) {
    for (const double gamma : {0.2, 0.6, 1.2, 2.5}) {
      Input input = full_frustum(1.0, 200.0, kPi / 3.0, gamma);
      Camera& c = input.camera;
      const double width = c.right, height = c.top;
      c.left += shift.x * width;
      c.right += shift.x * width;
      c.bottom += shift.y * height;
      c.top += shift.y * height;
      const glm::dvec3 half(1e4);
      input.receivers = input.casters = {{-half, half}};
      const double none = one_map(input, warps::none, check).storage;
      for (const Warp* warp : all_warps()) {
        const ShadowMap map = one_map(input, *warp, check);
        if (!warp->drop_without_gain) continue;
        check.that(map.storage <= none * (1.0 + 1e-9), "no more texels than no warp");
        best = std::min(best, map.storage / none);
      }
      check.that(judge(input, input.plan()).error_texels < 1e-3, "every corner lands in the map");
    }
  }
  check.note("least storage against none", best);
}

void case_tiny_maps(Check& check) {
  for (const int size : {-1, 0, 1, 2, kLeastMapSize - 1, kMaxMapSize + 1}) {
    Input input = plain_input(0);
    input.options.resolution.max_size = size;
    expect_refused(input, "options.resolution.max_size", check);
  }
  for (const int size : {kLeastMapSize, 5, kMaxMapSize}) {
    Input input = plain_input(0);
    input.options.resolution.max_size = size;
    const ShadowPlan plan = input.plan();
    check.that(plan.status == PlanStatus::ok && all_finite(plan), "accepted from 4 to 16384, finite");
  }
}

void case_splits(Check& check) {
  Input input = plain_input(0);
  for (const int cascades : {-1, 0, kMaxMaps + 1}) {
    input.options.cascades = cascades;
    expect_refused(input, "options.cascades", check);
  }
  input.options.cascades = 4;
  for (const double lambda : {-0.1, 1.1, kNan, kInfinity}) {
    input.options.split.lambda = lambda;
    expect_refused(input, "options.split.lambda", check);
  }
  std::array<double, 5> edges{};
  for (const double lambda : {-1.0, 0.0, 0.5, 1.0, 2.0, kNan}) {
    split_depths(0.1, 1000.0, {.scheme = SplitScheme::practical, .lambda = lambda}, edges);
    check.that(ascending(edges) && edges[0] == 0.1 && edges[4] == 1000.0, "clamped lambdas split in order");
  }
  for (const double hint : {-5.0, 0.0, 0.05, 999.0, 1000.0, 1e9, kInfinity, kNan}) {
    split_depths(0.1, 1000.0, {.scheme = SplitScheme::pseudo_near, .pseudo_near = hint}, edges);
    check.that(ascending(edges) && edges[0] == 0.1 && edges[4] == 1000.0,
               "clamped pseudo-nears split in order");
  }
  for (const double hint : {0.05, 1000.0, 1e9}) {
    Input with_hint = plain_input(0);
    with_hint.options = {};
    with_hint.options.split.scheme = SplitScheme::pseudo_near;
    with_hint.options.split.pseudo_near = hint;
    const ShadowPlan plan = with_hint.plan();
    check.that(plan.status == PlanStatus::ok && all_finite(plan),
               "a pseudo-near outside the depths still plans");
    for (int i = 1; i < plan.map_count; ++i)
      check.that(plan.map[static_cast<std::size_t>(i)].depth_begin >=
                     plan.map[static_cast<std::size_t>(i - 1)].depth_end,
                 "maps follow each other");
  }
}

void case_histograms(Check& check) {
  Input plain = plain_input(0);
  plain.options.cascades = 4;
  const ShadowPlan without = plain.plan();
  VisibleDepths sky;
  for (const double depth : {0.0, -1.0, kInfinity, kNan}) sky.add(depth);
  check.that(sky.empty(), "sky and what is no number do not count");
  plain.visible = &sky;
  const ShadowPlan with_sky = plain.plan();
  check.that(with_sky.map_count == without.map_count &&
                 with_sky.map[0].clip_from_world == without.map[0].clip_from_world,
             "all sky counts as unknown");
  VisibleDepths one;
  one.add(20.0);
  plain.visible = &one;
  const ShadowPlan with_one = plain.plan();
  check.that(with_one.status == PlanStatus::ok && all_finite(with_one), "one pixel plans, finite");
  const CameraAxes axes = camera_axes(plain.camera);
  check.that(map_serving(with_one, plain.camera.position + axes.forward * 19.9, 19.9) >= 0,
             "and its depth is served");
  check.that(with_one.map_count == 1, "by one map");
  VisibleDepths wrong = one;
  wrong.min = kNan;
  plain.visible = &wrong;
  check.that(plain.plan().status == PlanStatus::invalid_input, "an edge that is no number is refused");
  wrong.min = 30.0;
  wrong.max = 10.0;
  check.that(plain.plan().map_count == without.map_count, "edges the wrong way round count as unknown");
}

void case_zoom(Check& check) {
  std::set<double> sizes;
  int octaves = 0;
  for (const int steps : {1, 4, 16}) {
    sizes.clear();
    double low = kInfinity, high = 0.0;
    for (double fov = 0.3; fov < 1.6; fov *= 1.0 + 1e-3) {
      Input input = plain_input(0);
      input.camera =
          perspective_camera({0, 2, 0}, {0.3, -0.1, -1}, {0, 1, 0}, fov, 1.5, 0.1, 50.0, 1500, 1000);
      input.options.fit = Fit::stable;
      input.options.resolution.stable_size_steps = steps;
      const ShadowPlan plan = input.plan();
      check.that(plan.status == PlanStatus::ok && plan.map[0].snap_key.valid, "a grid");
      const double texel = plan.map[0].snap_key.texel.x;
      sizes.insert(texel);
      low = std::min(low, texel);
      high = std::max(high, texel);
    }
    octaves = static_cast<int>(std::ceil(std::log2(high / low))) + 1;
    check.that(static_cast<int>(sizes.size()) <= octaves * steps + 1, "as many sizes as steps");
  }
  check.note("sizes over the whole zoom with 16 steps an octave", static_cast<double>(sizes.size()));
}

void case_directions(Check& check) {
  for (const glm::dvec3 bad :
       {glm::dvec3(0.0), glm::dvec3(kNan, 0, 0), glm::dvec3(0, kInfinity, 0), glm::dvec3(0, 0, 1e31)}) {
    Input input = plain_input(0);
    input.light = DirectionalLight{bad};
    expect_refused(input, "light.direction", check);
    input.light = SpotLight{{0, 10, 0}, bad, 0.5, 100.0};
    expect_refused(input, "light.direction", check);
    input = plain_input(0);
    input.camera.forward = bad;
    expect_refused(input, "camera.forward", check);
  }
  Input unit = plain_input(0);
  const glm::dvec3 direction{0.5, -0.75, 0.25};
  unit.light = DirectionalLight{direction};
  const ShadowPlan expected = unit.plan();
  for (const double length : {1e-300, 0x1p-40, 1e-3, 0x1p40, 1e29}) {
    unit.light = DirectionalLight{direction * length};
    const ShadowPlan plan = unit.plan();
    check.that(plan.status == PlanStatus::ok, "any length but zero serves");
    const double change =
        std::abs(plan.map[0].clip_from_world[0][0] / expected.map[0].clip_from_world[0][0] - 1.0);
    check.that(change < 1e-9, "and does not matter");
  }
}

}  // namespace gnomon::stress
