"""Are masks of the program gnomon those of its scene? GNOMON_PROGRAM names it."""
import numpy as np
import pytest

import gnomon
from gnomon import GnomonError

SEEN = {"width": 160, "height": 90, "eye": (0, 3, 12), "target": (0, 1, 0)}


def test_exact_masks_and_those_of_filters_agree_but_at_edges():
    found = gnomon.masks("builtin:fence", ["hard", "pcf:radius=2"], cascades=2, map_size=1024, **SEEN)
    assert found.exact.shape == (90, 160) and found.exact.dtype == np.float32
    # Ground, shadow, and the sky above.
    assert set(np.unique(found.exact)) == {-1, 0, 1} and (found.exact[0] == -1).all() and (found.exact == 0).sum() > 300
    known = found.exact >= 0
    hard, soft = found.filters["hard"], found.filters["pcf:radius=2"]
    assert ((hard < 0) == (soft < 0)).all() and (hard[known] >= 0).all()
    wrong = np.abs(hard - found.exact)[known].mean()
    assert 0 < wrong < 0.05
    assert len(np.unique(soft)) > 10
    # Larger maps are nearer to the truth.
    coarse = gnomon.masks("builtin:fence", ["hard"], cascades=1, map_size=128, **SEEN)
    assert (coarse.exact == found.exact).all()
    assert np.abs(coarse.filters["hard"] - found.exact)[known].mean() > wrong


def test_what_the_program_refuses_is_told():
    def refused(*arguments, **options):
        with pytest.raises(GnomonError) as caught:
            gnomon.masks(*arguments, **options)
        return caught.value.field, str(caught.value)

    assert refused("no_file.glb")[0] == "scene" and "no_file.glb" in refused("no_file.glb")[1]
    assert "teapot" in refused("builtin:fence", ["teapot"], width=32, height=18)[1]
    assert "--size" in refused("builtin:fence", width=-1)[1]
    assert "cascade" in refused("builtin:fence", cascades=99)[1]
    # No shell reads a name.
    assert refused("$(touch x); builtin:fence")[0] == "scene"
    assert refused("builtin:fence", program="/no/gnomon")[0] == "program"
    assert refused("builtin:fence", eye=(0, 0, 0))[0] == "target"
    assert refused("builtin:fence", eye=(0, 0), target=(0, 0, 1))[0] == "eye"


def capture_of(plan, camera, boxes, sun):
    def corners(box):
        return {"min": box[:3], "max": box[3:]}

    eye, forward = np.array(camera.position[:]), np.array(camera.forward[:]) / np.linalg.norm(camera.forward[:])
    right = np.cross(forward, camera.up[:]) / np.linalg.norm(np.cross(forward, camera.up[:]))
    view_from_world = np.eye(4)
    view_from_world[:3, :3] = right, np.cross(right, forward), -forward
    view_from_world[:3, 3] = -view_from_world[:3, :3] @ eye
    near, far = camera.near_depth, camera.far_depth
    clip_from_view = np.array([[1 / camera.right, 0, 0, 0], [0, 1 / camera.top, 0, 0],
                               [0, 0, (far + near) / (near - far), 2 * far * near / (near - far)], [0, 0, -1, 0]])
    return {"format": "gnomon-capture/1", "name": "test", "clip_space": {"ndc_depth": "minus_one_to_one"},
            "receivers": [corners(box) for box in boxes], "casters": [corners(box) for box in boxes],
            "camera": {"view_from_world": view_from_world, "clip_from_view": clip_from_view, "width": camera.width, "height": camera.height},
            "lights": [{"type": "directional", "direction": sun}],
            "maps": [{"clip_from_world": np.array(one.clip_from_world), "light": 0, "width": one.width, "height": one.height,
                      "depths": [one.depth_begin, one.depth_end], "filter_texels": 1, "bias": {"world": 0.02}} for one in plan.maps]}


def test_maps_of_an_engine_are_judged():
    camera = gnomon.perspective(position=(0, 3, 10), forward=(0, -0.1, -1), fov_y=1.0, aspect=1.5, near=0.2, far=250, width=960, height=640)
    boxes, sun = np.array([[-40, -1, -200, 40, 0, 20], [-4, 0, -30, 4, 6, -26.0]]), [0.4, -1, 0.3]
    plan = gnomon.plan(camera, gnomon.directional(sun), boxes, boxes, cascades=2)
    capture = capture_of(plan, camera, boxes, sun)
    found = gnomon.judge(capture)
    assert found["lights"][0]["maps"] == 2
    p95 = gnomon.measure(plan, camera, boxes).p95
    assert abs(found["lights"][0]["m"]["p95"] - p95) < 0.1 * p95
    assert not {"transposed", "mirrored", "depth_reversed", "receivers_outside"} & {one["kind"] for one in found["findings"]}
    # Maps of a fourth of the extent leave most receivers outside; mirrored depth is another fault.
    for scale, kind in ((np.array([4, 4, 1, 1]), "receivers_outside"), (np.array([1, 1, -1, 1]), "depth_reversed")):
        maps = [{**one, "clip_from_world": scale[:, None] * one["clip_from_world"]} for one in capture["maps"]]
        assert kind in {one["kind"] for one in gnomon.judge({**capture, "maps": maps})["findings"]}
    for broken in ({"format": "gnomon-capture/1"}, {**capture, "maps": [{"clip_from_world": [1, 2]}]}, {"a": object()}):
        with pytest.raises(GnomonError) as caught:
            gnomon.judge(broken)
        assert caught.value.field == "capture" and str(caught.value)
    with pytest.raises(GnomonError):
        gnomon.judge("no_file.json")
