// One number that every bit of a plan goes into.
#pragma once

#include <bit>
#include <cstdint>

#include "gnomon/gnomon.hpp"

namespace gnomon::test {

/// FNV-1a (Fowler, Noll, Vo 1991), 64 bits, over whole numbers of eight bytes.
class PlanHash {
 public:
  void add(std::uint64_t bits) noexcept {
    for (int i = 0; i < 8; ++i) {
      value_ ^= (bits >> (8 * i)) & 0xff;
      value_ *= 0x100000001b3ULL;
    }
  }
  void add(double v) noexcept { add(std::bit_cast<std::uint64_t>(v)); }
  void add(int v) noexcept { add(static_cast<std::uint64_t>(static_cast<std::int64_t>(v))); }
  template <typename Vector>
  void add_all(const Vector& v) noexcept {
    for (int i = 0; i < static_cast<int>(Vector::length()); ++i) add(static_cast<double>(v[i]));
  }
  void add(const ShadowMap& map) noexcept {
    for (int i = 0; i < 4; ++i) {
      add_all(map.clip_from_world[i]);
      add_all(map.clip_from_camera_relative[i]);
    }
    for (const double v :
         {map.depth_begin, map.depth_end, map.kappa, map.depth_range_world, map.m_s_max, map.m_t_max,
          map.storage, map.bias_world.constant, map.bias_world.slope, map.bias_world.normal_offset})
      add(v);
    for (const int v : {map.cascade, map.width, map.height, map.filter_margin_texels, map.cull_plane_count,
                        map.select_plane_count})
      add(v);
    add_all(map.light_world);
    add_all(map.texel_world);
    add_all(map.texel_world_max);
    for (int i = 0; i < map.cull_plane_count; ++i) add_all(map.cull_planes[static_cast<std::size_t>(i)]);
    for (int i = 0; i < map.select_plane_count; ++i) add_all(map.select_planes[static_cast<std::size_t>(i)]);
    for (const std::int64_t v :
         {map.snap_key.x, map.snap_key.y, map.snap_key.depth_near, map.snap_key.depth_far})
      add(static_cast<std::uint64_t>(v));
    for (const char c : map.warp->name) add(static_cast<int>(c));
  }
  void add(const ShadowPlan& plan) noexcept {
    add(static_cast<int>(plan.status));
    for (const ShadowMap& map : plan.maps()) add(map);
    for (const Omission& o : plan.omitted()) {
      add(static_cast<int>(o.kind));
      add(o.map);
      add(o.a);
      add(o.b);
    }
  }
  [[nodiscard]] std::uint64_t value() const noexcept { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace gnomon::test
