// The scene of a random frame: objects as its JSON lists them, as a glTF file and as the loader reads that.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "gnomon/scene/scene.hpp"

namespace gnomon::stress {

/// The kinds of objects, in the order that they are drawn in.
enum class ObjectKind : std::uint8_t {
  box,         ///< closed
  plate,       ///< a sheet of two triangles, both sides of which are there
  fence,       ///< a sheet with holes: a mask with a texture transform
  pane,        ///< a sheet of glass
  soup,        ///< triangles that touch each other nowhere
  sliver,      ///< triangles a thousand times as long as wide
  degenerate,  ///< triangles without area among others that have some
  hill,        ///< a grid of slopes
  twins,       ///< one mesh placed five times, twice as its mirror image
  tower,       ///< skinned; bends with time
  grower,      ///< a morph target; grows with time
  walker,      ///< a node that moves and turns with time
};
inline constexpr int kObjectKinds = 12;
[[nodiscard]] std::string to_string(ObjectKind kind);

/// The bytes of a binary glTF file. Of `frame`: "objects" are the file's nodes, "frame.scale" and
/// "frame.origin" place all of them. Throws CaseError for an object of no kind.
[[nodiscard]] std::string glb_of(const nlohmann::ordered_json& frame);

/// The same, loaded.
[[nodiscard]] Scene scene_of_frame(const nlohmann::ordered_json& frame);

}  // namespace gnomon::stress
