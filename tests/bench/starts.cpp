// At which fall-offs should `optimal` begin under a local light? Those thirteen of many that together come
// nearest to the best of all of them, beside the three that go by what pixels cover: kLocalByStorage and
// kLocalByWorst in src/core/warp/optimal.cpp.
//   bench_starts [RANDOM LIGHTS]     1500 of them unless told
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "gnomon/extend/warp.hpp"
#include "gnomon/gnomon.hpp"
#include "support/seeded_input.hpp"
#include "warp/plane_error.hpp"
#include "warp/row_search.hpp"

namespace gnomon {
namespace {

constexpr double kPi = 3.141592653589793;
// Of those that are chosen, and of those that are always there.
constexpr std::size_t kChosen = 13;
constexpr std::array<double, 3> kFits = {1.0, 0.75, 1.3};
// Logarithm beyond which a start is as bad as none.
constexpr double kHopeless = 8.0;

/// All fall-offs on the right side, as shares of one that goes by the ratio of depths; those to the left are
/// their mirror images.
std::vector<FallOff> all_starts() {
  constexpr int kDegrees = 15;
  std::vector<FallOff> starts{{0.0, 0.0}};
  for (const double length : {0.12, 0.2, 0.28, 0.36, 0.44, 0.52, 0.6, 0.7, 0.85, 1.0, 1.2}) {
    for (int degrees = 0; degrees <= 180; degrees += kDegrees) {
      const double angle = degrees * kPi / 180.0;
      starts.push_back({degrees % 180 == 0 ? 0.0 : length * std::sin(angle), length * std::cos(angle)});
    }
  }
  return starts;
}
const std::vector<FallOff> starts = all_starts();
std::size_t slots(std::size_t start) {
  return starts[start].x == 0.0 ? 1 : 2;
}

/// Of one body: the logarithm of each start's value over the least, and what is there without them.
struct Row {
  std::vector<double> value;
  double fitted;
};
std::vector<Row> rows;

WarpChoice judge(const WarpInput& input) noexcept {
  if (input.flat()) return input.unwarped;
  PlaneError error(input, true);
  if (error.corner_count() == 0) return input.unwarped;
  RowSearch search(input, error);
  const double ratio = search.ahead(1.0).y;
  if (is_line(input, error.body()) || !(ratio > 0.0)) return input.unwarped;
  std::vector<FallOff> tried;
  for (const double by : kFits) tried.push_back({by * search.fitted().x, by * search.fitted().y});
  for (const FallOff& start : starts) {
    tried.push_back({start.x * ratio, start.y * ratio});
    tried.push_back({-start.x * ratio, start.y * ratio});
  }
  std::vector<double> value;
  for (std::size_t i = 0; i < tried.size(); i += kFloatLanes) {
    RowLanes lanes;
    for (std::size_t l = 0; l < kFloatLanes; ++l) {
      const double angle = 3.0 * kPi / 16.0;
      lanes.set(l, {tried[std::min(i + l, tried.size() - 1)],
                    {std::cos(angle), std::sin(angle)},
                    {-std::sin(angle), std::cos(angle)},
                    0.0});
    }
    search.find_rows(kPi / 8.0, lanes);
    for (std::size_t l = 0; l < kFloatLanes && i + l < tried.size(); ++l)
      value.push_back(std::log(std::max(lanes.value[l], std::numeric_limits<float>::min())));
  }
  const double least = *std::min_element(value.begin(), value.end());
  Row row{{}, kHopeless};
  for (std::size_t i = 0; i < kFits.size(); ++i) row.fitted = std::min(row.fitted, value[i] - least);
  for (std::size_t i = kFits.size(); i < value.size(); i += 2)
    row.value.push_back(std::min(kHopeless, std::min(value[i], value[i + 1]) - least));
  rows.push_back(row);
  return input.unwarped;
}
const Warp kJudge{"starts", "tries many starts", judge, true};

/// What the chosen starts leave over the best, of each body; without the start at `skipped`.
std::vector<double> left_over(const std::vector<std::size_t>& chosen, std::size_t skipped) {
  std::vector<double> result;
  for (const Row& row : rows) {
    double least = row.fitted;
    for (std::size_t i = 0; i < chosen.size(); ++i)
      least = i == skipped ? least : std::min(least, row.value[chosen[i]]);
    result.push_back(least);
  }
  return result;
}

/// The start that gains most for each of its places, among those that take no more than `room`.
std::size_t best_of(const std::vector<double>& left, std::size_t least_room, std::size_t room) {
  std::size_t best = 0;
  double most = -1.0;
  for (std::size_t start = 0; start < starts.size(); ++start) {
    if (slots(start) > room || slots(start) < least_room) continue;
    double gain = 0.0;
    for (std::size_t i = 0; i < rows.size(); ++i) gain += std::max(0.0, left[i] - rows[i].value[start]);
    gain /= static_cast<double>(slots(start));
    if (!(gain > most)) continue;
    most = gain;
    best = start;
  }
  return best;
}

void print_best(Objective objective, int lights) {
  rows.clear();
  test::SeededInput input;
  constexpr std::uint64_t kFirstSeed = 100000;  // others than the tests draw
  for (std::uint64_t seed = kFirstSeed; static_cast<int>(rows.size()) < lights; ++seed) {
    test::seed_input(seed, test::Extremes::ordinary, input);
    if (std::holds_alternative<DirectionalLight>(input.light) || input.camera.orthographic) continue;
    PlanOptions options;
    options.cascades = 1;
    options.warp.warp = &kJudge;
    options.warp.objective = objective;
    options.prune = kPruneNothing;
    (void)make_plan(input.camera, input.light, input.bounds(), options);
  }
  const auto none = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> chosen;
  for (std::size_t used = 0; used < kChosen; used += slots(chosen.back()))
    chosen.push_back(best_of(left_over(chosen, none), 1, kChosen - used));
  constexpr int kRounds = 4;  // of exchanging one for a better one
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < chosen.size(); ++i)
      chosen[i] = best_of(left_over(chosen, i), slots(chosen[i]), slots(chosen[i]));
  }
  double mean = 0.0;
  for (const double left : left_over(chosen, none)) mean += left / static_cast<double>(rows.size());
  std::printf("%s, %zu bodies: %.4f over the best of %zu, in the logarithm\n",
              std::string(to_string(objective)).c_str(), rows.size(), mean, starts.size());
  for (const std::size_t start : chosen)
    std::printf("  %s%.3f, %.3f\n", slots(start) == 2 ? "+-" : "", starts[start].x, starts[start].y);
}

}  // namespace
}  // namespace gnomon

int main(int argc, char** argv) {
  const int lights = argc > 1 ? std::atoi(argv[1]) : 1500;
  if (lights < 1) {
    std::fprintf(stderr, "usage: %s [RANDOM LIGHTS]\n", argv[0]);
    return 2;
  }
  for (const gnomon::Objective objective : {gnomon::Objective::storage, gnomon::Objective::p95})
    gnomon::print_best(objective, lights);
  return 0;
}
