// What a frame owes its caller: its mask against exact rays, and what it keeps against a new renderer.
#include "check_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <memory>
#include <sstream>

#include "check_mask.hpp"
#include "frame_stage.hpp"

namespace gnomon::stress {

const std::vector<Kind>& all_frame_kinds() {
  static const std::vector<Kind> kKinds{
      {"frame_refused", "legal input is planned and drawn"},
      {"mask_not_in_unit", "visibility is a number between 0 and 1"},
      {"mask_dark", "a look-up whose texels show nothing before the receiver's plane is lit"},
      {"mask_lit", "a look-up whose texels all show a caster is dark"},
      {"exact_mask_wrong", "exact shadows are those of rays"},
      {"unserved_in_shadow", "a surface that no map or page serves is lit, and no caster shadows it"},
      {"pane_light_wrong", "panes before exact shadows leave the light that rays find"},
      {"kept_depths_differ",
       "kept depths have the bits of new ones, but for casters that no surface needs now"},
      {"kept_mask_differs", "a mask from kept depths has the bits of one from new ones"},
      {"moved_renderer_differs", "a renderer that follows moves draws what one of the moved scene draws"},
      {"rules_change_mask", "exact rules change no bit of the mask"},
      {"passes_change_mask", "maps in one pass have the bits of maps one by one"},
  };
  return kKinds;
}

void FrameCounts::add(const FrameCounts& other) {
  cases += other.cases;
  frames += other.frames;
  moving += other.moving;
  pixels += other.pixels;
  lit += other.lit;
  dark += other.dark;
  exact += other.exact;
  unserved += other.unserved;
  panes += other.panes;
  kept += other.kept;
  anew += other.anew;
  maps += other.maps;
  pages += other.pages;
}

void FrameReport::add(std::string_view kind, double amount, const std::string& text) {
  add_worst(verdict_.findings, {kind, amount, words_ + text});
}

namespace {

std::size_t differing(const std::vector<float>& a, const std::vector<float>& b) {
  std::size_t count = a.size() == b.size() ? 0 : std::max(a.size(), b.size());
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) count += a[i] == b[i] ? 0 : 1;
  return count;
}

void expect_equal(const std::vector<float>& a, const std::vector<float>& b, std::string_view kind,
                  const std::string& what, FrameReport& report) {
  const std::size_t count = differing(a, b);
  if (count == 0) return;
  double most = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    most = std::max(most, std::abs(static_cast<double>(a[i]) - b[i]));
  std::ostringstream text;
  text << what << ": " << count << " of " << a.size() << " numbers differ, by up to " << most;
  report.add(kind, static_cast<double>(count), text.str());
}

/// Kept depths against new ones. Casters that shadow nothing in view are not drawn (swept_casters), but stay
/// in a map that was drawn when they did: it may be nearer to the light there, and nowhere farther.
void expect_kept(const std::vector<float>& kept, std::vector<float> anew, const FrameSetting& setting,
                 std::string_view kind, const std::string& what, FrameReport& report) {
  if (setting.options.prune.has(PruneRule::swept_casters)) {
    // A caster more may put another surface into the layers behind the first.
    if (setting.options.depth_layer != render::DepthLayer::front) return;
    for (std::size_t i = 0; i < std::min(kept.size(), anew.size()); ++i) anew[i] = std::min(anew[i], kept[i]);
  }
  expect_equal(kept, anew, kind, what, report);
}

render::FrameOptions without_kept(render::FrameOptions options) {
  for (const PruneRule rule : {PruneRule::held_maps, PruneRule::scrolled_maps, PruneRule::static_casters})
    options.prune = options.prune.without(rule);
  return options;
}

/// Whether a frame has the bits of one that keeps nothing: texels that are scrolled round elsewhere, and a
/// mean is of more than one frame.
bool keeps_bits(const FrameSetting& setting) {
  return !setting.options.prune.has(PruneRule::scrolled_maps) && setting.accumulated == 0;
}

/// Depths of both renderers' last frame.
void compare_depths(FrameStage& stage, const render::Renderer& other, std::string_view kind,
                    FrameReport& report) {
  const render::SourceKind source = stage.setting().source.kind;
  if (source == render::SourceKind::maps) {
    for (int i = 0; i < stage.maps().map_count; ++i)
      expect_kept(stage.keeping().depth_map(i).values, other.depth_map(i).values, stage.setting(), kind,
                  "map " + std::to_string(i), report);
  }
  if (source == render::SourceKind::pages) {
    for (std::size_t i = 0; i < stage.pages().pages.size(); ++i)
      expect_kept(stage.keeping().page_depths(i).values, other.page_depths(i).values, stage.setting(), kind,
                  "page " + std::to_string(i), report);
  }
}

/// The same frame by a renderer that keeps nothing.
void check_kept(FrameStage& stage, FrameReport& report) {
  if (!keeps_bits(stage.setting())) return;
  const std::vector<float> mask = stage.keeping().mask().values;
  stage.draw(stage.redrawing(), without_kept(stage.setting().options));
  ++report.counts().kept;
  expect_equal(mask, stage.redrawing().mask().values, "kept_mask_differs", "mask", report);
  compare_depths(stage, stage.redrawing(), "kept_depths_differ", report);
}

/// By a renderer made of the scene as it stands. Pages lie in other slots there, so that only their texels
/// are equal.
void check_anew(FrameStage& stage, FrameReport& report) {
  if (!keeps_bits(stage.setting()) || !stage.same_scale()) return;
  const std::unique_ptr<render::Renderer> anew = stage.anew();
  stage.draw(*anew, stage.setting().options);
  ++report.counts().anew;
  if (!stage.by_pages())
    expect_equal(stage.keeping().mask().values, anew->mask().values, "moved_renderer_differs", "mask",
                 report);
  // A page that is drawn by itself is drawn in its slot, and rounds as it lies there.
  const render::FrameOptions& options = stage.setting().options;
  const bool in_slots = stage.by_pages() && (options.map_passes == render::MapPasses::each ||
                                             render::info_of(options.depth_layer).peels);
  if (!in_slots) compare_depths(stage, *anew, "moved_renderer_differs", report);
}

/// At the first frame: without any rule, and with the other way of drawing maps.
void check_ways(FrameStage& stage, FrameReport& report) {
  const FrameSetting& setting = stage.setting();
  if (setting.accumulated > 0 || setting.source.kind == render::SourceKind::lights) return;
  const std::vector<float> mask = stage.keeping().mask().values;
  bool exact = true;
  for (const PruneRuleInfo& rule : prune_rules())
    exact = exact && (rule.certainty == PruneCertainty::exact || !setting.options.prune.has(rule.rule));
  render::FrameOptions options = setting.options;
  options.prune = kPruneNothing;
  if (exact) {
    stage.draw(stage.redrawing(), options);
    expect_equal(mask, stage.redrawing().mask().values, "rules_change_mask", "mask", report);
  }
  if (setting.source.kind != render::SourceKind::maps) return;
  options.prune = setting.options.prune;
  options.map_passes = setting.options.map_passes == render::MapPasses::layered ? render::MapPasses::each
                                                                                : render::MapPasses::layered;
  stage.draw(stage.redrawing(), without_kept(options));
  expect_equal(mask, stage.redrawing().mask().values, "passes_change_mask", "mask", report);
}

void draw_kept(FrameStage& stage) {
  render::FrameOptions options = stage.setting().options;
  const int accumulated = stage.setting().accumulated;
  options.accumulation.on = accumulated > 0;
  options.accumulation.restart = true;
  for (int i = 0; i < std::max(accumulated, 1); ++i) {
    options.frame_index = static_cast<std::uint32_t>(i);
    stage.draw(stage.keeping(), options);
    options.accumulation.restart = false;
  }
}

}  // namespace

FrameVerdict check_frame(const nlohmann::ordered_json& frame) {
  FrameVerdict verdict;
  FrameReport report(verdict);
  ++verdict.counts.cases;
  try {
    FrameStage stage(frame);
    for (int step = 0; step < stage.setting().steps; ++step) {
      report.begin_with(step == 0 ? "" : "step " + std::to_string(step) + ": ");
      stage.advance();
      if (!stage.plan()) {
        // Shrinking must not end at a camera that is none.
        if (stage.refused().starts_with("camera") || stage.refused().starts_with("light."))
          throw CaseError(invalid_input_text(stage.refused()));
        report.add("frame_refused", 1.0, "the plan refuses " + std::string(stage.refused()));
        return verdict;
      }
      draw_kept(stage);
      ++verdict.counts.frames;
      verdict.counts.moving += step > 0 ? 1 : 0;
      verdict.counts.maps += stage.by_pages() ? 0 : stage.maps().map_count;
      verdict.counts.pages += stage.by_pages() ? static_cast<long long>(stage.pages().pages.size()) : 0;
      check_mask(stage, report);
      if (step == 0) check_ways(stage, report);
      check_kept(stage, report);
      if (step > 0 && step + 1 == stage.setting().steps) check_anew(stage, report);
    }
  } catch (const render::RenderError& error) {
    report.add("frame_refused", 1.0, error.what());
  }
  return verdict;
}

}  // namespace gnomon::stress
