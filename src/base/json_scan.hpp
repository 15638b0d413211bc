// What can be told of JSON before a parser sees it: how deep it nests, and how much it holds.
#pragma once

#include <cstddef>
#include <string_view>

namespace gnomon {

/// Calls `visit(offset, character)` for each character of the text that is not in a string.
template <class Visit>
void scan_outside_strings(std::string_view json, Visit&& visit) {
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_string) {
      if (c == '\\') ++i;
      in_string = c != '"';
    } else if (c == '"') {
      in_string = true;
    } else {
      visit(i, c);
    }
  }
}

/// Where the first bracket opens that has more than `levels` - 1 open ones round it; npos: nowhere.
[[nodiscard]] inline std::size_t nested_deeper_at(std::string_view json, int levels) {
  std::size_t at = std::string_view::npos;
  int depth = 0;
  scan_outside_strings(json, [&](std::size_t offset, char c) {
    if (c == ']' || c == '}') --depth;
    if ((c == '[' || c == '{') && ++depth > levels && at == std::string_view::npos) at = offset;
  });
  return at;
}

}  // namespace gnomon
