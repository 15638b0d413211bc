#!/usr/bin/env bash
# Does the package work as pip installs it? Into an environment of its own, with all tests, the examples of its manual, the guides
# of docs/python_guides.md, and the sample of Panda3D.
#   all.sh WORK_DIR CASES FRAMES PROGRAM MORE, CASES and MORE of c_dump_cases, FRAMES of c_dump_frames, PROGRAM: gnomon
set -euo pipefail
here="$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"
work="$(readlink -m "$1")"
export CASES="$(readlink -f "$2")" FRAMES="$(readlink -f "$3")" GNOMON_PROGRAM="$(readlink -f "$4")" MORE="$(readlink -f "$5")"
python3 -B "$here/../../layout.py" --check
rm -rf "$work"
# Where there is a compiler cache, the library is compiled once.
export CMAKE_CXX_COMPILER_LAUNCHER="$here/../../../cmake/ccache"
python3 -m venv "$work"
"$work/bin/pip" install --quiet --disable-pip-version-check "$here/..[program]" pytest mypy matplotlib panda3d
# Not from the sources: the installed package alone.
cd "$work"
"$work/bin/python" -m pytest -q -p no:cacheprovider "$here"
"$work/bin/python" "$here/examples.py" "$here/../../../docs/python_guides.md"
"$work/bin/python" -m mypy --no-error-summary -p gnomon
"$work/bin/python" -m mypy --no-error-summary --strict -c 'import gnomon
camera: gnomon.Camera = gnomon.perspective(fov_y=1.0)
plan = gnomon.plan(camera, gnomon.directional((0, -1, 0)), [[0.0] * 6], None)
p95: float = gnomon.measure(plan, camera, None).p95
width: int = plan.maps[0].width + camera.width
texels: float = gnomon.measure(gnomon.pages(camera, gnomon.directional((0, -1, 0)), None, None, points=None), camera, None).texels_per_pixel
kind: str = gnomon.compare(plan.maps[0], plan.maps[0], plan.clip_space).kind
sun: gnomon.HeldSun = gnomon.hold_sun(camera, (0, 0, 0), (0, -1, 0), (0, 0, 0, 1, 1, 1), points=None)
share: float = gnomon.expected_error(plan, camera, [[1.0]], [[9.0]], occluders=lambda points: points[:, 1]).share'
# Panda3D with the matrices of gnomon: at most half of the misclassified pixels.
xvfb-run -a "$work/bin/python" "$here/../../../samples/panda3d/compare.py" "$work/panda3d" | tee panda3d.log
awk '/^ratio / { ok = $2 > 0 && $2 <= 0.5 } END { exit !ok }' panda3d.log
