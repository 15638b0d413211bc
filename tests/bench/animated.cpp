// Which texels do kept maps and kept pages redraw while a scene plays its animation, and is anything stale?
//
//     bench_animated [FRAMES [maps|pages] [SCENE.glb...]]
//
// FRAMES (default 600, 2 or more) at 60 Hz of the first animation of each scene, or of a scene of its own,
// under a sun and a camera that flies, or rests, once by four stable maps of 512 and once by pages of policy
// clipmap. Three renderers draw each frame by turns: one that keeps static casters apart
// (PruneRule::static_casters), one that keeps maps and pages without that rule, and one that draws
// everything. Texels of maps and pixels of the mask in which the first two differ from the third are stale.
//
// In percent of the texels that drawing everything takes: "drawn", by the rule, and without it; "exact",
// those that a caster which moved covers now or covered in the frame before, hidden or not, or all of a map
// that lies elsewhere than it lay; "changed", those that are others than in the frame before, of pages all
// texels of any such page. "Drawn over exact" is a ratio. Then, per frame with the rule, without it and all:
// triangles in the mean, and milliseconds of the shadow map pass in the median. The first frame draws
// everything: not counted.
#include <glad/gl.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "animated_gltf.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/default_light.hpp"
#include "gnomon/scene/pose.hpp"
#include "guarded.hpp"
#include "median.hpp"

namespace gnomon {
namespace {

constexpr int kWidth = 480, kHeight = 270;

/// What one renderer did over all frames.
struct Work {
  std::uint64_t texels = 0, triangles = 0;
  std::vector<double> ms;

  void add(const render::FrameStats& stats) {
    texels += stats.texels;
    for (int map = 0; map < stats.map_count; ++map)
      triangles += stats.map[static_cast<std::size_t>(map)].triangles;
    ms.push_back(stats.ms(render::Pass::shadow_maps));
  }
};

struct Sums {
  Work apart, kept, all;
  std::uint64_t exact = 0, changed = 0, stale = 0, pixels = 0;

  void add(const render::FrameStats& by_rule, const render::FrameStats& without,
           const render::FrameStats& whole) {
    apart.add(by_rule);
    kept.add(without);
    all.add(whole);
  }
};

/// The casters that moved between two frames, and nothing else.
class MovedAlone {
 public:
  explicit MovedAlone(const Scene& scene) : renderer_(scene) {
    Pose any;
    (void)pose(scene, 0, 0.0, any);
    std::vector<bool> listed(scene.instances.size());
    for (const PosedInstance& at : any.instances) listed[at.instance] = true;
    for (std::size_t i = 0; i < listed.size(); ++i) {
      if (listed[i]) continue;
      Instance point = scene.instances[i];
      hide(point.world_from_object, point.bounds_world);
      (void)renderer_.move_instance(i, point);
    }
  }
  /// Texels of the plan's maps that those casters cover which differ between two poses, in either of them.
  std::uint64_t covered(const ShadowPlan& plan, const Camera& camera, const Pose& before, const Pose& now,
                        const std::vector<bool>& same_map) {
    const std::vector<std::vector<float>> then = depths(plan, camera, before, now),
                                          here = depths(plan, camera, now, before);
    std::uint64_t count = 0;
    for (std::size_t map = 0; map < here.size(); ++map) {
      for (std::size_t i = 0; i < here[map].size(); ++i)
        count += !same_map[map] || here[map][i] < 1.0f || then[map][i] < 1.0f;
    }
    return count;
  }

 private:
  static void hide(glm::dmat4& world_from_object, Box& bounds) {
    for (int column = 0; column < 3; ++column) world_from_object[column] = glm::dvec4(0.0);
    bounds = {glm::dvec3(world_from_object[3]), glm::dvec3(world_from_object[3])};
  }
  std::vector<std::vector<float>> depths(const ShadowPlan& plan, const Camera& camera, const Pose& at,
                                         const Pose& other) {
    Pose shown = at;
    for (std::size_t i = 0; i < shown.instances.size(); ++i) {
      bool moved = !(at.instances[i] == other.instances[i]);
      for (std::size_t v = 0; v < at.vertices.size(); ++v) {
        const PosedVertices& range = at.vertices[v];
        if (range.instance != at.instances[i].instance) continue;
        for (std::size_t k = 0; k < range.count; ++k)
          moved = moved || at.positions[range.first + k] != other.positions[range.first + k];
      }
      if (!moved) hide(shown.instances[i].world_from_object, shown.instances[i].bounds_world);
    }
    (void)renderer_.apply_pose(shown);
    render::FrameOptions options;
    options.prune = kPruneNothing;
    options.aliasing = options.heat_map = options.cascade_tint = options.time_passes = false;
    renderer_.draw(plan, camera, renderer_.prepare(render::filters::hard), options);
    std::vector<std::vector<float>> all;
    for (int map = 0; map < plan.map_count; ++map) all.push_back(renderer_.depth_map(map).values);
    return all;
  }
  render::Renderer renderer_;
};

struct Playing {
  Scene scene, posed;
  CameraPath path;
  Light light;
  render::Renderer apart, keeps, redraws;
  MovedAlone moved;
  Pose at, before;
  std::vector<Box> boxes;

  explicit Playing(const Scene& of)
      : scene(of),
        posed(of),
        path(default_path(of)),
        light(default_light({}, of.bounds_world)),
        apart(of),
        keeps(of),
        redraws(of),
        moved(of) {}
  void go(int frame) {
    before = at;
    (void)pose(scene, 0, looped_time(scene.motion.animations.at(0), frame / 60.0), at);
    if (frame == 0) before = at;
    for (render::Renderer* renderer : {&apart, &keeps, &redraws}) (void)renderer->apply_pose(at);
    apply_pose(at, posed);
    boxes.clear();
    for (const Instance& instance : posed.instances) boxes.push_back(instance.bounds_world);
  }
  [[nodiscard]] Camera camera(int frame, bool flies) const {
    return path.at(flies ? 0.3 + frame / 3000.0 : 0.3, kWidth, kHeight);
  }
};

std::uint64_t differing(const std::vector<float>& a, const std::vector<float>& b) {
  std::uint64_t count = a.size() == b.size() ? 0 : a.size();
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) count += a[i] != b[i];
  return count;
}

enum class Keeping : std::uint8_t { apart, maps, nothing };

render::FrameOptions drawing(Keeping keeping) {
  render::FrameOptions options;
  options.aliasing = options.heat_map = options.cascade_tint = false;
  // All casters: kept maps may hold some that the frame's plan culls, where no look-up reads.
  options.prune = exact_prune_rules().without(PruneRule::swept_casters);
  if (keeping != Keeping::apart) options.prune = options.prune.without(PruneRule::static_casters);
  if (keeping == Keeping::nothing) options.prune = options.prune.without(PruneRule::held_maps);
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
  const render::PreparedFilter prepared = playing.apart.prepare(filter), with = playing.keeps.prepare(filter),
                               whole = playing.redraws.prepare(filter);
  Sums sums;
  ShadowPlan before;
  std::vector<std::vector<float>> depths(kMaxMaps);
  for (int frame = 0; frame < frames; ++frame) {
    playing.go(frame);
    const Camera camera = playing.camera(frame, flies);
    const ShadowPlan plan = make_plan(camera, playing.light, {playing.boxes, playing.boxes}, options);
    const auto draw = [&](render::Renderer& by, const render::PreparedFilter& of, Keeping keeping) {
      glFinish();  // what came before is not its work
      return by.draw(plan, camera, of, drawing(keeping));
    };
    const render::FrameStats apart = draw(playing.apart, prepared, Keeping::apart),
                             kept = draw(playing.keeps, with, Keeping::maps),
                             all = draw(playing.redraws, whole, Keeping::nothing);
    const bool counts = frame > 0;
    if (counts) sums.add(apart, kept, all);
    std::vector<bool> same;
    for (int map = 0; map < plan.map_count; ++map) {
      const auto i = static_cast<std::size_t>(map);
      std::vector<float> now = playing.redraws.depth_map(map).values;
      sums.stale += differing(playing.apart.depth_map(map).values, now);
      sums.stale += differing(playing.keeps.depth_map(map).values, now);
      same.push_back(map < before.map_count && before.map[i].clip_from_world == plan.map[i].clip_from_world);
      if (counts) sums.changed += same.back() ? differing(depths[i], now) : now.size();
      depths[i] = std::move(now);
    }
    if (counts) sums.exact += playing.moved.covered(plan, camera, playing.before, playing.at, same);
    const std::vector<float> mask = playing.redraws.mask().values;
    sums.pixels +=
        differing(playing.apart.mask().values, mask) + differing(playing.keeps.mask().values, mask);
    before = plan;
  }
  return sums;
}

Sums pages(Playing& playing, int frames, bool flies) {
  const render::FilterSettings filter = render::default_settings(render::filters::pcf);
  PageOptions of_pages;
  of_pages.plan = plan_options(filter);
  of_pages.page_texels = 64;
  of_pages.policy = &page_policies::clipmap;
  of_pages.fallback = true;
  std::vector<std::byte> memory(page_memory(1 << 13, std::size_t{kWidth} * kHeight));
  Sums sums;
  struct Drawn {
    glm::dmat4 clip_from_world;
    std::vector<float> depths;
  };
  std::vector<Drawn> before, now;
  for (int frame = 0; frame < frames; ++frame) {
    playing.go(frame);
    const Camera camera = playing.camera(frame, flies);
    playing.redraws.draw(ShadowPlan{}, camera, playing.redraws.prepare(filter), drawing(Keeping::nothing));
    const FloatImage at = playing.redraws.positions();
    std::vector<glm::dvec3> points;
    for (std::size_t i = 0; i < at.values.size(); i += 4 * 11) {
      const float* p = &at.values[i];
      if (p[3] > 0.0f) points.push_back(camera.position + glm::dvec3(p[0], p[1], p[2]));
    }
    const PagePlan plan = plan_pages({.camera = camera, .points_world = points}, playing.light,
                                     {playing.boxes, playing.boxes}, of_pages, memory);
    const auto draw = [&](render::Renderer& by, Keeping keeping) {
      glFinish();
      return by.draw(plan, camera, by.prepare(filter, render::Source::pages), drawing(keeping));
    };
    const render::FrameStats apart = draw(playing.apart, Keeping::apart),
                             kept = draw(playing.keeps, Keeping::maps),
                             all = draw(playing.redraws, Keeping::nothing);
    const bool counts = frame > 0;
    if (counts) sums.add(apart, kept, all);
    now.clear();
    for (std::size_t i = 0; i < plan.pages.size(); ++i) {
      now.push_back({page_map(plan, plan.pages[i]).clip_from_world, playing.redraws.page_depths(i).values});
      sums.stale += differing(playing.apart.page_depths(i).values, now.back().depths);
      sums.stale += differing(playing.keeps.page_depths(i).values, now.back().depths);
      const auto same = std::find_if(before.begin(), before.end(), [&](const Drawn& page) {
        return page.clip_from_world == now.back().clip_from_world;
      });
      const std::uint64_t size = now.back().depths.size();
      const std::uint64_t differs = same == before.end() ? size : differing(same->depths, now.back().depths);
      if (counts) sums.changed += differs > 0 ? size : 0;
    }
    std::swap(before, now);
    const std::vector<float> mask = playing.redraws.mask().values;
    sums.pixels +=
        differing(playing.apart.mask().values, mask) + differing(playing.keeps.mask().values, mask);
  }
  return sums;
}

void print(const char* what, const Sums& sums, int frames) {
  const auto share = [&](std::uint64_t texels) {
    return 100.0 * static_cast<double>(texels) /
           static_cast<double>(std::max<std::uint64_t>(sums.all.texels, 1));
  };
  const auto mean = [&](auto sum) { return static_cast<double>(sum) / std::max(frames - 1, 1); };
  std::printf("| %s | %.2f | %.2f | ", what, share(sums.apart.texels), share(sums.kept.texels));
  if (sums.exact > 0)
    std::printf("%.2f | %.2f", share(sums.exact),
                static_cast<double>(sums.apart.texels) / static_cast<double>(sums.exact));
  else
    std::printf("- | -");
  std::printf(" | %.2f | %.0f | %.0f | %.0f | %.2f | %.2f | %.2f | %llu | %llu |\n", share(sums.changed),
              mean(sums.apart.triangles), mean(sums.kept.triangles), mean(sums.all.triangles),
              median(sums.apart.ms), median(sums.kept.ms), median(sums.all.ms),
              static_cast<unsigned long long>(sums.stale), static_cast<unsigned long long>(sums.pixels));
  std::fflush(stdout);
}

struct Rows {
  bool maps = true, pages = true;
};

void run(const std::string& name, const Scene& scene, int frames, const Rows& rows) {
  if (scene.motion.animations.empty()) {
    std::printf("%s: has no animation\n", name.c_str());
    return;
  }
  Playing playing(scene);
  std::printf("\n%s, %d frames of '%s'\n", name.c_str(), frames, scene.motion.animations[0].name.c_str());
  std::printf(
      "| | drawn, %% | without | exact | drawn over exact | changed | triangles | without | all "
      "| ms | without | all | stale texels | stale pixels |\n");
  for (const bool flies : {false, true}) {
    if (rows.maps)
      print(flies ? "maps, camera flies" : "maps, camera at rest", maps(playing, frames, flies), frames);
  }
  for (const bool flies : {false, true}) {
    if (rows.pages)
      print(flies ? "pages, camera flies" : "pages, camera at rest", pages(playing, frames, flies), frames);
  }
}

int run_all(int argc, char** argv) {
  const int frames = argc > 1 ? std::max(std::atoi(argv[1]), 2) : 600;
  int next = 2;
  Rows rows;
  if (const std::string_view only = argc > next ? argv[next] : ""; only == "maps" || only == "pages") {
    rows = {only == "maps", only == "pages"};
    ++next;
  }
  const auto context = render::create_context(render::ContextKind::automatic);
  if (next >= argc) run("test scene", test::animated_gltf().load(), frames, rows);
  for (int i = next; i < argc; ++i) run(argv[i], load_gltf(argv[i]), frames, rows);
  return 0;
}

}  // namespace
}  // namespace gnomon

int main(int argc, char** argv) {
  return gnomon::guarded("bench_animated", gnomon::run_all, argc, argv);
}
