// The version of gnomon that these headers belong to. Stops a compiler that is set below C++20 with one line.
#pragma once

// A missing header ends the compilation at once. After #error a compiler would print hundreds of further
// lines.
#if (defined(_MSVC_LANG) ? _MSVC_LANG : __cplusplus) < 202002L
#include <gnomon needs C++20: compile with -std=c++20, MSVC with /std:c++20>
#endif

#include <string_view>

/// Version of the headers, for conditional compilation. CMakeLists.txt reads the numbers from here.
#define GNOMON_VERSION_MAJOR 0
#define GNOMON_VERSION_MINOR 1
#define GNOMON_VERSION_PATCH 0

/// Number of the binary interface: the SOVERSION of the shared libraries. Programs that were linked to
/// libraries with the same number run with newer ones.
#define GNOMON_ABI_VERSION 1

namespace gnomon {

/// Version of the headers as "major.minor.patch". A minor version of 0.x may change the API.
inline constexpr std::string_view kVersion = "0.1.0";

}  // namespace gnomon
