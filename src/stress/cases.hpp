// The extreme cases that a plan must answer in a known way: one entry for each, with what it requires.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/stress_rows.hpp"

namespace gnomon::stress {

/// Collects what a case found. A case fails where anything does not hold, and says all that does not.
class Check {
 public:
  /// `what`: the requirement in few words, told where it does not hold.
  void that(bool holds, std::string_view what);
  /// A number worth reading, whatever becomes of the case.
  void note(std::string_view name, double value);
  void note(std::string_view text);
  /// Nothing can be checked here, and why.
  void skip(std::string_view why);

  [[nodiscard]] bool passed() const noexcept { return failures_.empty(); }
  [[nodiscard]] bool skipped() const noexcept { return skipped_; }
  /// One line: what failed, or what was found.
  [[nodiscard]] std::string found() const;
  [[nodiscard]] int checks() const noexcept { return checks_; }

 private:
  std::string failures_, notes_;
  int checks_ = 0;
  bool skipped_ = false;
};

/// One extreme input.
struct ExtremeCase {
  int row;                ///< of the list of stiff cases, from 1
  std::string_view name;  ///< in snake_case: for tests and for choosing
  std::string_view input, required;
  void (*run)(Check& check);
  /// False where something that is no number goes in: comparing it is a floating-point exception by itself.
  bool finite_input = true;
};
/// All of them, by row.
[[nodiscard]] std::span<const ExtremeCase> all_cases() noexcept;

[[nodiscard]] CaseRow run_case(const ExtremeCase& extreme);

}  // namespace gnomon::stress
