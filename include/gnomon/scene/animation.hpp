// Which parts of a scene move, and when? Keyframes, the nodes they move, skins and morph targets. Plain data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace gnomon {

/// How values run from one key to the next.
/// Source: Khronos Group, glTF 2.0 Specification (2021), appendix C "Animation Sampler Interpolation Modes".
enum class Interpolation : std::uint8_t {
  step,          ///< the earlier key's value
  linear,        ///< straight between keys; rotations turn evenly, the short way round
  cubic_spline,  ///< Hermite curves, with a tangent into and out of each key
};

/// Part of a node that a channel drives.
enum class AnimatedPart : std::uint8_t { translation, rotation, scale, weights };

/// A curve of keys. Valid as the loader gives it: at least one key, times finite, >= 0 and not decreasing,
/// values finite.
struct AnimationSampler {
  Interpolation interpolation = Interpolation::linear;  ///< between keys; before the first and after the last
                                                        ///< the value stays
  std::uint32_t width = 3;  ///< numbers in a value: 3, 4 for rotations (x, y, z, w), or one for each target
  std::vector<float> times_s;  ///< seconds
  /// times_s.size() x width; of cubic_spline three times that: in-tangent, value, out-tangent of each key.
  std::vector<float> values;
};

/// A curve and its target.
struct AnimationChannel {
  std::uint32_t sampler = 0;                      ///< index into Animation::samplers
  AnimatedPart part = AnimatedPart::translation;  ///< of the target
  std::uint32_t target = 0;  ///< index into SceneMotion::nodes; of weights, into SceneMotion::weights
};

/// One animation of a file. Without channels it moves nothing, and its duration is 0.
struct Animation {
  std::string name;                        ///< as in the file; may be empty
  double duration_s = 0.0;                 ///< time of the last key of all channels, seconds
  std::vector<AnimationSampler> samplers;  ///< of all channels, which name theirs by its index
  std::vector<AnimationChannel> channels;  ///< at most one for each part of a target
};

/// A node that animations may move, or that a skin follows.
struct MotionNode {
  int parent = -1;                    ///< index into SceneMotion::nodes, below the node's own; -1: none moves
  glm::dmat4 world_from_parent{1.0};  ///< where `parent` is -1
  glm::dmat4 parent_from_node{1.0};   ///< at rest
  glm::dvec3 translation{0.0};        ///< at rest, as are the next two
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< of any length; one of no length is no turn
  glm::dvec3 scale{1.0};                    ///< along the node's own axes
};

/// The joints that vertices follow.
struct MotionSkin {
  std::vector<std::uint32_t> joints;        ///< indices into SceneMotion::nodes
  std::vector<glm::dmat4> joint_from_mesh;  ///< inverse bind matrices, one for each joint
};

/// Offsets of a mesh's vertices; empty lists stand for none.
struct MorphTarget {
  std::vector<glm::vec3> positions;  ///< one for each vertex
  std::vector<glm::vec3> normals;    ///< the same
};

/// A primitive whose vertices move: what they are made of. Its range of the scene's vertices is its own.
struct DeformedMesh {
  std::uint32_t instance = 0;        ///< the only one of its primitive
  int node = -1;                     ///< index into SceneMotion::nodes that places the instance; -1: it stays
  std::uint32_t first_vertex = 0;    ///< of Scene::positions
  int skin = -1;                     ///< index into SceneMotion::skins; -1: morph targets alone
  std::uint32_t first_weight = 0;    ///< of SceneMotion::weights, for targets[0]
  std::vector<glm::vec3> positions;  ///< in the mesh's own space, before targets and skin
  std::vector<glm::vec3> normals;    ///< empty: each triangle has its plane's, corners are not shared
  std::vector<MorphTarget> targets;  ///< added to the above, times their weights
  std::uint32_t influences = 0;      ///< joints for each vertex
  std::vector<std::uint32_t> joints;  ///< influences x vertices, indices into MotionSkin::joints
  std::vector<float> joint_weights;   ///< the same; all 0: the first joint carries the vertex
};

/// An instance whose vertices stay in its own space while a node moves it.
struct MovedInstance {
  std::uint32_t instance = 0;  ///< index into Scene::instances
  std::uint32_t node = 0;      ///< index into SceneMotion::nodes
};

/// Everything that a scene's animations need; empty for scenes without.
struct SceneMotion {
  std::vector<Animation> animations;     ///< in the file's order
  std::vector<MotionNode> nodes;         ///< parents before children
  std::vector<float> weights;            ///< of morph targets at rest, node by node
  std::vector<MotionSkin> skins;         ///< that `meshes` name
  std::vector<DeformedMesh> meshes;      ///< by their instances' order
  std::vector<MovedInstance> instances;  ///< by their order

  /// Memory of keys, vertices and matrices, bytes.
  [[nodiscard]] std::uint64_t bytes() const noexcept;
};

/// The time within an animation that repeats, seconds: from 0 up to, but not including, its duration. 0 for
/// animations without duration and for a time that is not finite.
[[nodiscard]] double looped_time(const Animation& animation, double time_s) noexcept;

/// Index of the animation of this name, else of the number that the word is; -1: none.
[[nodiscard]] int find_animation(const SceneMotion& motion, const std::string& word) noexcept;

}  // namespace gnomon
