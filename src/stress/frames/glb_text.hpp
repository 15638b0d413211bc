// A binary glTF file under construction: a JSON document to be filled in, and the numbers that it refers to.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace gnomon::stress {

/// Triangles in object space: three corners each, counter-clockwise seen from outside.
struct Corners {
  std::vector<float> positions, normals, texcoords;
};

class GlbText {
 public:
  using Json = nlohmann::ordered_json;
  GlbText();
  /// Adds to one of the document's lists, which is made where it is missing. Returns the index of the value.
  int add(const char* list, Json value);
  /// An accessor of floats; `shape` as in glTF: SCALAR, VEC2, ...
  int floats(const std::vector<float>& values, const char* shape);
  int bytes(const std::vector<std::uint8_t>& values, const char* shape);
  /// An image from the bytes of a PNG.
  int picture(const std::vector<std::uint8_t>& png);
  /// A primitive of these triangles.
  Json primitive(const Corners& corners, int material);
  /// A node below the scene's root, or below `parent`.
  int node(Json node, int parent = -1);
  /// Adds a curve of linear keys to the only animation.
  void animate(int node, const char* path, const std::vector<float>& times_s,
               const std::vector<float>& values);
  /// The bytes of the file.
  [[nodiscard]] std::string file() const;

  Json document;

 private:
  int view(const void* data, std::size_t size);
  std::string bytes_;
};

}  // namespace gnomon::stress
