// Small glTF files made in a test: a JSON document to be edited, with its bytes beside it.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gnomon/scene/load.hpp"
#include "load_memory.hpp"

namespace gnomon::test {

using nlohmann::json;

inline constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123,
                     kUnsignedInt = 5125, kFloat = 5126;

inline void append_number(std::string& bytes, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>(value >> (8 * i)));
}

/// A GLB file of these chunks.
inline std::string glb(std::string text, std::string bin) {
  while (text.size() % 4 != 0) text += ' ';
  while (bin.size() % 4 != 0) bin += '\0';
  std::string out = "glTF";
  append_number(out, 2);
  append_number(out, static_cast<std::uint32_t>(12 + 8 + text.size() + (bin.empty() ? 0 : 8 + bin.size())));
  append_number(out, static_cast<std::uint32_t>(text.size()));
  out += "JSON" + text;
  if (!bin.empty()) {
    append_number(out, static_cast<std::uint32_t>(bin.size()));
    out += std::string("BIN\0", 4) + bin;
  }
  return out;
}

struct TestGltf {
  json document = {{"asset", {{"version", "2.0"}}}};
  std::string bytes;

  template <class T>
  int view(const std::vector<T>& values, int stride = 0) {
    while (bytes.size() % 4 != 0) bytes += '\0';
    json v = {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", values.size() * sizeof(T)}};
    if (stride > 0) v["byteStride"] = stride;
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    return add("bufferViews", v);
  }
  int accessor(int view, int type, const char* shape, std::size_t count, json more = json::object()) {
    more.update({{"bufferView", view}, {"componentType", type}, {"type", shape}, {"count", count}});
    return add("accessors", more);
  }
  int positions(const std::vector<float>& values) {
    return accessor(view(values), kFloat, "VEC3", values.size() / 3);
  }
  int add(const char* array, const json& value) {
    document[array].push_back(value);
    return static_cast<int>(document[array].size()) - 1;
  }
  /// A mesh of one primitive, and a node in the scene that shows it. Returns the node.
  int show(const json& primitive, json node = json::object()) {
    node["mesh"] = add("meshes", {{"primitives", {primitive}}});
    return show_node(node);
  }
  int show_node(const json& node) {
    const int n = add("nodes", node);
    if (!document.contains("scenes")) document["scenes"] = {{{"nodes", json::array()}}};
    document["scenes"][0]["nodes"].push_back(n);
    document["scene"] = 0;
    return n;
  }
  [[nodiscard]] std::string file() const {
    json with_buffer = document;
    if (!bytes.empty()) with_buffer["buffers"] = {{{"byteLength", bytes.size()}}};
    return glb(with_buffer.dump(), bytes);
  }
  [[nodiscard]] Scene load(const LoadLimits& limits = {}) const {
    const std::string text = file();
    return detail::load_gltf_bytes({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, "test",
                                   "test", {}, limits);
  }
};

/// One triangle in the plane z = 0, counter-clockwise seen from +Z.
inline const std::vector<float> kTriangle{0, 0, 0, 1, 0, 0, 0, 1, 0};

inline TestGltf one_triangle() {
  TestGltf gltf;
  gltf.show({{"attributes", {{"POSITION", gltf.positions(kTriangle)}}}});
  return gltf;
}

/// What load() says, or "" where it loads.
inline std::string refusal_of(const TestGltf& gltf, const LoadLimits& limits = {}) {
  try {
    (void)gltf.load(limits);
    return "";
  } catch (const SceneError& e) {
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << "more than one line";
    return e.what();
  }
}

/// A folder of its own that is gone afterwards.
class WrittenFolder {
 public:
  WrittenFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "gnomon_scene_XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~WrittenFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  WrittenFolder(const WrittenFolder&) = delete;
  WrittenFolder& operator=(const WrittenFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace gnomon::test
