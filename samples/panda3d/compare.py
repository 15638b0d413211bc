"""How many pixels does Panda3D's shadow get wrong, with a lens round the scene and with gnomon's matrices? A walk down a street
at equal texels, against exact rays.
    compare.py [DIR]    pictures of both, and what is wrong in them, in DIR
Needs a display with OpenGL and GLX; xvfb-run gives one."""
import os
import sys

import numpy as np
from panda3d import core as p3

import gnomon
from gnomon_sun import GnomonSun

WIDTH, HEIGHT, TEXELS, FRAMES = 640, 360, 512, 6
SUN = np.array([0.6, -0.35, -0.5])
p3.load_prc_file_data("", "audio-library-name null\nwindow-type offscreen\nnotify-level error\nwin-size %d %d" % (WIDTH, HEIGHT))
from direct.showbase.ShowBase import ShowBase  # noqa: E402  it reads the line above


def street():
    """(n, 6): a ground, houses along both sides, and posts."""
    random = np.random.default_rng(3)
    boxes = [[-60, -20, -1, 60, 170, 0]]
    for i in range(18):
        boxes += [[x + random.uniform(0, 2), 9 * i, 0, x + 6, 9 * i + 6, random.uniform(2, 9)] for x in (-14, 6)]
    for _ in range(30):
        x, y = random.uniform(-5, 5), random.uniform(-6, 120)
        boxes.append([x, y, 0, x + 0.3, y + 0.3, random.uniform(1, 3)])
    return np.array(boxes, dtype=float)


def box_node(box):
    """A box of 12 triangles."""
    data = p3.GeomVertexData("box", p3.GeomVertexFormat.get_v3n3(), p3.Geom.UH_static)
    vertex, normal = p3.GeomVertexWriter(data, "vertex"), p3.GeomVertexWriter(data, "normal")
    triangles = p3.GeomTriangles(p3.Geom.UH_static)
    ends = box.reshape(2, 3)
    for axis in range(3):
        for side in (0, 1):
            first, place = data.get_num_rows(), np.empty(3)
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)) if side else ((0, 0), (0, 1), (1, 1), (1, 0)):
                place[[axis, (axis + 1) % 3, (axis + 2) % 3]] = ends[side, axis], ends[a, (axis + 1) % 3], ends[b, (axis + 2) % 3]
                vertex.add_data3(*place)
                normal.add_data3(*np.eye(3)[axis] * (2 * side - 1))
            triangles.add_vertices(first, first + 1, first + 2)
            triangles.add_vertices(first, first + 2, first + 3)
    geometry = p3.Geom(data)
    geometry.add_primitive(triangles)
    node = p3.GeomNode("box")
    node.add_geom(geometry)
    return node


def first_hits(boxes, origin, rays):
    """Distance of the first box along each ray, in units of the ray, and the axis of the face; infinity: none."""
    nearest, axis = np.full(len(rays), np.inf), np.zeros(len(rays), dtype=int)
    with np.errstate(divide="ignore", invalid="ignore"):
        for low, high in boxes.reshape(-1, 2, 3):
            a, b = (low - origin) / rays, (high - origin) / rays
            entries = np.minimum(a, b)
            enter, leave = entries.max(axis=-1), np.maximum(a, b).min(axis=-1)
            hit = (enter <= leave) & (enter > 1e-6) & (enter < nearest)
            nearest[hit], axis[hit] = enter[hit], entries[hit].argmax(axis=-1)
    return nearest, axis


def exact(boxes, camera):
    """What a camera sees by rays: 1 lit, 0 shadow, -1 the sky or turned away, and the brightness where it is lit."""
    forward, up = (np.array(v) / np.linalg.norm(v) for v in (camera.forward[:], camera.up[:]))
    right = np.cross(forward, up)
    x = camera.left + (camera.right - camera.left) * (np.arange(WIDTH) + 0.5) / WIDTH
    y = camera.top + (camera.bottom - camera.top) * (np.arange(HEIGHT) + 0.5) / HEIGHT
    up = np.cross(right, forward)
    rays = (forward + x[None, :, None] * right / np.linalg.norm(right) + y[:, None, None] * up / np.linalg.norm(up)).reshape(-1, 3)
    origin = np.array(camera.position[:])
    depth, axis = first_hits(boxes, origin, rays)
    facing = np.take(np.sign(rays) * SUN / np.linalg.norm(SUN), axis + 3 * np.arange(len(rays)))
    brightness = np.where(np.isfinite(depth), np.maximum(facing, 0.0), 0.0)
    mask, seen = np.full(len(rays), -1.0), brightness > 0
    points = origin + rays[seen] * depth[seen, None]
    mask[seen] = np.isinf(first_hits(boxes, points - 1e-5 * SUN, np.broadcast_to(-SUN, points.shape))[0])
    return mask.reshape(HEIGHT, WIDTH), brightness.reshape(HEIGHT, WIDTH)


def lens_round(boxes):
    """Panda3D's way: a parallel lens that holds the scene, as tightly as its boxes allow."""
    forward = SUN / np.linalg.norm(SUN)
    right = np.cross(forward, (0, 0, 1)) / np.linalg.norm(np.cross(forward, (0, 0, 1)))
    axes = np.array([right, np.cross(right, forward), forward])
    corners = boxes[:, [[0, 1, 2], [3, 1, 2], [0, 4, 2], [3, 4, 2], [0, 1, 5], [3, 1, 5], [0, 4, 5], [3, 4, 5]]] @ axes.T
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    clip_from_world = np.eye(4)
    clip_from_world[:3, :3] = axes * (2 / (high - low))[:, None]
    clip_from_world[:3, 3] = -(high + low) / (high - low)
    return clip_from_world


class Street:
    """The street in Panda3D: a sun, and the light of its own shader alone."""

    def __init__(self):
        self.base = ShowBase(windowType="offscreen")
        self.base.set_background_color(0.6, 0.7, 0.9)
        self.boxes = street()
        self.root = self.base.render.attach_new_node("street")
        for box in self.boxes:
            self.root.attach_new_node(box_node(box))
        light = p3.DirectionalLight("sun")
        light.set_direction(p3.LVector3(*SUN))
        light.set_shadow_caster(True, TEXELS, TEXELS)
        self.light = self.root.attach_new_node(light)
        self.root.set_light(self.light)
        self.root.set_shader_auto()
        self.base.camLens.set_fov(70)
        self.base.camLens.set_near_far(0.2, 250)

    def look(self, frame):
        """Places the camera: a walk of 1.5 world units a frame."""
        self.base.cam.set_pos(-1, -14 + 1.5 * frame, 3)
        self.base.cam.look_at(2, 20 + 1.5 * frame, 0.5)

    def draw(self):
        """The picture, (height, width, 3) in 0..1."""
        # Panda3D makes the map in the first frame of all, and reads it from the second on.
        for _ in range(2):
            self.base.graphicsEngine.render_frame()
        image = p3.PNMImage()
        self.base.win.get_screenshot(image)
        texture = p3.Texture()
        texture.load(image)
        pixels = np.frombuffer(texture.get_ram_image_as("RGB"), dtype=np.uint8).reshape(HEIGHT, WIDTH, 3)
        return pixels[::-1] / 255.0


def save(path, *pictures):
    """Pictures beside each other, as a PNG file."""
    pixels = np.ascontiguousarray(np.concatenate([np.clip(p, 0, 1) for p in pictures], axis=1)[::-1] * 255.0 + 0.5).astype(np.uint8)
    texture = p3.Texture()
    texture.setup_2d_texture(pixels.shape[1], pixels.shape[0], p3.Texture.T_unsigned_byte, p3.Texture.F_rgb)
    texture.set_ram_image_as(pixels.tobytes(), "RGB")
    texture.write(p3.Filename.from_os_specific(path))


def main(folder):
    stage = Street()
    sun = GnomonSun(stage.light, stage.base.cam, stage.root, TEXELS)
    own = lens_round(sun.boxes)
    wrong, error, pixels = {"lens": 0, "gnomon": 0}, {"lens": [], "gnomon": []}, 0
    for frame in range(FRAMES):
        stage.look(frame)
        sun.update()
        camera = sun.seen()
        mask, brightness = exact(sun.boxes, camera)
        counts, pictures = mask >= 0, []
        pixels += counts.sum()
        for name, matrix in (("lens", own), ("gnomon", sun.plan.maps[0].clip_from_world)):
            lens = p3.MatrixLens()
            lens.set_user_mat(p3.LMatrix4(*matrix.T.ravel()))
            stage.light.node().set_lens(lens)
            image = stage.draw()
            drawn = image[..., 0] / np.maximum(brightness, 1e-6)
            false = counts & ((drawn > 0.5) != (mask > 0.5))
            wrong[name] += false.sum()
            plan = gnomon.Plan.foreign([gnomon.Map.foreign(matrix, TEXELS, TEXELS)])
            error[name].append(gnomon.measure(plan, camera, sun.boxes).p95)
            pictures.append((image, np.where(false[..., None], (1.0, 0.2, 0.1), 0.6 + 0.4 * image)))
        if folder and frame == 0:
            os.makedirs(folder, exist_ok=True)
            save(os.path.join(folder, "street.png"), *(image for image, _ in pictures))
            save(os.path.join(folder, "wrong.png"), *(false for _, false in pictures))
    for name in wrong:
        print("%-6s %.2f %% of %d pixels misclassified, m p95 %.1f" % (name, 100 * wrong[name] / pixels, pixels, np.mean(error[name])))
    return wrong["gnomon"] / max(wrong["lens"], 1)


if __name__ == "__main__":
    print("ratio %.2f" % main(sys.argv[1] if len(sys.argv) > 1 else ""))
