// Does filtering only the tiles that a frame reads change the mask? Flights with the rule against the same
// flights with whole maps, bit by bit.
#include <gtest/gtest.h>

#include <string>

#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/load.hpp"
#include "prune_pair.hpp"

namespace gnomon::render {
namespace {

constexpr int kWidth = 96, kHeight = 54, kMapSize = 512;
constexpr PruneRules kHolding = kPruneNothing.with(PruneRule::held_maps);
constexpr PruneRules kScrolling = kHolding.with(PruneRule::scrolled_maps);

FilterSettings parsed(const std::string& text) {
  const ParsedFilter filter = parse_filter(text);
  EXPECT_EQ(filter.error, "") << text;
  return filter.settings;
}

struct Flight {
  const char* filter;
  Fit fit;
  PruneRules cached;
  int cascades;
};

/// Work of all frames with the rule, in texels.
struct Tally {
  std::uint64_t filtered = 0, saved = 0;
  std::size_t shadowed = 0;
  int held = 0;
};

/// Small steps, a stay, and jumps of the camera: maps are redrawn, kept and scrolled.
void fly(Pair& pair, const Flight& flight, Tally& tally) {
  const FilterSettings filter = parsed(flight.filter);
  PlanOptions options;
  options.resolution.max_size = kMapSize;
  options.cascades = flight.cascades;
  options.fit = flight.fit;
  options.prune = kPruneNothing;
  set_margin(filter, options);
  const PreparedFilter with = pair.pruned.prepare(filter), without = pair.full.prepare(filter);
  const CameraPath path = default_path(pair.scene);
  for (const double t : {0.10, 0.1005, 0.101, 0.101, 0.101, 0.101, 0.101, 0.102, 0.45, 0.4502, 0.8, 0.101}) {
    const Camera camera = path.at(t, kWidth, kHeight);
    const ShadowPlan plan = make_plan(camera, DirectionalLight{{0.4, -1.0, 0.3}}, pair.bounds(), options);
    ASSERT_GT(plan.map_count, 0);
    FrameOptions pruned = mask_only(flight.cached.with(PruneRule::unread_tiles));
    pruned.time_passes = true;
    const FrameStats stats = pair.pruned.draw(plan, camera, with, pruned);
    pair.full.draw(plan, camera, without, mask_only(flight.cached));
    const FloatImage mask = pair.full.mask();
    ASSERT_EQ(differing(pair.pruned.mask(), mask), 0u) << flight.filter << " at " << t;
    tally.filtered += stats.filtered_texels;
    tally.saved += stats.saved[static_cast<std::size_t>(PruneRule::unread_tiles)].filtered;
    tally.shadowed += shadowed(mask);
    for (int i = 0; i < stats.map_count; ++i)
      tally.held += stats.map[static_cast<std::size_t>(i)].held ? 1 : 0;
  }
}

TEST(UnreadTiles, change_no_bit_of_the_mask_under_any_kind_of_blur) {
  Pair pair(load_builtin("fence"));
  for (const Flight& flight :
       {Flight{"vsm:radius=3", Fit::tight, kHolding, 4}, Flight{"esm:radius=3", Fit::stable, kScrolling, 2},
        Flight{"esm:radius=2,c=900", Fit::tight, kHolding, 1},
        Flight{"convolution:radius=2", Fit::stable, kScrolling, 2},
        Flight{"power_cdf:radius=0", Fit::stable, kHolding, 2},
        Flight{"evsm4:unit=world,radius=0.1", Fit::tight, kHolding, 2},
        Flight{"power_cdf:unit=world,radius=0.3", Fit::stable, kScrolling, 2},
        Flight{"vsm:mipmap=1,radius=1", Fit::tight, kHolding, 2},
        Flight{"vsm:mipmap=1,anisotropy=16", Fit::stable, kScrolling, 2},
        Flight{"power_cdf:mipmap=1,anisotropy=4", Fit::tight, kHolding, 1}}) {
    Tally tally;
    fly(pair, flight, tally);
    EXPECT_GT(tally.shadowed, 1000u) << flight.filter;
    EXPECT_GT(tally.filtered, 0u) << flight.filter;
    EXPECT_GT(tally.saved, 0u) << flight.filter;
    if (flight.fit == Fit::stable) {
      EXPECT_GT(tally.held, 2) << flight.filter;
    }
  }
}

TEST(UnreadTiles, save_most_of_the_blur_where_the_view_reads_little) {
  Pair pair(load_builtin("city"));
  Tally tally;
  fly(pair, {"vsm:radius=3", Fit::tight, kPruneNothing, 1}, tally);
  EXPECT_GT(tally.saved, tally.filtered);
}

}  // namespace
}  // namespace gnomon::render
