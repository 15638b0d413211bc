// The checks of one light's maps: each adds what it finds.
#pragma once

#include <string>
#include <vector>

#include "judge/judge.hpp"
#include "judge/look.hpp"

namespace gnomon::judge {

/// Findings, each kind of each map once: with its largest size, and in how many frames it is.
class FindingList {
 public:
  void begin_frame(int frame) { frame_ = frame; }
  /// Of the current frame: `frame` and `frames` are filled in.
  void add(Finding finding);
  /// In the order of kinds; those of several maps of a light as one, the largest.
  [[nodiscard]] std::vector<Finding> sorted() const;

 private:
  struct Known {
    Finding finding;
    int last_frame;
  };
  int frame_ = 0;
  std::vector<Known> known_;
};

/// Which maps of the light no other check can say anything about, by their place among its maps.
using BrokenMaps = std::vector<bool>;

/// Is the matrix what it is said to be? Marks the maps for which it is not.
void check_matrices(const Capture& capture, const LightLooks& looks, BrokenMaps& broken, FindingList& out);
/// Do view depths fit the camera, each other and what is seen? False where the maps serve nothing that is
/// seen.
bool check_depths(const Capture& capture, const LightLooks& looks, FindingList& out);
/// Whether the camera, of the same clip space as the maps, shows that its range of depths is the one said.
[[nodiscard]] bool camera_fits(const Capture& capture, const LightLooks& looks);
/// Do the maps hold what is seen, and what shadows it?
void check_cover(const Capture& capture, const LightLooks& looks, const BrokenMaps& broken, FindingList& out);
/// Are texels where they are seen, and is each point read from the finest map that is there for it?
void check_use(const Capture& capture, const LightLooks& looks, const BrokenMaps& broken, FindingList& out);
/// Do maps fit together: depths, sizes, places in an atlas, kernels at rims?
void check_neighbours(const Capture& capture, const LightLooks& looks, const BrokenMaps& broken,
                      FindingList& out);
/// Do single precision and the depth buffer hold what is needed, and is the bias right?
void check_precision(const Capture& capture, const LightLooks& looks, const BrokenMaps& broken,
                     FindingList& out);
void check_bias(const Capture& capture, const LightLooks& looks, const BrokenMaps& broken, FindingList& out);
/// Do texels keep their place from one frame to the next?
void check_motion(const Capture& capture, const LightLooks& before, const LightLooks& now,
                  const BrokenMaps& broken, FindingList& out);

/// The bias at a point that faces the light, along the light, world units. Needs a normal.
[[nodiscard]] double bias_at(const CapturedMap& map, const Look& look, double cosine,
                             const glm::dvec3& normal);
/// The bias that one texel and the filter need there, so that a plane does not shadow itself.
[[nodiscard]] double needed_bias(const CapturedMap& map, const Look& look, double cosine,
                                 const glm::dvec3& normal);

/// A finding of one of the light's maps, by its place among them, or of all.
[[nodiscard]] Finding finding_of(FindingKind kind, const LightLooks& looks, std::optional<std::size_t> map,
                                 double size, std::string_view unit, std::optional<glm::dvec2> pixel = {});
/// Side of a texel across the light, world units.
[[nodiscard]] double texel_side(const Look& look);
/// "map 2".
[[nodiscard]] std::string map_name(const LightLooks& looks, std::size_t map);

}  // namespace gnomon::judge
