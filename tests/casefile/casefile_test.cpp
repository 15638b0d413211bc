// Reading cases: what the keys become, and that no text from outside does harm.
#include "gnomon/casefile/casefile.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <cmath>

#include <fstream>
#include <numbers>
#include <sstream>
#include <type_traits>
#include <variant>

#include "base/json_words.hpp"
#include "gnomon/casefile/plan_fields.hpp"

namespace gnomon {
namespace {

constexpr const char* kCameraAndBoxes =
    R"("camera": {"position": [1, 2, 3], "forward": [0, 0, -2], "up": [0, 1, 0],
  "fov_y_deg": 90, "aspect": 2, "near": 0.5, "far": 50, "width": 640, "height": 320},
  "receivers": {"min": [0, 0, 0], "max": [1, 1, 1]},
  "casters": [{"min": [0, 0, 0], "max": [1, 1, 1]}, {"min": [2, 2, 2], "max": [3, 3, 3]}])";

std::string text_with(const std::string& light, const std::string& options = "") {
  return std::string("{") + kCameraAndBoxes + R"(, "light": )" + light +
         (options.empty() ? "" : R"(, "options": )" + options) + "}";
}

const std::string kSun = R"({"type": "directional", "direction": [0, -1, 0]})";

/// True where `text` is a case, false where it is refused; anything else thrown fails the test.
bool reads(std::string_view text) {
  try {
    (void)read_case(text);
    return true;
  } catch (const CaseError& error) {
    const std::string_view what = error.what();
    EXPECT_FALSE(what.empty());
    for (const char c : what) EXPECT_TRUE(c >= ' ' && c <= '~') << what;
    return false;
  }
}

TEST(CaseFile, reads_a_far_plane_without_end) {
  const auto far_of = [](const std::string& far) {
    std::string text = text_with(kSun);
    const std::string fifty = R"("far": 50, )";
    text.replace(text.find(fifty), fifty.size(), far);
    return read_case(text).camera.far_depth;
  };
  for (const char* far : {R"("far": "infinity", )", R"("far": null, )", ""})
    EXPECT_TRUE(std::isinf(far_of(far))) << far;
  EXPECT_EQ(far_of(R"("far": 70, )"), 70.0);
  EXPECT_THROW((void)far_of(R"("far": "endless", )"), CaseError);
  EXPECT_THROW((void)far_of(R"("far": true, )"), CaseError);
}

TEST(CaseFile, reads_camera_and_boxes) {
  const Case input = read_case(text_with(kSun));
  EXPECT_EQ(input.camera.position, glm::dvec3(1, 2, 3));
  EXPECT_EQ(input.camera.forward, glm::dvec3(0, 0, -2));
  EXPECT_NEAR(input.camera.top, 1.0, 1e-15);  // tan(45 degrees), one rounding of pi away
  EXPECT_NEAR(input.camera.right, 2.0, 1e-15);
  EXPECT_EQ(input.camera.near_depth, 0.5);
  EXPECT_EQ(input.camera.far_depth, 50.0);
  EXPECT_EQ(input.camera.width, 640);
  EXPECT_EQ(input.receivers.size(), 1u);
  ASSERT_EQ(input.casters.size(), 2u);
  EXPECT_EQ(input.casters[1].max, glm::dvec3(3, 3, 3));
  EXPECT_EQ(input.bounds().casters.list().data(), input.casters.data());
}

TEST(CaseFile, reads_all_three_kinds_of_light) {
  const Case sun = read_case(text_with(kSun));
  EXPECT_EQ(std::get<DirectionalLight>(sun.light).direction, glm::dvec3(0, -1, 0));
  const Case spot = read_case(text_with(
      R"({"type": "spot", "position": [1, 2, 3], "direction": [0, -1, 0], "outer_deg": 45, "range": 9})"));
  EXPECT_DOUBLE_EQ(std::get<SpotLight>(spot.light).outer_radians, std::numbers::pi / 4);
  EXPECT_EQ(std::get<SpotLight>(spot.light).range, 9.0);
  const Case point = read_case(text_with(R"({"type": "point", "position": [1, 2, 3], "range": 9})"));
  EXPECT_EQ(std::get<PointLight>(point.light).position, glm::dvec3(1, 2, 3));
}

TEST(CaseFile, leaves_what_is_absent_at_its_default) {
  const PlanOptions defaults;
  const PlanOptions options = read_case(text_with(kSun, R"({"map_size": 512})")).options;
  EXPECT_EQ(options.resolution.max_size, 512);
  EXPECT_EQ(options.cascades, defaults.cascades);
  EXPECT_EQ(options.split.scheme, defaults.split.scheme);
  EXPECT_EQ(options.split.lambda, defaults.split.lambda);
  EXPECT_EQ(options.warp.warp, defaults.warp.warp);
  EXPECT_EQ(options.fit, defaults.fit);
  EXPECT_EQ(options.clip_space, defaults.clip_space);
}

TEST(CaseFile, finds_every_registered_warp_by_name) {
  for (const Warp* warp : all_warps()) {
    const std::string options = R"({"warp": ")" + std::string(warp->name) + R"("})";
    EXPECT_EQ(read_case(text_with(kSun, options)).options.warp.warp, warp);
  }
}

TEST(CaseFile, reads_partitions_and_takes_the_separating_plane_as_a_warp_too) {
  for (const Partition partition :
       {Partition::view_depth, Partition::frustum_faces, Partition::separating_plane, Partition::tetrahedron,
        Partition::receiver_clusters}) {
    const std::string options = R"({"partition": ")" + std::string(to_string(partition)) + R"("})";
    EXPECT_EQ(read_case(text_with(kSun, options)).options.split.partition, partition);
  }
  const PlanOptions as_warp = read_case(text_with(kSun, R"({"warp": "separating_plane"})")).options;
  EXPECT_EQ(as_warp.split.partition, Partition::separating_plane);
  EXPECT_EQ(as_warp.warp.warp, nullptr);
  EXPECT_THROW(
      (void)read_case(text_with(kSun, R"({"warp": "separating_plane", "partition": "frustum_faces"})")),
      CaseError);
  EXPECT_THROW((void)read_case(text_with(kSun, R"({"partition": "faces"})")), CaseError);
}

TEST(CaseFile, reads_slices_of_frustum_faces_and_where_maps_of_a_local_light_begin) {
  const PlanOptions options =
      read_case(
          text_with(kSun, R"({"partition": "frustum_faces", "face_slices": 3, "light_near_share": 1e-5})"))
          .options;
  EXPECT_EQ(options.split.face_slices, 3);
  EXPECT_EQ(options.light_near_share, 1e-5);
  EXPECT_EQ(read_case(text_with(kSun, "{}")).options.split.face_slices, 1);
  EXPECT_THROW((void)read_case(text_with(kSun, R"({"face_slices": 1.5})")), CaseError);
}

TEST(CaseFile, reads_given_splits) {
  const Case input = read_case(text_with(kSun, R"({"cascades": 3, "given_splits": [4, 9.5]})"));
  EXPECT_EQ(input.options.split.scheme, SplitScheme::given);
  EXPECT_EQ(input.options.split.given[0], 4.0);
  EXPECT_EQ(input.options.split.given[1], 9.5);
  EXPECT_TRUE(std::isinf(input.options.split.given[2]));
  EXPECT_THROW((void)read_case(text_with(kSun, R"({"split": "uniform", "given_splits": [4]})")), CaseError);
  EXPECT_THROW((void)read_case(text_with(kSun, R"({"given_splits": 4})")), CaseError);
  EXPECT_THROW((void)read_case(text_with(kSun, R"({"given_splits": ["4"]})")), CaseError);
  EXPECT_THROW((void)read_case(text_with(kSun, R"({"given_splits": [1,2,3,4,5,6,7,8]})")), CaseError);
}

TEST(CaseFile, reads_planes_that_get_a_map_each) {
  const WarpPlanes planes =
      read_case(text_with(kSun, R"({"planes": [{"point": [0, 1, 2], "normal": [0, 2, 0], "thickness": 0.25},
                                               {"point": [9, 0, 0], "normal": [1, 0, 0], "thickness": 0.5}]})"))
          .options.warp.planes;
  EXPECT_EQ(planes[0], (WarpPlane{{0, 1, 2}, {0, 2, 0}, 0.25}));
  EXPECT_EQ(planes[1], (WarpPlane{{9, 0, 0}, {1, 0, 0}, 0.5}));
  EXPECT_EQ(planes[2], WarpPlane{});
  for (const char* broken : {R"({"planes": {}})", R"({"planes": [1]})",
                             R"({"planes": [{"point": [0, 1, 2], "normal": [0, 2, 0]}]})",
                             R"({"planes": [{"point": [0, 1, 2], "normal": [0, 2, 0], "thickness": 0}]})",
                             R"({"planes": [{"point": [0, 1], "normal": [0, 2, 0], "thickness": 1}]})"}) {
    EXPECT_THROW((void)read_case(text_with(kSun, broken)), CaseError) << broken;
  }
}

TEST(CaseFile, reads_a_target_a_budget_and_the_whole_clip_space) {
  const PlanOptions options =
      read_case(text_with(kSun, R"({"target_m": 1.5, "texel_budget": 4294967296, "split_overlap": 0.1,
      "prune": "swept_casters,held_maps", "prune_m": 0.5,
      "clip_space": {"handedness": "left", "first_row": "y_plus_one"}})"))
          .options;
  EXPECT_EQ(options.resolution.max_error, 1.5);
  EXPECT_EQ(options.split.overlap, 0.1);
  EXPECT_EQ(options.prune, kPruneNothing.with(PruneRule::swept_casters).with(PruneRule::held_maps));
  EXPECT_EQ(options.resolution.prune_error, 0.5);
  EXPECT_THROW((void)read_case(text_with(kSun, R"({"prune": "everything"})")), CaseError);
  EXPECT_EQ(options.resolution.texel_budget, std::int64_t{1} << 32);
  EXPECT_EQ(options.clip_space.handedness, Handedness::left);
  EXPECT_EQ(options.clip_space.first_row, FirstRow::y_plus_one);
  EXPECT_THROW((void)read_case(text_with(kSun, R"({"texel_budget": 0.5})")), CaseError);
  EXPECT_THROW((void)read_case(text_with(kSun, R"({"texel_budget": 1e300})")), CaseError);
  EXPECT_THROW((void)read_case(text_with(kSun, R"({"clip_space": {"handedness": "up"}})")), CaseError);
  EXPECT_THROW((void)read_case(text_with(kSun, R"({"clip_space": {"first_row": "top"}})")), CaseError);
}

TEST(CaseFile, keeps_numbers_to_the_last_bit) {
  const Case input =
      read_case(text_with(R"({"type": "directional", "direction": [0.1, 5e-324, 1.7976931348623157e308]})"));
  const glm::dvec3 direction = std::get<DirectionalLight>(input.light).direction;
  EXPECT_EQ(direction.x, 0.1);
  EXPECT_EQ(direction.y, 5e-324);
  EXPECT_EQ(direction.z, 1.7976931348623157e308);
}

TEST(CaseFile, names_the_file_in_front_of_the_complaint) {
  try {
    (void)load_case("/nowhere/a.json");
    FAIL();
  } catch (const CaseError& error) {
    EXPECT_STREQ(error.what(), "/nowhere/a.json: cannot be read: No such file or directory");
  }
}

TEST(CaseFile, nests_no_deeper_than_its_limit) {
  const auto refusal = [](int depth) {
    try {
      (void)read_case(std::string(static_cast<std::size_t>(depth), '[') +
                      std::string(static_cast<std::size_t>(depth), ']'));
    } catch (const CaseError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal(kMaxCaseNesting + 1).find("nested deeper than 32 levels"), std::string::npos);
  EXPECT_NE(refusal(100'000).find("nested deeper than 32 levels"), std::string::npos);
  EXPECT_NE(refusal(kMaxCaseNesting).find("needs an object"), std::string::npos) << refusal(kMaxCaseNesting);
}

TEST(CaseFile, brackets_inside_strings_are_not_nesting) {
  const std::string brackets(100, '[');
  try {
    (void)read_case("{\"" + brackets + "\\\"" + brackets + "\": 1}");
    FAIL();
  } catch (const CaseError& error) {
    EXPECT_NE(std::string_view(error.what()).find("unknown key"), std::string_view::npos) << error.what();
  }
}

TEST(CaseFile, every_beginning_of_a_case_is_refused) {
  const std::string text = text_with(kSun, R"({"map_size": 512})");
  ASSERT_TRUE(reads(text));
  for (std::size_t length = 0; length < text.size(); ++length)
    EXPECT_FALSE(reads(text.substr(0, length))) << length;
}

/// A value other than the default for each field that one word can say.
std::string other_value(const PlanField& field) {
  const PlanOptions defaults;
  if (const auto* choice = std::get_if<PlanChoice>(&field.place)) {
    for (const std::string& name : choice->names())
      if (name != choice->get(defaults)) return "\"" + name + "\"";
  }
  return std::holds_alternative<PlanMember<bool>>(field.place) ? "true" : "7";
}

TEST(PlanFields, of_each_name_a_case_reads_into_the_same_place) {
  std::size_t checked = 0;
  for (const PlanField& field : plan_fields()) {
    const std::string value = other_value(field), key(field.key);
    std::visit(
        [&](const auto& place) {
          using Place = std::remove_cvref_t<decltype(place)>;
          constexpr bool is_word =
              std::is_same_v<Place, PlanChoice> || std::is_same_v<Place, PlanMember<int>> ||
              std::is_same_v<Place, PlanMember<double>> || std::is_same_v<Place, PlanMember<std::int64_t>>;
          if constexpr (is_word) {
            Case read = read_case(text_with(kSun, "{\"" + key + "\": " + value + "}"));
            if constexpr (std::is_same_v<Place, PlanChoice>) {
              EXPECT_EQ("\"" + place.get(read.options) + "\"", value) << key;
            } else {
              EXPECT_DOUBLE_EQ(static_cast<double>(place(read.options)), 7.0 * field.unit) << key;
            }
            ++checked;
          }
        },
        field.place);
  }
  EXPECT_GE(checked, 17u);
}

TEST(PlanFields, have_a_text_for_what_a_plan_refuses) {
  std::size_t texts = 0;
  for (const PlanField& field : plan_fields()) {
    EXPECT_EQ(field.invalid_field.empty(), field.must.empty()) << field.key;
    if (field.invalid_field.empty()) continue;
    ++texts;
    EXPECT_EQ(invalid_input_text(field.invalid_field),
              "options." + std::string(field.key) + ": " + std::string(field.must));
  }
  EXPECT_GE(texts, 14u);
  EXPECT_EQ(invalid_input_text("options.resolution.max_size"), "options.map_size: must lie in 4..16384");
}

TEST(PlanFields, are_suggested_where_a_key_or_a_name_nearly_matches) {
  const auto refusal = [](const std::string& options) {
    try {
      (void)read_case(text_with(kSun, options));
    } catch (const CaseError& error) {
      return std::string(error.what());
    }
    return std::string("read");
  };
  EXPECT_NE(refusal(R"({"lamda": 0.5})").find("did you mean 'lambda'?"), std::string::npos);
  EXPECT_NE(refusal(R"({"warp": "lispms"})").find("did you mean 'lispsm'?"), std::string::npos);
  EXPECT_EQ(refusal(R"({"elephants": 0.5})").find("did you mean"), std::string::npos);
}

TEST(JsonWords, are_ours) {
  EXPECT_EQ(json_words("[json.exception.out_of_range.403] key 'near' not found"), "\"near\" is missing");
  EXPECT_EQ(json_words("[json.exception.type_error.302] type must be string, but is number"),
            "needs string, is number");
  EXPECT_EQ(json_words("[json.exception.type_error.304] cannot use at() with null"),
            "needs an object, is null");
  const char* parse_error =
      "[json.exception.parse_error.101] parse error at line 2, column 5: syntax error while parsing value - "
      "invalid literal; last read: 'x'";
  EXPECT_EQ(json_words(parse_error), "line 2, column 5: invalid literal; last read: 'x'");
  EXPECT_EQ(json_words(parse_error, false), "invalid literal; last read: 'x'");
  for (const char* cut :
       {"", "[json.exception.", "[json.exception.x] ", "parse error", "parse error at", "key '"})
    EXPECT_EQ(json_words(cut).find("json.exception."), std::string::npos) << cut;
}

RC_GTEST_PROP(CaseFile, any_bytes_are_read_or_refused, (const std::string& bytes)) {
  (void)reads(bytes);
}

RC_GTEST_PROP(CaseFile, any_change_of_a_case_is_read_or_refused, ()) {
  std::string text = text_with(kSun, R"({"map_size": 512, "warp": "auto", "stable": true})");
  const int changes = *rc::gen::inRange(1, 6);
  for (int i = 0; i < changes; ++i)
    text[*rc::gen::inRange<std::size_t>(0, text.size())] =
        *rc::gen::oneOf(rc::gen::arbitrary<char>(),
                        rc::gen::element('{', '}', '[', ']', '"', ',', ':', '-', '.', 'e', '9', '\0'));
  (void)reads(text);
}

}  // namespace
}  // namespace gnomon
