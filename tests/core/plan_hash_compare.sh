#!/usr/bin/env bash
# Are plans the same bits with every compiler, optimization and vector unit? Compares the hashes of plan_hash of the
# release build (g++ -O3), of each clone of its wide loops, of g++ at -O0 and for this very processor, and of clang++ at
# -O0 and -O3, which it builds.
#   plan_hash_compare.sh SOURCE_DIR WORK_DIR RELEASE_BUILD [PLANS]
set -euo pipefail
source_dir=$1 work=$2 release=$3 plans=${4:-2000}
launcher=$(command -v ccache || true)
mkdir -p "$work"
rm -f "$work"/*.hash "$work"/*.out
build() {  # NAME COMPILER FLAG...
  local name=$1 compiler=$2
  shift 2
  local out="$work/$name"
  mkdir -p "$out"
  rm -f "$out"/*.o  # of sources that are no more
  {
    find "$source_dir/src/core" -name '*.cpp'
    printf '%s\n' "$source_dir"/tests/core/plan_hash.cpp "$source_dir"/tests/core/support/seeded_input.cpp
  } | CCACHE_BASEDIR="$source_dir" xargs -P "$(nproc)" -I FILE sh -c '
    out=$1 source_dir=$2 file=$3
    shift 3
    "$@" -std=c++20 -ffp-contract=off -fno-exceptions -fno-math-errno -w \
      -I"$source_dir/include" -I"$source_dir/src/core" -I"$source_dir/tests/core" -c "$file" -o "$out/$(echo "$file" | tr / _).o"' \
    sh "$out" "$source_dir" FILE ${launcher:+"$launcher"} "$compiler" "$@"
  "$compiler" "$out"/*.o -o "$out/plan_hash"
  run "$name" "$out/plan_hash"
}
run() {  # NAME COMMAND...
  local name=$1 code=0
  shift
  "$@" "$plans" >"$work/$name.out" 2>&1 || code=$?
  if ((code == 77)); then
    echo "$name: $(tail -n 1 "$work/$name.out")"
    return 0
  fi
  ((code == 0)) || { cat "$work/$name.out"; echo "$name: exit $code"; exit 1; }
  tail -n 1 "$work/$name.out" >"$work/$name.hash"
  echo "$name: $(<"$work/$name.hash")"
}
run release "$release/bin/tests/plan_hash"
for clone in sse2 avx2 avx512f; do
  [[ ! -x $release/bin/tests/plan_hash_$clone ]] ||
    run "clone $clone" "$(dirname "$0")/run_clone.sh" "$clone" "$release/bin/tests/plan_hash_$clone"
done
if command -v g++ >/dev/null; then
  build "g++ -O0" g++ -O0 -fno-trapping-math
  build "g++ -O3 -march=native" g++ -O3 -march=native -fno-trapping-math
fi
clang=$(command -v clang++ || command -v clang++-14 || true)
if [[ -n $clang ]]; then
  build "clang++ -O0" "$clang" -O0
  build "clang++ -O3" "$clang" -O3 -fno-slp-vectorize  # as src/core/CMakeLists.txt has it
else
  echo "no clang++ here: not compared"
fi
hashes=$(cat "$work"/*.hash | sort -u | wc -l)
((hashes == 1)) || { echo "plans differ: run plan_hash N --each of two builds"; exit 1; }
