// Random cases over the whole domain of legal input, as the text of case files.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>

namespace gnomon::stress {

/// Case number `number` of `seed`: every kind of camera, light, box and option that the case format knows.
/// Units from 1e-9 to 1e9, up to 1e12 from the origin, depth ratios and light ranges over 12 decades. Drawn
/// as JSON, so that a case that fails is its own file, to the last bit. The same on every compiler and C
/// library.
[[nodiscard]] nlohmann::ordered_json draw_case(std::uint64_t seed, std::uint64_t number);

}  // namespace gnomon::stress
