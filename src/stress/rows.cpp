// Rows of the stress test as JSON lines and CSV.
#include "rows.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "gnomon/report/csv.hpp"

namespace gnomon::stress {
namespace {

using Json = nlohmann::ordered_json;

template <class Row>
Json to_json(const char* kind, const Row& row) {
  Json json{{"kind", kind}};
  for_each_field(row, [&](const char* name, const auto& value, double = 0.0) { json[name] = value; });
  return json;
}

template <typename Take>
void for_each_row(const Results& results, Take&& take) {
  for (const CaseRow& row : results.cases) take(to_json("case", row));
  for (const AxisRow& row : results.axes) take(to_json("axis", row));
  for (const FilterRow& row : results.filters) take(to_json("filter", row));
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
