// `gnomon bias --sweep`: which bias is right for the scene nobody tuned it on?
#include "bias/bias_sweep.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "compare/measure.hpp"
#include "compare/planned.hpp"
#include "compare/stage.hpp"
#include "float_channel.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/report/errors.hpp"
#include "interrupt.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "scene_words.hpp"

namespace gnomon::tool {
namespace {

double number_from(const std::string& option, const std::string& word, double least, double most) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !(value >= least && value <= most)) {
    char text[64];
    std::snprintf(text, sizeof text, "wants a number between %g and %g", least, most);
    throw std::runtime_error(option + " " + word + ": " + text);
  }
  return value;
}

std::vector<double> read_bias_numbers(const std::string& option, const Words& words) {
  constexpr double kMaxTexels = 1e6;
  std::vector<double> values;
  for (const std::string& word : split_lists(words))
    values.push_back(number_from(option, word, 0.0, kMaxTexels));
  return values;
}

/// "sun:20" is a sun 20 degrees above the horizon. Each light comes from another side than the one before.
std::vector<SweptLight> read_lights(const std::string& option, const Words& words) {
  constexpr double kTurnDeg = 75.0, kLowestDeg = 0.1, kHighestDeg = 90.0;
  std::vector<SweptLight> lights;
  for (const std::string& word : split_lists(words)) {
    SweptLight light{word, {}};
    const std::size_t colon = word.find(':');
    if (!light_kind_from_name(word.substr(0, colon), light.placement.kind))
      refuse_name(option, word, std::vector<std::string>{"sun", "spot", "point"});
    if (colon != std::string::npos)
      light.placement.elevation_deg = number_from(option, word.substr(colon + 1), kLowestDeg, kHighestDeg);
    light.placement.azimuth_deg += kTurnDeg * static_cast<double>(lights.size());
    lights.push_back(std::move(light));
  }
  return lights;
}

std::vector<BiasOptions> settings_of(const BiasSweep& sweep) {
  std::vector<BiasOptions> settings{{}};
  for (const double constant : sweep.constants) {
    for (const double slope : sweep.slopes) {
      for (const double offset : sweep.normal_offsets) {
        for (const double max_slope : sweep.max_slopes) {
          const BiasOptions bias{constant, slope, offset, max_slope};
          if (!(bias == settings.front())) settings.push_back(bias);
        }
      }
    }
  }
  return settings;
}

/// What a mask has wrong, in pixels.
struct Wrong {
  double decided = 0.0;  ///< by exact rays
  double false_shadow = 0.0, false_light = 0.0;
  /// MaskErrors', where the exact shadow is uniform for three pixels round.
  double too_dark = 0.0, too_light = 0.0;
  [[nodiscard]] double misclassified() const noexcept { return false_shadow + false_light; }
  [[nodiscard]] double share(double pixels) const noexcept { return pixels / std::max(1.0, decided); }
};

Wrong wrong_pixels(const std::vector<float>& lit, const FrameTruth& truth,
                   const std::vector<float>& uniform) {
  const report::MaskErrors errors = report::mask_errors(lit, truth.seen.mask, uniform);
  const auto decided = static_cast<double>(errors.pixels);
  return {decided, errors.false_shadow * decided, errors.false_lit * decided, errors.too_dark * decided,
          errors.too_light * decided};
}

/// What a setting has wrong over all drawings of a filter, beside the first setting in the same ones.
class Totals {
 public:
  void add(const Wrong& wrong, const Wrong& first) {
    ++drawings_;
    misclassified_ += wrong.share(wrong.misclassified());
    first_ += first.share(first.misclassified());
    too_dark_ += wrong.share(wrong.too_dark);
    too_light_ += wrong.share(wrong.too_light);
    const double ratio = (wrong.misclassified() + kHandful) / (first.misclassified() + kHandful);
    log_ratio_ += std::log(ratio);
    worst_ = std::max(worst_, ratio);
    worse_ += ratio > kWorse ? 1 : 0;
  }
  [[nodiscard]] std::string cells() const {
    const double count = std::max(1, drawings_);
    char text[192];
    std::snprintf(text, sizeof text, "%.3f %% | %.3f | %.3f | %.2f | %d of %d | %.3f %% | %.3f %% |",
                  100.0 * misclassified_ / count, first_ > 0.0 ? misclassified_ / first_ : 1.0,
                  std::exp(log_ratio_ / count), worst_, worse_, drawings_, 100.0 * too_dark_ / count,
                  100.0 * too_light_ / count);
    return text;
  }

 private:
  /// Added to both counts of a ratio: a difference of so few pixels says nothing.
  static constexpr double kHandful = 20.0, kWorse = 1.05;
  int drawings_ = 0, worse_ = 0;
  double misclassified_ = 0.0, first_ = 0.0, too_dark_ = 0.0, too_light_ = 0.0, log_ratio_ = 0.0,
         worst_ = 0.0;
};

/// By setting: each filter's totals, and behind them those of all.
class Table {
 public:
  Table(std::vector<BiasOptions> settings, const std::vector<TechniqueFilter>& filters)
      : settings_(std::move(settings)), totals_(settings_.size(), std::vector<Totals>(filters.size() + 1)) {
    for (const TechniqueFilter& filter : filters) names_.push_back(filter.name);
    names_.emplace_back("all");
  }
  [[nodiscard]] const std::vector<BiasOptions>& settings() const noexcept { return settings_; }
  void add(std::size_t setting, const std::string& filter, const Wrong& wrong, const Wrong& first) {
    const auto place = std::find(names_.begin(), names_.end(), filter) - names_.begin();
    totals_[setting][static_cast<std::size_t>(place)].add(wrong, first);
    totals_[setting].back().add(wrong, first);
  }
  void print() const {
    print_line(
        "| constant | slope | normal offset | max slope | filter | misclassified | of the first | geometric "
        "mean "
        "of views | worst view | over 5 % worse | too dark | too light |");
    print_line("|--:|--:|--:|--:|--|--:|--:|--:|--:|--:|--:|--:|");
    for (std::size_t i = 0; i < settings_.size(); ++i) {
      const BiasOptions& bias = settings_[i];
      char text[96];
      std::snprintf(text, sizeof text, "| %g | %g | %g | %g | ", bias.constant_texels, bias.slope_texels,
                    bias.normal_offset_texels, bias.max_slope);
      for (std::size_t k = 0; k < names_.size(); ++k)
        print_line(text + names_[k] + " | " + totals_[i][k].cells());
    }
  }

 private:
  std::vector<BiasOptions> settings_;
  std::vector<std::string> names_;
  std::vector<std::vector<Totals>> totals_;
};

std::string json_line(const std::string& scene, const SweptLight& light, const SweepEntry& entry,
                      const Wrong& wrong) {
  const BiasOptions& bias = entry.plan.bias;
  return nlohmann::ordered_json{{"scene", scene},
                                {"light", light.name},
                                {"filter", entry.technique.filter},
                                {"layer", entry.technique.layer.empty() ? "front" : entry.technique.layer},
                                {"warp", entry.technique.warp},
                                {"map_size", entry.technique.map_size},
                                {"constant_texels", bias.constant_texels},
                                {"slope_texels", bias.slope_texels},
                                {"normal_offset_texels", bias.normal_offset_texels},
                                {"max_slope", bias.max_slope},
                                {"pixels", wrong.decided},
                                {"false_shadow", wrong.share(wrong.false_shadow)},
                                {"false_light", wrong.share(wrong.false_light)},
                                {"too_dark", wrong.share(wrong.too_dark)},
                                {"too_light", wrong.share(wrong.too_light)}}
      .dump();
}

/// One view: each technique with each setting.
void measure_view(const Sweep& product, const std::string& scene, const SweptLight& light, int frame,
                  Table& table, Progress& progress, long long& done) {
  Stage stage(product, scene);
  warn_of(stage.scene());
  const FrameTruth truth = frame_truth(stage, frame, product.baseline);
  constexpr int kReach = 3;  // pixels
  const std::vector<float> uniform = report::uniform_truth(truth.seen.mask, truth.hard.width, kReach);
  for (SweepEntry entry : product.entries) {
    Wrong first;
    for (std::size_t i = 0; i < table.settings().size(); ++i) {
      check_interrupt();
      entry.plan.bias = table.settings()[i];
      Planned plan(stage, entry, truth.camera);
      if (plan.status() == PlanStatus::invalid_input)
        throw std::runtime_error(scene + ": " + invalid_input_text(plan.invalid_field()));
      render::FrameOptions options;
      options.prune = prune_rules_of(PruneSource::this_frame);
      options.aliasing = options.heat_map = options.cascade_tint = options.time_passes = false;
      (void)plan.draw(truth.camera, options);
      const Wrong wrong = wrong_pixels(channel(stage.renderer().mask(), 0), truth, uniform);
      if (i == 0) first = wrong;
      table.add(i, entry.technique.filter, wrong, first);
      progress.set(++done);
      if (!product.json) continue;
      progress.clear();
      print_line(json_line(scene, light, entry, wrong));
      flush_output();
    }
  }
  render::check_context();
}

}  // namespace

std::vector<Option> bias_sweep_options(BiasSweep& sweep) {
  std::vector<Option> options{
      {.name = "--filters",
       .target = word_list(sweep.filters, read_filters, {"hard", "pcf", "vsm", "pcss"}),
       .help = "filters that read the maps",
       .names = names_in(render::all_filters(), {"all"})},
      {.name = "--warps",
       .target = word_list(sweep.warps, read_warps, {"none", "auto"}),
       .help = "warps of the maps",
       .names = names_in(all_warps(), {"auto"})},
      {.name = "--map-sizes",
       .target = word_list(sweep.map_sizes, read_map_sizes, {"512", "1024", "2048"}),
       .help = "texels along each side of a map"},
      {.name = "--lights",
       .target = word_list(sweep.lights, read_lights, {"sun:20", "sun:50", "spot", "point"}),
       .help = "a view of each scene for each; behind a colon the sun's elevation in degrees"},
      {.name = "--constants",
       .target = word_list(sweep.constants, read_bias_numbers, {"0.05", "0.15"}),
       .help = "texels along the light, everywhere"},
      {.name = "--slopes",
       .target = word_list(sweep.slopes, read_bias_numbers, {"0.5", "0.75"}),
       .help = "texels along the light, times tan(angle)"},
      {.name = "--normal-offsets",
       .target = word_list(sweep.normal_offsets, read_bias_numbers, {"0", "0.1", "0.5"}),
       .help = "texels along the normal, times sin(angle)"},
      {.name = "--max-slopes",
       .target = word_list(sweep.max_slopes, read_bias_numbers, {"4", "8", "100"}),
       .help = "caps of tan(angle)"}};
  for (Option& option : options) option.needs = "--sweep";
  return options;
}

void sweep_biases(const BiasSweep& sweep, SweepRequest request) {
  if (request.scenes.empty()) request.scenes = builtin_scene_words();
  request.filters = sweep.filters;
  request.warps = sweep.warps;
  request.map_sizes = sweep.map_sizes;
  // As many cameras along the scene's path as lights: each view has both of its own.
  request.frames = static_cast<int>(sweep.lights.size());
  Sweep product = make_sweep(request);
  for (const std::string& line : product.left_out) warn(line);
  for (const SweepEntry& entry : product.entries) {
    if (entry.irregular())
      throw std::runtime_error("--filters irregular: compares no depths, and knows no bias");
  }
  watch_interrupts();
  const auto context = render::create_context(product.context);
  Table table(settings_of(sweep), sweep.filters);
  Progress progress("gnomon bias --sweep, rows",
                    static_cast<long long>(product.scenes.size() * sweep.lights.size() *
                                           product.entries.size() * table.settings().size()));
  long long done = 0;
  for (const std::string& scene : product.scenes) {
    for (std::size_t i = 0; i < sweep.lights.size(); ++i) {
      product.light = sweep.lights[i].placement;
      measure_view(product, scene, sweep.lights[i], static_cast<int>(i), table, progress, done);
    }
  }
  progress.clear();
  if (!request.json) table.print();
}

}  // namespace gnomon::tool
