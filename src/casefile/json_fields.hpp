// Typed reading of a JSON object's keys. Every complaint carries the key's path.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gnomon/bounds.hpp"

namespace gnomon {

/// One object of the case and where it stands in it. All readers throw CaseError.
class Fields {
 public:
  /// Throws where `value` is no object or has a key outside `known`.
  Fields(const nlohmann::json& value, std::string path, std::span<const std::string_view> known);
  Fields(const nlohmann::json& value, std::string path, std::initializer_list<std::string_view> known)
      : Fields(value, std::move(path), std::span(known.begin(), known.size())) {}

  [[nodiscard]] bool has(std::string_view key) const { return value_.contains(key); }
  [[nodiscard]] const nlohmann::json& at(std::string_view key) const;
  [[nodiscard]] std::string path_of(std::string_view key) const;

  [[nodiscard]] double number(std::string_view key) const;
  [[nodiscard]] double positive(std::string_view key) const;
  [[nodiscard]] int integer(std::string_view key) const;
  [[nodiscard]] std::int64_t long_integer(std::string_view key) const;
  [[nodiscard]] bool boolean(std::string_view key) const;
  [[nodiscard]] std::string text(std::string_view key) const;
  [[nodiscard]] std::vector<double> numbers(std::string_view key) const;
  [[nodiscard]] glm::dvec3 vector(std::string_view key) const;
  /// One box or a list of boxes.
  [[nodiscard]] std::vector<Box> boxes(std::string_view key) const;

  // These leave `out` as it is where the key is absent.
  void read(std::string_view key, double& out) const {
    if (has(key)) out = number(key);
  }
  void read(std::string_view key, int& out) const {
    if (has(key)) out = integer(key);
  }
  void read(std::string_view key, std::int64_t& out) const {
    if (has(key)) out = long_integer(key);
  }
  void read(std::string_view key, bool& out) const {
    if (has(key)) out = boolean(key);
  }

  [[noreturn]] void refuse(std::string_view key, const std::string& why) const;

 private:
  const nlohmann::json& value_;
  std::string path_;
};

/// Throws CaseError with `path` before what is wrong.
[[nodiscard]] double finite_number(const nlohmann::json& value, const std::string& path);

/// {"min": [x, y, z], "max": [x, y, z]}; throws CaseError with `path` before what is wrong.
[[nodiscard]] Box box_from(const nlohmann::json& value, const std::string& path);

}  // namespace gnomon
