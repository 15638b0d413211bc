#!/usr/bin/env python3
"""What does Filament's LiSPSM make of a view? Captures of format gnomon-capture/1 (docs/captures.md), by its formulas.

    gnomon compare STUDY --write-masks --out out/views
    filament.py out/views/masks/technique0/masks.jsonl out/filament [SIZE]

writes FOLDER/VIEW.json for each view of the list, with one map of SIZE texels (1024, Filament's default). Nothing of
Filament runs: the formulas are those that its comments derive.
Based on: filament/src/ShadowMap.cpp (applyLISPSM, computeDirectionalShadowBounds), google/filament at 0362f36;
Wimmer, Scherzer, Purgathofer, "Light Space Perspective Shadow Maps", 2004.
"""
import itertools
import json
import math
import pathlib
import re
import sys

NEAR_HINT, FAR_HINT = 1.0, 100.0  # metres; defaults of LightManager::ShadowOptions
LEAST_SINE = 0.02                 # below it, view and light are parallel and nothing is warped
BORDER = 1                        # texels along each side of the map that hold no depth


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def scaled(a, by):
    return [x * by for x in a]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def unit(a):
    return scaled(a, 1.0 / math.sqrt(dot(a, a)))


def product(a, b):
    """Matrices are lists of rows."""
    return [[sum(a[r][k] * b[k][c] for k in range(4)) for c in range(4)] for r in range(4)]


def image(m, point):
    """The point behind the division by w, and w."""
    clip = [dot(row, list(point) + [1.0]) for row in m]
    return scaled(clip[:3], 1.0 / clip[3]), clip[3]


def rows_of(numbers):
    return [[numbers[4 * c + r] for c in range(4)] for r in range(4)]


def columns_of(m):
    return [m[r][c] for c in range(4) for r in range(4)]


def light_view(x, y, z):
    """Of a light at the origin that looks along -z."""
    return [x + [0.0], y + [0.0], z + [0.0], [0.0, 0.0, 0.0, 1.0]]


class Eye:
    def __init__(self, view):
        self.view, self.clip = rows_of(view["view_from_world"]), rows_of(view["clip_from_view"])
        right, up, back = (row[:3] for row in self.view[:3])
        self.right, self.forward = right, scaled(back, -1.0)
        self.position = [-sum(self.view[k][3] * self.view[k][i] for k in range(3)) for i in range(3)]
        # Planes of the frustum, inside where a . p + d >= 0: rows of the clip matrix.
        m = product(self.clip, self.view)
        sides = [[m[3][i] + sign * m[axis][i] for i in range(4)] for axis in range(2) for sign in (1.0, -1.0)]
        a, b = self.clip[2][2], self.clip[2][3]
        self.near = b / (a - 1.0)
        self.far = b / (a + 1.0) if a > -1.0 else math.inf
        ends = [self.forward + [-dot(self.forward, self.position) - self.near]]
        if self.far < 1e30:
            ends.append(scaled(self.forward, -1.0) + [dot(self.forward, self.position) + self.far])
        self.planes = sides + ends

    def depth(self, point):
        return dot(self.forward, minus(point, self.position))


def corners(box):
    return [list(p) for p in itertools.product(*zip(box["min"], box["max"]))]


def vertices_of(planes):
    """Of the convex body inside all planes."""
    planes = [scaled(p, 1.0 / math.sqrt(dot(p[:3], p[:3]))) for p in planes]
    found = []
    for p, q, r in itertools.combinations(planes, 3):
        qr, rp, pq = cross(q[:3], r[:3]), cross(r[:3], p[:3]), cross(p[:3], q[:3])
        volume = dot(p[:3], qr)
        if abs(volume) < 1e-9:
            continue
        point = [-(p[3] * qr[i] + q[3] * rp[i] + r[3] * pq[i]) / volume for i in range(3)]
        reach = 1e-7 * (1.0 + max(abs(x) for x in point))
        if all(dot(s[:3], point) + s[3] >= -reach for s in planes):
            found.append(point)
    return found


def near_distance(sine, near, far, depth, eye_near, eye_far, near_hint=NEAR_HINT, far_hint=FAR_HINT):
    """Distance of the warp's centre from the body, nopt; None where nothing is warped. `near`, `far`: view depths of
    the body; `depth`: its length along the warp."""
    dzn, dzf = max(0.0, near_hint - eye_near), max(0.0, eye_far - far_hint)
    share = dzn / (far - near)
    if not (sine > LEAST_SINE and 3.0 * share < 2.0):
        return None
    end = near + depth * sine
    virtual_near = max(near, eye_near + dzn)
    virtual_far = max(0.0, min(far, eye_far - dzf, end))
    return max((near + math.sqrt(virtual_near * virtual_far)) / sine, dzn / (2.0 - 3.0 * share))


def map_of(eye, light, casters, receivers, size):
    """clip_from_world of OpenGL's clip space, and the vertices of the body that the map is focused to."""
    z = scaled(unit(light), -1.0)
    x = unit(cross(eye.right, z))
    y = cross(z, x)
    seen = [[(dot(axis, p)) for axis in (x, y, z)] for p in corners(receivers)]
    cast = [[(dot(axis, p)) for axis in (x, y, z)] for p in corners(casters)]
    low = [max(min(p[i] for p in seen), min(p[i] for p in cast)) for i in range(2)]
    high = [min(max(p[i] for p in seen), max(p[i] for p in cast)) for i in range(2)]
    low.append(min(p[2] for p in seen))
    high.append(max(p[2] for p in cast))
    box = [scaled(axis, sign) + [-sign * bound[i]]
           for i, axis in enumerate((x, y, z)) for sign, bound in ((1.0, low), (-1.0, high))]
    body = vertices_of(eye.planes + box)
    if len(body) < 4:
        return None
    # Around z, so that y is the camera's forward as the light sees it.
    along = dot(eye.forward, z)
    if abs(along) < 0.9997:
        y = unit(minus(eye.forward, scaled(z, along)))
        x = cross(y, z)
    view = light_view(x, y, z)
    light_near, light_far = -high[2], -max(low[2], min(dot(z, p) for p in body))
    d = light_far - light_near
    flat = [[1.0, 0, 0, 0], [0, 1.0, 0, 0], [0, 0, -2.0 / d, -(light_far + light_near) / d], [0, 0, 0, 1.0]]
    m = product(flat, view)
    sine = math.sqrt(max(0.0, 1.0 - along * along))
    n, f = min(dot(y, p) for p in body), max(dot(y, p) for p in body)
    depths = [eye.depth(p) for p in body]
    near, far = max(eye.near, min(depths)), min(eye.far, max(depths))
    nopt = near_distance(sine, near, far, f - n, eye.near, eye.far) if f > n else None
    if nopt is not None:
        end = nopt + f - n
        shift = [[1.0, 0, 0, -dot(x, eye.position)], [0, 1.0, 0, nopt - n], [0, 0, 1.0, 0], [0, 0, 0, 1.0]]
        warp = [[nopt, 0, 0, 0], [0, (end + nopt) / (end - nopt), 0, -2.0 * nopt * end / (end - nopt)],
                [0, 0, nopt, 0], [0, 1.0, 0, 0]]
        m = product(product(warp, shift), m)
    flat = [image(m, p)[0] for p in body]
    inside = (size - 2.0 * BORDER) / size
    focus = [[0.0] * 4 for _ in range(4)]
    focus[2][2] = focus[3][3] = 1.0
    for i in range(2):
        low_i, high_i = min(p[i] for p in flat), max(p[i] for p in flat)
        focus[i][i] = inside * 2.0 / (high_i - low_i)
        focus[i][3] = -inside * (high_i + low_i) / (high_i - low_i)
    return product(focus, m), body


def frame_of(line, key, size):
    eye = Eye(line[key])
    made = map_of(eye, line["light_direction"], line["casters"], line["receivers"], size)
    if made is None:
        sys.exit("%s, frame %d: the view holds no receiver" % (line["scene"], line["frame"]))
    return {"camera": {"view_from_world": line[key]["view_from_world"], "clip_from_view": line[key]["clip_from_view"],
                       "width": line["width"], "height": line["height"]},
            "maps": [{"clip_from_world": columns_of(made[0]), "width": size, "height": size}]}


def name_of(line):
    """A file's name for the view: the scene, with its camera and sun where they are not the scene's own."""
    words = [line["scene"].split(":")[-1], "%g" % line["light_elevation_deg"], line.get("camera", "")]
    return re.sub(r"[^a-z0-9.]+", "_", " ".join(words).lower()).strip("_")


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    size = int(sys.argv[3]) if len(sys.argv) == 4 else 1024
    folder = pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    views = {}
    for text in pathlib.Path(sys.argv[1]).read_text().splitlines():
        line = json.loads(text)
        if "light_direction" in line and "casters" in line and "receivers" in line:
            views.setdefault(name_of(line), []).append(line)
    for name, lines in views.items():
        capture = {
            "format": "gnomon-capture/1", "name": name, "engine": "the formulas of Filament's LiSPSM",
            "clip_space": {"ndc_depth": "minus_one_to_one"},
            "lights": [{"type": "directional", "direction": lines[0]["light_direction"]}],
            "casters": [lines[0]["casters"]], "receivers": [lines[0]["receivers"]],
            "frames": [frame_of(line, key, size) for line in lines for key in ("view_before", "view")]}
        text = json.dumps(capture, separators=(",", ":")).replace('{"camera"', '\n{"camera"')
        (folder / (name + ".json")).write_text(text + "\n")
        print(folder / (name + ".json"))


if __name__ == "__main__":
    main()
