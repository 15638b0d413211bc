// Shadows by identifiers among the filters of a command line: identifiers, with of and neighbours behind it.
#pragma once

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "gnomon/render/renderer.hpp"

namespace gnomon::tool {

/// Word that stands for render::Renderer::prepare_identifiers. Behind it may follow `:of=triangle` and
/// `neighbours=N`, parted by a comma.
inline constexpr std::string_view kIdentifiers = "identifiers";

/// The test that `identifiers:of=triangle,neighbours=1` says; none for other words. Throws std::runtime_error
/// where an option is none.
[[nodiscard]] inline std::optional<render::IdentifierTest> identifier_test(const std::string& text) {
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
    else if (option.starts_with(kNeighbours) && count >= 0 && count <= render::kMostIdentifierNeighbours)
      test.neighbours = count;
    else
      known = false;
  }
  if (!known)
    throw std::runtime_error(
        "--filters " + text +
        ": wants identifiers, with of=instance or of=triangle and neighbours=N, N from 0 to " +
        std::to_string(render::kMostIdentifierNeighbours));
  return test;
}

}  // namespace gnomon::tool
