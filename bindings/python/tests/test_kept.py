"""What of a frame holds in the next: maps, histories, sets of boxes; and are maps that cameras share those of the native library?"""
import ctypes

import numpy as np
import pytest

import gnomon
from gnomon import GnomonError
from gnomon import _layout as c

BOXES = np.array([[-40, -1, -200, 40, 0, 20]] + [[-12 + 20 * (i % 2), 0, -5 * i - 3, -8 + 20 * (i % 2), 2 + i % 7, -5 * i] for i in range(40)], dtype=float)
SUN = gnomon.directional((0.4, -1, 0.3))


def camera_at(z=10.0, x=0.0):
    return gnomon.perspective(position=(x, 3, z), forward=(0, -0.1, -1), fov_y=1.0, aspect=1.5, near=0.2, far=250)


def bits_of(plan):
    return [bytes(one._struct) for one in plan.maps]


def clip_of(matrix, points):
    clip = np.c_[points, np.ones(len(points))] @ np.asarray(matrix, dtype=float).T
    return clip[:, :3] / clip[:, 3:]


def test_views_share_the_maps_of_the_call_of_c():
    cameras = [camera_at(), camera_at(x=0.5), camera_at(z=12)]
    shared = gnomon.plan_views(cameras, SUN, BOXES, gnomon.CasterSet(BOXES), cascades=2, filter_texels=1.5)
    assert shared.status == "ok" and len(shared.maps) == 2 and np.allclose(shared.origin, (0.5 / 3, 3, 32 / 3))
    places = (ctypes.c_void_p * 3)(*(ctypes.addressof(one) for one in cameras))
    given, options, maps = gnomon._records.Input(cameras[0], BOXES, BOXES), gnomon._call.make("plan_options"), (c.map * c.MAX_MAPS)()
    options.cascades, options.filter_texels, raw = 2, 1.5, gnomon._records.plan_struct(maps)
    gnomon._call.call("gnomon_plan_views", places, 3, SUN, given.scene, options, raw)
    assert bits_of(shared) == [bytes(one) for one in maps[:raw.map_count]]
    # All eyes have what they see in the maps.
    for camera in cameras:
        assert gnomon.measure(shared, camera, BOXES).outside == 0
    alone = gnomon.plan_views(cameras[:1], SUN, BOXES, BOXES)
    assert [one.depth_begin for one in alone.maps] == [one.depth_begin for one in gnomon.plan(cameras[0], SUN, BOXES, BOXES).maps]
    assert gnomon.plan_views(cameras, SUN, None, BOXES).omitted


def test_texels_of_the_last_frame_hold_where_they_are_said_to():
    space = {"zero_to_one": True, "first_row_at_y_max": True}
    before, now = (gnomon.plan(camera_at(z), SUN, BOXES, BOXES, fit="stable", clip_space=space) for z in (10, 9))
    assert gnomon.compare(now.maps[0], now.maps[0], space).kind == "identical"
    kinds = set()
    for old, new in zip(before.maps, now.maps):
        found = gnomon.compare(old, new, now.clip_space)
        kinds.add(found.kind)
        assert found[0] == gnomon.compare(old, new, space)[0] and found.kept.shape == (4,) and found.strips.shape[1:] == (4,)
        raw = c.reuse()
        gnomon._call.call("gnomon_compare", old._struct, new._struct, now.clip_space, raw)
        assert (raw.shift_x, raw.shift_y, raw.strip_count) == (found.shift_x, found.shift_y, len(found.strips))
        for rectangle, expected in zip((found.kept, *found.strips), (raw.kept, *raw.strip)):
            assert rectangle.tolist() == [expected.x, expected.y, expected.width, expected.height]
        if found.kind != "scrolled":
            continue
        # The kept part and the strips fill the map, and a point moves by the shift.
        assert sum(width * height for _, _, width, height in (found.kept, *found.strips)) == new.width * new.height
        x, y, width, height = found.kept
        at = np.array([[x + 0.5, y + 0.5, 0.5], [x + width / 2, y + height / 3, 0.25]])
        texture = gnomon.texture_from_clip(space)
        scale = np.array([new.width, new.height, 1.0])
        points = clip_of(np.linalg.inv(texture @ new.clip_from_world), at / scale)
        moved = clip_of(texture @ old.clip_from_world, points) * scale + (found.shift_x, found.shift_y, 0)
        assert np.allclose(moved[:, :2], at[:, :2], atol=1e-3)
    assert "scrolled" in kinds
    other = gnomon.plan(camera_at(), gnomon.directional((0.1, -1, 0.3)), BOXES, BOXES, fit="stable", clip_space=space)
    assert gnomon.compare(before.maps[0], other.maps[0], space).kind == "none"


def test_kept_maps_are_rebased_to_another_eye():
    plan = gnomon.plan(camera_at(), SUN, BOXES, BOXES)
    first = plan.maps[0]
    assert bytes(gnomon.rebased(first, plan.origin)._struct) == bytes(first._struct)
    eye, points = np.array([1.0, 3, 8]), np.array([[0, 0, -5], [2, 1, 0.0]])
    moved = gnomon.rebased(first, eye)
    assert moved.clip_from_world.tolist() == first.clip_from_world.tolist()
    assert np.allclose(clip_of(moved.clip_from_camera_relative, points - eye), clip_of(first.clip_from_world, points), atol=1e-5)
    # Its own memory: the first one has not moved.
    assert bytes(first._struct) == bits_of(plan)[0] != bytes(moved._struct)


def test_rectangles_of_maps_have_planes_that_cull():
    plan, casters = gnomon.plan(camera_at(), SUN, BOXES, BOXES, fit="stable"), gnomon.CasterSet(BOXES)
    for one in plan.maps:
        whole = gnomon.rectangle_planes(one, (0, 0, one.width, one.height), plan.clip_space)
        assert whole.shape == (5, 4) and np.allclose(np.linalg.norm(whole[:, :3], axis=1), 1)
        found = set(gnomon.cull_planes(whole, casters).tolist())
        assert set(gnomon.cull(one, casters).tolist()) <= found != set()
        parts = [gnomon.rectangle_planes(one, (x, 0, one.width // 2, one.height)) for x in (0, one.width // 2)]
        halves = [set(gnomon.cull_planes(part, casters).tolist()) for part in parts]
        assert halves[0] | halves[1] == found
    # The clip space decides which half has the first rows of the memory.
    for space in ({"y_down": True, "zero_to_one": True}, {"first_row_at_y_max": True}):
        one = gnomon.plan(camera_at(), SUN, BOXES, BOXES, fit="stable", clip_space=space).maps[0]
        planes = gnomon.rectangle_planes(one, (0, 0, one.width, one.height // 2), space)
        rows = clip_of(np.linalg.inv(gnomon.texture_from_clip(space) @ one.clip_from_world), np.array([[0.5, 0.25, 0.5], [0.5, 0.75, 0.5]]))
        assert (rows @ planes[:, :3].T + planes[:, 3] >= 0).all(axis=1).tolist() == [True, False]
    # A box lies within planes as the C header says: a part of it is on the inner side of each.
    low, high = BOXES[:, :3], BOXES[:, 3:]
    inside = np.all([np.where(plane[:3] > 0, high, low) @ plane[:3] + plane[3] >= 0 for plane in whole], axis=0)
    assert found <= set(np.flatnonzero(inside).tolist())
    assert sorted(gnomon.cull_planes(np.empty((0, 4)), casters)) == list(range(len(BOXES)))


def test_histories_say_what_jumped_and_are_tried_twice():
    history = gnomon.History()
    assert history.events == []
    gnomon.plan(camera_at(), SUN, BOXES, BOXES, cascades=2, history=history)
    assert [(one.kind, one.map) for one in history.events] == [("map_appeared", 0), ("map_appeared", 1)]
    gnomon.plan(camera_at(9.9), SUN, BOXES, BOXES, cascades=2, history=history)
    assert history.events == []
    tried = history.copy()
    first, second = (gnomon.plan(camera_at(-60), SUN, BOXES, BOXES, cascades=2, history=one) for one in (tried, history))
    assert bits_of(first) == bits_of(second) and tried.events == history.events
    raw = (c.event * 8)()
    count = gnomon._call.lib.gnomon_history_events(history.place, ctypes.byref(raw), 8)
    kinds = "map_appeared", "map_refitted", "density_jump"
    assert [(kinds[one.kind], one.map, one.density_ratio) for one in raw[:count]] == history.events != []
    history.close()
    assert bits_of(gnomon.plan(camera_at(-60), SUN, BOXES, BOXES, cascades=2, history=tried))


def test_one_box_of_a_set_moves():
    moved, casters = BOXES.copy(), gnomon.CasterSet(BOXES)
    moved[7] += (0, 3, 1, 0, 5, 1)
    casters.update(7, moved[7])
    assert bits_of(gnomon.plan(camera_at(), SUN, casters, BOXES)) == bits_of(gnomon.plan(camera_at(), SUN, moved, BOXES))


def test_points_whose_normals_are_turned_from_the_light_do_not_count():
    ground = np.array([[0.5 * (i % 31) - 8, 0, 5 - 0.1 * i] for i in range(600)])
    wall = np.array([[8, 0.1 * (i % 40), -0.3 * i] for i in range(200)], dtype=float)
    points = np.concatenate([ground, wall])
    # The wall faces the eye, and not the light, which travels along x.
    normals = np.concatenate([np.tile((0.0, 1.0, 0.0), (600, 1)), np.tile((-1.0, 0.0, 0.0), (200, 1))])
    plan = gnomon.plan(camera_at(), gnomon.directional((-1, -1, 0)), BOXES, BOXES, points=points, normals=normals, cascades=1)
    assert bits_of(plan) != bits_of(gnomon.plan(camera_at(), gnomon.directional((-1, -1, 0)), BOXES, BOXES, points=points, cascades=1))
    given, maps = gnomon._records.Input(camera_at(), BOXES, BOXES, points=points, normals=normals), (c.map * c.MAX_MAPS)()
    options, raw = gnomon._call.make("plan_options"), gnomon._records.plan_struct(maps)
    assert (given.view.points, given.view.normals) == (points.ctypes.data, normals.ctypes.data)
    options.cascades = 1
    gnomon._call.call("gnomon_make_plan", given.view, gnomon.directional((-1, -1, 0)), given.scene, options, None, raw)
    assert bits_of(plan) == [bytes(maps[0])]

    # Of a sun, the surfaces' slope decides; without, it lies halfway between eye and light.
    box, way, turned = (-40, -1, -200, 40, 8, 20), np.array([0.4, -1, 0.3]) / np.linalg.norm([0.4, -1, 0.3]), (0.4 + 1e-6, -1, 0.3)
    to_eye = np.array([0, 3, 10.0]) - ground
    half = to_eye / np.linalg.norm(to_eye, axis=1, keepdims=True) - way
    half /= np.linalg.norm(half, axis=1, keepdims=True)
    found, facing, up = (gnomon.hold_sun(camera_at(), way, turned, box, points=ground, normals=one) for one in (None, half, np.tile((0, 1.0, 0), (600, 1))))
    assert 0 < found.error_pixels < 0.25 and np.isclose(found.error_pixels, facing.error_pixels, rtol=1e-6)
    assert abs(up.error_pixels - found.error_pixels) > 1e-3 * found.error_pixels
    # No surface of these is lit.
    assert gnomon.hold_sun(camera_at(), way, turned, box, points=ground, normals=np.tile((0, -1.0, 0), (600, 1))).points_capped == 600
    # Maps do not read them.
    errors = [bytes(gnomon.measure(plan, camera_at(), BOXES, points=ground, normals=one)._struct) for one in (None, half)]
    assert errors[0] == errors[1]


def test_bad_input_is_refused_by_name():
    camera, plan, casters, history = camera_at(), gnomon.plan(camera_at(), SUN, BOXES, BOXES), gnomon.CasterSet(BOXES), gnomon.History()
    first = plan.maps[0]
    history.close()
    points, long = [[0, 0, -5.0]], [[0, 2.0, 0]]
    for field, run in {
        "cameras": lambda: gnomon.plan_views([], SUN, BOXES, BOXES),
        "light": lambda: gnomon.plan_views([camera], None, BOXES, BOXES),
        "plan_options.cascades": lambda: gnomon.plan_views([camera], SUN, BOXES, BOXES, cascades=9),
        "history": lambda: gnomon.plan(camera, SUN, BOXES, BOXES, history=gnomon.LightHistory()),
        "closed": lambda: history.copy(),
        "origin": lambda: gnomon.rebased(first, (0, np.nan, 0)),
        "map": lambda: gnomon.rebased(plan, (0, 0, 0)),
        "previous": lambda: gnomon.compare(plan, first),
        "current": lambda: gnomon.compare(first, None),
        "clip_space.left_hand": lambda: gnomon.compare(first, first, {"left_hand": True}),
        "rectangle": lambda: gnomon.rectangle_planes(first, (0, 0, first.width + 1, 1)),
        "planes": lambda: gnomon.cull_planes([[0, 0, np.nan, 0]], casters),
        "plane_count": lambda: gnomon.cull_planes(np.zeros((33, 4)), casters),
        "casters": lambda: gnomon.cull_planes(np.zeros((1, 4)), BOXES),
        "index": lambda: casters.update(len(BOXES), BOXES[0]),
        "box": lambda: casters.update(0, BOXES[0] * np.nan),
        "view.normals": lambda: gnomon.plan(camera, SUN, BOXES, BOXES, points=points, normals=long),
        "plan": lambda: gnomon.measure(first, camera, BOXES),
    }.items():
        with pytest.raises(GnomonError) as caught:
            run()
        assert caught.value.field == field
    for run in (lambda: gnomon.plan_views([camera] * 9, SUN, BOXES, BOXES), lambda: gnomon.plan_views([camera, SUN], SUN, BOXES, BOXES)):
        with pytest.raises(GnomonError, match="^cameras"):
            run()
    for index in (2**64, -(2**64), -1):
        with pytest.raises(GnomonError) as caught:
            casters.update(index, BOXES[0])
        assert caught.value.field == "index"
    for rectangle in ((0, 0, 0.5, 1), (0, 0, np.nan, 1), (0, 0, 2.0**40, 1), (0, 0, 1), (-1, 0, 1, 1)):
        with pytest.raises(GnomonError) as caught:
            gnomon.rectangle_planes(first, rectangle)
        assert caught.value.field == "rectangle"
    for run in (lambda: gnomon.plan(camera, SUN, BOXES, BOXES, normals=[[0, 1, 0]]), lambda: gnomon.measure(plan, camera, BOXES, points=points, normals=[]),
                lambda: gnomon.hold_sun(camera, (0, 0, 0), (0, -1, 0), np.zeros(6), points=points, normals=long)):
        with pytest.raises(GnomonError) as caught:
            run()
        assert caught.value.field == "view.normals"
