// A date, a time and a place as text: 2026-06-21T15:00+02:00@52.5,13.4.
#include <charconv>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>

#include "gnomon/scene/sun.hpp"

namespace gnomon {
namespace {

constexpr double kMinuteSeconds = 60.0, kHourSeconds = 3600.0, kDaySeconds = 86400.0;

[[noreturn]] void refuse_moment(const std::string& what) {
  throw std::runtime_error(what);
}

std::string angle_text(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 9).ptr;
  return {text, end};
}

/// Takes digits, numbers and signs off the front of a text.
class MomentText {
 public:
  explicit MomentText(std::string_view text) : rest_(text) {}

  [[nodiscard]] bool at_end() const noexcept { return rest_.empty(); }
  bool take(char c) noexcept {
    if (!rest_.starts_with(c)) return false;
    rest_.remove_prefix(1);
    return true;
  }
  /// Exactly so many digits; -1 where they are not there.
  int digits(std::size_t count) noexcept {
    int value = 0;
    if (rest_.size() < count) return -1;
    for (const char c : rest_.substr(0, count)) {
      if (c < '0' || c > '9') return -1;
      value = 10 * value + (c - '0');
    }
    rest_.remove_prefix(count);
    return value;
  }
  /// False where none is there.
  bool number(double& value) noexcept {
    if (rest_.starts_with('+')) rest_.remove_prefix(1);
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc{} || !std::isfinite(value)) return false;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return true;
  }

 private:
  std::string_view rest_;
};

/// Seconds since 1970 of the day's beginning in Greenwich.
double read_date_s(MomentText& words) {
  constexpr int kFirstYear = 1900, kLastYear = 2100;
  const int year = words.digits(4);
  const bool dash = words.take('-');
  const int month = words.digits(2);
  const bool second_dash = words.take('-');
  const int day = words.digits(2);
  if (year < 0 || !dash || month < 0 || !second_dash || day < 0)
    refuse_moment("wants a date as in 2026-06-21");
  if (year < kFirstYear || year > kLastYear)
    refuse_moment("the year " + std::to_string(year) + " is not within 1900 to 2100");
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) refuse_moment("there is no such day in the calendar");
  return kDaySeconds * static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
}

double read_time_s(MomentText& words) {
  const int hour = words.digits(2);
  const bool colon = words.take(':');
  const int minute = words.digits(2);
  double second = 0.0;
  if (hour < 0 || !colon || minute < 0) refuse_moment("wants a time as in 15:00 after the date and T");
  if (words.take(':') && (!words.number(second) || second < 0.0))
    refuse_moment("wants seconds as in 15:00:30");
  if (hour > 23 || minute > 59 || !(second < kMinuteSeconds)) refuse_moment("a day ends at 23:59:59");
  return kHourSeconds * hour + kMinuteSeconds * minute + second;
}

/// False where no zone is there.
bool read_zone_s(MomentText& words, double& zone_s) {
  constexpr double kWidest_s = 14.0 * kHourSeconds;
  if (words.take('Z')) return true;
  const bool west = words.take('-');
  if (!west && !words.take('+')) return false;
  const int hours = words.digits(2);
  const bool colon = words.take(':');
  const int minutes = words.digits(2);
  if (hours < 0 || !colon || minutes < 0 || minutes > 59) refuse_moment("wants a zone as in Z or +02:00");
  const double ahead_s = kHourSeconds * hours + kMinuteSeconds * minutes;
  if (ahead_s > kWidest_s) refuse_moment("the zone is more than 14 hours from UTC");
  zone_s = west ? -ahead_s : ahead_s;
  return true;
}

Place read_place(MomentText& words) {
  Place place;
  if (!words.take('@') || !words.number(place.latitude_deg) || !words.take(',') ||
      !words.number(place.longitude_deg))
    refuse_moment("wants a place as in @52.5,13.4: degrees north and degrees east");
  if (std::abs(place.latitude_deg) > 90.0)
    refuse_moment("the latitude " + angle_text(place.latitude_deg) + " is not within -90 to 90");
  if (std::abs(place.longitude_deg) > 180.0)
    refuse_moment("the longitude " + angle_text(place.longitude_deg) + " is not within -180 to 180");
  if (words.at_end()) return place;
  constexpr double kDeepest_m = -500.0, kHighest_m = 44000.0;
  if (!words.take(',') || !words.number(place.altitude_m) || !words.at_end())
    refuse_moment("wants at most an altitude in metres behind the longitude, as in @46.55,7.98,3454");
  if (!(place.altitude_m >= kDeepest_m && place.altitude_m <= kHighest_m))
    refuse_moment("the altitude " + angle_text(place.altitude_m) + " is not within -500 to 44000");
  return place;
}

}  // namespace

SunMoment read_sun_moment(std::string_view text) {
  MomentText words(text);
  SunMoment moment;
  moment.unix_s = read_date_s(words);
  if (!words.take('T')) refuse_moment("wants a time as in 15:00 after the date and T");
  moment.unix_s += read_time_s(words);
  if (!read_zone_s(words, moment.zone_s)) refuse_moment("wants a zone after the time, as in Z or +02:00");
  moment.unix_s -= moment.zone_s;
  moment.place = read_place(words);
  return moment;
}

SunMoment read_sun_day(std::string_view text) {
  MomentText words(text);
  SunMoment day;
  day.unix_s = read_date_s(words);
  const bool zoned = read_zone_s(words, day.zone_s);
  day.place = read_place(words);
  // The mean sun moves 15 degrees an hour.
  const double mean_solar_s = day.place.longitude_deg / 15.0 * kHourSeconds;
  day.unix_s -= mean_solar_s;
  if (!zoned) day.zone_s = mean_solar_s;
  return day;
}

}  // namespace gnomon
