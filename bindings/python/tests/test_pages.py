"""Are pages and many lights those of the native library, bit for bit, and kept from frame to frame? CASES and MORE name the files of
c_dump_cases."""
import ctypes
import os
import struct

import numpy as np
import pytest

import gnomon
from gnomon import GnomonError
from gnomon import _layout as c
from test_same_bits import read_cases

BOXES = np.array([[-40, -1, -200, 40, 0, 20], [-4, 0, -30, 4, 6, -26], [2, 0, -9, 3, 4, -8.0]])
GROUND = np.array([[0.5 * (i % 31) - 8, 0, 5 - 0.05 * i] for i in range(3000)])


def camera_at(z=10.0):
    return gnomon.perspective(position=(0, 3, z), forward=(0, -0.1, -1), fov_y=1.0, aspect=1.5, near=0.2, far=250, width=960, height=640)


def paged(camera=None, **options):
    options = {"points": GROUND, "capacity": 512, "plan_options": {"fit": "stable"}, **options}
    return gnomon.pages(camera or camera_at(), gnomon.directional((0.4, -1, 0.3)), BOXES, BOXES, **options)


def field_of(run):
    with pytest.raises(GnomonError) as caught:
        run()
    return caught.value.field


def test_pages_and_lights_have_the_bits_of_the_native_library():
    with open(os.environ["MORE"], "rb") as file:
        data = file.read()
    at = pages = levels = lights = 0

    def take(count):
        nonlocal at
        at += count
        assert at <= len(data)
        return data[at - count:at]

    policies = list(gnomon.names("page_policies"))
    for number, one in enumerate(read_cases(os.environ["CASES"])):
        camera, light = c.camera.from_buffer_copy(one["camera"]), c.light.from_buffer_copy(one["light"])
        scene = one["casters"], one["receivers"]

        def run():
            return gnomon.pages(camera, light, *scene, points=None, policy=policies[number % len(policies)], capacity=64 << number % 4)

        status, = struct.unpack("<i", take(4))
        if status == c.INVALID_INPUT:
            assert field_of(run)
        else:
            plan = run()
            assert plan.status == ("ok", "nothing_visible", "no_caster")[status], number
            if status == c.OK:
                assert (plan.page_count, plan.level_count, plan.target_m) == struct.unpack("<iid", take(16)), number
                assert plan.pages.tobytes() == take(ctypes.sizeof(c.page) * plan.page_count), number
                assert b"".join(bytes(level._struct) for level in plan.levels) == take(ctypes.sizeof(c.map) * plan.level_count), number
                stats = gnomon.measure(plan, camera, one["receivers"])
                assert bytes(stats._struct) + struct.pack("<d", stats.texels_per_pixel) == take(ctypes.sizeof(c.stats) + 8), number
                pages, levels = pages + plan.page_count, levels + plan.level_count
        reach = camera.near_depth * 400.0
        place = [p + (0.05 if k == 1 else -0.02) * reach for k, p in enumerate(camera.position)]
        lamps = light, gnomon.point(place, reach), gnomon.spot(place, list(camera.forward), 0.5, reach)

        def divide():
            return gnomon.lights(camera, lamps, *scene, weights=[1, 2, 3])

        status, = struct.unpack("<i", take(4))
        if status == c.INVALID_INPUT:
            assert field_of(divide)
            continue
        found = divide()
        assert found.status == ("ok", "nothing_visible", "no_caster")[status], number
        assert b"".join(bytes(maps._struct) for maps in found.lights) == take(3 * ctypes.sizeof(c.light_maps)), number
        lights += 3
    assert at == len(data)
    assert pages > 1000 and levels > 300 and lights > 300


def test_a_plan_of_pages_is_that_of_the_call_of_c_and_says_what_was_omitted():
    camera, up = camera_at(), np.tile((0.0, 1.0, 0.0), (len(GROUND), 1))
    plan = paged(normals=up)
    assert len(plan.pages) > 20 and (plan.select(GROUND) >= 0).all()
    settings, base, sun = (gnomon._call.make(name) for name in ("page_options", "plan_options", "light"))
    settings.capacity, base.fit = 512, gnomon._call.find(c.FITS, "stable", "fit")
    settings.plan, sun.direction[:] = ctypes.addressof(base), (0.4, -1, 0.3)
    given = gnomon._records.Input(camera, BOXES, BOXES, points=GROUND, normals=up)
    memory = np.empty(gnomon._call.lib.gnomon_page_memory(512, len(GROUND)), dtype=np.uint8)
    raw = gnomon._call.make("page_plan")
    gnomon._call.call("gnomon_plan_pages", given.view, sun, given.scene, settings, None, memory.ctypes.data, len(memory), raw)
    assert ctypes.string_at(raw.pages, 20 * raw.page_count) == plan.pages.tobytes()
    assert ctypes.string_at(raw.table, 4 * raw.table_count) == plan.table.tobytes()
    # Without normals other points count, and other pages are open.
    assert plan.pages.tobytes() != paged().pages.tobytes()
    few = paged(capacity=8)
    assert few.target_m > 1 and few.page_count <= 8
    assert [one.what for one in few.omitted] and few.to_dict()["omitted"] == [one._asdict() for one in few.omitted]
    assert few._struct.omission_room == 0 and few._struct.omissions is None
    # No warp, unless the options of the base name one.
    plain, none, warped = (paged(plan_options=options).pages.tobytes() for options in (None, {"warp": "none"}, {"warp": "lispsm"}))
    assert plain == none != warped


def test_the_error_of_pages_is_measured_at_points_on_their_surfaces_and_in_boxes():
    camera, up = camera_at(), np.tile((0.0, 1.0, 0.0), (len(GROUND), 1))
    plan = paged()
    found = gnomon.measure(plan, camera, BOXES, points=GROUND)
    assert isinstance(found, gnomon.PageStats) and found.samples > 2000 and 0 < found.p95 <= 1.5
    assert found.texels_per_pixel == plan.page_count * plan.page_texels ** 2 / (960 * 640)
    assert found.to_dict()["texels_per_pixel"] == found.texels_per_pixel
    on_ground = gnomon.measure(plan, camera, BOXES, points=GROUND, normals=up)
    assert on_ground.samples == found.samples and on_ground.mean != found.mean
    # Away from the light nothing counts.
    assert gnomon.measure(plan, camera, BOXES, points=GROUND, normals=-up).samples == 0
    assert gnomon.measure(plan, camera, BOXES).samples > 4000


def test_a_pool_draws_pages_once_and_those_that_a_moved_caster_touches_again():
    plan, pool = paged(), gnomon.PagePool(512)
    first = pool.keep(plan)
    assert len(pool) == 512 and first["draw"].all() and len(set(first["slot"].tolist())) == plan.page_count == len(first)
    again = pool.keep(plan)
    assert not again["draw"].any() and not again["compose"].any() and (again["slot"] == first["slot"]).all()
    touched = pool.keep(plan, BOXES[2:])
    assert 0 < touched["draw"].sum() < plan.page_count
    # The camera moves on: pages that stay keep their slots.
    moved = paged(camera_at(9.5), last=plan)
    kept = pool.keep(moved)
    assert 0 < kept["draw"].sum() < 0.5 * moved.page_count
    pool.clear()
    assert pool.keep(plan)["draw"].all()
    # The same as the call of C, from a pool that holds nothing.
    slots, table = (c.page_slot * 512)(), (ctypes.c_uint32 * gnomon._call.lib.gnomon_page_table_size(512))()
    raw, drawn = (c.kept_page * plan.page_count)(), ctypes.c_int64()
    for expected, changed in ((first, BOXES[:0]), (again, BOXES[:0]), (touched, BOXES[2:])):
        gnomon._call.call("gnomon_keep_pages", plan._struct, changed.ctypes.data, len(changed), slots, 512, table, raw, ctypes.byref(drawn))
        assert [(one.slot, bool(one.draw), bool(one.compose)) for one in raw] == expected.tolist() and drawn.value == expected["draw"].sum()


@pytest.mark.parametrize("policy, bit", (("edges", gnomon.SHADOW_EDGE), ("picture", gnomon.SHADOW_EDGE), ("queried", gnomon.SHADOW_CHANGED), ("tiled", gnomon.DEPTH_EDGE)))
def test_policies_read_the_picture_of_the_last_frame(policy, bit):
    last = paged(policy=policy)
    feedback = np.zeros(len(GROUND), dtype=np.uint8)
    feedback[1000:1200] = bit
    some, all_bits, none = (paged(policy=policy, last=last, feedback=bits) for bits in (feedback, np.full_like(feedback, bit), 0 * feedback))
    assert some.page_count > 0 and len({one.pages.tobytes() for one in (some, all_bits, none)}) > 1
    # Other bits are not read, and lists will do.
    assert paged(policy=policy, last=last, feedback=(feedback | 8).tolist()).pages.tobytes() == some.pages.tobytes()
    given = gnomon._records.Input(camera_at(), BOXES, BOXES, points=GROUND)
    past, settings, base, sun, raw = (gnomon._call.make(name) for name in ("page_history", "page_options", "plan_options", "light", "page_plan"))
    past.last, past.feedback, past.feedback_count = ctypes.addressof(last._struct), feedback.ctypes.data, len(feedback)
    settings.capacity, settings.policy, base.fit = 512, gnomon._call.find(c.PAGE_POLICIES, policy, ""), gnomon._call.find(c.FITS, "stable", "")
    settings.plan, sun.direction[:] = ctypes.addressof(base), (0.4, -1, 0.3)
    memory = np.empty(gnomon._call.lib.gnomon_page_memory(512, len(GROUND)), dtype=np.uint8)
    gnomon._call.call("gnomon_plan_pages", given.view, sun, given.scene, settings, past, memory.ctypes.data, len(memory), raw)
    assert ctypes.string_at(raw.pages, 20 * raw.page_count) == some.pages.tobytes()


def lamps():
    return [gnomon.point((0, 4, -60), 5), gnomon.spot((3, 6, -70), (0, -1, 0), 0.6, 8), gnomon.point((900, 4, -9), 2)]


POSTS = [[0, 1, -61, 1, 3, -59], [2, 1, -72, 4, 3, -69.0]]


def divided(lights, **options):
    return gnomon.lights(camera_at(), lights, POSTS, BOXES[:1], **{"texel_budget": 1 << 20, **options})


def test_lights_that_a_history_knows_are_drawn_by_turns():
    history, lights = gnomon.LightHistory(3), lamps()
    first = divided(lights, history=history)
    assert (first.mapped, first.due, first.status) == (2, 2, "ok") and first.lights[2].outcome == c.LIGHT_WITHOUT_RECEIVER
    places = [maps.places.tolist() for maps in first.lights]
    turns = [divided(lights, history=history) for _ in range(8)]
    assert all([maps.places.tolist() for maps in one.lights] == places for one in turns)
    assert sum(one.due for one in turns) < 8 and turns[0].due == 0
    # What changed is due at once, and so is a light that is forgotten.
    assert [maps.due for maps in divided(lights, history=history, changed=[True, False, False]).lights[:2]] == [1, 0]
    history.forget(1)
    assert [maps.due for maps in divided(lights, history=history).lights[:2]] == [0, 1]
    # In another order lights keep their places if what is remembered is exchanged.
    history.swap(0, 1)
    swapped = divided([lights[1], lights[0], lights[2]], history=history)
    assert [maps.places.tolist() for maps in swapped.lights[:2]] == [places[1], places[0]]
    # Costs fill a budget of milliseconds.
    dear = divided(lights, draws=[10, 10, 0], triangles=[1000] * 3, cost_per_kilodraw=1.0)
    assert dear.milliseconds > 0 == first.milliseconds


def test_the_maps_of_a_light_are_planned_with_its_own_options_and_a_camera_round_it():
    lights = lamps()
    base = {"prune": [], "fit": "stable", "clip_space": {"zero_to_one": True}, "filter_texels": 1.5}
    found = divided(lights, plan_options=base)
    for i, lamp in enumerate(lights[:2]):
        options = found.plan_options(i)
        assert options["resolution_max_size"] == found.lights[i].texels > 0
        assert (options["fit"], options["filter_texels"], options["clip_space"]["zero_to_one"]) == ("stable", 1.5, True)
        # They make the struct that C wrote.
        expected, made = gnomon._call.make("plan_options"), gnomon._call.set_options(gnomon._call.make("plan_options"), options)
        gnomon._call.call("gnomon_light_plan_options", found._settings, found.lights[i]._struct, expected)
        assert bytes(made) == bytes(expected)
        round_it = gnomon.camera_round(lamp, camera_at())
        assert round_it.orthographic and abs(round_it.far_depth - 2 * lamp.range) < 0.02 * lamp.range
        plan = gnomon.plan(round_it, lamp, POSTS, BOXES[:1], **options)
        assert len(plan.maps) == found.lights[i].map_count and {one.width for one in plan.maps} == {found.lights[i].texels}
        assert found.atlas(i).atlas_from_clip(0).shape == (4, 4)
    sun = gnomon.directional((0, -1, 0))
    assert bytes(gnomon.camera_round(sun, camera_at())) == bytes(camera_at())


def test_bad_input_is_refused_by_name():
    plan, pool, lights, closed = paged(), gnomon.PagePool(512), lamps(), gnomon.LightHistory()
    closed.close()
    for field, run in {
        "page_history.last": lambda: paged(last=BOXES),
        "page_history.feedback": lambda: paged(feedback=np.zeros(3, dtype=np.uint8)),
        "page_options.capacity": lambda: paged(capacity=0),
        "page_options.policy": lambda: paged(policy="teapot"),
        "view.normals": lambda: paged(normals=[[0, 1, 0]]),
        "slots": lambda: gnomon.PagePool(0),
        "slot_count": lambda: gnomon.PagePool(2).keep(plan),
        "moved": lambda: pool.keep(plan, np.full((1, 6), np.nan)),
        "plan": lambda: pool.keep(BOXES),
        "page": lambda: plan.page_map(2**64),
        "level": lambda: plan._map("gnomon_page_level", 99),
        "measure_options.columns": lambda: gnomon.measure(plan, camera_at(), BOXES, columns=0),
        "light_request.weight": lambda: divided(lights, weights=[1, np.nan, 1]),
        "light_request.changed": lambda: divided(lights, changed=[True]),
        "light_request.draws": lambda: divided(lights, draws=[-1, 0, 0]),
        "light_request.triangles": lambda: divided(lights, triangles=[0, 0, np.inf]),
        "light_options.depths": lambda: divided(lights, depths=None),
        "light_history": lambda: divided(lights, history=gnomon.LightHistory(2)),
        "lights": lambda: gnomon.LightHistory(4097),
        "a": lambda: gnomon.LightHistory(2).swap(2, 0),
        "b": lambda: gnomon.LightHistory(2).swap(0, -1),
        "light": lambda: divided(lights).plan_options(3),
        "closed": lambda: divided(lights, history=closed),
        "light.range": lambda: gnomon.camera_round(gnomon.point((0, 0, 0), -1), camera_at()),
        "camera": lambda: gnomon.camera_round(lights[0], lights[0]),
    }.items():
        assert field_of(run) == field, field
    assert field_of(lambda: divided(lights, history=gnomon.History())) == "light_history"
    assert field_of(lambda: gnomon.PagePool(2**32 + 1)) == "slots"
    assert field_of(lambda: gnomon.LightHistory().forget(4096)) == "light"
    for feedback in ([256] * len(GROUND), [-1] * len(GROUND), [0.5] * len(GROUND), np.zeros((len(GROUND), 2), dtype=np.uint8), ["a"], [np.nan] * len(GROUND)):
        assert field_of(lambda: paged(feedback=feedback)) == "page_history.feedback"
    # The message names the light.
    with pytest.raises(GnomonError, match=r"lights\[1\]: not usable: light_request.weight"):
        divided(lights, weights=[1, -1, 1])


def test_fractions_texts_and_ragged_lists_are_refused_by_name():
    boxes = gnomon.CasterSet(BOXES)
    assert field_of(lambda: boxes.update(0.5, BOXES[0])) == "index"
    for slots in (2.9, "12", None):
        assert field_of(lambda: gnomon.PagePool(slots)) == "slots"
    assert field_of(lambda: gnomon.LightHistory(2.7)) == "lights"
    assert field_of(lambda: paged(policy=None)) == "page_options.policy"
    assert field_of(lambda: paged(feedback=[[1], [2, 3]])) == "page_history.feedback"
    assert field_of(lambda: gnomon.rebased(paged().levels[0], "abc")) == "origin"
    assert field_of(lambda: gnomon.CasterSet([[0, 1], [2]])) == "boxes"
    assert field_of(lambda: gnomon.texture_from_clip(3)) == "clip_space"
