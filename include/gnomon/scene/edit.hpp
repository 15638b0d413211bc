// A scene other than its file has it: turned upright, without a sky's shadow, with shadow proxies, cut open
// by planes, or with a ground under it.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "gnomon/scene/load.hpp"
#include "gnomon/scene/scene.hpp"
#include "gnomon/scene/sun.hpp"

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
  std::string proxies = {};            ///< scene for cast_by_proxies(), before both; empty: none
  UpAxis up = UpAxis::y;               ///< of the file; turn_up(), before all others
  bool open_sky = false;               ///< open_sky(), after that
  /// Equal in all members.
  bool operator==(const SceneEdits&) const = default;
};

/// Turns a world with z up to y up: what was at (x, y, z) is at (x, z, -y). Instances, lights, cameras and
/// animations turn alike. UpAxis::y changes nothing.
void turn_up(UpAxis up, Scene& scene);
/// True where a mesh surrounds all the rest from afar, faces it, and casts: a sky that darkens the scene.
[[nodiscard]] bool has_sky_that_casts(const Scene& scene);
/// Lets such meshes cast no shadow. A sky that shares its mesh with other things casts as before.
void open_sky(Scene& scene);
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
/// Lets meshes of `proxies` cast in place of the scene's. For each node it is the mesh of the node of the
/// same name, else the mesh of the name of its mesh. A shadow proxy stands in the object space of its
/// original, follows its animation, and is not seen. Originals receive, and cast no more. A node with a skin,
/// that an animation bends, that casts none or has a proxy, stays as it is. A warning of the scene names
/// each, and proxies of these kinds, ambiguous names, and nodes that match nothing. `where`: file, for
/// messages. Throws SceneError where nothing matches, or where the scene grows beyond the limits.
void cast_by_proxies(const Scene& proxies, const std::string& where, const LoadLimits& limits, Scene& scene);
/// Triangles that a map of the whole scene draws.
struct CastTriangles {
  std::uint64_t by_proxies = 0;  ///< with shadow proxies
  std::uint64_t without = 0;     ///< as if originals cast
};
[[nodiscard]] CastTriangles cast_triangles(const Scene& scene) noexcept;
/// All edits. Throws SceneError where the proxies cannot be read, or match nothing.
void edit(const SceneEdits& edits, Scene& scene, const LoadLimits& limits = {});

}  // namespace gnomon
