// Which promises were broken how often, and the smallest input that breaks each.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "check.hpp"

namespace gnomon::stress {

/// A kind of failure over all cases.
struct KindFound {
  std::string_view kind;
  long long cases = 0;      ///< that have it
  std::uint64_t first = 0;  ///< number of the first of them
  double worst = 0.0;       ///< largest amount, and where it was
  std::uint64_t worst_case = 0;
  std::string text;       ///< of the shrunk case
  std::string case_file;  ///< the shrunk case, indented
};

class Failures {
 public:
  explicit Failures(const std::vector<Kind>& kinds);
  void add(const std::vector<Finding>& findings, std::uint64_t number, const nlohmann::ordered_json& value);
  /// Makes the first case of each kind as small as it can be; `check` throws CaseError where it is given no
  /// case.
  void shrink(const std::function<std::vector<Finding>(const nlohmann::ordered_json&)>& check,
              int most_tries);
  /// Those that were found, in the order of their kinds.
  [[nodiscard]] std::vector<KindFound> found() const;

 private:
  std::vector<KindFound> kinds_;
};

/// A line for each.
[[nodiscard]] std::string failure_lines(const std::vector<KindFound>& found);

}  // namespace gnomon::stress
