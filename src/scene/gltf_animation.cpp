// Which nodes of a glTF document do its animations move, and by which keys?
// Based on: Khronos Group, glTF 2.0 Specification (2021), section 3.11 "Animations".
#include "gltf_animation.hpp"

#include <algorithm>
#include <cmath>

#include "gltf_accessor.hpp"
#include "gltf_skin.hpp"
#include "refusal.hpp"

namespace gnomon::detail {

namespace {

constexpr std::uint32_t kCubicParts = 3;  // in-tangent, value, out-tangent

std::optional<Interpolation> interpolation_from_name(const std::string& name) {
  if (name == "STEP") return Interpolation::step;
  if (name == "LINEAR") return Interpolation::linear;
  if (name == "CUBICSPLINE") return Interpolation::cubic_spline;
  return std::nullopt;
}

std::optional<AnimatedPart> part_from_name(const std::string& name) {
  if (name == "translation") return AnimatedPart::translation;
  if (name == "rotation") return AnimatedPart::rotation;
  if (name == "scale") return AnimatedPart::scale;
  if (name == "weights") return AnimatedPart::weights;
  return std::nullopt;
}

void check_times(const std::vector<float>& times) {
  if (times.empty()) throw LeftOut("has no keys");
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i])) throw LeftOut("the time of key " + std::to_string(i) + " is not finite");
    if (times[i] < 0.0f) throw LeftOut("the time of key " + std::to_string(i) + " is below 0");
    if (i > 0 && times[i] < times[i - 1])
      throw LeftOut("the time of key " + std::to_string(i) + " is before that of the key before");
  }
}

/// Rotations of no length become no turn. Returns how many there were.
std::size_t repair_turns(AnimationSampler& sampler) {
  const bool cubic = sampler.interpolation == Interpolation::cubic_spline;
  std::size_t repaired = 0;
  for (std::size_t i = cubic ? sampler.width : 0; i + sampler.width <= sampler.values.size();
       i += cubic ? kCubicParts * sampler.width : sampler.width) {
    float* turn = &sampler.values[i];
    if (std::any_of(turn, turn + sampler.width, [](float v) { return v != 0.0f; })) continue;
    turn[sampler.width - 1] = 1.0f;
    ++repaired;
  }
  return repaired;
}

std::vector<std::size_t> parents_first(const tinygltf::Model& model, std::vector<int>& parents) {
  parents.assign(model.nodes.size(), -1);
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    for (const int child : model.nodes[n].children)
      parents[static_cast<std::size_t>(child)] = static_cast<int>(n);
  }
  std::vector<std::size_t> order;
  for (std::size_t n = 0; n < parents.size(); ++n) {
    if (parents[n] < 0) order.push_back(n);
  }
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (const int child : model.nodes[order[i]].children) order.push_back(static_cast<std::size_t>(child));
  }
  return order;
}

}  // namespace

void NumberBudget::spend(std::uint64_t count, std::uint64_t size, const std::string& where) {
  if (size != 0 && count > left_ / size) {
    throw Refusal(where, "takes the scene's animations above " + std::to_string(limit_) + " numbers");
  }
  left_ -= count * size;
}

MotionReader::MotionReader(const Document& document, const NodeTree& tree, const LoadLimits& limits,
                           Scene& scene)
    : document_(document), tree_(tree), scene_(scene), budget_(limits.animation_numbers) {
  if (document.motion.animations.empty()) return;
  driven_.resize(document.model.nodes.size());
  for (std::size_t i = 0; i < document.motion.animations.size(); ++i) read_animation(i);
  keep_nodes();
}

int MotionReader::moved_node(int node) const {
  const auto n = static_cast<std::size_t>(node);
  return n < moves_.size() && moves_[n] ? kept_[n] : -1;
}

bool MotionReader::moves_skin(int skin) const {
  const auto s = static_cast<std::size_t>(skin);
  return s < moving_skins_.size() && moving_skins_[s];
}

std::optional<std::uint32_t> MotionReader::weights_of(int node) const {
  const auto found = weights_.find(node);
  return found == weights_.end() ? std::nullopt : std::optional(found->second);
}

int MotionReader::skin_of(int skin) {
  const auto known = skins_.find(skin);
  if (known != skins_.end()) return known->second;
  const tinygltf::Skin& source = document_.model.skins[static_cast<std::size_t>(skin)];
  MotionSkin out{{}, inverse_binds(document_.model, source)};
  constexpr std::uint64_t kJointNumbers = 33;  // sixteen doubles and an index
  budget_.spend(source.joints.size(), kJointNumbers, element("skins", static_cast<std::size_t>(skin)));
  for (const int joint : source.joints)
    out.joints.push_back(static_cast<std::uint32_t>(kept_[static_cast<std::size_t>(joint)]));
  scene_.motion.skins.push_back(std::move(out));
  return skins_[skin] = static_cast<int>(scene_.motion.skins.size() - 1);
}

void MotionReader::read_animation(std::size_t index) {
  const AnimationSource& source = document_.motion.animations[index];
  const std::string where = element("animations", index);
  Animation animation;
  animation.name = source.name;
  Known known;
  taken_.clear();
  for (std::size_t c = 0; c < source.channels.size(); ++c) {
    const std::string at = where + "." + element("channels", c);
    try {
      read_channel(at, source, source.channels[c], animation, known);
    } catch (const LeftOut& e) {
      warn(scene_.warnings, at, std::string(e.what()) + ", skipped");
    }
  }
  for (const AnimationSampler& sampler : animation.samplers)
    animation.duration_s = std::max(animation.duration_s, static_cast<double>(sampler.times_s.back()));
  if (animation.channels.empty()) warn(scene_.warnings, where, "moves nothing");
  scene_.motion.animations.push_back(std::move(animation));
}

void MotionReader::read_channel(const std::string& where, const AnimationSource& source,
                                const AnimationSource::Channel& channel, Animation& animation, Known& known) {
  if (channel.node < 0) throw LeftOut("names no node");
  const std::optional<AnimatedPart> part = part_from_name(channel.path);
  if (!part) throw LeftOut("path '" + channel.path + "' is not supported");
  const auto node = static_cast<std::size_t>(channel.node);
  const bool weights = *part == AnimatedPart::weights;
  if (!weights && document_.model.nodes[node].matrix.size() == 16)
    throw LeftOut(element("nodes", node) + " has a matrix, which cannot be animated");
  const std::uint32_t targets = weights ? target_count(channel.node) : 0;
  if (weights && targets == 0) throw LeftOut(element("nodes", node) + " has no morph targets");
  if (channel.sampler >= source.samplers.size()) {
    throw LeftOut("names samplers[" + std::to_string(channel.sampler) + "], there are " +
                  std::to_string(source.samplers.size()));
  }
  if (!taken_.emplace(channel.node, *part).second)
    throw LeftOut("drives what another channel drives already");
  const bool turns = *part == AnimatedPart::rotation;
  const std::uint32_t width = weights ? targets : turns ? 4 : 3;
  const auto [it, is_new] = known.try_emplace({channel.sampler, width, turns}, -1);
  if (is_new) it->second = read_sampler(where, source, channel.sampler, width, *part, animation);
  if (it->second < 0) throw LeftOut(element("samplers", channel.sampler) + " is broken");
  animation.channels.push_back(
      {static_cast<std::uint32_t>(it->second), *part,
       weights ? first_weight(channel.node, targets) : static_cast<std::uint32_t>(channel.node)});
  if (!weights) driven_[node] = true;
}

int MotionReader::read_sampler(const std::string& where, const AnimationSource& source, std::size_t index,
                               std::uint32_t width, AnimatedPart part, Animation& animation) {
  const AnimationSource::Keys& keys = source.samplers[index];
  const std::optional<Interpolation> interpolation = interpolation_from_name(keys.interpolation);
  if (!interpolation) throw LeftOut("interpolation '" + keys.interpolation + "' is not supported");
  AnimationSampler out;
  out.interpolation = *interpolation;
  out.width = width;
  const std::uint64_t parts = *interpolation == Interpolation::cubic_spline ? kCubicParts : 1;
  const auto given = [&](int accessor) -> std::uint64_t {
    return document_.model.accessors[static_cast<std::size_t>(accessor)].count;
  };
  if (given(keys.output) > budget_.left() || given(keys.input) > budget_.left())
    budget_.spend(std::max(given(keys.output), given(keys.input)), 1, where);
  // Morph weights are scalars, all those of a key in a row.
  const int components = part == AnimatedPart::weights ? 1 : static_cast<int>(width);
  const std::uint64_t count = given(keys.input);
  if (given(keys.output) * static_cast<std::uint64_t>(components) != count * parts * width) {
    throw LeftOut(element("samplers", index) + " has " + std::to_string(given(keys.output)) + " values for " +
                  std::to_string(count) + " keys");
  }
  budget_.spend(count, 1 + parts * width, where);
  try {
    out.times_s = read_floats(document_.model, keys.input, 1, count);
    out.values = read_floats(document_.model, keys.output, components, given(keys.output));
  } catch (const Refusal& e) {
    throw LeftOut(e.what());
  }
  check_times(out.times_s);
  const auto broken =
      std::find_if(out.values.begin(), out.values.end(), [](float v) { return !std::isfinite(v); });
  if (broken != out.values.end())
    throw LeftOut(element("samplers", index) + " has a value that is not finite");
  if (const std::size_t repaired = part == AnimatedPart::rotation ? repair_turns(out) : 0)
    warn(scene_.warnings, where, std::to_string(repaired) + " rotations have no length, taken for no turn");
  animation.samplers.push_back(std::move(out));
  return static_cast<int>(animation.samplers.size() - 1);
}

std::uint32_t MotionReader::target_count(int node) const {
  const int mesh = document_.model.nodes[static_cast<std::size_t>(node)].mesh;
  std::size_t count = 0;
  const auto& targets = document_.motion.targets;
  for (auto it = targets.lower_bound({mesh, 0}); it != targets.end() && it->first.first == mesh; ++it)
    count = std::max(count, it->second.size());
  return mesh < 0 ? 0 : static_cast<std::uint32_t>(count);
}

std::uint32_t MotionReader::first_weight(int node, std::uint32_t count) {
  const auto [it, is_new] =
      weights_.try_emplace(node, static_cast<std::uint32_t>(scene_.motion.weights.size()));
  if (!is_new) return it->second;
  budget_.spend(count, 1, element("nodes", static_cast<std::size_t>(node)));
  const MotionSource& motion = document_.motion;
  const auto of_node = motion.node_weights.find(node);
  const auto of_mesh = motion.mesh_weights.find(document_.model.nodes[static_cast<std::size_t>(node)].mesh);
  std::vector<float> weights;
  if (of_node != motion.node_weights.end()) {
    weights = of_node->second;
  } else if (of_mesh != motion.mesh_weights.end()) {
    weights = of_mesh->second;
  }
  weights.resize(count, 0.0f);
  scene_.motion.weights.insert(scene_.motion.weights.end(), weights.begin(), weights.end());
  return it->second;
}

void MotionReader::keep_nodes() {
  const tinygltf::Model& model = document_.model;
  std::vector<int> parents;
  const std::vector<std::size_t> order = parents_first(model, parents);
  moves_ = driven_;
  for (const std::size_t n : order) {
    if (parents[n] >= 0 && moves_[static_cast<std::size_t>(parents[n])]) moves_[n] = true;
  }
  std::vector<bool> keeps = moves_;
  // Morph targets come before the skin, so that one at rest counts as well.
  moving_skins_.resize(model.skins.size());
  for (const auto& [node, first] : weights_) {
    const int skin = model.nodes[static_cast<std::size_t>(node)].skin;
    if (skin >= 0) moving_skins_[static_cast<std::size_t>(skin)] = true;
  }
  for (std::size_t s = 0; s < model.skins.size(); ++s) {
    const tinygltf::Skin& skin = model.skins[s];
    const bool moving =
        moving_skins_[s] || std::any_of(skin.joints.begin(), skin.joints.end(),
                                        [&](int joint) { return moves_[static_cast<std::size_t>(joint)]; });
    moving_skins_[s] = moving;
    for (const int joint : skin.joints) {
      if (moving) keeps[static_cast<std::size_t>(joint)] = true;
    }
  }
  kept_.assign(model.nodes.size(), -1);
  for (const std::size_t n : order) {
    if (!keeps[n]) continue;
    MotionNode node;
    const auto parent = static_cast<std::size_t>(parents[n]);
    if (parents[n] >= 0 && moves_[parent]) {
      node.parent = kept_[parent];
    } else if (parents[n] >= 0) {
      node.world_from_parent = tree_.world_from_node[parent];
    }
    node.parent_from_node = local_transform(model.nodes[n]);
    const PlacedNode at = placed(model.nodes[n]);
    node.translation = at.translation;
    node.rotation = at.rotation;
    node.scale = at.scale;
    kept_[n] = static_cast<int>(scene_.motion.nodes.size());
    scene_.motion.nodes.push_back(node);
  }
  // Channels name nodes by the file's numbers until here.
  for (Animation& animation : scene_.motion.animations) {
    for (AnimationChannel& channel : animation.channels) {
      if (channel.part != AnimatedPart::weights)
        channel.target = static_cast<std::uint32_t>(kept_[channel.target]);
    }
  }
}

}  // namespace gnomon::detail
