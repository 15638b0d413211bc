// A glTF file opened and checked, before any triangle is made of it: structure, bytes of its buffers, its
// pictures.
#pragma once

#include <tiny_gltf.h>

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "files.hpp"
#include "gltf_motion_source.hpp"
#include "gltf_placement.hpp"
#include "gltf_views.hpp"
#include "gnomon/scene/load.hpp"

namespace gnomon::detail {

/// KHR_texture_transform of a material's base colour, applied to texture coordinates on loading.
struct TextureTransform {
  std::array<double, 2> offset{0.0, 0.0}, scale{1.0, 1.0};
  double rotation = 0.0;  // radians, counter-clockwise
  int texcoord = -1;      // the set to use in place of the texture's own, -1: none
};

/// Where an encoded picture lies: a URI or, without one, a buffer view.
struct ImageSource {
  std::string name, uri;
  int buffer_view = -1;
};

struct Document {
  /// Checked: types, indices, buffer views within their buffers. Buffer data is empty where a buffer has none
  /// (`missing`). Holds no images.
  tinygltf::Model model;
  std::vector<ImageSource> images;
  std::vector<std::optional<TextureTransform>> transforms;  // one per material
  std::vector<float> transmissions;                         // 0..1, one per material
  std::vector<std::vector<int>> indices;      // accessor of each primitive of each mesh, -1: none
  std::vector<std::vector<bool>> compressed;  // primitives whose data only Draco can read
  MotionSource motion;                        // without animations: targets and weights alone
  PlacementSource placement;
  ViewSource views;
};

/// Throws Refusal.
[[nodiscard]] Document open_document(std::span<const std::uint8_t> bytes, SceneFolder& folder,
                                     const LoadLimits& limits, std::vector<std::string>& warnings);

/// The bytes of a buffer view. Throws LeftOut where its buffer has no data.
[[nodiscard]] std::span<const std::uint8_t> view_bytes(const tinygltf::Model& model, int buffer_view);

}  // namespace gnomon::detail
