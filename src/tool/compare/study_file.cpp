// A whole study in one file: which techniques are measured on which views?
#include "study_file.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "base/bounded_file.hpp"
#include "base/json_scan.hpp"
#include "base/json_words.hpp"
#include "gnomon/casefile/casefile.hpp"

namespace gnomon::tool {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kSchema = "gnomon-study/1";
constexpr std::string_view kOfLine[] = {"--out",     "--resume",         "--shard",       "--json",
                                        "--context", "--map-memory-mib", "--write-masks", "--exact"};

/// Fields of a view that are no options: what it is called, and what its files are.
constexpr const char* kOfView[] = {"name", "hash", "licence", "source", "optional"};

[[noreturn]] void refuse(const std::string& field, const std::string& why) {
  throw std::runtime_error(field + ": " + why);
}

std::string field_of(const Option& option) {
  if (option.name == "SCENE") return "scenes";
  std::string field = option.name.substr(option.name.find_first_not_of('-'));
  std::replace(field.begin(), field.end(), '-', '_');
  return field;
}

std::string word_of(const std::string& field, const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number()) return value.dump();
  refuse(field, "needs a string or a number, is " + std::string(value.type_name()));
}

std::vector<std::string> words_of(const std::string& field, const Json& value) {
  if (!value.is_array()) return {word_of(field, value)};
  if (value.empty()) refuse(field, "needs at least one entry");
  std::vector<std::string> words;
  for (std::size_t i = 0; i < value.size(); ++i)
    words.push_back(word_of(field + "[" + std::to_string(i) + "]", value[i]));
  return words;
}

template <class Number>
Number number_of(const std::string& field, const Json& value, const Option& option) {
  if (!value.is_number()) refuse(field, "needs a number, is " + std::string(value.type_name()));
  const double number = value.get<double>();
  if (std::is_integral_v<Number> && number != std::floor(number)) refuse(field, "needs a whole number");
  if (option.range && !(number >= (*option.range)[0] && number <= (*option.range)[1]))
    refuse(field,
           "is not from " + Json((*option.range)[0]).dump() + " to " + Json((*option.range)[1]).dump());
  return static_cast<Number>(number);
}

void set_option(const std::string& field, const Json& value, const Option& option) {
  const auto set = [&](const auto& target) {
    using Target = std::remove_cvref_t<decltype(target)>;
    if constexpr (std::is_same_v<Target, ParsedWord>) {
      const std::string word = word_of(field, value);
      if (!target.set(word)) refuse_name(field, word, option.names);
    } else if constexpr (std::is_same_v<Target, ParsedWords>) {
      target.set(field, words_of(field, value));
    } else if constexpr (std::is_same_v<Target, bool*>) {
      if (!value.is_boolean()) refuse(field, "needs true or false, is " + std::string(value.type_name()));
      *target = value.get<bool>();
    } else if constexpr (std::is_same_v<Target, std::string*>) {
      *target = word_of(field, value);
    } else if constexpr (std::is_same_v<Target, std::vector<std::string>*>) {
      *target = words_of(field, value);
    } else if constexpr (std::is_same_v<Target, std::vector<int>*>) {
      refuse(field, "is no field of a study");
    } else {
      *target = number_of<std::remove_pointer_t<Target>>(field, value, option);
    }
  };
  try {
    std::visit(set, option.target);
  } catch (const std::runtime_error& error) {
    const std::string what = error.what();
    throw std::runtime_error(what.starts_with(field) ? what : field + ": " + what);
  }
}

/// Sets the options that the object's fields name; `where` ends in what stands before a field.
void set_fields(const std::string& where, const Json& object, const std::vector<Option>& options,
                const std::vector<std::string>& besides) {
  std::vector<std::string> known = besides;
  for (const Option& option : options) {
    const bool of_line = stands_beside_study(option.name);
    const std::string field = field_of(option);
    if (of_line && object.contains(field)) refuse(where + field, "belongs on the command line");
    if (!of_line) known.push_back(field);
    if (!of_line && object.contains(field)) set_option(where + field, object[field], option);
  }
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const std::string near = nearest_name(key, known);
    refuse(where + one_line(key, 80),
           "is no field of a study" + (near.empty() ? "" : "; did you mean '" + near + "'?"));
  }
}

/// What a view is called, and what its files must be.
void set_manifest(const std::string& before_field, const Json& view, CompareRequest& request,
                  std::set<std::string>& names) {
  const auto text = [&](const char* field) {
    if (!view.contains(field)) return std::string();
    if (!view[field].is_string() || view[field].get<std::string>().empty())
      refuse(before_field + field, "needs a text");
    return view[field].get<std::string>();
  };
  request.view = text("name");
  if (!request.view.empty() && !names.insert(request.view).second)
    refuse(before_field + "name", "is the name of another view");
  request.files.hash = text("hash");
  request.files.licence = text("licence");
  request.files.source = text("source");
  if (!view.contains("optional")) return;
  if (!view["optional"].is_boolean()) refuse(before_field + "optional", "needs true or false");
  request.files.optional = view["optional"].get<bool>();
}

/// Names a view whose files need not be there, and are not.
bool is_left_out(const CompareRequest& request) {
  if (!request.files.optional) return false;
  for (const std::string& scene : request.scenes) {
    std::error_code error;
    if (scene.starts_with("builtin:") || std::filesystem::exists(scene, error)) continue;
    warn(request.where + ": " + scene + " is not there, and the view is optional: it is omitted");
    return true;
  }
  return false;
}

Json parsed(const std::filesystem::path& file) {
  constexpr std::uint64_t kMaxBytes = 1u << 20;
  constexpr int kDepth = 8;
  std::string text;
  if (const std::string why = read_bounded_file(file, kMaxBytes, Readable::file_or_pipe, text); !why.empty())
    refuse(file.string(), why);
  if (nested_deeper_at(text, kDepth) != std::string_view::npos)
    refuse(file.string(), "nested deeper than " + std::to_string(kDepth) + " levels");
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    refuse(file.string(), json_words(error.what()));
  }
}

}  // namespace

bool stands_beside_study(const std::string& option) {
  return std::find(std::begin(kOfLine), std::end(kOfLine), option) != std::end(kOfLine);
}

bool is_study_file(const std::string& word) {
  return word.ends_with(".json");
}

std::vector<CompareRequest> read_study(const std::filesystem::path& file, const CompareRequest& line,
                                       const OptionsOf& options_of) {
  const Json study = parsed(file);
  const std::string where = file.string() + ": ";
  if (!study.is_object()) throw std::runtime_error(where + "needs an object");
  if (!study.contains("schema") || study["schema"] != kSchema)
    refuse(where + "schema", "must be \"" + std::string(kSchema) + "\"");
  const bool has_views = study.contains("views");
  if (has_views && (!study["views"].is_array() || study["views"].empty()))
    refuse(where + "views", "needs a list of objects");
  const Json views = has_views ? study["views"] : Json::array({Json::object()});
  std::vector<CompareRequest> requests(views.size());
  std::set<std::string> names;
  for (std::size_t i = 0; i < views.size(); ++i) {
    CompareRequest& request = requests[i];
    const std::string of_view = has_views ? "views[" + std::to_string(i) + "]" : "";
    if (!views[i].is_object()) refuse(where + of_view, "needs an object");
    const std::vector<Option> options = options_of(request);
    set_fields(where, study, options, {"schema", "views"});
    const std::string before_field = where + of_view + (has_views ? "." : "");
    set_fields(before_field, views[i], options, {std::begin(kOfView), std::end(kOfView)});
    set_manifest(before_field, views[i], request, names);
    request.where = file.string() + (has_views ? ": " + of_view : "");
    if (request.scenes.empty()) refuse(where + (has_views ? of_view + "." : "") + "scenes", "is missing");
    request.out = line.out;
    request.resume = line.resume;
    request.json = line.json;
    request.shard = line.shard;
    request.shards = line.shards;
    request.context = line.context;
    request.map_memory_mib = line.map_memory_mib;
    request.write_masks = line.write_masks;
    request.exact = line.exact;
  }
  if (std::erase_if(requests, is_left_out) > 0 && requests.empty())
    throw std::runtime_error(where + "no view is left");
  return requests;
}

}  // namespace gnomon::tool
