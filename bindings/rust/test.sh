#!/usr/bin/env bash
# Do the crates build and give the bits of the native library? With the C++ that the crate compiles, with the installed library,
# without std, and from the package that cargo would publish.
#   test.sh WORK_DIR CASES FRAMES LIBRARY_DIR, CASES of c_dump_cases, FRAMES of c_dump_frames, LIBRARY_DIR with libgnomon.so
set -euo pipefail
here="$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"
work="$(readlink -m "$1")" library="$(readlink -f "$4")"
export GNOMON_CASES="$(readlink -f "$2")" GNOMON_FRAMES="$(readlink -f "$3")" CARGO_TERM_COLOR=never RUSTFLAGS="-D warnings" RUSTDOCFLAGS="-D warnings"
python3 -B "$here/../layout.py" --check
cd "$here"
export CARGO_TARGET_DIR="$work/compiled" CXX="$here/../../cmake/ccache g++"
cargo test --locked --quiet --all-features -- --include-ignored
cargo test --locked --quiet -p gnomon --no-default-features --tests -- --include-ignored
cargo doc --locked --quiet --no-deps --all-features
cargo package --locked --quiet -p gnomon-sys --allow-dirty --no-verify
export CARGO_TARGET_DIR="$work/installed" GNOMON_LIB_DIR="$library" LD_LIBRARY_PATH="$library"
cargo test --locked --quiet -p gnomon --tests -- --include-ignored
# What is published holds all that it compiles.
files="$(tar -tf "$work"/compiled/package/gnomon-sys-*.crate)"
for file in src/header.rs cpp/core/plan/plan.cpp cpp/c/plan.cpp cpp/include/gnomon/c/gnomon.h cpp/include/gnomon/warps.def; do
  grep -q "/$file\$" <<<"$files" || { echo "the package lacks $file" >&2; exit 1; }
done
