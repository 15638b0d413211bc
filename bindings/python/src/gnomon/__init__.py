"""Shadow maps, chosen by measurement.

A camera, a light and the bounds of a scene become the shadow maps worth drawing, with their error in screen pixels per
texel. Matrices are numpy arrays of shape (4, 4), rows first, that act on column vectors. Lengths are in world units, angles in
radians, the world is right-handed. Boxes have the shape (n, 6): least x, y, z, then largest x, y, z. Points have the shape
(n, 3). Arrays of float64 in C order are read where they lie; others are copied.

>>> camera = perspective(position=(0, 3, 10), forward=(0, -0.1, -1), fov_y=1.0, aspect=1.5, far=250)
>>> boxes = [[-40, -1, -200, 40, 0, 20], [-4, 0, -30, 4, 6, -26.0]]
>>> result = plan(camera, directional((0.4, -1, 0.3)), boxes, boxes, cascades=2)
>>> result.status, [shadow_map.width for shadow_map in result.maps]
('ok', [1024, 1024])
>>> bool(0.01 < measure(result, camera, boxes).p95 < 10)
True
>>> result.to_dict()["maps"][0]["width"]
1024
"""
from ._call import GnomonError, lib, strings
from ._frames import DepthTracker, HeldSun, Reuse, compare, hold_sun, jitter, jitter_texels, rebased, rectangle_planes
from ._many import Atlas, Clusters, LightHistory, LightMaps, LightPlan, camera_round, clusters, lights, pack_atlas
from ._pages import DEPTH_EDGE, SHADOW_CHANGED, SHADOW_EDGE, PagePlan, PagePool, pages
from ._pictures import WrongPixels, expected_error, shadow_edge_points
from ._plans import EngineBias, cull, cull_planes, engine_bias, measure, measure_points, plan, plan_views, select, shader_block
from ._program import Masks, judge, masks
from ._records import (Camera, CasterSet, Event, History, Light, Map, Omission, PageStats, Plan, Stats, VisibleDepths, camera_from,
                       directional, orthographic, perspective, point, spot, texture_from_clip)

__all__ = ["Atlas", "Camera", "CasterSet", "Clusters", "DEPTH_EDGE", "DepthTracker", "EngineBias", "Event", "GnomonError",
           "HeldSun", "History", "Light", "LightHistory", "LightMaps", "LightPlan", "Map", "Masks", "Omission", "PagePlan",
           "PagePool", "PageStats", "Plan", "Reuse", "SHADOW_CHANGED", "SHADOW_EDGE", "Stats", "VisibleDepths", "WrongPixels",
           "camera_from", "camera_round", "clusters", "compare", "cull", "cull_planes", "directional", "engine_bias",
           "expected_error", "hold_sun", "jitter", "jitter_texels", "judge", "lights", "masks", "measure", "measure_points",
           "names", "orthographic", "pack_atlas", "pages", "perspective", "plan", "plan_views", "point", "rebased",
           "rectangle_planes", "select", "shader_block", "shadow_edge_points", "spot", "texture_from_clip", "version"]


def version() -> str:
    """Version of the library as "major.minor.patch".

    >>> version().count(".")
    2
    """
    return lib.gnomon_version().decode()


def names(what: str) -> dict[str, str]:
    """Names and one line about each: "warps", "shapes", "fits", "splits", "partitions", "selections", "objectives",
    "prune_rules" or "page_policies".

    >>> "optimal" in names("warps")
    True
    """
    return strings(what)
