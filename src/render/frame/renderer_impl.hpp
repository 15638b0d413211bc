// The parts a Renderer is made of, and who owns them.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "casters/caster_scene.hpp"
#include "frame/look_up_pass.hpp"
#include "frame/mask_history.hpp"
#include "frame/pane_pass.hpp"
#include "frame/screen.hpp"
#include "gl/pass_timer.hpp"
#include "gnomon/render/renderer.hpp"
#include "maps/caster_pass.hpp"
#include "picture/picture_pass.hpp"
#include "source/lists.hpp"
#include "source/maps.hpp"
#include "source/pages.hpp"
#include "source/pool.hpp"

namespace gnomon::render {

/// The sources; each makes its own programs with the first filter that is prepared for it.
struct Sources {
  MapSource maps;
  PageSource pages;
  bool reads_pages = false;          ///< a filter was prepared for them
  std::optional<PoolSource> lights;  ///< none until prepared
  std::optional<ListSource> lists;   ///< likewise

  /// The one that draws the frame: maps where another was not prepared, or cannot.
  [[nodiscard]] FrameSource& of(const FrameJob& frame) noexcept;
  /// Whatever the others store is lost; `but`: nullptr: that of all is.
  void lose(const FrameSource* but) noexcept;
};

struct Renderer::Impl {
  explicit Impl(const Scene& scene);

  /// The index of the filter's programs, which are compiled once.
  [[nodiscard]] std::size_t program_of(const FilterSettings& settings);
  /// The sequence of a frame.
  void draw(FrameJob& frame, FrameSource& source);
  /// Tells the other sources, and the history of the mask, of what the frame changes.
  void begin(FrameJob& frame, FrameSource& source);
  /// The mask, with contacts.
  void draw_mask(FrameJob& frame, FrameSource& source);
  void accumulate(const FrameJob& frame);
  /// The pictures besides the lit one.
  void draw_pictures(const FrameJob& frame, const PassTimer& timed) const;
  [[nodiscard]] const Framebuffer& framebuffer_of(Picture picture) const noexcept;

  Box bounds_world;  ///< of the scene at rest
  CasterScene casters;
  CasterPass caster_pass;
  Screen screen;
  MapTargets depths;  ///< shared by maps, pages and the pool of many lights
  std::vector<FilterPrograms> filters;
  Sources sources;
  LookUpPass contact_pass{"pass/mask/contacts.frag"}, accumulate_pass{"pass/mask/accumulate.frag"};
  MaskHistory history;
  PicturePass pictures;
  std::optional<PanePass> panes;     ///< made by Renderer::add_panes
  Pose pane_posed;                   ///< the last one applied to them; empty: none, or some moved since
  std::array<int, 2> screen_size{};  ///< of the default framebuffer, as last shown
};

}  // namespace gnomon::render
