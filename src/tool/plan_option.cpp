// A field of a case file's "options" as an option of a command line.
#include "plan_option.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <type_traits>

namespace gnomon::tool {

Option plan_option(std::string_view key, PlanOptions& options, std::string help) {
  const PlanField& field = plan_field(key);
  Option option{.name = "--" + std::string(key),
                .target = static_cast<bool*>(nullptr),
                .help = help.empty() ? std::string(field.summary) : std::move(help)};
  std::replace(option.name.begin(), option.name.end(), '_', '-');
  std::visit(
      [&](const auto& place) {
        using Place = std::remove_cvref_t<decltype(place)>;
        if constexpr (std::is_same_v<Place, PlanChoice>) {
          option.names = place.names();
          option.target =
              ParsedWord{[set = place.set, &options](const std::string& name) { return set(name, options); },
                         place.get(options)};
        } else if constexpr (std::is_same_v<Place, PlanMember<int>> ||
                             std::is_same_v<Place, PlanMember<double>> ||
                             std::is_same_v<Place, PlanMember<bool>>) {
          if (field.unit != 1.0) throw std::logic_error(std::string(key) + " has a unit of its own");
          option.target = &place(options);
          if (field.least < field.most) option.range = {{field.least, field.most}};
        } else {
          throw std::logic_error(std::string(key) + " is no word of a command line");
        }
      },
      field.place);
  return option;
}

nlohmann::ordered_json plan_options_json(PlanOptions options) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const PlanField& field : plan_fields()) {
    std::visit(
        [&](const auto& place) {
          using Place = std::remove_cvref_t<decltype(place)>;
          if constexpr (std::is_same_v<Place, PlanChoice>) {
            json[std::string(field.key)] = place.get(options);
          } else if constexpr (std::is_same_v<Place, PlanMember<double>>) {
            json[std::string(field.key)] = place(options) / field.unit;
          } else if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(place(options))>>) {
            json[std::string(field.key)] = place(options);
          }
        },
        field.place);
  }
  return json;
}

bool set_plan_choice(std::string_view key, std::string_view name, PlanOptions& options) {
  return std::get<PlanChoice>(plan_field(key).place).set(name, options);
}

void resolve_lambda(bool lambda_given, bool split_given, PlanOptions& options) {
  if (!lambda_given) return;
  if (!split_given) (void)set_plan_choice("split", "practical", options);
  if (never_blends(options.split.scheme))
    throw std::runtime_error("--lambda: --split " + std::string(to_string(options.split.scheme)) +
                             " takes none");
}

std::vector<std::string> plan_choice_names(std::string_view key) {
  return std::get<PlanChoice>(plan_field(key).place).names();
}

}  // namespace gnomon::tool
