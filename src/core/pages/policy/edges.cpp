// Where would larger texels show? Only at shadow edges: points without one in sight get texels eight times
// the target. Based on: Fernando, Fernandez, Bala, Greenberg, "Adaptive Shadow Maps", 2001; Lefohn, Sengupta,
// Kniss, Strzodka, Owens, "Dynamic Adaptive Shadow Maps on Graphics Hardware", 2005. Edges come from the
// image of the last frame.
#include "pages/base.hpp"

namespace gnomon::page_policies {
namespace {

// Three octaves: an edge that appears between two frames is seen, and refined in the next.
constexpr double kCoarserOffEdges = 8.0;

}  // namespace

const PagePolicy edges{
    .name = "edges",
    .summary = "the target at shadow edges of the last frame, eight times as coarse elsewhere",
    .octaves = false,
    .shares_finer = true,
    .feedback = kShadowEdge,
    .assign = [](PageContext& c) noexcept {
      c.for_each_point([&](PagePoint& point, std::size_t index) {
        const bool edge = (c.feedback(index) & kShadowEdge) != 0;
        c.set_step(point, c.step_for(c.excess(point) / (edge ? c.target : kCoarserOffEdges * c.target)));
      });
    }};

}  // namespace gnomon::page_policies
