#!/usr/bin/env bash
# Does the writer find in a RenderDoc capture what the program drew? A frame of vulkan_sample by ordinary cascades and by
# gnomon's, captured and replayed headless: the matrices have the program's bits, and gnomon judge takes the files.
#   vulkan_renderdoc_test.sh WORK_DIR BIN_DIR, BIN_DIR with vulkan_sample and gnomon
set -euo pipefail
here="$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")" bin="$(readlink -f "$2")"
rm -rf "$1"
mkdir -p "$1"
cd "$1"
renderdoccmd capture --wait-for-exit --capture-file "$PWD/street" "$bin/vulkan_sample" --matrices "$PWD/matrices.jsonl" >sample.txt 2>&1 ||
  { cat sample.txt >&2; exit 1; }
write() {
  /usr/bin/python3 -B "$here/vulkan_renderdoc.py" "$1" --maps "${3:-draw_clip_from_point[]}" --camera clip_from_point --light shadows.light \
    --depths 'shadows.maps[].interval_size' --count shadows.layer.z --bias-depth 'depth_bias[].x' --filter-texels 0.5 \
    --name "$2" --engine "vulkan_sample, by RenderDoc" --out "$2.json"
}
write street_capture.rdc ordinary
write street_capture_4.rdc gnomon
/usr/bin/python3 -B - <<'END'
import json
lines = open("matrices.jsonl").read().splitlines()
def dot(a, b):
    return sum(x * y for x, y in zip(a, b))
for name, line in (("ordinary", 0), ("gnomon", 3)):
    capture = json.load(open(name + ".json"))
    own = [[m[4 * column + row] for row in range(4) for column in range(4)] for m in json.loads(lines[line])]
    # Both are single precision: nine digits bring back the bits.
    found = [[float(f"{x:.9g}") for x in m["clip_from_world"]] for m in capture["maps"]]
    assert own == found, f"{name}: maps differ from the program's"
    depths = [m["depths"] for m in capture["maps"]]
    assert all(a[0] < a[1] == b[0] for a, b in zip(depths, depths[1:])), f"{name}: {depths}"
    assert all(m["bias"]["depth"] > 0.0 and m["bias"]["slope_factor"] == 2.0 for m in capture["maps"]), f"{name}: bias"
    # Points are relative to the eye here, and what is seen faces it.
    points = capture["points"]
    assert len(points) > 1000 and all(dot(p[:3], p[3:]) < 0.0 for p in points), f"{name}: points that face away"
    right, up, back = (capture["camera"]["view_from_world"][4 * row:4 * row + 3] for row in range(3))
    across = [right[1] * up[2] - right[2] * up[1], right[2] * up[0] - right[0] * up[2], right[0] * up[1] - right[1] * up[0]]
    assert dot(across, back) > 0.999, f"{name}: a view that mirrors"
END
for name in ordinary gnomon; do "$bin/gnomon" judge "$name.json" --max-findings 0; done
! write street_capture.rdc wrong 'no_such_name[]' 2>wrong.txt
grep -q 'no_such_name' wrong.txt && [[ ! -e wrong.json && $(wc -l <wrong.txt) == 1 ]] || { cat wrong.txt >&2; exit 1; }
