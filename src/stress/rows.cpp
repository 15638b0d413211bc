// Rows of the stress test as JSON lines and CSV.
#include "rows.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "gnomon/report/csv.hpp"

namespace gnomon::stress {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const CaseRow& row) {
  return {{"kind", "case"},
          {"row", row.row},
          {"name", std::string(row.name)},
          {"input", std::string(row.input)},
          {"required", std::string(row.required)},
          {"verdict", std::string(row.verdict)},
          {"found", row.found}};
}

Json to_json(const AxisRow& row) {
  const Axis* axis = find_axis(row.axis);
  const Judgement& j = row.worst;
  return {{"kind", "axis"},
          {"axis", std::string(row.axis)},
          {"label", axis != nullptr ? std::string(axis->label) : std::string()},
          {"log", axis != nullptr && axis->logarithmic},
          {"variant", std::string(row.variant)},
          {"value", row.value},
          {"status", row.status},
          {"finite", j.finite},
          {"maps", row.maps},
          {"used", row.used},
          {"left_out", row.left_out},
          {"error_texels", j.error_texels},
          {"error_ulp", j.error_ulp},
          {"drift_texels", j.drift_texels},
          {"float_absolute_texels", j.float_absolute_texels},
          {"float_relative_texels", j.float_relative_texels},
          {"condition", j.condition},
          {"condition_world", j.condition_world},
          {"jump", row.jump}};
}

Json to_json(const FilterRow& row) {
  return {{"kind", "filter"},     {"axis", row.axis},    {"label", row.label}, {"log", row.logarithmic},
          {"filter", row.filter}, {"value", row.value},  {"error", row.error}, {"bound", row.bound},
          {"beyond", row.beyond}, {"within", row.within}};
}

template <typename Take>
void for_each_row(const Results& results, Take&& take) {
  for (const CaseRow& row : results.cases) take(to_json(row));
  for (const AxisRow& row : results.axes) take(to_json(row));
  for (const FilterRow& row : results.filters) take(to_json(row));
}

std::string field(const Json& value) {
  if (value.is_string()) return report::csv_field(value.get<std::string>());
  // dump() has no other word for what is not finite.
  const std::string text = value.dump();
  return text == "null" ? std::string() : text;
}

}  // namespace

bool Results::all_hold() const noexcept {
  return std::none_of(cases.begin(), cases.end(), [](const CaseRow& r) { return r.verdict == "fails"; }) &&
         std::all_of(axes.begin(), axes.end(), [](const AxisRow& r) { return r.worst.finite; }) &&
         std::all_of(filters.begin(), filters.end(), [](const FilterRow& r) { return r.within; });
}

std::string json_lines(const Results& results) {
  std::string out;
  for_each_row(results, [&](const Json& row) { out += row.dump() + "\n"; });
  return out;
}

std::string csv(const Results& results) {
  std::vector<std::string> names;
  for_each_row(results, [&](const Json& row) {
    for (const auto& [name, value] : row.items()) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  });
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ",") + name;
  out += "\n";
  for_each_row(results, [&](const Json& row) {
    std::string line;
    for (const std::string& name : names) {
      if (&name != &names.front()) line += ",";
      if (row.contains(name)) line += field(row[name]);
    }
    out += line + "\n";
  });
  return out;
}

}  // namespace gnomon::stress
