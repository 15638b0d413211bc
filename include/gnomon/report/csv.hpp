// Text in a table that people open in a spreadsheet.
#pragma once

#include <string>
#include <string_view>

namespace gnomon::report {

/// A CSV field in quotes (RFC 4180). Text that begins with = + - @ or a control character gets an apostrophe
/// in front, the mark for plain text. A spreadsheet would take it for a formula.
[[nodiscard]] inline std::string csv_field(std::string_view text) {
  constexpr std::string_view kFormula = "=+-@\t\r\n";
  std::string out = "\"";
  if (!text.empty() && kFormula.find(text.front()) != std::string_view::npos) out += '\'';
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

}  // namespace gnomon::report
