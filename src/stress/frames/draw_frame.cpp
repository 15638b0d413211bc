// Random frames: a scene, a view of it, a light, and a way to draw it, as JSON.
#include "draw_frame.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <string>
#include <vector>

#include "dice.hpp"
#include "frame_scene.hpp"
#include "gnomon/pages.hpp"
#include "gnomon/render/depth_layer.hpp"
#include "gnomon/render/filter.hpp"
#include "gnomon/render/page_filter.hpp"

namespace gnomon::stress {
namespace {

using Json = nlohmann::ordered_json;

/// The ground reaches so far from the middle; objects stand on the inner half. Times the scale.
constexpr double kGround = 12.0;

Json list(const glm::dvec3& v) {
  return Json::array({v.x, v.y, v.z});
}

/// The units of the scene, and where it lies.
struct World {
  double scale = 1.0;
  glm::dvec3 origin{0.0};
  [[nodiscard]] glm::dvec3 place(const glm::dvec3& p) const { return origin + scale * p; }
};

Json draw_object(Dice& dice, bool flat) {
  // Boxes and plates as often as all others together: they are what shadows are decided by.
  const auto kind = static_cast<ObjectKind>(dice.chance(0.4) ? dice.pick(2) : dice.pick(kObjectKinds));
  Json object{{"kind", to_string(kind)}};
  const double height = dice.chance(0.3) ? 0.0 : dice.between(0.2, 5.0);
  object["at"] = list({dice.between(-5.0, 5.0), height, dice.between(-5.0, 5.0)});
  glm::dvec3 size{dice.power(-1.0, 1.8), dice.power(-1.5, 1.2), dice.power(-1.0, 1.8)};
  if (dice.chance(0.15)) size[dice.pick(3)] = dice.power(-8.0, -4.0);  // thin
  if (dice.chance(0.2)) size[dice.pick(3)] *= -1.0;                    // a mirror image
  object["size"] = list(size);
  if (!flat && dice.chance(0.6)) {
    const glm::dvec3 axis = dice.direction();
    object["turn"] = Json::array({axis.x, axis.y, axis.z, dice.between(-1.5, 1.5)});
  }
  if (kind == ObjectKind::fence) {
    const double offset = dice.between(-2.0, 2.0), across = dice.sign() * dice.power(-1.0, 2.0);
    object["texture"] =
        Json::array({offset, dice.unit(), across, dice.power(-1.0, 2.0), dice.between(-3.0, 3.0)});
  }
  if (kind == ObjectKind::pane)
    object["color"] = Json::array({dice.unit(), dice.unit(), dice.unit(), dice.between(0.1, 0.95)});
  if (kind == ObjectKind::soup || kind == ObjectKind::sliver) object["count"] = 1 + dice.pick(24);
  object["seed"] = dice.pick(1 << 20);
  if (dice.chance(0.1)) object["casts"] = false;
  if (dice.chance(0.1)) object["receives"] = false;
  return object;
}

Json draw_objects(Dice& dice, bool flat) {
  Json objects = Json::array();
  const double rise = flat || dice.chance(0.7) ? 0.0 : dice.between(-0.15, 0.15);
  objects.push_back(
      {{"kind", "plate"}, {"size", {kGround, 1.0, kGround}}, {"turn", {rise, 0.0, 0.5 * rise, 1.0}}});
  const int count = 1 + dice.pick(dice.chance(0.8) ? 9 : 20);
  for (int i = 0; i < count; ++i) objects.push_back(draw_object(dice, flat));
  return objects;
}

Json draw_view(Dice& dice, const World& world, Stage& s) {
  const glm::dvec3 target{dice.between(-3.0, 3.0), dice.between(0.0, 2.0), dice.between(-3.0, 3.0)};
  glm::dvec3 away = dice.direction();
  away.y = std::abs(away.y) + (dice.chance(0.2) ? 0.0 : 0.25);
  const double far_off = dice.chance(0.08) ? dice.power(3.0, 9.0) : 1.0;  // through a telescope
  const glm::dvec3 eye = target + away * (far_off * dice.power(1.0, 3.7));
  s.near_depth = world.scale * dice.power(-5.0, -0.5) * far_off;
  s.far_depth = world.scale * dice.power(4.5, 6.5) * far_off;
  s.eye = world.place(eye);
  s.forward = glm::normalize(target - eye);
  s.right = glm::normalize(glm::cross(s.forward, glm::dvec3(0.1, 1.0, 0.05)));
  s.up = glm::cross(s.right, s.forward);
  const int width = 48 + dice.pick(80), height = 36 + dice.pick(60);
  const double aspect = static_cast<double>(width) / height;
  Json camera{{"position", list(s.eye)}, {"forward", list(s.forward)}, {"up", {0.0, 1.0, 0.0}}};
  s.orthographic = dice.chance(0.15);
  if (s.orthographic) {
    const double tall = world.scale * dice.power(1.5, 4.0);
    camera["height_world"] = tall;
    s.top = 0.5 * tall;
  } else {
    const double degrees = dice.between(20.0, 100.0) / far_off;
    camera["fov_y_deg"] = degrees;
    s.top = std::tan(degrees * 0.008726646259971648);
  }
  s.bottom = -s.top;
  s.right_edge = s.top * aspect;
  s.left = -s.right_edge;
  camera["aspect"] = aspect;
  camera["near"] = s.near_depth;
  camera["far"] = s.far_depth;
  camera["width"] = width;
  camera["height"] = height;
  return camera;
}

Json draw_lamp(Dice& dice, const World& world, Stage& s, bool flat) {
  const int kind = dice.pick(10);
  if (kind < 5 || flat) {
    glm::dvec3 way = dice.direction();
    way.y = -std::abs(way.y) - (dice.chance(0.3) ? 0.0 : 0.4);
    if (flat || dice.chance(0.1)) way = {0.0, -1.0, 0.0};
    s.light = glm::normalize(way);
    return {{"type", "directional"}, {"direction", list(way)}};
  }
  s.parallel = false;
  const glm::dvec3 at{dice.between(-7.0, 7.0), dice.between(1.0, 9.0), dice.between(-7.0, 7.0)};
  s.light = world.place(at);
  s.range = world.scale * dice.power(3.0, 6.0);
  Json light{{"type", kind < 8 ? "spot" : "point"}, {"position", list(s.light)}};
  if (kind < 8) {
    const glm::dvec3 target{dice.between(-3.0, 3.0), 0.0, dice.between(-3.0, 3.0)};
    light["direction"] = list(target - at);
    light["outer_deg"] = dice.chance(0.15) ? dice.between(80.0, 150.0) : dice.between(15.0, 75.0);
  }
  light["range"] = s.range;
  return light;
}

/// A filter with a kernel that leaves something of a small map; those that store texels in any format.
std::string draw_filter(Dice& dice, bool of_pool, bool of_lights) {
  std::vector<const render::Filter*> all(render::all_filters().begin(), render::all_filters().end());
  std::vector<const render::Filter*> comparing;
  std::copy_if(all.begin(), all.end(), std::back_inserter(comparing),
               [](const render::Filter* f) { return f->info.reads == render::MapRead::depth; });
  for (;;) {
    // Comparing filters, whose answers are exact, half of the time.
    const auto& filters = dice.chance(0.5) ? comparing : all;
    const auto* filter = filters[static_cast<std::size_t>(dice.pick(static_cast<int>(filters.size())))];
    render::FilterSettings settings = render::default_settings(*filter);
    if (filter->info.has_kernel) settings.radius = dice.chance(0.3) ? 0.0 : dice.between(0.25, 3.5);
    if (!filter->info.formats.empty() && dice.chance(0.4))
      settings.format =
          filter->info
              .formats[static_cast<std::size_t>(dice.pick(static_cast<int>(filter->info.formats.size())))];
    if (!filter->info.formats.empty() && dice.chance(0.3)) settings.blur = render::BlurShape::gauss;
    render::settle_options(settings);
    std::string text = render::to_string(settings);
    if (!of_pool && dice.chance(0.05))
      text += (text.find(':') == std::string::npos ? ":" : ",") + std::string("contacts=1");
    const render::ParsedFilter parsed = render::parse_filter(text);
    if (!parsed.error.empty()) continue;
    if (of_pool && !render::page_filter_refusal(parsed.settings).empty()) continue;
    if (of_lights && filter->info.reads != render::MapRead::depth) continue;
    return text;
  }
}

std::string draw_rules(Dice& dice) {
  if (dice.chance(0.5)) return "exact";
  std::string names;
  for (const PruneRuleInfo& rule : prune_rules()) {
    const bool allowed = rule.certainty == PruneCertainty::exact || dice.chance(0.1);
    if (allowed && dice.chance(0.5)) names += (names.empty() ? "" : ",") + std::string(rule.name);
  }
  return names.empty() ? "none" : names;
}

void draw_source(Dice& dice, Json& frame) {
  const int source = dice.pick(12);
  const bool of_pool = source >= 4 && source < 7;
  if (source == 4 || source == 5) {
    frame["source"] = "pages";
    const auto policies = all_page_policies();
    frame["policy"] =
        std::string(policies[static_cast<std::size_t>(dice.pick(static_cast<int>(policies.size())))]->name);
    frame["page_texels"] = 64 << dice.pick(2);
    frame["target_m"] = dice.power(0.0, 3.0);
  }
  if (source == 6) frame["source"] = "lights";
  if (source == 7 || source == 8 || source == 9) {
    frame["source"] = "irregular";
    if (dice.chance(0.15)) frame["samples"] = 2 + dice.pick(15);
    frame["panes"] = dice.chance(0.4);
  }
  if (source >= 10) {
    frame["source"] = "identifiers";
    if (dice.chance(0.4)) frame["identifiers_of"] = "triangle";
    frame["neighbours"] = dice.pick(3);
  }
  frame["filter"] = draw_filter(dice, of_pool, source == 6);
}

void draw_ways(Dice& dice, const World& world, Json& frame) {
  frame["prune"] = draw_rules(dice);
  static constexpr std::string_view kTransitions[] = {"cut", "blend", "dither"};
  static constexpr std::string_view kNoise[] = {"still", "gradient", "blue"};
  static constexpr std::string_view kPasses[] = {"each", "layered", "automatic"};
  if (dice.chance(0.3)) frame["transition"] = dice.name(kTransitions);
  if (dice.chance(0.3)) frame["noise"] = dice.name(kNoise);
  frame["map_passes"] = dice.name(kPasses);
  if (dice.chance(0.25))
    frame["layer"] = std::string(
        render::depth_layers()[static_cast<std::size_t>(dice.pick(render::kDepthLayerCount))].name);
  if (dice.chance(0.2)) frame["linear_depth"] = true;
  if (dice.chance(0.2)) frame["visible_points"] = true;
  if (dice.chance(0.1)) frame["accumulate"] = 2 + dice.pick(4);
  if (dice.chance(0.4)) {
    frame["steps"] = 2 + dice.pick(4);
    frame["move_seed"] = dice.pick(1 << 20);
    if (dice.chance(0.5)) frame["camera_step"] = list(dice.vector() * (0.4 * world.scale));
  }
}

/// A plan's own options, for maps that are drawn in no time.
Json plan_options(Dice& dice, const Stage& stage) {
  Json options = draw_options(dice, stage);
  constexpr int kLeast = 64, kMost = 512;
  options["map_size"] = std::clamp(options.value("map_size", 256), kLeast, kMost);
  // The filter has its own radius; a bias of random size promises nothing.
  for (const char* key : {"filter_radius_texels", "filter_radius_world", "bias", "prune"}) options.erase(key);
  if (dice.chance(0.5)) options["prune"] = "exact";
  // Wide kernels need larger maps than the case's own radius does.
  if (options.contains("texel_budget")) options["texel_budget"] = (1 << 18) + dice.pick(1 << 20);
  // Selections by what maps hold need it less than rays do: most frames are of one map or two.
  if (!options.contains("given_splits") && dice.chance(0.5)) options["cascades"] = 1 + dice.pick(2);
  return options;
}

}  // namespace

Json draw_frame(std::uint64_t seed, std::uint64_t number) {
  // As draw_case(), with other constants: the same seed must not give the same dice.
  Dice dice((seed * 0x9fb21c651e98df25ULL) ^ (number * 0xd6e8feb86659fd93ULL) ^ 0x5851f42d4c957f2dULL);
  World world;
  if (dice.chance(0.3)) world.scale = dice.power(-8.0, 8.0);
  if (dice.chance(0.15)) world.origin = world.scale * dice.power(4.0, 16.0) * dice.direction();
  const bool flat = dice.chance(0.15);  // light straight onto flat surfaces: every filter is exact there
  Stage stage;
  Json value = Json::object();
  value["camera"] = draw_view(dice, world, stage);
  value["light"] = draw_lamp(dice, world, stage, flat);
  value["objects"] = draw_objects(dice, flat);
  value["options"] = plan_options(dice, stage);
  Json frame = Json::object();
  if (world.scale != 1.0) frame["scale"] = world.scale;
  if (world.origin != glm::dvec3(0.0)) frame["origin"] = list(world.origin);
  draw_source(dice, frame);
  draw_ways(dice, world, frame);
  value["frame"] = frame;
  return value;
}

}  // namespace gnomon::stress
