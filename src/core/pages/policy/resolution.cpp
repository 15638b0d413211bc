// Which texels do visible points need? Each point gets the coarsest level whose texels are no larger than its
// pixel. Based on: Lefohn, Sengupta, Owens, "Resolution-Matched Shadow Maps", 2007; Giegl, Wimmer, "Fitted
// Virtual Shadow Maps", 2007 (one pass over the visible points, no search for edges).
#include "pages/base.hpp"

namespace gnomon::page_policies {

const PagePolicy resolution{"resolution",
                            "what every visible point needs for the target error",
                            false,
                            true,
                            0,
                            [](PageContext& c) noexcept {
                              const double inverse = 1.0 / c.target;
                              c.for_each_point([&](PagePoint& point, std::size_t) {
                                c.set_step(point, c.step_for(c.excess(point) * inverse));
                              });
                            }};

}  // namespace gnomon::page_policies
