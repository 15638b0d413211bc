// `gnomon filters`: what filters there are, what they cost, and what they do to the papers' scenes.
#pragma once

#include <string>
#include <vector>

namespace gnomon::tool {

struct FiltersRequest {
  bool cost = false;
  bool json = false;
  std::string gallery;                          ///< folder for the pictures; empty: none
  std::vector<std::string> filters{"all"};      ///< of the cost table
  std::vector<int> map_sizes{512, 1024, 2048};  ///< likewise
  int rounds = 3;                               ///< likewise
  std::string scene = "builtin:fence";          ///< likewise, and of the gallery's last strip
  std::string context = "auto";
};

/// Prints the list, or the cost table in Markdown, or writes the gallery. Throws std::runtime_error.
int run_filters(const FiltersRequest& request);

/// Prints a row for every filter, blur and map size, each against `hard` in the same interleaved rounds.
void print_filter_cost(const FiltersRequest& request);
/// Writes the papers' figures as strips in PNG, and their numbers as gallery.md; all filters on `scene` at
/// the end.
void write_filter_gallery(const std::string& folder, const std::string& scene);

}  // namespace gnomon::tool
