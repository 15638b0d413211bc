// All receivers that a map may serve: those it was fitted to, or all of the plan's that it holds.
#pragma once

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

  [[nodiscard]] const MapRequest& request() const noexcept { return request_; }
  [[nodiscard]] const LightBody& points() const noexcept { return *points_; }

 private:
  Polytope held_;
  LightBody held_points_;
  MapRequest request_;
  const LightBody* points_;
};

}  // namespace gnomon
