// A page plan of a case with its memory, and its JSON.
#pragma once

#include <cstddef>
#include <vector>

#include "plan_json.hpp"

namespace gnomon::tool {

/// Plans the pages of one case, again and again into the same memory.
class PagePlanner {
 public:
  /// `input` must have pages, and outlive the planner.
  explicit PagePlanner(const Case& input);
  /// The plan lives until the next call.
  [[nodiscard]] PagePlan plan() noexcept;

 private:
  const Case& input_;
  PageOptions options_;
  std::vector<std::byte> memory_;
};

/// As plan_json, of pages.
[[nodiscard]] Json pages_json(const PagePlan& plan, const Case& input);

}  // namespace gnomon::tool
