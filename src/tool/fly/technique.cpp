// Which maps and which filter meet the budget, or the error, that was asked for?
#include "gnomon/study/technique.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include "flight.hpp"
#include "gnomon/report/cost_model.hpp"
#include "gnomon/report/row.hpp"
#include "gnomon/scene/caster_work.hpp"
#include "gnomon/scene/pose.hpp"
#include "scene_rays.hpp"
#include "visible_surfaces.hpp"

namespace gnomon::tool::fly {
namespace {

/// Frames that are looked at: a flight changes slowly.
constexpr int kMaxPlanFrames = 16;

/// Filters that the program knows, with what they cost; without a model the one that was given, at no cost.
struct Known {
  CostModel costs;
  std::vector<FilterCost> filters;
  std::vector<render::FilterSettings> of_maps, of_pages;

  [[nodiscard]] const render::FilterSettings& filter_of(const Technique& t) const {
    return (t.pages < 0 ? of_maps : of_pages)[static_cast<std::size_t>(t.filter)];
  }
};

std::vector<render::FilterSettings> settings_of(const std::string& file,
                                                std::span<const FilterCost> filters) {
  std::vector<render::FilterSettings> all;
  for (const FilterCost& filter : filters) {
    const render::ParsedFilter parsed = render::parse_filter(filter.name);
    if (!parsed.error.empty()) throw std::runtime_error(fmt::format("{}: filter {}", file, parsed.error));
    all.push_back(parsed.settings);
  }
  return all;
}

void know(const Options& options, const report::StoredCostModel& model, Known& known) {
  known.costs = model.view(known.filters);
  if (!options.cost_model) {
    known.of_maps = known.of_pages = {options.filter};
    return;
  }
  const std::string file = options.cost_model->string();
  known.of_maps = settings_of(file, known.costs.filters);
  known.of_pages = settings_of(file, known.costs.pages.filters);
  if (options.pages.on() && known.of_pages.empty())
    throw std::runtime_error(file + ": has no costs of pages; gnomon calibrate measures them");
}

/// Pages of all the targets that are tried: like maps of several sizes.
std::vector<PageOptions> page_candidates(const Options& options) {
  if (!options.pages.on()) return {};
  if (options.pages.policy->feedback != 0)
    throw std::runtime_error(
        fmt::format("--pages {}: reads what was drawn, and --budget-ms and --target-error "
                    "choose before that; resolution and clipmap do not",
                    options.pages.policy->name));
  std::vector<PageOptions> all;
  for (double target_m = 0.25; target_m <= 8.0; target_m *= std::sqrt(2.0)) {
    PageSetting setting = options.pages;
    setting.target_m = target_m;
    all.push_back(page_options_of(setting, options.plan));
  }
  return all;
}

std::string text_of(const Technique& t, const std::vector<PageOptions>& pages, const Known& known) {
  const std::string maps = t.pages < 0 ? fmt::format("{} / {} x {}", t.warp->name, t.cascades, t.map_size)
                                       : fmt::format("pages of {} for m {:.2f}",
                                                     pages[static_cast<std::size_t>(t.pages)].page_texels,
                                                     pages[static_cast<std::size_t>(t.pages)].target_m);
  std::string text = fmt::format("{} / {}: {:.3f} % misclassified pixels expected, {:.1f} million texels",
                                 maps, render::to_string(known.filter_of(t)), 100.0 * t.error,
                                 static_cast<double>(t.texels) / 1e6);
  // Without a cost model nobody knows.
  if (t.milliseconds > 0.0) text += fmt::format(", {:.1f} ms", t.milliseconds);
  return text;
}

void print_choice(const TechniqueChoice& choice, const std::vector<PageOptions>& pages, const Known& known) {
  fmt::print("technique: {}{}\n", text_of(choice.chosen, pages, known),
             choice.met ? "" : " (no technique meets the request; this one is nearest)");
  if (choice.cheaper.map_size > 0)
    fmt::print("  a fifth cheaper: {}\n", text_of(choice.cheaper, pages, known));
  if (choice.better.map_size > 0) fmt::print("  a fifth better:  {}\n", text_of(choice.better, pages, known));
}

report::StoredCostModel model_of(const Options& options) {
  if (options.cost_model) {
    try {
      return report::load_cost_model(*options.cost_model);
    } catch (const report::ReportError& error) {
      throw std::runtime_error(error.what());
    }
  }
  report::StoredCostModel model;
  FilterCost free;
  free.extent = options.plan.filter;
  model.filters.push_back({render::to_string(options.filter), free});
  if (options.pages.on()) model.pages.filters = model.filters;
  return model;
}

}  // namespace

void choose_technique_of(Options& options, Flight& flight) {
  const report::StoredCostModel model = model_of(options);
  Known known;
  know(options, model, known);
  const std::vector<PageOptions> pages = page_candidates(options);
  const std::vector<CasterWork> work = caster_work(flight.scene);
  const Light light = light_of(options, flight.scene);
  const bool plays = flight.animation != kRestPose;
  Scene posed = flight.scene;
  std::optional<SceneRays> rays;
  TechniqueChoice hardest;
  const int frames = std::min(options.frames, kMaxPlanFrames);
  for (int i = 0; i < frames; ++i) {
    // The middle of each of `frames` equal parts.
    const int frame = static_cast<int>((i + 0.5) * options.frames / frames);
    const Camera camera = camera_of(options, flight, frame);
    pose_frame(options, flight, frame, nullptr);
    if (plays) apply_pose(flight.pose, posed);
    if (plays || i == 0) rays.emplace(posed);
    const auto shadow = rays->shadow(camera, light);
    TechniqueSet among;
    std::vector<glm::dvec3> points;
    std::vector<std::byte> memory;
    if (!pages.empty()) {
      // As densely as the pages of the flight are planned from.
      points = rays->points(camera, light, camera.width / VisibleSurfaces::kStride,
                            camera.height / VisibleSurfaces::kStride);
      memory.resize(page_memory(options.pages.capacity, points.size()));
      among.pages = {pages, points, {}, memory};
    }
    const TechniqueChoice choice = choose_technique(camera, shadow.picture(), light, flight.bounds(), work,
                                                    among, options.budget, known.costs, options.plan);
    if (choice.status == PlanStatus::invalid_input)
      throw std::runtime_error(fmt::format("frame {}: no technique for {}", frame, choice.invalid_field));
    if (choice.status != PlanStatus::ok) continue;
    const auto hardness = [&](const Technique& t) {
      return options.budget.target_error > 0.0 ? static_cast<double>(t.texels) : t.error;
    };
    if (hardest.status != PlanStatus::ok || hardness(choice.chosen) > hardness(hardest.chosen))
      hardest = choice;
    hardest.pages = {};  // lies in memory of this frame
  }
  if (hardest.status != PlanStatus::ok) return;  // nothing to see, nothing to choose
  if (!options.json) print_choice(hardest, pages, known);
  const Technique& chosen = hardest.chosen;
  if (chosen.pages >= 0) {
    options.pages.target_m = pages[static_cast<std::size_t>(chosen.pages)].target_m;
  } else {
    options.pages = {};
  }
  options.plan = hardest.options;
  options.filter = known.filter_of(chosen);
  render::set_margin(options.filter, options.plan);
}

}  // namespace gnomon::tool::fly
