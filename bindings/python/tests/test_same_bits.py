"""Do plans and errors have the bits of the native library? CASES names the file of c_dump_cases."""
import ctypes
import os
import re
import struct

import numpy as np
import pytest

import gnomon
from gnomon import _layout as c
from gnomon._call import GnomonError, call, make


def read_cases(path):
    with open(path, "rb") as file:
        data = file.read()
    at = 4

    def take(count):
        nonlocal at
        at += count
        return data[at - count:at]

    for _ in range(struct.unpack_from("<I", data)[0]):
        one = {name: take(ctypes.sizeof(getattr(c, name))) for name in ("camera", "light", "plan_options")}
        casters, receivers = struct.unpack("<II", take(8))
        one["casters"] = np.frombuffer(take(48 * casters)).reshape(-1, 6)
        one["receivers"] = np.frombuffer(take(48 * receivers)).reshape(-1, 6)
        one["status"], count = struct.unpack("<ii", take(8))
        one["maps"] = [take(ctypes.sizeof(c.map)) for _ in range(count)]
        one["stats"] = take(ctypes.sizeof(c.stats)) if one["status"] == 0 else None
        yield one


def test_plans_and_errors_have_the_bits_of_the_native_library():
    plans = maps = 0
    for number, one in enumerate(read_cases(os.environ["CASES"])):
        camera, light = c.camera.from_buffer_copy(one["camera"]), c.light.from_buffer_copy(one["light"])
        options = c.plan_options.from_buffer_copy(one["plan_options"])
        given = {name: getattr(options, name) for name, _ in options._fields_ if name not in ("size", "reserved", "prune", "clip_space")}
        given["prune"] = [name for i, name in enumerate(gnomon.names("prune_rules")) if options.prune >> i & 1]
        given["clip_space"] = {name: getattr(options.clip_space, name) for name, _ in options.clip_space._fields_ if name != "reserved"}
        if one["status"] == c.INVALID_INPUT:
            with pytest.raises(GnomonError):
                gnomon.plan(camera, light, one["casters"], one["receivers"], **given)
            continue
        plan = gnomon.plan(camera, light, one["casters"], one["receivers"], **given)
        assert plan.status == ("ok", "nothing_visible", "no_caster")[one["status"]], number
        assert [bytes(each._struct) for each in plan.maps] == one["maps"], number
        maps += len(plan.maps)
        if one["stats"] is None:
            continue
        plans += 1
        # The header's grid: casters play no part in an error, and all points are sampled.
        stats = gnomon.measure(plan, camera, one["receivers"], columns=9, rows=9, depths=7)
        assert bytes(stats._struct) == one["stats"], number
    assert plans > 100 and maps > 200


def test_every_call_of_the_header_is_made():
    folder = os.path.dirname(gnomon.__file__)
    text = "".join(open(os.path.join(folder, name), encoding="utf-8").read() for name in os.listdir(folder) if name.endswith(".py") and name != "_layout.py")
    # make() calls those that fill in defaults; len() of a set needs no call.
    assert [name for name in c.calls if not re.search(r"\b%s\b" % name, text) and not name.endswith("_default")] == ["gnomon_caster_set_count"]


def test_arrays_are_read_where_they_lie_and_results_are_views():
    boxes = np.array([[-40, -1, -200, 40, 0, 20], [-4, 0, -30, 4, 6, -26.0]])
    given = gnomon._records.Input(gnomon.perspective(fov_y=1.0), boxes, boxes)
    assert given.scene.casters == boxes.ctypes.data == given.scene.receivers
    plan = gnomon.plan(gnomon.perspective(position=(0, 3, 10), fov_y=1.0, far=250), gnomon.directional((0.4, -1, 0.3)), boxes, boxes)
    matrix = plan.maps[gnomon.select(plan, [[0, 0, -5]], [15.0])[0]].clip_from_world
    assert matrix.shape == (4, 4) and not matrix.flags.owndata
    # Rows first: the point that the map serves is inside of it.
    clip = matrix @ [0, 0, -5, 1]
    assert np.all(np.abs(clip[:3] / clip[3]) <= 1)
    # A view outlives its plan.
    del plan
    assert np.isfinite(matrix).all()
    assert matrix[3, 3] != 0


def test_bad_input_is_refused_by_name():
    camera, sun, boxes = gnomon.perspective(fov_y=1.0), gnomon.directional((0, -1, 0)), [[-9, -1, -20, 9, 0, -1.0]]

    def field_of(run):
        with pytest.raises(GnomonError) as caught:
            run()
        return caught.value.field

    assert field_of(lambda: gnomon.plan(camera, sun, boxes, boxes, cascades=9)) == "plan_options.cascades"
    assert field_of(lambda: gnomon.plan(camera, sun, boxes, boxes, cascades=2**40)) == "plan_options.cascades"
    assert field_of(lambda: gnomon.plan(camera, sun, boxes, boxes, cascades=1.5)) == "plan_options.cascades"
    assert field_of(lambda: gnomon.plan(camera, sun, boxes, boxes, warp="teapot")) == "plan_options.warp"
    assert field_of(lambda: gnomon.plan(camera, sun, boxes, boxes, map_size=1)) == "plan_options.map_size"
    assert field_of(lambda: gnomon.plan(camera, sun, boxes, boxes, size=1)) == "plan_options.size"
    assert field_of(lambda: gnomon.plan(camera, sun, boxes, boxes, prune=["x"])) == "plan_options.prune"
    assert field_of(lambda: gnomon.plan(camera, sun, [1, 2, 3], boxes)) == "scene.casters"
    assert field_of(lambda: gnomon.plan(camera, sun, [[np.nan, 0, 0, 1, 1, 1]], boxes)) == "scene.casters"
    assert field_of(lambda: gnomon.perspective(fov_y=60.0)) == "fov_y"
    assert field_of(lambda: gnomon.perspective(fov_y=1.0, width=2**40)) == "width"
    assert field_of(lambda: gnomon.point((0, 0), 1.0)) == "light.position"
    assert field_of(lambda: gnomon.names("teapots")) == "list"
    assert field_of(lambda: gnomon.camera_from(np.eye(3), np.eye(4), width=1, height=1)) == "view_from_world"
    assert field_of(lambda: gnomon.camera_from(np.eye(4), np.eye(4) * np.nan, width=1, height=1)) == "view_from_world, clip_from_view"
    closed = gnomon.CasterSet(boxes)
    closed.close()
    assert field_of(lambda: gnomon.plan(camera, sun, closed, boxes)) == "closed"


def test_sets_histories_and_foreign_maps_give_what_lists_and_plans_do():
    boxes = np.array([[-40, -1, -200, 40, 0, 20]] + [[-12 + 20 * (i % 2), 0, -5 * i - 3, -8 + 20 * (i % 2), 2 + i % 7, -5 * i] for i in range(40)], dtype=float)
    camera, sun = gnomon.perspective(position=(0, 3, 10), forward=(0, -0.1, -1), fov_y=1.0, aspect=1.5, near=0.2, far=250), gnomon.directional((0.4, -1, 0.3))
    casters = gnomon.CasterSet(boxes)
    plan, of_set = gnomon.plan(camera, sun, boxes, boxes), gnomon.plan(camera, sun, casters, casters)
    assert [bytes(a._struct) for a in plan.maps] == [bytes(b._struct) for b in of_set.maps]
    assert sorted(gnomon.cull(plan.maps[0], casters)) == sorted(gnomon.cull(plan.maps[0], boxes)) != []
    foreign = gnomon.Plan.foreign([gnomon.Map.foreign(m.clip_from_world, m.width, m.height, m.depth_begin, m.depth_end) for m in plan.maps])
    own, other = gnomon.measure(plan, camera, boxes), gnomon.measure(foreign, camera, boxes)
    assert own.samples == other.samples and abs(own.p95 - other.p95) < 1e-9 * own.p95
    history = gnomon.History()
    for _ in range(3):
        gnomon.plan(camera, sun, boxes, boxes, history=history)
    history.clear()
    indices = gnomon.select(plan, [[0, 0, -5], [0, 0, 900]], [15.0, -890.0])
    assert indices[0] >= 0 and indices[1] == -1
    assert gnomon.shader_block(plan)[10] == len(plan.maps)
    empty = gnomon.plan(camera, sun, None, boxes)
    assert empty.status == "no_caster" and empty.maps == []
    for omission in plan.omitted + empty.omitted:
        assert omission.what and omission.why
