// Compiles shaders; a mistake in one is reported by file and line.
#include "gl/program.hpp"

#include <array>
#include <span>
#include <string>
#include <vector>

#include "gnomon/render/context.hpp"

namespace gnomon::render {
namespace {

struct Stage {
  GLenum kind;
  ComposedShader source;
};

Shader compile(const Stage& stage) {
  const ComposedShader& source = stage.source;
  Shader shader(glCreateShader(stage.kind));
  const GLchar* text = source.text.c_str();
  glShaderSource(shader.name(), 1, &text, nullptr);
  glCompileShader(shader.name());
  GLint ok = GL_FALSE, length = 0;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &ok);
  if (ok == GL_TRUE) return shader;
  check_context();  // a lost context compiles nothing, and the shader is not to blame
  glGetShaderiv(shader.name(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length > 0 ? length : 1), '\0');
  glGetShaderInfoLog(shader.name(), length, nullptr, log.data());
  log.resize(log.find('\0') == std::string::npos ? log.size() : log.find('\0'));
  throw RenderError("shader " + source.files.front() + " does not compile:\n" +
                    name_files_in_log(log, source.files));
}

Program link(std::span<const Stage> stages) {
  std::vector<Shader> shaders;
  for (const Stage& stage : stages) shaders.push_back(compile(stage));
  Program program(glCreateProgram());
  for (const Shader& shader : shaders) glAttachShader(program.name(), shader.name());
  glLinkProgram(program.name());
  for (const Shader& shader : shaders) glDetachShader(program.name(), shader.name());
  GLint ok = GL_FALSE, length = 0;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &ok);
  if (ok == GL_TRUE) return program;
  check_context();
  glGetProgramiv(program.name(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length > 0 ? length : 1), '\0');
  glGetProgramInfoLog(program.name(), length, nullptr, log.data());
  std::string names;
  for (const Stage& stage : stages) names += (names.empty() ? "" : ", ") + stage.source.files.front();
  throw RenderError("shaders " + names + " do not link:\n" + log.c_str());
}

}  // namespace

Program make_program(const ShaderName& vertex, const ShaderName& fragment) {
  return link(std::array{Stage{GL_VERTEX_SHADER, compose_shader(vertex)},
                         Stage{GL_FRAGMENT_SHADER, compose_shader(fragment)}});
}

Program make_program(const ShaderName& vertex, const ShaderName& geometry, const ShaderName& fragment) {
  return link(std::array{Stage{GL_VERTEX_SHADER, compose_shader(vertex)},
                         Stage{GL_GEOMETRY_SHADER, compose_shader(geometry)},
                         Stage{GL_FRAGMENT_SHADER, compose_shader(fragment)}});
}

Program make_caster_program(std::string alpha_part, std::string depth_part) {
  return make_program("pass/depth/depth.vert",
                      {"pass/depth/depth.frag", {std::move(alpha_part), std::move(depth_part)}});
}

Program make_screen_program(const ShaderName& fragment, const ShaderChoice& choice) {
  return link_screen_program(compose_shader(fragment, choice));
}

Program link_screen_program(const ComposedShader& fragment) {
  return link(std::array{Stage{GL_VERTEX_SHADER, compose_shader("pass/common/fullscreen.vert")},
                         Stage{GL_FRAGMENT_SHADER, fragment}});
}

Program make_compute_program(const ShaderName& shader, const ShaderChoice& choice) {
  return link(std::array{Stage{GL_COMPUTE_SHADER, compose_shader(shader, choice)}});
}

}  // namespace gnomon::render
