// Which answer must a look-up give, whatever its texels' centres and its bias are? Triangles in the space of
// a map, by arithmetic alone: no ray is sampled, and nothing is drawn.
//
// A look-up at a point reads texels within some reach of it. Its *body* is that rectangle of the map, swept
// along the light. A pixel is decided
// - lit, where no other triangle has a part in the body before the receiver's plane, and the bias is at least
//   twice what rounding can do at the receiver's slope: each texel then holds the plane itself or what is
//   behind it;
// - dark, where each texel's centre, a square of rounding round it, lies within a triangle that is farther
//   before the plane than twice the largest bias: each texel then holds that triangle, or what is before it.
// All other pixels are undecided, and no answer for them is wrong. A triangle without area is none that hides
// or lights anything; but rasterizers move its corners, and it then may leave any depth along its line.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "gnomon/light.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/scene/scene.hpp"

namespace gnomon::stress {

/// A triangle in the world, in the order of trace::Tracer: masked ones come last.
struct WorldTriangle {
  std::array<glm::dvec3, 3> corner;  ///< relative to the eye
  std::uint32_t instance = 0;
  bool masked = false;  ///< has holes, or may have
  bool flat = false;    ///< without area
  bool casts = true;    ///< false: it is in no map
};
[[nodiscard]] std::vector<WorldTriangle> world_triangles(const Scene& scene, const glm::dvec3& eye);

enum class Must : std::uint8_t { undecided, lit, dark };

/// A receiver: a point of a triangle, and what is known of its place in the picture.
struct Receiver3 {
  glm::dvec3 point{0.0};       ///< relative to the eye
  glm::dvec3 normal{0.0};      ///< unit, of the triangle, towards the viewer
  std::uint32_t triangle = 0;  ///< index in the list
  double normal_error = 0.0;   ///< length of the difference to the picture's normal
  double height_error = 0.0;   ///< of the picture's point off the plane, world units
};

/// How a source compares.
struct Comparing {
  double reach_texels = 2.0;  ///< of the look-up, its kernel included
  bool linear_depth = false;  ///< depths are even along the light
  BiasOptions bias;
};

/// Triangles as one map shows them.
class MapSpace {
 public:
  /// `eye_world`: what the triangles' corners and the plan's matrices in float are relative to.
  MapSpace(const ShadowMap& map, const ClipSpace& clip_space, const glm::dvec3& eye_world, const Light& light,
           const std::vector<WorldTriangle>& triangles);

  /// For sources that compare depths.
  [[nodiscard]] Must decide(const Receiver3& receiver, const Comparing& comparing) const;
  /// For filters that store texels: only where a whole map is parallel to the light's wavefront, and all of
  /// the look-up's texels hold one depth, the receiver's own, or one at least `contact` of the map's depths
  /// before it.
  [[nodiscard]] Must decide_even(const Receiver3& receiver, const Comparing& comparing, double contact) const;
  /// For sources that compare identifiers, of which only the offset along the normal is a bias.
  /// `by_triangle`: each triangle has its own.
  [[nodiscard]] Must decide_identifier(const Receiver3& receiver, const Comparing& comparing,
                                       bool by_triangle) const;

 private:
  struct Corner {
    glm::dvec4 clip;
    double height;
  };
  struct Shape3 {
    std::array<glm::dvec4, 3> clip;
    glm::dvec2 low, high;  ///< bounds in ndc; infinite where a corner is not before the light
  };
  struct Rectangle {
    glm::dvec2 low, high;
  };
  struct Look;
  using Polygon = std::vector<Corner>;

  /// Largest sum of the sizes of a row's terms at any corner: what a float's product with it rounds by.
  [[nodiscard]] double row_terms(int row) const;
  /// Texels that the offset along the normal may move a look-up.
  [[nodiscard]] double moved_by_offset(const Receiver3& receiver, const BiasOptions& bias) const;
  [[nodiscard]] bool look_at(const Receiver3& receiver, double reach_texels, Look& look) const;
  [[nodiscard]] std::vector<std::uint32_t> near(const Rectangle& ndc) const;
  void part(std::uint32_t triangle, const Receiver3& receiver, const Rectangle& ndc, Polygon& out) const;
  [[nodiscard]] double depth_rounding(const Receiver3& receiver, const Look& look, bool linear) const;
  [[nodiscard]] bool all_centres_dark(const Receiver3& receiver, const Look& look,
                                      const std::vector<std::uint32_t>& candidates, double height) const;
  [[nodiscard]] bool covers(std::uint32_t triangle, const Receiver3& receiver, const Rectangle& ndc,
                            double least_height) const;
  template <class Answer>
  [[nodiscard]] bool all_centres(const Look& look, const Answer& answer) const;

  ShadowMap map_;
  const std::vector<WorldTriangle>& triangles_;
  Light light_;
  glm::dvec3 eye_;
  glm::dmat4 clip_from_relative_;
  std::vector<Shape3> shapes_;
  glm::dvec3 extent_{0.0};   ///< largest coordinate of any corner
  double depth_unit_ = 1.0;  ///< of ndc depth for all of a depth buffer's range
};

}  // namespace gnomon::stress
