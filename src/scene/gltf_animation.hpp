// Which nodes of a glTF document do its animations move, and by which keys?
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "gltf_document.hpp"
#include "gltf_nodes.hpp"

namespace gnomon::detail {

/// Numbers that animations may still take.
class NumberBudget {
 public:
  explicit NumberBudget(std::uint64_t limit) : limit_(limit), left_(limit) {}
  [[nodiscard]] std::uint64_t left() const noexcept { return left_; }
  /// Takes count x size of them. Throws Refusal where they are too many.
  void spend(std::uint64_t count, std::uint64_t size, const std::string& where);

 private:
  std::uint64_t limit_, left_;
};

/// Fills Scene::motion. Broken samplers and channels are warned of and skipped.
class MotionReader {
 public:
  /// Reads all keys. Throws Refusal where they are above the limit.
  MotionReader(const Document& document, const NodeTree& tree, const LoadLimits& limits, Scene& scene);

  [[nodiscard]] NumberBudget& budget() noexcept { return budget_; }
  /// The node's index in SceneMotion::nodes where an animation moves it; -1: it stays.
  [[nodiscard]] int moved_node(int node) const;
  [[nodiscard]] bool moves_skin(int skin) const;
  /// First of the node's weights in SceneMotion::weights where an animation drives them.
  [[nodiscard]] std::optional<std::uint32_t> weights_of(int node) const;
  /// The skin's index in SceneMotion::skins, for one that moves. Throws LeftOut where it is broken.
  [[nodiscard]] int skin_of(int skin);

 private:
  using Known = std::map<std::tuple<std::size_t, std::uint32_t, bool>, int>;  // samplers by how they are read
  void read_animation(std::size_t index);
  void read_channel(const std::string& where, const AnimationSource& source,
                    const AnimationSource::Channel& channel, Animation& animation, Known& known);
  int read_sampler(const std::string& where, const AnimationSource& source, std::size_t index,
                   std::uint32_t width, AnimatedPart part, Animation& animation);
  /// Targets of the node's mesh; as many as its primitive with most has.
  [[nodiscard]] std::uint32_t target_count(int node) const;
  std::uint32_t first_weight(int node, std::uint32_t count);
  /// Makes SceneMotion::nodes of the nodes that move and of moving skins' joints.
  void keep_nodes();

  const Document& document_;
  const NodeTree& tree_;
  Scene& scene_;
  NumberBudget budget_;
  std::vector<bool> driven_, moves_;               // by node
  std::vector<int> kept_;                          // by node: index in SceneMotion::nodes or -1
  std::vector<bool> moving_skins_;                 // by skin
  std::map<int, std::uint32_t> weights_;           // by node
  std::map<int, int> skins_;                       // by skin: index in SceneMotion::skins
  std::set<std::tuple<int, AnimatedPart>> taken_;  // by channels of the animation at hand
};

}  // namespace gnomon::detail
