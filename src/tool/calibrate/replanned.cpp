// A view of a sweep as the planner sees it: what it predicts of each technique, and which it picks.
#include "replanned.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <stdexcept>

#include "compare/sweep.hpp"

namespace gnomon::tool {
namespace {

constexpr double kMega = 1e6;

/// The scene under a row's light: one of a kind, or one of several over the scene, as "spot 1 of 8".
SceneView lit_scene(const report::Row& row) {
  LightPlacement placement{LightKind::sun, row.light_elevation_deg, row.light_azimuth_deg};
  const std::size_t word_end = row.light.find(' ');
  if (!light_kind_from_name(row.light.substr(0, word_end), placement.kind))
    throw std::runtime_error("light '" + row.light + "': wants sun, spot or point");
  SceneView scene(row.scene, placement);
  if (word_end == std::string::npos) return scene;
  int number = 0, count = 0, read = 0;
  if (std::sscanf(row.light.c_str() + word_end, " %d of %d%n", &number, &count, &read) != 2 ||
      word_end + static_cast<std::size_t>(read) != row.light.size() || number < 1 || number > count ||
      count > kMostLocalLights)
    throw std::runtime_error("light '" + row.light + "': wants the number of a light, as in spot 1 of 8");
  scene.set_light(local_lights(count, scene.scene().bounds_world)[static_cast<std::size_t>(number - 1)]);
  return scene;
}

/// Half side of the box of comparisons that the filter averages, texels.
double averaged_texels(const render::FilterSettings& filter) noexcept {
  const render::FilterInfo& info = filter.filter->info;
  const bool averages = info.has_kernel && info.penumbra_radius_world == nullptr;
  return averages && filter.unit == render::KernelUnit::texels ? filter.radius + 0.5 : 0.0;
}

/// It takes comparisons of depths as they are, or averages them.
bool compares(const render::FilterSettings& filter) noexcept {
  const render::FilterInfo& info = filter.filter->info;
  return info.reads == render::MapRead::depth && info.penumbra_radius_world == nullptr;
}

/// Texels may be finer than the frame's pixels, and shadows narrower: a small picture shows too few of their
/// errors.
Camera finer(Camera camera) noexcept {
  constexpr int kFiner = 2, kFineEnough = 1280;
  if (camera.width * kFiner > kFineEnough) return camera;
  camera.width *= kFiner;
  camera.height *= kFiner;
  return camera;
}

}  // namespace

std::vector<View> views_of(const std::vector<report::Row>& rows) {
  std::map<std::string, std::size_t> known;
  std::vector<View> views;
  for (const report::Row& row : rows) {
    if (row.technique.filter.starts_with(kIrregular)) continue;  // no model predicts it: it reads no map
    if (row.technique.is_given()) continue;                      // planned by others
    if (!row.times.known()) continue;                            // of a frame that was not timed
    // Rows do not hold what the files of a path and of shadow proxies do.
    if (!row.camera.empty() || !row.edits.empty()) continue;
    const std::string light = fmt::format("{} {:g}/{:g} {}x{}", row.light, row.light_elevation_deg,
                                          row.light_azimuth_deg, row.width, row.height);
    const std::string name = fmt::format("{} {}/{} {}", row.scene, row.frame + 1, row.frames, light);
    const auto [found, is_new] = known.try_emplace(name, views.size());
    if (is_new) views.push_back({name, fmt::format("{}, {} frames, {}", row.scene, row.frames, light), {}});
    views[found->second].rows.push_back(row);
  }
  return views;
}

double wrong_pixels(const report::Row& row) noexcept {
  return row.errors.false_lit + row.errors.false_shadow;
}

Replanned::Replanned(const View& view)
    : name_(view.name),
      scene_(lit_scene(view.rows.front())),
      camera_(scene_.camera(view.rows.front().frame, view.rows.front().frames, view.rows.front().width,
                            view.rows.front().height)),
      shadow_(trace::seen_shadow(trace::Tracer(scene_.scene()), finer(camera_), scene_.light())) {}

report::Observation Replanned::observe(const report::Row& row) const {
  const SweepEntry entry = sweep_entry(row.technique);
  const ShadowPlan plan = make_plan(camera_, scene_.light(), scene_.bounds(), entry.plan);
  report::Observation o;
  o.view = name_;
  o.filter = row.technique.filter;
  o.work = planned_work(plan, scene_.bounds(), scene_.work());
  o.megapixels = static_cast<double>(row.width) * row.height / kMega;
  o.bytes_per_texel = render::bytes_per_texel(entry.filter);
  o.frame_ms = row.times.plan_ns.median / kMega;
  o.depth_ms = row.times.depth_ms.median;
  o.prefilter_ms = row.times.prefilter_ms.median;
  o.lookup_ms = row.times.shade_ms.median;
  o.kernel_texels = averaged_texels(entry.filter);
  o.compares = compares(entry.filter);
  o.expected = expected_error(plan, shadow_.picture(), o.kernel_texels).share();
  o.wrong = wrong_pixels(row);
  o.pixels = static_cast<double>(row.errors.pixels);
  return o;
}

TechniqueChoice Replanned::choose(const View& view, const Budget& budget, const CostModel& costs) const {
  std::vector<const Warp*> warps;
  std::vector<SplitScheme> splits;
  std::vector<int> cascades, sizes;
  const auto once = [](auto& list, const auto& value) {
    if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
  };
  for (const report::Row& row : view.rows) {
    const SweepEntry entry = sweep_entry(row.technique);
    if (entry.plan.fit != Fit::tight || entry.plan.split.partition != Partition::view_depth ||
        entry.plan.warp.warp == nullptr || !entry.plan.warp.shape->affine)
      throw std::runtime_error(row.technique.name() +
                               ": the planner chooses among named warps with linear texels, split by depth");
    once(warps, entry.plan.warp.warp);
    once(splits, entry.plan.split.scheme);
    once(cascades, entry.plan.cascades);
    once(sizes, entry.plan.resolution.max_size);
  }
  if (splits.size() > 1) throw std::runtime_error(view.name + ": more than one kind of split");
  return choose_technique(camera_, shadow_.picture(), scene_.light(), scene_.bounds(), scene_.work(),
                          {warps, splits, cascades, sizes}, budget, costs,
                          sweep_entry(view.rows.front().technique).plan);
}

}  // namespace gnomon::tool
