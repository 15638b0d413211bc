// How do gnomon's plans compare with OGRE's shadow cameras, in error and in time? One process, one
// directional light, one caster and one receiver box, the cases in tests/data/cases; rounds interleave all
// rows. Both kinds of maps are measured by gnomon's metric over the same points. Only gnomon's time holds the
// planes that cull casters, bias and error bounds.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <optional>

#include "case_table.hpp"
#include "ogre_captures.hpp"
#include "ogre_setups.hpp"

namespace {

using namespace gnomon;
using peers::OgreScene;
using peers::OgreSetup;

struct Row {
  std::string name;
  int cascades;
  std::optional<OgreSetup> ogre;
  PlanOptions options;  // without ogre
  std::vector<double> ratio_p95, ratio_max, storage, outside_share;
  std::vector<std::vector<double>> nanoseconds;  // of one set-up: by case, then by round
};

Row ogre_row(const char* name, OgreSetup setup) {
  const bool split = setup == OgreSetup::pssm || setup == OgreSetup::pssm_n_opt;
  return {name, split ? 4 : 1, setup, {}, {}, {}, {}, {}, {}};
}

Row gnomon_row(const char* name, int cascades, const Warp& warp, Objective objective, SplitScheme split) {
  PlanOptions o;
  o.cascades = cascades;
  o.warp.warp = &warp;
  o.warp.objective = objective;
  o.split.scheme = split;
  return {name, cascades, std::nullopt, o, {}, {}, {}, {}, {}};
}

/// As make_plan does it by default.
Row default_row(const char* name, int cascades) {
  PlanOptions o;
  o.cascades = cascades;
  return {name, cascades, std::nullopt, o, {}, {}, {}, {}, {}};
}

std::vector<Row> rows() {
  constexpr SplitScheme kLog = SplitScheme::logarithmic;
  return {
      ogre_row("OGRE LiSPSM (default)", OgreSetup::lispsm),
      ogre_row("OGRE LiSPSM (n_opt)", OgreSetup::lispsm_n_opt),
      ogre_row("OGRE Focused", OgreSetup::focused),
      default_row("gnomon default", 1),
      gnomon_row("gnomon none", 1, warps::none, Objective::storage, kLog),
      gnomon_row("gnomon lispsm_closed", 1, warps::lispsm_closed, Objective::storage, kLog),
      gnomon_row("gnomon lispsm", 1, warps::lispsm, Objective::storage, kLog),
      gnomon_row("gnomon optimal", 1, warps::optimal, Objective::storage, kLog),
      gnomon_row("gnomon optimal by p95", 1, warps::optimal, Objective::p95, kLog),
      ogre_row("OGRE PSSM (own splits)", OgreSetup::pssm),
      ogre_row("OGRE PSSM (n_opt in each map)", OgreSetup::pssm_n_opt),
      default_row("gnomon default, four maps", 4),
      gnomon_row("gnomon none, log splits", 4, warps::none, Objective::storage, kLog),
      gnomon_row("gnomon lispsm, log splits", 4, warps::lispsm, Objective::storage, kLog),
      gnomon_row("gnomon optimal, log splits", 4, warps::optimal, Objective::storage, kLog),
      gnomon_row("gnomon optimal by p95, log splits", 4, warps::optimal, Objective::p95, kLog),
      gnomon_row("gnomon optimal, optimal splits", 4, warps::optimal, Objective::storage,
                 SplitScheme::optimal),
  };
}

/// OGRE's matrices in the place of a plan's own, for the metric.
ShadowPlan plan_of(const peers::OgreMaps& maps, const Case& c) {
  PlanOptions o;
  o.cascades = 1;
  ShadowPlan plan = make_plan(c.camera, c.light, c.bounds(), o);
  const ShadowMap one = plan.map[0];
  plan.map_count = maps.count;
  for (std::size_t i = 0; i < static_cast<std::size_t>(maps.count); ++i) {
    ShadowMap& map = plan.map[i] = one;
    map.cascade = static_cast<int>(i);
    map.clip_from_world = maps.clip_from_world[i];
    map.depth_begin = maps.border[i];
    map.depth_end = maps.border[i + 1];
  }
  // The outermost borders are the camera's own: floats must not leave a rim outside.
  plan.map[0].depth_begin = c.camera.near_depth;
  plan.map[static_cast<std::size_t>(maps.count - 1)].depth_end = c.camera.far_depth;
  return plan;
}

void judge(std::vector<Row>& table, const std::vector<NamedCase>& cases, std::deque<OgreScene>& scenes) {
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const NamedCase& c = cases[i];
    for (Row& row : table) {
      const AliasingStats base = unwarped_error(c, row.cascades);
      if (row.ogre) scenes[i].set_up(*row.ogre);
      const ShadowPlan plan = row.ogre ? plan_of(scenes[i].maps(*row.ogre), c)
                                       : make_plan(c.camera, c.light, c.bounds(), row.options);
      const AliasingStats stats = measure(plan, c.camera, c.bounds());
      row.ratio_p95.push_back(stats.p95 / base.p95);
      row.ratio_max.push_back(stats.max / base.max);
      row.storage.push_back(stats.storage);
      row.outside_share.push_back(static_cast<double>(stats.outside) /
                                  static_cast<double>(stats.outside + stats.samples));
    }
  }
}

std::uint64_t bits_of(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

std::uint64_t time_rows(std::vector<Row>& table, const std::vector<NamedCase>& cases,
                        std::deque<OgreScene>& scenes, int rounds) {
  // Well above the clock's resolution, and short enough for most batches to meet no other program.
  constexpr int kRepeats = 10;
  std::uint64_t checksum = 0;
  for (Row& row : table) row.nanoseconds.resize(cases.size());
  for (int round = 0; round < rounds; ++round) {
    for (Row& row : table) {
      for (std::size_t i = 0; i < cases.size(); ++i) {
        const NamedCase& c = cases[i];
        const auto begin = std::chrono::steady_clock::now();
        for (int repeat = 0; repeat < kRepeats; ++repeat) {
          if (row.ogre) {
            scenes[i].set_up(*row.ogre);
            continue;
          }
          const ShadowPlan plan = make_plan(c.camera, c.light, c.bounds(), row.options);
          checksum += bits_of(plan.map[0].clip_from_camera_relative[0][0]);
        }
        const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - begin;
        row.nanoseconds[i].push_back(spent.count() / kRepeats);
        if (row.ogre)
          checksum += bits_of(static_cast<float>(scenes[i].maps(*row.ogre).clip_from_world[0][0][0]));
      }
    }
  }
  return checksum;
}

/// Of one set-up, the mean over the cases of what each took: at the median of the rounds, or at the fastest.
double median_ns(const Row& row) {
  double sum = 0.0;
  for (const std::vector<double>& rounds : row.nanoseconds) sum += median(rounds);
  return sum / static_cast<double>(row.nanoseconds.size());
}
double least_ns(const Row& row) {
  double sum = 0.0;
  for (const std::vector<double>& rounds : row.nanoseconds)
    sum += *std::min_element(rounds.begin(), rounds.end());
  return sum / static_cast<double>(row.nanoseconds.size());
}

void print_table(const std::vector<Row>& table, int cascades, const Row& peer, int rounds) {
  std::printf("\n%d map%s (geometric means over the cases; ns: median of %d interleaved rounds)\n", cascades,
              cascades == 1 ? "" : "s", rounds);
  std::printf("%-34s %9s %9s %10s %8s %9s %9s   time of %s over this\n", "set-up", "p95 ratio", "max ratio",
              "storage", "outside", "ns", "ns least", peer.name.c_str());
  for (const Row& row : table) {
    if (row.cascades != cascades) continue;
    const double outside = *std::max_element(row.outside_share.begin(), row.outside_share.end());
    const double ns = median_ns(row);
    const double least = least_ns(row);
    std::printf("%-34s %9.4f %9.4f %10.1f %7.2f%% %9.0f %9.0f %7.1f x\n", row.name.c_str(),
                geometric_mean(row.ratio_p95), geometric_mean(row.ratio_max), geometric_mean(row.storage),
                100.0 * outside, ns, least, median_ns(peer) / ns);
  }
}

}  // namespace

// bench_peers_ogre [ROUNDS], or bench_peers_ogre --captures FOLDER [CAPTURE...]
int main(int argc, char** argv) {
  if (argc >= 3 && std::strcmp(argv[1], "--captures") == 0) {
    const peers::OgreRoot root;
    return peers::write_captures(argv[2], {argv + 3, argv + argc});
  }
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 51;
  const std::vector<NamedCase> cases = load_cases();
  const peers::OgreRoot root;
  std::deque<OgreScene> scenes;
  for (const NamedCase& c : cases) scenes.emplace_back(c);
  std::vector<Row> table = rows();
  judge(table, cases, scenes);
  const std::uint64_t checksum = time_rows(table, cases, scenes, rounds);
  const auto named = [&table](const char* name) -> const Row& {
    return *std::find_if(table.begin(), table.end(), [name](const Row& row) { return row.name == name; });
  };
  print_table(table, 1, named("OGRE LiSPSM (default)"), rounds);
  print_table(table, 4, named("OGRE PSSM (own splits)"), rounds);
  std::printf("\noutside: the largest share of visible points, over the cases, that no map holds\n");
  std::printf("checksum %016llx\n", static_cast<unsigned long long>(checksum));
  return 0;
}
