// What `gnomon fly` prints: the scene before its flight, and what the frames came to, as text or as JSON.
#pragma once

#include <optional>
#include <vector>

#include "flight.hpp"
#include "gnomon/render/context.hpp"
#include "lights_frame.hpp"
#include "report.hpp"

namespace gnomon::tool::fly {

void print_scene(const Options& options, const Flight& flight, const render::ContextInfo& context);
/// `lights`: where all of the file shine.
void print_summary(const Options& options, const std::optional<AllLights>& lights,
                   const std::vector<FrameRow>& rows);
/// The same, and each frame, in one line.
void print_json(const Options& options, const Flight& flight, const std::optional<AllLights>& lights,
                const render::ContextInfo& context, const std::vector<FrameRow>& rows);

}  // namespace gnomon::tool::fly
