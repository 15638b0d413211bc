#!/usr/bin/env bash
# Builds the modules of WebAssembly, and puts them into the package's folder: build.sh WORK_DIR
set -euo pipefail
here="$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"
work="$1"
python3 -B "$here/../layout.py" --check
cmake -S "$here/wasm" -B "$work" -G Ninja --toolchain wasi.cmake -DCMAKE_CXX_COMPILER_LAUNCHER="$here/../../cmake/ccache" >"$work.log" 2>&1 ||
  { cat "$work.log" >&2; exit 1; }
cmake --build "$work" >&2
cp "$work"/gnomon{,-full}{,-scalar}.wasm "$here/"
cp "$here/../../LICENSE" "$here/"
