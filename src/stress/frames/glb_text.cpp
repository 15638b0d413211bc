// A binary glTF file under construction: a JSON document to be filled in, and the numbers that it refers to.
#include "glb_text.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

namespace gnomon::stress {
namespace {

constexpr int kUnsignedByte = 5121, kFloat = 5126;  // of glTF

void append_number(std::string& bytes, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>((value >> (8 * i)) & 0xffu));
}

void append_chunk(std::string& out, const char* type, std::string data, char filler) {
  while (data.size() % 4 != 0) data += filler;
  append_number(out, static_cast<std::uint32_t>(data.size()));
  out.append(type, 4);
  out += data;
}

std::size_t width_of(const std::string& shape) {
  if (shape == "SCALAR") return 1;
  return shape == "VEC2" ? 2 : shape == "VEC3" ? 3 : 4;
}

}  // namespace

GlbText::GlbText() : document(Json::object()) {
  document["asset"] = {{"version", "2.0"}};
  document["scene"] = 0;
  document["scenes"] = Json::array({{{"nodes", Json::array()}}});
}

int GlbText::add(const char* list, Json value) {
  document[list].push_back(std::move(value));
  return static_cast<int>(document[list].size()) - 1;
}

int GlbText::view(const void* data, std::size_t size) {
  while (bytes_.size() % 4 != 0) bytes_ += '\0';
  const std::size_t offset = bytes_.size();
  bytes_.append(static_cast<const char*>(data), size);
  return add("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
}

int GlbText::floats(const std::vector<float>& values, const char* shape) {
  const std::size_t width = width_of(shape);
  Json accessor{{"bufferView", view(values.data(), values.size() * sizeof(float))},
                {"componentType", kFloat},
                {"type", shape},
                {"count", values.size() / width}};
  std::vector<float> low(width, std::numeric_limits<float>::max()), high(width, -low[0]);
  for (std::size_t i = 0; i < values.size(); ++i) {
    low[i % width] = std::min(low[i % width], values[i]);
    high[i % width] = std::max(high[i % width], values[i]);
  }
  accessor["min"] = low;
  accessor["max"] = high;
  return add("accessors", accessor);
}

int GlbText::bytes(const std::vector<std::uint8_t>& values, const char* shape) {
  return add("accessors", {{"bufferView", view(values.data(), values.size())},
                           {"componentType", kUnsignedByte},
                           {"type", shape},
                           {"count", values.size() / width_of(shape)}});
}

int GlbText::picture(const std::vector<std::uint8_t>& png) {
  return add("images", {{"bufferView", view(png.data(), png.size())}, {"mimeType", "image/png"}});
}

GlbText::Json GlbText::primitive(const Corners& corners, int material) {
  Json value{{"attributes",
              {{"POSITION", floats(corners.positions, "VEC3")}, {"NORMAL", floats(corners.normals, "VEC3")}}},
             {"material", material}};
  if (!corners.texcoords.empty()) value["attributes"]["TEXCOORD_0"] = floats(corners.texcoords, "VEC2");
  return value;
}

int GlbText::node(Json node, int parent) {
  const int index = add("nodes", std::move(node));
  Json& above = parent < 0 ? document["scenes"][0]["nodes"]
                           : document["nodes"][static_cast<std::size_t>(parent)]["children"];
  above.push_back(index);
  return index;
}

void GlbText::animate(int node, const char* path, const std::vector<float>& times_s,
                      const std::vector<float>& values) {
  Json& list = document["animations"];
  if (list.is_null())
    list = Json::array({{{"name", "all"}, {"channels", Json::array()}, {"samplers", Json::array()}}});
  const std::size_t width = values.size() / times_s.size();
  const int input = floats(times_s, "SCALAR");
  const int output = floats(values, width == 1 ? "SCALAR" : width == 3 ? "VEC3" : "VEC4");
  Json& all = document["animations"][0];
  all["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", "LINEAR"}});
  all["channels"].push_back(
      {{"sampler", all["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
}

std::string GlbText::file() const {
  Json with_buffer = document;
  with_buffer["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
  std::string chunks;
  append_chunk(chunks, "JSON", with_buffer.dump(), ' ');
  append_chunk(chunks, "BIN\0", bytes_, '\0');
  std::string out = "glTF";
  append_number(out, 2);
  append_number(out, static_cast<std::uint32_t>(12 + chunks.size()));
  return out + chunks;
}

}  // namespace gnomon::stress
