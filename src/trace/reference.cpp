// The true shadow at every pixel: which rays are asked, and what is made of their answers.
#include "gnomon/trace/reference.hpp"
#include "gnomon/extend/shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "light_ray.hpp"
#include "sampling.hpp"
#include "surface_rays.hpp"

namespace gnomon::trace {
namespace {

struct Frame {
  glm::dvec3 x, y;
};
Frame frame_across(const glm::dvec3& direction) noexcept {
  const glm::dvec3 a = glm::abs(direction);
  const glm::dvec3 other = a.x <= a.y && a.x <= a.z
                               ? glm::dvec3(1, 0, 0)
                               : (a.y <= a.z ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1));
  const glm::dvec3 x = glm::normalize(glm::cross(other, direction));
  return {x, glm::cross(direction, x)};
}

/// How the column and the row of a map's texels change over the world, texels per world unit.
struct TexelSlopes {
  glm::dvec3 column, row;
};
TexelSlopes texel_slopes(const ShadowMap& map, const glm::dvec3& point) noexcept {
  const glm::dmat4& m = map.clip_from_world;
  const glm::dvec4 clip = m * glm::dvec4(point, 1.0);
  const glm::dvec2 ndc = glm::dvec2(clip) / clip.w;
  const auto row = [&m](int i) { return glm::dvec3(m[0][i], m[1][i], m[2][i]); };
  const glm::dvec3 over_x = row(0) - ndc.x * row(3), over_y = row(1) - ndc.y * row(3);
  const glm::dmat2 d = map.texels().place(ndc).texel_from_ndc / clip.w;
  return {over_x * d[0][0] + over_y * d[1][0], over_x * d[0][1] + over_y * d[1][1]};
}

/// Mean answer of `samples` rays per pixel; `make` gives ray `sample` of a point.
template <class Make>
SoftReference mean_of_rays(const Tracer& tracer, const SurfacePoints& points, int samples, Make&& make) {
  SoftReference result{points.width, points.height, {}};
  const auto width = static_cast<std::size_t>(points.width), per_pixel = static_cast<std::size_t>(samples);
  result.pixels.assign(points.pixels.size(), -1.0f);
  for_each_row(points.height, [&](int row) {
    std::vector<Ray> rays;
    std::vector<std::size_t> pixels;
    const std::size_t begin = static_cast<std::size_t>(row) * width;
    for (std::size_t i = begin; i < begin + width; ++i) {
      if (points.pixels[i].state != PixelState::facing) continue;
      if (!points.pixels[i].receives) {
        result.pixels[i] = 1.0f;
        continue;
      }
      pixels.push_back(i);
      for (int s = 0; s < samples; ++s)
        rays.push_back(make(points.pixels[i], static_cast<std::uint32_t>(i), s));
    }
    std::vector<std::uint8_t> stopped(rays.size());
    tracer.occluded(rays, stopped);
    for (std::size_t n = 0; n < pixels.size(); ++n) {
      int lit = 0;
      for (std::size_t s = 0; s < per_pixel; ++s) lit += stopped[n * per_pixel + s] == 0 ? 1 : 0;
      result.pixels[pixels[n]] = static_cast<float>(lit) / static_cast<float>(samples);
    }
  });
  return result;
}

}  // namespace

HardReference hard_reference(const Tracer& tracer, const SurfacePoints& points, const Light& light) {
  constexpr std::size_t kRays = 5;
  HardReference result{points.width, points.height, {}};
  const auto width = static_cast<std::size_t>(points.width);
  result.pixels.assign(points.pixels.size(), Verdict::none);
  for_each_row(points.height, [&](int row) {
    std::vector<Ray> rays;
    std::vector<std::size_t> pixels;
    const std::size_t begin = static_cast<std::size_t>(row) * width;
    for (std::size_t i = begin; i < begin + width; ++i) {
      const SurfacePoint& point = points.pixels[i];
      if (point.state == PixelState::undecided) result.pixels[i] = Verdict::undecided;
      if (point.state != PixelState::facing) continue;
      if (!point.receives) {
        result.pixels[i] = Verdict::lit;
        continue;
      }
      pixels.push_back(i);
      const LightRay to_light = light_ray(light, point.position);
      const double error = error_of(tracer, light, point);
      const Frame across = frame_across(to_light.direction);
      for (const glm::dvec3& offset : {glm::dvec3(0.0), across.x, -across.x, across.y, -across.y})
        rays.push_back(ray_off_plane(point, point.position + error * offset, to_light.direction,
                                     to_light.distance, error));
    }
    std::vector<std::uint8_t> stopped(rays.size());
    tracer.occluded(rays, stopped);
    for (std::size_t n = 0; n < pixels.size(); ++n) {
      int count = 0;
      for (std::size_t s = 0; s < kRays; ++s) count += stopped[n * kRays + s];
      result.pixels[pixels[n]] = count == 0       ? Verdict::lit
                                 : count == kRays ? Verdict::shadow
                                                  : Verdict::undecided;
    }
  });
  return result;
}

KernelAxes texel_axes(const ShadowMap& map, const glm::dvec3& point, double radius_texels) noexcept {
  const auto [texel_x, texel_y] = texel_slopes(map, point);
  const glm::dvec3 light = glm::normalize(glm::dvec3(map.light_world) - map.light_world.w * point);
  // Vectors across the light whose change of one texel coordinate is 1 and of the other 0.
  const glm::dvec3 x = glm::cross(texel_y, light), y = glm::cross(light, texel_x);
  const double determinant = glm::dot(texel_x, x);
  if (!(std::abs(determinant) > 0.0) || !std::isfinite(determinant)) return {};
  return {x * (radius_texels / determinant), y * (radius_texels / determinant)};
}

glm::dvec2 pixel_in_texels(const ShadowMap& map, const glm::dvec3& point, const KernelAxes& facet) noexcept {
  const auto [texel_x, texel_y] = texel_slopes(map, point);
  return {std::hypot(glm::dot(texel_x, facet.x), glm::dot(texel_x, facet.y)),
          std::hypot(glm::dot(texel_y, facet.x), glm::dot(texel_y, facet.y))};
}

KernelAxes world_axes(const Light& light, const glm::dvec3& point, double radius) noexcept {
  const Frame across = frame_across(light_ray(light, point).direction);
  return {radius * across.x, radius * across.y};
}

KernelAxes facet_axes(const Camera& camera, const SurfacePoint& point) noexcept {
  const CameraAxes axes = camera_axes(camera);
  const glm::dvec3 way = point.position - camera.position, ray = camera.orthographic ? axes.forward : way;
  const double across = glm::dot(point.normal, ray);
  if (!(across < 0.0)) return {};
  const double depth = camera.orthographic ? 1.0 : glm::dot(axes.forward, way);
  const auto half_side = [&](const glm::dvec3& axis, double pixel) {
    const glm::dvec3 step = axis * (pixel * depth);
    return 0.5 * (step - ray * std::clamp(glm::dot(point.normal, step) / across, -1.0, 1.0));
  };
  return {half_side(axes.right, (camera.right - camera.left) / camera.width),
          half_side(axes.up, (camera.top - camera.bottom) / camera.height)};
}

SoftReference filtered_reference(const Tracer& tracer, const SurfacePoints& points, const Light& light,
                                 KernelShape shape, const std::function<KernelAxes(std::size_t pixel)>& axes,
                                 int samples) {
  return mean_of_rays(tracer, points, samples,
                      [&](const SurfacePoint& point, std::uint32_t pixel, int sample) {
                        const KernelAxes kernel = axes(pixel);
                        const glm::dvec2 at = to_kernel(shape, stratified(pixel, sample, samples));
                        const LightRay centre = light_ray(light, point.position);
                        const double error = error_of(tracer, light, point);
                        const glm::dvec3 from = point.position + at.x * kernel.x + at.y * kernel.y;
                        if (std::holds_alternative<DirectionalLight>(light))
                          return ray_off_plane(point, from, centre.direction, centre.distance, error);
                        const LightRay shifted = light_ray(light, from);
                        return ray_off_plane(point, from, shifted.direction, shifted.distance, error);
                      });
}

SoftReference area_reference(const Tracer& tracer, const SurfacePoints& points, const Light& light,
                             double radius, int samples) {
  return mean_of_rays(
      tracer, points, samples, [&](const SurfacePoint& point, std::uint32_t pixel, int sample) {
        const LightRay centre = light_ray(light, point.position);
        const Frame across = frame_across(centre.direction);
        const glm::dvec2 at = radius * to_kernel(KernelShape::disc, stratified(pixel, sample, samples));
        const bool parallel = std::holds_alternative<DirectionalLight>(light);
        const glm::dvec3 to_sample =
            centre.direction * (parallel ? 1.0 : centre.distance) + at.x * across.x + at.y * across.y;
        const double length = glm::length(to_sample);
        return ray_off_plane(point, point.position, to_sample / length, parallel ? centre.distance : length,
                             error_of(tracer, light, point));
      });
}

}  // namespace gnomon::trace
