// `gnomon panes`: how far is light behind panes from what rays say, and what does it cost?
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "command.hpp"
#include "compare/sweep.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/render/probe.hpp"
#include "gnomon/report/statistics.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/trace/transmittance.hpp"
#include "interrupt.hpp"
#include "output.hpp"
#include "pages/frame_pages.hpp"
#include "pane_lights.hpp"
#include "scene_view.hpp"
#include "scene_words.hpp"

namespace gnomon::tool {
namespace {

using report::median;

/// What shadows are drawn by.
enum class Way : std::uint8_t { maps, irregular, pages, lights };
/// By Way.
const std::vector<std::string> kWays{"maps", "irregular", "pages", "lights"};

struct PanesRequest : Measuring {
  MeasuredMaps maps{technique_warp("--warp", "auto"), 4};
  Way by = Way::maps;
  int local_lights = 4;  ///< beside the sun, by lights
};

Sweep sweep_of(const PanesRequest& request) {
  SweepRequest product = one_kind_of_maps(request, request.maps);
  if (product.scenes.empty()) product.scenes = {"builtin:glass"};
  // The cost of light through panes is printed beside that of four moments of depths.
  product.filters = read_filters("--filters", {"hard", "msm"});
  return make_sweep(product);
}

/// Refuses maps that draw no panes.
void check_shape(const PanesRequest& request, const Sweep& sweep) {
  if (request.by == Way::irregular || sweep.entries[0].plan.warp.shape->affine) return;
  throw std::runtime_error("--warp " + request.maps.warp.name +
                           ": maps that bend lines draw no panes; --by irregular draws them");
}

/// Refuses maps that memory does not take with the images of panes beside them.
void check_memory(const PanesRequest& request, const Sweep& sweep) {
  // The larger of both filters is drawn with panes as well.
  const SweepEntry& msm = sweep.entries[1];
  const LightKind kind = request.by == Way::lights ? LightKind::point : sweep.light.kind;
  const int wanted = request.maps.map_size;
  const render::FittingMaps fitting = render::largest_maps(
      wanted, most_maps(msm, kind), render::kPaneTexelBytes + render::bytes_per_texel(msm.filter), 0.0);
  if (fitting.size >= wanted) return;
  throw std::runtime_error("--map-size " + std::to_string(wanted) +
                           ": such maps and the images of panes do not fit (" + fitting.why +
                           "); largest that do: " + std::to_string(fitting.size));
}

struct PanesRow {
  std::string scene, by;
  int frame = 0;
  double tinted = 0.0;                   ///< share of the facing pixels behind panes
  double mean = 0.0, tinted_mean = 0.0;  ///< error over all facing pixels, and over those
  double panes_ms = 0.0, hard_ms = 0.0, msm_ms = 0.0;
};

void print_row(const PanesRow& row, bool json) {
  // Many lights have nothing to be compared with.
  const bool compared = row.msm_ms > 0.0;
  const double ratio = compared ? (row.hard_ms + row.panes_ms) / row.msm_ms : 0.0;
  if (json) {
    print_line(nlohmann::ordered_json{
        {"scene", row.scene},
        {"frame", row.frame},
        {"by", row.by},
        {"tinted", row.tinted},
        {"mean_error", row.mean},
        {"mean_error_tinted", row.tinted_mean},
        {"panes_ms", row.panes_ms},
        {"hard_ms", row.hard_ms},
        {"msm_ms", row.msm_ms},
        {"hard_and_panes_over_msm", compared ? nlohmann::ordered_json(ratio) : nlohmann::ordered_json()}}
                   .dump());
  } else {
    const auto number = [&](const char* format, double value) {
      std::array<char, 32> text{};
      if (compared) std::snprintf(text.data(), text.size(), format, value);
      return compared ? std::string(text.data()) : std::string("-");
    };
    char text[256];
    std::snprintf(text, sizeof text, "| %s | %d | %.1f %% | %.3f %% | %.3f %% | %.1f | %.1f | %s | %s |",
                  row.scene.c_str(), row.frame, 100.0 * row.tinted, 100.0 * row.mean, 100.0 * row.tinted_mean,
                  row.panes_ms, row.hard_ms, number("%.1f", row.msm_ms).c_str(),
                  number("%.2f", ratio).c_str());
    print_line(text);
  }
  flush_output();
}

/// The image of what panes leave against rays, over the pixels that face the light.
void judge(const FloatImage& image, const trace::SurfacePoints& points, const trace::PaneReference& truth,
           PanesRow& row) {
  std::size_t facing = 0, tinted = 0;
  for (std::size_t i = 0; i < points.pixels.size(); ++i) {
    if (points.pixels[i].state != trace::PixelState::facing) continue;
    double error = 0.0;
    for (int c = 0; c < 3; ++c)
      error += std::abs(image.values[3 * i + static_cast<std::size_t>(c)] - truth.pixels[i][c]) / 3.0;
    ++facing;
    row.mean += error;
    if (truth.pixels[i] == glm::dvec3(1.0)) continue;
    ++tinted;
    row.tinted_mean += error;
  }
  row.tinted = facing > 0 ? static_cast<double>(tinted) / static_cast<double>(facing) : 0.0;
  row.mean /= static_cast<double>(std::max<std::size_t>(facing, 1));
  row.tinted_mean /= static_cast<double>(std::max<std::size_t>(tinted, 1));
}

/// A scene ready to be drawn in one of the ways of --by.
struct PanesStage {
  PanesStage(const PanesRequest& from, const Sweep& of_sweep, const std::string& scene)
      : request(from),
        sweep(of_sweep),
        view(scene, sweep.light, sweep.camera, limits_of_triangles(sweep.max_triangles), sweep.edits),
        parts(split_translucent(view.scene())),
        renderer(parts.opaque),
        tracer(parts.opaque),
        panes(parts.panes),
        msm(renderer.prepare(sweep.entries[1].filter)) {
    renderer.add_panes(parts.panes);
    const render::FilterSettings& hard = sweep.entries[0].filter;
    shadows = renderer.prepare(hard, request.by == Way::irregular ? render::Source::irregular()
                                     : request.by == Way::pages   ? render::Source::pages
                                     : request.by == Way::lights  ? render::Source::lights
                                                                  : render::Source::maps);
    options.aliasing = options.heat_map = options.cascade_tint = false;
    // Every round draws its maps.
    options.prune = options.prune.without(PruneRule::held_maps);
  }
  [[nodiscard]] ShadowPlan plan(const Camera& camera, std::size_t entry) const {
    return make_plan(camera, view.light(), view.bounds(), sweep.entries[entry].plan);
  }
  [[nodiscard]] std::unique_ptr<FramePages> pages(const Camera& camera) {
    PageOptions of_pages;
    of_pages.policy = &page_policies::resolution;
    of_pages.plan = sweep.entries[0].plan;
    return std::make_unique<FramePages>(
        PageFrameInput{view.light(), view.bounds(), of_pages},
        std::make_shared<const VisibleSurfaces>(draw_surfaces(renderer, camera, render::DepthLayer::front)));
  }

  const PanesRequest& request;
  const Sweep& sweep;
  SceneView view;
  TranslucentParts parts;
  render::Renderer renderer;
  trace::Tracer tracer;
  trace::PaneTracer panes;
  render::PreparedFilter msm, shadows;
  render::FrameOptions options;
};

/// Times of one way beside msm, by turns, and the image against rays.
void measure_frame(PanesStage& stage, const Camera& camera, PanesRow& row) {
  std::unique_ptr<FramePages> pages;
  if (stage.request.by == Way::pages) pages = stage.pages(camera);
  std::vector<double> shadows, msm, panes;
  for (int round = 0; round <= stage.request.rounds; ++round) {
    const render::FrameStats of_msm =
        stage.renderer.draw(stage.plan(camera, 1), camera, stage.msm, stage.options);
    const render::FrameStats stats =
        pages ? pages->draw(stage.renderer, camera, stage.shadows, stage.options)
              : stage.renderer.draw(stage.plan(camera, 0), camera, stage.shadows, stage.options);
    if (round == 0) continue;  // warms up
    shadows.push_back(stats.shadow_ms());
    panes.push_back(stats.ms(render::Pass::panes));
    msm.push_back(of_msm.shadow_ms());
  }
  row.panes_ms = median(panes);
  row.hard_ms = median(shadows);
  row.msm_ms = median(msm);
  const trace::SurfacePoints points = trace::surface_points(
      stage.tracer, camera, stage.view.light(), stage.renderer.positions(), stage.renderer.normals());
  if (!stage.parts.panes.instances.empty())
    judge(stage.renderer.transmittance(), points,
          trace::pane_reference(stage.panes, points, stage.view.light()), row);
}

/// The sum of many lights against what rays leave of each, as shares of the light that there is without
/// panes.
void judge_lights(const FloatImage& found, const FloatImage& without, const std::vector<glm::dvec3>& truth,
                  PanesRow& row) {
  constexpr float kDark = 1e-3f;  // of a surface in the sun
  std::size_t lit = 0, tinted = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    double error = 0.0, tint = 0.0;
    bool dark = false;
    for (int c = 0; c < 3; ++c) {
      const std::size_t k = 3 * i + static_cast<std::size_t>(c);
      dark = dark || without.values[k] < kDark;
      error += std::abs(found.values[k] - truth[i][c]) / without.values[k] / 3.0;
      tint = std::max(tint, 1.0 - truth[i][c] / without.values[k]);
    }
    if (dark) continue;
    ++lit;
    row.mean += error;
    constexpr double kTint = 1e-4;
    if (tint < kTint) continue;
    ++tinted;
    row.tinted_mean += error;
  }
  row.tinted = static_cast<double>(tinted) / static_cast<double>(std::max<std::size_t>(lit, 1));
  row.mean /= static_cast<double>(std::max<std::size_t>(lit, 1));
  row.tinted_mean /= static_cast<double>(std::max<std::size_t>(tinted, 1));
}

/// The same under many lights; `plain`: without panes. What panes cost is the difference to it.
void measure_lights(PanesStage& stage, render::Renderer& plain, const Camera& camera, PanesRow& row) {
  const render::PreparedFilter of_plain =
      plain.prepare(stage.sweep.entries[0].filter, render::Source::lights);
  PaneLights lights(stage.view.light(), stage.request.local_lights, stage.parts);
  lights.plan(camera, stage.view.bounds(), stage.sweep.entries[0].plan, stage.request.maps.map_size);
  std::vector<double> with, without;
  for (int round = 0; round <= stage.request.rounds; ++round) {
    const render::FrameStats a = lights.draw(plain, camera, of_plain, stage.options),
                             b = lights.draw(stage.renderer, camera, stage.shadows, stage.options);
    if (round == 0) continue;
    without.push_back(a.shadow_ms());
    with.push_back(b.shadow_ms());
  }
  row.hard_ms = median(without);
  row.panes_ms = median(with) - row.hard_ms;
  const FloatImage all = plain.light_sum();
  judge_lights(stage.renderer.light_sum(), all,
               lights.reference(plain, camera, of_plain, stage.tracer, stage.panes), row);
}

/// `head`: prints the table's head once there is a row.
void measure_scene(const PanesRequest& request, const Sweep& sweep, const std::string& scene,
                   const std::function<void()>& head) {
  PanesStage stage(request, sweep, scene);
  warn_of(stage.view.scene());
  std::optional<render::Renderer> plain;
  if (request.by == Way::lights) plain.emplace(stage.parts.opaque);
  for (int frame = 0; frame < sweep.frames; ++frame) {
    check_interrupt();
    const Camera camera = stage.view.camera(frame, sweep.frames, sweep.width, sweep.height);
    PanesRow row;
    row.scene = scene;
    row.by = kWays[static_cast<std::size_t>(request.by)];
    row.frame = frame;
    plain ? measure_lights(stage, *plain, camera, row) : measure_frame(stage, camera, row);
    head();
    print_row(row, request.json);
    if (!request.out.empty()) {
      const std::string name =
          scene_stem(scene) + "_" + (request.by == Way::maps ? "" : row.by + "_") + std::to_string(frame);
      write_png(stage.renderer.image(), std::filesystem::path(request.out) / (name + ".png"));
    }
    render::check_context();
  }
}

int run_panes(const PanesRequest& request) {
  const Sweep sweep = sweep_of(request);
  check_shape(request, sweep);
  watch_interrupts();
  if (!request.out.empty()) make_folder("--out", request.out);
  const auto context = render::create_context(sweep.context);
  check_memory(request, sweep);
  bool headed = request.json;
  const auto head = [&headed] {
    if (headed) return;
    headed = true;
    print_line(
        "| scene | frame | tinted | mean error | of tinted | panes ms | hard ms | msm ms | "
        "(hard + panes) / msm |");
    print_line("|--|--:|--:|--:|--:|--:|--:|--:|--:|");
  };
  for (const std::string& scene : sweep.scenes) measure_scene(request, sweep, scene, head);
  return 0;
}

std::vector<Option> own_options(PanesRequest& request) {
  std::vector<Option> options{
      {.name = "--by",
       .target = enum_word(request.by, kWays),
       .help = "maps; irregular, exact shadows; pages; lights, the sun and others over the panes",
       .names = kWays},
      {.name = "--local-lights",
       .target = &request.local_lights,
       .help = "point lights beside the sun, by lights",
       .range = {{1, 64}}}};
  for (Option& option : measured_maps_options(request.maps)) options.push_back(std::move(option));
  options.push_back({.name = "--frames",
                     .target = &request.frames,
                     .help = "frames: the middles of as many equal parts of the camera path",
                     .range = {{1, 1000}}});
  options.push_back({.name = "--rounds",
                     .target = &request.rounds,
                     .help = "timings of each frame; the median counts",
                     .range = {{1, 1000}}});
  return options;
}

}  // namespace

std::function<int()> declare_panes(Arguments& arguments) {
  const auto request = std::make_shared<PanesRequest>();
  arguments.options = measuring_options(
      *request, scenes_option(*request, "builtin:NAME or glTF files; without any: builtin:glass", false),
      own_options(*request), "folder for a picture of each frame; without it none are written");
  arguments.footer =
      "Panes are surfaces with a transmission, or with alpha that blends. Tinted: pixels that rays find\n"
      "behind panes. Errors are means over the three colours, of the share of light that passes, against\n"
      "exact rays; by lights, of their sum. Milliseconds: panes, their maps and the image of what they\n"
      "leave; hard, or what --by says, and msm, shadow maps, prefilter and look-up of these filters.\n"
      "docs/panes.md explains them.";
  return [request] { return run_panes(*request); };
}

}  // namespace gnomon::tool
