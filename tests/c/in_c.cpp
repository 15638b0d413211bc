#include "in_c.hpp"

#include <algorithm>
#include <iterator>

namespace gnomon::test {
namespace {

void set(const glm::dvec3& from, double* to) {
  to[0] = from.x;
  to[1] = from.y;
  to[2] = from.z;
}

int32_t index_of(std::span<const Warp* const> all, const Warp* one) {
  const auto at = std::find(all.begin(), all.end(), one);
  return at == all.end() ? GNOMON_DEFAULT : static_cast<int32_t>(at - all.begin());
}
int32_t index_of(std::span<const Shape* const> all, const Shape* one) {
  return static_cast<int32_t>(std::find(all.begin(), all.end(), one) - all.begin());
}

/// Notes the first pair of numbers that are not the same bits.
class Comparison {
 public:
  void operator()(const char* field, double a, double b) {
    if (std::bit_cast<std::uint64_t>(a) != std::bit_cast<std::uint64_t>(b)) note(field);
  }
  void operator()(const char* field, float a, float b) {
    if (std::bit_cast<std::uint32_t>(a) != std::bit_cast<std::uint32_t>(b)) note(field);
  }
  void operator()(const char* field, std::int64_t a, std::int64_t b) {
    if (a != b) note(field);
  }
  void operator()(const char* field, int a, int b) { (*this)(field, std::int64_t{a}, std::int64_t{b}); }
  void operator()(const char* field, bool a, int b) { (*this)(field, a ? 1 : 0, b); }
  template <typename Vector, typename Number>
  void vectors(const char* field, const Vector& a, const Number* b) {
    for (int i = 0; i < static_cast<int>(Vector::length()); ++i) (*this)(field, a[i], b[i]);
  }
  [[nodiscard]] const std::string& found() const { return found_; }

 private:
  void note(const char* field) {
    if (found_.empty()) found_ = field;
  }
  std::string found_;
};

}  // namespace

gnomon_camera in_c(const Camera& from) {
  gnomon_camera to;
  gnomon_camera_default(&to, sizeof to);
  set(from.position, to.position);
  set(from.forward, to.forward);
  set(from.up, to.up);
  to.orthographic = from.orthographic;
  to.left = from.left;
  to.right = from.right;
  to.bottom = from.bottom;
  to.top = from.top;
  to.near_depth = from.near_depth;
  to.far_depth = from.far_depth;
  to.width = from.width;
  to.height = from.height;
  return to;
}

gnomon_light in_c(const Light& from) {
  gnomon_light to;
  gnomon_light_default(&to, sizeof to);
  if (const auto* sun = std::get_if<DirectionalLight>(&from)) {
    to.kind = GNOMON_DIRECTIONAL;
    set(sun->direction, to.direction);
  } else if (const auto* spot = std::get_if<SpotLight>(&from)) {
    to.kind = GNOMON_SPOT;
    set(spot->position, to.position);
    set(spot->direction, to.direction);
    to.outer_radians = spot->outer_radians;
    to.range = spot->range;
  } else if (const auto* point = std::get_if<PointLight>(&from)) {
    to.kind = GNOMON_POINT;
    set(point->position, to.position);
    to.range = point->range;
  }
  return to;
}

gnomon_clip_space in_c(const ClipSpace& from) {
  gnomon_clip_space to{};
  to.zero_to_one = from.ndc_depth == NdcDepth::zero_to_one;
  to.reversed_z = from.reversed_z;
  to.y_down = from.y_down;
  to.left_handed = from.handedness == Handedness::left;
  to.first_row_at_y_max = from.first_row == FirstRow::y_plus_one;
  return to;
}

gnomon_plan_options in_c(const PlanOptions& from) {
  gnomon_plan_options to;
  gnomon_plan_options_default(&to, sizeof to);
  to.cascades = from.cascades;
  to.resolution_max_size = from.resolution.max_size;
  to.resolution_max_error = from.resolution.max_error;
  to.resolution_texel_budget = from.resolution.texel_budget;
  to.resolution_prune_error = from.resolution.prune_error;
  to.resolution_stable_size_steps = from.resolution.stable_size_steps;
  to.fit = static_cast<int32_t>(from.fit);
  to.split_scheme = static_cast<int32_t>(from.split.scheme);
  to.split_lambda = from.split.lambda;
  to.split_pseudo_near = from.split.pseudo_near;
  to.split_range = static_cast<int32_t>(from.split.range);
  to.split_selection = static_cast<int32_t>(from.split.selection);
  for (std::size_t i = 0; i < from.split.given.size(); ++i) to.split_given[i] = from.split.given[i];
  to.split_overlap = from.split.overlap;
  to.split_partition = static_cast<int32_t>(from.split.partition);
  to.split_face_slices = from.split.face_slices;
  to.warp = index_of(all_warps(), from.warp.warp);
  to.warp_shape = index_of(all_shapes(), from.warp.shape);
  to.warp_objective = static_cast<int32_t>(from.warp.objective);
  set(from.warp.focus.min, to.warp_focus);
  set(from.warp.focus.max, to.warp_focus + 3);
  to.warp_focus_weight = from.warp.focus_weight;
  for (std::size_t i = 0; i < from.warp.planes.size(); ++i) {
    set(from.warp.planes[i].point_world, to.warp_planes[i]);
    set(from.warp.planes[i].normal, to.warp_planes[i] + 3);
    to.warp_planes[i][6] = from.warp.planes[i].thickness;
  }
  to.cadence_frames = from.cadence.frames;
  to.cadence_largest_step = from.cadence.largest_step;
  to.cadence_largest_turn = from.cadence.largest_turn;
  to.prune = from.prune.bits;
  to.filter_texels = from.filter.texels;
  to.filter_world = from.filter.world;
  to.bias_constant_texels = from.bias.constant_texels;
  to.bias_slope_texels = from.bias.slope_texels;
  to.bias_normal_offset_texels = from.bias.normal_offset_texels;
  to.bias_max_slope = from.bias.max_slope;
  to.light_near_share = from.light_near_share;
  to.clip_space = in_c(from.clip_space);
  return to;
}

std::string first_difference(const ShadowMap& a, const gnomon_map& b) {
  Comparison same;
  same("size", static_cast<int>(sizeof b), static_cast<int>(b.size));
  for (int c = 0; c < 4; ++c) {
    same.vectors("clip_from_world", a.clip_from_world[c], b.clip_from_world + 4 * c);
    same.vectors("clip_from_camera_relative", a.clip_from_camera_relative[c],
                 b.clip_from_camera_relative + 4 * c);
  }
  same("depth_begin", a.depth_begin, b.depth_begin);
  same("depth_end", a.depth_end, b.depth_end);
  same("overlap", a.overlap, b.overlap);
  same.vectors("light_world", a.light_world, b.light_world);
  same("cascade", a.cascade, b.cascade);
  same("width", a.width, b.width);
  same("height", a.height, b.height);
  same("shape", index_of(all_shapes(), a.shape), b.shape);
  for (std::size_t i = 0; i < a.shape_parameters.size(); ++i)
    same("shape_parameters", a.shape_parameters[i], b.shape_parameters[i]);
  same("warp", index_of(all_warps(), a.warp), b.warp);
  same("kappa", a.kappa, b.kappa);
  same.vectors("texel_world", a.texel_world, b.texel_world);
  same.vectors("texel_world_max", a.texel_world_max, b.texel_world_max);
  same("depth_range_world", a.depth_range_world, b.depth_range_world);
  same("filter_margin_texels", a.filter_margin_texels, b.filter_margin_texels);
  same("bias_constant", a.bias_world.constant, b.bias_constant);
  same("bias_slope", a.bias_world.slope, b.bias_slope);
  same("bias_normal_offset", a.bias_world.normal_offset, b.bias_normal_offset);
  same("cull_plane_count", a.cull_plane_count, b.cull_plane_count);
  for (int i = 0; i < GNOMON_MAX_CULL_PLANES; ++i)
    same.vectors("cull_planes",
                 i < a.cull_plane_count ? a.cull_planes[static_cast<std::size_t>(i)] : glm::dvec4(0.0),
                 b.cull_planes[i]);
  same("select_plane_count", a.select_plane_count, b.select_plane_count);
  for (int i = 0; i < GNOMON_MAX_SELECT_PLANES; ++i)
    same.vectors("select_planes",
                 i < a.select_plane_count ? a.select_planes[static_cast<std::size_t>(i)] : glm::dvec4(0.0),
                 b.select_planes[i]);
  same("snap_valid", a.snap_key.valid, b.snap_valid);
  same("snap_x", a.snap_key.x, b.snap_x);
  same("snap_y", a.snap_key.y, b.snap_y);
  same("snap_depth_near", a.snap_key.depth_near, b.snap_depth_near);
  same("snap_depth_far", a.snap_key.depth_far, b.snap_depth_far);
  same("snap_texel", a.snap_key.texel.x, b.snap_texel[0]);
  same("snap_texel", a.snap_key.texel.y, b.snap_texel[1]);
  same("m_s_max", a.m_s_max, b.m_s_max);
  same("m_t_max", a.m_t_max, b.m_t_max);
  same("m_max", a.m_max, b.m_max);
  same("storage", a.storage, b.storage);
  return same.found();
}

std::string first_difference(const ShadowPlan& a, const gnomon_plan& b) {
  Comparison same;
  same("status", static_cast<int>(a.status), b.status);
  same("map_count", a.map_count, b.map_count);
  same("omission_count", a.omission_count, b.omission_count);
  if (a.status == PlanStatus::invalid_input || !same.found().empty()) return same.found();
  same("selection", static_cast<int>(a.selection), b.selection);
  same("sizes_vary", a.sizes_vary, b.sizes_vary);
  same.vectors("origin", a.origin_world, b.origin);
  same.vectors("light_direction", a.light_direction, b.light_direction);
  const gnomon_clip_space space = in_c(a.clip_space);
  same("clip_space.zero_to_one", space.zero_to_one, b.clip_space.zero_to_one);
  same("clip_space.reversed_z", space.reversed_z, b.clip_space.reversed_z);
  same("clip_space.y_down", space.y_down, b.clip_space.y_down);
  same("clip_space.left_handed", space.left_handed, b.clip_space.left_handed);
  same("clip_space.first_row_at_y_max", space.first_row_at_y_max, b.clip_space.first_row_at_y_max);
  same("bias_constant_texels", a.bias.constant_texels, b.bias_constant_texels);
  same("bias_slope_texels", a.bias.slope_texels, b.bias_slope_texels);
  same("bias_normal_offset_texels", a.bias.normal_offset_texels, b.bias_normal_offset_texels);
  same("bias_max_slope", a.bias.max_slope, b.bias_max_slope);
  for (std::size_t i = 0; i < a.omitted().size() && b.omissions != nullptr; ++i) {
    same("omission.kind", static_cast<int>(a.omitted()[i].kind), b.omissions[i].kind);
    same("omission.map", a.omitted()[i].map, b.omissions[i].map);
    same("omission.a", a.omitted()[i].a, b.omissions[i].a);
    same("omission.b", a.omitted()[i].b, b.omissions[i].b);
    same("omission.saves_texels", a.omitted()[i].saves_texels, b.omissions[i].saves_texels);
  }
  if (!same.found().empty()) return same.found();
  for (std::size_t i = 0; i < a.maps().size(); ++i) {
    if (const std::string field = first_difference(a.map[i], b.maps[i]); !field.empty())
      return "map." + field;
  }
  return "";
}

std::string first_difference(const AliasingStats& a, const gnomon_stats& b) {
  Comparison same;
  same("p50", a.p50, b.p50);
  same("p95", a.p95, b.p95);
  same("max", a.max, b.max);
  same("mean", a.mean, b.mean);
  same("share_undersampled", a.share_undersampled, b.share_undersampled);
  same("storage", a.storage, b.storage);
  same("samples", static_cast<std::int64_t>(a.samples), b.samples);
  same("outside", static_cast<std::int64_t>(a.outside), b.outside);
  return same.found();
}

PlanInC::PlanInC() {
  gnomon_plan_default(&plan, sizeof plan);
  plan.maps = maps;
  plan.map_size = sizeof maps[0];
  plan.map_room = GNOMON_MAX_MAPS;
  plan.omissions = omissions;
  plan.omission_room = GNOMON_MAX_OMISSIONS;
}

InputInC::InputInC(const Camera& a_camera, const Light& a_light, const std::vector<Box>& casters,
                   const std::vector<Box>& receivers, const PlanOptions& all)
    : camera(in_c(a_camera)), light(in_c(a_light)), options(in_c(all)) {
  gnomon_view_default(&view, sizeof view);
  view.camera = &camera;
  gnomon_scene_default(&scene, sizeof scene);
  scene.casters = reinterpret_cast<const double*>(casters.data());
  scene.caster_count = static_cast<int64_t>(casters.size());
  scene.receivers = reinterpret_cast<const double*>(receivers.data());
  scene.receiver_count = static_cast<int64_t>(receivers.size());
}

ClustersInC::ClustersInC(const gnomon_camera& camera, const std::vector<gnomon_light>& lights,
                         std::int64_t room)
    : begin(static_cast<std::size_t>(gnomon_cluster_count(&camera, 64, 48)) + 1),
      list(static_cast<std::size_t>(room)) {
  const auto count = static_cast<std::int64_t>(lights.size());
  std::vector<std::byte> memory(static_cast<std::size_t>(gnomon_cluster_memory(count, room)));
  gnomon_light_clusters_default(&found, sizeof found);
  found.begin = begin.data();
  found.lights = list.data();
  found.begin_room = static_cast<std::int64_t>(begin.size());
  found.light_room = room;
  status = gnomon_cluster_lights(&camera, lights.data(), sizeof(gnomon_light), count, memory.data(),
                                 static_cast<std::int64_t>(memory.size()), &found, nullptr);
}

}  // namespace gnomon::test
