// Which texels do kept maps and kept pages redraw while a scene plays its animation, and is anything stale?
//
//     bench_animated [FRAMES] [SCENE.glb...]
//
// FRAMES (default 600) at 60 Hz of each scene's first animation, under a sun and a camera that flies, or
// rests, once by four stable maps of 512 and once by pages of policy clipmap. Every frame is compared with
// one that draws everything: texels of maps and pixels of the mask that differ are stale. "changed": texels
// that are others than in the frame before, where a map lies as it lay, and of pages all those of any
// such page.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "animated_gltf.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/default_light.hpp"
#include "gnomon/scene/pose.hpp"
#include "page_storage.hpp"

namespace gnomon {
namespace {

constexpr int kWidth = 480, kHeight = 270;

struct Sums {
  std::uint64_t drawn = 0, all = 0, changed = 0, stale = 0, pixels = 0;
  double drawn_ms = 0.0, all_ms = 0.0;
};

struct Playing {
  Scene scene, posed;
  CameraPath path;
  Light light;
  render::Renderer keeps, redraws;
  std::vector<Box> boxes;

  explicit Playing(const Scene& of)
      : scene(of),
        posed(of),
        path(default_path(of)),
        light(default_light({}, of.bounds_world)),
        keeps(of),
        redraws(of) {}
  void go(int frame) {
    Pose at;
    (void)pose(scene, 0, looped_time(scene.motion.animations.at(0), frame / 60.0), at);
    (void)keeps.apply_pose(at);
    (void)redraws.apply_pose(at);
    apply_pose(at, posed);
    boxes.clear();
    for (const Instance& instance : posed.instances) boxes.push_back(instance.bounds_world);
  }
  [[nodiscard]] Camera camera(int frame, bool flies) const {
    return path.at(flies ? 0.3 + frame / 3000.0 : 0.3, kWidth, kHeight);
  }
};

double map_ms(const render::FrameStats& stats) {
  return stats.milliseconds[static_cast<std::size_t>(render::Pass::shadow_maps)];
}

std::uint64_t differing(const std::vector<float>& a, const std::vector<float>& b) {
  std::uint64_t count = a.size() == b.size() ? 0 : a.size();
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) count += a[i] != b[i];
  return count;
}

render::FrameOptions drawing(bool keeps) {
  render::FrameOptions options;
  options.aliasing = options.heat_map = options.cascade_tint = false;
  // All casters: kept maps may hold some that the frame's plan culls, where no look-up reads.
  options.prune = exact_prune_rules().without(PruneRule::swept_casters);
  if (!keeps) options.prune = options.prune.without(PruneRule::held_maps).without(PruneRule::scrolled_maps);
  return options;
}

PlanOptions plan_options(const render::FilterSettings& filter) {
  PlanOptions options;
  options.fit = Fit::stable;
  options.resolution.max_size = 512;
  options.prune = exact_prune_rules();
  set_margin(filter, options);
  return options;
}

Sums maps(Playing& playing, int frames, bool flies) {
  const render::FilterSettings filter = render::default_settings(render::filters::pcf);
  const PlanOptions options = plan_options(filter);
  const render::PreparedFilter with = playing.keeps.prepare(filter), whole = playing.redraws.prepare(filter);
  Sums sums;
  ShadowPlan before;
  std::vector<std::vector<float>> depths(kMaxMaps);
  for (int frame = 0; frame < frames; ++frame) {
    playing.go(frame);
    const Camera camera = playing.camera(frame, flies);
    const ShadowPlan plan = make_plan(camera, playing.light, {playing.boxes, playing.boxes}, options);
    const render::FrameStats kept = playing.keeps.draw(plan, camera, with, drawing(true));
    const render::FrameStats all = playing.redraws.draw(plan, camera, whole, drawing(false));
    sums.drawn += kept.texels;
    sums.all += all.texels;
    sums.drawn_ms += map_ms(kept);
    sums.all_ms += map_ms(all);
    for (int map = 0; map < plan.map_count; ++map) {
      const auto i = static_cast<std::size_t>(map);
      std::vector<float> now = playing.redraws.depth_map(map).values;
      sums.stale += differing(playing.keeps.depth_map(map).values, now);
      const bool same =
          map < before.map_count && before.map[i].clip_from_world == plan.map[i].clip_from_world;
      sums.changed += same ? differing(depths[i], now) : now.size();
      depths[i] = std::move(now);
    }
    sums.pixels += differing(playing.keeps.mask().values, playing.redraws.mask().values);
    before = plan;
  }
  return sums;
}

Sums pages(Playing& playing, int frames, bool flies) {
  const render::FilterSettings filter = render::default_settings(render::filters::pcf);
  const PlanOptions options = plan_options(filter);
  PageOptions of_pages;
  of_pages.page_texels = 64;
  of_pages.policy = &page_policies::clipmap;
  of_pages.fallback = true;
  PageStorage memory{1 << 13, std::size_t{kWidth} * kHeight};
  Sums sums;
  struct Drawn {
    glm::dmat4 clip_from_world;
    std::vector<float> depths;
  };
  std::vector<Drawn> before, now;
  for (int frame = 0; frame < frames; ++frame) {
    playing.go(frame);
    const Camera camera = playing.camera(frame, flies);
    playing.redraws.draw(ShadowPlan{}, camera, playing.redraws.prepare(filter), drawing(true));
    const FloatImage at = playing.redraws.positions();
    std::vector<glm::dvec3> points;
    for (std::size_t i = 0; i < at.values.size(); i += 4 * 11) {
      const float* p = &at.values[i];
      if (p[3] > 0.0f) points.push_back(camera.position + glm::dvec3(p[0], p[1], p[2]));
    }
    const PagePlan plan = plan_pages(camera, playing.light, {playing.boxes, playing.boxes}, {points}, options,
                                     of_pages, memory.spans());
    const render::FrameStats kept =
        playing.keeps.draw(plan, camera, playing.keeps.prepare_pages(filter), drawing(true));
    const render::FrameStats all =
        playing.redraws.draw(plan, camera, playing.redraws.prepare_pages(filter), drawing(false));
    sums.drawn += kept.texels;
    sums.all += all.texels;
    sums.drawn_ms += map_ms(kept);
    sums.all_ms += map_ms(all);
    now.clear();
    for (std::size_t i = 0; i < plan.pages.size(); ++i) {
      now.push_back({page_map(plan, plan.pages[i]).clip_from_world, playing.redraws.page_depths(i).values});
      sums.stale += differing(playing.keeps.page_depths(i).values, now.back().depths);
      const auto same = std::find_if(before.begin(), before.end(), [&](const Drawn& page) {
        return page.clip_from_world == now.back().clip_from_world;
      });
      const std::uint64_t size = now.back().depths.size();
      const std::uint64_t differs = same == before.end() ? size : differing(same->depths, now.back().depths);
      sums.changed += differs > 0 ? size : 0;
    }
    std::swap(before, now);
    sums.pixels += differing(playing.keeps.mask().values, playing.redraws.mask().values);
  }
  return sums;
}

void print(const char* what, const Sums& sums, int frames) {
  const auto share = [&](std::uint64_t texels) {
    return 100.0 * static_cast<double>(texels) / static_cast<double>(std::max<std::uint64_t>(sums.all, 1));
  };
  std::printf("| %s | %.2f | ", what, share(sums.drawn));
  sums.changed > 0 ? std::printf("%.2f", share(sums.changed)) : std::printf("-");
  std::printf(" | %.2f | %.2f | %llu | %llu |\n", sums.drawn_ms / frames, sums.all_ms / frames,
              static_cast<unsigned long long>(sums.stale), static_cast<unsigned long long>(sums.pixels));
}

void run(const std::string& name, const Scene& scene, int frames) {
  if (scene.motion.animations.empty()) {
    std::printf("%s: has no animation\n", name.c_str());
    return;
  }
  Playing playing(scene);
  std::printf("\n%s, %d frames of '%s'\n", name.c_str(), frames, scene.motion.animations[0].name.c_str());
  std::printf("| | texels drawn, %% | changed, %% | kept, ms | all, ms | stale texels | stale pixels |\n");
  print("maps, camera at rest", maps(playing, frames, false), frames);
  print("maps, camera flies", maps(playing, frames, true), frames);
  print("pages, camera at rest", pages(playing, frames, false), frames);
  print("pages, camera flies", pages(playing, frames, true), frames);
}

}  // namespace
}  // namespace gnomon

int main(int argc, char** argv) {
  const int frames = argc > 1 ? std::max(std::atoi(argv[1]), 1) : 600;
  const auto context = gnomon::render::create_context(gnomon::render::ContextKind::automatic);
  gnomon::run("test scene", gnomon::test::animated_gltf().load(), frames);
  for (int i = 2; i < argc; ++i) gnomon::run(argv[i], gnomon::load_gltf(argv[i]), frames);
  return 0;
}
