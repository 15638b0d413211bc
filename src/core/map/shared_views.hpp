// Several cameras that share a plan's maps: the union of what they see, and each point with its own view
// depth.
#pragma once

#include <array>

#include "gnomon/extend/body.hpp"
#include "gnomon/plan.hpp"
#include "map/context.hpp"
#include "split/visible_depths.hpp"
#include "warp/plane_map.hpp"

namespace gnomon {

/// The camera's frustum between two view depths, relative to the origin.
[[nodiscard]] Polytope view_slice(const SharedView& view, double begin, double end) noexcept;

/// The camera's frustum, or a body round the receivers that several cameras see; relative to the camera.
[[nodiscard]] Polytope view_body(const PlanContext& c) noexcept;

/// The view depths at which any camera sees receivers.
[[nodiscard]] DepthRange receiver_depths(std::span<const SharedView> views) noexcept;

/// The part of the view's receivers between two of its depths.
[[nodiscard]] Polytope receivers_between(const SharedView& view, double begin, double end) noexcept;

/// A convex body round all of `parts`: the faces of each, moved out to hold the others.
[[nodiscard]] Polytope hull_of(std::span<const Polytope> parts) noexcept;

/// What cameras see, each by its own view depths.
struct ViewedPoints {
  std::array<ViewedPoint, kMaxBodyPoints> point;
  int count = 0;
  [[nodiscard]] std::span<const ViewedPoint> points() const noexcept {
    return {point.data(), static_cast<std::size_t>(count)};
  }
};
/// What all cameras see between two view depths, and a body round it, empty where no camera sees a receiver
/// there. `counted_from`: the view depth from which the error counts; nearer points are infinitely deep.
[[nodiscard]] ViewedPoints viewed_between(const PlanContext& c, double begin, double end, double counted_from,
                                          Polytope& hull) noexcept;
/// What the cameras see inside `body`, whatever its depth.
[[nodiscard]] ViewedPoints viewed_within(const PlanContext& c, const Polytope& body) noexcept;

/// A camera in the middle that looks the mean way over the images of all: what warps are turned along and
/// percentiles of errors are sampled from.
[[nodiscard]] Camera mean_camera(std::span<const SharedView> views, const glm::dvec3& origin) noexcept;

}  // namespace gnomon
