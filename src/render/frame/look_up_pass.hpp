// A pass over the pixels that looks maps up, whatever their shape.
#pragma once

#include <utility>

#include "gl/gl_object.hpp"
#include "gl/shader_text.hpp"

namespace gnomon::render {

/// Compiled for linear maps by the first use, and once more by the first frame whose maps have another shape:
/// software renderers run the places of all shapes.
class LookUpPass {
 public:
  explicit LookUpPass(ShaderName shader) : shader_(std::move(shader)) {}
  /// Compiles the program for linear maps, once. Throws RenderError.
  void prepare();
  /// For linear maps alone where the context was lost before a frame had others.
  [[nodiscard]] const Program& program(bool shaped);

 private:
  [[nodiscard]] Program compiled(bool shaped) const;

  ShaderName shader_;
  Program linear_, shaped_;
};

}  // namespace gnomon::render
