// Does bad input come back as a status and the name of a field? Null pointers, sizes, counts, numbers, and
// random bytes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <random>
#include <regex>
#include <set>
#include <sstream>

#include "c/sized.hpp"
#include "in_c.hpp"

namespace gnomon::c {

// A struct of three versions, each of which appended a field.
struct grown_first {
  std::uint32_t size;
  std::int32_t a;
};
struct grown {
  std::uint32_t size;
  std::int32_t a;
  double b, c;
};
GNOMON_C_SIZED(grown, "grown", sizeof(grown_first));
void set_defaults(grown& to) noexcept {
  to = {sizeof to, 1, 2.0, 3.0};
}

}  // namespace gnomon::c

namespace gnomon::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// "struct.field" of all structs of the header, and the names of all parameters.
std::set<std::string> names_in_header() {
  std::ifstream file(std::string(GNOMON_SOURCE_DIR) + "/include/gnomon/c/gnomon.h");
  std::stringstream text;
  text << file.rdbuf();
  const std::string header = std::regex_replace(text.str(), std::regex("//[^\n]*"), "");
  std::set<std::string> names;
  const std::regex structs("typedef struct gnomon_(\\w+) \\{([^}]*)\\}"), word("(\\w+)(?:\\[[^;,]*)?[,;]");
  for (std::sregex_iterator s(header.begin(), header.end(), structs), end; s != end; ++s) {
    const std::string name = (*s)[1], body = (*s)[2];
    names.insert(name);
    for (std::sregex_iterator f(body.begin(), body.end(), word); f != end; ++f)
      names.insert(name + "." + (*f)[1].str());
  }
  const std::regex parameter("(\\w+)(?:\\[\\w*\\])?[,)]");
  for (std::sregex_iterator p(header.begin(), header.end(), parameter), end; p != end; ++p)
    names.insert((*p)[1]);
  return names;
}

/// Whether `field` names what the header has: one name, or several with commas, and words behind.
bool is_named(const char* field) {
  static const std::set<std::string> names = names_in_header();
  if (field == nullptr) return false;
  const std::string text = field;
  const std::string first = text.substr(0, text.find_first_of(", "));
  return names.contains(first);
}

/// Everything that a plan takes, in good order.
struct Good {
  std::vector<Box> boxes{{{-20, -1, -200}, {20, 30, -1}}};
  std::vector<double> points{0, 0, -5, 1, 0, -6};
  InputInC in{perspective_camera({0, 5, 0}, {0, -0.1, -1}, {0, 1, 0}, 1.0, 1.5, 0.5, 250.0, 960, 640),
              DirectionalLight{{0.3, -1, 0.2}},
              boxes,
              boxes,
              {}};
  PlanInC out;

  int32_t plan(const char** field) {
    return gnomon_make_plan(&in.view, &in.light, &in.scene, &in.options, nullptr, &out.plan, field);
  }
};

TEST(Abuse, the_names_of_the_header_are_found) {
  EXPECT_GT(names_in_header().size(), 250u);
  EXPECT_TRUE(is_named("plan_options.split_lambda"));
  EXPECT_TRUE(is_named("camera.left, camera.right"));
  EXPECT_FALSE(is_named("plan_options.lambda"));
  EXPECT_FALSE(is_named(nullptr));
}

TEST(Abuse, an_older_struct_keeps_defaults_and_a_newer_one_is_refused) {
  const c::grown_first older{sizeof(c::grown_first), 7};
  c::grown read;
  ASSERT_EQ(c::read(reinterpret_cast<const c::grown*>(&older), read), nullptr);
  EXPECT_EQ(read.a, 7);
  EXPECT_EQ(read.b, 2.0);
  EXPECT_EQ(read.c, 3.0);
  EXPECT_EQ(read.size, sizeof(c::grown));
  // Nothing is written beyond the older one.
  struct {
    c::grown_first first{sizeof(c::grown_first), 0};
    double beyond = 5.0;
  } memory;
  c::write(c::grown{sizeof(c::grown), 9, 8.0, 8.0}, reinterpret_cast<c::grown*>(&memory.first));
  EXPECT_EQ(memory.first.a, 9);
  EXPECT_EQ(memory.first.size, sizeof(c::grown_first));
  EXPECT_EQ(memory.beyond, 5.0);
  EXPECT_EQ(c::write_defaults(reinterpret_cast<c::grown*>(&memory.first), sizeof(c::grown_first)), GNOMON_OK);
  EXPECT_EQ(memory.first.a, 1);
  EXPECT_EQ(memory.beyond, 5.0);
  for (const std::uint32_t size : {0u, 4u, 7u, 25u, 32u, 0xffffffffu}) {
    const c::grown odd{size, 0, 0.0, 0.0};
    EXPECT_STREQ(c::read(&odd, read), "grown.size") << size;
  }
  EXPECT_STREQ(c::read<c::grown>(nullptr, read), "grown");
}

/// Calls the _default() function of a struct with nothing, with sizes that no version had, and with its own.
template <typename T>
void check_default(int32_t (*set_default)(T*, uint32_t)) {
  struct {
    T value;
    unsigned char beyond[16];
  } memory;
  std::memset(&memory, 0xab, sizeof memory);
  EXPECT_EQ(set_default(nullptr, sizeof(T)), GNOMON_INVALID_INPUT);
  for (const std::uint32_t size : {0u, 4u, static_cast<std::uint32_t>(sizeof(T)) + 8u, 0xffffffffu})
    EXPECT_EQ(set_default(&memory.value, size), GNOMON_INVALID_INPUT);
  EXPECT_EQ(memory.value.size, 0xababababu);
  EXPECT_EQ(set_default(&memory.value, sizeof(T)), GNOMON_OK);
  EXPECT_EQ(memory.value.size, sizeof(T));
  for (const unsigned char byte : memory.beyond) EXPECT_EQ(byte, 0xab);
}

TEST(Abuse, defaults_take_the_size_that_they_have) {
  check_default(gnomon_camera_default);
  check_default(gnomon_light_default);
  check_default(gnomon_scene_default);
  check_default(gnomon_view_default);
  check_default(gnomon_plan_options_default);
  check_default(gnomon_map_default);
  check_default(gnomon_plan_default);
  check_default(gnomon_measure_options_default);
  check_default(gnomon_stats_default);
  check_default(gnomon_shadow_picture_default);
  check_default(gnomon_page_options_default);
  check_default(gnomon_page_plan_default);
  check_default(gnomon_page_history_default);
  check_default(gnomon_light_request_default);
  check_default(gnomon_light_options_default);
  check_default(gnomon_light_plan_default);
  check_default(gnomon_light_clusters_default);
}

TEST(Abuse, defaults_are_those_of_cpp) {
  gnomon_plan_options options;
  gnomon_plan_options_default(&options, sizeof options);
  const gnomon_plan_options expected = in_c(PlanOptions{});
  EXPECT_EQ(std::memcmp(&options, &expected, sizeof options), 0);
  EXPECT_EQ(options.warp, GNOMON_DEFAULT);
  EXPECT_STREQ(gnomon_name(GNOMON_SHAPES, options.warp_shape), "linear");
  EXPECT_STREQ(gnomon_name(GNOMON_SPLITS, options.split_scheme), "auto");
  gnomon_camera camera;
  gnomon_camera_default(&camera, sizeof camera);
  const gnomon_camera in_cpp = in_c(Camera{});
  EXPECT_EQ(std::memcmp(&camera, &in_cpp, sizeof camera), 0);
}

TEST(Abuse, names_are_those_of_the_registries) {
  const auto check = [](int32_t list, std::size_t count, auto name_of) {
    ASSERT_EQ(gnomon_count(list), static_cast<int32_t>(count));
    for (int32_t i = 0; i < gnomon_count(list); ++i) {
      const std::string_view name = name_of(static_cast<std::size_t>(i));
      EXPECT_EQ(std::string_view(gnomon_name(list, i)), name);
      EXPECT_EQ(gnomon_find(list, gnomon_name(list, i)), i);
      EXPECT_NE(gnomon_summary(list, i), nullptr);
    }
    EXPECT_EQ(gnomon_name(list, gnomon_count(list)), nullptr);
    EXPECT_EQ(gnomon_summary(list, -1), nullptr);
  };
  check(GNOMON_WARPS, all_warps().size(), [](std::size_t i) { return all_warps()[i]->name; });
  check(GNOMON_SHAPES, all_shapes().size(), [](std::size_t i) { return all_shapes()[i]->name; });
  check(GNOMON_PAGE_POLICIES, all_page_policies().size(),
        [](std::size_t i) { return all_page_policies()[i]->name; });
  check(GNOMON_PRUNE_RULES, kPruneRuleCount, [](std::size_t i) { return prune_rules()[i].name; });
  check(GNOMON_FITS, 4, [](std::size_t i) { return to_string(static_cast<Fit>(i)); });
  check(GNOMON_SPLITS, 7, [](std::size_t i) { return to_string(static_cast<SplitScheme>(i)); });
  check(GNOMON_PARTITIONS, 5, [](std::size_t i) { return to_string(static_cast<Partition>(i)); });
  check(GNOMON_SELECTIONS, 3, [](std::size_t i) { return to_string(static_cast<MapSelection>(i)); });
  check(GNOMON_OBJECTIVES, 4, [](std::size_t i) { return to_string(static_cast<Objective>(i)); });
  for (std::size_t i = 0; i < all_warps().size(); ++i)
    EXPECT_EQ(std::string_view(gnomon_summary(GNOMON_WARPS, static_cast<int32_t>(i))),
              all_warps()[i]->summary);
  EXPECT_STREQ(gnomon_name(GNOMON_STATUSES, GNOMON_OUT_OF_MEMORY), "out_of_memory");
  EXPECT_EQ(gnomon_find(GNOMON_WARPS, "teapot"), GNOMON_UNKNOWN);
  EXPECT_EQ(gnomon_find(GNOMON_WARPS, nullptr), GNOMON_UNKNOWN);
  EXPECT_EQ(gnomon_find(77, "none"), GNOMON_UNKNOWN);
  EXPECT_EQ(gnomon_count(-1), 0);
  EXPECT_EQ(std::string_view(gnomon_version()), kVersion);
}

TEST(Abuse, every_kind_of_omission_has_a_constant_and_words) {
  for (int32_t kind = 0; kind <= GNOMON_CASCADE_WITHOUT_GAIN; ++kind) {
    const gnomon_omission omission{kind, 1, 2.0, 3.0, 4};
    gnomon_text text;
    gnomon_describe(&omission, &text);
    EXPECT_NE(text.what[0], '\0') << kind;
    EXPECT_NE(text.why[0], '\0') << kind;
  }
  // The core has no further one: a kind that it does not know has no words.
  const OmissionText beyond =
      describe({static_cast<OmissionKind>(GNOMON_CASCADE_WITHOUT_GAIN + 1), 0, 0.0, 0.0, 0});
  EXPECT_STREQ(beyond.what.data(), "");
}

/// Whether bits of a rule are its place in the list.
TEST(Abuse, bits_of_prune_rules_are_their_places) {
  for (int32_t i = 0; i < gnomon_count(GNOMON_PRUNE_RULES); ++i)
    EXPECT_TRUE(PruneRules{1u << i}.has(find_prune_rule(gnomon_name(GNOMON_PRUNE_RULES, i))->rule));
}

TEST(Abuse, each_broken_field_is_named) {
  struct Fault {
    const char* field;
    void (*make)(Good&);
  };
  const Fault faults[] = {
      {"camera", [](Good& g) { g.in.view.camera = nullptr; }},
      {"camera.size", [](Good& g) { g.in.camera.size = 8; }},
      {"camera.size", [](Good& g) { g.in.camera.size += 8; }},
      {"camera.position", [](Good& g) { g.in.camera.position[1] = kNan; }},
      {"camera.forward",
       [](Good& g) { g.in.camera.forward[0] = g.in.camera.forward[1] = g.in.camera.forward[2] = 0; }},
      {"camera.far_depth", [](Good& g) { g.in.camera.far_depth = 0.1; }},
      {"camera.near_depth", [](Good& g) { g.in.camera.near_depth = -1; }},
      {"camera.width, camera.height", [](Good& g) { g.in.camera.width = 0; }},
      {"light.kind", [](Good& g) { g.in.light.kind = 3; }},
      {"light.kind", [](Good& g) { g.in.light.kind = -1; }},
      {"light.size", [](Good& g) { g.in.light.size = 0; }},
      {"light.direction", [](Good& g) { g.in.light.direction[1] = kNan; }},
      {"light.range", [](Good& g) { g.in.light.kind = GNOMON_POINT, g.in.light.range = 0; }},
      {"view.size", [](Good& g) { g.in.view.size = 1; }},
      {"view.points", [](Good& g) { g.in.view.point_count = 1; }},
      {"view.point_count", [](Good& g) { g.in.view.point_count = -1; }},
      {"view.points",
       [](Good& g) { g.points[4] = kNan, g.in.view.points = g.points.data(), g.in.view.point_count = 2; }},
      {"scene.size", [](Good& g) { g.in.scene.size = 1u << 30; }},
      {"scene.caster_count", [](Good& g) { g.in.scene.caster_count = -1; }},
      {"scene.receiver_count",
       [](Good& g) { g.in.scene.receiver_count = std::numeric_limits<int64_t>::min(); }},
      {"scene.casters", [](Good& g) { g.in.scene.casters = nullptr; }},
      {"scene.casters", [](Good& g) { g.boxes[0].max.x = kNan; }},
      {"plan_options.size", [](Good& g) { g.in.options.size = 12; }},
      {"plan_options.cascades", [](Good& g) { g.in.options.cascades = 9; }},
      {"plan_options.fit", [](Good& g) { g.in.options.fit = 256; }},
      {"plan_options.fit", [](Good& g) { g.in.options.fit = GNOMON_UNKNOWN; }},
      {"plan_options.warp", [](Good& g) { g.in.options.warp = gnomon_find(GNOMON_WARPS, "teapot"); }},
      {"plan_options.warp_shape", [](Good& g) { g.in.options.warp_shape = -1; }},
      {"plan_options.split_selection", [](Good& g) { g.in.options.split_selection = 1; }},
      {"plan_options.prune", [](Good& g) { g.in.options.prune = 0xffffffffu; }},
      {"plan_options.split_lambda", [](Good& g) { g.in.options.split_lambda = kNan; }},
      {"plan_options.warp_planes", [](Good& g) { g.in.options.warp_planes[0][6] = -1; }},
      {"plan_options.resolution_texel_budget", [](Good& g) { g.in.options.resolution_texel_budget = 1; }},
      {"plan.map_room", [](Good& g) { g.out.plan.map_room = -1; }},
      {"plan.map_room", [](Good& g) { g.out.plan.map_room = 1; }},
      {"plan.maps", [](Good& g) { g.out.plan.maps = nullptr; }},
      {"plan.map_size", [](Good& g) { g.out.plan.map_size = 100; }},
      {"plan.omissions", [](Good& g) { g.out.plan.omissions = nullptr; }},
      {"plan.size", [](Good& g) { g.out.plan.size = 0; }},
  };
  for (const Fault& fault : faults) {
    Good good;
    const char* field = nullptr;
    ASSERT_EQ(good.plan(&field), GNOMON_OK);
    ASSERT_EQ(field, nullptr);
    ASSERT_GT(good.out.plan.map_count, 1);
    fault.make(good);
    EXPECT_EQ(good.plan(&field), GNOMON_INVALID_INPUT) << fault.field;
    EXPECT_STREQ(field, fault.field);
    EXPECT_TRUE(is_named(field)) << field;
    EXPECT_EQ(good.plan(nullptr), GNOMON_INVALID_INPUT);
    if (std::string_view(fault.field) != "plan.size" &&
        !std::string_view(fault.field).starts_with("plan.map") &&
        std::string_view(fault.field) != "plan.omissions") {
      EXPECT_EQ(good.out.plan.map_count, 0);
      EXPECT_EQ(good.out.plan.status, GNOMON_INVALID_INPUT);
    }
  }
}

TEST(Abuse, every_number_of_the_options_is_checked_or_free) {
  // Each eight bytes of the options in turn become no number, and each four bytes a huge one.
  int refused = 0;
  for (std::size_t at = 8; at < sizeof(gnomon_plan_options); at += 4) {
    for (const int kind : {0, 1, 2}) {
      Good good;
      auto* bytes = reinterpret_cast<unsigned char*>(&good.in.options);
      if (kind == 0 && at % 8 == 0) std::memcpy(bytes + at, &kNan, 8);
      const std::int32_t number =
          kind == 1 ? std::numeric_limits<int32_t>::max() : std::numeric_limits<int32_t>::min();
      if (kind != 0) std::memcpy(bytes + at, &number, 4);
      const char* field = nullptr;
      const int32_t status = good.plan(&field);
      ASSERT_TRUE(status >= GNOMON_OK && status <= GNOMON_INVALID_INPUT);
      if (status == GNOMON_INVALID_INPUT) {
        EXPECT_TRUE(is_named(field)) << field << " by byte " << at;
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 90);
}

TEST(Abuse, null_pointers_are_named_by_every_call) {
  Good good;
  const char* field = nullptr;
  ASSERT_EQ(good.plan(nullptr), GNOMON_OK);
  const auto refuses = [&](int32_t status, const char* expected) {
    EXPECT_EQ(status, GNOMON_INVALID_INPUT) << expected;
    EXPECT_STREQ(field, expected);
    EXPECT_TRUE(is_named(field)) << expected;
  };
  InputInC& in = good.in;
  gnomon_plan* const plan = &good.out.plan;
  gnomon_map* const map = good.out.maps;
  int64_t count = 0;
  refuses(gnomon_make_plan(nullptr, &in.light, &in.scene, nullptr, nullptr, plan, &field), "view");
  refuses(gnomon_make_plan(&in.view, nullptr, &in.scene, nullptr, nullptr, plan, &field), "light");
  refuses(gnomon_make_plan(&in.view, &in.light, nullptr, nullptr, nullptr, plan, &field), "scene");
  refuses(gnomon_make_plan(&in.view, &in.light, &in.scene, nullptr, nullptr, nullptr, &field), "plan");
  refuses(gnomon_plan_views(nullptr, 1, &in.light, &in.scene, nullptr, plan, &field), "cameras");
  const gnomon_camera* const no_camera[] = {nullptr};
  refuses(gnomon_plan_views(no_camera, 1, &in.light, &in.scene, nullptr, plan, &field), "camera");
  refuses(gnomon_plan_views(no_camera, 9, &in.light, &in.scene, nullptr, plan, &field), "count");
  ASSERT_EQ(good.plan(nullptr), GNOMON_OK);
  refuses(gnomon_select(nullptr, nullptr, nullptr, 0, nullptr, &field), "plan");
  refuses(gnomon_select(plan, nullptr, nullptr, 1, nullptr, &field), "points");
  refuses(gnomon_select(plan, good.points.data(), nullptr, 1, nullptr, &field), "view_depths");
  refuses(gnomon_select(plan, good.points.data(), good.points.data(), 1, nullptr, &field), "indices");
  refuses(gnomon_select(plan, good.points.data(), good.points.data(), -1, nullptr, &field), "count");
  refuses(gnomon_cull(nullptr, nullptr, 0, nullptr, 0, &count, &field), "map");
  refuses(gnomon_cull(map, nullptr, 1, nullptr, 0, &count, &field), "casters");
  refuses(gnomon_cull(map, nullptr, -1, nullptr, 0, &count, &field), "count");
  refuses(gnomon_cull(map, nullptr, 0, nullptr, 1, &count, &field), "indices");
  refuses(gnomon_cull(map, nullptr, 0, nullptr, -1, &count, &field), "room");
  refuses(gnomon_cull(map, nullptr, 0, nullptr, 0, nullptr, &field), "found");
  refuses(gnomon_cull_set(map, nullptr, nullptr, 0, &count, &field), "set");
  refuses(gnomon_cull_planes(nullptr, 1, nullptr, nullptr, 0, &count, &field), "planes");
  refuses(gnomon_cull_planes(nullptr, 33, nullptr, nullptr, 0, &count, &field), "plane_count");
  refuses(gnomon_caster_set_create(nullptr, 1, nullptr, &field), "set");
  gnomon_caster_set* set = nullptr;
  refuses(gnomon_caster_set_create(nullptr, 1, &set, &field), "boxes");
  refuses(gnomon_caster_set_create(nullptr, -1, &set, &field), "count");
  refuses(gnomon_caster_set_refit(nullptr, nullptr, 0, &field), "set");
  refuses(gnomon_caster_set_update(nullptr, 0, nullptr, &field), "set");
  ASSERT_EQ(gnomon_caster_set_create(in.scene.casters, 1, &set, &field), GNOMON_OK);
  refuses(gnomon_caster_set_update(set, 1, in.scene.casters, &field), "index");
  refuses(gnomon_caster_set_update(set, 0, nullptr, &field), "box");
  refuses(gnomon_caster_set_refit(set, in.scene.casters, 2, &field), "count");
  in.scene.caster_set = set;
  refuses(good.plan(&field), "scene.caster_set");
  in.scene.caster_set = nullptr;
  gnomon_caster_set_destroy(set);
  ASSERT_EQ(good.plan(nullptr), GNOMON_OK);
  refuses(gnomon_rebased(map, nullptr, map, &field), "origin");
  refuses(gnomon_rebased(map, good.points.data(), nullptr, &field), "to");
  refuses(gnomon_compare(map, map, nullptr, nullptr, &field), "reuse");
  gnomon_texel_rect outside{0, 0, map->width + 1, 1};
  double planes[20];
  refuses(gnomon_rectangle_planes(map, &outside, nullptr, planes, &field), "rectangle");
  refuses(gnomon_rectangle_planes(map, nullptr, nullptr, planes, &field), "rectangle");
  refuses(gnomon_shader_block(plan, 0, 0, 0.0, nullptr, &field), "block");
  refuses(gnomon_shader_block(plan, 0, 0, kNan, nullptr, &field), "blur_texels");
  refuses(gnomon_measure(plan, &in.view, &in.scene, nullptr, nullptr, &field), "stats");
  refuses(gnomon_measure_points(map, &in.camera, nullptr, nullptr, 1, nullptr, &field), "points");
  refuses(gnomon_measure_points(map, nullptr, nullptr, nullptr, 0, nullptr, &field), "camera");
  refuses(gnomon_camera_from(nullptr, nullptr, nullptr, 1, 1, nullptr, nullptr, &field), "view_from_world");
  refuses(gnomon_perspective(nullptr, 1, 1, 1, 2, 1, 1, &field), "camera");
  refuses(gnomon_perspective(&in.camera, 60.0, 1, 1, 2, 1, 1, &field), "fov_y");
  refuses(gnomon_orthographic(&in.camera, kNan, 1, 1, 2, 1, 1, &field), "height_world");
  refuses(gnomon_visible_depths_add(nullptr, nullptr, 0, &field), "depths");
  gnomon_page_plan pages;
  gnomon_page_plan_default(&pages, sizeof pages);
  refuses(gnomon_plan_pages(&in.view, &in.light, &in.scene, nullptr, nullptr, nullptr, 0, &pages, &field),
          "memory");
  refuses(gnomon_plan_pages(&in.view, &in.light, &in.scene, nullptr, nullptr, planes, 160, &pages, &field),
          "bytes");
  refuses(gnomon_page_level(&pages, 0, map, &field), "page_plan.memory");
  refuses(gnomon_page_select(nullptr, nullptr, 0, nullptr, &field), "page_plan");
  gnomon_light_plan lights;
  gnomon_light_plan_default(&lights, sizeof lights);
  refuses(gnomon_plan_lights(&in.view, nullptr, sizeof(gnomon_light_request), 1, &in.scene, nullptr, nullptr,
                             nullptr, 0, &lights, &field),
          "requests");
  refuses(
      gnomon_plan_lights(&in.view, nullptr, 3, 0, &in.scene, nullptr, nullptr, nullptr, 0, &lights, &field),
      "request_size");
  refuses(gnomon_plan_lights(&in.view, nullptr, sizeof(gnomon_light_request), 0, &in.scene, nullptr, nullptr,
                             nullptr, 0, &lights, &field),
          "memory");
  refuses(gnomon_camera_round(&in.light, &in.camera, nullptr, &field), "round");
  EXPECT_EQ(gnomon_texture_from_clip(nullptr, nullptr), GNOMON_INVALID_INPUT);
  // These have nothing to name, and do nothing.
  gnomon_describe(nullptr, nullptr);
  gnomon_caster_set_destroy(nullptr);
  gnomon_history_destroy(nullptr);
  gnomon_history_clear(nullptr);
  gnomon_history_copy(nullptr, nullptr);
  gnomon_light_history_destroy(nullptr);
  gnomon_light_history_swap(nullptr, 0, 1);
  gnomon_light_history_forget(nullptr, 0);
  gnomon_visible_depths_clear(nullptr);
  EXPECT_EQ(gnomon_history_events(nullptr, nullptr, 0), 0);
  EXPECT_EQ(gnomon_light_history_create(-1), nullptr);
  EXPECT_EQ(gnomon_page_memory(0, 0), 0);
  EXPECT_EQ(gnomon_light_memory(GNOMON_MAX_LIGHTS + 1, 0), 0);
}

TEST(Abuse, random_bytes_in_any_struct_give_a_status_and_a_name) {
  std::mt19937_64 random(7);
  const auto spoil = [&](void* at, std::size_t bytes) {
    // A few numbers each: with more, nothing would get past the first check.
    for (int i = 0; i < 3; ++i) {
      const std::size_t place = 8 + 4 * (random() % ((bytes - 8) / 4));
      std::uint64_t value = random();
      if (random() % 2 == 0) value = random() % 16;
      std::memcpy(static_cast<unsigned char*>(at) + place, &value,
                  place + 8 <= bytes ? random() % 2 * 4 + 4 : 4);
    }
  };
  int refused = 0, planned = 0;
  for (int i = 0; i < 20000; ++i) {
    Good good;
    const auto which = random() % 4;
    if (which == 0) spoil(&good.in.camera, sizeof good.in.camera);
    if (which == 1) spoil(&good.in.light, sizeof good.in.light);
    if (which == 2) spoil(&good.in.options, sizeof good.in.options);
    const char* field = nullptr;
    const int32_t status = good.plan(&field);
    ASSERT_TRUE(status >= GNOMON_OK && status <= GNOMON_INVALID_INPUT);
    ASSERT_EQ(status == GNOMON_INVALID_INPUT, field != nullptr);
    if (status == GNOMON_INVALID_INPUT) {
      ASSERT_TRUE(is_named(field)) << field;
      ++refused;
    }
    if (status != GNOMON_OK) continue;
    ++planned;
    // A spoilt map, as a foreign one could be. The pointers of the plan are left alone.
    if (which == 3) spoil(good.out.maps, sizeof good.out.maps[0]);
    gnomon_stats stats;
    gnomon_stats_default(&stats, sizeof stats);
    gnomon_measure_options few;
    gnomon_measure_options_default(&few, sizeof few);
    few.columns = few.rows = few.depths = 3;
    if (gnomon_measure(&good.out.plan, &good.in.view, &good.in.scene, &few, &stats, &field) != GNOMON_OK) {
      ASSERT_TRUE(is_named(field)) << field;
    }
    std::uint32_t indices[1];
    int64_t found = 0;
    gnomon_cull(good.out.maps, good.in.scene.casters, 1, indices, 1, &found, &field);
    ASSERT_TRUE(found >= 0 && found <= 1);
    float block[GNOMON_SHADER_BLOCK_FLOATS];
    gnomon_shader_block(&good.out.plan, 0, 0, 0.0, block, &field);
    gnomon_reuse reuse;
    gnomon_compare(good.out.maps, good.out.maps, nullptr, &reuse, &field);
    int32_t index = 0;
    gnomon_select(&good.out.plan, good.points.data(), good.points.data(), 1, &index, &field);
    ASSERT_TRUE(index >= -1 && index < GNOMON_MAX_MAPS);
  }
  EXPECT_GT(refused, 2000);
  EXPECT_GT(planned, 2000);
}

}  // namespace
}  // namespace gnomon::test
