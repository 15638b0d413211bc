// A cost model from text that is already in memory, and to text.
#pragma once

#include <string>
#include <string_view>

#include "gnomon/report/cost_model.hpp"
#include "gnomon/report/row.hpp"

namespace gnomon::report {

/// load_cost_model on text; `name` stands in front of errors. Throws ReportError.
[[nodiscard]] StoredCostModel cost_model_from_text(std::string_view text, const std::string& name);
/// What save_cost_model writes.
[[nodiscard]] std::string to_text(const StoredCostModel& model);

}  // namespace gnomon::report
