// What does leaving out save? Frames of every scene's default flight with all rules and with none, in turns
// on one machine: texels and triangles drawn, time of a frame, what each rule saved, and how many pixels of
// the mask differ.
//
//     bench_prune [--scenes a,b] [--starts N] [--frames N] [--size WxH] [--maps TEXT] [--filter NAME]
//                 [--against RULES]
//
// --maps takes the layouts whose name holds the text; --against compares with these rules instead of none.
// Each flight is flown in pieces of consecutive frames of a 600th of the way; the first of each piece finds
// nothing to hold on to.
#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/load.hpp"
#include "median.hpp"

namespace {

using namespace gnomon;
using namespace gnomon::render;
using Clock = std::chrono::steady_clock;

struct Arguments {
  std::vector<std::string> scenes;
  std::string maps;  // part of a layout's name
  FilterSettings filter = default_settings(filters::pcf);
  PruneRules against = kPruneNothing;
  int starts = 3, frames = 10, width = 480, height = 270;
};

struct Layout {
  const char* name;
  Fit fit;
  const Warp* warp;
  bool history;
  int map_size;
  bool still;
};
constexpr int kSmall = 1024, kLarge = 2048;
const std::array kLayouts = {
    Layout{"tight, 1024", Fit::tight, nullptr, false, kSmall, false},
    Layout{"tight, 2048", Fit::tight, nullptr, false, kLarge, false},
    Layout{"stable, 1024", Fit::stable, nullptr, false, kSmall, false},
    Layout{"warped-stable, 1024", Fit::warped_stable, nullptr, true, kSmall, false},
    Layout{"tight, 1024, standing still", Fit::tight, nullptr, false, kSmall, true},
};

/// One side of the comparison: a renderer with its plans.
struct Side {
  Renderer renderer;
  PreparedFilter filter;
  PruneRules rules;
  PlanHistory history;
  std::vector<double> frame_ms, plan_us;
  std::uint64_t texels = 0, triangles = 0, maps = 0;
  std::array<PruneSaving, kPruneRuleCount> saved{};
  FloatImage mask;
  Side(const Scene& scene, PruneRules with) : renderer(scene), filter(), rules(with) {}
};

double sum(const std::vector<double>& values) {
  double total = 0.0;
  for (const double v : values) total += v;
  return total;
}

void draw(Side& side, const Camera& camera, const std::vector<Box>& boxes, const Layout& technique) {
  PlanOptions options;
  options.resolution.max_size = technique.map_size;
  options.fit = technique.fit;
  options.warp.warp = technique.warp;
  options.prune = side.rules;
  set_margin(side.filter.settings, options);
  const DirectionalLight sun{{0.5, -0.8, 0.4}};
  const SceneBounds bounds{boxes, boxes};
  FrameOptions frame;
  frame.aliasing = frame.heat_map = frame.cascade_tint = false;
  frame.prune = side.rules;
  const Clock::time_point begin = Clock::now();
  const ShadowPlan plan = technique.history ? make_plan(camera, sun, bounds, options, &side.history)
                                            : make_plan(camera, sun, bounds, options);
  const Clock::time_point planned = Clock::now();
  const FrameStats stats = side.renderer.draw(plan, camera, side.filter, frame);
  const Clock::time_point end = Clock::now();
  const auto ms = [](Clock::duration d) { return std::chrono::duration<double, std::milli>(d).count(); };
  side.frame_ms.push_back(ms(end - begin));
  side.plan_us.push_back(1000.0 * ms(planned - begin));
  side.texels += stats.texels;
  for (int i = 0; i < stats.map_count; ++i) {
    const MapStats& map = stats.map[static_cast<std::size_t>(i)];
    side.triangles += map.triangles;
    side.maps += map.held ? 0 : 1;
  }
  for (std::size_t r = 0; r < kPruneRuleCount; ++r) {
    side.saved[r].texels += stats.saved[r].texels;
    side.saved[r].triangles += stats.saved[r].triangles;
    side.saved[r].maps += stats.saved[r].maps;
  }
  side.mask = side.renderer.mask();
}

struct Outcome {
  std::string scene;
  const Layout* technique;
  int frames;
  double texels, triangles, time;  // of those without rules
  double plan_us[2], frame_ms[2];
  double differing;  // share of pixels whose visibility differs
  double full_texels, full_triangles;
  std::array<PruneSaving, kPruneRuleCount> saved;
};

double share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 1.0 : static_cast<double>(part) / static_cast<double>(whole);
}

Outcome compare(const Scene& scene, const std::vector<Box>& boxes, const Layout& technique,
                const Arguments& arguments) {
  Side with(scene, PruneRules{}), without(scene, arguments.against);
  for (Side* side : {&with, &without}) side->filter = side->renderer.prepare(arguments.filter);
  const CameraPath path = default_path(scene);
  std::size_t differing = 0, pixels = 0;
  int drawn = 0;
  for (int start = 0; start < arguments.starts; ++start) {
    with.history.clear();
    without.history.clear();
    for (int k = 0; k < arguments.frames; ++k, ++drawn) {
      const double t = (start + 0.5) / arguments.starts + (technique.still ? 0.0 : k / 600.0);
      const Camera camera = path.at(t, arguments.width, arguments.height);
      Side* const order[2] = {drawn % 2 == 0 ? &with : &without, drawn % 2 == 0 ? &without : &with};
      for (Side* side : order) draw(*side, camera, boxes, technique);
      for (std::size_t i = 0; i < with.mask.values.size(); i += 2, ++pixels)
        differing += std::bit_cast<std::uint32_t>(with.mask.values[i]) !=
                             std::bit_cast<std::uint32_t>(without.mask.values[i])
                         ? 1
                         : 0;
    }
  }
  return {scene.name,
          &technique,
          drawn,
          share(with.texels, without.texels),
          share(with.triangles, without.triangles),
          sum(with.frame_ms) / sum(without.frame_ms),
          {median(with.plan_us), median(without.plan_us)},
          {median(with.frame_ms), median(without.frame_ms)},
          share(differing, pixels),
          static_cast<double>(without.texels) / drawn,
          static_cast<double>(without.triangles) / drawn,
          with.saved};
}

void print(const Outcome& o) {
  std::printf("| %s | %s | %.0f %% | %.0f %% | %.0f %% | %.1f -> %.1f | %.0f -> %.0f | %.4f %% |\n",
              o.scene.c_str(), o.technique->name, 100 * o.texels, 100 * o.triangles, 100 * o.time,
              o.frame_ms[1], o.frame_ms[0], o.plan_us[1], o.plan_us[0], 100 * o.differing);
  (void)std::fflush(stdout);
}

/// What is left of texels and triangles after each rule, in the order of the rules.
void print_waterfall(const std::vector<Outcome>& outcomes) {
  std::printf(
      "\nLeft after each rule, texels / triangles a frame, of those without rules\n\n| scene | maps | all |");
  for (const PruneRuleInfo& rule : prune_rules()) std::printf(" %s |", std::string(rule.name).c_str());
  std::printf("\n|--|--|--|");
  for (std::size_t r = 0; r < kPruneRuleCount; ++r) std::printf("--|");
  std::printf("\n");
  for (const Outcome& o : outcomes) {
    std::printf("| %s | %s | %.2f M / %.0f k |", o.scene.c_str(), o.technique->name, 1e-6 * o.full_texels,
                1e-3 * o.full_triangles);
    double texels = o.full_texels, triangles = o.full_triangles;
    for (const PruneSaving& saved : o.saved) {
      texels -= static_cast<double>(saved.texels) / o.frames;
      triangles -= static_cast<double>(saved.triangles) / o.frames;
      std::printf(" %.0f %% / %.0f %% |", 100 * texels / std::max(1.0, o.full_texels),
                  100 * triangles / std::max(1.0, o.full_triangles));
    }
    std::printf("\n");
  }
}

std::vector<std::string> split(const char* text) {
  std::vector<std::string> parts(1);
  for (; *text != '\0'; ++text) {
    if (*text == ',')
      parts.emplace_back();
    else
      parts.back() += *text;
  }
  return parts;
}

bool parse(int argc, char** argv, Arguments& arguments) {
  for (int i = 1; i < argc; ++i) {
    const bool more = i + 1 < argc;
    if (more && std::strcmp(argv[i], "--scenes") == 0)
      arguments.scenes = split(argv[++i]);
    else if (more && std::strcmp(argv[i], "--starts") == 0)
      arguments.starts = std::atoi(argv[++i]);
    else if (more && std::strcmp(argv[i], "--frames") == 0)
      arguments.frames = std::atoi(argv[++i]);
    else if (more && std::strcmp(argv[i], "--maps") == 0)
      arguments.maps = argv[++i];
    else if (more && std::strcmp(argv[i], "--filter") == 0)
      arguments.filter = parse_filter(argv[++i]).settings;
    else if (more && std::strcmp(argv[i], "--against") == 0 &&
             parse_prune_rules(argv[i + 1], arguments.against))
      ++i;
    else if (more && std::strcmp(argv[i], "--size") == 0)
      (void)std::sscanf(argv[++i], "%dx%d", &arguments.width, &arguments.height);
    else
      return false;
  }
  if (arguments.scenes.empty()) {
    for (const BuiltinScene& scene : builtin_scenes())
      arguments.scenes.push_back("builtin:" + std::string(scene.name));
  }
  return arguments.filter.filter != nullptr && arguments.starts > 0 && arguments.frames > 0 &&
         arguments.width > 0 && arguments.height > 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  if (!parse(argc, argv, arguments)) {
    std::fputs(
        "usage: bench_prune [--scenes A,B] [--starts N] [--frames N] [--size WxH] [--maps TEXT] "
        "[--filter NAME] [--against RULES]\n",
        stderr);
    return 2;
  }
  const auto context = create_context(ContextKind::automatic);
  std::printf("%s, %dx%d, %d x %d frames, %s, up to 4 maps\n\n", context->info().description().c_str(),
              arguments.width, arguments.height, arguments.starts, arguments.frames,
              to_string(arguments.filter).c_str());
  std::printf("| scene | maps | texels | triangles | time | frame, ms | plan, us | pixels that differ |\n");
  std::printf("|--|--|--|--|--|--|--|--|\n");
  std::vector<Outcome> outcomes;
  for (const std::string& name : arguments.scenes) {
    try {
      const Scene scene = load_scene(name);
      std::vector<Box> boxes;
      for (const Instance& instance : scene.instances) boxes.push_back(instance.bounds_world);
      for (const Layout& technique : kLayouts) {
        if (std::string_view(technique.name).find(arguments.maps) == std::string_view::npos) continue;
        outcomes.push_back(compare(scene, boxes, technique, arguments));
        print(outcomes.back());
      }
    } catch (const std::exception& error) {
      std::fprintf(stderr, "bench_prune: %s\n", error.what());
      return 2;
    }
  }
  if (arguments.against == kPruneNothing) print_waterfall(outcomes);
  return 0;
}
