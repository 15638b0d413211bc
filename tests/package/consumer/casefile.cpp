// Has the installed reader refuse a case: the exception is caught by its own type.
#include <cstdio>

#include "all_headers.hpp"

int main() {
  try {
    (void)gnomon::read_case("{}");
  } catch (const gnomon::CaseError& error) {
    std::printf("consumer of casefile: %s\n", error.what());
    return 0;
  }
  return 1;
}
