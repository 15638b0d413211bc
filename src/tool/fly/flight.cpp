// The headless flight: plan, draw, measure, write.
#include "flight.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "animation_words.hpp"
#include "command.hpp"
#include "edit_words.hpp"
#include "float_channel.hpp"
#include "frame_plan.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "gnomon/render/filter.hpp"
#include "gnomon/render/picture.hpp"
#include "gnomon/render/probe.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/scene/load.hpp"
#include "interrupt.hpp"
#include "lights_frame.hpp"
#include "output.hpp"
#include "page_frame.hpp"
#include "plan_option.hpp"
#include "printed.hpp"
#include "progress.hpp"
#include "report.hpp"
#include "scene_words.hpp"

namespace gnomon::tool::fly {
namespace {

constexpr int kPlanRepeats = 5;  ///< the time of a plan is the median over these

struct TimedPlan {
  ShadowPlan plan;
  std::int64_t nanoseconds = 0;
};

/// `history` is taken one frame further, where the options ask for one.
TimedPlan timed_plan(const Options& options, const Flight& flight, const Light& light, const Camera& camera,
                     const VisibleDepths& depths, PlanHistory& history) {
  TimedPlan result;
  std::array<std::int64_t, kPlanRepeats> taken{};
  PlanHistory next;
  for (std::int64_t& ns : taken) {
    next = history;
    const auto begin = std::chrono::steady_clock::now();
    result.plan = plan_frame(options, flight, light, camera, depths, next);
    ns = std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - begin)
             .count();
  }
  std::nth_element(taken.begin(), taken.begin() + kPlanRepeats / 2, taken.end());
  result.nanoseconds = taken[kPlanRepeats / 2];
  history = next;
  return result;
}

void label_cascades(Image& image, const ShadowPlan& plan) {
  std::array<std::string, kMaxMaps> text;
  std::array<render::LegendEntry, kMaxMaps> entries{};
  for (std::size_t i = 0; i < plan.maps().size(); ++i) {
    const ShadowMap& map = plan.map[i];
    text[i] = fmt::format("map {}: depth {:.4g} to {:.4g}, {}x{}, {}", i, map.depth_begin, map.depth_end,
                          map.width, map.height, map.warp->name);
    entries[i] = {render::cascade_color(static_cast<int>(i)), text[i]};
  }
  const std::string title =
      plan.map_count > 0 ? "shadow maps" : fmt::format("no map: {}", to_string(plan.status));
  render::draw_legend(image, title, {entries.data(), plan.maps().size()});
}

void draw_legend_text(Image& image, const LegendText& legend) {
  std::vector<render::LegendEntry> entries;
  for (const auto& [color, text] : legend.fields) entries.push_back({color, text});
  render::draw_legend(image, legend.title, entries);
}

/// Everything a frame needs over the whole flight.
struct Studio {
  const Options& options;
  Flight& flight;
  render::Renderer renderer;
  render::PreparedFilter filter;
  ContactSheet sheet;
  PlanHistory history;
  std::optional<AllLights> lights;
};

/// The frame once more under each warp that is compared, side by side.
void draw_comparison(Studio& studio, const Camera& camera, int frame) {
  const Options& options = studio.options;
  PlanOptions plan_options = options.plan;
  WarpStrip strip;
  for (const Warp* warp : options.compared_warps) {
    plan_options.warp.warp = warp;
    const ShadowPlan plan =
        make_plan(camera, light_of(options, studio.flight.scene), studio.flight.bounds(), plan_options);
    studio.renderer.draw(plan, camera, studio.filter, {});
    const report::PixelAliasing m = pixel_aliasing(studio.renderer.aliasing());
    strip.add(fmt::format("{}: m p95 {:.3g}, median {:.3g}, {:.0f} % undersampled",
                          warp == nullptr ? "auto" : warp->name, m.p95, m.p50, 100.0 * m.share_undersampled),
              studio.renderer.image(), studio.renderer.heat_map());
  }
  const std::string title =
      fmt::format("{}, {} map{} of {}", options.scene, plan_options.cascades,
                  plan_options.cascades == 1 ? "" : "s", plan_options.resolution.max_size);
  write_png(strip.strip(title), options.out / fmt::format("frame_{:04}_warps.png", frame));
}

/// Asks the maps just drawn what the filter can do without, and takes that for the frames to come: where maps
/// are new, which is after the first frame, and now and then. Reading maps back takes longer than a frame of
/// a GPU.
void save_filter_precision(Studio& studio, const ShadowPlan& plan, int frame, FrameRow& row) {
  constexpr int kFramesBetween = 60;
  const Options& options = studio.options;
  if (!(options.filter_precision > 0.0) || frame % kFramesBetween != 0) return;
  const render::FilterFit fit =
      render::fit_filter(options.filter, studio.renderer.drawn_depths(options.filter, plan),
                         {.bound = options.filter_precision / 255.0});
  studio.filter = studio.renderer.prepare(fit.settings);
  const std::string left_out = describe(fit, options.filter);
  if (!left_out.empty())
    row.omitted +=
        fmt::format("{}filter, from the next frame on: {}", row.omitted.empty() ? "" : "; ", left_out);
}

/// The shadow of the frame drawn last, to lay over a picture: `over` in any program darkens by what light is
/// missing.
void write_shadow(const Studio& studio, int frame) {
  const FloatImage mask = studio.renderer.mask();
  Image shadow = render::blank_image(mask.width, mask.height, {0, 0, 0});
  const std::vector<float> lit = channel(mask, 0);
  for (std::size_t i = 0; i < lit.size(); ++i)
    shadow.rgba[4 * i + 3] =
        static_cast<std::uint8_t>(std::lround(255.0f * (1.0f - std::clamp(lit[i], 0.0f, 1.0f))));
  const std::vector<std::uint8_t> bytes = encode_png(shadow);
  write_file(studio.options.out / fmt::format("frame_{:04}_shadow.png", frame),
             {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

FrameRow draw_page_frame(Studio& studio, int frame) {
  const Options& options = studio.options;
  DrawnPages drawn = draw_with_pages(options, studio.flight, camera_of(options, studio.flight, frame),
                                     light_of(options, studio.flight.scene), studio.renderer, studio.filter);
  drawn.row.frame = frame;
  if (options.shadow_only) {
    write_shadow(studio, frame);
    return drawn.row;
  }
  if (studio.sheet.wants(frame)) studio.sheet.add(frame, {&drawn.lit, &drawn.heat, &drawn.levels});
  render::draw_heat_legend(drawn.heat);
  draw_legend_text(drawn.levels, drawn.level_text);
  draw_legend_text(drawn.cached, drawn.cached_text);
  const auto write = [&](const char* kind, const Image& image) {
    write_png(image, options.out / fmt::format("frame_{:04}_{}.png", frame, kind));
    check_interrupt();
  };
  write("image", drawn.lit);
  write("heat", drawn.heat);
  write("levels", drawn.levels);
  write("kept", drawn.cached);
  return drawn.row;
}

FrameRow draw_lights_frame(Studio& studio, int frame) {
  const Options& options = studio.options;
  FrameRow row = studio.lights->draw(options, studio.flight, camera_of(options, studio.flight, frame),
                                     studio.renderer, studio.filter);
  row.frame = frame;
  const Image lit = studio.renderer.image();
  if (studio.sheet.wants(frame)) studio.sheet.add(frame, {&lit});
  write_png(lit, options.out / fmt::format("frame_{:04}_image.png", frame));
  return row;
}

/// The exposure is that of the frames on the contact sheet, the same for all.
void expose(Studio& studio) {
  const Options& options = studio.options;
  for (int frame = 0; frame < options.frames; ++frame) {
    if (!studio.sheet.wants(frame)) continue;
    check_interrupt();
    pose_frame(options, studio.flight, frame, &studio.renderer);
    studio.lights->expose(options, studio.flight, camera_of(options, studio.flight, frame), studio.renderer,
                          studio.filter);
  }
}

FrameRow draw_frame(Studio& studio, int frame) {
  const Options& options = studio.options;
  pose_frame(options, studio.flight, frame, &studio.renderer);
  if (options.pages.on()) return draw_page_frame(studio, frame);
  if (studio.lights) return draw_lights_frame(studio, frame);
  const Camera camera = camera_of(options, studio.flight, frame);
  const Light light = light_of(options, studio.flight.scene);
  const VisibleDepths depths = frame_depths(options, studio.flight, studio.renderer, studio.filter, camera);
  const TimedPlan timed = timed_plan(options, studio.flight, light, camera, depths, studio.history);
  FrameRow row;
  row.frame = frame;
  row.status = timed.plan.status;
  row.plan_ns = timed.nanoseconds;
  render::FrameOptions drawn;
  drawn.transition = options.transition;
  drawn.depth_layer = options.layer;
  drawn.map_passes = options.map_passes;
  drawn.light = &light;
  drawn.prune = options.prune;
  row.stats = studio.renderer.draw(timed.plan, camera, studio.filter, drawn);
  row.aliasing = pixel_aliasing(studio.renderer.aliasing());
  for (std::size_t i = 0; i < timed.plan.maps().size(); ++i)
    row.m_bound[i] = std::max(timed.plan.map[i].m_s_max, timed.plan.map[i].m_t_max);
  row.warps = warps_text(timed.plan);
  row.omitted = omitted_text(timed.plan.omitted(), row.stats);
  save_filter_precision(studio, timed.plan, frame, row);
  if (options.shadow_only) {
    write_shadow(studio, frame);
    return row;
  }

  const Image lit = studio.renderer.image();
  Image heat = studio.renderer.heat_map(), tint = studio.renderer.cascade_tint();
  if (studio.sheet.wants(frame)) studio.sheet.add(frame, {&lit, &heat, &tint});
  render::draw_heat_legend(heat);
  label_cascades(tint, timed.plan);
  const auto file = [&](const char* kind) {
    return options.out / fmt::format("frame_{:04}_{}.png", frame, kind);
  };
  write_png(lit, file("image"));
  check_interrupt();
  write_png(heat, file("heat"));
  write_png(tint, file("cascades"));
  if (!options.compared_warps.empty()) draw_comparison(studio, camera, frame);
  return row;
}

/// Every frame's plan once, before anything is written: a flight is refused as a whole.
void check_plans(const Options& options, Flight& flight, const std::optional<AllLights>& lights) {
  for (int frame = 0; frame < options.frames; ++frame) {
    const Camera camera = camera_of(options, flight, frame);
    pose_frame(options, flight, frame, nullptr);
    if (lights) {
      lights->check(options, flight, camera);
      continue;
    }
    const ShadowPlan plan = make_plan(camera, light_of(options, flight.scene), flight.bounds(), options.plan);
    if (plan.status == PlanStatus::invalid_input) {
      throw std::runtime_error(
          fmt::format("{}: frame {}: {}", options.scene, frame, invalid_input_text(plan.invalid_field)));
    }
  }
}

}  // namespace

Flight load_flight(Options& options) {
  try {
    Flight flight;
    flight.scene = load_edited(options.scene, limits_of_triangles(options.max_triangles), options.edits);
    warn_of(flight.scene);
    fit_picture(options.camera, flight.scene, options.size_given, options.width, options.height);
    flight.path = camera_path(options.camera, flight.scene, 1.0 * options.width / options.height);
    if (!options.animation.empty())
      flight.animation = animation_of(options.scene, flight.scene.motion, options.animation);
    flight.boxes = ShadowBoxes(flight.scene);
    return flight;
  } catch (const SceneError& error) {
    throw std::runtime_error(error.what());
  }
}

void pose_flight(const Options& options, Flight& flight, double seconds, render::Renderer* renderer) {
  if (flight.animation == kRestPose) return;
  const Animation& animation = flight.scene.motion.animations[static_cast<std::size_t>(flight.animation)];
  const double time_s = looped_time(animation, options.animation_start + seconds);
  (void)pose(flight.scene, flight.animation, time_s, flight.pose);
  for (const PosedInstance& posed : flight.pose.instances)
    flight.boxes.place(posed.instance, posed.bounds_world);
  if (renderer != nullptr && !renderer->apply_pose(flight.pose))
    throw std::runtime_error(fmt::format("{}: the animation's pose does not fit the scene", options.scene));
}

void pose_frame(const Options& options, Flight& flight, int frame, render::Renderer* renderer) {
  pose_flight(options, flight, frame / options.animation_fps, renderer);
}

Camera camera_of(const Options& options, const Flight& flight, int frame) {
  // The end of a closed path is its beginning: the last frame stands one step before it.
  const int steps = flight.path.closed ? options.frames : options.frames - 1;
  const double t = options.frames == 1 ? 0.5 : 1.0 * frame / steps;
  return flight.path.at(t, options.width, options.height);
}

void fit_maps_to_memory(Options& options) {
  const int wanted = options.plan.resolution.max_size;
  const render::FittingMaps fitting = render::largest_maps(
      wanted, options.plan.cascades, render::bytes_per_texel(options.filter), options.map_memory_mib);
  if (fitting.size == 0)
    throw std::runtime_error(fmt::format("--map-size {}: no map fits ({})", wanted, fitting.why));
  if (fitting.size < wanted)
    warn(fmt::format("maps of {} do not fit ({}): maps of {}, {:.4g} MiB", wanted, fitting.why, fitting.size,
                     fitting.mebibytes));
  options.plan.resolution.max_size = fitting.size;
}

namespace {

/// Draws the frames, and keeps the rows of those that were drawn whatever ends the flight.
std::vector<FrameRow> draw_frames(Studio& studio, bool software) {
  const Options& options = studio.options;
  const auto write_rows = [&](const std::vector<FrameRow>& rows) {
    // The first map's columns are the sums over all pages, or over the maps of all lights.
    write_csv(rows, options.pages.on() || studio.lights ? 1 : options.plan.cascades, software,
              options.out / "frames.csv");
  };
  std::vector<FrameRow> rows;
  try {
    Progress progress(fmt::format("{} frames", program_name()), options.frames);
    for (int frame = 0; frame < options.frames; ++frame) {
      check_interrupt();
      progress.set(frame);
      rows.push_back(draw_frame(studio, frame));
    }
  } catch (...) {
    // Ctrl-C, a full disk, a lost context: the first failure is the one to report.
    try {
      if (!rows.empty()) write_rows(rows);
    } catch (const std::exception&) {
    }
    throw;
  }
  write_rows(rows);
  return rows;
}

std::string sheet_title(const Options& options) {
  if (options.pages.on())
    return fmt::format("{}: pages of {}, {}, {}, {}", options.scene, options.pages.page_texels,
                       options.pages.policy->name, render::to_string(options.filter),
                       to_string(options.plan.fit));
  if (options.all_lights())
    return fmt::format("{}: all lights of the file, {}", options.scene, render::to_string(options.filter));
  return fmt::format("{}: {} maps of {}, {}{}", options.scene, options.plan.cascades,
                     options.plan.resolution.max_size, render::to_string(options.filter),
                     options.plan.fit == Fit::tight ? "" : fmt::format(", {}", to_string(options.plan.fit)));
}

std::vector<std::string> sheet_rows(const Options& options) {
  if (options.all_lights()) return {"image"};
  return {"image", "m", options.pages.on() ? "levels" : "maps"};
}

}  // namespace

int fly_to_files(const Options& asked, Flight& flight) {
  Options options = asked;
  const auto context = [&options] {
    try {
      return render::create_context(options.context);
    } catch (const render::RenderError& error) {
      throw std::runtime_error(fmt::format("--context {}: {}", to_string(options.context), error.what()));
    }
  }();
  if (!options.json) print_scene(options, flight, context->info());
  if (options.pages.on()) {
    if (const std::string refusal =
            page_refusal(options.pages, options.filter, options.plan, options.light.kind);
        !refusal.empty())
      throw std::runtime_error(refusal);
  } else if (options.all_lights()) {
    fit_pool_to_memory(options);
  } else {
    fit_maps_to_memory(options);
  }
  std::optional<AllLights> lights;
  if (options.all_lights()) lights.emplace(flight.scene);
  check_plans(options, flight, lights);
  make_folder("--out", options.out);
  watch_interrupts();
  Studio studio{options,
                flight,
                render::Renderer(flight.scene),
                {},
                ContactSheet(options.frames, options.width, options.height, sheet_rows(options)),
                {},
                std::move(lights)};
  studio.filter = studio.renderer.prepare(options.filter, options.pages.on() ? render::Source::pages
                                                          : studio.lights    ? render::Source::lights
                                                                             : render::Source::maps);
  if (studio.lights) expose(studio);
  const std::vector<FrameRow> rows = draw_frames(studio, context->info().software);
  if (!options.shadow_only)
    write_png(studio.sheet.sheet(sheet_title(options)), options.out / "contact_sheet.png");
  if (options.json) {
    print_json(options, flight, studio.lights, context->info(), rows);
  } else {
    print_summary(options, studio.lights, rows);
  }
  return 0;
}

int run(Options options) {
  // A folder that cannot be written is found before a scene is loaded for minutes.
  check_folder("--out", options.out);
  Flight flight = load_flight(options);
  if (options.shadow_only && options.context == render::ContextKind::glfw)
    throw std::runtime_error("--shadow-only: writes pictures, and --context glfw opens a window");
  if (options.pages.on() && options.context == render::ContextKind::glfw)
    throw std::runtime_error(
        "--pages: --context glfw draws maps alone; gnomon view --pages shows pages in a window");
  if (options.budget.milliseconds > 0.0 || options.budget.target_error > 0.0)
    choose_technique_of(options, flight);
  if (options.perceptual_resolution) choose_perceptual_maps(options, flight);
  const int code = options.context == render::ContextKind::glfw ? fly_in_window(options, flight)
                                                                : fly_to_files(options, flight);
  flush_output();
  return code;
}

}  // namespace gnomon::tool::fly
