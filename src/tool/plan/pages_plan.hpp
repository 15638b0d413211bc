// A page plan of a case with its memory, and its JSON.
#pragma once

#include <cstdint>
#include <vector>

#include "gnomon/pages.hpp"
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
  std::vector<ShadowMap> levels_;
  std::vector<Page> pages_;
  std::vector<std::uint32_t> table_;
  std::vector<PagePoint> points_;
};

/// As plan_json, of pages.
[[nodiscard]] Json pages_json(const PagePlan& plan, const Case& input);

}  // namespace gnomon::tool
