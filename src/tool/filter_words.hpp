// A filter on a command line: NAME or NAME:OPTION=VALUE,...
#pragma once

#include <stdexcept>
#include <string>

#include "command.hpp"
#include "gnomon/render/filter.hpp"

namespace gnomon::tool {

/// The settings of `word`. Throws std::runtime_error with `option` in front, and with the name that may have
/// been meant.
[[nodiscard]] inline render::FilterSettings filter_word(const std::string& option, const std::string& word) {
  const render::ParsedFilter parsed = render::parse_filter(word);
  if (parsed.error.empty()) return parsed.settings;
  const std::string name = word.substr(0, word.find(':'));
  const bool known = render::find_filter(name) != nullptr;
  throw std::runtime_error(option + " " + parsed.error +
                           (known ? std::string() : meant(name, names_in(render::all_filters()))));
}

}  // namespace gnomon::tool
