// Which view depths of a scene can show a surface? Its largest meshes by their triangles, the others by their
// boxes.
#pragma once

#include <cstdint>
#include <vector>

#include "gnomon/scene/scene.hpp"
#include "gnomon/view.hpp"

namespace gnomon {

/// Holds the memory that coarse_depths() needs from frame to frame.
class CoarseView {
 public:
  /// The visible depths of the scene as it is now. The meshes that are largest in the image are drawn by
  /// their triangles, as many as stay within `most_triangles`. The others count by their boxes, which makes
  /// the range wider and the pass faster (docs/performance.md). Empty as coarse_depths().
  [[nodiscard]] VisibleDepths depths(const Scene& scene, const Camera& camera,
                                     std::uint64_t most_triangles = 20'000);

 private:
  struct Candidate {
    double size = 0.0;  ///< of the box over its distance
    std::uint32_t instance = 0;
  };
  std::vector<Candidate> candidates_;
  std::vector<CoarseMesh> meshes_;
  std::vector<Box> boxes_;
  std::vector<CoarseTile> tiles_;
};

}  // namespace gnomon
