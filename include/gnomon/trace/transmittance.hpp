// How much of the light passes the panes between this point and the light, exactly?
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "gnomon/light.hpp"
#include "gnomon/scene/translucent.hpp"
#include "gnomon/trace/reference.hpp"

namespace gnomon::trace {

/// The panes of a scene (split_translucent), ready for rays. Keeps no reference to them. Calls from several
/// threads at once are fine.
class PaneTracer {
 public:
  /// `panes`: every triangle counts, whatever its alpha mode.
  explicit PaneTracer(const Scene& panes);
  ~PaneTracer();
  PaneTracer(const PaneTracer&) = delete;
  PaneTracer& operator=(const PaneTracer&) = delete;

  /// Product of the transmittances of all panes that the ray meets, each by the finest level of its picture,
  /// read bilinearly. A ray through the very edge of two triangles meets both.
  [[nodiscard]] glm::dvec3 transmittance(const Ray& ray) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Transmittance towards the light's centre.
struct PaneReference {
  int width = 0, height = 0;  ///< pixels
  std::vector<glm::dvec3>
      pixels;  ///< width x height, rows top to bottom; 1 where there is nothing to evaluate
};
/// For all facing points, one ray each; undecided ones count as nothing.
[[nodiscard]] PaneReference pane_reference(const PaneTracer& panes, const SurfacePoints& points,
                                           const Light& light);

}  // namespace gnomon::trace
