// What the planner predicts and picks, beside what a sweep measured.
#pragma once

#include <vector>

#include "gnomon/report/cost_model.hpp"
#include "gnomon/report/row.hpp"

namespace gnomon::tool {

/// Asks for picks within budgets and at errors from end to end of what each flight measured. Prints for each
/// frame how far its picks are from the measured front and from the request. Where a flight has several
/// frames, the same of means over all of them: of the first frame's pick, the hardest frame's and each
/// frame's. Returns 0.
int check_planner(const report::StoredCostModel& model, const std::vector<report::Row>& rows, bool json);

}  // namespace gnomon::tool
