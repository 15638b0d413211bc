// What is a field of C++ called in C? Tests refuse each of these, and compare the names with the header's.
#include <iterator>

#include "c/convert.hpp"
#include "plan/input.hpp"

namespace gnomon::c {
namespace {

struct Field {
  std::string_view in_core;
  const char* in_c;
};

// Names that are the same on both sides are not listed: those of camera and light.
constexpr Field kFields[] = {
    {"bounds.casters", "scene.casters"},
    {"bounds.receivers", "scene.receivers"},
    {"view.points_world", "view.points"},
    {"view.normals_world", "view.normals"},
    {"options.split.partition", "plan_options.split_partition"},
    {"options.split.scheme", "plan_options.split_scheme"},
    {"options.split.range", "plan_options.split_range"},
    {"options.split.selection", "plan_options.split_selection"},
    {"options.fit", "plan_options.fit"},
    {"options.warp.objective", "plan_options.warp_objective"},
    {"options.resolution.max_size", "plan_options.resolution_max_size"},
    {"options.resolution.max_error", "plan_options.resolution_max_error"},
    {"options.resolution.prune_error", "plan_options.resolution_prune_error"},
    {"options.resolution.stable_size_steps", "plan_options.resolution_stable_size_steps"},
    {"options.resolution.texel_budget", "plan_options.resolution_texel_budget"},
    {"options.cascades", "plan_options.cascades"},
    {"options.split.lambda", "plan_options.split_lambda"},
    {"options.split.face_slices", "plan_options.split_face_slices"},
    {"options.split.overlap", "plan_options.split_overlap"},
    {"options.split.given", "plan_options.split_given"},
    {"options.split.pseudo_near", "plan_options.split_pseudo_near"},
    {"options.filter.texels", "plan_options.filter_texels"},
    {"options.filter.world", "plan_options.filter_world"},
    {"options.warp.focus", "plan_options.warp_focus"},
    {"options.warp.focus_weight", "plan_options.warp_focus_weight"},
    {"options.warp.planes", "plan_options.warp_planes"},
    {"options.light_near_share", "plan_options.light_near_share"},
    {"options.cadence.frames", "plan_options.cadence_frames"},
    {"options.cadence.largest_step", "plan_options.cadence_largest_step"},
    {"options.cadence.largest_turn", "plan_options.cadence_largest_turn"},
    {"options.bias", "plan_options.bias_constant_texels and the other three of bias"},
    {"pages.page_texels", "page_options.page_texels"},
    {"pages.virtual_texels", "page_options.virtual_texels"},
    {"pages.capacity", "page_options.capacity"},
    {"pages.target_m", "page_options.target_m"},
    {"pages.share", "page_options.share"},
    {"pages.levels_per_octave", "page_options.levels_per_octave"},
    {"pages.trials", "page_options.trials"},
    {"pages.reach_texels", "page_options.reach_texels"},
    {"pages.least_light_sine", "page_options.least_light_sine"},
    {"history.feedback", "page_history.feedback"},
    {"memory", "bytes"},
    {"lights", "count"},
    {"history.lights", "light_history"},
    {"light.weight", "light_request.weight"},
    {"light.draws", "light_request.draws"},
    {"light.triangles", "light_request.triangles"},
    {"lights.texel_budget", "light_options.texel_budget"},
    {"lights.page_budget", "light_options.page_budget"},
    {"lights.page_texels", "light_options.page_texels"},
    {"lights.millisecond_budget", "light_options.millisecond_budget"},
    {"lights.costs", "light_options.cost_per_map and the other three costs"},
    {"lights.most_size", "light_options.most_size"},
    {"lights.least_size", "light_options.least_size"},
    {"lights.pool_width, lights.pool_height", "light_options.pool_width, light_options.pool_height"},
    {"lights.enough_m", "light_options.enough_m"},
    {"lights.most_frames", "light_options.most_frames"},
    {"lights.full_share", "light_options.full_share"},
    {"lights.keep_gain", "light_options.keep_gain"},
    {"clusters.tile_pixels", "light_clusters.tile_pixels"},
    {"clusters.depth_slices", "light_clusters.depth_slices"},
    {"light", "lights"},
    {"memory.begin", "light_clusters.begin_room"},
    {"memory.lights", "light_clusters.light_room"},
    {"memory.work", "bytes"},
};

}  // namespace

const char* field_of(std::string_view name) noexcept {
  for (const Field& field : kFields) {
    if (field.in_core == name) return field.in_c;
  }
  // The core's names are whole literals, which end in a zero.
  return name.data();
}

const char* fault_of_view(const View& view, const SceneBounds& bounds) noexcept {
  const std::string_view field = first_invalid_field(view, DirectionalLight{}, bounds, PlanOptions{});
  return field.empty() ? nullptr : field_of(field);
}

}  // namespace gnomon::c
