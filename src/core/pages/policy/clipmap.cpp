// What do engines do? Levels in whole octaves of square texels, ceil(log2) of the footprint, one page for
// every point at its own level: the baseline that the other policies are compared with. Based on: Tanner,
// Migdal, Jones, "The Clipmap: A Virtual Mipmap", 1998; Unreal Engine 5, "Virtual Shadow Maps", 2022.
#include "pages/base.hpp"

namespace gnomon::page_policies {

const PagePolicy clipmap{.name = "clipmap",
                         .summary = "octaves of square texels by footprint, as engines do: the baseline",
                         .octaves = true,
                         .shares_finer = false,
                         .feedback = 0,
                         .assign = [](PageContext& c) noexcept { c.set_steps_by_need(); }};

}  // namespace gnomon::page_policies
