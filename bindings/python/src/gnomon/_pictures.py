"""How many pixels of a picture will a plan get wrong, before anything is drawn?"""
from __future__ import annotations

import ctypes
from concurrent.futures import ThreadPoolExecutor
from itertools import islice
from typing import Any, Callable, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _layout as c
from ._call import GnomonError, array_of, call, expect, make, whole
from ._pages import PagePlan
from ._records import Camera, Plan


class WrongPixels(NamedTuple):
    """The pixels that a plan will get wrong."""

    wrong: float  #: lit and dark pixels that are taken for each other; no whole number
    counted: float  #: pixels that have a surface, and are lit or dark
    share: float  #: wrong over counted, in 0..1; 0 where none counts


def _picture(camera: Camera, **pixels: ArrayLike | None) -> Any:
    """The struct, which keeps what it points into."""
    camera = expect(camera, Camera, "camera")
    shape = (camera.height, camera.width)
    struct = make("shadow_picture")
    struct.kept = [camera]
    struct.camera, struct.pixel_count = ctypes.addressof(camera), camera.height * camera.width
    for name, values in pixels.items():
        if values is None:
            continue
        array = array_of(values, "shadow_picture." + name, np.float32)
        expected = (*shape, 3) if name == "normals" else shape
        if array.shape != expected:
            raise GnomonError("shadow_picture." + name, "shadow_picture.%s: expected the shape of the camera's picture, %r"
                              % (name, expected))
        setattr(struct, name, array.ctypes.data)
        struct.kept.append(array)
    return struct


_SEARCH_FIELD = "shadow_picture.occluder_search"
_Point = ctypes.c_char * 24  # Three doubles; ctypes.string_at takes twice as long.


def _distances(occluders: Callable[[NDArray[np.float64]], ArrayLike], points: NDArray[np.float64]) -> list[float]:
    """One for each point, or a refusal."""
    count, result = len(points), occluders(points)
    try:
        distances = np.asarray(result, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise GnomonError(_SEARCH_FIELD, "%s: expected distances: %s" % (_SEARCH_FIELD, error)) from error
    if distances.shape != (count,):
        raise GnomonError(_SEARCH_FIELD, "%s: expected the shape %r, not %r" % (_SEARCH_FIELD, (count,), distances.shape))
    return list(distances.tolist())


def _call_searching(struct: Any, occluders: Callable[[NDArray[np.float64]], ArrayLike], run: Callable[[], int]) -> None:
    """Runs a call of C until its search has found every point in a table. C names points one by one: those that the table lacks
    go to occluders together. The last run reads nothing but their distances."""
    table: dict[bytes, float] = {}
    failed: list[BaseException] = []
    distance = -np.inf

    def look_up(_scene: int, point: int) -> float:
        nonlocal distance
        try:
            # One that is not known gets that of the point before, its neighbour: what C names next is then seldom wrong.
            distance = table.setdefault(_Point.from_address(point).raw, distance)
        except BaseException as error:
            failed.append(error)
        return distance

    search = c.occluder_search(look_up)
    struct.occluder_search = ctypes.cast(search, ctypes.c_void_p).value
    struct.kept.append(search)
    # Handlers of signals run in the main thread: what they raise must not be lost in C. This function may end before the thread.
    with ThreadPoolExecutor(1) as thread:
        while True:
            known = len(table)
            thread.submit(run).result()
            if failed:
                raise failed[0]
            missing = list(islice(table, known, None))
            if not missing:
                return
            points = np.frombuffer(bytearray().join(missing), dtype=np.float64).reshape(-1, 3)
            table.update(zip(missing, _distances(occluders, points)))


def expected_error(plan: Plan | PagePlan, camera: Camera, mask: ArrayLike, view_depths: ArrayLike, kernel_texels: float = 0.0,
                   occluder_distances: ArrayLike | None = None,
                   occluders: Callable[[NDArray[np.float64]], ArrayLike] | None = None,
                   normals: ArrayLike | None = None) -> WrongPixels:
    """Counts the pixels that comparisons in the plan's maps or pages will misclassify, without drawing them; also of foreign
    maps (Plan.foreign).

    mask: (height, width) float32 of the camera, first row on top: 1 lit .. 0 in shadow; negative, above 1 or not a number:
    does not count. It is a picture that is known: of rays, of other maps, of the last frame. view_depths: the same of the
    surfaces, world units; 0, less, infinite or not a number: no surface. float32 in C order is read where it lies.
    kernel_texels: half side of the box of texels whose comparisons a filter averages; 0: one texel, hard comparison.

    occluders: finds what casts shadows in the picture's light, by rays. It gets points, (n, 3) float64, world space, and returns
    n distances along the light, world units, each from its point to the occluder nearest the light: negative where that lies
    beyond the point, -inf where there is none. Each pixel is then compared with what lies on the light's ray through the middle
    of its texel. The points come in few batches: one for hard comparison, a few for kernels. Until the call returns, each
    distinct point takes about 200 bytes. Exceptions of occluders reach the caller.
    normals: beside occluders, (height, width, 3) float32, those of the surfaces, unit, towards the viewer; zero there, and None:
    from view_depths.

    Without occluders each pixel takes the shadow that the picture shows at the middle of its texel. occluder_distances: beside
    mask, for dark pixels the distance along the light from the surface to the occluder nearest the light, world units. A bias
    that is longer lights the surface. Negative or not a number: not known there; None: not known, and errors of the bias do not
    count.

    >>> camera = orthographic(position=(0, 10, 0), forward=(0, -1, 0), up=(0, 0, -1), height_world=10, aspect=1, far=20, width=64, height=64)
    >>> mask = np.tile(np.float32([1] * 21 + [0] * 43), (64, 1))
    >>> boxes = [[-9, -1, -9, 9, 0, 9], [-1, 1, -9, 9, 2, 9.0]]
    >>> coarse, fine = (plan(camera, directional((0, -1, 0)), boxes, boxes, cascades=1, resolution_max_size=size) for size in (8, 256))
    >>> depths = np.full((64, 64), 10, dtype=np.float32)
    >>> expected_error(fine, camera, mask, depths).share < expected_error(coarse, camera, mask, depths).share < 0.2
    True
    >>> roof = lambda points: np.where(points[:, 0] > -1, 2 - points[:, 1], -np.inf)
    >>> mask = np.tile(np.float32([1] * 26 + [0] * 38), (64, 1))
    >>> [round(expected_error(one, camera, mask, depths, occluders=roof).wrong) for one in (coarse, fine)]
    [320, 0]
    """
    struct = _picture(camera, mask=mask, view_depths=view_depths, occluder_distances=occluder_distances, normals=normals)
    struct.kernel_texels = float(kernel_texels)
    pixels = c.wrong_pixels()

    def run() -> int:
        if isinstance(plan, PagePlan):
            return call("gnomon_expected_page_error", plan._struct, struct, pixels)
        return call("gnomon_expected_error", expect(plan, Plan, "plan")._struct, struct, pixels)

    if occluders is None:
        run()
    elif callable(occluders):
        _call_searching(struct, occluders, run)
    else:
        raise GnomonError(_SEARCH_FIELD, "%s: expected a function of points" % _SEARCH_FIELD)
    return WrongPixels(pixels.wrong, pixels.counted, pixels.share)


def shadow_edge_points(camera: Camera, mask: ArrayLike, view_depths: ArrayLike, room: int = 4096) -> NDArray[np.float64]:
    """Points of the surfaces along the shadow's edges, (n, 3) world space: at most room, evenly over the picture. A plan for
    them (points=) has its texels where they show. mask, view_depths: as of expected_error()."""
    struct = _picture(camera, mask=mask, view_depths=view_depths)
    if not 0 <= whole(room, "room") < 2**31:
        raise GnomonError("room", "room: expected 0..2^31 - 1")
    points, written = np.empty((int(room), 3)), ctypes.c_int64()
    call("gnomon_shadow_edge_points", struct, points.ctypes.data, len(points), ctypes.byref(written))
    return points[:written.value]
