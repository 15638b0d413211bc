// Maps in one texture, for C.
#include "c/convert.hpp"

namespace gnomon::c {
namespace {

// Corners of places then stay whole numbers of 32 bits.
constexpr std::int32_t kMaxSide = 1 << 26;

bool holds(const gnomon_atlas& atlas, const gnomon_texel_rect& place) noexcept {
  return place.x >= 0 && place.y >= 0 && place.width >= 1 && place.height >= 1 &&
         place.width <= atlas.width - place.x && place.height <= atlas.height - place.y;
}

}  // namespace

gnomon_atlas from_atlas(const Atlas& from) noexcept {
  gnomon_atlas to{};
  to.width = from.width;
  to.height = from.height;
  for (std::size_t i = 0; i < from.place.size(); ++i) to.place[i] = from_rect(from.place[i]);
  to.count = from.count;
  to.efficiency = from.efficiency;
  return to;
}

}  // namespace gnomon::c

using namespace gnomon;
using namespace gnomon::c;

extern "C" {

int32_t gnomon_pack_atlas(const gnomon_plan* plan, int32_t width, int32_t height, gnomon_atlas* atlas,
                          const char** invalid_field) {
  ShadowPlan p;
  if (const char* fault = to_plan(plan, p)) return refuse(fault, invalid_field);
  if (width < 0 || width > kMaxSide) return refuse("width", invalid_field);
  if (height < 0 || height > kMaxSide || (width == 0) != (height == 0))
    return refuse("height", invalid_field);
  if (atlas == nullptr) return refuse("atlas", invalid_field);
  *atlas = from_atlas(width == 0 ? pack_atlas(p) : pack_atlas(p, width, height));
  return done(invalid_field);
}

int32_t gnomon_atlas_from_clip(const gnomon_atlas* atlas, const gnomon_clip_space* clip_space, int32_t map,
                               double matrix[16], const char** invalid_field) {
  if (atlas == nullptr) return refuse("atlas", invalid_field);
  if (map < 0 || map >= atlas->count || map >= GNOMON_MAX_MAPS) return refuse("map", invalid_field);
  if (!holds(*atlas, atlas->place[map])) return refuse("atlas.place", invalid_field);
  if (matrix == nullptr) return refuse("atlas_from_clip", invalid_field);
  Atlas a;
  a.width = atlas->width;
  a.height = atlas->height;
  a.place[static_cast<std::size_t>(map)] = to_rect(atlas->place[map]);
  from_matrix(atlas_from_clip(a, to_clip_space(clip_space), map), matrix);
  return done(invalid_field);
}

}  // extern "C"
