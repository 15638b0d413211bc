// Floating-point exceptions as something a test can see: invalid, division by zero, overflow.
#pragma once

#include <setjmp.h>
#include <cfenv>
#include <csignal>

namespace gnomon::test {

// Traps kill by SIGFPE; the handler jumps back so that the test names the case.
inline sigjmp_buf back_to_test;
extern "C" inline void gnomon_test_on_trap(int) {
  siglongjmp(back_to_test, 1);
}

inline constexpr int kTraps = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;

/// Runs `work` with traps on; false where one sprang.
template <typename Work>
bool runs_without_trap(Work&& work) {
  struct sigaction ours {
  }, before{};
  ours.sa_handler = gnomon_test_on_trap;
  sigaction(SIGFPE, &ours, &before);
  volatile bool quiet = true;
  std::feclearexcept(FE_ALL_EXCEPT);
  if (sigsetjmp(back_to_test, 1) == 0) {
    feenableexcept(kTraps);
    work();
  } else {
    quiet = false;
  }
  fedisableexcept(kTraps);
  std::feclearexcept(FE_ALL_EXCEPT);
  sigaction(SIGFPE, &before, nullptr);
  return quiet;
}

}  // namespace gnomon::test
