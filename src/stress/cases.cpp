// The list of extreme cases: what goes in, what must come out.
#include "cases.hpp"

#include <array>
#include <cstdio>

#include "case_list.hpp"

namespace gnomon::stress {
namespace {

constexpr ExtremeCase kCases[] = {
    {1, "depth_ratio_of_ten_million", "far / near = 1e7",
     "N = n + sqrt(n f); finite; storage not above no warp; floats cast last", case_depth_ratio},
    {2, "near_and_far_touch", "far / near from 1 + 1e-12 to 3",
     "strength finite, not negative; off where W + K <= 3 D", case_near_and_far_touch},
    {3, "near_plane_of_no_use", "near plane 0, negative, not a number, beyond 1e-12 of far",
     "refused; nothing that is no number comes out", case_bad_near, false},
    {4, "light_along_the_view", "angle to the view 0 and pi",
     "no warp by formula; an axis that stands in; orthonormal; storage of no warp", case_light_along_view},
    {5, "light_below_the_turn_off_angle", "angle from 1e-9 to the turn-off angle", "no warp by formula",
     case_below_turn_off},
    {6, "light_along_the_frustum_edge", "angle = half field of view, +- 1e-12", "strength continuous; finite",
     case_frustum_edge},
    {7, "light_overhead", "angle of 90 degrees", "N = n + sqrt(n f)", case_overhead},
    {8, "light_from_ahead", "angle above 90 degrees", "as under the mirrored angle", case_from_ahead},
    {9, "nothing_in_view", "camera outside of the scene, looking away", "status; no map; everything lit",
     case_looking_away},
    {10, "casters_behind_the_eye", "camera in the scene, casters behind it",
     "casters kept; a shadow falls where its ray leads", case_behind_eye},
    {11, "flat_line_and_point", "what is visible is a plane, a line, a point",
     "finite; invertible; no warp along nothing", case_degenerate_body},
    {12, "plane_edge_on_to_the_light", "a receiver whose plane holds the light's direction",
     "as 11; error infinite, not not-a-number", case_edge_on},
    {13, "scene_before_near_or_beyond_far", "scene before the near plane, beyond the far plane", "as 9",
     case_outside_depths},
    {14, "far_from_the_origin", "origin 1e6 and 1e7 away",
     "floats relative to the camera; error m the same to 1e-6", case_far_from_origin},
    {15, "tiny_and_huge_units", "the world times 1e-6 and 1e6", "the same plan in other units", case_units},
    {16, "wide_spots", "cones up to and beyond 180 degrees",
     "one map below 131 degrees; cube above; 360 refused", case_wide_spot},
    {17, "receiver_at_the_spot", "a receiver that touches the light",
     "near plane at 1e-4 of the far one at least", case_spot_near},
    {18, "point_light_in_view", "a point light inside the frustum", "a cube; faces without receivers skipped",
     case_point_in_view},
    {19, "point_light_behind_the_eye", "a point light behind the eye, perspective shadow map requested",
     "depth order kept", case_point_behind},
    {20, "light_in_the_eyes", "the camera looks straight into the light", "error finite", case_into_light},
    {21, "eye_behind_the_spot", "the eye behind the spot's plane", "finite; what is lit and visible is held",
     case_eye_behind_spot},
    {22, "spot_that_faces_the_eye", "far end no deeper in view than the near end", "no warp by formula",
     case_facing_spot},
    {23, "widest_view_and_none", "field of view near 180 degrees; orthographic camera",
     "finite, not above no warp; no warp", case_widest_view},
    {24, "off_axis_frustum", "image edges far off the axis",
     "support of the actual corners: never above no warp", case_off_axis},
    {25, "maps_of_no_texels", "map sizes 0 to 4", "refused below 4", case_tiny_maps},
    {26, "splits_of_no_use", "0 cascades, lambda outside [0, 1], pseudo-near outside the depths",
     "refused, or clamped and ascending", case_splits, false},
    {27, "histograms_of_sky", "visible depths: sky, not a number, one pixel", "as unknown; one map",
     case_histograms, false},
    {28, "zoom_of_a_stable_map", "field of view changes under a stable fit", "sizes in steps", case_zoom},
    {29, "hostile_texels", "filters given variance below 0, zmax below zmin, not a number, infinity",
     "a visibility in [0, 1]", case_hostile_texels, false},
    {30, "edge_on_surfaces", "normal across the light, across the eye, facing away",
     "infinite, zero or no value; never not-a-number", case_edge_on_surfaces},
    {31, "directions_of_no_use", "light direction zero, not finite, not of unit length",
     "refused; length does not matter", case_directions, false},
    {32, "pseudo_near_too_far", "pseudo-near at two thirds of the range and beyond far",
     "not above no warp; no warp where no depths are left", case_pseudo_near},
};

}  // namespace

void Check::that(bool holds, std::string_view what) {
  ++checks_;
  if (holds || failures_.find(what) != std::string::npos) return;
  failures_ += (failures_.empty() ? "" : "; ") + std::string(what);
}

void Check::note(std::string_view name, double value) {
  std::array<char, 40> text;
  std::snprintf(text.data(), text.size(), " %.3g", value);
  note(std::string(name) + text.data());
}

void Check::note(std::string_view text) {
  notes_ += (notes_.empty() ? "" : "; ") + std::string(text);
}

void Check::skip(std::string_view why) {
  skipped_ = true;
  note(why);
}

std::string Check::found() const {
  if (failures_.empty()) return notes_;
  return "not so: " + failures_ + (notes_.empty() ? "" : " (" + notes_ + ")");
}

std::span<const ExtremeCase> all_cases() noexcept {
  return kCases;
}

CaseRow run_case(const ExtremeCase& extreme) {
  Check check;
  extreme.run(check);
  CaseRow row{extreme.row,
              std::string(extreme.name),
              std::string(extreme.input),
              std::string(extreme.required),
              "holds",
              check.found()};
  if (!check.passed())
    row.verdict = "fails";
  else if (check.skipped())
    row.verdict = "skipped";
  return row;
}

}  // namespace gnomon::stress
