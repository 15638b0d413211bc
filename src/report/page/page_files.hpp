// Style and script of the report, as they stand in src/report/page/.
#pragma once

#include <string_view>

namespace gnomon::report {

[[nodiscard]] std::string_view page_style() noexcept;
[[nodiscard]] std::string_view page_script() noexcept;

}  // namespace gnomon::report
