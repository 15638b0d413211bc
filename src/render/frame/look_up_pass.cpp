// Programs of passes that look maps up.
#include "frame/look_up_pass.hpp"

#include "gl/program.hpp"
#include "gnomon/render/error.hpp"

namespace gnomon::render {

Program LookUpPass::compiled(bool shaped) const {
  ShaderChoice choice;
  choice.shapes = shaped;
  return make_screen_program(shader_, choice);
}

void LookUpPass::prepare() {
  if (!linear_) linear_ = compiled(false);
}

const Program& LookUpPass::program(bool shaped) {
  if (!shaped) return linear_;
  if (!shaped_) {
    try {
      shaped_ = compiled(true);
    } catch (const RenderError&) {
      return linear_;  // A lost context compiles nothing; who drew the frame finds out from the context.
    }
  }
  return shaped_;
}

}  // namespace gnomon::render
