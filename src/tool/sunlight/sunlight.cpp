// `gnomon sunlight`: how many hours of sun does each surface get on a day, by exact rays?
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "camera_words.hpp"
#include "command.hpp"
#include "edit_words.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/render/picture.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/trace/reference.hpp"
#include "interrupt.hpp"
#include "offscreen_context.hpp"
#include "output.hpp"
#include "picture_colors.hpp"
#include "picture_words.hpp"
#include "progress.hpp"
#include "scene_view.hpp"
#include "scene_words.hpp"
#include "sun_words.hpp"

namespace gnomon::tool::sunlight {
namespace {

constexpr double kHour_s = 3600.0, kDay_s = 24.0 * kHour_s;

struct Request {
  std::string scene = "builtin:city", sun, out, csv;
  double step_s = 900.0;
  CameraWords camera;
  SceneEdits edits;
  int width = 960, height = 540;  ///< pixels
  std::uint64_t max_triangles = LoadLimits{}.triangles;
  render::ContextKind context = render::ContextKind::automatic;
  bool json = false;
};

/// "15min", "0.5h", or a number of minutes. Throws std::runtime_error.
double step_of(const std::string& word) {
  constexpr double kShortest_s = 60.0, kLongest_s = 2.0 * kHour_s;
  double value = 0.0;
  const char* const end = word.data() + word.size();
  const auto [unit, error] = std::from_chars(word.data(), end, value);
  const std::string_view rest(unit, static_cast<std::size_t>(end - unit));
  const double unit_s = rest == "h" ? kHour_s : rest.empty() || rest == "min" ? 60.0 : 0.0;
  if (error != std::errc{} || unit_s == 0.0 ||
      !(value * unit_s >= kShortest_s && value * unit_s <= kLongest_s))
    throw std::runtime_error("--step " + word + ": wants 1min to 2h, as in 15min");
  return value * unit_s;
}

/// What the day brings to the pixels of a picture.
struct Sunlight {
  trace::SurfacePoints points;
  std::vector<double> hours;  ///< of sun on each pixel; below 0: no surface, or none that is known
  std::vector<double> areas;  ///< of its surface, world units
  double sun_hours = 0.0;     ///< for which the sun is above the horizon
  int positions = 0;          ///< of the sun
};

/// The surface at each pixel, drawn once. All that the eye sees face a light in the eye: `facing` is known.
trace::SurfacePoints seen_surfaces(const trace::Tracer& tracer, const SceneView& view, const Camera& camera) {
  render::Renderer renderer(view.scene());
  const Light sun = DirectionalLight{{0.0, -1.0, 0.0}};
  PlanOptions options;
  options.cascades = 1;
  options.resolution.max_size = kLeastMapSize;
  const ShadowPlan plan = make_plan(camera, sun, view.bounds(), options);
  if (plan.status == PlanStatus::invalid_input)
    throw std::runtime_error(view.scene().name + ": " + invalid_input_text(plan.invalid_field));
  (void)renderer.draw(plan, camera, renderer.prepare(render::filters::hard));
  const Light eye = PointLight{camera.position, std::numeric_limits<double>::infinity()};
  trace::SurfacePoints points =
      trace::surface_points(tracer, camera, eye, renderer.positions(), renderer.normals());
  render::check_context();
  return points;
}

/// One position of the sun: its rays to all surfaces that it could reach.
void add_position(const trace::Tracer& tracer, const glm::dvec3& to_light, double hours, Sunlight& day,
                  trace::SurfacePoints& turned) {
  for (std::size_t i = 0; i < turned.pixels.size(); ++i) {
    if (day.hours[i] < 0.0) continue;
    const bool faces = glm::dot(turned.pixels[i].normal, to_light) > 0.0;
    turned.pixels[i].state = faces ? trace::PixelState::facing : trace::PixelState::turned_away;
  }
  // A disc of no width, and so one ray to its middle.
  const trace::SoftReference lit = trace::area_reference(tracer, turned, DirectionalLight{-to_light}, 0.0, 1);
  for (std::size_t i = 0; i < lit.pixels.size(); ++i)
    if (day.hours[i] >= 0.0 && lit.pixels[i] > 0.0f) day.hours[i] += hours;
}

Sunlight measure(const Request& request, const SunMoment& begin, const SceneView& view,
                 const Camera& camera) {
  const trace::Tracer tracer(view.scene());
  Sunlight day;
  day.points = seen_surfaces(tracer, view, camera);
  for (const trace::SurfacePoint& point : day.points.pixels) {
    const bool known = point.state == trace::PixelState::facing;
    day.hours.push_back(known ? 0.0 : -1.0);
    const trace::KernelAxes half = trace::facet_axes(camera, point);
    day.areas.push_back(known ? 4.0 * glm::length(glm::cross(half.x, half.y)) : 0.0);
  }
  const int steps = std::max(1, static_cast<int>(std::lround(kDay_s / request.step_s)));
  const double step_s = kDay_s / steps;
  trace::SurfacePoints turned = day.points;
  Progress progress("sunlight", steps);
  for (int i = 0; i < steps; ++i) {
    check_interrupt();
    progress.set(i);
    const SunPosition sun = sun_position(begin.unix_s + (i + 0.5) * step_s, begin.place);
    if (!(sun.elevation_deg > 0.0)) continue;
    ++day.positions;
    day.sun_hours += step_s / kHour_s;
    add_position(tracer, to_sun(sun), step_s / kHour_s, day, turned);
  }
  return day;
}

/// Hours that all of the surfaces have, and how large a share of them has how many.
struct Summary {
  double mean_hours = 0.0, median_hours = 0.0;
  std::vector<double> shares;  ///< of the area, by full hours
  double unknown_share = 0.0;  ///< of the pixels with a surface
};

Summary summary_of(const Sunlight& day) {
  Summary summary;
  summary.shares.resize(static_cast<std::size_t>(std::ceil(day.sun_hours)) + 1);
  double area = 0.0;
  std::size_t surfaces = 0, unknown = 0;
  std::vector<std::pair<double, double>> sorted;  // hours and area
  for (std::size_t i = 0; i < day.hours.size(); ++i) {
    surfaces += day.points.pixels[i].state != trace::PixelState::sky ? 1 : 0;
    unknown += day.points.pixels[i].state != trace::PixelState::sky && day.hours[i] < 0.0 ? 1 : 0;
    if (day.hours[i] < 0.0) continue;
    area += day.areas[i];
    summary.mean_hours += day.hours[i] * day.areas[i];
    // Sums of steps that make up an hour may be rounded to less.
    constexpr double kRounding = 1e-9;
    summary.shares[static_cast<std::size_t>(day.hours[i] + kRounding)] += day.areas[i];
    sorted.emplace_back(day.hours[i], day.areas[i]);
  }
  if (surfaces > 0) summary.unknown_share = static_cast<double>(unknown) / static_cast<double>(surfaces);
  if (!(area > 0.0)) return summary;
  summary.mean_hours /= area;
  for (double& share : summary.shares) share /= area;
  while (summary.shares.size() > 1 && summary.shares.back() == 0.0) summary.shares.pop_back();
  std::sort(sorted.begin(), sorted.end());
  double below = 0.0;
  for (const auto& [hours, part] : sorted) {
    below += part;
    summary.median_hours = hours;
    if (below >= 0.5 * area) break;
  }
  return summary;
}

/// From no sun to all of the day's: dark to bright in brightness alone, too.
render::Color hours_color(double share) {
  constexpr std::array<render::Color, 5> kStops{
      {{26, 20, 70}, {112, 32, 120}, {204, 64, 84}, {246, 150, 40}, {252, 246, 164}}};
  const double at = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
  const auto stop = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  return mixed(kStops[stop], kStops[stop + 1], at - static_cast<double>(stop));
}

void draw_hours_legend(Image& image, const Sunlight& day, const std::string& title) {
  constexpr double kFields = 7.0;
  const int step = std::max(1, static_cast<int>(std::ceil(day.sun_hours / kFields)));
  std::vector<std::string> texts;
  std::vector<render::LegendEntry> entries;
  for (int hours = 0; hours + 0.5 * step < day.sun_hours; hours += step)
    texts.push_back(fmt::format("{} h", hours));
  texts.push_back(fmt::format("{:.1f} h: all day", day.sun_hours));
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const double hours = i + 1 < texts.size() ? static_cast<double>(i) * step : day.sun_hours;
    entries.push_back({hours_color(hours / day.sun_hours), texts[i]});
  }
  render::draw_legend(image, title, entries);
}

Image picture_of(const Sunlight& day, const Camera& camera, const std::string& title) {
  Image image = render::blank_image(day.points.width, day.points.height, kSky);
  for (std::size_t i = 0; i < day.hours.size(); ++i) {
    const trace::SurfacePoint& point = day.points.pixels[i];
    if (point.state == trace::PixelState::sky) continue;
    if (day.hours[i] < 0.0) {
      set_pixel(image, i, kUndecided);
      continue;
    }
    // A little light from the eye, so that surfaces of the same hours part at their edges.
    constexpr double kDarkest = 0.8;
    const double cosine = std::abs(glm::dot(point.normal, glm::normalize(point.position - camera.position)));
    const render::Color color = hours_color(day.hours[i] / day.sun_hours);
    set_pixel(image, i, mixed({0, 0, 0}, color, kDarkest + (1.0 - kDarkest) * cosine));
  }
  draw_hours_legend(image, day, title);
  return image;
}

std::string csv_of(const Summary& summary) {
  std::string text = "from_hours,to_hours,share_of_area\n";
  for (std::size_t hour = 0; hour < summary.shares.size(); ++hour)
    text += fmt::format("{},{},{:.4f}\n", hour, hour + 1, summary.shares[hour]);
  return text;
}

void print(const Request& request, const SunMoment& begin, const Sunlight& day, const Summary& summary) {
  if (!request.json) {
    fmt::print("sun:      {:.1f} hours, {}; {} positions\n", day.sun_hours, sun_hours_text(begin),
               day.positions);
    fmt::print(
        "sunlight: {:.2f} hours on average over the area in view, median {:.2f}; {:.1f} % of it has less "
        "than one\n",
        summary.mean_hours, summary.median_hours, 100.0 * summary.shares[0]);
    if (summary.unknown_share > 0.0)
      fmt::print("unknown:  {:.2f} % of the pixels, at edges (violet)\n", 100.0 * summary.unknown_share);
    fmt::print("picture:  {}\n", request.out);
    if (!request.csv.empty()) fmt::print("numbers:  {}\n", request.csv);
    return;
  }
  const auto rounded = [](double value) { return std::round(value * 1e4) / 1e4; };
  using Json = nlohmann::ordered_json;
  Json shares = Json::array();
  for (const double share : summary.shares) shares.push_back(rounded(share));
  print_line(Json{{"scene", scene_title(request.scene)},
                  {"sun", request.sun},
                  {"sun_hours", rounded(day.sun_hours)},
                  {"positions", day.positions},
                  {"mean_hours", rounded(summary.mean_hours)},
                  {"median_hours", rounded(summary.median_hours)},
                  {"share_of_area_by_hour", shares},
                  {"unknown_share", rounded(summary.unknown_share)},
                  {"picture", request.out}}
                 .dump(-1, ' ', false, Json::error_handler_t::replace));
}

int run(const Request& request) {
  const SunMoment begin = sun_day_word("--sun", request.sun);
  if (sun_hours(begin.unix_s, begin.place).never)
    throw std::runtime_error("--sun " + request.sun + ": the sun does not rise that day");
  check_scene_word("scene", request.scene);
  check_camera(request.camera);
  check_file("--out", request.out, {request.scene, request.camera.path, request.edits.proxies});
  if (!request.csv.empty())
    check_file("--csv", request.csv,
               {request.scene, request.camera.path, request.edits.proxies, request.out});
  watch_interrupts();
  try {
    const SceneView view(request.scene, {}, request.camera, limits_of_triangles(request.max_triangles),
                         request.edits);
    warn_of(view.scene());
    const auto context = render::create_context(request.context);
    const Camera camera = view.camera(0, 1, request.width, request.height);
    const Sunlight day = measure(request, begin, view, camera);
    const Summary summary = summary_of(day);
    const std::filesystem::path out = request.out;
    if (out.has_parent_path()) make_folder("--out", out.parent_path());
    write_png(picture_of(day, camera, "hours of sun on " + request.sun), out);
    if (!request.csv.empty()) write_file(request.csv, csv_of(summary));
    print(request, begin, day, summary);
  } catch (const SceneError& error) {
    throw std::runtime_error(error.what());
  }
  flush_output();
  return 0;
}

}  // namespace
}  // namespace gnomon::tool::sunlight

namespace gnomon::tool {

std::function<int()> declare_sunlight(Arguments& arguments) {
  const auto request = std::make_shared<sunlight::Request>();
  const auto set_step = [request](const std::string& word) {
    request->step_s = sunlight::step_of(word);
    return true;
  };
  arguments.options = {
      {.name = "scene",
       .target = &request->scene,
       .help = scene_help(),
       .names = builtin_scene_words(),
       .only_names = false,
       .completion = Completion::files},
      {.name = "--sun",
       .target = &request->sun,
       .help = "day and place, as in 2026-06-21@52.5,13.4; north is -Z, east is +X",
       .word = "DATE@PLACE",
       .required = true},
      {.name = "--step",
       .target = ParsedWord{set_step, "15min"},
       .help = "time between two positions of the sun, 1min to 2h",
       .word = "TIME"},
      {.name = "--out",
       .target = &request->out,
       .help = "PNG file of the picture",
       .word = "FILE",
       .required = true,
       .completion = Completion::files},
      {.name = "--csv",
       .target = &request->csv,
       .help = "also write the share of the area in view by hours of sun",
       .word = "FILE",
       .completion = Completion::files},
      {.name = "--json", .target = &request->json, .help = "print figures as a line of JSON"},
      size_option(request->width, request->height),
      max_triangles_option(request->max_triangles),
      context_option(request->context)};
  for (Option& option : camera_options(request->camera)) arguments.options.push_back(std::move(option));
  for (Option& option : edit_options(request->edits)) arguments.options.push_back(std::move(option));
  arguments.footer =
      "Each pixel's surface sends a ray to each position of the sun, in the middle of its step, from "
      "midnight to\n"
      "midnight of the place's mean solar time. Areas are those of the surfaces that the picture shows.\n"
      "A day without a zone has the place's mean solar time; 2026-06-21+02:00@52.5,13.4 has that of the "
      "zone.";
  return [request] { return sunlight::run(*request); };
}

}  // namespace gnomon::tool
