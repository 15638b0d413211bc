// How an option appears in texts: the word that stands for its value, its range and its default.
#pragma once

#include <string>
#include <string_view>

#include "command.hpp"

namespace gnomon::tool {

/// In capitals.
[[nodiscard]] std::string upper(std::string text);
/// The shortest decimal form, without trailing zeros.
[[nodiscard]] std::string number_word(double value);
/// "NAME", "FILE", "DIR", "N" or "TEXT"; empty for a flag.
[[nodiscard]] std::string value_word(const Option& option);
/// The value that an option has when it is not given; empty where there is none.
[[nodiscard]] std::string default_word(const Option& option);
/// "a, b or c": the values that an option takes, where neither its help nor the footer has all of them.
[[nodiscard]] std::string values_word(const Option& option, std::string_view footer);
/// True where the option takes several words.
[[nodiscard]] bool takes_list(const Option& option);
[[nodiscard]] bool is_positional(const Option& option);
/// The positional's word in a synopsis: "[SCENE]", "CASE...".
[[nodiscard]] std::string positional_word(const Option& option);

}  // namespace gnomon::tool
