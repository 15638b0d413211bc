// Is the clipped body the intersection it claims to be, and a well-formed simple polytope throughout?
#include "gnomon/extend/body.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <set>
#include <vector>

#include "support/property.hpp"
#include "support/random_case.hpp"
#include "support/same_body.hpp"

namespace gnomon::test {
namespace {

// The clipping tolerance is 1e-13 of the largest distance; a few cuts add up.
constexpr double kClip = 1e-11;

Box cube(double half) {
  return {glm::dvec3(-half), glm::dvec3(half)};
}
double distance(const Plane& plane, const glm::dvec3& p) {
  return glm::dot(plane.normal, p) + plane.offset;
}

/// Empty where all is well; otherwise what is wrong with faces, edges and neighbours.
std::string malformed(const Polytope& body) {
  if (body.vertex_count == 0) return "";
  if (body.vertex_count < 4 || body.vertex_count > kMaxVertices || body.vertex_count % 2 != 0)
    return "vertex count";
  if (body.face_count < 4 || body.face_count > kMaxFaces) return "face count";
  std::set<int> faces;
  for (int i = 0; i < body.vertex_count; ++i) {
    const Polytope::Vertex& v = body.vertex[static_cast<std::size_t>(i)];
    if (v.face[0] == v.face[1] || v.face[1] == v.face[2] || v.face[0] == v.face[2])
      return "a face twice at a vertex";
    for (std::size_t k = 0; k < 3; ++k) {
      if (v.face[k] >= body.face_count || v.neighbour[k] >= body.vertex_count) return "index out of range";
      faces.insert(v.face[k]);
      // The edge to neighbour k lies on both other faces, and leads back.
      const Polytope::Vertex& n = body.vertex[v.neighbour[k]];
      const auto on = [&](std::uint8_t f) {
        return std::find(n.face.begin(), n.face.end(), f) != n.face.end();
      };
      if (!on(v.face[(k + 1) % 3]) || !on(v.face[(k + 2) % 3])) return "edge off its faces";
      if (std::find(n.neighbour.begin(), n.neighbour.end(), i) == n.neighbour.end()) return "one-way edge";
    }
  }
  // Three edges at each vertex: E = 3 V / 2.
  const int euler = body.vertex_count - 3 * body.vertex_count / 2 + static_cast<int>(faces.size());
  return euler == 2 ? "" : "Euler characteristic";
}

/// Vertices of the intersection of half spaces, by trying all triples of planes.
std::vector<glm::dvec3> brute_vertices(const std::vector<Plane>& planes, double tolerance) {
  std::vector<glm::dvec3> found;
  for (std::size_t a = 0; a < planes.size(); ++a) {
    for (std::size_t b = a + 1; b < planes.size(); ++b) {
      for (std::size_t c = b + 1; c < planes.size(); ++c) {
        const glm::dmat3 rows(planes[a].normal, planes[b].normal, planes[c].normal);
        if (std::abs(glm::determinant(rows)) < 1e-9) continue;
        const glm::dvec3 p = glm::inverse(glm::transpose(rows)) *
                             -glm::dvec3(planes[a].offset, planes[b].offset, planes[c].offset);
        if (std::all_of(planes.begin(), planes.end(),
                        [&](const Plane& q) { return distance(q, p) >= -tolerance; }))
          found.push_back(p);
      }
    }
  }
  return found;
}

std::vector<Plane> box_planes(const Box& box) {
  const Polytope body = box_polytope(box);
  return {body.plane.begin(), body.plane.begin() + 6};
}

Plane draw_plane(double reach) {
  glm::dvec3 normal{between(-1, 1), between(-1, 1), between(-1, 1)};
  if (glm::length(normal) < 0.1) normal = {0.6, 0.0, 0.8};
  if (chance(0.2))
    normal = glm::dvec3(pick(3) - 1, 0, 1);  // along axes and diagonals: many planes through edges
  return {glm::normalize(normal), chance(0.1) ? 0.0 : between(-reach, reach)};
}

TEST(Body, a_flat_box_is_kept_as_a_polytope_with_coinciding_vertices) {
  for (const glm::dvec3& half : {glm::dvec3(1, 1, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 0)}) {
    Polytope body = box_polytope({-half, half});
    clip(body, cube(2.0));
    EXPECT_EQ(body.vertex_count, 8);
    EXPECT_EQ(malformed(body), "");
    const Box bounds = bounds_of(body);
    EXPECT_EQ(bounds.min, -half);
    EXPECT_EQ(bounds.max, half);
  }
}

TEST(Body, a_flat_box_is_cut_across_like_any_other) {
  Polytope body = box_polytope({{-1, -1, 0}, {1, 1, 0}});
  clip(body, Plane{{1, 0, 0}, -0.5});
  EXPECT_EQ(malformed(body), "");
  EXPECT_EQ(bounds_of(body).min, glm::dvec3(0.5, -1, 0));
  EXPECT_EQ(bounds_of(body).max, glm::dvec3(1, 1, 0));
}

TEST(Body, nothing_is_left_of_an_empty_box_or_beyond_a_plane) {
  Polytope body = box_polytope(cube(1.0));
  clip(body, Box{});
  EXPECT_TRUE(body.empty());
  EXPECT_TRUE(bounds_of(body).empty());
  clip(body, Plane{{1, 0, 0}, 0.0});  // an empty body stays empty
  EXPECT_TRUE(body.empty());
  Polytope away = box_polytope(cube(1.0));
  clip(away, Plane{{1, 0, 0}, -1.5});
  EXPECT_TRUE(away.empty());
  Polytope apart = box_polytope(cube(1.0));
  clip(apart, Box{{3, 3, 3}, {4, 4, 4}});
  EXPECT_TRUE(apart.empty());
}

TEST(Body, boxes_that_touch_share_their_common_face_edge_or_corner) {
  const Box neighbours[] = {{{1, -1, -1}, {2, 1, 1}}, {{1, 1, -1}, {2, 2, 1}}, {{1, 1, 1}, {2, 2, 2}}};
  for (const Box& other : neighbours) {
    Polytope body = box_polytope(cube(1.0));
    clip(body, other);
    ASSERT_FALSE(body.empty());
    EXPECT_EQ(malformed(body), "");
    const Box shared = bounds_of(body);
    EXPECT_LE(glm::length(shared.min - glm::max(other.min, glm::dvec3(-1.0))), kClip);
    EXPECT_LE(glm::length(shared.max - glm::dvec3(1.0)), kClip);
  }
}

TEST(Body, a_plane_that_only_touches_changes_nothing) {
  Polytope body = box_polytope(cube(1.0));
  clip(body, Plane{{-1, 0, 0}, 1.0});
  clip(body, Plane{glm::normalize(glm::dvec3(-1, -1, 0)), std::sqrt(2.0)});
  clip(body, Plane{glm::normalize(glm::dvec3(-1, -1, -1)), std::sqrt(3.0)});
  EXPECT_EQ(body.vertex_count, 8);
  EXPECT_EQ(body.face_count, 6);
}

TEST(Body, a_cube_loses_a_corner_to_a_triangle) {
  Polytope body = box_polytope(cube(1.0));
  clip(body, Plane{glm::normalize(glm::dvec3(-1, -1, -1)), 2.0 / std::sqrt(3.0)});
  EXPECT_EQ(malformed(body), "");
  EXPECT_EQ(body.vertex_count, 10);
  EXPECT_EQ(body.face_count, 7);
  int on_cap = 0;
  for (const Polytope::Vertex& v : body.vertices()) {
    if (std::find(v.face.begin(), v.face.end(), 6) == v.face.end()) continue;
    ++on_cap;
    EXPECT_NEAR(v.position.x + v.position.y + v.position.z, 2.0, kClip);
  }
  EXPECT_EQ(on_cap, 3);
}

TEST(Body, a_cube_cut_through_its_middle_across_the_diagonal_is_a_hexagon) {
  Polytope body = box_polytope(cube(1.0));
  clip(body, Plane{glm::normalize(glm::dvec3(1, 1, 1)), 0.0});
  EXPECT_EQ(malformed(body), "");
  EXPECT_EQ(body.vertex_count, 10);  // four corners and the hexagon
}

TEST(Body, a_frustum_slice_has_its_corners_where_the_image_edges_are) {
  Camera camera = perspective_camera({5, 6, 7}, {0, 0, -1}, {0, 1, 0}, 1.2, 1.5, 0.5, 100, 640, 480);
  camera.left *= 0.5;  // off-axis
  const CameraAxes axes = camera_axes(camera);
  const Polytope body = frustum_slice(camera, axes, 2.0, 1e9);
  EXPECT_EQ(malformed(body), "");
  for (int i = 0; i < 8; ++i) {
    const double depth = (i & 4) ? 1e9 : 2.0;
    const glm::dvec3 expected((i & 1 ? camera.right : camera.left) * depth,
                              (i & 2 ? camera.top : camera.bottom) * depth, -depth);
    const glm::dvec3 p = body.vertex[static_cast<std::size_t>(i)].position;
    EXPECT_LE(glm::length(p - expected), 1e-15 * depth);
    for (int f = 0; f < 6; ++f)
      EXPECT_GE(distance(body.plane[static_cast<std::size_t>(f)], p), -1e-15 * depth);
  }
}

TEST(BodyProperty, cutting_a_box_leaves_a_well_formed_body_with_the_vertices_of_brute_force) {
  int cut = 0;
  for_all(1500, [&] {
    const double scale = std::exp2(between(-40.0, 40.0));
    const Box box = {scale * glm::dvec3(-between(0.1, 1), -between(0.1, 1), -between(0.1, 1)),
                     scale * glm::dvec3(between(0.1, 1), between(0.1, 1), between(0.1, 1))};
    std::vector<Plane> planes = box_planes(box);
    Polytope body = box_polytope(box);
    const int count = 1 + pick(8);
    for (int i = 0; i < count; ++i) {
      const Plane plane = draw_plane(0.7 * scale);
      planes.push_back(plane);
      clip(body, plane);
      require(malformed(body).empty(), malformed(body), "after plane", i);
    }
    if (body.face_count > 6 && !body.empty()) ++cut;
    const double tolerance = kClip * scale;
    for (const Polytope::Vertex& v : body.vertices()) {
      for (const Plane& plane : planes) {
        require(distance(plane, v.position) >= -tolerance, "vertex outside by",
                distance(plane, v.position) / scale);
      }
    }
    const auto expected = brute_vertices(planes, -1e-9 * scale);  // clearly inside, so no doubt about them
    for (const glm::dvec3& p : expected) {
      double nearest = 1e300;
      for (const Polytope::Vertex& v : body.vertices())
        nearest = std::min(nearest, glm::length(v.position - p));
      require(nearest <= 1e-6 * scale, "missing vertex", p.x / scale, p.y / scale, p.z / scale, "nearest",
              nearest / scale);
    }
  });
  EXPECT_GT(cut, 500);
}

TEST(BodyProperty, the_body_reaches_as_far_in_every_direction_as_the_intersection_does) {
  for_all(800, [&] {
    const Box a = cube(1.0);
    std::vector<Plane> planes = box_planes(a);
    Polytope body = box_polytope(a);
    const int count = 1 + pick(6);
    for (int i = 0; i < count; ++i) {
      planes.push_back(draw_plane(0.7));
      clip(body, planes.back());
    }
    const auto vertices = brute_vertices(planes, 1e-9);
    if (body.empty()) {
      // At most a sliver of the tolerance's width.
      require(brute_vertices(planes, -1e-9).empty(), "lost a body of", vertices.size(), "vertices");
      return;
    }
    if (vertices.empty()) return;
    Random random(3);
    for (int i = 0; i < 10; ++i) {
      const glm::dvec3 d = random.direction();
      double ours = -1e300, theirs = -1e300;
      for (const Polytope::Vertex& v : body.vertices()) ours = std::max(ours, glm::dot(d, v.position));
      for (const glm::dvec3& v : vertices) theirs = std::max(theirs, glm::dot(d, v));
      require(std::abs(ours - theirs) <= 1e-5, "reach", ours, "brute force", theirs);
    }
  });
}

TEST(BodyProperty,
     a_point_is_in_both_box_and_frustum_exactly_where_it_is_in_the_faces_of_their_intersection) {
  std::uint64_t inside = 0;
  for_all(500, [&] {
    const Case c = draw_case({.max_depth_ratio = 1e3, .max_boxes = 1});
    const Polytope frustum =
        frustum_slice(c.camera, camera_axes(c.camera), c.camera.near_depth, c.camera.far_depth);
    const Box box{c.receivers[0].min - c.camera.position, c.receivers[0].max - c.camera.position};
    Polytope body = frustum;
    clip(body, box);
    require(malformed(body).empty(), malformed(body));
    std::vector<Plane> kept;
    std::set<int> used;
    for (const Polytope::Vertex& v : body.vertices()) used.insert(v.face.begin(), v.face.end());
    for (const int f : used) kept.push_back(body.plane[static_cast<std::size_t>(f)]);
    Random random(9);
    const double margin = 1e-9 * c.camera.far_depth;
    for (int i = 0; i < 60; ++i) {
      // Half of the points in and around the box, half in and around the frustum.
      const glm::dvec3 in_view = point_at(c.camera, random.between(-1.1, 1.1), random.between(-1.1, 1.1),
                                          c.camera.far_depth * random.unit()) -
                                 c.camera.position;
      const glm::dvec3 in_box =
          0.5 * (box.min + box.max) +
          0.55 * (box.max - box.min) *
              glm::dvec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
      const glm::dvec3 p = i % 2 == 0 ? in_view : in_box;
      double deepest = 1e300;
      for (int f = 0; f < 6; ++f)
        deepest = std::min(deepest, distance(frustum.plane[static_cast<std::size_t>(f)], p));
      for (int axis = 0; axis < 3; ++axis)
        deepest = std::min({deepest, p[axis] - box.min[axis], box.max[axis] - p[axis]});
      if (std::abs(deepest) <= margin) continue;
      double in_body = body.empty() ? -1.0 : 1e300;
      for (const Plane& plane : kept) in_body = std::min(in_body, distance(plane, p));
      require((deepest > 0.0) == (in_body > 0.0), "by its sources", deepest, "by the body", in_body);
      inside += deepest > 0.0;
    }
  });
  EXPECT_GT(inside, 200u);
}

// It asks all vertices about both faces across an axis at once.
TEST(BodyProperty, a_box_cuts_as_its_planes_do_one_after_another) {
  int cut = 0;
  for_all(1500, [&] {
    Polytope body = box_polytope(cube(1.0));
    const int before = pick(4);
    for (int i = 0; i < before; ++i) clip(body, draw_plane(0.7));
    if (body.empty()) return;
    Box box;
    box.extend({between(-1, 1), between(-1, 1), between(-1, 1)});
    box.extend({between(-1, 1), between(-1, 1), between(-1, 1)});
    Polytope by_planes = body;
    clip(body, box);
    for (const Plane& plane : box_planes(box)) clip(by_planes, plane);
    if (body.empty() && by_planes.empty()) return;
    require(difference(body, by_planes).empty(), difference(body, by_planes));
    ++cut;
  });
  EXPECT_GT(cut, 500);
}

TEST(BodyProperty, any_number_of_planes_never_exceeds_the_storage_and_never_cuts_into_the_body) {
  for_all(100, [&] {
    // Planes that touch the unit ball: their intersection holds it however many there are.
    Polytope body = box_polytope(cube(2.0));
    Random random(static_cast<std::uint64_t>(pick(1 << 20)));
    for (int i = 0; i < 150; ++i) clip(body, Plane{random.direction(), 1.0});
    require(malformed(body).empty(), malformed(body));
    for (int i = 0; i < 50; ++i) {
      const glm::dvec3 d = random.direction();
      double reach = 0.0;
      for (const Polytope::Vertex& v : body.vertices()) reach = std::max(reach, glm::dot(d, v.position));
      require(reach >= 1.0 - kClip, "cut into the ball:", reach);
    }
  });
}

}  // namespace
}  // namespace gnomon::test
