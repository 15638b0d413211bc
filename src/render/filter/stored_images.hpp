// Images of stored texels, and framebuffers that draw into all of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gl/gl_object.hpp"
#include "gnomon/render/filter.hpp"

namespace gnomon::render {

/// The format of these settings' images.
[[nodiscard]] GLenum stored_format(const FilterSettings& settings) noexcept;
/// Adds its size to `bytes`.
[[nodiscard]] Texture array_image(GLenum format, int levels, int width, int height, int layers,
                                  std::uint64_t& bytes);
void attach_images(const Framebuffer& fbo, const std::vector<Texture>& images, GLint level, GLint layer);
void draw_into_all(const Framebuffer& fbo, std::size_t images);
/// To the units of stored texels.
void bind_images(const std::vector<Texture>& images, const Sampler& sampler);

}  // namespace gnomon::render
