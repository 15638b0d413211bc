// The headless flight: plan, draw, measure, write.
#include "flight.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <system_error>

#include "frame_plan.hpp"
#include "gnomon/render/filter.hpp"
#include "gnomon/render/picture.hpp"
#include "gnomon/render/probe.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/scene/load.hpp"
#include "interrupt.hpp"
#include "progress.hpp"
#include "report.hpp"

namespace flythrough {
namespace {

using gnomon::Image;

constexpr int kPlanRepeats = 5;  ///< the time of a plan is the median over these

struct TimedPlan {
  gnomon::ShadowPlan plan;
  std::int64_t nanoseconds = 0;
};

/// `history` is taken one frame further, where the options ask for one.
TimedPlan timed_plan(const Options& options, const Flight& flight, const gnomon::Light& light,
                     const gnomon::Camera& camera, const gnomon::PlanOptions& plan,
                     gnomon::PlanHistory& history) {
  TimedPlan result;
  std::array<std::int64_t, kPlanRepeats> taken{};
  gnomon::PlanHistory next;
  for (std::int64_t& ns : taken) {
    next = history;
    const auto begin = std::chrono::steady_clock::now();
    result.plan = plan_frame(options, flight, light, camera, plan, next);
    ns = std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - begin)
             .count();
  }
  std::nth_element(taken.begin(), taken.begin() + kPlanRepeats / 2, taken.end());
  result.nanoseconds = taken[kPlanRepeats / 2];
  history = next;
  return result;
}

void label_cascades(Image& image, const gnomon::ShadowPlan& plan) {
  std::array<std::string, gnomon::kMaxMaps> text;
  std::array<gnomon::render::LegendEntry, gnomon::kMaxMaps> entries{};
  for (std::size_t i = 0; i < plan.maps().size(); ++i) {
    const gnomon::ShadowMap& map = plan.map[i];
    text[i] = fmt::format("map {}: depth {:.4g} to {:.4g}, {}x{}, {}", i, map.depth_begin, map.depth_end,
                          map.width, map.height, map.warp->name);
    entries[i] = {gnomon::render::cascade_color(static_cast<int>(i)), text[i]};
  }
  const std::string title =
      plan.map_count > 0 ? "shadow maps" : fmt::format("no map: {}", to_string(plan.status));
  gnomon::render::draw_legend(image, title, {entries.data(), plan.maps().size()});
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder)) {
    throw UsageError(fmt::format("--out {}: cannot be made a folder ({})", folder.string(), error.message()));
  }
}

/// Everything a frame needs over the whole flight.
struct Studio {
  const Options& options;
  const Flight& flight;
  gnomon::render::Renderer renderer;
  gnomon::render::PreparedFilter filter;
  ContactSheet sheet;
  gnomon::PlanHistory history;
};

/// The frame once more under each warp that is compared, side by side.
void draw_comparison(Studio& studio, const gnomon::Camera& camera, int frame) {
  const Options& options = studio.options;
  gnomon::PlanOptions plan_options = options.plan;
  WarpStrip strip;
  for (const gnomon::Warp* warp : options.compared_warps) {
    plan_options.warp = warp;
    const gnomon::ShadowPlan plan =
        gnomon::make_plan(camera, gnomon::default_light(options.light, studio.flight.scene.bounds_world),
                          studio.flight.bounds(), plan_options);
    studio.renderer.draw(plan, camera, studio.filter, {});
    const PixelAliasing m = pixel_aliasing(studio.renderer.aliasing());
    strip.add(fmt::format("{}: m p95 {:.3g}, median {:.3g}, {:.0f} % undersampled",
                          warp == nullptr ? "auto" : warp->name, m.p95, m.p50, 100.0 * m.share_undersampled),
              studio.renderer.image(), studio.renderer.heat_map());
  }
  const std::string title = fmt::format("{}, {} map{} of {}", options.scene, plan_options.cascades,
                                        plan_options.cascades == 1 ? "" : "s", plan_options.map_size);
  gnomon::write_png(strip.strip(title), options.out / fmt::format("frame_{:04}_warps.png", frame));
}

/// Asks the maps just drawn what the filter can do without, and takes that for the frames to come: where maps
/// are new, which is after the first frame, and now and then. Reading maps back takes longer than a frame of
/// a GPU.
void save_filter_precision(Studio& studio, const gnomon::ShadowPlan& plan, int frame, FrameRow& row) {
  constexpr int kFramesBetween = 60;
  const Options& options = studio.options;
  if (!(options.filter_precision > 0.0) || frame % kFramesBetween != 0) return;
  const gnomon::render::FilterFit fit =
      gnomon::render::fit_filter(options.filter, studio.renderer.drawn_depths(options.filter, plan),
                                 {.bound = options.filter_precision / 255.0});
  studio.filter = studio.renderer.prepare(fit.settings);
  const std::string left_out = describe(fit, options.filter);
  if (!left_out.empty())
    row.omitted +=
        fmt::format("{}filter, from the next frame on: {}", row.omitted.empty() ? "" : "; ", left_out);
}

FrameRow draw_frame(Studio& studio, int frame) {
  const Options& options = studio.options;
  const gnomon::Camera camera = camera_of(options, studio.flight, frame);
  const gnomon::Light light = gnomon::default_light(options.light, studio.flight.scene.bounds_world);
  gnomon::VisibleDepths depths;
  const gnomon::PlanOptions plan_options =
      frame_options(options, studio.renderer, studio.filter, camera, depths);
  const TimedPlan timed = timed_plan(options, studio.flight, light, camera, plan_options, studio.history);
  FrameRow row;
  row.frame = frame;
  row.status = timed.plan.status;
  row.plan_ns = timed.nanoseconds;
  gnomon::render::FrameOptions drawn;
  drawn.transition = options.transition;
  drawn.light = &light;
  drawn.prune = options.prune;
  row.stats = studio.renderer.draw(timed.plan, camera, studio.filter, drawn);
  row.aliasing = pixel_aliasing(studio.renderer.aliasing());
  for (std::size_t i = 0; i < timed.plan.maps().size(); ++i)
    row.m_bound[i] = std::max(timed.plan.map[i].m_s_max, timed.plan.map[i].m_t_max);
  row.warps = warps_text(timed.plan);
  row.omitted = omitted_text(timed.plan, row.stats);
  save_filter_precision(studio, timed.plan, frame, row);

  const Image lit = studio.renderer.image();
  Image heat = studio.renderer.heat_map(), tint = studio.renderer.cascade_tint();
  if (studio.sheet.wants(frame)) studio.sheet.add(frame, lit, heat, tint);
  gnomon::render::draw_heat_legend(heat);
  label_cascades(tint, timed.plan);
  const auto file = [&](const char* kind) {
    return options.out / fmt::format("frame_{:04}_{}.png", frame, kind);
  };
  gnomon::write_png(lit, file("image"));
  gnomon::tool::check_interrupt();
  gnomon::write_png(heat, file("heat"));
  gnomon::write_png(tint, file("cascades"));
  if (!options.compared_warps.empty()) draw_comparison(studio, camera, frame);
  return row;
}

/// All frames. A flight that ends early, by Ctrl-C, a full disk or a lost context, leaves the numbers of the
/// frames that were finished.
template <class WriteNumbers>
std::vector<FrameRow> draw_frames(Studio& studio, const WriteNumbers& write_numbers) {
  std::vector<FrameRow> rows;
  try {
    Progress progress(studio.options.frames);
    for (int frame = 0; frame < studio.options.frames; ++frame) {
      gnomon::tool::check_interrupt();
      progress.show(frame, "frames");
      rows.push_back(draw_frame(studio, frame));
    }
  } catch (...) {
    try {
      if (!rows.empty()) write_numbers(rows);
    } catch (const std::exception&) {
      // The first failure is the one to report.
    }
    throw;
  }
  return rows;
}

/// Every frame's plan once, before anything is written: a flight is refused as a whole.
void check_plans(const Options& options, const Flight& flight) {
  for (int frame = 0; frame < options.frames; ++frame) {
    const gnomon::Camera camera = camera_of(options, flight, frame);
    const gnomon::ShadowPlan plan =
        gnomon::make_plan(camera, gnomon::default_light(options.light, flight.scene.bounds_world),
                          flight.bounds(), options.plan);
    if (plan.status == gnomon::PlanStatus::invalid_input) {
      throw UsageError(
          fmt::format("{}: frame {}: the plan refuses {}", options.scene, frame, plan.invalid_field));
    }
  }
}

void print_summary(const Options& options, const std::vector<FrameRow>& rows) {
  double worst_p95 = 0.0, undersampled = 0.0, milliseconds = 0.0;
  std::int64_t slowest_plan = 0;
  for (const FrameRow& row : rows) {
    worst_p95 = std::max(worst_p95, row.aliasing.p95);
    undersampled += row.aliasing.share_undersampled / static_cast<double>(rows.size());
    slowest_plan = std::max(slowest_plan, row.plan_ns);
    for (const double ms : row.stats.milliseconds) milliseconds += ms / static_cast<double>(rows.size());
  }
  fmt::print(
      "{} frames: {:.1f} ms a frame, slowest plan {:.1f} us, worst m p95 {:.3g}, {:.1f} % of pixels "
      "undersampled\n",
      rows.size(), milliseconds, static_cast<double>(slowest_plan) * 1e-3, worst_p95, undersampled * 100.0);
  fmt::print("pictures: {}\nsheet:    {}\nnumbers:  {}\n", (options.out / "frame_0000_image.png").string(),
             (options.out / "contact_sheet.png").string(), (options.out / "frames.csv").string());
}

}  // namespace

Flight load_flight(const Options& options) {
  try {
    Flight flight;
    flight.scene = gnomon::load_scene(options.scene, gnomon::limits_of_triangles(options.max_triangles));
    for (const std::string& warning : flight.scene.warnings)
      fmt::print(stderr, "flythrough: warning: {}\n", warning);
    flight.path = options.path ? gnomon::load_camera_path(*options.path) : gnomon::default_path(flight.scene);
    flight.boxes.reserve(flight.scene.instances.size());
    for (const gnomon::Instance& instance : flight.scene.instances)
      flight.boxes.push_back(instance.bounds_world);
    return flight;
  } catch (const gnomon::SceneError& error) {
    throw UsageError(error.what());
  }
}

gnomon::Camera camera_of(const Options& options, const Flight& flight, int frame) {
  const double t = options.frames == 1 ? 0.5 : 1.0 * frame / (options.frames - 1);
  return flight.path.at(t, options.width, options.height);
}

void fit_maps_to_memory(Options& options) {
  const int wanted = options.plan.map_size;
  const gnomon::render::FittingMaps fitting = gnomon::render::largest_maps(
      wanted, options.plan.cascades, gnomon::render::bytes_per_texel(options.filter), options.map_memory_mib);
  if (fitting.size == 0)
    throw UsageError(fmt::format("--map-size {}: no map fits ({})", wanted, fitting.why));
  if (fitting.size < wanted)
    fmt::print(stderr, "flythrough: warning: maps of {} do not fit ({}): maps of {}, {:.4g} MiB\n", wanted,
               fitting.why, fitting.size, fitting.mebibytes);
  options.plan.map_size = fitting.size;
}

int fly_to_files(const Options& asked, const Flight& flight) {
  Options options = asked;
  const auto context = [&options] {
    try {
      return gnomon::render::create_context(options.context);
    } catch (const gnomon::render::RenderError& error) {
      throw UsageError(fmt::format("--context {}: {}", to_string(options.context), error.what()));
    }
  }();
  fmt::print("context:  {}\n", context->info().description());
  constexpr double kMebi = 1024.0 * 1024.0;
  fmt::print("scene:    {}, {} instances, {} triangles, {:.4g} MiB\n", flight.scene.name,
             flight.scene.instances.size(), flight.scene.triangle_count(),
             static_cast<double>(flight.scene.bytes()) / kMebi);
  fit_maps_to_memory(options);
  check_plans(options, flight);
  make_folder(options.out);
  gnomon::tool::watch_interrupts();
  Studio studio{options,
                flight,
                gnomon::render::Renderer(flight.scene),
                {},
                ContactSheet(options.frames, options.width, options.height),
                {}};
  studio.filter = studio.renderer.prepare(options.filter);
  const auto write_numbers = [&](const std::vector<FrameRow>& rows) {
    write_csv(rows, options.plan.cascades, context->info().software, options.out / "frames.csv");
  };
  const std::vector<FrameRow> rows = draw_frames(studio, write_numbers);
  const std::string title = fmt::format(
      "{}: {} maps of {}, {}{}", options.scene, options.plan.cascades, options.plan.map_size,
      gnomon::render::to_string(options.filter),
      options.plan.fit == gnomon::Fit::tight ? "" : fmt::format(", {}", to_string(options.plan.fit)));
  gnomon::write_png(studio.sheet.sheet(title), options.out / "contact_sheet.png");
  write_numbers(rows);
  print_summary(options, rows);
  return 0;
}

}  // namespace flythrough
