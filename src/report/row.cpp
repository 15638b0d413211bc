// Rows to JSON and back.
#include "gnomon/report/row.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace gnomon::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "gnomon.compare.1";

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json to_json(const Estimate& e) {
  return {{"median", e.median}, {"low", e.low}, {"high", e.high}};
}

Json to_json(const Technique& t) {
  return {{"warp", t.warp}, {"split", t.split},       {"cascades", t.cascades},
          {"fit", t.fit},   {"map_size", t.map_size}, {"filter", t.filter}};
}

Json errors_json(const Row& row) {
  const MaskErrors& e = row.errors;
  return {{"pixels", e.pixels},       {"undecided_pixels", row.undecided_pixels},
          {"false_lit", e.false_lit}, {"false_shadow", e.false_shadow},
          {"truth", row.truth},       {"mean_error", e.mean_error},
          {"leaking", e.leaking},     {"deep_pixels", e.deep_pixels},
          {"darkening", e.darkening}, {"open_pixels", e.open_pixels},
          {"flips", row.flips}};
}

Json aliasing_json(const PixelAliasing& a) {
  return {{"p50", number(a.p50)},
          {"p95", number(a.p95)},
          {"max", number(a.max)},
          {"share_undersampled", a.share_undersampled},
          {"pixels", a.pixels}};
}

Json costs_json(const Costs& c) {
  return {{"maps", c.maps},
          {"draws", c.draws},
          {"triangles", c.triangles},
          {"texels", c.texels},
          {"map_bytes", c.map_bytes}};
}

Json times_json(const Times& t) {
  return {{"plan_ns", to_json(t.plan_ns)},
          {"depth_ms", to_json(t.depth_ms)},
          {"prefilter_ms", to_json(t.prefilter_ms)},
          {"shade_ms", to_json(t.shade_ms)},
          {"total_ms", to_json(t.total_ms)},
          {"baseline_ms", t.baseline_ms},
          {"rounds", t.rounds}};
}

Json left_out_json(const std::vector<LeftOut>& list) {
  Json array = Json::array();
  for (const LeftOut& l : list)
    array.push_back({{"what", l.what}, {"why", l.why}, {"saves_texels", l.saves_texels}});
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
  return {{"scene", row.scene},
          {"frame", row.frame},
          {"frames", row.frames},
          {"width", row.width},
          {"height", row.height},
          {"light", row.light},
          {"light_elevation_deg", row.light_elevation_deg},
          {"light_azimuth_deg", row.light_azimuth_deg},
          {"technique", to_json(row.technique)}};
}

/// All but times and machine.
Json lasting_json(const Row& row) {
  Json json{{"schema", kSchema}, {"index", row.index}};
  json.update(settings_json(row));
  json["plan_status"] = row.plan_status;
  json["errors"] = errors_json(row);
  json["m"] = aliasing_json(row.aliasing);
  json["costs"] = costs_json(row.costs);
  json["left_out"] = left_out_json(row.left_out);
  json["pictures"] = pictures_json(row.pictures);
  return json;
}

double number_from(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>();
}

Estimate estimate_from(const Json& json) {
  return {json.at("median").get<double>(), json.at("low").get<double>(), json.at("high").get<double>()};
}

Technique technique_from(const Json& json) {
  Technique t;
  json.at("warp").get_to(t.warp);
  json.at("split").get_to(t.split);
  json.at("cascades").get_to(t.cascades);
  json.at("fit").get_to(t.fit);
  json.at("map_size").get_to(t.map_size);
  json.at("filter").get_to(t.filter);
  return t;
}

void errors_from(const Json& json, Row& row) {
  MaskErrors& e = row.errors;
  json.at("pixels").get_to(e.pixels);
  json.at("undecided_pixels").get_to(row.undecided_pixels);
  json.at("false_lit").get_to(e.false_lit);
  json.at("false_shadow").get_to(e.false_shadow);
  json.at("truth").get_to(row.truth);
  json.at("mean_error").get_to(e.mean_error);
  json.at("leaking").get_to(e.leaking);
  json.at("deep_pixels").get_to(e.deep_pixels);
  json.at("darkening").get_to(e.darkening);
  json.at("open_pixels").get_to(e.open_pixels);
  json.at("flips").get_to(row.flips);
}

void results_from(const Json& json, Row& row) {
  errors_from(json.at("errors"), row);
  const Json& m = json.at("m");
  row.aliasing = {number_from(m.at("p50")), number_from(m.at("p95")), number_from(m.at("max")),
                  m.at("share_undersampled").get<double>(), m.at("pixels").get<std::uint64_t>()};
  const Json& c = json.at("costs");
  row.costs = {c.at("maps").get<int>(), c.at("draws").get<std::uint64_t>(),
               c.at("triangles").get<std::uint64_t>(), c.at("texels").get<std::uint64_t>(),
               c.at("map_bytes").get<std::uint64_t>()};
  for (const Json& l : json.at("left_out"))
    row.left_out.push_back({l.at("what").get<std::string>(), l.at("why").get<std::string>(),
                            l.at("saves_texels").get<std::int64_t>()});
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
  t.at("baseline_ms").get_to(times.baseline_ms);
  t.at("rounds").get_to(times.rounds);
  const Json& m = json.at("machine");
  Machine& machine = row.machine;
  m.at("renderer").get_to(machine.renderer);
  m.at("context").get_to(machine.context);
  m.at("software").get_to(machine.software);
  m.at("cpu").get_to(machine.cpu);
  m.at("cores").get_to(machine.cores);
  m.at("load").get_to(machine.load);
  m.at("version").get_to(machine.version);
  m.at("rays").get_to(machine.rays);
}

}  // namespace

std::string Technique::name() const {
  std::string maps = std::to_string(cascades) + " x " + std::to_string(map_size);
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
    const Json json = Json::parse(line);
    const std::string schema = json.at("schema").get<std::string>();
    if (schema != kSchema) throw ReportError(where + ": schema '" + schema + "', wanted '" + kSchema + "'");
    Row row;
    json.at("index").get_to(row.index);
    json.at("scene").get_to(row.scene);
    json.at("frame").get_to(row.frame);
    json.at("frames").get_to(row.frames);
    json.at("width").get_to(row.width);
    json.at("height").get_to(row.height);
    json.at("light").get_to(row.light);
    json.at("light_elevation_deg").get_to(row.light_elevation_deg);
    json.at("light_azimuth_deg").get_to(row.light_azimuth_deg);
    row.technique = technique_from(json.at("technique"));
    json.at("plan_status").get_to(row.plan_status);
    results_from(json, row);
    measurement_from(json, row);
    return row;
  } catch (const Json::exception& error) {
    throw ReportError(where + ": " + error.what());
  }
}

}  // namespace gnomon::report
