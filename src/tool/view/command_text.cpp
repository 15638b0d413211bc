// The command line that shows the same picture as a state of the viewer.
#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "edit_words.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "picture_words.hpp"
#include "plan_option.hpp"
#include "scene_words.hpp"
#include "state.hpp"

namespace gnomon::tool::view {
namespace {

using Json = nlohmann::ordered_json;

std::string quoted(const std::string& word) {
  const bool plain = !word.empty() && word.find_first_not_of(
                                          "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                          "_-+=:,./%@") == std::string::npos;
  if (plain) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

/// Shortest text that reads back to the same number.
std::string exact(double value) {
  return fmt::format("{}", value);
}

std::string point_word(const glm::dvec3& p) {
  return exact(p.x) + "," + exact(p.y) + "," + exact(p.z);
}

void add_pages(const PageSetting& pages, std::string& text) {
  if (!pages.on()) return;
  const PageSetting none;
  text += " --pages " + page_policy_name(pages);
  if (pages.page_texels != none.page_texels) text += fmt::format(" --page-size {}", pages.page_texels);
  if (pages.capacity != none.capacity) text += fmt::format(" --page-capacity {}", pages.capacity);
  if (pages.target_m != none.target_m) text += " --page-target " + exact(pages.target_m);
}

void add_settings(const Settings& settings, std::string& text) {
  const Json now = plan_options_json(settings.plan), none = plan_options_json({});
  for (const auto& [key, value] : now.items()) {
    if (!is_spoken(key) || value == none[key]) continue;
    if (key == "lambda" && never_blends(settings.plan.split.scheme)) continue;
    // Alone it would select the practical split.
    if (key == "lambda" && now["split"] == none["split"])
      text += " --split " + now["split"].get<std::string>();
    std::string name = key;
    std::replace(name.begin(), name.end(), '_', '-');
    text += " --" + name + " " +
            quoted(value.is_string()         ? value.get<std::string>()
                   : value.is_number_float() ? exact(value.get<double>())
                                             : value.dump());
  }
  if (const std::string rest = unspoken_options(settings.plan); !rest.empty())
    text += " --options " + quoted(rest);
  add_pages(settings.pages, text);
  text += " --filter " + quoted(filter_text(settings));
  if (settings.transition != render::SplitTransition::cut)
    text += " --transition " + std::string(transition_names()[static_cast<std::size_t>(settings.transition)]);
  if (settings.layer != render::DepthLayer::front)
    text += " --layer " + std::string(render::info_of(settings.layer).name);
  if (settings.linear_depth) text += " --linear-depth";
  if (settings.map_passes != render::MapPasses::automatic)
    text += " --map-passes " + map_passes_names()[static_cast<std::size_t>(settings.map_passes)];
  if (settings.history) text += " --history";
  if (settings.visible_depths) text += " --visible-depths";
}

}  // namespace

bool is_spoken(std::string_view key) {
  // A filter sets its own radii, and a command line has no list of splits without the word for it.
  if (key == "filter_radius_texels" || key == "filter_radius_world") return false;
  const PlanField& field = plan_field(key);
  if (field.unit != 1.0) return false;
  return std::holds_alternative<PlanChoice>(field.place) ||
         std::holds_alternative<PlanMember<int>>(field.place) ||
         std::holds_alternative<PlanMember<double>>(field.place) ||
         std::holds_alternative<PlanMember<bool>>(field.place);
}

std::string command_text(const State& state) {
  std::string text = "gnomon view " + quoted(state.scene);
  if (state.panes) text += " --panes";
  if (state.edits.up == UpAxis::z) text += " --up z";
  if (state.edits.open_sky) text += " --open-sky";
  if (state.edits.ground) text += " --ground";
  if (!state.edits.sections.empty()) text += " --section=" + section_text(state.edits.sections);
  if (!state.edits.proxies.empty()) text += " --proxies " + quoted(state.edits.proxies);
  add_settings(state.a, text);
  const LightState& light = state.light;
  const LightPlacement none;
  if (light.all) text += " --scene-light " + std::string(kAllLights);
  if (light.sun.kind != none.kind) text += " --light " + std::string(to_string(light.sun.kind));
  if (light.sun.elevation_deg != none.elevation_deg)
    text += " --light-elevation-deg " + exact(light.sun.elevation_deg);
  if (light.sun.azimuth_deg != none.azimuth_deg)
    text += " --light-azimuth-deg " + exact(light.sun.azimuth_deg);
  if (light.sun.kind == LightKind::spot && light.spot) {
    text += " --light-position=" + point_word(light.spot->position) +
            " --light-direction=" + point_word(light.spot->direction) + " --light-outer-deg " +
            exact(light.spot->outer_radians * kDegrees) + " --light-range " + exact(light.spot->range);
  }
  if (light.sun.kind == LightKind::point && light.point)
    text += " --light-position=" + point_word(light.point->position) + " --light-range " +
            exact(light.point->range);
  if (state.eye)
    text += " --eye=" + point_word(state.eye->position) + " --target=" + point_word(state.eye->target);
  if (state.eye && state.eye->up != CameraKey().up) text += " --eye-up=" + point_word(state.eye->up);
  if (state.height_world > 0.0) text += " --orthographic " + exact(state.height_world);
  if (state.near_depth > 0.0) text += " --near " + exact(state.near_depth);
  if (state.far_depth > 0.0) text += " --far " + exact(state.far_depth);
  if (const Playing& playing = state.playing; !playing.animation.empty()) {
    text += " --animation " + quoted(playing.animation);
    if (playing.time_s != 0.0) text += " --animation-time=" + exact(playing.time_s);
    if (playing.on) text += " --animate=" + exact(playing.speed);
  }
  if (state.view != View::lit)
    text += " --view " + std::string(view_names()[static_cast<std::size_t>(state.view)].name);
  return text;
}

}  // namespace gnomon::tool::view
