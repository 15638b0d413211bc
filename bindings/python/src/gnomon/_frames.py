"""What changes from frame to frame? Maps that are kept, jittered grids, suns that turn slowly, and visible depths that are followed."""
from __future__ import annotations

import ctypes
from typing import NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _layout as c
from ._call import GnomonError, Handle, call, expect, lib, make, numbers_of, whole
from ._records import Camera, ClipSpace, Input, Map, Plan, VisibleDepths, clip_space_of


def rebased(map: Map, origin: ArrayLike) -> Map:
    """The map with clip_from_camera_relative for an eye at origin, (3,) world space: of one that was kept from an earlier frame."""
    eye, struct = numbers_of(origin, 3, "origin"), make("map")
    call("gnomon_rebased", expect(map, Map, "map")._struct, eye.ctypes.data, struct)
    return Map(struct)


class Reuse(NamedTuple):
    """How to make a map from that of the last frame. Rectangles are x, y, width and height, texels."""

    kind: str  #: "none": draw the whole map; "identical": every texel holds; "scrolled": kept holds once moved, draw the strips
    shift_x: int  #: texel (x, y) of the old map is (x + shift_x, y + shift_y) of the new one
    shift_y: int  #: see shift_x
    kept: NDArray[np.int32]  #: (4,): the part of the new map whose texels hold
    strips: NDArray[np.int32]  #: (n, 4), n up to 2: parts to draw


_REUSE = ("none", "identical", "scrolled")


def compare(previous: Map, current: Map, clip_space: ClipSpace = None) -> Reuse:
    """Which texels of a map of fit "stable" hold in the next frame. Casters must not have moved, and both frames must have drawn all
    casters over the map (rectangle_planes) with depth clamp. clip_space: of both plans, flags or Plan.clip_space.

    >>> boxes = [[-40, -1, -200, 40, 0, 20], [-4, 0, -30, 4, 6, -26.0]]
    >>> frames = [plan(perspective(position=(0, 3, z), fov_y=1.0, far=250), directional((0.4, -1, 0.3)), boxes, boxes, fit="stable")
    ...           for z in (10, 9.5)]
    >>> found = compare(frames[0].maps[-1], frames[1].maps[-1], frames[1].clip_space)
    >>> found.kind, len(found.strips) > 0
    ('scrolled', True)
    """
    reuse = c.reuse()
    before, now = expect(previous, Map, "previous"), expect(current, Map, "current")
    call("gnomon_compare", before._struct, now._struct, clip_space_of(clip_space), reuse)
    kept, *strips = ([r.x, r.y, r.width, r.height] for r in (reuse.kept, *reuse.strip[:reuse.strip_count]))
    return Reuse(_REUSE[reuse.kind], reuse.shift_x, reuse.shift_y, np.array(kept, dtype=np.int32),
                 np.array(strips, dtype=np.int32).reshape(-1, 4))


def rectangle_planes(map: Map, rectangle: ArrayLike, clip_space: ClipSpace = None) -> NDArray[np.float64]:
    """(5, 4): planes round all that can throw a shadow into a rectangle of a map, for cull_planes(); open towards the light.
    rectangle: x, y, width and height, texels. clip_space: as of compare().

    >>> boxes = [[-40, -1, -200, 40, 0, 20], [-4, 0, -30, 4, 6, -26.0]]
    >>> first = plan(perspective(position=(0, 3, 10), fov_y=1.0, far=250), directional((0.4, -1, 0.3)), boxes, boxes).maps[0]
    >>> cull_planes(rectangle_planes(first, (0, 0, 64, 64)), CasterSet(boxes)).tolist()
    [0]
    """
    texels = numbers_of(rectangle, 4, "rectangle")
    if not (np.abs(texels) < 2**31).all() or (texels != np.floor(texels)).any():
        raise GnomonError("rectangle", "rectangle: expected whole numbers of 32 bits")
    part, planes = c.texel_rect(*(int(one) for one in texels)), np.empty((5, 4))
    call("gnomon_rectangle_planes", expect(map, Map, "map")._struct, part, clip_space_of(clip_space), planes.ctypes.data)
    return planes


def jitter_texels(frame: int) -> NDArray[np.float64]:
    """Offset of the texel grid in a frame, (2,), in (-0.5, 0.5) texels. frame: 0..2^32 - 1. Offsets are a lattice of 64
    points, and any 64 frames in a row hold all of it.

    >>> bool((np.abs([jitter_texels(frame) for frame in range(64)]) < 0.5).all())
    True
    """
    offset = np.empty(2)
    if not 0 <= whole(frame, "frame") < 2**32:
        raise GnomonError("frame", "frame: expected 0..2^32 - 1")
    lib.gnomon_jitter_texels(int(frame), offset.ctypes.data)
    return offset


def jitter(plan: Plan, offset: ArrayLike) -> Plan:
    """The plan with the texel grid of every map moved by offset, (2,) texels across the light, each clamped to half a texel.
    Maps serve the same points and casters. Add 0.5 to filter_texels of the plan, so that no kernel leaves its map.

    >>> camera, boxes = perspective(position=(0, 3, 0), fov_y=1.0), [[-40, -1, -90, 40, 0, 0], [0, 1, -9, 1, 6, -8]]
    >>> still = plan(camera, directional((0.3, -1, 0)), boxes, boxes, filter_texels=1.5)
    >>> moved = jitter(still, jitter_texels(1))
    >>> bool((moved.maps[0].clip_from_world != still.maps[0].clip_from_world).any())
    True
    """
    by = numbers_of(offset, 2, "offset")
    maps, struct = type(plan._keep).from_buffer_copy(plan._keep), c.plan.from_buffer_copy(plan._struct)
    struct.maps = ctypes.addressof(maps)
    call("gnomon_jitter", struct, by.ctypes.data)
    return Plan(struct, maps, plan.omitted)


class HeldSun(NamedTuple):
    """The decision of hold_sun."""

    direction: NDArray[np.float64]  #: (3,): to plan with; the held one, or the sun's own, bit for bit
    error_pixels: float  #: largest error of the points that were read, screen pixels
    turned_pixels: float  #: error of the point that turned it, above the bound; 0: none did
    points_capped: int  #: points that the light grazes more than least_light_sine: not evaluated


def hold_sun(camera: Camera, held: ArrayLike, sun: ArrayLike, casters: ArrayLike, *, points: Optional[ArrayLike],
             normals: Optional[ArrayLike] = None, most_pixels: float = 0.25, least_light_sine: float = 0.05) -> HeldSun:
    """Keeps the direction of a sun that turns until a shadow edge could lie more than most_pixels from its true place.

    held: direction of the last frame, (3,); zeros before the first. sun: of this frame, (3,). casters: (6,), one box round
    all casters. points: (n, 3) visible points, world space; None: the sun is not held. normals: (n, 3) unit, one for each point,
    towards the eye; default halfway between eye and light. most_pixels: >= 0; 0 never holds. least_light_sine: sine of the angle
    between light and surface below which points are not evaluated, 0..1.

    >>> camera, ground = perspective(position=(0, 3, 0), fov_y=1.0), [[0, 0, -z] for z in range(5, 40)]
    >>> first = hold_sun(camera, (0, 0, 0), (0.3, -1, 0), (-40, -1, -90, 40, 6, 0), points=ground)
    >>> next = hold_sun(camera, first.direction, (0.3 + 1e-6, -1, 0), (-40, -1, -90, 40, 6, 0), points=ground)
    >>> bool((next.direction == first.direction).all()), next.error_pixels < 0.25
    (True, True)
    """
    given, result = Input(camera, None, None, points=points, normals=normals), c.held_sun()
    last, now, box = numbers_of(held, 3, "held"), numbers_of(sun, 3, "sun"), numbers_of(casters, 6, "casters")
    call("gnomon_hold_sun", given.view, last.ctypes.data, now.ctypes.data, box.ctypes.data, float(most_pixels),
         float(least_light_sine), result)
    return HeldSun(np.array(result.direction), result.error_pixels, result.turned_pixels, result.points_capped)


class DepthTracker(Handle):
    """Visible depths that are followed from frame to frame: those that come into view count at once, those that leave it are
    given up slowly. Keep one per camera; clear() it at a cut.

    frames_per_bin: frames that the nearest and the farthest depth take to move inwards by one bin, 1..65535. hold_frames:
    frames for which a depth between them that shows nothing any more still counts, 1..65535.

    >>> tracker = DepthTracker()
    >>> tracker.update(np.float32([[4, 80], [9, 0]])).max > 80, tracker.update(np.float32([[4, 8], [9, 0]])).max > 80
    (True, True)
    """

    def __init__(self, frames_per_bin: int = 4, hold_frames: int = 30) -> None:
        for name, frames in (("frames_per_bin", frames_per_bin), ("hold_frames", hold_frames)):
            if not 1 <= whole(frames, name) <= 65535:
                self._place = None
                raise GnomonError(name, "%s: expected 1..65535" % name)
        super().__init__(lib.gnomon_depth_tracker_create(int(frames_per_bin), int(hold_frames)),
                         lib.gnomon_depth_tracker_destroy)

    def update(self, frame: Union[ArrayLike, VisibleDepths]) -> VisibleDepths:
        """Takes the visible depths of the next frame, as VisibleDepths or as view depths of its pixels, and returns those to
        plan with. A frame that shows nothing changes nothing."""
        seen = frame if isinstance(frame, VisibleDepths) else VisibleDepths(frame)
        depths = VisibleDepths()
        call("gnomon_depth_tracker_update", self.place, seen._struct, depths._struct)
        return depths

    def clear(self) -> None:
        """Forgets all frames."""
        lib.gnomon_depth_tracker_clear(self.place)
