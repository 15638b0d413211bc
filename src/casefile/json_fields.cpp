// Typed reading of a JSON object's keys. Every complaint carries the key's path.
#include "json_fields.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/nearest_name.hpp"
#include "gnomon/casefile/casefile.hpp"

namespace gnomon {
namespace {

using nlohmann::json;

std::string joined(std::string_view path, std::string_view key) {
  return path.empty() ? std::string(key) : std::string(path) + "." + std::string(key);
}

[[noreturn]] void wrong_type(const std::string& path, std::string_view wanted, const json& found) {
  throw CaseError(path + ": needs " + std::string(wanted) + ", is " + found.type_name());
}

glm::dvec3 vector_from(const json& value, const std::string& path) {
  if (!value.is_array() || value.size() != 3) throw CaseError(path + ": needs three numbers");
  glm::dvec3 vector{};
  for (int i = 0; i < 3; ++i)
    vector[i] = finite_number(value[static_cast<std::size_t>(i)], path + "[" + std::to_string(i) + "]");
  return vector;
}

}  // namespace

double finite_number(const json& value, const std::string& path) {
  if (!value.is_number()) wrong_type(path, "a number", value);
  const double number = value.get<double>();
  if (!std::isfinite(number)) throw CaseError(path + ": is not finite");
  return number;
}

Box box_from(const json& value, const std::string& path) {
  const Fields fields(value, path, {"min", "max"});
  return {fields.vector("min"), fields.vector("max")};
}

Fields::Fields(const json& value, std::string path, std::span<const std::string_view> known)
    : value_(value), path_(std::move(path)) {
  if (!value.is_object()) wrong_type(path_.empty() ? "case" : path_, "an object", value);
  for (const auto& [key, unused] : value.items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    std::string list;
    for (const std::string_view name : known) list += (list.empty() ? "" : ", ") + std::string(name);
    throw CaseError(joined(path_, one_line(key, 60)) + ": unknown key (known here: " + list + ")" +
                    meant(key, known));
  }
}

const json& Fields::at(std::string_view key) const {
  const auto found = value_.find(key);
  if (found == value_.end()) throw CaseError(path_of(key) + ": is missing");
  return *found;
}

std::string Fields::path_of(std::string_view key) const {
  return joined(path_, key);
}

void Fields::refuse(std::string_view key, const std::string& why) const {
  throw CaseError(path_of(key) + ": " + why);
}

double Fields::number(std::string_view key) const {
  return finite_number(at(key), path_of(key));
}

double Fields::positive(std::string_view key) const {
  const double value = number(key);
  if (!(value > 0.0)) refuse(key, "must be above 0");
  return value;
}

int Fields::integer(std::string_view key) const {
  const double value = number(key);
  if (value != std::floor(value)) refuse(key, "needs a whole number");
  if (std::abs(value) > std::numeric_limits<int>::max()) refuse(key, "is out of range");
  return static_cast<int>(value);
}

std::int64_t Fields::long_integer(std::string_view key) const {
  const double value = number(key);
  if (value != std::floor(value)) refuse(key, "needs a whole number");
  // Whole numbers beyond this are not exact in JSON.
  if (std::abs(value) > 9007199254740992.0) refuse(key, "is out of range");
  return static_cast<std::int64_t>(value);
}

std::vector<double> Fields::numbers(std::string_view key) const {
  const json& value = at(key);
  if (!value.is_array()) wrong_type(path_of(key), "a list of numbers", value);
  std::vector<double> numbers;
  numbers.reserve(value.size());
  for (std::size_t i = 0; i < value.size(); ++i)
    numbers.push_back(finite_number(value[i], path_of(key) + "[" + std::to_string(i) + "]"));
  return numbers;
}

bool Fields::boolean(std::string_view key) const {
  const json& value = at(key);
  if (!value.is_boolean()) wrong_type(path_of(key), "true or false", value);
  return value.get<bool>();
}

std::string Fields::text(std::string_view key) const {
  const json& value = at(key);
  if (!value.is_string()) wrong_type(path_of(key), "a string", value);
  return value.get<std::string>();
}

glm::dvec3 Fields::vector(std::string_view key) const {
  return vector_from(at(key), path_of(key));
}

std::vector<Box> Fields::boxes(std::string_view key) const {
  const json& value = at(key);
  const std::string path = path_of(key);
  if (!value.is_array()) return {box_from(value, path)};
  std::vector<Box> boxes;
  boxes.reserve(value.size());
  for (std::size_t i = 0; i < value.size(); ++i)
    boxes.push_back(box_from(value[i], path + "[" + std::to_string(i) + "]"));
  return boxes;
}

}  // namespace gnomon
