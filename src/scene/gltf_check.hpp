// Is a glTF document's JSON well formed? Every field this library reads is checked for type and range before
// tinygltf sees it, and every other field is dropped.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::detail {

/// The document with only the fields that are read, each of the right type, indices in range, numbers finite
/// and lists of the right length. `images`, `buffers` and extensions are not in it. Throws Refusal.
[[nodiscard]] nlohmann::json checked_document(const nlohmann::json& source);

/// The same for one array of `source`, such as "buffers" or "images".
[[nodiscard]] nlohmann::json checked_array(const nlohmann::json& source, const char* name);

/// The extension of a buffer view or a primitive, checked like the document; null where it has none. Throws
/// Refusal.
[[nodiscard]] nlohmann::json checked_meshopt(const nlohmann::json& source, const nlohmann::json& view,
                                             const std::string& where);
[[nodiscard]] nlohmann::json checked_draco(const nlohmann::json& source, const nlohmann::json& primitive,
                                           const std::string& where);

/// A node's instances, the same way.
[[nodiscard]] nlohmann::json checked_instancing(const nlohmann::json& source, const nlohmann::json& node,
                                                const std::string& where);

/// An animation, a primitive's morph targets and a mesh's or a node's weights, checked like the document.
/// Throw Refusal.
[[nodiscard]] nlohmann::json checked_animation(const nlohmann::json& source, const nlohmann::json& animation,
                                               const std::string& where);
[[nodiscard]] nlohmann::json checked_morph_targets(const nlohmann::json& source,
                                                   const nlohmann::json& primitive, const std::string& where);
[[nodiscard]] std::vector<float> checked_weights(const nlohmann::json& owner, const std::string& where);

/// Whether this build decodes the data of this extension.
[[nodiscard]] bool decodes(std::string_view extension) noexcept;

/// Whether what the extension says is read, or is nothing that shadows depend on.
[[nodiscard]] bool is_supported(std::string_view extension);
/// Stops with the name of the first extension in extensionsRequired that is not supported.
void check_extensions(const nlohmann::json& source);

/// What to do about an extension that is not supported; empty: nothing is known.
[[nodiscard]] std::string remedy_for(std::string_view extension);

/// source[key] where that is an object, else nothing.
[[nodiscard]] const nlohmann::json* find_object(const nlohmann::json& source, const char* key);
/// The extension `name` of the document or one of its parts; nothing where it has none that is an object.
[[nodiscard]] const nlohmann::json* find_extension(const nlohmann::json& owner, const char* name);
/// The same, with a warning where it is no object. `where`: place of the owner; empty: the document.
[[nodiscard]] const nlohmann::json* find_extension(const nlohmann::json& owner, const char* name,
                                                   const std::string& where,
                                                   std::vector<std::string>& warnings);

}  // namespace gnomon::detail
