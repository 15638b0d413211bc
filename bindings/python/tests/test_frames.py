"""Are frames, atlases, clusters and pictures those of the native library, bit for bit? FRAMES names the file of c_dump_frames."""
import ctypes
import json
import os

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
    struct, keep = gnomon._pictures._picture(camera, mask=mask, view_depths=depths)
    assert (struct.mask, struct.view_depths) == (mask.ctypes.data, depths.ctypes.data)
    own = gnomon.expected_error(plan, camera, mask, depths)
    foreign = gnomon.Plan.foreign([gnomon.Map.foreign(m.clip_from_world, m.width, m.height, m.depth_begin, m.depth_end) for m in plan.maps])
    assert own == gnomon.expected_error(foreign, camera, mask, depths) and own.wrong > 0 and own.counted == mask.size
    assert gnomon.expected_error(plan, camera, np.ones_like(mask), depths).wrong < 1e-9
    mask[:] = -1
    assert gnomon.expected_error(plan, camera, mask, depths) == (0, 0, 0)


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
        "room": lambda: gnomon.shadow_edge_points(camera, mask, mask, room=-1),
        "normals": lambda: gnomon.measure_points(plan.maps[0], camera, [[0, 0, 0]], [[0, 1, 0]] * 2),
        "points": lambda: gnomon.measure_points(plan.maps[0], camera, [[0, np.nan, 0]]),
        "clip_space.left_hand": lambda: gnomon.Plan.foreign([], clip_space={"left_hand": True}),
        "plan_options.fit": lambda: gnomon.plan(camera, sun, boxes, boxes, fit="loose"),
    }.items():
        assert field_of(run) == field
    broken = gnomon.Map.foreign(np.full((4, 4), np.nan), 64, 64)
    assert field_of(lambda: gnomon.expected_error(gnomon.Plan.foreign([broken]), camera, mask, mask)) == "map.clip_from_world"
