"""Which pages of virtual shadow maps do visible points need, and which of them does a pool still hold?"""
from __future__ import annotations

import ctypes
from typing import Any, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _layout as c
from ._call import GnomonError, array_of, boxes_of, call, expect, find, lib, make, points_of, set_fields, set_options, whole
from ._records import Boxes, Camera, Input, Light, Map, Omission, Record, omissions_of

# Bits of feedback.
SHADOW_EDGE, SHADOW_CHANGED, DEPTH_EDGE = c.SHADOW_EDGE, c.SHADOW_CHANGED, c.DEPTH_EDGE
# Visible points that a call without points samples the receivers with.
_SAMPLES = 16384


class PagePlan(Record):
    """Levels and resident pages. pages: (n,) records level, column, row, slot, points. table: (m,) uint32. levels: Map. omitted:
    Omission."""

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

    def __init__(self, struct: Any, memory: NDArray[np.uint8], omissions: Sequence[Omission]) -> None:
        super().__init__(struct, memory)
        self.omitted: list[Omission] = list(omissions)

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
        call(what, self._struct, whole(index, "page"), struct)
        return Map(struct)

    def select(self, points: ArrayLike) -> NDArray[np.int32]:
        """Index of the page that serves each point, (n, 3) world space, or -1."""
        array = points_of(points, "points")
        indices = np.empty(len(array), dtype=np.int32)
        call("gnomon_page_select", self._struct, array.ctypes.data, len(array), indices.ctypes.data)
        return indices

    def to_dict(self) -> dict[str, Any]:
        """The counts and what was omitted as plain numbers and names."""
        return {**super().to_dict(), "omitted": [one._asdict() for one in self.omitted]}


def pages(camera: Camera, light: Light, casters: Boxes, receivers: Boxes, *, points: Optional[ArrayLike],
          normals: Optional[ArrayLike] = None, policy: str = "resolution", last: Optional[PagePlan] = None,
          feedback: Optional[ArrayLike] = None, plan_options: Optional[dict[str, Any]] = None, **options: Any) -> PagePlan:
    """Chooses the pages of virtual shadow maps that visible points need.

    points: (n, 3) world space; None, or no point: samples of the receivers. normals: (n, 3) unit. policy: a name of
    names("page_policies"). last: the plan of the last frame. feedback: (n,) uint8, what its picture showed at each point: bits SHADOW_EDGE (a shadow edge
    lies at the point or next to it; policies edges, picture), SHADOW_CHANGED (the last refinement changed whether the point is
    lit; queried) and DEPTH_EDGE (view depths jump there; tiled). Both default unknown. plan_options: of the base, such as
    {"fit": "stable"}; without a warp there, none is taken. options: fields of gnomon_page_options, such as capacity, page_texels,
    target_m.

    >>> ground = np.stack([np.linspace(-5, 5, 50), np.zeros(50), np.linspace(-30, -5, 50)], axis=1)
    >>> found = pages(perspective(position=(0, 3, 0), fov_y=1.0), directional((0.3, -1, 0)), [[0, 1, -9, 1, 6, -8]],
    ...               [[-40, -1, -90, 40, 0, 0]], points=ground, capacity=256)
    >>> bool(found.page_count == len(found.pages) > 0 and (found.select(ground) >= 0).all())
    True
    """
    given = Input(camera, casters, receivers, points=points, normals=normals)
    settings = set_fields(make("page_options"), {"policy": find(c.PAGE_POLICIES, policy, "page_options.policy"), **options})
    base = set_options(make("plan_options"), plan_options or {})
    settings.plan = ctypes.addressof(base)
    past = make("page_history")
    if last is not None:
        past.last = ctypes.addressof(expect(last, PagePlan, "page_history.last")._struct)
    if feedback is not None:
        bits = _bytes_of(feedback, "page_history.feedback")
        past.feedback, past.feedback_count = bits.ctypes.data, len(bits)
    size = lib.gnomon_page_memory(settings.capacity, given.view.point_count or _SAMPLES)
    if size == 0:
        raise GnomonError("page_options.capacity")
    memory, omissions = np.empty(size, dtype=np.uint8), (c.omission * c.MAX_OMISSIONS)()
    struct = make("page_plan")
    struct.omissions, struct.omission_room = ctypes.addressof(omissions), c.MAX_OMISSIONS
    call("gnomon_plan_pages", given.view, expect(light, Light, "light"), given.scene, settings, past, memory.ctypes.data, size, struct)
    omitted = list(omissions_of(omissions, struct.omission_count))
    # They end with the call.
    struct.omissions, struct.omission_room = None, 0
    return PagePlan(struct, memory, omitted)


def _bytes_of(values: ArrayLike, name: str) -> NDArray[np.uint8]:
    array = array_of(values, name)
    # numpy would keep the lower bits of a number that is too large.
    fits = array.dtype == np.uint8 or array.dtype.kind in "biuf" and ((array >= 0) & (array < 256) & (array == np.floor(array))).all()
    if array.ndim != 1 or not fits:
        raise GnomonError(name, "%s: expected bytes, one for each point" % name)
    return np.ascontiguousarray(array, dtype=np.uint8)


_KEPT = np.dtype([("slot", "u4"), ("draw", "?"), ("compose", "?"), ("reserved", "u2")])


class PagePool:
    """Slots that keep pages from frame to frame. Pages of fit "stable" keep their place in the world under camera motion.

    slots: of the pool, 1..2^20, at least one for each page.

    >>> ground = np.stack([np.linspace(-5, 5, 50), np.zeros(50), np.linspace(-30, -5, 50)], axis=1)
    >>> found = pages(perspective(position=(0, 3, 0), fov_y=1.0), directional((0.3, -1, 0)), [[0, 1, -9, 1, 6, -8]],
    ...               [[-40, -1, -90, 40, 0, 0]], points=ground, capacity=256, plan_options={"fit": "stable"})
    >>> pool = PagePool(256)
    >>> bool(pool.keep(found)["draw"].all()), bool(pool.keep(found)["draw"].any())
    (True, False)
    """

    def __init__(self, slots: int) -> None:
        size = lib.gnomon_page_table_size(int(slots)) if 1 <= whole(slots, "slots") < 2**31 else 0
        if size == 0:
            raise GnomonError("slots", "slots: expected 1..2^20")
        self._slots, self._table = (c.page_slot * int(slots))(), np.zeros(size, dtype=np.uint32)

    def __len__(self) -> int:
        return len(self._slots)

    def keep(self, plan: PagePlan, moved: ArrayLike = ()) -> NDArray[Any]:
        """Finds the pages of a plan that the pool still holds, and a slot for each of the others.

        moved: (n, 6) boxes of casters that changed since the last call, where they were and where they are. Returns a record for
        each page: slot (of the pool, in place of that of the plan), draw (the page is to be drawn) and compose (only its moving
        casters are, over the static ones)."""
        boxes, given = boxes_of(moved, "moved"), expect(plan, PagePlan, "plan")
        kept = np.zeros(given.page_count, dtype=_KEPT)
        call("gnomon_keep_pages", given._struct, boxes.ctypes.data, len(boxes), self._slots, len(self._slots), self._table.ctypes.data,
             kept.ctypes.data, None)
        return kept[["slot", "draw", "compose"]]

    def clear(self) -> None:
        """Forgets all pages."""
        ctypes.memset(self._slots, 0, ctypes.sizeof(self._slots))
