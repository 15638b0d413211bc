// Files that are nearly right: one input with a few changes that its format's readers must withstand.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace gnomon::fuzz {

/// `input` with one to four changes. What it is follows from its bytes: GLB (JSON, buffers and chunk headers
/// change), PNG (chunks, with their checksums made right), JPEG (segments), JSON (values, types, keys,
/// nesting) or lines of JSON; anything else changes by bytes. The same seed makes the same changes.
[[nodiscard]] std::string mutated(std::string_view input, std::uint64_t seed);

}  // namespace gnomon::fuzz
