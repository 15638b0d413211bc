// How is a zlib stream read and written? Based on: RFC 1950, RFC 1951.
#include "inflate.hpp"

#include <algorithm>
#include <array>
#include <optional>

namespace gnomon::detail {
namespace {

constexpr std::size_t kWindow = 32768;  // bytes that a copy may reach back
constexpr int kMaxBits = 15;            // of a code
constexpr int kEndOfBlock = 256, kLiteralCodes = 288, kDistanceCodes = 30;
// Lengths and distances of copies: base values and extra bits (RFC 1951, 3.2.5).
constexpr std::array<std::uint16_t, 29> kLengthBase{3,  4,  5,  6,   7,   8,   9,   10,  11, 13,
                                                    15, 17, 19, 23,  27,  31,  35,  43,  51, 59,
                                                    67, 83, 99, 115, 131, 163, 195, 227, 258};
constexpr std::array<std::uint8_t, 29> kLengthBits{0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                                   2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
constexpr std::array<std::uint16_t, 30> kDistanceBase{
    1,   2,   3,   4,   5,   7,    9,    13,   17,   25,   33,   49,   65,    97,    129,
    193, 257, 385, 513, 769, 1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
constexpr std::array<std::uint8_t, 30> kDistanceBits{0, 0, 0, 0, 1, 1, 2, 2,  3,  3,  4,  4,  5,  5,  6,
                                                     6, 7, 7, 8, 8, 9, 9, 10, 10, 11, 11, 12, 12, 13, 13};

std::uint32_t adler32(std::span<const std::uint8_t> bytes) {
  std::uint32_t a = 1, b = 0;
  for (const std::uint8_t byte : bytes) {
    a = (a + byte) % 65521;
    b = (b + a) % 65521;
  }
  return b << 16 | a;
}

/// Bits from the least significant one of each byte on. Past the end they are zero, and `overrun` is set.
class BitReader {
 public:
  explicit BitReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  std::uint32_t bits(int count) {
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i) {
      if (at_ == 8 * bytes_.size()) {
        overrun = true;
        return 0;
      }
      value |= static_cast<std::uint32_t>(bytes_[at_ / 8] >> at_ % 8 & 1) << i;
      ++at_;
    }
    return value;
  }
  void to_byte() { at_ = (at_ + 7) / 8 * 8; }
  bool overrun = false;

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;  // bit
};

/// Codes of a block: how many there are of each length, and their symbols in order.
class Codes {
 public:
  /// False where the lengths make more codes than there are.
  [[nodiscard]] bool set(std::span<const std::uint8_t> lengths) {
    count_.fill(0);
    for (const std::uint8_t length : lengths) ++count_[length];
    count_[0] = 0;
    int left = 1;
    for (int length = 1; length <= kMaxBits; ++length) {
      left = 2 * left - count_[static_cast<std::size_t>(length)];
      if (left < 0) return false;
    }
    std::array<std::uint16_t, kMaxBits + 2> offset{};
    for (std::size_t length = 1; length <= kMaxBits; ++length)
      offset[length + 1] = static_cast<std::uint16_t>(offset[length] + count_[length]);
    for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol) {
      if (lengths[symbol] != 0) symbols_[offset[lengths[symbol]]++] = static_cast<std::uint16_t>(symbol);
    }
    return true;
  }
  /// -1 where the bits are no code.
  [[nodiscard]] int next(BitReader& in) const {
    int code = 0, first = 0, index = 0;
    for (std::size_t length = 1; length <= kMaxBits; ++length) {
      code |= static_cast<int>(in.bits(1));
      const int count = count_[length];
      if (code - count < first) return symbols_[static_cast<std::size_t>(index + code - first)];
      index += count;
      first = (first + count) << 1;
      code <<= 1;
    }
    return -1;
  }

 private:
  std::array<std::uint16_t, kMaxBits + 1> count_{};
  std::array<std::uint16_t, kLiteralCodes> symbols_{};
};

struct BlockCodes {
  Codes literals, distances;
};

BlockCodes fixed_codes() {
  std::array<std::uint8_t, kLiteralCodes> lengths{};
  std::fill(lengths.begin(), lengths.begin() + 144, std::uint8_t{8});
  std::fill(lengths.begin() + 144, lengths.begin() + 256, std::uint8_t{9});
  std::fill(lengths.begin() + 256, lengths.begin() + 280, std::uint8_t{7});
  std::fill(lengths.begin() + 280, lengths.end(), std::uint8_t{8});
  std::array<std::uint8_t, kDistanceCodes> distances{};
  distances.fill(5);
  BlockCodes codes;
  (void)codes.literals.set(lengths);
  (void)codes.distances.set(distances);
  return codes;
}

/// The codes that a block begins with, themselves coded.
std::optional<BlockCodes> dynamic_codes(BitReader& in) {
  constexpr std::array<std::uint8_t, 19> kOrder{16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                11, 4,  12, 3, 13, 2, 14, 1, 15};
  const std::size_t literals = in.bits(5) + 257, distances = in.bits(5) + 1, count = in.bits(4) + 4;
  if (literals > 286 || distances > kDistanceCodes) return std::nullopt;
  std::array<std::uint8_t, 19> of_lengths{};
  for (std::size_t i = 0; i < count; ++i) of_lengths[kOrder[i]] = static_cast<std::uint8_t>(in.bits(3));
  Codes codes;
  if (!codes.set(of_lengths)) return std::nullopt;
  std::array<std::uint8_t, 286 + kDistanceCodes> lengths{};
  for (std::size_t i = 0; i < literals + distances;) {
    const int symbol = codes.next(in);
    if (symbol < 0 || in.overrun) return std::nullopt;
    if (symbol < 16) {
      lengths[i++] = static_cast<std::uint8_t>(symbol);
      continue;
    }
    if (symbol == 16 && i == 0) return std::nullopt;
    const std::uint8_t value = symbol == 16 ? lengths[i - 1] : std::uint8_t{0};
    const std::size_t repeat = symbol == 16   ? 3 + in.bits(2)
                               : symbol == 17 ? 3 + in.bits(3)
                                              : 11 + in.bits(7);
    if (repeat > literals + distances - i) return std::nullopt;
    for (std::size_t k = 0; k < repeat; ++k) lengths[i++] = value;
  }
  if (lengths[kEndOfBlock] == 0) return std::nullopt;
  BlockCodes block;
  const std::span all(lengths);
  if (!block.literals.set(all.first(literals)) || !block.distances.set(all.subspan(literals, distances)))
    return std::nullopt;
  return block;
}

/// Appends a block of codes; false where it is damaged or makes more than `size` bytes of all.
bool read_block(BitReader& in, const BlockCodes& codes, std::vector<std::uint8_t>& out, std::size_t size) {
  while (!in.overrun) {
    const int symbol = codes.literals.next(in);
    if (symbol == kEndOfBlock) return !in.overrun;
    if (symbol < 0 || symbol > 285) return false;
    if (symbol < kEndOfBlock) {
      if (out.size() == size) return false;
      out.push_back(static_cast<std::uint8_t>(symbol));
      continue;
    }
    const auto row = static_cast<std::size_t>(symbol - 257);
    const std::size_t length = kLengthBase[row] + in.bits(kLengthBits[row]);
    const int column = codes.distances.next(in);
    if (column < 0) return false;
    const auto at = static_cast<std::size_t>(column);
    const std::size_t distance = kDistanceBase[at] + in.bits(kDistanceBits[at]);
    if (distance > out.size() || length > size - out.size()) return false;
    for (std::size_t i = 0; i < length; ++i) out.push_back(out[out.size() - distance]);
  }
  return false;
}

bool read_stored(BitReader& in, std::vector<std::uint8_t>& out, std::size_t size) {
  in.to_byte();
  const std::uint32_t length = in.bits(16), inverse = in.bits(16);
  if (in.overrun || length != (~inverse & 0xffff) || length > size - out.size()) return false;
  for (std::uint32_t i = 0; i < length; ++i) out.push_back(static_cast<std::uint8_t>(in.bits(8)));
  return !in.overrun;
}

class BitWriter {
 public:
  void bits(std::uint32_t value, int count) {
    for (int i = 0; i < count; ++i) {
      if (at_ % 8 == 0) bytes.push_back(0);
      bytes.back() = static_cast<std::uint8_t>(bytes.back() | (value >> i & 1) << at_ % 8);
      ++at_;
    }
  }
  /// Codes go from their most significant bit on.
  void code(std::uint32_t value, int count) {
    for (int i = count - 1; i >= 0; --i) bits(value >> i & 1, 1);
  }
  std::vector<std::uint8_t> bytes;

 private:
  std::size_t at_ = 0;
};

/// A literal, a length or the end of a block in the fixed code.
void write_fixed(BitWriter& out, std::uint32_t symbol) {
  if (symbol < 144)
    out.code(0x30 + symbol, 8);
  else if (symbol < 256)
    out.code(0x190 + symbol - 144, 9);
  else if (symbol < 280)
    out.code(symbol - 256, 7);
  else
    out.code(0xc0 + symbol - 280, 8);
}

template <std::size_t N>
std::uint32_t row_of(const std::array<std::uint16_t, N>& base, std::size_t value) {
  return static_cast<std::uint32_t>(std::upper_bound(base.begin(), base.end(), value) - base.begin() - 1);
}

void write_copy(BitWriter& out, std::size_t length, std::size_t distance) {
  const std::uint32_t row = row_of(kLengthBase, length), column = row_of(kDistanceBase, distance);
  write_fixed(out, 257 + row);
  out.bits(static_cast<std::uint32_t>(length - kLengthBase[row]), kLengthBits[row]);
  out.code(column, 5);
  out.bits(static_cast<std::uint32_t>(distance - kDistanceBase[column]), kDistanceBits[column]);
}

}  // namespace

std::vector<std::uint8_t> inflate(std::span<const std::uint8_t> stream, std::size_t size) {
  constexpr std::size_t kHeader = 2, kChecksum = 4;
  const bool sane = stream.size() >= kHeader + kChecksum && (stream[0] & 0x0f) == 8 && stream[0] >> 4 <= 7 &&
                    (256 * stream[0] + stream[1]) % 31 == 0 && (stream[1] & 0x20) == 0;
  if (!sane) return {};
  BitReader in(stream.subspan(kHeader));
  std::vector<std::uint8_t> out;
  // A short stream that promises gigabytes must not take them.
  out.reserve(std::min(size, 1032 * stream.size()));
  for (bool last = false; !last;) {
    last = in.bits(1) == 1;
    const std::uint32_t kind = in.bits(2);
    bool whole = false;
    if (kind == 0) {
      whole = read_stored(in, out, size);
    } else if (kind == 1) {
      whole = read_block(in, fixed_codes(), out, size);
    } else if (kind == 2) {
      const std::optional<BlockCodes> codes = dynamic_codes(in);
      whole = codes && read_block(in, *codes, out, size);
    }
    if (!whole || in.overrun) return {};
  }
  in.to_byte();
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < kChecksum; ++i) sum = sum << 8 | in.bits(8);
  if (in.overrun || out.size() != size || sum != adler32(out)) return {};
  return out;
}

std::vector<std::uint8_t> deflate(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kShortest = 3, kLongest = 258;
  constexpr int kHashBits = 15;
  BitWriter out;
  out.bits(0x78, 8);  // a window of 32 kB
  out.bits(0x01, 8);
  out.bits(1, 1);  // the last block
  out.bits(1, 2);  // of the fixed code
  // The place after the last one where three bytes with this hash stood; 0 is none.
  std::vector<std::size_t> last(std::size_t{1} << kHashBits, 0);
  const auto hash = [&](std::size_t at) {
    const std::uint32_t three =
        static_cast<std::uint32_t>(bytes[at] | bytes[at + 1] << 8 | bytes[at + 2] << 16);
    return static_cast<std::size_t>(three * 2654435761u >> (32 - kHashBits));
  };
  for (std::size_t at = 0; at < bytes.size();) {
    std::size_t length = 0, distance = 0;
    if (at + kShortest <= bytes.size()) {
      std::size_t& place = last[hash(at)];
      if (place != 0 && at - (place - 1) <= kWindow) {
        distance = at - (place - 1);
        const std::size_t most = std::min(kLongest, bytes.size() - at);
        while (length < most && bytes[at + length] == bytes[at + length - distance]) ++length;
      }
      place = at + 1;
    }
    if (length < kShortest) {
      write_fixed(out, bytes[at++]);
      continue;
    }
    write_copy(out, length, distance);
    for (std::size_t i = 1; i < length && at + i + kShortest <= bytes.size(); ++i)
      last[hash(at + i)] = at + i + 1;
    at += length;
  }
  write_fixed(out, kEndOfBlock);
  std::vector<std::uint8_t> stream = std::move(out.bytes);
  const std::uint32_t sum = adler32(bytes);
  for (const int shift : {24, 16, 8, 0}) stream.push_back(static_cast<std::uint8_t>(sum >> shift));
  return stream;
}

}  // namespace gnomon::detail
