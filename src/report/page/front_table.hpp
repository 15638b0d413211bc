// Each scene's front as a table in Markdown: for READMEs and notes.
#pragma once

#include <string>

#include "summary.hpp"

namespace gnomon::report {

/// All scenes together first, then each: the techniques that no other beats in wrong pixels and total time,
/// by rising time, and behind them the best of every filter that is not on the front.
[[nodiscard]] std::string front_tables(const Summary& summary);

}  // namespace gnomon::report
