// A shadow plan as JSON: the output format of `gnomon plan`.
#include "plan_json.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "gnomon/measure.hpp"
#include "gnomon/study/log_perspective.hpp"

namespace gnomon::tool {

Json number(double value) {
  if (std::isnan(value)) throw std::logic_error("the plan holds a value that is not a number");
  return std::isinf(value) ? Json(nullptr) : Json(value);
}

Json rows_of(const glm::dmat4& matrix) {
  Json rows = Json::array();
  for (int row = 0; row < 4; ++row) {
    Json values = Json::array();
    for (int column = 0; column < 4; ++column) values.push_back(number(matrix[column][row]));
    rows.push_back(std::move(values));
  }
  return rows;
}

Json omitted_json(std::span<const Omission> omitted) {
  Json list = Json::array();
  for (const Omission& omission : omitted) {
    const OmissionText text = describe(omission);
    list.push_back(
        {{"what", text.what.data()}, {"why", text.why.data()}, {"saves_texels", omission.saves_texels}});
  }
  return list;
}

const char* reason_of(PlanStatus status) {
  if (status == PlanStatus::nothing_visible)
    return "no receiver is in view: nothing to draw, all in view is lit";
  if (status == PlanStatus::no_caster) return "no caster can reach the receivers in view: all in view is lit";
  return "";
}

namespace {

Json planes_of(std::span<const glm::dvec4> list, int count) {
  Json planes = Json::array();
  for (const glm::dvec4& plane : list.first(static_cast<std::size_t>(count))) {
    planes.push_back({number(plane.x), number(plane.y), number(plane.z), number(plane.w)});
  }
  return planes;
}

Json casters_of(const ShadowMap& map, const Case& input) {
  std::vector<std::uint32_t> indices(input.casters.size());
  indices.resize(cull_casters(map, input.casters, indices));
  return indices;
}

// Null where no grid is held still. An identical map takes equal depths, too: stored depths count from them.
Json snap_key_of(const SnapKey& key) {
  if (!key.valid) return nullptr;
  return {key.x, key.y};
}
Json snap_depth_of(const SnapKey& key) {
  if (!key.valid) return nullptr;
  return {key.depth_near, key.depth_far};
}

Json stats_of(const AliasingStats& stats) {
  return {{"p50", number(stats.p50)}, {"p95", number(stats.p95)}, {"max", number(stats.max)}};
}

Json map_json(const ShadowPlan& plan, int index, const Case& input) {
  const ShadowMap& map = plan.map[static_cast<std::size_t>(index)];
  Json result{
      {"clip_from_world", rows_of(map.clip_from_world)},
      {"depth_begin", number(map.depth_begin)},
      {"depth_end", number(map.depth_end)},
      {"size", {map.width, map.height}},
      {"cascade", map.cascade},
      {"warp", std::string(map.warp->name)},
      {"kappa", number(map.kappa)},
      {"texel_world", {number(map.texel_world.x), number(map.texel_world.y)}},
      {"filter_margin_texels", map.filter_margin_texels},
      {"bias_world",
       {{"constant", number(map.bias_world.constant)},
        {"slope", number(map.bias_world.slope)},
        {"normal_offset", number(map.bias_world.normal_offset)}}},
      {"cull_planes", planes_of(map.cull_planes, map.cull_plane_count)},
      {"select_planes", planes_of(map.select_planes, map.select_plane_count)},
      {"casters", casters_of(map, input)},
      {"snap_key", snap_key_of(map.snap_key)},
      {"snap_depth", snap_depth_of(map.snap_key)},
      {"m", stats_of(measure(plan, input.camera, input.bounds(), {.map = index}))},
  };
  if (map.shape != &shapes::linear) {
    Json parameters = Json::array();
    for (int i = 0; i < map.shape->parameter_count; ++i)
      parameters.push_back(number(map.shape_parameters[static_cast<std::size_t>(i)]));
    result["shape"] = {{"name", std::string(map.shape->name)}, {"parameters", std::move(parameters)}};
  }
  return result;
}

bool is_flat(const Json& value) {
  return std::none_of(value.begin(), value.end(), [](const Json& item) { return item.is_structured(); });
}

void append_pretty(const Json& value, std::size_t indent, std::string& text) {
  if (!value.is_structured() || value.empty() || (value.is_array() && is_flat(value))) {
    text += value.dump();
    return;
  }
  const bool object = value.is_object();
  const auto new_line = [&](std::size_t margin) {
    text += '\n';
    text.append(margin, ' ');
  };
  text += object ? '{' : '[';
  bool first = true;
  for (const auto& [key, item] : value.items()) {
    if (!first) text += ',';
    first = false;
    new_line(indent + 2);
    if (object) text.append(Json(key).dump()).append(": ");
    append_pretty(item, indent + 2, text);
  }
  new_line(indent);
  text += object ? '}' : ']';
}

}  // namespace

std::string pretty_text(const Json& value) {
  std::string text;
  append_pretty(value, 0, text);
  return text;
}

Json log_perspective_json(const Case& input) {
  const auto* light = std::get_if<DirectionalLight>(&input.light);
  if (light == nullptr) return nullptr;
  const LogPerspectiveMap map =
      log_perspective_map(input.camera, *light, input.bounds(), input.options.resolution.max_size);
  if (!map.valid) return nullptr;
  const AliasingStats stats = measure(map, input.camera, input.bounds());
  Json result = stats_of(stats);
  result["storage"] = number(stats.storage);
  result["kappa"] = number(map.kappa);
  return result;
}

Json plan_json(const ShadowPlan& plan, const Case& input) {
  Json result{{"status", std::string(to_string(plan.status))}};
  if (plan.status != PlanStatus::ok) result["reason"] = reason_of(plan.status);
  result["maps"] = Json::array();
  for (int i = 0; i < plan.map_count; ++i) result["maps"].push_back(map_json(plan, i, input));
  result["omitted"] = omitted_json(plan.omitted());
  const AliasingStats stats = measure(plan, input.camera, input.bounds());
  result["m"] = stats_of(stats);
  result["m"]["storage"] = number(stats.storage);
  return result;
}

}  // namespace gnomon::tool
