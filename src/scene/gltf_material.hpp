// What do a glTF document's surfaces look like, as far as light and shadow need it: base colour and alpha.
#pragma once

#include "gltf_document.hpp"

namespace gnomon::detail {

/// Fills scene.materials, the default one last, and scene.images with the pictures they use. A picture that
/// cannot be had is a warning, and its material keeps its plain colour.
void read_materials(const Document& document, SceneFolder& folder, const LoadLimits& limits, Scene& scene);

}  // namespace gnomon::detail
