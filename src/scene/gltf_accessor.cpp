// What numbers does an accessor stand for? Any component type, stride, normalization and sparse override,
// with every offset checked before a byte is read. Based on: Khronos Group, glTF 2.0 Specification (2021),
// section 3.6.2 "Accessors".
#include "gltf_accessor.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "gltf_document.hpp"
#include "refusal.hpp"

namespace gnomon::detail {

namespace {

using Span = std::span<const std::uint8_t>;

std::size_t component_bytes(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

int component_count(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
      return 4;
    case TINYGLTF_TYPE_MAT4:
      return 16;
    default:
      return 0;
  }
}

// `count` elements of `size` bytes, `stride` apart: in range, proven without a product that could overflow.
void check_range(const std::string& where, std::size_t available, std::size_t offset, std::size_t size,
                 std::size_t stride, std::uint64_t count) {
  if (count == 0) return;
  if (offset > available || size > available - offset || (count - 1) > (available - offset - size) / stride) {
    throw Refusal(where, std::to_string(count) + " elements do not fit the " + std::to_string(available) +
                             " bytes of the buffer view");
  }
}

template <class From>
From load(const std::uint8_t* bytes) {
  From value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

// Section 3.6.2.2 and 3.11: c / max, and for signed types never below -1.
template <class To, class From>
To convert(From value, bool normalized) {
  if constexpr (std::is_floating_point_v<To> && std::is_integral_v<From>) {
    if (normalized) {
      const float scaled = static_cast<float>(value) / static_cast<float>(std::numeric_limits<From>::max());
      return std::max(scaled, -1.0f);
    }
  }
  return static_cast<To>(value);
}

template <class To, class From>
void copy_element(const std::uint8_t* from, To* to, int components, bool normalized) {
  for (int c = 0; c < components; ++c) {
    to[c] = convert<To>(load<From>(from + static_cast<std::size_t>(c) * sizeof(From)), normalized);
  }
}

template <class To>
using Copier = void (*)(const std::uint8_t*, To*, int, bool);

template <class To>
Copier<To> copier(int component_type) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return copy_element<To, std::int8_t>;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return copy_element<To, std::uint8_t>;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return copy_element<To, std::int16_t>;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return copy_element<To, std::uint16_t>;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return copy_element<To, std::uint32_t>;
    default:
      return copy_element<To, float>;
  }
}

bool is_unsigned(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

template <class To>
void apply_sparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor, const std::string& where,
                  std::size_t size, int components, std::vector<To>& values) {
  const auto& sparse = accessor.sparse;
  const std::size_t index_size = component_bytes(sparse.indices.componentType);
  if (!is_unsigned(sparse.indices.componentType))
    throw Refusal(where + ".sparse.indices", "wrong component type");
  const auto count = static_cast<std::uint64_t>(sparse.count);
  if (count > accessor.count) throw Refusal(where + ".sparse", "overrides more elements than there are");
  const Span indices = view_bytes(model, sparse.indices.bufferView);
  const Span overrides = view_bytes(model, sparse.values.bufferView);
  const auto index_offset = static_cast<std::size_t>(sparse.indices.byteOffset);
  const auto value_offset = static_cast<std::size_t>(sparse.values.byteOffset);
  check_range(where + ".sparse.indices", indices.size(), index_offset, index_size, index_size, count);
  check_range(where + ".sparse.values", overrides.size(), value_offset, size, size, count);
  const Copier<std::uint32_t> copy_index = copier<std::uint32_t>(sparse.indices.componentType);
  const Copier<To> copy_value = copier<To>(accessor.componentType);
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t at = 0;
    copy_index(indices.data() + index_offset + i * index_size, &at, 1, false);
    if (at >= accessor.count)
      throw Refusal(where + ".sparse.indices", std::to_string(at) + " is out of range");
    copy_value(overrides.data() + value_offset + i * size, &values[at * static_cast<std::size_t>(components)],
               components, accessor.normalized);
  }
}

template <class To>
std::vector<To> read(const tinygltf::Model& model, int index, int components, std::uint64_t max_count) {
  const std::string where = element("accessors", static_cast<std::size_t>(index));
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  if (component_count(accessor.type) != components) {
    throw Refusal(where, "has the wrong type, " + std::to_string(components) + " components are needed");
  }
  const std::size_t bytes = component_bytes(accessor.componentType);
  if (bytes == 0) {
    throw Refusal(where, "component type " + std::to_string(accessor.componentType) + " is not allowed");
  }
  if constexpr (std::is_integral_v<To>) {
    if (!is_unsigned(accessor.componentType)) throw Refusal(where, "must be of unsigned integers");
  }
  if (accessor.count > max_count) {
    throw Refusal(where, std::to_string(accessor.count) + " elements, more than the limit of " +
                             std::to_string(max_count));
  }
  const std::size_t size = bytes * static_cast<std::size_t>(components);
  std::vector<To> values;
  if (accessor.bufferView >= 0) {
    const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
    const Span source = view_bytes(model, accessor.bufferView);
    const std::size_t stride = view.byteStride == 0 ? size : view.byteStride;
    if (stride < size) throw Refusal(where, "elements of " + std::to_string(size) + " bytes overlap");
    check_range(where, source.size(), accessor.byteOffset, size, stride, accessor.count);
    values.resize(accessor.count * static_cast<std::size_t>(components));
    const Copier<To> copy = copier<To>(accessor.componentType);
    for (std::size_t i = 0; i < accessor.count; ++i) {
      copy(source.data() + accessor.byteOffset + i * stride,
           &values[i * static_cast<std::size_t>(components)], components, accessor.normalized);
    }
  } else {
    values.resize(accessor.count * static_cast<std::size_t>(components));
  }
  if (accessor.sparse.isSparse) apply_sparse(model, accessor, where, size, components, values);
  return values;
}

}  // namespace

void check_accessors(const nlohmann::json& document) {
  const auto accessors = document.find("accessors");
  for (std::size_t i = 0; accessors != document.end() && i < accessors->size(); ++i) {
    const auto component = (*accessors)[i]["componentType"].get<std::uint32_t>();
    const auto& shape = (*accessors)[i]["type"].get_ref<const std::string&>();
    if (tinygltf::GetComponentSizeInBytes(component) <= 0)
      throw Refusal(element("accessors", i) + ".componentType",
                    std::to_string(component) + " is none of 5120, 5121, 5122, 5123, 5125 and 5126");
    constexpr std::array<std::string_view, 7> kShapes{"SCALAR", "VEC2", "VEC3", "VEC4",
                                                      "MAT2",   "MAT3", "MAT4"};
    if (std::find(kShapes.begin(), kShapes.end(), shape) == kShapes.end())
      throw Refusal(element("accessors", i) + ".type",
                    "'" + one_line(shape) + "' is none of SCALAR, VEC2 to VEC4 and MAT2 to MAT4");
  }
}

std::vector<float> read_floats(const tinygltf::Model& model, int accessor, int components,
                               std::uint64_t max_count) {
  return read<float>(model, accessor, components, max_count);
}

std::vector<std::uint32_t> read_integers(const tinygltf::Model& model, int accessor, int components,
                                         std::uint64_t max_count) {
  return read<std::uint32_t>(model, accessor, components, max_count);
}

}  // namespace gnomon::detail
