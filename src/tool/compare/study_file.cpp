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
#include "page_setting.hpp"

namespace gnomon::tool {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kSchema = "gnomon-study/1";
constexpr std::string_view kOfLine[] = {"--out",     "--resume",         "--shard",       "--json",
                                        "--context", "--map-memory-mib", "--write-masks", "--exact"};

/// Fields of a view that are no options: what it is called, and what its files are.
constexpr const char* kOfView[] = {"name", "hash", "licence", "source", "optional", "techniques"};

[[noreturn]] void refuse(const std::string& field, const std::string& why) {
  throw std::runtime_error(field + ": " + why);
}

std::string field_of(const std::string& option) {
  if (option == "SCENE") return "scenes";
  std::string field = option.substr(option.find_first_not_of('-'));
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
    const std::string field = field_of(option.name);
    if (of_line && object.contains(field)) refuse(where + field, "belongs on the command line");
    if (!of_line) known.push_back(field);
    if (of_line || !object.contains(field)) continue;
    for (const std::string& other : option.excludes)
      if (object.contains(field_of(other))) refuse(where + field, "does not go with " + field_of(other));
    set_option(where + field, object[field], option);
  }
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const std::string near = nearest_name(key, known);
    refuse(where + one_line(key, 80),
           "is no field of a study" + (near.empty() ? "" : "; did you mean '" + near + "'?"));
  }
}

/// The study without what a view's fields take the place of because it does not go with them.
Json under_view(Json study, const Json& view, const std::vector<Option>& options) {
  for (const Option& option : options)
    for (const std::string& other : option.excludes) {
      const std::string one = field_of(option.name), two = field_of(other);
      if (view.contains(one)) study.erase(two);
      if (view.contains(two)) study.erase(one);
    }
  return study;
}

/// One technique of a list, as a row has it. One that has a name says where it is from, what differs from
/// its description, and how it was checked.
report::Technique technique_of(const std::string& field, const Json& object) {
  constexpr const char* kOfPeople[] = {"source", "differs", "checked"};
  if (!object.is_object()) refuse(field, "needs an object");
  report::Technique t{"none", "auto", "tight", "hard"};
  const std::vector<Option> options{
      {.name = "name", .target = &t.entry, .help = {}},
      {.name = "warp", .target = &t.warp, .help = {}},
      {.name = "split", .target = &t.split, .help = {}},
      {.name = "fit", .target = &t.fit, .help = {}},
      {.name = "filter", .target = &t.filter, .help = {}},
      {.name = "layer", .target = &t.layer, .help = {}},
      {.name = "cascades", .target = &t.cascades, .help = {}, .range = {{1, kMaxMaps}}},
      {.name = "map_size", .target = &t.map_size, .help = {}, .range = {{kLeastMapSize, kMaxMapSize}}},
      {.name = "pages", .target = &t.pages, .help = {}},
      {.name = "page_texels",
       .target = &t.page_texels,
       .help = {},
       .range = {{kLeastPageTexels, kMaxPageTexels}}},
      {.name = "page_target_m", .target = &t.page_target_m, .help = {}, .range = {{0.0, kMaxTargetM}}}};
  if (object.contains("pages")) t.page_texels = 128;
  set_fields(field + ".", object, options, {std::begin(kOfPeople), std::end(kOfPeople)});
  if (object.contains("name") && !is_entry_name(t.entry))
    refuse(field + ".name", "wants at most 60 characters other than / and |");
  for (const char* const text : kOfPeople) {
    const bool has = object.contains(text);
    if (has ? !object[text].is_string() || object[text].get<std::string>().empty() : !t.entry.empty())
      refuse(field + "." + text, "needs a text");
  }
  if (!t.pages.empty() && !is_page_size(t.page_texels))
    refuse(field + ".page_texels", "wants 64, 128 or 256");
  try {
    (void)sweep_entry(t);
  } catch (const std::runtime_error& error) {
    refuse(field, error.what());
  }
  return t;
}

/// `techniques` of the view, else of the file.
std::vector<report::Technique> techniques_of(const std::string& where, const std::string& before_field,
                                             const Json& study, const Json& view) {
  const bool of_view = view.contains("techniques");
  const std::string field = (of_view ? before_field : where) + "techniques";
  std::vector<report::Technique> techniques;
  if (!of_view && !study.contains("techniques")) return techniques;
  const Json& list = of_view ? view["techniques"] : study["techniques"];
  if (!list.is_array()) refuse(field, "needs a list of objects");
  for (std::size_t i = 0; i < list.size(); ++i)
    techniques.push_back(technique_of(field + "[" + std::to_string(i) + "]", list[i]));
  return techniques;
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

Json parsed(const std::string& name, std::string_view text) {
  constexpr int kDepth = 8;
  if (nested_deeper_at(text, kDepth) != std::string_view::npos)
    refuse(name, "nested deeper than " + std::to_string(kDepth) + " levels");
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    refuse(name, json_words(error.what()));
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
  constexpr std::uint64_t kMaxBytes = 1u << 20;
  std::string text;
  if (const std::string why = read_bounded_file(file, kMaxBytes, Readable::file_or_pipe, text); !why.empty())
    refuse(file.string(), why);
  return study_from(text, file.string(), line, options_of);
}

std::vector<CompareRequest> study_from(std::string_view text, const std::string& name,
                                       const CompareRequest& line, const OptionsOf& options_of) {
  const Json study = parsed(name, text);
  const std::string where = name + ": ";
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
    set_fields(where, under_view(study, views[i], options), options, {"schema", "views", "techniques"});
    const std::string before_field = where + of_view + (has_views ? "." : "");
    set_fields(before_field, views[i], options, {std::begin(kOfView), std::end(kOfView)});
    set_manifest(before_field, views[i], request, names);
    request.techniques = techniques_of(where, before_field, study, views[i]);
    request.where = name + (has_views ? ": " + of_view : "");
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
    request.seconds = line.seconds;
  }
  if (std::erase_if(requests, is_left_out) > 0 && requests.empty())
    throw std::runtime_error(where + "no view is left");
  return requests;
}

}  // namespace gnomon::tool
