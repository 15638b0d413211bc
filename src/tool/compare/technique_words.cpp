// What do the words for a technique stand for: filters, layers, warps, shapes, splits, fits and page
// policies?
#include "technique_words.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <type_traits>

#include "filter_words.hpp"
#include "identifier_word.hpp"
#include "page_setting.hpp"
#include "picture_words.hpp"
#include "plan_option.hpp"

namespace gnomon::tool {
namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& word, const std::string& why) {
  throw std::runtime_error(option + " " + word + ": " + why);
}

/// False where `text` is no number from `low` to `high`; of an int, no whole one.
template <class Number>
bool read_number(std::string_view text, Number low, Number high, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size() && number >= low && number <= high;
}

std::vector<int> read_numbers(const std::string& option, const Words& words, int low, int high) {
  std::vector<int> numbers;
  for (const std::string& text : split_lists(words)) {
    int number = 0;
    if (!read_number(text, low, high, number))
      refuse(option, text, "wants whole numbers from " + std::to_string(low) + " to " + std::to_string(high));
    numbers.push_back(number);
  }
  return numbers;
}

/// What each word stands for; `all` for every one of `names`, where there are any.
template <class Value>
std::vector<Value> read_list(const std::string& option, const Words& words,
                             Value (*read)(const std::string&, const std::string&), const Words& names = {}) {
  std::vector<Value> values;
  for (const std::string& word : split_lists(words)) {
    const bool all = word == "all" && !names.empty();
    for (const std::string& name : all ? names : Words{word}) values.push_back(read(option, name));
  }
  return values;
}

/// The samples of a pixel in `irregular` and `irregular:samples=N`; 0 for other words.
int irregular_samples(const std::string& option, const std::string& word) {
  constexpr std::string_view kSamples = ":samples=";
  if (!word.starts_with(kIrregular)) return 0;
  const std::string_view rest = std::string_view(word).substr(kIrregular.size());
  if (rest.empty()) return 1;
  int samples = 0;
  if (!rest.starts_with(kSamples) ||
      !read_number(rest.substr(kSamples.size()), 1, render::kMaxFacetSamples, samples))
    refuse(option, word,
           "wants irregular or irregular:samples=N, N from 1 to " + std::to_string(render::kMaxFacetSamples));
  return samples;
}

/// Takes `suffix` off the name; false where it is not there.
bool take_suffix(std::string& name, std::string_view suffix) {
  const std::size_t at = name.find(suffix);
  if (at == std::string::npos) return false;
  name.erase(at, suffix.size());
  return true;
}

/// Takes `:KEY=NUMBER` off a split's name, where it has one.
template <class Number>
std::optional<Number> take_number(const std::string& option, const std::string& word, std::string& name,
                                  const std::string& key, Number low, Number high) {
  const std::string text = ":" + key + "=";
  const std::size_t at = name.find(text);
  if (at == std::string::npos) return std::nullopt;
  const std::size_t begin = at + text.size(), end = std::min(name.find(':', begin), name.size());
  Number number = 0;
  if (!read_number(std::string_view(name).substr(begin, end - begin), low, high, number))
    refuse(option, word,
           fmt::format("{} must be a {}number from {} to {}", key, std::is_integral_v<Number> ? "whole " : "",
                       low, high));
  name.erase(at, end - at);
  return number;
}

}  // namespace

std::string TechniqueLayer::name() const {
  if (layer == render::DepthLayer::front && !linear) return {};
  return std::string(render::info_of(layer).name) + (linear ? ":linear" : "");
}

TechniqueFilter technique_filter(const std::string& option, const std::string& word) {
  TechniqueFilter filter{.name = word};
  filter.irregular_samples = irregular_samples(option, word);
  filter.identifiers = identifier_test(word, option);
  if (filter.irregular_samples > 0 || filter.identifiers) return filter;
  filter.settings = filter_word(option, word);
  filter.name = render::to_string(filter.settings);
  return filter;
}

TechniqueLayer technique_layer(const std::string& option, const std::string& word) {
  constexpr std::string_view kLinear = ":linear";
  const bool linear = word.ends_with(kLinear);
  const std::string name = word.substr(0, word.size() - (linear ? kLinear.size() : 0));
  const render::DepthLayerInfo* const info = render::find_depth_layer(name);
  if (info == nullptr) refuse_name(option, name, layer_names());
  return {info->layer, linear};
}

TechniqueWarp technique_warp(const std::string& option, const std::string& word) {
  const std::size_t colon = word.find(':');
  const std::string name = word.substr(0, colon);
  TechniqueWarp warp{word, find_warp(name), nullptr};
  if (warp.warp == nullptr && name != "auto")
    refuse_name(option, word, names_in(all_warps(), {"all", "auto"}));
  if (colon == std::string::npos) return warp;
  const std::string behind = word.substr(colon + 1);
  Objective objective;
  if (objective_from_name(behind, objective)) {
    warp.objective = objective;
    return warp;
  }
  warp.shape = find_shape(behind);
  if (warp.shape != nullptr) return warp;
  Words known = names_in(all_shapes(), plan_choice_names("objective"));
  for (std::string& word_behind : known) word_behind.insert(0, name + ":");
  refuse_name(option, word, known);
}

TechniqueSplit technique_split(const std::string& option, const std::string& word) {
  TechniqueSplit split{.name = word};
  std::string name = word;
  split.shares_texels = take_suffix(name, ":budget");
  if (take_suffix(name, ":finest")) split.options.selection = MapSelection::finest;
  split.visible_depths = take_suffix(name, ":visible_depths");
  split.coarse_depths = take_suffix(name, ":coarse_depths");
  if (split.visible_depths && split.coarse_depths)
    refuse(option, word, "a plan takes visible depths from one source");
  if (take_suffix(name, ":visible_points"))
    split.points = PlanPoints::visible;
  else if (take_suffix(name, ":shadow_edges"))
    split.points = PlanPoints::shadow_edges;
  const std::optional<int> slices = take_number(option, word, name, "slices", 1, kMaxMaps);
  const std::optional<double> lambda = take_number(option, word, name, "lambda", 0.0, 1.0);
  const bool is_partition = partition_from_name(name, split.options.partition);
  if (slices && (!is_partition || split.options.partition != Partition::frustum_faces))
    refuse(option, word, "only frustum_faces has slices");
  split.options.face_slices = slices.value_or(1);
  if (!split_scheme_from_name(name, split.options.scheme) && (!is_partition || name == "view_depth"))
    refuse_name(option, word, split_names());
  if (lambda && split.options.scheme != SplitScheme::practical)
    refuse(option, word, "only practical has lambda");
  split.options.lambda = lambda.value_or(split.options.lambda);
  return split;
}

Fit technique_fit(const std::string& option, const std::string& word) {
  if (word != "tight" && word != "stable") refuse_name(option, word, Words{"tight", "stable"});
  return word == "stable" ? Fit::stable : Fit::tight;
}

const Shape* technique_shape(const std::string& option, const std::string& word) {
  const Shape* const shape = find_shape(word);
  if (shape == nullptr) refuse_name(option, word, names_in(all_shapes(), {"all"}));
  return shape;
}

const PagePolicy* technique_pages(const std::string& option, const std::string& word) {
  const PagePolicy* const policy = find_page_policy(word);
  if (policy == nullptr) refuse_name(option, word, names_in(all_page_policies(), {"all"}));
  return policy;
}

std::vector<TechniqueFilter> read_filters(const std::string& option, const Words& words) {
  return read_list(option, words, technique_filter, names_in(render::all_filters()));
}

std::vector<TechniqueLayer> read_layers(const std::string& option, const Words& words) {
  return read_list(option, words, technique_layer, layer_names());
}

std::vector<TechniqueWarp> read_warps(const std::string& option, const Words& words) {
  return read_list(option, words, technique_warp, names_in(all_warps()));
}

std::vector<TechniqueSplit> read_splits(const std::string& option, const Words& words) {
  return read_list(option, words, technique_split);
}

std::vector<Fit> read_fits(const std::string& option, const Words& words) {
  return read_list(option, words, technique_fit);
}

std::vector<const Shape*> read_shapes(const std::string& option, const Words& words) {
  return read_list(option, words, technique_shape, names_in(all_shapes()));
}

std::vector<const PagePolicy*> read_page_policies(const std::string& option, const Words& words) {
  return read_list(option, words, technique_pages, names_in(all_page_policies()));
}

std::vector<int> read_cascades(const std::string& option, const Words& words) {
  return read_numbers(option, words, 1, kMaxMaps);
}

std::vector<int> read_map_sizes(const std::string& option, const Words& words) {
  return read_numbers(option, words, kLeastMapSize, kMaxMapSize);
}

std::vector<int> read_page_sizes(const std::string& option, const Words& words) {
  const std::vector<int> sizes = read_numbers(option, words, kLeastPageTexels, kMaxPageTexels);
  for (const int size : sizes) {
    if (!is_page_size(size)) refuse(option, std::to_string(size), "wants 64, 128 or 256");
  }
  return sizes;
}

std::vector<std::string> split_names() {
  return {"auto",    "uniform",       "logarithmic",      "practical",         "pseudo_near",
          "optimal", "frustum_faces", "separating_plane", "receiver_clusters", "tetrahedron"};
}

std::vector<std::string> split_lists(const Words& lists) {
  std::vector<std::string> elements;
  for (const std::string& list : lists) {
    bool first_of_list = true;
    for (std::size_t begin = 0; begin <= list.size();) {
      const std::size_t end = std::min(list.find(',', begin), list.size());
      const std::string element = list.substr(begin, end - begin);
      const bool continues =
          !first_of_list && element.find('=') != std::string::npos && element.find(':') == std::string::npos;
      if (continues) {
        elements.back() += "," + element;
      } else {
        elements.push_back(element);
      }
      first_of_list = false;
      begin = end + 1;
    }
  }
  return elements;
}

std::vector<Option> measured_maps_options(MeasuredMaps& maps) {
  const std::vector<std::string> warps = names_in(all_warps(), {"auto"});
  const auto set_warp = [&maps, warps](const std::string& word) {
    if (std::find(warps.begin(), warps.end(), word.substr(0, word.find(':'))) == warps.end()) return false;
    maps.warp = technique_warp("--warp", word);
    return true;
  };
  return {{.name = "--warp",
           .target = ParsedWord{set_warp, maps.warp.name},
           .help = "warp of the maps, or none",
           .names = warps},
          {.name = "--cascades",
           .target = &maps.cascades,
           .help = "number of shadow maps along the view",
           .range = {{1, kMaxMaps}}},
          {.name = "--map-size",
           .target = &maps.map_size,
           .help = "texels along each side of a map",
           .range = {{64, 16384}}}};
}

}  // namespace gnomon::tool
