// What every warp gains and costs on the cases in tests/data/cases, with one map and with four: the tables of
// the README. Quality is measured as peers are compared in it: perspective error over 64 x 64 pixels x 64
// depths inside the receivers, relative to tight, unwarped maps (one; or four, split practically at lambda
// 0.9 over the camera's range).
//   bench_plan_table [ROUNDS] [--cases] [--markdown FILE]
// --cases adds every technique in every case by itself; --markdown writes the tables to a file as well.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>

#include "case_table.hpp"
#include "gnomon/study/log_perspective.hpp"

namespace {

using gnomon::NamedCase;

/// One way of planning, and what it came to over the cases.
struct Row {
  std::string name;
  const gnomon::Warp* warp;
  gnomon::Objective objective;
  gnomon::SplitScheme split;
  int cascades;
  std::vector<gnomon::AliasingStats> error;      // one per case
  std::vector<double> ratio_p95, ratio_max;      // over the unwarped maps' error, one per case
  std::vector<std::vector<double>> nanoseconds;  // of one plan: by case, then by round
};

std::vector<Row> rows() {
  using gnomon::Objective;
  using gnomon::SplitScheme;
  std::vector<Row> result;
  for (const gnomon::Warp* warp : gnomon::all_warps()) {
    const bool searches = warp == &gnomon::warps::lispsm || warp == &gnomon::warps::optimal ||
                          warp == &gnomon::warps::optimal_thorough;
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
  o.prune = gnomon::kPruneNothing.with(gnomon::PruneRule::light_depths);  // maps of one size
  o.cascades = row.cascades;
  o.warp.warp = row.warp;
  o.warp.objective = row.objective;
  o.split.scheme = row.split;
  return o;
}

void judge(std::vector<Row>& table, const std::vector<NamedCase>& cases) {
  for (const NamedCase& c : cases) {
    for (const int cascades : {1, 4}) {
      const gnomon::AliasingStats base = gnomon::unwarped_error(c, cascades);
      for (Row& row : table) {
        if (row.cascades != cascades) continue;
        row.error.push_back(
            measure(make_plan(c.camera, c.light, c.bounds(), options_of(row)), c.camera, c.bounds()));
        row.ratio_p95.push_back(row.error.back().p95 / base.p95);
        row.ratio_max.push_back(row.error.back().max / base.max);
      }
    }
  }
}

/// Interleaved: every round times every row in all cases, so that a slow spell of the machine hits all alike.
std::uint64_t time_rows(std::vector<Row>& table, const std::vector<NamedCase>& cases, int rounds) {
  std::uint64_t checksum = 0;
  constexpr int kPlans = 20;  // per case and round: a batch well above the clock's resolution
  for (Row& row : table) row.nanoseconds.resize(cases.size());
  for (int round = 0; round < rounds; ++round) {
    for (Row& row : table) {
      const gnomon::PlanOptions options = options_of(row);
      for (std::size_t c = 0; c < cases.size(); ++c) {
        const auto begin = std::chrono::steady_clock::now();
        for (int i = 0; i < kPlans; ++i) {
          const gnomon::ShadowPlan plan =
              make_plan(cases[c].camera, cases[c].light, cases[c].bounds(), options);
          const float corner = plan.map[0].clip_from_camera_relative[0][0];
          std::uint32_t bits = 0;
          std::memcpy(&bits, &corner, sizeof bits);
          checksum += bits;
        }
        const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - begin;
        row.nanoseconds[c].push_back(spent.count() / kPlans);
      }
    }
  }
  return checksum;
}

/// A table on its way out: a line of names, then lines that begin with one.
struct Table {
  std::string title;
  std::vector<std::vector<std::string>> line;
};

std::string number(double value, int decimals) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

/// Four figures, for values that span orders of magnitude.
std::string figures(double value) {
  return number(value, value < 1.0 ? 4 : value < 10.0 ? 3 : value < 100.0 ? 2 : value < 1000.0 ? 1 : 0);
}

/// Over the cases' mean in each round.
std::vector<double> mean_by_round(const Row& row) {
  std::vector<double> mean(row.nanoseconds.front().size(), 0.0);
  for (const std::vector<double>& by_round : row.nanoseconds) {
    for (std::size_t i = 0; i < mean.size(); ++i)
      mean[i] += by_round[i] / static_cast<double>(row.nanoseconds.size());
  }
  return mean;
}

Table summary(const std::vector<Row>& rows, int cascades, std::size_t cases, int rounds) {
  Table table{std::to_string(cascades) + " map" + (cascades == 1 ? "" : "s") + " over " +
                  std::to_string(cases) + " cases (geometric means; ns: median of " + std::to_string(rounds) +
                  " interleaved rounds, and the fastest)",
              {{"technique", "p95 ratio", "max ratio", "storage", "ns", "ns least"}}};
  for (const Row& row : rows) {
    if (row.cascades != cascades) continue;
    std::vector<double> storage;
    for (const gnomon::AliasingStats& error : row.error) storage.push_back(error.storage);
    const std::vector<double> ns = mean_by_round(row);
    table.line.push_back({row.name, number(gnomon::geometric_mean(row.ratio_p95), 4),
                          number(gnomon::geometric_mean(row.ratio_max), 4),
                          number(gnomon::geometric_mean(storage), 1), number(gnomon::median(ns), 0),
                          number(*std::min_element(ns.begin(), ns.end()), 0)});
  }
  return table;
}

/// What a logarithmic perspective map would come to: nothing that is planned or drawn, and so without times.
std::vector<std::string> log_perspective_line(const std::vector<NamedCase>& cases) {
  std::vector<double> p95, max, storage;
  for (const NamedCase& c : cases) {
    const auto* light = std::get_if<gnomon::DirectionalLight>(&c.light);
    if (light == nullptr) continue;
    const gnomon::AliasingStats base = gnomon::unwarped_error(c, 1);
    const auto map =
        log_perspective_map(c.camera, *light, c.bounds(), gnomon::PlanOptions{}.resolution.max_size);
    const gnomon::AliasingStats error = measure(map, c.camera, c.bounds());
    p95.push_back(error.p95 / base.p95);
    max.push_back(error.max / base.max);
    storage.push_back(error.storage);
  }
  return {"logpsm (numbers only)",
          number(gnomon::geometric_mean(p95), 4),
          number(gnomon::geometric_mean(max), 4),
          number(gnomon::geometric_mean(storage), 1),
          "-",
          "-"};
}

/// One quantity of every technique in every case.
template <typename Value>
Table by_case(const std::vector<Row>& rows, int cascades, const std::vector<NamedCase>& cases,
              const std::string& quantity, Value&& value) {
  Table table{std::to_string(cascades) + " map" + (cascades == 1 ? ", " : "s, ") + quantity, {{"technique"}}};
  for (const NamedCase& c : cases) table.line.front().push_back(c.name);
  for (const Row& row : rows) {
    if (row.cascades != cascades) continue;
    table.line.push_back({row.name});
    for (std::size_t c = 0; c < cases.size(); ++c) table.line.back().push_back(value(row, c));
  }
  return table;
}

void add_by_case(std::vector<Table>& tables, const std::vector<Row>& rows, int cascades,
                 const std::vector<NamedCase>& cases) {
  tables.push_back(by_case(rows, cascades, cases, "m p95 (screen pixels per texel)",
                           [](const Row& row, std::size_t c) { return figures(row.error[c].p95); }));
  tables.push_back(by_case(rows, cascades, cases, "m max (screen pixels per texel)",
                           [](const Row& row, std::size_t c) { return figures(row.error[c].max); }));
  tables.push_back(by_case(rows, cascades, cases, "storage (texels per pixel for m <= 1)",
                           [](const Row& row, std::size_t c) { return figures(row.error[c].storage); }));
  tables.push_back(by_case(rows, cascades, cases, "ns per plan (median)", [](const Row& row, std::size_t c) {
    return number(gnomon::median(row.nanoseconds[c]), 0);
  }));
}

void print(const Table& table) {
  std::printf("\n%s\n", table.title.c_str());
  std::vector<int> width;
  for (std::size_t i = 0; i < table.line.front().size(); ++i) {
    std::size_t longest = i == 0 ? 34 : 9;
    for (const std::vector<std::string>& line : table.line) longest = std::max(longest, line[i].size());
    width.push_back(static_cast<int>(longest));
  }
  for (const std::vector<std::string>& line : table.line) {
    std::printf("%-*s", width.front(), line.front().c_str());
    for (std::size_t i = 1; i < line.size(); ++i) std::printf(" %*s", width[i], line[i].c_str());
    std::printf("\n");
  }
}

void write_markdown(const std::vector<Table>& tables, const char* file) {
  std::ofstream out(file);
  for (const Table& table : tables) {
    out << "\n" << table.title << "\n\n";
    for (std::size_t l = 0; l < table.line.size(); ++l) {
      for (const std::string& cell : table.line[l]) out << "| " << cell << " ";
      out << "|\n";
      if (l > 0) continue;
      for (std::size_t i = 0; i < table.line[l].size(); ++i) out << (i == 0 ? "|--" : "|--:");
      out << "|\n";
    }
  }
  out.flush();
  if (!out) {
    std::fprintf(stderr, "%s: cannot be written\n", file);
    std::exit(1);
  }
}

struct Arguments {
  int rounds = 25;
  bool cases = false;
  const char* markdown = nullptr;
};

std::optional<Arguments> parse(int argc, char** argv) {
  Arguments result;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--cases") == 0) {
      result.cases = true;
    } else if (std::strcmp(argv[i], "--markdown") == 0 && i + 1 < argc) {
      result.markdown = argv[++i];
    } else if (std::atoi(argv[i]) > 0) {
      result.rounds = std::atoi(argv[i]);
    } else {
      std::fprintf(stderr, "usage: %s [ROUNDS] [--cases] [--markdown FILE]\n", argv[0]);
      return std::nullopt;
    }
  }
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  const std::optional<Arguments> arguments = parse(argc, argv);
  if (!arguments) return 2;
  const std::vector<NamedCase> cases = gnomon::load_cases();
  std::vector<Row> table = rows();
  judge(table, cases);
  const std::uint64_t checksum = time_rows(table, cases, arguments->rounds);
  std::vector<Table> tables;
  for (const int cascades : {1, 4}) {
    tables.push_back(summary(table, cascades, cases.size(), arguments->rounds));
    if (cascades == 1) tables.back().line.push_back(log_perspective_line(cases));
    if (arguments->cases) add_by_case(tables, table, cascades, cases);
  }
  for (const Table& t : tables) print(t);
  std::printf("\nchecksum %016llx\n", static_cast<unsigned long long>(checksum));
  if (arguments->markdown != nullptr) write_markdown(tables, arguments->markdown);
  return 0;
}
