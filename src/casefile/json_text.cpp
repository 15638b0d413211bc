// JSON text from outside into a value, or one line that says what is wrong with it and where.
#include "json_text.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "base/json_scan.hpp"
#include "base/json_words.hpp"
#include "gnomon/casefile/casefile.hpp"

namespace gnomon {
namespace {

std::string place_of(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0: the first line
  const std::string column = "column " + std::to_string(before.size() - line_start + 1);
  const bool several_lines = text.find('\n') != std::string_view::npos;
  return several_lines ? "line " + std::to_string(line) + ", " + column : column;
}

void check_nesting(std::string_view text) {
  const std::size_t at = nested_deeper_at(text, kMaxCaseNesting);
  if (at != std::string_view::npos)
    throw CaseError(place_of(text, at) + ": nested deeper than " + std::to_string(kMaxCaseNesting) +
                    " levels");
}

}  // namespace

nlohmann::json parse_json(std::string_view text) {
  if (text.size() > kMaxCaseBytes) throw CaseError("larger than 16 MiB");
  check_nesting(text);
  std::vector<std::set<std::string, std::less<>>> open_objects;
  const auto refuse_doubles = [&](int, nlohmann::json::parse_event_t event, nlohmann::json& value) {
    using Event = nlohmann::json::parse_event_t;
    if (event == Event::object_start) open_objects.emplace_back();
    if (event == Event::object_end) open_objects.pop_back();
    if (event == Event::key && !open_objects.back().insert(value.get<std::string>()).second)
      throw CaseError("key \"" + one_line(value.get<std::string>(), 60) + "\" stands twice in one object");
    return true;
  };
  try {
    return nlohmann::json::parse(text, refuse_doubles);
  } catch (const nlohmann::json::parse_error& error) {
    const std::size_t offset = error.byte > 0 ? error.byte - 1 : 0;
    throw CaseError(place_of(text, offset) + ": " + one_line(json_words(error.what(), false)));
  } catch (const nlohmann::json::exception& error) {  // a number beyond the range of double
    throw CaseError(one_line(json_words(error.what(), false)));
  }
}

}  // namespace gnomon
