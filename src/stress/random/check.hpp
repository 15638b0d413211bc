// What a plan owes its caller, checked in long double against nothing but the case and the plan.
#pragma once

#include <cfenv>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/casefile/casefile.hpp"

namespace gnomon::stress {

/// A promise that a plan breaks.
struct Finding {
  std::string_view kind;  ///< in snake_case; every promise has its own, the list is in all_kinds()
  double amount = 0.0;    ///< how badly, in the unit that `text` names; larger is worse
  std::string text;       ///< what happened where, on one line
};

/// Keeps the worst finding of each kind.
void add_worst(std::vector<Finding>& findings, const Finding& finding);

/// A kind of finding, with the promise that it breaks.
struct Kind {
  std::string_view name, promise;
};
[[nodiscard]] const std::vector<Kind>& all_kinds();

/// What was looked at, so that nothing passes for lack of checks.
struct Counts {
  long long plans = 0, seen_plans = 0, pages = 0, lights = 0, light_maps = 0, maps = 0, receivers = 0,
            casters = 0, unmapped = 0, measured = 0, texels = 0, warps = 0, view_plans = 0, page_points = 0;
  void add(const Counts& other);
};

struct Verdict {
  std::vector<Finding> findings;  ///< at most one of each kind: the worst
  Counts counts;
  double plan_ms = 0.0;  ///< time of make_plan
};

/// Checks the case of this JSON text; throws CaseError where it is no case.
[[nodiscard]] Verdict check_case(const nlohmann::ordered_json& value);

// The parts of check_case.
class Report {
 public:
  explicit Report(Verdict& verdict) : verdict_(verdict) {}
  /// What was planned with, in front of each text from now on.
  void begin_with(std::string_view words) { words_ = words; }
  /// Keeps the worst of each kind.
  void add(std::string_view kind, double amount, const std::string& text);
  [[nodiscard]] Counts& counts() { return verdict_.counts; }

 private:
  Verdict& verdict_;
  std::string_view words_;
};
/// Runs what `who` names; a finding where a program that traps floating-point exceptions would have died.
template <typename Work>
auto quiet(const char* who, Report& report, Work&& work) {
  constexpr int kTrapped = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;
  std::feclearexcept(kTrapped);
  auto result = work();
  const int raised = std::fetestexcept(kTrapped);
  std::feclearexcept(kTrapped);
  if (raised != 0)
    report.add("floating_point_exception", 1.0,
               std::string(who) + " raises" + ((raised & FE_INVALID) != 0 ? " invalid" : "") +
                   ((raised & FE_DIVBYZERO) != 0 ? " division by zero" : "") +
                   ((raised & FE_OVERFLOW) != 0 ? " overflow" : ""));
  return result;
}
/// The numbers of each map and of the plan as a whole.
void check_numbers(const Case& input, const ShadowPlan& plan, Report& report);
/// Places in the receivers that the camera sees, world space: what check_points takes, and what a picture
/// would show.
[[nodiscard]] std::vector<glm::dvec3> seen_places(const Case& input);
/// Receivers in their maps, casters kept and within the depths, world and camera-relative matrices alike.
void check_points(const Case& input, const ShadowPlan& plan, std::span<const glm::dvec3> seen,
                  Report& report);
/// The metric against its definition.
void check_metric(const Case& input, const ShadowPlan& plan, Report& report);
/// Pages for these visible points under every policy: each point served as finely as it was promised, within
/// the pool, kept as they are, and drawn again where a caster moved.
void check_pages(const Case& input, std::span<const glm::dvec3> seen, Report& report);
/// Maps that several cameras share: what each of them sees is in them, with its casters.
void check_views(const Case& input, Report& report);
/// The plan as the shaders of one camera read it.
[[nodiscard]] ShadowPlan as_seen_by(const ShadowPlan& plan, const Camera& camera);
/// The lights of the case, or its light and a sun, in one pool: within the budget, no two maps in one place,
/// sizes and frames as they are said to be, and what each light lights in its maps.
void check_lights(const Case& input, std::span<const glm::dvec3> points, Report& report);
/// That a warp which may be dropped lowers the objective.
void check_warp(const nlohmann::ordered_json& value, Report& report);

}  // namespace gnomon::stress
