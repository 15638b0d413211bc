// How is a PNG file read and written? Based on: W3C, "Portable Network Graphics (PNG) Specification", 2nd
// edition, 2003.
#include "png.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

#include "inflate.hpp"

namespace gnomon::detail {
namespace {

using PngBytes = std::span<const std::uint8_t>;
constexpr std::array<std::uint8_t, 8> kMagic{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::size_t kHeaderAt = 16, kHeaderEnd = 33;  // of the first chunk's data and its checksum
enum class Colour : std::uint8_t { gray = 0, rgb = 2, palette = 3, gray_alpha = 4, rgba = 6 };

std::uint32_t big_endian(PngBytes bytes, std::size_t at) {
  return static_cast<std::uint32_t>(bytes[at]) << 24 | static_cast<std::uint32_t>(bytes[at + 1]) << 16 |
         static_cast<std::uint32_t>(bytes[at + 2]) << 8 | bytes[at + 3];
}

std::uint32_t crc32(PngBytes bytes) {
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> made{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t value = i;
      for (int bit = 0; bit < 8; ++bit) value = value & 1 ? 0xedb88320u ^ value >> 1 : value >> 1;
      made[i] = value;
    }
    return made;
  }();
  std::uint32_t sum = ~0u;
  for (const std::uint8_t byte : bytes) sum = table[(sum ^ byte) & 0xff] ^ sum >> 8;
  return ~sum;
}

struct Header {
  PngSize size;
  int depth = 8;  // bits of a sample
  Colour colour = Colour::rgba;
  [[nodiscard]] std::size_t channels() const {
    constexpr std::array<std::uint8_t, 7> kChannels{1, 0, 3, 1, 2, 0, 4};
    return kChannels[static_cast<std::size_t>(colour)];
  }
  [[nodiscard]] std::size_t row_bytes() const {
    return (size.width * channels() * static_cast<std::size_t>(depth) + 7) / 8;
  }
  /// The bytes between a sample and the one before it of the same channel, for the filters of rows.
  [[nodiscard]] std::size_t step() const {
    return std::max<std::size_t>(1, channels() * static_cast<std::size_t>(depth) / 8);
  }
};

Header header_of(PngBytes bytes) {
  Header header;
  header.size = png_size(bytes);
  header.depth = bytes[kHeaderAt + 8];
  const std::uint8_t colour = bytes[kHeaderAt + 9];
  if (colour > 6 || colour == 1 || colour == 5) throw PngError("its colour type is unknown");
  header.colour = static_cast<Colour>(colour);
  const bool small = header.colour == Colour::gray || header.colour == Colour::palette;
  const bool sane = header.depth == 8 || (header.depth == 16 && header.colour != Colour::palette) ||
                    (small && (header.depth == 1 || header.depth == 2 || header.depth == 4));
  if (!sane) throw PngError("its bit depth is unknown");
  if (bytes[kHeaderAt + 10] != 0 || bytes[kHeaderAt + 11] != 0) throw PngError("its method is unknown");
  if (bytes[kHeaderAt + 12] != 0) throw PngError("it is interlaced, which this program does not read");
  return header;
}

struct Chunks {
  std::vector<std::uint8_t> stream, palette, transparent;
};

/// The data of all chunks up to the last one; unknown ones are skipped unless the file calls them critical.
Chunks chunks_of(PngBytes bytes) {
  constexpr std::size_t kAroundData = 12;  // length, type and checksum
  Chunks chunks;
  for (std::size_t at = kMagic.size(); bytes.size() - at >= kAroundData;) {
    const std::uint32_t length = big_endian(bytes, at);
    if (length > bytes.size() - at - kAroundData) break;
    const PngBytes typed = bytes.subspan(at + 4, length + 4), data = typed.subspan(4);
    if (crc32(typed) != big_endian(bytes, at + 8 + length)) throw PngError("a checksum is wrong");
    const std::string_view type(reinterpret_cast<const char*>(typed.data()), 4);
    if (type == "IEND") return chunks;
    if (type == "IDAT")
      chunks.stream.insert(chunks.stream.end(), data.begin(), data.end());
    else if (type == "PLTE")
      chunks.palette.assign(data.begin(), data.end());
    else if (type == "tRNS")
      chunks.transparent.assign(data.begin(), data.end());
    else if (type != "IHDR" && (typed[0] & 0x20) == 0)
      throw PngError("it has an unknown critical chunk");
    at += kAroundData + length;
  }
  throw PngError("it is cut off");
}

std::uint8_t paeth(int left, int up, int corner) {
  const int guess = left + up - corner;
  const int to_left = std::abs(guess - left), to_up = std::abs(guess - up),
            to_corner = std::abs(guess - corner);
  if (to_left <= to_up && to_left <= to_corner) return static_cast<std::uint8_t>(left);
  return static_cast<std::uint8_t>(to_up <= to_corner ? up : corner);
}

/// What filter `kind` expects at a place, of its neighbours.
std::uint8_t expected(int kind, int left, int up, int corner) {
  switch (kind) {
    case 1:
      return static_cast<std::uint8_t>(left);
    case 2:
      return static_cast<std::uint8_t>(up);
    case 3:
      return static_cast<std::uint8_t>((left + up) / 2);
    case 4:
      return paeth(left, up, corner);
    default:
      return 0;
  }
}

/// Adds to each byte of the rows what its filter expects there; the byte in front of a row names its filter.
void undo_filters(std::vector<std::uint8_t>& rows, std::size_t row_bytes, std::size_t step) {
  const std::vector<std::uint8_t> none(row_bytes, 0);
  const std::uint8_t* above = none.data();
  for (std::size_t begin = 0; begin < rows.size(); begin += row_bytes + 1) {
    const int kind = rows[begin];
    if (kind > 4) throw PngError("a row has an unknown filter");
    std::uint8_t* const row = &rows[begin + 1];
    for (std::size_t i = 0; i < row_bytes; ++i) {
      const int left = i < step ? 0 : row[i - step], corner = i < step ? 0 : above[i - step];
      row[i] = static_cast<std::uint8_t>(row[i] + expected(kind, left, above[i], corner));
    }
    above = row;
  }
}

/// Sample `index` of a row, as it is stored.
std::uint32_t stored_sample(const std::uint8_t* row, std::size_t index, int depth) {
  if (depth == 8) return row[index];
  if (depth == 16) return static_cast<std::uint32_t>(row[2 * index] << 8 | row[2 * index + 1]);
  const std::size_t bit = index * static_cast<std::size_t>(depth);
  return static_cast<std::uint32_t>(row[bit / 8] >> (8 - depth - static_cast<int>(bit % 8)) &
                                    ((1 << depth) - 1));
}

std::uint8_t to_8_bits(std::uint32_t value, int depth) {
  const std::uint32_t most = (1u << depth) - 1;
  return static_cast<std::uint8_t>((value * 255 + most / 2) / most);
}

/// One pixel of a palette, 255 where no transparency is stated.
void put_palette(const Chunks& chunks, std::uint32_t index, std::uint8_t* to) {
  if (3 * index + 2 >= chunks.palette.size()) throw PngError("a pixel is outside of the palette");
  std::copy_n(&chunks.palette[3 * index], 3, to);
  to[3] = index < chunks.transparent.size() ? chunks.transparent[index] : std::uint8_t{255};
}

/// One pixel of gray or colour. A colour without alpha may be called transparent.
void put_samples(const Header& header, const Chunks& chunks, const std::array<std::uint32_t, 4>& samples,
                 std::uint8_t* to) {
  const std::size_t channels = header.channels(), colours = channels < 3 ? 1 : 3;
  for (std::size_t c = 0; c < 3; ++c) to[c] = to_8_bits(samples[colours == 1 ? 0 : c], header.depth);
  to[3] = channels % 2 == 0 ? to_8_bits(samples[channels - 1], header.depth) : std::uint8_t{255};
  if (channels % 2 == 0 || chunks.transparent.size() != 2 * colours) return;
  bool clear = true;
  for (std::size_t c = 0; c < colours; ++c)
    clear = clear && samples[c] == static_cast<std::uint32_t>(chunks.transparent[2 * c] << 8 |
                                                              chunks.transparent[2 * c + 1]);
  if (clear) to[3] = 0;
}

void append_chunk(std::vector<std::uint8_t>& out, std::string_view type, PngBytes data) {
  const auto put = [&](std::uint32_t value) {
    for (const int shift : {24, 16, 8, 0}) out.push_back(static_cast<std::uint8_t>(value >> shift));
  };
  put(static_cast<std::uint32_t>(data.size()));
  const std::size_t begin = out.size();
  out.insert(out.end(), type.begin(), type.end());
  out.insert(out.end(), data.begin(), data.end());
  put(crc32(PngBytes(out).subspan(begin)));
}

/// Each row with the filter that leaves the least sum of magnitudes, as libpng chooses.
std::vector<std::uint8_t> filtered(PngBytes pixels, std::size_t row_bytes, std::size_t step) {
  std::vector<std::uint8_t> out, best, row(row_bytes);
  out.reserve(pixels.size() + pixels.size() / row_bytes);
  for (std::size_t begin = 0; begin < pixels.size(); begin += row_bytes) {
    long least = -1;
    int chosen = 0;
    for (int kind = 0; kind <= 4; ++kind) {
      long sum = 0;
      for (std::size_t i = 0; i < row_bytes; ++i) {
        const std::size_t at = begin + i;
        const int left = i < step ? 0 : pixels[at - step], up = begin == 0 ? 0 : pixels[at - row_bytes];
        const int corner = i < step || begin == 0 ? 0 : pixels[at - row_bytes - step];
        row[i] = static_cast<std::uint8_t>(pixels[at] - expected(kind, left, up, corner));
        sum += std::min<int>(row[i], 256 - row[i]);
      }
      if (least >= 0 && sum >= least) continue;
      least = sum;
      chosen = kind;
      best = row;
    }
    out.push_back(static_cast<std::uint8_t>(chosen));
    out.insert(out.end(), best.begin(), best.end());
  }
  return out;
}

}  // namespace

bool is_png(PngBytes bytes) noexcept {
  return bytes.size() >= kMagic.size() && std::equal(kMagic.begin(), kMagic.end(), bytes.begin());
}

PngSize png_size(PngBytes bytes) {
  if (!is_png(bytes) || bytes.size() < kHeaderEnd) throw PngError("it is cut off");
  const std::string_view type(reinterpret_cast<const char*>(&bytes[kHeaderAt - 4]), 4);
  if (type != "IHDR" || big_endian(bytes, kHeaderAt - 8) != 13)
    throw PngError("it does not begin with its header");
  return {big_endian(bytes, kHeaderAt), big_endian(bytes, kHeaderAt + 4)};
}

std::vector<std::uint8_t> decode_png(PngBytes bytes) {
  const Header header = header_of(bytes);
  const Chunks chunks = chunks_of(bytes);
  const std::size_t row_bytes = header.row_bytes(), channels = header.channels(), height = header.size.height;
  std::vector<std::uint8_t> rows = inflate(chunks.stream, height * (row_bytes + 1));
  if (rows.empty()) throw PngError("its pixels are damaged");
  undo_filters(rows, row_bytes, header.step());
  std::vector<std::uint8_t> rgba(std::size_t{header.size.width} * height * 4);
  std::uint8_t* to = rgba.data();
  for (std::size_t y = 0; y < height; ++y) {
    const std::uint8_t* const row = &rows[y * (row_bytes + 1) + 1];
    for (std::size_t x = 0; x < header.size.width; ++x, to += 4) {
      std::array<std::uint32_t, 4> samples{};
      for (std::size_t c = 0; c < channels; ++c)
        samples[c] = stored_sample(row, x * channels + c, header.depth);
      if (header.colour == Colour::palette)
        put_palette(chunks, samples[0], to);
      else
        put_samples(header, chunks, samples, to);
    }
  }
  return rgba;
}

std::vector<std::uint8_t> encode_png(PngBytes pixels, PngSize size, int channels) {
  std::vector<std::uint8_t> out(kMagic.begin(), kMagic.end());
  std::vector<std::uint8_t> header;
  for (const std::uint32_t value : {size.width, size.height})
    for (const int shift : {24, 16, 8, 0}) header.push_back(static_cast<std::uint8_t>(value >> shift));
  const Colour colour = channels == 3 ? Colour::rgb : Colour::rgba;
  for (const int value : {8, static_cast<int>(colour), 0, 0, 0})
    header.push_back(static_cast<std::uint8_t>(value));
  append_chunk(out, "IHDR", header);
  const auto step = static_cast<std::size_t>(channels);
  append_chunk(out, "IDAT", deflate(filtered(pixels, size.width * step, step)));
  append_chunk(out, "IEND", {});
  return out;
}

}  // namespace gnomon::detail
