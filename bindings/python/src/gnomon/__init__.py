"""Shadow maps, chosen by measurement.

A camera, a light and the bounds of a scene become the shadow maps worth drawing, with their error in screen pixels per
texel. Matrices are numpy arrays of shape (4, 4), rows first, that act on column vectors. Lengths are in world units, angles in
radians, the world is right-handed. Boxes have the shape (n, 6): least x, y, z, then largest x, y, z. Points have the shape
(n, 3). Arrays of float64 in C order are read where they lie; others are copied.

>>> camera = perspective(position=(0, 3, 10), forward=(0, -0.1, -1), fov_y=1.0, aspect=1.5, far=250)
>>> boxes = np.array([[-40, -1, -200, 40, 0, 20], [-4, 0, -30, 4, 6, -26.0]])
>>> result = plan(camera, directional((0.4, -1, 0.3)), boxes, boxes, cascades=2)
>>> result.status, [shadow_map.width for shadow_map in result.maps]
('ok', [1024, 1024])
>>> bool(0.01 < measure(result, camera, boxes).p95 < 10)
True
"""
from __future__ import annotations

import ctypes
import os
from typing import Any, Iterator, NamedTuple, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _layout as c
from ._call import (GnomonError, Handle, boxes_of, call, find, lib, make, name_of, points_of, set_fields, set_options,
                    strings)

__all__ = ["Camera", "CasterSet", "GnomonError", "History", "LightPlan", "Map", "PagePlan", "Plan", "Stats", "camera_from",
           "cull", "directional", "lights", "measure", "names", "orthographic", "pages", "perspective", "plan", "point",
           "select", "shader_block", "spot", "version"]

Light = c.light
Camera = c.camera


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


# ------------------------------------------------------------------ cameras and lights

def perspective(*, position: ArrayLike = (0, 0, 0), forward: ArrayLike = (0, 0, -1), up: ArrayLike = (0, 1, 0),
                fov_y: float, aspect: float = 16 / 9, near: float = 0.1, far: float = 100.0, width: int = 1920,
                height: int = 1080) -> Camera:
    """A symmetric perspective camera.

    position, forward, up: three numbers, world space. fov_y: full vertical angle, radians, in (0, pi). aspect: width over
    height. near, far: view depths, world units; far may be infinite. width, height: pixels.

    >>> round(perspective(fov_y=np.pi / 2, aspect=1).top, 12)
    1.0
    """
    camera = make("camera")
    set_fields(camera, {"position": position, "forward": forward, "up": up})
    call("gnomon_perspective", camera, float(fov_y), float(aspect), float(near), float(far), int(width), int(height))
    return camera


def orthographic(*, position: ArrayLike = (0, 0, 0), forward: ArrayLike = (0, 0, -1), up: ArrayLike = (0, 1, 0),
                 height_world: float, aspect: float = 16 / 9, near: float = 0.1, far: float = 100.0, width: int = 1920,
                 height: int = 1080) -> Camera:
    """A parallel projection of height_world world units from bottom to top; otherwise as perspective()."""
    camera = make("camera")
    set_fields(camera, {"position": position, "forward": forward, "up": up})
    call("gnomon_orthographic", camera, float(height_world), float(aspect), float(near), float(far), int(width), int(height))
    return camera


def camera_from(view_from_world: ArrayLike, clip_from_view: ArrayLike, *, width: int, height: int,
                zero_to_one: bool = False, reversed_z: bool = False, y_down: bool = False,
                left_handed: bool = False) -> Camera:
    """The camera of an engine's own matrices, shape (4, 4), which act on column vectors. The flags say which clip space the
    projection is for; default OpenGL's. Raises GnomonError with the reason where there is no such camera."""
    camera, why = make("camera"), ctypes.c_char_p()
    space = c.clip_space(zero_to_one=zero_to_one, reversed_z=reversed_z, y_down=y_down, left_handed=left_handed)
    view, clip = (_columns(m, name) for m, name in ((view_from_world, "view_from_world"), (clip_from_view, "clip_from_view")))
    try:
        call("gnomon_camera_from", view.ctypes.data, clip.ctypes.data, space, int(width), int(height), camera, ctypes.byref(why))
    except GnomonError as error:
        raise GnomonError(error.field, why.value.decode()) from None if why.value else error
    return camera


def _columns(matrix: ArrayLike, name: str) -> NDArray[np.float64]:
    array = np.asarray(matrix, dtype=np.float64)
    if array.shape != (4, 4):
        raise GnomonError(name, "%s: expected the shape (4, 4)" % name)
    return np.ascontiguousarray(array.T)


def directional(direction: ArrayLike) -> Light:
    """Parallel light. direction: the way that it travels, any length above 0."""
    return set_fields(make("light"), {"kind": c.DIRECTIONAL, "direction": direction})


def spot(position: ArrayLike, direction: ArrayLike, outer_radians: float, range: float) -> Light:
    """A cone of light. outer_radians: its half angle, in (0, pi). range: world units; nothing is lit beyond."""
    return set_fields(make("light"), {"kind": c.SPOT, "position": position, "direction": direction,
                                      "outer_radians": outer_radians, "range": range})


def point(position: ArrayLike, range: float) -> Light:
    """Light into all directions, up to range world units."""
    return set_fields(make("light"), {"kind": c.POINT, "position": position, "range": range})


# ------------------------------------------------------------------ handles

class History(Handle):
    """State that plans carry from frame to frame. Keep one per camera and light; clear() it at a cut."""

    def __init__(self) -> None:
        super().__init__(lib.gnomon_history_create(), lib.gnomon_history_destroy)

    def clear(self) -> None:
        """Forgets all frames."""
        lib.gnomon_history_clear(self.place)


class CasterSet(Handle):
    """Boxes sorted into a tree, for scenes with hundreds and more. Gives the same plans as their list.

    boxes: shape (n, 6), world space; copied.

    >>> len(CasterSet([[0, 0, 0, 1, 1, 1.0]]))
    1
    """

    def __init__(self, boxes: ArrayLike) -> None:
        array, handle = boxes_of(boxes, "boxes"), ctypes.c_void_p()
        call("gnomon_caster_set_create", array.ctypes.data, len(array), ctypes.byref(handle))
        super().__init__(handle.value, lib.gnomon_caster_set_destroy)
        self._count = len(array)

    def __len__(self) -> int:
        return self._count

    def refit(self, boxes: ArrayLike) -> None:
        """New bounds for all boxes, shape (n, 6), in their first order."""
        array = boxes_of(boxes, "boxes")
        call("gnomon_caster_set_refit", self.place, array.ctypes.data, len(array))


Boxes = Union[ArrayLike, CasterSet, None]


# ------------------------------------------------------------------ results

class _Record:
    """Fields of a struct of C. Arrays are views of its memory; matrices have the shape (4, 4), rows first."""

    def __init__(self, struct: ctypes.Structure, keep: Any = None) -> None:
        self._struct, self._keep = struct, keep

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        value = getattr(self._struct, name)
        if isinstance(value, ctypes.Array) and not isinstance(value, ctypes.Array) or hasattr(value, "_length_"):
            array = np.ctypeslib.as_array(value)
            return array.reshape(4, 4).T if len(array) == 16 else array
        return name_of(self._struct, name, value)

    def __dir__(self) -> Sequence[str]:
        return [name for name, *_ in self._struct._fields_ if name not in ("size", "reserved")]

    def __repr__(self) -> str:
        return "%s(%s)" % (type(self).__name__, ", ".join("%s=%r" % (name, getattr(self, name)) for name in self._shown))

    _shown: Sequence[str] = ()


class Map(_Record):
    """One shadow map: gnomon_map of the C header, whose comments explain each field.

    clip_from_world: (4, 4) float64. clip_from_camera_relative: (4, 4) float32, for points relative to Plan.origin.
    depth_begin, depth_end: view depths that it serves, world units. width, height: texels. warp, shape: names.
    cull_planes: (n, 4): casters that count lie where dot(xyz, p) + w >= 0 for all. texel_world: (2,) world units.
    m_max: bound of the error, screen pixels per texel.
    """

    _shown = ("cascade", "width", "height", "warp", "depth_begin", "depth_end")

    @property
    def cull_planes(self) -> NDArray[np.float64]:
        return np.ctypeslib.as_array(self._struct.cull_planes).reshape(-1, 4)[:self._struct.cull_plane_count]

    @property
    def select_planes(self) -> NDArray[np.float64]:
        return np.ctypeslib.as_array(self._struct.select_planes).reshape(-1, 4)[:self._struct.select_plane_count]

    @classmethod
    def foreign(cls, clip_from_world: ArrayLike, width: int, height: int, depth_begin: float = 0.0,
                depth_end: float = np.inf) -> "Map":
        """A map of another planner, to be measured. clip_from_world: (4, 4), OpenGL clip space."""
        struct = make("map")
        struct.clip_from_world[:] = _columns(clip_from_world, "map.clip_from_world").ravel()
        set_fields(struct, {"width": width, "height": height, "depth_begin": depth_begin, "depth_end": depth_end})
        return cls(struct)


class Omission(NamedTuple):
    """Something that the scene did not need, or an option that did not hold, in words."""

    what: str
    why: str
    map: int
    saves_texels: int


class Plan(_Record):
    """A plan: status ("ok", "nothing_visible" or "no_caster"), maps, omitted, selection, origin (3,), light_direction (3,)."""

    _shown = ("status", "maps")

    def __init__(self, struct: Any, maps: Any, omissions: Sequence[Omission]) -> None:
        super().__init__(struct, maps)
        self.maps = [Map(maps[i], maps) for i in range(struct.map_count)]
        self.omitted = list(omissions)

    @classmethod
    def foreign(cls, maps: Sequence[Map], selection: str = "view_depth") -> "Plan":
        """A plan of another planner's maps, to be measured. selection: "view_depth", "first_holding" or "finest"."""
        array = (c.map * c.MAX_MAPS)()
        if len(maps) > c.MAX_MAPS:
            raise GnomonError("plan.map_count")
        for i, one in enumerate(maps):
            array[i] = one._struct
        struct = _plan_struct(array)
        struct.status, struct.map_count = c.OK, len(maps)
        struct.selection = find(c.SELECTIONS, selection, "plan.selection")
        return cls(struct, array, [])


class Stats(_Record):
    """The error m over many points, screen pixels per texel: p50, p95, max, mean; share_undersampled, storage, samples,
    outside."""

    _shown = ("p50", "p95", "max", "mean", "samples", "outside")


def _plan_struct(maps: Any) -> Any:
    struct = make("plan")
    struct.maps, struct.map_size, struct.map_room = ctypes.addressof(maps), ctypes.sizeof(c.map), c.MAX_MAPS
    return struct


def _omissions(structs: Any, count: int) -> Iterator[Omission]:
    text = c.text()
    for one in structs[:min(count, len(structs))]:
        lib.gnomon_describe(ctypes.byref(one), ctypes.byref(text))
        yield Omission(text.what.decode(), text.why.decode(), one.map, one.saves_texels)


class _Input:
    """View and scene of C, with the arrays that they point into."""

    def __init__(self, camera: Camera, casters: Boxes, receivers: Boxes, points: Optional[ArrayLike] = None,
                 normals: Optional[ArrayLike] = None) -> None:
        self.camera, self.view, self.scene = camera, make("view"), make("scene")
        self.view.camera = ctypes.addressof(camera)
        self.keep = []
        for name, boxes in (("caster", casters), ("receiver", receivers)):
            if isinstance(boxes, CasterSet):
                setattr(self.scene, name + "_set", boxes.place)
                self.keep.append(boxes)
            elif boxes is not None:
                array = boxes_of(boxes, "scene.%ss" % name)
                setattr(self.scene, name + "s", array.ctypes.data)
                setattr(self.scene, name + "_count", len(array))
                self.keep.append(array)
        for name, values in (("points", points), ("normals", normals)):
            if values is None:
                continue
            array = points_of(values, "view." + name)
            if name == "normals" and len(array) != self.view.point_count:
                raise GnomonError("view.normals", "view.normals: expected as many as points")
            setattr(self.view, name, array.ctypes.data)
            self.view.point_count = len(array)
            self.keep.append(array)


# ------------------------------------------------------------------ plans

def plan(camera: Camera, light: Light, casters: Boxes, receivers: Boxes, *, points: Optional[ArrayLike] = None,
         history: Optional[History] = None, **options: Any) -> Plan:
    """Chooses the shadow maps of one light for one camera.

    casters, receivers: (n, 6) boxes, world space, or a CasterSet. points: (n, 3) visible points, world space; default
    unknown. history: keeps maps steady from frame to frame. options: fields of gnomon_plan_options in the C header, such as
    cascades, resolution_max_size, fit="stable", warp="lispsm" (None: the plan chooses), split_scheme="practical",
    filter_texels, prune=[names]. Raises GnomonError with the name of what is not usable.

    >>> plan(perspective(fov_y=1.0), directional((0, -1, 0)), [[0, 5, -9, 1, 6, -8]], [[-9, -1, -20, 9, 0, -1]], fit="stable").status
    'ok'
    >>> plan(perspective(fov_y=1.0), directional((0, -1, 0)), None, None, cascades=0)
    Traceback (most recent call last):
    gnomon.GnomonError: not usable: plan_options.cascades
    """
    given = _Input(camera, casters, receivers, points)
    maps, omissions = (c.map * c.MAX_MAPS)(), (c.omission * c.MAX_OMISSIONS)()
    struct = _plan_struct(maps)
    struct.omissions, struct.omission_room = ctypes.addressof(omissions), c.MAX_OMISSIONS
    call("gnomon_make_plan", given.view, light, given.scene, set_options(make("plan_options"), options),
         history.place if history is not None else None, struct)
    return Plan(struct, maps, list(_omissions(omissions, struct.omission_count)))


def measure(plan: Plan, camera: Camera, receivers: Boxes, *, points: Optional[ArrayLike] = None, columns: int = 64,
            rows: int = 64, depths: int = 64, map: int = -1) -> Stats:
    """Measures the error of a plan over what the camera sees, also of foreign maps (Plan.foreign).

    receivers: (n, 6) boxes or a CasterSet. points: (n, 3) visible points; without, columns x rows pixels with depths each
    are sampled in the receivers. map: index of the one map that counts; -1: all.
    """
    given = _Input(camera, None, receivers, points)
    options = set_fields(make("measure_options"), {"columns": columns, "rows": rows, "depths": depths, "map": map})
    stats = make("stats")
    call("gnomon_measure", plan._struct, given.view, given.scene, options, stats)
    return Stats(stats)


def select(plan: Plan, points: ArrayLike, view_depths: ArrayLike) -> NDArray[np.int32]:
    """Index of the map that serves each point, or -1: lit. points: (n, 3) world space. view_depths: (n,) world units."""
    array, depths = points_of(points, "points"), np.ascontiguousarray(view_depths, dtype=np.float64)
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


def shader_block(plan: Plan, layer_width: int = 0, layer_height: int = 0, blur_texels: float = 0.0) -> NDArray[np.float32]:
    """The uniform block of shaders/library/shadow_block.glsl (std140), (460,) float32."""
    block = np.empty(c.SHADER_BLOCK_FLOATS, dtype=np.float32)
    call("gnomon_shader_block", plan._struct, int(layer_width), int(layer_height), float(blur_texels), block.ctypes.data)
    return block


# ------------------------------------------------------------------ pages and many lights

class PagePlan(_Record):
    """Levels and resident pages. pages: (n,) records level, column, row, slot, points. table: (m,) uint32. levels: Map."""

    _shown = ("status", "page_count", "level_count", "target_m")

    @property
    def pages(self) -> NDArray[Any]:
        kind = np.dtype([("level", "u4"), ("column", "i4"), ("row", "i4"), ("slot", "u4"), ("points", "u4")])
        return self._lent(self._struct.pages, self._struct.page_count, kind)

    @property
    def table(self) -> NDArray[np.uint32]:
        return self._lent(self._struct.table, self._struct.table_count, np.dtype("u4"))

    def _lent(self, place: Optional[int], count: int, kind: np.dtype) -> NDArray[Any]:
        if not count:
            return np.empty(0, dtype=kind)
        # The memory of the call holds them: the view keeps it.
        offset = place - self._keep.ctypes.data
        return self._keep[offset:offset + count * kind.itemsize].view(kind)

    @property
    def levels(self) -> list[Map]:
        return [self._map("gnomon_page_level", i) for i in range(self._struct.level_count)]

    def page_map(self, page: int) -> Map:
        """The page of this index as a map of its own."""
        return self._map("gnomon_page_map", page)

    def _map(self, what: str, index: int) -> Map:
        struct = make("map")
        call(what, self._struct, int(index), struct)
        return Map(struct)

    def select(self, points: ArrayLike) -> NDArray[np.int32]:
        """Index of the page that serves each point, (n, 3) world space, or -1."""
        array = points_of(points, "points")
        indices = np.empty(len(array), dtype=np.int32)
        call("gnomon_page_select", self._struct, array.ctypes.data, len(array), indices.ctypes.data)
        return indices


def pages(camera: Camera, light: Light, casters: Boxes, receivers: Boxes, *, points: ArrayLike,
          normals: Optional[ArrayLike] = None, policy: str = "resolution", plan_options: Optional[dict[str, Any]] = None,
          **options: Any) -> PagePlan:
    """Chooses the pages of virtual shadow maps that visible points need.

    points: (n, 3) world space; normals: (n, 3) unit. policy: a name of names("page_policies"). plan_options: of the base,
    such as {"fit": "stable"}. options: fields of gnomon_page_options, such as capacity, page_texels, target_m.

    >>> ground = np.stack([np.linspace(-5, 5, 50), np.zeros(50), np.linspace(-30, -5, 50)], axis=1)
    >>> found = pages(perspective(position=(0, 3, 0), fov_y=1.0), directional((0.3, -1, 0)), [[0, 1, -9, 1, 6, -8]],
    ...               [[-40, -1, -90, 40, 0, 0]], points=ground, capacity=256)
    >>> bool(found.page_count == len(found.pages) > 0 and (found.select(ground) >= 0).all())
    True
    """
    given = _Input(camera, casters, receivers, points, normals)
    settings = set_fields(make("page_options"), {"policy": find(c.PAGE_POLICIES, policy, "page_options.policy"), **options})
    base = set_options(make("plan_options"), plan_options or {})
    settings.plan = ctypes.addressof(base)
    size = lib.gnomon_page_memory(settings.capacity, given.view.point_count)
    if size == 0:
        raise GnomonError("page_options.capacity")
    memory = np.empty(size, dtype=np.uint8)
    struct = make("page_plan")
    call("gnomon_plan_pages", given.view, light, given.scene, settings, None, memory.ctypes.data, size, struct)
    return PagePlan(struct, memory)


class LightMaps(_Record):
    """The maps of one light in the pool: texels, map_count, share, m, frames, due, and places (n, 4): x, y, width, height."""

    _shown = ("texels", "map_count", "share", "m", "due")

    @property
    def places(self) -> NDArray[np.int32]:
        return np.array([[r.x, r.y, r.width, r.height] for r in self._struct.place[:self._struct.map_count]], dtype=np.int32).reshape(-1, 4)


class LightPlan(_Record):
    """Maps of many lights in one pool: lights, pool_width, pool_height, texels, error, mapped, due."""

    _shown = ("status", "mapped", "texels", "error")

    def __init__(self, struct: Any, maps: Any) -> None:
        super().__init__(struct, maps)
        self.lights = [LightMaps(maps[i], maps) for i in range(struct.light_count)]


def lights(camera: Camera, lights: Sequence[Light], casters: Boxes, receivers: Boxes, *,
           weights: Optional[Sequence[float]] = None, points: Optional[ArrayLike] = None,
           plan_options: Optional[dict[str, Any]] = None, **options: Any) -> LightPlan:
    """Divides the texels of one pool among lights.

    weights: count the error of a light so many times; default 1. options: fields of gnomon_light_options, such as
    pool_width, pool_height, texel_budget, most_size.

    >>> found = lights(perspective(position=(0, 3, 0), fov_y=1.0), [point((0, 4, -9), 20), point((3, 4, -20), 20)],
    ...                [[0, 1, -9, 1, 3, -8], [2, 1, -22, 4, 3, -19]], [[-40, -1, -90, 40, 0, 0]])
    >>> found.mapped, found.lights[0].texels > 0
    (2, True)
    """
    given = _Input(camera, casters, receivers, points)
    settings = set_fields(make("light_options"), options)
    base = set_options(make("plan_options"), plan_options or {})
    settings.plan = ctypes.addressof(base)
    count = len(lights)
    if weights is not None and len(weights) != count:
        raise GnomonError("light_request.weight", "weights: expected one for each light")
    requests = (c.light_request * max(count, 1))()
    for i, light in enumerate(lights):
        lib.gnomon_light_request_default(ctypes.byref(requests[i]), ctypes.sizeof(c.light_request))
        requests[i].light = ctypes.addressof(light)
        requests[i].weight = 1.0 if weights is None else weights[i]
    size = lib.gnomon_light_memory(count, given.view.point_count)
    memory = np.empty(max(size, 1), dtype=np.uint8)
    maps = (c.light_maps * max(count, 1))()
    struct = make("light_plan")
    struct.lights, struct.light_size, struct.light_room = ctypes.addressof(maps), ctypes.sizeof(c.light_maps), count
    call("gnomon_plan_lights", given.view, requests, ctypes.sizeof(c.light_request), count, given.scene, settings, None,
         memory.ctypes.data, size, struct)
    return LightPlan(struct, maps)
