// Draws pages: neighbours together into the image of their block, from which each goes to its slot.
#include "renderer_impl.hpp"

namespace gnomon::render {
namespace {

constexpr float kFarthest = 1.0f;

void take_rectangle(const TexelRect& at) noexcept {
  glScissor(at.x, at.y, at.width, at.height);
}

/// From one layer into another.
void copy_depths(const Texture& from, const TexelRect& at, int layer, const Texture& into,
                 const TexelRect& to, int to_layer) noexcept {
  glCopyImageSubData(from.name(), GL_TEXTURE_2D_ARRAY, 0, at.x, at.y, layer, into.name(), GL_TEXTURE_2D_ARRAY,
                     0, to.x, to.y, to_layer, at.width, at.height, 1);
}

TexelRect in_block(const BlockPage& page) noexcept {
  return {page.block.x, page.block.y, page.drawn.place.width, page.drawn.place.height};
}

}  // namespace

void Renderer::Impl::draw_pages(const ShadowPlan& of_light, const DepthDraw& how, int block_side) noexcept {
  glBindVertexArray(scene.vertex_array());
  scene.use(SceneBuffers::Placed::for_maps);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDisable(GL_CULL_FACE);
  glEnable(GL_SCISSOR_TEST);
  if (!pages.in_runs()) {
    draw_each_page(of_light, how);
  } else {
    if (!pages.runs().empty()) page_stage.fit(block_side, pages.runs().size());
    const auto layers = static_cast<std::size_t>(page_stage.layers);
    for (std::size_t run = 0; run < pages.runs().size(); run += layers)
      draw_page_runs(run, std::min(run + layers, pages.runs().size()), how);
  }
  glDisable(GL_SCISSOR_TEST);
}

void Renderer::Impl::draw_page_runs(std::size_t first, std::size_t last, const DepthDraw& how) noexcept {
  // All copies before or after all draws: each waits for what is being drawn into its images.
  const auto each_page = [&](auto&& act) {
    for (std::size_t i = first; i < last; ++i)
      for (const BlockPage& page : pages.pages_of(pages.runs()[i])) act(page, i, static_cast<int>(i - first));
  };
  const auto draw = [&](std::size_t run, const DrawnPart& part, bool clear) {
    page_stage.attach(static_cast<int>(run - first));
    glViewport(0, 0, page_stage.side, page_stage.side);
    take_rectangle(pages.drawn()[run].place);
    if (clear) {
      glDisable(GL_SCISSOR_TEST);
      glClearNamedFramebufferfv(page_stage.fbo.name(), GL_DEPTH, 0, &kFarthest);
      glEnable(GL_SCISSOR_TEST);
    }
    draw_casters(part, pages.drawn()[run].clip_from_position, how);
  };
  each_page([&](const BlockPage& page, std::size_t, int layer) {
    const DrawnPage& at = page.drawn;
    if (!at.composed) return;
    maps.add_beneath();
    // Without static depths of its own it shows static casters alone.
    if (!at.has_beneath) {
      maps.copy(MapTargets::Of::static_casters, at.layer, at.place);
      pages.add_beneath(at.slot);
    }
    copy_depths(maps.beneath, at.place, at.layer, page_stage.depth, in_block(page), layer);
  });
  for (std::size_t i = first; i < last; ++i)
    if (!pages.drawn()[i].composed) draw(i, lists.page_part(i), true);
  each_page([&](const BlockPage& page, std::size_t run, int layer) {
    if (page.drawn.composed || !lists.draws(lists.moving_part(run))) return;
    maps.add_beneath();
    copy_depths(page_stage.depth, in_block(page), layer, maps.beneath, page.drawn.place, page.drawn.layer);
    pages.add_beneath(page.drawn.slot);
  });
  for (std::size_t i = first; i < last; ++i)
    if (lists.draws(lists.moving_part(i))) draw(i, lists.moving_part(i), false);
  each_page([&](const BlockPage& page, std::size_t, int layer) {
    copy_depths(page_stage.depth, in_block(page), layer, maps.depth, page.drawn.place, page.drawn.layer);
  });
}

void Renderer::Impl::draw_each_page(const ShadowPlan& of_light, const DepthDraw& how) noexcept {
  for (std::size_t i = 0; i < pages.drawn().size(); ++i) {
    const DrawnPage& page = pages.drawn()[i];
    glNamedFramebufferTextureLayer(maps.fbo.name(), GL_DEPTH_ATTACHMENT, maps.depth.name(), 0, page.layer);
    glBindFramebuffer(GL_FRAMEBUFFER, maps.fbo.name());
    const TexelRect& at = page.place;
    // Clipping to the viewport alone lets triangles that pass by a local light spill a row into the next
    // page.
    take_rectangle(at);
    glViewport(at.x, at.y, at.width, at.height);
    glClearNamedFramebufferfv(maps.fbo.name(), GL_DEPTH, 0, &kFarthest);
    draw_casters(lists.page_part(i), page.clip_from_position, how);
    if (!info_of(how.layer).peels) continue;
    peel(lists.page_part(i), at, page.layer, page.clip_from_position, how, how.peeled(of_light, page.map));
  }
}

}  // namespace gnomon::render
