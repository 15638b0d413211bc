// Pictures: what decodes, what is refused before it is decoded, what files hold after writing.
#include "gnomon/scene/image.hpp"

#include <OpenImageIO/imageio.h>

#include "gltf_text.hpp"
#include "image_formats.hpp"

namespace gnomon::test {
namespace {

Image gradient(int width, int height) {
  Image out;
  out.name = "gradient";
  out.width = width;
  out.height = height;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (const int value : {x * 7, y * 5, x + y, 255 - x})
        out.rgba.push_back(static_cast<std::uint8_t>(value));
    }
  }
  return out;
}

std::string refusal(const std::vector<std::uint8_t>& bytes, std::uint64_t max_pixels = 1u << 20) {
  try {
    (void)decode_image(bytes, "picture", max_pixels);
    return "";
  } catch (const SceneError& e) {
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    EXPECT_TRUE(std::string(e.what()).starts_with("picture: ")) << e.what();
    return e.what();
  }
}

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

TEST(Image, nothing_and_other_formats_are_refused) {
  for (const std::string& text :
       {std::string(), std::string("\x89PNG"), std::string("GIF89a and so on, for long enough"),
        std::string("II*\0 a TIFF file, which OpenImageIO would read", 40)}) {
    EXPECT_NE(refusal({text.begin(), text.end()}).find("neither PNG, JPEG nor"), std::string::npos);
  }
}

TEST(Image, encoded_and_decoded_again_is_the_same_picture_with_colour_under_zero_alpha) {
  Image image = gradient(13, 7);
  for (std::size_t i = 3; i < image.rgba.size(); i += 8) image.rgba[i] = 0;
  const Image back = decode_image(encode_png(image), "back", 91);
  EXPECT_EQ(back.width, 13);
  EXPECT_EQ(back.height, 7);
  EXPECT_EQ(back.rgba, image.rgba);
}

TEST(Image, a_grey_picture_with_alpha_is_grey_with_alpha) {
  const WrittenFolder folder;
  const std::string file = (folder.path() / "a.png").string();
  OIIO::ImageSpec spec(2, 1, 2, OIIO::TypeDesc::UINT8);
  spec.channelnames = {"Y", "A"};
  spec.alpha_channel = 1;
  spec.attribute("oiio:UnassociatedAlpha", 1);
  auto out = OIIO::ImageOutput::create("png");
  const std::vector<std::uint8_t> pixels{100, 200, 7, 30};
  ASSERT_TRUE(out && out->open(file, spec) && out->write_image(OIIO::TypeDesc::UINT8, pixels.data()) &&
              out->close());
  const Image image = decode_image(read_bytes(file), "a", 2);
  EXPECT_EQ(image.rgba, (std::vector<std::uint8_t>{100, 100, 100, 200, 7, 7, 7, 30}));
}

TEST(Image, a_written_png_holds_the_colours_and_no_alpha) {
  const WrittenFolder folder;
  const Image image = gradient(9, 5);
  write_png(image, folder.path() / "a.png");
  const Image back = decode_image(read_bytes(folder.path() / "a.png"), "a", 45);
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    EXPECT_EQ(back.rgba[i], i % 4 == 3 ? 255 : image.rgba[i]) << i;
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1)
      << "a temporary file was left";
}

TEST(Image, writing_where_one_cannot_is_refused_and_leaves_nothing) {
  const WrittenFolder folder;
  EXPECT_THROW(write_png(gradient(2, 2), folder.path() / "none/a.png"), SceneError);
  EXPECT_THROW(write_png(Image(), folder.path() / "a.png"), SceneError);
  Image short_of_pixels = gradient(4, 4);
  short_of_pixels.rgba.pop_back();
  EXPECT_THROW(write_png(short_of_pixels, folder.path() / "a.png"), SceneError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Image, the_size_in_the_header_is_held_to_the_limit_before_decoding) {
  std::vector<std::uint8_t> png = encode_png(gradient(8, 8));
  EXPECT_EQ(refusal(png, 64), "");
  EXPECT_NE(refusal(png, 63).find("limit"), std::string::npos);
  png[16] = 0x7f;  // width of two thousand million
  EXPECT_NE(refusal(png, ~0ull).find("limit"), std::string::npos);
  png[16] = png[19] = 0;
  EXPECT_NE(refusal(png).find("0 x 8"), std::string::npos);
}

TEST(Image, a_damaged_png_is_refused_wherever_it_is_cut) {
  const std::vector<std::uint8_t> png = encode_png(gradient(40, 40));
  for (std::size_t size = 0; size < png.size() - 12;
       size += 7) {  // the last 12 bytes are IEND, which readers forgive
    EXPECT_NE(refusal({png.begin(), png.begin() + static_cast<std::ptrdiff_t>(size)}), "") << size;
  }
}

TEST(Image, a_jpeg_is_recognised_by_its_frame_header_and_decoded) {
  const WrittenFolder folder;
  const std::string file = (folder.path() / "a.jpg").string();
  auto out = OIIO::ImageOutput::create("jpeg");
  ASSERT_TRUE(out && out->open(file, OIIO::ImageSpec(16, 8, 3, OIIO::TypeDesc::UINT8)));
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::UINT8, std::vector<std::uint8_t>(16 * 8 * 3, 100).data()));
  out->close();
  const std::vector<std::uint8_t> bytes = read_bytes(file);
  const Image image = decode_image(bytes, "a", 128);
  EXPECT_EQ(image.width, 16);
  EXPECT_EQ(image.height, 8);
  EXPECT_NEAR(image.rgba[0], 100, 2);  // JPEG is lossy
  EXPECT_EQ(image.rgba[3], 255);
  EXPECT_NE(refusal(bytes, 127).find("16 x 8"), std::string::npos);
  for (std::size_t size = 0; size < 160; ++size) {
    EXPECT_NE(refusal({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)}), "") << size;
  }
}

std::vector<std::uint8_t> webp(const char* compression, int channels, const WrittenFolder& folder) {
  const std::string file = (folder.path() / "a.webp").string();
  OIIO::ImageSpec spec(16, 8, channels, OIIO::TypeDesc::UINT8);
  spec.attribute("compression", compression);
  auto out = OIIO::ImageOutput::create("webp");
  const std::vector<std::uint8_t> grey(16u * 8u * 4u, 100);
  EXPECT_TRUE(out && out->open(file, spec) && out->write_image(OIIO::TypeDesc::UINT8, grey.data()) &&
              out->close());
  return read_bytes(file);
}

TEST(Image, a_webp_of_each_kind_is_recognised_by_its_header_and_decoded) {
  if (!detail::reads_webp()) GTEST_SKIP() << "this OpenImageIO has no reader of WebP";
  const WrittenFolder folder;
  for (const auto& [compression, channels] :
       std::vector<std::pair<const char*, int>>{{"webp:80", 3}, {"lossless:100", 3}, {"webp:80", 4}}) {
    const std::vector<std::uint8_t> bytes = webp(compression, channels, folder);
    const Image image = decode_image(bytes, "a", 128);
    EXPECT_EQ(image.width, 16);
    EXPECT_EQ(image.height, 8);
    EXPECT_NEAR(image.rgba[3], channels == 4 ? 100 : 255, 2);
    EXPECT_NE(refusal(bytes, 127).find("16 x 8"), std::string::npos) << compression;
    for (std::size_t size = 0; size < bytes.size(); ++size)
      EXPECT_NE(refusal({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)}), "") << size;
  }
}

TEST(Image, a_webp_that_is_animated_or_damaged_is_refused_or_decoded_to_its_size) {
  if (!detail::reads_webp()) GTEST_SKIP() << "this OpenImageIO has no reader of WebP";
  const WrittenFolder folder;
  std::vector<std::uint8_t> bytes = webp("webp:80", 4, folder);
  ASSERT_EQ(std::string(bytes.begin() + 12, bytes.begin() + 16), "VP8X");
  const std::uint8_t flags = bytes[20];
  bytes[20] |= 2;
  EXPECT_NE(refusal(bytes).find("nor a single WebP"), std::string::npos);
  bytes[20] = flags;
  bytes[24] = 200;  // 201 pixels wide: not what the frame says
  EXPECT_NE(refusal(bytes), "");
  bytes[24] = 15;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::vector<std::uint8_t> damaged = bytes;
    damaged[at] ^= 0xff;
    (void)refusal(damaged);
  }
}

TEST(Image, an_exr_holds_its_values_and_channel_names_exactly) {
  const WrittenFolder folder;
  const std::string file = (folder.path() / "a.exr").string();
  write_exr({2, 2, 2, {0.1f, -1e30f, 1e-30f, 4, 5, 6, 7, 8}, {"m", "depth"}}, file);
  auto in = OIIO::ImageInput::open(file);
  ASSERT_TRUE(in);
  EXPECT_EQ(in->spec().format, OIIO::TypeDesc::FLOAT);
  std::vector<float> values(8);
  ASSERT_TRUE(in->read_image(0, 0, 0, 2, OIIO::TypeDesc::FLOAT, values.data()));
  // EXR files list channels by name; find ours.
  const int m = in->spec().channelindex("m");
  ASSERT_GE(m, 0);
  EXPECT_EQ(values[static_cast<std::size_t>(m)], 0.1f);
  EXPECT_EQ(values[static_cast<std::size_t>(1 - m)], -1e30f);
  EXPECT_THROW(write_exr({2, 2, 1, {1, 2, 3}, {"Y"}}, file), SceneError);
  EXPECT_THROW(write_exr({1, 1, 1, {1}, {}}, file), SceneError);
}

}  // namespace
}  // namespace gnomon::test
