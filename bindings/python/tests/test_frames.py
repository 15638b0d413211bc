"""Are frames, atlases, clusters and pictures those of the native library, bit for bit? FRAMES names the file of c_dump_frames."""
import ctypes
import json
import os
import signal

import numpy as np
import pytest

import gnomon
from gnomon import GnomonError
from gnomon import _layout as c


class Reader:
    """The file of tests/c/dump_frames.cpp, in its order."""

    def __init__(self):
        with open(os.environ["FRAMES"], "rb") as file:
            self.data = file.read()
        self.at = 0

    def bytes(self, count):
        self.at += count
        assert self.at <= len(self.data)
        return self.data[self.at - count:self.at]

    def struct(self, name):
        kind = getattr(c, name)
        return kind.from_buffer_copy(self.bytes(ctypes.sizeof(kind)))

    def numbers(self, kind, *shape):
        return np.frombuffer(self.bytes(int(np.prod(shape)) * np.dtype(kind).itemsize), dtype=kind).reshape(shape)

    def count(self):
        return int(self.numbers("u4", 1)[0])


def slats(way, points):
    """What `slats` of tests/c/dump_frames.cpp returns, for all points at once."""
    up = (6.0 - points[:, 1]) / -way[1]
    at = points[:, 0] - way[0] * up + 0.4 * (points[:, 2] - way[2] * up)
    return np.where(at - 8.0 * np.floor(at / 8.0) < 3.0, -np.inf, up)


def searched(way):
    """The slats as occluders, and a list of the batches that they get."""
    batches = []

    def roof(points):
        assert points.dtype == np.float64 and points.ndim == 2 and points.flags.writeable
        batches.append(points.copy())
        return slats(way, points)

    return roof, batches


def options_of(struct):
    given = {name: getattr(struct, name) for name, _ in struct._fields_ if name not in ("size", "reserved", "prune", "clip_space")}
    given["prune"] = [name for i, name in enumerate(gnomon.names("prune_rules")) if struct.prune >> i & 1]
    return given


def test_all_that_changes_from_frame_to_frame_has_the_bits_of_the_native_library():
    file = Reader()
    camera, sun, options = (file.struct(name) for name in ("camera", "light", "plan_options"))
    boxes = file.numbers("f8", file.count(), 6)
    maps = [file.struct("map") for _ in range(file.count())]
    plan = gnomon.plan(camera, sun, boxes, boxes, **options_of(options))
    assert [bytes(one._struct) for one in plan.maps] == [bytes(one) for one in maps] != []

    for _ in range(file.count()):
        frame, offset = int(file.numbers("i8", 1)[0]), file.numbers("f8", 2)
        assert gnomon.jitter_texels(frame).tobytes() == offset.tobytes()
        moved = gnomon.jitter(plan, offset)
        assert [bytes(one._struct) for one in moved.maps] == [file.bytes(ctypes.sizeof(c.map)) for _ in maps]
    # The plan itself has not moved.
    assert [bytes(one._struct) for one in plan.maps] == [bytes(one) for one in maps]

    points, held, turns = file.numbers("f8", file.count(), 3), (0, 0, 0), 0
    for _ in range(file.count()):
        direction, expected = file.numbers("f8", 3), file.struct("held_sun")
        found = gnomon.hold_sun(camera, held, direction, (-40, -1, -200, 40, 8, 20), points=points)
        assert found.direction.tolist() == list(expected.direction)
        assert found[1:] == (expected.error_pixels, expected.turned_pixels, expected.points_capped)
        turns += found.direction.tolist() == direction.tolist()
        held = found.direction
    assert 1 < turns < 50

    bin_frames, hold_frames = file.numbers("i4", 2).tolist()
    tracker = gnomon.DepthTracker(bin_frames, hold_frames)
    for _ in range(file.count()):
        followed = tracker.update(file.numbers("f4", file.count()))
        assert bytes(followed._struct) == bytes(file.struct("visible_depths"))
    assert followed and followed.counts.sum() > 0

    for _ in range(file.count()):
        width, height = file.numbers("i4", 2).tolist()
        expected, atlas = file.struct("atlas"), gnomon.pack_atlas(plan, width, height)
        assert bytes(atlas._struct) == bytes(expected) and atlas.place.shape == (atlas.count, 4)
        for i in range(atlas.count):
            assert atlas.atlas_from_clip(i).T.tobytes() == file.bytes(128)

    for _ in range(file.count()):
        index, way = file.numbers("i4", 2).tolist()
        found = gnomon.engine_bias(plan, index, ("rasterizer", "normal_offset")[way], kernel_radius_texels=1.5, depth_bits=24)
        assert np.array(found).tobytes() == bytes(file.struct("engine_bias")) and found.units > 0

    lights = [file.struct("light") for _ in range(file.count())]
    for _ in range(file.count()):
        room = int(file.numbers("i8", 1)[0])
        found = gnomon.clusters(camera, lights, room=room)
        assert [found.tile_pixels, found.columns, found.rows, found.slices] == file.numbers("i4", 4).tolist()
        assert [found.depth_scale, found.depth_offset] == file.numbers("f8", 2).tolist()
        assert found.begin.tobytes() == file.bytes(4 * file.count())
        assert found.lights.tobytes() == file.bytes(4 * file.count())
        assert 0 in found.of(0, 0, found.slices - 1) and len(found.lights) <= room

    count = file.count()
    assert count == camera.width * camera.height
    mask, depths, distances = (file.numbers("f4", camera.height, camera.width) for _ in range(3))
    for kernel, occluders in ((0.0, None), (1.5, None), (1.5, distances)):
        wrong = gnomon.expected_error(plan, camera, mask, depths, kernel_texels=kernel, occluder_distances=occluders)
        assert bytes(file.struct("wrong_pixels")) == np.array(wrong).tobytes()
    roof, _ = searched(file.numbers("f8", 3))
    normals = file.numbers("f4", camera.height, camera.width, 3)
    for kernel, facing in ((1.5, None), (0.0, normals)):
        wrong = gnomon.expected_error(plan, camera, mask, depths, kernel, distances, occluders=roof, normals=facing)
        assert bytes(file.struct("wrong_pixels")) == np.array(wrong).tobytes() and wrong.wrong > 0
    edges = file.numbers("f8", file.count(), 3)
    assert gnomon.shadow_edge_points(camera, mask, depths, room=len(edges)).tobytes() == edges.tobytes()
    assert file.at == len(file.data)


def scene():
    camera = gnomon.perspective(position=(0, 3, 10), forward=(0, -0.1, -1), fov_y=1.0, aspect=1.5, near=0.2, far=250, width=96, height=64)
    boxes = np.array([[-40, -1, -200, 40, 0, 20], [-4, 0, -30, 4, 6, -26.0]])
    return camera, gnomon.directional((0.4, -1, 0.3)), boxes


def test_pictures_are_read_where_they_lie_and_foreign_maps_are_expected_to_err_as_their_plan():
    camera, sun, boxes = scene()
    plan = gnomon.plan(camera, sun, boxes, boxes, resolution_max_size=64)
    mask = (np.indices((64, 96)).sum(axis=0) // 9 % 2).astype(np.float32)
    depths = np.full((64, 96), 12, dtype=np.float32)
    struct = gnomon._pictures._picture(camera, mask=mask, view_depths=depths)
    assert (struct.mask, struct.view_depths) == (mask.ctypes.data, depths.ctypes.data)
    own = gnomon.expected_error(plan, camera, mask, depths)
    foreign = gnomon.Plan.foreign([gnomon.Map.foreign(m.clip_from_world, m.width, m.height, m.depth_begin, m.depth_end) for m in plan.maps])
    assert own == gnomon.expected_error(foreign, camera, mask, depths) and own.wrong > 0 and own.counted == mask.size
    assert gnomon.expected_error(plan, camera, np.ones_like(mask), depths).wrong < 1e-9
    mask[:] = -1
    assert gnomon.expected_error(plan, camera, mask, depths) == (0, 0, 0)


def ground_under_slats(width, height):
    """A camera over ground under slats, the sun, boxes, the ground's points, mask and view depths."""
    camera = gnomon.perspective(position=(0, 3, 10), forward=(0, -0.4, -1), fov_y=0.7, aspect=1.5, near=0.2, far=250, width=width, height=height)
    way = np.array([0.4, -1, 0.3]) / np.linalg.norm([0.4, -1, 0.3])
    forward = np.array([0, -0.4, -1]) / np.hypot(0.4, 1)
    x, y = np.meshgrid((2 * np.arange(width) + 1) / width - 1, 1 - (2 * np.arange(height) + 1) / height)
    rays = forward + x[..., None] * (camera.right, 0, 0) + y[..., None] * camera.top * np.cross((1, 0, 0), forward)
    depths = -3 / rays[..., 1]
    points = ((0, 3, 10) + rays * depths[..., None]).reshape(-1, 3)
    boxes = np.array([[-40, -1, -200, 40, 0, 20], [-80, 6, -200, 40, 7, 20.0]])
    return camera, way, boxes, points, (slats(way, points) < 0).reshape(height, width), depths


@pytest.mark.parametrize("kernel, most", ((0.0, 1), (1.5, 4), (8.0, 4)))
def test_occluders_get_few_batches_and_give_the_bits_of_a_search_point_by_point(kernel, most):
    camera, way, boxes, points, mask, depths = ground_under_slats(96, 64)
    sun = gnomon.directional(way)
    pages = gnomon.pages(camera, sun, boxes, boxes, points=points, capacity=64, target_m=8)
    assert len(pages.pages) > 1
    for plan, name in ((gnomon.plan(camera, sun, boxes, boxes, resolution_max_size=128), "gnomon_expected_error"), (pages, "gnomon_expected_page_error")):
        roof, batches = searched(way)
        found = gnomon.expected_error(plan, camera, mask, depths, kernel, occluders=roof)
        named = []

        def one_by_one(_scene, place):
            named.append(ctypes.string_at(place, 24))
            return slats(way, np.frombuffer(named[-1]).reshape(1, 3))[0]

        struct = gnomon._pictures._picture(camera, mask=mask, view_depths=depths)
        search = gnomon._layout.occluder_search(one_by_one)
        struct.kernel_texels, struct.occluder_search = kernel, ctypes.cast(search, ctypes.c_void_p).value
        expected = c.wrong_pixels()
        gnomon._call.call(name, plan._struct, struct, expected)
        assert np.array(found).tobytes() == bytes(expected) and 0 < found.share < 0.2
        assert 1 <= len(batches) <= most
        searched_points = [point.tobytes() for batch in batches for point in batch]
        assert len(set(searched_points)) == len(searched_points) and set(named) <= set(searched_points)


def test_foreign_maps_are_searched_along_the_rays_of_their_matrices():
    camera, way, boxes, _, mask, depths = ground_under_slats(96, 64)
    plan = gnomon.plan(camera, gnomon.directional(way), boxes, boxes, resolution_max_size=128)
    roof, _ = searched(way)
    # On level ground rays from above would do as well.
    tilted = np.tile(np.float32([0, 0.8, 0.6]), (64, 96, 1))
    own = gnomon.expected_error(plan, camera, mask, depths, occluders=roof, normals=tilted)
    maps = [gnomon.Map.foreign(m.clip_from_world, m.width, m.height, m.depth_begin, m.depth_end) for m in plan.maps]
    foreign = gnomon.expected_error(gnomon.Plan.foreign(maps), camera, mask, depths, occluders=roof, normals=tilted)
    assert 0 < own.wrong and abs(foreign.wrong - own.wrong) <= 2


def test_a_plan_without_maps_searches_nothing_and_without_occluders_pages_read_the_picture():
    camera, way, boxes, points, mask, depths = ground_under_slats(96, 64)
    roof, batches = searched(way)
    dark = mask.size - mask.sum()
    assert gnomon.expected_error(gnomon.Plan.foreign([]), camera, mask, depths, occluders=roof) == (dark, mask.size, dark / mask.size)
    assert batches == []
    pages = gnomon.pages(camera, gnomon.directional(way), boxes, boxes, points=points, capacity=64)
    assert 0 < gnomon.expected_error(pages, camera, mask, depths).share < 0.2


def test_what_occluders_raise_and_what_comes_up_in_the_search_reaches_the_caller(monkeypatch):
    camera, way, boxes, _, mask, depths = ground_under_slats(240, 160)
    plan = gnomon.plan(camera, gnomon.directional(way), boxes, boxes)
    own = KeyError("own")

    def broken(points):
        raise own

    with pytest.raises(KeyError) as caught:
        gnomon.expected_error(plan, camera, mask, depths, occluders=broken)
    assert caught.value is own

    # Signals while C searches, 12 of them: where the search begins in Python, a handler's exception would be lost.
    def interrupt(*_):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, interrupt)
    try:
        for i in range(12):
            with pytest.raises(KeyboardInterrupt):
                signal.setitimer(signal.ITIMER_REAL, 5e-3 + 1e-4 * i)
                gnomon.expected_error(plan, camera, mask, depths, occluders=lambda points: slats(way, points))
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)

    class Full:
        @staticmethod
        def from_address(place):
            raise MemoryError

    monkeypatch.setattr(gnomon._pictures, "_Point", Full)
    with pytest.raises(MemoryError):
        gnomon.expected_error(plan, camera, mask, depths, occluders=lambda points: slats(way, points))


def test_visible_depths_shorten_the_maps_and_plans_become_text():
    camera, sun, boxes = scene()
    far = gnomon.plan(camera, sun, boxes, boxes, cascades=1)
    near = gnomon.plan(camera, sun, boxes, boxes, cascades=1, depths=gnomon.VisibleDepths(np.float32([5, 40])))
    assert near.maps[0].depth_end < far.maps[0].depth_end
    text = json.loads(json.dumps(near.to_dict()))
    assert text["status"] == "ok" and text["maps"][0]["clip_from_world"] == near.maps[0].clip_from_world.tolist()
    assert text["omitted"] == [one._asdict() for one in near.omitted] and "size" not in text["maps"][0]
    errors = gnomon.measure_points(near.maps[0], camera, [[0, 0, -5.0], [0, 0, 900]], [[0, 1, 0]] * 2)
    assert errors["status"].tolist() == [0, 1] and errors["m_max"][0] >= errors["m_min"][0] > 0
    assert gnomon.measure_points(near.maps[0], camera, [[0, 0, -5.0]])["perspective_max"][0] == errors["perspective_max"][0]
    lights = [gnomon.point((0, 4, -9), 20), gnomon.spot((3, 4, -20), (0, -1, 0), 0.6, 20)]
    found = gnomon.lights(camera, lights, boxes, boxes)
    for i, one in enumerate(found.lights):
        assert found.atlas(i).place.tolist() == one.places.tolist()
    assert json.dumps([found.to_dict(), found.lights[0].to_dict(), gnomon.clusters(camera, lights).to_dict()])


def test_bad_input_is_refused_by_name():
    camera, sun, boxes = scene()
    plan = gnomon.plan(camera, sun, boxes, boxes)
    mask = np.zeros((64, 96), dtype=np.float32)
    closed = gnomon.DepthTracker()
    closed.close()

    def field_of(run):
        with pytest.raises(GnomonError) as caught:
            run()
        return caught.value.field

    for field, run in {
        "offset": lambda: gnomon.jitter(plan, (0, np.nan)),
        "frame": lambda: gnomon.jitter_texels(-1),
        "held": lambda: gnomon.hold_sun(camera, (0, 0), (0, -1, 0), np.zeros(6), points=None),
        "sun": lambda: gnomon.hold_sun(camera, (0, 0, 0), (0, 0, 0), np.zeros(6), points=None),
        "casters": lambda: gnomon.hold_sun(camera, (0, 0, 0), (0, -1, 0), boxes, points=None),
        "most_pixels": lambda: gnomon.hold_sun(camera, (0, 0, 0), (0, -1, 0), boxes[0], points=None, most_pixels=-1),
        "frames_per_bin": lambda: gnomon.DepthTracker(0),
        "hold_frames": lambda: gnomon.DepthTracker(4, 2**40),
        "closed": lambda: closed.update([]),
        "width": lambda: gnomon.pack_atlas(plan, -1, 0),
        "height": lambda: gnomon.pack_atlas(plan, 64, 2**40),
        "map": lambda: gnomon.pack_atlas(plan).atlas_from_clip(99),
        "way": lambda: gnomon.engine_bias(plan, 0, "by hand"),
        "depth_bits": lambda: gnomon.engine_bias(plan, 0, depth_bits=33),
        "kernel_radius_texels": lambda: gnomon.engine_bias(plan, 0, kernel_radius_texels=-1),
        "light": lambda: gnomon.plan(camera, 5, boxes, boxes),
        "lights": lambda: gnomon.clusters(camera, [sun, None]),
        "camera": lambda: gnomon.expected_error(plan, sun, mask, mask),
        "light_clusters.tile_pixels": lambda: gnomon.clusters(camera, [sun], tile_pixels=0),
        "light_clusters.depth_slices": lambda: gnomon.clusters(camera, [sun], depth_slices=257),
        "light_clusters.light_room": lambda: gnomon.clusters(camera, [sun] * 3, room=2),
        "shadow_picture.mask": lambda: gnomon.expected_error(plan, camera, mask.T, mask),
        "shadow_picture.view_depths": lambda: gnomon.shadow_edge_points(camera, mask, mask[1:]),
        "shadow_picture.normals": lambda: gnomon.expected_error(plan, camera, mask, mask, normals=mask),
        "plan": lambda: gnomon.expected_error(camera, camera, mask, mask),
        "room": lambda: gnomon.shadow_edge_points(camera, mask, mask, room=-1),
        "normals": lambda: gnomon.measure_points(plan.maps[0], camera, [[0, 0, 0]], [[0, 1, 0]] * 2),
        "points": lambda: gnomon.measure_points(plan.maps[0], camera, [[0, np.nan, 0]]),
        "clip_space.left_hand": lambda: gnomon.Plan.foreign([], clip_space={"left_hand": True}),
        "plan_options.fit": lambda: gnomon.plan(camera, sun, boxes, boxes, fit="loose"),
    }.items():
        assert field_of(run) == field
    depths, up = np.full_like(mask, 12), np.tile(np.float32([0, 1, 0]), (64, 96, 1))
    for occluders in (lambda p: p, lambda p: p[1:, 0], lambda p: 1.0, lambda p: ["far"] * len(p), lambda p: [[1.0], [1.0, 2.0]], "rays"):
        assert field_of(lambda: gnomon.expected_error(plan, camera, mask, depths, occluders=occluders, normals=up)) == "shadow_picture.occluder_search"
    broken = gnomon.Map.foreign(np.full((4, 4), np.nan), 64, 64)
    assert field_of(lambda: gnomon.expected_error(gnomon.Plan.foreign([broken]), camera, mask, mask)) == "map.clip_from_world"
