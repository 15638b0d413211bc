// Texels that pages need on the cases, policy by policy, and the time that a page plan takes.
//
//     bench_pages            the table of texels per pixel, and the times
//     bench_pages --seconds  the times alone
#include <chrono>
#include <cstdio>
#include <cstring>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "case_table.hpp"

namespace gnomon {
namespace {

/// Where eye rays leave the receivers' boxes for the last time, through the centres of a grid of parts of the
/// image.
std::vector<glm::dvec3> far_faces(const Case& c, int columns, int rows) {
  std::vector<glm::dvec3> points;
  const CameraAxes axes = camera_axes(c.camera);
  for (int i = 0; i < columns * rows; ++i) {
    const double x = c.camera.left + (c.camera.right - c.camera.left) * (i % columns + 0.5) / columns;
    const double y = c.camera.bottom + (c.camera.top - c.camera.bottom) * (i / columns + 0.5) / rows;
    const glm::dvec3 ray = axes.forward + axes.right * x + axes.up * y;
    double last = -1.0;
    for (const Box& box : c.receivers) {
      double begin = c.camera.near_depth, end = c.camera.far_depth;
      for (int axis = 0; axis < 3; ++axis) {
        const double a = (box.min[axis] - c.camera.position[axis]) / ray[axis];
        const double b = (box.max[axis] - c.camera.position[axis]) / ray[axis];
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
      }
      if (begin <= end && end < c.camera.far_depth) last = std::max(last, end);
    }
    if (last > 0.0) points.push_back(c.camera.position + ray * last);
  }
  return points;
}

struct Column {
  const char* name;
  const PagePolicy* policy;
  Fit fit;
  bool warp;
  int levels_per_octave, trials;
  double share;
};
const Column kColumns[] = {
    {"clipmap", &page_policies::clipmap, Fit::stable, false, 1, 1, 1.0},
    {"octaves", &page_policies::resolution, Fit::tight, false, 1, 1, 1.0},
    {"thirds", &page_policies::resolution, Fit::tight, false, 3, 1, 1.0},
    {"tried", &page_policies::resolution, Fit::tight, false, 3, 8, 1.0},
    {"quarters", &page_policies::resolution, Fit::tight, false, 4, 8, 1.0},
    {"stable", &page_policies::resolution, Fit::stable, false, 3, 1, 1.0},
    {"warped", &page_policies::resolution, Fit::tight, true, 3, 8, 1.0},
    {"95 %", &page_policies::resolution, Fit::tight, false, 3, 1, 0.95},
    {"95 % tried", &page_policies::resolution, Fit::tight, false, 3, 8, 0.95},
    {"stable 95 %", &page_policies::resolution, Fit::stable, false, 3, 1, 0.95},
};

double texels_per_pixel(const NamedCase& c, const std::vector<glm::dvec3>& points, const Column& column,
                        int page_texels, std::span<std::byte> memory) {
  PageOptions pages;
  pages.plan.fit = column.fit;
  pages.plan.filter.texels = 0.0;
  if (column.warp) pages.plan.warp.warp = &warps::optimal;
  pages.policy = column.policy;
  pages.page_texels = page_texels;
  pages.capacity = 1 << 15;
  pages.levels_per_octave = column.levels_per_octave;
  pages.trials = column.trials;
  pages.share = column.share;
  const View seen{.camera = c.camera, .points_world = points};
  const PagePlan plan = plan_pages(seen, c.light, c.bounds(), pages, memory);
  const PageStats stats = measure(plan, seen, {});
  const double above = static_cast<double>(plan.points_coarser) / static_cast<double>(plan.points);
  const bool kept = column.share < 1.0 ? above <= 1.0 - column.share : stats.worst_side <= 1.0 + 1e-9;
  if (plan.status != PlanStatus::ok || stats.m.outside > 0 || plan.target_m > 1.0 || !kept) {
    std::printf("\n%s, %s: status %d %s, outside %d, worst %.3f\n", c.name.c_str(), column.name,
                static_cast<int>(plan.status), std::string(plan.invalid_field).c_str(),
                static_cast<int>(stats.m.outside), stats.worst_side);
    std::exit(1);
  }
  return stats.texels_per_pixel;
}

void print_table(const std::vector<NamedCase>& cases, std::span<std::byte> memory) {
  for (const int page_texels : {128, 64}) {
    std::printf("texels per pixel, pages of %d, borders apart\n%-16s", page_texels, "");
    for (const Column& column : kColumns) std::printf(" %11s", column.name);
    std::printf("\n");
    std::vector<std::vector<double>> by_column(std::size(kColumns));
    for (const NamedCase& c : cases) {
      const std::vector<glm::dvec3> points = far_faces(c, 240, 135);
      std::printf("%-16s", c.name.c_str());
      for (std::size_t i = 0; i < std::size(kColumns); ++i) {
        by_column[i].push_back(texels_per_pixel(c, points, kColumns[i], page_texels, memory));
        std::printf(" %11.2f", by_column[i].back());
      }
      std::printf("\n");
    }
    std::printf("%-16s", "geometric mean");
    for (const std::vector<double>& column : by_column) std::printf(" %11.2f", geometric_mean(column));
    std::printf("\n");
  }
}

/// Median time of one plan from 10 000 points, for the target that gives about 1000 pages.
void print_times(const std::vector<NamedCase>& cases, std::span<std::byte> memory) {
  using Clock = std::chrono::steady_clock;
  for (const char* name : {"light45", "overhead", "fov110"}) {
    const auto c =
        std::find_if(cases.begin(), cases.end(), [&](const NamedCase& one) { return one.name == name; });
    if (c == cases.end()) continue;
    const std::vector<glm::dvec3> points = far_faces(*c, 133, 75);
    PageOptions pages;
    pages.target_m = 0.75;
    std::vector<double> milliseconds;
    std::size_t opened = 0;
    for (int run = 0; run < 200; ++run) {
      const auto begin = Clock::now();
      const PagePlan plan =
          plan_pages({.camera = c->camera, .points_world = points}, c->light, c->bounds(), pages, memory);
      milliseconds.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
      opened = plan.pages.size();
    }
    std::sort(milliseconds.begin(), milliseconds.end());
    std::printf("%s: %zu pages from %zu points: %.3f ms median, %.3f least\n", name, opened, points.size(),
                milliseconds[milliseconds.size() / 2], milliseconds.front());
  }
}

}  // namespace
}  // namespace gnomon

int main(int argc, char** argv) {
  const std::vector<gnomon::NamedCase> cases = gnomon::load_cases();
  std::vector<std::byte> memory(gnomon::page_memory(1 << 15, 1 << 17));
  if (argc < 2 || std::strcmp(argv[1], "--seconds") != 0) gnomon::print_table(cases, memory);
  gnomon::print_times(cases, memory);
}
