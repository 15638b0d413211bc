// From shader files to a program that can be drawn with.
#pragma once

#include <string>

#include "gl/gl_object.hpp"
#include "gl/shader_text.hpp"

namespace gnomon::render {

/// Compiles and links. Throws RenderError with shader file, line and the driver's words.
[[nodiscard]] Program make_program(const ShaderName& vertex, const ShaderName& fragment);
/// With a geometry shader between the two.
[[nodiscard]] Program make_program(const ShaderName& vertex, const ShaderName& geometry,
                                   const ShaderName& fragment);
/// Draws casters into one map: parts of pass/depth/depth.frag.
[[nodiscard]] Program make_caster_program(std::string alpha_part, std::string depth_part);
/// Draws one triangle over the whole image.
[[nodiscard]] Program make_screen_program(const ShaderName& fragment, const ShaderChoice& choice = {});
[[nodiscard]] Program link_screen_program(const ComposedShader& fragment);
[[nodiscard]] Program make_compute_program(const ShaderName& shader, const ShaderChoice& choice = {});

}  // namespace gnomon::render
