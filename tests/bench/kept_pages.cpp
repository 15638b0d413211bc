// How many pages are kept from frame to frame over the flights of the built-in scenes, and what does that
// save?
//
//     bench_kept_pages [FRAMES] [SCENE...]
//
// SCENE: a built-in scene or a glTF file; without one all built-in scenes.
// A flight has 600 frames: ten seconds at 60 Hz. Shares are those of all of them, for policies that no mask
// need report to; the FRAMES (default 40) in its middle are drawn as well. 0: an instance walks, and no
// camera flies. "ms, whole": every page drawn, and large casters whole (without PruneRule::caster_clusters),
// by turns with "ms, all".
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <vector>

#include "gnomon/render/context.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/default_light.hpp"
#include "gnomon/scene/load.hpp"
#include "guarded.hpp"
#include "median.hpp"
#include "quiet.hpp"

namespace gnomon {
namespace {

constexpr int kWidth = 480, kHeight = 270, kStride = 3, kFlightFrames = 600;

/// A scene, its flight, and what a depth buffer reports of every frame.
struct Flight {
  std::string name;
  Scene scene;
  CameraPath path;
  std::vector<Box> boxes;
  Light light;
  render::Renderer renderer;
  std::vector<glm::dvec3> points;
  std::vector<std::uint32_t> pixels;
  std::vector<std::uint8_t> feedback;
  std::vector<std::byte> memory = std::vector<std::byte>(page_memory(1 << 13, std::size_t{kWidth} * kHeight)),
                         memory_before = memory;

  explicit Flight(const std::string& of)
      : name(of),
        scene(of.find('.') == std::string::npos ? load_builtin(of) : load_gltf(of)),
        path(default_path(scene)),
        renderer(scene) {
    for (const Instance& instance : scene.instances) boxes.push_back(instance.bounds_world);
    light = default_light({}, scene.bounds_world);
  }
  [[nodiscard]] Camera camera(int frame) const {
    return path.at((frame + 0.5) / kFlightFrames, kWidth, kHeight);
  }
  /// Pixels of the last frame drawn, for a plan of the next.
  void read_back(const Camera& camera) {
    const FloatImage at = renderer.positions();
    points.clear();
    pixels.clear();
    for (int y = 0; y < kHeight; y += kStride) {
      for (int x = 0; x < kWidth; x += kStride) {
        const auto pixel = static_cast<std::size_t>(y * kWidth + x);
        if (!(at.values[4 * pixel + 3] > 0.0f)) continue;
        points.push_back(camera.position + glm::dvec3(at.values[4 * pixel], at.values[4 * pixel + 1],
                                                      at.values[4 * pixel + 2]));
        pixels.push_back(static_cast<std::uint32_t>(pixel));
      }
    }
  }
  /// Shadow edges and depth edges beside the points' pixels, of the last frame drawn.
  void report() {
    const FloatImage mask = renderer.mask(), at = renderer.positions();
    feedback.assign(pixels.size(), 0);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const int x = static_cast<int>(pixels[i]) % kWidth, y = static_cast<int>(pixels[i]) / kWidth;
      for (int row = std::max(y - 2, 0); row <= std::min(y + 2, kHeight - 1); ++row) {
        for (int column = std::max(x - 2, 0); column <= std::min(x + 2, kWidth - 1); ++column) {
          const auto other = static_cast<std::size_t>(row * kWidth + column);
          const float step = mask.values[2 * other] - mask.values[2 * std::size_t{pixels[i]}];
          const float own = at.values[4 * std::size_t{pixels[i]} + 3], depth = at.values[4 * other + 3];
          if (std::abs(step) > 0.25f) feedback[i] |= kShadowEdge | kShadowChanged;
          if (std::max(own, depth) > 1.1f * std::min(own, depth)) feedback[i] |= kDepthEdge;
        }
      }
    }
  }
};

/// Sums over a flight.
struct Kept {
  double pages = 0.0, drawn = 0.0, texels = 0.0;
  int whole_frames = 0;  ///< in which nothing was kept, the first not counted
  std::vector<double> map_ms, whole_caster_ms, plan_ms;
};

double map_ms_of(const render::FrameStats& stats) {
  return stats.milliseconds[static_cast<std::size_t>(render::Pass::shadow_maps)];
}

PageOptions page_options(const PagePolicy& policy, const render::FilterSettings& filter) {
  PageOptions pages;
  pages.plan.fit = Fit::stable;
  render::set_margin(filter, pages.plan);
  pages.policy = &policy;
  pages.page_texels = 64;
  pages.capacity = 1024;
  pages.fallback = true;
  return pages;
}

Kept fly(Flight& flight, const PagePolicy& policy, int frames, bool keeps) {
  const int begin_frame = (kFlightFrames - frames) / 2;
  using Clock = std::chrono::steady_clock;
  Kept sums;
  const render::FilterSettings filter = render::default_settings(render::filters::hard);
  const render::PreparedFilter hard = flight.renderer.prepare(filter, render::Source::pages);
  const PageOptions pages = page_options(policy, filter);
  render::FrameOptions draw_options = quiet();
  if (!keeps) draw_options.prune = draw_options.prune.without(PruneRule::held_maps);
  // An empty pool, and points of the first camera.
  const Camera first = flight.camera(begin_frame);
  std::vector<Box> everything{flight.scene.bounds_world};
  draw_options.moved_world = everything;
  flight.renderer.draw(ShadowPlan{}, first, hard, draw_options);
  draw_options.moved_world = {};
  flight.read_back(first);
  flight.feedback.assign(flight.points.size(), 0);
  PagePlan before;
  for (int frame = 0; frame < frames; ++frame) {
    const Camera camera = flight.camera(begin_frame + frame);
    std::span<std::byte> memory = frame % 2 == 0 ? flight.memory : flight.memory_before;
    const PageHistory history{frame == 0 ? nullptr : &before, flight.feedback};
    const Clock::time_point begin = Clock::now();
    const PagePlan plan = plan_pages({.camera = camera, .points_world = flight.points}, flight.light,
                                     {flight.boxes, flight.boxes}, pages, memory, &history);
    sums.plan_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
    if (plan.status != PlanStatus::ok) {
      std::fprintf(stderr, "%s: frame %d has no pages: %s\n", flight.name.c_str(), frame,
                   std::string(to_string(plan.status)).c_str());
      std::exit(1);
    }
    const render::FrameStats stats = flight.renderer.draw(plan, camera, hard, draw_options);
    if (!keeps && frame > 0) {
      render::FrameOptions whole = draw_options;
      whole.prune = whole.prune.without(PruneRule::caster_clusters);
      sums.whole_caster_ms.push_back(map_ms_of(flight.renderer.draw(plan, camera, hard, whole)));
    }
    // One frame late, as a program without a wait reads it.
    flight.read_back(camera);
    if (policy.feedback != 0) {
      flight.report();
    } else {
      flight.feedback.assign(flight.points.size(), 0);
    }
    before = plan;
    if (frame == 0) continue;
    sums.pages += stats.pages;
    sums.drawn += stats.pages_drawn;
    sums.texels += static_cast<double>(stats.texels);
    sums.whole_frames += stats.pages_drawn == stats.pages;
    sums.map_ms.push_back(map_ms_of(stats));
  }
  return sums;
}

/// A pool without texels, of the size of the largest plan so far and a quarter more.
struct CountedPool {
  const PagePolicy* policy;
  std::vector<PageSlot> slots;
  std::vector<std::uint32_t> table;
  std::vector<KeptPage> out;
  double kept = 0.0, all = 0.0;

  void add(const PagePlan& plan, bool counts) {
    if (slots.size() < plan.pages.size()) {
      slots.resize(plan.pages.size() + plan.pages.size() / 4);
      table.resize(page_table_size(static_cast<int>(slots.size())));
    }
    out.resize(plan.pages.size());
    const KeptPages result = keep_pages(plan, {}, slots, table, out);
    if (!counts) return;
    kept += static_cast<double>(result.kept);
    all += static_cast<double>(plan.pages.size());
  }
};

/// Counts the pages that are kept over the whole flight, without drawing them.
void count_kept(Flight& flight, std::vector<CountedPool>& pools) {
  const render::FilterSettings filter = render::default_settings(render::filters::hard);
  const render::PreparedFilter hard = flight.renderer.prepare(filter);
  render::FrameOptions surfaces = quiet();
  surfaces.time_passes = false;
  for (int frame = 0; frame < kFlightFrames; ++frame) {
    const Camera camera = flight.camera(frame);
    flight.renderer.draw(ShadowPlan{}, camera, hard, surfaces);
    flight.read_back(camera);
    flight.report();
    for (CountedPool& pool : pools) {
      const PageOptions pages = page_options(*pool.policy, filter);
      const PageHistory reported{nullptr, flight.feedback};
      pool.add(plan_pages({.camera = camera, .points_world = flight.points}, flight.light,
                          {flight.boxes, flight.boxes}, pages, flight.memory, &reported),
               frame > 0);
    }
  }
}

double cascades_ms(Flight& flight, int frames, bool keeps) {
  const render::FilterSettings filter = render::default_settings(render::filters::hard);
  const render::PreparedFilter hard = flight.renderer.prepare(filter);
  PlanOptions options;
  options.fit = Fit::stable;
  options.resolution.max_size = 1024;
  render::set_margin(filter, options);
  render::FrameOptions draw_options = quiet();
  if (!keeps) draw_options.prune = prune_rules_of(PruneSource::this_frame);
  std::vector<double> ms;
  for (int frame = 0; frame < frames; ++frame) {
    const Camera camera = flight.camera((kFlightFrames - frames) / 2 + frame);
    const ShadowPlan plan = make_plan(camera, flight.light, {flight.boxes, flight.boxes}, options);
    const render::FrameStats stats = flight.renderer.draw(plan, camera, hard, draw_options);
    if (frame > 0) ms.push_back(stats.milliseconds[static_cast<std::size_t>(render::Pass::shadow_maps)]);
  }
  return median(ms);
}

void print(const Flight& flight, const PagePolicy& policy, double share, Kept kept, Kept redrawn) {
  const auto frames = static_cast<double>(kept.map_ms.size());
  std::sort(kept.map_ms.begin(), kept.map_ms.end());
  std::string share_text = "-";
  if (share >= 0.0) {
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "%.2f", 100.0 * share);
    share_text = text.data();
  }
  std::printf("%-9s %-11s %9s %7.0f %8.2f %6d %9.2f %8.2f %8.2f %8.2f %8.2f\n",
              std::filesystem::path(flight.name).stem().c_str(), std::string(policy.name).c_str(),
              share_text.c_str(), kept.pages / frames, 100.0 * (1.0 - kept.drawn / kept.pages),
              kept.whole_frames, median(redrawn.whole_caster_ms), median(redrawn.map_ms), median(kept.map_ms),
              kept.map_ms[kept.map_ms.size() * 99 / 100], median(kept.plan_ms));
  std::fflush(stdout);
}

/// The instance that walks: the nearest to the middle of the view, of those no larger than a twentieth of the
/// scene.
std::size_t walker_of(const Flight& flight, const Camera& camera) {
  const double largest = 0.05 * glm::length(flight.scene.bounds_world.max - flight.scene.bounds_world.min);
  const CameraAxes axes = camera_axes(camera);
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < flight.boxes.size(); ++i) {
    const Box& box = flight.boxes[i];
    const glm::dvec3 at = 0.5 * (box.min + box.max) - camera.position;
    const double depth = glm::dot(at, axes.forward);
    if (glm::length(box.max - box.min) > largest || !(depth > camera.near_depth)) continue;
    const double off = glm::length(at - axes.forward * depth) + 0.1 * depth;
    if (off < least) {
      least = off;
      best = i;
    }
  }
  return best;
}

/// Pages drawn, triangles and milliseconds of the shadow map pass, over the steps of a walk.
struct Walk {
  std::size_t drawn = 0, composed = 0;
  std::uint64_t triangles = 0;
  std::vector<double> ms;

  void add(const render::FrameStats& stats) {
    drawn += static_cast<std::size_t>(stats.pages_drawn);
    composed += static_cast<std::size_t>(stats.pages_composed);
    triangles += stats.map[0].triangles;
    ms.push_back(map_ms_of(stats));
  }
};

/// An instance walks before a camera at rest: the pages drawn over those whose texels changed, and what they
/// cost with static casters apart and without, by turns.
void walk(Flight& flight, const PagePolicy& policy) {
  constexpr int kSteps = 12;
  const Camera camera = flight.camera(kFlightFrames / 2);
  const render::FilterSettings filter = render::default_settings(render::filters::hard);
  // Both begin with an empty pool: in another slot a page's texels differ by rounding.
  render::Renderer one(flight.scene), other(flight.scene);
  const render::PreparedFilter hard = one.prepare(filter, render::Source::pages),
                               hard_of_other = other.prepare(filter, render::Source::pages);
  render::FrameOptions together = quiet();
  together.prune = together.prune.without(PruneRule::static_casters);
  const PageOptions pages = page_options(policy, filter);
  flight.renderer.draw(ShadowPlan{}, camera, flight.renderer.prepare(filter), quiet());
  flight.read_back(camera);
  const PagePlan plan = plan_pages({.camera = camera, .points_world = flight.points}, flight.light,
                                   {flight.boxes, flight.boxes}, pages, flight.memory);
  const auto texels_of_pages = [&] {
    std::vector<std::vector<float>> texels;
    for (std::size_t i = 0; i < plan.pages.size(); ++i) texels.push_back(one.page_depths(i).values);
    return texels;
  };
  one.draw(plan, camera, hard, quiet());
  other.draw(plan, camera, hard_of_other, together);
  std::vector<std::vector<float>> before = texels_of_pages();
  const std::size_t walker = walker_of(flight, camera);
  const Instance at_rest = flight.scene.instances[walker];
  const glm::dvec3 size = at_rest.bounds_world.max - at_rest.bounds_world.min;
  Walk apart, whole;
  std::size_t changed = 0, stale = 0;
  for (int step = 1; step <= kSteps; ++step) {
    const glm::dvec3 by = glm::dvec3(size.x, 0.0, 0.5 * size.z) * (0.05 * step);
    Instance at = at_rest;
    at.world_from_object[3] += glm::dvec4(by, 0.0);
    at.bounds_world = {at.bounds_world.min + by, at.bounds_world.max + by};
    one.move_instance(walker, at);
    other.move_instance(walker, at);
    apart.add(one.draw(plan, camera, hard, quiet()));
    whole.add(other.draw(plan, camera, hard_of_other, together));
    std::vector<std::vector<float>> after = texels_of_pages();
    for (std::size_t i = 0; i < after.size(); ++i) {
      changed += after[i] != before[i];
      stale += after[i] != other.page_depths(i).values;
    }
    before = std::move(after);
  }
  const auto mean = [](auto sum) { return static_cast<double>(sum) / kSteps; };
  std::printf(
      "%-9s %-11s an instance walks: %.1f of %zu pages drawn in a frame, %.1f change; %.1f composed, "
      "%.0f triangles, %.2f ms (without static_casters %.1f drawn, %.0f triangles, %.2f ms); %zu stale\n",
      std::filesystem::path(flight.name).stem().c_str(), std::string(policy.name).c_str(), mean(apart.drawn),
      plan.pages.size(), mean(changed), mean(apart.composed), mean(apart.triangles), median(apart.ms),
      mean(whole.drawn), mean(whole.triangles), median(whole.ms), stale);
  std::fflush(stdout);
}

int run_all(int argc, char** argv) {
  const int frames = argc > 1 ? std::atoi(argv[1]) : 40;
  const bool walks_alone = frames == 0;
  if ((frames != 0 && frames < 3) || frames > kFlightFrames) {
    std::fprintf(stderr, "bench_kept_pages: FRAMES %s: wants 0 or a number from 3 to 600\n", argv[1]);
    return 2;
  }
  std::vector<std::string> scenes(argv + std::min(argc, 2), argv + argc);
  if (scenes.empty()) {
    for (const BuiltinScene& scene : builtin_scenes()) scenes.emplace_back(scene.name);
  }
  const auto context = render::create_context();
  std::printf("%-9s %-11s %9s %7s %8s %6s %9s %8s %8s %8s %8s\n", "scene", "policy", "of 600, %", "pages",
              "kept, %", "none", "ms, whole", "ms, all", "ms, kept", "99 %", "plan, ms");
  // Frames that draw everything take as long each: a few of them, spread over the flight, tell.
  constexpr int kRedrawn = 6;
  for (const std::string& name : scenes) {
    Flight flight(name);
    for (const PagePolicy* policy : {&page_policies::resolution, &page_policies::clipmap})
      walk(flight, *policy);
    if (walks_alone) continue;
    std::vector<CountedPool> pools;
    for (const PagePolicy* policy : all_page_policies()) {
      // Without a mask drawn there are no shadow edges, and queried asks whether a still picture changes.
      if ((policy->feedback & (kShadowEdge | kShadowChanged)) == 0) pools.push_back({policy, {}, {}, {}});
    }
    count_kept(flight, pools);
    for (const PagePolicy* policy : all_page_policies()) {
      if ((policy->feedback & kShadowChanged) != 0) continue;
      const auto pool =
          std::find_if(pools.begin(), pools.end(), [&](const CountedPool& p) { return p.policy == policy; });
      const double share = pool == pools.end() ? -1.0 : pool->kept / pool->all;
      const Kept kept = fly(flight, *policy, frames, true);
      print(flight, *policy, share, kept, fly(flight, *policy, std::min(frames, kRedrawn), false));
    }
    std::printf("%-9s four stable cascades of 1024: all %.2f ms, kept and scrolled %.2f ms\n",
                std::filesystem::path(name).stem().c_str(),
                cascades_ms(flight, std::min(frames, kRedrawn), false), cascades_ms(flight, frames, true));
  }
  return 0;
}

}  // namespace
}  // namespace gnomon

int main(int argc, char** argv) {
  return gnomon::guarded("bench_kept_pages", gnomon::run_all, argc, argv);
}
