#!/usr/bin/env bash
# Does abi.sh find what it is there for? A field that is appended, one in the middle, and a call that is gone, each in a copy
# of the header. Then the header itself: abi_test.sh WORK_DIR
set -euo pipefail
here="$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"
work="$1"

# planted NAME SED_EXPRESSION WORDS
planted() {
  local tree="$work/planted_$1"
  rm -rf "$tree"
  mkdir -p "$tree/tests/c" "$tree/include/gnomon/c"
  cp "$here/abi.sh" "$here/gnomon.abi" "$tree/tests/c/"
  sed "$2" "$here/../../include/gnomon/c/gnomon.h" >"$tree/include/gnomon/c/gnomon.h"
  if "$tree/tests/c/abi.sh" "$tree/work" >"$tree/log" 2>&1; then
    echo "abi.sh overlooks: $1" >&2
    exit 1
  fi
  grep -q "$3" "$tree/log" || { cat "$tree/log" >&2; echo "abi.sh does not say '$3' of: $1" >&2; exit 1; }
}
planted appended_field 's|^} gnomon_stats;|  double planted;\n&|' 'double planted'
planted inserted_field 's|^  double p50;|  double planted;\n&|' 'double planted'
planted removed_call '/^GNOMON_API const char\* gnomon_version/d' 'gnomon_version'
"$here/abi.sh" "$work"
