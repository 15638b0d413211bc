// What do engines do? Levels in whole octaves of square texels, ceil(log2) of the footprint, one page for
// every point at its own level: the baseline that the other policies are compared with. Based on: Tanner,
// Migdal, Jones, "The Clipmap: A Virtual Mipmap", 1998; Unreal Engine 5, "Virtual Shadow Maps", 2022.
#include "pages/base.hpp"

namespace gnomon::page_policies {

const PagePolicy clipmap{"clipmap",
                         "octaves of square texels by footprint, as engines do: the baseline",
                         true,
                         false,
                         0,
                         [](PageContext& c) noexcept {
                           const double inverse = 1.0 / c.target;
                           c.for_each_point([&](PagePoint& point, std::size_t) {
                             c.set_step(point, c.step_for(c.excess(point) * inverse));
                           });
                         }};

}  // namespace gnomon::page_policies
