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
#include "offscreen_context.hpp"
#include "output.hpp"
#include "pages/frame_pages.hpp"
#include "pane_lights.hpp"
#include "picture_words.hpp"
#include "scene_view.hpp"
#include "scene_words.hpp"

namespace gnomon::tool {
namespace {

using report::median;

struct PanesRequest {
  std::vector<std::string> scenes;
  std::string warp = "auto", light = "sun", size = "480x270", context = "auto", by = "maps", out;
  int local_lights = 4;  ///< beside the sun, by lights
  int map_size = 1024, cascades = 4, frames = 4, rounds = 5;
  LightPlacement sun;
  bool json = false;
};

Sweep sweep_of(const PanesRequest& request) {
  CompareRequest compared;
  compared.scenes = request.scenes;
  if (compared.scenes.empty()) compared.scenes = {"builtin:glass"};
  // What light through panes costs is told beside four moments of depths.
  compared.filters = {"hard", "msm"};
  compared.warps = {request.warp};
  compared.cascades = {std::to_string(request.cascades)};
  compared.map_sizes = {std::to_string(request.map_size)};
  compared.size = request.size;
  compared.frames = request.frames;
  compared.context = request.context;
  compared.light = request.light;
  compared.sun = request.sun;
  return make_sweep(compared);
}

/// Refuses maps that draw no panes.
void check_shape(const PanesRequest& request, const Sweep& sweep) {
  const Shape* const shape = sweep.entries[0].plan.warp.shape;
  if (request.by == "irregular" || shape == nullptr || shape->affine) return;
  throw std::runtime_error("--warp " + request.warp +
                           ": maps that bend lines draw no panes; --by irregular draws them");
}

/// Refuses maps that memory does not take with the images of panes beside them.
void check_memory(const PanesRequest& request, const Sweep& sweep) {
  // The larger of both filters is drawn with panes as well.
  const SweepEntry& msm = sweep.entries[1];
  const LightKind kind = request.by == "lights" ? LightKind::point : sweep.light.kind;
  const render::FittingMaps fitting =
      render::largest_maps(request.map_size, most_maps(msm, kind),
                           render::kPaneTexelBytes + render::bytes_per_texel(msm.filter), 0.0);
  if (fitting.size >= request.map_size) return;
  throw std::runtime_error("--map-size " + std::to_string(request.map_size) +
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
        view(scene, sweep.light, limits_of_triangles(sweep.max_triangles)),
        parts(split_translucent(view.scene())),
        renderer(parts.opaque),
        tracer(parts.opaque),
        panes(parts.panes),
        msm(renderer.prepare(sweep.entries[1].filter)) {
    renderer.add_panes(parts.panes);
    const render::FilterSettings& hard = sweep.entries[0].filter;
    shadows = request.by == "irregular" ? renderer.prepare_irregular()
              : request.by == "pages"   ? renderer.prepare_pages(hard)
              : request.by == "lights"  ? renderer.prepare_lights(hard)
                                        : renderer.prepare(hard);
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
    return std::make_unique<FramePages>(
        PageFrameInput{view.light(), view.bounds(), sweep.entries[0].plan, of_pages},
        std::make_shared<const SeenSurfaces>(draw_surfaces(renderer, camera, render::DepthLayer::front)));
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
  if (row.by == "pages") pages = stage.pages(camera);
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
  const render::PreparedFilter of_plain = plain.prepare_lights(stage.sweep.entries[0].filter);
  PaneLights lights(stage.view.light(), stage.request.local_lights, stage.parts);
  lights.plan(camera, stage.view.bounds(), stage.sweep.entries[0].plan, stage.request.map_size);
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
  for (const std::string& warning : stage.view.scene().warnings)
    std::fprintf(stderr, "gnomon: %s: %s\n", scene.c_str(), warning.c_str());
  std::optional<render::Renderer> plain;
  if (request.by == "lights") plain.emplace(stage.parts.opaque);
  for (int frame = 0; frame < sweep.frames; ++frame) {
    check_interrupt();
    const Camera camera = stage.view.camera(frame, sweep.frames, sweep.width, sweep.height);
    PanesRow row;
    row.scene = scene;
    row.by = request.by;
    row.frame = frame;
    plain ? measure_lights(stage, *plain, camera, row) : measure_frame(stage, camera, row);
    head();
    print_row(row, request.json);
    if (!request.out.empty()) {
      const std::string name =
          std::filesystem::path(scene.substr(scene.find_last_of(":/") + 1)).stem().string() + "_" +
          (request.by == "maps" ? "" : request.by + "_") + std::to_string(frame);
      write_png(stage.renderer.image(), std::filesystem::path(request.out) / (name + ".png"));
    }
    render::check_context();
  }
}

int run_panes(const PanesRequest& request) {
  for (const std::string& scene : request.scenes) check_scene_word("SCENE", scene);
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

}  // namespace

std::function<int()> declare_panes(Arguments& arguments) {
  const auto request = std::make_shared<PanesRequest>();
  arguments.options = {
      {.name = "SCENE",
       .target = &request->scenes,
       .help = "builtin:NAME or glTF files; without any: builtin:glass",
       .names = builtin_scene_words(),
       .only_names = false,
       .completion = Completion::files},
      {.name = "--by",
       .target = &request->by,
       .help = "maps; irregular, exact shadows; pages; lights, the sun and others over the panes",
       .names = {"maps", "irregular", "pages", "lights"}},
      {.name = "--local-lights",
       .target = &request->local_lights,
       .help = "point lights beside the sun, by lights",
       .range = {{1, 64}}},
      {.name = "--warp",
       .target = &request->warp,
       .help = "warp of the maps, or none",
       .names = names_in(all_warps(), {"auto"}),
       .only_names = false},
      {.name = "--cascades",
       .target = &request->cascades,
       .help = "number of shadow maps along the view",
       .range = {{1, kMaxMaps}}},
      {.name = "--map-size",
       .target = &request->map_size,
       .help = "texels along each side of a map",
       .range = {{64, 16384}}},
      {.name = "--frames",
       .target = &request->frames,
       .help = "frames along the scene's camera path",
       .range = {{1, 1000}}},
      {.name = "--rounds",
       .target = &request->rounds,
       .help = "timings of each frame; the median counts",
       .range = {{1, 1000}}}};
  for (Option& option : light_options(request->light, request->sun))
    arguments.options.push_back(std::move(option));
  arguments.options.push_back(
      {.name = "--size", .target = &request->size, .help = "size of a frame in pixels, WIDTHxHEIGHT"});
  arguments.options.push_back({.name = "--out",
                               .target = &request->out,
                               .help = "folder for a picture of each frame; without it none are written",
                               .completion = Completion::folders});
  arguments.options.push_back(
      {.name = "--json", .target = &request->json, .help = "print each row as a line of JSON"});
  arguments.options.push_back(context_option(request->context));
  arguments.footer =
      "Panes are surfaces with a transmission, or with alpha that blends. Tinted: pixels that rays find\n"
      "behind panes. Errors are means over the three colours, of the share of light that passes, against\n"
      "exact rays; by lights, of their sum. Milliseconds: panes, their maps and the image of what they\n"
      "leave; hard, or what --by says, and msm, shadow maps, prefilter and look-up of these filters.\n"
      "docs/panes.md explains them.";
  return [request] { return run_panes(*request); };
}

}  // namespace gnomon::tool
