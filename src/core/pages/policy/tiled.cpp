// How is a fixed number of texels best spent? Tiles of one map share the pool by what lies in them: near
// surfaces and depth edges weigh more. Based on: Arvo, "Tiled Shadow Maps", 2004. His pixels' weights become
// those of the visible points.
#include <algorithm>

#include "pages/base.hpp"

namespace gnomon::page_policies {
namespace {

constexpr int kTiles = 16;  // along each side of the base
// A depth edge weighs as much as so many points without one.
constexpr double kEdgeWeight = 8.0;

struct Tiles {
  std::array<double, std::size_t{kMaxMaps} * kTiles * kTiles> weight{};

  [[nodiscard]] static std::size_t index_of(const PageContext& c, const PagePoint& point) noexcept {
    const PageBase& base = c.base_of(point.level);
    const glm::dvec2 at = (glm::dvec2(point.x, point.y) - base.low) / (base.high - base.low) * double{kTiles};
    const auto tile = [](double v) { return static_cast<std::size_t>(clamp_to(v, 0.0, kTiles - 1)); };
    return (point.level / kLadder * kTiles + tile(at.y)) * kTiles + tile(at.x);
  }
};

void assign(PageContext& c) noexcept {
  Tiles tiles;
  double all = 0.0;
  // Nearer surfaces need smaller texels: the need itself says how near.
  c.for_each_point([&](PagePoint& point, std::size_t index) {
    const double near = clamp_to(max_of(point.need_x, point.need_y), 0.0, kMaxVirtualTexels);
    const double weight = near * ((c.feedback(index) & kDepthEdge) != 0 ? kEdgeWeight : 1.0);
    tiles.weight[Tiles::index_of(c, point)] += weight;
    all += weight;
  });
  // A tile that gets a share of the pool is divided into about so many pages: 4^octaves of them fill a tile
  // whole. A pool in which that does not fit is spent on coarser tiles.
  const double coarser = c.target / c.options.target_m;
  c.for_each_point([&](PagePoint& point, std::size_t) {
    const double share = all > 0.0 ? tiles.weight[Tiles::index_of(c, point)] / all : 0.0;
    const double along = std::sqrt(share * c.options.capacity);
    c.set_step(point, c.step_for(max_of(kTiles * along / coarser, 1.0)));
  });
}

}  // namespace

const PagePolicy tiled{.name = "tiled",
                       .summary = "tiles of one map share the pool by nearness and depth edges",
                       .octaves = false,
                       .shares_finer = true,
                       .feedback = kDepthEdge,
                       .assign = assign};

}  // namespace gnomon::page_policies
