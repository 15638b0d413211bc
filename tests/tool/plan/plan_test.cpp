// `gnomon plan`: what it prints for good cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cases.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "gnomon/gnomon.hpp"
#include "gnomon/study/log_perspective.hpp"
#include "process.hpp"

namespace gnomon::test {
namespace {

std::vector<std::string> plan_arguments_for_all_cases() {
  std::vector<std::string> arguments{"plan"};
  for (const auto& file : case_files()) arguments.push_back(file.string());
  return arguments;
}

// Parsed from the program's text, against the doubles of the library itself: equal to the last bit.
void expect_same_matrix(const json& rows, const glm::dmat4& matrix) {
  ASSERT_EQ(rows.size(), 4u);
  for (int row = 0; row < 4; ++row) {
    ASSERT_EQ(rows[static_cast<std::size_t>(row)].size(), 4u);
    for (int column = 0; column < 4; ++column) {
      const json& value = rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
      ASSERT_TRUE(value.is_number());
      EXPECT_TRUE(std::isfinite(value.get<double>()));
      EXPECT_EQ(value.get<double>(), matrix[column][row]) << "row " << row << ", column " << column;
    }
  }
}

TEST(Plan, every_case_is_planned_in_order_with_matrices_that_read_back_exactly) {
  const auto files = case_files();
  ASSERT_GE(files.size(), 9u);
  const Finished finished = run_gnomon(plan_arguments_for_all_cases());
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_EQ(finished.err, "");
  const auto lines = finished.lines();
  ASSERT_EQ(lines.size(), files.size());
  for (std::size_t i = 0; i < files.size(); ++i) {
    SCOPED_TRACE(files[i]);
    const json printed = json::parse(lines[i]);
    const Case input = load_case(files[i]);
    const ShadowPlan plan = make_plan(input.camera, input.light, input.bounds(), input.options);
    EXPECT_EQ(printed["status"], "ok");
    ASSERT_GT(plan.map_count, 0);
    ASSERT_EQ(printed["maps"].size(), plan.maps().size());
    for (std::size_t k = 0; k < plan.maps().size(); ++k) {
      const json& map = printed["maps"][k];
      const ShadowMap& expected = plan.maps()[k];
      expect_same_matrix(map["clip_from_world"], expected.clip_from_world);
      EXPECT_EQ(map["depth_begin"].get<double>(), expected.depth_begin);
      EXPECT_EQ(map["depth_end"].get<double>(), expected.depth_end);
      EXPECT_EQ(map["size"], json({expected.width, expected.height}));
      EXPECT_EQ(map["warp"], expected.warp->name);
      EXPECT_EQ(map["kappa"].get<double>(), expected.kappa);
      EXPECT_EQ(map["cull_planes"].size(), static_cast<std::size_t>(expected.cull_plane_count));
      EXPECT_EQ(map["casters"], json::array({0}));
      for (const char* key : {"p50", "p95", "max"}) EXPECT_GT(map["m"][key].get<double>(), 0.0) << key;
    }
  }
}

TEST(Plan, has_the_keys_of_the_format_and_no_others) {
  const auto keys_of = [](const json& object) {
    std::vector<std::string> keys;
    for (const auto& [key, unused] : object.items()) keys.push_back(key);
    return keys;  // sorted: nlohmann::json keeps its keys so
  };
  const Finished finished = run_gnomon({"plan", case_files().front().string(), "--repeat", "3"});
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  const json plan = json::parse(finished.out);
  EXPECT_EQ(keys_of(plan), (std::vector<std::string>{"m", "maps", "omitted", "plan_ns", "status"}));
  EXPECT_EQ(keys_of(plan["m"]), (std::vector<std::string>{"max", "p50", "p95", "storage"}));
  EXPECT_EQ(
      keys_of(plan["maps"][0]),
      (std::vector<std::string>{"bias_world", "cascade", "casters", "clip_from_world", "cull_planes",
                                "depth_begin", "depth_end", "filter_margin_texels", "kappa", "m",
                                "select_planes", "size", "snap_depth", "snap_key", "texel_world", "warp"}));
  ASSERT_FALSE(plan["omitted"].empty());
  EXPECT_EQ(keys_of(plan["omitted"][0]), (std::vector<std::string>{"saves_texels", "what", "why"}));
}

TEST(Plan, reads_one_case_per_line_of_standard_input) {
  const std::string small = base_case_with("/options", {{"map_size", 64}, {"cascades", 1}}).dump();
  const std::string large = base_case_with("/options", {{"map_size", 128}, {"cascades", 1}}).dump();
  // Blank lines between, a carriage return, and no newline at the end.
  const Finished finished = run_gnomon({"plan", "-"}, small + "\n\n  \n" + large + "\r\n" + small);
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  std::vector<int> sizes;
  for (const std::string& line : finished.lines()) sizes.push_back(json::parse(line)["maps"][0]["size"][0]);
  EXPECT_EQ(sizes, (std::vector<int>{64, 128, 64}));
}

TEST(Plan, takes_files_and_standard_input_together_in_the_order_given) {
  const TemporaryFolder folder;
  const auto sized = [](int size) {
    return base_case_with("/options", {{"map_size", size}, {"cascades", 1}}).dump();
  };
  const Finished finished =
      run_gnomon({"plan", folder.write("a.json", sized(32)), "-", folder.write("b.json", sized(16)), "-"},
                 sized(8) + "\n" + sized(4));
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  std::vector<int> sizes;
  for (const std::string& line : finished.lines()) sizes.push_back(json::parse(line)["maps"][0]["size"][0]);
  EXPECT_EQ(sizes, (std::vector<int>{32, 8, 4, 16}));
}

TEST(Plan, of_no_input_at_all_is_no_plan) {
  const Finished finished = run_gnomon({"plan", "-"}, "");
  EXPECT_EQ(finished.exit_code, 0);
  EXPECT_EQ(finished.out, "");
}

TEST(Plan, pretty_holds_the_same_values) {
  const std::string file = case_files().front().string();
  const Finished plain = run_gnomon({"plan", file});
  const Finished pretty = run_gnomon({"plan", "--pretty", file});
  ASSERT_EQ(plain.exit_code, 0) << plain.err;
  ASSERT_EQ(pretty.exit_code, 0) << pretty.err;
  EXPECT_EQ(plain.lines().size(), 1u);
  EXPECT_GT(pretty.lines().size(), 10u);
  EXPECT_EQ(json::parse(plain.out), json::parse(pretty.out));
}

TEST(Plan, is_the_same_text_every_time) {
  const auto arguments = plan_arguments_for_all_cases();
  EXPECT_EQ(run_gnomon(arguments).out, run_gnomon(arguments).out);
}

TEST(Plan, repeat_prints_times_and_that_no_plan_allocated_memory) {
  auto arguments = plan_arguments_for_all_cases();
  arguments.insert(arguments.end(), {"--repeat", "50"});
  const Finished finished = run_gnomon(arguments);
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  ASSERT_FALSE(finished.lines().empty());
  for (const std::string& line : finished.lines()) {
    const json time = json::parse(line)["plan_ns"];
    EXPECT_GT(time["min"].get<double>(), 0.0);
    EXPECT_LE(time["min"].get<double>(), time["median"].get<double>());
    EXPECT_LE(time["median"].get<double>(), time["p99"].get<double>());
    EXPECT_EQ(time["allocations"].get<int>(), 0);
  }
}

TEST(Plan, of_a_scene_out_of_view_says_so_and_is_no_error) {
  const json elsewhere{{"min", {-10, 0, 500}}, {"max", {10, 1, 600}}};
  const Finished finished = run_gnomon({"plan", "-"}, base_case_with("/receivers", elsewhere).dump());
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  const json plan = json::parse(finished.out);
  EXPECT_EQ(plan["status"], "nothing_visible");
  EXPECT_FALSE(plan["reason"].get<std::string>().empty());
  EXPECT_TRUE(plan["maps"].empty());
  EXPECT_EQ(plan["m"]["max"].get<double>(), 0.0);
}

TEST(Plan, of_no_boxes_at_all_is_no_error) {
  for (const char* list : {"/receivers", "/casters"}) {
    const Finished finished = run_gnomon({"plan", "-"}, base_case_with(list, json::array()).dump());
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_NE(json::parse(finished.out)["status"], "ok") << list;
  }
}

TEST(Plan, lists_the_casters_a_map_needs_by_index) {
  // The second box stands behind the floor as the light sees it: it can shadow nothing in view.
  const json boxes = json::parse(R"([{"min": [-1, 0, -1], "max": [1, 3, 1]},
                                     {"min": [-1, -9, -1], "max": [1, -5, 1]},
                                     {"min": [3, 0, -1], "max": [4, 2, 1]}])");
  json input = base_case_with("/casters", boxes);
  input["options"] = {{"cascades", 1}};
  const Finished finished = run_gnomon({"plan", "-"}, input.dump());
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_EQ(json::parse(finished.out)["maps"][0]["casters"], json::array({0, 2}));
}

TEST(Plan, logpsm_adds_the_numbers_of_one_logarithmic_perspective_map_on_request) {
  const auto files = case_files();
  const Finished finished = run_gnomon({"plan", files.front().string(), "--logpsm"});
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  const json printed = json::parse(finished.lines().at(0));
  const Case input = load_case(files.front());
  const LogPerspectiveMap map = log_perspective_map(input.camera, std::get<DirectionalLight>(input.light),
                                                    input.bounds(), input.options.resolution.max_size);
  const AliasingStats stats = measure(map, input.camera, input.bounds());
  EXPECT_EQ(printed["logpsm"]["storage"].get<double>(), stats.storage);
  EXPECT_EQ(printed["logpsm"]["p95"].get<double>(), stats.p95);
}

/// A street with two visible points, as text.
std::string pages_case(const std::string& pages, const std::string& rest) {
  return R"({"camera": {"position": [0,5,0], "forward": [0,-0.1,-1], "up": [0,1,0], "fov_y_deg": 60,
    "aspect": 1.5, "near": 0.5, "far": 250, "width": 960, "height": 640},
    "light": {"type": "directional", "direction": [0.3,-1,0.2]},
    "receivers": {"min": [-20,-1,-200], "max": [20,30,-1]}, "casters": {"min": [-20,-1,-200], "max": [20,30,-1]},
    "options": {"pages": )" +
         pages + "}" + rest + "}";
}

/// Runs the case through standard input.
Finished plan_of(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return run_gnomon({"plan", "-"}, text + "\n");
}

TEST(PlanPages, the_case_format_holds_and_every_point_is_served_by_its_last_level) {
  const Finished finished =
      plan_of(pages_case(R"({"policy": "resolution", "page_texels": 64, "capacity": 512, "target_m": 1})",
                         R"(, "seen": [[0,0,-20], [3,0,-90], [-4,2,-30]])"));
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  const json plan = json::parse(finished.lines().at(0));
  EXPECT_EQ(plan["status"], "ok");
  EXPECT_EQ(plan["page_texels"], 64);
  ASSERT_EQ(plan["pages"].size(), 3u);
  EXPECT_LE(plan["m"]["side_max"].get<double>(), 1.0 + 1e-6);
  // As architecture says: column and row from ndc (-1, -1), the last level with a resident page.
  const double points[3][3] = {{0, 0, -20}, {3, 0, -90}, {-4, 2, -30}};
  for (const auto& p : points) {
    int served = 0;
    for (const json& page : plan["pages"]) {
      const json& level = plan["levels"][page[0].get<std::size_t>()];
      double clip[4];
      for (std::size_t row = 0; row < 4; ++row) {
        const json& r = level["clip_from_world"][row];
        clip[row] = r[0].get<double>() * p[0] + r[1].get<double>() * p[1] + r[2].get<double>() * p[2] +
                    r[3].get<double>();
      }
      int cell[2];
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const double texels = level["size"][axis].get<double>();
        cell[axis] = static_cast<int>((0.5 * clip[axis] / clip[3] + 0.5) * texels / 64.0);
      }
      served += cell[0] == page[1].get<int>() && cell[1] == page[2].get<int>();
    }
    EXPECT_EQ(served, 1);
  }
}

TEST(PlanPages, bad_pages_and_points_are_one_line_that_names_the_key) {
  struct Entry {
    const char *pages, *rest, *message;
  };
  const Entry entries[] = {
      {R"({"capacity": 0})", "", "options.pages.capacity: must lie in"},
      {R"({"page_texels": 100})", "", "options.pages.page_texels: must be 64, 128 or 256"},
      {R"({"page_texels": 128, "virtual_texels": 64})", "", "options.pages.page_texels: must be"},
      {R"({"policy": "edgse"})", "", "options.pages.policy: is \"edgse\""},
      {R"({"size": 3})", "", "options.pages.size: unknown key"},
      {"{}", R"(, "seen": [[1,2]])", "seen[0]: needs three numbers"},
      {"{}", R"(, "seen": [[1,2,3],[1,2,3,0,1,0]])", "seen[1]: has a normal"},
      {"{}", R"(, "seen": [[1,2,null]])", "seen[0][2]: needs a number"},
      {"{}", R"(, "seen": [[1,2,1e31]])", "seen: a point is beyond"},
      {"{}", R"(, "seen": [[1,2,3,0,0,0]])", "seen: a normal is not of length 1"},
      {"{}", R"(, "seen": [[1,2,3]], "seen_feedback": [8])", "seen_feedback: needs sums"},
      {"{}", R"(, "seen": [[1,2,3]], "seen_feedback": [1, 2])", "seen_feedback: needs one number"}};
  for (const Entry& entry : entries) {
    const Finished finished = plan_of(pages_case(entry.pages, entry.rest));
    EXPECT_EQ(finished.exit_code, 2) << entry.message;
    EXPECT_NE(finished.err.find(entry.message), std::string::npos) << finished.err;
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
    EXPECT_EQ(finished.out, "");
  }
}

TEST(PlanPages, repeats_are_timed_and_allocate_nothing) {
  std::string text = pages_case("{}", R"(, "seen": [[0,0,-20], [3,0,-90]])");
  std::replace(text.begin(), text.end(), '\n', ' ');
  const Finished finished = run_gnomon({"plan", "--repeat", "20", "-"}, text + "\n");
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  const json timing = json::parse(finished.lines().at(0))["plan_ns"];
  EXPECT_EQ(timing["allocations"], 0);
  EXPECT_GT(timing["median"].get<double>(), 0.0);
}

std::string lights_case(const std::string& lights, const std::string& rest = "") {
  return R"({"camera": {"position": [0,5,20], "forward": [0,-0.2,-1], "up": [0,1,0], "fov_y_deg": 60,
    "aspect": 1.5, "near": 0.1, "far": 100, "width": 960, "height": 640}, "lights": )" +
         lights +
         R"(, "receivers": [{"min": [-50,-1,-50], "max": [50,0,50]}, {"min": [-1,0,-1], "max": [1,3,1]}],
    "casters": [{"min": [-1,0,-1], "max": [1,3,1]}])" +
         rest + "}";
}
const char* const kThreeLights = R"([{"type": "point", "position": [0,5,3], "range": 15, "weight": 2},
  {"type": "spot", "position": [4,6,0], "direction": [-0.5,-1,0], "outer_deg": 35, "range": 20},
  {"type": "point", "position": [0,5,60], "range": 5}])";

TEST(PlanLights, prints_sizes_places_and_reasons_by_light) {
  const Finished finished =
      plan_of(lights_case(kThreeLights, R"(, "options": {"lights": {"pool_width": 2048}})"));
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  const json plan = json::parse(finished.lines().at(0));
  EXPECT_EQ(plan["status"], "ok");
  EXPECT_EQ(plan["pool"], json({2048, 4096}));
  ASSERT_EQ(plan["lights"].size(), 3u);
  std::int64_t texels = 0;
  for (const json& light : plan["lights"]) {
    for (const json& place : light["places"]) {
      EXPECT_EQ(place[2], light["size"]);
      texels += place[2].get<std::int64_t>() * place[3].get<std::int64_t>();
    }
  }
  EXPECT_EQ(texels, plan["texels"].get<std::int64_t>());
  EXPECT_GT(plan["lights"][0]["places"].size(), 1u);
  EXPECT_EQ(plan["lights"][1]["places"].size(), 1u);
  EXPECT_EQ(plan["lights"][2]["outcome"], "without_receiver");
  EXPECT_EQ(plan["lights"][2]["why"], "the light lights no receiver in view");
}

TEST(PlanLights, budgets_of_pages_and_milliseconds_are_read_and_kept) {
  const auto plan_with = [](const std::string& options) {
    const Finished finished =
        plan_of(lights_case(kThreeLights, R"(, "options": {"lights": {)" + options + "}}"));
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    return json::parse(finished.lines().at(0));
  };
  const json pages = plan_with(R"("page_budget": 40, "page_texels": 128)");
  EXPECT_LE(pages["pages"].get<int>(), 40);
  EXPECT_EQ(pages["pages"].get<int>() * 128 * 128, pages["texels"].get<std::int64_t>());
  const std::string costs = R"("costs": {"per_map": 0.01, "per_megatexel": 1.0})";
  const json free = plan_with(costs), timed = plan_with(R"("millisecond_budget": 0.5, )" + costs);
  EXPECT_GT(free["milliseconds"].get<double>(), 0.5);
  EXPECT_LE(timed["milliseconds"].get<double>(), 0.5);
  EXPECT_LT(timed["texels"].get<std::int64_t>(), free["texels"].get<std::int64_t>());
}

TEST(PlanLights, bad_lights_are_one_line_that_names_the_key) {
  struct Entry {
    const char *lights, *rest, *message;
  };
  const Entry entries[] = {
      {"[]", "", "lights: needs a list of lights"},
      {"3", "", "lights: needs a list of lights"},
      {R"([{"type": "point", "position": [0,1,0], "range": 0}])", "", "lights[0].range: must be above 0"},
      {R"([{"type": "point", "position": [0,1,0], "range": 1, "wieght": 1}])", "",
       "lights[0].wieght: unknown key"},
      {R"([{"type": "point", "position": [0,1,0], "range": 1, "weight": "a"}])", "",
       "lights[0].weight: needs"},
      {R"([{"type": "point", "position": [0,1,0], "range": 1, "weight": -1}])", "",
       "lights[0].weight: must lie"},
      {kThreeLights, R"(, "light": {"type": "directional", "direction": [0,-1,0]})",
       "lights: stands in place"},
      {kThreeLights, R"(, "options": {"pages": {}})", "options.pages: are of one light"},
      {kThreeLights, R"(, "options": {"lights": {"size": 1}})", "options.lights.size: unknown key"},
      {kThreeLights, R"(, "options": {"lights": {"most_size": 1000}})", "options.lights.most_size: must be"},
      {kThreeLights, R"(, "options": {"lights": {"pool_width": 1000}})",
       "options.lights.pool_width, pool_height"},
      {kThreeLights, R"(, "options": {"lights": {"texel_budget": 0}})",
       "options.lights.texel_budget: is too"},
      {kThreeLights, R"(, "options": {"lights": {"page_budget": 1}})", "options.lights.page_budget: is too"},
      {kThreeLights, R"(, "options": {"lights": {"page_budget": 64, "page_texels": 100}})",
       "options.lights.page_texels: must be a power of two"},
      {kThreeLights, R"(, "options": {"lights": {"millisecond_budget": 0.1, "costs": {"per_map": 5}}})",
       "options.lights.millisecond_budget: is too"},
      {kThreeLights, R"(, "options": {"lights": {"costs": {"per_map": -5}}})",
       "options.lights.costs: must lie"},
      {kThreeLights, R"(, "options": {"lights": {"costs": {"per_page": 5}}})",
       "options.lights.costs.per_page: unknown key"},
      {R"([{"type": "point", "position": [0,1,0], "range": 1, "draws": -1}])", "",
       "lights[0].draws: must lie"}};
  for (const Entry& entry : entries) {
    const Finished finished = plan_of(lights_case(entry.lights, entry.rest));
    EXPECT_EQ(finished.exit_code, 2) << entry.message;
    EXPECT_NE(finished.err.find(entry.message), std::string::npos) << finished.err;
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
    EXPECT_EQ(finished.out, "");
  }
}

TEST(PlanLights, repeats_are_timed_and_allocate_nothing) {
  std::string text = lights_case(kThreeLights, R"(, "seen": [[0,0,0], [3,0,-9]])");
  std::replace(text.begin(), text.end(), '\n', ' ');
  const Finished finished = run_gnomon({"plan", "--repeat", "20", "-"}, text + "\n");
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_EQ(json::parse(finished.lines().at(0))["plan_ns"]["allocations"], 0);
}

}  // namespace
}  // namespace gnomon::test
