// Loops over many numbers, compiled once more for wider vector units and picked when the program starts.
#pragma once

// The bits are the same whichever is picked: no multiply-add is fused (-ffp-contract=off), and sums are not
// reordered. Not under the thread sanitizer, which is not awake yet when the program picks.
// GNOMON_ONLY_CLONE names the one clone to compile ("sse2" for what every x86-64 has): tests run each clone
// on one machine (tests/core/CMakeLists.txt).
//
// -fno-trapping-math, without which none of these loops becomes a vector loop, lets the compiler divide
// before it chooses. So `1 / max_of(x, least)` may divide by an x of 0. Divisors are sums that cannot be 0:
// divisor(x, least) of lanes/lanes.hpp, or x plus a number that changes no bit of an x that counts.
#if !defined(__GNUC__) || defined(__clang__) || !defined(__x86_64__) || !defined(__gnu_linux__) || \
    defined(__SANITIZE_THREAD__)
#define GNOMON_WIDE
#else
#define GNOMON_HAS_CLONES
#ifdef GNOMON_ONLY_CLONE
#define GNOMON_WIDE __attribute__((target(GNOMON_ONLY_CLONE)))
#else
#define GNOMON_WIDE __attribute__((target_clones("default", "avx2", "avx512f")))
#endif
#endif
