// The scene of a random frame: objects as its JSON lists them, as a glTF file and as the loader reads that.
#include "frame_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

#include "base/random.hpp"
#include "glb_text.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/scene/load.hpp"
#include "load_memory.hpp"

namespace gnomon::stress {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, kObjectKinds> kKindNames{"box",   "plate",  "fence",      "pane",
                                                                "soup",  "sliver", "degenerate", "hill",
                                                                "twins", "tower",  "grower",     "walker"};

std::vector<float> numbers(const Json& object, const char* key, std::vector<float> fallback) {
  const auto found = object.find(key);
  if (found == object.end()) return fallback;
  if (!found->is_array() || found->size() != fallback.size())
    throw CaseError(std::string("objects: ") + key + " needs " + std::to_string(fallback.size()) +
                    " numbers");
  for (std::size_t i = 0; i < fallback.size(); ++i) {
    const Json& value = (*found)[i];
    if (!value.is_number()) throw CaseError(std::string("objects: ") + key + " needs numbers");
    fallback[i] = value.get<float>();
  }
  return fallback;
}

void add_triangle(Corners& to, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::vec3 across = glm::cross(b - a, c - a);
  const float size = glm::length(across);
  const glm::vec3 n = size > 0.0f ? across / size : glm::vec3(0, 1, 0);
  for (const glm::vec3& p : {a, b, c}) {
    to.positions.insert(to.positions.end(), {p.x, p.y, p.z});
    to.normals.insert(to.normals.end(), {n.x, n.y, n.z});
  }
}

void add_quad(Corners& to, const glm::vec3& origin, const glm::vec3& u, const glm::vec3& v) {
  add_triangle(to, origin, origin + u, origin + u + v);
  add_triangle(to, origin, origin + u + v, origin + v);
  to.texcoords.insert(to.texcoords.end(), {0, 1, 1, 1, 1, 0, 0, 1, 1, 0, 0, 0});
}

/// From -1 to 1 along x and z and from 0 to 2 along y, its sides in as many rows.
Corners box_corners(int rows = 1) {
  Corners out;
  const glm::vec3 x(2, 0, 0), z(0, 0, 2), row(0, 2.0f / static_cast<float>(rows), 0);
  for (int r = 0; r < rows; ++r) {
    const glm::vec3 at = glm::vec3(-1, 0, -1) + row * static_cast<float>(r);
    add_quad(out, at + z, x, row);
    add_quad(out, at + x, -x, row);
    add_quad(out, at, z, row);
    add_quad(out, at + x + z, -z, row);
  }
  add_quad(out, {-1, 2, 1}, x, -z);
  add_quad(out, {-1, 0, -1}, x, z);
  return out;
}

Corners sheet_corners() {
  Corners out;
  add_quad(out, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
  return out;
}

glm::vec3 in_cube(Random& random) {
  const auto unit = [&] { return static_cast<float>(random.between(-1.0, 1.0)); };
  const float x = unit(), y = unit(), z = unit();
  return {x, y + 1.0f, z};
}

Corners soup_corners(Random& random, int count) {
  Corners out;
  for (int i = 0; i < count; ++i) {
    const glm::vec3 middle = in_cube(random);
    const glm::vec3 a = in_cube(random), b = in_cube(random), c = in_cube(random);
    add_triangle(out, middle + 0.4f * a, middle + 0.4f * b, middle + 0.4f * c);
  }
  return out;
}

Corners sliver_corners(Random& random, int count) {
  Corners out;
  for (int i = 0; i < count; ++i) {
    const glm::vec3 from = in_cube(random), to = in_cube(random), aside = 1e-3f * in_cube(random);
    add_triangle(out, from, to, from + aside);
  }
  return out;
}

/// A sheet, with triangles among its own that are a point, a line, and a line with a corner twice.
Corners degenerate_corners() {
  Corners out = sheet_corners();
  const glm::vec3 a(-1, 0, 1), b(1, 0, 1), c(1, 0, -1);
  add_triangle(out, a, a, a);
  add_triangle(out, a, b, a);
  add_triangle(out, a, 0.5f * (a + c), c);
  out.texcoords.resize(out.positions.size() / 3 * 2, 0.0f);
  return out;
}

Corners hill_corners(Random& random) {
  constexpr int kSide = 6;
  std::array<std::array<float, kSide + 1>, kSide + 1> height{};
  for (auto& row : height) {
    for (float& h : row) h = static_cast<float>(0.6 * random.unit());
  }
  Corners out;
  const auto at = [&](int x, int z) {
    const float step = 2.0f / kSide;
    return glm::vec3(-1.0f + step * static_cast<float>(x),
                     height[static_cast<std::size_t>(z)][static_cast<std::size_t>(x)],
                     -1.0f + step * static_cast<float>(z));
  };
  for (int z = 0; z < kSide; ++z) {
    for (int x = 0; x < kSide; ++x) {
      add_triangle(out, at(x, z), at(x, z + 1), at(x + 1, z + 1));
      add_triangle(out, at(x, z), at(x + 1, z + 1), at(x + 1, z));
    }
  }
  return out;
}

/// Holes of every size: alpha from dice, blurred where it is not.
Image holes(Random& random) {
  Image image{"holes", 8, 8, {}};
  for (int i = 0; i < image.width * image.height; ++i) {
    const std::uint8_t alpha = random.unit() < 0.5 ? 255 : static_cast<std::uint8_t>(random.pick(120));
    image.rgba.insert(image.rgba.end(), {200, 180, 160, alpha});
  }
  return image;
}

/// The numbers of the glTF materials that objects share.
struct Materials {
  int solid = 0, sheet = 0;
};

int fence_material(GlbText& glb, const Json& object, Random& random) {
  const int image = glb.picture(encode_png(holes(random)));
  static constexpr int kWraps[] = {10497, 33648, 33071};  // repeat, mirrored, clamp
  const std::vector<float> turned = numbers(object, "texture", {0.0f, 0.0f, 1.0f, 1.0f, 0.0f});
  const int wrap = kWraps[static_cast<std::size_t>(random.pick(3))];
  const int sampler = glb.add("samplers", {{"wrapS", wrap}, {"wrapT", wrap}});
  const int texture = glb.add("textures", {{"source", image}, {"sampler", sampler}});
  glb.document["extensionsUsed"] = Json::array({"KHR_texture_transform"});
  Json look{
      {"index", texture},
      {"extensions",
       {{"KHR_texture_transform",
         {{"offset", {turned[0], turned[1]}}, {"scale", {turned[2], turned[3]}}, {"rotation", turned[4]}}}}}};
  return glb.add("materials", {{"alphaMode", "MASK"},
                               {"alphaCutoff", 0.5},
                               {"doubleSided", true},
                               {"pbrMetallicRoughness", {{"baseColorTexture", look}}}});
}

int pane_material(GlbText& glb, const Json& object) {
  const std::vector<float> color = numbers(object, "color", {0.8f, 0.5f, 0.4f, 0.6f});
  return glb.add("materials", {{"alphaMode", "BLEND"},
                               {"doubleSided", true},
                               {"pbrMetallicRoughness", {{"baseColorFactor", color}}}});
}

/// Where the object stands: a rotation of any length, and a size that may be negative.
Json placed(const Json& object) {
  std::vector<float> turn = numbers(object, "turn", {0, 0, 0, 1});
  double square = 0.0;
  for (const float v : turn) square += static_cast<double>(v) * v;
  if (!(square > 0.0)) turn = {0, 0, 0, 1};
  const double size = square > 0.0 ? std::sqrt(square) : 1.0;
  for (float& v : turn) v = static_cast<float>(v / size);
  return {{"translation", numbers(object, "at", {0, 0, 0})},
          {"rotation", turn},
          {"scale", numbers(object, "size", {1, 1, 1})}};
}

/// A mesh of one primitive, which casts and receives as the object says.
int mesh_of(GlbText& glb, const Json& object, const Json& primitive) {
  Json mesh{{"primitives", Json::array({primitive})}};
  if (!object.value("casts", true)) mesh["extras"]["castShadow"] = false;
  if (!object.value("receives", true)) mesh["extras"]["receiveShadow"] = false;
  return glb.add("meshes", mesh);
}

/// Bends about its foot and its middle.
void add_tower(GlbText& glb, const Json& object, int root, int material) {
  const Corners corners = box_corners(4);
  Json primitive = glb.primitive(corners, material);
  std::vector<std::uint8_t> joints;
  std::vector<float> weights;
  for (std::size_t v = 0; v < corners.positions.size(); v += 3) {
    const float upper = 0.5f * corners.positions[v + 1];
    joints.insert(joints.end(), {0, 1, 0, 0});
    weights.insert(weights.end(), {1.0f - upper, upper, 0.0f, 0.0f});
  }
  primitive["attributes"]["JOINTS_0"] = glb.bytes(joints, "VEC4");
  primitive["attributes"]["WEIGHTS_0"] = glb.floats(weights, "VEC4");
  const int foot = glb.node(placed(object), root);
  const int top = glb.node(Json::object(), foot);
  const int skin = glb.add("skins", {{"joints", {foot, top}}});
  glb.node({{"mesh", mesh_of(glb, object, primitive)}, {"skin", skin}});
  constexpr float kTilt = 0.28f, kUp = 0.96f;
  glb.animate(top, "rotation", {0, 1, 2, 3}, {0, 0, 0, 1, 0, 0, kTilt, kUp, kTilt, 0, 0, kUp, 0, 0, 0, 1});
}

void add_grower(GlbText& glb, const Json& object, int root, int material) {
  const Corners corners = box_corners();
  Json primitive = glb.primitive(corners, material);
  std::vector<float> offsets = corners.positions;
  for (std::size_t i = 0; i < offsets.size(); ++i) offsets[i] *= i % 3 == 1 ? 1.0f : -0.5f;
  primitive["targets"] = Json::array({{{"POSITION", glb.floats(offsets, "VEC3")}}});
  Json node = placed(object);
  node["mesh"] = mesh_of(glb, object, primitive);
  glb.animate(glb.node(node, root), "weights", {0, 1.5f, 3}, {0, 1, 0});
}

void add_walker(GlbText& glb, const Json& object, int root, int material) {
  Json node = placed(object);
  node["mesh"] = mesh_of(glb, object, glb.primitive(box_corners(), material));
  const int walker = glb.node(node, root);
  const std::vector<float> at = numbers(object, "at", {0, 0, 0});
  std::vector<float> way;
  for (const float step : {0.0f, 1.0f, 2.0f, 0.0f})
    way.insert(way.end(), {at[0] + step, at[1], at[2] - 0.5f * step});
  glb.animate(walker, "translation", {0, 1, 2, 3}, way);
}

/// One mesh in five places, two of them mirror images.
void add_twins(GlbText& glb, const Json& object, int root, int material) {
  const int mesh = mesh_of(glb, object, glb.primitive(box_corners(), material));
  const int group = glb.node(placed(object), root);
  for (int i = 0; i < 5; ++i) {
    const double side = i % 2 == 1 ? -0.35 : 0.35;
    glb.node({{"mesh", mesh},
              {"translation", {1.6 * i - 3.2, 0.3 * i, 0.4 * (i % 3)}},
              {"scale", {side, 0.5, 0.35}}},
             group);
  }
}

ObjectKind kind_of(const Json& object) {
  const std::string name = object.value("kind", "");
  const auto found = std::find(kKindNames.begin(), kKindNames.end(), name);
  if (found == kKindNames.end()) throw CaseError("objects: kind '" + one_line(name) + "' is none");
  return static_cast<ObjectKind>(found - kKindNames.begin());
}

void add_object(GlbText& glb, const Json& object, int root, const Materials& materials) {
  Random random(object.value("seed", std::uint64_t{1}));
  const ObjectKind kind = kind_of(object);
  Corners corners;
  int material = materials.solid;
  switch (kind) {
    case ObjectKind::tower:
      return add_tower(glb, object, root, materials.solid);
    case ObjectKind::grower:
      return add_grower(glb, object, root, materials.solid);
    case ObjectKind::walker:
      return add_walker(glb, object, root, materials.solid);
    case ObjectKind::twins:
      return add_twins(glb, object, root, materials.solid);
    case ObjectKind::box:
      corners = box_corners();
      break;
    case ObjectKind::hill:
      corners = hill_corners(random);
      material = materials.sheet;
      break;
    case ObjectKind::soup:
    case ObjectKind::sliver: {
      const int count = std::clamp(object.value("count", 8), 1, 64);
      corners = kind == ObjectKind::soup ? soup_corners(random, count) : sliver_corners(random, count);
      material = materials.sheet;
      break;
    }
    case ObjectKind::degenerate:
      corners = degenerate_corners();
      material = materials.sheet;
      break;
    case ObjectKind::plate:
    case ObjectKind::fence:
    case ObjectKind::pane:
      corners = sheet_corners();
      material = kind == ObjectKind::fence  ? fence_material(glb, object, random)
                 : kind == ObjectKind::pane ? pane_material(glb, object)
                                            : materials.sheet;
      break;
  }
  Json node = placed(object);
  node["mesh"] = mesh_of(glb, object, glb.primitive(corners, material));
  glb.node(node, root);
}

}  // namespace

std::string to_string(ObjectKind kind) {
  return std::string(kKindNames[static_cast<std::size_t>(kind)]);
}

std::string glb_of(const Json& frame) {
  GlbText glb;
  Materials materials;
  materials.solid = glb.add("materials", {{"name", "solid"}});
  materials.sheet = glb.add("materials", {{"name", "sheet"}, {"doubleSided", true}});
  const Json setting = frame.value("frame", Json::object());
  const double scale = setting.value("scale", 1.0);
  const int root = glb.node({{"translation", setting.value("origin", std::vector<double>{0, 0, 0})},
                             {"scale", {scale, scale, scale}}});
  for (const Json& object : frame.value("objects", Json::array())) add_object(glb, object, root, materials);
  return glb.file();
}

Scene scene_of_frame(const Json& frame) {
  const std::string bytes = glb_of(frame);
  return detail::load_gltf_bytes({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, "frame",
                                 "frame.glb", {}, {});
}

}  // namespace gnomon::stress
