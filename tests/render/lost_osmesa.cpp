// Stands in for OSMesa: the real one, but its driver says that it was reset after GNOMON_TEST_RESET_AFTER
// questions. Loaded in its place by name, so that programs are tested as they are.
#include <dlfcn.h>

#include <cstdlib>
#include <cstring>

namespace {

template <class Function>
Function real(const char* name) {
  static void* const library = dlopen(GNOMON_REAL_OSMESA, RTLD_LAZY | RTLD_LOCAL);
  return reinterpret_cast<Function>(dlsym(library, name));
}

unsigned reset_status() {
  constexpr unsigned kNoError = 0, kUnknownContextReset = 0x8255;
  static int left = std::atoi(std::getenv("GNOMON_TEST_RESET_AFTER"));
  return left-- > 0 ? kNoError : kUnknownContextReset;
}

}  // namespace

extern "C" {
void* OSMesaCreateContextAttribs(const int* attributes, void* share) {
  return real<void* (*)(const int*, void*)>("OSMesaCreateContextAttribs")(attributes, share);
}
void OSMesaDestroyContext(void* context) {
  real<void (*)(void*)>("OSMesaDestroyContext")(context);
}
unsigned char OSMesaMakeCurrent(void* context, void* buffer, unsigned type, int width, int height) {
  return real<unsigned char (*)(void*, void*, unsigned, int, int)>("OSMesaMakeCurrent")(context, buffer, type,
                                                                                        width, height);
}
void* OSMesaGetProcAddress(const char* name) {
  if (std::strcmp(name, "glGetGraphicsResetStatus") == 0) return reinterpret_cast<void*>(reset_status);
  return real<void* (*)(const char*)>("OSMesaGetProcAddress")(name);
}
}
