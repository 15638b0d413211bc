// Does a slab cut a body as its two planes do, one after the other?
#include "geometry/body.hpp"
#include "gnomon/extend/body.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "support/same_body.hpp"
#include "support/seeded_input.hpp"

namespace gnomon::test {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

TEST(Slab, an_endless_one_changes_nothing) {
  const Polytope body = box_polytope({glm::dvec3(-1.0), glm::dvec3(2.0)});
  Polytope cut = body;
  clip_to_slab(cut, {0.0, 0.6, 0.8}, -kEndless, kEndless);
  EXPECT_EQ(difference(cut, body), "");
}

TEST(Slab, nothing_is_left_beyond_either_plane) {
  for (const double at : {-3.0, 3.0}) {
    Polytope body = box_polytope({glm::dvec3(-1.0), glm::dvec3(1.0)});
    clip_to_slab(body, {1.0, 0.0, 0.0}, at - 1.0, at + 1.0);
    EXPECT_TRUE(body.empty()) << at;
  }
}

TEST(Slab, of_no_thickness_it_leaves_a_flat_body) {
  Polytope body = box_polytope({glm::dvec3(-1.0), glm::dvec3(1.0)});
  clip_to_slab(body, {0.0, 1.0, 0.0}, 0.25, 0.25);
  ASSERT_FALSE(body.empty());
  for (const Polytope::Vertex& v : body.vertices()) EXPECT_EQ(v.position.y, 0.25);
}

TEST(Slab, it_cuts_as_its_planes_do_one_after_the_other) {
  int cut = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    SeededNumbers draw(seed);
    Polytope body = box_polytope({glm::dvec3(-1.0), glm::dvec3(1.0)});
    for (int i = draw.pick(4); i > 0; --i)
      clip(body, Plane{glm::normalize(draw.vector()), draw.between(0.1, 1.0)});
    const glm::dvec3 normal = glm::normalize(draw.vector());
    const double a = draw.between(-1.0, 1.0), b = draw.between(-1.0, 1.0);
    const double begin = std::min(a, b), end = std::max(a, b);
    Polytope by_planes = body, by_slab = body;
    clip_to_slab(by_slab, normal, begin, end);
    clip(by_planes, Plane{normal, -begin});
    clip(by_planes, Plane{-normal, end});
    EXPECT_EQ(difference(by_slab, by_planes), "") << seed;
    cut += by_slab.empty() ? 0 : 1;
  }
  EXPECT_GT(cut, 2000);
}

}  // namespace
}  // namespace gnomon::test
