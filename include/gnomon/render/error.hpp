// How do faults outside of our code appear? Drivers, shader compilers, missing libraries.
#pragma once

#include <stdexcept>

namespace gnomon::render {

/// Thrown while contexts, programs and buffers are made, never while a frame is drawn. what() says which
/// file, line or library, and why.
class RenderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace gnomon::render
