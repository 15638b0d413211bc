// Which maps and which filter meet the budget, or the error, that was asked for?
#include "gnomon/study/technique.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "flight.hpp"
#include "gnomon/report/cost_model.hpp"
#include "gnomon/report/row.hpp"
#include "gnomon/scene/caster_work.hpp"
#include "visible_points.hpp"

namespace gnomon::tool::fly {
namespace {

/// Frames that are looked at: a flight changes slowly.
constexpr int kMaxPlanFrames = 16;

/// The camera with as many pixels as are worth the time: as many are counted for each technique.
Camera smaller(Camera camera) noexcept {
  constexpr int kMaxWidth = 320;
  const double scale = std::min(1.0, static_cast<double>(kMaxWidth) / camera.width);
  camera.width = std::max(static_cast<int>(camera.width * scale), 1);
  camera.height = std::max(static_cast<int>(camera.height * scale), 1);
  return camera;
}

/// Filters that the program knows, with what they cost; without a model the one that was given, at no cost.
struct Known {
  CostModel costs;
  std::vector<FilterCost> filters;
  std::vector<render::FilterSettings> settings;
};

void know(const Options& options, const report::StoredCostModel& model, Known& known) {
  known.costs = model.view(known.filters);
  if (!options.cost_model) known.settings = {options.filter};
  if (!options.cost_model) return;
  for (const FilterCost& filter : known.filters) {
    const render::ParsedFilter parsed = render::parse_filter(filter.name);
    if (!parsed.error.empty())
      throw std::runtime_error(fmt::format("{}: filter {}", options.cost_model->string(), parsed.error));
    known.settings.push_back(parsed.settings);
  }
}

std::string text_of(const Technique& t, const Known& known) {
  std::string text = fmt::format(
      "{} / {} x {} / {}: {:.3f} % misclassified pixels expected, {:.1f} million texels", t.warp->name,
      t.cascades, t.map_size, render::to_string(known.settings[static_cast<std::size_t>(t.filter)]),
      100.0 * t.error, static_cast<double>(t.texels) / 1e6);
  // Without a cost model nobody knows.
  if (t.milliseconds > 0.0) text += fmt::format(", {:.1f} ms", t.milliseconds);
  return text;
}

void print_choice(const TechniqueChoice& choice, const Known& known) {
  fmt::print("technique: {}{}\n", text_of(choice.chosen, known),
             choice.met ? "" : " (no technique meets the request; this one is nearest)");
  if (choice.cheaper.map_size > 0) fmt::print("  a fifth cheaper: {}\n", text_of(choice.cheaper, known));
  if (choice.better.map_size > 0) fmt::print("  a fifth better:  {}\n", text_of(choice.better, known));
}

}  // namespace

void choose_technique_of(Options& options, const Flight& flight) {
  Known known;
  report::StoredCostModel model;
  if (options.cost_model) {
    try {
      model = report::load_cost_model(*options.cost_model);
    } catch (const report::ReportError& error) {
      throw std::runtime_error(error.what());
    }
  } else {
    model.filters.push_back({render::to_string(options.filter), {}});
  }
  know(options, model, known);
  const std::vector<CasterWork> work = caster_work(flight.scene);
  const Light light = light_of(options, flight.scene);
  const SeenShadowOf seen_shadow(flight.scene);
  TechniqueChoice hardest;
  const int frames = std::min(options.frames, kMaxPlanFrames);
  for (int i = 0; i < frames; ++i) {
    // The middle of each of `frames` equal parts.
    const int frame = static_cast<int>((i + 0.5) * options.frames / frames);
    const Camera camera = camera_of(options, flight, frame);
    const auto shadow = seen_shadow(smaller(camera), light);
    const TechniqueChoice choice = choose_technique(camera, shadow.picture(), light, flight.bounds(), work,
                                                    {}, options.budget, known.costs, options.plan);
    if (choice.status == PlanStatus::invalid_input)
      throw std::runtime_error(fmt::format("frame {}: no technique for {}", frame, choice.invalid_field));
    if (choice.status != PlanStatus::ok) continue;
    const auto hardness = [&](const Technique& t) {
      return options.budget.target_error > 0.0 ? static_cast<double>(t.texels) : t.error;
    };
    if (hardest.status != PlanStatus::ok || hardness(choice.chosen) > hardness(hardest.chosen))
      hardest = choice;
  }
  if (hardest.status != PlanStatus::ok) return;  // nothing to see, nothing to choose
  if (!options.json) print_choice(hardest, known);
  options.plan = hardest.options;
  options.filter = known.settings[static_cast<std::size_t>(hardest.chosen.filter)];
  render::set_margin(options.filter, options.plan);
}

}  // namespace gnomon::tool::fly
