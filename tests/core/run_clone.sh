#!/usr/bin/env bash
# Runs a program that needs a feature of the processor, under qemu's emulation where the processor lacks it.
#   run_clone.sh FEATURE PROGRAM [ARGUMENT...]
# Exit 77 where neither has it.
set -euo pipefail
feature=$1
shift
cpu_has=$(dirname "$1")/cpu_has
echo "processor: $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), of sse2, avx2, avx512f it has: $("$cpu_has")"
if "$cpu_has" "$feature"; then exec "$@"; fi
emulator=$(command -v qemu-x86_64 || command -v qemu-x86_64-static || true)
if [[ -z $emulator ]]; then
  echo "$feature: neither this processor has it nor is there a qemu-x86_64 (Debian's qemu-user): not run"
  exit 77
fi
if ! "$emulator" -cpu max "$cpu_has" "$feature"; then
  echo "$feature: neither this processor nor $("$emulator" --version | head -n 1) has it: not run"
  exit 77
fi
echo "$feature: under $("$emulator" --version | head -n 1)"
exec "$emulator" -cpu max "$@"
