// Does the net of random frames hold, and does it notice a mask that is wrong?
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "check_frame.hpp"
#include "decided.hpp"
#include "draw_frame.hpp"
#include "frame_scene.hpp"
#include "frame_setting.hpp"
#include "gnomon/render/context.hpp"
#include "run_frames.hpp"
#include "shrink.hpp"

namespace gnomon::stress {
namespace {

using Json = nlohmann::ordered_json;

class FramesNet : public testing::Test {
 protected:
  static void SetUpTestSuite() { context_ = render::create_context(); }
  static void TearDownTestSuite() { context_.reset(); }
  static inline std::unique_ptr<render::Context> context_;
};

void expect_none(const FramesResult& result) {
  for (const KindFound& k : result.kinds)
    ADD_FAILURE() << k.kind << ": " << k.cases << " scenes, first " << k.first << ": " << k.text;
}

TEST_F(FramesNet, a_few_frames_keep_every_promise) {
  const FramesResult result = run_frames({60, 20061026, false});
  expect_none(result);
  // Nothing holds because nothing was looked at.
  EXPECT_GE(result.counts.frames, 60);
  EXPECT_GT(result.counts.moving, 10);
  EXPECT_GT(result.counts.lit, 20'000);
  EXPECT_GT(result.counts.dark, 500);
  EXPECT_GT(result.counts.exact, 10'000);
  EXPECT_GT(result.counts.kept, 30);
  EXPECT_GT(result.counts.anew, 3);
}

TEST_F(FramesNet, many_frames_keep_every_promise) {
  const FramesResult result = run_frames({300, 20061027, false});
  expect_none(result);
  EXPECT_GT(result.counts.panes, 1000);
  EXPECT_GT(result.counts.pages, 1000);
}

TEST_F(FramesNet, frames_that_failed_once_keep_every_promise) {
  namespace fs = std::filesystem;
  int files = 0;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(fs::path(GNOMON_TEST_DATA) / "stress_frames")) {
    std::ifstream stream(entry.path());
    const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    for (const Finding& f : check_frame(Json::parse(text)).findings)
      ADD_FAILURE() << entry.path().filename() << ": " << f.kind << ": " << f.text;
    ++files;
  }
  EXPECT_GE(files, 4);
}

/// A plate of 2 x 2 over the middle of a ground of 8 x 8, seen from above; light falls straight down.
Json plate_over_ground() {
  return Json::parse(R"({"camera": {"position": [0, 6, 5], "forward": [0, -1, -0.8], "up": [0, 1, 0],
      "fov_y_deg": 60, "aspect": 1.5, "near": 0.5, "far": 40, "width": 96, "height": 64},
    "light": {"type": "directional", "direction": [0, -1, 0]},
    "objects": [{"kind": "plate", "size": [4, 1, 4]}, {"kind": "plate", "at": [0, 2, 0]}],
    "options": {"cascades": 1, "map_size": 256, "warp": "none"}, "frame": {"filter": "hard"}})");
}

TEST_F(FramesNet, most_of_a_plain_frame_is_decided) {
  for (const char* filter : {"hard", "pcf:radius=1", "pcf_tent", "revectorized:run=1", "silhouette"}) {
    Json frame = plate_over_ground();
    frame["frame"]["filter"] = filter;
    const FrameVerdict verdict = check_frame(frame);
    for (const Finding& f : verdict.findings) ADD_FAILURE() << filter << ": " << f.kind << ": " << f.text;
    EXPECT_GT(verdict.counts.dark, 20) << filter;
    EXPECT_GT(verdict.counts.lit, 2000) << filter;
    EXPECT_LT(verdict.counts.lit + verdict.counts.dark, verdict.counts.pixels) << filter;
  }
}

TEST_F(FramesNet, exact_shadows_are_decided_but_for_edges) {
  Json frame = plate_over_ground();
  frame["frame"]["source"] = "irregular";
  const FrameVerdict verdict = check_frame(frame);
  EXPECT_TRUE(verdict.findings.empty());
  EXPECT_GT(verdict.counts.exact, verdict.counts.pixels * 99 / 100);
}

TEST_F(FramesNet, what_casts_or_receives_no_shadow_is_lit_from_every_source) {
  for (const char* source : {"maps", "pages", "lights", "irregular", "identifiers"}) {
    for (const auto& [object, key] : {std::pair(1, "casts"), std::pair(0, "receives")}) {
      Json frame = plate_over_ground();
      frame["frame"]["source"] = source;
      const long long shadow = check_frame(frame).counts.dark;
      frame["objects"][static_cast<std::size_t>(object)][key] = false;
      const FrameVerdict verdict = check_frame(frame);
      for (const Finding& f : verdict.findings) ADD_FAILURE() << source << ": " << f.kind << ": " << f.text;
      const FrameCounts& c = verdict.counts;
      EXPECT_EQ(c.dark, 0) << source << " " << key;
      EXPECT_TRUE(shadow > 0 || source == std::string("irregular")) << source;
      EXPECT_GT(c.lit + c.exact + c.unserved, c.pixels / 2) << source << " " << key;
    }
  }
}

/// The space of one map of that scene, whose triangles are changed by `harm` behind the renderer's back.
struct Space {
  explicit Space(const Json& frame) : setting(read_frame(frame)), scene(scene_of_frame(frame)) {
    for (const Instance& instance : scene.instances) boxes.push_back(instance.bounds_world);
    plan = make_plan(setting.input.camera, setting.input.light, {boxes, boxes}, setting.input.options);
    triangles = world_triangles(scene, setting.input.camera.position);
  }
  [[nodiscard]] Must decide(double x, double z, double reach_texels = 1.5) const {
    const MapSpace space(plan.map[0], plan.clip_space, setting.input.camera.position, setting.input.light,
                         triangles);
    const glm::dvec3 point = glm::dvec3(x, 0.0, z) - setting.input.camera.position;
    return space.decide({point, {0.0, 1.0, 0.0}, 0, 0.0, 0.0}, {reach_texels, false, plan.bias});
  }
  FrameSetting setting;
  Scene scene;
  std::vector<Box> boxes;
  ShadowPlan plan;
  std::vector<WorldTriangle> triangles;
};

// The plate ends at 1; a texel of this map is about 0.03 wide.
TEST(Decided, by_hand_round_the_edge_of_a_plate) {
  const Space space(plate_over_ground());
  ASSERT_EQ(space.plan.map_count, 1);
  const double texel = space.plan.map[0].texel_world.x;
  // The diagonal of the plate is an edge of two triangles, too: off it.
  EXPECT_EQ(space.decide(0.5, 0.1), Must::dark);
  EXPECT_EQ(space.decide(1.5, 0.1), Must::lit);
  EXPECT_EQ(space.decide(1.0, 0.1), Must::undecided);
  EXPECT_EQ(space.decide(1.0 + 1.2 * texel, 0.1), Must::undecided);
  EXPECT_EQ(space.decide(1.0 + 3.0 * texel, 0.1), Must::lit);
  EXPECT_EQ(space.decide(1.0 + 3.0 * texel, 0.1, 6.0), Must::undecided);
  EXPECT_EQ(space.decide(1.0 - 4.0 * texel, 0.1), Must::dark);
}

TEST(Decided, a_mask_with_holes_decides_no_shadow_and_stops_no_light) {
  Json frame = plate_over_ground();
  frame["objects"][1]["kind"] = "fence";
  const Space space(frame);
  EXPECT_EQ(space.decide(0.5, 0.1), Must::undecided);
  EXPECT_EQ(space.decide(1.5, 0.1), Must::lit);
}

TEST(Decided, a_bias_as_large_as_the_gap_decides_no_shadow) {
  Json frame = plate_over_ground();
  frame["options"]["bias"] = {{"constant_texels", 100.0}};
  const Space space(frame);
  EXPECT_EQ(space.decide(0.5, 0.1), Must::undecided);
}

TEST(DrawFrame, frames_are_the_same_for_a_seed_and_different_from_each_other) {
  EXPECT_EQ(draw_frame(7, 3), draw_frame(7, 3));
  EXPECT_NE(draw_frame(7, 3), draw_frame(7, 4));
  EXPECT_NE(draw_frame(7, 3), draw_frame(8, 3));
}

TEST(DrawFrame, every_kind_of_object_is_drawn_and_loads) {
  for (int kind = 0; kind < kObjectKinds; ++kind) {
    Json frame = plate_over_ground();
    frame["objects"][1] = {{"kind", to_string(static_cast<ObjectKind>(kind))}, {"size", {1.0, -0.5, 1.0}}};
    const Scene scene = scene_of_frame(frame);
    EXPECT_GT(scene.instances.size(), 1u) << kind;
  }
  bool seen[kObjectKinds] = {};
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Json frame = draw_frame(1, i);
    for (const Json& object : frame["objects"]) {
      for (int kind = 0; kind < kObjectKinds; ++kind)
        seen[kind] = seen[kind] || object["kind"] == to_string(static_cast<ObjectKind>(kind));
    }
  }
  for (int kind = 0; kind < kObjectKinds; ++kind) EXPECT_TRUE(seen[kind]) << kind;
}

TEST(ReadFrame, what_is_no_frame_is_refused) {
  const auto refusal = [](const char* at, const Json& value) -> std::string {
    Json frame = plate_over_ground();
    frame[Json::json_pointer(at)] = value;
    try {
      (void)read_frame(frame);
      (void)scene_of_frame(frame);
      return "";
    } catch (const CaseError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(refusal("/frame/source", "maps"), "");
  EXPECT_NE(refusal("/frame/source", "map").find("frame.source"), std::string::npos);
  EXPECT_NE(refusal("/frame/source", 3).find("frame"), std::string::npos);
  EXPECT_NE(refusal("/frame/filter", "soft").find("frame.filter"), std::string::npos);
  EXPECT_NE(refusal("/frame/steps", 1e9).find("frame.steps"), std::string::npos);
  EXPECT_NE(refusal("/frame/layer", "last").find("frame.layer"), std::string::npos);
  EXPECT_NE(refusal("/objects/0/kind", "tree").find("tree"), std::string::npos);
  EXPECT_NE(refusal("/objects/0/at", Json::array({1})).find("at"), std::string::npos);
}

TEST(ShrinkFrame, objects_and_words_that_do_not_matter_go) {
  Json frame = plate_over_ground();
  for (int i = 0; i < 12; ++i) frame["objects"].push_back({{"kind", "box"}, {"at", {i, 0, 0}}});
  frame["objects"].push_back({{"kind", "tower"}});
  frame["frame"]["source"] = "pages";
  frame["frame"]["steps"] = 3;
  const Json small = shrink_case(frame, [](const Json& candidate) {
    if (candidate["frame"].value("source", "") != "pages") return false;
    const Json& objects = candidate["objects"];
    return std::any_of(objects.begin(), objects.end(), [](const Json& o) { return o["kind"] == "tower"; });
  });
  EXPECT_EQ(small["objects"].size(), 1u);
  EXPECT_EQ(small["frame"], Json({{"source", "pages"}}));
}

}  // namespace
}  // namespace gnomon::stress
