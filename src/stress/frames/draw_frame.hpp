// Random frames: a scene, a view of it, a light, and a way to draw it, as JSON.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>

namespace gnomon::stress {

/// Frame number `number` of `seed`: a case (draw_case()) whose boxes are objects of a scene, and "frame" with
/// the source of shadows, the filter and what the renderer is asked for. Every word that is not there has its
/// default, so that a frame that fails is its own file.
[[nodiscard]] nlohmann::ordered_json draw_frame(std::uint64_t seed, std::uint64_t number);

}  // namespace gnomon::stress
