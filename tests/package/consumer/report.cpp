// Takes a median through the installed report library.
#include <array>
#include <cstdio>

#include "all_headers.hpp"

int main() {
  const std::array<double, 3> values{3.0, 1.0, 2.0};
  const double median = gnomon::report::median(values);
  std::printf("consumer of report: median %g\n", median);
  return median == 2.0 ? 0 : 1;
}
