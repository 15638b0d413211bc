// Draws one state of the viewer to a picture: the same with a window and without.
#include "stage.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "float_channel.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/render/error.hpp"
#include "gnomon/render/picture.hpp"
#include "gnomon/render/probe.hpp"
#include "gnomon/study/expected_error.hpp"
#include "gnomon/study/technique.hpp"
#include "level_picture.hpp"
#include "lines.hpp"
#include "page_aliasing.hpp"
#include "plan_option.hpp"
#include "refusals.hpp"

namespace gnomon::tool::view {
namespace {

using Clock = std::chrono::steady_clock;

/// Over which the curve of m is measured: a thousandth of a second, and steady to a few percent.
constexpr MeasureOptions kCoarse{24, 24, 16};

render::FrameOptions frame_options(const State& state, const Settings& settings, const Light& light) {
  render::FrameOptions frame;
  frame.transition = settings.transition;
  frame.depth_layer = settings.layer;
  frame.linear_depth = settings.linear_depth;
  frame.map_passes = settings.map_passes;
  frame.light = &light;
  frame.prune = settings.plan.prune;
  frame.aliasing = frame.heat_map = state.view == View::heat;
  frame.cascade_tint = state.view == View::cascades;
  return frame;
}

VisibleDepths visible_depths(render::Renderer& renderer, const Camera& camera) {
  render::FrameOptions surfaces;
  surfaces.aliasing = surfaces.heat_map = surfaces.cascade_tint = surfaces.time_passes = false;
  renderer.draw(ShadowPlan{}, camera, renderer.prepare(render::filters::hard), surfaces);
  const FloatImage positions = renderer.positions();
  VisibleDepths depths;
  for (std::size_t i = 3; i < positions.values.size(); i += 4)
    depths.add(static_cast<double>(positions.values[i]));
  return depths;
}

/// The name of what a side compiles.
std::string program_text(const Settings& settings, bool all_lights) {
  return (all_lights ? "lights " : settings.pages.on() ? "pages " : "") + filter_text(settings);
}

}  // namespace

const ShadowMap* Side::map_of(int index) const noexcept {
  if (pages) return pages->level_of(index);
  return index >= 0 && index < plan.map_count ? &plan.map[static_cast<std::size_t>(index)] : nullptr;
}

int Side::picture_count() const noexcept {
  return pages ? static_cast<int>(pages->plan().levels.size()) : plan.map_count;
}

Stage::Stage(std::shared_ptr<const Loaded> loaded)
    : loaded_(std::move(loaded)),
      renderer_(loaded_->scene),
      posed_(std::shared_ptr<const Scene>(loaded_, &loaded_->scene), loaded_->boxes) {
  if (loaded_->parted) renderer_.add_panes(loaded_->panes);
}

void Stage::cut() noexcept {
  for (Side& side : sides_) side.history.clear();
}

bool Stage::is_compiled(const Settings& settings, bool all_lights) const {
  return std::find(compiled_.begin(), compiled_.end(), program_text(settings, all_lights)) != compiled_.end();
}

render::PreparedFilter Stage::prepare(const Settings& settings, bool all_lights) {
  if (!is_compiled(settings, all_lights)) compiled_.push_back(program_text(settings, all_lights));
  using render::Source;
  if (settings.identifiers)
    return renderer_.prepare(render::filters::hard, Source::identifiers(*settings.identifiers));
  return renderer_.prepare(settings.filter, all_lights            ? Source::lights
                                            : settings.pages.on() ? Source::pages
                                                                  : Source::maps);
}

bool Stage::compile_ahead(bool by_pages) {
  for (const render::Filter* filter : render::all_filters()) {
    Settings settings;
    settings.filter = render::default_settings(*filter);
    if (by_pages) settings.pages.policy = &page_policies::resolution;
    if (is_compiled(settings) ||
        (by_pages &&
         no_pages(settings.filter, plan_options_of(settings), settings.pages.page_texels).has_value()))
      continue;
    (void)prepare(settings);
    return true;
  }
  return false;
}

double Stage::time_frame(const State& state, Timed what) {
  render::FrameOptions frame = frame_options(state, state.a, light_);
  frame.prune = prune_rules_of(PruneSource::this_frame);
  frame.aliasing = frame.heat_map = frame.cascade_tint = false;
  render::FrameStats stats;
  double plan_ms = sides_[0].plan_ms;
  if (what == Timed::baseline) {
    PlanOptions options;
    options.cascades = 1;
    options.warp.warp = &warps::none;
    options.resolution.max_size = state.a.plan.resolution.max_size;
    options.prune = options.prune.without(PruneRule::metric_resolution);
    frame.depth_layer = render::DepthLayer::front;
    frame.linear_depth = false;
    frame.map_passes = render::MapPasses::automatic;
    const auto begin = Clock::now();
    const ShadowPlan plan = make_plan(camera_, light_, posed_.bounds(), options);
    plan_ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    stats = renderer_.draw(plan, camera_, renderer_.prepare(render::filters::hard), frame);
  } else if (sides_[0].lights) {
    const render::LightPool& pool = *sides_[0].lights;
    stats = renderer_.draw({pool.last(), pool.drawn(exposure_)}, camera_, prepare(state.a, true), frame);
  } else if (sides_[0].pages) {
    stats = sides_[0].pages->draw(renderer_, camera_, prepare(state.a), frame);
  } else {
    stats = renderer_.draw(sides_[0].drawn, camera_, prepare(state.a), frame);
  }
  return plan_ms + stats.shadow_ms();
}

std::string Stage::plan_side(const Settings& settings, const Camera& planned, const Light& light,
                             std::shared_ptr<const VisibleSurfaces>& surfaces, Side& side) {
  const SceneBounds bounds = posed_.bounds();
  const PlanOptions options = plan_options_of(settings);
  side.pages.reset();
  side.lights.reset();
  side.plan_camera = planned;
  if (settings.pages.on()) {
    const LightKind kind = std::holds_alternative<PointLight>(light)  ? LightKind::point
                           : std::holds_alternative<SpotLight>(light) ? LightKind::spot
                                                                      : LightKind::sun;
    if (std::string refusal = refusal_of_pages(settings); !refusal.empty()) return refusal;
    if (std::string refusal = page_refusal(settings.pages, settings.filter, options, kind); !refusal.empty())
      return refusal;
    if (surfaces == nullptr)
      surfaces = std::make_shared<const VisibleSurfaces>(draw_surfaces(renderer_, planned, settings.layer));
    side.pages = std::make_shared<FramePages>(
        PageFrameInput{light, bounds, page_options_of(settings.pages, options)}, surfaces);
    side.plan = {};
    side.history.clear();
    const PagePlan& plan = side.pages->plan();
    return plan.status == PlanStatus::invalid_input ? invalid_input_text(plan.invalid_field) : std::string();
  }
  const bool panes = !loaded_->panes.instances.empty();
  if (panes && !options.warp.shape->affine)
    return fmt::format("no panes with shape {}: its maps bend lines", options.warp.shape->name);
  if (std::string refusal = memory_refusal(options, settings, panes); !refusal.empty()) return refusal;
  const VisibleDepths depths = settings.visible_depths ? visible_depths(renderer_, planned) : VisibleDepths{};
  const VisibleDepths* seen = settings.visible_depths ? &depths : nullptr;
  const auto begin = Clock::now();
  const bool keeps = settings.history || needs_history(options.fit);
  side.plan = make_plan({planned, seen}, light, bounds, options, keeps ? &side.history : nullptr);
  side.plan_ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  if (side.plan.status == PlanStatus::invalid_input) return invalid_input_text(side.plan.invalid_field);
  side.m = measure(side.plan, planned, bounds, kCoarse);
  return {};
}

std::string Stage::plan_lights_of(const State& state, const Settings& settings, const Camera& camera,
                                  Side& side) {
  if (std::string refusal = refusal_of_all_lights(state, settings); !refusal.empty()) return refusal;
  const FileLights lights = file_lights(loaded_->scene);
  const PlanOptions options = plan_options_of(settings);
  if (std::string refusal = memory_refusal(options, settings, !loaded_->panes.instances.empty());
      !refusal.empty())
    return refusal;
  side = {};
  side.plan_camera = camera;
  side.lights = std::make_shared<render::LightPool>(lights.lights, pool_options(options));
  const auto begin = Clock::now();
  const LightPlan& plan = side.lights->plan(camera, posed_.bounds());
  side.plan_ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  side.lights_drawn = lights_drawn(lights, lights_in_view(plan));
  return refused_light(plan, side.lights->lights());
}

Light Stage::held_light(const State& state, const Camera& camera,
                        std::shared_ptr<const VisibleSurfaces>& surfaces) {
  Light light = light_of(state.light, loaded_->scene.bounds_world);
  auto* const sun = std::get_if<DirectionalLight>(&light);
  const bool holds = sun != nullptr && state.motion.hold_sun_pixels > 0.0;
  if (holds && held_sun_ != glm::dvec3(0.0) && sun->direction != held_sun_) {
    if (surfaces == nullptr)
      surfaces = std::make_shared<const VisibleSurfaces>(draw_surfaces(renderer_, camera, state.a.layer));
    Box casters;
    for (const Box& box : posed_.boxes()) casters.extend(box);
    const gnomon::View view{
        .camera = camera, .points_world = surfaces->points, .normals_world = surfaces->normals};
    sun->direction =
        hold_sun(view, held_sun_, sun->direction, casters, state.motion.hold_sun_pixels).direction;
  }
  held_sun_ = holds ? sun->direction : glm::dvec3(0.0);
  return light;
}

std::string Stage::make_plans(const State& state, int width, int height) {
  const Camera eye = eye_camera(state, loaded_->path, posed_.boxes(), width, height);
  const Camera planned = state.frozen ? frozen_camera(state, loaded_->path, width, height) : eye;
  std::shared_ptr<const VisibleSurfaces> surfaces;
  const bool all = state.light.all;
  const Light light = all ? light_ : held_light(state, planned, surfaces);
  const bool both = state.comparison != Comparison::off && !state.b_is_truth;
  std::array<Side, 2> next = sides_;
  for (int i = 0; i < (both ? 2 : 1); ++i) {
    const Settings& settings = i == 0 ? state.a : state.b;
    Side& side = next[static_cast<std::size_t>(i)];
    std::string refusal = all ? plan_lights_of(state, settings, planned, side)
                              : plan_side(settings, planned, light, surfaces, side);
    if (!refusal.empty()) return refusal;
    side.drawn = state.frozen ? from_frozen(side.plan, planned, eye) : side.plan;
    // Throws where a shader does not compile: before anything of the last picture is gone.
    (void)prepare(settings, all);
  }
  sides_ = next;
  camera_ = eye;
  light_ = light;
  return {};
}

std::string Stage::draw(const State& state, int width, int height, bool settled) try {
  bool moved = false;
  if (std::string refusal = posed_.follow(state.playing, renderer_, moved); !refusal.empty()) return refusal;
  if (moved) truth_.stop();
  posed_.take_tracer(false);
  if (settled) posed_.begin_tracer();
  const Side before = counts_flips_ ? sides_[0] : Side();
  const std::string light_before = light_text(light_);
  if (std::string refusal = make_plans(state, width, height); !refusal.empty()) return refusal;
  unfinished_ = false;
  for (Canvas* canvas : {&canvas_, &canvas_a_, &canvas_b_}) canvas->resize(width, height);
  wants_truth_ =
      !state.light.all && (state.view == View::misclassified || state.view == View::truth || counts_errors_ ||
                           (state.comparison != Comparison::off && state.b_is_truth));
  if (!wants_truth_) truth_.stop();
  std::optional<FloatImage> mask_before;
  if (!moved && light_before == light_text(light_)) mask_before = mask_of_plan_before(state, before);
  draw_side(state, state.a, sides_[0], canvas_a_, settled);
  sides_[0].flips.reset();
  if (mask_before) sides_[0].flips = flips_between(*mask_before, renderer_.mask());
  if (state.comparison != Comparison::off) {
    if (state.b_is_truth) {
      canvas_b_.put(truth_picture(width, height, truth_.verdicts(), renderer_.normals()), 0, 0);
    } else {
      draw_side(state, state.b, sides_[1], canvas_b_, settled);
    }
  }
  compose(state);
  render::check_context();
  return {};
} catch (const std::runtime_error& error) {
  return error.what();
}

std::optional<FloatImage> Stage::mask_of_plan_before(const State& state, const Side& before) {
  if (!counts_flips_ || before.plan.map_count == 0 || before.pages || sides_[0].pages || state.frozen)
    return {};
  render::FrameOptions frame = frame_options(state, state.a, light_);
  frame.aliasing = frame.heat_map = frame.cascade_tint = false;
  renderer_.draw(from_frozen(before.plan, before.plan_camera, camera_), camera_, prepare(state.a), frame);
  return renderer_.mask();
}

void Stage::draw_lights(const State& state, const Settings& settings, Side& side) {
  const render::LightPool& pool = *side.lights;
  const render::PreparedFilter filter = prepare(settings, true);
  render::FrameOptions frame = frame_options(state, settings, light_);
  frame.light = nullptr;
  const auto draw = [&] {
    const double exposure = exposure_ > 0.0 ? exposure_ : 1.0;
    side.stats = renderer_.draw({pool.last(), pool.drawn(exposure)}, camera_, filter, frame);
  };
  draw();
  // The first picture with light in it says how bright all of them are.
  if (exposure_ > 0.0) return;
  exposure_ = render::exposure_of(renderer_.light_sum());
  if (exposure_ > 0.0) draw();
}

void Stage::draw_pages(const State& state, const Settings& settings, Side& side, bool settled) {
  const render::PreparedFilter filter = prepare(settings);
  render::FrameOptions frame = frame_options(state, settings, light_);
  // The renderer draws these pictures of maps alone; those of pages are made of the mask.
  frame.aliasing = frame.heat_map = frame.cascade_tint = false;
  const double map_ms = side.pages->refine(renderer_, filter, frame, settled ? FramePages::kMaxRounds : 1);
  unfinished_ = unfinished_ || (!settled && side.pages->wants_rounds());
  side.plan_ms = side.pages->plan_ms();
  side.m = side.pages->measure().m;
  if (state.frozen) side.pages->rebase_to(camera_.position);
  side.stats = side.pages->draw(renderer_, camera_, filter, frame);
  side.stats.milliseconds[static_cast<std::size_t>(render::Pass::shadow_maps)] += map_ms;
}

Image Stage::side_legend(const State& state, const Side& side) const {
  if (!side.pages) {
    if (state.view != View::kept) return legend(state.view, side.plan, camera_.width);
    const LegendText text = cached_legend(served_by(side.stats), "maps");
    return field_legend(text.title, text.fields, camera_.width);
  }
  const int level = std::clamp(state.map, 0, std::max(side.picture_count() - 1, 0));
  return page_legend(state.view, side.pages->plan(), side.pages->drawn(), static_cast<std::size_t>(level),
                     camera_.width);
}

void Stage::draw_side(const State& state, const Settings& settings, Side& side, Canvas& canvas,
                      bool settled) {
  if (side.lights) {
    draw_lights(state, settings, side);
  } else if (side.pages) {
    draw_pages(state, settings, side, settled);
  } else {
    side.stats =
        renderer_.draw(side.drawn, camera_, prepare(settings), frame_options(state, settings, light_));
  }
  side.errors.reset();
  side.expected_wrong.reset();
  if (wants_truth_) want_truth(settled);
  if (wants_truth_ && truth_.done()) {
    const FloatImage mask = renderer_.mask();
    side.errors = errors_of(mask, truth_.verdicts());
    const FloatImage positions = renderer_.positions();
    const std::vector<float> depths = channel(positions, static_cast<std::size_t>(positions.channels) - 1);
    const std::vector<float> lit = lit_of(truth_.verdicts(), depths.size());
    const std::vector<glm::vec3> normals = vectors_of(renderer_.normals());
    const ShadowPicture shadow{camera_, lit, depths, {}, normals, truth_.occluders()};
    const int every = pixels_between(shadow);
    side.expected_wrong = (side.pages ? expected_error(side.pages->plan(), shadow, 0.0, every)
                                      : expected_error(side.drawn, shadow, 0.0, every))
                              .share();
  }
  draw_view(state, side, canvas);
  if (state.frozen && state.view != View::map) {
    const Box& scene = loaded_->scene.bounds_world;
    canvas.draw(on_screen(side.pages
                              ? page_lines(side.pages->plan(), side.plan_camera, posed_.boxes(), state.drawn)
                              : plan_lines(side.plan, side.plan_camera, posed_.boxes(), scene, state.drawn),
                          camera_));
  }
  if (const Image image = side_legend(state, side); image.width > 0)
    canvas.put(image, 0, camera_.height - image.height);
}

void Stage::want_truth(bool settled) {
  if (truth_.is_of(camera_, light_)) return;
  truth_.stop();
  if (!settled || posed_.tracer() == nullptr) return;
  truth_.begin(posed_.tracer(), camera_, light_, renderer_.positions(), renderer_.normals());
}

void Stage::draw_view(const State& state, Side& side, Canvas& canvas) {
  using Picture = render::Renderer::Picture;
  switch (state.view) {
    case View::lit:
      return renderer_.copy(Picture::lit, canvas.framebuffer());
    case View::heat: {
      if (!side.pages) return renderer_.copy(Picture::heat_map, canvas.framebuffer());
      const PageFrameImages images{renderer_.mask(), renderer_.positions(), renderer_.normals()};
      const PagePlan& plan = side.pages->plan();
      return canvas.put(page_heat_map(plan, page_aliasing(plan, camera_, images), images), 0, 0);
    }
    case View::cascades:
      if (!side.pages) return renderer_.copy(Picture::cascade_tint, canvas.framebuffer());
      return canvas.put(
          level_picture(renderer_.image(), renderer_.mask(), renderer_.normals(), side.pages->plan()), 0, 0);
    case View::kept:
      return canvas.put(cached_picture(renderer_.mask(), renderer_.normals(),
                                       side.pages ? served_by(side.pages->plan(), side.pages->drawn())
                                                  : served_by(side.stats)),
                        0, 0);
    case View::mask:
      return canvas.put(mask_picture(renderer_.mask(), renderer_.normals()), 0, 0);
    case View::misclassified: {
      const FloatImage mask = renderer_.mask();
      const auto verdicts = truth_.verdicts();
      return canvas.put(misclassified_picture(mask, verdicts, renderer_.normals()), 0, 0);
    }
    case View::truth:
      return canvas.put(truth_picture(camera_.width, camera_.height, truth_.verdicts(), renderer_.normals()),
                        0, 0);
    case View::checker:
      return canvas.put(checker_picture(
                            renderer_.image(), renderer_.mask(), renderer_.positions(),
                            [&side](int index) { return side.map_of(index); }, camera_),
                        0, 0);
    case View::map:
      return draw_map_view(state, side, canvas);
  }
}

void Stage::draw_map_view(const State& state, Side& side, Canvas& canvas) {
  const int count = side.picture_count(), map = std::min(state.map, count - 1);
  if (count == 0) return canvas.put(render::blank_image(camera_.width, camera_.height, {24, 24, 28}), 0, 0);
  const MapPicture picture =
      side.pages ? level_map_picture(
                       side.pages->plan(), static_cast<std::size_t>(map), side.pages->drawn(),
                       [this](std::size_t page) { return renderer_.page_depths(page); }, camera_.width,
                       camera_.height)
                 : map_picture(renderer_.depth_map(map), side.plan, map, side.plan_camera,
                               loaded_->scene.bounds_world, posed_.boxes(), camera_.width, camera_.height);
  canvas.put(picture.image, 0, 0);
  canvas.draw(picture.lines);
}

namespace {

/// What the corner of a side says: its filter, warp and maps.
std::string side_text(const char* name, const Settings& settings, const Side& side) {
  if (side.pages)
    return fmt::format("{}: {} pages of {}, {}, {}", name, side.stats.pages, settings.pages.page_texels,
                       settings.pages.policy->name, render::to_string(settings.filter));
  if (side.lights)
    return fmt::format("{}: {} lights with maps, {}", name, side.lights->last().mapped,
                       filter_text(settings));
  std::string text =
      fmt::format("{}: {} map{} of {}, {}", name, side.plan.map_count, side.plan.map_count == 1 ? "" : "s",
                  settings.plan.resolution.max_size, filter_text(settings));
  if (side.plan.map_count > 0) text += fmt::format(", warp {}", side.plan.map[0].warp->name);
  return text;
}

}  // namespace

void Stage::compose(const State& state) {
  const int width = camera_.width;
  if (state.comparison == Comparison::off) return canvas_.take(canvas_a_, 0, width);
  if (state.comparison == Comparison::difference) {
    canvas_.put(difference_picture(canvas_a_.image(), canvas_b_.image(), state.gain), 0, 0);
    return canvas_.put(
        label(fmt::format("difference x {:.3g}: orange A lighter, blue B lighter", state.gain)), 0, 0);
  }
  const int line = static_cast<int>(std::lround(std::clamp(state.wipe, 0.0, 1.0) * width));
  canvas_.take(canvas_a_, 0, line);
  canvas_.take(canvas_b_, line, width);
  const double x = line;
  const ScreenLine wipe{{x, 0.0}, {x, 1.0 * camera_.height}, {240, 228, 66, 255}, 2.0};
  canvas_.draw({&wipe, 1});
  const Image a = label(side_text("A", state.a, sides_[0])),
              b = label(state.b_is_truth ? "B: exact rays" : side_text("B", state.b, sides_[1]));
  canvas_.put(a, 0, 0);
  // Below A's where the picture is too narrow for both.
  canvas_.put(b, std::max(width - b.width, 0), a.width + b.width <= width ? 0 : a.height);
}

void Stage::finish_truth(const std::function<void(int rows, int of)>& seen) {
  posed_.take_tracer(true);
  if (!wants_truth_) return;
  if (!truth_.is_of(camera_, light_))
    truth_.begin(posed_.tracer(), camera_, light_, renderer_.positions(), renderer_.normals());
  while (seen && !truth_.done()) {
    constexpr std::chrono::milliseconds kPause{20};
    seen(truth_.rows(), camera_.height);
    std::this_thread::sleep_for(kPause);
  }
  truth_.finish();
}

std::optional<std::array<int, 2>> Stage::truth_progress() const {
  if (!wants_truth_) return {};
  return std::array<int, 2>{truth_.rows(), camera_.height};
}

}  // namespace gnomon::tool::view
