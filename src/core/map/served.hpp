// All receivers that a map may serve: those it was fitted to, or all of the plan's that it holds.
#pragma once

#include <optional>

#include "map/light_body.hpp"

namespace gnomon {

/// The receivers inside the rectangle of `plane`, as body and points of a request of their own.
class ServedBody {
 public:
  /// The request's own body where it names no other receivers.
  ServedBody(const PlanContext& c, const MapRequest& request, const LightBody& body,
             const PlaneMap& plane) noexcept;
  ServedBody(const ServedBody&) = delete;
  ServedBody& operator=(const ServedBody&) = delete;

  [[nodiscard]] const MapRequest& request() const noexcept { return held_request_ ? *held_request_ : own_; }
  [[nodiscard]] const LightBody& points() const noexcept { return *points_; }

 private:
  Polytope held_;
  LightBody held_points_;
  const MapRequest& own_;
  std::optional<MapRequest> held_request_;  // none: the request's own
  const LightBody* points_;
};

}  // namespace gnomon
