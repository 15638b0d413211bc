// Which view depths of a scene can show a surface?
#include "gnomon/scene/coarse_view.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace gnomon {
namespace {

/// Planes of the camera's image and of its near end, relative to its position, pointing inward.
std::array<glm::dvec4, 5> image_planes(const Camera& camera, const CameraAxes& axes) noexcept {
  const auto side = [&](const glm::dvec3& axis, double edge, double sign) {
    return camera.orthographic ? glm::dvec4(sign * axis, -sign * edge)
                               : glm::dvec4(sign * (axis - edge * axes.forward), 0.0);
  };
  return {side(axes.right, camera.left, 1.0), side(axes.right, camera.right, -1.0),
          side(axes.up, camera.bottom, 1.0), side(axes.up, camera.top, -1.0),
          glm::dvec4(axes.forward, -camera.near_depth)};
}

bool wholly_outside(const Box& box, const glm::dvec3& origin, const glm::dvec4& plane) noexcept {
  const glm::dvec3 normal(plane);
  const glm::dvec3 farthest = glm::mix(box.min, box.max, glm::greaterThan(normal, glm::dvec3(0.0)));
  return glm::dot(normal, farthest - origin) + plane.w < 0.0;
}

CoarseMesh mesh_of(const Scene& scene, const Instance& instance) noexcept {
  const Primitive& primitive = scene.primitives[instance.primitive];
  const Material& material = scene.materials[static_cast<std::size_t>(primitive.material)];
  CoarseMesh mesh;
  mesh.positions = scene.positions;
  mesh.indices = std::span(scene.indices).subspan(primitive.first_index, primitive.index_count);
  mesh.world_from_object = instance.world_from_object;
  mesh.occludes = material.alpha_mode == AlphaMode::opaque;
  mesh.double_sided = material.double_sided;
  mesh.mirrored = instance.mirrored;
  return mesh;
}

}  // namespace

VisibleDepths CoarseView::depths(const Scene& scene, const Camera& camera, std::uint64_t most_triangles) {
  const std::array<glm::dvec4, 5> planes = image_planes(camera, camera_axes(camera));
  candidates_.clear();
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Box& box = scene.instances[i].bounds_world;
    if (!scene.instances[i].shown || box.empty() ||
        std::any_of(planes.begin(), planes.end(),
                    [&](const glm::dvec4& plane) { return wholly_outside(box, camera.position, plane); }))
      continue;
    const double distance = glm::length(camera.position - glm::clamp(camera.position, box.min, box.max));
    candidates_.push_back({glm::length(box.max - box.min) / std::max(distance, camera.near_depth), i});
  }
  std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
    return a.size != b.size ? a.size > b.size : a.instance < b.instance;
  });
  meshes_.clear();
  boxes_.clear();
  std::uint64_t left = most_triangles;
  for (const Candidate& candidate : candidates_) {
    const Instance& instance = scene.instances[candidate.instance];
    const std::uint64_t triangles = scene.primitives[instance.primitive].index_count / 3;
    if (triangles > left) {
      boxes_.push_back(instance.bounds_world);
      continue;
    }
    left -= triangles;
    meshes_.push_back(mesh_of(scene, instance));
  }
  tiles_.resize(coarse_tile_count(camera));
  return coarse_depths(camera, meshes_, boxes_, tiles_);
}

}  // namespace gnomon
