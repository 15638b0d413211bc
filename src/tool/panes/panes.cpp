// `gnomon panes`: how far is light behind panes from what rays say, and what does it cost?
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "compare/sweep.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/trace/transmittance.hpp"
#include "interrupt.hpp"
#include "offscreen_context.hpp"
#include "output.hpp"
#include "picture_words.hpp"
#include "scene_view.hpp"
#include "scene_words.hpp"

namespace gnomon::tool {
namespace {

struct PanesRequest {
  std::vector<std::string> scenes;
  std::string warp = "auto", light = "sun", size = "480x270", context = "auto", out;
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

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

struct PanesRow {
  std::string scene;
  int frame = 0;
  double tinted = 0.0;                   ///< share of the facing pixels behind panes
  double mean = 0.0, tinted_mean = 0.0;  ///< error over all facing pixels, and over those
  double panes_ms = 0.0, hard_ms = 0.0, msm_ms = 0.0;
};

void print_row(const PanesRow& row, bool json) {
  const double ratio = row.msm_ms > 0.0 ? (row.hard_ms + row.panes_ms) / row.msm_ms : 0.0;
  if (json) {
    print_line(nlohmann::ordered_json{
        {"scene", row.scene},
        {"frame", row.frame},
        {"tinted", row.tinted},
        {"mean_error", row.mean},
        {"mean_error_tinted", row.tinted_mean},
        {"panes_ms", row.panes_ms},
        {"hard_ms", row.hard_ms},
        {"msm_ms", row.msm_ms},
        {"hard_and_panes_over_msm",
         ratio}}.dump());
  } else {
    char text[256];
    std::snprintf(text, sizeof text, "| %s | %d | %.1f %% | %.2f %% | %.2f %% | %.1f | %.1f | %.1f | %.2f |",
                  row.scene.c_str(), row.frame, 100.0 * row.tinted, 100.0 * row.mean, 100.0 * row.tinted_mean,
                  row.panes_ms, row.hard_ms, row.msm_ms, ratio);
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

/// `head`: prints the table's head once there is a row.
void measure_scene(const PanesRequest& request, const Sweep& sweep, const std::string& scene,
                   const std::function<void()>& head) {
  const SceneView view(scene, sweep.light, limits_of_triangles(sweep.max_triangles));
  for (const std::string& warning : view.scene().warnings)
    std::fprintf(stderr, "gnomon: %s: %s\n", scene.c_str(), warning.c_str());
  const TranslucentParts parts = split_translucent(view.scene());
  render::Renderer renderer(parts.opaque);
  renderer.add_panes(parts.panes);
  const trace::Tracer tracer(parts.opaque);
  const trace::PaneTracer panes(parts.panes);
  std::vector<render::PreparedFilter> filters;
  for (const SweepEntry& entry : sweep.entries) filters.push_back(renderer.prepare(entry.filter));
  for (int frame = 0; frame < sweep.frames; ++frame) {
    check_interrupt();
    const Camera camera = view.camera(frame, sweep.frames, sweep.width, sweep.height);
    PanesRow row;
    row.scene = scene;
    row.frame = frame;
    std::array<std::vector<double>, 2> shadows;
    std::vector<double> panes_ms;
    for (int round = 0; round <= request.rounds; ++round) {
      for (std::size_t f = 0; f < filters.size(); ++f) {
        render::FrameOptions options;
        options.aliasing = options.heat_map = options.cascade_tint = false;
        // Every round draws its maps.
        options.prune = options.prune.without(PruneRule::held_maps);
        const ShadowPlan plan = make_plan(camera, view.light(), view.bounds(), sweep.entries[f].plan);
        const render::FrameStats stats = renderer.draw(plan, camera, filters[f], options);
        if (round == 0) continue;  // warms up
        shadows[f].push_back(stats.shadow_ms());
        if (f == 0) panes_ms.push_back(stats.ms(render::Pass::panes));
      }
    }
    row.panes_ms = median(panes_ms);
    row.hard_ms = median(shadows[0]);
    row.msm_ms = median(shadows[1]);
    const trace::SurfacePoints points =
        trace::surface_points(tracer, camera, view.light(), renderer.positions(), renderer.normals());
    if (!parts.panes.instances.empty())
      judge(renderer.transmittance(), points, trace::pane_reference(panes, points, view.light()), row);
    head();
    print_row(row, request.json);
    if (!request.out.empty()) {
      const std::string name =
          std::filesystem::path(scene.substr(scene.find_last_of(":/") + 1)).stem().string() + "_" +
          std::to_string(frame);
      write_png(renderer.image(), std::filesystem::path(request.out) / (name + ".png"));
    }
    render::check_context();
  }
}

int run_panes(const PanesRequest& request) {
  for (const std::string& scene : request.scenes) check_scene_word("SCENE", scene);
  const Sweep sweep = sweep_of(request);
  watch_interrupts();
  if (!request.out.empty()) make_folder("--out", request.out);
  const auto context = render::create_context(sweep.context);
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
  arguments.options = {{.name = "SCENE",
                        .target = &request->scenes,
                        .help = "builtin:NAME or glTF files; without any: builtin:glass",
                        .names = builtin_scene_words(),
                        .only_names = false,
                        .completion = Completion::files},
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
      "exact rays. Milliseconds: panes, their maps and the image of what they leave; hard and msm, shadow\n"
      "maps, prefilter and look-up of these filters. docs/panes.md explains them.";
  return [request] { return run_panes(*request); };
}

}  // namespace gnomon::tool
