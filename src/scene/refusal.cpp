// How is a bad file named? One line: which element, and what is wrong with it.
#include "refusal.hpp"

#include <algorithm>

namespace gnomon::detail {

namespace {
constexpr std::size_t kLineLength = 400;    // characters; long enough for a path and a sentence
constexpr std::size_t kWarningCount = 200;  // more are not read by anyone
constexpr int kLinesAlike = 3;              // that differ by their element alone; others are counted
}  // namespace

std::string one_line(std::string_view text) {
  std::string line(text.substr(0, kLineLength));
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  const auto last = line.find_last_not_of(' ');
  line.resize(last == std::string::npos ? 0 : last + 1);
  if (text.size() > kLineLength) line += "...";
  return line;
}

std::string element(std::string_view kind, std::size_t index) {
  return std::string(kind) + "[" + std::to_string(index) + "]";
}

void warn(std::vector<std::string>& warnings, const std::string& element, const std::string& what) {
  const std::string end = one_line(": " + what);
  constexpr std::string_view kMore = "and ";
  const auto is_count = [&](const std::string& line) {
    return line.starts_with(kMore) && line.ends_with(" more" + end);
  };
  const auto count = std::find_if(warnings.begin(), warnings.end(), is_count);
  if (count != warnings.end()) {
    const unsigned long long more = std::stoull(count->substr(kMore.size()));
    *count = std::string(kMore) + std::to_string(more + 1) + " more" + end;
    return;
  }
  const auto alike = std::count_if(warnings.begin(), warnings.end(),
                                   [&](const std::string& line) { return line.ends_with(end); });
  warn(warnings, alike < kLinesAlike ? element + ": " + what : std::string(kMore) + "1 more" + end);
}

void warn(std::vector<std::string>& warnings, const std::string& line) {
  if (warnings.size() < kWarningCount) {
    warnings.push_back(one_line(line));
  } else if (warnings.size() == kWarningCount) {
    warnings.push_back("more warnings are not shown");
  }
}

}  // namespace gnomon::detail
