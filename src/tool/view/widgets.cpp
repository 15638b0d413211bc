// Widgets for the options of a plan and of a filter, made from the tables that command lines read.
#include "widgets.hpp"

#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "option_words.hpp"

namespace gnomon::tool::view {
namespace {

const ImVec4 kChanged{0.94f, 0.78f, 0.35f, 1.0f};  ///< the name of an option that is not at its default

/// A number that may be typed: what is not finite is undone.
bool edit_double(const char* label, double& value, double speed, double least, double most,
                 const char* format = "%.4g") {
  const double before = value;
  const bool bounded = least < most;
  // What spans decades is set by its ratio.
  constexpr double kDecades = 1e4;
  const ImGuiSliderFlags scale =
      least > 0.0 && most > kDecades * least ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None;
  const bool changed = bounded ? ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &least, &most,
                                                     format, ImGuiSliderFlags_AlwaysClamp | scale)
                               : ImGui::DragScalar(label, ImGuiDataType_Double, &value,
                                                   static_cast<float>(speed), nullptr, nullptr, format);
  if (!std::isfinite(value)) value = before;
  return changed;
}

/// Steps with a size: a hundredth of the value.
double speed_of(double value) {
  return std::max(std::abs(value), 0.1) * 0.01;
}

bool edit_int(const char* label, int& value, int least, int most) {
  constexpr int kSlider = 64;
  if (least < most && most - least <= kSlider)
    return ImGui::SliderInt(label, &value, least, most, "%d", ImGuiSliderFlags_AlwaysClamp);
  // Sizes double and halve.
  const float button = ImGui::GetFrameHeight(), gap = ImGui::GetStyle().ItemInnerSpacing.x;
  ImGui::PushID(label);
  ImGui::SetNextItemWidth(ImGui::CalcItemWidth() - 2.0f * (button + gap));
  bool changed = ImGui::InputInt("##value", &value, 0, 0, ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::SameLine(0.0f, gap);
  if (ImGui::Button("/2", {button, 0.0f})) changed = true, value /= 2;
  ImGui::SameLine(0.0f, gap);
  if (ImGui::Button("x2", {button, 0.0f})) changed = true, value = value > most / 2 ? most : value * 2;
  ImGui::SameLine(0.0f, gap);
  ImGui::TextUnformatted(label);
  ImGui::PopID();
  if (changed && least < most) value = std::clamp(value, least, most);
  return changed;
}

void edit_choice(const char* label, const PlanField& field, const PlanChoice& choice, PlanOptions& options) {
  std::vector<std::string> names = choice.names();
  // Only the words for whole sets are a list: rules may be joined by commas as well.
  std::erase_if(names, [](const std::string& name) { return name.find(' ') != std::string::npos; });
  const std::string now = choice.get(options);
  if (!ImGui::BeginCombo(label, now.c_str())) return tooltip(field.summary);
  for (const std::string& name : names) {
    if (ImGui::Selectable(name.c_str(), name == now)) (void)choice.set(name, options);
  }
  if (field.key == "prune") {
    ImGui::Separator();
    for (const PruneRuleInfo& rule : prune_rules()) {
      bool on = options.prune.has(rule.rule);
      if (ImGui::Checkbox(std::string(rule.name).c_str(), &on))
        options.prune = on ? options.prune.with(rule.rule) : options.prune.without(rule.rule);
      tooltip(rule.what);
    }
  }
  ImGui::EndCombo();
}

void edit_bias(BiasOptions& bias) {
  const BiasOptions none;
  const auto term = [](const char* label, double& value, double fallback, double most, const char* help) {
    if (value != fallback) ImGui::PushStyleColor(ImGuiCol_Text, kChanged);
    const bool changed_color = value != fallback;
    edit_double(label, value, 0.01, 0.0, most);
    if (changed_color) ImGui::PopStyleColor();
    tooltip(help);
  };
  term("bias constant", bias.constant_texels, none.constant_texels, 8.0,
       "along the light, in texels, everywhere: covers depth rounding");
  term("bias slope", bias.slope_texels, none.slope_texels, 8.0,
       "along the light, in texels times tan(angle between normal and light)");
  term("bias normal", bias.normal_offset_texels, none.normal_offset_texels, 8.0,
       "along the surface normal, in texels times sin(angle)");
  term("bias max slope", bias.max_slope, none.max_slope, 64.0, "cap of tan(angle)");
}

void edit_clip_space(ClipSpace& clip) {
  int depth = static_cast<int>(clip.ndc_depth), hand = static_cast<int>(clip.handedness),
      row = static_cast<int>(clip.first_row);
  if (choose("ndc depth", depth, {"minus_one_to_one", "zero_to_one"}))
    clip.ndc_depth = static_cast<NdcDepth>(depth);
  tooltip("range of depths after the division by w: matrices change, the picture does not");
  ImGui::Checkbox("reversed z", &clip.reversed_z);
  ImGui::SameLine();
  ImGui::Checkbox("y down", &clip.y_down);
  if (choose("handedness", hand, {"right", "left"})) clip.handedness = static_cast<Handedness>(hand);
  if (choose("first row", row, {"y_minus_one", "y_plus_one"})) clip.first_row = static_cast<FirstRow>(row);
}

void edit_focus(Box& focus) {
  bool on = !focus.empty();
  if (ImGui::Checkbox("focus box", &on)) focus = on ? Box{{-1, -1, -1}, {1, 1, 1}} : Box{};
  tooltip("box whose error is weighted by focus_weight");
  if (!on) return;
  edit_vector("focus min", focus.min, speed_of(focus.max.x - focus.min.x), "least corner, world units");
  edit_vector("focus max", focus.max, speed_of(focus.max.x - focus.min.x), "largest corner, world units");
}

void edit_planes(WarpPlanes& planes) {
  for (std::size_t i = 0; i < planes.size(); ++i) {
    WarpPlane& plane = planes[i];
    bool on = plane.thickness != 0.0;
    if (ImGui::Checkbox(fmt::format("plane {}", i + 1).c_str(), &on)) plane.thickness = on ? 0.05 : 0.0;
    tooltip("a map of its own for receivers near this plane: one texel per pixel on it");
    if (!on) continue;
    const auto label = [i](const char* what) { return fmt::format("{} {}", what, i + 1); };
    edit_vector(label("point").c_str(), plane.point_world, 0.05, "any point on the plane, world units");
    const glm::dvec3 before = plane.normal;
    edit_vector(label("normal").c_str(), plane.normal, 0.01, "across the plane, of any length above 0");
    if (plane.normal == glm::dvec3(0.0)) plane.normal = before;
    edit_double(label("thickness").c_str(), plane.thickness, speed_of(plane.thickness), 1e-9, 1e30);
    tooltip("how far receivers may lie off the plane, to each side, world units");
  }
}

void edit_splits(const PlanOptions& options, SplitDepths& given) {
  if (options.split.scheme != SplitScheme::given) return;
  for (int i = 0; i + 1 < options.cascades; ++i) {
    double& depth = given[static_cast<std::size_t>(i)];
    if (!std::isfinite(depth)) depth = i == 0 ? 10.0 : given[static_cast<std::size_t>(i - 1)] * 2.0;
    edit_double(fmt::format("split {}", i + 1).c_str(), depth, speed_of(depth), 0.0, 0.0);
    tooltip("view depth where a cascade ends and the next begins, world units");
  }
}

template <class Value>
bool edit_value(const char* label, const PlanField& field, Value& value) {
  if constexpr (std::is_same_v<Value, bool>) {
    return ImGui::Checkbox(label, &value);
  } else if constexpr (std::is_same_v<Value, int>) {
    return edit_int(label, value, static_cast<int>(field.least), static_cast<int>(field.most));
  } else if constexpr (std::is_same_v<Value, std::int64_t>) {
    return ImGui::InputScalar(label, ImGuiDataType_S64, &value, nullptr, nullptr, "%lld",
                              ImGuiInputTextFlags_EnterReturnsTrue);
  } else {
    double shown = value / field.unit;
    constexpr double kSlider = 1000.0;
    const bool slider = field.most > field.least && field.most - field.least <= kSlider;
    const bool changed =
        edit_double(label, shown, speed_of(shown), slider ? field.least : 0.0, slider ? field.most : 0.0);
    if (changed) {
      if (field.most > field.least) shown = std::clamp(shown, field.least, field.most);
      value = std::max(shown, 0.0) * field.unit;
    }
    return changed;
  }
}

/// Resets on a right click. Returns true where the option is not at its default.
template <class Value>
void edit_plain(const PlanField& field, Value& value, const Value& fallback) {
  const std::string label(field.key);
  const bool differs = value != fallback;
  if (differs) ImGui::PushStyleColor(ImGuiCol_Text, kChanged);
  edit_value(label.c_str(), field, value);
  if (differs) ImGui::PopStyleColor();
  if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) value = fallback;
  std::string text = std::string(field.summary);
  if (!field.must.empty()) text += " (" + std::string(field.must) + ")";
  if constexpr (!std::is_same_v<Value, bool>)
    text += "; default " +
            number_word(static_cast<double>(fallback) / (std::is_same_v<Value, double> ? field.unit : 1.0));
  tooltip(text + "; right click resets");
}

}  // namespace

void tooltip(std::string_view text) {
  if (text.empty() || !ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 26.0f);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool choose(const char* label, int& index, const std::vector<std::string>& names,
            const std::vector<std::string>& help) {
  bool changed = false;
  const std::string& now =
      names[static_cast<std::size_t>(std::clamp(index, 0, static_cast<int>(names.size()) - 1))];
  if (!ImGui::BeginCombo(label, now.c_str(), ImGuiComboFlags_HeightLarge)) return false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (ImGui::Selectable(names[i].c_str(), static_cast<int>(i) == index)) {
      changed = static_cast<int>(i) != index;
      index = static_cast<int>(i);
    }
    if (i < help.size()) tooltip(help[i]);
  }
  ImGui::EndCombo();
  return changed;
}

void edit_vector(const char* label, glm::dvec3& v, double speed, const char* help) {
  const glm::dvec3 before = v;
  ImGui::DragScalarN(label, ImGuiDataType_Double, &v.x, 3, static_cast<float>(speed), nullptr, nullptr,
                     "%.3g");
  constexpr double kMost = 1e30;
  if (!(std::abs(v.x) <= kMost && std::abs(v.y) <= kMost && std::abs(v.z) <= kMost)) v = before;
  tooltip(help);
}

void edit_plan_field(const PlanField& field, PlanOptions& options) {
  const std::string label(field.key);
  // Set from the filter, whose panel has them.
  if (label.starts_with("filter_radius")) return;
  PlanOptions none;
  std::visit(
      [&](const auto& place) {
        using Place = std::remove_cvref_t<decltype(place)>;
        if constexpr (std::is_same_v<Place, PlanChoice>) {
          const bool differs = place.get(options) != place.get(none);
          if (differs) ImGui::PushStyleColor(ImGuiCol_Text, kChanged);
          edit_choice(label.c_str(), field, place, options);
          if (differs) ImGui::PopStyleColor();
          if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) (void)place.set(place.get(none), options);
        } else if constexpr (std::is_same_v<Place, PlanMember<Box>>) {
          edit_focus(place(options));
        } else if constexpr (std::is_same_v<Place, PlanMember<BiasOptions>>) {
          edit_bias(place(options));
        } else if constexpr (std::is_same_v<Place, PlanMember<ClipSpace>>) {
          edit_clip_space(place(options));
        } else if constexpr (std::is_same_v<Place, PlanMember<SplitDepths>>) {
          edit_splits(options, place(options));
        } else if constexpr (std::is_same_v<Place, PlanMember<WarpPlanes>>) {
          edit_planes(place(options));
        } else {
          edit_plain(field, place(options), place(none));
        }
      },
      field.place);
}

namespace {

void edit_stored_texels(render::FilterSettings& settings) {
  const render::FilterInfo& info = settings.filter->info;
  if (!info.formats.empty()) {
    std::vector<std::string> names;
    int at = 0;
    for (const render::TexelFormat format : info.formats) {
      if (format == settings.format) at = static_cast<int>(names.size());
      names.emplace_back(to_string(format));
    }
    if (choose("format", at, names)) settings.format = info.formats[static_cast<std::size_t>(at)];
    tooltip("number format of a stored channel");
    int blur = static_cast<int>(settings.blur);
    if (choose("blur", blur, {"box", "gauss"})) settings.blur = static_cast<render::BlurShape>(blur);
    tooltip("shape of the blur of stored texels");
  }
  if (!info.may_mipmap) return;
  ImGui::Checkbox("mipmap", &settings.mipmap);
  tooltip("averages over the pixel's footprint where texels are smaller than pixels");
  if (!settings.mipmap) settings.anisotropy = 1;
  if (settings.mipmap)
    ImGui::SliderInt("anisotropy", &settings.anisotropy, 1, render::kMaxAnisotropy, "%d",
                     ImGuiSliderFlags_AlwaysClamp);
}

}  // namespace

void edit_filter(render::FilterSettings& settings) {
  std::vector<std::string> names, help;
  int at = 0;
  for (const render::Filter* filter : render::all_filters()) {
    if (filter == settings.filter) at = static_cast<int>(names.size());
    names.emplace_back(filter->info.name);
    help.push_back(std::string(filter->info.summary) + "\n" + std::string(filter->info.source));
  }
  if (choose("filter", at, names, help))
    settings = render::default_settings(*render::all_filters()[static_cast<std::size_t>(at)]);
  const render::FilterInfo& info = settings.filter->info;
  ImGui::TextWrapped("%.*s", static_cast<int>(info.summary.size()), info.summary.data());
  ImGui::Separator();
  if (info.has_kernel) {
    int unit = static_cast<int>(settings.unit);
    if (choose("unit", unit, {"texels", "world"})) settings.unit = static_cast<render::KernelUnit>(unit);
    tooltip("of the radius: texels of the map that serves the point, or world units across the light");
    const bool texels = settings.unit == render::KernelUnit::texels;
    edit_double("radius", settings.radius, speed_of(settings.radius), 0.0,
                texels ? render::kMaxRadiusTexels : 0.0);
    settings.radius =
        std::clamp(settings.radius, 0.0, texels ? render::kMaxRadiusTexels : render::kMaxRadiusWorld);
    tooltip("half width of the kernel; Ctrl and click to type");
  }
  edit_stored_texels(settings);
  ImGui::Checkbox("contacts", &settings.contacts);
  tooltip("marches towards the light through what the camera sees, as far as contacts leak");
  for (std::size_t i = 0; i < info.options.size(); ++i) {
    const render::FilterOption& option = info.options[i];
    edit_double(std::string(option.name).c_str(), settings.option[i], 0.01, option.min, option.max);
    if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) settings.option[i] = option.fallback;
    tooltip(std::string(option.summary) + "; default " + number_word(option.fallback) +
            "; right click resets");
  }
  // Only what can be written as text is a legal setting.
  const render::ParsedFilter parsed = render::parse_filter(render::to_string(settings));
  if (parsed.error.empty()) settings = parsed.settings;
  if (!parsed.error.empty()) ImGui::TextWrapped("%s", parsed.error.c_str());
  if (ImGui::Button("reset filter")) settings = render::default_settings(*settings.filter);
}

void edit_sun_dome(LightPlacement& sun, float side) {
  constexpr double kRight = 90.0, kLeast = 0.1;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("dome", {side, side});
  const float radius = side * 0.46f;
  const ImVec2 middle{corner.x + side * 0.5f, corner.y + side * 0.5f};
  if (ImGui::IsItemActive()) {
    const double x = static_cast<double>((ImGui::GetIO().MousePos.x - middle.x) / radius),
                 y = static_cast<double>((ImGui::GetIO().MousePos.y - middle.y) / radius);
    sun.elevation_deg = std::clamp(kRight * (1.0 - std::hypot(x, y)), kLeast, kRight);
    if (x != 0.0 || y != 0.0) sun.azimuth_deg = std::atan2(x, -y) * kDegrees;
  }
  tooltip("drag the sun: the middle is the zenith, the edge the horizon, -Z is above");
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 line = IM_COL32(130, 134, 146, 255);
  list.AddCircleFilled(middle, radius, IM_COL32(44, 58, 84, 255), 48);
  for (const float share : {1.0f, 2.0f / 3.0f, 1.0f / 3.0f}) list.AddCircle(middle, radius * share, line, 48);
  list.AddLine({middle.x - radius, middle.y}, {middle.x + radius, middle.y}, line);
  list.AddLine({middle.x, middle.y - radius}, {middle.x, middle.y + radius}, line);
  const double share = 1.0 - sun.elevation_deg / kRight, azimuth = sun.azimuth_deg / kDegrees;
  const ImVec2 at{middle.x + radius * static_cast<float>(share * std::sin(azimuth)),
                  middle.y - radius * static_cast<float>(share * std::cos(azimuth))};
  list.AddCircleFilled(at, side * 0.045f, IM_COL32(255, 214, 90, 255), 24);
}

}  // namespace gnomon::tool::view
