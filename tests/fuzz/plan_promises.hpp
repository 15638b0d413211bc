// What make_plan promises for every input, broken or not.
#pragma once

#include "gnomon/gnomon.hpp"

namespace gnomon::fuzz {

/// Stops where the plan breaks a promise: its status, what goes with it, and that every number is finite.
void check_plan(const ShadowPlan& plan, const PlanOptions& options);

}  // namespace gnomon::fuzz
