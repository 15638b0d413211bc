// What decoders of geometry share: the budget, and where bytes come from and go to.
#include "gltf_compression.hpp"

#include "refusal.hpp"

namespace gnomon::detail {

void spend_decoded(Compressed& file, std::uint64_t count, std::uint64_t size, const std::string& where) {
  if (size != 0 && count > file.bytes_left / size) {
    throw Refusal(where, std::to_string(count) + " elements of " + std::to_string(size) +
                             " bytes take decoded data above " + std::to_string(file.limits.total_bytes) +
                             " bytes");
  }
  file.bytes_left -= count * size;
}

std::span<const std::uint8_t> part_of(const Compressed& file, std::size_t buffer, std::uint64_t offset,
                                      std::uint64_t length, const std::string& where) {
  const Bytes& bytes = file.data[buffer];
  if (bytes.empty()) throw Refusal(where, element("buffers", buffer) + " has no data");
  if (offset > bytes.size() || length > bytes.size() - offset) {
    throw Refusal(where, "bytes " + std::to_string(offset) + " + " + std::to_string(length) +
                             " lie beyond the buffer's " + std::to_string(bytes.size()));
  }
  return std::span<const std::uint8_t>(bytes).subspan(static_cast<std::size_t>(offset),
                                                      static_cast<std::size_t>(length));
}

std::size_t add_buffer(Compressed& file, Bytes bytes) {
  file.data.push_back(std::move(bytes));
  return file.data.size() - 1;
}

}  // namespace gnomon::detail
