// Is a glTF document's JSON well formed? Every field this library reads is checked for type and range before
// tinygltf sees it, and every other field is dropped.
// Based on: Khronos Group, glTF 2.0 Specification (2021), section 5 "Properties Reference".
#include "gltf_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>

#include "gltf_compression.hpp"
#include "image_formats.hpp"
#include "refusal.hpp"

namespace gnomon::detail {

using nlohmann::json;

namespace {

enum class Kind {
  index,       // into the array named by `target`
  index_list,  // the same, many
  index_map,   // an object whose values are indices
  count_map,   // an object whose values are integers in [0, limit]
  count,       // an integer in [0, limit]
  numbers,     // exactly `limit` finite numbers
  number,
  boolean,
  string,
  object,   // checked by `rules`
  objects,  // a list of them
};

struct Rule {
  const char* key;
  Kind kind;
  const char* target = "";
  std::uint64_t limit = 0;
  std::span<const Rule> rules = {};
  bool required = false;
};

constexpr std::uint64_t kMaxBytes = 1ull << 53;  // integers are exact up to here in every JSON implementation
constexpr std::uint64_t kMaxInt = 0x7fffffff;    // tinygltf reads these into an int

constexpr Rule kBuffer[] = {{"byteLength", Kind::count, "", kMaxBytes, {}, true}, {"uri", Kind::string}};
constexpr Rule kBufferView[] = {{"buffer", Kind::index, "buffers", 0, {}, true},
                                {"byteOffset", Kind::count, "", kMaxBytes},
                                {"byteLength", Kind::count, "", kMaxBytes, {}, true},
                                {"byteStride", Kind::count, "", kMaxInt}};
constexpr Rule kSparseIndices[] = {{"bufferView", Kind::index, "bufferViews", 0, {}, true},
                                   {"byteOffset", Kind::count, "", kMaxInt},
                                   {"componentType", Kind::count, "", kMaxInt, {}, true}};
constexpr Rule kSparseValues[] = {{"bufferView", Kind::index, "bufferViews", 0, {}, true},
                                  {"byteOffset", Kind::count, "", kMaxInt}};
constexpr Rule kSparse[] = {{"count", Kind::count, "", kMaxInt, {}, true},
                            {"indices", Kind::object, "", 0, kSparseIndices, true},
                            {"values", Kind::object, "", 0, kSparseValues, true}};
constexpr Rule kAccessor[] = {{"bufferView", Kind::index, "bufferViews"},
                              {"byteOffset", Kind::count, "", kMaxBytes},
                              {"componentType", Kind::count, "", kMaxInt, {}, true},
                              {"count", Kind::count, "", kMaxBytes, {}, true},
                              {"type", Kind::string, "", 0, {}, true},
                              {"normalized", Kind::boolean},
                              {"sparse", Kind::object, "", 0, kSparse}};
constexpr Rule kImage[] = {
    {"name", Kind::string}, {"uri", Kind::string}, {"bufferView", Kind::index, "bufferViews"}};
constexpr Rule kTexture[] = {{"source", Kind::index, "images"}, {"sampler", Kind::index, "samplers"}};
constexpr Rule kSampler[] = {{"wrapS", Kind::count, "", kMaxInt}, {"wrapT", Kind::count, "", kMaxInt}};
constexpr Rule kTextureInfo[] = {{"index", Kind::index, "textures", 0, {}, true},
                                 {"texCoord", Kind::count, "", kMaxInt}};
constexpr Rule kRoughness[] = {{"baseColorFactor", Kind::numbers, "", 4},
                               {"baseColorTexture", Kind::object, "", 0, kTextureInfo}};
constexpr Rule kMaterial[] = {{"name", Kind::string},
                              {"alphaMode", Kind::string},
                              {"alphaCutoff", Kind::number},
                              {"doubleSided", Kind::boolean},
                              {"pbrMetallicRoughness", Kind::object, "", 0, kRoughness}};
constexpr Rule kPrimitive[] = {{"attributes", Kind::index_map, "accessors", 0, {}, true},
                               {"indices", Kind::index, "accessors"},
                               {"material", Kind::index, "materials"},
                               {"mode", Kind::count, "", 6}};
constexpr Rule kMesh[] = {{"name", Kind::string}, {"primitives", Kind::objects, "", 0, kPrimitive, true}};
constexpr Rule kNode[] = {{"name", Kind::string},
                          {"mesh", Kind::index, "meshes"},
                          {"skin", Kind::index, "skins"},
                          {"children", Kind::index_list, "nodes"},
                          {"matrix", Kind::numbers, "", 16},
                          {"translation", Kind::numbers, "", 3},
                          {"rotation", Kind::numbers, "", 4},
                          {"scale", Kind::numbers, "", 3}};
constexpr Rule kSkin[] = {{"joints", Kind::index_list, "nodes", 0, {}, true},
                          {"inverseBindMatrices", Kind::index, "accessors"}};
constexpr Rule kScene[] = {{"name", Kind::string}, {"nodes", Kind::index_list, "nodes"}};

constexpr Rule kMeshopt[] = {{"buffer", Kind::index, "buffers", 0, {}, true},
                             {"byteOffset", Kind::count, "", kMaxBytes},
                             {"byteLength", Kind::count, "", kMaxBytes, {}, true},
                             {"byteStride", Kind::count, "", kMaxInt, {}, true},
                             {"count", Kind::count, "", kMaxInt, {}, true},
                             {"mode", Kind::string, "", 0, {}, true},
                             {"filter", Kind::string}};
constexpr Rule kDraco[] = {{"bufferView", Kind::index, "bufferViews", 0, {}, true},
                           {"attributes", Kind::count_map, "", kMaxInt, {}, true}};

constexpr Rule kInstancing[] = {{"attributes", Kind::index_map, "accessors", 0, {}, true}};

constexpr Rule kChannelTarget[] = {{"node", Kind::index, "nodes"}, {"path", Kind::string, "", 0, {}, true}};
constexpr Rule kChannel[] = {{"sampler", Kind::count, "", kMaxInt, {}, true},
                             {"target", Kind::object, "", 0, kChannelTarget, true}};
constexpr Rule kKeys[] = {{"input", Kind::index, "accessors", 0, {}, true},
                          {"output", Kind::index, "accessors", 0, {}, true},
                          {"interpolation", Kind::string}};
constexpr Rule kAnimation[] = {{"name", Kind::string},
                               {"channels", Kind::objects, "", 0, kChannel, true},
                               {"samplers", Kind::objects, "", 0, kKeys, true}};
constexpr Rule kMorphTarget = {"", Kind::index_map, "accessors"};

struct ArrayRule {
  const char* name;
  std::span<const Rule> rules;
};
constexpr std::array<ArrayRule, 11> kArrays{{{"buffers", kBuffer},
                                             {"images", kImage},
                                             {"bufferViews", kBufferView},
                                             {"accessors", kAccessor},
                                             {"textures", kTexture},
                                             {"samplers", kSampler},
                                             {"materials", kMaterial},
                                             {"meshes", kMesh},
                                             {"nodes", kNode},
                                             {"skins", kSkin},
                                             {"scenes", kScene}}};
constexpr std::size_t kRawArrays = 2;  // buffers and images, which tinygltf is not given

// Supported in the sense that a scene that requires them is shown rightly enough for its shadows.
constexpr std::array<std::string_view, 6> kSupported{"KHR_texture_transform",   "KHR_lights_punctual",
                                                     "KHR_mesh_quantization",   "KHR_xmp_json_ld",
                                                     "EXT_mesh_gpu_instancing", "KHR_node_visibility"};

std::size_t array_size(const json& document, const char* name) {
  const auto it = document.find(name);
  return it == document.end() || !it->is_array() ? 0 : it->size();
}

// An integer as any writer may spell it: 3 or 3.0.
std::uint64_t checked_count(const json& value, const std::string& where, std::uint64_t limit) {
  std::uint64_t count = 0;
  if (value.is_number_unsigned()) {
    count = value.get<std::uint64_t>();
  } else if (value.is_number_float()) {
    const double number = value.get<double>();
    if (!(number >= 0.0 && number <= static_cast<double>(kMaxBytes)) || number != std::floor(number)) {
      throw Refusal(where, "must be an integer of at least 0, is " + value.dump());
    }
    count = static_cast<std::uint64_t>(number);
  } else {
    throw Refusal(where, "must be an integer of at least 0, is " +
                             (value.is_number() ? value.dump() : std::string(value.type_name())));
  }
  if (count > limit) throw Refusal(where, std::to_string(count) + " is more than " + std::to_string(limit));
  return count;
}

std::uint64_t checked_index(const json& document, const json& value, const std::string& where,
                            const char* target) {
  const std::uint64_t index = checked_count(value, where, kMaxInt);
  const std::size_t size = array_size(document, target);
  if (index >= size) {
    throw Refusal(where, std::string("names ") + target + "[" + std::to_string(index) + "], there are " +
                             std::to_string(size));
  }
  return index;
}

double checked_number(const json& value, const std::string& where) {
  if (!value.is_number()) throw Refusal(where, std::string("must be a number, is ") + value.type_name());
  const double number = value.get<double>();
  if (!std::isfinite(number)) throw Refusal(where, "is not finite");
  return number;
}

void expect(bool right, const json& value, const std::string& where, const char* what) {
  if (!right) throw Refusal(where, std::string("must be ") + what + ", is " + value.type_name());
}

json checked_object(const json& document, const json& source, const std::string& where,
                    std::span<const Rule> rules);

json checked_list(const json& document, const json& value, const std::string& where, const Rule& rule) {
  expect(value.is_array(), value, where, "a list");
  json out = json::array();
  if (rule.kind == Kind::numbers) {
    if (value.size() != rule.limit) {
      throw Refusal(
          where, "must be " + std::to_string(rule.limit) + " numbers, has " + std::to_string(value.size()));
    }
    for (std::size_t i = 0; i < value.size(); ++i) out.push_back(checked_number(value[i], element(where, i)));
  } else if (rule.kind == Kind::index_list) {
    for (std::size_t i = 0; i < value.size(); ++i)
      out.push_back(checked_index(document, value[i], element(where, i), rule.target));
  } else {
    for (std::size_t i = 0; i < value.size(); ++i) {
      out.push_back(checked_object(document, value[i], element(where, i), rule.rules));
    }
  }
  return out;
}

json checked_value(const json& document, const json& value, const std::string& where, const Rule& rule) {
  switch (rule.kind) {
    case Kind::index:
      return checked_index(document, value, where, rule.target);
    case Kind::count:
      return checked_count(value, where, rule.limit);
    case Kind::number:
      return checked_number(value, where);
    case Kind::boolean:
      expect(value.is_boolean(), value, where, "true or false");
      return value;
    case Kind::string:
      expect(value.is_string(), value, where, "a string");
      return value;
    case Kind::object:
      return checked_object(document, value, where, rule.rules);
    case Kind::index_map: {
      expect(value.is_object(), value, where, "an object");
      json out = json::object();
      for (const auto& [key, v] : value.items()) {
        out[key] = checked_index(document, v, where + "." + one_line(key), rule.target);
      }
      return out;
    }
    case Kind::count_map: {
      expect(value.is_object(), value, where, "an object");
      json out = json::object();
      for (const auto& [key, v] : value.items())
        out[key] = checked_count(v, where + "." + one_line(key), rule.limit);
      return out;
    }
    case Kind::numbers:
    case Kind::index_list:
    case Kind::objects:
      break;
  }
  return checked_list(document, value, where, rule);
}

json checked_object(const json& document, const json& source, const std::string& where,
                    std::span<const Rule> rules) {
  expect(source.is_object(), source, where, "an object");
  json out = json::object();
  for (const Rule& rule : rules) {
    const auto it = source.find(rule.key);
    if (it != source.end()) {
      out[rule.key] = checked_value(document, *it, where + "." + rule.key, rule);
    } else if (rule.required) {
      throw Refusal(where, std::string("has no ") + rule.key);
    }
  }
  return out;
}

json checked_entries(const json& source, const ArrayRule& array) {
  const auto it = source.find(array.name);
  json out = json::array();
  if (it == source.end()) return out;
  expect(it->is_array(), *it, array.name, "a list");
  for (std::size_t i = 0; i < it->size(); ++i) {
    out.push_back(checked_object(source, (*it)[i], element(array.name, i), array.rules));
  }
  return out;
}

json checked_asset(const json& source) {
  const json* asset = find_object(source, "asset");
  if (asset == nullptr) throw Refusal("asset", "is missing: not a glTF 2.0 file");
  const auto version = asset->find("version");
  if (version == asset->end() || !version->is_string()) throw Refusal("asset.version", "is missing");
  const auto text = version->get<std::string>();
  if (!text.starts_with("2.")) throw Refusal("asset.version", "'" + text + "', only 2.0 is supported");
  const auto least = asset->find("minVersion");
  if (least != asset->end() && *least != "2.0") {
    throw Refusal("asset.minVersion", one_line(least->dump()) + ", only \"2.0\" is supported");
  }
  return {{"version", "2.0"}};
}

}  // namespace

const json* find_object(const json& source, const char* key) {
  if (!source.is_object()) return nullptr;
  const auto it = source.find(key);
  return it != source.end() && it->is_object() ? &*it : nullptr;
}

const json* find_extension(const json& owner, const char* name) {
  const json* extensions = find_object(owner, "extensions");
  return extensions == nullptr ? nullptr : find_object(*extensions, name);
}

const json* find_extension(const json& owner, const char* name, const std::string& where,
                           std::vector<std::string>& warnings) {
  const json* extensions = find_object(owner, "extensions");
  if (extensions == nullptr || !extensions->contains(name)) return nullptr;
  const json* found = find_object(*extensions, name);
  if (found == nullptr)
    warn(warnings, where + (where.empty() ? "" : ".") + name, "is no object, and does not count");
  return found;
}

json checked_array(const json& source, const char* name) {
  const auto* array = std::find_if(kArrays.begin(), kArrays.end(),
                                   [&](const ArrayRule& a) { return std::string_view(a.name) == name; });
  return array == kArrays.end() ? json::array() : checked_entries(source, *array);
}

namespace {

json checked_extension(const json& source, const json& owner, const char* name, std::span<const Rule> rules,
                       const std::string& where) {
  const json* found = find_extension(owner, name);
  return found == nullptr ? json() : checked_object(source, *found, where, rules);
}

}  // namespace

json checked_meshopt(const json& source, const json& view, const std::string& where) {
  return checked_extension(source, view, "EXT_meshopt_compression", kMeshopt, where);
}

json checked_draco(const json& source, const json& primitive, const std::string& where) {
  return checked_extension(source, primitive, "KHR_draco_mesh_compression", kDraco, where);
}

json checked_instancing(const json& source, const json& node, const std::string& where) {
  return checked_extension(source, node, "EXT_mesh_gpu_instancing", kInstancing, where);
}

json checked_animation(const json& source, const json& animation, const std::string& where) {
  return checked_object(source, animation, where, kAnimation);
}

json checked_morph_targets(const json& source, const json& primitive, const std::string& where) {
  json out = json::array();
  const auto targets = primitive.find("targets");
  if (targets == primitive.end()) return out;
  expect(targets->is_array(), *targets, where + ".targets", "a list");
  for (std::size_t i = 0; i < targets->size(); ++i)
    out.push_back(checked_value(source, (*targets)[i], where + "." + element("targets", i), kMorphTarget));
  return out;
}

std::vector<float> checked_weights(const json& owner, const std::string& where) {
  std::vector<float> out;
  const auto weights = owner.find("weights");
  if (weights == owner.end()) return out;
  expect(weights->is_array(), *weights, where + ".weights", "a list");
  for (const json& weight : *weights) {
    const auto value = static_cast<float>(checked_number(weight, where + ".weights"));
    if (!std::isfinite(value)) throw Refusal(where + ".weights", "is not finite");
    out.push_back(value);
  }
  return out;
}

json checked_document(const json& source) {
  expect(source.is_object(), source, "JSON", "an object");
  json out = json::object();
  out["asset"] = checked_asset(source);
  for (std::size_t i = kRawArrays; i < kArrays.size(); ++i) {
    json array = checked_entries(source, kArrays[i]);
    if (!array.empty()) out[kArrays[i].name] = std::move(array);
  }
  const auto scene = source.find("scene");
  if (scene != source.end()) out["scene"] = checked_index(source, *scene, "scene", "scenes");
  return out;
}

bool decodes(std::string_view extension) noexcept {
  return (extension == "KHR_draco_mesh_compression" && decodes_draco()) ||
         (extension == "EXT_meshopt_compression" && decodes_meshopt()) ||
         (extension == "EXT_texture_webp" && reads_webp());
}

std::string remedy_for(std::string_view extension) {
  if (extension == "KHR_texture_basisu") return "convert its KTX2 pictures to PNG, JPEG or WebP";
  if (extension == "KHR_draco_mesh_compression") return "this build lacks libdraco";
  if (extension == "EXT_meshopt_compression") return "this build lacks libmeshoptimizer";
  if (extension == "EXT_texture_webp") return "this build lacks OpenImageIO";
  return {};
}

bool is_supported(std::string_view extension) {
  // Materials look otherwise, and cast alike; variants are other materials.
  if (extension.starts_with("KHR_materials_")) return extension != "KHR_materials_variants";
  return decodes(extension) || std::find(kSupported.begin(), kSupported.end(), extension) != kSupported.end();
}

void check_extensions(const json& source) {
  if (!source.is_object()) return;
  const auto required = source.find("extensionsRequired");
  if (required == source.end()) return;
  expect(required->is_array(), *required, "extensionsRequired", "a list");
  for (const json& name : *required) {
    expect(name.is_string(), name, "extensionsRequired", "a list of strings");
    const auto text = name.get<std::string>();
    if (is_supported(text) || text == "KHR_materials_variants") continue;
    const std::string remedy = remedy_for(text);
    throw Refusal("extensionsRequired",
                  "'" + text + "' is not supported" + (remedy.empty() ? "" : ": " + remedy));
  }
}

}  // namespace gnomon::detail
