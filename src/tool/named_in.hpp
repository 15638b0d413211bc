// A light or a camera of a scene's file, by its name or its number.
#pragma once

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "command.hpp"

namespace gnomon::tool {

/// Throws std::runtime_error "OPTION WORD: ..." where the file has none, or none of that name or number.
template <class Entry>
[[nodiscard]] const Entry& named_in(const std::vector<Entry>& entries, const std::string& word,
                                    std::string_view option, std::string_view kind) {
  const auto named =
      std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) { return entry.name == word; });
  if (named != entries.end()) return *named;
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error == std::errc{} && end == word.data() + word.size() && number < entries.size())
    return entries[number];
  if (entries.empty())
    throw std::runtime_error(std::string(option) + " " + word + ": the file has no " + std::string(kind));
  std::vector<std::string> names;
  for (const Entry& entry : entries) names.push_back(entry.name);
  refuse_name(option, word, names);
}

}  // namespace gnomon::tool
