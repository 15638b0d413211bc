// What does a scene file hold: JSON text and, for GLB, a binary chunk? Told by its bytes, not by its name.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace gnomon::detail {

struct Container {
  std::string_view json;
  std::span<const std::uint8_t> bin;
  bool has_bin = false;
};

/// Finds the chunks of a GLB; anything else is taken to be JSON as a whole. Throws Refusal. The result refers
/// into `bytes`.
[[nodiscard]] Container open_container(std::span<const std::uint8_t> bytes);

/// Refuses JSON whose nesting or number of values would exhaust a parser's stack or memory. A linear scan
/// that needs no valid JSON.
void check_json_size(std::string_view json);

}  // namespace gnomon::detail
