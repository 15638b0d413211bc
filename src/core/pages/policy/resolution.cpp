// Which texels do visible points need? Each point gets the coarsest level whose texels are no larger than its
// pixel. Based on: Lefohn, Sengupta, Owens, "Resolution-Matched Shadow Maps", 2007; Giegl, Wimmer, "Fitted
// Virtual Shadow Maps", 2007 (one pass over the visible points, no search for edges).
#include "pages/base.hpp"

namespace gnomon::page_policies {

const PagePolicy resolution{.name = "resolution",
                            .summary = "what every visible point needs for the target error",
                            .octaves = false,
                            .shares_finer = true,
                            .feedback = 0,
                            .assign = [](PageContext& c) noexcept { c.set_steps_by_need(); }};

}  // namespace gnomon::page_policies
