// Which technique has the least error within a budget of time, on this machine, and how sure is that?
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gnomon/report/statistics.hpp"
#include "summary.hpp"
#include "views.hpp"

namespace gnomon::report {

/// From this budget on the technique has the least median error, up to the next choice's budget.
struct BudgetChoice {
  double budget_ms = 0.0;        ///< upper end of the interval of its median time
  std::size_t technique = 0;     ///< of the summary
  Estimate error, ms;            ///< medians over the views with their intervals
  std::optional<SignTest> test;  ///< against the choice before it, view by view; the first has none
  std::vector<std::size_t>
      as_good;  ///< within the budget and not shown to have more error, least error first
};
/// Choices of one error by rising budget, of techniques that all views have. Empty where there is none.
[[nodiscard]] std::vector<BudgetChoice> budget_choices(const ViewTable& table, const Summary& summary,
                                                       std::string_view error);

/// Heading and a table for each of the errors of kinds; empty for fewer than two views.
[[nodiscard]] std::string budget_part(const std::vector<Row>& rows, const Summary& summary);
/// The same as JSON ("gnomon-budgets/1"), with the machine. No choices for fewer than two views.
[[nodiscard]] std::string budgets_json(const std::vector<Row>& rows, const Summary& summary);

}  // namespace gnomon::report
