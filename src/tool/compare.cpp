// `gnomon compare`: every technique of a sweep on every frame of every scene, a row of results each.
#include "compare.hpp"

#include <array>
#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>

#include "frame_pictures.hpp"
#include "gnomon/report/page.hpp"
#include "gnomon/report/rows_file.hpp"
#include "gnomon/scene/load.hpp"
#include "interrupt.hpp"
#include "machine.hpp"
#include "measure.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "stage.hpp"

namespace gnomon::tool {
namespace {

namespace fs = std::filesystem;

/// A row of the sweep that is still to be measured.
struct Task {
  std::size_t entry = 0;
  report::Row row;
};

report::Row empty_row(const Sweep& sweep, std::size_t scene, int frame, std::size_t entry) {
  report::Row row;
  row.index = sweep.index(scene, frame, entry);
  row.scene = sweep.scenes[scene];
  row.frame = frame;
  row.frames = sweep.frames;
  row.width = sweep.width;
  row.height = sweep.height;
  row.light = to_string(sweep.light.kind);
  row.light_elevation_deg = sweep.light.elevation_deg;
  row.light_azimuth_deg = sweep.light.azimuth_deg;
  row.technique = sweep.entries[entry].technique;
  return row;
}

/// Rows of a frame that are this shard's and not yet in the file.
std::vector<Task> tasks_of(const Sweep& sweep, std::size_t scene, int frame,
                           const std::set<std::string>& known) {
  std::vector<Task> tasks;
  std::set<std::string> asked;  // maps made smaller may be those of another entry
  for (std::size_t entry = 0; entry < sweep.entries.size(); ++entry) {
    report::Row row = empty_row(sweep, scene, frame, entry);
    if (!sweep.is_mine(row.index) || known.contains(row.key()) || !asked.insert(row.key()).second) continue;
    tasks.push_back({entry, std::move(row)});
  }
  return tasks;
}

/// What each scene's files hold. A scene that cannot be loaded is found now and not after an hour.
std::vector<std::string> hashes_of(const Sweep& sweep) {
  std::vector<std::string> hashes;
  for (const std::string& scene : sweep.scenes) {
    const std::uint64_t hash = scene_files_hash(scene, limits_of_triangles(sweep.max_triangles));
    std::array<char, 17> text{};
    if (hash != 0) std::snprintf(text.data(), text.size(), "%016" PRIx64, hash);
    hashes.emplace_back(text.data());
  }
  return hashes;
}

std::set<std::string> known_keys(const Sweep& sweep, const std::vector<std::string>& hashes) {
  const fs::path file = fs::path(sweep.out) / report::kRowsFile;
  std::set<std::string> keys;
  if (!fs::exists(file)) return keys;
  if (!sweep.resume)
    throw std::runtime_error(file.string() +
                             ": there already; --resume goes on with it, another --out starts anew");
  report::SceneHashes now;
  for (std::size_t i = 0; i < hashes.size(); ++i) (void)now.agree(sweep.scenes[i], hashes[i]);
  std::vector<std::string> warnings;
  const std::vector<report::Row> rows = report::read_rows(file, &warnings);
  for (const std::string& line : warnings)
    std::fprintf(stderr, "gnomon: warning: %s; it is measured again\n", line.c_str());
  for (const report::Row& row : rows) {
    if (!now.agree(row.scene, row.scene_hash))
      throw std::runtime_error(file.string() + ": " + row.scene +
                               " is no longer what was measured; another --out starts anew");
    keys.insert(row.key());
  }
  return keys;
}

/// One sweep under way.
class Run {
 public:
  Run(const Sweep& sweep, std::vector<std::string> hashes, const report::Machine& machine,
      std::set<std::string> known, report::ResultsLock lock)
      : sweep_(sweep),
        hashes_(std::move(hashes)),
        machine_(machine),
        known_(std::move(known)),
        file_(fs::path(sweep.out) / report::kRowsFile, std::move(lock)),
        progress_("gnomon compare", steps_in_all()) {}

  void all() {
    for (std::size_t scene = 0; scene < sweep_.scenes.size(); ++scene) {
      std::unique_ptr<Stage> stage;
      for (int frame = 0; frame < sweep_.frames; ++frame) {
        std::vector<Task> tasks = tasks_of(sweep_, scene, frame, known_);
        if (tasks.empty()) continue;
        if (!stage) stage = std::make_unique<Stage>(sweep_, sweep_.scenes[scene]);
        one_frame(*stage, scene, frame, tasks);
      }
    }
  }

 private:
  /// Errors of a row weigh as much as its rounds.
  [[nodiscard]] int steps_of_errors() const { return sweep_.rounds + 1; }

  [[nodiscard]] long long steps_in_all() const {
    long long steps = 0;
    for (std::size_t scene = 0; scene < sweep_.scenes.size(); ++scene) {
      for (int frame = 0; frame < sweep_.frames; ++frame) {
        const auto tasks = static_cast<long long>(tasks_of(sweep_, scene, frame, known_).size());
        if (tasks > 0) steps += (2 * tasks + 1) * steps_of_errors();
      }
    }
    return steps;
  }

  void step(long long count) {
    check_interrupt();
    progress_.set(steps_ += count);
  }

  void one_frame(Stage& stage, std::size_t scene, int frame, std::vector<Task>& tasks) {
    const FrameTruth truth = frame_truth(stage, frame, sweep_.baseline);
    const bool pictures = frame == sweep_.frames / 2;
    std::vector<const SweepEntry*> entries;
    for (Task& task : tasks) {
      const SweepEntry& entry = sweep_.entries[task.entry];
      entries.push_back(&entry);
      Seen seen;
      measure_errors(stage, truth, entry, task.row, pictures ? &seen : nullptr);
      if (pictures) task.row.pictures = write_pictures(sweep_.out, scene, task.entry, truth, seen);
      step(steps_of_errors());
    }
    const std::vector<report::Times> times =
        measure_times(stage, truth.camera, entries, sweep_.baseline, sweep_.rounds, [this] { step(1); });
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      tasks[i].row.scene_hash = hashes_[scene];
      tasks[i].row.times = times[i];
      tasks[i].row.machine = machine_;
      tasks[i].row.machine.load = current_load();
      file_.append(tasks[i].row);
    }
  }

  const Sweep& sweep_;
  std::vector<std::string> hashes_;  ///< of the scenes
  report::Machine machine_;
  std::set<std::string> known_;
  report::RowsFile file_;
  Progress progress_;
  long long steps_ = 0;
};

}  // namespace

Compared compare(const CompareRequest& request) {
  Sweep sweep = make_sweep(request);
  std::optional<report::ResultsLock> lock;  // before rows are read: another process may be writing them
  if (fs::is_directory(sweep.out)) lock.emplace(sweep.out);
  const std::vector<std::string> hashes = hashes_of(sweep);
  std::set<std::string> known = known_keys(sweep, hashes);
  const std::unique_ptr<render::Context> context = render::create_context(sweep.context);
  for (const std::string& line : fit_to_memory(sweep))
    std::fprintf(stderr, "gnomon: warning: %s\n", line.c_str());
  make_folder("--out", sweep.out);
  if (!lock) {
    lock.emplace(sweep.out);
    known = known_keys(sweep, hashes);
  }
  watch_interrupts();
  Run(sweep, hashes, machine(context->info()), std::move(known), std::move(*lock)).all();
  // A shard's report would show a part as if it were the whole.
  return {(fs::path(sweep.out) / report::kRowsFile).string(),
          sweep.shards == 1 ? report::write_report(sweep.out).string() : std::string()};
}

int run_compare(const CompareRequest& request, bool json) {
  const auto [rows, page] = compare(request);
  if (json) {
    print_line(nlohmann::json{{"rows", rows}, {"report", page}}.dump());
  } else {
    print_line("rows:   " + rows);
    if (!page.empty()) print_line("report: " + page);
  }
  flush_output();
  return 0;
}

}  // namespace gnomon::tool
