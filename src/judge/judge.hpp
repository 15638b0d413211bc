// What is wrong with an engine's shadow maps, how much, where, and what would mend it?
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/measure.hpp"
#include "judge/capture.hpp"
#include "judge/seen.hpp"

namespace gnomon::judge {

/// Kinds of faults, in the order in which they are listed: what makes others meaningless comes first.
enum class FindingKind : std::uint8_t {
  transposed,           ///< the matrix is written the other way round
  light_direction,      ///< the map looks along another ray than its light's
  depth_reversed,       ///< depth grows the other way than the convention says
  mirrored,             ///< the map shows a mirror image
  texture_space,        ///< the matrices lead to texture coordinates
  depth_convention,     ///< depths are of the other range: 0..1 or -1..1
  receivers_outside,    ///< visible surfaces are in no map
  receivers_cut,        ///< visible surfaces are before the near or behind the far plane of their map
  casters_cut,          ///< casters are before the near plane
  selection_disagrees,  ///< the map that is chosen does not hold the point, and another does
  gap_between_maps,     ///< view depths belong to no map
  density_step,         ///< texels change their size at once from map to map
  map_unseen,           ///< a map serves nothing that the camera sees
  texels_unseen,        ///< most of a map's texels are nowhere in view
  atlas_overlap,        ///< two maps share texels of the atlas
  atlas_outside,        ///< a map is not in the atlas
  filter_leaves_map,    ///< the kernel reads beyond the map's rim
  matrix_precision,     ///< rounding of a float matrix moves look-ups
  depth_precision,      ///< steps of depth are larger than the bias
  bias_small,           ///< surfaces will shadow themselves
  bias_large,           ///< shadows leave the foot of their casters
  swimming,             ///< texels move over the world from frame to frame
  density_jump,         ///< texels change their size from frame to frame
};
inline constexpr std::size_t kFindingKinds = static_cast<std::size_t>(FindingKind::density_jump) + 1;
/// As in files: "bias_small".
[[nodiscard]] std::string_view to_string(FindingKind kind) noexcept;
/// Whether a finding costs texels and no shadow: map_unseen and texels_unseen.
[[nodiscard]] bool is_waste(FindingKind kind) noexcept;

/// Three digits.
[[nodiscard]] std::string digits(double value);
/// "1.23 %".
[[nodiscard]] std::string percent(double share);

/// One fault of one light's maps, with its largest extent over all frames.
struct Finding {
  FindingKind kind{};
  std::string what;    ///< one sentence
  std::string change;  ///< what mends it
  double size = 0.0;   ///< in `unit`
  std::string_view unit;
  int light = 0, map = -1;          ///< indices; -1: all maps of the light
  std::vector<int> also;            ///< other maps of the light with the same kind of fault
  int frame = 0;                    ///< where it is largest
  int frames = 1;                   ///< in how many frames it is
  std::optional<glm::dvec2> pixel;  ///< where in that frame's image
};

/// Points that the map chosen for them does not hold, of all that maps are to serve.
[[nodiscard]] double share_missed(const AliasingStats& error) noexcept;

/// One visible point of the first frame. No map serves it: infinite. Nothing to sample: negative.
struct SeenError {
  glm::dvec2 pixel{0.0};
  double m = -1.0, planned_m = -1.0;
};

/// The errors of one light's maps in the first frame, beside those of gnomon's own.
struct LightFigures {
  int light = 0;
  ShadowPlan plan;  ///< the maps as data for measure() and a renderer, in the file's order
  std::int64_t texels = 0;
  AliasingStats error;
  struct OfMap {
    int map;  ///< index in the frame
    AliasingStats error;
  };
  std::vector<OfMap> of_map;
  /// gnomon's, for the same camera and as many maps of as many texels.
  struct Planned {
    Fit fit;
    ShadowPlan plan;
    std::int64_t texels = 0;
    AliasingStats error;
  };
  std::optional<Planned> tight, stable;  ///< fitted to each view, and on a grid that stays; none: no plan
  std::vector<SeenError> seen;           ///< `planned_m`: of `tight`
  /// Those that there are.
  [[nodiscard]] std::vector<const Planned*> planned() const;
};

/// The maps of one light of a frame as a plan, for measure() and a renderer, in the file's order.
[[nodiscard]] ShadowPlan plan_of(const Capture& capture, const CapturedFrame& frame, int light);

struct Judgement {
  std::vector<LightFigures> lights;
  std::vector<Finding> findings;
  std::vector<std::string> notes;  ///< what could not be judged, and why
};

/// Judges all lights and frames.
[[nodiscard]] Judgement judge(const Capture& capture);

}  // namespace gnomon::judge
