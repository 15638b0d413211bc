// Points spread evenly over a kernel or a light's disc, and work spread over the processor's cores.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>

#include "gnomon/trace/reference.hpp"

namespace gnomon::trace {

/// Sample `index` of `count` for a pixel: in [0,1) x [0,1), one in each cell of a grid where `count` is a
/// square, else in each cell of a Latin hypercube's diagonal strips.
[[nodiscard]] glm::dvec2 stratified(std::uint32_t pixel, int index, int count) noexcept;

/// The unit square taken to a kernel's weight, areas to weights.
[[nodiscard]] glm::dvec2 to_kernel(KernelShape shape, const glm::dvec2& unit) noexcept;

/// Calls work(row) for every row in [0, rows), from as many threads as there are cores; returns when all are
/// done. `work` must not throw.
void for_each_row(int rows, const std::function<void(int row)>& work);

}  // namespace gnomon::trace
