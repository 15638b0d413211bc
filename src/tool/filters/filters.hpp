// `gnomon filters`: what filters there are, what they cost, and what they do to the papers' scenes.
#pragma once

#include <string>
#include <vector>

#include "gnomon/render/context.hpp"
#include "gnomon/render/filter.hpp"

namespace gnomon::tool {

struct FiltersRequest {
  std::string name;  ///< the one filter to describe; empty: all are listed
  bool cost = false;
  bool contacts = false;
  bool json = false;
  std::string fit;                              ///< scene whose maps say what each filter needs; empty: none
  double fit_bound = 0.5;                       ///< by how much answers may differ, in steps of 8 bits
  double fit_exceptions = 0.0;                  ///< percent of the receivers that may differ by more
  std::string gallery;                          ///< folder for the pictures; empty: none
  std::vector<render::FilterSettings> filters;  ///< of the tables
  bool filters_given = false;
  std::vector<int> map_sizes{512, 1024, 2048};  ///< likewise
  int rounds = 3;                               ///< likewise
  std::string scene = "builtin:fence";          ///< likewise, and of the gallery's last strip
  render::ContextKind context = render::ContextKind::automatic;
};

/// Prints a row for every filter that stores anything: what the maps of request.fit let it do without.
void print_filter_needs(const FiltersRequest& request);
/// Prints a row for every filter, blur and map size, each against `hard` in the same interleaved rounds.
void print_filter_cost(const FiltersRequest& request);
/// Prints a row for every filter and format: the visibility left close behind a flat occluder.
void print_filter_contacts(const FiltersRequest& request);
/// Writes the papers' figures as strips in PNG, and their numbers as gallery.md; all filters on `scene` at
/// the end.
void write_filter_gallery(const std::string& folder, const std::string& scene);

}  // namespace gnomon::tool
