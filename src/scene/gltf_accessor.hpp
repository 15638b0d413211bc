// What numbers does an accessor stand for? Any component type, stride, normalization and sparse override,
// with every offset checked before a byte is read.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace gnomon::detail {

/// Throws Refusal with the place of a component type or element type that glTF does not have. tinygltf would
/// name no place.
void check_accessors(const nlohmann::json& document);

/// The accessor's elements as `components` floats each, normalized integers expanded. An accessor with no
/// buffer view is zeros. Throws Refusal where its data is out of range, its type another or its count above
/// `max_count`; LeftOut where its buffer has no data.
[[nodiscard]] std::vector<float> read_floats(const tinygltf::Model& model, int accessor, int components,
                                             std::uint64_t max_count);

/// The accessor's elements as `components` unsigned integers each (indices, joints).
[[nodiscard]] std::vector<std::uint32_t> read_integers(const tinygltf::Model& model, int accessor,
                                                       int components, std::uint64_t max_count);

}  // namespace gnomon::detail
