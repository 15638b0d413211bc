// All triangles of a scene, placed in the world, and what of them alpha masks leave.
#include "world_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace gnomon::trace {
namespace {

/// Texture coordinates beyond this are no texture any more; the cast to int needs some bound.
constexpr double kFarTexel = 1e9;

Cutout make_cutout(const Material& material, const Scene& scene) {
  Cutout cutout;
  cutout.wrap_u = material.wrap_u;
  cutout.wrap_v = material.wrap_v;
  cutout.base_alpha = material.base_color.a;
  cutout.cutoff = material.alpha_cutoff;
  if (material.alpha_mode == AlphaMode::opaque || material.base_color_image < 0) return cutout;
  const Image& image = scene.images[static_cast<std::size_t>(material.base_color_image)];
  cutout.width = image.width;
  cutout.height = image.height;
  cutout.alpha.reserve(image.rgba.size() / 4);
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) cutout.alpha.push_back(image.rgba[i]);
  return cutout;
}

}  // namespace

bool Cutout::keeps(const glm::dvec2& texcoord) const noexcept {
  if (width <= 0 || height <= 0) return base_alpha >= cutoff;
  const double x = std::clamp(texcoord.x * width - 0.5, -kFarTexel, kFarTexel);
  const double y = std::clamp(texcoord.y * height - 0.5, -kFarTexel, kFarTexel);
  const double left = std::floor(x), top = std::floor(y);
  const auto at = [this](int column, int row) {
    const auto texel =
        static_cast<std::size_t>(wrapped(row, height, wrap_v)) * static_cast<std::size_t>(width) +
        static_cast<std::size_t>(wrapped(column, width, wrap_u));
    return alpha[texel] / 255.0;
  };
  const int column = static_cast<int>(left), row = static_cast<int>(top);
  const double fx = x - left, fy = y - top;
  const double upper = at(column, row) * (1.0 - fx) + at(column + 1, row) * fx;
  const double lower = at(column, row + 1) * (1.0 - fx) + at(column + 1, row + 1) * fx;
  return (upper * (1.0 - fy) + lower * fy) * base_alpha >= cutoff;
}

WorldTriangles::WorldTriangles(const Scene& scene) {
  cutouts.reserve(scene.materials.size());
  for (const Material& material : scene.materials) cutouts.push_back(make_cutout(material, scene));
  corners.reserve(scene.triangle_count());
  const auto add = [&](bool masked) {
    for (const Instance& instance : scene.instances) {
      const Primitive& primitive = scene.primitives[instance.primitive];
      const auto material = static_cast<std::uint32_t>(primitive.material);
      if ((scene.materials[material].alpha_mode != AlphaMode::opaque) != masked) continue;
      const bool mirrored = glm::determinant(glm::dmat3(instance.world_from_object)) < 0.0;
      const std::int8_t side = scene.materials[material].double_sided ? 0 : mirrored ? -1 : 1;
      for (std::uint32_t i = 0; i + 2 < primitive.index_count; i += 3) {
        shown_side.push_back(side);
        instance_of.push_back(static_cast<std::uint32_t>(&instance - scene.instances.data()));
        casts.push_back(instance.casts);
        receives.push_back(instance.receives);
        shown.push_back(instance.shown);
        std::array<glm::vec2, 3> uv;
        Corners& placed = corners.emplace_back();
        for (std::uint32_t k = 0; k < 3; ++k) {
          const std::uint32_t vertex = scene.indices[primitive.first_index + i + k];
          placed[k] = glm::dvec3(instance.world_from_object * glm::dvec4(scene.positions[vertex], 1.0));
          uv[k] = scene.texcoords[vertex];
          bounds.extend(placed[k]);
        }
        if (!masked) continue;
        texcoords.push_back(uv);
        cutout_of.push_back(material);
      }
    }
  };
  add(false);
  opaque = static_cast<std::uint32_t>(corners.size());
  add(true);
}

bool WorldTriangles::is_there(std::uint32_t triangle, double b1, double b2) const noexcept {
  if (triangle < opaque) return true;
  const std::array<glm::vec2, 3>& uv = texcoords[triangle - opaque];
  const glm::dvec2 at = (1.0 - b1 - b2) * glm::dvec2(uv[0]) + b1 * glm::dvec2(uv[1]) + b2 * glm::dvec2(uv[2]);
  return cutouts[cutout_of[triangle - opaque]].keeps(at);
}

}  // namespace gnomon::trace
