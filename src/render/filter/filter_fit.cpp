// What a filter can do without on the maps at hand. Candidates that store less are asked, the cheapest first,
// whether they answer like the settings asked for; most fail at one of the first receivers.
#include "gnomon/render/filter_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "base/random.hpp"
#include "filter/filter_block.hpp"
#include "filter/filter_parts.hpp"

namespace gnomon::render {
namespace {

/// One map with what its kernel weighs.
struct Map {
  const DrawnDepths& drawn;
  std::array<double, 4 * kTapVectors> weights{};
  int reach = 0;

  [[nodiscard]] double depth(int x, int y) const noexcept {
    if (x < 0 || y < 0 || x >= drawn.width || y >= drawn.height) return 1.0;
    const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(drawn.width);
    return static_cast<double>(drawn.depths[row + static_cast<std::size_t>(x)]);
  }
  /// As in shaders/pass/store/store.frag: of both steps the one that stays on the surface.
  [[nodiscard]] glm::dvec2 slope(int x, int y) const noexcept {
    const auto smaller = [](double before, double here, double after) {
      const double a = here - before, b = after - here;
      return std::abs(a) < std::abs(b) ? a : b;
    };
    const double here = depth(x, y);
    return {smaller(depth(x - 1, y), here, depth(x + 1, y)), smaller(depth(x, y - 1), here, depth(x, y + 1))};
  }
};

/// Receivers over one texel.
struct Place {
  std::size_t map;
  int x, y;
  std::vector<FilterLookup> lookups;
  std::vector<double> answers;  // of the settings asked for
};

void add(StoredTexel& sum, const StoredTexel& texel, double weight, const FilterSettings& s) noexcept {
  if (s.filter->reference.join != nullptr) {
    s.filter->reference.join(sum, texel, weight, s);
    return;
  }
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * texel[i];
}

StoredTexel rounded(StoredTexel texel, const FilterSettings& s) noexcept {
  if (s.filter->reference.pack != nullptr) texel = s.filter->reference.pack(texel, s);
  for (double& channel : texel) channel = rounded_to(s.format, channel);
  return texel;
}

/// As the passes store it, blurred along x, rounded, blurred along y, rounded, and as lookups read that.
StoredTexel stored_at(const Map& map, int x, int y, const FilterSettings& s) noexcept {
  const StoredTexel none =
      s.filter->reference.nothing != nullptr ? s.filter->reference.nothing(s) : StoredTexel{};
  const auto weight = [&](int i) { return map.weights[static_cast<std::size_t>(std::abs(i))]; };
  StoredTexel sum = none;
  for (int j = -map.reach; j <= map.reach; ++j) {
    StoredTexel row = none;
    for (int i = -map.reach; i <= map.reach; ++i)
      add(row, s.filter->reference.store(map.depth(x + i, y + j), map.slope(x + i, y + j), s), weight(i), s);
    add(sum, rounded(row, s), weight(j), s);
  }
  if (s.filter->reference.pack == nullptr) return rounded(sum, s);
  StoredTexel read = none;
  add(read, rounded(sum, s), 1.0, s);
  return read;
}

bool is_empty(const Map& map, int x, int y) noexcept {
  for (int j = -map.reach; j <= map.reach; ++j)
    for (int i = -map.reach; i <= map.reach; ++i)
      if (map.depth(x + i, y + j) < 1.0) return false;
  return true;
}

/// Whether more than a thousandth of the depth range lies between the texel and one next to it.
bool at_edge(const Map& map, int x, int y) noexcept {
  constexpr double kEdge = 1e-3;
  const double here = map.depth(x, y);
  return std::abs(map.depth(x + 1, y) - here) > kEdge || std::abs(map.depth(x, y + 1) - here) > kEdge;
}

void add_receiver(const Map& map, double depth, const glm::dvec2& gradient, double depth_max, Place& place) {
  FilterLookup lookup;
  lookup.map_depth = [&map](int x, int y) { return map.depth(x, y); };
  lookup.depth_max = depth_max;
  lookup.position = {place.x + 0.5, place.y + 0.5};
  lookup.depth = depth - map.drawn.bias;
  lookup.depth_gradient = gradient;
  lookup.box = glm::dvec2(std::max(map.drawn.half_side, 0.5));
  place.lookups.push_back(std::move(lookup));
}

/// The surface under the texel, the deepest one in the kernel, and some other depth of the map.
void add_receivers(const Map& map, double other, Place& place) {
  double least = 1.0, deepest = 0.0, any = 0.0;
  for (int j = -map.reach; j <= map.reach; ++j) {
    for (int i = -map.reach; i <= map.reach; ++i) {
      const double depth = map.depth(place.x + i, place.y + j);
      least = std::min(least, depth);
      any = std::max(any, depth);
      if (depth < 1.0) deepest = std::max(deepest, depth);
    }
  }
  const double here = map.depth(place.x, place.y);
  if (here < 1.0) add_receiver(map, here, map.slope(place.x, place.y), any, place);
  if (deepest > here || here == 1.0) add_receiver(map, deepest, {}, any, place);
  // In front of all that is stored everything is lit, whatever the filter.
  if (other > least) add_receiver(map, other, {}, any, place);
}

std::vector<Place> places_of(const std::vector<Map>& maps, const FilterFitOptions& options) {
  std::vector<Place> places;
  Random random(options.seed);
  for (std::size_t m = 0; m < maps.size(); ++m) {
    const Map& map = maps[m];
    if (map.drawn.width < 1 || map.drawn.height < 1) continue;
    const auto somewhere = [&] {
      return std::pair(random.pick(map.drawn.width), random.pick(map.drawn.height));
    };
    // Many texels are empty, and few are edges: so many are looked at for each that is taken.
    constexpr int kTries = 64;
    for (int i = 0; i < options.places; ++i) {
      for (int attempt = 0; attempt < kTries; ++attempt) {
        const auto [x, y] = somewhere();
        if (is_empty(map, x, y) || (i % 2 == 0 && attempt + 1 < kTries && !at_edge(map, x, y))) continue;
        const auto [other_x, other_y] = somewhere();
        places.push_back({m, x, y, {}, {}});
        add_receivers(map, map.depth(other_x, other_y), places.back());
        break;
      }
    }
  }
  return places;
}

/// With the options that the filter sets for each map by itself.
std::vector<FilterSettings> per_map(const FilterSettings& settings, const std::vector<Map>& maps) {
  std::vector<FilterSettings> all(maps.size(), settings);
  const Filter& filter = *settings.filter;
  for (std::size_t i = 0; i < maps.size(); ++i) all[i] = settings_for_map(settings, maps[i].drawn.world);
  if (filter.hooks.adapts == nullptr || !filter.hooks.adapts(settings)) return all;
  for (std::size_t i = 0; i < maps.size(); ++i) filter.hooks.adapt(all[i], maps[i].drawn.depths);
  return all;
}

/// How far answers are from those asked for.
struct Difference {
  double largest = 0.0;
  int above = 0;  // the bound
};

/// Stops at the first receiver more than `allowed` above the bound.
Difference difference_of(const FilterSettings& settings, const std::vector<Map>& maps,
                         const std::vector<Place>& places, double bound, int allowed) {
  const std::vector<FilterSettings> own = per_map(settings, maps);
  Difference result;
  for (const Place& place : places) {
    const FilterSettings& s = own[place.map];
    const StoredTexel texel = stored_at(maps[place.map], place.x, place.y, s);
    for (std::size_t i = 0; i < place.lookups.size(); ++i) {
      const double apart =
          std::abs(s.filter->reference.visibility(texel, place.lookups[i], s) - place.answers[i]);
      result.largest = std::max(result.largest, apart);
      result.above += apart <= bound ? 0 : 1;
      if (result.above > allowed) return result;
    }
  }
  return result;
}

/// The settings for the simpler filter: options of the same name, the kernel, and what it is read by.
FilterSettings settings_of_leaner(const FilterSettings& full) {
  FilterSettings lean = default_settings(*full.filter->info.leaner);
  lean.radius = full.radius;
  lean.unit = full.unit;
  lean.blur = full.blur;
  lean.mipmap = full.mipmap;
  lean.anisotropy = full.anisotropy;
  for (std::size_t i = 0; i < lean.filter->info.options.size(); ++i) {
    for (std::size_t k = 0; k < full.filter->info.options.size(); ++k) {
      if (full.filter->info.options[k].name == lean.filter->info.options[i].name)
        lean.option[i] = full.option[k];
    }
  }
  return lean;
}

/// Everything that takes fewer bytes than the settings asked for, the cheapest first.
std::vector<FilterSettings> candidates_of(const FilterSettings& full) {
  std::vector<FilterSettings> all;
  const auto add_all = [&](const FilterSettings& base) {
    const Filter& filter = *base.filter;
    const int terms = filter.info.terms_option;
    const double least = terms < 0 ? 0.0 : filter.info.options[static_cast<std::size_t>(terms)].min;
    const double most = terms < 0 ? 0.0 : base.option[static_cast<std::size_t>(terms)];
    for (const TexelFormat format : filter.info.formats) {
      for (double count = least; count <= most; count += 1.0) {
        FilterSettings candidate = base;
        candidate.format = format;
        if (terms >= 0) candidate.option[static_cast<std::size_t>(terms)] = count;
        settle_options(candidate);
        if (bytes_per_texel(candidate) < bytes_per_texel(full)) all.push_back(candidate);
      }
    }
  };
  add_all(full);
  if (full.filter->info.leaner != nullptr) add_all(settings_of_leaner(full));
  // Of equal bytes the one with fewer channels blurs and reads less; of those, more terms tell more.
  std::stable_sort(all.begin(), all.end(), [](const FilterSettings& a, const FilterSettings& b) {
    const double bytes_a = bytes_per_texel(a), bytes_b = bytes_per_texel(b);
    return bytes_a != bytes_b ? bytes_a < bytes_b : a.filter->info.channels(a) < b.filter->info.channels(b);
  });
  return all;
}

}  // namespace

FilterFit fit_filter(const FilterSettings& full, std::span<const DrawnDepths> drawn,
                     const FilterFitOptions& options) {
  const Filter& filter = *full.filter;
  FilterFit fit;
  fit.settings = full;
  fit.bytes = fit.full_bytes = bytes_per_texel(full);
  fit.channels = fit.full_channels = filter.info.channels != nullptr ? filter.info.channels(full) : 0;
  if (filter.info.reads == MapRead::depth || filter.info.reads == MapRead::summed) return fit;
  std::vector<Map> maps;
  for (const DrawnDepths& d : drawn) {
    maps.push_back({d, {}, 0});
    maps.back().reach = tap_weights(full.blur, d.half_side, maps.back().weights);
  }
  std::vector<Place> places = places_of(maps, options);
  const std::vector<FilterSettings> own = per_map(full, maps);
  for (Place& place : places) {
    const FilterSettings& s = own[place.map];
    const StoredTexel texel = stored_at(maps[place.map], place.x, place.y, s);
    for (const FilterLookup& lookup : place.lookups) {
      place.answers.push_back(filter.reference.visibility(texel, lookup, s));
      ++fit.receivers;
    }
  }
  if (fit.receivers == 0) return fit;
  const int allowed = static_cast<int>(options.exceptions * fit.receivers);
  for (const FilterSettings& candidate : candidates_of(full)) {
    const Difference difference = difference_of(candidate, maps, places, options.bound, allowed);
    if (difference.above > allowed) continue;
    fit.settings = candidate;
    fit.error = difference.largest;
    fit.exceeding = static_cast<double>(difference.above) / fit.receivers;
    fit.bytes = bytes_per_texel(candidate);
    fit.channels = candidate.filter->info.channels(candidate);
    break;
  }
  return fit;
}

std::string describe(const FilterFit& fit, const FilterSettings& full) {
  if (!fit.saves()) return {};
  char text[256];
  std::snprintf(
      text, sizeof text,
      "%s suffices for %s: at %d receivers of these maps visibility differs by at most %.2g of a step of "
      "8 bits; %.1f in place of %.1f bytes a texel",
      to_string(fit.settings).c_str(), to_string(full).c_str(), fit.receivers, 255.0 * fit.error, fit.bytes,
      fit.full_bytes);
  return text;
}

}  // namespace gnomon::render
