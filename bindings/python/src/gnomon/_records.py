"""What do calls take and return? Cameras, lights, boxes, maps and plans: structs of C as small typed classes over their memory."""
from __future__ import annotations

import ctypes
from typing import Any, Iterable, Iterator, NamedTuple, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _layout as c
from ._call import (GnomonError, Handle, array_of, boxes_of, call, expect, fields_of, find, lib, make, name_of, numbers_of,
                    points_of, set_fields, whole)

Camera = c.camera
Light = c.light


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
    call("gnomon_perspective", camera, float(fov_y), float(aspect), float(near), float(far), whole(width, "width"), whole(height, "height"))
    return camera


def orthographic(*, position: ArrayLike = (0, 0, 0), forward: ArrayLike = (0, 0, -1), up: ArrayLike = (0, 1, 0),
                 height_world: float, aspect: float = 16 / 9, near: float = 0.1, far: float = 100.0, width: int = 1920,
                 height: int = 1080) -> Camera:
    """A parallel projection of height_world world units from bottom to top; otherwise as perspective()."""
    camera = make("camera")
    set_fields(camera, {"position": position, "forward": forward, "up": up})
    call("gnomon_orthographic", camera, float(height_world), float(aspect), float(near), float(far), whole(width, "width"), whole(height, "height"))
    return camera


def camera_from(view_from_world: ArrayLike, clip_from_view: ArrayLike, *, width: int, height: int,
                zero_to_one: bool = False, reversed_z: bool = False, y_down: bool = False,
                left_handed: bool = False) -> Camera:
    """The camera of an engine's own matrices, shape (4, 4), which act on column vectors. The flags say which clip space the
    projection is for; default OpenGL's. Raises GnomonError with the reason where there is no such camera."""
    camera, why = make("camera"), ctypes.c_char_p()
    space = c.clip_space(zero_to_one=zero_to_one, reversed_z=reversed_z, y_down=y_down, left_handed=left_handed)
    view, clip = (columns_of(m, name) for m, name in ((view_from_world, "view_from_world"), (clip_from_view, "clip_from_view")))
    try:
        call("gnomon_camera_from", view.ctypes.data, clip.ctypes.data, space, whole(width, "width"), whole(height, "height"), camera, ctypes.byref(why))
    except GnomonError as error:
        raise GnomonError(error.field, why.value.decode() if why.value else None) from None
    return camera


def columns_of(matrix: ArrayLike, name: str) -> NDArray[np.float64]:
    """A matrix column by column, as C takes it."""
    array = array_of(matrix, name, np.float64)
    if array.shape != (4, 4):
        raise GnomonError(name, "%s: expected the shape (4, 4)" % name)
    return np.ascontiguousarray(array.T)


ClipSpace = Union[dict[str, bool], c.clip_space, None]


def clip_space_of(flags: ClipSpace) -> Any:
    """A clip space of its flags; None: OpenGL. That of a plan is one already."""
    return flags if isinstance(flags, c.clip_space) else set_fields(c.clip_space(), expect(flags or {}, dict, "clip_space"))


def texture_from_clip(clip_space: ClipSpace = None) -> NDArray[np.float64]:
    """(4, 4): from a map's clip space to its texture. x and y are 0..1 from the first texel of the first row on, z is the depth in
    0..1. clip_space: flags such as {"zero_to_one": True}, or clip_space of a plan; default OpenGL.

    >>> (texture_from_clip() @ (-1, 1, 0, 1)).tolist(), (texture_from_clip({"first_row_at_y_max": True}) @ (-1, 1, 0, 1)).tolist()
    ([0.0, 1.0, 0.5, 1.0], [0.0, 0.0, 0.5, 1.0])
    """
    matrix = np.empty(16)
    lib.gnomon_texture_from_clip(ctypes.byref(clip_space_of(clip_space)), matrix.ctypes.data)
    return matrix.reshape(4, 4).T


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

class Event(NamedTuple):
    """A discontinuity of one map from the last frame to this one."""

    kind: str  #: "map_appeared", "map_refitted" or "density_jump": texels per area of some point changed by more than 5 %
    map: int  #: Map.cascade
    density_ratio: float  #: texels per area of now over before, where it is farthest from 1


_EVENTS = ("map_appeared", "map_refitted", "density_jump")


class History(Handle):
    """State that plans carry from frame to frame. Keep one per camera and light; clear() it at a cut.

    >>> history, boxes = History(), [[-40, -1, -90, 40, 0, 0], [0, 1, -9, 1, 6, -8]]
    >>> result = plan(perspective(position=(0, 3, 0), fov_y=1.0), directional((0.3, -1, 0)), boxes, boxes, cascades=1, history=history)
    >>> [event.kind for event in history.events]
    ['map_appeared']
    """

    def __init__(self) -> None:
        super().__init__(lib.gnomon_history_create(), lib.gnomon_history_destroy)

    def clear(self) -> None:
        """Forgets all frames."""
        lib.gnomon_history_clear(self.place)

    def copy(self) -> "History":
        """A second one that is equal, to try a frame twice."""
        place, copy = self.place, History()
        lib.gnomon_history_copy(place, copy.place)
        return copy

    @property
    def events(self) -> list[Event]:
        """Jumps that the last plan could not avoid."""
        structs = (c.event * c.MAX_MAPS)()
        count = lib.gnomon_history_events(self.place, ctypes.byref(structs), c.MAX_MAPS)
        return [Event(_EVENTS[one.kind], one.map, one.density_ratio) for one in structs[:min(count, c.MAX_MAPS)]]


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

    def update(self, index: int, box: ArrayLike) -> None:
        """New bounds for the box of this index, (6,)."""
        array = numbers_of(box, 6, "box")
        call("gnomon_caster_set_update", self.place, whole(index, "index"), array.ctypes.data)


Boxes = Union[ArrayLike, CasterSet, None]


class VisibleDepths:
    """Visible view depths of a frame: pixels in each bin of the logarithm of depth, and the nearest and farthest depth.

    view_depths: float32, any shape, world units; copied where it is another type. Not counted, as the sky: 0, less,
    infinity, not a number. Plans take it as depths=.

    >>> depths = VisibleDepths(np.float32([4, 8, 0]))
    >>> depths.min, depths.max, int(depths.counts.sum())
    (4.0, 8.0, 2)
    """

    def __init__(self, view_depths: ArrayLike = ()) -> None:
        self._struct = c.visible_depths()
        lib.gnomon_visible_depths_clear(ctypes.byref(self._struct))
        self.add(view_depths)

    def add(self, view_depths: ArrayLike) -> None:
        """Counts the depths of more pixels."""
        array = array_of(view_depths, "view_depths", np.float32)
        call("gnomon_visible_depths_add", self._struct, array.ctypes.data, array.size)

    @property
    def counts(self) -> NDArray[np.uint32]:
        """(352,): eight bins per doubling, from 2^-20 world units on. A view."""
        return np.ctypeslib.as_array(self._struct.count)

    @property
    def min(self) -> float:
        """Nearest visible depth, world units; above max where nothing is visible."""
        return float(self._struct.min)

    @property
    def max(self) -> float:
        """Farthest visible depth, world units."""
        return float(self._struct.max)

    def __bool__(self) -> bool:
        """Whether anything is visible."""
        return self.min <= self.max


# ------------------------------------------------------------------ results

class Record:
    """Fields of a struct of C. Arrays are views of its memory; matrices have the shape (4, 4), rows first."""

    def __init__(self, struct: ctypes.Structure, keep: Any = None) -> None:
        self._struct: Any = struct
        self._keep = keep

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return self._field(name)

    def _field(self, name: str) -> Any:
        value = getattr(self._struct, name)
        if hasattr(value, "_length_"):
            array = np.ctypeslib.as_array(value)
            return array.reshape(4, 4).T if len(array) == 16 else array
        return name_of(self._struct, name, value)

    def _names(self) -> Iterable[str]:
        return [name for name, kind in fields_of(self._struct).items() if name not in ("size", "reserved") and kind is not ctypes.c_void_p]

    def __dir__(self) -> Iterable[str]:
        return [*self._names(), *super().__dir__()]

    def __repr__(self) -> str:
        return "%s(%s)" % (type(self).__name__, ", ".join("%s=%r" % (name, getattr(self, name)) for name in self._shown))

    def to_dict(self) -> dict[str, Any]:
        """All fields as plain numbers, names and nested lists, rows of matrices first: what json.dumps takes."""
        found = {}
        for name in self._names():
            value = getattr(self, name)
            if isinstance(value, np.ndarray):
                value = value.tolist()
            elif isinstance(value, ctypes.Structure):
                value = {field: getattr(value, field) for field in fields_of(value) if field != "reserved"}
            found[name] = value
        return found

    _shown: Sequence[str] = ()


class Map(Record):
    """One shadow map: gnomon_map of the C header, whose comments explain each field.

    clip_from_world: (4, 4) float64. clip_from_camera_relative: (4, 4) float32, for points relative to Plan.origin.
    depth_begin, depth_end: view depths that it serves, world units. width, height: texels. warp, shape: names.
    cull_planes: (n, 4): casters that count lie where dot(xyz, p) + w >= 0 for all. texel_world: (2,) world units.
    m_max: bound of the error, screen pixels per texel.
    """

    _shown = ("cascade", "width", "height", "warp", "depth_begin", "depth_end")

    cascade: int
    clip_from_world: NDArray[np.float64]
    clip_from_camera_relative: NDArray[np.float32]
    depth_begin: float
    depth_end: float
    overlap: float
    light_world: NDArray[np.float64]
    width: int
    height: int
    shape: str
    warp: Optional[str]
    shape_parameters: NDArray[np.float64]
    kappa: float
    texel_world: NDArray[np.float64]
    texel_world_max: NDArray[np.float64]
    depth_range_world: float
    bias_constant: float
    bias_slope: float
    bias_normal_offset: float
    filter_margin_texels: int
    m_s_max: float
    m_t_max: float
    m_max: float
    storage: float

    @property
    def cull_planes(self) -> NDArray[np.float64]:
        return np.ctypeslib.as_array(self._struct.cull_planes).reshape(-1, 4)[:self._struct.cull_plane_count]

    @property
    def select_planes(self) -> NDArray[np.float64]:
        return np.ctypeslib.as_array(self._struct.select_planes).reshape(-1, 4)[:self._struct.select_plane_count]

    @classmethod
    def foreign(cls, clip_from_world: ArrayLike, width: int, height: int, depth_begin: float = 0.0,
                depth_end: float = np.inf) -> "Map":
        """A map of another planner, to be measured. clip_from_world: (4, 4), in the clip space that Plan.foreign gets."""
        struct = make("map")
        struct.clip_from_world[:] = columns_of(clip_from_world, "map.clip_from_world").ravel()
        set_fields(struct, {"width": width, "height": height, "depth_begin": depth_begin, "depth_end": depth_end})
        return cls(struct)


class Omission(NamedTuple):
    """Something that the scene did not need, or an option that did not hold, in words."""

    what: str
    why: str
    map: int
    saves_texels: int


class Plan(Record):
    """A plan: status ("ok", "nothing_visible" or "no_caster"), maps, omitted, selection, origin (3,), light_direction (3,)."""

    _shown = ("status", "maps")

    status: str
    map_count: int
    selection: str
    sizes_vary: int
    origin: NDArray[np.float64]
    light_direction: NDArray[np.float64]
    clip_space: c.clip_space

    def __init__(self, struct: Any, maps: Any, omissions: Sequence[Omission]) -> None:
        super().__init__(struct, maps)
        self.maps: list[Map] = [Map(maps[i], maps) for i in range(struct.map_count)]
        self.omitted: list[Omission] = list(omissions)

    @classmethod
    def foreign(cls, maps: Sequence[Map], selection: str = "view_depth",
                clip_space: ClipSpace = None) -> "Plan":
        """A plan of another planner's maps, to be measured. selection: "view_depth", "first_holding" or "finest".
        clip_space: flags that hold for the matrices, such as {"zero_to_one": True}; default OpenGL."""
        array = (c.map * c.MAX_MAPS)()
        if len(maps) > c.MAX_MAPS:
            raise GnomonError("plan.map_count")
        for i, one in enumerate(maps):
            array[i] = one._struct
        struct = plan_struct(array)
        struct.status, struct.map_count = c.OK, len(maps)
        struct.selection = find(c.SELECTIONS, selection, "plan.selection")
        struct.clip_space = clip_space_of(clip_space)
        return cls(struct, array, [])

    def to_dict(self) -> dict[str, Any]:
        """The plan, its maps and what was omitted as plain numbers, names and lists."""
        return {**super().to_dict(), "maps": [one.to_dict() for one in self.maps],
                "omitted": [one._asdict() for one in self.omitted]}


class Stats(Record):
    """The error m over many points, screen pixels per texel: p50, p95, max, mean; share_undersampled, storage, samples,
    outside."""

    _shown = ("p50", "p95", "max", "mean", "samples", "outside")

    p50: float
    p95: float
    max: float
    mean: float
    share_undersampled: float
    storage: float
    samples: int
    outside: int


class PageStats(Stats):
    """The same of pages, and texels_per_pixel: texels of pages without borders over the pixels of the camera."""

    texels_per_pixel: float

    def __init__(self, struct: Any, texels_per_pixel: float) -> None:
        super().__init__(struct)
        self.texels_per_pixel = texels_per_pixel

    def to_dict(self) -> dict[str, Any]:
        """All fields as plain numbers."""
        return {**super().to_dict(), "texels_per_pixel": self.texels_per_pixel}


def plan_struct(maps: Any) -> Any:
    """A plan of C with room for maps."""
    struct = make("plan")
    struct.maps, struct.map_size, struct.map_room = ctypes.addressof(maps), ctypes.sizeof(c.map), c.MAX_MAPS
    return struct


def omissions_of(structs: Any, count: int) -> Iterator[Omission]:
    """Omissions in words."""
    text = c.text()
    for one in structs[:min(count, len(structs))]:
        lib.gnomon_describe(ctypes.byref(one), ctypes.byref(text))
        yield Omission(text.what.decode(), text.why.decode(), one.map, one.saves_texels)


class Input:
    """View and scene of C, with the arrays that they point into."""

    def __init__(self, camera: Camera, casters: Boxes, receivers: Boxes, *, points: Optional[ArrayLike] = None,
                 normals: Optional[ArrayLike] = None, depths: Optional[VisibleDepths] = None) -> None:
        self.camera, self.view, self.scene = expect(camera, Camera, "camera"), make("view"), make("scene")
        self.view.camera = ctypes.addressof(camera)
        self.keep: list[Any] = [depths]
        if depths is not None:
            self.view.depths = ctypes.addressof(depths._struct)
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
