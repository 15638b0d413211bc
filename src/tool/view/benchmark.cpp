// A fixed flight along the path: the same frames on every machine, and a row of figures for each.
#include "benchmark.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "gnomon/report/csv.hpp"

namespace gnomon::tool::view {
namespace {

std::string row_of(const Side& side) {
  std::uint64_t draws = 0, triangles = 0;
  for (int i = 0; i < side.stats.map_count; ++i) {
    draws += side.stats.map[static_cast<std::size_t>(i)].draws;
    triangles += side.stats.map[static_cast<std::size_t>(i)].triangles;
  }
  return fmt::format("{:.1f},{:.3f},{:.3f},{:.3f},{:.3f},{:.5g},{:.5g},{:.5g},{},{},{},{},{},{},{}",
                     side.plan_ms * 1e3, side.stats.ms(render::Pass::shadow_maps),
                     side.stats.ms(render::Pass::prefilter), side.stats.ms(render::Pass::mask),
                     side.plan_ms + side.stats.shadow_ms(), side.m.p50, side.m.p95, side.m.max,
                     side.pages ? 0 : side.plan.map_count, side.stats.pages, side.stats.pages_drawn,
                     side.stats.texels, draws, triangles, side.stats.map_bytes);
}

}  // namespace

Benchmark::Benchmark(const State& from, int frames, std::filesystem::path file, std::string renderer)
    : from_(from), frames_(frames), file_(std::move(file)), renderer_(std::move(renderer)) {}

State Benchmark::next() const {
  State state = from_;
  // Before the first frame the last one: what the first keeps from it is then as little as all others keep.
  const double share = static_cast<double>(frame_ < 0 ? frames_ - 1 : frame_) / frames_,
               seconds = share * from_.motion.path_seconds;
  state.eye.reset();
  state.frozen.reset();
  state.path_time = share;
  if (from_.motion.sun) turn_sun(state, seconds);
  if (from_.playing.on) state.playing.time_s = from_.playing.time_s + seconds * from_.playing.speed;
  return state;
}

void Benchmark::take(const Stage& stage, double frame_ms) {
  if (frame_++ < 0) return;
  const Camera& camera = stage.camera();
  const bool both = from_.comparison != Comparison::off && !from_.b_is_truth;
  for (int side = 0; side < (both ? 2 : 1); ++side)
    rows_ += fmt::format("{},{},{:.6g},{},{:.3f},{},{},{},{}\n", frame_ - 1, side == 0 ? 'A' : 'B',
                         static_cast<double>(frame_ - 1) / frames_, row_of(stage.side(side)), frame_ms,
                         camera.width, camera.height, report::csv_field(stage.loaded().name),
                         report::csv_field(renderer_));
  total_ms_.push_back(stage.side(0).plan_ms + stage.side(0).stats.shadow_ms());
}

std::string Benchmark::text() const {
  // Wall clock after the driver has finished; on software OpenGL its timer queries do not count the work.
  return "frame,side,path_time,plan_us,maps_ms,prefilter_ms,lookup_ms,shadows_ms,m_p50,m_p95,m_max,"
         "maps,pages,pages_drawn,texels,draws,triangles,map_bytes,"
         "frame_ms,width,height,scene,renderer\n" +
         rows_;
}

std::string Benchmark::summary() const {
  std::vector<double> sorted = total_ms_;
  std::sort(sorted.begin(), sorted.end());
  const auto at = [&sorted](double share) {
    return sorted[static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size() - 1)))];
  };
  return sorted.empty() ? std::string()
                        : fmt::format("{} frames, shadows {:.2f} ms (median), {:.2f} ms (95 %)",
                                      sorted.size(), at(0.5), at(0.95));
}

}  // namespace gnomon::tool::view
