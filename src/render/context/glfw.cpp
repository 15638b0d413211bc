// A window and its context. The only file that knows GLFW's start-up; it needs a display.
#include <glad/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "context/backend.hpp"
#include "gnomon/render/window.hpp"

namespace gnomon::render {
namespace {

std::string last_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text == nullptr ? "no reason given" : text;
}

void* glfw_proc(const char* name) {
  return reinterpret_cast<void*>(glfwGetProcAddress(name));
}

class GlfwWindow final : public Window {
 public:
  GlfwWindow(int width, int height, const std::string& title) {
    if (glfwInit() == GLFW_FALSE) throw RenderError("GLFW: " + last_error());
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
    window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) {  // a driver may refuse to report resets
      glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_NO_ROBUSTNESS);
      window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    }
    if (window_ == nullptr) {
      const std::string why = last_error();
      glfwTerminate();
      throw RenderError("GLFW: no window with OpenGL 4.5: " + why);
    }
    info_.kind = ContextKind::glfw;
    info_.platform = "GLFW window";
    try {
      glfwMakeContextCurrent(window_);
      load_gl(glfw_proc, &info_);
    } catch (...) {
      close();
      throw;
    }
  }
  ~GlfwWindow() override { close(); }
  void make_current() override {
    glfwMakeContextCurrent(window_);
    load_gl(glfw_proc, nullptr);
  }
  [[nodiscard]] GLFWwindow* handle() const noexcept override { return window_; }

 private:
  void close() noexcept {
    glfwDestroyWindow(window_);
    glfwTerminate();
  }
  GLFWwindow* window_ = nullptr;
};

}  // namespace

std::unique_ptr<Window> create_window(int width, int height, const std::string& title) {
  return std::make_unique<GlfwWindow>(width, height, title);
}

}  // namespace gnomon::render
