// The sun on a command line: by a date, a time and a place.
#pragma once

#include <string>

#include "command.hpp"
#include "gnomon/scene/default_light.hpp"
#include "gnomon/scene/sun.hpp"

namespace gnomon::tool {

/// --sun of a command that lights a scene: sets kind, elevation and azimuth. A sun below the horizon is
/// refused, with the hours of that day at which it is above it.
[[nodiscard]] Option sun_option(LightPlacement& light);
/// The day of `option`'s word. Throws std::runtime_error by the option's name.
[[nodiscard]] SunMoment sun_day_word(const std::string& option, const std::string& word);
/// When the sun is above the horizon on a day that begins at `day`: "from 04:43 to 21:33", in the day's zone.
[[nodiscard]] std::string sun_hours_text(const SunMoment& day);

}  // namespace gnomon::tool
