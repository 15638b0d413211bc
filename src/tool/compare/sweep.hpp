// The product of techniques that `gnomon compare` goes through.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/pages.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/report/row.hpp"
#include "measuring.hpp"
#include "others_frames.hpp"
#include "technique_words.hpp"

namespace gnomon::tool {

/// Most lights of --local-lights.
inline constexpr int kMostLocalLights = 64;

/// The product of techniques, and what it is measured on. Each list has at least one entry, but `pages`.
struct SweepRequest : Measuring {
  std::vector<TechniqueFilter> filters = {TechniqueFilter{}};
  std::vector<TechniqueLayer> layers = {TechniqueLayer{}};
  std::vector<TechniqueWarp> warps = {TechniqueWarp{}};
  /// Beside the warps: each shape that is not affine as WARP:SHAPE.
  std::vector<const Shape*> shapes{&shapes::linear};
  std::vector<TechniqueSplit> splits = {TechniqueSplit{}};
  std::vector<Fit> fits{Fit::tight};
  std::vector<int> cascades{1}, map_sizes{1024};
  std::vector<const PagePolicy*> pages = {};  ///< policies beside the maps; none: maps alone
  std::vector<int> page_sizes{128};
  std::vector<report::Technique> techniques = {};  ///< beside the product, each as it is
  double page_target = 0.0;  ///< error m that pages are opened for; 0: the least that the pool holds
  double near_hint = 0.0;    ///< of split pseudo_near: view depth from which error counts
  bool visible_depths = false, visible_points = false;  ///< plan with what a frame shows
  render::MapPasses map_passes = render::MapPasses::automatic;
  int pixel_samples = 0;  ///< rays through each pixel, for errors over whole pixels; 0: none
  int timed_frames = 0;   ///< of the frames, evenly spread, that are timed; 0: each
  int local_lights = 0;   ///< over the scene, each measured alone; 0: the one placed
  int local_light = 0;    ///< index of the one that this sweep measures
};

/// A sweep of one kind of maps, with the hard filter.
[[nodiscard]] SweepRequest one_kind_of_maps(const Measuring& measuring, const MeasuredMaps& maps);

/// One point of the product, with what the names stand for.
struct SweepEntry {
  report::Technique technique;
  PlanOptions plan;
  render::FilterSettings filter;                         ///< hard where irregular(), or with identifiers
  std::optional<render::IdentifierTest> identifiers;     ///< shadows by them in place of a filter
  render::DepthLayer layer = render::DepthLayer::front;  ///< that maps and pages store
  render::MapPasses map_passes = render::MapPasses::automatic;  ///< changes time alone: no part of the name
  bool linear_depth = false;                                    ///< the same depths, even along the light
  int irregular_samples = 0;                                    ///< of a pixel, by lists; 0: by a filter
  bool visible_depths = false;                                  ///< of the frame, given to the plan
  bool coarse_depths = false;            ///< of a coarse pass on the CPU, given to the plan
  bool shares_texels = false;            ///< the maps share the texels of equal ones, as a budget
  PlanPoints points = PlanPoints::none;  ///< given to the plan
  PageOptions pages;                     ///< where by_pages()
  /// Maps of another engine in place of a plan, and masks that others drew; nullptr: none.
  std::shared_ptr<const CapturedMaps> captured = nullptr;
  std::shared_ptr<const GivenMasks> given = nullptr;

  /// Drawn by lists of pixels.
  [[nodiscard]] bool irregular() const noexcept { return irregular_samples > 0; }
  /// Planned by plan_pages in place of make_plan.
  [[nodiscard]] bool by_pages() const noexcept { return !technique.pages.empty(); }
};

/// Every technique once, in the order of the product.
struct Sweep : Measuring {
  std::vector<SweepEntry> entries;
  std::vector<std::string> left_out;      ///< combinations that cannot be measured, a line for each reason
  SweepEntry baseline;                    ///< hard x no warp x one map, of the first map size
  std::string camera_text;                ///< of the camera's words, for rows
  std::string edit_text;                  ///< of the scenes' edits, the same
  int pixel_samples = 0;                  ///< rays through each pixel; 0: none
  int timed_frames = 0;                   ///< as in the request
  int local_lights = 0, local_light = 0;  ///< as in the request
  std::vector<Camera> cameras;            ///< of a capture, in place of the scenes' paths; empty: none
  std::string view;                       ///< name in a study, for people; empty: none
  std::uint64_t first_index = 0;          ///< of its rows, where it is part of a study
  std::size_t first_scene = 0;            ///< number of its first scene there

  /// True for a frame that is timed, the first among them.
  [[nodiscard]] bool times(int frame) const noexcept {
    if (timed_frames == 0 || timed_frames >= frames || frame == 0) return true;
    const auto due = [&](int f) { return static_cast<long long>(f) * timed_frames / frames; };
    return due(frame) != due(frame - 1);
  }

  /// Place of a row in the whole sweep.
  [[nodiscard]] std::uint64_t index(std::size_t scene, int frame, std::size_t entry) const noexcept {
    const auto row = static_cast<std::uint64_t>(scene) * static_cast<std::uint64_t>(frames) +
                     static_cast<std::uint64_t>(frame);
    return first_index + row * entries.size() + entry;
  }
};

/// Combinations that are the same technique under two names are taken once: with one map or under a local
/// light the split does not matter, and a stable fit takes no warp. Throws std::runtime_error where nothing
/// is left to measure, or a split is given what it does not take.
[[nodiscard]] Sweep make_sweep(const SweepRequest& request);

/// Makes maps smaller that memory does not take, in the context that is current: a technique goes by the size
/// it is measured with. `map_memory_mib`: that a technique's maps may take; 0: what there is. Returns a line
/// for each. Throws std::runtime_error where not even the least fit.
std::vector<std::string> fit_to_memory(Sweep& sweep, double map_memory_mib);

/// The most maps that the plans of an entry may have under this light.
[[nodiscard]] int most_maps(const SweepEntry& entry, LightKind light) noexcept;

/// As many pages as the texels of the entry's maps hold under this light, borders included.
[[nodiscard]] int page_capacity(const SweepEntry& entry, LightKind light) noexcept;

/// The maps of an entry with one filter.
[[nodiscard]] SweepEntry captured_entry(const std::string& name, const TechniqueFilter& filter,
                                        std::shared_ptr<const CapturedMaps> captured);
/// The masks of an entry.
[[nodiscard]] SweepEntry given_entry(const std::string& name, std::shared_ptr<const GivenMasks> given);

/// What a technique's names stand for, but the capacity of its pages. Throws std::runtime_error where one of
/// them means nothing.
[[nodiscard]] SweepEntry sweep_entry(const report::Technique& technique);

}  // namespace gnomon::tool
