// Where does the sun stand at a date, a time and a place?
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string_view>

namespace gnomon {

/// A place on earth.
struct Place {
  double latitude_deg = 0.0;   ///< -90..90, north of the equator positive
  double longitude_deg = 0.0;  ///< -180..180, east of Greenwich positive
  double altitude_m = 0.0;     ///< above the sea; thinner air refracts less
};

/// The middle of the sun's disc as an observer sees it, refraction included.
struct SunPosition {
  double elevation_deg = 0.0;  ///< above the horizon; below 0 at night
  double azimuth_deg = 0.0;    ///< 0..360 from north: 90 is east, 180 south
};

/// Within 0.01 degrees of NREL's Solar Position Algorithm (Reda, Andreas, 2004) from 1950 to 2050, and within
/// 0.02 from 1900 to 2100. Air of 12 degrees Celsius and standard pressure refracts; below -0.83 degrees it
/// does not. `unix_s`: seconds since 1970-01-01T00:00Z, without leap seconds. Not finite where an argument is
/// not. Based on: Meeus, "Astronomical Algorithms", 1998, chapters 12, 16, 22, 25 and 40.
[[nodiscard]] SunPosition sun_position(double unix_s, const Place& place) noexcept;

/// Which axis of the world points up.
enum class UpAxis : std::uint8_t {
  y,  ///< north is -Z, east +X: glTF, three.js, OpenGL
  z,  ///< north is +Y, east +X: maps, CAD, Blender
};
/// Unit vector towards the sun. DirectionalLight::direction is its negative.
[[nodiscard]] glm::dvec3 to_sun(const SunPosition& sun, UpAxis up = UpAxis::y) noexcept;

/// A moment at a place.
struct SunMoment {
  double unix_s = 0.0;  ///< seconds since 1970-01-01T00:00Z
  double zone_s = 0.0;  ///< local time minus UTC, seconds
  Place place;          ///< on the earth
};
/// Reads text such as "2026-06-21T15:00+02:00@52.5,13.4". The date is of 1900 to 2100, the time has seconds
/// or not, the zone is Z or hours and minutes. Latitude and longitude follow, then perhaps an altitude in
/// metres. Throws std::runtime_error that names the part that is wrong.
[[nodiscard]] SunMoment read_sun_moment(std::string_view text);
/// Reads text such as "2026-06-21@52.5,13.4": local mean solar midnight, with which that day begins there. A
/// zone may follow the date; `zone_s` is then its offset, else that of mean solar time. Throws as above.
[[nodiscard]] SunMoment read_sun_day(std::string_view text);

/// When the sun is above an elevation within the 24 hours from `begin_s` on, to the second.
struct SunHours {
  double rise_s = 0.0, set_s = 0.0;    ///< seconds since 1970; equal where it never is
  bool never = false, always = false;  ///< it is below, or above, for all of the 24 hours
};
/// `begin_s` is a local midnight: the sun then rises at most once, and sets after that.
[[nodiscard]] SunHours sun_hours(double begin_s, const Place& place, double elevation_deg = 0.0) noexcept;

}  // namespace gnomon
