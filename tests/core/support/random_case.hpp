// Random cameras, lights and boxes for the laws, and points that such a camera sees.
#pragma once

#include <glm/vec3.hpp>
#include <iosfwd>
#include <vector>

#include "base/random.hpp"
#include "gnomon/gnomon.hpp"

namespace gnomon::test {

/// For bulk data, where shrinking each number would cost more than it tells.
class Random : public gnomon::Random {
 public:
  using gnomon::Random::Random;
  [[nodiscard]] glm::dvec3 direction();
};

/// Input of make_plan with its memory.
struct Case {
  Camera camera;
  glm::dvec3 light{0.0, -1.0, 0.0};
  std::vector<Box> casters, receivers;
  PlanOptions options;
  const VisibleDepths* visible = nullptr;
  [[nodiscard]] SceneBounds bounds() const { return {casters, receivers}; }
  [[nodiscard]] ShadowPlan plan() const;
};
std::ostream& operator<<(std::ostream& out, const Case& c);

/// What a law needs its input to be.
struct CaseLimits {
  bool orthographic = true, off_axis = true;
  bool light_along_view = true;
  double max_depth_ratio = 1e5;
  int max_boxes = 64;
};
/// Draws a case inside a RapidCheck property: perspective (1 to 150 degrees), off-axis or orthographic camera
/// anywhere within a few frustum lengths of the origin, light from anywhere including exactly and nearly
/// along and against the view, 1 to 64 boxes of each kind (some flat, some points), any options.
[[nodiscard]] Case draw_case(const CaseLimits& limits = {});

/// World point that the camera sees at image position (x, y) in [-1, 1]^2 and a view depth.
[[nodiscard]] glm::dvec3 point_at(const Camera& camera, double x, double y, double depth);
[[nodiscard]] double depth_of(const Camera& camera, const glm::dvec3& point);

/// Points of receivers inside the camera's frustum, corners and edges of what is visible among them.
[[nodiscard]] std::vector<glm::dvec3> visible_points(const Case& c, Random& random, int boxes, int per_box);

/// The map that serves this view depth; nullptr where the plan has none.
[[nodiscard]] const ShadowMap* map_for(const ShadowPlan& plan, double depth);

/// Where the ray start + t * step, t >= 0, is inside a box.
struct Crossing {
  bool hits;
  double enter, leave;
};
[[nodiscard]] Crossing cross(const Box& box, const glm::dvec3& start, const glm::dvec3& step);

/// Unit vector across `v`.
[[nodiscard]] glm::dvec3 any_across(const glm::dvec3& v);

}  // namespace gnomon::test
