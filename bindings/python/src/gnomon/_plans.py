"""Which maps does one light need, and how good are they?"""
from __future__ import annotations

import ctypes
from typing import Any, NamedTuple, Optional, Sequence, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _layout as c
from ._call import GnomonError, array_of, boxes_of, call, expect, fields_of, make, planes_of, points_of, set_fields, set_options, whole
from ._pages import PagePlan
from ._records import (Boxes, Camera, CasterSet, History, Input, Light, Map, PageStats, Plan, Stats, VisibleDepths,
                       directional, omissions_of, perspective, plan_struct)


def _planned(name: str, *given: Any) -> Plan:
    """What a call writes whose last parameter is a plan."""
    maps, omissions = (c.map * c.MAX_MAPS)(), (c.omission * c.MAX_OMISSIONS)()
    struct = plan_struct(maps)
    struct.omissions, struct.omission_room = ctypes.addressof(omissions), c.MAX_OMISSIONS
    call(name, *given, struct)
    return Plan(struct, maps, list(omissions_of(omissions, struct.omission_count)))


def plan(camera: Camera, light: Light, casters: Boxes, receivers: Boxes, *, points: Optional[ArrayLike] = None,
         normals: Optional[ArrayLike] = None, depths: Optional[VisibleDepths] = None, history: Optional[History] = None,
         **options: Any) -> Plan:
    """Chooses the shadow maps of one light for one camera.

    casters, receivers: (n, 6) boxes, world space, or a CasterSet. points: (n, 3) visible points, world space; default
    unknown. normals: (n, 3) unit, one for each point, towards the eye: warps do not serve points that are turned from the light;
    default unknown. depths: visible depths of this frame or the last ones; default unknown. history: keeps maps steady from
    frame to frame. options: fields of gnomon_plan_options in the C header, such as cascades, resolution_max_size, fit="stable",
    warp="lispsm" (None: the plan chooses), split_scheme="practical", filter_texels, prune=[names],
    clip_space={"zero_to_one": True}. Raises GnomonError with the name of what is not usable.

    >>> plan(perspective(fov_y=1.0), directional((0, -1, 0)), [[0, 5, -9, 1, 6, -8]], [[-9, -1, -20, 9, 0, -1]], fit="stable").status
    'ok'
    >>> plan(perspective(fov_y=1.0), directional((0, -1, 0)), None, None, cascades=0)
    Traceback (most recent call last):
    gnomon.GnomonError: not usable: plan_options.cascades
    """
    given = Input(camera, casters, receivers, points=points, normals=normals, depths=depths)
    return _planned("gnomon_make_plan", given.view, expect(light, Light, "light"), given.scene, set_options(make("plan_options"), options),
                    expect(history, History, "history").place if history is not None else None)


def plan_views(cameras: Sequence[Camera], light: Light, casters: Boxes, receivers: Boxes, **options: Any) -> Plan:
    """Chooses the maps that 1..8 cameras share: two eyes, a split screen, faces of a probe. Plan.origin is the mean of the eyes.
    Otherwise as plan().

    >>> eyes, boxes = [perspective(position=(x, 3, 0), fov_y=1.0) for x in (0, 0.06)], [[-40, -1, -90, 40, 0, 0], [0, 1, -9, 1, 6, -8]]
    >>> plan_views(eyes, directional((0.3, -1, 0)), boxes, boxes, cascades=2).origin.tolist()
    [0.03, 3.0, 0.0]
    """
    if not 1 <= len(cameras) <= c.MAX_VIEWS:
        raise GnomonError("cameras", "cameras: expected 1..%d" % c.MAX_VIEWS)
    places = (ctypes.c_void_p * len(cameras))(*(ctypes.addressof(expect(camera, Camera, "cameras")) for camera in cameras))
    given = Input(cameras[0], casters, receivers)
    return _planned("gnomon_plan_views", places, len(cameras), expect(light, Light, "light"), given.scene,
                    set_options(make("plan_options"), options))


@overload
def measure(plan: Plan, camera: Camera, receivers: Boxes, *, points: Optional[ArrayLike] = None, normals: Optional[ArrayLike] = None,
            columns: int = 64, rows: int = 64, depths: int = 64, map: int = -1) -> Stats: ...
@overload
def measure(plan: PagePlan, camera: Camera, receivers: Boxes, *, points: Optional[ArrayLike] = None, normals: Optional[ArrayLike] = None,
            columns: int = 64, rows: int = 64, depths: int = 64, map: int = -1) -> PageStats: ...


def measure(plan: Union[Plan, PagePlan], camera: Camera, receivers: Boxes, *, points: Optional[ArrayLike] = None,
            normals: Optional[ArrayLike] = None, columns: int = 64, rows: int = 64, depths: int = 64, map: int = -1) -> Stats:
    """Measures the error of a plan over what the camera sees: of its maps or pages, also of foreign maps (Plan.foreign).

    receivers: (n, 6) boxes or a CasterSet. points: (n, 3) visible points; None, or no point: columns x rows pixels with depths each
    are sampled in the receivers. normals: (n, 3) unit, one for each point: read for pages alone, whose error is then that on the
    surface, without points that are turned from the light or the eye. map: index of the one map that counts; -1: all; not read for
    pages.
    """
    given = Input(camera, None, receivers, points=points, normals=normals)
    options = set_fields(make("measure_options"), {"columns": columns, "rows": rows, "depths": depths, "map": map})
    stats = make("stats")
    if isinstance(plan, PagePlan):
        texels = ctypes.c_double()
        call("gnomon_measure_pages", plan._struct, given.view, given.scene, options, stats, ctypes.byref(texels))
        return PageStats(stats, texels.value)
    call("gnomon_measure", expect(plan, Plan, "plan")._struct, given.view, given.scene, options, stats)
    return Stats(stats)


_POINT_ERROR = np.dtype([(name, "i4" if kind is ctypes.c_int32 else "f8") for name, kind in fields_of(c.point_error).items()])


def measure_points(map: Map, camera: Camera, points: ArrayLike, normals: Optional[ArrayLike] = None) -> NDArray[Any]:
    """The error of one map at each point, also of a foreign one. points: (n, 3) world space. normals: (n, 3) unit; without,
    the perspective part alone.

    Returns (n,) records: status (0: the error is known, 1: outside of the map, 2: turned away, 3: edge-on), m_max, m_min,
    m_s, m_t, m_area, all screen pixels per texel, anisotropy, perspective_max, perspective_s, perspective_t, projection.

    >>> camera = perspective(position=(0, 3, 10), forward=(0, -0.1, -1), fov_y=1.0, far=250)
    >>> boxes = [[-40, -1, -200, 40, 0, 20], [-4, 0, -30, 4, 6, -26.0]]
    >>> result = plan(camera, directional((0.4, -1, 0.3)), boxes, boxes, cascades=1)
    >>> errors = measure_points(result.maps[0], camera, [[0, 0, -5], [0, 0, -50]], [[0, 1, 0]] * 2)
    >>> errors["status"].tolist(), bool((errors["m_max"] >= errors["m_min"]).all())
    ([0, 0], True)
    """
    array = points_of(points, "points")
    facing = points_of(normals, "normals") if normals is not None else None
    if facing is not None and len(facing) != len(array):
        raise GnomonError("normals", "normals: expected as many as points")
    errors = np.empty(len(array), dtype=_POINT_ERROR)
    call("gnomon_measure_points", map._struct, expect(camera, Camera, "camera"), array.ctypes.data, facing.ctypes.data if facing is not None else None,
         len(array), errors.ctypes.data)
    return errors


def select(plan: Plan, points: ArrayLike, view_depths: ArrayLike) -> NDArray[np.int32]:
    """Index of the map that serves each point, or -1: lit. points: (n, 3) world space. view_depths: (n,) world units."""
    array, depths = points_of(points, "points"), array_of(view_depths, "view_depths", np.float64)
    if depths.shape != (len(array),):
        raise GnomonError("view_depths", "view_depths: expected one for each point")
    indices = np.empty(len(array), dtype=np.int32)
    call("gnomon_select", plan._struct, array.ctypes.data, depths.ctypes.data, len(array), indices.ctypes.data)
    return indices


def cull(map: Map, casters: Union[ArrayLike, CasterSet]) -> NDArray[np.uint32]:
    """Indices of the casters that a map needs: (n, 6) boxes, or a CasterSet."""
    found = ctypes.c_int64()
    if isinstance(casters, CasterSet):
        indices = np.empty(len(casters), dtype=np.uint32)
        call("gnomon_cull_set", map._struct, casters.place, indices.ctypes.data, len(indices), ctypes.byref(found))
    else:
        boxes = boxes_of(casters, "casters")
        indices = np.empty(len(boxes), dtype=np.uint32)
        call("gnomon_cull", map._struct, boxes.ctypes.data, len(boxes), indices.ctypes.data, len(boxes), ctypes.byref(found))
    return indices[:found.value]


def cull_planes(planes: ArrayLike, casters: CasterSet) -> NDArray[np.uint32]:
    """Indices of the casters that lie within planes of one's own, in part at least: (n, 4), n up to 32, as Map.cull_planes. Those of
    rectangle_planes(), say."""
    array, found = planes_of(planes, "planes"), ctypes.c_int64()
    indices = np.empty(len(expect(casters, CasterSet, "casters")), dtype=np.uint32)
    call("gnomon_cull_planes", array.ctypes.data, len(array), casters.place, indices.ctypes.data, len(indices), ctypes.byref(found))
    return indices[:found.value]


def shader_block(plan: Plan, layer_width: int = 0, layer_height: int = 0, blur_texels: float = 0.0) -> NDArray[np.float32]:
    """The uniform block of shaders/library/shadow_block.glsl (std140), (460,) float32."""
    block = np.empty(c.SHADER_BLOCK_FLOATS, dtype=np.float32)
    call("gnomon_shader_block", plan._struct, whole(layer_width, "layer_width"), whole(layer_height, "layer_height"), float(blur_texels), block.ctypes.data)
    return block


class EngineBias(NamedTuple):
    """A bias in an engine's units. All of it is towards the light."""

    depth: float  #: of the map's depth, 0..1
    slope_factor: float  #: times the larger growth of depth over a texel, along the map's x or y
    normal_world: float  #: along the normal, world units
    units: float  #: depth in units of rasterizer states: steps of the map's format


def engine_bias(plan: Plan, map: int, way: str = "rasterizer", *, kernel_radius_texels: float = 0.0, depth_bits: int = 0) -> EngineBias:
    """The bias of a map in an engine's own units: what keeps planes from shadowing themselves under a kernel of this radius.

    map: index in plan.maps. way: "rasterizer" (glPolygonOffset, states of Direct3D, Vulkan and Metal) or "normal_offset"
    (three.js, Babylon.js, Unity, Godot). depth_bits: of a map that stores normalized integers, 1..32; 0: single precision. depth
    is right where the map's w is constant: parallel light without a warp; elsewhere it holds in the middle of the map.

    >>> boxes = [[-40, -1, -200, 40, 0, 20], [-4, 0, -30, 4, 6, -26.0]]
    >>> result = plan(perspective(position=(0, 3, 10), fov_y=1.0, far=250), directional((0.4, -1, 0.3)), boxes, boxes)
    >>> bias = engine_bias(result, 0, kernel_radius_texels=1.5)
    >>> bias.slope_factor, bias.normal_world, bias.units > 0
    (4.0, 0.0, True)
    """
    bias, ways = c.engine_bias(), {"rasterizer": c.BIAS_RASTERIZER, "normal_offset": c.BIAS_NORMAL_OFFSET}
    if way not in ways:
        raise GnomonError("way", "way: expected 'rasterizer' or 'normal_offset'")
    call("gnomon_translate_bias", plan._struct, whole(map, "map"), ways[way], float(kernel_radius_texels), whole(depth_bits, "depth_bits"), bias)
    return EngineBias(bias.depth, bias.slope_factor, bias.normal_world, bias.units)
