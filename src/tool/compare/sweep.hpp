// The product of techniques that `gnomon compare` goes through.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/pages.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/report/row.hpp"
#include "gnomon/scene/default_light.hpp"
#include "gnomon/scene/load.hpp"

namespace gnomon::tool {

/// What the command line says, before it is understood.
struct CompareRequest {
  std::vector<std::string> scenes;
  std::vector<std::string> warps{"none", "lispsm", "optimal"}, splits{"auto"}, fits{"tight"}, filters{"all"};
  std::vector<std::string> shapes{"linear"};  ///< beside the warps: each other than linear as WARP:SHAPE
  std::vector<std::string> cascades{"1", "4"}, map_sizes{"1024"};
  int frames = 4, rounds = 5;
  std::vector<std::string> pages, page_sizes{"128"};  ///< policies beside the maps; none: maps alone
  std::vector<std::string> layers{"front"};           ///< depth layers
  double page_target = 0.0;  ///< error m that pages are opened for; 0: the least that the pool holds
  std::string size = "480x270", shard = "1/1", context = "auto", out = "out/compare", map_passes = "auto";
  std::string light = "sun";
  std::string animation;        ///< that scenes play, by name or number; empty: at rest
  LightPlacement sun;           ///< its kind is that of `light`
  double near_hint = 0.0;       ///< of split pseudo_near: view depth from which error counts
  double map_memory_mib = 0.0;  ///< that a technique's maps may take; 0: what there is
  std::uint64_t max_triangles = LoadLimits{}.triangles;
  bool resume = false, json = false;
  bool visible_depths = false, visible_points = false;  ///< plan with what a frame shows
};

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
  bool visible_depths = false, visible_points = false;          ///< of the frame, given to the plan
  bool coarse_depths = false;  ///< of a coarse pass on the CPU, given to the plan
  PageOptions pages;           ///< where by_pages()

  /// Drawn by lists of pixels.
  [[nodiscard]] bool irregular() const noexcept { return irregular_samples > 0; }
  /// Planned by plan_pages in place of make_plan.
  [[nodiscard]] bool by_pages() const noexcept { return !technique.pages.empty(); }
};

struct Sweep {
  std::vector<std::string> scenes;
  std::vector<SweepEntry> entries;
  std::vector<std::string> left_out;  ///< combinations that cannot be measured, a line for each reason
  SweepEntry baseline;                ///< hard x no warp x one map, of the first map size
  int frames = 1, rounds = 1, width = 0, height = 0;
  std::size_t shard = 0, shards = 1;
  render::ContextKind context = render::ContextKind::automatic;
  LightPlacement light;
  std::string animation;
  std::string out;
  double map_memory_mib = 0.0;
  std::uint64_t max_triangles = 0;
  bool resume = false;

  /// Place of a row in the whole sweep.
  [[nodiscard]] std::uint64_t index(std::size_t scene, int frame, std::size_t entry) const noexcept {
    const auto row = static_cast<std::uint64_t>(scene) * static_cast<std::uint64_t>(frames) +
                     static_cast<std::uint64_t>(frame);
    return row * entries.size() + entry;
  }
  [[nodiscard]] bool is_mine(std::uint64_t row) const noexcept { return row % shards == shard; }
};

/// Throws std::runtime_error with what is wrong and where. Combinations that are the same technique under two
/// names are taken once: with one map or under a local light the split does not matter, and a stable fit
/// takes no warp.
[[nodiscard]] Sweep make_sweep(const CompareRequest& request);

/// Makes maps smaller that memory does not take, in the context that is current: a technique goes by the size
/// it is measured with. Returns a line for each. Throws std::runtime_error where not even the least fit.
std::vector<std::string> fit_to_memory(Sweep& sweep);

/// The most maps that the plans of an entry may have under this light.
[[nodiscard]] int most_maps(const SweepEntry& entry, LightKind light) noexcept;

/// As many pages as the texels of the entry's maps hold under this light, borders included.
[[nodiscard]] int page_capacity(const SweepEntry& entry, LightKind light) noexcept;

/// What a technique's names stand for, but the capacity of its pages. Throws std::runtime_error where one of
/// them means nothing.
[[nodiscard]] SweepEntry sweep_entry(const report::Technique& technique);

/// What the lists take, for the end of the help.
[[nodiscard]] std::string compare_footer();

/// Schemes and partitions that --splits takes. Behind each may follow `:finest` (MapSelection),
/// `:visible_depths` and `:visible_points` (what the frame shows is given to the plan), or `:coarse_depths`
/// (what a coarse pass on the CPU finds); behind frustum_faces `:slices=K` (SplitOptions::face_slices).
[[nodiscard]] std::vector<std::string> split_names();

/// Elements of lists with commas; an element of the form `key=value` without a colon belongs to the one
/// before it, as in `esm:c=40,radius=3,pcf`.
[[nodiscard]] std::vector<std::string> split_lists(const std::vector<std::string>& lists);

}  // namespace gnomon::tool
