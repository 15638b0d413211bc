// Standard output as a file that can fail: a plan that did not arrive must not look like success.
#include "output.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>

namespace gnomon::tool {
namespace {

[[noreturn]] void fail() {
  throw std::runtime_error(std::string("standard output: ") + std::strerror(errno));
}

}  // namespace

void print_line(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fputc('\n', stdout) == EOF)
    fail();
}

void flush_output() {
  if (std::fflush(stdout) != 0) fail();
}

}  // namespace gnomon::tool
