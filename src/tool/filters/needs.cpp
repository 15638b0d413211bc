// `gnomon filters --fit`: what each filter could do without on a scene's maps.
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

#include "filters.hpp"
#include "gnomon/render/filter_fit.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/default_light.hpp"
#include "gnomon/scene/load.hpp"
#include "output.hpp"
#include "stage.hpp"

namespace gnomon::tool {
namespace {

constexpr int kMapSize = 1024;               // as a flight's default maps
constexpr std::array kViews{0.1, 0.5, 0.9};  // of the scene's default path

std::string row_of(const render::FilterSettings& full, const render::FilterFit& fit, bool json) {
  if (json) {
    return nlohmann::ordered_json{{"asked", to_string(full)},     {"needed", to_string(fit.settings)},
                                  {"channels", fit.channels},     {"channels_asked", fit.full_channels},
                                  {"bytes_per_texel", fit.bytes}, {"bytes_per_texel_asked", fit.full_bytes},
                                  {"error", fit.error},           {"exceeding", fit.exceeding},
                                  {"receivers", fit.receivers}}
        .dump();
  }
  char text[256];
  std::snprintf(text, sizeof text, "| %s | %s | %d -> %d | %.1f -> %.1f | %.0f %% | %.3f | %.1f %% |",
                to_string(full).c_str(), fit.saves() ? to_string(fit.settings).c_str() : "all of it",
                fit.full_channels, fit.channels, fit.full_bytes, fit.bytes,
                100.0 * (1.0 - fit.bytes / fit.full_bytes), 255.0 * fit.error, 100.0 * fit.exceeding);
  return text;
}

/// Draws views of a scene's flight and keeps their maps.
class Views {
 public:
  explicit Views(Scene scene) : scene_(std::move(scene)), renderer_(scene_) {
    for (const Instance& instance : scene_.instances) boxes_.push_back(instance.bounds_world);
  }
  std::vector<render::DrawnDepths> maps_for(const render::FilterSettings& filter);

 private:
  Scene scene_;
  std::vector<Box> boxes_;
  render::Renderer renderer_;
};

std::vector<render::DrawnDepths> Views::maps_for(const render::FilterSettings& filter) {
  const Light light = default_light({}, scene_.bounds_world);
  PlanOptions options;
  options.resolution.max_size = kMapSize;
  render::set_margin(filter, options);
  render::FrameOptions frame;
  frame.aliasing = frame.heat_map = frame.cascade_tint = frame.time_passes = false;
  const render::PreparedFilter depths_only = renderer_.prepare(render::filters::hard);
  const CameraPath path = default_path(scene_);
  std::vector<render::DrawnDepths> all;
  for (const double t : kViews) {
    const Camera camera = path.at(t, kStageWidth, kStageHeight);
    const ShadowPlan plan = make_plan(camera, light, {boxes_, boxes_}, options);
    renderer_.draw(plan, camera, depths_only, frame);
    for (render::DrawnDepths& map : renderer_.drawn_depths(filter, plan)) all.push_back(std::move(map));
  }
  return all;
}

}  // namespace

void print_filter_needs(const FiltersRequest& request) {
  Views views(load_scene(request.fit));
  if (!request.json) {
    print_line(
        "| filter | needs no more than | channels | bytes per texel | saves | differs at most, 8-bit steps | "
        "above the bound |");
    print_line("|---|---|---|---|---|---|---|");
  }
  render::FilterFitOptions options;
  options.bound = request.fit_bound / 255.0;
  options.exceptions = request.fit_exceptions / 100.0;
  for (const render::FilterSettings& full : request.filters) {
    // Those that store nothing have nothing to leave out.
    if (full.filter->info.formats.empty()) continue;
    print_line(row_of(full, render::fit_filter(full, views.maps_for(full), options), request.json));
    flush_output();
  }
}

}  // namespace gnomon::tool
