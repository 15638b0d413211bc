// Mesa's off-screen rendering, loaded at run time: newer Mesa no longer ships it, and linking it next to
// libGL makes both fight over the names of the gl functions.
#include <dlfcn.h>

#include <array>

#include "context/backend.hpp"

namespace gnomon::render {
namespace {

using OsMesaContext = struct osmesa_context*;
constexpr unsigned kGlUnsignedByte = 0x1401;
constexpr int kFormat = 0x22, kRgba = 0x1908, kDepthBits = 0x30, kProfile = 0x33, kCoreProfile = 0x34,
              kMajorVersion = 0x36, kMinorVersion = 0x37;  // GL/osmesa.h

struct OsMesa {
  OsMesaContext (*create)(const int* attributes, OsMesaContext share);
  void (*destroy)(OsMesaContext);
  unsigned char (*make_current)(OsMesaContext, void* buffer, unsigned type, int width, int height);
  void* (*get_proc_address)(const char* name);
};

OsMesa load_osmesa() {
  void* library = nullptr;
  for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}) {
    library = dlopen(name, RTLD_LAZY | RTLD_LOCAL);
    if (library != nullptr) break;
  }
  if (library == nullptr) throw RenderError("OSMesa: libOSMesa.so.8 is not installed");
  const auto symbol = [library](const char* name) {
    void* address = dlsym(library, name);
    if (address == nullptr) throw RenderError(std::string("OSMesa: the library has no ") + name);
    return address;
  };
  OsMesa osmesa{};
  osmesa.create = reinterpret_cast<decltype(osmesa.create)>(symbol("OSMesaCreateContextAttribs"));
  osmesa.destroy = reinterpret_cast<decltype(osmesa.destroy)>(symbol("OSMesaDestroyContext"));
  osmesa.make_current = reinterpret_cast<decltype(osmesa.make_current)>(symbol("OSMesaMakeCurrent"));
  osmesa.get_proc_address =
      reinterpret_cast<decltype(osmesa.get_proc_address)>(symbol("OSMesaGetProcAddress"));
  return osmesa;
}

class OsMesaBackend final : public Context {
 public:
  explicit OsMesaBackend(const std::vector<std::string>& refused) : osmesa_(load_osmesa()) {
    info_.refused = refused;
    const std::array<int, 12> attributes{kFormat,       kRgba, kDepthBits,    0, kProfile, kCoreProfile,
                                         kMajorVersion, 4,     kMinorVersion, 5, 0,        0};
    context_ = osmesa_.create(attributes.data(), nullptr);
    if (context_ == nullptr) throw RenderError("OSMesa: refuses an OpenGL 4.5 core context");
    info_.kind = ContextKind::osmesa;
    info_.platform = "OSMesa";
    try {
      bind(&info_);
    } catch (...) {
      osmesa_.destroy(context_);
      throw;
    }
  }
  ~OsMesaBackend() override { osmesa_.destroy(context_); }
  void make_current() override { bind(nullptr); }

 private:
  void bind(ContextInfo* info) {
    // A colour buffer is required but never drawn to: all passes draw into framebuffer objects.
    if (osmesa_.make_current(context_, pixel_.data(), kGlUnsignedByte, 1, 1) == 0) {
      throw RenderError("OSMesa: the context cannot be made current");
    }
    load_gl(osmesa_.get_proc_address, info);
  }

  OsMesa osmesa_;
  OsMesaContext context_ = nullptr;
  std::array<unsigned char, 4> pixel_{};
};

}  // namespace

std::unique_ptr<Context> create_osmesa_context(const std::vector<std::string>& refused) {
  return std::make_unique<OsMesaBackend>(refused);
}

}  // namespace gnomon::render
