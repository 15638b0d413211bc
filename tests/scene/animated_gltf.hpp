// A small animated scene as a glTF file: boxes on a ground, of which some walk, turn, bend and grow.
#pragma once

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "gltf_text.hpp"

namespace gnomon::test {

/// Triangles of a mesh, each corner its own vertex.
struct MeshText {
  std::vector<float> positions, normals;

  void quad(const glm::vec3& origin, const glm::vec3& u, const glm::vec3& v) {
    const glm::vec3 n = glm::normalize(glm::cross(u, v));
    for (const glm::vec3& p : {origin, origin + u, origin + u + v, origin, origin + u + v, origin + v}) {
      positions.insert(positions.end(), {p.x, p.y, p.z});
      normals.insert(normals.end(), {n.x, n.y, n.z});
    }
  }
  /// Standing on y = 0, its sides in as many rows; centred in x and z.
  void box(float width, float height, float depth, int rows = 1) {
    const glm::vec3 x(width, 0, 0), z(0, 0, depth), low(-0.5f * width, 0, -0.5f * depth);
    const glm::vec3 row(0, height / static_cast<float>(rows), 0);
    for (int r = 0; r < rows; ++r) {
      const glm::vec3 at = low + row * static_cast<float>(r);
      quad(at + z, x, row);
      quad(at + x, -x, row);
      quad(at, z, row);
      quad(at + x + z, -z, row);
    }
    quad(low + row * static_cast<float>(rows) + z, x, -z);
    quad(low, x, z);
  }
};

inline json mesh_text(TestGltf& gltf, const MeshText& mesh) {
  return {{"attributes",
           {{"POSITION", gltf.positions(mesh.positions)}, {"NORMAL", gltf.positions(mesh.normals)}}}};
}

/// Adds a channel to the first animation.
inline void add_keys(TestGltf& gltf, int node, const char* path, const std::vector<float>& times,
                     const std::vector<float>& values, const char* interpolation = "LINEAR") {
  const bool turns = std::string(path) == "rotation", weights = std::string(path) == "weights";
  const std::size_t width = weights ? 1 : turns ? 4 : 3;
  json& animations = gltf.document["animations"];
  if (animations.is_null())
    animations = {{{"name", "all"}, {"channels", json::array()}, {"samplers", json::array()}}};
  const int input = gltf.accessor(gltf.view(times), kFloat, "SCALAR", times.size());
  const int output = gltf.accessor(gltf.view(values), kFloat,
                                   weights ? "SCALAR"
                                   : turns ? "VEC4"
                                           : "VEC3",
                                   values.size() / width);
  json& to = gltf.document["animations"][0];
  to["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
  to["channels"].push_back(
      {{"sampler", to["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
}

/// A walking box that carries a spinning one, a bending tower, a growing block, a box that flips, among
/// twelve that stay. The animation "all" takes four seconds and ends as it begins.
inline TestGltf animated_gltf() {
  TestGltf gltf;
  MeshText ground, block, tower, post;
  ground.quad({-20, 0, 20}, {40, 0, 0}, {0, 0, -40});
  block.box(1.2f, 1.0f, 0.8f);
  tower.box(0.6f, 4.0f, 0.6f, 8);
  post.box(0.7f, 2.0f, 0.7f);
  gltf.show(mesh_text(gltf, ground));
  const int post_mesh = gltf.add("meshes", {{"primitives", {mesh_text(gltf, post)}}});
  for (int i = 0; i < 12; ++i)
    gltf.show_node({{"mesh", post_mesh},
                    {"translation", {-9 + 6 * (i % 4), 0, -14 + 7 * (i / 4)}},
                    {"scale", {1, 0.5 + 0.2 * i, 1}}});

  const int walker = gltf.show(mesh_text(gltf, block), {{"translation", {-3, 0, 2}}});
  const int spinner =
      gltf.add("nodes", {{"mesh", gltf.document["nodes"][static_cast<std::size_t>(walker)]["mesh"]},
                         {"translation", {0, 1.4, 0}}});
  gltf.document["nodes"][static_cast<std::size_t>(walker)]["children"] = {spinner};
  add_keys(gltf, walker, "translation", {0, 2, 4}, {-3, 0, 2, 3, 0, 3.5f, -3, 0, 2});
  const auto half = static_cast<float>(std::sqrt(0.5));
  add_keys(gltf, spinner, "rotation", {0, 1, 2, 3, 4},
           {0, 0, 0, 1, 0, half, 0, half, 0, 1, 0, 0, 0, half, 0, -half, 0, 0, 0, -1});

  const int flipper = gltf.show_node({{"mesh", post_mesh}, {"translation", {5, 0, -3}}});
  add_keys(gltf, flipper, "scale", {0, 1.5f, 3}, {1, 1, 1, -1, 1.5f, 1, 1, 1, 1}, "STEP");

  json grows = mesh_text(gltf, block);
  MeshText offsets = block;
  for (std::size_t i = 0; i < offsets.positions.size(); ++i)
    offsets.positions[i] = i % 3 == 1 ? 2.0f * offsets.positions[i] : 0.0f;
  grows["targets"] = {{{"POSITION", gltf.positions(offsets.positions)}}};
  const int grower = gltf.show(grows, {{"translation", {-5, 0, -3}}});
  add_keys(gltf, grower, "weights", {0, 2, 4}, {0, 1, 0});

  json bends = mesh_text(gltf, tower);
  std::vector<std::uint8_t> joints;
  std::vector<float> weights;
  for (std::size_t v = 0; v < tower.positions.size(); v += 3) {
    const float upper = tower.positions[v + 1] / 4.0f;
    joints.insert(joints.end(), {0, 1, 0, 0});
    weights.insert(weights.end(), {1.0f - upper, upper, 0.0f, 0.0f});
  }
  bends["attributes"]["JOINTS_0"] =
      gltf.accessor(gltf.view(joints), kUnsignedByte, "VEC4", joints.size() / 4);
  bends["attributes"]["WEIGHTS_0"] = gltf.accessor(gltf.view(weights), kFloat, "VEC4", weights.size() / 4);
  gltf.show(bends, {{"skin", 0}});
  const int root = gltf.show_node({{"translation", {1, 0, 0}}});
  const int top = gltf.add("nodes", json::object());
  gltf.document["nodes"][static_cast<std::size_t>(root)]["children"] = {top};
  gltf.add("skins", {{"joints", {root, top}}});
  const auto tilt = static_cast<float>(std::sin(0.3)), up = static_cast<float>(std::cos(0.3));
  add_keys(gltf, top, "rotation", {0, 1, 3, 4}, {0, 0, 0, 1, 0, 0, tilt, up, 0, 0, -tilt, up, 0, 0, 0, 1});
  return gltf;
}

}  // namespace gnomon::test
