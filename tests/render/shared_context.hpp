// One OpenGL context for all tests of a program: starting one costs more than most tests.
#pragma once

#include "gnomon/render/context.hpp"

namespace gnomon::render {

/// Current in every test.
[[nodiscard]] Context& shared_context();

}  // namespace gnomon::render
