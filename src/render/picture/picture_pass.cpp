// Light, error and maps as pixels.
#include "picture/picture_pass.hpp"

#include "gl/program.hpp"

namespace gnomon::render {
namespace {

constexpr GLuint kExtraUnit = 7;  // as the shaders state it

}  // namespace

PicturePass::PicturePass(Screen& screen)
    : screen_(screen),
      shade_(make_screen_program({"pass/shade/shade.frag", {"panes/none"}})),
      aliasing_(make_screen_program("pass/mask/aliasing.frag")),
      heat_(make_screen_program("pass/shade/heat.frag")),
      tint_(make_screen_program("pass/shade/tint.frag")) {}

void PicturePass::shade(const FrameBlock& block, const glm::dvec3& camera_world, PanePass* panes) {
  const FrameTargets& targets = screen_.targets;
  screen_.bind_mask();
  if (panes != nullptr) glBindTextureUnit(kExtraUnit, panes->image().name());
  glEnable(GL_FRAMEBUFFER_SRGB);
  screen_.fullscreen(targets.color_fbo.name(), panes != nullptr ? panes->shade_program() : shade_);
  glDisable(GL_FRAMEBUFFER_SRGB);
  if (panes != nullptr) panes->draw_over(targets, block.clip_from_camera_relative, camera_world);
}

void PicturePass::aliasing() const noexcept {
  screen_.bind_mask();
  screen_.fullscreen(screen_.targets.aliasing_fbo.name(), aliasing_);
}

void PicturePass::heat_map() const noexcept {
  screen_.bind_mask();
  glBindTextureUnit(kExtraUnit, screen_.targets.aliasing.name());
  glEnable(GL_FRAMEBUFFER_SRGB);
  screen_.fullscreen(screen_.targets.heat_fbo.name(), heat_);
  glDisable(GL_FRAMEBUFFER_SRGB);
}

void PicturePass::cascade_tint() const noexcept {
  screen_.bind_mask();
  glBindTextureUnit(kExtraUnit, screen_.targets.color.name());
  glEnable(GL_FRAMEBUFFER_SRGB);
  screen_.fullscreen(screen_.targets.tint_fbo.name(), tint_);
  glDisable(GL_FRAMEBUFFER_SRGB);
}

}  // namespace gnomon::render
