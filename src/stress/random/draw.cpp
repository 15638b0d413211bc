// Random cases over the whole domain of legal input, as the text of case files.
#include "draw.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "dice.hpp"
#include "gnomon/extend/shape.hpp"
#include "gnomon/extend/warp.hpp"
#include "gnomon/options.hpp"

namespace gnomon::stress {
namespace {

using Json = nlohmann::ordered_json;

Json json(const glm::dvec3& v) {
  return Json::array({v.x, v.y, v.z});
}

glm::dvec3 any_across(const glm::dvec3& v) {
  const glm::dvec3 other = std::abs(v.y) < 0.7 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  return glm::normalize(glm::cross(v, other));
}

struct BoxOf {
  glm::dvec3 min, max;
};
Json json(const BoxOf& box) {
  return Json{{"min", json(box.min)}, {"max", json(box.max)}};
}

double depth_ratio(Dice& dice, bool stiff) {
  if (!stiff) return dice.power(0.5, 17.0);
  if (dice.chance(0.1)) return 1.0 + dice.power(-40.0, -1.0);
  return dice.power(0.01, 39.8);
}

/// Without the C library: doubled from an angle that a few terms serve.
double tangent(double radians) {
  constexpr int kHalvings = 8;
  const double x = std::ldexp(radians, -kHalvings);
  double t = x + x * x * x * (1.0 / 3.0 + x * x * (2.0 / 15.0));
  for (int i = 0; i < kHalvings; ++i) t = 2.0 * t / (1.0 - t * t);
  return t;
}

/// The image's edges: slopes, or world units.
void draw_edges(Dice& dice, Stage& s, Json& camera) {
  const double aspect = s.stiff ? dice.power(-6.0, 6.0) : dice.power(-1.2, 1.2);
  const int kind = dice.pick(8);
  s.orthographic = kind >= 6;
  if (kind < 3) {  // the usual one
    const double degrees = s.stiff ? (dice.chance(0.2) ? dice.power(-10.0, 0.0) : dice.between(1.0, 179.9))
                                   : dice.between(5.0, 130.0);
    camera["fov_y_deg"] = degrees;
    camera["aspect"] = aspect;
    s.top = tangent(degrees * 0.008726646259971648);
  } else if (kind == 6) {
    s.top = 0.5 * s.far_depth * dice.power(s.stiff ? -20.0 : -5.0, s.stiff ? 5.0 : 1.0);
    camera["height_world"] = 2.0 * s.top;
    camera["aspect"] = aspect;
  } else {
    s.top = dice.power(s.stiff ? -20.0 : -4.0, s.stiff ? 9.0 : 1.0);
    if (s.orthographic) s.top *= s.far_depth;
  }
  s.bottom = -s.top;
  s.right_edge = s.top * aspect;
  s.left = -s.right_edge;
  if (camera.contains("aspect")) return;
  if (dice.chance(0.7)) {
    const double x = dice.between(-1.5, 1.5) * s.right_edge, y = dice.between(-1.5, 1.5) * s.top;
    s.left += x;
    s.right_edge += x;
    s.bottom += y;
    s.top += y;
  }
  camera["left"] = s.left;
  camera["right"] = s.right_edge;
  camera["bottom"] = s.bottom;
  camera["top"] = s.top;
  if (s.orthographic) camera["orthographic"] = true;
}

Json draw_camera(Dice& dice, Stage& s) {
  Json camera = Json::object();
  s.far_depth = s.stiff ? dice.power(-30.0, 30.0) : dice.power(-2.0, 12.0);
  s.near_depth = s.far_depth / depth_ratio(dice, s.stiff);
  if (!(s.near_depth < s.far_depth)) s.near_depth = 0.5 * s.far_depth;
  draw_edges(dice, s, camera);
  if (s.orthographic && dice.chance(0.2)) s.near_depth = dice.chance(0.5) ? 0.0 : -dice.unit() * s.far_depth;
  s.forward = dice.chance(0.2) ? dice.axis() : dice.direction();
  s.right = any_across(s.forward);
  s.up = glm::cross(s.right, s.forward);
  const glm::dvec3 place = dice.vector();
  double away = 2.0 * s.far_depth;
  if (dice.chance(0.1)) away = 0.0;
  if (s.stiff && dice.chance(0.3)) away = s.far_depth * dice.power(0.0, 24.0);
  if (s.stiff && dice.chance(0.05)) away = 1e12;
  s.eye = place * away;
  glm::dvec3 up = dice.chance(0.7) ? glm::dvec3(0, 1, 0) : dice.direction();
  if (s.stiff && dice.chance(0.1)) up = s.forward;
  if (s.stiff && dice.chance(0.05)) up = glm::dvec3(0.0);
  camera["position"] = json(s.eye);
  camera["forward"] = json(s.forward * (dice.chance(0.3) ? dice.power(-12.0, 12.0) : 1.0));
  camera["up"] = json(up);
  camera["near"] = s.near_depth;
  camera["far"] = s.far_depth;
  const bool odd = s.stiff && dice.chance(0.1);
  camera["width"] = odd ? static_cast<int>(dice.power(0.0, 19.9)) : 64 + dice.pick(2000);
  camera["height"] = odd ? static_cast<int>(dice.power(0.0, 19.9)) : 64 + dice.pick(1200);
  return camera;
}

/// A place that the camera sees, or nearly.
glm::dvec3 seen_place(Dice& dice, const Stage& s, double spread) {
  const double least = std::max(s.near_depth, s.far_depth * 1e-12);
  const double octaves = std::ilogb(s.far_depth / least) + 1.0;
  const double depth = std::min(least * dice.power(0.0, octaves), s.far_depth * 1.1);
  const double scale = s.orthographic ? 1.0 : depth;
  const double x = 0.5 * (s.left + s.right_edge) + spread * dice.between(-0.5, 0.5) * (s.right_edge - s.left);
  const double y = 0.5 * (s.bottom + s.top) + spread * dice.between(-0.5, 0.5) * (s.top - s.bottom);
  return s.eye + s.right * (x * scale) + s.up * (y * scale) + s.forward * depth;
}

glm::dvec3 light_direction(Dice& dice, const Stage& s) {
  const glm::dvec3 free = dice.direction();
  switch (dice.pick(8)) {
    case 0:
      return {0.0, -1.0, 0.0};
    case 1:
      return s.forward * dice.sign();
    case 2: {
      const double sign = dice.sign();
      return s.forward * sign + free * dice.power(s.stiff ? -100.0 : -30.0, -3.0);
    }
    case 3: {
      const glm::dvec3 across = glm::cross(s.forward, free);
      return glm::dot(across, across) > 1e-6 ? glm::normalize(across) : s.right;
    }
    default:
      return free;
  }
}

Json draw_light(Dice& dice, Stage& s) {
  Json light = Json::object();
  const int kind = dice.pick(10);
  if (kind < 5) {
    const glm::dvec3 d = light_direction(dice, s);
    s.light = glm::normalize(d);
    const double length = dice.chance(0.5) ? 1.0 : dice.power(s.stiff ? -90.0 : -12.0, s.stiff ? 90.0 : 12.0);
    light["type"] = "directional";
    light["direction"] = json(d * length);
    return light;
  }
  s.parallel = false;
  const glm::dvec3 target = seen_place(dice, s, 1.0);
  const double distance = glm::length(target - s.eye);
  const glm::dvec3 away = dice.direction();
  s.light = target + away * (distance * dice.power(s.stiff ? -20.0 : -4.0, s.stiff ? 10.0 : 1.0));
  if (dice.chance(0.05)) s.light = s.eye;
  const glm::dvec3 to_target = target - s.light;
  const double needed = std::max(glm::length(to_target), s.far_depth * 1e-15);
  s.range = needed * (s.stiff ? dice.power(-3.0, 20.0) : dice.power(-1.0, 4.0));
  if (s.stiff && dice.chance(0.2)) s.range = s.far_depth * dice.power(-30.0, 10.0);
  light["type"] = kind < 8 ? "spot" : "point";
  light["position"] = json(s.light);
  if (kind < 8) {
    glm::dvec3 direction = light_direction(dice, s);
    if (dice.chance(0.7) && glm::dot(to_target, to_target) > 0.0) direction = to_target;
    if (dice.chance(0.1) && s.light != s.eye) direction = s.eye - s.light;
    light["direction"] = json(direction);
    light["outer_deg"] = dice.chance(0.2)              ? dice.between(80.0, 179.9)
                         : s.stiff && dice.chance(0.2) ? dice.power(-20.0, 0.0)
                                                       : dice.between(1.0, 89.9);
  }
  light["range"] = s.range;
  return light;
}

/// Half the extents of a box about so far from what looks at it.
glm::dvec3 half_extents(Dice& dice, const Stage& s, double distance) {
  glm::dvec3 half;
  for (int axis = 0; axis < 3; ++axis) {
    half[axis] = dice.chance(0.08) ? 0.0 : distance * dice.power(s.stiff ? -30.0 : -7.0, s.stiff ? 6.0 : 1.0);
  }
  if (dice.chance(0.02)) half = glm::dvec3(0.0);
  if (dice.chance(0.02)) half = -half;  // inside out: an empty box
  return half;
}

constexpr double kLargest = 1e30;  // of any number of legal input

BoxOf clamped(const glm::dvec3& low, const glm::dvec3& high) {
  BoxOf box{low, high};
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = std::clamp(low[axis], -kLargest, kLargest);
    box.max[axis] = std::clamp(high[axis], -kLargest, kLargest);
  }
  return box;
}

BoxOf draw_receiver(Dice& dice, const Stage& s) {
  const glm::dvec3 centre = seen_place(dice, s, 1.2);
  const glm::dvec3 half = half_extents(dice, s, glm::length(centre - s.eye));
  return clamped(centre - half, centre + half);
}

BoxOf ground(Dice& dice, const Stage& s) {
  const double wide = s.far_depth * dice.power(-1.0, 2.0), below = s.far_depth * dice.power(-8.0, -2.0);
  const double thick = dice.chance(0.3) ? 0.0 : below * dice.unit();
  return clamped(s.eye - glm::dvec3(wide, below + thick, wide), s.eye + glm::dvec3(wide, -below, wide));
}

/// Between a receiver and the light, or behind the light, or anywhere.
BoxOf draw_caster(Dice& dice, const Stage& s, const std::vector<BoxOf>& receivers) {
  const BoxOf& r = receivers[static_cast<std::size_t>(dice.pick(static_cast<int>(receivers.size())))];
  if (dice.chance(0.4)) return draw_receiver(dice, s);
  const glm::dvec3 spread = dice.vector();
  // From within the part of the receiver that is near the view.
  glm::dvec3 at = seen_place(dice, s, 1.0);
  for (int axis = 0; axis < 3; ++axis) {
    if (r.min[axis] <= r.max[axis]) at[axis] = std::clamp(at[axis], r.min[axis], r.max[axis]);
  }
  const double distance = std::max(glm::length(at - s.eye), s.far_depth * 1e-15);
  glm::dvec3 to_light =
      s.parallel ? s.light * (-distance * dice.power(s.stiff ? -20.0 : -4.0, s.stiff ? 20.0 : 4.0))
                 : (s.light - at) * (dice.chance(0.5) ? dice.unit() : 1.0 - dice.power(-20.0, 0.0));
  const double apart = std::max(glm::length(to_light), distance * 1e-6);
  const glm::dvec3 centre = at + to_light + spread * (0.1 * apart);
  const glm::dvec3 half = half_extents(dice, s, s.parallel ? distance : apart);
  return clamped(centre - half, centre + half);
}

int box_count(Dice& dice, bool stiff) {
  if (dice.chance(0.6)) return 1 + dice.pick(3);
  if (stiff && dice.chance(0.03)) return 1000 + dice.pick(4000);
  return 1 + dice.pick(30);
}

void draw_boxes(Dice& dice, const Stage& s, Json& value) {
  std::vector<BoxOf> receivers, casters;
  const int count = box_count(dice, s.stiff);
  for (int i = 0; i < count; ++i) receivers.push_back(draw_receiver(dice, s));
  if (dice.chance(0.4)) receivers.push_back(ground(dice, s));
  if (dice.chance(0.3)) casters = receivers;
  const int more = casters.empty() || dice.chance(0.7) ? box_count(dice, s.stiff) : 0;
  for (int i = 0; i < more; ++i) casters.push_back(draw_caster(dice, s, receivers));
  const auto list = [](const std::vector<BoxOf>& boxes) {
    Json all = Json::array();
    for (const BoxOf& box : boxes) all.push_back(json(box));
    return all;
  };
  if (s.stiff && dice.chance(0.1)) {  // a box beyond all measure
    auto& boxes = dice.chance(0.5) ? receivers : casters;
    BoxOf& box = boxes[static_cast<std::size_t>(dice.pick(static_cast<int>(boxes.size())))];
    const double reach = std::min(dice.power(20.0, 99.6), kLargest);
    const int only = dice.pick(6);  // one axis, or all
    for (int axis = 0; axis < 3; ++axis) {
      if (only < 3 && axis != only) continue;
      if (dice.chance(0.7)) box.max[axis] = std::max(box.max[axis], reach);
      if (dice.chance(0.5)) box.min[axis] = std::min(box.min[axis], -reach);
    }
  }
  value["receivers"] = list(receivers);
  value["casters"] = list(casters);
}

/// How the view depths are divided, and for whom.
void draw_split(Dice& dice, const Stage& s, Json& o) {
  if (dice.chance(0.8)) o["cascades"] = 1 + dice.pick(8);
  const int cascades = o.value("cascades", 4);
  static constexpr std::string_view kSchemes[] = {"auto",        "uniform", "logarithmic", "practical",
                                                  "pseudo_near", "optimal", "given"};
  if (dice.chance(0.6)) o["split"] = dice.name(kSchemes);
  if (o.value("split", "") == "given") {
    Json splits = Json::array();
    double depth = s.near_depth;
    for (int i = 1; i < cascades; ++i) {
      depth += dice.chance(0.1) ? 0.0 : dice.unit() * (s.far_depth - depth);
      splits.push_back(depth);
    }
    o["given_splits"] = splits;
  }
  if (dice.chance(0.3)) o["lambda"] = dice.chance(0.2) ? dice.pick(2) : dice.unit();
  if (dice.chance(0.2)) {
    const double least = std::max(s.near_depth, s.far_depth * 1e-12);
    o[dice.chance(0.5) ? "near_hint" : "pseudo_near"] =
        least * dice.power(0.0, std::ilogb(s.far_depth / least) + 2.0);
  }
  static constexpr std::string_view kRanges[] = {"auto", "receivers", "camera"};
  if (dice.chance(0.4)) o["split_range"] = dice.name(kRanges);
  if (dice.chance(0.2)) o["split_overlap"] = dice.chance(0.2) ? 1.0 : dice.unit();
  static constexpr std::string_view kPartitions[] = {"frustum_faces", "separating_plane", "tetrahedron",
                                                     "receiver_clusters"};
  if (dice.chance(0.2)) o["partition"] = dice.name(kPartitions);
}

void draw_warp(Dice& dice, const Stage& s, Json& o) {
  const int warp = dice.pick(static_cast<int>(all_warps().size()) + 3);
  if (static_cast<std::size_t>(warp) < all_warps().size())
    o["warp"] = std::string(all_warps()[static_cast<std::size_t>(warp)]->name);
  static constexpr std::string_view kObjectives[] = {"storage", "max", "p95", "picture"};
  if (dice.chance(0.6)) o["objective"] = dice.name(kObjectives);
  if (dice.chance(0.1)) {
    o["focus"] = json(draw_receiver(dice, s));
    if (dice.chance(0.7)) o["focus_weight"] = dice.power(0.0, 19.9);
  }
  if (dice.chance(0.15))
    o["shape"] = std::string(
        all_shapes()[static_cast<std::size_t>(dice.pick(static_cast<int>(all_shapes().size())))]->name);
}

void draw_map(Dice& dice, const Stage& s, Json& o) {
  int size = 1024;
  if (dice.chance(0.7)) size = dice.chance(0.1) ? 4 + dice.pick(60) : 64 << dice.pick(s.stiff ? 9 : 6);
  if (dice.chance(0.1)) size = 4 + dice.pick(16381);
  if (size != 1024) o["map_size"] = size;
  static constexpr std::string_view kFits[] = {"tight", "rotated", "stable", "warped_stable"};
  if (dice.chance(0.1))
    o["stable"] = dice.chance(0.5);
  else if (dice.chance(0.6))
    o["fit"] = dice.name(kFits);
  if (dice.chance(0.1)) o["stable_size_steps"] = 1 + dice.pick(1024);
  double radius = std::min(1.0, 0.25 * size);
  if (dice.chance(0.4)) radius = dice.chance(0.3) ? 0.0 : std::min(dice.power(-4.0, 4.0), 0.25 * size);
  if (s.stiff && dice.chance(0.05)) radius = 0.25 * size;
  if (radius != 1.0) o["filter_radius_texels"] = radius;
  if (dice.chance(0.15))
    o["filter_radius_world"] = s.far_depth * dice.power(s.stiff ? -40.0 : -12.0, s.stiff ? 40.0 : -3.0);
  if (dice.chance(0.08)) o["target_m"] = dice.power(-4.0, 4.0);
  if (dice.chance(0.08)) {
    const auto least = static_cast<std::int64_t>(std::max(16.0, std::ceil(4.0 * radius / 16.0) * 16.0));
    o["texel_budget"] = least * least * 8 + static_cast<std::int64_t>(dice.power(0.0, 26.0));
  }
}

/// Planes near what is seen, of any direction.
void draw_planes(Dice& dice, const Stage& s, Json& o) {
  const int count = std::min(1 + dice.pick(3), 8 - o.value("cascades", 4));
  Json planes = Json::array();
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 seen = seen_place(dice, s, 1.0), point = clamped(seen, seen).min;
    const glm::dvec3 normal = dice.chance(0.3) ? glm::dvec3(0.0, 1.0, 0.0) : dice.vector();
    if (!(glm::length(normal) > 0.0)) continue;
    planes.push_back({{"point", {point.x, point.y, point.z}},
                      {"normal", {normal.x, normal.y, normal.z}},
                      {"thickness", std::clamp(s.far_depth * dice.power(-30.0, 2.0), 1e-30, kLargest)}});
  }
  if (!planes.empty()) o["planes"] = planes;
}

void draw_rest(Dice& dice, Json& o) {
  static constexpr std::string_view kSets[] = {"all", "none", "exact"};
  if (dice.chance(0.4)) o["prune"] = dice.name(kSets);
  if (dice.chance(0.1)) {
    std::string names;
    for (const PruneRuleInfo& rule : prune_rules()) {
      if (dice.chance(0.5)) names += (names.empty() ? "" : ",") + std::string(rule.name);
    }
    o["prune"] = names.empty() ? "none" : names;
  }
  if (dice.chance(0.1)) o["prune_m"] = dice.chance(0.1) ? 1e-9 : dice.power(-6.0, 6.0);
  if (dice.chance(0.1)) {
    Json bias = Json::object();
    for (const char* key : {"constant_texels", "slope_texels", "normal_offset_texels", "max_slope"}) {
      if (dice.chance(0.5)) bias[key] = dice.chance(0.2) ? 0.0 : dice.power(-10.0, 10.0);
    }
    o["bias"] = bias;
  }
  if (dice.chance(0.3)) {
    Json space = Json::object();
    if (dice.chance(0.5)) space["ndc_depth"] = "zero_to_one";
    if (dice.chance(0.5)) space["reversed_z"] = true;
    if (dice.chance(0.5)) space["y_down"] = true;
    if (dice.chance(0.5)) space["handedness"] = "left";
    if (dice.chance(0.5)) space["first_row"] = "y_plus_one";
    o["clip_space"] = space;
  }
  static constexpr std::string_view kSelections[] = {"view_depth", "finest"};
  if (dice.chance(0.2)) o["selection"] = dice.name(kSelections);
}

/// How many lights share a pool.
Json draw_pool(Dice& dice) {
  Json o = Json::object();
  const int most = 64 << dice.pick(5),
            least = 16 << dice.pick(std::bit_width(static_cast<unsigned>(most / 16)));
  o["most_size"] = most;
  o["least_size"] = least;
  o["pool_width"] = most * (1 + dice.pick(4));
  o["pool_height"] = most * (1 + dice.pick(4));
  if (dice.chance(0.5)) o["texel_budget"] = static_cast<std::int64_t>(dice.power(8.0, 22.0));
  if (dice.chance(0.2)) {
    o["page_budget"] = static_cast<int>(dice.power(0.0, 10.0));
    o["page_texels"] = 64;
  }
  if (dice.chance(0.3)) o["enough_m"] = dice.power(-6.0, 6.0);
  if (dice.chance(0.2)) {
    Json costs = Json::object();
    for (const char* key : {"per_map", "per_megatexel", "per_kilodraw", "per_megatriangle"}) {
      if (dice.chance(0.7)) costs[key] = dice.power(-8.0, 2.0);
    }
    o["costs"] = costs;
    if (dice.chance(0.7)) o["millisecond_budget"] = dice.power(-8.0, 6.0);
  }
  if (dice.chance(0.3)) o["most_frames"] = 1 + dice.pick(16);
  if (dice.chance(0.3)) o["full_share"] = dice.power(-12.0, -0.01);
  return o;
}

/// Puts lights of all kinds beside the case's own.
void draw_lights(Dice& dice, const Stage& s, Json& value) {
  Json lights = Json::array({value["light"]});
  const int more = dice.chance(0.8) ? 1 + dice.pick(8) : 1 + dice.pick(60);
  for (int i = 0; i < more; ++i) {
    Stage own = s;
    lights.push_back(draw_light(dice, own));
  }
  for (Json& light : lights) {
    if (dice.chance(0.3)) light["weight"] = dice.chance(0.2) ? 0.0 : dice.power(-20.0, 20.0);
    if (dice.chance(0.2)) light["draws"] = dice.power(0.0, 16.0);
    if (dice.chance(0.2)) light["triangles"] = dice.power(0.0, 24.0);
  }
  value.erase("light");
  value["lights"] = lights;
  value["options"]["lights"] = draw_pool(dice);
}

}  // namespace

Json draw_options(Dice& dice, const Stage& stage) {
  Json options = Json::object();
  draw_split(dice, stage, options);
  draw_warp(dice, stage, options);
  draw_map(dice, stage, options);
  draw_rest(dice, options);
  if (stage.parallel && dice.chance(0.1)) draw_planes(dice, stage, options);
  return options;
}

Json draw_case(std::uint64_t seed, std::uint64_t number) {
  // Neighbouring seeds must not share cases; odd, so that no two numbers of a seed meet.
  constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ULL;
  Dice dice((seed * 0xd1342543de82ef95ULL) ^ (number * kGolden));
  Stage stage;
  stage.stiff = dice.chance(0.6);
  Json value = Json::object();
  value["camera"] = draw_camera(dice, stage);
  value["light"] = draw_light(dice, stage);
  draw_boxes(dice, stage, value);
  value["options"] = draw_options(dice, stage);
  // Last: cases of one light are what they were before there were others.
  if (dice.chance(0.3)) draw_lights(dice, stage, value);
  return value;
}

}  // namespace gnomon::stress
