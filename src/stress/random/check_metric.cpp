// Is the metric what it is defined as, and does a warp lower the objective that it was taken for?
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>
#include <vector>

#include "check.hpp"
#include "exact_map.hpp"
#include "gnomon/extend/shape.hpp"

namespace gnomon::stress {
namespace {

/// Extents of a texel in pixels, and how far rounding in double may change them, relatively.
struct ExactError {
  Real longest = 0.0L, s = 0.0L, t = 0.0L;
  Real rounding = 0.0L;
};

/// d(world) / d(pixel) where the pixel's ray meets the plane through `p` across `normal`.
Real3 per_pixel(const View& v, const Real3& p, const Real3& normal, const Real3& image, Real pixel) {
  if (v.camera.orthographic)
    return image * pixel - v.forward * (pixel * glm::dot(normal, image) / glm::dot(normal, v.forward));
  const Real depth = v.depth(p);
  return image * (pixel * depth) - p * (pixel * depth * glm::dot(normal, image) / glm::dot(normal, p));
}

/// By the definition: a pixel's footprint on the surface that faces the half vector of eye and light, taken
/// into the map. (equation: A.3, Jacobian of texels over pixels)
ExactError exact_error(const View& v, const LightAt& light, const RelativeMap& exact, const ShadowMap& map,
                       const Real3& p) {
  const Camera& c = v.camera;
  const Real3 ray = c.orthographic ? v.forward : p / length(p);
  const Real3 half = ray + light.travel(p);
  const Real square = glm::dot(half, half);
  const Real3 normal = half / std::sqrt(square);
  const Real3 step[2] = {per_pixel(v, p, normal, v.right, (Real(c.right) - c.left) / c.width),
                         per_pixel(v, p, normal, v.up, (Real(c.top) - c.bottom) / c.height)};
  const Real4x4& m = exact.matrix();
  const Real4 clip = m * Real4(p, 1.0L), error = exact.world_error(p);
  Real j[2][2], of_ndc[2][2];
  Real worst = error.w / std::abs(clip.w);
  for (int axis = 0; axis < 2; ++axis) {
    const Real ndc = clip[axis] / clip.w, side = 0.5L * (axis == 0 ? map.width : map.height);
    Real3 row, size;
    for (int k = 0; k < 3; ++k) {
      row[k] = (m[k][axis] - ndc * m[k][3]) / clip.w * side;
      size[k] = (std::abs(m[k][axis]) + std::abs(ndc * m[k][3])) / clip.w * side;
    }
    const Real turned = (error[axis] + std::abs(ndc) * error.w) / clip.w;
    const Real3 row_w(m[0][3], m[1][3], m[2][3]);
    const Real off = turned * length(row_w) / clip.w * side + 0x1p-50L * length(size);
    worst = std::max(worst, off / length(row));
    for (int k = 0; k < 2; ++k) of_ndc[axis][k] = glm::dot(row, step[k]);
  }
  // From linear texels to the shape's.
  const glm::dmat2 shaped =
      map.texels()
          .place({static_cast<double>(clip.x / clip.w), static_cast<double>(clip.y / clip.w)})
          .texel_from_ndc;
  const Real sides[2] = {0.5L * map.width, 0.5L * map.height};
  for (int axis = 0; axis < 2; ++axis) {
    for (int k = 0; k < 2; ++k)
      j[axis][k] = map.shape->affine ? of_ndc[axis][k]
                                     : shaped[0][axis] / sides[0] * of_ndc[0][k] +
                                           shaped[1][axis] / sides[1] * of_ndc[1][k];
  }
  ExactError out;
  const Real det = std::abs(j[0][0] * j[1][1] - j[0][1] * j[1][0]);
  const Real sum = j[0][0] * j[0][0] + j[0][1] * j[0][1] + j[1][0] * j[1][0] + j[1][1] * j[1][1];
  const Real apart = std::sqrt(std::max(0.0L, (0.5L * sum - det) * (0.5L * sum + det)));
  out.longest = std::sqrt(0.5L * sum + apart) / det;
  out.s = std::sqrt(j[1][1] * j[1][1] + j[1][0] * j[1][0]) / det;
  out.t = std::sqrt(j[0][0] * j[0][0] + j[0][1] * j[0][1]) / det;
  // The determinant is a difference; the half vector one, too, where the rays oppose each other.
  const Real cancelled = sum / det;
  const Real eye =
      length(v.eye) / std::max(v.camera.orthographic ? length(p) : std::abs(v.depth(p)), 1e-4900L);
  const Real position = 0x1p-50L * (1.0L + eye);
  out.rounding = (16.0L * worst + 32.0L * position) * cancelled / std::min(1.0L, square);
  return out;
}

// Room beyond the error's own bound, relative: nobody reads m to more digits.
constexpr Real kErrorRoom = 1e-6L;
// Points whose bound is looser than this tell nothing.
constexpr Real kUseful = 1e-3L;

std::string numbers(double a, Real b, const glm::dvec3& p) {
  std::ostringstream text;
  text.precision(9);
  text << a << ", by definition " << static_cast<double>(b) << " at (" << p.x << ", " << p.y << ", " << p.z
       << ")";
  return text.str();
}

void check_point(const Case& input, const ShadowMap& map, const View& view, const LightAt& light,
                 const RelativeMap& exact, const glm::dvec3& world, Report& report) {
  const Real3 p = Real3(world) - view.eye;
  const PointAliasing found = measure_perspective(map, input.camera, world);
  if (found.status != PointAliasing::Status::ok) return;
  const ExactError wanted = exact_error(view, light, exact, map, p);
  if (!(wanted.rounding < kUseful) || !std::isfinite(wanted.longest)) return;
  ++report.counts().measured;
  const auto compare = [&](const char* name, double a, Real b) {
    const Real apart = std::abs(a / b - 1.0L);
    if (!(apart <= kErrorRoom + wanted.rounding))
      report.add("metric_wrong", static_cast<double>(apart),
                 std::string(name) + " is " + numbers(a, b, world));
  };
  compare("m_max", found.m_max, wanted.longest);
  compare("m_s", found.m_s, wanted.s);
  compare("m_t", found.m_t, wanted.t);
}

/// m at the points of measure()'s grid.
struct Sampled {
  std::vector<Real> sure;  ///< of points that count, whatever rounding does
  std::size_t maybe = 0;   ///< points that may count or not, or whose m is rounding
};

Sampled sample_grid(const Case& input, const std::vector<Box>& receivers, const ShadowPlan& plan,
                    const View& view, const LightAt& light, const std::vector<RelativeMap>& maps,
                    const MeasureOptions& grid) {
  Sampled out;
  const Camera& c = input.camera;
  const Real n = c.near_depth, f = c.far_depth;
  std::vector<Real> depths;
  for (int k = 0; k < grid.depths; ++k) {
    const Real share = (k + 0.5L) / grid.depths;
    depths.push_back(n > 0.0L ? n * std::pow(f / n, share) : n + (f - n) * share);
  }
  const auto count = [&](const Real3& p, Real depth, bool in) {
    const glm::dvec3 world(p + view.eye);
    const int served = map_serving(plan, world, static_cast<double>(depth));
    // Next to the border of two maps rounding decides which of them it is.
    constexpr double kBorder = 1e-9;
    const auto deeper = [&](double by) {
      return map_serving(plan, world, static_cast<double>(depth) * (1.0 + by));
    };
    const bool border = plan.selection == MapSelection::view_depth &&
                        (deeper(kBorder) != served || deeper(-kBorder) != served);
    if (served < 0 && !border) return;
    if (border) {
      ++out.maybe;
      return;
    }
    const auto at = static_cast<std::size_t>(served);
    const Real3 rounded = Real3(world) - view.eye;
    const ExactError m = exact_error(view, light, maps[at], plan.map[at], rounded);
    if (in && m.rounding < kUseful && m.longest > 1e-11L && m.longest < 1e11L)
      out.sure.push_back(m.longest);
    else
      ++out.maybe;
  };
  for (int i = 0; i < grid.columns * grid.rows; ++i) {
    const Real x = c.left + (Real(c.right) - c.left) * (i % grid.columns + 0.5L) / grid.columns;
    const Real y =
        c.bottom + (Real(c.top) - c.bottom) * (static_cast<Real>(i / grid.columns) + 0.5L) / grid.rows;
    const Real3 aside = view.right * x + view.up * y;
    const Real3 start = c.orthographic ? aside : Real3{},
                way = c.orthographic ? view.forward : view.forward + aside;
    for (const Real depth : depths) {
      const Real3 p = start + way * depth;
      const Real room = 1e-11L * (length(p) + length(view.eye));
      bool in = false, near = false;
      for (const Box& box : receivers) {
        const Real3 low = p - (Real3(box.min) - view.eye), high = (Real3(box.max) - view.eye) - p;
        const Real least = std::min({low.x, low.y, low.z, high.x, high.y, high.z});
        in = in || least > room;
        near = near || least >= -room;
      }
      if (near) count(p, depth, in);
    }
    const ThinHit thin = thin_hit(receivers, view, start, way, depths, {n, f});
    if (thin.doubt) {
      ++out.maybe;
    } else if (thin.met) {
      count(start + way * thin.depth, thin.depth, true);
    }
  }
  std::sort(out.sure.begin(), out.sure.end());
  return out;
}

void check_measure(const Case& input, const ShadowPlan& plan, const View& view, const LightAt& light,
                   const std::vector<RelativeMap>& maps, Report& report) {
  constexpr MeasureOptions kGrid{6, 6, 24};
  constexpr std::size_t kMaxReceivers = 40;
  if (input.receivers.size() > kMaxReceivers) return;
  // Where a flat one is met, rounding decides whether a depth is in it.
  std::vector<Box> receivers = input.receivers;
  std::erase_if(receivers, [](const Box& box) {
    return box.empty() || box.min.x == box.max.x || box.min.y == box.max.y || box.min.z == box.max.z;
  });
  const AliasingStats stats = quiet("measure", report, [&] {
    return measure(plan, input.camera, {input.casters, receivers}, kGrid);
  });
  const Sampled exact = sample_grid(input, receivers, plan, view, light, maps, kGrid);
  const std::size_t sure = exact.sure.size();
  // A twentieth of the points in doubt moves no percentile out of what is allowed below.
  if (sure < 40 || exact.maybe * 20 > sure) return;
  const auto owe = [&](bool holds, const char* name, double value, Real wanted) {
    std::ostringstream text;
    text.precision(9);
    text << name << " is " << value << ", by the points themselves " << static_cast<double>(wanted);
    if (!holds) report.add("measure_wrong", std::abs(value - static_cast<double>(wanted)), text.str());
  };
  // Points next to a map's border may be counted as outside: they are in doubt, too.
  const auto doubt = exact.maybe + static_cast<std::size_t>(stats.outside);
  owe(stats.samples + stats.outside + exact.maybe >= sure, "samples", static_cast<double>(stats.samples),
      static_cast<Real>(sure));
  // A bin of the histogram is 2^-10 wide.
  constexpr Real kBin = 0x1p-10L + kUseful;
  const auto percentile = [&](const char* name, double value, Real share) {
    const Real rank = share * static_cast<Real>(sure);
    const Real low = std::floor(rank) - 2.0L - static_cast<Real>(doubt),
               high = std::ceil(rank) + 2.0L + static_cast<Real>(doubt);
    const Real last = static_cast<Real>(sure - 1);
    const Real least = exact.sure[static_cast<std::size_t>(std::clamp(low, 0.0L, last))];
    const Real most = exact.sure[static_cast<std::size_t>(std::clamp(high, 0.0L, last))];
    // A rank in doubt at either end bounds nothing there.
    owe(low < 0.0L || value >= least * (1.0L - kBin), name, value, least);
    owe(high > last || value <= most * (1.0L + kBin), name, value, most);
  };
  percentile("p50", stats.p50, 0.50L);
  percentile("p95", stats.p95, 0.95L);
  owe(stats.outside > 0 || stats.max >= exact.sure.back() * (1.0L - kUseful), "max", stats.max,
      exact.sure.back());
  owe(exact.maybe > 0 || stats.max <= exact.sure.back() * (1.0L + kUseful), "max", stats.max,
      exact.sure.back());
}

}  // namespace

void check_empty_boxes(const Case& input, const ShadowPlan& plan, Report& report) {
  Case whole = input;
  const auto drop = [](std::vector<Box>& boxes) {
    return std::erase_if(boxes, [](const Box& box) { return box.empty(); });
  };
  if (drop(whole.receivers) + drop(whole.casters) == 0) return;
  const ShadowPlan without = make_plan(whole.camera, whole.light, whole.bounds(), whole.options);
  if (without.status != plan.status || without.map_count != plan.map_count)
    report.add("empty_box_counts", 1.0, "another number of maps where empty boxes are taken out");
  constexpr MeasureOptions kGrid{6, 6, 24};
  const AliasingStats a = measure(plan, input.camera, input.bounds(), kGrid),
                      b = measure(plan, input.camera, whole.bounds(), kGrid);
  if (a.samples != b.samples || a.outside != b.outside || a.max != b.max)
    report.add("empty_box_counts", 1.0,
               "measure() changes where empty boxes are taken out: " + std::to_string(a.samples) +
                   " samples and " + std::to_string(a.outside) + " outside with them, " +
                   std::to_string(b.samples) + " and " + std::to_string(b.outside) + " without");
}

void check_metric(const Case& input, const ShadowPlan& plan, Report& report) {
  check_empty_boxes(input, plan, report);
  if (plan.map_count == 0) return;
  const View view(input.camera);
  const LightAt light(input.light, view);
  std::vector<RelativeMap> maps;
  for (const ShadowMap& map : plan.maps()) maps.emplace_back(plan, map, view);
  Random random(7);
  constexpr std::size_t kMaxBoxes = 4;
  for (std::size_t i = 0; i < std::min(input.receivers.size(), kMaxBoxes); ++i) {
    for (const Real3& p :
         seen_points(view, input.receivers[i], input.camera.near_depth, input.camera.far_depth, 6, random)) {
      const glm::dvec3 world(p + view.eye);
      const int index = map_serving(plan, world, static_cast<double>(view.depth(p)));
      if (index < 0) continue;
      const auto k = static_cast<std::size_t>(index);
      check_point(input, plan.map[k], view, light, maps[k], world, report);
    }
  }
  check_measure(input, plan, view, light, maps, report);
}

namespace {

// The plan's sampler and measure()'s differ in their points; a 95th percentile of a body that is small on the
// screen moves by this much with them.
constexpr Real kSampled = 1.15L;

/// The error over one map's share of the receivers, sampled at its corners and between.
struct BodyError {
  Real m_s = 0.0L, m_t = 0.0L, longest = 0.0L, rounding = 0.0L;
};

BodyError body_error(const View& view, const LightAt& light, const RelativeMap& exact, const ShadowMap& map,
                     const std::vector<Real3>& points) {
  BodyError error;
  for (const Real3& p : points) {
    const ExactError e = exact_error(view, light, exact, map, p);
    error.m_s = std::max(error.m_s, e.s);
    error.m_t = std::max(error.m_t, e.t);
    error.longest = std::max(error.longest, e.longest);
    error.rounding = std::max(error.rounding, e.rounding);
  }
  return error;
}

/// The case reduced to what the promise is about: one receiver, whole maps, cascades that do not follow the
/// warp. False where nothing is left of it.
bool for_warps(const nlohmann::ordered_json& value, nlohmann::ordered_json& out, std::string& objective) {
  out = value;
  auto& options = out["options"];
  if (!options.is_object()) options = nlohmann::ordered_json::object();
  const std::string name = options.value("warp", "auto");
  const Warp* warp = name == "auto" ? &warps::optimal : find_warp(name);
  if (warp == nullptr || warp == &warps::none || !warp->drop_without_gain) return false;
  if (options.value("stable", false) || options.value("fit", "tight") != "tight") return false;
  if (options.contains("filter_radius_world")) return false;
  for (const char* key : {"target_m", "texel_budget", "partition", "selection", "focus", "focus_weight",
                          "near_hint", "pseudo_near", "shape"})
    options.erase(key);
  if (options.value("split", "auto") == "optimal") options["split"] = "logarithmic";
  options["prune"] = "exact";
  objective = options.value("objective", "picture");
  // Counted at points in boxes, which say nothing of the volume: tests/core/warp/seen_points_test.cpp.
  if (objective == "picture") return false;
  // measure_map() takes no points from the band that a map shares with the cascade before it.
  // Of many lights the first is planned.
  const nlohmann::ordered_json& planned = out.contains("lights") ? out["lights"][0] : out["light"];
  const std::string light = planned.value("type", "directional");
  if (objective == "p95" || light != "directional") options.erase("split_overlap");
  auto& receivers = out["receivers"];
  if (receivers.is_array() && receivers.size() > 1) {
    const nlohmann::ordered_json first = receivers.front();
    receivers = nlohmann::ordered_json::array({first});
  }
  return !out["camera"].value("orthographic", false) && !out["camera"].contains("height_world");
}

void compare_maps(const Case& input, const ShadowPlan& with, int a, const ShadowPlan& without, int b,
                  const std::string& objective, Report& report) {
  const auto ia = static_cast<std::size_t>(a), ib = static_cast<std::size_t>(b);
  const ShadowMap& warped = with.map[ia];
  const View view(input.camera);
  const LightAt light(input.light, view);
  Real ratio = 0.0L;
  const Real allowed = kSampled;
  if (objective == "p95" || !light.parallel()) {
    constexpr MeasureOptions kGrid{24, 24, 48};
    constexpr std::uint64_t kEnough = 400;
    // Over all of the camera's depths the grid might have a single layer of them in the map.
    Camera own = input.camera;
    if (warped.depth_begin < warped.depth_end) {
      own.near_depth = warped.depth_begin;
      own.far_depth = warped.depth_end;
    }
    const AliasingStats m = measure(with, own, input.bounds(), {kGrid.columns, kGrid.rows, kGrid.depths, a});
    const AliasingStats m0 =
        measure(without, own, input.bounds(), {kGrid.columns, kGrid.rows, kGrid.depths, b});
    if (m.samples < kEnough || m.samples != m0.samples || m.outside != m0.outside) return;
    ratio = objective == "p95"   ? Real(m.p95) / m0.p95
            : objective == "max" ? Real(m.max) / m0.max
                                 : Real(m.storage) / m0.storage;
  } else {
    Random random(3);
    // In the band before that the cascade before it serves as well.
    const std::vector<Real3> points =
        seen_points(view, input.receivers[0], warped.depth_begin, warped.depth_end, 400, random);
    const BodyError e = body_error(view, light, RelativeMap(with, warped, view), warped, points);
    const BodyError e0 =
        body_error(view, light, RelativeMap(without, without.map[ib], view), without.map[ib], points);
    if (points.size() < 100 || !(e.rounding < kUseful) || !(e0.rounding < kUseful)) return;
    ratio = objective == "max" ? e.longest / e0.longest : e.m_s * e.m_t / (e0.m_s * e0.m_t);
  }
  // Both are infinite where a pixel has no area.
  if (std::isnan(ratio)) return;
  ++report.counts().warps;
  if (!(ratio <= allowed)) {
    std::ostringstream text;
    text << "map " << warped.cascade << " (" << warped.warp->name << "): " << objective << " is "
         << static_cast<double>(ratio) << " times that of no warp";
    report.add("warp_worse_than_none", static_cast<double>(ratio), text.str());
  }
}

}  // namespace

void check_warp(const nlohmann::ordered_json& value, Report& report) {
  nlohmann::ordered_json changed;
  std::string objective;
  if (!for_warps(value, changed, objective)) return;
  const Case input = read_case(changed.dump());
  const ShadowPlan with = make_plan(input.camera, input.light, input.bounds(), input.options);
  if (with.status != PlanStatus::ok) return;
  const bool any =
      std::any_of(with.maps().begin(), with.maps().end(), [](const ShadowMap& m) { return m.kappa > 0.0; });
  if (!any) return;
  changed["options"]["warp"] = "none";
  const Case plain = read_case(changed.dump());
  const ShadowPlan without = make_plan(plain.camera, plain.light, plain.bounds(), plain.options);
  for (int a = 0; a < with.map_count; ++a) {
    for (int b = 0; b < without.map_count; ++b) {
      const ShadowMap& warped = with.map[static_cast<std::size_t>(a)];
      const ShadowMap& other = without.map[static_cast<std::size_t>(b)];
      if (warped.cascade != other.cascade || !(warped.kappa > 0.0)) continue;
      if (warped.depth_begin != other.depth_begin || warped.depth_end != other.depth_end) continue;
      compare_maps(input, with, a, without, b, objective, report);
    }
  }
}

}  // namespace gnomon::stress
