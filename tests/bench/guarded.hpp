// Ends a benchmark with one line where it cannot go on: a file that is not there, a driver that lacks
// something.
#pragma once

#include <cstdio>
#include <exception>

namespace gnomon {

/// What `run` returns; where it throws, one line after the program's name, and 2.
inline int guarded(const char* program, int (*run)(int, char**), int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", program, error.what());
    return 2;
  }
}

}  // namespace gnomon
