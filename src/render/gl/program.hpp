// From shader files to a program that can be drawn with.
#pragma once

#include <string_view>

#include "gl/gl_object.hpp"
#include "gl/shader_text.hpp"

namespace gnomon::render {

/// Compiles and links. Throws RenderError with shader file, line and the driver's words.
[[nodiscard]] Program make_program(const ComposedShader& vertex, const ComposedShader& fragment);
[[nodiscard]] Program make_program(std::string_view vertex_path, std::string_view fragment_path,
                                   const ShaderChoice& choice = {});
/// With a geometry shader between the two.
[[nodiscard]] Program make_geometry_program(std::string_view vertex_path, std::string_view geometry_path,
                                            std::string_view fragment_path);
[[nodiscard]] Program make_compute_program(std::string_view path, const ShaderChoice& choice = {});

}  // namespace gnomon::render
