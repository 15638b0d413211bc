// How do inputs and maps of C become those of C++, and back?
#include "c/convert.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace gnomon::c {

// Lists are read as they lie in the caller's memory.
static_assert(sizeof(Box) == 6 * sizeof(double) && offsetof(Box, max) == 3 * sizeof(double));
static_assert(sizeof(glm::dvec3) == 3 * sizeof(double) && alignof(Box) == alignof(double));
static_assert(sizeof(VisibleDepths) == sizeof(gnomon_visible_depths) &&
              offsetof(VisibleDepths, count) == offsetof(gnomon_visible_depths, count) &&
              offsetof(VisibleDepths, min) == offsetof(gnomon_visible_depths, min) &&
              offsetof(VisibleDepths, max) == offsetof(gnomon_visible_depths, max));
static_assert(kDepthBins == GNOMON_DEPTH_BINS && kMaxMaps == GNOMON_MAX_MAPS &&
              kMaxCullPlanes == GNOMON_MAX_CULL_PLANES && kMaxSelectPlanes == GNOMON_MAX_SELECT_PLANES &&
              kMaxWarpPlanes == GNOMON_MAX_WARP_PLANES && kMaxOmissions == GNOMON_MAX_OMISSIONS &&
              kMaxViews == GNOMON_MAX_VIEWS && kMaxLights == GNOMON_MAX_LIGHTS);
static_assert(std::tuple_size_v<ShapeParameters> == GNOMON_SHAPE_PARAMETERS);

namespace {

/// Whether an index is one of an enumeration that ends in `last`; then `to` is that enumerator.
template <typename Enum>
bool enumerator(std::int32_t from, Enum last, Enum& to) noexcept {
  if (from < 0 || from > static_cast<std::int32_t>(last)) return false;
  to = static_cast<Enum>(from);
  return true;
}
template <typename Enum>
std::int32_t index_of(Enum value) noexcept {
  return static_cast<std::int32_t>(value);
}
/// The entry of a registry at an index, or nullptr.
template <typename List>
auto entry_at(const List& list, std::int32_t index) noexcept {
  return index >= 0 && static_cast<std::size_t>(index) < list.size() ? list[static_cast<std::size_t>(index)]
                                                                     : nullptr;
}
template <typename List, typename Entry>
std::int32_t index_in(const List& list, const Entry* entry) noexcept {
  const auto at = std::find(list.begin(), list.end(), entry);
  return at != list.end() ? static_cast<std::int32_t>(at - list.begin()) : GNOMON_DEFAULT;
}

const char* to_warp_options(const gnomon_plan_options& from, WarpOptions& to) noexcept {
  to.warp = entry_at(all_warps(), from.warp);
  if (to.warp == nullptr && from.warp != GNOMON_DEFAULT) return "plan_options.warp";
  to.shape = entry_at(all_shapes(), from.warp_shape);
  if (to.shape == nullptr) return "plan_options.warp_shape";
  if (!enumerator(from.warp_objective, Objective::picture, to.objective))
    return "plan_options.warp_objective";
  to.focus = {to_vector(from.warp_focus), to_vector(from.warp_focus + 3)};
  to.focus_weight = from.warp_focus_weight;
  for (std::size_t i = 0; i < to.planes.size(); ++i) {
    const double* plane = from.warp_planes[i];
    to.planes[i] = {to_vector(plane), to_vector(plane + 3), plane[6]};
  }
  return nullptr;
}

const char* to_split_options(const gnomon_plan_options& from, SplitOptions& to) noexcept {
  if (!enumerator(from.split_scheme, SplitScheme::given, to.scheme)) return "plan_options.split_scheme";
  if (!enumerator(from.split_range, SplitRange::camera, to.range)) return "plan_options.split_range";
  if (!enumerator(from.split_selection, MapSelection::finest, to.selection))
    return "plan_options.split_selection";
  if (!enumerator(from.split_partition, Partition::receiver_clusters, to.partition))
    return "plan_options.split_partition";
  to.lambda = from.split_lambda;
  to.pseudo_near = from.split_pseudo_near;
  static_assert(std::size(decltype(from.split_given){}) == std::tuple_size_v<decltype(to.given)>);
  std::copy(std::begin(from.split_given), std::end(from.split_given), to.given.begin());
  to.overlap = from.split_overlap;
  to.face_slices = from.split_face_slices;
  return nullptr;
}

}  // namespace

glm::dmat4 to_matrix(const double* from) noexcept {
  glm::dmat4 to;
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) to[c][r] = from[4 * c + r];
  }
  return to;
}

void from_matrix(const glm::dmat4& from, double* to) noexcept {
  for (int c = 0; c < 4; ++c) from_vector(from[c], to + 4 * c);
}

ClipSpace to_clip_space(const gnomon_clip_space& from) noexcept {
  return {from.zero_to_one != 0 ? NdcDepth::zero_to_one : NdcDepth::minus_one_to_one, from.reversed_z != 0,
          from.y_down != 0, from.left_handed != 0 ? Handedness::left : Handedness::right,
          from.first_row_at_y_max != 0 ? FirstRow::y_plus_one : FirstRow::y_minus_one};
}

ClipSpace to_clip_space(const gnomon_clip_space* from) noexcept {
  return from != nullptr ? to_clip_space(*from) : ClipSpace{};
}

gnomon_clip_space from_clip_space(const ClipSpace& from) noexcept {
  return {index_of(from.ndc_depth),  from.reversed_z,          from.y_down,
          index_of(from.handedness), index_of(from.first_row), 0};
}

gnomon_texel_rect from_rect(const TexelRect& from) noexcept {
  return {from.x, from.y, from.width, from.height};
}
TexelRect to_rect(const gnomon_texel_rect& from) noexcept {
  return {from.x, from.y, from.width, from.height};
}

const char* to_camera(const gnomon_camera* from, Camera& to) noexcept {
  if (const char* fault = fault_of(from)) return fault;
  gnomon_camera older;
  const gnomon_camera& c = whole(*from, older);
  to.position = to_vector(c.position);
  to.forward = to_vector(c.forward);
  to.up = to_vector(c.up);
  to.orthographic = c.orthographic != 0;
  to.left = c.left;
  to.right = c.right;
  to.bottom = c.bottom;
  to.top = c.top;
  to.near_depth = c.near_depth;
  to.far_depth = c.far_depth;
  to.width = c.width;
  to.height = c.height;
  return nullptr;
}

void from_camera(const Camera& from, gnomon_camera& to) noexcept {
  to.orthographic = from.orthographic ? 1 : 0;
  from_vector(from.position, to.position);
  from_vector(from.forward, to.forward);
  from_vector(from.up, to.up);
  to.left = from.left;
  to.right = from.right;
  to.bottom = from.bottom;
  to.top = from.top;
  to.near_depth = from.near_depth;
  to.far_depth = from.far_depth;
  to.width = from.width;
  to.height = from.height;
}

const char* to_light(const gnomon_light* from, Light& to) noexcept {
  if (const char* fault = fault_of(from)) return fault;
  gnomon_light older;
  const gnomon_light& l = whole(*from, older);
  switch (l.kind) {
    case GNOMON_DIRECTIONAL:
      to = DirectionalLight{to_vector(l.direction)};
      return nullptr;
    case GNOMON_SPOT:
      to = SpotLight{to_vector(l.position), to_vector(l.direction), l.outer_radians, l.range};
      return nullptr;
    case GNOMON_POINT:
      to = PointLight{to_vector(l.position), l.range};
      return nullptr;
    default:
      return "light.kind";
  }
}

const char* to_boxes(const BoxList& from, std::span<const Box>& to) noexcept {
  if (from.count < 0) return from.count_name;
  if (from.first == nullptr && from.count > 0) return from.name;
  to = {reinterpret_cast<const Box*>(from.first), static_cast<std::size_t>(from.count)};
  return nullptr;
}

const char* to_points(const double* first, std::int64_t count, const char* name,
                      std::span<const glm::dvec3>& to) noexcept {
  if (count < 0 || (first == nullptr && count > 0)) return name;
  to = {reinterpret_cast<const glm::dvec3*>(first), static_cast<std::size_t>(count)};
  return nullptr;
}

const char* to_scene(const gnomon_scene* from, SceneBounds& to) noexcept {
  if (const char* fault = fault_of(from)) return fault;
  gnomon_scene older;
  const gnomon_scene& s = whole(*from, older);
  std::span<const Box> casters, receivers;
  if (const char* fault =
          to_boxes({s.casters, s.caster_count, "scene.casters", "scene.caster_count"}, casters))
    return fault;
  if (const char* fault =
          to_boxes({s.receivers, s.receiver_count, "scene.receivers", "scene.receiver_count"}, receivers))
    return fault;
  if (s.caster_set != nullptr && !casters.empty()) return "scene.caster_set";
  if (s.receiver_set != nullptr && !receivers.empty()) return "scene.receiver_set";
  to.casters = s.caster_set != nullptr ? Boxes(s.caster_set->set) : Boxes(casters);
  to.receivers = s.receiver_set != nullptr ? Boxes(s.receiver_set->set) : Boxes(receivers);
  return nullptr;
}

const char* to_view(const gnomon_view* from, View& to) noexcept {
  if (const char* fault = fault_of(from)) return fault;
  gnomon_view older;
  const gnomon_view& v = whole(*from, older);
  if (const char* fault = to_camera(v.camera, to.camera)) return fault;
  if (v.point_count < 0) return "view.point_count";
  if (const char* fault = to_points(v.points, v.point_count, "view.points", to.points_world)) return fault;
  to.depths = reinterpret_cast<const VisibleDepths*>(v.depths);
  if (v.normals == nullptr) return nullptr;
  return to_points(v.normals, v.point_count, "view.normals", to.normals_world);
}

const char* to_options(const gnomon_plan_options* from, PlanOptions& to) noexcept {
  if (from == nullptr) return nullptr;
  if (const char* fault = fault_of(from)) return fault;
  gnomon_plan_options older;
  const gnomon_plan_options& o = whole(*from, older);
  to.cascades = o.cascades;
  to.resolution = {o.resolution_max_size, o.resolution_max_error, o.resolution_texel_budget,
                   o.resolution_prune_error, o.resolution_stable_size_steps};
  if (!enumerator(o.fit, Fit::warped_stable, to.fit)) return "plan_options.fit";
  if (const char* fault = to_split_options(o, to.split)) return fault;
  if (const char* fault = to_warp_options(o, to.warp)) return fault;
  to.cadence = {o.cadence_frames, o.cadence_largest_step, o.cadence_largest_turn};
  to.filter = {o.filter_texels, o.filter_world};
  to.bias = {o.bias_constant_texels, o.bias_slope_texels, o.bias_normal_offset_texels, o.bias_max_slope};
  to.light_near_share = o.light_near_share;
  to.clip_space = to_clip_space(o.clip_space);
  to.prune.bits = o.prune;
  return (o.prune & ~PruneRules::kAll) != 0 ? "plan_options.prune" : nullptr;
}

void from_options(const PlanOptions& from, gnomon_plan_options& to) noexcept {
  to.cascades = from.cascades;
  to.resolution_max_size = from.resolution.max_size;
  to.resolution_max_error = from.resolution.max_error;
  to.resolution_texel_budget = from.resolution.texel_budget;
  to.resolution_prune_error = from.resolution.prune_error;
  to.resolution_stable_size_steps = from.resolution.stable_size_steps;
  to.fit = index_of(from.fit);
  to.split_scheme = index_of(from.split.scheme);
  to.split_lambda = from.split.lambda;
  to.split_pseudo_near = from.split.pseudo_near;
  to.split_range = index_of(from.split.range);
  to.split_selection = index_of(from.split.selection);
  std::copy(from.split.given.begin(), from.split.given.end(), to.split_given);
  to.split_overlap = from.split.overlap;
  to.split_partition = index_of(from.split.partition);
  to.split_face_slices = from.split.face_slices;
  to.warp = index_in(all_warps(), from.warp.warp);
  to.warp_shape = index_in(all_shapes(), from.warp.shape != nullptr ? from.warp.shape : &shapes::linear);
  to.warp_objective = index_of(from.warp.objective);
  from_vector(from.warp.focus.min, to.warp_focus);
  from_vector(from.warp.focus.max, to.warp_focus + 3);
  to.warp_focus_weight = from.warp.focus_weight;
  for (std::size_t i = 0; i < from.warp.planes.size(); ++i) {
    from_vector(from.warp.planes[i].point_world, to.warp_planes[i]);
    from_vector(from.warp.planes[i].normal, to.warp_planes[i] + 3);
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
  to.clip_space = from_clip_space(from.clip_space);
}

static const char* to_measure_options(const gnomon_measure_options* from, MeasureOptions& to) noexcept {
  if (from == nullptr) return nullptr;
  if (const char* fault = fault_of(from)) return fault;
  gnomon_measure_options older;
  const gnomon_measure_options& o = whole(*from, older);
  constexpr std::int32_t kMost = 65536;
  if (o.columns < 1 || o.columns > kMost) return "measure_options.columns";
  if (o.rows < 1 || o.rows > kMost) return "measure_options.rows";
  if (o.depths < 1 || o.depths > kMost) return "measure_options.depths";
  if (o.map < -1) return "measure_options.map";
  to = {o.columns, o.rows, o.depths, o.map};
  return nullptr;
}

const char* to_measured(const gnomon_view* view, const gnomon_scene* scene,
                        const gnomon_measure_options* options, const gnomon_stats* stats,
                        Measured& to) noexcept {
  if (const char* fault = to_view(view, to.view)) return fault;
  if (const char* fault = to_scene(scene, to.bounds)) return fault;
  if (const char* fault = to_measure_options(options, to.options)) return fault;
  if (const char* fault = fault_of_view(to.view, to.bounds)) return fault;
  return fault_of(stats);
}

}  // namespace gnomon::c
