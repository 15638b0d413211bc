// Where shader text comes from: files embedded in the library, put together by #include.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::render {

struct ShaderFile {
  std::string_view path;  ///< below shaders/, e.g. "filter/pcf.glsl"
  std::string_view text;
};
/// All files under shaders/, sorted by path.
[[nodiscard]] std::span<const ShaderFile> shader_files() noexcept;
/// Throws RenderError where there is none of that path.
[[nodiscard]] std::string_view shader_file(std::string_view path);

/// Text for the compiler, and which file each of its source-string numbers stands for.
struct ComposedShader {
  std::string text;
  std::vector<std::string> files;
};

/// What a shader is compiled for: which filter's file it includes, and what is known of its settings.
struct ShaderChoice {
  std::string filter_path = {};
  int vectors = 1;          ///< of a stored texel
  bool reads_slope = true;  ///< FilterHooks::reads_slope
  bool mean = true;         ///< texels are put together by their weighted mean: MapRead::filtered
  int reach = 1;            ///< taps of the blur to either side of the middle one, for shaders made for one
  int channels = 4;         ///< of a stored texel
  int vector = 0;           ///< of a stored texel, which store_rows.comp blurs
  bool shapes = true;       ///< false: every map is linear
};

/// Replaces `#include "path"` by that file (each once) and `#include <filter>` by the choice's, and defines
/// GNOMON_MAX_MAPS and one macro for each field of the choice after `#version`. Throws RenderError with file
/// and line for a file that does not exist.
[[nodiscard]] ComposedShader compose_shader(std::string_view path, const ShaderChoice& choice = {});
/// The same for text that stands in no file; `name` is used in messages.
[[nodiscard]] ComposedShader compose_shader_text(std::string_view name, std::string_view text,
                                                 const ShaderChoice& choice = {});

/// Puts file names in the place of source-string numbers in a compiler's log ("2:14(7): ...", "2(14) : ...",
/// "ERROR: 2:14: ...").
[[nodiscard]] std::string name_files_in_log(std::string_view log, const std::vector<std::string>& files);

}  // namespace gnomon::render
