// The comparisons of the filters' papers, on scenes of our own: strips of pictures, and their numbers.
// After figures of: Annen et al., "Convolution Shadow Maps", 2007 (orders, bleeding, minification); Annen et
// al., "Exponential Shadow Maps", 2008 (failures, samples); Gumbau et al., "Improving Shadow Map Filtering
// with Statistical Analysis", 2011 (contacts, 16 bits).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "filter_stage.hpp"
#include "filters.hpp"
#include "gnomon/render/picture.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/load.hpp"
#include "output.hpp"

namespace gnomon::tool {
namespace {

namespace fs = std::filesystem;
using render::FilterSettings;

constexpr int kWidth = 400, kHeight = 300;  // of one picture of a strip
constexpr int kGap = 4, kCaption = 14, kColumns = 4;

/// Where the tables go, and the folder of the strips.
struct Gallery {
  fs::path folder;
  std::ofstream text;
};

template <class... T>
void print(Gallery& gallery, const char* format, T... values) {
  char line[512];
  std::snprintf(line, sizeof line, format, values...);
  gallery.text << line << "\n";
}

struct Panel {
  std::string caption;
  Image image;
};

void write_strip(Gallery& gallery, const std::string& name, const std::vector<Panel>& panels) {
  constexpr render::Color kPaper{255, 255, 255}, kInk{20, 20, 20};
  const int count = static_cast<int>(panels.size()), columns = std::min(count, kColumns);
  const int rows = (count + columns - 1) / columns;
  Image sheet = render::blank_image(columns * (kWidth + kGap), rows * (kHeight + kCaption + kGap), kPaper);
  for (int i = 0; i < count; ++i) {
    const Panel& panel = panels[static_cast<std::size_t>(i)];
    const int x = i % columns * (kWidth + kGap), y = i / columns * (kHeight + kCaption + kGap);
    render::draw_text(sheet, x + 2, y + 3, panel.caption, kInk);
    render::paste(sheet, panel.image, x, y + kCaption);
  }
  write_png(sheet, gallery.folder / (name + ".png"));
  print(gallery, "\n![%s](%s.png)\n", name.c_str(), name.c_str());
  print_line((gallery.folder / (name + ".png")).string());
}

/// Root of the mean squared difference, over the pixels that a map serves in both.
double rms(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] < 0.0f || b[i] < 0.0f) continue;
    sum += (a[i] - b[i]) * (a[i] - b[i]);
    count += 1.0;
  }
  return std::sqrt(sum / std::max(count, 1.0));
}

/// Near enough to the truth: the mean of 4 x 4 hard samples a pixel, out of a map of 4096 texels.
std::vector<float> truth(FilterStage& stage, Camera (*camera)(double, int, int), double at) {
  constexpr int kSamples = 4, kMapSize = 4096;
  stage.draw(filter_from("hard"), camera(at, kSamples * kWidth, kSamples * kHeight), kMapSize);
  const std::vector<float> fine = stage.visibility();
  std::vector<float> coarse;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      float sum = 0.0f;
      bool served = true;
      for (int i = 0; i < kSamples * kSamples; ++i) {
        const int row = kSamples * y + i / kSamples, column = kSamples * x + i % kSamples;
        const float lit = fine[static_cast<std::size_t>(row * kSamples * kWidth + column)];
        served = served && lit >= 0.0f;
        sum += lit;
      }
      coarse.push_back(served ? sum / (kSamples * kSamples) : -1.0f);
    }
  }
  return coarse;
}

/// A strip with one picture per filter.
void strip_of(Gallery& gallery, const std::string& name, FilterStage& stage, const Camera& camera,
              int map_size, const std::vector<std::string>& filters) {
  std::vector<Panel> panels;
  for (const std::string& text : filters) {
    stage.draw(filter_from(text), camera, map_size);
    panels.push_back({text, stage.renderer().image()});
  }
  write_strip(gallery, name, panels);
}

Camera still_contact(double, int width, int height) {
  return contact_camera(width, height);
}

/// At the wall behind the fence, where the fence's shadow falls over others.
Camera behind_fence(double, int width, int height) {
  static const CameraPath path = default_path(load_scene("builtin:fence"));
  return path.at(0.25, width, height);
}

/// Backs away from the fence along the view: `at` times as far.
Camera receding(double at, int width, int height) {
  Camera camera = behind_fence(0.0, width, height);
  constexpr double kStep = 6.0;  // world units
  camera.position -= glm::normalize(camera.forward) * (kStep * (at - 1.0));
  camera.position.y += 0.5 * kStep * (at - 1.0);
  return camera;
}

void convolution_orders(Gallery& gallery, FilterStage& stage) {
  print(gallery, "## Convolution: orders 1 to 16 at a contact and on a slanted plane\n");
  print(gallery, "| order | RMS to the truth | bytes per texel |\n|---|---|---|");
  const std::vector<float> exact = truth(stage, still_contact, 0.0);
  std::vector<Panel> panels;
  for (const char* text :
       {"pcf:radius=2", "convolution:radius=2,order=1,offset=0.6,attenuation=0",
        "convolution:radius=2,order=2,offset=0.6,attenuation=0", "convolution:radius=2,order=4,attenuation=0",
        "convolution:radius=2,order=8,attenuation=0", "convolution:radius=2,attenuation=0",
        "convolution:radius=2", "convolution:radius=2,order=4,offset=0,scale=2,attenuation=0"}) {
    const FilterSettings settings = filter_from(text);
    stage.draw(settings, contact_camera(kWidth, kHeight), 512);
    panels.push_back({text, stage.renderer().image()});
    print(gallery, "| %s | %.3f | %.0f |", text, rms(stage.visibility(), exact),
          render::bytes_per_texel(settings));
  }
  write_strip(gallery, "convolution_orders", panels);
}

void bleeding(Gallery& gallery, FilterStage& contact, FilterStage& fence) {
  print(gallery, "## Light bleeding behind a fence\n");
  const std::vector<std::string> filters{
      "pcf:radius=2",  "vsm:radius=2,bleed=0",   "vsm:radius=2",       "convolution:radius=2",
      "lvsm:radius=2", "lvsm:radius=2,layers=8", "power_cdf:radius=2", "savsm:radius=2"};
  strip_of(gallery, "bleeding_bars", contact, contact_camera(kWidth, kHeight), 512, filters);
  strip_of(gallery, "bleeding_fence", fence, default_path(fence.scene()).at(0.5, kWidth, kHeight), 2048,
           filters);
  print(gallery, "| bars, filter | RMS to the truth | light beyond that of pcf, where the truth is dark |");
  print(gallery, "|---|---|---|");
  const std::vector<float> exact = truth(contact, still_contact, 0.0);
  std::vector<float> compared;  // of the first filter, pcf, with the same kernel
  for (const std::string& text : filters) {
    contact.draw(filter_from(text), contact_camera(kWidth, kHeight), 512);
    const std::vector<float> lit = contact.visibility();
    if (compared.empty()) compared = lit;
    double leaked = 0.0, dark = 0.0;
    for (std::size_t i = 0; i < lit.size(); ++i) {
      if (lit[i] < 0.0f || exact[i] != 0.0f) continue;
      leaked += std::max(lit[i] - compared[i], 0.0f);
      dark += 1.0;
    }
    print(gallery, "| %s | %.3f | %.3f |", text.c_str(), rms(lit, exact), leaked / std::max(dark, 1.0));
  }
  print(gallery, "");
}

void minification(Gallery& gallery, FilterStage& fence) {
  print(gallery, "## Minification as the camera backs away\n");
  print(gallery, "| filter | distance | RMS to the truth |\n|---|---|---|");
  std::vector<Panel> panels;
  for (const char* text : {"pcf:radius=1", "vsm:radius=1,mipmap=1,anisotropy=16",
                           "convolution:radius=1,mipmap=1,anisotropy=16"}) {
    for (const double at : {1.0, 2.0, 4.0, 8.0}) {
      const std::vector<float> exact = truth(fence, receding, at);
      fence.draw(filter_from(text), receding(at, kWidth, kHeight), 2048);
      panels.push_back(
          {std::string(text) + " x" + std::to_string(static_cast<int>(at)), fence.renderer().image()});
      print(gallery, "| %s | %.0f | %.3f |", text, at, rms(fence.visibility(), exact));
    }
  }
  write_strip(gallery, "minification", panels);
}

void power_law(Gallery& gallery, FilterStage& contact, FilterStage& trees) {
  print(gallery, "## Power law against VSM and ESM, at contacts and under overlapping shadows\n");
  const std::vector<std::string> filters{"pcf:radius=2", "power_cdf:radius=2", "vsm:radius=2",
                                         "esm:radius=2"};
  strip_of(gallery, "power_cdf_contact", contact, contact_camera(kWidth, kHeight), 512, filters);
  const Camera camera = default_path(trees.scene()).at(0.3, kWidth, kHeight);
  strip_of(gallery, "power_cdf_overlap", trees, camera, 2048, filters);
  print(gallery, "| format | RMS to 32 bits |\n|---|---|");
  trees.draw(filter_from("power_cdf:radius=2"), camera, 2048);
  const std::vector<float> full = trees.visibility();
  for (const char* text : {"power_cdf:radius=2,format=fp16", "power_cdf:radius=2,format=unorm16"}) {
    trees.draw(filter_from(text), camera, 2048);
    print(gallery, "| %s | %.4f |", text, rms(trees.visibility(), full));
  }
  strip_of(gallery, "power_cdf_bits", trees, camera, 2048,
           {"power_cdf:radius=2", "power_cdf:radius=2,format=fp16", "power_cdf:radius=2,format=unorm16"});
}

/// Share of pixels that face the light, no bias taken, where a texel of the kernel lies behind the receiver
/// by enough, by either of the paper's classifications.
struct Failures {
  double threshold = 0.0, depth_max = 0.0;
};
Failures esm_failures(const FilterStage& stage, const Camera& camera, int radius, double c) {
  constexpr double kEpsilon = 0.02;  // of the answer above 1: esm's default
  const FloatImage depth = stage.renderer().depth_map(0), points = stage.renderer().positions();
  const FloatImage normals = stage.renderer().normals();
  const std::vector<float> lit = stage.visibility();
  const glm::dvec3 light = stage.plan().light_direction;
  const glm::dmat4& clip = stage.plan().map[0].clip_from_world;
  Failures failures;
  double count = 0.0;
  for (std::size_t i = 0; i < lit.size(); ++i) {
    const float* n = &normals.values[4 * i];
    if (lit[i] < 0.0f || glm::dot(light, glm::dvec3(n[0], n[1], n[2])) >= 0.0) continue;
    const float* p = &points.values[4 * i];
    const glm::dvec4 h = clip * glm::dvec4(camera.position + glm::dvec3(p[0], p[1], p[2]), 1.0);
    const int column = static_cast<int>(std::floor((h.x / h.w * 0.5 + 0.5) * depth.width));
    const int row = static_cast<int>(std::floor((h.y / h.w * 0.5 + 0.5) * depth.height));
    double sum = 0.0, largest = 0.0;
    for (int k = 0; k < (2 * radius + 1) * (2 * radius + 1); ++k) {
      const int x = std::clamp(column - radius + k % (2 * radius + 1), 0, depth.width - 1);
      const int y = std::clamp(row - radius + k / (2 * radius + 1), 0, depth.height - 1);
      const double z = depth.values[static_cast<std::size_t>(y * depth.width + x)];
      sum += std::exp(c * (z - h.z / h.w));
      largest = std::max(largest, z);
    }
    const double answer = sum / ((2.0 * radius + 1.0) * (2.0 * radius + 1.0));
    failures.threshold += answer > 1.0 + kEpsilon ? 1.0 : 0.0;
    failures.depth_max += h.z / h.w + std::log(1.0 + kEpsilon) / c < largest ? 1.0 : 0.0;
    count += 1.0;
  }
  return {failures.threshold / count, failures.depth_max / count};
}

void failures(Gallery& gallery, FilterStage& fence, FilterStage& trees) {
  print(gallery, "## ESM: share of pixels where the mean fails (c = 80, 1024 texels)\n");
  print(gallery, "| scene | blur | by threshold | by largest depth |\n|---|---|---|---|");
  for (FilterStage* stage : {&fence, &trees}) {
    const Camera camera = default_path(stage->scene()).at(0.25, kWidth, kHeight);
    stage->draw(filter_from("hard"), camera, 1024);
    for (int radius = 0; radius <= 3; ++radius) {
      const Failures f = esm_failures(*stage, camera, radius, 80.0);
      print(gallery, "| %s | %dx%d | %.2f %% | %.2f %% |", stage->scene().name.c_str(), 2 * radius + 1,
            2 * radius + 1, 100.0 * f.threshold, 100.0 * f.depth_max);
    }
  }
}

void samples(Gallery& gallery, FilterStage& fence) {
  print(gallery, "\n## Samples that PCF takes to match a trilinear read of ESM (fence, 4 times as far)\n");
  print(gallery, "| filter | RMS to the truth |\n|---|---|");
  const Camera camera = receding(4.0, kWidth, kHeight);
  const std::vector<float> exact = truth(fence, receding, 4.0);
  std::vector<std::string> filters{"esm:radius=1,mipmap=1"};
  for (int count = 1; count <= 64; count *= 2)
    filters.push_back("pcf:pattern=1,radius=2,samples=" + std::to_string(count));
  for (const std::string& text : filters) {
    fence.draw(filter_from(text), camera, 2048);
    print(gallery, "| %s | %.4f |", text.c_str(), rms(fence.visibility(), exact));
  }
}

void memory(Gallery& gallery) {
  const double convolution = render::bytes_per_texel(filter_from("convolution")) - 4.0;
  print(gallery, "\n## Memory: bytes a texel besides the depth map's four\n");
  print(gallery, "| filter | format | bytes | of convolution, order 16, 8 bits |\n|---|---|---|---|");
  for (const render::Filter* filter : render::all_filters()) {
    FilterSettings settings = render::default_settings(*filter);
    for (const render::TexelFormat format : filter->formats) {
      settings.format = format;
      const double bytes = render::bytes_per_texel(settings) - 4.0;
      print(gallery, "| %s | %s | %.1f | %.3f |", std::string(filter->name).c_str(),
            std::string(to_string(format)).c_str(), bytes, bytes / convolution);
    }
  }
}

}  // namespace

void write_filter_gallery(const std::string& folder) {
  Gallery gallery{folder, {}};
  fs::create_directories(gallery.folder);
  gallery.text.open(gallery.folder / "gallery.md");
  print(gallery,
        "# Shadow filters\n\nTruth: the mean of 4 x 4 hard samples a pixel out of a map of 4096 texels.\n");
  FilterStage contact(contact_scene(false), 38.0, 250.0);
  convolution_orders(gallery, contact);
  FilterStage fence(load_scene("builtin:fence"), 38.0, 140.0);
  FilterStage bars(contact_scene(true), 38.0, 250.0);
  bleeding(gallery, bars, fence);
  minification(gallery, fence);
  FilterStage trees(load_scene("builtin:trees"), 38.0, 140.0);
  power_law(gallery, contact, trees);
  failures(gallery, fence, trees);
  samples(gallery, fence);
  memory(gallery);
  gallery.text.flush();
  if (!gallery.text) throw std::runtime_error(folder + ": gallery.md cannot be written");
  print_line((gallery.folder / "gallery.md").string());
  flush_output();
}

}  // namespace gnomon::tool
