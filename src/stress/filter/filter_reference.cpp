// The passes of the renderer on the CPU, in double, for any filter of the registry.
#include <glad/gl.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string_view>

#include "filter/filter_block.hpp"
#include "filter/filter_parts.hpp"
#include "filter_harness.hpp"

namespace gnomon::render {
namespace {

/// A graphics card's bilinear weights have 8 bits; Mesa's rasterizers compute them in float.
bool weights_are_floats() {
  const GLubyte* renderer = glGetString(GL_RENDERER);
  const std::string_view name = renderer == nullptr ? "" : reinterpret_cast<const char*>(renderer);
  return name.find("llvmpipe") != name.npos || name.find("softpipe") != name.npos;
}

double smaller_step(double before, double here, double after) {
  return std::abs(here - before) < std::abs(after - here) ? here - before : after - here;
}

}  // namespace

FilterLookup lookup_of(const FilterSettings& settings, const TestMap& map, const Question& q) {
  FilterLookup lookup;
  lookup.map_depth = [&map](int x, int y) { return map.at(x, y); };
  lookup.silhouette = [&map](int x, int y) { return map.silhouette_at(x, y); };
  lookup.position = q.position;
  lookup.depth = q.depth;
  lookup.depth_gradient = q.depth_gradient;
  lookup.box = glm::dvec2(settings.radius + 0.5);
  lookup.disc = glm::dmat2(settings.radius + 0.5);
  lookup.texels_per_world = glm::dmat2(kTestTexelsPerWorld);
  lookup.ray = {q.depth, 1.0, 1.0 / kTestDepthRange, 0.0};
  lookup.rotation = q.rotation;
  lookup.pixel = q.pixel;
  lookup.ends_below = q.ends_below;
  lookup.ends_above = q.ends_above;
  lookup.longer_below = q.longer_below;
  lookup.longer_above = q.longer_above;
  if (settings.filter->hooks.needs_depth_max != nullptr && settings.filter->hooks.needs_depth_max(settings)) {
    // The pyramid's texels, as depth_max_in takes them.
    const double side = 2.0 * lookup.box.x;
    const int span = 1 << static_cast<int>(std::ceil(std::log2(std::max(side, 2.0))));
    const auto cell = [span](double at) { return static_cast<int>(std::floor(at / span)) * span; };
    double largest = 0.0;
    const glm::dvec2 low = lookup.position - lookup.box, high = lookup.position + lookup.box;
    for (int y = cell(low.y); y < cell(high.y) + span; ++y) {
      for (int x = cell(low.x); x < cell(high.x) + span; ++x) {
        if (x >= 0 && y >= 0 && x < map.width && y < map.height) largest = std::max(largest, map.at(x, y));
      }
    }
    lookup.depth_max = largest;
  }
  return lookup;
}

Reference::Reference(const FilterSettings& settings, const TestMap& map, Storing storing)
    : settings_(settings), map_(map), exact_(storing == Storing::exact) {
  const MapRead reads = settings.filter->info.reads;
  if (reads != MapRead::filtered && reads != MapRead::joined) return;
  std::array<double, 4 * kTapVectors> weights{};
  const int reach = tap_weights(settings.blur, settings.radius + 0.5, weights);
  const auto weight = [&weights](int tap) { return weights[static_cast<std::size_t>(std::abs(tap))]; };
  const auto index = [&map](int x, int y) { return static_cast<std::size_t>(y * map.width + x); };
  std::vector<StoredTexel> rows(map.depth.size());
  const StoredTexel outside = settings.filter->reference.store(1.0, glm::dvec2(0.0), settings);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      StoredTexel sum = nothing();
      for (int tap = -reach; tap <= reach; ++tap) join(sum, stored(x + tap, y), weight(tap));
      rows[index(x, y)] = rounded(sum);
    }
  }
  if (reach == 0) {
    blurred_ = rows;
    return;
  }
  blurred_.resize(rows.size());
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      StoredTexel sum = nothing();
      for (int tap = -reach; tap <= reach; ++tap) {
        const bool inside = y + tap >= 0 && y + tap < map.height;
        join(sum, inside ? rows[index(x, y + tap)] : outside, weight(tap));
      }
      blurred_[index(x, y)] = rounded(sum);
    }
  }
}

StoredTexel Reference::stored(int x, int y) const {
  const double here = map_.at(x, y);
  const glm::dvec2 slope{smaller_step(map_.at(x - 1, y), here, map_.at(x + 1, y)),
                         smaller_step(map_.at(x, y - 1), here, map_.at(x, y + 1))};
  return settings_.filter->reference.store(here, slope, settings_);
}

StoredTexel Reference::rounded(StoredTexel texel) const noexcept {
  if (settings_.filter->reference.pack != nullptr) texel = settings_.filter->reference.pack(texel, settings_);
  if (exact_) return texel;
  for (double& channel : texel) channel = rounded_to(settings_.format, channel);
  return texel;
}

void Reference::join(StoredTexel& sum, const StoredTexel& texel, double weight) const {
  if (settings_.filter->reference.join != nullptr)
    return settings_.filter->reference.join(sum, texel, weight, settings_);
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * texel[i];
}

StoredTexel Reference::nothing() const {
  return settings_.filter->reference.nothing != nullptr ? settings_.filter->reference.nothing(settings_)
                                                        : StoredTexel{};
}

StoredTexel Reference::mean_of_box(const glm::dvec2& position, const glm::dvec2& half_sides) const {
  const double steps = filter_block(settings_, {}).sums.x;
  const auto channels = static_cast<std::size_t>(settings_.filter->info.channels(settings_));
  const glm::dvec2 low = position - half_sides, high = position + half_sides;
  const auto overlap = [](int i, double a, double b) {
    return std::clamp(std::min(b, i + 1.0) - std::max(a, 1.0 * i), 0.0, 1.0);
  };
  StoredTexel sum{};
  double area = 0.0;
  for (int y = static_cast<int>(std::floor(low.y)); y < static_cast<int>(std::ceil(high.y)); ++y) {
    for (int x = static_cast<int>(std::floor(low.x)); x < static_cast<int>(std::ceil(high.x)); ++x) {
      if (x < 0 || y < 0 || x >= map_.width || y >= map_.height) continue;
      const double share = overlap(x, low.x, high.x) * overlap(y, low.y, high.y);
      const StoredTexel texel = stored(x, y);
      for (std::size_t i = 0; i < channels; ++i) {
        const double kept = std::clamp(texel[i], 0.0, 1.0);
        sum[i] += share * (exact_ ? kept : std::floor(kept * steps + 0.5) / steps);
      }
      area += share;
    }
  }
  for (double& channel : sum) channel /= std::max(area, 1e-6);
  return sum;
}

StoredTexel Reference::texel(const glm::dvec2& position) const {
  if (settings_.filter->info.reads == MapRead::depth) return {};
  if (settings_.filter->info.reads == MapRead::summed)
    return mean_of_box(position, glm::dvec2(settings_.radius + 0.5));
  StoredTexel sum = nothing();
  for (const Weighed& corner : corners(position)) {
    if (corner.weight > 0.0) join(sum, *corner.texel, corner.weight);
  }
  return sum;
}

std::array<Reference::Weighed, 4> Reference::corners(const glm::dvec2& position) const {
  const glm::dvec2 first{std::floor(position.x - 0.5), std::floor(position.y - 0.5)};
  const glm::dvec2 part = position - 0.5 - first;
  std::array<Weighed, 4> all;
  for (int corner = 0; corner < 4; ++corner) {
    const int dx = corner & 1, dy = corner >> 1;
    const int x = std::clamp(static_cast<int>(first.x) + dx, 0, map_.width - 1);
    const int y = std::clamp(static_cast<int>(first.y) + dy, 0, map_.height - 1);
    all[static_cast<std::size_t>(corner)] = {
        &blurred_[static_cast<std::size_t>(y * map_.width + x)],
        (dx == 0 ? 1.0 - part.x : part.x) * (dy == 0 ? 1.0 - part.y : part.y), glm::dvec2(x, y) + 0.5};
  }
  return all;
}

Question Reference::moved_to(const Weighed& corner, Question question) const {
  const FilterLookup lookup = lookup_of(settings_, map_, question);
  question.depth = static_cast<float>(plane_depth(lookup, corner.position - lookup.position));
  return question;
}

double Reference::value(const StoredTexel& texel, const Question& question, const StoredTexel& change) const {
  FilterLookup lookup = lookup_of(settings_, map_, question);
  lookup.mean_of_box = [&](const glm::dvec2& half_sides) {
    StoredTexel mean = mean_of_box(question.position, half_sides);
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += change[i];
    return mean;
  };
  return settings_.filter->reference.visibility(texel, lookup, settings_);
}

double Reference::answer(const Question& question) const {
  if (!settings_.filter->reference.interpolates) return value(texel(question.position), question, {});
  double lit = 0.0;
  for (const Weighed& corner : corners(question.position))
    lit += corner.weight * value(*corner.texel, moved_to(corner, question), {});
  return lit;
}

double Reference::bound(const Question& question) const {
  if (!settings_.filter->reference.interpolates) return bound_of(texel(question.position), question);
  double sum = 0.0;
  for (const Weighed& corner : corners(question.position))
    sum += corner.weight * bound_of(*corner.texel, moved_to(corner, question));
  return sum;
}

double Reference::bound_of(const StoredTexel& here, const Question& question) const {
  // Up to 65 products are added per pass, in float, twice; then four by the hardware.
  constexpr double kSumRounding = 2.0 * 65.0 * 0x1p-24, kDepthRounding = 4.0 * 0x1p-24,
                   kResultRounding = 1e-5;
  const double known = value(here, question, {});
  double sum = kResultRounding;
  const auto add = [&](const StoredTexel& change, const Question& asked) {
    StoredTexel changed = here;
    for (std::size_t i = 0; i < changed.size(); ++i) changed[i] += change[i];
    sum += std::abs(value(changed, asked, change) - known);
  };
  const int channels =
      settings_.filter->info.channels == nullptr ? 0 : settings_.filter->info.channels(settings_);
  const double weights = weights_are_floats() ? 0.0 : 1.0 / 512.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(channels); ++i) {
    double spread = 0.0;
    for (const glm::dvec2 step : {glm::dvec2(-1, 0), glm::dvec2(1, 0), glm::dvec2(0, -1), glm::dvec2(0, 1)}) {
      if (weights > 0.0)
        spread = std::max(spread, std::abs(texel(glm::dvec2(question.position) + step)[i] - here[i]));
    }
    const double size = is_unsigned_unit(settings_.format) ? 1.0 : std::max(std::abs(here[i]), 0x1p-14);
    // Whole steps are what a sum of integers rounds texels to.
    const double step = exact_ && settings_.filter->info.reads == MapRead::summed
                            ? 0.5 / filter_block(settings_, {}).sums.x
                            : 0.0;
    const double change =
        size * (2.0 * rounding_of(settings_.format) + kSumRounding) + spread * weights + step;
    for (const double sign : {-1.0, 1.0}) {
      StoredTexel changed{};
      changed[i] = sign * change;
      add(changed, question);
    }
  }
  for (const double sign : {-1.0, 1.0}) {
    Question moved = question;
    moved.depth += static_cast<float>(sign * kDepthRounding);
    add({}, moved);
  }
  return sum;
}

std::vector<double> ask_reference(const FilterSettings& settings, const TestMap& map,
                                  const std::vector<Question>& questions) {
  const Reference reference(settings, map);
  std::vector<double> answers;
  for (const Question& q : questions) answers.push_back(reference.answer(q));
  return answers;
}

}  // namespace gnomon::render
