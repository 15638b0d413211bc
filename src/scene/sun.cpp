// Where does the sun stand at a date, a time and a place? By short series for its longitude.
// Based on: Meeus, "Astronomical Algorithms", 1998, chapters 12 (sidereal time), 16 (refraction), 22
// (nutation), 25 (the sun) and 40 (parallax); planets' pull on the earth: Meeus, "Astronomical Formulae for
// Calculators", 1988, chapter 18.
#include "gnomon/scene/sun.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gnomon {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0, kDay_s = 86400.0;
constexpr double kJ2000_s = 946728000.0;  ///< 2000-01-01T12:00Z

double sin_deg(double degrees) noexcept {
  return std::sin(kRadians * degrees);
}

double cos_deg(double degrees) noexcept {
  return std::cos(kRadians * degrees);
}

/// Seconds by which uniform time is ahead of the turning earth's: within 11 of what was observed since 1950,
/// in which the sun moves 0.0002 degrees.
double delta_t_s(double days_from_2000) noexcept {
  constexpr double kDaysOfYear = 365.25;
  return 64.0 + 0.58 * days_from_2000 / kDaysOfYear;
}

struct Ecliptic {
  double longitude_deg = 0.0;  ///< apparent
  double obliquity_deg = 0.0;  ///< of the equator
  double equinox_deg = 0.0;    ///< by which sidereal time is off its mean
};

/// `t`: uniform centuries since 2000.
Ecliptic ecliptic(double t) noexcept {
  const double mean_longitude = 280.46646 + t * (36000.76983 + t * 0.0003032);
  const double anomaly = 357.52911 + t * (35999.05029 - t * 0.0001537);
  const double centre = (1.914602 - t * (0.004817 + t * 0.000014)) * sin_deg(anomaly) +
                        (0.019993 - t * 0.000101) * sin_deg(2.0 * anomaly) +
                        0.000289 * sin_deg(3.0 * anomaly);
  const double t1900 = t + 1.0;  // which these five count from
  const double venus =
      0.00134 * cos_deg(153.23 + 22518.7541 * t1900) + 0.00154 * cos_deg(216.57 + 45037.5082 * t1900);
  const double jupiter = 0.00200 * cos_deg(312.69 + 32964.3577 * t1900);
  const double moon = 0.00179 * sin_deg(350.74 + t1900 * (445267.1142 - t1900 * 0.00144));
  const double slow = 0.00178 * sin_deg(231.19 + 20.20 * t1900);
  const double node = 125.04 - 1934.136 * t;
  const double nutation = -0.00478 * sin_deg(node) - 0.00037 * sin_deg(2.0 * mean_longitude);
  constexpr double kAberration = -0.00569;
  Ecliptic sun;
  sun.longitude_deg = mean_longitude + centre + venus + jupiter + moon + slow + nutation + kAberration;
  sun.obliquity_deg =
      23.4392911 - 0.0130042 * t + 0.00256 * cos_deg(node) + 0.00016 * cos_deg(2.0 * mean_longitude);
  sun.equinox_deg = nutation * cos_deg(sun.obliquity_deg);
  return sun;
}

/// By which air lifts what stands at this elevation (Saemundsson's formula as NREL's algorithm has it).
double refraction_deg(double elevation_deg, double altitude_m) noexcept {
  // Below, the whole disc is under the horizon: half its width and the refraction there.
  constexpr double kSet = -0.83, kTemperature_c = 12.0, kPressure_hpa = 1013.25;
  if (!(elevation_deg >= kSet)) return 0.0;
  // The international standard atmosphere's pressure by altitude; none from 44 km on.
  const double pressure_hpa = kPressure_hpa * std::pow(std::max(1.0 - 2.25577e-5 * altitude_m, 0.0), 5.25588);
  return pressure_hpa / 1010.0 * (283.0 / (273.0 + kTemperature_c)) * 1.02 /
         (60.0 * std::tan(kRadians * (elevation_deg + 10.3 / (elevation_deg + 5.11))));
}

}  // namespace

SunPosition sun_position(double unix_s, const Place& place) noexcept {
  constexpr double kDaysOfCentury = 36525.0, kParallax_deg = 8.794 / 3600.0;
  const double days = (unix_s - kJ2000_s) / kDay_s;
  const Ecliptic sun = ecliptic((days + delta_t_s(days) / kDay_s) / kDaysOfCentury);
  const double t = days / kDaysOfCentury;
  const double sidereal =
      280.46061837 + 360.98564736629 * days + t * t * 0.000387933 + sun.equinox_deg + place.longitude_deg;

  // The sun in the equator's axes, turned by the hour, then by the latitude.
  const double sin_longitude = sin_deg(sun.longitude_deg);
  const double x = cos_deg(sun.longitude_deg), y = cos_deg(sun.obliquity_deg) * sin_longitude;
  const double z = sin_deg(sun.obliquity_deg) * sin_longitude;
  const double out = x * cos_deg(sidereal) + y * sin_deg(sidereal);
  const double east = y * cos_deg(sidereal) - x * sin_deg(sidereal);
  const double sin_latitude = sin_deg(place.latitude_deg), cos_latitude = cos_deg(place.latitude_deg);
  const double up = sin_latitude * z + cos_latitude * out, north = cos_latitude * z - sin_latitude * out;

  const double seen = std::atan2(up, std::hypot(north, east));
  const double elevation_deg = seen / kRadians - kParallax_deg * std::cos(seen);
  const double azimuth_deg = std::atan2(east, north) / kRadians;
  return {elevation_deg + refraction_deg(elevation_deg, place.altitude_m),
          azimuth_deg < 0.0 ? azimuth_deg + 360.0 : azimuth_deg};
}

glm::dvec3 to_sun(const SunPosition& sun, UpAxis up) noexcept {
  const double flat = cos_deg(sun.elevation_deg), height = sin_deg(sun.elevation_deg);
  const double east = flat * sin_deg(sun.azimuth_deg), north = flat * cos_deg(sun.azimuth_deg);
  return up == UpAxis::z ? glm::dvec3{east, north, height} : glm::dvec3{east, height, -north};
}

SunHours sun_hours(double begin_s, const Place& place, double elevation_deg) noexcept {
  const auto is_up = [&](double unix_s) { return sun_position(unix_s, place).elevation_deg > elevation_deg; };
  // The change lies between the two, whose answers differ.
  const auto between = [&](double before, double after) {
    const bool was_up = is_up(before);
    while (after - before > 1.0) {
      const double middle = 0.5 * (before + after);
      (is_up(middle) == was_up ? before : after) = middle;
    }
    return after;
  };
  constexpr int kSteps = 288;  // of five minutes: near the poles, days can be that short
  constexpr double kStep_s = kDay_s / kSteps;
  SunHours hours{begin_s, begin_s + kDay_s, true, true};
  for (int i = 0; i <= kSteps; ++i) {
    const double now = begin_s + kStep_s * i;
    const bool up = is_up(now);
    (up ? hours.never : hours.always) = false;
    if (i == 0 || up == is_up(now - kStep_s)) continue;
    (up ? hours.rise_s : hours.set_s) = between(now - kStep_s, now);
  }
  if (hours.never) hours.set_s = hours.rise_s;
  return hours;
}

}  // namespace gnomon
