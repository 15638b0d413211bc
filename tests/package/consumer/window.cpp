// Opens a window. Where there is no display, the exception is caught by its own type.
#include <cstdio>

#include "all_headers.hpp"

int main() {
  try {
    const auto window = gnomon::render::create_window(16, 16, "consumer");
    std::printf("consumer of window: %s\n", window->info().description().c_str());
  } catch (const gnomon::render::RenderError& error) {
    std::printf("consumer of window: %s\n", error.what());
  }
  return 0;
}
