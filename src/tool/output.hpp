// Standard output as a file that can fail: a plan that did not arrive must not look like success.
#pragma once

#include <string_view>

namespace gnomon::tool {

/// Writes `text` and a newline. Throws std::runtime_error where the reader is gone or the disk is full.
void print_line(std::string_view text);
/// Hands everything written so far to the system; throws like print_line().
void flush_output();

}  // namespace gnomon::tool
