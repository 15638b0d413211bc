#!/usr/bin/env bash
# Are plans the same bits with every compiler, optimization and instruction set? Builds the core and plan_hash with
# each of g++ and clang++ that is there, at -O0 and at -O3, g++ for this very processor, and compares their hashes.
#   plan_hash_compare.sh SOURCE_DIR WORK_DIR [PLANS]
set -euo pipefail
source_dir=$1 work=$2 plans=${3:-2000}
launcher=$(command -v ccache || true)
builds=()
for compiler in g++ clang++; do
  command -v "$compiler" >/dev/null || { echo "no $compiler here: left out"; continue; }
  best=-O3
  [[ $compiler == g++ ]] && best="-O3 -march=native"
  for level in -O0 "$best"; do
    out="$work/$compiler${level// /}"
    mkdir -p "$out"
    rm -f "$out"/*.o  # of sources that are no more
    mapfile -t files < <(find "$source_dir/src/core" -name '*.cpp')
    files+=("$source_dir"/tests/core/plan_hash.cpp "$source_dir"/tests/core/support/seeded_input.cpp)
    printf '%s\n' "${files[@]}" | CCACHE_BASEDIR="$source_dir" xargs -P 2 -I FILE sh -c '
      $1 $2 -std=c++20 $3 -ffp-contract=off -fno-exceptions -fno-math-errno -fno-trapping-math -w \
        -I"$4/include" -I"$4/src/core" -I"$4/tests/core" -c "$6" -o "$5/$(echo "$6" | tr / _).o"' \
      sh "$launcher" "$compiler" "$level" "$source_dir" "$out" FILE
    "$compiler" "$out"/*.o -o "$out/plan_hash"
    builds+=("$out")
  done
done
((${#builds[@]} > 1)) || { echo "nothing to compare"; exit 1; }
printf '%s\n' "${builds[@]}" | xargs -P 2 -I BUILD sh -c '"$1/plan_hash" "$2" >"$1/hash"' sh BUILD "$plans"
for build in "${builds[@]}"; do echo "$(basename "$build"): $(<"$build/hash")"; done
for build in "${builds[@]}"; do
  cmp -s "$build/hash" "${builds[0]}/hash" || { echo "plans differ: run plan_hash N --each of both builds"; exit 1; }
done
