// What do the words for a technique stand for: filters, layers, warps, shapes, splits, fits and page
// policies?
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "command.hpp"
#include "gnomon/pages.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/render/renderer.hpp"

namespace gnomon::tool {

/// Word that stands for render::Source::irregular. Behind it may follow `:samples=N`.
inline constexpr std::string_view kIrregular = "irregular";

/// What reads the maps: a filter, identifiers, or lists of pixels.
struct TechniqueFilter {
  std::string name = "hard";  ///< as in rows
  /// Hard with identifiers and with lists of pixels.
  render::FilterSettings settings = render::default_settings(render::filters::hard);
  std::optional<render::IdentifierTest> identifiers = {};  ///< shadows by them in place of a filter
  int irregular_samples = 0;                               ///< of a pixel, by lists; 0: by a filter
};

/// What the maps store.
struct TechniqueLayer {
  render::DepthLayer layer = render::DepthLayer::front;
  bool linear = false;  ///< the same depths, even along the light
  /// As in rows: empty for front.
  [[nodiscard]] std::string name() const;
};

/// How texels lie on a map.
struct TechniqueWarp {
  std::string name = "none";                ///< as in rows
  const Warp* warp = &warps::none;          ///< nullptr: the plan chooses
  const Shape* shape = nullptr;             ///< that the word names; nullptr: none
  std::optional<Objective> objective = {};  ///< that the word names
};

/// Which points of visible surfaces a plan is given.
enum class PlanPoints : std::uint8_t {
  none,
  visible,       ///< all that the frame shows
  shadow_edges,  ///< along the shadow of the frame before
};

/// How receivers are divided among maps, and what of the frame the plan is given.
struct TechniqueSplit {
  std::string name = "auto";  ///< as in rows
  SplitOptions options = {};
  bool visible_depths = false;  ///< of the frame
  bool coarse_depths = false;   ///< of a coarse pass on the CPU
  bool shares_texels = false;   ///< the texels of all maps are a budget
  PlanPoints points = PlanPoints::none;
};

/// A word read, which `option` took. Each throws std::runtime_error, with `option` in front, for a word that
/// stands for nothing.
[[nodiscard]] TechniqueFilter technique_filter(const std::string& option, const std::string& word);
[[nodiscard]] TechniqueLayer technique_layer(const std::string& option, const std::string& word);
[[nodiscard]] TechniqueWarp technique_warp(const std::string& option, const std::string& word);
[[nodiscard]] TechniqueSplit technique_split(const std::string& option, const std::string& word);
[[nodiscard]] Fit technique_fit(const std::string& option, const std::string& word);
[[nodiscard]] const Shape* technique_shape(const std::string& option, const std::string& word);
[[nodiscard]] const PagePolicy* technique_pages(const std::string& option, const std::string& word);

/// Lists of such words; `all` stands for every entry of a registry.
using Words = std::vector<std::string>;
[[nodiscard]] std::vector<TechniqueFilter> read_filters(const std::string& option, const Words& words);
[[nodiscard]] std::vector<TechniqueLayer> read_layers(const std::string& option, const Words& words);
[[nodiscard]] std::vector<TechniqueWarp> read_warps(const std::string& option, const Words& words);
[[nodiscard]] std::vector<TechniqueSplit> read_splits(const std::string& option, const Words& words);
[[nodiscard]] std::vector<Fit> read_fits(const std::string& option, const Words& words);
[[nodiscard]] std::vector<const Shape*> read_shapes(const std::string& option, const Words& words);
[[nodiscard]] std::vector<const PagePolicy*> read_page_policies(const std::string& option,
                                                                const Words& words);
/// Whole numbers within what a plan takes.
[[nodiscard]] std::vector<int> read_cascades(const std::string& option, const Words& words);
[[nodiscard]] std::vector<int> read_map_sizes(const std::string& option, const Words& words);
/// 64, 128 or 256.
[[nodiscard]] std::vector<int> read_page_sizes(const std::string& option, const Words& words);

/// A list that one of these functions reads. Its default is what `words` stand for.
template <class Value>
[[nodiscard]] ParsedWords word_list(std::vector<Value>& values,
                                    std::vector<Value> (*read)(const std::string&, const Words&),
                                    const Words& words) {
  if (!words.empty()) values = read({}, words);
  std::string shown;
  for (const std::string& word : words) shown += (shown.empty() ? "" : " ") + word;
  return {[&values, read](const std::string& option, const Words& given) { values = read(option, given); },
          shown};
}

/// Schemes and partitions that a split may name. Behind each may follow `:finest` (MapSelection),
/// `:visible_depths` and `:visible_points` (what the frame shows is given to the plan), or `:coarse_depths`
/// (what a coarse pass on the CPU finds), `:shadow_edges` (points of the last frame's) and `:budget` (the
/// maps share the texels of equal ones, ResolutionOptions::texel_budget); behind frustum_faces `:slices=K`
/// (SplitOptions::face_slices), behind practical `:lambda=L` (SplitOptions::lambda).
[[nodiscard]] std::vector<std::string> split_names();

/// Elements of lists with commas; an element of the form `key=value` without a colon belongs to the one
/// before it, as in `esm:c=40,radius=3,pcf`.
[[nodiscard]] std::vector<std::string> split_lists(const Words& lists);

/// The one kind of maps that a command measures with.
struct MeasuredMaps {
  TechniqueWarp warp = {};
  int cascades = 1;     ///< shadow maps along the view
  int map_size = 1024;  ///< texels along each side of a map
};
/// --warp, --cascades and --map-size.
[[nodiscard]] std::vector<Option> measured_maps_options(MeasuredMaps& maps);

}  // namespace gnomon::tool
