// The sun on a command line: by a date, a time and a place.
#include "sun_words.hpp"

#include <fmt/core.h>

#include <cmath>
#include <stdexcept>

#include "gnomon/casefile/casefile.hpp"

namespace gnomon::tool {
namespace {

constexpr double kSecondsOfDay = 86400.0;

template <class Read>
SunMoment sun_word(const std::string& option, const std::string& word, const Read& read) {
  try {
    return read(word);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(option + " " + one_line(word, 80) + ": " + error.what());
  }
}

/// "04:43" of a moment in a zone.
std::string clock_text(double unix_s, double zone_s) {
  constexpr int kMinutesOfDay = 24 * 60;
  const double of_day_s = unix_s + zone_s - kSecondsOfDay * std::floor((unix_s + zone_s) / kSecondsOfDay);
  const int minutes = static_cast<int>(std::lround(of_day_s / 60.0)) % kMinutesOfDay;
  return fmt::format("{:02}:{:02}", minutes / 60, minutes % 60);
}

}  // namespace

SunMoment sun_day_word(const std::string& option, const std::string& word) {
  return sun_word(option, word, read_sun_day);
}

std::string sun_hours_text(const SunMoment& day) {
  const SunHours hours = sun_hours(day.unix_s, day.place);
  if (hours.never) return "not at all";
  if (hours.always) return "from midnight to midnight";
  return "from " + clock_text(hours.rise_s, day.zone_s) + " to " + clock_text(hours.set_s, day.zone_s);
}

Option sun_option(LightPlacement& light) {
  const auto set = [&light](const std::string& word) {
    // Lower suns cast shadows a thousand times as long as what they are of.
    constexpr double kLowest_deg = 0.1;
    const SunMoment moment = sun_word("--sun", word, read_sun_moment);
    const SunPosition sun = sun_position(moment.unix_s, moment.place);
    if (sun.elevation_deg < kLowest_deg) {
      SunMoment day = moment;
      const double mean_solar_s = day.place.longitude_deg / 360.0 * kSecondsOfDay;
      day.unix_s = kSecondsOfDay * std::floor((moment.unix_s + mean_solar_s) / kSecondsOfDay) - mean_solar_s;
      throw std::runtime_error(
          fmt::format("--sun {}: the sun is {}, at {:.1f} degrees; that day it shines {}", one_line(word, 80),
                      sun.elevation_deg < 0.0 ? "below the horizon" : "too near the horizon",
                      sun.elevation_deg, sun_hours_text(day)));
    }
    light = {LightKind::sun, sun.elevation_deg, sun.azimuth_deg};
    return true;
  };
  return {.name = "--sun",
          .target = ParsedWord{set, {}},
          .help =
              "the sun of a date, a time with its zone and a place, as in 2026-06-21T15:00+02:00@52.5,13.4; "
              "north is -Z, east is +X",
          .word = "DATE@PLACE",
          .excludes = {"--light", "--light-elevation-deg", "--light-azimuth-deg"}};
}

}  // namespace gnomon::tool
