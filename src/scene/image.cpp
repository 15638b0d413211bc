// Pictures to and from files, through OpenImageIO; no other file includes it.
#include "gnomon/scene/image.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <string_view>

#include "base/whole_file.hpp"
#include "gnomon/scene/load.hpp"
#include "image_formats.hpp"
#include "refusal.hpp"

namespace gnomon {

namespace {

constexpr std::uint64_t kMaxSide = 1u << 16;  // pixels; wider is no texture and overflows readers' row sizes

struct Header {
  const char* format;
  std::uint64_t width, height;
};

using Span = std::span<const std::uint8_t>;

std::uint64_t big_endian(Span bytes, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) value = value << 8 | bytes[at + i];
  return value;
}

std::optional<Header> png_header(Span bytes) {
  constexpr std::uint8_t kMagic[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  constexpr std::size_t kWidthAt = 16, kHeightAt = 20, kEnd = 24;
  if (bytes.size() < kEnd || !std::equal(std::begin(kMagic), std::end(kMagic), bytes.begin()))
    return std::nullopt;
  return Header{"png", big_endian(bytes, kWidthAt, 4), big_endian(bytes, kHeightAt, 4)};
}

// Whether the chunks run whole up to the last, IEND. libpng says so as well, but on standard error.
bool png_is_whole(Span bytes) {
  constexpr std::size_t kFirstChunk = 8, kAroundData = 12;  // length, type and checksum
  std::size_t at = kFirstChunk;
  while (bytes.size() - at >= kAroundData) {
    const std::uint64_t length = big_endian(bytes, at, 4);
    if (length > bytes.size() - at - kAroundData) return false;
    if (big_endian(bytes, at + 4, 4) == 0x49454e44) return true;  // "IEND"
    at += kAroundData + static_cast<std::size_t>(length);
  }
  return false;
}

// Walks the segments up to the frame header (SOF), which says the size. ITU-T T.81 (1992), annex B.
std::optional<Header> jpeg_header(Span bytes) {
  if (bytes.size() < 4 || bytes[0] != 0xff || bytes[1] != 0xd8) return std::nullopt;
  std::size_t at = 2;
  while (at + 9 <= bytes.size()) {
    if (bytes[at] != 0xff) return std::nullopt;
    const std::uint8_t marker = bytes[at + 1];
    if (marker == 0xff) {  // fill byte
      ++at;
      continue;
    }
    const bool is_frame =
        marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (is_frame) return Header{"jpeg", big_endian(bytes, at + 7, 2), big_endian(bytes, at + 5, 2)};
    at += 2 + static_cast<std::size_t>(big_endian(bytes, at + 2, 2));
  }
  return std::nullopt;
}

std::uint64_t little_endian(Span bytes, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = size; i-- > 0;) value = value << 8 | bytes[at + i];
  return value;
}

// RIFF with one of three first chunks. Google, "WebP Container Specification", 2012; RFC 6386, section 9.1.
std::optional<Header> webp_header(Span bytes) {
  constexpr std::size_t kEnd = 30, kChunk = 12, kData = 20;
  const auto is = [&](std::size_t at, const char* tag) {
    return std::equal(tag, tag + 4, bytes.begin() + static_cast<std::ptrdiff_t>(at));
  };
  if (bytes.size() < kEnd || !is(0, "RIFF") || !is(8, "WEBP")) return std::nullopt;
  if (is(kChunk, "VP8 "))
    return Header{"webp", little_endian(bytes, kData + 6, 2) & 0x3fff,
                  little_endian(bytes, kData + 8, 2) & 0x3fff};
  if (is(kChunk, "VP8L")) {
    const std::uint64_t bits = little_endian(bytes, kData + 1, 4);
    return Header{"webp", (bits & 0x3fff) + 1, (bits >> 14 & 0x3fff) + 1};
  }
  constexpr std::uint8_t kAnimation = 2;
  if (!is(kChunk, "VP8X") || (bytes[kData] & kAnimation) != 0) return std::nullopt;
  return Header{"webp", little_endian(bytes, kData + 4, 3) + 1, little_endian(bytes, kData + 7, 3) + 1};
}

// Whether the file is as long as its header says.
bool webp_is_whole(Span bytes) {
  return little_endian(bytes, 4, 4) + 8 <= bytes.size();
}

Header checked_header(Span bytes, const std::string& name, std::uint64_t max_pixels) {
  auto header = png_header(bytes);
  if (!header) header = jpeg_header(bytes);
  if (!header) header = webp_header(bytes);
  if (!header) throw SceneError(detail::one_line(name + ": picture: is neither PNG, JPEG nor a single WebP"));
  const bool sane =
      header->width > 0 && header->height > 0 && header->width <= kMaxSide && header->height <= kMaxSide;
  if (!sane || header->width * header->height > max_pixels) {
    throw SceneError(detail::one_line(name + ": picture: " + std::to_string(header->width) + " x " +
                                      std::to_string(header->height) +
                                      " pixels are not within the limit of " + std::to_string(max_pixels)));
  }
  return *header;
}

// Gray, gray with alpha, colour, colour with alpha: four channels of each.
void expand(const std::vector<std::uint8_t>& raw, std::size_t channels, std::vector<std::uint8_t>& rgba) {
  for (std::size_t i = 0; i < rgba.size() / 4; ++i) {
    const std::uint8_t* from = &raw[i * channels];
    std::uint8_t* to = &rgba[i * 4];
    const bool gray = channels < 3;
    to[0] = from[0];
    to[1] = gray ? from[0] : from[1];
    to[2] = gray ? from[0] : from[2];
    to[3] = channels % 2 == 0 ? from[channels - 1] : std::uint8_t{255};
  }
}

std::vector<unsigned char> encoded(const char* format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                                   const void* pixels, const std::string& where) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  auto out = OIIO::ImageOutput::create(format);
  const bool done = out && out->set_ioproxy(&memory) && out->open("memory", spec) &&
                    out->write_image(type, pixels) && out->close();
  if (!done) {
    throw SceneError(detail::one_line(
        where + ": picture: cannot be encoded: " + (out ? out->geterror() : OIIO::geterror())));
  }
  return bytes;
}

// Not through OpenImageIO, whose PNG writer does not notice a disk that is full.
void write_file(const char* format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type, const void* pixels,
                const std::filesystem::path& file) {
  const std::vector<unsigned char> bytes = encoded(format, spec, type, pixels, file.string());
  const std::string why = write_whole_file(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  if (!why.empty()) {
    throw SceneError(detail::one_line(file.string() + ": picture: cannot be written: " + why));
  }
}

OIIO::ImageSpec rgb_spec(const Image& image, int channels, const std::string& where) {
  const auto pixels = static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
  if (image.width <= 0 || image.height <= 0 || image.rgba.size() != pixels * 4) {
    throw SceneError(detail::one_line(where + ": picture: has no pixels, or not as many as its size says"));
  }
  OIIO::ImageSpec spec(image.width, image.height, channels, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  return spec;
}

}  // namespace

bool detail::reads_webp() noexcept {
  static const bool reads = OIIO::ImageInput::create("webp") != nullptr;
  return reads;
}

Image decode_image(std::span<const std::uint8_t> bytes, const std::string& name, std::uint64_t max_pixels) {
  const Header header = checked_header(bytes, name, max_pixels);
  const auto fail = [&](const std::string& why) {
    throw SceneError(detail::one_line(name + ": picture: damaged " + header.format + ": " + why));
  };
  if (header.format == std::string_view("png") && !png_is_whole(bytes)) fail("it is cut off");
  if (header.format == std::string_view("webp") && !webp_is_whole(bytes)) fail("it is cut off");
  // The reader is chosen by name: OpenImageIO would otherwise try every format it knows on bytes it does
  // not.
  auto in = OIIO::ImageInput::create(header.format);
  if (!in) fail(OIIO::geterror());
  OIIO::Filesystem::IOMemReader memory(const_cast<std::uint8_t*>(bytes.data()), bytes.size());
  OIIO::ImageSpec config, spec;
  config.attribute("oiio:UnassociatedAlpha",
                   1);  // alpha is coverage here; colour must not be multiplied by it
  if (!in->set_ioproxy(&memory) || !in->open(name, spec, config)) fail(in->geterror());
  const bool as_promised = spec.width == static_cast<int>(header.width) &&
                           spec.height == static_cast<int>(header.height) && spec.nchannels >= 1 &&
                           spec.nchannels <= 4;
  if (!as_promised) fail("its size is not what its header says");
  Image out;
  out.name = name;
  out.width = spec.width;
  out.height = spec.height;
  const std::size_t pixels = static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height);
  std::vector<std::uint8_t> raw(pixels * static_cast<std::size_t>(spec.nchannels));
  if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, raw.data())) fail(in->geterror());
  in->close();
  out.rgba.resize(pixels * 4);
  expand(raw, static_cast<std::size_t>(spec.nchannels), out.rgba);
  return out;
}

std::vector<std::uint8_t> encode_png(const Image& image) {
  const OIIO::ImageSpec spec = rgb_spec(image, 4, image.name);
  return encoded("png", spec, OIIO::TypeDesc::UINT8, image.rgba.data(), image.name);
}

void write_png(const Image& image, const std::filesystem::path& file) {
  const OIIO::ImageSpec spec = rgb_spec(image, 3, file.string());
  std::vector<std::uint8_t> rgb(image.rgba.size() / 4 * 3);
  for (std::size_t i = 0; i < rgb.size() / 3; ++i) {
    for (std::size_t c = 0; c < 3; ++c) rgb[i * 3 + c] = image.rgba[i * 4 + c];
  }
  write_file("png", spec, OIIO::TypeDesc::UINT8, rgb.data(), file);
}

void write_exr(const FloatImage& image, const std::filesystem::path& file) {
  const auto values = static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height) *
                      static_cast<std::uint64_t>(image.channels);
  const bool whole = image.width > 0 && image.height > 0 && image.channels > 0 &&
                     image.values.size() == values &&
                     image.channel_names.size() == static_cast<std::size_t>(image.channels);
  if (!whole) {
    throw SceneError(
        detail::one_line(file.string() + ": picture: values or channel names do not match its size"));
  }
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT);
  spec.channelnames = image.channel_names;
  write_file("openexr", spec, OIIO::TypeDesc::FLOAT, image.values.data(), file);
}

}  // namespace gnomon
