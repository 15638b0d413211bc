// What does a scene file hold: JSON text and, for GLB, a binary chunk? Told by its bytes, not by its name.
// Based on: Khronos Group, glTF 2.0 Specification (2021), section 4.4 "GLB File Format Specification".
#include "glb.hpp"

#include <string>

#include "base/json_scan.hpp"
#include "refusal.hpp"

namespace gnomon::detail {

namespace {

constexpr std::size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinChunk = 0x004E4942;
constexpr int kJsonDepth = 64;                   // real files nest about 10 deep
constexpr std::size_t kJsonValues = 16'000'000;  // about 1 GB once parsed

std::uint32_t little_endian(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint32_t>(bytes[at]) | static_cast<std::uint32_t>(bytes[at + 1]) << 8 |
         static_cast<std::uint32_t>(bytes[at + 2]) << 16 | static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

bool is_glb(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= 4 && bytes[0] == 'g' && bytes[1] == 'l' && bytes[2] == 'T' && bytes[3] == 'F';
}

}  // namespace

Container open_container(std::span<const std::uint8_t> bytes) {
  Container out;
  if (!is_glb(bytes)) {
    out.json = {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    return out;
  }
  if (bytes.size() < kHeaderBytes + kChunkHeaderBytes) throw Refusal("GLB header", "file is too short");
  if (little_endian(bytes, 4) != 2) {
    throw Refusal("GLB header",
                  "version " + std::to_string(little_endian(bytes, 4)) + ", only 2 is supported");
  }
  const std::size_t length = little_endian(bytes, 8);
  if (length > bytes.size() || length < kHeaderBytes + kChunkHeaderBytes) {
    throw Refusal("GLB header", "length " + std::to_string(length) + " does not fit a file of " +
                                    std::to_string(bytes.size()) + " bytes");
  }
  std::size_t at = kHeaderBytes;
  for (std::size_t chunk = 0; at < length; ++chunk) {
    if (length - at < kChunkHeaderBytes) throw Refusal(element("GLB chunk", chunk), "header is cut off");
    const std::size_t size = little_endian(bytes, at);
    const std::uint32_t type = little_endian(bytes, at + 4);
    at += kChunkHeaderBytes;
    if (size > length - at) {
      throw Refusal(element("GLB chunk", chunk), std::to_string(size) + " bytes, but only " +
                                                     std::to_string(length - at) + " are left in the file");
    }
    if (chunk == 0) {
      if (type != kJsonChunk) throw Refusal("GLB chunk[0]", "is not JSON");
      out.json = {reinterpret_cast<const char*>(bytes.data()) + at, size};
    } else if (chunk == 1 && type == kBinChunk) {
      out.bin = bytes.subspan(at, size);
      out.has_bin = true;
    }
    at += size;
    // The last chunk may lack its padding in files from careless writers.
    const std::size_t padding = (4 - at % 4) % 4;
    at += padding < length - at ? padding : length - at;
  }
  return out;
}

void check_json_size(std::string_view json) {
  if (json.find_first_not_of(" \t\r\n") == std::string_view::npos) throw Refusal("JSON", "is empty");
  if (nested_deeper_at(json, kJsonDepth) != std::string_view::npos)
    throw Refusal("JSON", "nested more than " + std::to_string(kJsonDepth) + " deep");
  std::size_t values = 1;
  scan_outside_strings(json, [&](std::size_t, char c) {
    if (c == '[' || c == '{' || c == ',' || c == ':') ++values;
  });
  if (values > kJsonValues) throw Refusal("JSON", "more than " + std::to_string(kJsonValues) + " values");
}

}  // namespace gnomon::detail
