// The stops of the tour that writes the pictures of docs/viewer.md.
#include <glm/geometric.hpp>

#include "app.hpp"

namespace gnomon::tool::view {
namespace {

void to_front(Display& display, Tab tab) {
  display.tab = tab;
  display.select_tab = true;
}

/// Pixels of the window where the picture's middle lies.
glm::dvec2 in_picture(const Area& area, double x, double y) {
  return {area.x + x * area.width, area.y + y * area.height};
}

/// Away from the frozen camera, up and to the side, looking at what it sees.
void fly_off(State& state, const Box& scene) {
  const CameraKey from = *state.frozen;
  const glm::dvec3 ahead = glm::normalize(from.target - from.position);
  const glm::dvec3 aside = glm::normalize(glm::dvec3(ahead.z, 0.0, -ahead.x));
  const double step = 0.3 * glm::length(scene.max - scene.min);
  state.eye =
      CameraKey{from.position - 0.8 * step * ahead + 1.2 * step * aside + glm::dvec3(0.0, 0.9 * step, 0.0),
                from.position + 0.7 * step * ahead};
}

constexpr std::array<TourStop, 18> kStops{{
    {"lit", [](App& app) { to_front(app.display, Tab::view); }},
    {"help", [](App& app) { app.display.help = true; }},
    {"heat",
     [](App& app) {
       app.display.help = false;
       app.document.state.view = View::heat;
       to_front(app.display, Tab::light);
       app.display.pointer = in_picture(app.drawing.area, 0.5, 0.7);
     }},
    {"mask",
     [](App& app) {
       app.display.pointer = glm::dvec2(-1.0);
       app.document.state.view = View::mask;
       to_front(app.display, Tab::filter);
     }},
    {"misclassified",
     [](App& app) {
       app.document.state.view = View::misclassified;
       to_front(app.display, Tab::compare);
     }},
    {"cascades",
     [](App& app) {
       app.document.state.view = View::cascades;
       to_front(app.display, Tab::maps);
     }},
    {"checker", [](App& app) { app.document.state.view = View::checker; }},
    {"map",
     [](App& app) {
       app.document.state.view = View::map;
       to_front(app.display, Tab::view);
     }},
    {"truth", [](App& app) { app.document.state.view = View::truth; }},
    {"pages",
     [](App& app) {
       app.document.state.a.pages.policy = &page_policies::resolution;
       app.document.state.a.pages.page_texels = 64;
       app.document.state.a.plan.fit = Fit::stable;
       app.document.state.view = View::cascades;
       to_front(app.display, Tab::maps);
       app.display.pointer = in_picture(app.drawing.area, 0.5, 0.7);
     }},
    {"kept",
     [](App& app) {
       // A step: what it uncovers is drawn.
       app.display.pointer = glm::dvec2(-1.0);
       app.document.state.path_time += 0.004;
       app.document.state.view = View::kept;
       to_front(app.display, Tab::compare);
     }},
    {"wipe",
     [](App& app) {
       app.document.state.path_time = State().path_time;
       presets()[1].set(app.document.state);
       to_front(app.display, Tab::compare);
     }},
    {"difference",
     [](App& app) {
       app.document.state.view = View::lit;
       app.document.state.comparison = Comparison::difference;
     }},
    {"freeze",
     [](App& app) {
       app.document.state.a = app.document.state.b = {};
       app.document.state.drawn.casters = false;
       app.document.state.comparison = Comparison::off;
       app.document.state.view = View::cascades;
       to_front(app.display, Tab::view);
       toggle_freeze(app.document.state, app.drawing.stage.get());
       fly_off(app.document.state, app.drawing.stage->loaded().scene.bounds_world);
     }},
    {"curves",
     [](App& app) {
       app.document.state.frozen.reset();
       app.document.state.eye.reset();
       app.document.state.view = View::lit;
       to_front(app.display, Tab::curves);
     },
     40},
    {.name = "results", .set = [](App& app) { to_front(app.display, Tab::curves); }, .needs_results = true},
    {"local_light",
     [](App& app) {
       app.document.state.light.sun.kind = LightKind::spot;
       to_front(app.display, Tab::light);
     }},
    {"file", [](App& app) { to_front(app.display, Tab::file); }},
}};

}  // namespace

std::span<const TourStop> tour_stops() noexcept {
  return kStops;
}

}  // namespace gnomon::tool::view
