// Are two bodies the same to the last bit?
#pragma once

#include <string>

#include "gnomon/extend/body.hpp"

namespace gnomon::test {

/// What differs first; empty where both bodies have the same vertices, edges and faces.
[[nodiscard]] inline std::string difference(const Polytope& a, const Polytope& b) {
  if (a.empty() && b.empty()) return "";
  if (a.vertex_count != b.vertex_count || a.face_count != b.face_count) return "counts";
  for (std::size_t i = 0; i < a.vertices().size(); ++i) {
    if (a.vertex[i].position != b.vertex[i].position) return "position";
    if (a.vertex[i].neighbour != b.vertex[i].neighbour || a.vertex[i].face != b.vertex[i].face)
      return "edges";
  }
  for (std::size_t f = 0; f < static_cast<std::size_t>(a.face_count); ++f) {
    if (a.plane[f].normal != b.plane[f].normal || a.plane[f].offset != b.plane[f].offset) return "planes";
  }
  return "";
}

}  // namespace gnomon::test
