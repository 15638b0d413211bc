// `gnomon judge`: what is wrong with the shadow maps that an engine hands in?
#include "judge/judge.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "command.hpp"
#include "judge/in_scene.hpp"
#include "judge/judge_page.hpp"
#include "output.hpp"

namespace gnomon::tool {
namespace {

using Json = nlohmann::ordered_json;

struct JudgeRequest {
  std::string capture;
  JudgedScene scene;  ///< no file: none
  double max_m = 0.0, max_findings = -1.0;
  double max_misclassified = 0.0;  ///< percent; 0: no limit
  std::string out;                 ///< folder; empty: no files
  bool json = false;
};

/// Null for what is not finite.
Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json error_json(const AliasingStats& error) {
  return {{"p50", number(error.p50)},   {"p95", number(error.p95)}, {"max", number(error.max)},
          {"mean", number(error.mean)}, {"points", error.samples},  {"outside", error.outside}};
}

Json finding_json(const judge::Finding& finding) {
  Json json{{"kind", to_string(finding.kind)},
            {"grade", judge::is_waste(finding.kind) ? "waste" : "error"},
            {"what", finding.what},
            {"change", finding.change},
            {"size", number(finding.size)},
            {"unit", finding.unit},
            {"light", finding.light},
            {"map", finding.map},
            {"frame", finding.frame},
            {"frames", finding.frames}};
  if (!finding.also.empty()) json["also"] = finding.also;
  if (finding.pixel) json["pixel"] = {finding.pixel->x, finding.pixel->y};
  return json;
}

Json drawn_json(const DrawnErrors& errors) {
  return {{"misclassified", errors.wrong},
          {"false_light", errors.false_light},
          {"false_shadow", errors.false_shadow},
          {"expected", errors.expected}};
}

Json light_json(const judge::LightFigures& light, const DrawnLightErrors* drawn) {
  Json maps = Json::array();
  for (const judge::LightFigures::OfMap& map : light.of_map) maps.push_back(error_json(map.error));
  Json json{{"light", light.light},
            {"maps", light.plan.map_count},
            {"texels", light.texels},
            {"m", error_json(light.error)},
            {"m_of_maps", maps}};
  for (const judge::LightFigures::Planned* planned : light.planned())
    json["gnomon"].push_back({{"fit", to_string(planned->fit)},
                              {"maps", planned->plan.map_count},
                              {"texels", planned->texels},
                              {"m", error_json(planned->error)}});
  if (drawn == nullptr) return json;
  json["drawn"] = {{"pixels", drawn->pixels}, {"capture", drawn_json(drawn->captured)}};
  if (drawn->planned) json["drawn"]["gnomon"] = drawn_json(*drawn->planned);
  return json;
}

Json judgement_json(const judge::Capture& capture, const SceneJudgement& result) {
  Json lights = Json::array(), findings = Json::array();
  for (const judge::LightFigures& light : result.judgement.lights)
    lights.push_back(light_json(light, result.drawn_of(light)));
  for (const judge::Finding& finding : result.judgement.findings) findings.push_back(finding_json(finding));
  return {{"capture", capture.name}, {"engine", capture.engine}, {"frames", capture.frames.size()},
          {"lights", lights},        {"findings", findings},     {"notes", result.judgement.notes}};
}

std::string error_text(const AliasingStats& error) {
  if (error.samples == 0) return "no visible points";
  std::string text = "p50 " + judge::digits(error.p50) + ", p95 " + judge::digits(error.p95) + ", max " +
                     judge::digits(error.max);
  if (error.outside > 0) text += "; " + judge::percent(judge::share_missed(error)) + " not in their map";
  return text;
}

void print_drawn(const DrawnLightErrors& errors) {
  const auto text = [](const DrawnErrors& e) {
    return judge::percent(e.wrong) +
           " misclassified (expected without drawing: " + judge::percent(e.expected) + ")";
  };
  print_line("  drawn, " + std::to_string(errors.pixels) + " pixels: " + text(errors.captured));
  if (errors.planned) print_line("  gnomon's plan, fit tight: " + text(*errors.planned));
}

/// " [also in maps 1, 2]"; empty where there are none.
std::string also_text(const judge::Finding& finding) {
  if (finding.also.empty()) return {};
  std::string text;
  for (const int map : finding.also) text += (text.empty() ? " " : ", ") + std::to_string(map);
  return (finding.also.size() > 1 ? " [also in maps" : " [also in map") + text + "]";
}

std::string maps_text(int maps, std::int64_t texels, const AliasingStats& error) {
  return std::to_string(maps) + (maps == 1 ? " map, " : " maps, ") + std::to_string(texels) +
         " texels; m: " + error_text(error);
}

/// What the plan is to the capture's maps.
std::string gain_text(const AliasingStats& captured, const AliasingStats& planned) {
  const double times = captured.p95 / planned.p95;
  if (!(std::isfinite(times) && times > 0.0)) return {};
  const std::string size = judge::digits(std::max(times, 1.0 / times));
  if (size == judge::digits(1.0)) return " (p95: the same)";
  return " (p95: " + size + (times >= 1.0 ? " times less)" : " times more)");
}

void print_finding(const judge::Finding& finding, std::size_t frames) {
  std::string place = also_text(finding);
  if (frames > 1)
    place += " [" + std::to_string(finding.frames) + " of " + std::to_string(frames) + " frames, worst in " +
             std::to_string(finding.frame) + "]";
  if (finding.pixel)
    place += " [pixel " + std::to_string(std::lround(finding.pixel->x)) + "," +
             std::to_string(std::lround(finding.pixel->y)) + "]";
  print_line(std::string(to_string(finding.kind)) + ": " + finding.what + place);
  print_line("  " + finding.change);
}

void print_text(const judge::Capture& capture, const SceneJudgement& result) {
  const judge::Judgement& judgement = result.judgement;
  std::string head = capture.name.empty() ? std::string("capture") : one_line(capture.name);
  if (!capture.engine.empty()) head += " (" + one_line(capture.engine) + ")";
  print_line(head + ": " + std::to_string(capture.frames.size()) +
             (capture.frames.size() == 1 ? " frame" : " frames"));
  for (const judge::LightFigures& light : judgement.lights) {
    print_line("light " + std::to_string(light.light) + ": " +
               maps_text(light.plan.map_count, light.texels, light.error));
    for (std::size_t i = 0; light.of_map.size() > 1 && i < light.of_map.size(); ++i)
      print_line("  map " + std::to_string(light.of_map[i].map) +
                 ": m: " + error_text(light.of_map[i].error));
    for (const judge::LightFigures::Planned* planned : light.planned())
      print_line("  gnomon, fit " + std::string(to_string(planned->fit)) + ": " +
                 maps_text(planned->plan.map_count, planned->texels, planned->error) +
                 gain_text(light.error, planned->error));
    if (const DrawnLightErrors* drawn = result.drawn_of(light)) print_drawn(*drawn);
  }
  for (const judge::Finding& finding : judgement.findings) print_finding(finding, capture.frames.size());
  if (judgement.findings.empty()) print_line("nothing found");
  for (const std::string& note : judgement.notes) print_line("note: " + note);
}

/// Whether a limit is passed, as engines' own checks ask for.
bool beyond_limits(const JudgeRequest& request, const SceneJudgement& result) {
  const auto errors = std::count_if(result.judgement.findings.begin(), result.judgement.findings.end(),
                                    [](const judge::Finding& f) { return !is_waste(f.kind); });
  if (request.max_findings >= 0.0 && static_cast<double>(errors) > request.max_findings) return true;
  // A light may reach nothing in view. Where no light has anything to compare, no limit holds.
  bool has_point = false, has_pixel = false;
  for (const judge::LightFigures& light : result.judgement.lights) {
    has_point |= light.error.samples > 0;
    // Also an error that is no number is beyond a limit.
    if (request.max_m > 0.0 && light.error.samples > 0 && !(light.error.p95 <= request.max_m)) return true;
    const DrawnLightErrors* drawn = result.drawn_of(light);
    if (drawn == nullptr) continue;
    has_pixel |= drawn->pixels > 0;
    if (request.max_misclassified > 0.0 && 100.0 * drawn->captured.wrong > request.max_misclassified)
      return true;
  }
  if (request.max_m > 0.0 && !has_point) return true;
  return request.max_misclassified > 0.0 && !has_pixel;
}

int run_judge(const JudgeRequest& request) {
  judge::Capture capture = judge::load_capture(request.capture);
  if (!request.out.empty()) make_folder("--out", request.out);
  SceneJudgement result;
  if (request.scene.file.empty()) {
    result.judgement = judge::judge(capture);
  } else {
    result = judge_in_scene(capture, request.scene);
  }
  const Json json = judgement_json(capture, result);
  if (request.json) {
    print_line(json.dump());
  } else {
    print_text(capture, result);
  }
  if (!request.out.empty()) {
    const std::filesystem::path folder(request.out);
    write_file(folder / "judge.json", json.dump(2) + "\n");
    write_file(folder / "judge.html", judge_page(capture, result));
    if (!request.json) print_line("page: " + (folder / "judge.html").string());
  }
  flush_output();
  return beyond_limits(request, result) ? 1 : 0;
}

}  // namespace

std::function<int()> declare_judge(Arguments& arguments) {
  const auto request = std::make_shared<JudgeRequest>();
  arguments.options = {
      {.name = "CAPTURE",
       .target = &request->capture,
       .help = "JSON of format gnomon-capture/1: cameras, lights and matrices of an engine",
       .required = true,
       .completion = Completion::files},
      {.name = "SCENE",
       .target = &request->scene.file,
       .help =
           "glTF file or builtin:NAME that the capture is of: adds misclassified pixels, boxes and points",
       .completion = Completion::files},
      {.name = "--max-misclassified",
       .target = &request->max_misclassified,
       .help = "exit with 1 where any light's maps misclassify more percent of the pixels, or no pixel was "
               "compared; 0: no limit",
       .range = {{0.0, 100.0}},
       .needs = "SCENE"},
      {.name = "--max-m",
       .target = &request->max_m,
       .help = "exit with 1 where the 95th percentile of m of any light is above this, or no point was "
               "compared; 0: no limit",
       .range = {{0.0, 1e9}}},
      {.name = "--max-findings",
       .target = &request->max_findings,
       .help = "exit with 1 where there are more findings than this, waste of texels aside; -1: no limit",
       .range = {{-1.0, 1e9}}},
      {.name = "--out",
       .target = &request->out,
       .help = "write the page (judge.html) and its figures (judge.json) into this folder",
       .completion = Completion::folders},
      {.name = "--json", .target = &request->json, .help = "print the result as one line of JSON"}};
  for (Option& option : judged_scene_options(request->scene)) arguments.options.push_back(std::move(option));
  arguments.footer =
      "docs/captures.md has the format, a writer for three.js, and what each finding means.\n\n"
      "Exit: 0 within the limits; 1 beyond a limit; 2 bad input, with one line that names the "
      "file and key.";
  return [request] { return run_judge(*request); };
}

}  // namespace gnomon::tool
