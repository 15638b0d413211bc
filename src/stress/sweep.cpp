// What happens along an axis: each of its values on several scenes, and a tiny step beyond.
#include <algorithm>
#include <cmath>
#include <limits>

#include "axes.hpp"

namespace gnomon::stress {
namespace {

constexpr double kStep = 1e-6;  // of the value

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Input input_at(const Axis& axis, const Variant& variant, double value, std::uint64_t seed) {
  Input input = plain_input(seed);
  variant.apply(input.options);
  Random random(seed * 7919);
  axis.apply(value, seed == 0 ? 0.0 : random.unit(), input);
  return input;
}

const ShadowMap* same_map(const ShadowPlan& plan, int cascade) {
  for (const ShadowMap& map : plan.maps()) {
    if (map.cascade == cascade) return &map;
  }
  return nullptr;
}

/// Largest change of a map's texels per area, at points of the world that it shows. At a border between maps
/// the density always jumps: that is what several maps are for.
double jump_between(const Input& input, const ShadowPlan& here, const ShadowPlan& there) {
  double largest = kNone;
  for (int i = 0; i < here.map_count; ++i) {
    const ShadowMap& map = here.map[static_cast<std::size_t>(i)];
    const ShadowMap* other = same_map(there, map.cascade);
    if (other == nullptr) continue;
    constexpr int kBetween = 12;
    for (const glm::dvec3& p : points_of(input, here, i, kBetween, 2)) {
      // The same point where the whole world has moved.
      const glm::dvec3 moved = p + (there.origin_world - here.origin_world);
      const double a = texel_density(map, p), b = texel_density(*other, moved);
      if (!(a > 0.0) || !(b > 0.0)) continue;
      const double jump = std::abs(b / a - 1.0);
      if (!(jump <= largest)) largest = jump;
    }
  }
  return largest;
}

void note(std::string& list, const std::string& what) {
  if (what.empty() || (" | " + list + " | ").find(" | " + what + " | ") != std::string::npos) return;
  list += (list.empty() ? "" : " | ") + what;
}

void take_worst(Judgement& all, const Judgement& one) {
  all.finite = all.finite && one.finite;
  const auto worse = [](double& a, double b) {
    if (!(b <= a)) a = b;
  };
  worse(all.error_texels, one.error_texels);
  worse(all.error_ulp, one.error_ulp);
  worse(all.drift_texels, one.drift_texels);
  worse(all.float_absolute_texels, one.float_absolute_texels);
  worse(all.float_relative_texels, one.float_relative_texels);
  worse(all.condition, one.condition);
  worse(all.condition_world, one.condition_world);
}

AxisRow row_at(const Axis& axis, const Variant& variant, double value, const SweepOptions& options) {
  AxisRow row;
  row.axis = axis.name;
  row.label = axis.label;
  row.logarithmic = axis.logarithmic;
  row.variant = variant.name;
  row.value = value;
  // Counts have no next value that is closer.
  const bool whole = axis.name == "cascades" || axis.name == "map_size";
  for (int scene = 0; scene < options.scenes; ++scene) {
    const std::uint64_t seed = scene == 0 ? 0 : options.seed * 1000 + static_cast<std::uint64_t>(scene);
    const Input input = input_at(axis, variant, value, seed);
    const ShadowPlan plan = input.plan();
    note(row.status, std::string(to_string(plan.status)));
    note(row.used, used_by(input, plan));
    note(row.left_out, left_out_of(plan));
    row.maps = std::max(row.maps, plan.map_count);
    take_worst(row.worst, judge(input, plan));
    const double next = value + kStep * (axis.logarithmic ? value : 1.0);
    if (whole || next == value || plan.status != PlanStatus::ok) continue;
    const Input beyond = input_at(axis, variant, next, seed);
    const double jump = jump_between(input, plan, beyond.plan());
    if (!(jump <= row.jump)) row.jump = std::isnan(jump) ? row.jump : jump;
  }
  return row;
}

}  // namespace

std::vector<AxisRow> sweep(const Axis& axis, const SweepOptions& options, const std::function<void()>& step) {
  std::vector<AxisRow> rows;
  for (const double value : axis.values(options.samples)) {
    for (const Variant& variant : all_variants()) rows.push_back(row_at(axis, variant, value, options));
    if (step) step();
  }
  return rows;
}

}  // namespace gnomon::stress
