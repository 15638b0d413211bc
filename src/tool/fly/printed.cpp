// What `gnomon fly` prints: the scene before its flight, and what the frames came to, as text or as JSON.
#include "printed.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "command.hpp"
#include "edit_words.hpp"
#include "output.hpp"
#include "page_frame.hpp"
#include "plan_option.hpp"
#include "scene_words.hpp"

namespace gnomon::tool::fly {
namespace {

/// Mean and worst over the frames.
struct Summary {
  double milliseconds = 0.0, worst_p95 = 0.0, undersampled = 0.0;
  std::int64_t slowest_plan_ns = 0;
};

Summary summary_of(const std::vector<FrameRow>& rows) {
  Summary summary;
  for (const FrameRow& row : rows) {
    summary.worst_p95 = std::max(summary.worst_p95, row.aliasing.p95);
    summary.undersampled += row.aliasing.share_undersampled / static_cast<double>(rows.size());
    summary.slowest_plan_ns = std::max(summary.slowest_plan_ns, row.plan_ns);
    for (const double ms : row.stats.milliseconds)
      summary.milliseconds += ms / static_cast<double>(rows.size());
  }
  return summary;
}

}  // namespace

void print_scene(const Options& options, const Flight& flight, const render::ContextInfo& context) {
  constexpr double kMebi = 1024.0 * 1024.0;
  fmt::print("context:  {}\n", context.description());
  fmt::print("scene:    {}, {} instances, {} triangles, {:.4g} MiB{}{}\n", scene_title(options.scene),
             flight.scene.instances.size(), flight.scene.triangle_count(),
             static_cast<double>(flight.scene.bytes()) / kMebi,
             has_ground(flight.scene) ? "" : "; no ground under it: --ground adds one",
             has_sky_that_casts(flight.scene) ? "; a sky round it casts: --open-sky lets light in" : "");
  if (const std::string text = proxies_text(flight.scene); !text.empty()) fmt::print("proxies:  {}\n", text);
}

void print_summary(const Options& options, const std::optional<AllLights>& lights,
                   const std::vector<FrameRow>& rows) {
  const Summary s = summary_of(rows);
  fmt::print("{} frames: {:.1f} ms a frame, slowest plan {:.1f} us", rows.size(), s.milliseconds,
             static_cast<double>(s.slowest_plan_ns) * 1e-3);
  if (lights) {
    fmt::print("\nlights:   {}\n", to_string(lights->drawn(rows)));
  } else {
    fmt::print(", worst m p95 {:.3g}, {:.1f} % of pixels undersampled\n", s.worst_p95,
               s.undersampled * 100.0);
  }
  if (options.pages.on()) {
    const PageSummary pages = page_summary(rows);
    const bool moves = pages.share_cached == 0.0 && rows.size() > 1 && options.plan.fit != Fit::stable;
    fmt::print("pages:    {:.0f} a frame, {:.1f} % kept from earlier frames{}\n", pages.pages_per_frame,
               100.0 * pages.share_cached, moves ? "; --fit stable keeps them while the camera moves" : "");
  }
  fmt::print(
      "pictures: {}\n",
      (options.out / (options.shadow_only ? "frame_0000_shadow.png" : "frame_0000_image.png")).string());
  if (!options.shadow_only) fmt::print("sheet:    {}\n", (options.out / "contact_sheet.png").string());
  fmt::print("numbers:  {}\n", (options.out / "frames.csv").string());
}

void print_json(const Options& options, const Flight& flight, const std::optional<AllLights>& lights,
                const render::ContextInfo& context, const std::vector<FrameRow>& rows) {
  using Json = nlohmann::ordered_json;
  const Summary s = summary_of(rows);
  const CastTriangles cast = cast_triangles(flight.scene);
  Json json{{"scene", scene_title(options.scene)},
            {"instances", flight.scene.instances.size()},
            {"triangles", flight.scene.triangle_count()},
            {"cast_triangles", {{"by_proxies", cast.by_proxies}, {"without", cast.without}}},
            {"context", context.description()},
            {"software", context.software},
            {"filter", render::to_string(options.filter)},
            {"options", plan_options_json(options.plan)},
            {"summary",
             {{"frames", rows.size()},
              {"ms", s.milliseconds},
              {"slowest_plan_ns", s.slowest_plan_ns},
              {"worst_m_p95", s.worst_p95},
              {"share_undersampled", s.undersampled}}},
            {"sheet", options.shadow_only ? Json() : Json((options.out / "contact_sheet.png").string())},
            {"numbers", (options.out / "frames.csv").string()},
            {"frames", frames_json(rows)}};
  if (lights) {
    const LightsDrawn drawn = lights->drawn(rows);
    json["lights"] = {{"of_file", drawn.of_file},
                      {"drawn", drawn.drawn},
                      {"out_of_view", drawn.out_of_view},
                      {"dark", drawn.dark},
                      {"beyond_limit", drawn.beyond_limit}};
  }
  if (options.pages.on()) {
    const PageSummary pages = page_summary(rows);
    json["pages"] = {{"policy", page_policy_name(options.pages)},
                     {"page_texels", options.pages.page_texels},
                     {"capacity", options.pages.capacity},
                     {"target_m", options.pages.target_m}};
    json["summary"]["pages_per_frame"] = pages.pages_per_frame;
    json["summary"]["share_kept"] = pages.share_cached;
  }
  print_line(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace gnomon::tool::fly
