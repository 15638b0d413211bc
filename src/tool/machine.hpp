// On what, and with which version of this program, something was measured.
#pragma once

#include <string>
#include <vector>

#include "gnomon/render/context.hpp"
#include "gnomon/report/row.hpp"

namespace gnomon::tool {

/// `context` is the one that draws. The load is left to current_load().
[[nodiscard]] report::Machine machine(const render::ContextInfo& context);
/// Processes that ran or wanted to, averaged over the last minute; 0 where the system does not say.
[[nodiscard]] double current_load() noexcept;
/// The processor's vector units that planning has loops for, the one that it takes first; empty on other processors.
[[nodiscard]] std::vector<std::string> vector_units();
/// The program's version, with what git said of the sources when it was built.
[[nodiscard]] const char* build_version() noexcept;

}  // namespace gnomon::tool
