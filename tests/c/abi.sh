#!/usr/bin/env bash
# Has the binary interface of include/gnomon/c/gnomon.h changed? Compares it with tests/c/gnomon.abi, and names what has.
#   abi.sh WORK_DIR            0: unchanged; 1: changed, in words
#   abi.sh WORK_DIR --update   writes tests/c/gnomon.abi anew, after a change that is meant
# The interface is that of a library whose functions do nothing: what the real one has inside is no part of it, and that it
# exports the same calls is a test of its own (symbols.cmake).
set -euo pipefail
here="$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"
header="$here/../../include/gnomon/c/gnomon.h" work="$1"
mkdir -p "$work"

python3 -B - "$header" >"$work/stubs.c" <<'PYTHON'
import re
import sys

text = re.sub(r"//[^\n]*", "", open(sys.argv[1], encoding="utf-8").read())
calls = re.findall(r"^(?:GNOMON_API|GNOMON_EXPERIMENTAL) ((?:const )?\w+\*?) (gnomon_\w+\([^;]*\));", text, re.M)
if len(calls) < 50:
    sys.exit("the header's calls were not found")
print('#include "gnomon/c/gnomon.h"')
# Handles have no definition in the header.
for handle in re.findall(r"^typedef struct (\w+) \1;", text, re.M):
    print("struct %s { int hidden; };" % handle)
for kind, call in calls:
    print("%s %s { %s }" % (kind, call, "" if kind == "void" else "return 0;"))
PYTHON
gcc -std=c99 -g -O0 -fPIC -shared -I"$here/../../include" -Wl,-soname,libgnomon.so.0 -o "$work/libstubs.so" "$work/stubs.c"
abidw --no-corpus-path --no-comp-dir-path --no-show-locs --no-elf-needed "$work/libstubs.so" >"$work/gnomon.abi"
if [[ ${2:-} == --update ]]; then
  cp "$work/gnomon.abi" "$here/gnomon.abi"
  exit 0
fi
# 4: changed as programs may not notice; 8 more: as they do.
result=0
abidiff "$here/gnomon.abi" "$work/gnomon.abi" || result=$?
case "$result" in
  0) ;;
  4) echo "the binary interface has grown: tests/c/abi.sh build/abi --update, and a line in CHANGELOG.md" >&2 ;;
  *) echo "the binary interface has changed so that programs break: GNOMON_C_ABI_VERSION must grow, too" >&2 ;;
esac
((result == 0))
