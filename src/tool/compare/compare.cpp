// `gnomon compare`: every technique of a sweep on every frame of every scene, a row of results each.
#include "compare.hpp"

#include <array>
#include <charconv>
#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <map>
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
#include "machine.hpp"
#include "measure.hpp"
#include "offscreen_context.hpp"
#include "output.hpp"
#include "picture_words.hpp"
#include "progress.hpp"
#include "scene_words.hpp"
#include "stage.hpp"
#include "study_file.hpp"

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
  row.camera = sweep.camera_text;
  row.animation = sweep.animation;
  row.pixel_samples = sweep.pixel_samples;
  row.technique = sweep.entries[entry].technique;
  return row;
}

/// Rows of a frame that are this shard's and not yet in the file.
std::vector<Task> tasks_of(const CompareRequest& request, const Sweep& sweep, std::size_t scene, int frame,
                           const std::set<std::string>& known) {
  std::vector<Task> tasks;
  std::set<std::string> asked;  // maps made smaller may be those of another entry
  for (std::size_t entry = 0; entry < sweep.entries.size(); ++entry) {
    report::Row row = empty_row(sweep, scene, frame, entry);
    if (!request.is_mine(row.index) || known.contains(row.key()) || !asked.insert(row.key()).second) continue;
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

/// A sweep with the hashes of its scenes.
struct Part {
  const CompareRequest* request = nullptr;
  Sweep sweep;
  std::vector<std::string> hashes;
};

std::set<std::string> known_keys(const std::vector<Part>& parts, bool resume) {
  const fs::path file = fs::path(parts.front().sweep.out) / report::kRowsFile;
  std::set<std::string> keys;
  if (!fs::exists(file)) return keys;
  if (!resume)
    throw std::runtime_error(
        file.string() + " already exists; --resume continues it, another --out starts from the beginning");
  report::SceneHashes now;
  for (const Part& part : parts) {
    for (std::size_t i = 0; i < part.hashes.size(); ++i)
      (void)now.agree(part.sweep.scenes[i], part.hashes[i]);
  }
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

/// Sweeps under way, one after the other.
class Run {
 public:
  Run(const std::vector<Part>& parts, const report::Machine& machine, std::set<std::string> known,
      report::ResultsLock lock)
      : parts_(parts),
        machine_(machine),
        known_(std::move(known)),
        file_(fs::path(parts.front().sweep.out) / report::kRowsFile, std::move(lock)),
        progress_("gnomon compare, " + std::to_string(rows_in_all()) + " rows, steps", steps_in_all()) {}

  void all() {
    for (const Part& part : parts_) {
      for (std::size_t scene = 0; scene < part.sweep.scenes.size(); ++scene) one_scene(part, scene);
    }
  }

 private:
  /// Errors of a row weigh as much as its rounds.
  [[nodiscard]] static int steps_of_errors(const Sweep& sweep) { return sweep.rounds + 1; }

  /// Sums up what `of_frame` makes of each sweep and the rows of each of its frames.
  template <class OfFrame>
  [[nodiscard]] long long sum_over_frames(const OfFrame& of_frame) const {
    long long sum = 0;
    for (const Part& part : parts_) {
      for (std::size_t scene = 0; scene < part.sweep.scenes.size(); ++scene) {
        for (int frame = 0; frame < part.sweep.frames; ++frame)
          sum += of_frame(part.sweep, static_cast<long long>(tasks_in(part, scene, frame).size()));
      }
    }
    return sum;
  }
  [[nodiscard]] long long rows_in_all() const {
    return sum_over_frames([](const Sweep&, long long rows) { return rows; });
  }
  [[nodiscard]] long long steps_in_all() const {
    return sum_over_frames([](const Sweep& sweep, long long rows) {
      return rows > 0 ? (2 * rows + 2) * steps_of_errors(sweep) : 0;
    });
  }

  [[nodiscard]] std::vector<Task> tasks_in(const Part& part, std::size_t scene, int frame) const {
    return tasks_of(*part.request, part.sweep, scene, frame, known_);
  }

  void one_scene(const Part& part, std::size_t scene) {
    std::unique_ptr<Stage> stage;
    for (int frame = 0; frame < part.sweep.frames; ++frame) {
      std::vector<Task> tasks = tasks_in(part, scene, frame);
      if (tasks.empty()) continue;
      if (!stage) stage = std::make_unique<Stage>(part.sweep, part.sweep.scenes[scene]);
      one_frame(part, *stage, scene, frame, tasks);
    }
  }

  void step(long long count) {
    check_interrupt();
    progress_.set(steps_ += count);
  }

  void one_frame(const Part& part, Stage& stage, std::size_t scene, int frame, std::vector<Task>& tasks) {
    const Sweep& sweep = part.sweep;
    const FrameTruth truth = frame_truth(stage, frame, sweep.baseline, sweep.pixel_samples);
    const bool pictures = frame == sweep.frames / 2;
    std::vector<const SweepEntry*> entries;
    for (Task& task : tasks) {
      const SweepEntry& entry = sweep.entries[task.entry];
      entries.push_back(&entry);
      FramePictures drawn;
      measure_errors(stage, truth, entry, task.row, pictures ? &drawn : nullptr);
      if (pictures)
        task.row.pictures = write_pictures(sweep.out, sweep.first_scene + scene, task.entry, truth, drawn);
      step(steps_of_errors(sweep));
    }
    const std::vector<report::Times> times =
        measure_times(stage, truth.camera, entries, sweep.baseline, sweep.rounds, [this] { step(1); });
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      tasks[i].row.scene_hash = part.hashes[scene];
      tasks[i].row.animation_time_s = stage.animation_seconds(frame);
      tasks[i].row.times = times[i];
      tasks[i].row.machine = machine_;
      tasks[i].row.machine.load = current_load();
      file_.append(tasks[i].row);
      known_.insert(tasks[i].row.key());
    }
  }

  const std::vector<Part>& parts_;
  report::Machine machine_;
  std::set<std::string> known_;
  report::RowsFile file_;
  Progress progress_;
  long long steps_ = 0;
};

/// The sweep of a request, numbered behind those before it.
Part part_of(const CompareRequest& request, const std::vector<Part>& before) {
  Part part{&request, {}, {}};
  try {
    part.sweep = make_sweep(request);
  } catch (const std::runtime_error& error) {
    if (request.where.empty()) throw;
    throw std::runtime_error(request.where + ": " + error.what());
  }
  if (before.empty()) return part;
  const Sweep& last = before.back().sweep;
  part.sweep.first_index = last.index(last.scenes.size(), 0, 0);
  part.sweep.first_scene = last.first_scene + last.scenes.size();
  return part;
}

}  // namespace

Compared compare(std::span<const CompareRequest> requests) {
  const CompareRequest& first = requests.front();
  const std::string& out = first.out;
  std::vector<Part> parts;
  for (const CompareRequest& request : requests) parts.push_back(part_of(request, parts));
  check_folder("--out", out);
  std::optional<report::ResultsLock> lock;  // before rows are read: another process may be writing them
  if (fs::is_directory(out)) lock.emplace(out);
  for (Part& part : parts) {
    part.hashes = hashes_of(part.sweep);
    check_animations(part.sweep);
  }
  std::set<std::string> known = known_keys(parts, first.resume);
  const std::unique_ptr<render::Context> context = render::create_context(first.context);
  for (Part& part : parts) {
    for (const std::string& line : part.sweep.left_out) warn(line);
    for (const std::string& line : fit_to_memory(part.sweep, first.map_memory_mib)) warn(line);
  }
  make_folder("--out", out);
  if (!lock) {
    lock.emplace(out);
    known = known_keys(parts, first.resume);
  }
  watch_interrupts();
  Run(parts, machine(context->info()), std::move(known), std::move(*lock)).all();
  // A shard's report would show a part as if it were the whole.
  return {(fs::path(out) / report::kRowsFile).string(),
          first.shards == 1 ? report::write_report(out).string() : std::string()};
}

namespace {

/// By name: whether the option stands on the command line.
using Given = std::map<std::string, bool>;

int run_compare(const CompareRequest& request, const OptionsOf& options_of, const Given& given) {
  const bool is_study = request.scenes.size() == 1 && is_study_file(request.scenes.front());
  for (const auto& [option, stands] : given) {
    if (is_study && stands && option != "SCENE" && !stands_beside_study(option))
      throw std::runtime_error(option + ": not beside a study, whose file has it as a field");
  }
  const std::vector<CompareRequest> requests =
      is_study ? read_study(request.scenes.front(), request, options_of) : std::vector{request};
  const auto [rows, page] = compare(requests);
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
       .target = word_list(request.warps, read_warps, {"none", "lispsm", "optimal"}),
       .help = "perspective warps, or all; auto lets the plan choose; behind a colon a shape or an "
               "objective, as in optimal:picture",
       .names = names_in(all_warps(), {"all", "auto"})},
      {.name = "--shapes",
       .target = word_list(request.shapes, read_shapes, {"linear"}),
       .help = "how texels lie, or all; rectilinear plans with the points that a frame shows",
       .names = names_in(all_shapes(), {"all"})},
      {.name = "--splits",
       .target = word_list(request.splits, read_splits, {"auto"}),
       .help = "how receivers are divided among maps; listed below",
       .names = split_names()},
      {.name = "--near-hint",
       .target = &request.near_hint,
       .help = "view depth, world units, from which the error of split pseudo_near counts; 0: the near plane",
       .range = {{0.0, 1e30}}},
      {.name = "--fits",
       .target = word_list(request.fits, read_fits, {"tight"}),
       .help = "fits of a map: tight, stable",
       .names = {"tight", "stable"}},
      {.name = "--cascades",
       .target = word_list(request.cascades, read_cascades, {"1", "4"}),
       .help = "numbers of shadow maps along the view"},
      {.name = "--filters",
       .target = word_list(request.filters, read_filters, {"all"}),
       .help = "filters, with options as in vsm:radius=3; all, irregular (exact; :samples=8), identifiers",
       .names = names_in(render::all_filters(), {"all", std::string(kIrregular), std::string(kIdentifiers)})},
      {.name = "--layers",
       .target = word_list(request.layers, read_layers, {"front"}),
       .help = "depths that the maps store: front, back, second, ..., or all; listed below",
       .names = layer_names({"all"})},
      {.name = "--map-sizes",
       .target = word_list(request.map_sizes, read_map_sizes, {"1024"}),
       .help = "sizes of a map, texels along each side"},
      {.name = "--pages",
       .target = word_list(request.pages, read_page_policies, {}),
       .help = "page policies, or all: pages of as many texels as the maps, beside them; listed below",
       .names = names_in(all_page_policies(), {"all"})},
      {.name = "--page-sizes",
       .target = word_list(request.page_sizes, read_page_sizes, {"128"}),
       .help = "sizes of a page, texels along each side: 64, 128, 256"},
      {.name = "--page-target",
       .target = &request.page_target,
       .help = "error m that pages are opened for; 0: the least that the pool holds",
       .range = {{0.0, 1e6}}}};
}

Option shard_option(CompareRequest& request) {
  const auto set = [&request](const std::string& word) {
    constexpr std::size_t kMaxShards = 1'000'000;
    std::size_t shard = 0, shards = 0;
    const char* const end = word.data() + word.size();
    const auto [slash, no_shard] = std::from_chars(word.data(), end, shard);
    const bool parted = no_shard == std::errc{} && slash != end && *slash == '/';
    const auto [last, no_shards] = std::from_chars(parted ? slash + 1 : end, end, shards);
    if (!parted || no_shards != std::errc{} || last != end || shard < 1 || shard > shards ||
        shards > kMaxShards)
      throw std::runtime_error("--shard " + word + ": wants I/N with 1 <= I <= N, as in 2/8");
    request.shard = shard - 1;
    request.shards = shards;
    return true;
  };
  return {.name = "--shard",
          .target = ParsedWord{set, "1/1"},
          .help = "I/N: measure only part I of N; gnomon merge joins the parts"};
}

/// What it is measured on.
std::vector<Option> frame_options(CompareRequest& request) {
  return {{.name = "--frames",
           .target = &request.frames,
           .help = "frames along the scene's camera path",
           .range = {{1, 100'000}}},
          {.name = "--animation",
           .target = &request.animation,
           .help = "animation that the scenes play while frames pass, by name or number",
           .word = "NAME"},
          {.name = "--pixel-samples",
           .target = &request.pixel_samples,
           .help = "rays through each pixel, for errors over whole pixels and twinkling; 0: none",
           .range = {{0, 64}}},
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
           .help = "plan with points of the surfaces that the frame shows, where the split names no others"},
          size_option(request.width, request.height),
          {.name = "--out",
           .target = &request.out,
           .help = "folder for results and report",
           .completion = Completion::folders},
          shard_option(request),
          context_option(request.context)};
}

std::vector<Option> light_and_camera_options(CompareRequest& request) {
  std::vector<Option> options = light_options(request.light);
  for (Option& option : camera_options(request.camera)) options.push_back(std::move(option));
  return options;
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

/// What the lists take.
std::string compare_footer() {
  return "Lists take commas or spaces. Every combination of the lists is measured once. Each result is on "
         "the disk before the next frame begins: after a crash, --resume continues. Errors compare the "
         "shadow mask with exact rays.\n\n"
         "Warps: " +
         any_of_text(names_in(all_warps(), {"auto"})) + ".\nSplits: " + any_of_text(split_names()) +
         ", each with :finest, :visible_depths, :coarse_depths, :visible_points, :shadow_edges or :budget "
         "(maps share their texels) behind "
         "it, and "
         "frustum_faces with :slices=K for up to K maps along each side face" +
         ".\nPages: " + any_of_text(names_in(all_page_policies())) +
         ": virtual shadow maps of as many texels as the maps beside them, with every filter of --filters "
         "that reads depths in texels; the others are named and skipped. docs/pages.md explains them." +
         "\nLayers: " + any_of_text(layer_names()) +
         ", each with :linear behind it for depths even along the light. gnomon bias and docs/bias.md "
         "compare them." +
         "\nFilters: " + any_of_text(names_in(render::all_filters())) +
         ". gnomon filters NAME prints the options of one. " + std::string(kIrregular) +
         " takes no filter: casters are tested against each pixel, for exact hard shadows at their price. " +
         std::string(kIdentifiers) +
         " compares who is nearest in place of how near; :of=triangle numbers triangles in place of "
         "instances, neighbours=1 takes the texels around as well.\n";
}

}  // namespace

namespace {

std::vector<Option> options_of(CompareRequest& request) {
  request.out = "out/compare";
  request.pixel_samples = report::kPixelSamples;
  std::vector<Option> options{scenes_option(request, "builtin:NAME or glTF files; or one study.json", true)};
  for (const auto& part : {technique_options, frame_options, light_and_camera_options, limit_options}) {
    for (Option& option : part(request)) options.push_back(std::move(option));
  }
  return options;
}

}  // namespace

std::function<int()> declare_compare(Arguments& arguments) {
  const auto request = std::make_shared<CompareRequest>();
  const auto given = std::make_shared<Given>();
  arguments.options = options_of(*request);
  for (Option& option : arguments.options) option.given = &(*given)[option.name];
  arguments.footer = compare_footer();
  return [request, given] { return run_compare(*request, options_of, *given); };
}

}  // namespace gnomon::tool
