// Our own PNG against OpenImageIO's: programs that are built without the latter read and write with it.
#include "png.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "gnomon/scene/image.hpp"
#include "inflate.hpp"

namespace gnomon::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes written_by_openimageio(int width, int height, int channels, OIIO::TypeDesc type, const Bytes& raw) {
  OIIO::ImageSpec spec(width, height, channels, type);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  Bytes bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  auto out = OIIO::ImageOutput::create("png");
  EXPECT_TRUE(out && out->set_ioproxy(&memory) && out->open("memory", spec) &&
              out->write_image(type, raw.data()) && out->close());
  return bytes;
}

Bytes drawn_bytes(std::size_t size) {
  // Runs and noise, so that copies as well as literals are written.
  Bytes bytes;
  while (bytes.size() < size) {
    const auto value = *rc::gen::arbitrary<std::uint8_t>();
    bytes.insert(bytes.end(), static_cast<std::size_t>(*rc::gen::inRange(1, 40)), value);
  }
  bytes.resize(size);
  return bytes;
}

std::string png_refusal(const Bytes& bytes) {
  try {
    (void)detail::decode_png(bytes);
    return "";
  } catch (const detail::PngError& error) {
    return error.what();
  }
}

TEST(Png, nothing_is_no_png) {
  EXPECT_FALSE(detail::is_png({}));
  EXPECT_NE(png_refusal({}), "");
}

TEST(Png, one_pixel_by_hand) {
  const Bytes pixel{1, 2, 3, 4};
  const Bytes png = detail::encode_png(pixel, {1, 1}, 4);
  EXPECT_EQ(detail::png_size(png).width, 1u);
  EXPECT_EQ(detail::decode_png(png), pixel);
  EXPECT_EQ(decode_image(png, "one", 1).rgba, pixel);
}

TEST(Png, a_stored_block_by_hand) {
  const Bytes stream{0x78, 0x01, 0x01, 0x03, 0x00, 0xfc, 0xff, 'a', 'b', 'c', 0x02, 0x4d, 0x01, 0x27};
  EXPECT_EQ(detail::inflate(stream, 3), (Bytes{'a', 'b', 'c'}));
  EXPECT_TRUE(detail::inflate(stream, 2).empty());
  EXPECT_TRUE(detail::inflate(stream, 4).empty());
}

RC_GTEST_PROP(Png, openimageio_reads_what_we_write, ()) {
  const int width = *rc::gen::inRange(1, 70), height = *rc::gen::inRange(1, 40),
            channels = *rc::gen::inRange(3, 5);
  const auto pixels = static_cast<std::size_t>(width * height);
  const Bytes raw = drawn_bytes(pixels * static_cast<std::size_t>(channels));
  const Bytes png = detail::encode_png(
      raw, {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)}, channels);
  const Image back = decode_image(png, "back", pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      const bool stored = c < static_cast<std::size_t>(channels);
      RC_ASSERT(back.rgba[4 * i + c] == (stored ? raw[static_cast<std::size_t>(channels) * i + c] : 255));
    }
  }
  RC_ASSERT(detail::decode_png(png) == back.rgba);
}

RC_GTEST_PROP(Png, we_read_what_openimageio_writes, ()) {
  const int width = *rc::gen::inRange(1, 70), height = *rc::gen::inRange(1, 40),
            channels = *rc::gen::inRange(1, 5);
  const auto values = static_cast<std::size_t>(width * height * channels);
  const Bytes png =
      written_by_openimageio(width, height, channels, OIIO::TypeDesc::UINT8, drawn_bytes(values));
  RC_ASSERT(detail::decode_png(png) == decode_image(png, "back", 1u << 20).rgba);
}

RC_GTEST_PROP(Png, sixteen_bits_are_rounded_to_eight, ()) {
  const int channels = *rc::gen::inRange(1, 5);
  const Bytes raw = drawn_bytes(static_cast<std::size_t>(2 * 9 * 5 * channels));
  const Bytes png = written_by_openimageio(9, 5, channels, OIIO::TypeDesc::UINT16, raw);
  const Bytes ours = detail::decode_png(png), theirs = decode_image(png, "back", 45).rgba;
  RC_ASSERT(ours.size() == theirs.size());
  for (std::size_t i = 0; i < ours.size(); ++i) RC_ASSERT(std::abs(ours[i] - theirs[i]) <= 1);
}

RC_GTEST_PROP(Png, a_file_with_a_wrong_bit_or_cut_off_is_refused, ()) {
  const Bytes raw = drawn_bytes(20 * 20 * 4);
  Bytes png = detail::encode_png(raw, {20, 20}, 4);
  const std::size_t at = *rc::gen::inRange<std::size_t>(0, png.size());
  png[at] = static_cast<std::uint8_t>(png[at] ^ (1 << *rc::gen::inRange(0, 8)));
  RC_ASSERT(!png_refusal(png).empty());
  png.resize(at);
  RC_ASSERT(!png_refusal(png).empty());
}

RC_GTEST_PROP(Png, bytes_that_are_no_stream_are_refused, ()) {
  // The header is right, so that the blocks are read.
  Bytes stream = drawn_bytes(*rc::gen::inRange<std::size_t>(6, 300));
  stream[0] = 0x78;
  stream[1] = 0x01;
  RC_ASSERT(detail::inflate(stream, 4096).empty());
}

}  // namespace
}  // namespace gnomon::test
