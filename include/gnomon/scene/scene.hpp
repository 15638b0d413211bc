// A scene as the renderer and the tracer read it: triangles, instances, materials, images. Plain data.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "gnomon/bounds.hpp"
#include "gnomon/light.hpp"
#include "gnomon/scene/animation.hpp"

namespace gnomon {

/// A decoded picture: rows top to bottom, four 8-bit channels (red, green, blue, alpha), colour in sRGB.
struct Image {
  std::string name;                ///< for messages
  int width = 0, height = 0;       ///< pixels
  std::vector<std::uint8_t> rgba;  ///< width x height x 4
};

/// How a texture coordinate outside [0,1] is read.
enum class TextureWrap : std::uint8_t { repeat, mirrored_repeat, clamp_to_edge };

/// Meaning of alpha. `blend` surfaces are drawn and cast shadows like opaque ones with a cutoff of 0.5, but
/// for those that split_translucent() parts from the scene.
enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// The look of a surface, as far as light and shadow need it.
struct Material {
  std::string name;            ///< as in the file; may be empty
  glm::vec4 base_color{1.0f};  ///< linear, multiplied with the image
  int base_color_image = -1;   ///< index into Scene::images, -1: none
  TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;  ///< of the image
  AlphaMode alpha_mode = AlphaMode::opaque;                                ///< which fragments are there
  float alpha_cutoff = 0.5f;  ///< a fragment below it is not there (mask and blend)
  bool double_sided = false;  ///< back faces are drawn, too
  /// Share of the light that passes the surface, coloured by base_color, 0..1: the factor of
  /// KHR_materials_transmission. Counts in split_translucent() alone.
  float transmission = 0.0f;
};

/// A run of triangles with one material. `first_index` and `index_count` count entries of Scene::indices; the
/// indices are absolute into the vertex arrays and always in range. `bounds` is in object space and holds
/// every vertex used.
struct Primitive {
  std::uint32_t first_index = 0, index_count = 0;  ///< a multiple of 3 entries of Scene::indices
  int material = 0;                                ///< index into Scene::materials
  Box bounds;                                      ///< object space
};

/// A node of a file that places a mesh.
struct SceneNode {
  std::uint32_t index = 0;  ///< in the file
  std::string name, mesh;   ///< names of the node and of its mesh; may be empty
  bool skinned = false;     ///< its vertices are in world space, where a skin has them
};
inline constexpr std::uint32_t kNoNode = 0xffffffff;  ///< of an instance that no file has

/// One primitive placed in the world: the unit of drawing and of culling.
struct Instance {
  glm::dmat4 world_from_object{1.0};  ///< affine
  std::uint32_t primitive = 0;        ///< index into Scene::primitives
  bool mirrored = false;              ///< the transform turns the winding round (negative determinant)
  bool casts = true;                  ///< false: no shadow of it falls on anything, nor on itself
  bool receives = true;               ///< false: no shadow falls on it, it is lit wherever it faces the light
  bool shown = true;                  ///< false: cameras do not see it; it may cast, as a shadow proxy does
  bool has_proxy = false;             ///< a shadow proxy casts in its place, and it does not
  std::uint32_t node = kNoNode;       ///< index into Scene::nodes
  Box bounds_world;                   ///< of the transformed vertices, not of the transformed box
};

/// A light that a file has (KHR_lights_punctual).
struct SceneLight {
  std::string name;        ///< as in the file, else its node's, else its number there
  Light light;             ///< world space
  glm::vec3 color{1.0f};   ///< linear, by channel, >= 0
  double intensity = 1.0;  ///< lux of a sun, candela of a spot or point, >= 0
};

/// A camera that a file has.
struct SceneCamera {
  std::string name;                    ///< as in the file, else its node's, else its number there
  glm::dvec3 position{0.0};            ///< eye, world units
  glm::dvec3 forward{0.0, 0.0, -1.0};  ///< unit
  glm::dvec3 up{0.0, 1.0, 0.0};        ///< unit
  bool orthographic = false;           ///< parallel projection
  double fov_y_radians = 0.0;          ///< full vertical angle, of a perspective camera
  double height_world = 0.0;           ///< from bottom to top, of an orthographic one
  double aspect = 0.0;                 ///< width over height of its picture; 0: the file has none
  double near_depth = 0.0;             ///< world units
  double far_depth = 0.0;              ///< world units, may be infinite
};

/// Triangles in object space, placed by instances. Vertex arrays have equal length; `normals` are unit
/// length, `texcoords` are (0,0) where a mesh has none.
struct Scene {
  std::string name;                    ///< of the file, without folder and ending
  std::vector<glm::vec3> positions;    ///< object space
  std::vector<glm::vec3> normals;      ///< unit, object space
  std::vector<glm::vec2> texcoords;    ///< (0, 0) is the first texel of the first row
  std::vector<std::uint32_t> indices;  ///< three for each triangle
  std::vector<Primitive> primitives;   ///< each placed by any number of instances
  std::vector<Instance> instances;     ///< in the order of the file's nodes, shadow proxies last
  std::vector<SceneNode> nodes;        ///< that instances are of
  std::vector<Material> materials;  ///< never empty: index 0 is the default material where a file names none
  std::vector<Image> images;        ///< of base colours
  std::vector<std::string> warnings;  ///< repairs and omissions of the loader, a line each
  Box bounds_world;                   ///< of all instances that are shown; empty without any
  SceneMotion motion;                 ///< what pose() moves; empty without animations
  std::vector<SceneLight> lights;     ///< of nodes that are shown, at rest
  std::vector<SceneCamera> cameras;   ///< the same

  /// Memory of vertices, indices, instances, pictures and animations, bytes.
  [[nodiscard]] std::uint64_t bytes() const noexcept {
    std::uint64_t n = positions.size() * (sizeof(glm::vec3) * 2 + sizeof(glm::vec2)) +
                      indices.size() * sizeof(std::uint32_t) + instances.size() * sizeof(Instance);
    for (const Image& image : images) n += image.rgba.size();
    return n + motion.bytes();
  }
  /// Triangles drawn in one pass over all instances.
  [[nodiscard]] std::uint64_t triangle_count() const noexcept {
    std::uint64_t n = 0;
    for (const Instance& i : instances) n += primitives[i.primitive].index_count / 3;
    return n;
  }
};

}  // namespace gnomon
