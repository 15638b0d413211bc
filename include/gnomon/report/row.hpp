// One result: what one technique did on one frame of one scene, and where and how that was measured. A row
// explains itself; a file of rows is JSON lines.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "gnomon/report/errors.hpp"
#include "gnomon/report/statistics.hpp"

namespace gnomon::report {

/// A file that is not what it should be. what() is one line: path, line, what is wrong.
class ReportError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// How the shadow was made.
struct Technique {
  std::string warp, split, fit, filter;  ///< names as on the command line
  int cascades = 1;                      ///< requested
  int map_size = 1024;                   ///< texels along each side
  /// Page policy: a pool of pages, with as many texels as the maps would have, replaces them. Empty: maps.
  std::string pages = {};
  int page_texels = 0;         ///< along each side that a page serves; 0: maps
  double page_target_m = 0.0;  ///< error that pages are opened for; 0: the least that the pool holds
  /// Name of the render::DepthLayer that the maps store. Empty: front.
  std::string layer = {};
  /// Name of a technique of others. Where gnomon plans it, the rest says how. Where their maps or masks are
  /// measured, warp, split and fit are empty, and cascades and map_size 0 for masks. Empty: gnomon's own.
  std::string entry = {};
  /// Maps or masks that others made: gnomon has no plan of it.
  [[nodiscard]] bool is_given() const noexcept { return !entry.empty() && warp.empty(); }
  /// "warp lispsm", "pages resolution" or "entry three": the charts' marks.
  [[nodiscard]] std::string kind() const;
  /// "none / auto / 4 x 1024 / pcf": unique within a sweep, for people.
  [[nodiscard]] std::string name() const;
  /// The same names and numbers.
  bool operator==(const Technique&) const = default;
};

/// Where it was measured.
struct Machine {
  std::string renderer, context;   ///< GL_RENDERER; kind of context
  std::string cpu, version, rays;  ///< names of CPU, gnomon's version and ray tracer
  bool software = true;            ///< drawn by the CPU
  int cores = 0;                   ///< logical ones
  double load = 0.0;               ///< average over the last minute, when the row was measured
};

/// Milliseconds of the wall clock after the driver has finished, but plan_ns.
struct Times {
  Estimate plan_ns, depth_ms, prefilter_ms, shade_ms;  ///< nanoseconds, then milliseconds
  Estimate total_ms;                                   ///< of the four
  double baseline_ms = 0.0;  ///< median total of hard x no warp x one map in the same rounds
  /// The same once more in those rounds, as if it were another technique: what the clock's noise is. 0: not
  /// measured.
  double baseline_again_ms = 0.0;
  int rounds = 0;  ///< measured, warm-up not counted; 0: stated by an entry, or total_ms 0: not known
  /// False for a frame that was not timed, and where an entry states no time.
  [[nodiscard]] bool known() const noexcept { return total_ms.median > 0.0; }
  /// total over baseline; 0 where there is none.
  [[nodiscard]] double ratio() const noexcept {
    return baseline_ms > 0.0 ? total_ms.median / baseline_ms : 0.0;
  }
};

/// Pixels in each list of an irregular z-buffer; lists without pixels are skipped.
struct ListLengths {
  double mean = 0.0;                ///< over the lists
  std::uint64_t p99 = 0, most = 0;  ///< 99 % of the lists are not longer; the longest
};

/// Counts of one frame's shadows.
struct Costs {
  int maps = 0;                                                       ///< drawn
  std::uint64_t draws = 0, triangles = 0, texels = 0, map_bytes = 0;  ///< over all maps
  std::uint64_t filtered_texels = 0;                                  ///< stored and blurred by the filter
  ListLengths lists = {};  ///< of technique "irregular" and its samples alone
};

/// One omission of the plan, or the savings of one prune rule.
struct LeftOut {
  std::string what, why;          ///< as describe() words them
  std::int64_t saves_texels = 0;  ///< not drawn
  std::string rule = {};  ///< of gnomon::prune_rules(): all that it saved of the frame; empty: one thing
  std::int64_t saves_triangles = 0;  ///< not drawn
  std::int64_t saves_filtered = 0;   ///< texels that the filter did not store and blur
};

/// Files beside the rows, relative to their folder; empty: none was written for this frame.
struct Pictures {
  std::string image, truth, mask, difference, heat;  ///< PNG files
};

/// Rays of a pixel by default.
inline constexpr int kPixelSamples = 16;

/// One technique on one frame of one scene.
struct Row {
  std::uint64_t index = 0;  ///< place in the whole sweep, the same in every shard
  std::string scene;        ///< as on the command line
  std::string scene_hash;   ///< of the scene's files, in hexadecimal; empty: built in, or not known
  int frame = 0, frames = 1, width = 0, height = 0;  ///< index, count, pixels
  std::string light;  ///< "sun", "spot" or "point", in the direction of elevation and azimuth
  double light_elevation_deg = 0.0, light_azimuth_deg = 0.0;  ///< degrees
  /// Where the camera was placed by hand: its eye, or its path's file and a number for what that holds.
  /// Empty: the scene's own flight.
  std::string camera = {};
  /// Edits of the scene: "ground", planes of a section, and a file of shadow proxies with a number for what
  /// it holds. Empty: as its file has it.
  std::string edits = {};
  std::string animation = {};     ///< of the scene that plays, by name or number; empty: the scene is at rest
  double animation_time_s = 0.0;  ///< of the frame's pose, seconds
  Technique technique;            ///< how the shadow was made
  std::string plan_status;        ///< name of the PlanStatus
  /// What mean_error is against: "filtered", "area", "hard" or "facet". "none": masks of an unknown kernel,
  /// which have no mean error, leaking and darkening.
  std::string truth;
  MaskErrors errors;                   ///< against the truth
  std::uint64_t undecided_pixels = 0;  ///< undecided by the geometry, not counted in `errors`
  /// Excess flips per pixel over one step of a 60 Hz viewer; not a number where an entry has no frame before.
  double flips = 0.0;
  int pixel_samples = kPixelSamples;      ///< rays of each pixel for `pixel`; 0: not measured
  std::optional<PixelErrors> pixel = {};  ///< against whole pixels; rows of earlier versions have none
  PixelAliasing aliasing;                 ///< over the pixels of the frame
  /// Misclassified share of the pixels compared that the plan's maps or pages were expected to have under
  /// hard comparison, without drawing them (expected_error). Rows of pages of earlier versions have none.
  std::optional<double> expected_wrong = {};
  Costs costs;                    ///< of the frame
  Times times;                    ///< over all rounds
  std::vector<LeftOut> left_out;  ///< by the plan and the renderer
  Pictures pictures;              ///< of this frame
  Machine machine;                ///< that measured

  /// Name of the view in a study, for people. Empty: none.
  std::string view = {};

  /// Masks that others drew: nothing of their maps is known.
  [[nodiscard]] bool is_masks() const noexcept { return !technique.entry.empty() && technique.cascades == 0; }
  /// Everything that identifies a measurement, except the machine, the view's name and the content of the
  /// scene's files: equal keys mean the same measurement.
  [[nodiscard]] std::string key() const;
};

/// One line of JSON without its end. Infinite values are written as null.
[[nodiscard]] std::string to_json_line(const Row& row);
/// Throws ReportError with `where` in front.
[[nodiscard]] Row row_from_json(const std::string& line, const std::string& where);
/// The row without what differs between two runs of the same sweep: times, load and machine.
[[nodiscard]] std::string without_times(const Row& row);

}  // namespace gnomon::report
