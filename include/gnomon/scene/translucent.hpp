// Which surfaces of a scene let light through, and how much of it?
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "gnomon/scene/pose.hpp"
#include "gnomon/scene/scene.hpp"

namespace gnomon {

/// True where light may pass: AlphaMode::blend, or a transmission above 0.
[[nodiscard]] inline bool is_translucent(const Material& material) noexcept {
  return material.alpha_mode == AlphaMode::blend || material.transmission > 0.0f;
}

/// Share of each colour's light that passes the material, 0..1, where its base colour times its picture is
/// `color` (linear, alpha behind). All of it passes beside what alpha covers; where it covers, the
/// transmission times the colour. A surface that AlphaMode::mask cuts out lets all pass. No refraction: light
/// keeps its way.
[[nodiscard]] inline glm::vec3 transmittance(const Material& material, const glm::vec4& color) noexcept {
  const bool cut_out = material.alpha_mode == AlphaMode::mask && color.a < material.alpha_cutoff;
  const float covered = cut_out ? 0.0f : material.alpha_mode == AlphaMode::blend ? color.a : 1.0f;
  return glm::vec3(1.0f - covered) + glm::vec3(color) * (covered * material.transmission);
}

/// A scene in two, which share materials and pictures by their indices.
struct TranslucentParts {
  Scene opaque;  ///< without the panes
  Scene panes;   ///< instances with translucent materials; no instance where there are none
  std::vector<std::uint32_t> opaque_instances;  ///< index in the whole scene, by instance of `opaque`
  std::vector<std::uint32_t> pane_instances;    ///< the same, by instance of `panes`
};
/// Parts the panes from the rest. Vertices and pictures are in both: twice the memory. Animations stay with
/// neither: pose the whole scene, and give each part its share (pose_of_part()).
[[nodiscard]] TranslucentParts split_translucent(const Scene& scene);
/// The share of one part in a pose of the whole scene; `instances`: TranslucentParts' list of that part. Bent
/// vertices come along where the part shows them.
[[nodiscard]] Pose pose_of_part(const Pose& pose, std::span<const std::uint32_t> instances);

}  // namespace gnomon
