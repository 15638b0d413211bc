// What do a glTF document's surfaces look like, as far as light and shadow need it: base colour and alpha.
// Based on: Khronos Group, glTF 2.0 Specification (2021), sections 3.8 "Texture data" and 3.9 "Materials".
#include "gltf_material.hpp"

#include <algorithm>
#include <map>

#include "gnomon/scene/image.hpp"
#include "refusal.hpp"

namespace gnomon::detail {

namespace {

// A picture that fails late costs as much time as one that decodes, and no pixels of the budget.
constexpr int kFailures = 64;

class ImageReader {
 public:
  ImageReader(const Document& document, SceneFolder& folder, std::uint64_t pixels, Scene& scene)
      : document_(document), folder_(folder), pixels_left_(pixels), scene_(scene) {}

  /// Index into scene.images, -1 where the picture cannot be had.
  int image(int source) {
    const auto [it, is_new] = loaded_.try_emplace(source, -1);
    if (!is_new) return it->second;
    const ImageSource& from = document_.images[static_cast<std::size_t>(source)];
    try {
      Image decoded = decode(from);
      pixels_left_ -= static_cast<std::uint64_t>(decoded.width) * static_cast<std::uint64_t>(decoded.height);
      scene_.images.push_back(std::move(decoded));
      it->second = static_cast<int>(scene_.images.size() - 1);
    } catch (const std::runtime_error& e) {
      ++failures_;
      const std::string where = element("images", static_cast<std::size_t>(source));
      // A picture without a name is named by its place already.
      const bool named = std::string_view(e.what()).starts_with(where + ": ");
      warn(scene_.warnings, (named ? "" : where + ": ") + std::string(e.what()) + "; shown white");
    }
    return it->second;
  }

 private:
  Image decode(const ImageSource& from) {
    if (failures_ >= kFailures)
      throw LeftOut("is not tried after " + std::to_string(kFailures) + " that failed");
    if (!from.uri.empty()) return decode_image(folder_.read(from.uri), from.name, pixels_left_);
    if (from.buffer_view >= 0) {
      return decode_image(view_bytes(document_.model, from.buffer_view), from.name, pixels_left_);
    }
    throw LeftOut("has neither a URI nor a buffer view");
  }

  const Document& document_;
  SceneFolder& folder_;
  std::uint64_t pixels_left_;
  int failures_ = 0;
  Scene& scene_;
  std::map<int, int> loaded_;
};

TextureWrap to_wrap(int mode, const std::string& where, std::vector<std::string>& warnings) {
  if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return TextureWrap::clamp_to_edge;
  if (mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return TextureWrap::mirrored_repeat;
  if (mode != TINYGLTF_TEXTURE_WRAP_REPEAT)
    warn(warnings, where, std::to_string(mode) + " is no way to wrap, the picture repeats");
  return TextureWrap::repeat;
}

AlphaMode to_alpha_mode(const std::string& word, const std::string& where,
                        std::vector<std::string>& warnings) {
  if (word == "MASK") return AlphaMode::mask;
  if (word == "BLEND") return AlphaMode::blend;
  if (!word.empty() && word != "OPAQUE")
    warn(warnings, where, "'" + one_line(word) + "' is none of OPAQUE, MASK and BLEND, shown opaque");
  return AlphaMode::opaque;
}

Material to_material(const Document& document, std::size_t index, ImageReader& images, Scene& scene) {
  const tinygltf::Material& source = document.model.materials[index];
  const tinygltf::PbrMetallicRoughness& base = source.pbrMetallicRoughness;
  Material out;
  out.name = source.name;
  for (std::size_t c = 0; c < 4 && c < base.baseColorFactor.size(); ++c) {
    out.base_color[static_cast<int>(c)] = static_cast<float>(std::clamp(base.baseColorFactor[c], 0.0, 1.0));
  }
  if (index < document.transmissions.size()) out.transmission = document.transmissions[index];
  out.alpha_mode =
      to_alpha_mode(source.alphaMode, element("materials", index) + ".alphaMode", scene.warnings);
  if (out.alpha_mode == AlphaMode::mask)
    out.alpha_cutoff = static_cast<float>(std::max(source.alphaCutoff, 0.0));
  out.double_sided = source.doubleSided;
  if (base.baseColorTexture.index < 0) return out;
  const auto t = static_cast<std::size_t>(base.baseColorTexture.index);
  const tinygltf::Texture& texture = document.model.textures[t];
  if (texture.source < 0) {
    warn(scene.warnings, element("textures", t),
         "has no picture in a format that this build reads; shown white");
    return out;
  }
  out.base_color_image = images.image(texture.source);
  if (texture.sampler >= 0) {
    const auto s = static_cast<std::size_t>(texture.sampler);
    const tinygltf::Sampler& sampler = document.model.samplers[s];
    out.wrap_u = to_wrap(sampler.wrapS, element("samplers", s) + ".wrapS", scene.warnings);
    out.wrap_v = to_wrap(sampler.wrapT, element("samplers", s) + ".wrapT", scene.warnings);
  }
  return out;
}

}  // namespace

void read_materials(const Document& document, SceneFolder& folder, const LoadLimits& limits, Scene& scene) {
  ImageReader images(document, folder, limits.pixels, scene);
  for (std::size_t m = 0; m < document.model.materials.size(); ++m) {
    scene.materials.push_back(to_material(document, m, images, scene));
  }
  scene.materials.emplace_back();
  scene.materials.back().name = "default";
}

}  // namespace gnomon::detail
