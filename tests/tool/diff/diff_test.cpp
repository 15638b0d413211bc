// `gnomon diff`: its verdict on two pictures is its exit code.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gnomon/scene/image.hpp"
#include "process.hpp"

namespace gnomon::test {
namespace {

Image grey(int width, int height) {
  Image image;
  image.width = width;
  image.height = height;
  image.rgba.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4, 128);
  for (std::size_t alpha = 3; alpha < image.rgba.size(); alpha += 4) image.rgba[alpha] = 255;
  return image;
}

std::string saved(const TemporaryFolder& folder, const std::string& name, const Image& image) {
  const std::filesystem::path file = folder.path() / name;
  const std::vector<std::uint8_t> bytes = encode_png(image);
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
  return file.string();
}

TEST(Diff, grades_by_how_many_pixels_differ) {
  const TemporaryFolder folder;
  Image other = grey(10, 10);
  other.rgba[4 * 23] = 138;  // one of a hundred pixels, by 10 steps, at 3,2
  const std::string a = saved(folder, "a.png", grey(10, 10)), b = saved(folder, "b.png", other);
  EXPECT_EQ(run_gnomon({"diff", a, a}).exit_code, 0);
  EXPECT_EQ(run_gnomon({"diff", a, b}).exit_code, 3);
  EXPECT_EQ(run_gnomon({"diff", a, b, "--tolerance", "9"}).exit_code, 3);
  EXPECT_EQ(run_gnomon({"diff", a, b, "--tolerance", "10"}).exit_code, 0);
  EXPECT_EQ(run_gnomon({"diff", a, b, "--allow-percent", "0.9"}).exit_code, 3);
  EXPECT_EQ(run_gnomon({"diff", a, b, "--allow-percent", "1"}).exit_code, 1);
  const nlohmann::json found = nlohmann::json::parse(run_gnomon({"diff", a, b, "--json"}).out);
  EXPECT_EQ(found["differing"], 1);
  EXPECT_EQ(found["largest"], 10);
  EXPECT_EQ(found["largest_at"], nlohmann::json({3, 2}));
  // One of 300 colours is off by 10: the root of 100 / 300.
  EXPECT_NEAR(found["rms"].get<double>(), 0.57735, 1e-4);
}

TEST(Diff, pictures_that_differ_in_what_they_cover_are_different) {
  const TemporaryFolder folder;
  Image other = grey(10, 10);
  other.rgba[4 * 23 + 3] = 155;
  const std::string a = saved(folder, "a.png", grey(10, 10)), b = saved(folder, "b.png", other);
  const Finished finished = run_gnomon({"diff", a, b, "--json"});
  EXPECT_EQ(finished.exit_code, 3);
  const nlohmann::json found = nlohmann::json::parse(finished.out);
  EXPECT_EQ(found["largest"], 100);
  EXPECT_EQ(found["largest_at"], nlohmann::json({3, 2}));
  EXPECT_NEAR(found["rms"].get<double>(), 5.0, 1e-9);  // the root of 100^2 over 400 channels
}

TEST(Diff, says_that_sizes_differ) {
  const TemporaryFolder folder;
  const Finished finished =
      run_gnomon({"diff", saved(folder, "a.png", grey(10, 10)), saved(folder, "b.png", grey(10, 11))});
  EXPECT_EQ(finished.exit_code, 4);
  EXPECT_EQ(finished.out, "other size: 10x10 and 10x11\n");
}

TEST(Diff, draws_where_pictures_differ) {
  const TemporaryFolder folder;
  Image other = grey(8, 8);
  other.rgba[0] = 255;
  const std::string out = (folder.path() / "diff.png").string();
  const Finished finished =
      run_gnomon({"diff", saved(folder, "a.png", grey(8, 8)), saved(folder, "b.png", other), "--out", out});
  EXPECT_EQ(finished.exit_code, 3) << finished.err;
  EXPECT_EQ(run_gnomon({"diff", out, out}).exit_code, 0);
  // Nothing but the first pixel is off in the picture of the differences either.
  const nlohmann::json against_same =
      nlohmann::json::parse(run_gnomon({"diff", out, (folder.path() / "a.png").string(), "--json"}).out);
  EXPECT_EQ(against_same["largest_at"], nlohmann::json({0, 0}));
}

TEST(Diff, overwrites_no_picture_that_it_compares) {
  const TemporaryFolder folder;
  const std::string a = saved(folder, "a.png", grey(8, 8)), b = saved(folder, "b.png", grey(8, 8));
  for (const std::string& out : {a, b, folder.path().string()}) {
    const Finished finished = run_gnomon({"diff", a, b, "--out", out});
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_EQ(finished.out, "");
    EXPECT_NE(finished.err.find("--out " + out), std::string::npos) << finished.err;
  }
}

TEST(Diff, refuses_what_is_no_picture) {
  const TemporaryFolder folder;
  const std::string a = saved(folder, "a.png", grey(4, 4)), text = folder.write("b.png", "no picture");
  for (const std::string& other : {text, folder.path().string(), (folder.path() / "none.png").string()}) {
    const Finished finished = run_gnomon({"diff", a, other});
    EXPECT_EQ(finished.exit_code, 2) << other;
    EXPECT_NE(finished.err.find(other), std::string::npos) << finished.err;
  }
}

}  // namespace
}  // namespace gnomon::test
