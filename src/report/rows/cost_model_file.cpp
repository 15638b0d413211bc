// A cost model in a file of JSON.
#include <nlohmann/json.hpp>
#include <utility>

#include "file.hpp"
#include "gnomon/report/cost_model.hpp"
#include "gnomon/report/row.hpp"
#include "json_words.hpp"
#include "text.hpp"

namespace gnomon::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "gnomon.cost.2";
constexpr std::size_t kLargestFile = 1 << 20;
constexpr std::pair<const char*, double DrawingCosts::*> kDrawing[] = {
    {"frame_ms", &DrawingCosts::per_frame},
    {"ms_per_map", &DrawingCosts::per_map},
    {"ms_per_megatexel", &DrawingCosts::per_megatexel},
    {"ms_per_kilodraw", &DrawingCosts::per_kilodraw},
    {"ms_per_megatriangle", &DrawingCosts::per_megatriangle},
    {"ms_per_megatexel_tested", &DrawingCosts::per_megatexel_tested}};

}  // namespace

void save_cost_model(const StoredCostModel& model, const std::filesystem::path& file) {
  Json json{
      {"schema", kSchema},
      {"machine", model.machine},
      {"mean_relative_error",
       {{"depth", model.depth_error}, {"prefilter", model.prefilter_error}, {"lookup", model.lookup_error}}}};
  for (const auto& [key, cost] : kDrawing) json[key] = model.drawing.*cost;
  json["filters"] = Json::array();
  for (const auto& [name, cost] : model.filters) {
    json["filters"].push_back({{"name", name},
                               {"prefilter_ms_per_map", cost.prefilter_ms_per_map},
                               {"prefilter_ms_per_megatexel", cost.prefilter_ms_per_megatexel},
                               {"lookup_ms_per_megapixel", cost.lookup_ms_per_megapixel},
                               {"bytes_per_texel", cost.bytes_per_texel},
                               {"error_ratio", cost.error_ratio},
                               {"error_power", cost.error_power}});
  }
  write_text(file, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

StoredCostModel load_cost_model(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored) &&
      std::filesystem::file_size(file, ignored) > kLargestFile)
    throw ReportError(file.string() + ": larger than any cost model");
  const std::string text = read_text(file);
  try {
    check_nesting(text);
  } catch (const ReportError& error) {
    throw ReportError(file.string() + ": " + error.what());
  }
  try {
    const Json json = Json::parse(text);
    if (json.at("schema").get<std::string>() != kSchema)
      throw ReportError(file.string() + ": schema '" + json.at("schema").get<std::string>() + "', wanted '" +
                        kSchema + "'");
    StoredCostModel model;
    json.at("machine").get_to(model.machine);
    for (const auto& [key, cost] : kDrawing) json.at(key).get_to(model.drawing.*cost);
    const Json& errors = json.at("mean_relative_error");
    errors.at("depth").get_to(model.depth_error);
    errors.at("prefilter").get_to(model.prefilter_error);
    errors.at("lookup").get_to(model.lookup_error);
    for (const Json& entry : json.at("filters")) {
      StoredCostModel::Filter filter{entry.at("name").get<std::string>(), {}};
      entry.at("prefilter_ms_per_map").get_to(filter.cost.prefilter_ms_per_map);
      entry.at("prefilter_ms_per_megatexel").get_to(filter.cost.prefilter_ms_per_megatexel);
      entry.at("lookup_ms_per_megapixel").get_to(filter.cost.lookup_ms_per_megapixel);
      entry.at("bytes_per_texel").get_to(filter.cost.bytes_per_texel);
      entry.at("error_ratio").get_to(filter.cost.error_ratio);
      entry.at("error_power").get_to(filter.cost.error_power);
      model.filters.push_back(std::move(filter));
    }
    return model;
  } catch (const Json::exception& error) {
    throw ReportError(one_line(file.string() + ": " + json_words(error.what())));
  }
}

}  // namespace gnomon::report
