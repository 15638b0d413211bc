// Data compressed by "deflate" inside of a zlib stream, as PNG files have it: read and written.
// Based on: P. Deutsch, J.-L. Gailly, "ZLIB Compressed Data Format" (RFC 1950) and "DEFLATE" (RFC 1951),
// 1996.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::detail {

/// The `size` bytes that a zlib stream holds. Empty where the stream is damaged, or holds fewer or more.
[[nodiscard]] std::vector<std::uint8_t> inflate(std::span<const std::uint8_t> stream, std::size_t size);

/// A zlib stream that holds `bytes`.
[[nodiscard]] std::vector<std::uint8_t> deflate(std::span<const std::uint8_t> bytes);

}  // namespace gnomon::detail
