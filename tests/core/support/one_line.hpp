// A wrapped text, to look for a sentence in.
#pragma once

#include <string>

namespace gnomon::test {

/// The text without its line breaks and columns.
inline std::string in_one_line(const std::string& text) {
  std::string line;
  for (const char c : text) {
    const bool gap = c == ' ' || c == '\n';
    if (!gap || line.empty() || line.back() != ' ') line += gap ? ' ' : c;
  }
  return line;
}

}  // namespace gnomon::test
