#!/usr/bin/env bash
# Does the package work as pip installs it? Into an environment of its own, with all tests and the examples of the manual.
#   all.sh WORK_DIR CASES, CASES of c_dump_cases
set -euo pipefail
here="$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"
work="$(readlink -m "$1")" cases="$(readlink -f "$2")"
python3 -B "$here/../../layout.py" --check
rm -rf "$work"
# Where there is a compiler cache, the library is compiled once.
export CMAKE_CXX_COMPILER_LAUNCHER="$here/../../../cmake/ccache"
python3 -m venv "$work"
"$work/bin/pip" install --quiet --disable-pip-version-check "$here/.." pytest mypy
# Not from the sources: the installed package alone.
cd "$work"
CASES="$cases" "$work/bin/python" -m pytest -q -p no:cacheprovider "$here"
"$work/bin/python" - <<'PYTHON'
import doctest
import gnomon
found = doctest.testmod(gnomon)
assert found.attempted >= 16 and found.failed == 0, found
print(found)
PYTHON
"$work/bin/python" -m mypy --no-error-summary -c 'import gnomon
camera: gnomon.Camera = gnomon.perspective(fov_y=1.0)
p95: float = gnomon.measure(gnomon.plan(camera, gnomon.directional((0, -1, 0)), [[0.0] * 6], None), camera, None).p95'
