# What do body, cascade, warp and m look like? Draws the figures of docs/concepts.md from plans that `gnomon plan` prints.
# figures.py PROGRAM FOLDER writes them; figures.py --check PROGRAM FOLDER compares them with those that are there.
import json
import math
import os
import subprocess
import sys

STYLE = """svg{font:14px system-ui,sans-serif}.bg{fill:#fff}text{fill:#222}.title{font-weight:600}.small{font-size:12px}
.ground{fill:#e8e8e8}.frame{fill:none;stroke:#999}.frustum{fill:none;stroke:#222;stroke-width:1.5}.grid{stroke:#0072b2;stroke-width:.8}
.pixel{stroke:#ccc;stroke-width:.7}.axis{stroke:#ddd}.eye{fill:#222}.sun{stroke:#b8860b;stroke-width:2}.sunhead{fill:#b8860b}
.body{fill:#009e73;fill-opacity:.45}.swept{fill:#e69f00;fill-opacity:.22}.visible{fill:#009e73;fill-opacity:.2}
.map{fill:none;stroke:#0072b2;stroke-width:2;stroke-dasharray:7 4}.drawn{fill:#555}.culled{fill:none;stroke:#888;stroke-width:1.5;stroke-dasharray:3 3}
.c0{color:#0072b2}.c1{color:#d55e00}.c2{color:#009e73}.c3{color:#a04f83}.key,.part{fill:currentColor}.part{fill-opacity:.35}
.outline{fill:none;stroke:currentColor;stroke-width:1.8;stroke-dasharray:6 3}.line{fill:none;stroke:currentColor;stroke-width:2.2}
.texel{fill:currentColor;fill-opacity:.3;stroke:currentColor;stroke-width:2}
@media (prefers-color-scheme:dark){.bg{fill:#0d1117}text,.eye{fill:#e6edf3}.ground{fill:#30363d}.frustum{stroke:#e6edf3}.grid,.map{stroke:#56b4e9}
.pixel,.axis{stroke:#3d444d}.drawn{fill:#aaa}.sun{stroke:#f0c040}.sunhead{fill:#f0c040}.c0{color:#56b4e9}.c1{color:#ff8c42}.c2{color:#2fc79a}
.c3{color:#dd8fc0}}"""

# The scenes, as case files. The sun of the first travels in the plane of the picture.
SIDE = {
    "camera": {"position": [0, 6, 0], "forward": [0, -0.12, -1], "up": [0, 1, 0], "fov_y_deg": 40, "aspect": 1.5, "near": 2, "far": 90,
               "width": 1920, "height": 1280},
    "light": {"type": "directional", "direction": [0, -0.8, -0.6]},
    "receivers": [{"min": [-60, -1, -100], "max": [60, 0, 40]}, {"min": [-6, 0, -40], "max": [6, 12, -32]}],
    "casters": [{"min": [-6, 0, -40], "max": [6, 12, -32]}, {"min": [-8, 0, 14], "max": [8, 52, 22]},
                {"min": [-5, 34, -58], "max": [5, 37, -50]}, {"min": [-8, 0, 25], "max": [8, 10, 31]},
                {"min": [-8, 0, -98], "max": [8, 14, -92]}],
    "options": {"map_size": 1024, "cascades": 1, "warp": "none"}}
STREET = {
    "camera": {"position": [0, 4, 0], "forward": [0, -0.16, -1], "up": [0, 1, 0], "fov_y_deg": 45, "aspect": 1.5, "near": 2, "far": 80,
               "width": 1920, "height": 1280},
    "light": {"type": "directional", "direction": [0.5, -0.8, -0.3]},
    "receivers": [{"min": [-50, -0.5, -90], "max": [50, 0, 10]}],
    "casters": [{"min": [-50, 0, -90], "max": [50, 12, 10]}],
    "options": {"map_size": 1024, "cascades": 1, "warp": "none"}}


def with_options(case, **options):
    return {**case, "options": {**case["options"], **options}}


def plan_of(program, case):
    result = subprocess.run([program, "plan", "-"], input=json.dumps(case) + "\n", capture_output=True, text=True, check=True)
    return json.loads(result.stdout)


# Vectors and planes. A plane holds what has dot(xyz, p) + w >= 0.
def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    length = math.sqrt(dot(a, a))
    return [x / length for x in a]


class View:
    """A camera of a case file."""

    def __init__(self, camera):
        self.eye = camera["position"]
        self.forward = unit(camera["forward"])
        self.right = unit(cross(self.forward, camera["up"]))
        self.up = cross(self.right, self.forward)
        self.top = math.tan(math.radians(camera["fov_y_deg"]) / 2)
        self.side = self.top * camera["aspect"]
        self.near, self.far = camera["near"], camera["far"]
        self.width, self.height = camera["width"], camera["height"]

    def depth_plane(self, depth, sign):
        return [sign * x for x in self.forward] + [-sign * (dot(self.forward, self.eye) + depth)]

    def planes(self, begin, end):
        result = [self.depth_plane(begin, 1), self.depth_plane(end, -1)]
        for axis, slope in ((self.right, self.side), (self.up, self.top)):
            for sign in (1, -1):
                normal = [slope * f + sign * a for f, a in zip(self.forward, axis)]
                result.append(normal + [-dot(normal, self.eye)])
        return result

    def pixel(self, p):
        """Place in the image, pixels from the upper left corner."""
        q = [a - b for a, b in zip(p, self.eye)]
        depth = dot(q, self.forward)
        return ((dot(q, self.right) / depth / self.side + 1) / 2 * self.width,
                (1 - dot(q, self.up) / depth / self.top) / 2 * self.height)

    def ground_at(self, depth):
        """The point of the ground under the middle of the image at a view depth."""
        slope = (-self.eye[1] - depth * self.forward[1]) / (depth * self.up[1])
        return [e + depth * (f + slope * u) for e, f, u in zip(self.eye, self.forward, self.up)]


def volume_planes(map_):
    """The map's volume: -w <= x, y, z <= w in clip space."""
    rows = map_["clip_from_world"]
    return [[w + sign * x for x, w in zip(row, rows[3])] for row in rows[:3] for sign in (1, -1)]


def clipped(polygon, planes, lift):
    """A convex polygon of points of a plane of the picture, which `lift` puts into the world, cut by planes."""
    for plane in planes:
        kept = []
        for a, b in zip(polygon, polygon[1:] + polygon[:1]):
            da, db = (dot(plane, list(lift(p)) + [1]) for p in (a, b))
            if da >= 0:
                kept.append(a)
            if (da < 0) != (db < 0):
                t = da / (da - db)
                kept.append((a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])))
        polygon = kept
        if not polygon:
            break
    return polygon


class Picture:
    def __init__(self, width, height):
        self.width, self.height, self.parts = width, height, []

    def add(self, text):
        self.parts.append(text)

    def text(self, x, y, words, kind="", anchor="start"):
        self.add('<text%s x="%.1f" y="%.1f" text-anchor="%s">%s</text>' % (' class="%s"' % kind if kind else "", x, y, anchor, words))

    def path(self, points, kind, closed=True):
        if points:
            self.add('<path class="%s" d="M%s%s"/>' % (kind, "L".join("%.1f,%.1f" % p for p in points), "Z" if closed else ""))

    def arrow(self, begin, end, kind):
        dx, dy = unit([end[0] - begin[0], end[1] - begin[1]])
        self.path([begin, (end[0] - 8 * dx, end[1] - 8 * dy)], kind, False)
        self.path([end, (end[0] - 12 * dx - 6 * dy, end[1] - 12 * dy + 6 * dx), (end[0] - 12 * dx + 6 * dy, end[1] - 12 * dy - 6 * dx)],
                  kind + "head")

    def begin_panel(self, name, x, y, width, height):
        self.add('<clipPath id="%s"><rect x="%.1f" y="%.1f" width="%.1f" height="%.1f"/></clipPath><g clip-path="url(#%s)">' %
                 (name, x, y, width, height, name))

    def end_panel(self):
        self.add("</g>")

    def svg(self, title):
        return '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 %d %d" width="%d" height="%d" role="img">\n<title>%s</title>\n<style>%s</style>\n' \
            '<rect class="bg" width="100%%" height="100%%"/>\n%s\n</svg>\n' % (self.width, self.height, self.width, self.height, title, STYLE,
                                                                            "\n".join(self.parts))


def body_figure(program):
    plan = plan_of(program, SIDE)
    view, map_ = View(SIDE["camera"]), plan["maps"][0]
    picture = Picture(900, 540)

    def at(p):  # p: (z, y), the camera looks to the right
        return (215 - 6.2 * p[0], 386 - 6.2 * p[1])

    def lift(p):
        return (0.0, p[1], p[0])

    def section(planes):
        return [at(p) for p in clipped([(60, -40), (60, 70), (-115, 70), (-115, -40)], planes, lift)]

    ground = SIDE["receivers"][0]
    picture.begin_panel("scene", 0, 0, 900, 466)
    picture.path([at((40, 0)), at((40, -1)), at((-100, -1)), at((-100, 0))], "ground")
    picture.path(section(map_["cull_planes"]), "swept")
    bounds = [[0, 1, 0, -ground["min"][1]], [0, -1, 0, SIDE["receivers"][1]["max"][1]], [0, 0, 1, -ground["min"][2]]]
    picture.path(section(view.planes(map_["depth_begin"], map_["depth_end"]) + bounds), "body")
    for index, box in enumerate(SIDE["casters"]):
        (_, y0, z0), (_, y1, z1) = box["min"], box["max"]
        picture.path([at(p) for p in ((z0, y0), (z0, y1), (z1, y1), (z1, y0))], "drawn" if index in map_["casters"] else "culled")
    picture.path(section(view.planes(view.near, view.far)), "frustum")
    picture.path(section(volume_planes(map_)), "map")
    eye = at((view.eye[2], view.eye[1]))
    picture.add('<circle class="eye" cx="%.1f" cy="%.1f" r="5"/>' % eye)
    for z in (-72, -77, -82):
        picture.arrow(at((z + 0.75 * 9, 59)), at((z, 50)), "sun")
    picture.end_panel()
    picture.text(eye[0] - 10, eye[1] + 22, "camera", anchor="end")
    picture.text(at((-86, 0))[0], at((0, 53))[1], "sunlight")
    keys = (("body", "body: the visible receivers"), ("swept", "body extended to the light"), ("map", "the map's volume"),
            ("drawn", "caster that is drawn"), ("culled", "caster that is culled"), ("frustum", "view frustum"))
    for i, (kind, words) in enumerate(keys):
        x, y = 30 + 290 * (i % 3), 482 + 30 * (i // 3)
        picture.add('<rect class="%s" x="%d" y="%d" width="30" height="14"/>' % (kind, x, y))
        picture.text(x + 40, y + 12, words)
    return picture.svg("Side view: the body, extended to the light, and the casters that it holds")


def ground_view(picture, x, y, width, height, scale, eye_up):
    """From (x, z) of the ground to a panel; the camera looks up."""
    def at(p):
        return (x + width / 2 + scale * p[0], y + height - eye_up + scale * p[1])
    return at


def ground_lift(p):
    return (p[0], 0.0, p[1])


GROUND = [(-50.0, 10.0), (50.0, 10.0), (50.0, -90.0), (-50.0, -90.0)]


def cascade_figure(program):
    plan = plan_of(program, with_options(STREET, cascades=4, **{"lambda": 0.7}))
    view = View(STREET["camera"])
    picture = Picture(900, 560)
    at = ground_view(picture, 20, 20, 520, 520, 6.2, 42)
    picture.begin_panel("ground", 20, 20, 520, 520)
    picture.path([at(p) for p in GROUND], "ground")
    for i, map_ in enumerate(plan["maps"]):
        part = clipped(GROUND, view.planes(map_["depth_begin"], map_["depth_end"]), ground_lift)
        picture.path([at(p) for p in part], "part c%d" % i)
        picture.path([at(p) for p in clipped([(-90, 40), (90, 40), (90, -130), (-90, -130)], volume_planes(map_), ground_lift)],
                     "outline c%d" % i)
    picture.add('<circle class="eye" cx="%.1f" cy="%.1f" r="5"/>' % at((0, 0)))
    picture.end_panel()
    picture.text(at((0, 0))[0] + 12, at((0, 0))[1] + 18, "camera, looks up the page")
    picture.text(565, 60, "Four cascades, seen from above", "title")
    picture.text(565, 84, "Filled: what each map serves.")
    picture.text(565, 104, "Dashed: the ground under the map.")
    for i, map_ in enumerate(plan["maps"]):
        y = 140 + 62 * i
        picture.add('<rect class="key c%d" x="565" y="%d" width="24" height="40"/>' % (i, y))
        picture.text(602, y + 14, "cascade %d: depths %.1f to %.1f" % (map_["cascade"], map_["depth_begin"], map_["depth_end"]))
        picture.text(602, y + 34, "texels of %.3f x %.3f units" % tuple(map_["texel_world"]))
    picture.text(565, 400, "Each map has 1024 x 1024 texels.")
    return picture.svg("Four cascades from above: what each map serves, and the ground under it")


def ground_from_map(map_):
    """(x, y) of the map, -1..1, to (X, Z, w): the ground there is at X / w and Z / w, and is in the map where w > 0."""
    r = map_["clip_from_world"]
    m = [[r[i][0], r[i][2], r[i][3]] for i in (0, 1, 3)]
    columns = [cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])]
    determinant = dot(m[0], columns[0])
    return lambda x, y: [(x * columns[0][k] + y * columns[1][k] + columns[2][k]) / determinant for k in range(3)]


def map_lines(map_, cells):
    """Lines between the cells of a map, as segments of the ground."""
    ground = ground_from_map(map_)
    for i in range(cells + 1):
        c = -1 + 2 * i / cells
        for ends in (((c, -1), (c, 1)), ((-1, c), (1, c))):
            a, b = (ground(*end) for end in ends)
            least = 1e-6 * max(abs(a[2]), abs(b[2]))
            if a[2] < least and b[2] < least:
                continue
            for p, q in ((a, b), (b, a)):
                if p[2] < least:
                    t = (least - p[2]) / (q[2] - p[2])
                    p[:] = [u + t * (v - u) for u, v in zip(p, q)]
            yield (a[0] / a[2], a[1] / a[2]), (b[0] / b[2], b[1] / b[2])


def cut_segment(a, b, planes):
    """The part of a segment of the ground within planes, or None."""
    begin, end = 0.0, 1.0
    for plane in planes:
        da, db = (dot(plane, list(ground_lift(p)) + [1]) for p in (a, b))
        if da < 0 and db < 0:
            return None
        if da < 0:
            begin = max(begin, da / (da - db))
        elif db < 0:
            end = min(end, da / (da - db))
    if begin >= end:
        return None
    return tuple((a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])) for t in (begin, end))


BOX_OF_GROUND = [[1, 0, 0, 50], [-1, 0, 0, 50], [0, 0, 1, 90], [0, 0, -1, 10]]


def warp_figure(program):
    view = View(STREET["camera"])
    picture = Picture(900, 660)
    for column, (warp, words) in enumerate((("none", "without a warp"), ("auto", "with the warp that the plan chose"))):
        plan = plan_of(program, with_options(STREET, warp=warp))
        map_, x = plan["maps"][0], 20 + 440 * column
        picture.text(x, 24, "%s%s" % (words, "" if warp == "none" else ": " + map_["warp"]), "title")
        at = ground_view(picture, x, 36, 420, 330, 3.3, 28)
        picture.begin_panel("above%d" % column, x, 36, 420, 330)
        picture.path([at(p) for p in GROUND], "ground")
        picture.path([at(p) for p in clipped(GROUND, view.planes(view.near, view.far), ground_lift)], "visible")
        for line in map_lines(map_, 16):
            inside = cut_segment(*line, BOX_OF_GROUND)
            if inside:
                picture.path([at(p) for p in inside], "grid", False)
        picture.add('<circle class="eye" cx="%.1f" cy="%.1f" r="5"/>' % at((0, 0)))
        picture.end_panel()
        picture.begin_panel("seen%d" % column, x, 376, 420, 250)

        def seen(p):
            px, py = view.pixel(ground_lift(p))
            return (x + px * 420 / view.width, 346 + py * 420 / view.width)

        frustum = view.planes(view.near, view.far)
        picture.path([seen(p) for p in clipped(GROUND, frustum, ground_lift)], "ground")
        for line in map_lines(map_, 32):
            inside = cut_segment(*line, frustum + BOX_OF_GROUND)
            if inside:
                picture.path([seen(p) for p in inside], "grid", False)
        picture.end_panel()
        picture.add('<rect class="frame" x="%d" y="376" width="420" height="250"/>' % x)
        picture.text(x, 648, "m, which 95 % of the visible points stay below: {:.1f}".format(plan["m"]["p95"]))
    return picture.svg("The texels of one map on the ground, from above and as the camera sees them, without and with a warp")


def texels_of(map_, p):
    """Place in the map, texels."""
    x, y, _, w = (dot(row, list(p) + [1]) for row in map_["clip_from_world"])
    return ((x / w + 1) / 2 * map_["size"][0], (y / w + 1) / 2 * map_["size"][1])


def pixels_per_texel(view, map_, p):
    """d(pixel) / d(texel) on the ground at p: its columns are the sides of a texel, in pixels."""
    step = 1e-5 * (1 + abs(p[0]) + abs(p[2]))

    def jacobian(place):
        columns = []
        for axis in (0, 2):
            a, b = list(p), list(p)
            a[axis] -= step
            b[axis] += step
            columns.append([(v - u) / (2 * step) for u, v in zip(place(a), place(b))])
        return columns

    (pa, pb), (ta, tb) = jacobian(view.pixel), jacobian(lambda q: texels_of(map_, q))
    determinant = ta[0] * tb[1] - tb[0] * ta[1]
    # Columns of the texels' inverse, times the pixels' columns.
    first = [(pa[k] * tb[1] - pb[k] * ta[1]) / determinant for k in (0, 1)]
    second = [(-pa[k] * tb[0] + pb[k] * ta[0]) / determinant for k in (0, 1)]
    return first, second


def longest(first, second):
    """The largest singular value: m."""
    a, b, c = dot(first, first), dot(first, second), dot(second, second)
    return math.sqrt((a + c) / 2 + math.hypot((a - c) / 2, b))


def serving(plan, depth):
    return next((m for m in plan["maps"] if m["depth_begin"] <= depth <= m["depth_end"]), None)


def m_figure(program):
    view = View(STREET["camera"])
    plans = [plan_of(program, with_options(STREET, **options)) for options in (
        {}, {"warp": "auto"}, {"cascades": 4, "lambda": 0.7, "map_size": 512})]
    words = ("one map of 1024, no warp", "one map of 1024, the chosen warp", "four cascades of 512, no warp")
    picture = Picture(900, 720)
    picture.text(20, 26, "One texel on the ground, in pixels", "title")
    for column, depth in enumerate((8, 25, 75)):
        x, y, side, pixels = 20 + 295 * column, 66, 270, 16
        picture.text(x, 54, "view depth %d" % depth)
        picture.begin_panel("texel%d" % column, x, y, side, side)
        for i in range(pixels + 1):
            c = side * i / pixels
            picture.path([(x + c, y), (x + c, y + side)], "pixel", False)
            picture.path([(x, y + c), (x + side, y + c)], "pixel", False)
        notes = []
        for i, plan in enumerate(plans):
            first, second = pixels_per_texel(view, serving(plan, depth), view.ground_at(depth))
            corners = [(sx * first[0] + sy * second[0], sx * first[1] + sy * second[1]) for sx, sy in ((-.5, -.5), (.5, -.5), (.5, .5), (-.5, .5))]
            picture.path([(x + side / 2 + side / pixels * a, y + side / 2 + side / pixels * b) for a, b in corners], "texel c%d" % i)
            notes.append(longest(first, second))
        picture.end_panel()
        picture.add('<rect class="frame" x="%d" y="%d" width="%d" height="%d"/>' % (x, y, side, side))
        picture.text(x, y + side + 20, "m: no warp %.1f, warp %.1f, cascades %.1f" % tuple(notes), "small")
    # m by depth.
    left, right, top, bottom = 70, 560, 420, 660
    low, high = 0.4, 40.0
    ends = (7.5, 79.0)

    def at(depth, m):
        return (left + (right - left) * math.log(depth / ends[0]) / math.log(ends[1] / ends[0]),
                bottom - (bottom - top) * math.log(m / low) / math.log(high / low))

    picture.text(20, 400, "m on the ground before the camera", "title")
    for m in (0.5, 1, 2, 5, 10, 20):
        picture.path([at(ends[0], m), at(ends[1], m)], "axis", False)
        picture.text(left - 8, at(ends[0], m)[1] + 5, "%g" % m, anchor="end")
    for depth in (10, 20, 40):
        picture.path([at(depth, low), at(depth, high)], "axis", False)
        picture.text(at(depth, low)[0], bottom + 20, "%g" % depth, anchor="middle")
    picture.text((left + right) / 2, bottom + 42, "view depth", anchor="middle")
    for i, plan in enumerate(plans):
        runs, last = [], None
        for k in range(121):
            depth = ends[0] * (ends[1] / ends[0]) ** (k / 120)
            map_ = serving(plan, depth)
            if map_ is None:
                continue
            if map_ is not last:
                runs.append([])
                last = map_
            runs[-1].append(at(depth, longest(*pixels_per_texel(view, map_, view.ground_at(depth)))))
        for run in runs:
            picture.path(run, "line c%d" % i, False)
        picture.add('<rect class="key c%d" x="590" y="%d" width="24" height="14"/>' % (i, 452 + 34 * i))
        picture.text(626, 464 + 34 * i, words[i])
    picture.text(590, 580, "Above 1, a texel is larger than")
    picture.text(590, 600, "a pixel, and edges show stairs.")
    return picture.svg("What a texel covers in pixels at three depths, and m by view depth")


FIGURES = {"body.svg": body_figure, "cascades.svg": cascade_figure, "warp.svg": warp_figure, "m.svg": m_figure}


def main():
    check = sys.argv[1] == "--check"
    program, folder = sys.argv[2:4] if check else sys.argv[1:3]
    for name, figure in FIGURES.items():
        path, text = os.path.join(folder, name), figure(program)
        if check:
            with open(path, encoding="utf-8") as file:
                if file.read() != text:
                    sys.exit("%s is not what this program plans: run %s PROGRAM FOLDER, and look at it" % (path, sys.argv[0]))
        else:
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)


if __name__ == "__main__":
    main()
