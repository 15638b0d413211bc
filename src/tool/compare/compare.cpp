// `gnomon compare`: every technique of a sweep on every frame of every scene, a row of results each.
#include "compare.hpp"

#include <array>
#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>

#include "animation_words.hpp"
#include "command.hpp"
#include "frame_pictures.hpp"
#include "gnomon/report/page.hpp"
#include "gnomon/report/rows_file.hpp"
#include "gnomon/scene/load.hpp"
#include "identifier_word.hpp"
#include "interrupt.hpp"
#include "irregular_word.hpp"
#include "machine.hpp"
#include "measure.hpp"
#include "offscreen_context.hpp"
#include "output.hpp"
#include "picture_words.hpp"
#include "progress.hpp"
#include "scene_words.hpp"
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
  row.animation = sweep.animation;
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

/// Throws std::runtime_error where a scene has no animation of that name.
void check_animations(const Sweep& sweep) {
  if (sweep.animation.empty()) return;
  for (const std::string& name : sweep.scenes) {
    const Scene scene = load_scene(name, limits_of_triangles(sweep.max_triangles));
    if (find_animation(scene.motion, sweep.animation) < 0)
      throw std::runtime_error(name + ": " + no_animation_text(scene.motion, sweep.animation));
  }
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
    throw std::runtime_error(
        file.string() + " already exists; --resume continues it, another --out starts from the beginning");
  report::SceneHashes now;
  for (std::size_t i = 0; i < hashes.size(); ++i) (void)now.agree(sweep.scenes[i], hashes[i]);
  std::vector<std::string> warnings;
  const std::vector<report::Row> rows = report::read_rows(file, &warnings);
  for (const std::string& line : warnings)
    std::fprintf(stderr, "gnomon: warning: %s; it is measured again\n", line.c_str());
  for (const report::Row& row : rows) {
    if (!now.agree(row.scene, row.scene_hash))
      throw std::runtime_error(file.string() + ": " + row.scene +
                               " has changed since it was measured; another --out starts from the beginning");
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
      tasks[i].row.animation_time_s = stage.animation_seconds(frame);
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
  for (const std::string& scene : request.scenes) check_scene_word("SCENE", scene);
  Sweep sweep = make_sweep(request);
  check_folder("--out", sweep.out);
  std::optional<report::ResultsLock> lock;  // before rows are read: another process may be writing them
  if (fs::is_directory(sweep.out)) lock.emplace(sweep.out);
  const std::vector<std::string> hashes = hashes_of(sweep);
  check_animations(sweep);
  std::set<std::string> known = known_keys(sweep, hashes);
  const std::unique_ptr<render::Context> context = render::create_context(sweep.context);
  for (const std::string& line : sweep.left_out) warn(line);
  for (const std::string& line : fit_to_memory(sweep)) warn(line);
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

namespace {

int run_compare(const CompareRequest& request) {
  const auto [rows, page] = compare(request);
  if (request.json) {
    print_line(nlohmann::json{{"rows", rows}, {"report", page}}.dump());
  } else {
    print_line("rows:   " + rows);
    if (!page.empty()) print_line("report: " + page);
  }
  flush_output();
  return 0;
}

/// The product that is gone through.
std::vector<Option> technique_options(CompareRequest& request) {
  return {
      {.name = "--warps",
       .target = &request.warps,
       .help = "perspective warps, or all; auto lets the plan choose",
       .names = names_in(all_warps(), {"all", "auto"}),
       .only_names = false},
      {.name = "--shapes",
       .target = &request.shapes,
       .help = "how texels lie, or all; rectilinear plans with the points that a frame shows",
       .names = names_in(all_shapes(), {"all"}),
       .only_names = false},
      {.name = "--splits",
       .target = &request.splits,
       .help = "how receivers are divided among maps; listed below",
       .names = split_names(),
       .only_names = false},
      {.name = "--near-hint",
       .target = &request.near_hint,
       .help = "view depth, world units, from which the error of split pseudo_near counts; 0: the near plane",
       .range = {{0.0, 1e30}}},
      {.name = "--fits",
       .target = &request.fits,
       .help = "fits of a map: tight, stable",
       .names = {"tight", "stable"},
       .only_names = false},
      {.name = "--cascades", .target = &request.cascades, .help = "numbers of shadow maps along the view"},
      {.name = "--filters",
       .target = &request.filters,
       .help = "filters, with options as in vsm:radius=3; all, irregular (exact; :samples=8), identifiers",
       .names = names_in(render::all_filters(), {"all", std::string(kIrregular), std::string(kIdentifiers)}),
       .only_names = false},
      {.name = "--layers",
       .target = &request.layers,
       .help = "depths that the maps store: front, back, second, ..., or all; listed below",
       .names = layer_names({"all"}),
       .only_names = false},
      {.name = "--map-sizes", .target = &request.map_sizes, .help = "sizes of a map, texels along each side"},
      {.name = "--pages",
       .target = &request.pages,
       .help = "page policies, or all: pages of as many texels as the maps, beside them; listed below",
       .names = names_in(all_page_policies(), {"all"}),
       .only_names = false},
      {.name = "--page-sizes",
       .target = &request.page_sizes,
       .help = "sizes of a page, texels along each side: 64, 128, 256"},
      {.name = "--page-target",
       .target = &request.page_target,
       .help = "error m that pages are opened for; 0: the least that the pool holds",
       .range = {{0.0, 1e6}}}};
}

/// What it is measured on.
std::vector<Option> measuring_options(CompareRequest& request) {
  return {{.name = "--frames",
           .target = &request.frames,
           .help = "frames along the scene's camera path",
           .range = {{1, 100'000}}},
          {.name = "--animation",
           .target = &request.animation,
           .help = "animation that the scenes play while frames pass, by name or number",
           .word = "NAME"},
          {.name = "--rounds",
           .target = &request.rounds,
           .help = "timings of each technique per frame",
           .range = {{1, 10'000}}},
          map_passes_option(request.map_passes),
          {.name = "--visible-depths",
           .target = &request.visible_depths,
           .help = "plan with the view depths that the frame shows"},
          {.name = "--visible-points",
           .target = &request.visible_points,
           .help = "plan with points of the surfaces that the frame shows"},
          {.name = "--size", .target = &request.size, .help = "size of a frame in pixels, WIDTHxHEIGHT"},
          {.name = "--out",
           .target = &request.out,
           .help = "folder for results and report",
           .completion = Completion::folders},
          {.name = "--shard",
           .target = &request.shard,
           .help = "I/N: measure only part I of N; gnomon merge joins the parts"},
          context_option(request.context)};
}

/// What the machine may give.
std::vector<Option> limit_options(CompareRequest& request) {
  return {{.name = "--map-memory-mib",
           .target = &request.map_memory_mib,
           .help = "memory for a technique's maps, MiB; larger maps are halved until they fit; 0: no limit",
           .range = {{0.0, 1e9}}},
          max_triangles_option(request.max_triangles),
          {.name = "--resume", .target = &request.resume, .help = "continue with the results in --out"},
          {.name = "--json", .target = &request.json, .help = "print a summary as one line of JSON"}};
}

std::vector<Option> sun_options(CompareRequest& request) {
  return light_options(request.light, request.sun);
}

}  // namespace

std::function<int()> declare_compare(Arguments& arguments) {
  const auto request = std::make_shared<CompareRequest>();
  arguments.options = {{.name = "SCENE",
                        .target = &request->scenes,
                        .help = "builtin:NAME or glTF files",
                        .required = true,
                        .names = builtin_scene_words(),
                        .only_names = false,
                        .completion = Completion::files}};
  for (const auto& part : {technique_options, measuring_options, sun_options, limit_options}) {
    for (Option& option : part(*request)) arguments.options.push_back(std::move(option));
  }
  arguments.footer = compare_footer();
  return [request] { return run_compare(*request); };
}

}  // namespace gnomon::tool
