// The functions behind the list of extreme cases, and the scenes they share.
#pragma once

#include "cases.hpp"
#include "input.hpp"

namespace gnomon::stress {

void case_depth_ratio(Check& check);
void case_near_and_far_touch(Check& check);
void case_bad_near(Check& check);
void case_light_along_view(Check& check);
void case_below_turn_off(Check& check);
void case_frustum_edge(Check& check);
void case_overhead(Check& check);
void case_from_ahead(Check& check);
void case_looking_away(Check& check);
void case_behind_eye(Check& check);
void case_degenerate_body(Check& check);
void case_edge_on(Check& check);
void case_outside_depths(Check& check);
void case_far_from_origin(Check& check);
void case_units(Check& check);
void case_wide_spot(Check& check);
void case_spot_near(Check& check);
void case_point_in_view(Check& check);
void case_point_behind(Check& check);
void case_into_light(Check& check);
void case_eye_behind_spot(Check& check);
void case_facing_spot(Check& check);
void case_widest_view(Check& check);
void case_off_axis(Check& check);
void case_tiny_maps(Check& check);
void case_splits(Check& check);
void case_histograms(Check& check);
void case_zoom(Check& check);
void case_hostile_texels(Check& check);
void case_edge_on_surfaces(Check& check);
void case_directions(Check& check);
void case_pseudo_near(Check& check);

/// A camera at the origin that looks level along -z, all of its frustum full of receivers, and a light at
/// `gamma` from the view direction, coming from above: the textbook case, for which there are formulas. One
/// map.
[[nodiscard]] Input full_frustum(double near_depth, double far_depth, double fov_radians, double gamma);

/// The plan's one map under this warp; its status is ok and its numbers are finite, or the check fails.
[[nodiscard]] ShadowMap one_map(Input input, const Warp& warp, Check& check);

}  // namespace gnomon::stress
