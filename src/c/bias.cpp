// The bias of a map in an engine's units, for C.
#include "c/convert.hpp"
#include "geometry/usable.hpp"
#include "gnomon/study/engine_bias.hpp"

using namespace gnomon;
using namespace gnomon::c;

extern "C" {

int32_t gnomon_translate_bias(const gnomon_plan* plan, int32_t map, int32_t way, double kernel_radius_texels,
                              int32_t depth_bits, gnomon_engine_bias* bias, const char** invalid_field) {
  ShadowPlan p;
  if (const char* fault = to_plan(plan, p)) return refuse(fault, invalid_field);
  if (map < 0 || map >= p.map_count) return refuse("map", invalid_field);
  if (way != GNOMON_BIAS_RASTERIZER && way != GNOMON_BIAS_NORMAL_OFFSET) return refuse("way", invalid_field);
  if (!(kernel_radius_texels >= 0.0 && usable(kernel_radius_texels)))
    return refuse("kernel_radius_texels", invalid_field);
  if (depth_bits < 0 || depth_bits > 32) return refuse("depth_bits", invalid_field);
  if (bias == nullptr) return refuse("bias", invalid_field);
  const ShadowMap& record = p.map[static_cast<std::size_t>(map)];
  if (!usable(p.bias.slope_texels)) return refuse("plan.bias_slope_texels", invalid_field);
  if (!usable(record.bias_world.constant)) return refuse("map.bias_constant", invalid_field);
  if (!usable(record.texel_world_max.x) || !usable(record.texel_world_max.y))
    return refuse("map.texel_world_max", invalid_field);
  const EngineBias found = engine_bias(record, p.bias, static_cast<BiasWay>(way), kernel_radius_texels);
  if (!usable(found.depth)) return refuse("map.depth_range_world", invalid_field);
  *bias = {found.depth, found.slope_factor, found.normal_world, rasterizer_units(found.depth, depth_bits)};
  return done(invalid_field);
}

}  // extern "C"
