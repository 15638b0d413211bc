// How near are `optimal` and `optimal_thorough` to the best projective map there is? A brute-force search
// over axis, strength and both rows (centre, turn and slant), for the cases in tests/data/cases and for
// random cameras, by the plan's own objective; and what such maps would come to by the measure of
// bench_plan_table, beside its targets.
//   bench_brute_force [RANDOM CAMERAS]     200 of them unless told
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <variant>
#include <vector>

#include "case_table.hpp"
#include "gnomon/extend/warp.hpp"
#include "support/seeded_input.hpp"
#include "warp/plane_error.hpp"
#include "warp/plane_map.hpp"

namespace gnomon {
namespace {

constexpr double kPi = 3.141592653589793;

/// Angle of the axis, logarithm of kappa times length, angles of both rows over the image scaled to a square.
using Position = std::array<double, 4>;
struct Found {
  Position at{};
  double value = 0.0;
};

class Brute {
 public:
  explicit Brute(const WarpInput& input) : in_(input), error_(input, true) {
    double nearest = 1e300, farthest = 0.0;
    for (const WarpInput::Point& p : input.body) {
      if (!std::isfinite(p.depth)) continue;
      nearest = std::min(nearest, p.depth);
      farthest = std::max(farthest, p.depth);
    }
    strongest_ = std::log(8.0 * farthest / nearest);
  }
  [[nodiscard]] double value(const WarpChoice& choice) {
    const double v = error_.value(choice);
    return std::isfinite(v) && usable(in_.body, choice, in_.most_stretch) ? v : 1e300;
  }
  [[nodiscard]] WarpChoice choice(const Position& p) const {
    WarpChoice c;
    c.axis = {std::sin(p[0]), std::cos(p[0])};
    const double y = in_.light.perspective ? in_.y_min : 0.0;
    c.centre = in_.centre * c.axis.y - y * c.axis.x;
    double low = 1e300, high = -1e300;
    for (const WarpInput::Point& b : in_.body) {
      const double u = b.x * c.axis.x + b.y * c.axis.y;
      low = std::min(low, u);
      high = std::max(high, u);
    }
    const double most = std::log(std::max(in_.most_stretch - 1.0, 1e-3)) - 1e-9;
    c.kappa = std::exp(std::clamp(p[1], -9.0, std::min(most, 20.7))) / std::max(high - low, 1e-300);
    const PlaneMap map = plane_map(in_.body, c);
    const auto row = [&](double x, double v) {
      const glm::dvec2 r{x / (map.a_max - map.a_min), v / (map.b_max - map.b_min)};
      return r / std::hypot(r.x, r.y);
    };
    c.row_a = row(std::cos(p[2]), std::sin(p[2]));
    c.row_b = row(-std::sin(p[3]), std::cos(p[3]));
    return c;
  }
  [[nodiscard]] Found search() {
    constexpr int kAxes = 20, kStrengths = 14, kRows = 8, kWalks = 8;
    std::vector<Found> grid;
    for (int a = 0; a < kAxes; ++a) {
      for (int t = 0; t < kStrengths; ++t) {
        Found best{{}, 1e301};
        for (int i = 0; i < kRows * kRows; ++i) {
          const double row_a = kPi * (i % kRows) / kRows, row_b = kPi * (i / kRows) / kRows;
          // Rows that lean on each other make no map.
          if (std::abs(std::cos(row_a - row_b)) < 0.1) continue;
          const Found next =
              at({2.0 * kPi * a / kAxes, -3.0 + (strongest_ + 3.0) * t / (kStrengths - 1.0), row_a, row_b});
          if (next.value < best.value) best = next;
        }
        grid.push_back(best);
      }
    }
    std::sort(grid.begin(), grid.end(), [](const Found& a, const Found& b) { return a.value < b.value; });
    Found best = grid.front();
    for (std::size_t i = 0; i < kWalks; ++i) {
      Found found = grid[i];
      for (const double step : {0.7, 0.3, 0.1}) found = walk(found, step);
      if (found.value < best.value) best = found;
    }
    for (const double step : {0.5, 0.05, 0.5, 0.05}) best = walk(best, step);
    return best;
  }

 private:
  [[nodiscard]] Found at(const Position& p) { return {p, value(choice(p))}; }
  /// Nelder and Mead's simplex until its corners agree.
  [[nodiscard]] Found walk(const Found& start, double scale) {
    constexpr Position kStep = {0.35, -0.5, 0.2, 0.2};
    constexpr double kAgree = 1e-7;
    std::array<Found, 5> s;
    s[0] = start;
    for (std::size_t i = 0; i < 4; ++i) {
      Position p = start.at;
      p[i] += kStep[i] * scale;
      s[i + 1] = at(p);
    }
    for (int i = 0; i < 300; ++i) {
      std::sort(s.begin(), s.end(), [](const Found& a, const Found& b) { return a.value < b.value; });
      if (s[4].value - s[0].value < kAgree * s[0].value) break;
      const auto tried = [&](double reach) {
        Position p;
        for (std::size_t k = 0; k < 4; ++k) {
          const double centre = 0.25 * (s[0].at[k] + s[1].at[k] + s[2].at[k] + s[3].at[k]);
          p[k] = centre * (1.0 + reach) - s[4].at[k] * reach;
        }
        return at(p);
      };
      const Found reflected = tried(1.0);
      if (reflected.value < s[0].value) {
        const Found expanded = tried(2.0);
        s[4] = expanded.value < reflected.value ? expanded : reflected;
      } else if (reflected.value < s[3].value) {
        s[4] = reflected;
      } else {
        const Found contracted = tried(reflected.value < s[4].value ? 0.5 : -0.5);
        if (contracted.value < s[4].value) {
          s[4] = contracted;
        } else {
          for (std::size_t k = 1; k < 5; ++k) {
            Position p;
            for (std::size_t d = 0; d < 4; ++d) p[d] = 0.5 * (s[0].at[d] + s[k].at[d]);
            s[k] = at(p);
          }
        }
      }
    }
    return *std::min_element(s.begin(), s.end(),
                             [](const Found& a, const Found& b) { return a.value < b.value; });
  }
  const WarpInput& in_;
  PlaneError error_;
  double strongest_;
};

/// Of a warp that is searched for, for each body asked about.
struct Ratios {
  const Warp* warp;
  std::vector<double> over_brute;  // its value over that of brute force
  std::vector<double> over_other;  // and over that of the best warp in closed form
};
std::array<Ratios, 2> ratios = {{{&warps::optimal, {}, {}}, {&warps::optimal_thorough, {}, {}}}};
void forget() {
  for (Ratios& r : ratios) {
    r.over_brute.clear();
    r.over_other.clear();
  }
}

WarpChoice judge(const WarpInput& in) noexcept {
  Brute brute(in);
  const double without = brute.value(in.unwarped);
  if (in.flat() || !(without > 0.0 && without < 1e299)) return in.unwarped;
  // A line in the light plane has no width to speak of.
  glm::dvec2 low(1e300), high(-1e300);
  for (const WarpInput::Point& p : in.body) {
    low = glm::min(low, glm::dvec2(p.x, p.y));
    high = glm::max(high, glm::dvec2(p.x, p.y));
  }
  const glm::dvec2 extent = high - low;
  if (std::min(extent.x, extent.y) < 1e-4 * std::max(extent.x, extent.y)) return in.unwarped;
  const Found best = brute.search();
  double other = without;
  for (const Warp* warp : all_warps()) {
    if (warp != ratios[0].warp && warp != ratios[1].warp)
      other = std::min(other, brute.value(warp->choose(in)));
  }
  for (Ratios& r : ratios) {
    const double value = std::min(brute.value(r.warp->choose(in)), without);
    r.over_brute.push_back(value / std::min(best.value, without));
    r.over_other.push_back(value / other);
  }
  return best.value < without ? brute.choice(best.at) : in.unwarped;
}
const Warp kBrute{"brute_force", "every axis, strength and row", judge, true};

double share_of(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1,
                         static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

void print_ratios(const char* what, Objective objective) {
  for (const Ratios& r : ratios) {
    const auto within =
        std::count_if(r.over_brute.begin(), r.over_brute.end(), [](double ratio) { return ratio <= 1.03; });
    std::printf(
        "%-8s %-22s %-17s over brute force, %3zu bodies: median %.4f, 90 %% %.4f, worst %.4f; within 3 %%: "
        "%.0f %%; over the best warp in closed form: worst %.4f\n",
        std::string(to_string(objective)).c_str(), what, std::string(r.warp->name).c_str(),
        r.over_brute.size(), share_of(r.over_brute, 0.5), share_of(r.over_brute, 0.9),
        share_of(r.over_brute, 1.0),
        100.0 * static_cast<double>(within) / static_cast<double>(r.over_brute.size()),
        share_of(r.over_other, 1.0));
  }
  forget();
}

struct Row {
  double p95_ratio, storage;
};

/// The nine cases by bench_plan_table's measure.
Row measured(const std::vector<NamedCase>& cases, const Warp& warp, Objective objective, int maps,
             SplitScheme split) {
  std::vector<double> p95, storage;
  for (const NamedCase& c : cases) {
    PlanOptions o;
    o.prune = kPruneNothing.with(PruneRule::light_depths);
    o.cascades = maps;
    o.warp.warp = &warp;
    o.warp.objective = objective;
    o.split.scheme = split;
    const AliasingStats stats = measure(make_plan(c.camera, c.light, c.bounds(), o), c.camera, c.bounds());
    p95.push_back(stats.p95 / unwarped_error(c, maps).p95);
    storage.push_back(stats.storage);
  }
  return {geometric_mean(p95), geometric_mean(storage)};
}

void print_targets(const std::vector<NamedCase>& cases) {
  struct Target {
    int maps;
    double p95, storage;
  };
  std::printf("\n%-6s %-10s %12s %12s %12s %12s\n", "maps", "quantity", "target", "optimal", "thorough",
              "brute force");
  for (const Target& t : {Target{1, 0.055, 600.0}, Target{4, 0.075, 28.0}}) {
    const SplitScheme split = t.maps == 1 ? SplitScheme::logarithmic : SplitScheme::optimal;
    for (const Objective objective : {Objective::p95, Objective::storage}) {
      const bool by_p95 = objective == Objective::p95;
      const auto of = [&](const Warp& warp, SplitScheme scheme) {
        const Row row = measured(cases, warp, objective, t.maps, scheme);
        return by_p95 ? row.p95_ratio : row.storage;
      };
      const double quick = of(warps::optimal, split), thorough = of(warps::optimal_thorough, split);
      const double limit = of(kBrute, SplitScheme::logarithmic);
      std::printf("%-6d %-10s %12.*f %12.*f %12.*f %12.*f\n", t.maps, by_p95 ? "p95 ratio" : "storage",
                  by_p95 ? 4 : 1, by_p95 ? t.p95 : t.storage, by_p95 ? 4 : 1, quick, by_p95 ? 4 : 1, thorough,
                  by_p95 ? 4 : 1, limit);
    }
    forget();
  }
  std::printf(
      "optimal and thorough with optimal splits, brute force with logarithmic ones, where there are four "
      "maps\n");
}

void print_random(Objective objective, int cameras) {
  test::SeededInput input;
  for (std::uint64_t seed = 1; static_cast<int>(ratios[0].over_brute.size()) < cameras; ++seed) {
    test::seed_input(seed, test::Extremes::ordinary, input);
    if (!std::holds_alternative<DirectionalLight>(input.light) || input.camera.orthographic) continue;
    PlanOptions o;
    o.cascades = 1;
    o.warp.warp = &kBrute;
    o.warp.objective = objective;
    o.prune = kPruneNothing;
    (void)make_plan(input.camera, input.light, input.bounds(), o);
  }
  print_ratios("random cameras", objective);
}

}  // namespace
}  // namespace gnomon

int main(int argc, char** argv) {
  using namespace gnomon;
  const int cameras = argc > 1 ? std::atoi(argv[1]) : 200;
  if (cameras < 1) {
    std::fprintf(stderr, "usage: %s [RANDOM CAMERAS]\n", argv[0]);
    return 2;
  }
  const std::vector<NamedCase> cases = load_cases();
  for (const Objective objective : {Objective::storage, Objective::max, Objective::p95}) {
    (void)measured(cases, kBrute, objective, 1, SplitScheme::logarithmic);
    print_ratios("nine cases, one map", objective);
    (void)measured(cases, kBrute, objective, 4, SplitScheme::logarithmic);
    print_ratios("nine cases, four maps", objective);
    print_random(objective, cameras);
  }
  print_targets(cases);
  return 0;
}
