#!/usr/bin/python3
"""What do the shadow maps of a Vulkan program look like to `gnomon judge`? Reads them out of a RenderDoc capture.

  vulkan_renderdoc.py FRAME.rdc --maps 'cascades[].clip_from_world' --view view --projection proj --light sun_direction

Names are those of the shader that reads the maps: members of its uniform blocks and push constants, with dots, and [] where
the index of the map stands. Writes a capture of format gnomon-capture/1 (docs/captures.md). Needs RenderDoc's Python module
(Debian: python3-renderdoc, which /usr/bin/python3 finds).
"""
import argparse
import json
import struct
import sys

try:
    import renderdoc as rd
except ImportError:
    sys.exit("vulkan_renderdoc.py: no module renderdoc (Debian: python3-renderdoc, run by /usr/bin/python3)")
from renderdoc_uniforms import STAGES, Fault, Uniforms, all_draws, names_of, numbers

POINTS_ACROSS, POINTS_DOWN = 96, 54
BITS = {"D16": 16, "D24": 24}  # of formats of fixed point; others are single precision


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def inverse(m):
    """Of 4 x 4, by elimination with the largest pivot."""
    rows = [list(row) + [float(i == j) for j in range(4)] for i, row in enumerate(m)]
    for i in range(4):
        pivot = max(range(i, 4), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        if rows[i][i] == 0.0:
            raise Fault("the camera's matrix has no inverse")
        rows[i] = [x / rows[i][i] for x in rows[i]]
        for k in range(4):
            if k != i:
                rows[k] = [x - rows[k][i] * y for x, y in zip(rows[k], rows[i])]
    return [row[4:] for row in rows]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(v):
    length = dot(v, v) ** 0.5
    if length == 0.0:
        raise Fault("the camera's matrix has no axes")
    return [x / length for x in v]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def view_and_projection(clip):
    """The two factors of a perspective camera's clip_from_world, both right-handed: w is the depth along the view."""
    if dot(clip[3][:3], clip[3][:3]) == 0.0:
        raise Fault("--camera: a parallel projection does not split; give --view and --projection")
    back = [-x for x in unit(clip[3][:3])]
    across = dot(clip[0][:3], back)
    right = unit(minus(clip[0][:3], [across * x for x in back]))
    up = cross(back, right)
    at = inverse(clip)  # the eye has x, y and w of 0
    eye = [at[i][2] / at[3][2] for i in range(3)]
    view = [axis + [-dot(axis, eye)] for axis in (right, up, back)] + [[0.0, 0.0, 0.0, 1.0]]
    projection = product(clip, inverse(view))
    # What the product leaves of zeros.
    for i, j in ((0, 1), (0, 3), (1, 0), (1, 3), (2, 0), (2, 1), (3, 0), (3, 1), (3, 3)):
        projection[i][j] = 0.0
    return view, projection


def matrix(values, name, transposed):
    if len(values) != 16:
        raise Fault(f"{name} has {len(values)} numbers, a matrix has 16")
    rows = [values[4 * i:4 * i + 4] for i in range(4)]
    return [list(column) for column in zip(*rows)] if transposed else rows


def flat(rows):
    return [x for row in rows for x in row]


def bits_of(texture):
    return next((bits for start, bits in BITS.items() if texture.format.Name().startswith(start)), 0)


def depths_of(controller, texture):
    """All of its depths, rows top to bottom; None for formats that are not known here."""
    data, count = controller.GetTextureData(texture.resourceId, rd.Subresource(0, 0, 0)), texture.width * texture.height
    size = len(data) // count
    bits = bits_of(texture)
    if bits == 16 and size == 2:
        return [x / 65535.0 for x in struct.unpack(f"<{count}H", data)]
    if bits == 24 and size == 4:
        return [(x & 0xFFFFFF) / 16777215.0 for x in struct.unpack(f"<{count}I", data)]
    if bits == 0 and size in (4, 8):
        return list(struct.unpack("<" + ("f" if size == 4 else "fI") * count, data))[::size // 4]
    return None


def is_flat(depths, i, step):
    """True inside of a surface, where the depths of pixels lie on a line."""
    before, at, after = depths[i - step], depths[i], depths[i + step]
    return abs(before + after - 2.0 * at) <= 0.1 * abs(after - before) + 1e-6 * abs(at)


def is_reversed(state):
    return state.depthStencil.depthFunction in (rd.CompareFunction.Greater, rd.CompareFunction.GreaterEqual)


def clip_space(reversed_z, viewport):
    return {"ndc_depth": "zero_to_one", "reversed_z": reversed_z, "y_down": viewport.height > 0}


class Frame:
    """One frame of a RenderDoc capture, replayed up to the draw that reads the maps."""

    def __init__(self, controller, options):
        self.controller, self.options = controller, options
        self.draws = list(all_draws(controller.GetRootActions()))
        self.textures = {texture.resourceId: texture for texture in controller.GetTextures()}
        asked = [options.maps, options.camera, options.view, options.projection, options.light, options.towards_light]
        self.names = [name for name in asked if name is not None]
        self.missing = self.names
        for draw in reversed(self.draws):
            if options.event is not None and draw.eventId != options.event:
                continue
            controller.SetFrameEvent(draw.eventId, False)
            self.uniforms = Uniforms(controller)
            missing = [name for name in self.names if self.uniforms.find(name, 0) is None]
            if not missing:
                self.draw = draw
                break
            self.missing = min(self.missing, missing, key=len)
        else:
            raise Fault(f"no draw's shaders have a uniform {self.missing[0]}; --list prints the names")

    def values(self, name, index=None):
        found = self.uniforms.find(name, index)
        if found is None:
            raise Fault(f"no uniform {name}" + (f" of map {index}" if index is not None else ""))
        return numbers(found)

    def matrix(self, name, index=None):
        return matrix(self.values(name, index), name, self.options.transposed)

    def count(self):
        asked = self.options.count
        if asked is None:
            return self.uniforms.elements(self.options.maps) if "[]" in self.options.maps else 1
        return int(asked) if asked.isdigit() else int(self.values(asked)[0])

    def map_texture(self):
        state = self.controller.GetPipelineState()
        found = []
        for stage in STAGES:
            shader = state.GetShaderReflection(stage)
            if shader is None:
                continue
            bound = state.GetReadOnlyResources(stage)
            for read in shader.readOnlyResources:
                for texture in (self.textures.get(resource.resourceId) for resource in bound[read.bindPoint].resources):
                    if texture is not None and texture.creationFlags & rd.TextureCategory.DepthTarget:
                        found.append((read.name, texture))
        wanted = [texture for name, texture in found if self.options.texture in (None, name)]
        if len({texture.resourceId for texture in wanted}) != 1:
            raise Fault("--texture: say which of the depth textures: " + (", ".join(sorted({n for n, _ in found})) or "the draw reads none"))
        return wanted[0]

    def camera(self):
        """The camera, its clip space, and points that it sees."""
        if self.options.camera is not None:
            clip = self.matrix(self.options.camera)
            view, projection = view_and_projection(clip)
        else:
            view, projection = self.matrix(self.options.view), self.matrix(self.options.projection)
            clip = product(projection, view)
        pipeline = self.controller.GetPipelineState()
        viewport, state = pipeline.GetViewport(0), self.controller.GetVulkanPipelineState()
        width, height = round(viewport.width), round(abs(viewport.height))
        space = clip_space(is_reversed(state), viewport)
        camera = {"view_from_world": flat(view), "clip_from_view": flat(projection), "width": width, "height": height}
        return camera, space, self.points(clip, width, height, space, self.textures.get(pipeline.GetDepthTarget().resourceId))

    def points(self, clip, width, height, space, texture):
        """Up to 96 x 54 points with normals, by the depths after the draw, none at edges."""
        depths = None if texture is None or texture.msSamp > 1 else depths_of(self.controller, texture)
        if depths is None:
            print("vulkan_renderdoc.py: the camera's depths cannot be read: no points", file=sys.stderr)
            return []
        point_from_clip, empty, out = inverse(clip), 0.0 if space["reversed_z"] else 1.0, []

        def point(x, y, depth=None):
            ndc_y = 2.0 * (y + 0.5) / height - 1.0
            ndc = [2.0 * (x + 0.5) / width - 1.0, ndc_y if space["y_down"] else -ndc_y,
                   depths[y * texture.width + x] if depth is None else depth, 1.0]
            at = [dot(line, ndc) for line in point_from_clip]
            return [at[i] / at[3] for i in range(3)]

        for row in range(POINTS_DOWN):
            y = min(max(int((row + 0.5) * height / POINTS_DOWN), 1), height - 2)
            for column in range(POINTS_ACROSS):
                x = min(max(int((column + 0.5) * width / POINTS_ACROSS), 1), width - 2)
                i = y * texture.width + x
                if depths[i] == empty or not all(is_flat(depths, i, step) for step in (1, texture.width)):
                    continue
                at = point(x, y)
                normal = unit(cross(minus(point(x + 1, y), point(x - 1, y)), minus(point(x, y + 1), point(x, y - 1))))
                facing = dot(normal, minus(point(x, y, 1.0 - empty), at)) > 0.0
                out.append([float(f"{v:.7g}") for v in at + (normal if facing else [-n for n in normal])])
        return out

    def drawn_maps(self, texture):
        """Clip space and bias of the last draw into the maps."""
        for draw in reversed([draw for draw in self.draws if draw.depthOut == texture.resourceId]):
            self.controller.SetFrameEvent(draw.eventId, False)
            state, viewport = self.controller.GetVulkanPipelineState(), self.controller.GetPipelineState().GetViewport(0)
            rasterizer = state.rasterizer
            sign = -1.0 if is_reversed(state) else 1.0
            # A step of a polygon offset; in single precision that at depths of 0.5..1.
            step = 2.0 ** -(bits_of(texture) or 24)
            bias = {"depth": sign * rasterizer.depthBias * step, "slope_factor": sign * rasterizer.slopeScaledDepthBias}
            return clip_space(is_reversed(state), viewport), bias if rasterizer.depthBiasEnable else {"depth": 0.0, "slope_factor": 0.0}
        raise Fault("no draw of this frame draws the maps: capture a frame in which they are drawn")

    def capture(self):
        options = self.options
        camera, camera_space, points = self.camera()
        texture, count = self.map_texture(), self.count()
        size = options.size or [texture.width, texture.height]
        if options.size is None and texture.arraysize < count:
            raise Fault(f"{count} maps in a texture of {texture.arraysize} layers: give --size of one map")
        maps = []
        for i in range(count):
            one = {"clip_from_world": flat(self.matrix(options.maps, i)), "width": size[0], "height": size[1], "depth_bits": bits_of(texture),
                   "filter_texels": options.filter_texels}
            if options.depths is not None:
                one["depths"] = self.values(options.depths, i)[:2]
            maps.append(one)
        extra = [self.values(options.bias_depth, i)[0] if options.bias_depth is not None else 0.0 for i in range(count)]
        light = self.values(options.light or options.towards_light)[:3]
        space, drawn = self.drawn_maps(texture)
        for one, depth in zip(maps, extra):
            one["bias"] = {**drawn, "depth": drawn["depth"] + depth}
        return {"format": "gnomon-capture/1", "name": options.name, "engine": options.engine, "matrices": "row_major",
                "clip_space": space, "camera_clip_space": camera_space, "camera": camera,
                "lights": [{"type": "directional", "direction": light if options.light is not None else [-x for x in light]}],
                "maps": maps, **({"points": points} if points else {})}


def print_names(controller):
    """All uniforms of all draws, each set of them once."""
    seen = set()
    for draw in all_draws(controller.GetRootActions()):
        controller.SetFrameEvent(draw.eventId, False)
        text = "\n".join("  " + line for _, values in Uniforms(controller).blocks for line in names_of(values))
        if text not in seen:
            seen.add(text)
            print(f"draw {draw.eventId}:\n{text}")


def opened(path):
    """(file, controller) of a capture that this machine can replay."""
    file = rd.OpenCaptureFile()
    status = file.OpenFile(path, "", None)
    if status != rd.ResultCode.Succeeded:
        raise Fault(f"{path}: {status}")
    if file.DriverName() != "Vulkan":
        raise Fault(f"{path}: a capture of {file.DriverName()}, not of Vulkan")
    status, controller = file.OpenCapture(rd.ReplayOptions(), None)
    if status != rd.ResultCode.Succeeded:
        raise Fault(f"{path}: does not replay here: {status}")
    return file, controller


def arguments():
    parser = argparse.ArgumentParser(prog="vulkan_renderdoc.py", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("frame", metavar="FRAME.rdc")
    add("--list", action="store_true", help="print the names that the frame's draws have, and end")
    add("--maps", metavar="NAME", help="clip_from_world of the maps; [] where the index of the map stands")
    add("--camera", metavar="NAME", help="clip_from_world of the camera, which is split into ...")
    add("--view", metavar="NAME", help="... view_from_world")
    add("--projection", metavar="NAME", help="... and clip_from_view")
    add("--light", metavar="NAME", help="the way that the sun's light travels")
    add("--towards-light", metavar="NAME", help="the other way")
    add("--depths", metavar="NAME", help="view depths at which a map begins and ends: the first two components")
    add("--count", metavar="NAME|N", help="of maps; without it, all elements of --maps")
    add("--texture", metavar="NAME", help="the depth texture with the maps; without it, the only one that is read")
    add("--size", type=int, nargs=2, metavar=("W", "H"), help="texels of a map; without it, the texture's")
    add("--bias-depth", metavar="NAME", help="depth that the look-up takes off, 0..1; the rasterizer's bias is added to it")
    add("--filter-texels", type=float, default=0.0, metavar="R", help="reach of the look-up's kernel: 0.5 for one linear tap that compares")
    add("--transposed", action="store_true", help="matrices act on row vectors")
    add("--event", type=int, metavar="ID", help="the draw that reads the maps; without it, the last one with all names")
    add("--name", default="RenderDoc")
    add("--engine", default="Vulkan")
    add("--out", metavar="FILE.json", help="without it, to standard output")
    options = parser.parse_args()
    if not options.list:
        if options.maps is None or (options.light is None) == (options.towards_light is None):
            parser.error("--maps and one of --light, --towards-light are needed")
        if (options.camera is None) == (options.view is None) or (options.view is None) != (options.projection is None):
            parser.error("either --camera, or --view and --projection are needed")
    return options


def main():
    options = arguments()
    rd.InitialiseReplay(rd.GlobalEnvironment(), [])
    file = controller = None
    try:
        file, controller = opened(options.frame)
        if options.list:
            print_names(controller)
            return 0
        text = json.dumps(Frame(controller, options).capture()) + "\n"
        if options.out is None:
            sys.stdout.write(text)
        else:
            with open(options.out, "w", encoding="utf-8") as out:
                out.write(text)
        return 0
    except (Fault, OSError) as fault:
        print(f"vulkan_renderdoc.py: {fault}", file=sys.stderr)
        return 2
    finally:
        if controller is not None:
            controller.Shutdown()
        if file is not None:
            file.Shutdown()
        rd.ShutdownReplay()


if __name__ == "__main__":
    sys.exit(main())
