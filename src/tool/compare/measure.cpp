// What one technique does on one frame: its errors against the truth, what it costs, and how long it takes.
#include "measure.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <memory>
#include <numeric>
#include <random>
#include <stdexcept>
#include <utility>
#include <variant>

#include "exact_results.hpp"
#include "float_channel.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "planned.hpp"

namespace gnomon::tool {
namespace {

using render::Pass;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

render::FrameOptions frame_options(bool pictures) {
  render::FrameOptions options;
  // Each round measures the whole frame: none may live on the one before.
  options.prune = prune_rules_of(PruneSource::this_frame);
  options.aliasing = options.heat_map = pictures;
  options.cascade_tint = false;
  return options;
}

/// The kernel of a filter as the box that weighs alike. Texels: half its side; world: the same in world
/// units.
double kernel_half_side(const render::FilterSettings& filter) {
  constexpr double kHalfTexel = 0.5, kBoxOfDisc = 0.86602540378443865;  // of the variance of a unit disc
  return filter.unit == render::KernelUnit::world ? kBoxOfDisc * filter.radius : filter.radius + kHalfTexel;
}

/// Radius of the light that the filter softens its shadows for, as trace::area_reference wants it; 0 where it
/// knows of none.
double light_radius(const render::FilterSettings& filter, const Light& light) noexcept {
  const auto penumbra = filter.filter->info.penumbra_radius_world;
  if (penumbra == nullptr) return 0.0;
  // Half way to a local light the penumbra is as wide as the light.
  return std::holds_alternative<DirectionalLight>(light) ? penumbra(filter, 1.0, 0.0)
                                                         : penumbra(filter, 0.5, 1.0);
}

/// The kernel no narrower than the pixel, half sides in texels.
glm::dvec2 wider(const glm::dvec2& kernel, const glm::dvec2& pixel) noexcept {
  return glm::max(kernel, glm::min(pixel, render::kMaxRadiusTexels));
}

/// Through an ideal filter, whose kernel lies at each facing pixel as `axes_at` says.
std::vector<float> filtered(const Stage& stage, const FrameTruth& truth, trace::KernelShape shape,
                            int samples, const std::function<trace::KernelAxes(std::size_t)>& axes_at) {
  std::vector<trace::KernelAxes> axes(truth.points.pixels.size());
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (truth.points.pixels[i].state == trace::PixelState::facing) axes[i] = axes_at(i);
  ExactKey key = stage.exact().key("filtered").add(truth.points).add(static_cast<int>(shape)).add(samples);
  for (const trace::KernelAxes& a : axes) key.add(a.x).add(a.y);
  return stage.exact().values(key, axes.size(), [&] {
    return trace::filtered_reference(
               stage.tracer(), truth.points, stage.light(), shape, [&](std::size_t i) { return axes[i]; },
               samples)
        .pixels;
  });
}

std::vector<float> soft_truth(const Stage& stage, const FrameTruth& truth, const Planned& plan,
                              const SweepEntry& entry, const std::vector<float>& maps) {
  if (entry.irregular_samples == 1) return truth.seen.mask;
  if (entry.irregular()) {
    // As many as make the mean's own error small beside that of the most samples a pixel can have.
    constexpr int kSamples = 256;
    return filtered(stage, truth, trace::KernelShape::box, kSamples, [&](std::size_t pixel) {
      return trace::facet_axes(truth.camera, truth.points.pixels[pixel]);
    });
  }
  const double light = light_radius(entry.filter, stage.light());
  if (light > 0.0) {
    return stage.exact().values(
        stage.exact().key("area").add(truth.points).add(light), truth.points.pixels.size(),
        [&] { return trace::area_reference(stage.tracer(), truth.points, stage.light(), light).pixels; });
  }
  // Stored texels are blurred by a Gauss that is cut at two deviations, the box's half side: 0.88 of a
  // deviation is what is left of it.
  constexpr double kDeviationOfSide = 0.44;
  const bool gauss = entry.filter.filter->info.reads != render::MapRead::depth &&
                     entry.filter.blur == render::BlurShape::gauss;
  const double side = kernel_half_side(entry.filter) * (gauss ? kDeviationOfSide : 1.0);
  const bool covers_pixel = render::covers_pixel(entry.filter);
  const auto axes = [&](std::size_t pixel) {
    const glm::dvec3& point = truth.points.pixels[pixel].position;
    const ShadowMap* const map = plan.map(static_cast<int>(maps[pixel]));
    const bool in_world = entry.filter.unit == render::KernelUnit::world;
    if (in_world && !covers_pixel) return trace::world_axes(stage.light(), point, side);
    if (map == nullptr) return trace::KernelAxes{};
    glm::dvec2 half_sides(side);
    if (in_world)
      half_sides = trace::pixel_in_texels(*map, point, trace::world_axes(stage.light(), point, side));
    if (covers_pixel) {
      const trace::KernelAxes facet = trace::facet_axes(truth.camera, truth.points.pixels[pixel]);
      half_sides = wider(half_sides, trace::pixel_in_texels(*map, point, facet));
    }
    const trace::KernelAxes texel = trace::texel_axes(*map, point, 1.0);
    return trace::KernelAxes{texel.x * half_sides.x, texel.y * half_sides.y};
  };
  return filtered(stage, truth, gauss ? trace::KernelShape::gauss : trace::KernelShape::box,
                  trace::kSoftSamples, axes);
}

/// Pixels in the lists of an irregular frame.
report::ListLengths list_lengths(const render::Renderer& renderer) {
  std::vector<std::uint32_t> lengths = renderer.list_lengths();
  if (lengths.empty()) return {};
  std::sort(lengths.begin(), lengths.end());
  constexpr double kHigh = 0.99;
  const auto high = static_cast<std::size_t>(kHigh * static_cast<double>(lengths.size() - 1));
  const double sum = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  return {sum / static_cast<double>(lengths.size()), lengths[high], lengths.back()};
}

/// Bytes of an identifier in each texel, beside its depth.
constexpr std::uint64_t kIdentifierBytes = 4;

void count_costs(const render::FrameStats& stats, const Planned& plan, const SweepEntry& entry,
                 report::Row& row) {
  row.costs.maps = plan.map_count();
  for (int i = 0; i < stats.map_count; ++i) {
    const render::MapStats& map = stats.map[static_cast<std::size_t>(i)];
    row.costs.draws += map.draws;
    row.costs.triangles += map.triangles;
  }
  row.costs.texels = stats.texels;
  row.costs.filtered_texels = stats.filtered_texels;
  // Of this technique alone: the renderer's own images may be those of a larger one before it.
  row.costs.map_bytes =
      static_cast<std::uint64_t>(static_cast<double>(stats.texels) * render::bytes_per_texel(entry.filter)) +
      plan.table_bytes();
  if (entry.identifiers) row.costs.map_bytes += kIdentifierBytes * stats.texels;
}

/// What the rules of one source saved, in their order.
void count_savings(const render::FrameStats& stats, PruneSource source, report::Row& row) {
  for (const PruneRuleInfo& rule : prune_rules()) {
    if (rule.source != source) continue;
    const PruneSaving& saved = stats.saved[static_cast<std::size_t>(rule.rule)];
    if (saved.texels == 0 && saved.triangles == 0 && saved.filtered == 0) continue;
    row.left_out.push_back({std::string(rule.what), std::string(rule.proof),
                            static_cast<std::int64_t>(saved.texels), std::string(rule.name),
                            static_cast<std::int64_t>(saved.triangles),
                            static_cast<std::int64_t>(saved.filtered)});
  }
}

/// `values` of the pixels that `seen_at` names; `none` where it names none.
std::vector<float> at_pixels(const std::vector<float>& values, const std::vector<int>& seen_at, float none) {
  std::vector<float> found(seen_at.size(), none);
  for (std::size_t i = 0; i < seen_at.size(); ++i)
    if (seen_at[i] >= 0) found[i] = values[static_cast<std::size_t>(seen_at[i])];
  return found;
}

/// What whole pixels hold of `mask`, and of its change since `mask_before`, the frame before through its own
/// camera; empty: not known.
report::PixelErrors errors_of_pixels(const FrameTruth::Pixels& pixels, const std::vector<float>& mask,
                                     const std::vector<float>& mask_before) {
  report::PixelErrors errors = report::pixel_errors(mask, pixels.light, pixels.several);
  if (mask_before.empty()) {
    errors.twinkle = errors.twinkle_tracked = kUnknown;
    return errors;
  }
  errors.twinkle = report::twinkling(mask_before, mask, pixels.light_before, pixels.light);
  errors.twinkle_tracked =
      report::twinkling(at_pixels(mask_before, pixels.seen_at, 0.0f), mask,
                        at_pixels(pixels.light_before, pixels.seen_at, -1.0f), pixels.light);
  return errors;
}

/// All errors that masks alone decide. `soft`: the ideal filter's, negative where it is not known.
void set_errors(const FrameTruth& truth, const FrameMasks& masks, const std::vector<float>& soft,
                report::Row& row) {
  row.errors = report::mask_errors(masks.mask, truth.seen.mask, soft);
  row.undecided_pixels = truth.undecided;
  row.flips = masks.moved.empty()
                  ? kUnknown
                  : report::excess_flips(masks.moved, masks.mask, truth.lit_before, truth.seen.mask);
  if (!truth.pixels.light.empty()) row.pixel = errors_of_pixels(truth.pixels, masks.mask, masks.before);
}

/// Samples of one technique over the rounds.
struct Samples {
  std::vector<double> plan_ns, depth_ms, prefilter_ms, shade_ms, total_ms;
};

/// One visit to a technique: drawn once to have its images made and the caches full of it, as they are in a
/// program that uses nothing else; then as often as counts. Nowhere to put samples: a visit that warms up.
void time_visit(Planned& plan, const Camera& camera, Samples* samples) {
  using Clock = std::chrono::steady_clock;
  constexpr std::size_t kPlans = 5;  // a plan takes microseconds: the median of a few is steadier
  constexpr int kDraws = 2;
  std::array<double, kPlans> plan_ns{};
  for (double& ns : plan_ns) {
    const Clock::time_point begin = Clock::now();
    plan.again();
    ns = std::chrono::duration<double, std::nano>(Clock::now() - begin).count();
  }
  const render::FrameOptions options = frame_options(false);
  plan.draw(camera, options);
  if (samples == nullptr) return;
  constexpr double kMillisecondsPerNanosecond = 1e-6;
  const double plan_time = report::median(plan_ns);
  samples->plan_ns.push_back(plan_time);
  for (int i = 0; i < kDraws; ++i) {
    const render::FrameStats stats = plan.draw(camera, options);
    samples->depth_ms.push_back(stats.ms(Pass::shadow_maps));
    samples->prefilter_ms.push_back(stats.ms(Pass::prefilter));
    samples->shade_ms.push_back(stats.ms(Pass::mask));
    samples->total_ms.push_back(plan_time * kMillisecondsPerNanosecond + stats.shadow_ms());
  }
  render::check_context();
}

}  // namespace

std::vector<FrameBefore> draw_before(Stage& stage, const FrameTruth& truth,
                                     std::span<const SweepEntry* const> entries) {
  stage.go_to(truth.frame, Stage::At::before);
  std::vector<FrameBefore> all;
  for (const SweepEntry* const entry : entries) {
    FrameBefore& before = all.emplace_back();
    before.plan = std::make_unique<Planned>(stage, *entry, truth.before);
    if (truth.pixels.light.empty()) continue;
    before.plan->draw(truth.before, frame_options(false));
    before.mask = channel(stage.renderer().mask(), 0);
  }
  return all;
}

FrameMasks measure_errors(Stage& stage, const FrameTruth& truth, const SweepEntry& entry, FrameBefore before,
                          report::Row& row, FramePictures* drawn) {
  FrameMasks masks;
  masks.before = std::move(before.mask);
  render::Renderer& renderer = stage.renderer();
  stage.go_to(truth.frame, Stage::At::before);
  before.plan->move_eye(truth.camera);
  before.plan->draw(truth.camera, frame_options(false));
  masks.moved = channel(renderer.mask(), 0);

  stage.go_to(truth.frame, Stage::At::frame);
  Planned plan(stage, entry, truth.camera);
  if (plan.status() == PlanStatus::invalid_input)
    throw std::runtime_error(row.scene + ", " + row.technique.name() + ": " +
                             invalid_input_text(plan.invalid_field()));
  const render::FrameStats stats = plan.draw(truth.camera, frame_options(true));
  const FloatImage mask_image = renderer.mask();
  const std::vector<float> maps = channel(mask_image, 1);
  masks.mask = channel(mask_image, 0);
  if (entry.irregular() && !stats.irregular)
    throw std::runtime_error(row.technique.name() + ": the driver's storage buffers hold no list of " +
                             std::to_string(row.width) + "x" + std::to_string(row.height) + " pixels");
  row.truth = entry.irregular_samples == 1                      ? "hard"
              : entry.irregular()                               ? "facet"
              : light_radius(entry.filter, stage.light()) > 0.0 ? "area"
                                                                : "filtered";
  const std::vector<float> soft = soft_truth(stage, truth, plan, entry, maps);
  set_errors(truth, masks, soft, row);
  row.aliasing = report::pixel_aliasing(plan.aliasing(mask_image));
  row.expected_wrong = plan.expected(truth.seen.picture()).share();
  count_costs(stats, plan, entry, row);
  if (entry.irregular()) {
    row.costs.lists = list_lengths(renderer);
    constexpr std::uint64_t kEntryBytes = 16;  // of a list; its texel has as many as one of a depth map
    row.costs.map_bytes +=
        kEntryBytes * masks.mask.size() * static_cast<std::uint64_t>(entry.irregular_samples);
  }
  row.plan_status = to_string(plan.status());
  for (const Omission& omission : plan.omitted()) {
    const OmissionText text = describe(omission);
    row.left_out.push_back({text.what.data(), text.why.data(), omission.saves_texels});
  }
  count_savings(stats, PruneSource::this_frame, row);
  if (drawn != nullptr) *drawn = {renderer.image(), plan.heat_map(mask_image), masks.mask};
  // Tight maps are others in every frame, and so are their pages.
  if (entry.plan.fit == Fit::tight) return masks;
  render::FrameOptions all_rules = frame_options(false);
  all_rules.prune = {};
  stage.go_to(truth.frame, Stage::At::before);
  before.plan->draw(truth.camera, all_rules);
  stage.go_to(truth.frame, Stage::At::frame);
  count_savings(plan.draw(truth.camera, all_rules), PruneSource::last_frame, row);
  return masks;
}

void measure_given(const FrameTruth& truth, const GivenMasks& given, report::Row& row, FrameMasks& masks) {
  const GivenMasks::Frame& frame = *masks_of(given, row);
  masks = read_masks(given, frame, row.width, row.height);
  row.truth = "none";
  row.plan_status = to_string(PlanStatus::ok);
  set_errors(truth, masks, std::vector<float>(masks.mask.size(), -1.0f), row);
  row.times.total_ms = {frame.ms, frame.ms_low, frame.ms_high};
}

std::vector<report::Times> measure_times(Stage& stage, const Camera& camera,
                                         const std::vector<const SweepEntry*>& entries,
                                         const SweepEntry& baseline, int rounds,
                                         const std::function<void()>& done) {
  std::vector<const SweepEntry*> all = entries;
  // Twice, as two techniques: their difference is the clock's noise.
  all.insert(all.end(), {&baseline, &baseline});
  std::vector<std::unique_ptr<Planned>> plans;
  for (const SweepEntry* const entry : all) plans.push_back(std::make_unique<Planned>(stage, *entry, camera));
  std::vector<Samples> samples(all.size());
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937 random(1);
  for (int round = -1; round < rounds; ++round) {
    for (std::size_t i = order.size() - 1; i > 0; --i) std::swap(order[i], order[random() % (i + 1)]);
    for (const std::size_t i : order) {
      time_visit(*plans[i], camera, round < 0 ? nullptr : &samples[i]);
      done();
    }
  }
  const double baseline_ms = report::median(samples[entries.size()].total_ms),
               again_ms = report::median(samples.back().total_ms);
  std::vector<report::Times> times(entries.size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Samples& s = samples[i];
    times[i] = {report::estimate(s.plan_ns),
                report::estimate(s.depth_ms),
                report::estimate(s.prefilter_ms),
                report::estimate(s.shade_ms),
                report::estimate(s.total_ms),
                baseline_ms,
                again_ms,
                rounds};
  }
  return times;
}

}  // namespace gnomon::tool
