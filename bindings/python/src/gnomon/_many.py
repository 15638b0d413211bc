"""Where do the texels go when there is more than one light, or more than one map in a texture? Pages, many lights, clusters of
lights, atlases."""
from __future__ import annotations

import ctypes
from typing import Any, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _layout as c
from ._call import GnomonError, call, expect, find, lib, make, points_of, set_fields, set_options
from ._records import Boxes, Camera, Input, Light, Map, Plan, Record, VisibleDepths


class PagePlan(Record):
    """Levels and resident pages. pages: (n,) records level, column, row, slot, points. table: (m,) uint32. levels: Map."""

    _shown = ("status", "page_count", "level_count", "target_m")

    status: str
    page_count: int
    table_count: int
    level_count: int
    policy: str
    page_texels: int
    border_texels: int
    capacity: int
    target_m: float
    points: int
    points_outside: int
    points_coarser: int
    points_capped: int

    @property
    def pages(self) -> NDArray[Any]:
        kind = np.dtype([("level", "u4"), ("column", "i4"), ("row", "i4"), ("slot", "u4"), ("points", "u4")])
        return self._lent(self._struct.pages, self._struct.page_count, kind)

    @property
    def table(self) -> NDArray[np.uint32]:
        return self._lent(self._struct.table, self._struct.table_count, np.dtype("u4"))

    def _lent(self, place: int, count: int, kind: np.dtype) -> NDArray[Any]:
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
    given = Input(camera, casters, receivers, points, normals)
    settings = set_fields(make("page_options"), {"policy": find(c.PAGE_POLICIES, policy, "page_options.policy"), **options})
    base = set_options(make("plan_options"), plan_options or {})
    settings.plan = ctypes.addressof(base)
    size = lib.gnomon_page_memory(settings.capacity, given.view.point_count)
    if size == 0:
        raise GnomonError("page_options.capacity")
    memory = np.empty(size, dtype=np.uint8)
    struct = make("page_plan")
    call("gnomon_plan_pages", given.view, expect(light, Light, "light"), given.scene, settings, None, memory.ctypes.data, size, struct)
    return PagePlan(struct, memory)


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
        call("gnomon_atlas_from_clip", self._struct, self._keep, int(map), matrix.ctypes.data)
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
    call("gnomon_pack_atlas", plan._struct, int(width), int(height), struct)
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
    """Maps of many lights in one pool: lights, pool_width, pool_height, texels, error, mapped, due."""

    _shown = ("status", "mapped", "texels", "error")

    status: str
    pool_width: int
    pool_height: int
    texels: int
    due_texels: int
    error: float
    mapped: int
    due: int

    def __init__(self, struct: Any, maps: Any, clip_space: Any) -> None:
        super().__init__(struct, maps)
        self._clip_space = clip_space
        self.lights = [LightMaps(maps[i], maps) for i in range(struct.light_count)]

    def atlas(self, light: int) -> Atlas:
        """The pool as the atlas of one light's maps."""
        struct = c.atlas()
        call("gnomon_light_atlas", self._struct, int(light), struct)
        return Atlas(struct, self._clip_space)


def lights(camera: Camera, lights: Sequence[Light], casters: Boxes, receivers: Boxes, *,
           weights: Optional[Sequence[float]] = None, points: Optional[ArrayLike] = None,
           depths: Optional[VisibleDepths] = None, plan_options: Optional[dict[str, Any]] = None, **options: Any) -> LightPlan:
    """Divides the texels of one pool among lights.

    weights: count the error of a light so many times; default 1. options: fields of gnomon_light_options, such as
    pool_width, pool_height, texel_budget, most_size.

    >>> found = lights(perspective(position=(0, 3, 0), fov_y=1.0), [point((0, 4, -9), 20), point((3, 4, -20), 20)],
    ...                [[0, 1, -9, 1, 3, -8], [2, 1, -22, 4, 3, -19]], [[-40, -1, -90, 40, 0, 0]])
    >>> found.mapped, found.lights[0].texels > 0, found.atlas(0).count == found.lights[0].map_count
    (2, True, True)
    """
    given = Input(camera, casters, receivers, points, depths=depths)
    settings = set_fields(make("light_options"), options)
    base = set_options(make("plan_options"), plan_options or {})
    settings.plan = ctypes.addressof(base)
    count = len(lights)
    if weights is not None and len(weights) != count:
        raise GnomonError("light_request.weight", "weights: expected one for each light")
    requests = (c.light_request * max(count, 1))()
    for i, light in enumerate(lights):
        lib.gnomon_light_request_default(ctypes.byref(requests[i]), ctypes.sizeof(c.light_request))
        requests[i].light = ctypes.addressof(expect(light, Light, "lights"))
        requests[i].weight = 1.0 if weights is None else weights[i]
    size = lib.gnomon_light_memory(count, given.view.point_count)
    memory = np.empty(max(size, 1), dtype=np.uint8)
    maps = (c.light_maps * max(count, 1))()
    struct = make("light_plan")
    struct.lights, struct.light_size, struct.light_room = ctypes.addressof(maps), ctypes.sizeof(c.light_maps), count
    call("gnomon_plan_lights", given.view, requests, ctypes.sizeof(c.light_request), count, given.scene, settings, None,
         memory.ctypes.data, size, struct)
    return LightPlan(struct, maps, c.clip_space.from_buffer_copy(base.clip_space))


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
    if not 0 <= int(room) < 2**31:
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
