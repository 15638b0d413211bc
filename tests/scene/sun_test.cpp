// The sun stands where NREL's Solar Position Algorithm has it, and dates and places are read or refused by
// name.
#include "gnomon/scene/sun.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace gnomon::test {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kPromised_deg = 0.01;  ///< from 1950 to 2050

double apart_deg(const SunPosition& a, const SunPosition& b) {
  return kDegrees * 2.0 * std::asin(std::min(0.5 * glm::distance(to_sun(a), to_sun(b)), 1.0));
}

std::string refusal_of(const char* text) {
  try {
    (void)read_sun_moment(text);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "read";
}

TEST(Sun, without_a_number_has_no_place) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(sun_position(nan, {}).elevation_deg));
  EXPECT_TRUE(std::isnan(sun_position(0.0, {nan, 0.0}).elevation_deg));
}

TEST(Sun, stands_as_in_the_example_of_nrels_paper) {
  // Reda, Andreas, "Solar Position Algorithm for Solar Radiation Applications", 2004, table A5.1. Its air has
  // 820 hPa and 11 degrees; the standard atmosphere of that altitude differs by less than a thousandth of a
  // degree.
  const SunMoment moment = read_sun_moment("2003-10-17T12:30:30-07:00@39.742476,-105.1786,1830.14");
  const SunPosition sun = sun_position(moment.unix_s, moment.place);
  EXPECT_NEAR(90.0 - sun.elevation_deg, 50.11162, 0.001);
  EXPECT_NEAR(sun.azimuth_deg, 194.34024, 0.001);
}

struct Row {
  double unix_s;
  Place place;
  SunPosition sun;
};
/// NREL's algorithm as pvlib 0.16.1 has it: spa_python(..., altitude=0, pressure=101325, temperature=12,
/// delta_t=None), at times and places drawn over 1950 to 2050; night and poles among them.
constexpr Row kRows[] = {
    {-627399136.0, {-41.83, -110.71}, {-22.18890, 134.64642}},
    {-537512263.0, {68.46, 154.05}, {-25.26146, 90.12201}},
    {-459434783.0, {1.76, 18.84}, {67.53677, 341.92256}},
    {-394225815.0, {62.49, -115.00}, {2.33241, 320.45591}},
    {-310253719.0, {25.15, 138.26}, {56.92546, 164.23015}},
    {-211328781.0, {43.52, 50.97}, {-2.59353, 70.87536}},
    {-155654102.0, {-73.53, 25.09}, {35.41736, 356.24243}},
    {-49451886.0, {7.41, -44.54}, {73.48509, 339.38225}},
    {31546667.0, {1.40, -32.06}, {-65.59486, 153.45266}},
    {103395956.0, {66.84, -93.78}, {30.42299, 159.76363}},
    {180172204.0, {-24.97, -166.30}, {-39.07591, 251.51021}},
    {261157322.0, {17.67, 135.44}, {-61.93043, 22.93454}},
    {342173965.0, {-79.33, -11.62}, {20.15648, 65.75910}},
    {429603489.0, {-20.23, 17.15}, {13.27005, 68.48909}},
    {513110971.0, {-31.85, -64.02}, {37.72215, 309.80906}},
    {596302767.0, {-62.96, 90.48}, {-2.99956, 209.16139}},
    {691286178.0, {56.94, -170.93}, {11.39218, 190.67362}},
    {766924350.0, {-21.70, -46.01}, {15.77800, 70.01856}},
    {843533192.0, {86.17, -169.07}, {1.98938, 234.58784}},
    {936259943.0, {16.20, -135.76}, {-62.73479, 331.81146}},
    {994773722.0, {18.91, 168.17}, {-45.55436, 23.20892}},
    {1074844146.0, {24.84, 56.79}, {44.77581, 168.22267}},
    {1170137296.0, {31.76, -25.84}, {-31.94439, 92.09843}},
    {1234802691.0, {-62.86, 8.55}, {17.07667, 276.66651}},
    {1316278162.0, {-10.74, 134.21}, {-61.00424, 105.15915}},
    {1412377742.0, {-46.88, -56.08}, {-12.88904, 249.22200}},
    {1492640581.0, {-17.55, 32.50}, {-79.77251, 125.23163}},
    {1587892756.0, {-72.59, 66.13}, {2.22068, 334.28999}},
    {1660977834.0, {84.21, -52.05}, {8.62617, 47.26850}},
    {1739247899.0, {-51.30, 6.88}, {-1.35329, 114.52765}},
    {1820453895.0, {30.92, 95.49}, {28.99696, 101.82929}},
    {1894696463.0, {-35.92, 147.30}, {9.54378, 250.74683}},
    {1969348159.0, {67.33, -125.62}, {-0.04346, 11.49001}},
    {2056489726.0, {29.20, 156.03}, {37.35665, 126.98069}},
    {2153201948.0, {-66.31, -178.14}, {-11.98209, 247.52160}},
    {2220182509.0, {62.11, 91.07}, {5.73345, 297.70842}},
    {2306973720.0, {80.09, 111.79}, {-7.53611, 140.05727}},
    {2377722981.0, {72.71, -130.76}, {31.70428, 213.25400}},
    {2484235709.0, {12.55, -29.19}, {34.56393, 261.97028}},
    {2545691432.0, {-63.82, 113.49}, {6.03972, 58.43209}},
};

TEST(Sun, stands_where_nrels_algorithm_has_it_for_a_century) {
  double worst = 0.0;
  for (const Row& row : kRows) {
    const double apart = apart_deg(sun_position(row.unix_s, row.place), row.sun);
    EXPECT_LT(apart, kPromised_deg) << row.unix_s << " " << row.place.latitude_deg;
    worst = std::max(worst, apart);
  }
  EXPECT_GT(worst, 0.0) << "the rows were written by the code they check";
}

TEST(Sun, has_the_worlds_axes) {
  EXPECT_LT(glm::distance(to_sun({0.0, 0.0}), glm::dvec3(0, 0, -1)), 1e-15);
  EXPECT_LT(glm::distance(to_sun({0.0, 90.0}), glm::dvec3(1, 0, 0)), 1e-15);
  EXPECT_LT(glm::distance(to_sun({90.0, 90.0}), glm::dvec3(0, 1, 0)), 1e-15);
  EXPECT_LT(glm::distance(to_sun({0.0, 0.0}, UpAxis::z), glm::dvec3(0, 1, 0)), 1e-15);
  EXPECT_LT(glm::distance(to_sun({0.0, 90.0}, UpAxis::z), glm::dvec3(1, 0, 0)), 1e-15);
  EXPECT_LT(glm::distance(to_sun({90.0, 0.0}, UpAxis::z), glm::dvec3(0, 0, 1)), 1e-15);
}

TEST(Sun, thin_air_refracts_less) {
  const double noon_s = read_sun_moment("2026-12-21T17:00Z@70,-75").unix_s;
  const double low = sun_position(noon_s, {60.0, -75.0, 0.0}).elevation_deg;
  const double high = sun_position(noon_s, {60.0, -75.0, 44000.0}).elevation_deg;
  EXPECT_NEAR(low - high, 0.12, 0.05);
}

TEST(Sun, rises_and_sets_in_berlin_to_the_minute) {
  // 04:43:05 and 21:33:18 in summer time, by pvlib's sun_rise_set_transit_spa: the disc's upper edge at the
  // horizon, half a disc above its middle.
  const SunMoment day = read_sun_day("2026-06-21+02:00@52.52,13.405");
  const SunHours hours = sun_hours(day.unix_s, day.place, -0.2667);
  const double midnight_s = read_sun_moment("2026-06-21T00:00+02:00@52.52,13.405").unix_s;
  constexpr double kMinute_s = 60.0;
  EXPECT_NEAR(hours.rise_s - midnight_s, (4 * 60 + 43) * kMinute_s, kMinute_s);
  EXPECT_NEAR(hours.set_s - midnight_s, (21 * 60 + 33) * kMinute_s, kMinute_s);
  EXPECT_FALSE(hours.never || hours.always);
}

TEST(Sun, stays_up_or_down_near_the_pole) {
  EXPECT_TRUE(sun_hours(read_sun_day("2026-06-21@78.2,15.6").unix_s, {78.2, 15.6}).always);
  const SunHours night = sun_hours(read_sun_day("2026-12-21@78.2,15.6").unix_s, {78.2, 15.6});
  EXPECT_TRUE(night.never);
  EXPECT_EQ(night.rise_s, night.set_s);
}

TEST(SunMoment, is_read_with_zone_seconds_and_altitude) {
  const SunMoment moment = read_sun_moment("2026-06-21T15:00:30.5+02:00@52.5,-13.4,34");
  EXPECT_DOUBLE_EQ(moment.unix_s, 1782046830.5);
  EXPECT_DOUBLE_EQ(moment.zone_s, 7200.0);
  EXPECT_DOUBLE_EQ(moment.place.latitude_deg, 52.5);
  EXPECT_DOUBLE_EQ(moment.place.longitude_deg, -13.4);
  EXPECT_DOUBLE_EQ(moment.place.altitude_m, 34.0);
  EXPECT_EQ(read_sun_moment("1970-01-01T00:00Z@0,0").unix_s, 0.0);
  EXPECT_EQ(read_sun_moment("1970-01-01T00:00-01:30@0,0").unix_s, 5400.0);
}

TEST(SunMoment, begins_its_day_at_midnight_of_the_place) {
  EXPECT_DOUBLE_EQ(read_sun_day("1970-01-02@0,15").unix_s, 23.0 * 3600.0);
  EXPECT_DOUBLE_EQ(read_sun_day("1970-01-02@0,15").zone_s, 3600.0);
  EXPECT_DOUBLE_EQ(read_sun_day("1970-01-02+02:00@0,15").zone_s, 7200.0);
}

TEST(SunMoment, refuses_what_is_wrong_by_name) {
  const std::pair<const char*, const char*> wrong[] = {
      {"", "wants a date"},
      {"noon", "wants a date"},
      {"2026-6-21T15:00Z@0,0", "wants a date"},
      {"2026-02-30T15:00Z@0,0", "no such day"},
      {"2026-13-01T15:00Z@0,0", "no such day"},
      {"1492-10-12T15:00Z@0,0", "the year 1492"},
      {"2026-06-21@0,0", "wants a time"},
      {"2026-06-21T24:00Z@0,0", "ends at 23:59:59"},
      {"2026-06-21T15:00:60Z@0,0", "ends at 23:59:59"},
      {"2026-06-21T15:00:xZ@0,0", "wants seconds"},
      {"2026-06-21T15:00@0,0", "wants a zone"},
      {"2026-06-21T15:00+2@0,0", "wants a zone"},
      {"2026-06-21T15:00+15:00@0,0", "14 hours"},
      {"2026-06-21T15:00Z", "wants a place"},
      {"2026-06-21T15:00Z@52.5", "wants a place"},
      {"2026-06-21T15:00Z@nan,0", "wants a place"},
      {"2026-06-21T15:00Z@95,0", "the latitude 95"},
      {"2026-06-21T15:00Z@0,-180.5", "the longitude -180.5"},
      {"2026-06-21T15:00Z@0,0,1e6", "the altitude 1000000"},
      {"2026-06-21T15:00Z@0,0,1 m", "at most an altitude"},
  };
  for (const auto& [text, what] : wrong)
    EXPECT_NE(refusal_of(text).find(what), std::string::npos) << text << ": " << refusal_of(text);
}

}  // namespace
}  // namespace gnomon::test
