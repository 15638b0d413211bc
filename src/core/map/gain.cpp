// What a warp gains on a body, and whether a map takes it.
#include "map/gain.hpp"
#include "gnomon/extend/body.hpp"
#include "gnomon/extend/warp.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/vector.hpp"
#include "map/size.hpp"
#include "map/turned.hpp"
#include "warp/plane_error.hpp"

namespace gnomon {
namespace {

/// The objective with the choice over that without; infinite where it is not known.
double ratio_at(const PlaneError& error, const WarpInput& in, const WarpChoice& choice) noexcept {
  const double without = error.value(in.unwarped);
  const bool known = without > 0.0 && std::isfinite(without);
  return known ? error.value(choice) / without : std::numeric_limits<double>::infinity();
}

[[gnu::noinline]] double sampled_ratio(const WarpInput& in, const WarpChoice& choice, bool inside,
                                       int set) noexcept {
  return ratio_at(PlaneError(in, inside, set), in, choice);
}

/// The objective under the choice. Out of line: what is searched before and after it need not make room for
/// its samples.
[[gnu::noinline]] double error_under(const WarpInput& in, const WarpChoice& choice) noexcept {
  return PlaneError(in).value(choice);
}

/// Pixels whose sides differ by no more than this factor count as square.
constexpr double kSquare = 2.0;

bool sides_differ(const ViewInLight& view, double factor) noexcept {
  return max_of(view.pixel_x, view.pixel_y) > factor * min_of(view.pixel_x, view.pixel_y);
}

/// Slope of the edge of the image that is farthest off the view.
double widest_slope(const ViewInLight& view) noexcept {
  return max_of(max_of(std::abs(view.image_left), std::abs(view.image_right)),
                max_of(std::abs(view.image_bottom), std::abs(view.image_top)));
}

/// Whether rays fan out wide.
bool wide(const ViewInLight& view) noexcept {
  return widest_slope(view) >= kWideSlope;
}

/// How far texels lean, over their width, at most over the body. Under a view's perspective no farther than
/// its rays: more comes of a warp that makes a body narrow by shearing it.
double most_lean(const WarpInput& in, double kappa) noexcept {
  double lean = 0.0;
  for (const WarpInput::Point& p : in.body)
    lean = max_of(lean, std::abs(kappa * (p.x - in.centre)) / (1.0 + kappa * (p.y - in.y_min)));
  return lean;
}

double first_ratio(const WarpInput& in, const WarpChoice& choice) noexcept {
  if (choice.gain_ratio > 0.0) return choice.gain_ratio;
  const bool along_y = !in.light.perspective && choice.axis.x == 0.0 && choice.centre == 0.0 &&
                       choice.row_a.y == 0.0 && choice.row_b.x == 0.0;
  if (in.is_unwarped(choice)) return 1.0;
  const bool turned = in.unwarped.row_a.y != 0.0;
  if (along_y && !turned && in.objective == Objective::storage) {
    // A gain by the simplified weights above this factor is one by the exact error, too: they differ by the
    // obliquity of the view rays alone, where pixels are square and rays do not fan out wide.
    constexpr double kCertainRatio = 0.25;
    const double with = warp_error(in, choice.kappa).value(in.objective);
    const double plain = warp_error(in, 0.0).value(in.objective);
    if (with < kCertainRatio * plain && !wide(in.view) && !sides_differ(in.view, kSquare) &&
        most_lean(in, choice.kappa) < kWideSlope)
      return with / plain;
  }
  return sampled_ratio(in, choice, false, 0);
}

/// How much a warp may lose beyond what samples show. Where rays of the light oppose those of the eye, the
/// sides of a pixel on a surface between them turn through every direction, of which samples see a few.
double turned_pixels(const WarpInput& in, const WarpChoice& choice) noexcept {
  // Rounding of a camera's aspect is no difference.
  constexpr double kAlike = 1.01;
  if (!sides_differ(in.view, kAlike) || choice.kappa == 0.0) return 1.0;
  double least_cosine = 1.0;
  for (const Polytope::Vertex& v : in.polytope->vertices()) {
    const glm::dvec3 ray = safe_normalize(v.position, in.view.forward);
    const glm::dvec3 light = in.light.perspective ? safe_normalize(in.light.ray(v.position), {0.0, 0.0, -1.0})
                                                  : glm::dvec3(0.0, 0.0, -1.0);
    least_cosine = min_of(least_cosine, glm::dot(ray, light));
  }
  if (least_cosine > kOpposedCosine) return 1.0;
  const double longer = max_of(in.view.pixel_x, in.view.pixel_y) / min_of(in.view.pixel_x, in.view.pixel_y);
  return in.objective == Objective::storage ? longer * longer : longer;
}

/// The objective over what it is without a border: sides that are longer by the border show longer texels.
double border_factor(const PlanContext& c, const MapRequest& request, const WarpQuestion& question,
                     const WarpChoice& choice) noexcept {
  const PlaneMap plane = plane_map(question.points.points(), choice);
  const int width = request.slot.width > 0 ? request.slot.width : c.options.resolution.max_size;
  const int border = border_texels(c.options, width, border_share(c, request, question.points, plane));
  const double longer = 1.0 / (1.0 - 2.0 * border / width);
  return question.in.objective == Objective::storage ? longer * longer : longer;
}

/// The choice's border over that without a warp, each as border_factor. A warp that makes near texels short
/// makes a kernel in world units many texels wide there.
double border_ratio(const PlanContext& c, const MapRequest& request, const WarpQuestion& question,
                    const WarpChoice& choice) noexcept {
  if (!(c.options.filter.world > 0.0)) return 1.0;
  return border_factor(c, request, question, choice) /
         border_factor(c, request, question, question.in.unwarped);
}

/// A 95th percentile's ratio over several sets of points, of which the first had `ratio`: as many as it takes
/// to tell gain from loss.
[[gnu::noinline]] double percentile_ratio(const WarpInput& in, const WarpChoice& choice,
                                          double ratio) noexcept {
  // How far the ratio at one set may be off.
  constexpr double kOff = 0.2;
  PlaneError error(in, true, 1);
  // Of a body that shows in a few pixels it is the worst.
  if (!error.is_percentile()) return max_of(ratio, ratio_at(error, in, choice));
  double sum = ratio;
  for (int sets = 2;; ++sets) {
    sum += ratio_at(error, in, choice);
    const double mean = sum / sets, off = mean - 1.0;
    if (sets == kRaySets || !(off * off * sets < kOff * kOff)) return mean;
    error.take_set(sets);
  }
}

/// gain_ratio without borders.
double inner_ratio(const WarpInput& in, const WarpChoice& choice) noexcept {
  if (!usable(in.body, choice, in.most_stretch)) return std::numeric_limits<double>::infinity();
  // A tenth of a degree off a half space: of a thousand samples none says what its rays meet.
  constexpr double kTooWide = 500.0;
  if (!in.orthographic && widest_slope(in.view) > kTooWide) return 1.0;
  const double ratio = first_ratio(in, choice);
  // Points that are seen are what is counted: no others.
  if (in.objective == Objective::picture) return ratio;
  if (in.orthographic || !(ratio < 1.0)) return ratio;
  // The 95th percentile of so few points is off by up to a third, and where rays fan out wide the worst texel
  // lies between them: a gain below that must show in other points, too.
  constexpr double kSure = 0.6;
  if (in.objective == Objective::p95) return ratio > kSure ? percentile_ratio(in, choice, ratio) : ratio;
  // Where the light comes to meet the eye the worst texel may lie anywhere inside.
  const bool opposed = in.cos_gamma < kOpposedCosine && choice.kappa > 0.0;
  const bool exact = !in.light.perspective && !(in.tan_half_fov > kWideSlope);
  const double turned = turned_pixels(in, choice);
  if (!opposed && !(turned > 1.0) && (exact || !(ratio > kSure))) return ratio;
  // Of what two sets of points between the corners show, others may show a little more, and far more where
  // pixels are long.
  constexpr double kBetween = 1.05, kLong = 4.0;
  const double between = sides_differ(in.view, kLong) ? turned : min_of(turned, kBetween);
  double sampled = max_of(ratio, sampled_ratio(in, choice, true, 1));
  if (turned > 1.0) sampled = max_of(sampled, sampled_ratio(in, choice, true, 0)) * between;
  return sampled;
}

}  // namespace

double gain_ratio(const PlanContext& c, const MapRequest& request, const WarpQuestion& question,
                  const WarpChoice& choice) noexcept {
  const double ratio = inner_ratio(question.in, choice);
  return ratio < 1.0 ? ratio * border_ratio(c, request, question, choice) : ratio;
}

bool pays(const Warp& warp, const WarpChoice& choice, double ratio) noexcept {
  return std::isfinite(ratio) &&
         (ratio < 1.0 - kLeastWarpGain || (!warp.drop_without_gain && choice.kappa > 0.0));
}

namespace {

FocusedObjective objective_of(const PlanContext& c, const MapRequest& request,
                              const WarpQuestion& question) noexcept {
  const WarpInput& in = question.in;
  const WarpChoice choice = request.warp.choose(in);
  const double inner = error_under(in, in.unwarped);
  const double without = inner * border_factor(c, request, question, in.unwarped);
  if (in.is_unwarped(choice)) return {without, without};
  const double ratio = gain_ratio(c, request, question, choice);
  if (!pays(request.warp, choice, ratio)) return {without, without};
  const bool rotated = c.how.rotated;
  const WarpChoice drawn = rotated ? turned_to_least_area(in, choice) : choice;
  const double with = drawn.gain_ratio > 0.0 ? drawn.gain_ratio * inner : error_under(in, drawn);
  return {with * border_factor(c, request, question, drawn), without};
}

}  // namespace

FocusedObjective focused_objective(const PlanContext& c, const MapRequest& request) noexcept {
  const LightBody body = in_light_space(c, request);
  return with_question(c, request, body,
                       [&](const WarpQuestion& question) { return objective_of(c, request, question); });
}

PlaneMap focused_plane(const PlanContext& c, const MapRequest& request) noexcept {
  const LightBody body = in_light_space(c, request);
  return with_question(c, request, body, [&](const WarpQuestion& question) {
    const WarpInput& in = question.in;
    const WarpChoice choice = request.warp.choose(in);
    const double ratio = gain_ratio(c, request, question, choice);
    return plane_map(in.body, pays(request.warp, choice, ratio) ? choice : in.unwarped);
  });
}

}  // namespace gnomon
