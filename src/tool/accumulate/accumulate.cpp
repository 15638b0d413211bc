// `gnomon accumulate`: how much of the shadow's error is left after 1, 8, 64 frames of temporal accumulation,
// with the view at rest and along a moving one?
#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "command.hpp"
#include "compare/measure.hpp"
#include "compare/stage.hpp"
#include "compare/sweep.hpp"
#include "float_channel.hpp"
#include "gnomon/motion.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/report/errors.hpp"
#include "gnomon/scene/image.hpp"
#include "interrupt.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "scene_words.hpp"

namespace gnomon::tool {
namespace {

constexpr int kFlightFrames = 600;  ///< ten seconds at 60 Hz
constexpr int kFrame = kFlightFrames / 2;
constexpr int kMaxFrames = 4096;

struct AccumulateRequest : Measuring {
  AccumulateRequest() {
    width = 1680;
    height = 1050;
  }
  MeasuredMaps maps{technique_warp("--warp", "optimal")};
  std::vector<TechniqueFilter> filters;
  std::vector<int> rest_frames{1, 8, 64};  ///< after which the view at rest is measured
  int moving_frames = 32;                  ///< 0: none
  render::SampleNoise noise = render::SampleNoise::blue;
  double bias = 0.05;  ///< share of the usual one
  render::Accumulation settings;
};

/// The sweep of the filters, in frames as a viewer at 60 Hz sees them.
Sweep sweep_of(const AccumulateRequest& request) {
  SweepRequest product = one_kind_of_maps(request, request.maps);
  product.filters = request.filters;
  product.frames = kFlightFrames;
  Sweep sweep = make_sweep(product);
  for (SweepEntry& entry : sweep.entries) {
    entry.plan.filter.texels += kJitterReachTexels;
    BiasOptions& bias = entry.plan.bias;
    bias.constant_texels *= request.bias;
    bias.slope_texels *= request.bias;
    bias.normal_offset_texels *= request.bias;
  }
  return sweep;
}

/// One frame's mask, and the milliseconds that finding and accumulating it took.
struct DrawnMask {
  std::vector<float> lit;
  double mask_ms = 0.0, accumulate_ms = 0.0;
};

/// Draws frames of one filter on one scene.
class Run {
 public:
  Run(const AccumulateRequest& request, Stage& stage, const SweepEntry& entry)
      : request_(request), stage_(stage), entry_(entry) {}

  /// `index` counts from 0; 0 forgets what was accumulated. Not accumulated: the frame alone.
  DrawnMask draw(const Camera& camera, int index, bool accumulated) {
    const auto frame = static_cast<std::uint32_t>(index);
    const ShadowPlan plan = jittered(stage_.plan(entry_, camera), jitter_texels(frame));
    render::FrameOptions options;
    options.aliasing = options.heat_map = options.cascade_tint = false;
    options.noise = request_.noise;
    options.frame_index = frame;
    options.accumulation = request_.settings;
    options.accumulation.on = accumulated;
    options.accumulation.restart = index == 0;
    const render::FrameStats stats = stage_.renderer().draw(plan, camera, stage_.filter(entry_), options);
    return {channel(stage_.renderer().mask(), 0), stats.ms(render::Pass::mask),
            stats.ms(render::Pass::accumulate)};
  }

  void write_picture(const std::string& name) const {
    if (request_.out.empty()) return;
    write_png(stage_.renderer().image(), std::filesystem::path(request_.out) / (name + ".png"));
  }

 private:
  const AccumulateRequest& request_;
  Stage& stage_;
  const SweepEntry& entry_;
};

double misclassified(const std::vector<float>& mask, const FrameTruth& truth) {
  const report::MaskErrors errors = report::mask_errors(mask, truth.seen.mask, truth.seen.mask);
  return errors.false_lit + errors.false_shadow;
}

/// Pixels that are wrong with accumulation and right without, as a share of those that are decided.
double ghosting(const std::vector<float>& accumulated, const std::vector<float>& single,
                const FrameTruth& truth) {
  const auto wrong = [](float lit, float exact) { return (lit > 0.5f) != (exact > 0.5f); };
  std::uint64_t decided = 0, ghosts = 0;
  for (std::size_t i = 0; i < accumulated.size(); ++i) {
    if (truth.seen.mask[i] < 0.0f) continue;
    ++decided;
    ghosts += wrong(accumulated[i], truth.seen.mask[i]) && !wrong(single[i], truth.seen.mask[i]) ? 1 : 0;
  }
  return decided == 0 ? 0.0 : static_cast<double>(ghosts) / static_cast<double>(decided);
}

/// A line of the table; numbers below zero were not measured.
struct AccumulateRow {
  std::string scene, filter, view;
  int frames = 0;
  double wrong = 0.0, to_first = -1.0, flips = -1.0, ghosts = -1.0, mask_ms = 0.0, accumulate_ms = 0.0;
};

/// "street_pcf_radius_2_8": one file for each scene, filter and view.
std::string picture_name(const AccumulateRow& row, const std::string& view) {
  std::string name = scene_stem(row.scene) + "_" + row.filter + "_" + view;
  for (char& c : name)
    if (c == ':' || c == '=' || c == ',') c = '_';
  return name;
}

void print_row(const AccumulateRow& row, bool json) {
  if (json) {
    nlohmann::ordered_json line{{"scene", row.scene},
                                {"filter", row.filter},
                                {"view", row.view},
                                {"frames", row.frames},
                                {"misclassified", row.wrong},
                                {"mask_ms", row.mask_ms},
                                {"accumulate_ms", row.accumulate_ms}};
    if (row.to_first >= 0.0) line["to_first"] = row.to_first;
    if (row.flips >= 0.0) line["flips"] = row.flips;
    if (row.ghosts >= 0.0) line["ghosting"] = row.ghosts;
    print_line(line.dump());
  } else {
    const auto percent = [](double share) {
      char text[32];
      std::snprintf(text, sizeof text, "%.3g %%", 100.0 * share);
      return share < 0.0 ? std::string() : std::string(text);
    };
    char text[512];
    std::snprintf(text, sizeof text, "| %s | %s | %s | %d | %s | %s | %s | %s | %.1f | %.1f |",
                  row.scene.c_str(), row.filter.c_str(), row.view.c_str(), row.frames,
                  percent(row.wrong).c_str(), percent(row.to_first).c_str(), percent(row.flips).c_str(),
                  percent(row.ghosts).c_str(), row.mask_ms, row.accumulate_ms);
    print_line(text);
  }
  flush_output();
}

/// The view at rest: rows at the requested numbers of frames.
void measure_rest(const AccumulateRequest& request, Run& run, const Camera& camera, const FrameTruth& truth,
                  AccumulateRow row) {
  std::vector<int> wanted = request.rest_frames;
  std::sort(wanted.begin(), wanted.end());
  row.view = "at rest";
  double first = -1.0;
  DrawnMask now = run.draw(camera, 0, true);
  Progress progress(row.filter, wanted.back());
  for (int drawn = 1; drawn <= wanted.back(); ++drawn) {
    check_interrupt();
    progress.set(drawn);
    const bool counts = std::binary_search(wanted.begin(), wanted.end(), drawn);
    if (drawn == 1) first = misclassified(now.lit, truth);
    if (counts) run.write_picture(picture_name(row, std::to_string(drawn)));
    DrawnMask next = run.draw(camera, drawn, true);
    if (counts) {
      row.frames = drawn;
      row.wrong = misclassified(now.lit, truth);
      row.to_first = first > 0.0 ? row.wrong / first : -1.0;
      row.flips = report::excess_flips(now.lit, next.lit, truth.seen.mask, truth.seen.mask);
      row.mask_ms = now.mask_ms;
      row.accumulate_ms = now.accumulate_ms;
      progress.clear();
      print_row(row, request.json);
    }
    now = std::move(next);
  }
}

/// The last of some frames, alone and with those before it.
struct Sequence {
  std::string name;
  std::function<void(int index)> pose;  ///< places the scene for a frame, before it is drawn
  std::function<Camera(int index)> camera;
};

void measure_sequence(const AccumulateRequest& request, Run& run, const Sequence& sequence,
                      const FrameTruth& truth, AccumulateRow row) {
  const int last = request.moving_frames - 1;
  sequence.pose(last);
  const DrawnMask single = run.draw(sequence.camera(last), last, false);
  row.view = sequence.name + ", alone";
  row.frames = 1;
  row.wrong = misclassified(single.lit, truth);
  row.mask_ms = single.mask_ms;
  print_row(row, request.json);
  DrawnMask accumulated;
  for (int i = 0; i <= last; ++i) {
    check_interrupt();
    sequence.pose(i);
    accumulated = run.draw(sequence.camera(i), i, true);
  }
  run.write_picture(picture_name(row, sequence.name));
  const double alone = row.wrong;
  row.view = sequence.name;
  row.frames = request.moving_frames;
  row.wrong = misclassified(accumulated.lit, truth);
  row.to_first = alone > 0.0 ? row.wrong / alone : -1.0;
  row.ghosts = ghosting(accumulated.lit, single.lit, truth);
  row.mask_ms = accumulated.mask_ms;
  row.accumulate_ms = accumulated.accumulate_ms;
  print_row(row, request.json);
}

/// The view on its way to the frame that is measured.
Sequence moving_view(const AccumulateRequest& request, const Stage& stage) {
  return {"moving", [](int) {},
          [&](int index) { return stage.camera(kFrame - request.moving_frames + 1 + index); }};
}

/// The view at rest while the animation plays up to the frame's pose.
Sequence moving_casters(const AccumulateRequest& request, Stage& stage) {
  return {"animated", [&](int index) { stage.pose_before(kFrame, request.moving_frames - 1 - index); },
          [&](int) { return stage.camera(kFrame); }};
}

int run_accumulate(const AccumulateRequest& request) {
  for (const int frames : request.rest_frames)
    if (frames < 1 || frames > kMaxFrames)
      throw std::runtime_error("--frames " + std::to_string(frames) + ": wants 1 to " +
                               std::to_string(kMaxFrames));
  if (request.maps.warp.shape != nullptr)
    refuse_name("--warp", request.maps.warp.name, names_in(all_warps(), {"auto"}));
  const Sweep sweep = sweep_of(request);
  watch_interrupts();
  if (!request.out.empty()) make_folder("--out", request.out);
  const auto context = render::create_context(sweep.context);
  if (!request.json) {
    print_line(
        "| scene | filter | view | frames | misclassified | to one frame | flips | ghosting | mask ms | "
        "accumulate ms |");
    print_line("|--|--|--|--:|--:|--:|--:|--:|--:|--:|");
  }
  for (const std::string& scene : sweep.scenes) {
    Stage stage(sweep, scene);
    warn_of(stage.scene());
    const FrameTruth truth = frame_truth(stage, kFrame, sweep.baseline);
    for (const SweepEntry& entry : sweep.entries) {
      Run run(request, stage, entry);
      AccumulateRow row;
      row.scene = scene;
      row.filter = to_string(entry.filter);
      measure_rest(request, run, truth.camera, truth, row);
      if (request.moving_frames > 0) {
        measure_sequence(request, run, moving_view(request, stage), truth, row);
        if (stage.plays()) measure_sequence(request, run, moving_casters(request, stage), truth, row);
      }
      render::check_context();
    }
  }
  return 0;
}

/// Which maps are drawn and read, and what moves.
std::vector<Option> map_options(AccumulateRequest& request) {
  std::vector<Option> options{{.name = "--filters",
                               .target = word_list(request.filters, read_filters, {"hard"}),
                               .help = "filters, with options as in pcss:angle_deg=1",
                               .names = names_in(render::all_filters())}};
  for (Option& option : measured_maps_options(request.maps)) options.push_back(std::move(option));
  options.insert(options.begin() + 2,
                 {.name = "--animation",
                  .target = &request.animation,
                  .help = "animation that plays before a view at rest, by name or number",
                  .word = "NAME"});
  options.push_back({.name = "--bias",
                     .target = &request.bias,
                     .help = "share of the usual bias; comparisons near texels' centres need less of it",
                     .range = {{0.0, 4.0}}});
  return options;
}

/// How frames are accumulated.
std::vector<Option> accumulation_options(AccumulateRequest& request) {
  const std::vector<std::string> noises{"still", "gradient", "blue"};  // in the order of render::SampleNoise
  return {{.name = "--frames",
           .target = &request.rest_frames,
           .help = "numbers of frames after which the view at rest is measured",
           .delimiter = ','},
          {.name = "--moving",
           .target = &request.moving_frames,
           .help = "frames of a moving view, or of an animation, at 60 Hz that are accumulated; 0: none",
           .range = {{0, kFrame}}},
          {.name = "--confidence-power",
           .target = &request.settings.confidence_power,
           .help = "power of the confidence that weighs a frame; 0: all frames weigh alike",
           .range = {{0.0, 64.0}}},
          {.name = "--memory",
           .target = &request.settings.memory,
           .help = "frames that the history counts as at most",
           .range = {{1.0, 4096.0}}},
          {.name = "--depth-tolerance",
           .target = &request.settings.depth_tolerance,
           .help = "share of the view depth by which the history may be off",
           .range = {{0.0, 1.0}}},
          {.name = "--noise",
           .target = enum_word(request.noise, noises),
           .help = "noise of sample patterns from frame to frame",
           .names = noises}};
}

}  // namespace

std::function<int()> declare_accumulate(Arguments& arguments) {
  const auto request = std::make_shared<AccumulateRequest>();
  std::vector<Option> own = accumulation_options(*request);
  for (Option& option : map_options(*request)) own.push_back(std::move(option));
  arguments.options =
      measuring_options(*request, scenes_option(*request, "builtin:NAME or glTF files", true), std::move(own),
                        "folder for pictures of the measured frames; without it none are written");
  arguments.footer =
      "Each frame moves the maps' texels by another share of a texel; re-projection accumulates the mask.\n"
      "Misclassified: pixels whose mask is on the wrong side of one half, against exact rays. Flips: pixels\n"
      "that change from this frame to the next. Ghosting: pixels that the frame alone has right and\n"
      "accumulation has wrong.";
  return [request] { return run_accumulate(*request); };
}

}  // namespace gnomon::tool
