// Where does everything in an animated scene stand at a time?
// Based on: Khronos Group, glTF 2.0 Specification (2021), sections 3.7.2.2 "Morph Targets", 3.7.3 "Skins" and
// 3.11 "Animations".
#include "gnomon/scene/pose.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/matrix.hpp>

#include "bounds_of.hpp"
#include "deform.hpp"
#include "node_matrix.hpp"
#include "sampler.hpp"
#include "triangles.hpp"

namespace gnomon {

namespace {

/// How nodes and weights stand, whatever instances there are.
struct Skeleton {
  std::vector<glm::dmat4> world_from_node;
  std::vector<double> weights;
};

struct DrivenNode {
  glm::dvec3 translation;
  glm::dquat rotation;
  glm::dvec3 scale;
};

Skeleton skeleton_at(const SceneMotion& motion, int animation, double time_s) {
  Skeleton out;
  out.weights.assign(motion.weights.begin(), motion.weights.end());
  std::vector<DrivenNode> driven;
  std::vector<int> driven_by(motion.nodes.size(), -1);
  if (animation != kRestPose) {
    const Animation& played = motion.animations[static_cast<std::size_t>(animation)];
    for (const AnimationChannel& channel : played.channels) {
      const AnimationSampler& sampler = played.samplers[channel.sampler];
      if (channel.part == AnimatedPart::weights) {
        detail::sample(sampler, time_s, false, std::span(out.weights).subspan(channel.target, sampler.width));
        continue;
      }
      const MotionNode& node = motion.nodes[channel.target];
      int& at = driven_by[channel.target];
      if (at < 0) {
        at = static_cast<int>(driven.size());
        driven.push_back({node.translation, node.rotation, node.scale});
      }
      DrivenNode& to = driven[static_cast<std::size_t>(at)];
      std::array<double, 4> v{};
      const bool turns = channel.part == AnimatedPart::rotation;
      detail::sample(sampler, time_s, turns, std::span(v).first(sampler.width));
      if (turns)
        to.rotation = glm::dquat(v[3], v[0], v[1], v[2]);
      else
        (channel.part == AnimatedPart::scale ? to.scale : to.translation) = {v[0], v[1], v[2]};
    }
  }
  for (std::size_t n = 0; n < motion.nodes.size(); ++n) {
    const MotionNode& node = motion.nodes[n];
    const glm::dmat4& world_from_parent =
        node.parent < 0 ? node.world_from_parent : out.world_from_node[static_cast<std::size_t>(node.parent)];
    if (driven_by[n] < 0) {
      out.world_from_node.push_back(world_from_parent * node.parent_from_node);
    } else {
      const DrivenNode& to = driven[static_cast<std::size_t>(driven_by[n])];
      out.world_from_node.push_back(world_from_parent *
                                    detail::composed(to.translation, to.rotation, to.scale));
    }
  }
  return out;
}

class Poser {
 public:
  Poser(const Scene& scene, const Skeleton& skeleton, Pose& out)
      : scene_(scene), motion_(scene.motion), skeleton_(skeleton), out_(out) {}

  void place(const MovedInstance& moved) {
    const Primitive& primitive = scene_.primitives[scene_.instances[moved.instance].primitive];
    const glm::dmat4& at = skeleton_.world_from_node[moved.node];
    add(moved.instance, at, detail::transformed_bounds(scene_, primitive, at));
  }

  void bend(const DeformedMesh& mesh) {
    const Instance& instance = scene_.instances[mesh.instance];
    const Primitive& primitive = scene_.primitives[instance.primitive];
    const std::span<const std::uint32_t> corners(&scene_.indices[primitive.first_index],
                                                 primitive.index_count);
    PosedVertices range{mesh.instance,
                        out_.positions.size(),
                        mesh.first_vertex,
                        static_cast<std::uint32_t>(mesh.positions.size()),
                        {}};
    out_.positions.insert(out_.positions.end(), mesh.positions.begin(), mesh.positions.end());
    out_.normals.resize(out_.positions.size());
    std::copy(mesh.normals.begin(), mesh.normals.end(),
              out_.normals.begin() + static_cast<std::ptrdiff_t>(range.first));
    const std::span<glm::vec3> positions = std::span(out_.positions).subspan(range.first),
                               normals = std::span(out_.normals).subspan(range.first);
    const std::span<glm::vec3> smooth = mesh.normals.empty() ? std::span<glm::vec3>() : normals;
    morph(mesh, positions, smooth);
    follow_joints(mesh, positions, smooth);
    if (mesh.normals.empty())
      flatten(positions, normals);
    else
      detail::repair_normals(positions, corners, normals, mesh.first_vertex);
    const glm::dmat4& at = mesh.node < 0 ? instance.world_from_object
                                         : skeleton_.world_from_node[static_cast<std::size_t>(mesh.node)];
    Box world;
    for (const std::uint32_t corner : corners) {
      const glm::dvec3 position(positions[corner - mesh.first_vertex]);
      range.bounds.extend(position);
      world.extend(glm::dvec3(at * glm::dvec4(position, 1.0)));
    }
    const bool finite = std::all_of(positions.begin(), positions.end(), [](const glm::vec3& p) {
      return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    });
    if (!add(mesh.instance, at, finite ? world : Box{})) {
      std::copy_n(scene_.positions.begin() + mesh.first_vertex, range.count, positions.begin());
      std::copy_n(scene_.normals.begin() + mesh.first_vertex, range.count, normals.begin());
      range.bounds = primitive.bounds;
    }
    out_.vertices.push_back(range);
  }

 private:
  /// False where that is not finite; the instance is at rest then.
  bool add(std::uint32_t instance, const glm::dmat4& at, const Box& bounds_world) {
    PosedInstance posed{instance, at, glm::determinant(glm::dmat3(at)) < 0.0, bounds_world};
    const bool finite = !bounds_world.empty() && detail::is_finite(bounds_world);
    if (!finite) {
      const Instance& rest = scene_.instances[instance];
      posed = {instance, rest.world_from_object, rest.mirrored, rest.bounds_world};
      ++out_.at_rest;
    }
    out_.instances.push_back(posed);
    return finite;
  }

  void morph(const DeformedMesh& mesh, std::span<glm::vec3> positions, std::span<glm::vec3> normals) const {
    const auto move = [&](std::span<glm::vec3> values, auto offsets) {
      for (std::size_t v = 0; v < values.size(); ++v) {
        glm::dvec3 sum(values[v]);
        for (std::size_t t = 0; t < mesh.targets.size(); ++t) {
          const std::vector<glm::vec3>& by = offsets(mesh.targets[t]);
          const double weight = skeleton_.weights[mesh.first_weight + t];
          if (!by.empty() && weight != 0.0) sum += weight * glm::dvec3(by[v]);
        }
        values[v] = glm::vec3(sum);
      }
    };
    if (mesh.targets.empty()) return;
    move(
        positions, [](const MorphTarget& t) -> const auto& { return t.positions; });
    move(
        normals, [](const MorphTarget& t) -> const auto& { return t.normals; });
  }

  void follow_joints(const DeformedMesh& mesh, std::span<glm::vec3> positions, std::span<glm::vec3> normals) {
    if (mesh.influences == 0) return;
    const auto skin = static_cast<std::size_t>(mesh.skin);
    if (joints_of_ != mesh.skin) {
      joints_of_ = mesh.skin;
      const MotionSkin& of = motion_.skins[skin];
      joints_.clear();
      for (std::size_t j = 0; j < of.joints.size(); ++j)
        joints_.push_back(skeleton_.world_from_node[of.joints[j]] * of.joint_from_mesh[j]);
    }
    detail::carry({mesh.influences, mesh.joints, mesh.joint_weights}, joints_, positions, normals);
  }

  static void flatten(std::span<const glm::vec3> positions, std::span<glm::vec3> normals) {
    for (std::size_t i = 0; i + 2 < positions.size(); i += 3) {
      const glm::vec3 normal = detail::face_normal(positions[i], positions[i + 1], positions[i + 2]);
      std::fill_n(normals.begin() + static_cast<std::ptrdiff_t>(i), 3, normal);
    }
  }

  const Scene& scene_;
  const SceneMotion& motion_;
  const Skeleton& skeleton_;
  Pose& out_;
  std::vector<glm::dmat4> joints_;  ///< world from mesh, of the last skin
  int joints_of_ = -1;
};

}  // namespace

bool pose(const Scene& scene, int animation, double time_s, Pose& out) {
  out.instances.clear();
  out.vertices.clear();
  out.positions.clear();
  out.normals.clear();
  out.at_rest = 0;
  const SceneMotion& motion = scene.motion;
  const bool known = animation >= 0 && static_cast<std::size_t>(animation) < motion.animations.size();
  const bool valid = animation == kRestPose || (known && std::isfinite(time_s));
  const Skeleton skeleton = skeleton_at(motion, valid ? animation : kRestPose, time_s);
  Poser poser(scene, skeleton, out);
  // Both lists run by their instances.
  auto moved = motion.instances.begin();
  for (const DeformedMesh& mesh : motion.meshes) {
    for (; moved != motion.instances.end() && moved->instance < mesh.instance; ++moved) poser.place(*moved);
    poser.bend(mesh);
  }
  for (; moved != motion.instances.end(); ++moved) poser.place(*moved);
  return valid;
}

void apply_pose(const Pose& pose, Scene& scene) {
  for (const PosedVertices& range : pose.vertices) {
    std::copy_n(pose.positions.begin() + static_cast<std::ptrdiff_t>(range.first), range.count,
                scene.positions.begin() + range.first_vertex);
    std::copy_n(pose.normals.begin() + static_cast<std::ptrdiff_t>(range.first), range.count,
                scene.normals.begin() + range.first_vertex);
    scene.primitives[scene.instances[range.instance].primitive].bounds = range.bounds;
  }
  for (const PosedInstance& posed : pose.instances) {
    Instance& instance = scene.instances[posed.instance];
    instance.world_from_object = posed.world_from_object;
    instance.mirrored = posed.mirrored;
    instance.bounds_world = posed.bounds_world;
  }
  if (pose.instances.empty()) return;
  scene.bounds_world = {};
  for (const Instance& instance : scene.instances)
    if (instance.shown) scene.bounds_world.extend(instance.bounds_world);
}

}  // namespace gnomon
