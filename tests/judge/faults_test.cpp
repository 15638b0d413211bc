// Is each fault that is planted in a capture of a real engine named by its own sentence?
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>

#include "captures.hpp"

namespace gnomon::judge::test {
namespace {

struct Fault {
  std::string name, capture;
  void (*plant)(Json& capture);
  std::string kind;
};

void each_map(Json& c, const char* key, const Json& value, int only = -1) {
  for_each_map(c, [&](Json& map, std::size_t index) {
    if (only < 0 || index == static_cast<std::size_t>(only)) map[key] = value;
  });
}
void each_light(Json& c, const char* key, const Json& value) {
  if (c.contains("lights")) c["lights"][0][key] = value;
  if (!c.contains("frames")) return;
  for (Json& frame : c["frames"]) frame["lights"][0][key] = value;
}
/// Moves the world: cameras, maps and boxes, as an engine far from the origin has them.
void move_world(Json& c, const glm::dvec3& by) {
  const glm::dmat4 back = glm::translate(glm::dmat4(1.0), -by);
  for_each_map(c, [&](Json& map, std::size_t) {
    map["clip_from_world"] = numbers(matrix(map["clip_from_world"]) * back);
  });
  for (Json& frame : c["frames"])
    frame["camera"]["view_from_world"] = numbers(matrix(frame["camera"]["view_from_world"]) * back);
  for (const char* list : {"receivers", "casters"}) {
    for (Json& box : c[list]) {
      for (std::size_t i = 0; i < 3; ++i) {
        for (const char* end : {"min", "max"})
          box[end][i] = box[end][i].get<double>() + by[static_cast<int>(i)];
      }
    }
  }
}
void shift_each_frame(Json& c, double texels) {
  double sum = 0.0;
  for (Json& frame : c["frames"]) {
    for (Json& map : frame["maps"]) {
      glm::dmat4 shift(1.0);
      shift[3][0] = sum * 2.0 / map["width"].get<double>();
      map["clip_from_world"] = numbers(shift * matrix(map["clip_from_world"]));
    }
    sum += texels;
  }
}

/// Sixty units above the street: Babylon's maps begin some 36 units along the light above it.
void plant_crane(Json& c) {
  c["casters"].push_back({{"min", {-300, 60, -100}}, {"max", {300, 65, 400}}});
  each_map(c, "clamps_depth", false);
}

const std::vector<Fault> kFaults = {
    {"all matrices transposed", "three_csm",
     [](Json& c) {
       for_each_map(c, [](Json& map, std::size_t) {
         map["clip_from_world"] = numbers(glm::transpose(matrix(map["clip_from_world"])));
       });
     },
     "transposed"},
    {"one matrix transposed", "three_sunlight",
     [](Json& c) {
       for_each_map(c, [](Json& map, std::size_t i) {
         if (i == 1) map["clip_from_world"] = numbers(glm::transpose(matrix(map["clip_from_world"])));
       });
     },
     "transposed"},
    {"a spot's light of another frame", "three_spot",
     [](Json& c) {
       each_light(c, "position", {6.0, 9.0, -20.0});
     },
     "light_direction"},
    {"a sun's light of another frame", "three_csm",
     [](Json& c) {
       each_light(c, "direction", {0.6, -1.0, -0.2});
     },
     "light_direction"},
    {"z of the light negated, as from the other hand", "babylon_stabilized",
     [](Json& c) {
       each_light(c, "direction", {0.5, -1.0, -0.35});
     },
     "light_direction"},
    {"the map looks at the light from below", "ogre_pssm",
     [](Json& c) {
       each_light(c, "direction", {-0.6123724356957946, 0.7071067811865475, 0.35355339059327384});
     },
     "light_direction"},
    {"reversed depth that the engine has not", "three_sunlight",
     [](Json& c) {
       c["clip_space"]["reversed_z"] = true;
       c["camera_clip_space"] = Json::object();
     },
     "depth_reversed"},
    {"depth turned round without saying so", "babylon_stabilized",
     [](Json& c) { transform_maps(c, scaled(1, 1, -1)); }, "depth_reversed"},
    {"x of the light's view negated", "three_csm", [](Json& c) { transform_maps(c, scaled(-1, 1, 1)); },
     "mirrored"},
    {"x of the light's view negated, left-handed", "babylon_stabilized",
     [](Json& c) { transform_maps(c, scaled(-1, 1, 1)); }, "mirrored"},
    {"y downwards that the engine has not", "ogre_pssm",
     [](Json& c) {
       c["clip_space"]["y_down"] = true;
       c["camera_clip_space"] = Json::object();
     },
     "mirrored"},
    {"matrices that lead to textures", "three_csm",
     [](Json& c) {
       glm::dmat4 texture = scaled(0.5, 0.5, 0.5, 0.5);
       texture[3][0] = texture[3][1] = 0.5;
       transform_maps(c, texture);
     },
     "texture_space"},
    {"a spot's matrix transposed", "three_spot",
     [](Json& c) {
       for_each_map(c, [](Json& map, std::size_t) {
         map["clip_from_world"] = numbers(glm::transpose(matrix(map["clip_from_world"])));
       });
     },
     "transposed"},
    {"the first cascade begins too late", "babylon_stabilized",
     [](Json& c) {
       for (Json& frame : c["frames"]) frame["maps"][0]["depths"][0] = 20.0;
     },
     "gap_between_maps"},
    {"depths of clip space in place of the view's", "three_csm",
     [](Json& c) {
       for (Json& frame : c["frames"]) {
         for (std::size_t i = 0; i < frame["maps"].size(); ++i)
           frame["maps"][i]["depths"] = {0.25 * static_cast<double>(i), 0.25 * static_cast<double>(i + 1)};
       }
     },
     "gap_between_maps"},
    {"a matrix of OpenGL's depths for an API of 0 to 1", "three_csm",
     [](Json& c) {
       c["clip_space"]["ndc_depth"] = "zero_to_one";
       c["camera_clip_space"] = Json::object();
     },
     "depth_convention"},
    {"a spot's map that is narrower than its cone", "three_spot",
     [](Json& c) { transform_maps(c, scaled(2, 2, 1)); }, "receivers_outside"},
    {"maps that are an eighth as wide as the view", "three_sunlight",
     [](Json& c) { transform_maps(c, scaled(8, 8, 1)); }, "receivers_outside"},
    {"a far plane that cuts the ground off", "babylon_stabilized",
     [](Json& c) { transform_maps(c, scaled(1, 1, 2.5, 1.5)); }, "receivers_cut"},
    {"near planes that cut the nearer half off", "three_csm",
     [](Json& c) { transform_maps(c, scaled(1, 1, 1, -0.75)); }, "receivers_cut"},
    {"a cloud above the near plane", "three_csm",
     [](Json& c) {
       c["casters"].push_back({{"min", {-2000, 600, -2000}}, {"max", {2000, 601, 2000}}});
     },
     "casters_cut"},
    {"a crane above the near plane", "babylon_stabilized", plant_crane, "casters_cut"},
    {"depths of two cascades exchanged", "three_csm",
     [](Json& c) {
       for (Json& frame : c["frames"]) std::swap(frame["maps"][0]["depths"], frame["maps"][2]["depths"]);
     },
     "selection_disagrees"},
    {"a first cascade that is fitted to half of its depths", "babylon_stabilized",
     [](Json& c) { transform_maps(c, scaled(2.5, 2.5, 1), 0); }, "selection_disagrees"},
    {"a cascade begins late", "three_csm",
     [](Json& c) {
       for (Json& frame : c["frames"])
         frame["maps"][1]["depths"][0] = frame["maps"][1]["depths"][0].get<double>() + 6.0;
     },
     "gap_between_maps"},
    {"a cascade ends early", "babylon_stabilized",
     [](Json& c) {
       for (Json& frame : c["frames"])
         frame["maps"][0]["depths"][1] = frame["maps"][0]["depths"][1].get<double>() - 8.0;
     },
     "gap_between_maps"},
    {"a far cascade of a few texels", "three_csm",
     [](Json& c) {
       each_map(c, "width", 128, 2);
       each_map(c, "height", 128, 2);
     },
     "density_step"},
    {"a cascade beyond all that is seen", "three_sunlight",
     [](Json& c) {
       for (Json& frame : c["frames"]) {
         Json map = frame["maps"][1];
         map["depths"] = {250.0, 900.0};
         frame["maps"].push_back(map);
       }
     },
     "map_unseen"},
    {"maps fitted to the whole world", "three_csm", [](Json& c) { transform_maps(c, scaled(0.06, 0.06, 1)); },
     "texels_unseen"},
    {"one map fitted to the whole world", "ogre_pssm",
     [](Json& c) { transform_maps(c, scaled(0.05, 0.05, 1), 2); }, "texels_unseen"},
    {"two maps in one corner of the atlas", "three_csm",
     [](Json& c) {
       c["atlas"] = {2048, 2048};
       each_map(c, "atlas", {0, 0, 1024, 1024});
     },
     "atlas_overlap"},
    {"a map half out of the atlas", "three_spot",
     [](Json& c) {
       c["atlas"] = {2048, 1024};
       each_map(c, "atlas", {1536, 0, 1024, 1024});
     },
     "atlas_outside"},
    {"a wide kernel in a map without a margin", "three_spot",
     [](Json& c) { each_map(c, "filter_texels", 150); }, "filter_leaves_map"},
    {"a world far from the origin", "three_csm",
     [](Json& c) {
       move_world(c, {4e6, 0.0, -3e6});
     },
     "matrix_precision"},
    {"sixteen bits over a range of kilometres", "babylon_stabilized",
     [](Json& c) {
       transform_maps(c, scaled(1, 1, 0.01));
       each_map(c, "depth_bits", 16);
     },
     "depth_precision"},
    {"no bias at all", "ogre_pssm", [](Json& c) { each_map(c, "bias", Json::object()); }, "bias_small"},
    {"a bias for another engine's units", "babylon_stabilized",
     [](Json& c) {
       each_map(c, "bias", {{"depth", 0.00005}});
     },
     "bias_small"},
    {"a bias of three metres", "babylon_stabilized",
     [](Json& c) {
       each_map(c, "bias", {{"world", 3.0}});
     },
     "bias_large"},
    {"a normal offset for a scene in centimetres", "three_spot",
     [](Json& c) {
       each_map(c, "stores", "front");
       each_map(c, "bias", {{"normal_world", 2.0}});
     },
     "bias_large"},
    {"cascades that follow the view", "babylon_cascades", [](Json&) {}, "swimming"},
    {"a third of a texel from frame to frame", "three_csm", [](Json& c) { shift_each_frame(c, 0.31); },
     "swimming"},
    {"maps that breathe", "three_sunlight",
     [](Json& c) {
       for (std::size_t f = 0; f < c["frames"].size(); f += 2) {
         for (Json& map : c["frames"][f]["maps"])
           map["clip_from_world"] = numbers(scaled(0.9, 0.9, 1) * matrix(map["clip_from_world"]));
       }
     },
     "density_jump"},
};

TEST(PlantedFaults, are_each_named_by_their_own_sentence) {
  ASSERT_GE(kFaults.size(), 30u);
  for (const Fault& fault : kFaults) {
    Json capture = sound(fault.capture);
    fault.plant(capture);
    const Judgement judgement = judged(capture);
    EXPECT_THAT(kinds(judgement), testing::Contains(fault.kind)) << fault.capture << ": " << fault.name;
  }
}

TEST(PlantedFaults, of_a_matrix_hide_what_follows_from_them) {
  Json capture = sound("three_csm");
  for_each_map(capture, [](Json& map, std::size_t) {
    map["clip_from_world"] = numbers(glm::transpose(matrix(map["clip_from_world"])));
  });
  EXPECT_THAT(kinds(judged(capture)), testing::ElementsAre("transposed"));
  capture = sound("three_sunlight");
  each_light(capture, "direction", {0.6, -1.0, -0.2});
  EXPECT_THAT(kinds(judged(capture)), testing::ElementsAre("light_direction"));
}

TEST(PlantedFaults, every_kind_of_finding_is_planted) {
  for (std::size_t kind = 0; kind < kFindingKinds; ++kind) {
    const std::string_view name = to_string(static_cast<FindingKind>(kind));
    EXPECT_TRUE(std::any_of(kFaults.begin(), kFaults.end(), [&](const Fault& f) { return f.kind == name; }))
        << name;
  }
}

TEST(Findings, have_the_size_of_what_was_planted) {
  Json capture = sound("three_csm");
  shift_each_frame(capture, 0.31);
  Judgement judgement = judged(capture);
  ASSERT_EQ(judgement.findings.size(), 1u);
  EXPECT_NEAR(judgement.findings[0].size, 0.31, 0.01);
  EXPECT_EQ(judgement.findings[0].frames, 7);

  capture = sound("babylon_stabilized");
  each_light(capture, "direction", {0.5 + 0.1, -1.0, 0.35});
  judgement = judged(capture);
  ASSERT_FALSE(judgement.findings.empty());
  // The angle between both directions.
  const glm::dvec3 a = glm::normalize(glm::dvec3(0.5, -1.0, 0.35)),
                   b = glm::normalize(glm::dvec3(0.6, -1.0, 0.35));
  EXPECT_NEAR(judgement.findings[0].size, glm::degrees(std::acos(glm::dot(a, b))), 0.01);

  // Everything lit by the ground lies under it.
  capture = sound("babylon_stabilized");
  plant_crane(capture);
  judgement = judged(capture);
  ASSERT_FALSE(judgement.findings.empty());
  EXPECT_EQ(judgement.findings[0].kind, FindingKind::casters_cut);
  EXPECT_GT(judgement.findings[0].size, 0.9);
}

}  // namespace
}  // namespace gnomon::judge::test
