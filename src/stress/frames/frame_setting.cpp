// How is a random frame drawn? The words of its JSON as the renderer's own types.
#include "frame_setting.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace gnomon::stress {
namespace {

using Json = nlohmann::ordered_json;

template <std::size_t N>
std::size_t word(const Json& setting, const char* key, const std::array<std::string_view, N>& words) {
  const std::string name = setting.value(key, std::string(words[0]));
  const auto found = std::find(words.begin(), words.end(), name);
  if (found == words.end())
    throw CaseError(std::string("frame.") + key + ": '" + one_line(name) + "' is none of its words");
  return static_cast<std::size_t>(found - words.begin());
}

int whole(const Json& setting, const char* key, int fallback, int least, int most) {
  const auto found = setting.find(key);
  if (found == setting.end()) return fallback;
  const double value = found->is_number() ? found->get<double>() : least - 1.0;
  if (!(value >= least && value <= most))
    throw CaseError(std::string("frame.") + key + ": needs a number in " + std::to_string(least) + ".." +
                    std::to_string(most));
  return static_cast<int>(value);
}

render::Source source_of(const Json& setting) {
  static constexpr std::array<std::string_view, 5> kSources{"maps", "pages", "lights", "irregular",
                                                            "identifiers"};
  static constexpr std::array<std::string_view, 2> kOf{"instance", "triangle"};
  switch (word(setting, "source", kSources)) {
    case 1:
      return render::Source::pages;
    case 2:
      return render::Source::lights;
    case 3:
      return render::Source::irregular(whole(setting, "samples", 1, 1, render::kMaxFacetSamples));
    case 4:
      return render::Source::identifiers(
          {static_cast<render::IdentifierOf>(word(setting, "identifiers_of", kOf)),
           whole(setting, "neighbours", 0, 0, render::kMaxIdentifierNeighbours)});
    default:
      return render::Source::maps;
  }
}

render::DepthLayer layer_of(const Json& setting) {
  const std::string name = setting.value("layer", "front");
  for (const render::DepthLayerInfo& info : render::depth_layers()) {
    if (info.name == name) return info.layer;
  }
  throw CaseError("frame.layer: '" + one_line(name) + "' is no depth layer");
}

render::FrameOptions options_of(const Json& setting) {
  static constexpr std::array<std::string_view, 3> kTransitions{"cut", "blend", "dither"};
  static constexpr std::array<std::string_view, 3> kNoise{"still", "gradient", "blue"};
  static constexpr std::array<std::string_view, 3> kPasses{"automatic", "each", "layered"};
  static constexpr std::array<render::MapPasses, 3> kPassesOf{
      render::MapPasses::automatic, render::MapPasses::each, render::MapPasses::layered};
  render::FrameOptions options;
  options.aliasing = options.heat_map = options.cascade_tint = options.time_passes = false;
  options.transition = static_cast<render::SplitTransition>(word(setting, "transition", kTransitions));
  options.noise = static_cast<render::SampleNoise>(word(setting, "noise", kNoise));
  options.map_passes = kPassesOf[word(setting, "map_passes", kPasses)];
  options.depth_layer = layer_of(setting);
  options.linear_depth = setting.value("linear_depth", false);
  const Json rules{{"prune", setting.value("prune", "exact")}};
  options.prune = read_plan_options(rules.dump()).prune;
  return options;
}

/// The case's own keys; a case needs boxes, which are then the scene's.
Case case_of(const Json& frame) {
  Json value = Json::object();
  for (const char* key : {"camera", "light", "options"}) {
    if (frame.contains(key)) value[key] = frame[key];
  }
  const Json point{{"min", {0, 0, 0}}, {"max", {0, 0, 0}}};
  value["receivers"] = Json::array({point});
  value["casters"] = Json::array({point});
  return read_case(value.dump());
}

}  // namespace

FrameSetting read_frame(const Json& frame) {
  FrameSetting out;
  try {
    out.input = case_of(frame);
    const Json setting = frame.value("frame", Json::object());
    out.source = source_of(setting);
    const render::ParsedFilter parsed = render::parse_filter(setting.value("filter", "hard"));
    if (!parsed.error.empty()) throw CaseError("frame.filter: " + parsed.error);
    out.filter = parsed.settings;
    out.options = options_of(setting);
    out.panes = setting.value("panes", false);
    out.visible_points = setting.value("visible_points", false);
    out.accumulated = whole(setting, "accumulate", 0, 0, 64);
    out.steps = whole(setting, "steps", 1, 1, 64);
    out.move_seed = static_cast<std::uint64_t>(whole(setting, "move_seed", 1, 0, 1 << 30));
    out.scale = setting.value("scale", 1.0);
    const std::vector<double> step = setting.value("camera_step", std::vector<double>{0, 0, 0});
    if (step.size() != 3) throw CaseError("frame.camera_step: needs 3 numbers");
    out.camera_step = {step[0], step[1], step[2]};
    const std::string policy = setting.value("policy", "resolution");
    out.pages.policy = find_page_policy(policy);
    if (out.pages.policy == nullptr) throw CaseError("frame.policy: '" + one_line(policy) + "' is none");
    out.pages.page_texels = whole(setting, "page_texels", 64, 64, 256);
    out.pages.target_m = setting.value("target_m", 2.0);
  } catch (const Json::exception& error) {
    throw CaseError("frame: " + one_line(error.what()));
  }
  render::set_margin(out.filter, out.input.options);
  out.pages.plan = out.input.options;
  out.pages.capacity = 1024;
  return out;
}

}  // namespace gnomon::stress
