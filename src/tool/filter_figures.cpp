// The figures of the filters' papers that compare pictures: orders, bleeding, minification, contacts, bits.
#include "filter_figures.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/load.hpp"

namespace gnomon::tool {
namespace {

constexpr double kSunElevation = 38.0, kSunOverScenes = 140.0, kSunBehindBars = 250.0;  // degrees

const std::vector<std::string> kLeakColumns{"filter", "RMS to the truth",
                                            "light beyond that of pcf where the truth is dark"};

FilterStage scene_stage(const std::string& scene) {
  return {load_scene(scene), kSunElevation, kSunOverScenes};
}

CameraOf along_path(const FilterStage& stage, double at) {
  return
      [path = default_path(stage.scene()), at](int width, int height) { return path.at(at, width, height); };
}

/// Draws every filter, adds its picture, and answers what each pixel sees of the light.
std::vector<float> draw_panel(Figure& figure, FilterStage& stage, const std::string& filter,
                              const CameraOf& camera, const FigureSize& size, int map_size) {
  stage.draw(filter_from(filter), camera(size.width, size.height), map_size);
  figure.panels.push_back({filter, stage.renderer().image()});
  return stage.visibility();
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
void compare(Figure& figure, FilterStage& stage, const std::vector<std::string>& filters,
             const CameraOf& camera, const FigureSize& size, int map_size) {
  const std::vector<float> exact = true_visibility(stage, camera, size);
  std::vector<float> compared;
  for (const std::string& filter : filters) {
    const std::vector<float> lit = draw_panel(figure, stage, filter, camera, size, map_size);
    if (compared.empty()) compared = lit;
    figure.rows.push_back({filter, {rms(lit, exact), leaked(lit, compared, exact)}});
  }
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
          "vsm:radius=2",
          "savsm:radius=2",
          "lvsm:radius=2",
          "evsm4:radius=2",
          "msm:radius=2"};
}
std::vector<std::string> power_law_filters() {
  return {"pcf:radius=2", "power_cdf:radius=2,offset=0", "power_cdf:radius=2",
          "vsm:radius=2", "vsm:radius=2,bleed=0",        "esm:radius=2"};
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

}  // namespace

double Figure::value(const std::string& label, std::size_t column) const {
  for (const Row& row : rows) {
    if (row.label == label) return row.values.at(column);
  }
  throw std::out_of_range(name + " has no row " + label);
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
  FilterStage stage(contact_scene(false), kSunElevation, kSunBehindBars);
  const std::vector<float> exact = true_visibility(stage, contact_camera, size);
  const auto add = [&](const std::string& filter) {
    const std::vector<float> lit = draw_panel(figure, stage, filter, contact_camera, size, size.narrow_map);
    figure.rows.push_back({filter, {rms(lit, exact), render::bytes_per_texel(filter_from(filter))}});
  };
  add("pcf:radius=2");
  // Lit surfaces kept lit by the paper's two ways: an offset of half a step of the series, and twice the
  // answer.
  for (const char* way : {"attenuation=0", "attenuation=0,offset=0,scale=2"}) {
    for (const int order : {1, 2, 4, 8, 16})
      add("convolution:radius=2,order=" + std::to_string(order) + "," + way);
  }
  add("convolution:radius=2");
  return figure;
}

Figure bleeding_bars(const FigureSize& size) {
  Figure figure{"bleeding_bars", "Light bleeding behind bars", kLeakColumns, {}, {}};
  FilterStage bars(contact_scene(true), kSunElevation, kSunBehindBars);
  compare(figure, bars, bleeding_filters(), contact_camera, size, size.narrow_map);
  return figure;
}

Figure bleeding_fence(const FigureSize& size) {
  Figure figure{"bleeding_fence", "Light bleeding behind a fence", kLeakColumns, {}, {}};
  FilterStage fence = scene_stage("builtin:fence");
  compare(figure, fence, bleeding_filters(), along_path(fence, 0.5), size, size.wide_map);
  return figure;
}

Figure minification(const FigureSize& size) {
  Figure figure{"minification",
                "Minification as the scene recedes (pictures: the middle, enlarged as many times)",
                {"filter", "RMS at 1 time the distance", "2", "4", "8"},
                {},
                {}};
  FilterStage grating(grating_scene(), kSunElevation, kSunBehindBars);
  for (const char* filter :
       {"hard", "pcf:radius=1", "vsm:radius=1,mipmap=1,anisotropy=16",
        "convolution:radius=1,mipmap=1,anisotropy=16", "esm:radius=1,mipmap=1,anisotropy=16,fallback=0",
        "esm:radius=1,mipmap=1,anisotropy=16"}) {
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
  Figure figure{"contacts", "Power law against VSM and ESM at contacts", kLeakColumns, {}, {}};
  FilterStage contact(contact_scene(false), kSunElevation, kSunBehindBars);
  compare(figure, contact, power_law_filters(), contact_camera, size, size.narrow_map);
  return figure;
}

Figure overlaps(const FigureSize& size) {
  Figure figure{"overlaps", "Power law against VSM and ESM under overlapping shadows", kLeakColumns, {}, {}};
  FilterStage trees = scene_stage("builtin:trees");
  compare(figure, trees, power_law_filters(), along_path(trees, 0.3), size, size.wide_map);
  return figure;
}

Figure bits(const FigureSize& size) {
  Figure figure{"bits", "16 bits a channel against 32", {"filter", "RMS to 32 bits"}, {}, {}};
  FilterStage trees = scene_stage("builtin:trees");
  const CameraOf camera = along_path(trees, 0.3);
  for (const char* name : {"power_cdf", "vsm", "esm", "lvsm", "evsm4", "msm"}) {
    const render::Filter& filter = *render::find_filter(name);
    const std::string text = std::string(name) + ":radius=2";
    const std::vector<float> full =
        draw_panel(figure, trees, text + ",format=fp32", camera, size, size.wide_map);
    for (const render::TexelFormat format : filter.info.formats) {
      if (render::bytes_per_channel(format) != 2) continue;
      const std::string shorter = text + ",format=" + std::string(to_string(format));
      figure.rows.push_back(
          {shorter, {rms(draw_panel(figure, trees, shorter, camera, size, size.wide_map), full)}});
    }
  }
  return figure;
}

Figure one_scene(const std::string& scene, const FigureSize& size) {
  Figure figure{"one_scene", "All filters on " + scene, kLeakColumns, {}, {}};
  std::vector<std::string> filters{"pcf:radius=2"};
  for (const render::Filter* filter : render::all_filters()) {
    const std::string name(filter->info.name);
    if (name != "pcf")
      filters.push_back(filter->info.has_kernel && name != "pcss" ? name + ":radius=2" : name);
  }
  FilterStage stage = scene_stage(scene);
  // The flight goes round all of a scene; half its width shows the shadows.
  const CameraOf closer = [path = along_path(stage, 0.3)](int width, int height) {
    Camera camera = path(width, height);
    for (double* edge : {&camera.left, &camera.right, &camera.bottom, &camera.top}) *edge *= 0.5;
    return camera;
  };
  compare(figure, stage, filters, closer, size, size.wide_map);
  return figure;
}

}  // namespace gnomon::tool
