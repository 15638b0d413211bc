// `gnomon plan`: bad input ends with 2 and one line that names the file and what is wrong in it.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "cases.hpp"
#include "process.hpp"

namespace gnomon::test {
namespace {

void expect_refusal(const Finished& finished, const std::string& where, const std::string& what) {
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_EQ(finished.out, "");
  EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
  EXPECT_EQ(finished.err.find("gnomon: " + where + ": "), 0u) << finished.err;
  EXPECT_NE(finished.err.find(what), std::string::npos) << "wanted: " << what << "\nfound: " << finished.err;
  EXPECT_TRUE(std::all_of(finished.err.begin(), finished.err.end(), [](char c) {
    return c == '\n' || (c >= ' ' && c <= '~');
  })) << finished.err;
}

void expect_refused_text(const std::string& text, const std::string& what) {
  const TemporaryFolder folder;
  const std::string file = folder.write("bad.json", text);
  expect_refusal(run_gnomon({"plan", file}), file, what);
}

struct Change {
  const char *name, *pointer, *value, *complaint;  // value: JSON, or null to remove
};
void PrintTo(const Change& change, std::ostream* stream) {
  *stream << change.name;
}

class ChangedCase : public testing::TestWithParam<Change> {};

TEST_P(ChangedCase, is_refused_by_name) {
  const Change& change = GetParam();
  const json input = base_case_with(change.pointer, json::parse(change.value));
  expect_refused_text(input.dump(), change.complaint);
}

constexpr Change kChanges[] = {
    {"unknown_top_key", "/shadows", "1", "shadows: unknown key"},
    {"unknown_option", "/options", R"({"lamda": 0.5})", "options.lamda: unknown key"},
    {"unknown_camera_key", "/camera/fov", "60", "camera.fov: unknown key"},
    {"unknown_light_key", "/light/range", "5", "light.range: unknown key"},
    {"unknown_box_key", "/casters/0/mid", "[0,0,0]", "casters[0].mid: unknown key"},
    {"unknown_clip_space_key", "/options", R"({"clip_space": {"z": 1}})",
     "options.clip_space.z: unknown key"},
    {"unprintable_key", "/a\nb\u001b[31m", "1", "a?b?[31m: unknown key"},
    {"no_camera", "/camera", "null", "camera: is missing"},
    {"no_light", "/light", "null", "light: is missing"},
    {"no_receivers", "/receivers", "null", "receivers: is missing"},
    {"no_casters", "/casters", "null", "casters: is missing"},
    {"no_position", "/camera/position", "null", "camera.position: is missing"},
    {"no_aspect", "/camera/aspect", "null", "camera.aspect: is missing"},
    {"no_angle", "/camera/fov_y_deg", "null", "camera: needs one of fov_y_deg"},
    {"angle_and_height", "/camera/height_world", "5", "camera: needs one of fov_y_deg"},
    {"some_edges", "/camera/left", "-1", "camera: needs one of fov_y_deg"},
    {"no_light_type", "/light/type", "null", "light.type: is missing"},
    {"light_type", "/light/type", R"("laser")", "light.type: is \"laser\""},
    {"camera_type", "/camera", "[1]", "camera: needs an object, is array"},
    {"number_type", "/camera/near", R"("1")", "camera.near: needs a number, is string"},
    {"boolean_type", "/options", R"({"stable": 1})", "options.stable: needs true or false, is number"},
    {"string_type", "/options", R"({"warp": 3})", "options.warp: needs a string, is number"},
    {"vector_length", "/camera/up", "[0, 1]", "camera.up: needs three numbers"},
    {"vector_item", "/camera/up", R"([0, "1", 0])", "camera.up[1]: needs a number"},
    {"box_type", "/casters/0", "7", "casters[0]: needs an object"},
    {"box_corner", "/casters/0/max", "null", "casters[0].max: is missing"},
    {"fraction", "/camera/width", "10.5", "camera.width: needs a whole number"},
    {"large_integer", "/camera/width", "1e12", "camera.width: is out of range"},
    {"angle_of_180", "/camera/fov_y_deg", "180", "camera.fov_y_deg: must be between 0 and 180"},
    {"negative_aspect", "/camera/aspect", "-1", "camera.aspect: must be above 0"},
    {"warp_name", "/options", R"({"warp": "lispms"})", "options.warp: is \"lispms\", not one of auto, none"},
    {"split_name", "/options", R"({"split": "log"})", "options.split: is \"log\""},
    {"objective_name", "/options", R"({"objective": "min"})", "options.objective: is \"min\""},
    {"near_twice", "/options", R"({"near_hint": 1, "pseudo_near": 1})",
     "options.pseudo_near: is another name"},
    {"far_below_near", "/camera/far", "0.1", "camera.far: must lie above near"},
    {"near_of_zero", "/camera/near", "0", "camera.near: must be above 0"},
    {"zero_forward", "/camera/forward", "[0, 0, 0]", "camera.forward: must not be zero"},
    {"zero_light", "/light/direction", "[0, 0, 0]", "light.direction: must not be zero"},
    {"no_pixels", "/camera/width", "0", "camera.width"},
    {"no_cascade", "/options", R"({"cascades": 0})", "options.cascades: must lie in 1.."},
    {"large_map", "/options", R"({"map_size": 100000})", "options.map_size: must lie in"},
    {"lambda_of_2", "/options", R"({"lambda": 2})", "options.lambda: must lie in 0..1"},
    {"far_corner", "/casters/0/max", "[1e300, 1, 1]", "casters: a corner is beyond"},
};
INSTANTIATE_TEST_SUITE_P(BadInput, ChangedCase, testing::ValuesIn(kChanges),
                         [](const auto& change) { return change.param.name; });

TEST(BadInput, that_is_no_json_is_refused_with_its_place) {
  expect_refused_text("", "unexpected end of input");
  expect_refused_text("hello", "column 1: ");
  expect_refused_text("{\n  \"camera\": oops\n}", "line 2, column 1");
  expect_refused_text(base_case().dump() + "x", "column ");
  expect_refused_text("[1, 2]", "case: needs an object, is array");
  expect_refused_text(R"({"camera": NaN})", "column ");
  expect_refused_text(R"({"camera": {"near": 1e999}})", "number overflow");
  expect_refused_text(R"({"camera": 1, "camera": 2})", "key \"camera\" stands twice");
}

TEST(BadInput, that_is_cut_off_or_deep_or_binary_or_huge_is_refused) {
  const std::string whole = base_case().dump();
  expect_refused_text(whole.substr(0, whole.size() / 2), "column ");
  expect_refused_text(std::string(100'000, '['), "nested deeper than 32 levels");
  expect_refused_text(std::string(1'000'000, '\0'), "column 1: ");
  expect_refused_text("{\"" + std::string(1'000'000, 'k') + "\": 1}", "unknown key");
  std::string noise(4096, '\0');
  std::mt19937 random(1);
  for (char& c : noise) c = static_cast<char>(random() & 0xff);
  expect_refused_text(noise, "column ");
  expect_refused_text("\"\xff\xfe\"", "column ");
  expect_refused_text(whole + std::string((std::size_t{16} << 20) + 1, ' '), "larger than 16 MiB");
}

TEST(BadInput, that_cannot_be_opened_is_refused) {
  expect_refusal(run_gnomon({"plan", "/nowhere/a.json"}), "/nowhere/a.json", "No such file");
  expect_refusal(run_gnomon({"plan", "/"}), "/", "is a folder");
}

TEST(BadInput, from_standard_input_is_named_by_its_line) {
  const std::string good = base_case().dump();
  const Finished finished = run_gnomon({"plan", "-"}, good + "\n\n" + R"({"camera": 1})" + "\n" + good);
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_EQ(finished.err, "gnomon: -:3: camera: needs an object, is number\n");
  EXPECT_EQ(finished.lines().size(), 1u)
      << "the plan before the bad line is printed, the one after it is not";
}

TEST(BadInput, without_end_of_line_does_not_fill_the_memory) {
  expect_refusal(run_gnomon({"plan", "-"}, std::string((std::size_t{16} << 20) + 5, ' ') + "{"), "-:1",
                 "larger than 16 MiB");
}

TEST(BadInput, after_good_files_leaves_their_plans_printed) {
  const TemporaryFolder folder;
  const std::string good = folder.write("good.json", base_case().dump());
  const std::string bad = folder.write("bad.json", "{}");
  const Finished finished = run_gnomon({"plan", good, good, bad, good});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_EQ(finished.lines().size(), 2u);
  EXPECT_EQ(finished.err, "gnomon: " + bad + ": camera: is missing\n");
}

TEST(BadInput, of_corners_in_the_wrong_order_is_planned_with_a_warning) {
  json swapped = base_case();
  std::swap(swapped["casters"][0]["min"], swapped["casters"][0]["max"]);
  const Finished finished = run_gnomon({"plan", "-"}, swapped.dump());
  EXPECT_EQ(finished.exit_code, 0);
  EXPECT_EQ(finished.err, "gnomon: warning: -:1: casters[0]: min is above max, so the box is empty\n");
}

}  // namespace
}  // namespace gnomon::test
