// Loops over many numbers, compiled once more for wider vector units and picked when the program starts.
#pragma once

// The bits are the same whichever is picked: no multiply-add is fused (-ffp-contract=off), and sums are not
// reordered. Not under the thread sanitizer, which is not awake yet when the program picks.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__gnu_linux__) && \
    !defined(__SANITIZE_THREAD__)
#define GNOMON_WIDE __attribute__((target_clones("default", "avx2", "avx512f")))
#else
#define GNOMON_WIDE
#endif
