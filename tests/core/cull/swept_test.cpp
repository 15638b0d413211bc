// Are the planes of a swept body a tight fit: everything that can shadow it inside, everything else outside?
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "gnomon/extend/body.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

// Rounding of a plane through an edge, relative to the body's size.
constexpr double kEdge = 1e-9;

struct Sweep {
  std::array<Plane, kMaxCullPlanes> storage;
  int count;
  [[nodiscard]] std::span<const Plane> planes() const {
    return {storage.data(), static_cast<std::size_t>(count)};
  }
  /// Distance inside the nearest plane; negative outside.
  [[nodiscard]] double depth(const glm::dvec3& p) const {
    double least = 1e300;
    for (const Plane& plane : planes()) least = std::min(least, glm::dot(plane.normal, p) + plane.offset);
    return least;
  }
};

Sweep sweep(const Polytope& body, const glm::dvec3& direction) {
  Sweep result;
  result.count = swept_planes(body, glm::dvec4(direction, 0.0), result.storage);
  return result;
}

/// Signed distance-like measure: is p - t direction inside the body for some t >= 0?
bool swept_by_brute_force(const Polytope& body, const glm::dvec3& direction, const glm::dvec3& p,
                          double margin) {
  double low = 0.0, high = 1e300;
  for (int f = 0; f < body.face_count; ++f) {
    const Plane& plane = body.plane[static_cast<std::size_t>(f)];
    const double at = glm::dot(plane.normal, p) + plane.offset + margin;
    const double slope = -glm::dot(plane.normal, direction);
    if (slope == 0.0) {
      if (at < 0.0) return false;
    } else if (slope > 0.0) {
      low = std::max(low, -at / slope);
    } else {
      high = std::min(high, at / -slope);
    }
  }
  return low <= high;
}

Polytope draw_body() {
  Polytope body = box_polytope({glm::dvec3(-between(0.2, 1)), glm::dvec3(between(0.2, 1))});
  const int cuts = pick(7);
  for (int i = 0; i < cuts; ++i) {
    const glm::dvec3 normal{between(-1, 1), between(-1, 1), between(0.1, 1)};
    clip(body, Plane{glm::normalize(normal), between(0.05, 0.8)});
  }
  return body;
}

glm::dvec3 draw_direction() {
  const glm::dvec3 axes[] = {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}, {1, 1, 0}};
  const int kind = pick(6);
  if (kind < 4) return axes[kind];
  const glm::dvec3 free{between(-1, 1), between(-1, 1), between(-1, 1)};
  return glm::length(free) < 0.1 ? glm::dvec3(0, 1, 0) : free;
}

TEST(Swept, a_cube_along_an_axis_keeps_its_bottom_and_four_sides) {
  const Polytope body = box_polytope({glm::dvec3(-1), glm::dvec3(1)});
  const Sweep up = sweep(body, {0, 3, 0});  // any length
  EXPECT_GE(up.count, 5);
  EXPECT_GT(up.depth({0, 1e6, 0}), 0.5);
  EXPECT_LT(up.depth({0, -1.5, 0}), -0.4);
  EXPECT_LT(up.depth({1.5, 10, 0}), -0.4);
  EXPECT_LT(up.depth({0, 10, -1.5}), -0.4);
}

TEST(Swept, an_empty_body_has_no_planes) {
  Polytope body = box_polytope({glm::dvec3(-1), glm::dvec3(1)});
  clip(body, Box{});
  EXPECT_EQ(sweep(body, {0, 1, 0}).count, 0);
}

TEST(Swept, a_flat_body_and_a_point_still_have_a_shaft) {
  for (const glm::dvec3& half : {glm::dvec3(1, 0, 1), glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0)}) {
    const Polytope body = box_polytope({-half, half});
    for (const glm::dvec3& direction : {glm::dvec3(0, 1, 0), glm::dvec3(0.3, 0.9, -0.2)}) {
      const Sweep s = sweep(body, direction);
      EXPECT_GE(s.depth(direction * 100.0), -kEdge * 100.0);
      EXPECT_LT(s.depth(direction * -100.0), -1.0);
      EXPECT_LT(s.depth(direction * 100.0 + glm::dvec3(0, 0, 40)), -1.0);
    }
  }
}

TEST(SweptProperty, everything_the_body_passes_on_its_way_is_inside) {
  for_all(1000, [&] {
    const Polytope body = draw_body();
    const glm::dvec3 direction = draw_direction();
    const Sweep s = sweep(body, direction);
    require(s.count >= 3 && s.count <= kMaxCullPlanes, "planes", s.count);
    Random random(1);
    for (int i = 0; i < 30; ++i) {
      glm::dvec3 p(0.0);
      double total = 0.0;
      for (int m = 0; m < 3; ++m) {
        const double weight = random.unit();
        p += body.vertex[static_cast<std::size_t>(random.pick(body.vertex_count))].position * weight;
        total += weight;
      }
      const double t = i % 3 == 0 ? 0.0 : std::pow(10.0, random.between(-2.0, 3.0));
      require(s.depth(p / total + direction * t) >= -1e-12 * (1.0 + t), "t", t, "outside by",
              s.depth(p / total + direction * t));
    }
  });
}

TEST(SweptProperty, a_point_is_inside_exactly_where_the_body_passes_it) {
  std::uint64_t in = 0, out = 0;
  for_all(1000, [&] {
    const Polytope body = draw_body();
    const glm::dvec3 direction = draw_direction();
    const Sweep s = sweep(body, direction);
    Random random(2);
    for (int i = 0; i < 40; ++i) {
      const glm::dvec3 p =
          glm::dvec3(random.between(-1.5, 1.5), random.between(-1.5, 1.5), random.between(-1.5, 1.5)) +
          direction * random.between(-1.0, 4.0);
      const bool surely = swept_by_brute_force(body, direction, p, -kEdge);
      const bool maybe = swept_by_brute_force(body, direction, p, kEdge);
      if (surely != maybe) continue;
      require((s.depth(p) >= 0.0) == surely, "brute force", surely, "planes", s.depth(p), "at", p.x, p.y,
              p.z);
      ++(surely ? in : out);
    }
  });
  EXPECT_GT(in, 3000u);
  EXPECT_GT(out, 3000u);
}

}  // namespace
}  // namespace gnomon::test
