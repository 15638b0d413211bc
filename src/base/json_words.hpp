// What a JSON library complains about, in the words of our messages.
#pragma once

#include <string>
#include <string_view>

namespace gnomon {
namespace detail {

/// The text between `open` and `close`, both of which `text` must have in this order; else empty.
inline std::string_view text_between(std::string_view text, std::string_view open, std::string_view close) {
  const std::size_t begin = text.find(open);
  if (begin == std::string_view::npos) return {};
  const std::size_t end = text.find(close, begin + open.size());
  if (end == std::string_view::npos) return {};
  return text.substr(begin + open.size(), end - begin - open.size());
}

inline std::string_view after(std::string_view text, std::string_view mark) {
  const std::size_t at = text.find(mark);
  return at == std::string_view::npos ? std::string_view() : text.substr(at + mark.size());
}

}  // namespace detail

/// nlohmann's "[json.exception.KIND.NUMBER] MESSAGE" as "line 2, column 5: invalid literal; ...", "\"key\" is
/// missing" or "needs a string, is number"; what is none of these keeps its message. `with_place`: line and
/// column in front, where the library gives them.
[[nodiscard]] inline std::string json_words(std::string_view what, bool with_place = true) {
  if (what.starts_with("[json.exception.")) what = detail::after(what, "] ");
  if (what.starts_with("parse error")) {
    const std::string_view place = detail::text_between(what, "parse error at ", ": ");
    std::string_view message = detail::after(what, ": ");
    if (message.empty()) message = what;
    if (message.starts_with("syntax error while parsing ")) message = detail::after(message, " - ");
    return (with_place && !place.empty() ? std::string(place) + ": " : std::string()) + std::string(message);
  }
  if (const std::string_view key = detail::text_between(what, "key '", "' not found"); !key.empty())
    return "\"" + std::string(key) + "\" is missing";
  if (const std::string_view wanted = detail::text_between(what, "type must be ", ", but is ");
      !wanted.empty())
    return "needs " + std::string(wanted) + ", is " + std::string(detail::after(what, ", but is "));
  if (const std::string_view found = detail::after(what, "cannot use at() with "); !found.empty())
    return "needs an object, is " + std::string(found);
  return std::string(what);
}

}  // namespace gnomon
