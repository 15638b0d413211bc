// The figures of exponential shadow maps: where their mean fails, what they save, and what filters keep.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "filter_figures.hpp"
#include "gnomon/bias.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/load.hpp"

namespace gnomon::tool {
namespace {

/// What of a kernel a classification looks at, in depths of the map.
struct Kernel {
  double mean = 0.0;     ///< of exp(c (depth - receiver's))
  double largest = 0.0;  ///< depth
};
Kernel kernel_at(const FloatImage& depth, const glm::dvec3& at, int radius, double c) {
  const int side = 2 * radius + 1, column = static_cast<int>(std::floor(at.x)),
            row = static_cast<int>(std::floor(at.y));
  Kernel kernel;
  for (int k = 0; k < side * side; ++k) {
    const int x = std::clamp(column - radius + k % side, 0, depth.width - 1);
    const int y = std::clamp(row - radius + k / side, 0, depth.height - 1);
    const double z = depth.values[static_cast<std::size_t>(y * depth.width + x)];
    kernel.mean += std::exp(c * (z - at.z)) / (side * side);
    kernel.largest = std::max(kernel.largest, z);
  }
  return kernel;
}

/// Shares of the pixels that face the light, where a texel of the kernel lies behind the receiver by enough:
/// by the mean of the exponentials or by the largest depth; and by the bare inequality, that any texel does.
struct Failures {
  double threshold = 0.0, depth_max = 0.0, bare = 0.0;
};
Failures failures_of(const FilterStage& stage, const Camera& camera, int radius, double c) {
  constexpr double kEpsilon = 0.02;  // of the answer above 1: the filter's own default
  const FloatImage depth = stage.renderer().depth_map(0), points = stage.renderer().positions();
  const FloatImage normals = stage.renderer().normals();
  const std::vector<float> lit = stage.visibility();
  const ShadowPlan& plan = stage.plan();
  Receiver receiver{plan.map[0].clip_from_world, depth.width, depth.height, plan.light_direction, {}, {}};
  Failures failures;
  double count = 0.0;
  for (std::size_t i = 0; i < lit.size(); ++i) {
    const float *n = &normals.values[4 * i], *p = &points.values[4 * i];
    receiver.normal = {n[0], n[1], n[2]};
    receiver.point = camera.position + glm::dvec3(p[0], p[1], p[2]);
    if (lit[i] < 0.0f || glm::dot(receiver.light_direction, receiver.normal) >= 0.0) continue;
    const glm::dvec4 h = receiver.clip_from_world * glm::dvec4(receiver.point, 1.0);
    const glm::dvec3 at{(h.x / h.w * 0.5 + 0.5) * depth.width, (h.y / h.w * 0.5 + 0.5) * depth.height,
                        h.z / h.w};
    const Kernel kernel = kernel_at(depth, at, radius, c);
    // As the filter does: the rise of the receiver's own plane is no failure, nor are a texel's worth of
    // bias.
    const glm::dvec2 rise = glm::abs(receiver_plane(receiver).gradient), s = c * (radius + 0.5) * rise;
    const auto mean_over = [](double half) { return half > 1e-3 ? std::sinh(half) / half : 1.0; };
    const double allowed = std::log(1.0 + kEpsilon) + c * (rise.x + rise.y);
    const double plane = mean_over(std::min(s.x, 300.0)) * mean_over(std::min(s.y, 300.0));
    failures.threshold += std::log(kernel.mean / plane) > allowed ? 1.0 : 0.0;
    failures.depth_max += at.z + (allowed + s.x + s.y) / c < kernel.largest ? 1.0 : 0.0;
    failures.bare += at.z + std::log(1.0 + kEpsilon) / c < kernel.largest ? 1.0 : 0.0;
    count += 1.0;
  }
  count = std::max(count, 1.0);
  return {100.0 * failures.threshold / count, 100.0 * failures.depth_max / count,
          100.0 * failures.bare / count};
}

}  // namespace

Figure exponential_failures(const FigureSize& size) {
  constexpr double kExponent = 80.0;  // the paper's
  Figure figure{"exponential_failures",
                "ESM: percentage of pixels whose kernel holds a texel behind the receiver (c = 80)",
                {"scene, blur", "by threshold", "by largest depth",
                 "by largest depth, slant and bias counted as failure"},
                {},
                {}};
  for (const char* name : {"builtin:fence", "builtin:trees"}) {
    FilterStage stage(load_scene(name), 38.0, 140.0);
    const Camera camera = default_path(stage.scene()).at(0.25, size.width, size.height);
    stage.draw(filter_from("hard"), camera, size.wide_map / 2);
    for (int radius = 0; radius <= 3; ++radius) {
      const Failures f = failures_of(stage, camera, radius, kExponent);
      const std::string side = std::to_string(2 * radius + 1);
      figure.rows.push_back(
          {std::string(name) + ", " + side + "x" + side, {f.threshold, f.depth_max, f.bare}});
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
  std::vector<std::string> filters{"esm:radius=1,mipmap=1,fallback=0",
                                   "esm:radius=1,mipmap=1,fallback=0,anisotropy=16",
                                   "esm:radius=1,mipmap=1,anisotropy=16"};
  for (int count = 1; count <= 64; count *= 2)
    filters.push_back("pcf:pattern=1,radius=4,samples=" + std::to_string(count));
  for (const std::string& filter : filters) figure.rows.push_back({filter, {}});
  for (const double elevation_deg : {80.0, 38.0}) {
    FilterStage stage(grating_scene(), elevation_deg, 250.0);
    const CameraOf camera = [](int width, int height) { return grating_camera(4.0, width, height); };
    const std::vector<float> exact = true_visibility(stage, camera, size);
    for (Figure::Row& row : figure.rows) {
      stage.draw(filter_from(row.label), camera(size.width, size.height), size.wide_map);
      row.values.push_back(rms(stage.visibility(), exact));
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
