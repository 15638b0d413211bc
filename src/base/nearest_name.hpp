// Which of several names was meant by a word that is none of them?
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon {

/// Edits that turn `a` into `b`: a character added, removed, replaced, or two neighbours exchanged.
/// Based on: Damerau, "A technique for computer detection and correction of spelling errors", 1964.
inline std::size_t edits_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    row[0] = i + 1;
    for (std::size_t k = 0; k < b.size(); ++k) {
      row[k + 1] = std::min({last[k + 1] + 1, row[k] + 1, last[k] + (a[i] == b[k] ? 0 : 1)});
      if (i > 0 && k > 0 && a[i] == b[k - 1] && a[i - 1] == b[k])
        row[k + 1] = std::min(row[k + 1], before_last[k - 1] + 1);
    }
    std::swap(before_last, last);
    std::swap(last, row);
  }
  return last.back();
}

/// The name that is nearest to `word`, a typing mistake or two away; empty where none is.
template <class Names>
[[nodiscard]] std::string nearest_name(std::string_view word, const Names& names) {
  constexpr std::size_t kLongest = 64;  // no name is longer, and what is takes no table of its square
  if (word.size() > kLongest) return {};
  std::string nearest;
  // A third of the letters may be wrong, but not so many that short names all look alike.
  std::size_t fewest = std::clamp<std::size_t>(word.size() / 3, 1, 3) + 1;
  for (const std::string_view name : names) {
    const std::size_t edits = edits_between(word, name);
    if (edits < fewest) {
      fewest = edits;
      nearest = name;
    }
  }
  return nearest;
}

/// "; did you mean 'NAME'?", or nothing where no name is near.
template <class Names>
[[nodiscard]] std::string meant(std::string_view word, const Names& names) {
  const std::string near = nearest_name(word, names);
  return near.empty() ? near : "; did you mean '" + near + "'?";
}

}  // namespace gnomon
