// Compiles shaders; a mistake in one is reported by file and line.
#include "program.hpp"

#include <string>

#include "gnomon/render/error.hpp"

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
  glGetShaderiv(shader.name(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length > 0 ? length : 1), '\0');
  glGetShaderInfoLog(shader.name(), length, nullptr, log.data());
  log.resize(log.find('\0') == std::string::npos ? log.size() : log.find('\0'));
  throw RenderError("shader " + source.files.front() + " does not compile:\n" +
                    name_files_in_log(log, source.files));
}

}  // namespace

Program make_program(const ComposedShader& vertex, const ComposedShader& fragment) {
  const Shader vertex_shader = compile(GL_VERTEX_SHADER, vertex);
  const Shader fragment_shader = compile(GL_FRAGMENT_SHADER, fragment);
  Program program(glCreateProgram());
  glAttachShader(program.name(), vertex_shader.name());
  glAttachShader(program.name(), fragment_shader.name());
  glLinkProgram(program.name());
  GLint ok = GL_FALSE, length = 0;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &ok);
  glDetachShader(program.name(), vertex_shader.name());
  glDetachShader(program.name(), fragment_shader.name());
  if (ok == GL_TRUE) return program;
  glGetProgramiv(program.name(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length > 0 ? length : 1), '\0');
  glGetProgramInfoLog(program.name(), length, nullptr, log.data());
  throw RenderError("shaders " + vertex.files.front() + " and " + fragment.files.front() + " do not link:\n" +
                    log.c_str());
}

Program make_program(std::string_view vertex_path, std::string_view fragment_path,
                     std::string_view filter_path) {
  return make_program(compose_shader(vertex_path), compose_shader(fragment_path, filter_path));
}

}  // namespace gnomon::render
