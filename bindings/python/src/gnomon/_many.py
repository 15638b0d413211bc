"""Where do the texels go when there is more than one light, or more than one map in a texture? Many lights, clusters of lights,
atlases."""
from __future__ import annotations

import ctypes
from typing import Any, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _layout as c
from ._call import GnomonError, Handle, call, expect, lib, make, options_of, set_fields, set_options, whole
from ._records import Boxes, Camera, Input, Light, Plan, Record


def _places(rectangles: Any) -> NDArray[np.int32]:
    return np.array([[r.x, r.y, r.width, r.height] for r in rectangles], dtype=np.int32).reshape(-1, 4)


class Atlas(Record):
    """Where maps lie in one texture; no two share a texel. width, height: texels; 0: there is no map, or they do not fit.
    count: maps placed, all or none. efficiency: texels of the maps over those of the texture, in 0..1."""

    _shown = ("width", "height", "count", "efficiency")

    width: int
    height: int
    count: int
    efficiency: float

    @property
    def place(self) -> NDArray[np.int32]:
        """(count, 4): x, y, width and height of each map, texels."""
        return _places(self._struct.place[:self._struct.count])

    def atlas_from_clip(self, map: int) -> NDArray[np.float64]:
        """(4, 4): from the clip space of a map to its part of the atlas. x and y are 0..1 over the whole texture, z is the
        depth in 0..1. Draw the map with its place as the viewport."""
        matrix = np.empty(16)
        call("gnomon_atlas_from_clip", self._struct, self._keep, whole(map, "map"), matrix.ctypes.data)
        return matrix.reshape(4, 4).T


def pack_atlas(plan: Plan, width: int = 0, height: int = 0) -> Atlas:
    """Places the maps of a plan into a texture of width times height texels; both 0: into the smallest one whose sides are
    powers of two. count of the result is 0 where they do not fit. The same sizes give the same places.

    >>> camera, boxes = perspective(position=(0, 3, 0), fov_y=1.0), [[-40, -1, -90, 40, 0, 0], [0, 1, -9, 1, 6, -8]]
    >>> atlas = pack_atlas(plan(camera, directional((0.3, -1, 0)), boxes, boxes, cascades=2))
    >>> atlas.place.tolist(), atlas.width, atlas.height
    ([[0, 0, 1024, 1024], [1024, 0, 1024, 1024]], 2048, 1024)
    """
    struct = c.atlas()
    call("gnomon_pack_atlas", plan._struct, whole(width, "width"), whole(height, "height"), struct)
    return Atlas(struct, c.clip_space.from_buffer_copy(plan._struct.clip_space))


class LightMaps(Record):
    """The maps of one light in the pool: texels, map_count, share, m, frames, due, and places (n, 4): x, y, width, height."""

    _shown = ("texels", "map_count", "share", "m", "due")

    outcome: int
    texels: int
    map_count: int
    share: float
    m: float
    frames: int
    due: int

    @property
    def places(self) -> NDArray[np.int32]:
        return _places(self._struct.place[:self._struct.map_count])

    place = places  # to_dict() goes by the fields of C


class LightPlan(Record):
    """Maps of many lights in one pool: lights, pool_width, pool_height, texels, error, mapped, due. Plan the maps of each light that is
    due by plan() with plan_options(): for this camera, or for that of camera_round() where frames of the light is above 1."""

    _shown = ("status", "mapped", "texels", "error")

    status: str
    pool_width: int
    pool_height: int
    texels: int
    due_texels: int
    pages: int
    milliseconds: float
    due_milliseconds: float
    error: float
    mapped: int
    due: int
    repacked: int

    def __init__(self, struct: Any, maps: Any, settings: Any, base: Any) -> None:
        super().__init__(struct, maps)
        # The settings point to the base.
        self._settings, self._base = settings, base
        self.lights = [LightMaps(maps[i], maps) for i in range(struct.light_count)]

    def atlas(self, light: int) -> Atlas:
        """The pool as the atlas of one light's maps."""
        struct = c.atlas()
        call("gnomon_light_atlas", self._struct, whole(light, "light"), struct)
        return Atlas(struct, c.clip_space.from_buffer_copy(self._base.clip_space))

    def plan_options(self, light: int) -> dict[str, Any]:
        """Options for the plan of one light, maps of its size: plan(..., **found.plan_options(0))."""
        if not 0 <= light < len(self.lights):
            raise GnomonError("light")
        options = make("plan_options")
        call("gnomon_light_plan_options", self._settings, self.lights[light]._struct, options)
        return options_of(options)


class LightHistory(Handle):
    """State of lights() from frame to frame. Keep one per pool and camera. lights: most lights of a call, 0..4096.

    >>> history, lamps = LightHistory(), [point((0, 4, -60), 5), point((3, 4, -70), 5)]
    >>> for _ in range(2):
    ...     lights(perspective(position=(0, 3, 0), fov_y=1.0), lamps, [[0, 1, -61, 1, 3, -59], [2, 1, -72, 4, 3, -69]],
    ...            [[-40, -1, -90, 40, 0, 0]], history=history).due
    2
    0
    """

    def __init__(self, lights: int = c.MAX_LIGHTS) -> None:
        self._place, self._count = None, whole(lights, "lights")
        if not 0 <= self._count <= c.MAX_LIGHTS:
            raise GnomonError("lights", "lights: expected 0..%d" % c.MAX_LIGHTS)
        super().__init__(lib.gnomon_light_history_create(self._count), lib.gnomon_light_history_destroy)

    def swap(self, a: int, b: int) -> None:
        """Exchanges what is remembered of two lights: where their order changes."""
        lib.gnomon_light_history_swap(self.place, self._index(a, "a"), self._index(b, "b"))

    def forget(self, light: int) -> None:
        """Forgets one light: where another one takes its index."""
        lib.gnomon_light_history_forget(self.place, self._index(light, "light"))

    def _index(self, light: int, name: str) -> int:
        if not 0 <= whole(light, "light") < self._count:
            raise GnomonError(name, "%s: expected an index of a light, 0..%d" % (name, self._count - 1))
        return int(light)


def lights(camera: Camera, lights: Sequence[Light], casters: Boxes, receivers: Boxes, *,
           weights: Optional[Sequence[float]] = None, changed: Optional[Sequence[bool]] = None,
           draws: Optional[Sequence[float]] = None, triangles: Optional[Sequence[float]] = None,
           points: Optional[ArrayLike] = None, history: Optional[LightHistory] = None,
           plan_options: Optional[dict[str, Any]] = None, **options: Any) -> LightPlan:
    """Divides the texels of one pool among lights, and chooses which of them are due in this frame.

    One number for each light: weights count its error so many times, default 1; changed says that its casters moved, or that its
    maps are lost; draws and triangles are those of all its maps, for millisecond_budget. points: (n, 3) visible points, world
    space; default unknown. history: keeps maps where they are, and draws them less often; without, all are due. options: fields of
    gnomon_light_options, such as pool_width, pool_height, texel_budget, most_size. Of plan_options, those of all lights, the sizes
    are not read.

    >>> found = lights(perspective(position=(0, 3, 0), fov_y=1.0), [point((0, 4, -9), 20), point((3, 4, -20), 20)],
    ...                [[0, 1, -9, 1, 3, -8], [2, 1, -22, 4, 3, -19]], [[-40, -1, -90, 40, 0, 0]])
    >>> found.mapped, found.lights[0].texels > 0, found.atlas(0).count == found.lights[0].map_count
    (2, True, True)
    >>> found.plan_options(0)["resolution_max_size"] == found.lights[0].texels
    True
    """
    given = Input(camera, casters, receivers, points=points)
    settings = set_fields(make("light_options"), options)
    base = set_options(make("plan_options"), plan_options or {})
    settings.plan = ctypes.addressof(base)
    count = len(lights)
    requests = (c.light_request * max(count, 1))()
    for i, light in enumerate(lights):
        lib.gnomon_light_request_default(ctypes.byref(requests[i]), ctypes.sizeof(c.light_request))
        requests[i].light = ctypes.addressof(expect(light, Light, "lights"))
    for name, values in (("weight", weights), ("changed", changed), ("draws", draws), ("triangles", triangles)):
        if values is None:
            continue
        if len(values) != count:
            raise GnomonError("light_request." + name, "light_request.%s: expected one for each light" % name)
        for request, value in zip(requests, values):
            set_fields(request, {name: value})
    size = lib.gnomon_light_memory(count, given.view.point_count)
    memory = np.empty(max(size, 1), dtype=np.uint8)
    maps = (c.light_maps * max(count, 1))()
    struct = make("light_plan")
    struct.lights, struct.light_size, struct.light_room = ctypes.addressof(maps), ctypes.sizeof(c.light_maps), count
    try:
        call("gnomon_plan_lights", given.view, requests, ctypes.sizeof(c.light_request), count, given.scene, settings,
             expect(history, LightHistory, "light_history").place if history is not None else None, memory.ctypes.data, size, struct)
    except GnomonError as error:
        if struct.invalid_light < 0:
            raise
        raise GnomonError(error.field, "lights[%d]: not usable: %s" % (struct.invalid_light, error.field)) from None
    return LightPlan(struct, maps, settings, base)


def camera_round(light: Light, camera: Camera) -> Camera:
    """A camera that sees all that a local light can light, for maps that serve several frames: LightMaps.frames above 1. Other
    maps are better for the camera itself. For parallel light, the camera itself.

    >>> camera_round(point((0, 4, -9), 20), perspective(position=(0, 3, 0), fov_y=1.0)).orthographic
    1
    """
    round: Camera = make("camera")
    call("gnomon_camera_round", expect(light, Light, "light"), expect(camera, Camera, "camera"), round)
    return round


class Clusters(Record):
    """Lists of the lights that reach into each cluster of the view: a tile of pixels times a slice of depth.

    columns, rows, slices: clusters along the image's sides and along depth. tile_pixels: side of a tile; larger than
    requested where the lists hold no finer ones. begin: (columns * rows * slices + 1,) uint32. lights: (n,) uint32, indices
    in ascending order. Cluster (column, row, slice) has lights[begin[i]:begin[i + 1]], i = (slice * rows + row) * columns +
    column, with row 0 at the bottom of the image. Suns are in every list.
    """

    _shown = ("columns", "rows", "slices", "tile_pixels", "light_count")

    columns: int
    rows: int
    slices: int
    tile_pixels: int
    orthographic: int
    depth_scale: float
    depth_offset: float
    light_count: int

    def __init__(self, struct: Any, begin: NDArray[np.uint32], lights: NDArray[np.uint32]) -> None:
        super().__init__(struct)
        self.begin = begin[:struct.columns * struct.rows * struct.slices + 1]
        self.lights = lights[:struct.light_count]

    def of(self, column: int, row: int, slice: int) -> NDArray[np.uint32]:
        """Indices of the lights of one cluster. Raises IndexError where there is no such cluster."""
        if not (0 <= column < self.columns and 0 <= row < self.rows and 0 <= slice < self.slices):
            raise IndexError("no cluster (%d, %d, %d)" % (column, row, slice))
        i = (slice * self.rows + row) * self.columns + column
        return self.lights[self.begin[i]:self.begin[i + 1]]

    def slice_of(self, view_depths: ArrayLike) -> NDArray[np.int64]:
        """Slice of each view depth, world units, any shape."""
        depths = np.asarray(view_depths, dtype=np.float64)
        along = depths if self.orthographic else np.log2(np.maximum(depths, np.finfo(np.float64).tiny))
        return np.clip(np.floor(self.depth_scale * along + self.depth_offset), 0, self.slices - 1).astype(np.int64)


def clusters(camera: Camera, lights: Sequence[Light], *, tile_pixels: int = 64, depth_slices: int = 48,
             room: int = 1 << 18) -> Clusters:
    """Lists the lights that can light a surface in each cluster of the view. Shading by the lists gives the same light as
    shading by all, as long as a light is zero beyond its range and cone.

    tile_pixels: side of a tile, pixels, at least 1. depth_slices: parts of the view depth, 1..256. room: most entries of all
    lists together, at least as many as lights; where they would be longer, tiles become larger and slices fewer.

    >>> found = clusters(perspective(position=(0, 3, 0), fov_y=1.0), [point((0, 1, -9), 2), directional((0, -1, 0))])
    >>> found.columns, found.rows, found.slices
    (30, 17, 48)
    >>> found.of(0, 0, 0).tolist(), found.of(15, 5, int(found.slice_of(9.0))).tolist()
    ([1], [0, 1])
    """
    count = len(lights)
    if not 0 <= whole(room, "room") < 2**31:
        raise GnomonError("light_clusters.light_room", "room: expected 0..2^31 - 1")
    array = (c.light * max(count, 1))()
    for i, light in enumerate(lights):
        array[i] = expect(light, Light, "lights")
    struct = set_fields(make("light_clusters"), {"tile_pixels": tile_pixels, "depth_slices": depth_slices})
    total = lib.gnomon_cluster_count(ctypes.byref(expect(camera, Camera, "camera")), struct.tile_pixels, struct.depth_slices)
    # Where an argument is out of range, the call below names it.
    begin, lists = np.zeros(max(total, 1) + 1, dtype=np.uint32), np.empty(max(int(room), 1), dtype=np.uint32)
    struct.begin, struct.begin_room = begin.ctypes.data, len(begin)
    struct.lights, struct.light_room = lists.ctypes.data, int(room)
    memory = np.empty(max(lib.gnomon_cluster_memory(count, int(room)), 1), dtype=np.uint8)
    call("gnomon_cluster_lights", camera, array, ctypes.sizeof(c.light), count, memory.ctypes.data, len(memory), struct)
    return Clusters(struct, begin, lists)
