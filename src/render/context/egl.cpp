// EGL without a surface: the way to a GPU without a display, and to Mesa's software renderer where there is
// none. Loaded at run time, so that a machine without libEGL still draws.
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <optional>

#include "context/backend.hpp"

#ifndef EGL_PLATFORM_SURFACELESS_MESA
#define EGL_PLATFORM_SURFACELESS_MESA 0x31DD
#endif

namespace gnomon::render {
namespace {

constexpr int kMaxDevices = 16;

struct Egl {
  decltype(&eglGetProcAddress) get_proc_address;
  decltype(&eglInitialize) initialize;
  decltype(&eglTerminate) terminate;
  decltype(&eglBindAPI) bind_api;
  decltype(&eglCreateContext) create_context;
  decltype(&eglDestroyContext) destroy_context;
  decltype(&eglMakeCurrent) make_current;
  decltype(&eglGetError) get_error;
  PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display;
  PFNEGLQUERYDEVICESEXTPROC query_devices;  ///< nullptr without EGL_EXT_device_enumeration
};

Egl load_egl() {
  void* library = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr) throw RenderError("EGL: libEGL.so.1 is not installed");
  const auto load = [library](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
    if (function == nullptr) throw RenderError(std::string("EGL: the library has no ") + name);
  };
  Egl egl{};
  load(egl.get_proc_address, "eglGetProcAddress");
  load(egl.initialize, "eglInitialize");
  load(egl.terminate, "eglTerminate");
  load(egl.bind_api, "eglBindAPI");
  load(egl.create_context, "eglCreateContext");
  load(egl.destroy_context, "eglDestroyContext");
  load(egl.make_current, "eglMakeCurrent");
  load(egl.get_error, "eglGetError");
  egl.get_platform_display =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(egl.get_proc_address("eglGetPlatformDisplayEXT"));
  if (egl.get_platform_display == nullptr) throw RenderError("EGL: no eglGetPlatformDisplayEXT");
  egl.query_devices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(egl.get_proc_address("eglQueryDevicesEXT"));
  return egl;
}

/// load_gl takes a plain function; EGL's returns a function pointer type of its own.
thread_local decltype(&eglGetProcAddress) current_get_proc_address = nullptr;
void* egl_proc(const char* name) {
  return reinterpret_cast<void*>(current_get_proc_address(name));
}

class EglBackend final : public Context {
 public:
  EglBackend(const Egl& egl, EGLenum platform, void* native, std::string name) : egl_(egl) {
    info_.kind = ContextKind::egl;
    info_.platform = std::move(name);
    display_ = egl_.get_platform_display(platform, native, nullptr);
    if (display_ == EGL_NO_DISPLAY) throw RenderError(info_.platform + ": no such display");
    if (egl_.initialize(display_, nullptr, nullptr) == EGL_FALSE) fail("cannot be initialised");
    try {
      open();
    } catch (...) {
      close();
      throw;
    }
  }
  ~EglBackend() override { close(); }
  void make_current() override { bind(nullptr); }
  void set_refused(std::vector<std::string> reasons) { info_.refused = std::move(reasons); }

 private:
  void open() {
    if (egl_.bind_api(EGL_OPENGL_API) == EGL_FALSE) fail("has no desktop OpenGL");
    constexpr std::array<EGLint, 6> kCore{
        EGL_CONTEXT_MAJOR_VERSION,          4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
    // Robust access and reports of resets where the driver has both, else the latter alone, else neither.
    for (const std::vector<EGLint>& more :
         {std::vector<EGLint>{EGL_CONTEXT_OPENGL_ROBUST_ACCESS, EGL_TRUE,
                              EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET},
          std::vector<EGLint>{EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET},
          std::vector<EGLint>{}}) {
      std::vector<EGLint> attributes(kCore.begin(), kCore.end());
      attributes.insert(attributes.end(), more.begin(), more.end());
      attributes.push_back(EGL_NONE);
      context_ = egl_.create_context(display_, nullptr, EGL_NO_CONTEXT, attributes.data());
      if (context_ != EGL_NO_CONTEXT) break;
    }
    if (context_ == EGL_NO_CONTEXT) fail("refuses an OpenGL 4.5 core context");
    bind(&info_);
  }
  void bind(ContextInfo* info) {
    egl_.bind_api(EGL_OPENGL_API);
    if (egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
      fail("cannot make a context current without a surface");
    }
    current_get_proc_address = egl_.get_proc_address;
    load_gl(egl_proc, info);
  }
  [[noreturn]] void fail(const char* what) const {
    throw RenderError(info_.platform + ": " + what + " (EGL error " + std::to_string(egl_.get_error()) + ")");
  }
  void close() noexcept {
    if (context_ != EGL_NO_CONTEXT) {
      egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
      egl_.destroy_context(display_, context_);
    }
    // The display is the process's, not ours: terminating it would end other contexts on it.
    context_ = EGL_NO_CONTEXT;
  }

  Egl egl_;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

struct Candidate {
  EGLenum platform;
  void* native;
  std::string name;
};

std::vector<Candidate> candidates(const Egl& egl) {
  std::vector<Candidate> all{{EGL_PLATFORM_SURFACELESS_MESA, nullptr, "EGL surfaceless"}};
  std::array<EGLDeviceEXT, kMaxDevices> devices{};
  EGLint count = 0;
  if (egl.query_devices == nullptr || egl.query_devices(kMaxDevices, devices.data(), &count) == EGL_FALSE)
    return all;
  for (EGLint i = 0; i < count; ++i) {
    all.push_back(
        {EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], "EGL device " + std::to_string(i)});
  }
  return all;
}

}  // namespace

std::unique_ptr<Context> create_egl_context(bool software_too, std::vector<std::string>& refused) {
  std::vector<std::string> reasons;
  std::optional<Candidate> software;
  std::unique_ptr<EglBackend> taken;
  try {
    const Egl egl = load_egl();
    const std::vector<Candidate> all = candidates(egl);
    for (const Candidate& candidate : all) {
      try {
        auto context =
            std::make_unique<EglBackend>(egl, candidate.platform, candidate.native, candidate.name);
        if (!context->info().software) {
          taken = std::move(context);
          break;
        }
        if (!software) software = candidate;
        reasons.push_back(candidate.name + ": software (" + context->info().renderer + ")");
      } catch (const RenderError& error) {
        reasons.emplace_back(error.what());
      }
    }
    if (taken == nullptr && software && software_too) {
      taken = std::make_unique<EglBackend>(egl, software->platform, software->native, software->name);
      for (std::vector<std::string>* lines : {&reasons, &refused})
        std::erase_if(*lines,
                      [&](const std::string& line) { return line.rfind(software->name + ":", 0) == 0; });
    }
  } catch (const RenderError& error) {
    reasons.emplace_back(error.what());
  }
  for (std::string& reason : reasons) {
    if (std::find(refused.begin(), refused.end(), reason) == refused.end())
      refused.push_back(std::move(reason));
  }
  if (taken != nullptr) taken->set_refused(refused);
  return taken;
}

}  // namespace gnomon::render
