// A glTF file opened and checked, before any triangle is made of it: structure, bytes of its buffers, its
// pictures. tinygltf 2.7 is given neither files nor buffers nor images: it dereferences unchecked offsets
// into them and follows any path. It gets a document that holds only checked fields, and its file access is
// closed.
#include "gltf_document.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "base/json_words.hpp"
#include "glb.hpp"
#include "gltf_accessor.hpp"
#include "gltf_check.hpp"
#include "gltf_compression.hpp"
#include "refusal.hpp"

namespace gnomon::detail {

using nlohmann::json;

namespace {

constexpr std::uint64_t kStrideUnit = 4, kMaxStride = 252;  // bytes; glTF 2.0, section 5.11.4

json parse_json(std::string_view text) {
  check_json_size(text);
  try {
    return json::parse(text);
  } catch (const json::exception& e) {
    throw Refusal("JSON", one_line(json_words(e.what())));
  }
}

// How often each extension stands anywhere in the document.
std::map<std::string, std::size_t> extension_uses(const json& source) {
  std::map<std::string, std::size_t> uses;
  std::vector<const json*> open{&source};
  while (!open.empty()) {
    const json& value = *open.back();
    open.pop_back();
    if (const json* extensions = find_object(value, "extensions"))
      for (const auto& [name, of] : extensions->items()) ++uses[name];
    if (!value.is_structured()) continue;
    for (const json& inner : value) open.push_back(&inner);
  }
  return uses;
}

// Extensions that a file uses without requiring, and that are not read: one line each.
void warn_of_extensions(const json& source, std::vector<std::string>& warnings) {
  const auto used = source.find("extensionsUsed");
  if (used == source.end() || !used->is_array()) return;
  const std::map<std::string, std::size_t> uses = extension_uses(source);
  for (const auto& [name, count] : uses) {
    if (std::find(used->begin(), used->end(), name) == used->end() || is_supported(name)) continue;
    const std::string remedy = remedy_for(name);
    warn(warnings, "extensionsUsed",
         one_line(name) + " is not supported, " +
             (remedy.empty() ? "what it says does not count" : "fallbacks are used") + " (" +
             std::to_string(count) + (count == 1 ? " place)" : " places)") +
             (remedy.empty() ? "" : ": " + remedy));
  }
}

std::vector<Bytes> load_buffers(const json& source, const json& buffers, const Container& container,
                                SceneFolder& folder, std::vector<std::string>& warnings) {
  std::vector<Bytes> out;
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const json& buffer = buffers[i];
    const auto length = buffer["byteLength"].get<std::uint64_t>();
    Bytes bytes;
    if (buffer.contains("uri")) {
      try {
        bytes = folder.read(buffer["uri"].get_ref<const std::string&>());
      } catch (const std::runtime_error& e) {
        throw Refusal(element("buffers", i), e.what());
      }
    } else if (i == 0 && container.has_bin) {
      bytes.assign(container.bin.begin(), container.bin.end());
    } else {
      // A buffer that only stands in for compressed views holds nothing to miss.
      const json* extensions = find_object(source["buffers"][i], "extensions");
      const bool stand_in = extensions != nullptr && extensions->contains("EXT_meshopt_compression");
      if (!stand_in || !decodes_meshopt()) warn(warnings, element("buffers", i), "has no data");
      out.emplace_back();
      continue;
    }
    if (bytes.size() < length) {
      throw Refusal(element("buffers", i), "has " + std::to_string(bytes.size()) +
                                               " bytes, byteLength says " + std::to_string(length));
    }
    bytes.resize(static_cast<std::size_t>(length));
    out.push_back(std::move(bytes));
  }
  return out;
}

void check_views(const json& document, const json& buffers) {
  const auto views = document.find("bufferViews");
  if (views == document.end()) return;
  for (std::size_t i = 0; i < views->size(); ++i) {
    const json& view = (*views)[i];
    const auto total = buffers[view["buffer"].get<std::size_t>()]["byteLength"].get<std::uint64_t>();
    const auto offset = view.value("byteOffset", std::uint64_t{0});
    const auto length = view["byteLength"].get<std::uint64_t>();
    if (offset > total || length > total - offset) {
      throw Refusal(element("bufferViews", i), "bytes " + std::to_string(offset) + " + " +
                                                   std::to_string(length) + " lie beyond the buffer's " +
                                                   std::to_string(total));
    }
    const auto stride = view.value("byteStride", std::uint64_t{0});  // 0, as some write it, means none
    if (stride > kMaxStride || stride % kStrideUnit != 0) {
      throw Refusal(element("bufferViews", i),
                    "byteStride " + std::to_string(stride) + " is not one of 4, 8 ... 252");
    }
  }
}

std::vector<ImageSource> list_images(const json& source) {
  const json images = checked_array(source, "images");
  std::vector<ImageSource> out;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const json& image = images[i];
    out.push_back({image.value("name", std::string()), image.value("uri", std::string()),
                   image.value("bufferView", -1)});
    if (out.back().name.empty()) out.back().name = element("images", i);
  }
  return out;
}

std::optional<TextureTransform> texture_transform(const json& texture_info, const std::string& of,
                                                  std::vector<std::string>& warnings) {
  constexpr const char* kName = "KHR_texture_transform";
  const json* found = find_extension(texture_info, kName, of, warnings);
  if (found == nullptr) return std::nullopt;
  const std::string where = of + "." + kName;
  TextureTransform out;
  // Each field by itself, where it is what it should be.
  const auto take = [&](const char* key, const char* what, const auto& is_right, const auto& set) {
    const auto field = found->find(key);
    if (field == found->end()) return;
    if (is_right(*field))
      set(*field);
    else
      warn(warnings, where + "." + key, std::string("is not ") + what + ", and does not count");
  };
  const auto is_number = [](const json& value) { return value.is_number(); };
  const auto is_pair = [](const json& value) {
    return value.is_array() && value.size() == 2 && value[0].is_number() && value[1].is_number();
  };
  const auto is_set = [](const json& value) {
    return value.is_number_unsigned() && value.get<std::uint64_t>() <= UINT16_MAX;
  };
  take("offset", "two numbers", is_pair, [&](const json& value) { value.get_to(out.offset); });
  take("scale", "two numbers", is_pair, [&](const json& value) { value.get_to(out.scale); });
  take("rotation", "a number", is_number, [&](const json& value) { value.get_to(out.rotation); });
  take("texCoord", "a number of texture coordinates", is_set,
       [&](const json& value) { value.get_to(out.texcoord); });
  return out;
}

// A specular-glossiness material has its colour in an extension only; it is read as the usual kind.
void adopt_specular_glossiness(json& source) {
  const auto materials = source.find("materials");
  if (materials == source.end() || !materials->is_array()) return;
  for (json& material : *materials) {
    const json* found = find_extension(material, "KHR_materials_pbrSpecularGlossiness");
    if (found == nullptr || material.contains("pbrMetallicRoughness")) continue;
    json told = json::object();
    if (found->contains("diffuseFactor")) told["baseColorFactor"] = found->at("diffuseFactor");
    if (found->contains("diffuseTexture")) told["baseColorTexture"] = found->at("diffuseTexture");
    material["pbrMetallicRoughness"] = std::move(told);
  }
}

// A texture may name a picture in WebP beside one in PNG or JPEG.
void adopt_webp(json& source) {
  const auto textures = source.find("textures");
  if (textures == source.end() || !textures->is_array()) return;
  for (json& texture : *textures) {
    const json* found = find_extension(texture, "EXT_texture_webp");
    if (found == nullptr || !found->contains("source")) continue;
    json picture = found->at("source");
    texture["source"] = std::move(picture);
  }
}

std::vector<std::optional<TextureTransform>> list_transforms(const json& source,
                                                             std::vector<std::string>& warnings) {
  std::vector<std::optional<TextureTransform>> out;
  const auto materials = source.find("materials");
  if (materials == source.end()) return out;
  for (const json& material : *materials) {
    const json* base = find_object(material, "pbrMetallicRoughness");
    const json* texture = base == nullptr ? nullptr : find_object(*base, "baseColorTexture");
    out.push_back(texture == nullptr ? std::nullopt
                                     : texture_transform(*texture,
                                                         element("materials", out.size()) +
                                                             ".pbrMetallicRoughness.baseColorTexture",
                                                         warnings));
  }
  return out;
}

/// The factor of KHR_materials_transmission; a broken one counts as none.
float transmission(const json& material, const std::string& where, std::vector<std::string>& warnings) {
  const json* found = find_extension(material, "KHR_materials_transmission", where, warnings);
  if (found == nullptr) return 0.0f;
  if (found->contains("transmissionTexture"))
    warn(warnings, where, "its transmission's picture is not read; the factor holds everywhere");
  const auto factor = found->find("transmissionFactor");
  if (factor == found->end()) return 0.0f;
  if (factor->is_number() && factor->get<double>() >= 0.0 && factor->get<double>() <= 1.0)
    return factor->get<float>();
  warn(warnings, where, "transmissionFactor is not a number from 0 to 1; nothing shines through");
  return 0.0f;
}

std::vector<float> list_transmissions(const json& source, std::vector<std::string>& warnings) {
  std::vector<float> out;
  const auto materials = source.find("materials");
  if (materials == source.end()) return out;
  for (const json& material : *materials)
    out.push_back(transmission(material, element("materials", out.size()), warnings));
  return out;
}

bool has_data(const json& accessor) {
  return accessor.contains("bufferView") || accessor.contains("sparse");
}

// tinygltf refuses index accessors without a buffer view, which are legal when sparse: they are kept beside
// it.
void take_indices(json& document, const json& source, Document& out) {
  const auto meshes = document.find("meshes");
  if (meshes == document.end()) return;
  for (std::size_t m = 0; m < meshes->size(); ++m) {
    out.indices.emplace_back();
    out.compressed.emplace_back();
    json& primitives = (*meshes)[m]["primitives"];
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      json& primitive = primitives[p];
      out.indices.back().push_back(primitive.value("indices", -1));
      primitive.erase("indices");
      const json* extensions = find_object(source["meshes"][m]["primitives"][p], "extensions");
      const bool draco = extensions != nullptr && extensions->contains("KHR_draco_mesh_compression");
      const auto position = primitive["attributes"].find("POSITION");
      out.compressed.back().push_back(draco && !decodes_draco() &&
                                      position != primitive["attributes"].end() &&
                                      !has_data(document["accessors"][position->get<std::size_t>()]));
    }
  }
}

// The callbacks of a tinygltf that may touch nothing.
bool no_file_exists(const std::string&, void*) {
  return false;
}
std::string no_expansion(const std::string& path, void*) {
  return path;
}
bool no_reading(std::vector<unsigned char>*, std::string*, const std::string&, void*) {
  return false;
}
bool no_writing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
  return false;
}
bool no_decoding(tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int,
                 void*) {
  return false;
}

void build_model(const json& document, tinygltf::Model& model) {
  const std::string text = document.dump();
  if (text.size() > std::numeric_limits<unsigned int>::max()) throw Refusal("JSON", "is larger than 4 GiB");
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks({no_file_exists, no_expansion, no_reading, no_writing, nullptr});
  loader.SetImageLoader(no_decoding, nullptr);
  std::string error, warning;
  if (!loader.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                  static_cast<unsigned int>(text.size()), "")) {
    throw Refusal("glTF", one_line(error.empty() ? "is not valid" : error));
  }
}

}  // namespace

Document open_document(std::span<const std::uint8_t> bytes, SceneFolder& folder, const LoadLimits& limits,
                       std::vector<std::string>& warnings) {
  const Container container = open_container(bytes);
  json source = parse_json(container.json);
  check_extensions(source);
  if (source.is_object()) adopt_specular_glossiness(source);
  if (source.is_object() && decodes("EXT_texture_webp")) adopt_webp(source);
  json document = checked_document(source);
  check_accessors(document);
  if (document.contains("nodes") && document["nodes"].size() > limits.nodes) {
    throw Refusal("nodes", "there are more than " + std::to_string(limits.nodes));
  }
  warn_of_extensions(source, warnings);

  Document out;
  const json buffers = checked_array(source, "buffers");
  check_views(document, buffers);
  std::vector<Bytes> data = load_buffers(source, buffers, container, folder, warnings);
  Compressed compressed{source, document, data, limits, limits.total_bytes};
  decode_meshopt_views(compressed);
  decode_draco_primitives(compressed);
  out.images = list_images(source);
  out.transforms = list_transforms(source, warnings);
  out.transmissions = list_transmissions(source, warnings);
  out.motion = read_motion_source(source, warnings);
  out.placement = read_placement_source(source, warnings);
  out.views = read_view_source(source, warnings);
  take_indices(document, source, out);
  build_model(document, out.model);
  for (Bytes& bytes_of_buffer : data) {
    out.model.buffers.emplace_back();
    out.model.buffers.back().data = std::move(bytes_of_buffer);
  }
  // tinygltf drops what it cannot parse without a word; the tables beside the model count on nothing being
  // dropped.
  bool whole = out.model.meshes.size() == out.indices.size();
  for (std::size_t m = 0; whole && m < out.indices.size(); ++m) {
    whole = out.model.meshes[m].primitives.size() == out.indices[m].size();
  }
  if (!whole) throw Refusal("meshes", "could not be read");
  return out;
}

std::span<const std::uint8_t> view_bytes(const tinygltf::Model& model, int buffer_view) {
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(buffer_view)];
  const auto& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
  if (data.empty()) throw LeftOut(element("buffers", static_cast<std::size_t>(view.buffer)) + " has no data");
  return std::span<const std::uint8_t>(data).subspan(view.byteOffset, view.byteLength);
}

}  // namespace gnomon::detail
