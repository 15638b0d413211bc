// The stops of the tour that writes the pictures of docs/viewer.md.
#include <glm/geometric.hpp>

#include "app.hpp"

namespace gnomon::tool::view {
namespace {

void to_front(App& app, Tab tab) {
  app.tab = tab;
  app.select_tab = true;
}

void show(App& app, View view) {
  app.state.view = view;
}

/// Pixels of the window where the picture's middle lies.
glm::dvec2 in_picture(const App& app, double x, double y) {
  return {app.picture.x + x * app.picture.width, app.picture.y + y * app.picture.height};
}

/// Away from the frozen camera, up and to the side, looking at what it sees.
void fly_off(App& app) {
  const CameraKey from = *app.state.frozen;
  const Box& scene = app.stage->loaded().scene.bounds_world;
  const glm::dvec3 ahead = glm::normalize(from.target - from.position);
  const glm::dvec3 aside = glm::normalize(glm::dvec3(ahead.z, 0.0, -ahead.x));
  const double step = 0.3 * glm::length(scene.max - scene.min);
  app.state.eye =
      CameraKey{from.position - 0.8 * step * ahead + 1.2 * step * aside + glm::dvec3(0.0, 0.9 * step, 0.0),
                from.position + 0.7 * step * ahead};
}

constexpr std::array<TourStop, 18> kStops{{
    {"lit", [](App& app) { to_front(app, Tab::view); }},
    {"help", [](App& app) { app.help = true; }},
    {"heat",
     [](App& app) {
       app.help = false;
       show(app, View::heat);
       to_front(app, Tab::light);
       app.pointer = in_picture(app, 0.5, 0.7);
     }},
    {"mask",
     [](App& app) {
       app.pointer = glm::dvec2(-1.0);
       show(app, View::mask);
       to_front(app, Tab::filter);
     }},
    {"misclassified",
     [](App& app) {
       show(app, View::misclassified);
       to_front(app, Tab::compare);
     }},
    {"cascades",
     [](App& app) {
       show(app, View::cascades);
       to_front(app, Tab::maps);
     }},
    {"checker", [](App& app) { show(app, View::checker); }},
    {"map",
     [](App& app) {
       show(app, View::map);
       to_front(app, Tab::view);
     }},
    {"truth", [](App& app) { show(app, View::truth); }},
    {"pages",
     [](App& app) {
       app.state.a.pages.policy = &page_policies::resolution;
       app.state.a.pages.page_texels = 64;
       app.state.a.plan.fit = Fit::stable;
       show(app, View::cascades);
       to_front(app, Tab::maps);
       app.pointer = in_picture(app, 0.5, 0.7);
     }},
    {"kept",
     [](App& app) {
       // A step: what it uncovers is drawn.
       app.pointer = glm::dvec2(-1.0);
       app.state.path_time += 0.004;
       show(app, View::kept);
       to_front(app, Tab::compare);
     }},
    {"wipe",
     [](App& app) {
       app.state.path_time = State().path_time;
       presets()[1].set(app.state);
       to_front(app, Tab::compare);
     }},
    {"difference",
     [](App& app) {
       show(app, View::lit);
       app.state.comparison = Comparison::difference;
     }},
    {"freeze",
     [](App& app) {
       app.state.a = app.state.b = {};
       app.state.drawn.casters = false;
       app.state.comparison = Comparison::off;
       show(app, View::cascades);
       to_front(app, Tab::view);
       toggle_freeze(app);
       fly_off(app);
     }},
    {"curves",
     [](App& app) {
       app.state.frozen.reset();
       app.state.eye.reset();
       show(app, View::lit);
       to_front(app, Tab::curves);
     },
     40},
    {.name = "results", .set = [](App& app) { to_front(app, Tab::curves); }, .needs_results = true},
    {"local_light",
     [](App& app) {
       app.state.light.sun.kind = LightKind::spot;
       to_front(app, Tab::light);
     }},
    {"file", [](App& app) { to_front(app, Tab::file); }},
}};

}  // namespace

std::span<const TourStop> tour_stops() noexcept {
  return kStops;
}

}  // namespace gnomon::tool::view
