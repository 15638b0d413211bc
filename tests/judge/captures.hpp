// The shipped captures as JSON, and what tests do to them.
#pragma once

#include <functional>
#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "judge/judge.hpp"
#include "plan_capture.hpp"

namespace gnomon::judge::test {

using Json = nlohmann::json;

/// A capture of samples/capture, by name, made sound: where the engine sets no bias of its own, look-ups
/// follow the receiver's plane.
[[nodiscard]] Json sound(const std::string& name);
/// As its engine wrote it.
[[nodiscard]] Json shipped(const std::string& name);

/// The maps of a file with one frame, and those of all frames.
void for_each_map(Json& capture, const std::function<void(Json& map, std::size_t index)>& change);
/// What read_capture() says of the text: "taken" where it refuses nothing.
[[nodiscard]] std::string refusal(const std::string& text);

/// A matrix of the file; numbers() is the way back.
[[nodiscard]] glm::dmat4 matrix(const Json& numbers);
/// A matrix for transform_maps().
[[nodiscard]] glm::dmat4 scaled(double x, double y, double z, double shift_z = 0.0);
/// Multiplies `left` onto the left of every map's matrix.
void transform_maps(Json& capture, const glm::dmat4& left, int only = -1);

[[nodiscard]] Judgement judged(const Json& capture);
[[nodiscard]] std::vector<std::string> kinds(const Judgement& judgement);

}  // namespace gnomon::judge::test
