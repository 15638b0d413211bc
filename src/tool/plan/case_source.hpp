// Where cases come from: files, and the lines of standard input.
#pragma once

#include <functional>
#include <string>

#include "gnomon/casefile/casefile.hpp"

namespace gnomon::tool {

/// Receives a case and the name it has in messages ("a.json", or "-:3" for the third line of standard input).
using CaseHandler = std::function<void(const Case&, const std::string& name)>;

/// Hands on the case of the file `name`, or, for "-", one case per line of standard input as each line
/// arrives; blank lines are passed over. Throws CaseError with the name in front.
void for_each_case(const std::string& name, const CaseHandler& handle);

}  // namespace gnomon::tool
