// What is left to draw after each rule that leaves something out, scene by scene.
#pragma once

#include <string>
#include <vector>

#include "gnomon/report/row.hpp"

namespace gnomon::report {

/// A table with bars for every scene, as HTML; nothing where no row has a rule's savings.
[[nodiscard]] std::string waterfalls(const std::vector<Row>& rows);

}  // namespace gnomon::report
