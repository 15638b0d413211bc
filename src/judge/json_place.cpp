// On which line of JSON text is the value that a path names?
#include "judge/json_place.hpp"

#include <algorithm>
#include <charconv>

namespace gnomon::judge {
namespace {

constexpr std::string_view kSpace = " \t\r\n";

std::size_t end_of_string(std::string_view text, std::size_t at) {
  for (++at; at < text.size() && text[at] != '"'; ++at) at += text[at] == '\\' ? 1 : 0;
  return std::min(at + 1, text.size());
}

std::size_t past_space(std::string_view text, std::size_t at) {
  return std::min(text.find_first_not_of(kSpace, at), text.size());
}

std::size_t end_of_value(std::string_view text, std::size_t at) {
  int open = 0;
  while (at < text.size()) {
    const char c = text[at];
    if (c == '"') {
      at = end_of_string(text, at);
    } else {
      if (open == 0 && (c == ',' || c == ']' || c == '}')) return at;
      open += c == '[' || c == '{' ? 1 : c == ']' || c == '}' ? -1 : 0;
      ++at;
    }
    if (open == 0 && (c == '"' || c == ']' || c == '}')) return at;
  }
  return at;
}

/// A step of a path: a key, or a number in brackets.
struct Step {
  std::string_view key;
  std::size_t index = 0;
  bool of_list = false;
};

Step take_step(std::string_view& path) {
  Step step;
  if (path.starts_with('[')) {
    step.of_list = true;
    std::from_chars(path.data() + 1, path.data() + path.size(), step.index);
    path.remove_prefix(std::min(path.find(']'), path.size() - 1) + 1);
  } else {
    step.key = path.substr(0, path.find_first_of(".["));
    path.remove_prefix(step.key.size());
  }
  if (path.starts_with('.')) path.remove_prefix(1);
  return step;
}

/// Where the step leads from the value at `at`; npos: it is not there.
std::size_t follow(std::string_view text, std::size_t at, const Step& step) {
  if (at >= text.size() || text[at] != (step.of_list ? '[' : '{')) return std::string_view::npos;
  at = past_space(text, at + 1);
  for (std::size_t index = 0; at < text.size() && text[at] != ']' && text[at] != '}'; ++index) {
    bool here = step.of_list && index == step.index;
    if (!step.of_list) {
      const std::size_t end = end_of_string(text, at);
      here = text.substr(at + 1, end - at - 2) == step.key;
      at = past_space(text, past_space(text, end) + 1);
    }
    if (here) return at;
    at = past_space(text, end_of_value(text, at));
    if (at < text.size() && text[at] == ',') at = past_space(text, at + 1);
  }
  return std::string_view::npos;
}

}  // namespace

std::size_t line_of(std::string_view text, std::string_view path, std::size_t& found) {
  std::size_t at = past_space(text, 0);
  found = 0;
  while (!path.empty()) {
    const std::size_t next = follow(text, at, take_step(path));
    if (next == std::string_view::npos) break;
    at = next;
    ++found;
  }
  const std::string_view before = text.substr(0, at);
  return static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1;
}

}  // namespace gnomon::judge
