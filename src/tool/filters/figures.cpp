// The figures of the filters' papers: orders, bleeding, minification, contacts, bits, and where exponential
// maps fail.
#include "figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "gnomon/scene/camera_path.hpp"

namespace gnomon::tool {
namespace {

constexpr double kSunBehindBars = 250.0;  // azimuth, degrees

const std::vector<std::string> kLeakColumns{"filter", "RMS to the truth",
                                            "light beyond that of pcf where the truth is dark"};

/// Box and board, with the fence beside them or without.
FilterStage contact_stage(bool bars) {
  return {contact_scene(bars), kStageElevationDeg, kSunBehindBars};
}

CameraOf along_path(const FilterStage& stage, double at) {
  return
      [path = default_path(stage.scene()), at](int width, int height) { return path.at(at, width, height); };
}

/// Draws every filter, adds its picture, and answers what each pixel sees of the light. `exact`: to compare
/// it with; empty: with nothing.
std::vector<float> draw_panel(Figure& figure, FilterStage& stage, const std::string& filter,
                              const CameraOf& camera, const FigureSize& size, int map_size,
                              const std::vector<float>& exact = {}) {
  stage.draw(filter_from(filter), camera(size.width, size.height), map_size);
  figure.panels.push_back({filter, stage.renderer().image()});
  const std::vector<float> lit = stage.visibility();
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const bool served = lit[i] >= 0.0f && exact[i] >= 0.0f;
    figure.panels.back().off.push_back(served ? lit[i] - exact[i] : 0.0f);
  }
  return lit;
}

/// Mean of the light beyond that of `compared`, over the pixels that are wholly dark in truth.
double leaked(const std::vector<float>& lit, const std::vector<float>& compared,
              const std::vector<float>& exact) {
  double sum = 0.0, dark = 0.0;
  for (std::size_t i = 0; i < lit.size(); ++i) {
    if (lit[i] < 0.0f || exact[i] != 0.0f) continue;
    sum += std::max(lit[i] - compared[i], 0.0f);
    dark += 1.0;
  }
  return sum / std::max(dark, 1.0);
}

/// Error, and light that leaks, of filters against the first of them, whose kernel is the same.
Figure comparison(const std::string& name, const std::string& title, FilterStage& stage,
                  const std::vector<std::string>& filters, const CameraOf& camera, const FigureSize& size,
                  int map_size) {
  Figure figure{name, title, kLeakColumns, {}, {}};
  const std::vector<float> exact = true_visibility(stage, camera, size);
  std::vector<float> compared;
  for (const std::string& filter : filters) {
    const std::vector<float> lit = draw_panel(figure, stage, filter, camera, size, map_size, exact);
    if (compared.empty()) compared = lit;
    figure.rows.push_back({filter, {rms(lit, exact), leaked(lit, compared, exact)}});
  }
  return figure;
}

/// The same at the contacts of box and board.
Figure at_contacts(const std::string& name, const std::string& title, bool bars,
                   const std::vector<std::string>& filters, const FigureSize& size) {
  FilterStage stage = contact_stage(bars);
  return comparison(name, title, stage, filters, contact_camera, size, size.narrow_map);
}

/// The same in a large scene, from a place of its path.
Figure in_scene(const std::string& name, const std::string& title, const std::string& scene, double at,
                const std::vector<std::string>& filters, const FigureSize& size) {
  FilterStage stage(scene);
  return comparison(name, title, stage, filters, along_path(stage, at), size, size.wide_map);
}

std::vector<std::string> bleeding_filters() {
  return {"pcf:radius=2",
          "vsm:radius=2,bleed=0",
          "lvsm:radius=2,bleed=0,format=fp32",
          "lvsm:radius=2,bleed=0,format=fp32,placement=1",
          "lvsm:radius=2,bleed=0,format=fp32,layers=8,placement=1",
          "convolution:radius=2",
          "power_cdf:radius=2,offset=0",
          "power_cdf:radius=2",
          "power_cdf:radius=2,layers=2",
          "power_cdf:radius=2,layers=4",
          "vsm:radius=2",
          "savsm:radius=2",
          "lvsm:radius=2",
          "evsm4:radius=2",
          "msm:radius=2"};
}
std::vector<std::string> power_law_filters() {
  return {"pcf:radius=2",
          "power_cdf:radius=2,offset=0",
          "power_cdf:radius=2,offset=0,layers=4",
          "power_cdf:radius=2",
          "power_cdf:radius=2,layers=4",
          "vsm:radius=2",
          "vsm:radius=2,bleed=0",
          "esm:radius=2"};
}

/// `factor` times as large about the middle, texel by texel.
Image enlarged(const Image& image, int factor) {
  Image result = image;
  const int left = image.width / 2 - image.width / (2 * factor),
            top = image.height / 2 - image.height / (2 * factor);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto to = static_cast<std::ptrdiff_t>(4) * (y * image.width + x);
      const auto from =
          static_cast<std::ptrdiff_t>(4) * ((top + y / factor) * image.width + left + x / factor);
      std::copy_n(image.rgba.begin() + from, 4, result.rgba.begin() + to);
    }
  }
  return result;
}

/// Pixels that face the light on which the mean of an exponential map fails, as its own shader says.
struct Failures {
  double percent = 0.0;
  Image shown;  // those in red
};
Failures failures_of(FilterStage& stage, const Camera& camera, const FigureSize& size,
                     const std::string& settings) {
  constexpr std::array<std::uint8_t, 3> kRed{230, 30, 30};
  stage.draw(filter_from(settings), camera, size.wide_map / 2);
  Failures failures{0.0, stage.renderer().image()};
  stage.draw(filter_from(settings + ",failures=1"), camera, size.wide_map / 2);
  const FloatImage normals = stage.renderer().normals();
  const std::vector<float> holds = stage.visibility();
  double count = 0.0;
  for (std::size_t i = 0; i < holds.size(); ++i) {
    const float* n = &normals.values[4 * i];
    if (holds[i] < 0.0f || glm::dot(stage.plan().light_direction, glm::dvec3(n[0], n[1], n[2])) >= 0.0)
      continue;
    count += 1.0;
    if (holds[i] > 0.5f) continue;
    failures.percent += 1.0;
    std::copy(kRed.begin(), kRed.end(), failures.shown.rgba.begin() + static_cast<std::ptrdiff_t>(4 * i));
  }
  failures.percent *= 100.0 / std::max(count, 1.0);
  return failures;
}

/// Radius of a disc as large as a pixel's footprint in the map, texels: the median over the pixels that a map
/// serves. A box and a disc of equal variance.
double footprint_radius(const FilterStage& stage, const Camera& camera) {
  constexpr double kSideOfRadius = 1.7320508075688772;
  const FloatImage points = stage.renderer().positions();
  const std::vector<float> lit = stage.visibility();
  const ShadowMap& map = stage.plan().map[0];
  const auto texel_of = [&](std::size_t i) {
    const float* p = &points.values[4 * i];
    const glm::dvec4 h =
        map.clip_from_world * glm::dvec4(camera.position + glm::dvec3(p[0], p[1], p[2]), 1.0);
    return 0.5 * glm::dvec2(h) / h.w * glm::dvec2(map.width, map.height);
  };
  std::vector<double> radii;
  const auto width = static_cast<std::size_t>(points.width);
  for (std::size_t i = 0; i + width < lit.size(); ++i) {
    if (lit[i] < 0.0f || lit[i + 1] < 0.0f || lit[i + width] < 0.0f) continue;
    const glm::dvec2 here = texel_of(i), x = texel_of(i + 1) - here, y = texel_of(i + width) - here;
    radii.push_back(std::sqrt(std::abs(x.x * y.y - x.y * y.x)) / kSideOfRadius);
  }
  if (radii.empty()) return 0.5;
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return std::clamp(*middle, 0.5, render::kMaxRadiusTexels);
}

}  // namespace

double Figure::value(const std::string& label, std::size_t column) const {
  for (const Row& row : rows) {
    if (row.label == label) return row.values.at(column);
  }
  throw std::out_of_range(name + " has no row " + label);
}

Figure::Window Figure::worst_window() const {
  constexpr int kShare = 5;
  const auto compared =
      std::find_if(panels.begin(), panels.end(), [](const Panel& panel) { return !panel.off.empty(); });
  if (compared == panels.end()) return {};
  const int width = compared->image.width, height = compared->image.height;
  Window worst{0, 0, std::max(width / kShare, 1), std::max(height / kShare, 1)};
  double most = -1.0;
  for (int y = 0; y + worst.height <= height; y += std::max(worst.height / 2, 1)) {
    for (int x = 0; x + worst.width <= width; x += std::max(worst.width / 2, 1)) {
      double sum = 0.0;
      for (const Panel& panel : panels) {
        for (std::size_t i = 0; i < panel.off.size(); ++i) {
          const int column = static_cast<int>(i) % width, row = static_cast<int>(i) / width;
          const bool inside = column >= x && column < x + worst.width && row >= y && row < y + worst.height;
          sum += inside ? std::abs(panel.off[i]) : 0.0;
        }
      }
      if (sum <= most) continue;
      most = sum;
      worst.x = x;
      worst.y = y;
    }
  }
  return worst;
}

double rms(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] < 0.0f || b[i] < 0.0f) continue;
    sum += (a[i] - b[i]) * (a[i] - b[i]);
    count += 1.0;
  }
  return std::sqrt(sum / std::max(count, 1.0));
}

std::vector<float> true_visibility(FilterStage& stage, const CameraOf& camera, const FigureSize& size) {
  constexpr int kSamples = 4;
  stage.draw(filter_from("hard"), camera(kSamples * size.width, kSamples * size.height), size.true_map);
  const std::vector<float> fine = stage.visibility();
  std::vector<float> coarse;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      float sum = 0.0f;
      bool served = true;
      for (int i = 0; i < kSamples * kSamples; ++i) {
        const int row = kSamples * y + i / kSamples, column = kSamples * x + i % kSamples;
        const float lit = fine[static_cast<std::size_t>(row * kSamples * size.width + column)];
        served = served && lit >= 0.0f;
        sum += lit;
      }
      coarse.push_back(served ? sum / (kSamples * kSamples) : -1.0f);
    }
  }
  return coarse;
}

Figure convolution_orders(const FigureSize& size) {
  Figure figure{"convolution_orders",
                "Convolution: orders 1 to 16 at a contact and on a slanted plane",
                {"filter", "RMS to the truth", "bytes a texel"},
                {},
                {}};
  FilterStage stage = contact_stage(false);
  const std::vector<float> exact = true_visibility(stage, contact_camera, size);
  const auto add = [&](const std::string& filter) {
    const std::vector<float> lit =
        draw_panel(figure, stage, filter, contact_camera, size, size.narrow_map, exact);
    figure.rows.push_back({filter, {rms(lit, exact), render::bytes_per_texel(filter_from(filter))}});
  };
  add("pcf:radius=2");
  // Lit surfaces kept lit by the paper's two ways: an offset of half a step of the series, and twice the
  // answer.
  for (const char* way : {"attenuation=0,offset=1,scale=1.02", "attenuation=0"}) {
    for (const int order : {1, 2, 4, 8, 16})
      add("convolution:radius=2,order=" + std::to_string(order) + "," + way);
  }
  add("convolution:radius=2");
  for (const char* format : {"unorm8", "fp32"})
    add(std::string("convolution:radius=2,attenuation=0,format=") + format);
  return figure;
}

Figure bleeding_bars(const FigureSize& size) {
  return at_contacts("bleeding_bars", "Light bleeding behind bars", true, bleeding_filters(), size);
}

Figure bleeding_fence(const FigureSize& size) {
  return in_scene("bleeding_fence", "Light bleeding behind a fence", "builtin:fence", 0.5, bleeding_filters(),
                  size);
}

Figure minification(const FigureSize& size) {
  Figure figure{"minification",
                "Minification as the scene recedes (pictures: the middle, enlarged as many times)",
                {"filter", "RMS at 1 time the distance", "2", "4", "8"},
                {},
                {}};
  FilterStage grating(grating_scene(), kStageElevationDeg, kSunBehindBars);
  for (const char* filter :
       {"hard", "pcf:radius=1", "vsm:radius=1,mipmap=1,anisotropy=16",
        "convolution:radius=1,mipmap=1,anisotropy=16", "esm:radius=1,mipmap=1,anisotropy=16,fallback=0",
        "esm:radius=1,mipmap=1,c=80,anisotropy=16"}) {
    Figure::Row row{filter, {}};
    for (const int at : {1, 2, 4, 8}) {
      const CameraOf camera = [at](int width, int height) { return grating_camera(at, width, height); };
      const std::vector<float> exact = true_visibility(grating, camera, size);
      row.values.push_back(rms(draw_panel(figure, grating, filter, camera, size, size.wide_map), exact));
      Panel& panel = figure.panels.back();
      panel.caption += " x" + std::to_string(at);
      panel.image = enlarged(panel.image, at);
    }
    figure.rows.push_back(row);
  }
  return figure;
}

Figure contacts(const FigureSize& size) {
  return at_contacts("contacts", "Power law against VSM and ESM at contacts", false, power_law_filters(),
                     size);
}

Figure overlaps(const FigureSize& size) {
  return in_scene("overlaps", "Power law against VSM and ESM under overlapping shadows", "builtin:trees", 0.3,
                  power_law_filters(), size);
}

Figure half_resolution(const FigureSize& size) {
  Figure figure{"half_resolution",
                "Kernels as wide out of maps of half the resolution",
                {"filter", "RMS to the truth", "at half the resolution"},
                {},
                {}};
  FilterStage contact = contact_stage(true);
  const std::vector<float> exact = true_visibility(contact, contact_camera, size);
  for (const char* filter : {"pcf", "power_cdf", "vsm", "esm"}) {
    Figure::Row row{filter, {}};
    // Five texels, and two and a half of twice the width.
    for (const auto& [radius, map_size] :
         {std::pair(":radius=2", size.narrow_map), std::pair(":radius=0.75", size.narrow_map / 2)}) {
      const std::string settings = std::string(filter) + radius;
      row.values.push_back(
          rms(draw_panel(figure, contact, settings, contact_camera, size, map_size, exact), exact));
      figure.panels.back().caption += " of " + std::to_string(map_size) + " texels";
    }
    figure.rows.push_back(row);
  }
  return figure;
}

Figure bits(const FigureSize& size) {
  Figure figure{"bits", "16 bits a channel and less against 32", {"filter", "RMS to 32 bits"}, {}, {}};
  FilterStage trees("builtin:trees");
  const CameraOf camera = along_path(trees, 0.3);
  for (const char* name : {"power_cdf", "vsm", "esm", "lvsm", "evsm4", "msm", "convolution"}) {
    const render::Filter& filter = *render::find_filter(name);
    const std::string text = std::string(name) + ":radius=2";
    const std::vector<float> full =
        draw_panel(figure, trees, text + ",format=fp32", camera, size, size.wide_map);
    for (const render::TexelFormat format : filter.info.formats) {
      if (render::bytes_per_channel(format) > 2) continue;
      const std::string shorter = text + ",format=" + std::string(to_string(format));
      figure.rows.push_back(
          {shorter, {rms(draw_panel(figure, trees, shorter, camera, size, size.wide_map, full), full)}});
    }
  }
  return figure;
}

Figure one_scene(const std::string& scene, const FigureSize& size) {
  std::vector<std::string> filters{"pcf:radius=2"};
  for (const render::Filter* filter : render::all_filters()) {
    const std::string name(filter->info.name);
    if (name != "pcf")
      filters.push_back(filter->info.has_kernel && name != "pcss" ? name + ":radius=2" : name);
  }
  FilterStage stage(scene);
  // The flight goes round all of a scene; half its width shows the shadows.
  const CameraOf closer = [path = along_path(stage, 0.3)](int width, int height) {
    Camera camera = path(width, height);
    for (double* edge : {&camera.left, &camera.right, &camera.bottom, &camera.top}) *edge *= 0.5;
    return camera;
  };
  return comparison("one_scene", "All filters on " + scene, stage, filters, closer, size, size.wide_map);
}

Figure exponential_failures(const FigureSize& size) {
  Figure figure{"exponential_failures",
                "ESM: percentage of pixels whose kernel holds a texel behind the receiver (c = 80)",
                {"scene, blur", "by threshold", "by largest depth"},
                {},
                {}};
  for (const char* name : {"builtin:fence", "builtin:trees"}) {
    FilterStage stage{std::string(name)};
    const Camera camera = default_path(stage.scene()).at(0.25, size.width, size.height);
    for (int radius = 0; radius <= 3; ++radius) {
      const std::string side = std::to_string(2 * radius + 1), blur = side + "x" + side;
      Figure::Row row{std::string(name) + ", " + blur, {}};
      for (const char* fallback : {"1", "2"}) {
        const Failures failures = failures_of(
            stage, camera, size,
            "esm:c=80,falloff_kernel=0,radius=" + std::to_string(radius) + ",fallback=" + fallback);
        row.values.push_back(failures.percent);
        figure.panels.push_back(
            {row.label + (fallback[0] == '1' ? " by threshold" : " by largest depth"), failures.shown});
      }
      figure.rows.push_back(row);
    }
  }
  return figure;
}

Figure matching_samples(const FigureSize& size) {
  Figure figure{"matching_samples",
                "Samples that PCF takes to match a trilinear read of ESM, scene 4 times as far",
                {"filter", "RMS to the truth, sun at 80 degrees", "at 38 degrees"},
                {},
                {}};
  std::vector<std::string> filters{"esm:radius=1,mipmap=1,c=80,fallback=0",
                                   "esm:radius=1,mipmap=1,c=80,fallback=0,anisotropy=16",
                                   "esm:radius=1,mipmap=1,c=80,anisotropy=16"};
  for (int count = 1; count <= 64; count *= 2)
    filters.push_back("pcf:pattern=1,radius=4,samples=" + std::to_string(count));
  constexpr const char* kOfFootprint = "pcf:pattern=1,samples=64, radius of the footprint";
  filters.emplace_back(kOfFootprint);
  for (const std::string& filter : filters) figure.rows.push_back({filter, {}});
  for (const double elevation_deg : {80.0, kStageElevationDeg}) {
    FilterStage stage(grating_scene(), elevation_deg, kSunBehindBars);
    const CameraOf camera = [](int width, int height) { return grating_camera(4.0, width, height); };
    const std::vector<float> exact = true_visibility(stage, camera, size);
    stage.draw(filter_from("hard"), camera(size.width, size.height), size.wide_map);
    const std::string of_footprint = "pcf:pattern=1,samples=64,radius=" +
                                     std::to_string(footprint_radius(stage, camera(size.width, size.height)));
    for (Figure::Row& row : figure.rows) {
      const std::string filter = row.label == kOfFootprint ? of_footprint : row.label;
      row.values.push_back(rms(draw_panel(figure, stage, filter, camera, size, size.wide_map, exact), exact));
    }
  }
  return figure;
}

Figure memory_of_filters() {
  Figure figure{"memory",
                "Memory besides the depth map's four bytes a texel",
                {"filter, format", "bytes a texel", "of convolution, order 16, 8 bits"},
                {},
                {}};
  constexpr double kDepthBytes = 4.0;
  const double convolution = render::bytes_per_texel(filter_from("convolution")) - kDepthBytes;
  for (const render::Filter* filter : render::all_filters()) {
    render::FilterSettings settings = render::default_settings(*filter);
    for (const render::TexelFormat format : filter->info.formats) {
      settings.format = format;
      const double bytes = render::bytes_per_texel(settings) - kDepthBytes;
      figure.rows.push_back({std::string(filter->info.name) + ", " + std::string(to_string(format)),
                             {bytes, bytes / convolution}});
    }
  }
  return figure;
}

}  // namespace gnomon::tool
