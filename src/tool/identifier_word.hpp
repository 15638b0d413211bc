// Shadows by identifiers among the filters of a command line: identifiers, with of and neighbours behind it.
#pragma once

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/render/renderer.hpp"

namespace gnomon::tool {

/// Word that stands for render::Source::identifiers. Behind it may follow `:of=triangle` and
/// `neighbours=N`, parted by a comma.
inline constexpr std::string_view kIdentifiers = "identifiers";

/// The test that `identifiers:of=triangle,neighbours=1` says; none for other words. Throws std::runtime_error
/// that names the command's option where an option of the word is none.
[[nodiscard]] inline std::optional<render::IdentifierTest> identifier_test(
    const std::string& text, std::string_view option_name = "--filters") {
  const std::size_t colon = text.find(':');
  if (text.substr(0, colon) != kIdentifiers) return std::nullopt;
  render::IdentifierTest test;
  std::string_view rest = colon == std::string::npos ? "" : std::string_view(text).substr(colon + 1);
  bool known = colon == std::string::npos || !rest.empty();
  while (known && !rest.empty()) {
    constexpr std::string_view kNeighbours = "neighbours=";
    const std::string_view option = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(option.size() + 1, rest.size()));
    const int count = option.size() == kNeighbours.size() + 1 ? option.back() - '0' : -1;
    if (option == "of=instance" || option == "of=triangle")
      test.of = option == "of=triangle" ? render::IdentifierOf::triangle : render::IdentifierOf::instance;
    else if (option.starts_with(kNeighbours) && count >= 0 && count <= render::kMaxIdentifierNeighbours)
      test.neighbours = count;
    else
      known = false;
  }
  if (!known)
    throw std::runtime_error(
        std::string(option_name) + " " + text +
        ": wants identifiers, with of=instance or of=triangle and neighbours=N, N from 0 to " +
        std::to_string(render::kMaxIdentifierNeighbours));
  return test;
}

/// What shadows go by in place of depths, by identifier_index(): nothing, or an IdentifierOf.
[[nodiscard]] inline std::vector<std::string> identifier_names() {
  return {"off", "instance", "triangle"};
}
[[nodiscard]] inline std::size_t identifier_index(
    const std::optional<render::IdentifierTest>& test) noexcept {
  return test ? 1 + static_cast<std::size_t>(test->of) : 0;
}
/// The test of a name's index.
[[nodiscard]] inline std::optional<render::IdentifierTest> identifier_test(std::size_t index,
                                                                           int neighbours) {
  if (index == 0) return std::nullopt;
  return render::IdentifierTest{static_cast<render::IdentifierOf>(index - 1), neighbours};
}

/// The word that identifier_test() reads back to the same test.
[[nodiscard]] inline std::string to_string(const render::IdentifierTest& test) {
  std::string text(kIdentifiers);
  if (test.of == render::IdentifierOf::triangle) text += ":of=triangle";
  if (test.neighbours > 0)
    text += (test.of == render::IdentifierOf::triangle ? ",neighbours=" : ":neighbours=") +
            std::to_string(test.neighbours);
  return text;
}

}  // namespace gnomon::tool
