#!/usr/bin/env bash
# Does the core give the same bits on other processors and systems? Builds the core and the C interface by the cross compiler
# of each *.cmake beside this file, compiles the public headers with all warnings, and runs two programs under an
# emulator: plan_hash, and the program of C against the static and the shared library. All must print what this machine does.
#   run.sh WORK_DIR RELEASE_BUILD [PLANS]
set -euo pipefail
here="$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"
root="$(readlink -f "$here/../..")" work="$(readlink -m "$1")" release="$(readlink -f "$2")" plans="${3:-2000}"
strict=(-Wall -Wextra -pedantic -Wconversion -Wshadow -Werror)
failed=0
mkdir -p "$work"

# emulator NAME: the command that runs a program of this platform, and where its libraries are; nothing where there is none.
emulator() {
  case "$1" in
    aarch64) command -v qemu-aarch64 >/dev/null && echo "qemu-aarch64 -L /usr/aarch64-linux-gnu" ;;
    i386) command -v qemu-i386 >/dev/null && echo "qemu-i386 -L /usr/i686-linux-gnu" ;;
    windows) WINEPREFIX="$work/wine" timeout 120 /usr/lib/wine/wine64 cmd /c exit 2>/dev/null && echo "/usr/lib/wine/wine64" ;;
  esac
  return 0
}

compiler_of() { sed -n "s/^set(CMAKE_$2_COMPILER \(.*\))$/\1/p" "$here/$1.cmake"; }

# same NAME WHAT EXPECTED COMMAND...
same() {
  local name=$1 what=$2 expected=$3 printed
  shift 3
  if printed="$(WINEPREFIX="$work/wine" WINEDEBUG=-all "$@" 2>"$work/$name/errors" | tr -d '\r' | tail -n 1)" && [[ $printed == "$expected" ]]; then
    echo "$name: $what: $printed"
    return
  fi
  echo "$name: $what: $printed, expected $expected" >&2
  cat "$work/$name/errors" >&2
  failed=1
}

headers() { (cd "$root/include" && printf '#include "%s"\n' gnomon/*.hpp gnomon/extend/*.hpp gnomon/study/*.hpp gnomon/c/gnomon.h); }
headers >"$work/headers.hpp"
(cd "$root/include" && grep -hoE '^ *#include <[a-z0-9_/.]+>' $(sed -n 's/.*"\(.*\)"/\1/p' "$work/headers.hpp") | sort -u) >"$work/before.hpp"

hash="$("$release/bin/tests/plan_hash" "$plans" | tail -n 1)"
echo "this machine: $plans plans: $hash"
consumer="$root/tests/c/consumer.c"
gcc -std=c99 -I"$root/include" "$consumer" "$release/src/c/libgnomon.a" -lm -o "$work/consumer"
line="$("$work/consumer")"
echo "this machine: $line"

for file in "$here"/*.cmake; do
  name="$(basename "$file" .cmake)" out="$work/$(basename "$file" .cmake)"
  mkdir -p "$out/bin"  # where CMake puts DLLs
  cmake -S "$root" -B "$out" -G Ninja --toolchain "$file" -DCMAKE_BUILD_TYPE=Release -DGNOMON_WERROR=ON \
    -DCMAKE_CXX_COMPILER_LAUNCHER="$root/cmake/ccache" -Dglm_DIR="$here/glm" \
    -DGNOMON_{SCENE,RENDER,TRACE,REPORT,CASEFILE,TOOL,SAMPLES,INSTALL}=OFF >"$out/configure.log" 2>&1 ||
    { cat "$out/configure.log" >&2; exit 1; }
  cmake --build "$out" >"$out/build.log" || { cat "$out/build.log" >&2; exit 1; }
  read -ra flags <<<"$(sed -n 's/^set(CMAKE_CXX_FLAGS_INIT "\(.*\)")$/\1/p' "$file")"
  cc=("$(compiler_of "$name" C)" "${flags[@]}") cxx=("$(compiler_of "$name" CXX)" "${flags[@]}" -std=c++20 -I"$root/include" -isystem "$out/include")
  "${cxx[@]}" "${strict[@]}" -fsyntax-only -I"$work" "$here/headers.cpp"
  "${cxx[@]}" "${strict[@]}" -O1 -ffp-contract=off -fno-exceptions -fno-math-errno -I"$root/src/core" -I"$root/tests/core" \
    "$root"/tests/core/{plan_hash,support/seeded_input}.cpp "$out/src/core/libgnomon_core.a" -static -o "$out/plan_hash"
  "${cc[@]}" -std=c99 "${strict[@]}" -I"$root/include" "$consumer" "$out/src/c/libgnomon.a" -lm -o "$out/consumer_static"
  shared=("$out/src/c/libgnomon.so")
  [[ $name != windows ]] || shared=(-DGNOMON_SHARED_C "$out/src/c/libgnomon.dll.a")
  "${cc[@]}" -std=c99 "${strict[@]}" -I"$root/include" "$consumer" "${shared[@]}" -lm -Wl,-rpath,"$out/src/c" -o "$out/bin/consumer_shared"
  read -ra run <<<"$(emulator "$name")"
  ((${#run[@]})) || { echo "$name: compiled; nothing here runs it"; continue; }
  suffix=
  [[ $name != windows ]] || suffix=.exe
  same "$name" "$plans plans" "$hash" "${run[@]}" "$out/plan_hash$suffix" "$plans"
  same "$name" "static" "$line" "${run[@]}" "$out/consumer_static$suffix"
  same "$name" "shared" "$line" "${run[@]}" "$out/bin/consumer_shared$suffix"
done
exit "$failed"
