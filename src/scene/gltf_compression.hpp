// How does compressed geometry become plain glTF? Views and primitives are decoded into buffers of their own
// before any triangle is made, so that all later checks see plain data.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "files.hpp"
#include "gnomon/scene/load.hpp"

namespace gnomon::detail {

/// A document that is being read: its JSON as it came, its checked JSON, the bytes of its buffers.
struct Compressed {
  const nlohmann::json& source;
  nlohmann::json& document;
  std::vector<Bytes>& data;
  const LoadLimits& limits;
  std::uint64_t bytes_left;  ///< that decoded data may still take
};

/// Whether this build decodes KHR_draco_mesh_compression (libdraco) and EXT_meshopt_compression
/// (meshoptimizer).
[[nodiscard]] bool decodes_draco() noexcept;
[[nodiscard]] bool decodes_meshopt() noexcept;

/// Replaces each compressed buffer view by one of decoded data. Throws Refusal. Nothing without
/// meshoptimizer.
void decode_meshopt_views(Compressed& file);
/// Replaces the accessors of each compressed primitive by ones of decoded data. Throws Refusal. Nothing
/// without libdraco.
void decode_draco_primitives(Compressed& file);

/// Takes `count` elements of `size` bytes from what may still be decoded. Throws Refusal where they are too
/// many.
void spend_decoded(Compressed& file, std::uint64_t count, std::uint64_t size, const std::string& where);
/// A part of a buffer. Throws Refusal where it lies beyond the buffer's end, or the buffer has no data.
[[nodiscard]] std::span<const std::uint8_t> part_of(const Compressed& file, std::size_t buffer,
                                                    std::uint64_t offset, std::uint64_t length,
                                                    const std::string& where);
/// Adds decoded bytes as a buffer. Returns its index.
std::size_t add_buffer(Compressed& file, Bytes bytes);

}  // namespace gnomon::detail
