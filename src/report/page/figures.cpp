// The survey's Figures 12 and 18, from measured plans.
#include "gnomon/report/figures.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "chart.hpp"
#include "file.hpp"
#include "gnomon/measure.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/report/csv.hpp"
#include "gnomon/study/dpds.hpp"
#include "gnomon/study/log_perspective.hpp"
#include "text.hpp"

namespace gnomon::report {
namespace {

constexpr int kPixels = 1024, kTexels = 1024;
constexpr glm::dvec3 kAhead{0.0, 0.0, -1.0}, kDown{0.0, -1.0, 0.0};

/// A camera whose whole view is full of receivers and casters.
struct View {
  Camera camera;
  Box everything;
  View(double near_depth, double far_depth)
      : camera(perspective_camera(glm::dvec3(0.0), kAhead, -kDown, std::numbers::pi / 3.0, 1.0, near_depth,
                                  far_depth, kPixels, kPixels)),
        everything{glm::dvec3(-far_depth), glm::dvec3(far_depth)} {}
  [[nodiscard]] SceneBounds bounds() const { return {{&everything, 1}, {&everything, 1}}; }
};

PlanOptions plain_options(const Warp* warp) {
  PlanOptions options;
  options.prune = kPruneNothing;
  options.filter.texels = 0.0;
  options.resolution.max_size = kTexels;
  options.warp.warp = warp;
  options.warp.objective = Objective::storage;
  return options;
}

StorageFigure::Line storage_line(const StorageFigure::Scheme& scheme, const View& view,
                                 const DirectionalLight& light) {
  StorageFigure::Line line{scheme, {}};
  if (scheme.warp == nullptr) {
    const LogPerspectiveMap map = log_perspective_map(view.camera, light, view.bounds(), kTexels);
    line.points.push_back({1, measure(map, view.camera, view.bounds()).storage});
    return line;
  }
  PlanOptions options = plain_options(scheme.warp);
  options.split.scheme = SplitScheme::logarithmic;
  options.split.partition = scheme.partition;
  // A separating plane parts two maps.
  const int most = scheme.partition == Partition::separating_plane ? 1 : kMaxMaps;
  for (int count = 1; count <= most; ++count) {
    // Cascades, or slices of each face.
    options.cascades = options.split.face_slices = count;
    const ShadowPlan plan = make_plan(view.camera, light, view.bounds(), options);
    // More slices than maps change nothing.
    if (count > 1 && plan.map_count == line.points.back().maps) break;
    line.points.push_back({plan.map_count, measure(plan, view.camera, view.bounds()).storage});
  }
  return line;
}

std::vector<StorageFigure::Line> storage_lines(const glm::dvec3& direction) {
  constexpr double kFarOverNear = 1000.0;
  const View view(1.0, kFarOverNear);
  const DirectionalLight light{direction};
  std::vector<StorageFigure::Line> lines;
  for (const StorageFigure::Scheme& scheme : std::array<StorageFigure::Scheme, 6>{
           {{"cascades", Partition::view_depth, &warps::none},
            {"cascades, warped", Partition::view_depth, &warps::optimal},
            {"frustum faces", Partition::frustum_faces, &warps::none},
            {"frustum faces, warped", Partition::frustum_faces, &warps::optimal},
            {"separating plane, warped", Partition::separating_plane, &warps::optimal},
            {"one logarithmic map (limit)", Partition::view_depth, nullptr}}})
    lines.push_back(storage_line(scheme, view, light));
  return lines;
}

ErrorCurves::Curve error_curve(const char* name, const Warp* warp, double (*textbook)(double, double, double),
                               const ErrorCurves& over) {
  ErrorCurves::Curve curve{name, {}, {}};
  for (const double z : over.depth) curve.textbook.push_back(textbook(z, over.near_depth, over.far_depth));
  if (warp == nullptr) return curve;
  const View view(over.near_depth, over.far_depth);
  const auto plan_with = [&](const Warp& of) {
    PlanOptions options = plain_options(&of);
    options.cascades = 1;
    return make_plan(view.camera, DirectionalLight{kDown}, view.bounds(), options);
  };
  const auto error_at = [&](const ShadowPlan& plan, double z) {
    return measure_perspective(plan.map[0], view.camera, kAhead * z).perspective_t;
  };
  // One unit for all: pixels of the unwarped map per dp/ds.
  const double unit = error_at(plan_with(warps::none), over.near_depth) /
                      dpds::uniform(over.near_depth, over.near_depth, over.far_depth);
  const ShadowPlan plan = plan_with(*warp);
  for (const double z : over.depth) curve.measured.push_back(error_at(plan, z) / unit);
  return curve;
}

/// A color and a kind of mark for each name, and the axes' ranges.
Chart storage_chart(const char* title, const std::vector<StorageFigure::Line>& lines) {
  Axis x{"shadow maps", false}, y{"texels per screen pixel for m <= 1"};
  x.whole = true;
  x.fit({0.0, static_cast<double>(kMaxMaps)});
  std::vector<double> values;
  for (const auto& line : lines) {
    for (const auto& point : line.points) values.push_back(point.storage);
  }
  y.fit(values);
  Chart chart(title, x, y);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string name = lines[i].scheme.name;
    std::vector<Point> points;
    for (const auto& p : lines[i].points) points.push_back({static_cast<double>(p.maps), p.storage});
    chart.line(points, i, "line", name);
    for (const Point& p : points)
      chart.mark(p, i, i, name + ", " + short_number(p.x) + ": " + short_number(p.y), i);
    chart.legend_color(name, i);
  }
  return chart;
}

Chart error_chart(const ErrorCurves& curves) {
  Axis x{"view depth / near depth"}, y{"dp/ds: lines from the textbook, marks from plans"};
  std::vector<double> values;
  for (const auto& curve : curves.curves)
    values.insert(values.end(), curve.textbook.begin(), curve.textbook.end());
  x.fit(curves.depth);
  y.fit(values);
  Chart chart("Error along the view, light overhead, far over near " +
                  short_number(curves.far_depth / curves.near_depth),
              x, y);
  for (std::size_t i = 0; i < curves.curves.size(); ++i) {
    const ErrorCurves::Curve& curve = curves.curves[i];
    std::vector<Point> points;
    for (std::size_t k = 0; k < curves.depth.size(); ++k)
      points.push_back({curves.depth[k], curve.textbook[k]});
    chart.line(points, i, "line", curve.name);
    for (std::size_t k = 0; k < curve.measured.size(); ++k) {
      chart.mark({curves.depth[k], curve.measured[k]}, i, i,
                 std::string(curve.name) + ": " + short_number(curve.measured[k]), i);
    }
    chart.legend_color(curve.name, i);
  }
  return chart;
}

std::string storage_csv(const StorageFigure& figure) {
  std::string out = "light,scheme,maps,storage\n";
  for (const auto& [light, lines] :
       {std::pair{"overhead", &figure.overhead}, std::pair{"behind", &figure.behind}}) {
    for (const auto& line : *lines) {
      for (const auto& point : line.points) {
        out += csv_field(light) + "," + csv_field(line.scheme.name) + "," + std::to_string(point.maps) + "," +
               exact_number(point.storage) + "\n";
      }
    }
  }
  return out;
}

std::string error_csv(const ErrorCurves& curves) {
  std::string out = "warp,depth,textbook,measured\n";
  for (const auto& curve : curves.curves) {
    for (std::size_t k = 0; k < curves.depth.size(); ++k) {
      out += csv_field(curve.name) + "," + exact_number(curves.depth[k]) + "," +
             exact_number(curve.textbook[k]) + "," +
             (curve.measured.empty() ? "" : exact_number(curve.measured[k])) + "\n";
    }
  }
  return out;
}

}  // namespace

StorageFigure storage_figure() {
  return {storage_lines(kDown), storage_lines(kAhead)};
}

ErrorCurves error_curves() {
  constexpr int kDepths = 33;
  ErrorCurves curves{1.0, 100.0, {}, {}};
  const double step = std::log(curves.far_depth / curves.near_depth) / (kDepths - 1);
  for (int i = 0; i < kDepths; ++i) curves.depth.push_back(curves.near_depth * std::exp(step * i));
  // Rounding must not lead out of the view.
  curves.depth.back() = curves.far_depth * (1.0 - 1e-9);
  curves.depth.front() = curves.near_depth * (1.0 + 1e-9);
  curves.curves = {error_curve("uniform", &warps::none, dpds::uniform, curves),
                   error_curve("perspective shadow map", &warps::psm, dpds::psm, curves),
                   error_curve("LiSPSM", &warps::lispsm04, dpds::lispsm, curves),
                   error_curve("logarithmic", nullptr, dpds::logarithmic, curves)};
  return curves;
}

std::vector<std::filesystem::path> write_figures(const std::filesystem::path& folder) {
  const StorageFigure storage = storage_figure();
  const ErrorCurves curves = error_curves();
  make_folder(folder);
  std::vector<std::filesystem::path> files;
  for (const auto& [name, text] : std::array<std::pair<const char*, std::string>, 5>{
           {{"storage_overhead.svg", storage_chart("Storage, light overhead", storage.overhead).standalone()},
            {"storage_behind.svg",
             storage_chart("Storage, light behind the viewer", storage.behind).standalone()},
            {"storage.csv", storage_csv(storage)},
            {"error_by_depth.svg", error_chart(curves).standalone()},
            {"error_by_depth.csv", error_csv(curves)}}}) {
    files.push_back(folder / name);
    write_text(files.back(), text);
  }
  return files;
}

}  // namespace gnomon::report
