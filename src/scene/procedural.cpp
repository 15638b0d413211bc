// Which scenes come with the library? Each is written as a GLB file and read back like any other.
#include <algorithm>
#include <array>

#include "builtin/builtin.hpp"
#include "gnomon/scene/load.hpp"
#include "load_memory.hpp"
#include "refusal.hpp"

namespace gnomon {

namespace {

constexpr std::array<BuiltinScene, 8> kScenes{
    {{"city", "2 km of streets, blocks and towers from shared meshes: near and far in one view"},
     {"fence", "wire mesh, pickets and posts before walls, benches and crates: detail below a texel"},
     {"glass", "walls and a roof of coloured panes: light that is not stopped but tinted"},
     {"hangar", "open steel hall with trusses, purlins and crates: nested thin shadows"},
     {"room", "a room behind windows with blinds: furniture that stands close, light through slats"},
     {"street", "boxes along a street, as the captures of engines were made in"},
     {"terrain", "1 km of hills with boulders and standing stones, for grazing light"},
     {"trees", "a grove with foliage cut out of cards by alpha"}}};
constexpr std::array<std::string (*)(), kScenes.size()> kBuilders{
    detail::build_city, detail::build_fence,  detail::build_glass,   detail::build_hangar,
    detail::build_room, detail::build_street, detail::build_terrain, detail::build_trees};

}  // namespace

std::span<const BuiltinScene> builtin_scenes() noexcept {
  return kScenes;
}

std::string build_glb(std::string_view name) {
  for (std::size_t i = 0; i < kScenes.size(); ++i) {
    if (kScenes[i].name == name) return kBuilders[i]();
  }
  std::string known;
  for (const BuiltinScene& scene : kScenes) known += (known.empty() ? "" : ", ") + std::string(scene.name);
  throw SceneError(detail::one_line("builtin:" + std::string(name) + ": scene: is not one of " + known));
}

Scene load_builtin(std::string_view name) {
  const std::string glb = build_glb(name);
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(glb.data());
  const std::string full = "builtin:" + std::string(name);
  return detail::load_gltf_bytes({bytes, glb.size()}, full, full, {}, {});
}

}  // namespace gnomon
