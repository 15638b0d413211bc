// Where does everything in an animated scene stand at a time?
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "gnomon/scene/scene.hpp"

namespace gnomon {

/// An instance as posed.
struct PosedInstance {
  std::uint32_t instance = 0;         ///< index into Scene::instances
  glm::dmat4 world_from_object{1.0};  ///< affine
  bool mirrored = false;              ///< as Instance::mirrored
  Box bounds_world;                   ///< of the posed vertices
  /// Equal in all members.
  bool operator==(const PosedInstance&) const = default;
};

/// Vertices that were bent: `count` entries of Pose::positions and Pose::normals from `first` on.
struct PosedVertices {
  std::uint32_t instance = 0;      ///< that shows them, alone
  std::size_t first = 0;           ///< in the pose
  std::uint32_t first_vertex = 0;  ///< in the scene
  std::uint32_t count = 0;         ///< vertices
  Box bounds;                      ///< object space, as Primitive::bounds
};

/// A scene at one time of one animation. Lists the instances that any of its animations can move, so that the
/// pose of one animation follows that of another. Its memory is used again by the next pose().
struct Pose {
  std::vector<PosedInstance> instances;  ///< by their order in the scene
  std::vector<PosedVertices> vertices;   ///< the same
  std::vector<glm::vec3> positions;      ///< object space, as Scene::positions
  std::vector<glm::vec3> normals;        ///< unit, object space
  std::uint32_t at_rest = 0;             ///< instances kept at rest, because their pose would not be finite
};

/// Index that stands for no animation: everything at rest.
inline constexpr int kRestPose = -1;

/// Poses the scene at `time_s` seconds of an animation, or of none (kRestPose). Before the first key and
/// after the last one values stay; looped_time() repeats. False, and the pose at rest, for an animation that
/// is not there and for a time that is not finite. The same arguments give the same bits. Source: Khronos
/// Group, glTF 2.0 Specification (2021), sections 3.7.3 "Skins" and 3.11 "Animations".
bool pose(const Scene& scene, int animation, double time_s, Pose& out);

/// Places a scene's instances and vertices as posed; all bounds follow. `pose` must come from the same scene
/// or from a copy of it.
void apply_pose(const Pose& pose, Scene& scene);

}  // namespace gnomon
