// A cost model in a file of JSON.
#include <nlohmann/json.hpp>
#include <utility>

#include "base/json_words.hpp"
#include "file.hpp"
#include "rows/cost_model_text.hpp"
#include "text.hpp"

namespace gnomon::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kCostSchema = "gnomon.cost.6";
constexpr std::uint64_t kMaxBytes = 1 << 20;  // larger than any cost model
constexpr std::pair<const char*, double DrawingCosts::*> kDrawing[] = {
    {"frame_ms", &DrawingCosts::per_frame},
    {"ms_per_map", &DrawingCosts::per_map},
    {"ms_per_megatexel", &DrawingCosts::per_megatexel},
    {"ms_per_kilodraw", &DrawingCosts::per_kilodraw},
    {"ms_per_megatriangle", &DrawingCosts::per_megatriangle},
    {"ms_per_megatexel_covered", &DrawingCosts::per_megatexel_covered},
    {"ms_per_megatexel_tested", &DrawingCosts::per_megatexel_tested}};

/// A cost: neither below zero nor so large that sums over techniques overflow.
void get_cost(const Json& json, const char* key, double& cost) {
  constexpr double kLargest = 1e30;
  const Json& value = json.at(key);
  if (value.is_number()) cost = value.get<double>();
  if (!value.is_number() || !(cost >= 0.0 && cost <= kLargest))
    throw ReportError(std::string(key) + ": wants a number from 0 to 1e30");
}

/// Words that programs print: one line of them, without control characters.
std::string words_from(const Json& json, const char* key) {
  std::string words = json.at(key).get<std::string>();
  if (words != one_line(words)) throw ReportError(std::string(key) + ": wants one line of printable text");
  return words;
}

StoredCostModel::Filter filter_from(const Json& json) {
  StoredCostModel::Filter filter{words_from(json, "name"), {}};
  get_cost(json, "prefilter_ms_per_map", filter.cost.prefilter_ms_per_map);
  get_cost(json, "prefilter_ms_per_megatexel", filter.cost.prefilter_ms_per_megatexel);
  get_cost(json, "lookup_ms_per_megapixel", filter.cost.lookup_ms_per_megapixel);
  get_cost(json, "bytes_per_texel", filter.cost.bytes_per_texel);
  get_cost(json, "error_ratio", filter.cost.error_ratio);
  get_cost(json, "error_power", filter.cost.error_power);
  get_cost(json, "kernel_texels", filter.cost.kernel_texels);
  get_cost(json, "extent_texels", filter.cost.extent.texels);
  get_cost(json, "extent_world", filter.cost.extent.world);
  return filter;
}

StoredCosts costs_from(const Json& json) {
  StoredCosts costs;
  for (const auto& [key, cost] : kDrawing) get_cost(json, key, costs.drawing.*cost);
  const Json& errors = json.at("mean_relative_error");
  get_cost(errors, "depth", costs.depth_error);
  get_cost(errors, "prefilter", costs.prefilter_error);
  get_cost(errors, "lookup", costs.lookup_error);
  for (const Json& filter : json.at("filters")) costs.filters.push_back(filter_from(filter));
  if (costs.filters.empty()) throw ReportError("filters: there is none");
  return costs;
}

StoredCostModel model_from(const Json& json) {
  const std::string schema = json.at("schema").get<std::string>();
  if (schema != kCostSchema) throw ReportError("schema '" + schema + "', wanted '" + kCostSchema + "'");
  StoredCostModel model{costs_from(json), words_from(json, "machine"), {}};
  if (json.contains("pages")) model.pages = costs_from(json.at("pages"));
  return model;
}

void put(const StoredCosts& costs, Json& json) {
  json["mean_relative_error"] = {
      {"depth", costs.depth_error}, {"prefilter", costs.prefilter_error}, {"lookup", costs.lookup_error}};
  for (const auto& [key, cost] : kDrawing) json[key] = costs.drawing.*cost;
  json["filters"] = Json::array();
  for (const auto& [name, cost] : costs.filters) {
    json["filters"].push_back({{"name", name},
                               {"prefilter_ms_per_map", cost.prefilter_ms_per_map},
                               {"prefilter_ms_per_megatexel", cost.prefilter_ms_per_megatexel},
                               {"lookup_ms_per_megapixel", cost.lookup_ms_per_megapixel},
                               {"bytes_per_texel", cost.bytes_per_texel},
                               {"error_ratio", cost.error_ratio},
                               {"error_power", cost.error_power},
                               {"kernel_texels", cost.kernel_texels},
                               {"extent_texels", cost.extent.texels},
                               {"extent_world", cost.extent.world}});
  }
}

}  // namespace

std::string to_text(const StoredCostModel& model) {
  Json json{{"schema", kCostSchema}, {"machine", model.machine}};
  put(model, json);
  if (!model.pages.filters.empty()) put(model.pages, json["pages"]);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

StoredCostModel cost_model_from_text(std::string_view text, const std::string& name) {
  try {
    check_nesting(text);
    return model_from(Json::parse(text));
  } catch (const Json::exception& error) {
    throw ReportError(one_line(name + ": " + json_words(error.what())));
  } catch (const ReportError& error) {
    throw ReportError(one_line(name + ": " + error.what()));
  }
}

void save_cost_model(const StoredCostModel& model, const std::filesystem::path& file) {
  write_text(file, to_text(model));
}

StoredCostModel load_cost_model(const std::filesystem::path& file) {
  return cost_model_from_text(read_text(file, kMaxBytes), file.string());
}

}  // namespace gnomon::report
