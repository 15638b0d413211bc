// Parts of a flight, without flying: where its frames stand, and what its sheets show.
#include <gtest/gtest.h>

#include <algorithm>

#include "flight.hpp"
#include "gnomon/render/picture.hpp"
#include "report.hpp"

namespace gnomon::tool::fly {
namespace {

std::size_t ink_of(const Image& image, int rows) {
  std::size_t ink = 0;
  const auto end = static_cast<std::size_t>(4 * image.width * std::min(rows, image.height));
  for (std::size_t i = 0; i < end; i += 4) ink += image.rgba[i] > 200 ? 1 : 0;  // light text on dark paper
  return ink;
}

/// Light pixels of a text on one line that is wide enough for it.
std::size_t ink_of_text(const std::string& text, int scale) {
  Image line =
      render::blank_image(render::text_width(text, scale) + 8, render::text_height(scale) + 8, {24, 24, 28});
  render::draw_text(line, 4, 4, text, {240, 240, 236}, scale);
  return ink_of(line, line.height);
}

TEST(ContactSheet, shows_all_of_its_title_however_narrow_it_is) {
  constexpr int kHeight = 40;  // of a picture
  const std::string title =
      "builtin:hangar: 4 maps of 2048, pcf:radius=2,unit=texels,format=fp32, warped_stable";
  for (const int width : {64, 320, 2000}) {
    ContactSheet sheet(1, width, kHeight * width / 64);
    const Image black = render::blank_image(width, kHeight * width / 64, {0, 0, 0});
    sheet.add(0, black, black, black);
    const Image titled = sheet.sheet(title), plain = sheet.sheet("");
    // Pictures are black: what the title adds is all that its letters have.
    const std::size_t added = ink_of(titled, titled.height) - ink_of(plain, plain.height);
    const bool large = render::text_width(title, 2) < titled.width - 16;
    EXPECT_EQ(added, ink_of_text(title, large ? 2 : 1)) << width;
  }
}

TEST(ContactSheet, shows_the_first_and_the_last_frame_and_as_many_as_fit) {
  for (const int frames : {1, 2, 7, 8, 9, 100}) {
    const ContactSheet sheet(frames, 64, 36);
    int columns = 0;
    for (int frame = 0; frame < frames; ++frame) columns += sheet.wants(frame) ? 1 : 0;
    EXPECT_EQ(columns, std::min(frames, 8)) << frames;
    EXPECT_TRUE(sheet.wants(0) && sheet.wants(frames - 1)) << frames;
  }
}

Flight flight_of(bool closed) {
  Flight flight;
  flight.path.keys = {
      {{1, 0, 0}, {0, 0, 0}}, {{0, 0, 1}, {0, 0, 0}}, {{-1, 0, 0}, {0, 0, 0}}, {{0, 0, -1}, {0, 0, 0}}};
  flight.path.closed = closed;
  return flight;
}

TEST(Flight, over_a_closed_path_draws_no_frame_twice) {
  Options options;
  options.frames = 4;
  const Flight round = flight_of(true);
  for (int a = 0; a < options.frames; ++a) {
    for (int b = 0; b < a; ++b) {
      const glm::dvec3 apart = camera_of(options, round, a).position - camera_of(options, round, b).position;
      EXPECT_GT(std::max({std::abs(apart.x), std::abs(apart.y), std::abs(apart.z)}), 0.5)
          << a << " and " << b;
    }
  }
  // An open path is flown from end to end.
  const Flight straight = flight_of(false);
  EXPECT_NEAR(camera_of(options, straight, 0).position.x, 1.0, 1e-12);
  EXPECT_NEAR(camera_of(options, straight, 3).position.z, -1.0, 1e-12);
}

}  // namespace
}  // namespace gnomon::tool::fly
