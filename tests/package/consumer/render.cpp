// Opens a context through the installed renderer and looks a filter up.
#include <cstdio>

#include "all_headers.hpp"

int main() {
  const auto context = gnomon::render::create_context();
  std::printf("consumer of render: %s\n", context->info().description().c_str());
  return gnomon::render::find_filter("pcf") == nullptr ? 1 : 0;
}
