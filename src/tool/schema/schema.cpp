// `gnomon schema`: what may stand in the files that the program reads? Skeletons in JSON, filled from the
// tables that the readers go by.
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

#include "command.hpp"
#include "gnomon/casefile/plan_fields.hpp"
#include "identifier_word.hpp"
#include "output.hpp"
#include "page_setting.hpp"
#include "picture_words.hpp"
#include "schema_texts.inc"
#include "view/state.hpp"

namespace gnomon::tool::schema {
namespace {

using Json = nlohmann::ordered_json;

struct Entry {
  std::string_view name, what, text;
};
constexpr std::array<Entry, 4> kSchemas{{
    {"case", "a camera, a light and bounds, for gnomon plan", kCaseText},
    {"path", "a camera flight, for --path", kPathText},
    {"state", "what the window of gnomon view shows, for --state", kStateText},
    {"capture", "cameras, lights and maps of an engine, for gnomon judge", kCaptureText},
}};

std::vector<std::string> schema_names() {
  std::vector<std::string> names;
  for (const Entry& entry : kSchemas) names.emplace_back(entry.name);
  return names;
}

std::vector<std::string> names_of(std::span<const view::Named> all) {
  std::vector<std::string> names;
  for (const view::Named& one : all) names.emplace_back(one.name);
  return names;
}

std::vector<std::string> names_in_table(const std::string& table) {
  if (table == "views") return names_of(view::view_names());
  if (table == "comparisons") return names_of(view::comparison_names());
  if (table == "page_policies") return names_in(all_page_policies());
  if (table == "page_policies_or_off") return page_policy_names();
  if (table == "transitions") return transition_names();
  if (table == "identifiers") return identifier_names();
  if (table == "layers") return layer_names();
  if (table == "map_passes") return map_passes_names();
  throw std::logic_error("a schema names no such table: " + table);
}

Json reference(const char* name) {
  return {{"$ref", std::string("#/$defs/") + name}};
}

Json choice_schema(const PlanField& field, const PlanChoice& choice) {
  // Rules joined by commas have no end of names.
  if (field.key == "prune") return {{"type", "string"}};
  std::vector<std::string> names = choice.names();
  if (field.key == "warp") names.emplace_back(to_string(Partition::separating_plane));
  return {{"enum", names}};
}

/// A field's value, by the type of its place.
Json value_schema(const PlanField& field) {
  return std::visit(
      [&](const auto& place) -> Json {
        using Place = std::remove_cvref_t<decltype(place)>;
        if constexpr (std::is_same_v<Place, PlanChoice>) {
          return choice_schema(field, place);
        } else if constexpr (std::is_same_v<Place, PlanMember<Box>>) {
          return reference("box");
        } else if constexpr (std::is_same_v<Place, PlanMember<BiasOptions>>) {
          return reference("bias");
        } else if constexpr (std::is_same_v<Place, PlanMember<ClipSpace>>) {
          return reference("clip_space");
        } else if constexpr (std::is_same_v<Place, PlanMember<SplitDepths>>) {
          return {{"type", "array"}, {"items", {{"type", "number"}}}, {"maxItems", SplitDepths{}.size()}};
        } else if constexpr (std::is_same_v<Place, PlanMember<WarpPlanes>>) {
          return {{"type", "array"}, {"items", reference("plane")}, {"maxItems", WarpPlanes{}.size()}};
        } else if constexpr (std::is_same_v<Place, PlanMember<bool>>) {
          return {{"type", "boolean"}};
        } else {
          Json number{{"type", std::is_same_v<Place, PlanMember<double>> ? "number" : "integer"}};
          if (field.least < field.most) {
            number["minimum"] = field.least;
            number["maximum"] = field.most;
          }
          return number;
        }
      },
      field.place);
}

/// All keys of "options".
Json plan_properties() {
  Json properties = Json::object();
  for (const PlanField& field : plan_fields()) {
    Json value = value_schema(field);
    value["description"] = field.summary;
    properties[std::string(field.key)] = std::move(value);
  }
  properties["pseudo_near"] = {{"type", "number"}, {"description", "another name of near_hint"}};
  properties["stable"] = {{"type", "boolean"}, {"description", "another name of fit: stable or tight"}};
  properties["pages"] = reference("pages");
  properties["lights"] = reference("light_pool");
  return properties;
}

/// The skeleton with its "$shared", "$names" and "$plan_fields" replaced.
Json filled(const Json& skeleton) {
  if (skeleton.is_object() && skeleton.contains("$shared"))
    return filled(Json::parse(kSharedText).at(skeleton.at("$shared").get<std::string>()));
  if (skeleton.is_object() && skeleton.contains("$names")) {
    Json out{{"enum", names_in_table(skeleton.at("$names").get<std::string>())}};
    return out;
  }
  if (skeleton.is_object() && skeleton.contains("$plan_fields")) return plan_properties();
  Json out = skeleton;
  for (auto& value : out)
    if (value.is_structured()) value = filled(value);
  return out;
}

int print(const std::string& name) {
  for (const Entry& entry : kSchemas)
    if (entry.name == name) print_line(filled(Json::parse(entry.text)).dump(2));
  flush_output();
  return 0;
}

}  // namespace
}  // namespace gnomon::tool::schema

namespace gnomon::tool {

std::function<int()> declare_schema(Arguments& arguments) {
  const auto name = std::make_shared<std::string>();
  arguments.options = {{.name = "NAME",
                        .target = name.get(),
                        .help = "of the kind of file: " + any_of_text(schema::schema_names()),
                        .required = true,
                        .names = schema::schema_names()}};
  arguments.footer = "Kinds:\n";
  for (const schema::Entry& entry : schema::kSchemas)
    arguments.footer += "  " + std::string(entry.name) + ": " + std::string(entry.what) + "\n";
  arguments.footer += "docs/files.md has an example of each.";
  return [name] { return schema::print(*name); };
}

}  // namespace gnomon::tool
