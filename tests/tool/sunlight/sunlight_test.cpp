// The sun of a date and a place lights scenes as its angles do, and hours of sunlight are those that geometry
// gives.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gltf_text.hpp"
#include "gnomon/scene/sun.hpp"
#include "process.hpp"

namespace gnomon::test {
namespace {

/// A ground of 2 km; half a metre over it, west of x = -10, a roof; along x = 20 a wall of 1 km from north to
/// south.
std::string yard() {
  TestGltf gltf;
  const auto face = [&](const std::vector<float>& corners) {
    const int positions = gltf.positions(corners);
    const int indices =
        gltf.accessor(gltf.view(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}), kUnsignedShort, "SCALAR", 6);
    gltf.show({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
  };
  face({-1000, 0, -1000, -1000, 0, 1000, 1000, 0, 1000, 1000, 0, -1000});
  face({-1000, 0.5f, -1000, -1000, 0.5f, 1000, -10, 0.5f, 1000, -10, 0.5f, -1000});
  face({20, 0, -1000, 20, 0, 1000, 20, 1000, 1000, 20, 1000, -1000});
  return gltf.file();
}

class Sunlight : public testing::Test {
 protected:
  /// What the command says of the ground around x, on the equator at equinox, when the sun goes from east to
  /// west.
  json on_ground_at(double x, double height, const std::vector<std::string>& more = {}) {
    const std::string at = std::to_string(x);
    std::vector<std::string> arguments{"sunlight",
                                       folder_.write("yard.glb", yard()),
                                       "--sun",
                                       "2026-03-20@0,0",
                                       "--eye=" + at + "," + std::to_string(height) + ",0.01",
                                       "--target=" + at + ",0,0",
                                       "--near",
                                       "0.01",
                                       "--far",
                                       "100",
                                       "--size",
                                       "32x32",
                                       "--context",
                                       "osmesa",
                                       "--json",
                                       "--out",
                                       picture()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Finished finished = run_gnomon(arguments);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    return finished.exit_code == 0 ? json::parse(finished.out) : json();
  }
  [[nodiscard]] std::string picture() const { return (folder_.path() / "hours.png").string(); }

  TemporaryFolder folder_;
};

constexpr double kStep_h = 0.25;

TEST_F(Sunlight, under_a_roof_there_is_none) {
  const json dark = on_ground_at(-500.0, 0.4);
  EXPECT_EQ(dark.at("mean_hours"), 0.0);
  EXPECT_EQ(dark.at("share_of_area_by_hour"), json::array({1.0}));
}

TEST_F(Sunlight, beside_a_wall_lasts_half_the_day) {
  const json half = on_ground_at(21.0, 1.0);
  const double day = half.at("sun_hours").get<double>();
  EXPECT_NEAR(day, 12.1, kStep_h) << "equinox, with refraction";
  // From noon on the wall is in the west of it; within a hundredth of its height it stops all of the evening.
  EXPECT_NEAR(half.at("mean_hours").get<double>(), 0.5 * day, kStep_h);
  EXPECT_GT(half.at("positions").get<int>(), 40);
  EXPECT_LT(half.at("unknown_share").get<double>(), 0.01);
}

TEST_F(Sunlight, writes_its_picture_and_shares_that_add_up) {
  const std::string csv = (folder_.path() / "hours.csv").string();
  const json both = on_ground_at(20.0, 10.0, {"--csv", csv, "--step", "0.5h"});
  EXPECT_EQ(both.at("positions"), 24);
  double sum = 0.0;
  for (const json& share : both.at("share_of_area_by_hour")) sum += share.get<double>();
  EXPECT_NEAR(sum, 1.0, 1e-3);
  EXPECT_EQ(content_of(csv).find("from_hours,to_hours,share_of_area\n0,1,"), 0u) << content_of(csv);
  EXPECT_EQ(content_of(picture()).substr(1, 3), "PNG");
}

TEST_F(Sunlight, refuses_days_without_sun_and_words_that_are_none) {
  const auto error_of = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"sunlight", "builtin:fence", "--out", picture()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Finished finished = run_gnomon(arguments);
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
    return finished.err;
  };
  EXPECT_NE(error_of({"--sun", "2026-12-21@78.2,15.6"}).find("does not rise that day"), std::string::npos);
  EXPECT_NE(error_of({"--sun", "2026-12-32@0,0"}).find("--sun 2026-12-32@0,0: there is no such day"),
            std::string::npos);
  EXPECT_NE(error_of({"--sun", "2026-03-20@0,0", "--step", "1s"}).find("--step 1s: wants 1min to 2h"),
            std::string::npos);
  EXPECT_NE(error_of({}).find("--sun"), std::string::npos);
}

TEST(SunOption, lights_a_scene_as_its_elevation_and_azimuth_do) {
  const TemporaryFolder folder;
  const std::string moment = "2026-06-21T15:00+02:00@52.5,13.4";
  const SunMoment read = read_sun_moment(moment);
  const SunPosition sun = sun_position(read.unix_s, read.place);
  EXPECT_NEAR(sun.elevation_deg, 54.0, 0.1);
  EXPECT_NEAR(sun.azimuth_deg, 227.0, 0.1) << "past noon the sun is in the south west";
  const auto picture = [&](const std::vector<std::string>& light) {
    std::vector<std::string> arguments{"fly",       "builtin:fence", "--frames",   "1",
                                       "--size",    "64x32",         "--map-size", "64",
                                       "--context", "osmesa",        "--out",      folder.path().string()};
    arguments.insert(arguments.end(), light.begin(), light.end());
    const Finished finished = run_gnomon(arguments);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    return content_of(folder.path() / "frame_0000_image.png");
  };
  const auto exact = [](double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.17g", value);
    return std::string(text.data());
  };
  const std::string by_date = picture({"--sun", moment});
  EXPECT_GT(by_date.size(), 100u);
  EXPECT_EQ(by_date, picture({"--light-elevation-deg", exact(sun.elevation_deg), "--light-azimuth-deg",
                              exact(sun.azimuth_deg)}));
  EXPECT_NE(by_date, picture({}));
}

TEST_F(Sunlight, overwrites_neither_the_scene_nor_the_picture) {
  const std::string scene = folder_.write("yard.glb", yard());
  for (const auto& [out, csv] : {std::pair(scene, picture()), {picture(), scene}, {picture(), picture()}}) {
    const Finished finished =
        run_gnomon({"sunlight", scene, "--sun", "2026-03-20@0,0", "--out", out, "--csv", csv});
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_NE(finished.err.find(": would overwrite "), std::string::npos) << finished.err;
  }
  EXPECT_EQ(content_of(scene), yard());
}

TEST(SunOption, refuses_nights_and_what_it_contradicts) {
  const auto error_of = [](const std::vector<std::string>& light) {
    std::vector<std::string> arguments{"view", "builtin:fence", "--out", "/none/a.png"};
    arguments.insert(arguments.end(), light.begin(), light.end());
    const Finished finished = run_gnomon(arguments);
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
    return finished.err;
  };
  const std::string night = error_of({"--sun", "2026-06-21T03:00+02:00@52.5,13.4"});
  EXPECT_NE(night.find("the sun is below the horizon"), std::string::npos) << night;
  EXPECT_NE(night.find("that day it shines from 04:4"), std::string::npos) << night;
  EXPECT_NE(error_of({"--sun", "2026-06-21T15:00+02:00@95,13.4"}).find("the latitude 95"), std::string::npos);
  EXPECT_NE(error_of({"--sun", "2026-12-21T12:00Z@78.2,15.6"}).find("shines not at all"), std::string::npos);
  for (const char* other : {"--light", "--light-elevation-deg", "--scene-light"})
    EXPECT_NE(
        error_of({"--sun", "2026-06-21T15:00Z@0,0", other, other[7] == '\0' ? "sun" : "30"}).find(other),
        std::string::npos);
}

}  // namespace
}  // namespace gnomon::test
