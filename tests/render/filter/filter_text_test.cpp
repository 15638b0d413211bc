// Filter settings as text, formats, and what filters cost.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "gnomon/render/filter.hpp"
#include "support/one_line.hpp"

namespace gnomon::render {
namespace {

using test::in_one_line;

TEST(FilterText, refuses_what_it_does_not_know_with_one_line_that_names_it) {
  const struct {
    const char* text;
    const char* named;
  } kCases[] = {{"", "''"},
                {"soap", "'soap'"},
                {"vsm:", ""},
                {"vsm:bleed", "'bleed': wants KEY=VALUE"},
                {"vsm:bleed=", "bleed=: wants a number from 0 to 0.95"},
                {"vsm:bleed=1", "bleed=1: wants a number from 0 to 0.95"},
                {"vsm:bleed=nan", "bleed=nan"},
                {"vsm:bleed=0.1x", "bleed=0.1x"},
                {"vsm:radius=-1", "radius=-1"},
                {"vsm:radius=33", "radius=33: at most 32 texels"},
                {"vsm:unit=feet", "unit=feet: wants texels or world"},
                {"vsm:format=unorm8", "format=unorm8: wants fp32, unorm16"},
                {"hard:format=fp32", "stores nothing"},
                {"hard:mipmap=1", "mipmap: hard knows contacts"},
                {"hard:radius=1", "radius: hard knows contacts"},
                {"silhouette:unit=world", "unit: silhouette knows contacts"},
                {"pcf:c=40", "c: pcf knows radius, unit, contacts, pattern, samples, rotate"}};
  for (const auto& c : kCases) {
    const ParsedFilter parsed = parse_filter(c.text);
    EXPECT_EQ(parsed.error.empty(), std::string_view(c.named).empty()) << c.text << ": " << parsed.error;
    EXPECT_NE(parsed.error.find(c.named), std::string::npos) << c.text << ": " << parsed.error;
    EXPECT_EQ(parsed.error.find('\n'), std::string::npos) << parsed.error;
  }
}

TEST(FilterText, gives_the_filters_default_where_the_text_is_wrong) {
  for (const char* text : {"vsm:radius=3,bleed=2", "vsm:radius=33", "vsm:bleed=0.5,soap"})
    EXPECT_EQ(to_string(parse_filter(text).settings), "vsm") << text;
  EXPECT_EQ(parse_filter("soap").settings.filter, nullptr);
}

TEST(FilterText, rounds_what_is_a_whole_number) {
  int rounded = 0;
  for (const Filter* filter : all_filters()) {
    for (const FilterOption& option : filter->info.options) {
      if (!option.whole) continue;
      const double below = option.max - 0.75;
      const std::string text =
          std::string(filter->info.name) + ":" + std::string(option.name) + "=" + std::to_string(below);
      EXPECT_EQ(parse_filter(text).settings.value(option.name), option.max - 1.0) << text;
      ++rounded;
    }
  }
  EXPECT_GT(rounded, 15);
  EXPECT_EQ(parse_filter("vsm:anisotropy=3.7").settings.anisotropy, 4);
}

TEST(FilterText, reads_every_key) {
  const FilterSettings s =
      parse_filter(
          "vsm:radius=2.5,unit=world,contacts=1,blur=gauss,format=unorm16,mipmap=1,anisotropy=8,bleed=0.25")
          .settings;
  EXPECT_EQ(s.filter, &filters::vsm);
  EXPECT_EQ(s.radius, 2.5);
  EXPECT_EQ(s.unit, KernelUnit::world);
  EXPECT_EQ(s.blur, BlurShape::gauss);
  EXPECT_EQ(s.format, TexelFormat::unorm16);
  EXPECT_TRUE(s.contacts);
  EXPECT_TRUE(s.mipmap);
  EXPECT_EQ(s.anisotropy, 8);
  EXPECT_EQ(s.value("bleed"), 0.25);
  EXPECT_EQ(s.value("no_such_option"), 0.0);
}

TEST(FilterText, is_the_name_alone_by_default_and_reads_back_to_the_same_settings) {
  for (const Filter* filter : all_filters()) {
    const FilterSettings usual = default_settings(*filter);
    EXPECT_EQ(to_string(usual), filter->info.name);
    FilterSettings other = usual;
    other.radius = 1.75;
    other.unit = KernelUnit::world;
    for (const TexelFormat format : filter->info.formats) other.format = format;
    for (std::size_t i = 0; i < filter->info.options.size(); ++i) {
      other.option[i] = std::floor(0.5 * (filter->info.options[i].min + filter->info.options[i].max));
      other.option[i] = std::max(other.option[i], filter->info.options[i].min);
    }
    settle_options(other);
    const ParsedFilter back = parse_filter(to_string(other));
    EXPECT_EQ(back.error, "") << to_string(other);
    EXPECT_EQ(to_string(back.settings), to_string(other));
    EXPECT_EQ(back.settings.option, other.option) << to_string(other);
  }
}

TEST(FilterText, help_names_exactly_the_keys_that_are_read) {
  for (const Filter* filter : all_filters()) {
    const std::string help = filter_help(*filter);
    for (const char* key : {"radius", "unit", "contacts", "blur", "format", "mipmap", "anisotropy"}) {
      const bool shown = help.find("\n  " + std::string(key) + " ") != std::string::npos;
      const std::string error = parse_filter(std::string(filter->info.name) + ":" + key + "=?").error;
      const bool read =
          error.find("knows") == std::string::npos && error.find("stores nothing") == std::string::npos;
      EXPECT_EQ(shown, read) << filter->info.name << " " << key;
    }
    EXPECT_NE(in_one_line(help).find(filter->info.source), std::string::npos) << filter->info.name;
  }
}

TEST(FilterText, documents_every_option_of_every_filter_within_its_range) {
  for (const Filter* filter : all_filters()) {
    ASSERT_LE(filter->info.options.size(), kMaxFilterOptions);
    EXPECT_FALSE(filter->info.summary.empty() || filter->info.source.empty()) << filter->info.name;
    for (const FilterOption& option : filter->info.options) {
      EXPECT_LE(option.min, option.fallback) << filter->info.name << " " << option.name;
      EXPECT_GE(option.max, option.fallback) << filter->info.name << " " << option.name;
      EXPECT_FALSE(option.summary.empty());
      EXPECT_NE(in_one_line(filter_help(*filter)).find(option.summary), std::string::npos) << option.name;
    }
    EXPECT_EQ(filter->info.reads == MapRead::depth, filter->info.formats.empty()) << filter->info.name;
  }
}

TEST(TexelFormats, round_as_their_texels_do) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(rounded_to(TexelFormat::unorm8, 0.5), 128.0 / 255.0);
  EXPECT_EQ(rounded_to(TexelFormat::unorm8, -3.0), 0.0);
  EXPECT_EQ(rounded_to(TexelFormat::unorm16, 2.0), 1.0);
  EXPECT_EQ(rounded_to(TexelFormat::fp16, 1.0 + 0x1p-11), 1.0);
  EXPECT_EQ(rounded_to(TexelFormat::fp16, 1.0 + 0x1.8p-10), 1.0 + 0x1p-9);
  EXPECT_EQ(rounded_to(TexelFormat::fp16, 65504.0), 65504.0);
  EXPECT_EQ(rounded_to(TexelFormat::fp16, 1e6), kInf);
  EXPECT_EQ(rounded_to(TexelFormat::fp16, 0x1p-24), 0x1p-24);
  EXPECT_EQ(rounded_to(TexelFormat::fp16, 0x1p-26), 0.0);
  EXPECT_EQ(rounded_to(TexelFormat::fp32, 0.1), double{0.1f});
  for (const TexelFormat format :
       {TexelFormat::fp32, TexelFormat::fp16, TexelFormat::unorm16, TexelFormat::unorm8}) {
    for (double x = 0.0; x <= 1.0; x += 0.0137) {
      EXPECT_LE(std::abs(rounded_to(format, x) - x), rounding_of(format) * (1.0 + 1e-9))
          << to_string(format) << x;
    }
  }
}

TEST(Filters, cost_what_their_images_take) {
  EXPECT_EQ(bytes_per_texel(parse_filter("hard").settings), 4.0);
  EXPECT_EQ(bytes_per_texel(parse_filter("vsm").settings), 4.0 + 8.0);
  EXPECT_EQ(bytes_per_texel(parse_filter("vsm:format=unorm16").settings), 4.0 + 4.0);
  EXPECT_NEAR(bytes_per_texel(parse_filter("vsm:mipmap=1").settings), 4.0 + 8.0 * 4.0 / 3.0, 1e-12);
}

TEST(Filters, request_a_border_in_the_kernels_own_unit) {
  PlanOptions options;
  set_margin(parse_filter("vsm:radius=3").settings, options);
  EXPECT_GE(options.filter.texels, 4.0);
  EXPECT_EQ(options.filter.world, 0.0);
  set_margin(parse_filter("vsm:radius=3,unit=world").settings, options);
  EXPECT_LE(options.filter.texels, 3.0);
  EXPECT_GE(options.filter.world, 3.0);
}

}  // namespace
}  // namespace gnomon::render
