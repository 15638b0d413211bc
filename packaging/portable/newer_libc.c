// What gcc 12's libstdc++.a takes from glibc newer than 2.31, for programs that are linked against 2.31.
#include <stdint.h>
#include <stdlib.h>
#include <sys/random.h>

// Since 2.32. Without an answer from the C library, counters are always atomic.
__attribute__((visibility("hidden"))) char __libc_single_threaded = 0;

// Since 2.36: the source of std::random_device.
__attribute__((visibility("hidden"))) uint32_t arc4random(void) {
  uint32_t value = 0;
  if (getrandom(&value, sizeof value, 0) != (ssize_t)sizeof value) abort();
  return value;
}
