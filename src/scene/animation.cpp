// Which animation, at what time of it?
#include "gnomon/scene/animation.hpp"

#include <charconv>
#include <cmath>

namespace gnomon {

namespace {

template <class T>
std::uint64_t bytes_of(const std::vector<T>& values) noexcept {
  return values.size() * sizeof(T);
}

}  // namespace

std::uint64_t SceneMotion::bytes() const noexcept {
  std::uint64_t n = bytes_of(nodes) + bytes_of(weights) + bytes_of(instances);
  for (const Animation& animation : animations) {
    n += bytes_of(animation.channels);
    for (const AnimationSampler& sampler : animation.samplers)
      n += bytes_of(sampler.times_s) + bytes_of(sampler.values);
  }
  for (const MotionSkin& skin : skins) n += bytes_of(skin.joints) + bytes_of(skin.joint_from_mesh);
  for (const DeformedMesh& mesh : meshes) {
    n += bytes_of(mesh.positions) + bytes_of(mesh.normals) + bytes_of(mesh.joints) +
         bytes_of(mesh.joint_weights);
    for (const MorphTarget& target : mesh.targets) n += bytes_of(target.positions) + bytes_of(target.normals);
  }
  return n;
}

double looped_time(const Animation& animation, double time_s) noexcept {
  if (!(animation.duration_s > 0.0) || !std::isfinite(time_s)) return 0.0;
  const double rest = std::fmod(time_s, animation.duration_s);
  const double time = rest < 0.0 ? rest + animation.duration_s : rest;
  return time < animation.duration_s ? time : 0.0;  // a tiny negative rest rounds to the whole
}

int find_animation(const SceneMotion& motion, const std::string& word) noexcept {
  for (std::size_t i = 0; i < motion.animations.size(); ++i) {
    if (motion.animations[i].name == word) return static_cast<int>(i);
  }
  int index = -1;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
  const bool whole = error == std::errc{} && end == word.data() + word.size();
  return whole && index >= 0 && static_cast<std::size_t>(index) < motion.animations.size() ? index : -1;
}

}  // namespace gnomon
