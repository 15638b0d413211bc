// `gnomon compare`: every technique of a sweep on every frame of every scene, a row of results each.
#include "compare.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>

#include "animation_words.hpp"
#include "base/fnv.hpp"
#include "command.hpp"
#include "edit_words.hpp"
#include "entry_file.hpp"
#include "frame_pictures.hpp"
#include "gnomon/report/page.hpp"
#include "gnomon/report/rows_file.hpp"
#include "gnomon/scene/load.hpp"
#include "gnomon/trace/tracer.hpp"
#include "interrupt.hpp"
#include "machine.hpp"
#include "measure.hpp"
#include "output.hpp"
#include "parts.hpp"
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

/// As in rows: "spot", or "spot 1 of 8".
std::string light_text(const Sweep& sweep) {
  std::string text(to_string(sweep.light.kind));
  if (sweep.local_lights > 0)
    text += " " + std::to_string(sweep.local_light + 1) + " of " + std::to_string(sweep.local_lights);
  return text;
}

report::Row empty_row(const Sweep& sweep, std::size_t scene, int frame, std::size_t entry) {
  report::Row row;
  row.index = sweep.index(scene, frame, entry);
  row.scene = sweep.scenes[scene];
  row.frame = frame;
  row.frames = sweep.frames;
  row.width = sweep.width;
  row.height = sweep.height;
  row.light = light_text(sweep);
  row.light_elevation_deg = sweep.light.elevation_deg;
  row.light_azimuth_deg = sweep.light.azimuth_deg;
  row.camera = sweep.camera_text;
  row.edits = sweep.edit_text;
  row.animation = sweep.animation;
  row.pixel_samples = sweep.pixel_samples;
  row.technique = sweep.entries[entry].technique;
  row.view = sweep.view;
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

/// Throws std::runtime_error where a scene has no animation of that name, or no node for the proxies.
void check_scenes(const Sweep& sweep) {
  if (sweep.animation.empty() && sweep.edits.proxies.empty()) return;
  for (const std::string& name : sweep.scenes) {
    const Scene scene = load_edited(name, limits_of_triangles(sweep.max_triangles), sweep.edits);
    if (!sweep.animation.empty()) (void)animation_of(name, scene.motion, sweep.animation);
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

/// Throws std::runtime_error where a study was made for other files.
void check_hashes(const Part& part) {
  const std::string& wanted = part.request->files.hash;
  for (std::size_t i = 0; i < part.hashes.size() && !wanted.empty(); ++i) {
    if (part.hashes[i] != wanted)
      throw std::runtime_error(part.request->where + ".hash: " + part.sweep.scenes[i] + " has " +
                               (part.hashes[i].empty() ? "none" : part.hashes[i]) + ", and not " + wanted);
  }
}

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

/// Why an entry of others has nothing for a row's frame. Empty: it has, or gnomon plans the entry.
std::string why_not(const Stage& stage, const SweepEntry& entry, const report::Row& row) {
  const std::string frame = "frame " + std::to_string(row.frame);
  if (entry.given != nullptr) {
    const GivenMasks::Frame* const masks = masks_of(*entry.given, row);
    if (masks == nullptr) return "has no mask of " + frame + " of " + std::to_string(row.frames);
    try {
      (void)read_masks(*entry.given, *masks, row.width, row.height);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return {};
  }
  if (entry.captured == nullptr) return {};
  const auto* const sun = std::get_if<DirectionalLight>(&stage.light());
  constexpr double kAngle = 1e-5;
  if (sun == nullptr ||
      glm::length(glm::normalize(sun->direction) - entry.captured->light_direction) > kAngle)
    return "its maps are of another light; --capture takes cameras and sun from it";
  for (const Camera& camera : {stage.camera(row.frame), stage.camera_before(row.frame)}) {
    if (entry.captured->at(camera) == nullptr)
      return "has no frame of the camera of " + frame +
             ", or of the one before it; --capture takes its cameras";
  }
  return {};
}

/// Where exact results are kept: beside --out unless the request says otherwise.
ExactResults exact_results(const Part& part, std::size_t scene) {
  if (part.request->exact == "none") return {};
  const fs::path out(part.sweep.out);
  const fs::path beside = (out.has_filename() ? out : out.parent_path()).parent_path() / "exact";
  const Sweep& s = part.sweep;
  std::string identity = std::string(build_version()) + "\n" +
                         (trace::built_with_embree() ? "embree" : "own") + "\n" + s.scenes[scene] + "\n" +
                         part.hashes[scene] + "\n" + s.edit_text + "\n" + s.animation + "\n" + light_text(s);
  ExactKey light(fnv_of(identity));
  light.add(s.light.elevation_deg).add(s.light.azimuth_deg);
  identity += "\n" + std::to_string(light.hash());
  return {part.request->exact.empty() ? beside : fs::path(part.request->exact), identity};
}

/// Sweeps under way, one after the other.
class Run {
 public:
  Run(const std::vector<Part>& parts, const report::Machine& machine, std::set<std::string> known,
      report::ResultsLock lock, RefusedEntries& refused)
      : parts_(parts),
        refused_(refused),
        machine_(machine),
        known_(std::move(known)),
        file_(fs::path(parts.front().sweep.out) / report::kRowsFile, std::move(lock)),
        progress_("gnomon compare, " + std::to_string(rows_in_all()) + " rows, steps", steps_in_all(),
                  parts_.front().request->seconds) {}

  /// Returns how many frames time did not allow.
  std::size_t all() {
    for (const Part& part : parts_) {
      for (std::size_t scene = 0; scene < part.sweep.scenes.size(); ++scene) one_scene(part, scene);
    }
    return frames_left_;
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// Errors of a row weigh as much as its rounds.
  [[nodiscard]] static int steps_of_errors(const Sweep& sweep) { return sweep.rounds + 1; }
  /// The same of its times: as often as rounds, and once to warm up.
  [[nodiscard]] static int steps_of_times(const Sweep& sweep, int frame) {
    return sweep.times(frame) ? sweep.rounds + 1 : 0;
  }

  /// Sums up what `of_frame` makes of each sweep and the rows of each of its frames.
  template <class OfFrame>
  [[nodiscard]] long long sum_over_frames(const OfFrame& of_frame) const {
    long long sum = 0;
    for (const Part& part : parts_) {
      for (std::size_t scene = 0; scene < part.sweep.scenes.size(); ++scene) {
        for (int frame = 0; frame < part.sweep.frames; ++frame)
          sum += of_frame(part.sweep, frame, static_cast<long long>(tasks_in(part, scene, frame).size()));
      }
    }
    return sum;
  }
  [[nodiscard]] long long rows_in_all() const {
    return sum_over_frames([](const Sweep&, int, long long rows) { return rows; });
  }
  [[nodiscard]] long long steps_in_all() const {
    return sum_over_frames([](const Sweep& sweep, int frame, long long rows) {
      return rows > 0 ? rows * steps_of_errors(sweep) + (rows + 2) * steps_of_times(sweep, frame) : 0;
    });
  }

  [[nodiscard]] std::vector<Task> tasks_in(const Part& part, std::size_t scene, int frame) const {
    return tasks_of(*part.request, part.sweep, scene, frame, known_);
  }

  /// Names the entries of others that do not hold all frames of a scene.
  void refuse_entries(const Part& part, const Stage& stage, std::size_t scene) {
    for (std::size_t entry = 0; entry < part.sweep.entries.size(); ++entry) {
      const SweepEntry& one = part.sweep.entries[entry];
      std::string why;
      for (int frame = 0; frame < part.sweep.frames && why.empty(); ++frame)
        why = why_not(stage, one, empty_row(part.sweep, scene, frame, entry));
      if (why.empty()) continue;
      refused_here_.insert(entry);
      refused_.refuse(one.technique.entry, part.sweep.scenes[scene], why);
    }
  }

  void one_scene(const Part& part, std::size_t scene) {
    std::unique_ptr<Stage> stage;
    refused_here_.clear();
    for (int frame = 0; frame < part.sweep.frames; ++frame) {
      std::vector<Task> tasks = tasks_in(part, scene, frame);
      if (tasks.empty()) continue;
      if (is_late()) {
        ++frames_left_;
        continue;
      }
      const Clock::time_point frame_begin = Clock::now();
      if (!stage) {
        stage = std::make_unique<Stage>(part.sweep, part.sweep.scenes[scene], exact_results(part, scene));
        warn_of(stage->scene());
        refuse_entries(part, *stage, scene);
      }
      const auto refused = [&](const Task& task) { return refused_here_.contains(task.entry); };
      step(static_cast<long long>(std::count_if(tasks.begin(), tasks.end(), refused)) *
           (steps_of_errors(part.sweep) + steps_of_times(part.sweep, frame)));
      std::erase_if(tasks, refused);
      if (tasks.empty()) continue;
      one_frame(part, *stage, scene, frame, tasks);
      longest_ = std::max(longest_, Clock::now() - frame_begin);
    }
  }

  /// True where another frame, as long as the longest so far, would end too late. The first never does.
  [[nodiscard]] bool is_late() const {
    const double seconds = parts_.front().request->seconds;
    return seconds > 0.0 && longest_ > Clock::duration::zero() &&
           std::chrono::duration<double>(Clock::now() - begin_ + longest_).count() > seconds;
  }

  void step(long long count) {
    check_interrupt();
    progress_.set(steps_ += count);
  }

  void one_frame(const Part& part, Stage& stage, std::size_t scene, int frame, std::vector<Task>& tasks) {
    const Sweep& sweep = part.sweep;
    const FrameTruth truth = frame_truth(stage, frame, sweep.baseline, sweep.pixel_samples);
    const bool pictures = frame == sweep.frames / 2;
    std::vector<const SweepEntry*> entries;  // that are drawn and timed
    for (const Task& task : tasks)
      if (sweep.entries[task.entry].given == nullptr) entries.push_back(&sweep.entries[task.entry]);
    constexpr std::size_t kAhead = 8;  // frames before that are drawn at once: their masks are kept
    std::vector<FrameBefore> ahead;
    std::size_t measured = 0;
    std::vector<FrameMasks> masks;
    for (Task& task : tasks) {
      const SweepEntry& entry = sweep.entries[task.entry];
      masks.emplace_back();
      if (entry.given != nullptr) {
        measure_given(truth, *entry.given, task.row, masks.back());
        step(steps_of_errors(sweep) + steps_of_times(sweep, frame));
        continue;
      }
      if (measured % kAhead == 0) {
        const std::size_t next = std::min(kAhead, entries.size() - measured);
        ahead = draw_before(stage, truth, std::span(entries).subspan(measured, next));
      }
      FrameBefore before = std::move(ahead[measured++ % kAhead]);
      FramePictures drawn;
      masks.back() =
          measure_errors(stage, truth, entry, std::move(before), task.row, pictures ? &drawn : nullptr);
      if (!part.request->write_masks) masks.back() = {};
      if (pictures)
        task.row.pictures = write_pictures(sweep.out, sweep.first_scene + scene, task.entry, truth, drawn);
      step(steps_of_errors(sweep));
    }
    std::vector<report::Times> times(entries.size());
    if (sweep.times(frame))
      times = measure_times(stage, truth.camera, entries, sweep.baseline, sweep.rounds, [this] { step(1); });
    std::size_t timed = 0;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      const bool is_given = sweep.entries[tasks[i].entry].given != nullptr;
      tasks[i].row.scene_hash = part.hashes[scene];
      tasks[i].row.animation_time_s = stage.animation_seconds(frame);
      if (!is_given) tasks[i].row.times = times[timed++];
      tasks[i].row.machine = machine_;
      tasks[i].row.machine.load = current_load();
      if (part.request->write_masks && !is_given)
        write_masks(fs::path(sweep.out) / "masks" / ("technique" + std::to_string(tasks[i].entry)),
                    tasks[i].row, {truth.camera, truth.before, stage.light(), stage.bounds()}, masks[i]);
      file_.append(tasks[i].row);
      known_.insert(tasks[i].row.key());
    }
  }

  const std::vector<Part>& parts_;
  RefusedEntries& refused_;
  std::set<std::size_t> refused_here_;  ///< entries of the sweep, in the scene under way
  report::Machine machine_;
  std::set<std::string> known_;
  report::RowsFile file_;
  Progress progress_;
  long long steps_ = 0;
  Clock::time_point begin_ = Clock::now();
  Clock::duration longest_{};  ///< of a frame
  std::size_t frames_left_ = 0;
};

}  // namespace

Compared compare(std::span<const CompareRequest> requests) {
  const CompareRequest& first = requests.front();
  const std::string& out = first.out;
  RefusedEntries refused;
  std::vector<Part> parts = parts_of(requests, refused);
  check_folder("--out", out);
  std::optional<report::ResultsLock> lock;  // before rows are read: another process may be writing them
  if (fs::is_directory(out)) lock.emplace(out);
  for (Part& part : parts) {
    part.hashes = hashes_of(part.sweep);
    check_hashes(part);
    check_scenes(part.sweep);
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
  const std::size_t frames_left =
      Run(parts, machine(context->info()), std::move(known), std::move(*lock), refused).all();
  // A shard's report would show a part as if it were the whole.
  return {frames_left, (fs::path(out) / report::kRowsFile).string(),
          first.shards == 1 ? report::write_report(out).string() : std::string(), refused.lines()};
}

}  // namespace gnomon::tool
