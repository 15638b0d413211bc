// All lights of a scene's file over one flight: what each frame plans and draws, and what is left out.
#include "lights_frame.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <stdexcept>

#include "command.hpp"
#include "gnomon/extend/shape.hpp"
#include "gnomon/render/filter.hpp"
#include "gnomon/render/probe.hpp"

namespace gnomon::tool::fly {
namespace {

/// What the plan left out, by reason, with a count.
std::string omitted_lights(const LightPlan& plan) {
  constexpr std::array<std::pair<LightOutcome, const char*>, 3> kWhy{
      {{LightOutcome::without_receiver, "lights without a surface in view"},
       {LightOutcome::without_caster, "lights without a caster in their range"},
       {LightOutcome::below_least_size, "lights with smaller maps than the least size"}}};
  std::string text;
  for (const auto& [outcome, words] : kWhy) {
    const auto count =
        std::count_if(plan.lights.begin(), plan.lights.end(),
                      [outcome = outcome](const LightMaps& m) { return m.outcome == outcome; });
    if (count > 0) text += (text.empty() ? "" : "; ") + fmt::format("{}: {}", words, count);
  }
  return text;
}

}  // namespace

std::string all_lights_refusal(const Options& options) {
  constexpr const char* kOption = "--scene-light all";
  if (const std::string_view other = for_whole_maps(options); !other.empty())
    return fmt::format("{}: {} is for one light", kOption, other);
  if (options.pages.on()) return fmt::format("{}: --pages are of one light", kOption);
  if (options.shadow_only) return fmt::format("{}: --shadow-only is of one light", kOption);
  if (options.context == render::ContextKind::glfw)
    return fmt::format("{}: --context glfw draws one light", kOption);
  if (!options.plan.warp.shape->affine)
    return fmt::format("{}: not with shape {}, whose maps bend lines", kOption,
                       options.plan.warp.shape->name);
  return {};
}

void fit_pool_to_memory(Options& options) {
  const LightOptions pool = pool_options(options.plan);
  const render::FittingMaps fitting = render::largest_maps(
      pool.pool_width, 1, render::bytes_per_texel(options.filter), options.map_memory_mib);
  const int across = pool.pool_width / pool.most_size, size = fitting.size / across;
  if (size == 0)
    throw std::runtime_error(fmt::format("--map-size {}: no pool of lights fits ({})",
                                         options.plan.resolution.max_size, fitting.why));
  if (size < pool.most_size)
    warn(fmt::format("a pool of {} x {} texels does not fit ({}): {} x {}, {:.4g} MiB", pool.pool_width,
                     pool.pool_height, fitting.why, fitting.size, fitting.size, fitting.mebibytes));
  options.plan.resolution.max_size = size;
}

void AllLights::check(const Options& options, const Flight& flight, const Camera& camera) const {
  render::LightPool pool(lights_.lights, pool_options(options.plan));
  if (const std::string refused = refused_light(pool.plan(camera, flight.bounds()), lights_.lights);
      !refused.empty())
    throw std::runtime_error(fmt::format("{}: --scene-light all: {}", options.scene, refused));
}

void AllLights::expose(const Options& options, const Flight& flight, const Camera& camera,
                       render::Renderer& renderer, const render::PreparedFilter& filter) {
  render::LightPool pool(lights_.lights, pool_options(options.plan));
  const LightPlan& plan = pool.plan(camera, flight.bounds());
  render::FrameOptions frame;
  frame.time_passes = false;
  frame.depth_layer = options.layer;
  renderer.draw({plan, pool.drawn()}, camera, filter, frame);
  const double exposure = render::exposure_of(renderer.light_sum());
  if (exposure > 0.0) exposure_ = exposure_ > 0.0 ? std::min(exposure_, exposure) : exposure;
}

FrameRow AllLights::draw(const Options& options, const Flight& flight, const Camera& camera,
                         render::Renderer& renderer, const render::PreparedFilter& filter) const {
  render::LightPool pool(lights_.lights, pool_options(options.plan));
  const auto begin = std::chrono::steady_clock::now();
  const LightPlan& plan = pool.plan(camera, flight.bounds());
  FrameRow row;
  row.plan_ns =
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - begin).count();
  row.status = plan.status;
  render::FrameOptions frame;
  frame.depth_layer = options.layer;
  frame.prune = options.prune;
  row.stats = renderer.draw({plan, pool.drawn(exposure_ > 0.0 ? exposure_ : 1.0)}, camera, filter, frame);
  row.lights = LightCounts{plan.mapped, 0, lights_in_view(plan)};
  for (const ShadowPlan& own : pool.plans()) row.lights->maps += own.map_count;
  row.omitted = omitted_lights(plan);
  if (const std::string others = omitted_text({}, row.stats); !others.empty())
    row.omitted += (row.omitted.empty() ? "" : "; ") + others;
  return row;
}

LightsDrawn AllLights::drawn(const std::vector<FrameRow>& rows) const {
  std::vector<char> in_view(lights_.lights.size(), 0);
  for (const FrameRow& row : rows)
    for (std::size_t i = 0; i < in_view.size(); ++i)
      in_view[i] = std::max(in_view[i], row.lights->in_view[i]);
  return lights_drawn(lights_, in_view);
}

}  // namespace gnomon::tool::fly
