// Do the public headers of the core compile without a warning, also below the macros of windows.h?
// headers.hpp, which run.sh writes, includes all of them; before.hpp what they take from other libraries,
// which those macros would break.
#include "before.hpp"
#if defined(_WIN32)
#include <windows.h>
#endif

#undef min
#undef max
#undef near
#undef far
#define min(a, b) ((a) < (b) ? (a) : (b))
#define max(a, b) ((a) > (b) ? (a) : (b))
#define near
#define far

#include "headers.hpp"
