// Store and blur in two passes at most, mip-maps and sums only where the filter reads them.
#include "filter/stored_maps.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include "filter/stored_images.hpp"
#include "gl/program.hpp"
#include "gnomon/render/error.hpp"
#include "gnomon/render/page_filter.hpp"

namespace gnomon::render {
namespace {

constexpr GLint kMapLocation = 0;
constexpr GLuint kSumsImage = 0;
constexpr int kRowsPerGroup = 32;  ///< local_size_x of sum_rows.comp and sum_columns.comp
constexpr GLint kWalkLocation = 1, kVectorLocation = 2, kLevelsLocation = 1;
/// Compilers unroll loops over 31 taps; wider kernels are rare.
constexpr int kMaxWalkReach = 15;

GLuint groups_of(int count, int each) noexcept {
  return static_cast<GLuint>((count + each - 1) / each);
}

std::uint64_t area(const glm::ivec2& size) noexcept {
  return static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y);
}

/// The part of pass/mask/mask.frag.
std::string read_part(MapRead reads) {
  switch (reads) {
    case MapRead::depth:
      return "read/depth";
    case MapRead::filtered:
      return "read/filtered";
    case MapRead::joined:
      return "read/joined";
    case MapRead::summed:
      return "read/summed";
  }
  return "";
}

ShaderName store_shader(const Filter& filter, const char* file, const char* target = "target/map") {
  return {"pass/store/" + std::string(file), {target, filter_part(filter.info.name)}};
}

/// Marks the tiles that the mask of whole maps reads.
ShaderName mark_shader(const Filter& filter) {
  return {"pass/mask/mask.frag", {"source/maps", "read/tiles", filter_part(filter.info.name)}};
}

/// What the shaders of one variant of a filter are compiled for. `shapes`: for maps of any shape.
ShaderChoice choice_for(const FilterVariant& variant, bool shapes) {
  return {variant.vectors,
          variant.reads_slope,
          variant.reads == MapRead::filtered,
          std::max(variant.reach, 0),
          variant.channels,
          0,
          shapes};
}

int full_chain(int width, int height) noexcept {
  return static_cast<int>(std::bit_width(static_cast<unsigned>(std::max(width, height))));
}

}  // namespace

ShaderName mask_shader(const Filter& filter, MapRead reads, std::string source) {
  return {"pass/mask/mask.frag", {std::move(source), read_part(reads), filter_part(filter.info.name)}};
}

std::vector<ShaderName> filter_shaders(const Filter& filter, MapRead reads) {
  std::vector<ShaderName> all{mask_shader(filter, reads, "source/maps")};
  const auto add = [&](const char* file) { all.push_back(store_shader(filter, file)); };
  if (reads == MapRead::filtered || reads == MapRead::joined) {
    for (const char* file : {"store_rows.comp", "blur_columns.comp", "store.frag", "blur.frag"}) add(file);
    all.push_back(mark_shader(filter));
  }
  if (reads == MapRead::joined && filter.info.may_mipmap) add("join_mip.frag");
  if (reads == MapRead::summed) {
    for (const char* file : {"sum_rows.comp", "sum_columns.comp"}) add(file);
  }
  if (filter.hooks.needs_depth_max != nullptr) add("depth_max.frag");
  return all;
}

std::vector<ShaderName> pages_shaders(const Filter& filter, MapRead reads) {
  if (reads == MapRead::summed || filter.info.draws_silhouettes) return {};
  std::vector<ShaderName> all{mask_shader(filter, reads, "source/pages")};
  if (reads == MapRead::depth) return all;
  for (const char* file : {"store.frag", "blur.frag"})
    all.push_back(store_shader(filter, file, "target/page"));
  return all;
}

std::vector<ShaderName> lights_shaders(const Filter& filter, MapRead reads) {
  if (reads != MapRead::depth || filter.info.draws_silhouettes) return {};
  return {mask_shader(filter, reads, "source/pool"),
          {"pass/shade/clusters.frag", {"source/clusters", read_part(reads), filter_part(filter.info.name)}}};
}

FilterVariant variant_of(const FilterSettings& settings) noexcept {
  const Filter& filter = *settings.filter;
  FilterVariant variant{&filter, shadow_vectors(settings), reads_of(settings), false, 0, 1};
  if (filter.info.channels != nullptr) variant.channels = filter.info.channels(settings);
  if (filter.info.reads == MapRead::depth) return variant;
  variant.reads_slope = filter.hooks.reads_slope != nullptr && filter.hooks.reads_slope(settings);
  if (filter.info.reads == MapRead::summed) return variant;
  variant.reach = FilterVariant::kAnyReach;
  if (settings.unit == KernelUnit::world) return variant;
  std::array<double, 4 * kTapVectors> weights{};
  const int reach = settings.radius > 0.0 ? tap_weights(settings.blur, settings.radius + 0.5, weights) : 0;
  if (reach <= kMaxWalkReach) variant.reach = reach;
  return variant;
}

namespace {

/// The first or the second of lights_shaders().
Program make_pool_program(const FilterSettings& settings, std::size_t which) {
  const FilterInfo& info = settings.filter->info;
  if (settings.contacts) {
    throw RenderError("filter " + std::string(info.name) +
                      ": contacts take a pass over the pixels of one plan, and a pool of lights has none");
  }
  if (covers_pixel(settings)) {
    throw RenderError(
        "filter " + std::string(info.name) +
        ": kernels as wide as a pixel read beyond the border of a map, and a pool of lights has "
        "other maps there");
  }
  if (info.reads != MapRead::depth || info.draws_silhouettes) {
    throw RenderError("filter " + std::string(info.name) + ": " +
                      (info.draws_silhouettes ? "reads outlines beside" : "stores texels of") +
                      " whole maps, and a pool of lights has depths alone");
  }
  // Light plans have linear maps only.
  return make_screen_program(lights_shaders(*settings.filter, info.reads).at(which),
                             choice_for(variant_of(settings), false));
}

}  // namespace

void make_pages_programs(const FilterSettings& settings, FilterPrograms& programs) {
  const std::string_view refusal = page_filter_refusal(settings);
  if (!refusal.empty())
    throw RenderError("filter " + std::string(settings.filter->info.name) + ": " + std::string(refusal));
  if (programs.mask_pages) return;
  const ShaderChoice choice = choice_for(programs.variant, false);  // pages have even texels
  const std::vector<ShaderName> shaders = pages_shaders(*settings.filter, programs.variant.reads);
  programs.mask_pages = make_screen_program(shaders[0], choice);
  if (programs.variant.reads == MapRead::depth) return;
  programs.store_page = make_screen_program(shaders[1], choice);
  programs.blur_page = make_screen_program(shaders[2], choice);
}

Program make_lights_program(const FilterSettings& settings) {
  return make_pool_program(settings, 0);
}

Program make_clusters_program(const FilterSettings& settings) {
  return make_pool_program(settings, 1);
}

void make_shaped_programs(const FilterSettings& settings, FilterPrograms& programs) {
  if (programs.shaped_mask) return;
  const ShaderChoice choice = choice_for(programs.variant, true);
  const Filter& filter = *settings.filter;
  programs.shaped_mask =
      make_screen_program(mask_shader(filter, programs.variant.reads, "source/maps"), choice);
  if (programs.mark) programs.shaped_mark = make_screen_program(mark_shader(filter), choice);
}

FilterPrograms make_filter_programs(const FilterSettings& settings) {
  FilterPrograms programs;
  programs.variant = variant_of(settings);
  const bool any_reach = programs.variant.reach == FilterVariant::kAnyReach;
  ShaderChoice choice = choice_for(programs.variant, false);
  const std::vector<ShaderName> shaders = filter_shaders(*settings.filter, programs.variant.reads);
  programs.mask = make_screen_program(shaders.front(), choice);
  const auto find = [&](const std::string& file) {
    return std::find_if(shaders.begin(), shaders.end(),
                        [&](const ShaderName& each) { return each.path == "pass/store/" + file; });
  };
  const auto make = [&](Program& program, const std::string& file) {
    const auto shader = find(file);
    if (shader == shaders.end()) return;
    program = file.ends_with(".comp") ? make_compute_program(*shader, choice)
                                      : make_screen_program(*shader, choice);
  };
  const auto rows = find("store_rows.comp");
  if (any_reach) {
    make(programs.store, "store.frag");
    make(programs.blur, "blur.frag");
  } else if (rows != shaders.end()) {
    const bool blurs = programs.variant.reach > 0;
    if (blurs) make(programs.blur_columns, "blur_columns.comp");
    const int count = blurs ? programs.variant.vectors : 1;
    for (choice.vector = 0; choice.vector < count; ++choice.vector)
      programs.store_rows.push_back(make_compute_program(*rows, choice));
  }
  if (rows != shaders.end()) programs.mark = make_screen_program(mark_shader(*settings.filter), choice);
  make(programs.join_mip, "join_mip.frag");
  make(programs.sum_rows, "sum_rows.comp");
  make(programs.sum_columns, "sum_columns.comp");
  make(programs.depth_max, "depth_max.frag");
  return programs;
}

StoredMaps::StoredMaps() {
  // Integers cannot be read through linear samplers, also where only single texels are fetched.
  glSamplerParameteri(nearest_sampler_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
  glSamplerParameteri(nearest_sampler_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

bool StoredMaps::fit(const FilterPrograms& programs, const FilterSettings& settings, const StoreJob& job,
                     bool blurred) {
  const Filter& filter = *settings.filter;
  const bool stores = filter.info.reads != MapRead::depth;
  Shape wanted;
  wanted.width = job.layer_width;
  wanted.height = job.layer_height;
  wanted.layers = std::max(static_cast<int>(job.map_size.size()), 1);
  wanted.levels = job.mipmaps ? full_chain(job.layer_width, job.layer_height) : 1;
  wanted.vectors = stores ? programs.variant.vectors : 0;
  wanted.format = stores ? stored_format(settings) : 0;
  wanted.scratch = blurred;
  wanted.walks = !programs.store_rows.empty();
  wanted.depth_max = filter.hooks.needs_depth_max != nullptr && filter.hooks.needs_depth_max(settings);
  Shape same_but_fewer = shape_;
  if (wanted.layers < shape_.layers) same_but_fewer.layers = wanted.layers;
  if (wanted == same_but_fewer) return false;
  shape_ = wanted;
  bytes_ = scratch_bytes_ = 0;
  stored_.clear();
  scratch_.clear();
  depth_max_ = {};
  for (int i = 0; i < wanted.vectors; ++i) {
    stored_.push_back(
        array_image(wanted.format, wanted.levels, wanted.width, wanted.height, wanted.layers, bytes_));
    if (wanted.scratch && (i == 0 || !wanted.walks))
      scratch_.push_back(array_image(wanted.format, 1, wanted.width, wanted.height, 1, scratch_bytes_));
  }
  if (wanted.depth_max) {
    const int width = std::max(wanted.width / 2, 1), height = std::max(wanted.height / 2, 1);
    depth_max_ = array_image(GL_R32F, full_chain(width, height), width, height, wanted.layers, bytes_);
  }
  stored_fbo_ = make_framebuffer();
  scratch_fbo_ = make_framebuffer();
  draw_into_all(stored_fbo_, std::max<std::size_t>(stored_.size(), 1));
  draw_into_all(scratch_fbo_, std::max<std::size_t>(scratch_.size(), 1));
  attach_images(scratch_fbo_, scratch_, 0, 0);
  return true;
}

bool StoredMaps::made_alike(const FilterSettings& settings, const FilterBlock& block) noexcept {
  // The block has the rest of the settings, and no padding.
  const bool alike = made_with_.filter == settings.filter && made_with_.format == settings.format &&
                     std::memcmp(&made_block_, &block, sizeof block) == 0;
  made_with_ = settings;
  made_block_ = block;
  return alike;
}

void StoredMaps::draw(GLuint fbo, glm::ivec2 size) {
  glBindFramebuffer(GL_FRAMEBUFFER, fbo);
  glViewport(0, 0, size.x, size.y);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  ++passes_;
}

void StoredMaps::blur_map(const FilterPrograms& programs, GLint map, bool blurred) {
  attach_images(stored_fbo_, stored_, 0, map);
  tiles_.list(map, viewport_, programs.variant.reach);  // counts them; the passes look at the states
  tiles_.bind_for_reads();
  glUseProgram(programs.store.name());
  glUniform1i(kMapLocation, map);
  draw(blurred ? scratch_fbo_.name() : stored_fbo_.name(), viewport_);
  if (!blurred) return;
  glUseProgram(programs.blur.name());
  glUniform1i(kMapLocation, map);
  bind_images(scratch_, nearest_sampler_);
  draw(stored_fbo_.name(), viewport_);
}

void StoredMaps::walk_rows(const Program& program, GLint map, std::span<const Texture> into, GLint layer) {
  for (std::size_t i = 0; i < into.size(); ++i)
    glBindImageTexture(static_cast<GLuint>(i), into[i].name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, shape_.format);
  glUseProgram(program.name());
  glUniform1i(kMapLocation, map);
  glUniform4i(kWalkLocation, viewport_.x, viewport_.y, layer, tiles_.per_layer());
  tiles_.dispatch(FilterTiles::List::rows);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void StoredMaps::walk_columns(const FilterPrograms& programs, GLint map, std::size_t vector) {
  glBindImageTexture(0, stored_[vector].name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, shape_.format);
  glBindTextureUnit(kStoredUnit, scratch_[0].name());
  glBindSampler(kStoredUnit, nearest_sampler_.name());
  glUseProgram(programs.blur_columns.name());
  glUniform1i(kMapLocation, map);
  glUniform4i(kWalkLocation, viewport_.x, viewport_.y, map, tiles_.per_layer());
  glUniform1i(kVectorLocation, static_cast<GLint>(vector));
  tiles_.dispatch(FilterTiles::List::tiles);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

void StoredMaps::walk_map(const FilterPrograms& programs, GLint map) {
  tiles_.list(map, viewport_, programs.variant.reach);
  if (programs.variant.reach == 0) {
    walk_rows(programs.store_rows[0], map, stored_, map);
    ++passes_;
    return;
  }
  // Windows of many vectors do not fit into registers: each vector is blurred by itself.
  for (std::size_t i = 0; i < stored_.size(); ++i) {
    walk_rows(programs.store_rows[i], map, {scratch_.data(), 1}, 0);
    walk_columns(programs, map, i);
    passes_ += 2;
  }
}

void StoredMaps::join_mips(const FilterPrograms& programs, const StoreJob& job, const Held& held) {
  glUseProgram(programs.join_mip.name());
  bind_images(stored_, nearest_sampler_);
  for (GLint map = 0; map < static_cast<GLint>(job.map_size.size()); ++map) {
    if (held[static_cast<std::size_t>(map)]) continue;
    glUniform1i(kMapLocation, map);
    for (GLint level = 1; level < shape_.levels; ++level) {
      // Reading and drawing different levels of one image is defined only where the levels read are the only
      // ones in reach.
      for (const Texture& image : stored_) {
        glTextureParameteri(image.name(), GL_TEXTURE_BASE_LEVEL, level - 1);
        glTextureParameteri(image.name(), GL_TEXTURE_MAX_LEVEL, level - 1);
      }
      attach_images(stored_fbo_, stored_, level, map);
      draw(stored_fbo_.name(), {std::max(shape_.width >> level, 1), std::max(shape_.height >> level, 1)});
    }
  }
  for (const Texture& image : stored_) {
    glTextureParameteri(image.name(), GL_TEXTURE_BASE_LEVEL, 0);
    glTextureParameteri(image.name(), GL_TEXTURE_MAX_LEVEL, shape_.levels - 1);
  }
}

void StoredMaps::sum_map(const FilterPrograms& programs, GLint map, const StoreJob& job) {
  glBindImageTexture(kSumsImage, stored_[0].name(), 0, GL_TRUE, 0, GL_READ_WRITE, shape_.format);
  glUseProgram(programs.sum_rows.name());
  glUniform1i(kMapLocation, map);
  glDispatchCompute(groups_of(job.layer_height, kRowsPerGroup), 1, 1);
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  glUseProgram(programs.sum_columns.name());
  glUniform1i(kMapLocation, map);
  glDispatchCompute(groups_of(job.layer_width, kRowsPerGroup), 1, 1);
  passes_ += 2;
}

void StoredMaps::build_depth_max(const FilterPrograms& programs, const StoreJob& job, const Held& held) {
  const int width = std::max(shape_.width / 2, 1), height = std::max(shape_.height / 2, 1);
  const int levels = full_chain(width, height);
  const Framebuffer fbo = make_framebuffer();
  glUseProgram(programs.depth_max.name());
  for (GLint map = 0; map < static_cast<GLint>(job.map_size.size()); ++map) {
    if (held[static_cast<std::size_t>(map)]) continue;
    glUniform1i(kMapLocation, map);
    for (GLint level = 0; level < levels; ++level) {
      if (level > 0) {
        glTextureParameteri(depth_max_.name(), GL_TEXTURE_BASE_LEVEL, level - 1);
        glTextureParameteri(depth_max_.name(), GL_TEXTURE_MAX_LEVEL, level - 1);
      }
      glBindTextureUnit(kDepthUnit, level == 0 ? job.depth : depth_max_.name());
      glNamedFramebufferTextureLayer(fbo.name(), GL_COLOR_ATTACHMENT0, depth_max_.name(), level, map);
      draw(fbo.name(), {std::max(width >> level, 1), std::max(height >> level, 1)});
    }
  }
  glTextureParameteri(depth_max_.name(), GL_TEXTURE_BASE_LEVEL, 0);
  glTextureParameteri(depth_max_.name(), GL_TEXTURE_MAX_LEVEL, levels - 1);
  glBindTextureUnit(kDepthUnit, job.depth);
}

StoredMaps::Held StoredMaps::keep_whole(const StoreJob& job) noexcept {
  Held held{};
  for (std::size_t i = 0; i < job.map_size.size(); ++i) {
    held[i] = job.held[i] && made_[i].depths;
    made_[i] = {true, true, 0};
  }
  return held;
}

StoredMaps::Held StoredMaps::choose_tiles(const FilterPrograms& programs, const StoreJob& job) {
  // Marking in one frame after the other must not come to more than filling all tiles once.
  constexpr int kMaxMarks = 4;
  Held held{};
  tiles_.fit(shape_.width, shape_.height, shape_.layers);
  const glm::ivec2 layer{shape_.width, shape_.height};
  whole_texels_ = 0;
  bool marks = false;
  for (std::size_t i = 0; i < job.map_size.size(); ++i) {
    Made& made = made_[i];
    const bool kept = job.held[i] && made.depths;
    held[i] = kept && made.whole;
    if (held[i]) continue;
    const bool all = !job.mark_read || made.marks == kMaxMarks;
    tiles_.keep(static_cast<GLint>(i), {kept, all});
    made = {true, all, all ? 0 : kept ? made.marks + 1 : 1};
    if (!kept) whole_texels_ += area(job.mipmaps ? layer : job.map_size[i]);
    marks = marks || !all;
  }
  if (marks) {
    tiles_.bind_for_marks();
    glUseProgram(programs.mark_for(job.shaped).name());
    glUniform1i(kLevelsLocation, job.mipmaps ? shape_.levels : 1);
    job.mark_read();
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    glDisable(GL_DEPTH_TEST);
    glBindVertexArray(no_vertices_.name());
  }
  return held;
}

void StoredMaps::build(const FilterPrograms& programs, const FilterSettings& settings,
                       const FilterBlock& block, const StoreJob& job) {
  passes_ = 0;
  const std::size_t maps = job.map_size.size();
  const bool any_blur =
      std::any_of(block.reach.begin(), block.reach.begin() + static_cast<std::ptrdiff_t>(maps),
                  [](const glm::ivec4& reach) { return reach.x > 0; });
  const bool alike = made_alike(settings, block);
  const bool fresh = fit(programs, settings, job, any_blur && (programs.blur || programs.blur_columns));
  if (!alike || fresh) made_ = {};
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glBindVertexArray(no_vertices_.name());
  const Held held = programs.mark ? choose_tiles(programs, job) : keep_whole(job);
  glBindTextureUnit(kDepthUnit, job.depth);
  glBindSampler(kDepthUnit, nearest_sampler_.name());
  for (std::size_t i = 0; i < maps; ++i) {
    if (held[i]) continue;
    const auto map = static_cast<GLint>(i);
    // Beyond the map nothing is read but by mip-maps.
    viewport_ = job.mipmaps ? glm::ivec2(job.layer_width, job.layer_height) : job.map_size[i];
    if (!programs.store_rows.empty()) walk_map(programs, map);
    if (programs.store) blur_map(programs, map, block.reach[i].x > 0);
    if (programs.sum_rows) sum_map(programs, map, job);
  }
  if (programs.sum_rows) glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  if (!programs.store_rows.empty())
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                    GL_FRAMEBUFFER_BARRIER_BIT);
  if (shape_.depth_max) build_depth_max(programs, job, held);
  const bool mipmaps = job.mipmaps && shape_.levels > 1 && maps > 0;
  const bool any = std::find(held.begin(), held.begin() + static_cast<std::ptrdiff_t>(maps), false) !=
                   held.begin() + static_cast<std::ptrdiff_t>(maps);
  if (!any) {
    // What shrinks is as it was, too.
  } else if (mipmaps && programs.join_mip) {
    join_mips(programs, job, held);
  } else if (mipmaps) {
    for (const Texture& image : stored_) glGenerateTextureMipmap(image.name());
    ++passes_;
  }
  const bool smooth = programs.variant.reads == MapRead::filtered;
  const GLint shrinking = !smooth ? GL_NEAREST_MIPMAP_NEAREST : GL_LINEAR_MIPMAP_LINEAR;
  glSamplerParameteri(stored_sampler_.name(), GL_TEXTURE_MIN_FILTER,
                      mipmaps ? shrinking : (smooth ? GL_LINEAR : GL_NEAREST));
  glSamplerParameteri(stored_sampler_.name(), GL_TEXTURE_MAG_FILTER, smooth ? GL_LINEAR : GL_NEAREST);
  glSamplerParameteri(stored_sampler_.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glSamplerParameteri(stored_sampler_.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void StoredMaps::bind() const noexcept {
  bind_images(stored_, stored_sampler_);
  glBindTextureUnit(kDepthMaxUnit, depth_max_.name());
  glBindSampler(kDepthMaxUnit, nearest_sampler_.name());
}

}  // namespace gnomon::render
