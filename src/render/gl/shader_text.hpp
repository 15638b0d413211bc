// Where shader text comes from: files embedded in the library, put together by #include.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
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

/// A shader by its main file, and the parts that it is put together from.
struct ShaderName {
  std::string path;  ///< below shaders/, e.g. "pass/mask/mask.frag"
  /// "ROLE/NAME" for each `#include <ROLE>`, e.g. "read/joined"; the others are ignored.
  std::vector<std::string> parts = {};

  ShaderName(const char* main_file) : path(main_file) {}
  ShaderName(std::string main_file, std::vector<std::string> all_parts)
      : path(std::move(main_file)), parts(std::move(all_parts)) {}
};

/// What a shader is compiled for: a macro for each member.
struct ShaderChoice {
  int vectors = 1;          ///< of a stored texel
  bool reads_slope = true;  ///< FilterHooks::reads_slope
  bool mean = true;         ///< texels are put together by their weighted mean: MapRead::filtered
  int reach = 1;            ///< taps of the blur to either side of the middle one, for shaders made for one
  int channels = 4;         ///< of a stored texel
  int vector = 0;           ///< of a stored texel, which store_rows.comp blurs
  bool shapes = true;       ///< false: every map is linear
};

/// Puts a shader together. `#include "path"` becomes that file, each file once. `#include <ROLE>` becomes the
/// part of that role: ROLE/NAME.glsl in the folder of the file that includes it, else below shaders/. After
/// `#version` stand GNOMON_MAX_MAPS and one macro for each member of the choice. Throws RenderError with file
/// and line for a file that does not exist, and for a role that has no part.
[[nodiscard]] ComposedShader compose_shader(const ShaderName& shader, const ShaderChoice& choice = {});
/// The same for text that stands in no file; the path is used in messages.
[[nodiscard]] ComposedShader compose_shader_text(const ShaderName& shader, std::string_view text,
                                                 const ShaderChoice& choice = {});
/// The part of role "filter": the filter of that name.
[[nodiscard]] std::string filter_part(std::string_view filter);

/// Puts file names in the place of source-string numbers in a compiler's log ("2:14(7): ...", "2(14) : ...",
/// "ERROR: 2:14: ...").
[[nodiscard]] std::string name_files_in_log(std::string_view log, const std::vector<std::string>& files);

}  // namespace gnomon::render
