// A body's vertices in light space, and the body as warps see it.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "geometry/first_hits.hpp"
#include "gnomon/extend/body.hpp"
#include "gnomon/extend/warp.hpp"
#include "map/context.hpp"
#include "map/light_body.hpp"
#include "warp/plane_map.hpp"

namespace gnomon {

/// The body's vertices in light space, with the extent of a unit of image slope there.
struct LightBody {
  std::array<WarpInput::Point, kMaxBodyPoints> point;
  int count = 0;
  PointBounds bounds;                    // of the points
  double nearest = 1.0, farthest = 1.0;  // distances along a local light's axis
  [[nodiscard]] std::span<const WarpInput::Point> points() const noexcept {
    return {point.data(), static_cast<std::size_t>(count)};
  }
  /// Their map, as plane_map.
  [[nodiscard]] PlaneMap under(const WarpChoice& choice) const noexcept {
    return plane_map(points(), bounds, choice);
  }
};
[[nodiscard]] LightBody in_light_space(const PlanContext& c, const MapRequest& request) noexcept;

/// What a question about a body with a focus refers to. Few have one, and this is long.
struct WarpFocus {
  Polytope part;     // of the body in the focus, along the frame's axes
  LightBody judged;  // the body's points
};

/// How a warp is asked about a body, with everything that the question refers to.
struct WarpQuestion {
  Polytope body_light;
  Plane receiver;                                  // along the frame's axes, where the request has one
  const LightBody& points;                         // as warps judge them
  std::array<glm::dvec3, SeenPoints::kMost> seen;  // those of the context inside the body
  WarpInput in;
  /// `body`: the request's, in light space; refers to it. `focus`: nullptr where the options have none.
  WarpQuestion(const PlanContext& c, const MapRequest& request, const LightBody& body,
               WarpFocus* focus) noexcept;
  WarpQuestion(const WarpQuestion&) = delete;
  WarpQuestion& operator=(const WarpQuestion&) = delete;
};
template <class Use>
[[gnu::noinline]] auto with_focused_question(const PlanContext& c, const MapRequest& request,
                                             const LightBody& body, const Use& use) noexcept {
  WarpFocus focus;
  WarpQuestion question(c, request, body, &focus);
  return use(question);
}
/// Calls `use` with the question about a body. Only one with a focus makes room for it.
template <class Use>
auto with_question(const PlanContext& c, const MapRequest& request, const LightBody& body,
                   const Use& use) noexcept {
  if (!c.options.warp.focus.empty()) return with_focused_question(c, request, body, use);
  WarpQuestion question(c, request, body, nullptr);
  return use(question);
}
/// The body's points as warps judge them: with the focus's own, all others as much deeper as they count less.
/// `focus`: the part of the body in the focus, relative to the camera; empty where there is none.
[[nodiscard]] LightBody judged_body(const PlanContext& c, const MapRequest& request,
                                    Polytope& focus) noexcept;

/// The receivers inside the rectangle of `plane`, as body and points of a request of their own.
class ServedBody {
 public:
  /// The request's own body where it names no other receivers.
  ServedBody(const PlanContext& c, const MapRequest& request, const LightBody& body,
             const PlaneMap& plane) noexcept;
  ServedBody(const ServedBody&) = delete;
  ServedBody& operator=(const ServedBody&) = delete;

  [[nodiscard]] const MapRequest& request() const noexcept {
    return served_request_ ? *served_request_ : own_;
  }
  [[nodiscard]] const LightBody& points() const noexcept { return *points_; }

 private:
  Polytope served_;
  LightBody served_points_;
  const MapRequest& own_;
  std::optional<MapRequest> served_request_;  // none: the request's own
  const LightBody* points_;
};

}  // namespace gnomon
