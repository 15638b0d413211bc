// What are the defaults of each struct? Those of the C++ structs, so that they stand once.
#include <limits>

#include "c/convert.hpp"

namespace gnomon::c {
namespace {

template <typename T>
void clear(T& to) noexcept {
  to = {};
  to.size = sizeof to;
}

}  // namespace

void set_defaults(gnomon_camera& to) noexcept {
  clear(to);
  from_camera(Camera{}, to);
}

void set_defaults(gnomon_light& to) noexcept {
  const SpotLight light;  // has all fields that any light has
  clear(to);
  to.kind = GNOMON_DIRECTIONAL;
  from_vector(light.position, to.position);
  from_vector(DirectionalLight{}.direction, to.direction);
  to.outer_radians = light.outer_radians;
  to.range = light.range;
}

void set_defaults(gnomon_scene& to) noexcept {
  clear(to);
}

void set_defaults(gnomon_view& to) noexcept {
  clear(to);
}

void set_defaults(gnomon_plan_options& to) noexcept {
  clear(to);
  from_options(PlanOptions{}, to);
}

void set_defaults(gnomon_map& to) noexcept {
  clear(to);
  ShadowMap map;
  map.cull_plane_count = 0;
  from_map(map, to);
}

void set_defaults(gnomon_plan& to) noexcept {
  clear(to);
  to.status = GNOMON_INVALID_INPUT;
  const BiasOptions bias;
  to.bias_constant_texels = bias.constant_texels;
  to.bias_slope_texels = bias.slope_texels;
  to.bias_normal_offset_texels = bias.normal_offset_texels;
  to.bias_max_slope = bias.max_slope;
  from_vector(ShadowPlan{}.light_direction, to.light_direction);
}

void set_defaults(gnomon_measure_options& to) noexcept {
  const MeasureOptions options;
  clear(to);
  to.map = options.map;
  to.columns = options.columns;
  to.rows = options.rows;
  to.depths = options.depths;
}

void set_defaults(gnomon_stats& to) noexcept {
  clear(to);
}

void set_defaults(gnomon_shadow_picture& to) noexcept {
  clear(to);
}

void set_defaults(gnomon_page_options& to) noexcept {
  const PageOptions options;
  clear(to);
  to.policy = gnomon_find(GNOMON_PAGE_POLICIES, "resolution");
  to.page_texels = options.page_texels;
  to.capacity = options.capacity;
  to.target_m = options.target_m;
  to.share = options.share;
  to.levels_per_octave = options.levels_per_octave;
  to.trials = options.trials;
  to.virtual_texels = options.virtual_texels;
  to.fallback = options.fallback ? 1 : 0;
  to.reach_texels = options.reach_texels;
  to.least_light_sine = options.least_light_sine;
}

void set_defaults(gnomon_page_plan& to) noexcept {
  clear(to);
  to.status = GNOMON_INVALID_INPUT;
  to.policy = GNOMON_DEFAULT;
}

void set_defaults(gnomon_page_history& to) noexcept {
  clear(to);
}

void set_defaults(gnomon_light_request& to) noexcept {
  clear(to);
  to.weight = LightRequest{}.weight;
}

void set_defaults(gnomon_light_options& to) noexcept {
  const LightOptions options;
  clear(to);
  to.page_budget = options.page_budget;
  to.pool_width = options.pool_width;
  to.pool_height = options.pool_height;
  to.texel_budget = options.texel_budget;
  to.page_texels = options.page_texels;
  to.least_size = options.least_size;
  to.most_size = options.most_size;
  to.most_frames = options.most_frames;
  to.millisecond_budget = options.millisecond_budget;
  to.enough_m = options.enough_m;
  to.full_share = options.full_share;
  to.keep_gain = options.keep_gain;
}

void set_defaults(gnomon_light_maps& to) noexcept {
  clear(to);
  to.outcome = GNOMON_LIGHT_WITHOUT_RECEIVER;
  to.frames = 1;
}

void set_defaults(gnomon_light_plan& to) noexcept {
  clear(to);
  to.status = GNOMON_INVALID_INPUT;
  to.invalid_light = -1;
}

void set_defaults(gnomon_light_clusters& to) noexcept {
  const ClusterOptions options;
  clear(to);
  to.tile_pixels = options.tile_pixels;
  to.depth_slices = options.depth_slices;
  to.status = GNOMON_INVALID_INPUT;
}

}  // namespace gnomon::c

using gnomon::c::write_defaults;

extern "C" {

int32_t gnomon_camera_default(gnomon_camera* camera, uint32_t size) {
  return write_defaults(camera, size);
}
int32_t gnomon_light_default(gnomon_light* light, uint32_t size) {
  return write_defaults(light, size);
}
int32_t gnomon_scene_default(gnomon_scene* scene, uint32_t size) {
  return write_defaults(scene, size);
}
int32_t gnomon_view_default(gnomon_view* view, uint32_t size) {
  return write_defaults(view, size);
}
int32_t gnomon_plan_options_default(gnomon_plan_options* options, uint32_t size) {
  return write_defaults(options, size);
}
int32_t gnomon_map_default(gnomon_map* map, uint32_t size) {
  return write_defaults(map, size);
}
int32_t gnomon_plan_default(gnomon_plan* plan, uint32_t size) {
  return write_defaults(plan, size);
}
int32_t gnomon_measure_options_default(gnomon_measure_options* options, uint32_t size) {
  return write_defaults(options, size);
}
int32_t gnomon_stats_default(gnomon_stats* stats, uint32_t size) {
  return write_defaults(stats, size);
}
int32_t gnomon_shadow_picture_default(gnomon_shadow_picture* picture, uint32_t size) {
  return write_defaults(picture, size);
}
int32_t gnomon_page_options_default(gnomon_page_options* options, uint32_t size) {
  return write_defaults(options, size);
}
int32_t gnomon_page_plan_default(gnomon_page_plan* plan, uint32_t size) {
  return write_defaults(plan, size);
}
int32_t gnomon_page_history_default(gnomon_page_history* history, uint32_t size) {
  return write_defaults(history, size);
}
int32_t gnomon_light_request_default(gnomon_light_request* request, uint32_t size) {
  return write_defaults(request, size);
}
int32_t gnomon_light_options_default(gnomon_light_options* options, uint32_t size) {
  return write_defaults(options, size);
}
int32_t gnomon_light_plan_default(gnomon_light_plan* plan, uint32_t size) {
  return write_defaults(plan, size);
}
int32_t gnomon_light_clusters_default(gnomon_light_clusters* clusters, uint32_t size) {
  return write_defaults(clusters, size);
}

}  // extern "C"
