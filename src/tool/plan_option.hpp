// A field of a case file's "options" as an option of a command line.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "command.hpp"
#include "gnomon/casefile/plan_fields.hpp"

namespace gnomon::tool {

/// The field `key` as --key, with dashes; its value goes into `options`, which must outlive the parsing.
/// `help` stands in for the field's own summary. Numbers and choices only: throws std::logic_error for
/// others.
[[nodiscard]] Option plan_option(std::string_view key, PlanOptions& options, std::string help = {});

/// Numbers and choices of a plan as "options" of a case file has them.
[[nodiscard]] nlohmann::ordered_json plan_options_json(PlanOptions options);

/// Sets the choice `key` by its name; false where the name is unknown.
[[nodiscard]] bool set_plan_choice(std::string_view key, std::string_view name, PlanOptions& options);
/// As in case files: who gives a blend and no split means the split that blends. Throws std::runtime_error
/// where a blend is given for splits that never blend.
void resolve_lambda(bool lambda_given, bool split_given, PlanOptions& options);
/// Whether a lambda has no effect on such splits, whatever else is chosen.
[[nodiscard]] constexpr bool never_blends(SplitScheme scheme) noexcept {
  return scheme == SplitScheme::uniform || scheme == SplitScheme::logarithmic ||
         scheme == SplitScheme::pseudo_near || scheme == SplitScheme::given;
}
/// Whether a grid of this fit only stays where it is from frame to frame: a warped one always, a stable one
/// beside receivers that move.
[[nodiscard]] constexpr bool needs_history(Fit fit) noexcept {
  return fit == Fit::warped_stable || fit == Fit::stable;
}
/// The names that a choice takes.
[[nodiscard]] std::vector<std::string> plan_choice_names(std::string_view key);

}  // namespace gnomon::tool
