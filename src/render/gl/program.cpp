// Compiles shaders; a mistake in one is reported by file and line.
#include "gl/program.hpp"

#include <array>
#include <span>
#include <string>

#include "gnomon/render/context.hpp"

namespace gnomon::render {
namespace {

Shader compile(GLenum stage, const ComposedShader& source) {
  Shader shader(glCreateShader(stage));
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

Program link(std::span<const Shader* const> shaders, const std::string& names) {
  Program program(glCreateProgram());
  for (const Shader* shader : shaders) glAttachShader(program.name(), shader->name());
  glLinkProgram(program.name());
  for (const Shader* shader : shaders) glDetachShader(program.name(), shader->name());
  GLint ok = GL_FALSE, length = 0;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &ok);
  if (ok == GL_TRUE) return program;
  check_context();
  glGetProgramiv(program.name(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length > 0 ? length : 1), '\0');
  glGetProgramInfoLog(program.name(), length, nullptr, log.data());
  throw RenderError("shaders " + names + " do not link:\n" + log.c_str());
}

}  // namespace

Program make_program(const ComposedShader& vertex, const ComposedShader& fragment) {
  const Shader vertex_shader = compile(GL_VERTEX_SHADER, vertex);
  const Shader fragment_shader = compile(GL_FRAGMENT_SHADER, fragment);
  const std::array<const Shader*, 2> both{&vertex_shader, &fragment_shader};
  return link(both, vertex.files.front() + " and " + fragment.files.front());
}

Program make_program(std::string_view vertex_path, std::string_view fragment_path,
                     const ShaderChoice& choice) {
  return make_program(compose_shader(vertex_path), compose_shader(fragment_path, choice));
}

Program make_geometry_program(std::string_view vertex_path, std::string_view geometry_path,
                              std::string_view fragment_path) {
  const ComposedShader vertex = compose_shader(vertex_path), geometry = compose_shader(geometry_path),
                       fragment = compose_shader(fragment_path);
  const Shader vertex_shader = compile(GL_VERTEX_SHADER, vertex);
  const Shader geometry_shader = compile(GL_GEOMETRY_SHADER, geometry);
  const Shader fragment_shader = compile(GL_FRAGMENT_SHADER, fragment);
  const std::array<const Shader*, 3> all{&vertex_shader, &geometry_shader, &fragment_shader};
  return link(all, vertex.files.front() + ", " + geometry.files.front() + " and " + fragment.files.front());
}

Program make_compute_program(std::string_view path, const ShaderChoice& choice) {
  const ComposedShader source = compose_shader(path, choice);
  const Shader shader = compile(GL_COMPUTE_SHADER, source);
  const std::array<const Shader*, 1> one{&shader};
  return link(one, source.files.front());
}

}  // namespace gnomon::render
