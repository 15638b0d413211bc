// Do the numbers of the metric agree with what they are said to be: finite differences, identities, a sort?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "support/near.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

// The identities are exact: a few dozen roundings, magnified by anisotropies up to 1e4.
constexpr double kExact = 1e-9;

glm::dvec2 pixel_of(const Camera& camera, const glm::dvec3& p) {
  const glm::dvec4 clip = clip_from_view(camera) * view_from_world(camera) * glm::dvec4(p, 1.0);
  return {0.5 * camera.width * clip.x / clip.w, 0.5 * camera.height * clip.y / clip.w};
}
glm::dvec2 texel_of(const ShadowMap& map, const glm::dvec3& p) {
  const glm::dvec4 clip = map.clip_from_world * glm::dvec4(p, 1.0);
  return {0.5 * map.width * clip.x / clip.w, 0.5 * map.height * clip.y / clip.w};
}
glm::dvec3 eye_ray(const Camera& camera, const glm::dvec3& p) {
  return camera.orthographic ? glm::normalize(camera.forward) : glm::normalize(p - camera.position);
}

/// A point of a plan's map with a surface through it.
struct Sample {
  const ShadowMap* map = nullptr;
  glm::dvec3 point{0.0}, normal{0.0}, eye{0.0}, light{0.0};
};

/// A surface that eye and light both see at more than a graze.
bool facing(Sample& s, Random& random) {
  for (int i = 0; i < 200; ++i) {
    s.normal = random.direction();
    if (glm::dot(s.normal, s.eye) < -0.05 && glm::dot(s.normal, s.light) < -0.05) return true;
  }
  return false;
}

/// Calls `check` at points of a random plan's maps; returns how many there were.
template <typename Check>
std::uint64_t at_samples(const Case& c, const ShadowPlan& plan, Check&& check) {
  std::uint64_t count = 0;
  Random random(23);
  for (const glm::dvec3& p : visible_points(c, random, 3, 4)) {
    Sample s;
    s.map = map_for(plan, depth_of(c.camera, p));
    if (s.map == nullptr) continue;
    s.point = p;
    s.eye = eye_ray(c.camera, p);
    s.light = glm::normalize(c.light);
    if (!facing(s, random)) continue;
    check(s);
    ++count;
  }
  return count;
}

Case draw_metric_case() {
  return draw_case({.max_depth_ratio = 1e3, .max_boxes = 6});
}

TEST(MetricLaw, the_area_factors_into_perspective_and_projection_for_every_normal) {
  std::uint64_t count = 0;
  for_all(1000, [&] {
    const Case c = draw_metric_case();
    const ShadowPlan plan = c.plan();
    RC_LOG() << c;
    count += at_samples(c, plan, [&](const Sample& s) {
      const PointAliasing all = measure_point(*s.map, c.camera, s.point, s.normal);
      const PointAliasing perspective = measure_perspective(*s.map, c.camera, s.point);
      require(all.status == PointAliasing::Status::ok, "status", static_cast<int>(all.status));
      const double cosines = glm::dot(s.normal, s.eye) / glm::dot(s.normal, s.light);
      require(deviation(all.projection, cosines) <= kExact, "projection", all.projection, cosines);
      require(deviation(all.m_area * all.m_area, perspective.m_area * perspective.m_area * cosines) <= 1e-7,
              "area", all.m_area, "perspective", perspective.m_area, "cosines", cosines);
    });
  });
  EXPECT_GT(count, of_all_draws(2000));
}

TEST(MetricLaw, the_longest_extent_lies_between_the_axis_extents_and_their_hypotenuse) {
  for_all(1000, [&] {
    const Case c = draw_metric_case();
    const ShadowPlan plan = c.plan();
    (void)at_samples(c, plan, [&](const Sample& s) {
      const PointAliasing m = measure_point(*s.map, c.camera, s.point, s.normal);
      require(std::max(m.m_s, m.m_t) <= m.m_max * (1.0 + kExact), "axis", m.m_s, m.m_t, "longest", m.m_max);
      require(m.m_max <= std::hypot(m.m_s, m.m_t) * (1.0 + kExact), "longest", m.m_max, "axes", m.m_s, m.m_t);
      require(m.m_min <= m.m_max && m.m_min > 0.0, "shortest", m.m_min, m.m_max);
      require(deviation(m.anisotropy, m.m_max / m.m_min) <= kExact, "anisotropy", m.anisotropy);
      require(deviation(m.m_area * m.m_area, m.m_max * m.m_min) <= kExact, "area", m.m_area);
      require(std::max(m.perspective_s, m.perspective_t) <= m.perspective_max * (1.0 + kExact) &&
                  m.perspective_max <= std::hypot(m.perspective_s, m.perspective_t) * (1.0 + kExact),
              "perspective", m.perspective_s, m.perspective_t, m.perspective_max);
    });
  });
}

TEST(MetricLaw, the_perspective_part_is_the_error_on_the_surface_that_faces_the_half_vector) {
  std::uint64_t count = 0;
  for_all(1000, [&] {
    const Case c = draw_metric_case();
    const ShadowPlan plan = c.plan();
    RC_LOG() << c;
    (void)at_samples(c, plan, [&](const Sample& s) {
      const glm::dvec3 half = -(s.eye + s.light);
      if (glm::length(half) < 0.05) return;  // towards the light the half vector loses its digits
      ++count;
      const PointAliasing m = measure_point(*s.map, c.camera, s.point, glm::normalize(half));
      require(deviation(m.m_max, m.perspective_max) <= 1e-8, "longest", m.m_max, m.perspective_max);
      require(deviation(m.m_s, m.perspective_s) <= 1e-8, "s", m.m_s, m.perspective_s);
      require(deviation(m.m_t, m.perspective_t) <= 1e-8, "t", m.m_t, m.perspective_t);
      require(deviation(m.projection, 1.0) <= 1e-8, "projection", m.projection);
    });
  });
  EXPECT_GT(count, of_all_draws(2000));
}

// Central differences of step h: h^2 for the curvature, rounding / h for the positions.
constexpr double kDifference = 1e-5;
// Most that w may change over h, as a share of w: the quotient's curvature is the square of that.
constexpr double kStraight = 1e-3;

double w_of(const ShadowMap& map, const glm::dvec3& p) {
  return (map.clip_from_world * glm::dvec4(p, 1.0)).w;
}

TEST(MetricLaw, the_extents_agree_with_finite_differences_of_both_projections) {
  std::uint64_t count = 0;
  for_all(1000, [&] {
    Case c = draw_metric_case();
    // At the origin: differences of far-away positions would measure their rounding.
    for (auto* boxes : {&c.casters, &c.receivers}) {
      for (Box& box : *boxes) box = {box.min - c.camera.position, box.max - c.camera.position};
    }
    c.camera.position = glm::dvec3(0.0);
    const ShadowPlan plan = c.plan();
    RC_LOG() << c;
    (void)at_samples(c, plan, [&](const Sample& s) {
      const glm::dvec3 u = any_across(s.normal), v = glm::cross(s.normal, u);
      const double step = 1e-5 * (c.camera.orthographic ? c.camera.top - c.camera.bottom
                                                        : std::min(c.camera.top - c.camera.bottom, 1.0) *
                                                              depth_of(c.camera, s.point));
      // A thin body's strong warp runs from end to end within such a step.
      const double w = w_of(*s.map, s.point);
      if (std::abs(w_of(*s.map, s.point + u * step) - w) > kStraight * w ||
          std::abs(w_of(*s.map, s.point + v * step) - w) > kStraight * w)
        return;
      ++count;
      glm::dmat2 pixels, texels;
      pixels[0] = pixel_of(c.camera, s.point + u * step) - pixel_of(c.camera, s.point - u * step);
      pixels[1] = pixel_of(c.camera, s.point + v * step) - pixel_of(c.camera, s.point - v * step);
      texels[0] = texel_of(*s.map, s.point + u * step) - texel_of(*s.map, s.point - u * step);
      texels[1] = texel_of(*s.map, s.point + v * step) - texel_of(*s.map, s.point - v * step);
      const glm::dmat2 extent = pixels * glm::inverse(texels);
      const PointAliasing m = measure_point(*s.map, c.camera, s.point, s.normal);
      // An axis that is by far the shorter one drowns in the other's rounding.
      require(std::abs(m.m_s - glm::length(extent[0])) <= kDifference * m.m_max, "s", m.m_s,
              glm::length(extent[0]));
      require(std::abs(m.m_t - glm::length(extent[1])) <= kDifference * m.m_max, "t", m.m_t,
              glm::length(extent[1]));
      const double area = std::sqrt(std::abs(glm::determinant(extent)));
      require(deviation(m.m_area, area) <= 1e-3, "area", m.m_area, area);
    });
  });
  EXPECT_GT(count, of_all_draws(2000));
}

TEST(MetricLaw, a_surface_turned_from_the_eye_or_the_light_is_distinguished) {
  for_all(300, [&] {
    const Case c = draw_metric_case();
    const ShadowPlan plan = c.plan();
    (void)at_samples(c, plan, [&](const Sample& s) {
      using Status = PointAliasing::Status;
      require(measure_point(*s.map, c.camera, s.point, -s.normal).status == Status::faces_away,
              "turned away");
      const glm::dvec3 away = glm::normalize(s.light - s.eye);  // seen by the eye, not by the light
      if (glm::dot(s.eye, s.light) < 0.99)
        require(measure_point(*s.map, c.camera, s.point, away).status == Status::faces_away,
                "turned from light");
    });
  });
}

/// Where a ray is between a box's sides: view depths, empty where begin > end.
struct Passage {
  double begin, end;
};
Passage passage(const Box& box, const Camera& camera, double x, double y) {
  const glm::dvec3 start = point_at(camera, x, y, 0.0), step = point_at(camera, x, y, 1.0) - start;
  Passage result{camera.near_depth, camera.far_depth};
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.min[axis] - start[axis]) / step[axis],
                 b = (box.max[axis] - start[axis]) / step[axis];
    result.begin = std::max(result.begin, std::min(a, b));
    result.end = std::min(result.end, std::max(a, b));
  }
  return box.empty() ? Passage{1.0, 0.0} : result;
}

// Bins 0.1 % wide, their middle reported.
constexpr double kBin = 1.1e-3;

TEST(MetricLaw, percentiles_of_a_grid_are_those_of_sorting_its_samples) {
  std::uint64_t compared = 0;
  for_all(150, [&] {
    const Case c = draw_metric_case();
    const ShadowPlan plan = c.plan();
    if (plan.map_count == 0) return;
    RC_LOG() << c;
    const MeasureOptions grid{7, 6, 8};
    const auto depth_at = [&](int k) {
      return c.camera.near_depth *
             std::pow(c.camera.far_depth / c.camera.near_depth, (k + 0.5) / grid.depths);
    };
    // On the border between two maps the last bit of a power decides which of them serves a depth.
    constexpr double kBorder = 1e-9;
    for (int k = 0; k < grid.depths; ++k) {
      for (const ShadowMap& map : plan.maps()) {
        if (deviation(depth_at(k), map.depth_begin) < kBorder ||
            deviation(depth_at(k), map.depth_end) < kBorder)
          return;
      }
    }
    std::vector<double> values;
    std::uint64_t outside = 0;
    bool border = false;
    const auto add = [&](const glm::dvec3& p, double depth) {
      const ShadowMap* map = map_for(plan, depth);
      if (map == nullptr) {
        ++outside;
      } else {
        values.push_back(measure_perspective(*map, c.camera, p).m_max);
      }
    };
    for (int row = 0; row < grid.rows; ++row) {
      for (int column = 0; column < grid.columns; ++column) {
        const double x = (2 * column + 1.0) / grid.columns - 1.0, y = (2 * row + 1.0) / grid.rows - 1.0;
        for (int k = 0; k < grid.depths; ++k) {
          const glm::dvec3 p = point_at(c.camera, x, y, depth_at(k));
          const bool receives = std::any_of(c.receivers.begin(), c.receivers.end(), [&](const Box& b) {
            return b.min.x <= p.x && p.x <= b.max.x && b.min.y <= p.y && p.y <= b.max.y && b.min.z <= p.z &&
                   p.z <= b.max.z;
          });
          if (receives) add(p, depth_at(k));
        }
        // The nearest of those that the ray passes between two depths.
        double nearest = c.camera.far_depth;
        for (const Box& box : c.receivers) {
          const Passage part = passage(box, c.camera, x, y);
          bool held = part.begin > part.end * (1.0 + kBorder);
          border = border || (!held && deviation(part.begin, part.end) < kBorder && part.begin != part.end);
          for (int k = 0; !held && k < grid.depths; ++k) {
            border = border || deviation(depth_at(k), part.begin) < kBorder ||
                     deviation(depth_at(k), part.end) < kBorder;
            held = part.begin <= depth_at(k) && depth_at(k) <= part.end;
          }
          if (!held) nearest = std::min(nearest, part.begin);
        }
        if (!(nearest < c.camera.far_depth)) continue;
        for (const ShadowMap& map : plan.maps())
          border = border || deviation(nearest, map.depth_begin) < kBorder ||
                   deviation(nearest, map.depth_end) < kBorder;
        add(point_at(c.camera, x, y, nearest), nearest);
      }
    }
    if (border) return;
    std::sort(values.begin(), values.end());
    const AliasingStats stats = measure(plan, c.camera, {c.casters, c.receivers}, grid);
    require(stats.samples == values.size() && stats.outside == outside, "samples", stats.samples,
            values.size(), "outside", stats.outside, outside);
    if (values.empty()) return;
    ++compared;
    const auto rank = [&](double share) {
      const auto wanted = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
      return values[std::max<std::size_t>(wanted, 1) - 1];
    };
    require(deviation(stats.p50, rank(0.50)) <= kBin, "p50", stats.p50, rank(0.50));
    require(deviation(stats.p95, rank(0.95)) <= kBin, "p95", stats.p95, rank(0.95));
    require(deviation(stats.max, values.back()) <= kExact, "max", stats.max, values.back());
    const auto under = std::count_if(values.begin(), values.end(), [](double m) { return m > 1.0; });
    require(deviation(stats.share_undersampled,
                      static_cast<double>(under) / static_cast<double>(values.size())) <= kExact,
            "share", stats.share_undersampled);
  });
  EXPECT_GT(compared, of_all_draws(40));
}

}  // namespace
}  // namespace gnomon::test
