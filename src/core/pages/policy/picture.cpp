// Which pages leave the fewest pixels misclassified? Where a shadow edge passes, the share of such pixels
// grows with m: about as its square root, as thin shadows are lost once texels are wider. A page is worth
// opening where it lessens that by more than its price. The price rises until the pool holds the pages.
#include "pages/tree.hpp"

namespace gnomon::page_policies {
namespace {

void assign(PageContext& c) noexcept {
  PageTree tree(c);
  // A pool's pages have this weight in the mean. Pages are opened in proportion to 1 / m^2, so that one of
  // them lessens the sum of sqrt(m) over its points by a fourth: the price makes c.target the m of such
  // pages.
  const double weight_of_page = tree.weight() / c.options.capacity;
  // Above 0, so that no page is opened for nothing.
  constexpr double kFirst = 0x1p-20;
  const double target = std::sqrt(c.options.target_m);
  c.chosen = tree.choose(0.25 * weight_of_page * (std::sqrt(c.target) - target * (1.0 - kFirst)));
  c.for_each_point([&](PagePoint& point, std::size_t) { c.set_step(point, 0); });
}

}  // namespace

const PagePolicy picture{
    .name = "picture",
    .summary = "what lessens the pixels that are expected to be wrong most, for each page",
    .octaves = false,
    .shares_finer = true,
    .chooses = true,
    .feedback = kShadowEdge,
    .assign = assign};

}  // namespace gnomon::page_policies
