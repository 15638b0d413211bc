// Do the commands measure a scene far from the origin as at it, and in any unit?
#include <gtest/gtest.h>

#include <cmath>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "gltf_text.hpp"
#include "small_sweep.hpp"

namespace gnomon::test {
namespace {

/// Ground, and boards on it, one above the other, in a frame of 40 units that a node moves to `place` and
/// scales.
std::string scene_at(const glm::dvec3& place, double scale = 1.0) {
  TestGltf gltf;
  const auto board = [&](float low, float high, float y) {
    const int corners = gltf.positions({low, y, low, low, y, high, high, y, high, high, y, low});
    const int indices =
        gltf.accessor(gltf.view(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}), kUnsignedShort, "SCALAR", 6);
    const json primitive = {{"attributes", {{"POSITION", corners}}}, {"indices", indices}};
    gltf.show(primitive, {{"translation", {place.x, place.y, place.z}}, {"scale", {scale, scale, scale}}});
  };
  board(-20.0f, 20.0f, 0.0f);
  board(-4.0f, 3.0f, 6.0f);
  board(-11.0f, -7.0f, 2.0f);
  board(8.0f, 14.0f, 1.0f);
  return gltf.file();
}

// On the Earth from its middle; the second as far as positions are promised.
const glm::dvec3 kFar[] = {{6378137.0, 12345.0, -2345678.0}, {1e8, -5e7, 1e8}};
// Doubles at 1e8 are 1.5e-8 apart: a place moves by a millionth of a pixel, and an edge with it.
constexpr double kRounding = 2e-5;

class FarScene : public testing::Test {
 protected:
  /// Runs it with the scene at `place`, and these more arguments.
  Finished run(const char* command, const glm::dvec3& place, const std::vector<std::string>& more) {
    const std::string name = "at_" + std::to_string(static_cast<long long>(place.x));
    std::vector<std::string> arguments{
        command, folder_.write(name + ".glb", scene_at(place)), "--size", "96x54", "--context", "osmesa"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Finished finished = run_gnomon(arguments);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    return finished;
  }
  /// A folder for what it writes.
  [[nodiscard]] std::string out(const std::string& name) const { return (folder_.path() / name).string(); }

  TemporaryFolder folder_;
};

TEST_F(FarScene, is_flown_through_as_at_the_origin_with_maps_and_with_pages) {
  const std::vector<std::vector<std::string>> kinds{{}, {"--pages", "resolution"}, {"--light", "point"}};
  for (const std::vector<std::string>& kind : kinds) {
    const auto flight = [&](const glm::dvec3& place) {
      std::vector<std::string> more{"--frames", "2", "--map-size", "256", "--out", out("flight"), "--json"};
      more.insert(more.end(), kind.begin(), kind.end());
      return json::parse(run("fly", place, more).out);
    };
    const auto pictures = [&] {
      std::vector<std::string> files;
      for (const char* name : {"frame_0000_image.png", "frame_0001_image.png"})
        files.push_back(content_of(out("flight") + "/" + name));
      return files;
    };
    const json here = flight(glm::dvec3(0.0));
    const std::vector<std::string> wanted = pictures();
    EXPECT_GT(wanted[0].size(), 1000u);
    EXPECT_NE(wanted[0], wanted[1]);
    for (const glm::dvec3& place : kFar) {
      const json there = flight(place);
      EXPECT_EQ(pictures(), wanted) << place.x;
      ASSERT_EQ(there.at("frames").size(), 2u);
      for (std::size_t i = 0; i < 2; ++i) {
        const json &frame = there.at("frames")[i], &same = here.at("frames")[i];
        EXPECT_EQ(frame.at("texels"), same.at("texels"));
        const double p95 = same.at("m").at("p95").get<double>();
        EXPECT_GT(p95, 0.01);
        EXPECT_NEAR(frame.at("m").at("p95").get<double>(), p95, kRounding * p95);
      }
    }
  }
}

// Products of two lengths left single precision: surfaces were black from 1e10 on, and noisy below 1e-8.
TEST_F(FarScene, is_drawn_alike_in_every_unit) {
  const auto picture = [&](double unit) {
    const std::string file = folder_.write("scene.glb", scene_at(glm::dvec3(0.0), unit));
    const Finished finished = run_gnomon({"fly", file, "--frames", "1", "--map-size", "256", "--size",
                                          "96x54", "--context", "osmesa", "--out", out("flight")});
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    return content_of(out("flight") + "/frame_0000_image.png");
  };
  const std::string wanted = picture(1.0);
  // Powers of two, which round nothing.
  for (const int power : {-30, 30, 40}) EXPECT_EQ(picture(std::ldexp(1.0, power)), wanted) << power;
}

TEST_F(FarScene, is_compared_as_at_the_origin) {
  const auto rows = [&](const glm::dvec3& place, const std::string& name) {
    (void)run("compare", place,
              {"--warps", "none,lispsm", "--filters", "hard,pcf", "--cascades", "2", "--map-sizes", "256",
               "--pages", "resolution", "--frames", "1", "--rounds", "1", "--out", out(name)});
    return report::read_rows(out(name));
  };
  const std::vector<report::Row> here = rows(glm::dvec3(0.0), "here");
  ASSERT_EQ(here.size(), 6u);
  for (const glm::dvec3& place : kFar) {
    const std::vector<report::Row> there = rows(place, "there" + std::to_string(place.x));
    ASSERT_EQ(there.size(), here.size());
    for (std::size_t i = 0; i < here.size(); ++i) {
      SCOPED_TRACE(here[i].technique.name());
      EXPECT_GT(here[i].errors.pixels, 300);
      EXPECT_EQ(there[i].errors.pixels, here[i].errors.pixels);
      EXPECT_NEAR(there[i].errors.false_lit, here[i].errors.false_lit, kRounding);
      EXPECT_NEAR(there[i].errors.false_shadow, here[i].errors.false_shadow, kRounding);
      EXPECT_NEAR(there[i].errors.darkening, here[i].errors.darkening, kRounding);
      EXPECT_NEAR(there[i].aliasing.p95, here[i].aliasing.p95, kRounding * here[i].aliasing.p95);
      EXPECT_EQ(there[i].costs.texels, here[i].costs.texels);
    }
  }
}

TEST_F(FarScene, has_the_biases_of_the_origin) {
  for (const char* light : {"sun", "spot"}) {
    const auto rows = [&](const glm::dvec3& place) {
      const Finished finished =
          run("bias", place, {"--layers", "front,dual", "--light", light, "--map-size", "256", "--json"});
      std::vector<json> found;
      std::istringstream lines(finished.out);
      for (std::string line; std::getline(lines, line);) found.push_back(json::parse(line));
      return found;
    };
    const std::vector<json> here = rows(glm::dvec3(0.0));
    EXPECT_GE(here.size(), 4u);
    for (const glm::dvec3& place : kFar) {
      const std::vector<json> there = rows(place);
      ASSERT_EQ(there.size(), here.size());
      for (std::size_t i = 0; i < here.size(); ++i) {
        EXPECT_EQ(there[i].at("layer"), here[i].at("layer"));
        EXPECT_EQ(there[i].at("bias"), here[i].at("bias"));
        for (const char* key : {"false_shadow", "false_light", "contact_gap_texels"})
          EXPECT_NEAR(there[i].at(key).get<double>(), here[i].at(key).get<double>(), kRounding) << key;
      }
    }
  }
}

}  // namespace
}  // namespace gnomon::test
