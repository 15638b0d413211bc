// Decodes EXT_meshopt_compression: buffer views of vertices and indices, packed by meshoptimizer.
// Based on: Khronos Group, EXT_meshopt_compression (2021).
#include <meshoptimizer.h>

#include "gltf_check.hpp"
#include "gltf_compression.hpp"
#include "refusal.hpp"

namespace gnomon::detail {

using nlohmann::json;

namespace {

constexpr std::uint64_t kMaxPackedStride = 256;  // bytes of a vertex, the format's own limit

void check_layout(const json& extension, const std::string& where) {
  const auto mode = extension["mode"].get<std::string>(),
             filter = extension.value("filter", std::string("NONE"));
  const auto stride = extension["byteStride"].get<std::uint64_t>(),
             count = extension["count"].get<std::uint64_t>();
  const bool vertices = mode == "ATTRIBUTES", triangles = mode == "TRIANGLES";
  if (!vertices && !triangles && mode != "INDICES")
    throw Refusal(where + ".mode", "'" + one_line(mode) + "' is not ATTRIBUTES, TRIANGLES or INDICES");
  const bool fits =
      vertices ? stride > 0 && stride % 4 == 0 && stride <= kMaxPackedStride : stride == 2 || stride == 4;
  if (!fits) throw Refusal(where + ".byteStride", std::to_string(stride) + " does not fit mode " + mode);
  if (triangles && count % 3 != 0)
    throw Refusal(where + ".count", std::to_string(count) + " is no multiple of 3");
  const bool known =
      filter == "NONE" || (vertices && (filter == "EXPONENTIAL" || (filter == "QUATERNION" && stride == 8) ||
                                        (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8))));
  if (!known) throw Refusal(where + ".filter", "'" + one_line(filter) + "' does not fit mode and stride");
}

Bytes decoded(std::span<const std::uint8_t> packed, const json& extension, const std::string& where) {
  const auto mode = extension["mode"].get<std::string>(),
             filter = extension.value("filter", std::string("NONE"));
  const auto stride = extension["byteStride"].get<std::size_t>(),
             count = extension["count"].get<std::size_t>();
  Bytes out(count * stride);
  int failed = 0;
  if (mode == "ATTRIBUTES") {
    failed = meshopt_decodeVertexBuffer(out.data(), count, stride, packed.data(), packed.size());
  } else if (mode == "TRIANGLES") {
    failed = meshopt_decodeIndexBuffer(out.data(), count, stride, packed.data(), packed.size());
  } else {
    failed = meshopt_decodeIndexSequence(out.data(), count, stride, packed.data(), packed.size());
  }
  if (failed != 0) throw Refusal(where, "its meshopt data are damaged");
  if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), count, stride);
  if (filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), count, stride);
  if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), count, stride);
  return out;
}

}  // namespace

bool decodes_meshopt() noexcept {
  return true;
}

void decode_meshopt_views(Compressed& file) {
  const auto views = file.document.find("bufferViews");
  if (views == file.document.end()) return;
  for (std::size_t i = 0; i < views->size(); ++i) {
    const std::string where = element("bufferViews", i) + ".EXT_meshopt_compression";
    const json extension = checked_meshopt(file.source, file.source["bufferViews"][i], where);
    if (extension.is_null()) continue;
    check_layout(extension, where);
    json& view = (*views)[i];
    const auto stride = extension["byteStride"].get<std::uint64_t>(),
               count = extension["count"].get<std::uint64_t>();
    spend_decoded(file, count, stride, where);
    if (view["byteLength"].get<std::uint64_t>() != count * stride)
      throw Refusal(where,
                    "the view's byteLength is not count x byteStride, " + std::to_string(count * stride));
    const std::span<const std::uint8_t> packed =
        part_of(file, extension["buffer"].get<std::size_t>(), extension.value("byteOffset", std::uint64_t{0}),
                extension["byteLength"].get<std::uint64_t>(), where);
    view["buffer"] = add_buffer(file, decoded(packed, extension, where));
    view["byteOffset"] = 0;
  }
}

}  // namespace gnomon::detail
