// Are the constants of gnomon.h the enumerators of C++? Everything here is checked while it compiles.
#include "gnomon/c/gnomon.h"
#include "gnomon/gnomon.hpp"
#include "gnomon/study/engine_bias.hpp"

namespace gnomon::c {
namespace {

template <typename Enum>
constexpr bool is(Enum enumerator, int constant) {
  return static_cast<int>(enumerator) == constant;
}

static_assert(is(PlanStatus::ok, GNOMON_OK));
static_assert(is(PlanStatus::nothing_visible, GNOMON_NOTHING_VISIBLE));
static_assert(is(PlanStatus::no_caster, GNOMON_NO_CASTER));
static_assert(is(PlanStatus::invalid_input, GNOMON_INVALID_INPUT));

static_assert(is(SplitRange::automatic, GNOMON_RANGE_AUTOMATIC));
static_assert(is(SplitRange::receivers, GNOMON_RANGE_RECEIVERS));
static_assert(is(SplitRange::camera, GNOMON_RANGE_CAMERA));

static_assert(is(OmissionKind::cascade_without_receiver, GNOMON_CASCADE_WITHOUT_RECEIVER));
static_assert(is(OmissionKind::cascade_without_caster, GNOMON_CASCADE_WITHOUT_CASTER));
static_assert(is(OmissionKind::depth_without_receiver, GNOMON_DEPTH_WITHOUT_RECEIVER));
static_assert(is(OmissionKind::depth_not_visible, GNOMON_DEPTH_NOT_VISIBLE));
static_assert(is(OmissionKind::warp_without_gain, GNOMON_WARP_WITHOUT_GAIN));
static_assert(is(OmissionKind::warp_in_stable_fit, GNOMON_WARP_IN_STABLE_FIT));
static_assert(is(OmissionKind::part_without_caster, GNOMON_PART_WITHOUT_CASTER));
static_assert(is(OmissionKind::partition_without_gain, GNOMON_PARTITION_WITHOUT_GAIN));
static_assert(is(OmissionKind::partition_in_stable_fit, GNOMON_PARTITION_IN_STABLE_FIT));
static_assert(is(OmissionKind::face_without_receiver, GNOMON_FACE_WITHOUT_RECEIVER));
static_assert(is(OmissionKind::face_without_caster, GNOMON_FACE_WITHOUT_CASTER));
static_assert(is(OmissionKind::resolution_without_gain, GNOMON_RESOLUTION_WITHOUT_GAIN));
static_assert(is(OmissionKind::depth_near_light, GNOMON_DEPTH_NEAR_LIGHT));
static_assert(is(OmissionKind::option_ignored, GNOMON_OPTION_IGNORED));
static_assert(is(OmissionKind::view_without_receiver, GNOMON_VIEW_WITHOUT_RECEIVER));
static_assert(is(OmissionKind::pages_coarsened, GNOMON_PAGES_COARSENED));
static_assert(is(OmissionKind::points_left_coarser, GNOMON_POINTS_LEFT_COARSER));
static_assert(is(OmissionKind::points_beyond_levels, GNOMON_POINTS_BEYOND_LEVELS));
static_assert(is(OmissionKind::shape_without_gain, GNOMON_SHAPE_WITHOUT_GAIN));
static_assert(is(OmissionKind::plane_without_receiver, GNOMON_PLANE_WITHOUT_RECEIVER));
static_assert(is(OmissionKind::plane_without_caster, GNOMON_PLANE_WITHOUT_CASTER));
static_assert(is(OmissionKind::cascade_on_planes, GNOMON_CASCADE_ON_PLANES));
static_assert(is(OmissionKind::faces_less_divided, GNOMON_FACES_LESS_DIVIDED));
static_assert(is(OmissionKind::receiver_near_light, GNOMON_RECEIVER_NEAR_LIGHT));
static_assert(is(OmissionKind::cascade_without_gain, GNOMON_CASCADE_WITHOUT_GAIN));

static_assert(is(IgnoredOption::partition, GNOMON_IGNORED_PARTITION));
static_assert(is(IgnoredOption::split_scheme, GNOMON_IGNORED_SPLIT_SCHEME));
static_assert(is(IgnoredOption::split_overlap, GNOMON_IGNORED_SPLIT_OVERLAP));
static_assert(is(IgnoredOption::visible_depths, GNOMON_IGNORED_VISIBLE_DEPTHS));
static_assert(is(IgnoredOption::texel_budget, GNOMON_IGNORED_TEXEL_BUDGET));
static_assert(is(IgnoredOption::history, GNOMON_IGNORED_HISTORY));
static_assert(is(IgnoredOption::selection, GNOMON_IGNORED_SELECTION));
static_assert(is(IgnoredOption::cadence, GNOMON_IGNORED_CADENCE));
static_assert(is(IgnoredOption::visible_points, GNOMON_IGNORED_VISIBLE_POINTS));
static_assert(is(IgnoredOption::shape, GNOMON_IGNORED_SHAPE));
static_assert(is(IgnoredOption::planes, GNOMON_IGNORED_PLANES));
static_assert(is(IgnoredOption::page_share, GNOMON_IGNORED_PAGE_SHARE));
static_assert(is(IgnoredOption::page_reach, GNOMON_IGNORED_PAGE_REACH));

static_assert(is(PlanEventKind::map_appeared, GNOMON_MAP_APPEARED));
static_assert(is(PlanEventKind::map_refitted, GNOMON_MAP_REFITTED));
static_assert(is(PlanEventKind::density_jump, GNOMON_DENSITY_JUMP));

static_assert(is(ReuseKind::none, GNOMON_REUSE_NONE));
static_assert(is(ReuseKind::identical, GNOMON_REUSE_IDENTICAL));
static_assert(is(ReuseKind::scrolled, GNOMON_REUSE_SCROLLED));

static_assert(is(BiasWay::rasterizer, GNOMON_BIAS_RASTERIZER));
static_assert(is(BiasWay::normal_offset, GNOMON_BIAS_NORMAL_OFFSET));

static_assert(is(PointAliasing::Status::ok, GNOMON_POINT_OK));
static_assert(is(PointAliasing::Status::outside, GNOMON_POINT_OUTSIDE));
static_assert(is(PointAliasing::Status::faces_away, GNOMON_POINT_FACES_AWAY));
static_assert(is(PointAliasing::Status::undetermined, GNOMON_POINT_UNDETERMINED));

static_assert(is(LightOutcome::mapped, GNOMON_LIGHT_MAPPED));
static_assert(is(LightOutcome::below_least_size, GNOMON_LIGHT_BELOW_LEAST_SIZE));
static_assert(is(LightOutcome::without_receiver, GNOMON_LIGHT_WITHOUT_RECEIVER));
static_assert(is(LightOutcome::without_caster, GNOMON_LIGHT_WITHOUT_CASTER));

}  // namespace
}  // namespace gnomon::c
