// Where OpenGL comes from: an off-screen context, with or without a GPU, with or without a display.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/render/error.hpp"

namespace gnomon::render {

enum class ContextKind : std::uint8_t {
  automatic,  ///< a GPU through EGL where there is one, else OSMesa, else EGL in software; never needs a
              ///< display
  osmesa,     ///< Mesa's off-screen library: software, in process
  egl,        ///< EGL without a surface, then each EGL device; a GPU is taken over software
  glfw,       ///< a window (gnomon/render/window.hpp); needs a display
};
[[nodiscard]] std::string_view to_string(ContextKind kind) noexcept;
/// True and `kind` set where `name` is one of auto, osmesa, egl, glfw.
[[nodiscard]] bool context_kind_from_name(std::string_view name, ContextKind& kind) noexcept;

/// Which context this is, and why this one.
struct ContextInfo {
  ContextKind kind = ContextKind::automatic;  ///< never automatic in a finished context
  std::string platform;                       ///< e.g. "EGL device 0", "OSMesa"
  std::string renderer;                       ///< GL_RENDERER
  std::string version;                        ///< GL_VERSION
  bool software = true;                       ///< drawn by the CPU: timings are wall clock
  bool reports_resets = false;                ///< check_context() notices when the driver is reset
  std::vector<std::string> refused;           ///< those tried before, a line each: which and why not

  /// All of it in a few lines of English.
  [[nodiscard]] std::string description() const;
};

/// An OpenGL 4.5 core context. Each thread has its own table of OpenGL functions, which make_current() fills.
/// A thread draws through the context that it made current last; other threads draw through theirs.
class Context {
 public:
  virtual ~Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  /// Throws RenderError where the driver refuses.
  virtual void make_current() = 0;
  /// Which context this is.
  [[nodiscard]] const ContextInfo& info() const noexcept { return info_; }

 protected:
  Context() = default;
  ContextInfo info_;  ///< set by the one that makes the context
};

/// Makes an off-screen context and makes it current. Throws RenderError with the reason of every candidate
/// that was tried; ContextKind::glfw is refused here, see gnomon/render/window.hpp.
[[nodiscard]] std::unique_ptr<Context> create_context(ContextKind kind = ContextKind::automatic);

/// Throws RenderError where the driver has reset the current context: everything drawn in it is undefined.
/// Call it after a frame, before its pictures or times are used; the Renderer's pictures do so themselves.
void check_context();

}  // namespace gnomon::render
