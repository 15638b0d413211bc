// Where cases come from: files, and the lines of standard input.
#include "case_source.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string_view>

namespace gnomon::tool {
namespace {

/// The next line without its end; false at the end of the input. Stops reading soon after kMaxCaseBytes, so
/// that a line without end does not fill the memory.
bool read_line(std::FILE* stream, std::string& line) {
  line.clear();
  for (int c = std::getc(stream); c != EOF; c = std::getc(stream)) {
    if (c == '\n') return true;
    line.push_back(static_cast<char>(c));
    if (line.size() > kMaxCaseBytes) return true;
  }
  if (std::ferror(stream)) throw CaseError(std::string("-: ") + std::strerror(errno));
  return !line.empty();
}

}  // namespace

void for_each_case(const std::string& name, const CaseHandler& handle) {
  if (name != "-") {
    handle(load_case(name), shown_name(name));
    return;
  }
  std::string line;
  for (long long number = 1; read_line(stdin, line); ++number) {
    const std::string place = "-:" + std::to_string(number);
    if (line.size() > kMaxCaseBytes) throw CaseError(place + ": larger than 16 MiB");
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    Case input;
    try {
      input = read_case(line);
    } catch (const CaseError& error) {
      throw CaseError(place + ": " + error.what());
    }
    handle(input, place);
  }
}

}  // namespace gnomon::tool
