// Loops over many numbers, compiled once more for wider vector units and picked when the program starts.
#pragma once

// The bits are the same whichever is picked: no multiply-add is fused (-ffp-contract=off), and sums are not
// reordered.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__gnu_linux__)
#define GNOMON_WIDE __attribute__((target_clones("default", "avx2", "avx512f")))
#else
#define GNOMON_WIDE
#endif
