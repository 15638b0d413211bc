// Floating-point exceptions as something a test can see: invalid, division by zero, overflow.
#pragma once

#include <cfenv>

namespace gnomon::test {

inline constexpr int kTraps = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;

/// Runs `work`; false where a program that traps these exceptions (feenableexcept) would have died. Flags and not
/// traps, which no emulator raises.
template <typename Work>
bool runs_without_trap(Work&& work) {
  std::feclearexcept(FE_ALL_EXCEPT);
  work();
  const bool quiet = std::fetestexcept(kTraps) == 0;
  std::feclearexcept(FE_ALL_EXCEPT);
  return quiet;
}

}  // namespace gnomon::test
