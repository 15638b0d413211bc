// What every warp gains and costs on the cases in tests/data/cases, with one map and with four: the tables of
// the README. Quality is measured as peers are compared in it: perspective error over 64 x 64 pixels x 64
// depths inside the receivers, relative to tight, unwarped maps (one; or four, split practically at lambda
// 0.9 over the camera's range).
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "gnomon/casefile/casefile.hpp"
#include "gnomon/gnomon.hpp"

namespace {

using gnomon::Case;

/// One way of planning, and what it came to over the cases.
struct Row {
  std::string name;
  const gnomon::Warp* warp;
  gnomon::Objective objective;
  gnomon::SplitScheme split;
  int cascades;
  std::vector<double> ratio_p95, ratio_max, storage;
  std::vector<double> nanoseconds;  // one per round, summed over the cases
};

double geometric_mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += std::log(v);
  return std::exp(sum / static_cast<double>(values.size()));
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

std::vector<Case> load_cases() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(GNOMON_TEST_DATA "/cases"))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Case> cases;
  for (const auto& file : files) cases.push_back(gnomon::load_case(file));
  return cases;
}

std::vector<Row> rows() {
  using gnomon::Objective;
  using gnomon::SplitScheme;
  std::vector<Row> result;
  for (const gnomon::Warp* warp : gnomon::all_warps()) {
    const bool searches = warp == &gnomon::warps::lispsm || warp == &gnomon::warps::optimal;
    for (const Objective objective : {Objective::storage, Objective::max, Objective::p95}) {
      if (!searches && objective != Objective::storage) continue;
      const std::string name =
          std::string(warp->name) + (searches ? " by " + std::string(to_string(objective)) : "");
      result.push_back({name, warp, objective, SplitScheme::logarithmic, 1, {}, {}, {}, {}});
      result.push_back({name + ", log splits", warp, objective, SplitScheme::logarithmic, 4, {}, {}, {}, {}});
      if (searches) {
        result.push_back(
            {name + ", optimal splits", warp, objective, SplitScheme::optimal, 4, {}, {}, {}, {}});
      }
    }
  }
  return result;
}

gnomon::PlanOptions options_of(const Row& row) {
  gnomon::PlanOptions o;
  o.cascades = row.cascades;
  o.warp = row.warp;
  o.objective = row.objective;
  o.split = row.split;
  return o;
}

gnomon::AliasingStats baseline(const Case& c, int cascades) {
  gnomon::PlanOptions o;
  o.cascades = cascades;
  o.warp = &gnomon::warps::none;
  o.split = gnomon::SplitScheme::practical;
  o.lambda = 0.9;
  o.split_range = gnomon::SplitRange::camera;
  return measure(make_plan(c.camera, c.light, c.bounds(), o), c.camera, c.bounds());
}

void judge(std::vector<Row>& table, const std::vector<Case>& cases) {
  for (const Case& c : cases) {
    for (const int cascades : {1, 4}) {
      const gnomon::AliasingStats base = baseline(c, cascades);
      for (Row& row : table) {
        if (row.cascades != cascades) continue;
        const auto stats =
            measure(make_plan(c.camera, c.light, c.bounds(), options_of(row)), c.camera, c.bounds());
        row.ratio_p95.push_back(stats.p95 / base.p95);
        row.ratio_max.push_back(stats.max / base.max);
        row.storage.push_back(stats.storage);
      }
    }
  }
}

/// Interleaved: every round times every row over all cases, so that a slow spell of the machine hits all
/// alike.
std::uint64_t time_rows(std::vector<Row>& table, const std::vector<Case>& cases, int rounds) {
  std::uint64_t checksum = 0;
  constexpr int kPlans = 20;  // per case and round: a batch well above the clock's resolution
  for (int round = 0; round < rounds; ++round) {
    for (Row& row : table) {
      const gnomon::PlanOptions options = options_of(row);
      const auto begin = std::chrono::steady_clock::now();
      for (const Case& c : cases) {
        for (int i = 0; i < kPlans; ++i) {
          const gnomon::ShadowPlan plan = make_plan(c.camera, c.light, c.bounds(), options);
          float corner = plan.map[0].clip_from_camera_relative[0][0];
          std::uint32_t bits = 0;
          std::memcpy(&bits, &corner, sizeof bits);
          checksum += bits;
        }
      }
      const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - begin;
      row.nanoseconds.push_back(spent.count() / (kPlans * static_cast<double>(cases.size())));
    }
  }
  return checksum;
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 25;
  const std::vector<Case> cases = load_cases();
  std::vector<Row> table = rows();
  judge(table, cases);
  const std::uint64_t checksum = time_rows(table, cases, rounds);
  for (const int cascades : {1, 4}) {
    std::printf(
        "\n%d map%s over %zu cases (geometric means; ns: median of %d interleaved rounds, and the fastest)\n",
        cascades, cascades == 1 ? "" : "s", cases.size(), rounds);
    std::printf("%-34s %9s %9s %12s %9s %9s\n", "technique", "p95 ratio", "max ratio", "storage", "ns",
                "ns least");
    for (const Row& row : table) {
      if (row.cascades != cascades) continue;
      std::printf("%-34s %9.4f %9.4f %12.1f %9.0f %9.0f\n", row.name.c_str(), geometric_mean(row.ratio_p95),
                  geometric_mean(row.ratio_max), geometric_mean(row.storage), median(row.nanoseconds),
                  *std::min_element(row.nanoseconds.begin(), row.nanoseconds.end()));
    }
  }
  std::printf("\nchecksum %016llx\n", static_cast<unsigned long long>(checksum));
  return 0;
}
