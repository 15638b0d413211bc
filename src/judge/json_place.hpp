// On which line of JSON text is the value that a path names?
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace gnomon::judge {

/// Line of the value at a path as "maps[1].width", from 1, in text that is JSON; of the deepest part of the
/// path that is there. `found`: how many steps of the path that is.
[[nodiscard]] std::size_t line_of(std::string_view text, std::string_view path, std::size_t& found);

}  // namespace gnomon::judge
