// A scene other than its file has it: with a ground under it, or cut open by planes.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "gnomon/scene/scene.hpp"

namespace gnomon {

/// Cuts away the points p with dot(normal, p) > distance.
struct SectionPlane {
  glm::dvec3 normal{0.0, 1.0, 0.0};  ///< world space, of any length but zero
  double distance = 0.0;             ///< from the origin along the normal, in lengths of the normal
  /// Equal in all members.
  bool operator==(const SectionPlane&) const = default;
};
inline constexpr std::size_t kMaxSections = 8;  ///< of SceneEdits

/// How a scene is changed once it is loaded.
struct SceneEdits {
  bool ground = false;                 ///< add_ground()
  std::vector<SectionPlane> sections;  ///< cut_by(), before the ground
  /// Equal in all members.
  bool operator==(const SceneEdits&) const = default;
};

/// True where something lies under the scene that a shadow could fall on: a ground or land. Surfaces of its
/// own count where they face up and have nothing below them, over half of it or more.
[[nodiscard]] bool has_ground(const Scene& scene);
/// Adds a level plane right below the lowest point of what the scene is about (default_path), sixteen times
/// as wide as that. It receives and does not cast. Scene::bounds_world stays that of the model, so that
/// default_light() does. Nothing is added to a scene without triangles.
void add_ground(Scene& scene);
/// Cuts all instances by the planes, in order: casters and receivers alike. Cuts stay open. New vertices lie
/// on the plane as far as single precision in the instance's space can say, and edges that triangles share
/// stay shared. Instances beyond a plane are removed. Animations are removed with a warning, as a cut holds
/// for one pose. Planes with a normal of zero or numbers that are not finite do nothing.
void cut_by(std::span<const SectionPlane> planes, Scene& scene);
/// All edits.
void edit(const SceneEdits& edits, Scene& scene);

}  // namespace gnomon
