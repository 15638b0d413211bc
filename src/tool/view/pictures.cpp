// The views that are painted on the CPU from what the renderer measured, and their legends.
#include "pictures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "float_channel.hpp"
#include "gnomon/extend/shape.hpp"
#include "gnomon/render/picture.hpp"
#include "gnomon/report/errors.hpp"
#include "lines.hpp"
#include "picture_colors.hpp"

namespace gnomon::tool::view {
namespace {

using render::Color;

constexpr Color kPale{150, 152, 158}, kGround{24, 24, 28};

std::size_t pixels_of(const FloatImage& image) {
  return image.values.size() / static_cast<std::size_t>(image.channels);
}

double first_channel(const FloatImage& image, std::size_t pixel) {
  return static_cast<double>(image.values[pixel * static_cast<std::size_t>(image.channels)]);
}

}  // namespace

Image mask_picture(const FloatImage& mask, const FloatImage& normals) {
  Image image = render::blank_image(mask.width, mask.height, kSky);
  for (std::size_t i = 0; i < pixels_of(mask); ++i) {
    if (normals.values[4 * i + 3] > 0.0f) set_pixel(image, i, mixed(kShadow, kLit, first_channel(mask, i)));
  }
  return image;
}

Image truth_picture(int width, int height, std::span<const trace::Verdict> verdicts,
                    const FloatImage& normals) {
  Image image = render::blank_image(width, height, kSky);
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (std::size_t i = 0; i < count; ++i) {
    if (!(normals.values[4 * i + 3] > 0.0f)) continue;
    if (i >= verdicts.size()) {
      set_pixel(image, i, kPale);
      continue;
    }
    // Surfaces turned away from the light are dark without any map, as in a mask.
    const Color color = verdicts[i] == trace::Verdict::lit         ? kLit
                        : verdicts[i] == trace::Verdict::undecided ? kUndecided
                                                                   : kShadow;
    set_pixel(image, i, color);
  }
  return image;
}

Image misclassified_picture(const FloatImage& mask, std::span<const trace::Verdict> verdicts,
                            const FloatImage& normals) {
  Image image = render::blank_image(mask.width, mask.height, kSky);
  for (std::size_t i = 0; i < pixels_of(mask); ++i) {
    if (i >= verdicts.size()) {
      set_pixel(image, i, kPale);
      continue;
    }
    const trace::Verdict verdict = verdicts[i];
    if (!(normals.values[4 * i + 3] > 0.0f)) continue;
    if (verdict == trace::Verdict::none) set_pixel(image, i, kPale);  // turned away, or unlit
    if (verdict == trace::Verdict::none) continue;
    if (verdict == trace::Verdict::undecided) {
      set_pixel(image, i, kUndecided);
      continue;
    }
    const double truth = verdict == trace::Verdict::lit ? 1.0 : 0.0, error = first_channel(mask, i) - truth;
    set_pixel(image, i, error_color(truth, error));
  }
  return image;
}

std::vector<float> lit_of(std::span<const trace::Verdict> verdicts, std::size_t pixels) {
  std::vector<float> lit(pixels, -1.0f);
  for (std::size_t i = 0; i < std::min(verdicts.size(), lit.size()); ++i) {
    if (verdicts[i] == trace::Verdict::lit) lit[i] = 1.0f;
    if (verdicts[i] == trace::Verdict::shadow) lit[i] = 0.0f;
  }
  return lit;
}

report::MaskErrors errors_of(const FloatImage& mask, std::span<const trace::Verdict> verdicts) {
  constexpr int kReach = 3;  // pixels
  const std::vector<float> truth = lit_of(verdicts, pixels_of(mask));
  return report::mask_errors(channel(mask, 0), truth, report::uniform_truth(truth, mask.width, kReach));
}

double flips_between(const FloatImage& before, const FloatImage& after) {
  // Neither the light nor the eye moved between them: the truth is the same wherever a map serves.
  const auto truth_of = [](const FloatImage& mask) {
    std::vector<float> truth(pixels_of(mask));
    for (std::size_t i = 0; i < truth.size(); ++i) truth[i] = mask.values[2 * i + 1] < 0.0f ? -1.0f : 1.0f;
    return truth;
  };
  return report::excess_flips(channel(before, 0), channel(after, 0), truth_of(before), truth_of(after));
}

Image checker_picture(const Image& lit, const FloatImage& mask, const FloatImage& positions,
                      const std::function<const ShadowMap*(int)>& map_of, const Camera& camera) {
  Image image = lit;
  for (std::size_t i = 0; i < pixels_of(mask); ++i) {
    const ShadowMap* const map = map_of(static_cast<int>(mask.values[2 * i + 1]));
    const float* at = &positions.values[4 * i];
    if (map == nullptr || !(at[3] > 0.0f)) continue;
    const glm::dvec4 clip =
        map->clip_from_world * glm::dvec4(camera.position + glm::dvec3(at[0], at[1], at[2]), 1.0);
    if (!(clip.w > 0.0)) continue;
    const glm::dvec2 texel = map->texels().place(glm::dvec2(clip) / clip.w).texel / double{kCheckerTexels};
    const bool dark =
        (static_cast<long long>(std::floor(texel.x)) + static_cast<long long>(std::floor(texel.y))) % 2 != 0;
    const Color now{lit.rgba[4 * i], lit.rgba[4 * i + 1], lit.rgba[4 * i + 2]};
    set_pixel(image, i, mixed(now, dark ? kShadow : kLit, 0.45));
  }
  return image;
}

Image difference_picture(const Image& a, const Image& b, double gain) {
  constexpr double kMost = 255.0;
  Image image = render::blank_image(a.width, a.height, kPale);
  const std::size_t count = std::min(a.rgba.size(), b.rgba.size()) / 4;
  for (std::size_t i = 0; i < count; ++i) {
    int most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const int apart = int{a.rgba[4 * i + c]} - int{b.rgba[4 * i + c]};
      if (std::abs(apart) > std::abs(most)) most = apart;
    }
    if (most != 0)
      set_pixel(image, i, mixed(kPale, most > 0 ? kFalseLight : kFalseShadow, gain * std::abs(most) / kMost));
  }
  return image;
}

namespace {

/// Where the texels of a map lie in a picture: as large as it allows, y upwards.
struct MapFrame {
  double scale = 1.0;
  glm::dvec2 corner{0.0};  ///< of texel (0, 0)
  [[nodiscard]] glm::dvec2 pixel(const glm::dvec2& texel) const {
    return corner + glm::dvec2(texel.x, -texel.y) * scale;
  }
};

MapFrame frame_of(const ShadowMap& map, int width, int height) {
  constexpr double kRoom = 0.94;  // of the picture: lines beyond the map's edges show as well
  MapFrame frame;
  frame.scale = kRoom * std::min(1.0 * width / map.width, 1.0 * height / map.height);
  frame.corner = {0.5 * (width - frame.scale * map.width), 0.5 * (height + frame.scale * map.height)};
  return frame;
}

void add_rectangle(const MapFrame& frame, const glm::dvec2& low, const glm::dvec2& high,
                   const glm::u8vec4& color, double line_width, std::vector<ScreenLine>& lines) {
  const std::array<glm::dvec2, 4> corner{frame.pixel(low), frame.pixel({high.x, low.y}), frame.pixel(high),
                                         frame.pixel({low.x, high.y})};
  for (std::size_t i = 0; i < 4; ++i) lines.push_back({corner[i], corner[(i + 1) % 4], color, line_width});
}

/// A line of the world in the map. It bends under shapes that are not affine: drawn in pieces.
void add_line(const MapFrame& frame, const ShadowMap& map, const WorldLine& line,
              std::vector<ScreenLine>& lines) {
  constexpr int kPieces = 8;
  const int pieces = map.shape->affine ? 1 : kPieces;
  const auto place = [&](double t, glm::dvec2& pixel) {
    const glm::dvec4 clip = map.clip_from_world * glm::dvec4(line.from + (line.to - line.from) * t, 1.0);
    if (!(clip.w > 0.0)) return false;
    pixel = frame.pixel(map.texels().place(glm::dvec2(clip) / clip.w).texel);
    return true;
  };
  glm::dvec2 from, to;
  for (int i = 0; i < pieces; ++i) {
    if (place(1.0 * i / pieces, from) && place(1.0 * (i + 1) / pieces, to))
      lines.push_back({from, to, line.color, line.width});
  }
}

Image depth_image(const FloatImage& depths, const MapFrame& frame, int width, int height) {
  Image image = render::blank_image(width, height, kGround);
  // The depths that are there, not 0 to 1: few scenes use all of it.
  float nearest = 1.0f, farthest = 0.0f;
  for (const float depth : depths.values) {
    if (depth >= 1.0f) continue;
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  constexpr Color kNothing{58, 60, 70};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const glm::dvec2 texel = glm::dvec2(x + 0.5 - frame.corner.x, frame.corner.y - y - 0.5) / frame.scale;
      if (!(texel.x >= 0.0 && texel.y >= 0.0 && texel.x < depths.width && texel.y < depths.height)) continue;
      const float depth =
          depths.values[static_cast<std::size_t>(texel.y) * static_cast<std::size_t>(depths.width) +
                        static_cast<std::size_t>(texel.x)];
      const double share =
          farthest > nearest ? static_cast<double>((depth - nearest) / (farthest - nearest)) : 0.0;
      set_pixel(image,
                static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x),
                depth >= 1.0f ? kNothing : mixed(kLit, {70, 72, 80}, share));
    }
  }
  return image;
}

constexpr glm::u8vec4 kBorderLine{240, 228, 66, 255}, kCasterLine{0, 158, 115, 110},
    kBodyLine{213, 94, 0, 255};

}  // namespace

MapPicture map_picture(const FloatImage& depths, const ShadowPlan& plan, int index, const Camera& camera,
                       const Box& scene, const std::vector<Box>& boxes, int width, int height) {
  const ShadowMap& map = plan.map[static_cast<std::size_t>(index)];
  const MapFrame frame = frame_of(map, width, height);
  MapPicture picture{depth_image(depths, frame, width, height), {}};
  ShadowPlan only = plan;
  only.map[0] = map;
  only.map_count = 1;
  std::vector<Box> drawn(boxes.size());
  std::vector<std::uint32_t> list(boxes.size());
  const std::size_t count = cull_casters(map, boxes, list);
  for (std::size_t i = 0; i < std::min(count, list.size()); ++i) drawn[i] = boxes[list[i]];
  // More boxes than this are a green cloud.
  constexpr std::size_t kMaxBoxes = 600;
  if (count <= kMaxBoxes) {
    drawn.resize(count);
    for (WorldLine line : plan_lines(only, camera, drawn, scene, {false, false, false, true})) {
      line.color = kCasterLine;
      add_line(frame, map, line, picture.lines);
    }
  }
  for (const WorldLine& line : body_lines(map, camera, scene, kBodyLine))
    add_line(frame, map, line, picture.lines);
  const glm::dvec2 size(map.width, map.height), border(map.filter_margin_texels);
  add_rectangle(frame, {0.0, 0.0}, size, {200, 200, 205, 255}, 1.0, picture.lines);
  add_rectangle(frame, border, size - border, kBorderLine, 1.0, picture.lines);
  return picture;
}

Image field_legend(const std::string& title, const std::vector<std::pair<Color, std::string>>& fields,
                   int picture_width) {
  std::vector<render::LegendEntry> entries;
  int widest = render::text_width(title);
  for (const auto& [color, text] : fields) {
    entries.push_back({color, text});
    widest = std::max(widest, render::text_width(text) + 24);
  }
  Image sheet =
      render::blank_image(std::min(widest + 32, std::max(picture_width, 64)),
                          20 + (render::text_height() + 4) * (static_cast<int>(fields.size()) + 1), kGround);
  render::draw_legend(sheet, title, entries);
  return sheet;
}

Image legend(View view, const ShadowPlan& plan, int picture_width) {
  std::vector<std::pair<Color, std::string>> fields;
  switch (view) {
    case View::heat:
      return render::heat_legend(picture_width);
    case View::cascades:
      for (std::size_t i = 0; i < plan.maps().size(); ++i) {
        const ShadowMap& map = plan.map[i];
        fields.emplace_back(render::cascade_color(static_cast<int>(i)),
                            fmt::format("map {}: depth {:.4g} to {:.4g}, {}x{}, {}", i, map.depth_begin,
                                        map.depth_end, map.width, map.height, map.warp->name));
      }
      return field_legend(fields.empty() ? "no map: " + std::string(to_string(plan.status)) : "shadow maps",
                          fields, picture_width);
    case View::misclassified:
      return field_legend(
          "against exact rays",
          {{kFalseLight, "false light"}, {kFalseShadow, "false shadow"}, {kUndecided, "undecided: an edge"}},
          picture_width);
    case View::map:
      return field_legend("depth map: light grey is near the light",
                          {{Color(kBodyLine), "receivers' body"},
                           {Color(kBorderLine), "border"},
                           {Color(kCasterLine), "casters"}},
                          picture_width);
    case View::lit:
    case View::mask:
    case View::checker:
    case View::truth:
    case View::kept:  // its legend counts what the frame did
      break;
  }
  return {};
}

Image label(const std::string& text) {
  Image image = render::blank_image(render::text_width(text) + 10, render::text_height() + 8, kGround);
  render::draw_text(image, 5, 4, text, {235, 235, 230});
  return image;
}

}  // namespace gnomon::tool::view
