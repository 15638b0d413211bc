// What a frame can ask for, what it does ask for, and which source honours it.
#include "frame/options_in_use.hpp"

#include <algorithm>
#include <array>

#include "source/lists.hpp"
#include "source/maps.hpp"
#include "source/pages.hpp"
#include "source/pool.hpp"

namespace gnomon::render {
namespace {

struct Names {
  std::string_view name, what;
};
constexpr std::array<Names, kFrameOptionCount> kNames{{
#define GNOMON_FRAME_OPTION(name, what) {#name, what},
#include "gnomon/render/frame_options.def"
#include "gnomon/study/bias.hpp"
#undef GNOMON_FRAME_OPTION
}};

bool has_bent_maps(const FrameJob& frame) noexcept {
  const std::span<const DrawnLight> lights = frame.shadows.lights();
  return bends_lines(frame.plan) || std::any_of(lights.begin(), lights.end(), [](const DrawnLight& light) {
           return light.plan != nullptr && bends_lines(*light.plan);
         });
}

}  // namespace

std::string_view to_string(FrameOption option) noexcept {
  return kNames[static_cast<std::size_t>(option)].name;
}

std::string_view describe(FrameOption option) noexcept {
  return kNames[static_cast<std::size_t>(option)].what;
}

std::string to_string(const FrameOptionSet& options) {
  std::string text;
  for (std::size_t i = 0; i < kFrameOptionCount; ++i) {
    if (!options.has(static_cast<FrameOption>(i))) continue;
    if (!text.empty()) text += ", ";
    text += kNames[i].name;
  }
  return text;
}

std::span<const SourceSupport> source_supports() noexcept {
  static const std::array<SourceSupport, 6> all{MapSource::kSupport,  MapSource::kBentSupport,
                                                PageSource::kSupport, PoolSource::kSupport,
                                                ListSource::kSupport, MapSource::kIdentifierSupport};
  return all;
}

std::string source_table() {
  std::string head = "| a frame requests |", rule = "|--|", rows;
  for (const SourceSupport& source : source_supports()) {
    head.append(" ").append(source.name).append(" |");
    rule += ":-:|";
  }
  for (std::size_t i = 0; i < kFrameOptionCount; ++i) {
    rows.append("| ").append(kNames[i].what).append(" |");
    for (const SourceSupport& source : source_supports())
      rows += source.supports.has(static_cast<FrameOption>(i)) ? " yes |" : " |";
    rows += "\n";
  }
  return head + "\n" + rule + "\n" + rows;
}

FrameOptionSet options_in_use(const FrameJob& frame) noexcept {
  const FrameOptions& options = frame.options;
  FrameOptionSet used;
  used.add(FrameOption::transition, options.transition != SplitTransition::cut);
  used.add(FrameOption::noise, options.noise != SampleNoise::still);
  used.add(FrameOption::accumulation, options.accumulation.on);
  used.add(FrameOption::depth_layer, options.depth_layer != DepthLayer::front);
  used.add(FrameOption::linear_depth, options.linear_depth);
  used.add(FrameOption::map_passes, options.map_passes != MapPasses::automatic);
  used.add(FrameOption::receiver_plane, !options.receiver_plane);
  used.add(FrameOption::light, options.light != nullptr);
  used.add(FrameOption::aliasing, options.aliasing);
  used.add(FrameOption::heat_map, options.aliasing && options.heat_map);
  used.add(FrameOption::cascade_tint, options.cascade_tint);
  used.add(FrameOption::light_clusters, options.light_clusters != ClusterOptions{});
  used.add(FrameOption::moved_world, !options.moved_world.empty());
  constexpr std::array kRules{
      std::pair{FrameOption::small_casters, PruneRule::small_casters},
      std::pair{FrameOption::caster_clusters, PruneRule::caster_clusters},
      std::pair{FrameOption::alpha_test, PruneRule::alpha_test},
      std::pair{FrameOption::held_maps, PruneRule::held_maps},
      std::pair{FrameOption::scrolled_maps, PruneRule::scrolled_maps},
      std::pair{FrameOption::static_casters, PruneRule::static_casters},
      std::pair{FrameOption::unread_tiles, PruneRule::unread_tiles},
  };
  for (const auto& [option, rule] : kRules) used.add(option, options.prune.has(rule));
  used.add(FrameOption::panes, frame.panes != nullptr);
  used.add(FrameOption::contacts, frame.filter.settings.contacts);
  used.add(FrameOption::bent_maps, has_bent_maps(frame));
  return used;
}

}  // namespace gnomon::render
