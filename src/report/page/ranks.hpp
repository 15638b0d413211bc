// Do two errors rank the techniques alike, and what is each of them for?
#pragma once

#include <string>
#include <vector>

#include "summary.hpp"

namespace gnomon::report {

/// The errors that the ranks compare: misclassified pixels, pixel error, twinkling, flicker.
inline constexpr std::string_view kRankedErrors[] = {"wrong", "pixel_error", "twinkle", "flips"};

/// Place of each technique of a scene by an error, 1 for the least; equal errors share the first place of
/// theirs. 0: the technique has none.
[[nodiscard]] std::vector<std::size_t> places_by(const Summary& summary, std::size_t scene,
                                                 std::string_view measure);
/// Spearman's correlation over the techniques that have both; not a number where there are too few.
[[nodiscard]] double rank_agreement(const Summary& summary, std::size_t scene, std::string_view measure,
                                    std::string_view other);

/// Heading, the question of each error, and a table of places per scene; empty where no row has a pixel
/// error.
[[nodiscard]] std::string rank_part(const Summary& summary, std::size_t first_scene);
/// The agreement of a scene as a sentence in Markdown; empty where no row has a pixel error.
[[nodiscard]] std::string rank_line(const Summary& summary, std::size_t scene);

}  // namespace gnomon::report
