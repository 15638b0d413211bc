// Which context is taken, and why the others were not.
#include "gnomon/render/context.hpp"

#include <glad/gl.h>

#include <array>
#include <utility>

#include "context/backend.hpp"

namespace gnomon::render {
namespace {

constexpr std::array<std::pair<ContextKind, std::string_view>, 4> kKindNames{{
    {ContextKind::automatic, "auto"},
    {ContextKind::osmesa, "osmesa"},
    {ContextKind::egl, "egl"},
    {ContextKind::glfw, "glfw"},
}};

std::string gl_string(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text == nullptr ? std::string{} : std::string{reinterpret_cast<const char*>(text)};
}

std::string joined(const std::vector<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines) all += "\n  " + line;
  return all;
}

}  // namespace

bool is_software(std::string_view renderer) {
  for (const std::string_view mark : {"llvmpipe", "softpipe", "swrast", "SWR", "Software Rasterizer"}) {
    if (renderer.find(mark) != std::string_view::npos) return true;
  }
  return false;
}

std::string_view to_string(ContextKind kind) noexcept {
  for (const auto& [value, name] : kKindNames) {
    if (value == kind) return name;
  }
  return "auto";
}

bool context_kind_from_name(std::string_view name, ContextKind& kind) noexcept {
  for (const auto& [value, known] : kKindNames) {
    if (known == name) {
      kind = value;
      return true;
    }
  }
  return false;
}

std::string ContextInfo::description() const {
  std::string text = platform + ": " + renderer + ", OpenGL " + version +
                     (software ? " (software: times are wall clock)" : "");
  for (const std::string& line : refused) text += "\n  not taken: " + line;
  return text;
}

void load_gl(void* (*get_proc_address)(const char*), ContextInfo* info) {
  const int version = gladLoadGL(reinterpret_cast<GLADloadfunc>(get_proc_address));
  if (version < GLAD_MAKE_VERSION(4, 5)) {
    throw RenderError("needs OpenGL 4.5, the context has " + std::to_string(GLAD_VERSION_MAJOR(version)) +
                      "." + std::to_string(GLAD_VERSION_MINOR(version)));
  }
  if (info == nullptr) return;
  info->renderer = gl_string(GL_RENDERER);
  info->version = gl_string(GL_VERSION);
  info->software = is_software(info->renderer);
  GLint strategy = GL_NO_RESET_NOTIFICATION;
  glGetIntegerv(GL_RESET_NOTIFICATION_STRATEGY, &strategy);
  info->reports_resets = strategy == GL_LOSE_CONTEXT_ON_RESET;
}

void check_context() {
  switch (glGetGraphicsResetStatus()) {
    case GL_NO_ERROR:
      return;
    case GL_GUILTY_CONTEXT_RESET:
      throw RenderError("the OpenGL context was lost: the driver was reset by what was drawn here");
    case GL_INNOCENT_CONTEXT_RESET:
      throw RenderError("the OpenGL context was lost: the driver was reset by another program");
    default:
      throw RenderError("the OpenGL context was lost: the driver was reset for an unknown reason");
  }
}

std::unique_ptr<Context> create_context(ContextKind kind) {
  if (kind == ContextKind::glfw) {
    throw RenderError("a GLFW context is a window: make it with create_window (gnomon/render/window.hpp)");
  }
  if (kind == ContextKind::osmesa) return create_osmesa_context();

  std::vector<std::string> refused;
  if (auto context = create_egl_context(kind == ContextKind::egl, refused)) return context;
  if (kind == ContextKind::egl) throw RenderError("no EGL context:" + joined(refused));
  try {
    return create_osmesa_context(refused);
  } catch (const RenderError& error) {
    refused.emplace_back(error.what());
  }
  if (auto context = create_egl_context(true, refused)) return context;
  throw RenderError("no OpenGL 4.5 context:" + joined(refused));
}

}  // namespace gnomon::render
