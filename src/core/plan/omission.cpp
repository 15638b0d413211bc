// What was left out, in words.
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "gnomon/plan.hpp"

namespace gnomon {
namespace {

/// clang takes a format without values for one that a stranger wrote, so such a text is passed as a value.
template <std::size_t N, typename... Values>
void write(std::array<char, N>& text, const char* format, Values... values) noexcept {
  if constexpr (sizeof...(values) == 0) {
    std::snprintf(text.data(), N, "%s", format);
  } else {
    std::snprintf(text.data(), N, format, values...);
  }
}

}  // namespace

std::string_view to_string(PlanStatus status) noexcept {
  switch (status) {
    case PlanStatus::ok:
      return "ok";
    case PlanStatus::nothing_visible:
      return "nothing_visible";
    case PlanStatus::no_caster:
      return "no_caster";
    case PlanStatus::invalid_input:
      break;
  }
  return "invalid_input";
}

namespace {

void describe_ignored(const Omission& o, OmissionText& text) noexcept {
  struct Entry {
    const char *what, *why;
  };
  constexpr Entry kEntries[] = {
      {"option split.partition",
       "it divides another kind of light: parts of the view a sun's, a tetrahedron a point light's"},
      {"option split.scheme",
       "local lights have no cascades, and plans by the picture divide where their points are"},
      {"option split.overlap", "only cascades along the view blend into each other"},
      {"visible depths", "a local light has no cascades to divide the view among"},
      {"option resolution.texel_budget", "maps of this partition keep their size"},
      {"history", "parts that follow the view do not move steadily"},
      {"option split.selection", "only cascades can be chosen among by view depth"},
      {"option cadence", "it needs a history, a directional light, and cascades of a fixed number and size"},
      {"visible points", "local lights, stable fits, parts and kept maps do not follow them"},
      {"option warp.shape",
       "it needs a tight fit, no history; rectilinear visible points, one view, fixed sizes, kernels in "
       "texels; paraboloid a local light"},
      {"option warp.planes",
       "it needs a directional light, one view, partition view_depth, and a tight or rotated fit without a "
       "texel budget"},
      {"option pages.share",
       "this policy weighs all points together, and leaves none to twice the texel size"},
      {"option pages.reach_texels", "this policy opens pages round shadow edges by itself"}};
  if (!(o.a > -1.0 && o.a < static_cast<double>(std::size(kEntries)))) return;
  const auto at = static_cast<std::size_t>(o.a);
  std::snprintf(text.what.data(), text.what.size(), "%s", kEntries[at].what);
  std::snprintf(text.why.data(), text.why.size(), "%s", kEntries[at].why);
}

}  // namespace

OmissionText describe(const Omission& o) noexcept {
  OmissionText text{};
  const auto what = [&](const char* format, auto... values) { write(text.what, format, values...); };
  const auto why = [&](const char* format, auto... values) { write(text.why, format, values...); };
  switch (o.kind) {
    case OmissionKind::cascade_without_receiver:
      what("cascade %d", o.map);
      why("no receiver between depths %g and %g", o.a, o.b);
      break;
    case OmissionKind::cascade_without_caster:
      what("cascade %d", o.map);
      why("no caster can reach the receivers between depths %g and %g", o.a, o.b);
      break;
    case OmissionKind::depth_without_receiver:
      what("depths %g to %g", o.a, o.b);
      why("no receiver in view there, so no cascade covers them");
      break;
    case OmissionKind::depth_not_visible:
      what("depths %g to %g", o.a, o.b);
      why("the visible depths given show no surface there, so no cascade covers them");
      break;
    case OmissionKind::warp_without_gain:
      what("warp of cascade %d", o.map);
      if (std::isfinite(o.a)) {
        why("the objective with it is %.4g of the objective without", o.a);
      } else {
        why("it fits no map here: the objective with it has no bound");
      }
      break;
    case OmissionKind::warp_in_stable_fit:
      what("warp");
      why("a stable fit keeps its texel grid still, which a warp that follows the view cannot");
      break;
    case OmissionKind::part_without_caster:
      what("part %d", o.map);
      why("no caster can reach its receivers, at depths from %g to %g", o.a, o.b);
      break;
    case OmissionKind::partition_without_gain:
      what("partition");
      if (std::isfinite(o.a)) {
        why("the objective of its parts is %.4g of the objective of one map", o.a);
      } else {
        why("the objective of its parts has no bound, unlike that of one map");
      }
      break;
    case OmissionKind::partition_in_stable_fit:
      what("partition");
      why("a stable fit keeps its texel grid still, which parts that follow the view cannot");
      break;
    case OmissionKind::face_without_receiver:
      what("face %d", o.map);
      why("no visible receiver lies in it within the light's range and cone");
      break;
    case OmissionKind::face_without_caster:
      what("face %d", o.map);
      why("no caster lies between the light and the receivers in it");
      break;
    case OmissionKind::resolution_without_gain:
      what("texels of map %d", o.map);
      why("a texel covers at most %.3g pixels at full size and %.3g at this one", o.a, o.b);
      break;
    case OmissionKind::depth_near_light:
      what("depths near the light, map %d", o.map);
      why("%.0f casters reach below depth %g along the map's axis, and cast no shadow there", o.b, o.a);
      break;
    case OmissionKind::view_without_receiver:
      what("camera %.0f", o.a);
      why("no receiver in its view");
      break;
    case OmissionKind::pages_coarsened:
      what("levels of pages");
      why("the pool holds too few pages for an error of %.3g; levels are as coarse as one of %.3g needs", o.a,
          o.b);
      break;
    case OmissionKind::points_left_coarser:
      what("pages that few points need");
      why("%.0f visible points are left to a page of larger texels", o.a);
      break;
    case OmissionKind::points_beyond_levels:
      what("levels beyond the deepest");
      why("%.0f visible points need more texels than the deepest level has", o.a);
      break;
    case OmissionKind::shape_without_gain:
      what("shape of map %d", o.map);
      if (std::isfinite(o.a)) {
        why("the error along the warp with it is %.4g of that without", o.a);
      } else {
        why("the error along the warp with it has no bound");
      }
      break;
    case OmissionKind::plane_without_receiver:
      what("map of plane %.0f", o.a);
      why("no visible receiver lies near the plane, or the light lies in it");
      break;
    case OmissionKind::plane_without_caster:
      what("map of plane %.0f", o.a);
      why("no caster can reach the receivers near the plane");
      break;
    case OmissionKind::cascade_without_gain:
      what("cascade %d", o.map);
      why("the next one serves depths %g to %g with the same texels", o.a, o.b);
      break;
    case OmissionKind::cascade_on_planes:
      what("cascade %d", o.map);
      why("maps of planes serve all receivers between depths %g and %g", o.a, o.b);
      break;
    case OmissionKind::faces_less_divided:
      what("slices of frustum faces");
      why("a plan has %d maps at most: a face stays at %.0f of up to %.0f slices", kMaxMaps, o.a, o.b);
      break;
    case OmissionKind::receiver_near_light:
      what("receivers near the light, map %d", o.map);
      why("%.0f boxes of receivers reach nearer than %g to the light; what is nearer has no map and is lit",
          o.b, o.a);
      break;
    case OmissionKind::option_ignored:
      describe_ignored(o, text);
      break;
  }
  return text;
}

}  // namespace gnomon
