"""How many pixels of a picture will a plan get wrong, before anything is drawn?"""
from __future__ import annotations

import ctypes
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _layout as c
from ._call import GnomonError, call, expect, make
from ._records import Camera, Plan


class WrongPixels(NamedTuple):
    """The pixels that a plan will get wrong."""

    wrong: float  #: lit and dark pixels that are taken for each other; no whole number
    counted: float  #: pixels that have a surface, and are lit or dark
    share: float  #: wrong over counted, in 0..1; 0 where none counts


def _picture(camera: Camera, **pixels: ArrayLike | None) -> tuple[Any, list[Any]]:
    """The struct, and the arrays that it points into."""
    camera = expect(camera, Camera, "camera")
    shape = (camera.height, camera.width)
    keep: list[Any] = [camera]
    struct = make("shadow_picture")
    struct.camera, struct.pixel_count = ctypes.addressof(camera), camera.height * camera.width
    for name, values in pixels.items():
        if values is None:
            continue
        array = np.ascontiguousarray(values, dtype=np.float32)
        if array.shape != shape:
            raise GnomonError("shadow_picture." + name, "shadow_picture.%s: expected the shape of the camera's picture, %r"
                              % (name, shape))
        setattr(struct, name, array.ctypes.data)
        keep.append(array)
    return struct, keep


def expected_error(plan: Plan, camera: Camera, mask: ArrayLike, view_depths: ArrayLike, kernel_texels: float = 0.0,
                   occluder_distances: ArrayLike | None = None) -> WrongPixels:
    """Counts the pixels that comparisons in the plan's maps will misclassify, without drawing them; also of foreign maps
    (Plan.foreign).

    mask: (height, width) float32 of the camera, first row on top: 1 lit .. 0 in shadow; negative, above 1 or not a number:
    does not count. It is a picture that is known: of rays, of other maps, of the last frame. view_depths: the same of the
    surfaces, world units; 0, less, infinite or not a number: no surface. float32 in C order is read where it lies. Each pixel
    takes the shadow at the middle of its texel. kernel_texels: half side of the box of texels whose comparisons a filter averages;
    0: one texel, hard comparison. occluder_distances: the same, for dark pixels the distance along the light from the surface to the
    occluder nearest the light, world units. A bias that is longer lights the surface. Negative or not a number: not known there;
    None: not known, and errors of the bias do not count.

    >>> camera = orthographic(position=(0, 10, 0), forward=(0, -1, 0), up=(0, 0, -1), height_world=10, aspect=1, far=20, width=64, height=64)
    >>> mask = np.tile(np.float32([1] * 21 + [0] * 43), (64, 1))
    >>> boxes = [[-9, -1, -9, 9, 0, 9], [-1, 1, -9, 9, 2, 9.0]]
    >>> coarse, fine = (plan(camera, directional((0, -1, 0)), boxes, boxes, cascades=1, resolution_max_size=size) for size in (8, 256))
    >>> depths = np.full((64, 64), 10, dtype=np.float32)
    >>> expected_error(fine, camera, mask, depths).share < expected_error(coarse, camera, mask, depths).share < 0.2
    True
    """
    struct, _keep = _picture(camera, mask=mask, view_depths=view_depths, occluder_distances=occluder_distances)
    struct.kernel_texels = float(kernel_texels)
    pixels = c.wrong_pixels()
    call("gnomon_expected_error", plan._struct, struct, pixels)
    return WrongPixels(pixels.wrong, pixels.counted, pixels.share)


def shadow_edge_points(camera: Camera, mask: ArrayLike, view_depths: ArrayLike, room: int = 4096) -> NDArray[np.float64]:
    """Points of the surfaces along the shadow's edges, (n, 3) world space: at most room, evenly over the picture. A plan for
    them (points=) has its texels where they show. mask, view_depths: as of expected_error()."""
    struct, _keep = _picture(camera, mask=mask, view_depths=view_depths)
    if not 0 <= int(room) < 2**31:
        raise GnomonError("room", "room: expected 0..2^31 - 1")
    points, written = np.empty((int(room), 3)), ctypes.c_int64()
    call("gnomon_shadow_edge_points", struct, points.ctypes.data, len(points), ctypes.byref(written))
    return points[:written.value]
