// Rows to JSON and back.
#include "gnomon/report/row.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/json_words.hpp"
#include "text.hpp"

namespace gnomon::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kRowSchema = "gnomon.compare.1";

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json to_json(const Estimate& e) {
  return {{"median", e.median}, {"low", e.low}, {"high", e.high}};
}

Json to_json(const Technique& t) {
  Json json{{"warp", t.warp}, {"split", t.split},       {"cascades", t.cascades},
            {"fit", t.fit},   {"map_size", t.map_size}, {"filter", t.filter}};
  // As before there were layers and pages: results can be continued.
  if (!t.layer.empty()) json["layer"] = t.layer;
  if (!t.entry.empty()) json["entry"] = t.entry;
  if (t.pages.empty()) return json;
  json["pages"] = t.pages;
  json["page_texels"] = t.page_texels;
  json["page_target_m"] = t.page_target_m;
  return json;
}

Json pixel_json(const PixelErrors& p) {
  return {{"pixels", p.pixels},
          {"several", p.several},
          {"error", p.error},
          {"one_surface", p.one_surface},
          {"twinkle", number(p.twinkle)},
          {"twinkle_tracked", number(p.twinkle_tracked)}};
}

Json errors_json(const Row& row) {
  const MaskErrors& e = row.errors;
  Json json{{"pixels", e.pixels},        {"undecided_pixels", row.undecided_pixels},
            {"false_lit", e.false_lit},  {"false_shadow", e.false_shadow},
            {"truth", row.truth},        {"mean_error", e.mean_error},
            {"leaking", e.leaking},      {"deep_pixels", e.deep_pixels},
            {"darkening", e.darkening},  {"open_pixels", e.open_pixels},
            {"too_dark", e.too_dark},    {"too_light", e.too_light},
            {"flips", number(row.flips)}};
  if (row.pixel) json["pixel"] = pixel_json(*row.pixel);
  return json;
}

Json aliasing_json(const PixelAliasing& a) {
  return {{"p50", number(a.p50)},
          {"p95", number(a.p95)},
          {"max", number(a.max)},
          {"share_undersampled", a.share_undersampled},
          {"pixels", a.pixels}};
}

Json costs_json(const Costs& c) {
  Json json{{"maps", c.maps},     {"draws", c.draws},         {"triangles", c.triangles},
            {"texels", c.texels}, {"map_bytes", c.map_bytes}, {"filtered_texels", c.filtered_texels}};
  if (c.lists.most > 0)
    json["lists"] = {{"mean", c.lists.mean}, {"p99", c.lists.p99}, {"most", c.lists.most}};
  return json;
}

Json times_json(const Times& t) {
  return {{"plan_ns", to_json(t.plan_ns)},
          {"depth_ms", to_json(t.depth_ms)},
          {"prefilter_ms", to_json(t.prefilter_ms)},
          {"shade_ms", to_json(t.shade_ms)},
          {"total_ms", to_json(t.total_ms)},
          {"baseline_ms", t.baseline_ms},
          {"baseline_again_ms", t.baseline_again_ms},
          {"rounds", t.rounds}};
}

Json left_out_json(const std::vector<LeftOut>& list) {
  Json array = Json::array();
  for (const LeftOut& l : list)
    array.push_back({{"what", l.what},
                     {"why", l.why},
                     {"saves_texels", l.saves_texels},
                     {"rule", l.rule},
                     {"saves_triangles", l.saves_triangles},
                     {"saves_filtered", l.saves_filtered}});
  return array;
}

Json pictures_json(const Pictures& p) {
  return {{"image", p.image},
          {"truth", p.truth},
          {"mask", p.mask},
          {"difference", p.difference},
          {"heat", p.heat}};
}

Json machine_json(const Machine& m) {
  return {{"renderer", m.renderer}, {"context", m.context}, {"software", m.software}, {"cpu", m.cpu},
          {"cores", m.cores},       {"load", m.load},       {"version", m.version},   {"rays", m.rays}};
}

/// What was measured, without what came out.
Json settings_json(const Row& row) {
  Json json{{"scene", row.scene},
            {"frame", row.frame},
            {"frames", row.frames},
            {"width", row.width},
            {"height", row.height},
            {"light", row.light},
            {"light_elevation_deg", row.light_elevation_deg},
            {"light_azimuth_deg", row.light_azimuth_deg},
            {"technique", to_json(row.technique)}};
  // Rows keep the key that they had before cameras could be placed, scenes could be edited or move, and
  // pixels had rays.
  if (!row.camera.empty()) json["camera"] = row.camera;
  if (!row.edits.empty()) json["edits"] = row.edits;
  if (!row.animation.empty()) json["animation"] = row.animation;
  if (row.pixel_samples != kPixelSamples) json["pixel_samples"] = row.pixel_samples;
  return json;
}

/// All but times and machine.
Json lasting_json(const Row& row) {
  Json json{{"schema", kRowSchema}, {"index", row.index}};
  json.update(settings_json(row));
  json["scene_hash"] = row.scene_hash;
  if (!row.view.empty()) json["view"] = row.view;
  if (!row.animation.empty()) json["animation_time_s"] = row.animation_time_s;
  json["plan_status"] = row.plan_status;
  json["errors"] = errors_json(row);
  json["m"] = aliasing_json(row.aliasing);
  if (row.expected_wrong) json["expected_wrong"] = *row.expected_wrong;
  json["costs"] = costs_json(row.costs);
  json["left_out"] = left_out_json(row.left_out);
  json["pictures"] = pictures_json(row.pictures);
  return json;
}

/// A whole number that fits. The library's own conversion would take 1e300 for an int.
template <class Whole>
void get_whole(const Json& json, Whole& out) {
  const bool is_natural = json.is_number_unsigned();
  const auto natural = is_natural ? json.get<std::uint64_t>() : 0;
  const auto integer = json.is_number_integer() && !is_natural ? json.get<std::int64_t>() : 0;
  if (!json.is_number_integer() ||
      (is_natural ? !std::in_range<Whole>(natural) : !std::in_range<Whole>(integer)))
    throw ReportError("a whole number is wanted, not " +
                      json.dump(-1, ' ', false, Json::error_handler_t::replace));
  out = is_natural ? static_cast<Whole>(natural) : static_cast<Whole>(integer);
}

template <class Whole>
Whole whole_from(const Json& json) {
  Whole out{};
  get_whole(json, out);
  return out;
}

/// A number whose sums and products stay finite: nothing that was measured is larger.
double real_from(const Json& json) {
  constexpr double kLargest = 1e30;
  const double value = json.get<double>();
  if (!(std::abs(value) <= kLargest)) throw ReportError("a number is beyond 1e30");
  return value;
}

double number_from(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::infinity() : real_from(json);
}

/// Of a number that an entry of others may lack.
double number_or_none(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : real_from(json);
}

Estimate estimate_from(const Json& json) {
  return {real_from(json.at("median")), real_from(json.at("low")), real_from(json.at("high"))};
}

Technique technique_from(const Json& json) {
  Technique t;
  json.at("warp").get_to(t.warp);
  json.at("split").get_to(t.split);
  get_whole(json.at("cascades"), t.cascades);
  json.at("fit").get_to(t.fit);
  get_whole(json.at("map_size"), t.map_size);
  json.at("filter").get_to(t.filter);
  if (json.contains("layer")) json.at("layer").get_to(t.layer);
  if (json.contains("entry")) json.at("entry").get_to(t.entry);
  if (!json.contains("pages")) return t;
  json.at("pages").get_to(t.pages);
  get_whole(json.at("page_texels"), t.page_texels);
  t.page_target_m = real_from(json.at("page_target_m"));
  return t;
}

void errors_from(const Json& json, Row& row) {
  MaskErrors& e = row.errors;
  get_whole(json.at("pixels"), e.pixels);
  get_whole(json.at("undecided_pixels"), row.undecided_pixels);
  e.false_lit = real_from(json.at("false_lit"));
  e.false_shadow = real_from(json.at("false_shadow"));
  json.at("truth").get_to(row.truth);
  e.mean_error = real_from(json.at("mean_error"));
  e.leaking = real_from(json.at("leaking"));
  get_whole(json.at("deep_pixels"), e.deep_pixels);
  e.darkening = real_from(json.at("darkening"));
  get_whole(json.at("open_pixels"), e.open_pixels);
  // Rows of an earlier version have none.
  if (json.contains("too_dark")) e.too_dark = real_from(json.at("too_dark"));
  if (json.contains("too_light")) e.too_light = real_from(json.at("too_light"));
  row.flips = number_or_none(json.at("flips"));
  // Rows of an earlier version, and of sweeps without it, have none.
  if (!json.contains("pixel")) return;
  const Json& p = json.at("pixel");
  PixelErrors& pixel = row.pixel.emplace();
  get_whole(p.at("pixels"), pixel.pixels);
  get_whole(p.at("several"), pixel.several);
  pixel.error = real_from(p.at("error"));
  pixel.one_surface = real_from(p.at("one_surface"));
  pixel.twinkle = number_or_none(p.at("twinkle"));
  pixel.twinkle_tracked = number_or_none(p.at("twinkle_tracked"));
}

void results_from(const Json& json, Row& row) {
  errors_from(json.at("errors"), row);
  const Json& m = json.at("m");
  row.aliasing = {number_from(m.at("p50")), number_from(m.at("p95")), number_from(m.at("max")),
                  real_from(m.at("share_undersampled")), whole_from<std::uint64_t>(m.at("pixels"))};
  // Rows of pages and of an earlier version have none.
  if (json.contains("expected_wrong")) row.expected_wrong = real_from(json.at("expected_wrong"));
  const Json& c = json.at("costs");
  row.costs = {whole_from<int>(c.at("maps")), whole_from<std::uint64_t>(c.at("draws")),
               whole_from<std::uint64_t>(c.at("triangles")), whole_from<std::uint64_t>(c.at("texels")),
               whole_from<std::uint64_t>(c.at("map_bytes"))};
  // Rows of an earlier version have none.
  if (c.contains("filtered_texels"))
    row.costs.filtered_texels = whole_from<std::uint64_t>(c.at("filtered_texels"));
  // Rows of techniques without lists have none.
  if (c.contains("lists")) {
    const Json& l = c.at("lists");
    row.costs.lists = {real_from(l.at("mean")), whole_from<std::uint64_t>(l.at("p99")),
                       whole_from<std::uint64_t>(l.at("most"))};
  }
  // Rows of scenes at rest have none.
  if (json.contains("animation")) {
    json.at("animation").get_to(row.animation);
    row.animation_time_s = real_from(json.at("animation_time_s"));
  }
  for (const Json& l : json.at("left_out")) {
    LeftOut left{l.at("what").get<std::string>(), l.at("why").get<std::string>(),
                 whole_from<std::int64_t>(l.at("saves_texels"))};
    // Rows of an earlier version have none.
    if (l.contains("rule")) {
      l.at("rule").get_to(left.rule);
      left.saves_triangles = whole_from<std::int64_t>(l.at("saves_triangles"));
      if (l.contains("saves_filtered"))
        left.saves_filtered = whole_from<std::int64_t>(l.at("saves_filtered"));
    }
    row.left_out.push_back(std::move(left));
  }
  const Json& p = json.at("pictures");
  p.at("image").get_to(row.pictures.image);
  p.at("truth").get_to(row.pictures.truth);
  p.at("mask").get_to(row.pictures.mask);
  p.at("difference").get_to(row.pictures.difference);
  p.at("heat").get_to(row.pictures.heat);
}

void measurement_from(const Json& json, Row& row) {
  const Json& t = json.at("times");
  Times& times = row.times;
  times.plan_ns = estimate_from(t.at("plan_ns"));
  times.depth_ms = estimate_from(t.at("depth_ms"));
  times.prefilter_ms = estimate_from(t.at("prefilter_ms"));
  times.shade_ms = estimate_from(t.at("shade_ms"));
  times.total_ms = estimate_from(t.at("total_ms"));
  times.baseline_ms = real_from(t.at("baseline_ms"));
  // Rows of an earlier version have none.
  if (t.contains("baseline_again_ms")) times.baseline_again_ms = real_from(t.at("baseline_again_ms"));
  get_whole(t.at("rounds"), times.rounds);
  const Json& m = json.at("machine");
  Machine& machine = row.machine;
  m.at("renderer").get_to(machine.renderer);
  m.at("context").get_to(machine.context);
  m.at("software").get_to(machine.software);
  m.at("cpu").get_to(machine.cpu);
  get_whole(m.at("cores"), machine.cores);
  machine.load = real_from(m.at("load"));
  m.at("version").get_to(machine.version);
  m.at("rays").get_to(machine.rays);
}

}  // namespace

std::string Technique::kind() const {
  if (!entry.empty()) return "entry " + entry;
  return pages.empty() ? "warp " + warp : "pages " + pages;
}

std::string Technique::name() const {
  std::string maps = std::to_string(cascades) + " x " + std::to_string(map_size) +
                     (layer.empty() ? "" : " " + layer + " layer");
  if (!entry.empty()) return entry + (cascades > 0 ? " / " + maps : std::string()) + " / " + filter;
  if (!pages.empty()) {
    const std::string target = page_target_m > 0.0 ? " m " + short_number(page_target_m) : "";
    return kind() + " " + std::to_string(page_texels) + target + (fit == "stable" ? " stable" : "") +
           " / as " + maps + " / " + filter;
  }
  return warp + " / " + split + (fit == "stable" ? " stable" : "") + " / " + maps + " / " + filter;
}

std::string Row::key() const {
  return settings_json(*this).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string to_json_line(const Row& row) {
  Json json = lasting_json(row);
  json["times"] = times_json(row.times);
  json["machine"] = machine_json(row.machine);
  // Names of scenes and drivers may be in any encoding: what is not UTF-8 is replaced, not thrown at.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string without_times(const Row& row) {
  return lasting_json(row).dump(-1, ' ', false, Json::error_handler_t::replace);
}

Row row_from_json(const std::string& line, const std::string& where) {
  try {
    check_nesting(line);
    const Json json = Json::parse(line);
    const std::string schema = json.at("schema").get<std::string>();
    if (schema != kRowSchema) throw ReportError("schema '" + schema + "', wanted '" + kRowSchema + "'");
    Row row;
    get_whole(json.at("index"), row.index);
    json.at("scene").get_to(row.scene);
    get_whole(json.at("frame"), row.frame);
    get_whole(json.at("frames"), row.frames);
    get_whole(json.at("width"), row.width);
    get_whole(json.at("height"), row.height);
    json.at("light").get_to(row.light);
    row.light_elevation_deg = real_from(json.at("light_elevation_deg"));
    row.light_azimuth_deg = real_from(json.at("light_azimuth_deg"));
    // Rows of an earlier version have none.
    if (json.contains("scene_hash")) json.at("scene_hash").get_to(row.scene_hash);
    // Rows of views without a name have none.
    if (json.contains("view")) json.at("view").get_to(row.view);
    // Rows of the scene's own flight have none.
    if (json.contains("camera")) json.at("camera").get_to(row.camera);
    // Rows of scenes as their files have them have none.
    if (json.contains("edits")) json.at("edits").get_to(row.edits);
    // Rows of the default number have none.
    if (json.contains("pixel_samples")) get_whole(json.at("pixel_samples"), row.pixel_samples);
    row.technique = technique_from(json.at("technique"));
    json.at("plan_status").get_to(row.plan_status);
    results_from(json, row);
    measurement_from(json, row);
    return row;
  } catch (const Json::exception& error) {
    throw ReportError(one_line(where + ": " + json_words(error.what())));
  } catch (const ReportError& error) {
    throw ReportError(one_line(where + ": " + error.what()));
  }
}

}  // namespace gnomon::report
