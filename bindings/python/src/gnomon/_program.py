"""What is the exact shadow of a glTF file, and what does a filter make of it? The program gnomon draws both."""
from __future__ import annotations

import json
import os
import shutil
import subprocess
import tempfile
from typing import Any, NamedTuple, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._call import GnomonError, numbers_of

# The colours of gnomon view: no surface, undecided, shadow and light.
_SKY, _UNDECIDED = (214, 224, 234), (160, 60, 160)
_SHADOW, _LIT = np.array((40.0, 42.0, 50.0)), np.array((245.0, 243.0, 236.0))


class Masks(NamedTuple):
    """Shadows of a scene from one place. Masks are (height, width) float32, first row on top: 1 lit .. 0 in shadow."""

    exact: NDArray[np.float32]  #: by rays; -1: no surface, or an edge so near that rounding decides
    filters: dict[str, NDArray[np.float32]]  #: of each filter, in steps of 1/205; -1: no surface


def masks(scene: Union[str, "os.PathLike[str]"], filters: Sequence[str] = (), *, width: int = 640, height: int = 360,
          eye: Optional[ArrayLike] = None, target: Optional[ArrayLike] = None, light_elevation_deg: float = 38.0,
          light_azimuth_deg: float = 140.0, cascades: int = 4, map_size: int = 1024,
          options: Optional[dict[str, Any]] = None, program: Optional[str] = None, timeout_s: float = 600.0) -> Masks:
    """Exact shadows of a glTF file, and masks of filters, by the program gnomon.

    scene: a .gltf or .glb file, or builtin:NAME. filters: such as "hard" or "pcf:radius=2", as `gnomon filters` lists them.
    eye, target: (3,) world space, both or neither: of the scene's own path. light_elevation_deg, light_azimuth_deg: of the
    sun. cascades, map_size: maps along the view, and their texels. options: further ones of the plan, as "options" of a case
    file. program: its path; default GNOMON_PROGRAM of the environment, else the one on PATH. timeout_s: seconds for each
    picture. Needs Pillow. Raises GnomonError("program") where there is none, and GnomonError("scene") with the program's own
    line where it refuses an argument.
    """
    found = program or os.environ.get("GNOMON_PROGRAM") or shutil.which("gnomon")
    if not found or not shutil.which(found):
        raise GnomonError("program", "program: there is no program gnomon; build it, and name it in GNOMON_PROGRAM")
    if (eye is None) != (target is None):
        raise GnomonError("target", "eye and target go together")
    command = [found, "view", os.fspath(scene), "--size", "%dx%d" % (width, height), "--light-elevation-deg",
               str(float(light_elevation_deg)), "--light-azimuth-deg", str(float(light_azimuth_deg)), "--cascades",
               str(int(cascades)), "--map-size", str(int(map_size))]
    for name, place in (("eye", eye), ("target", target)):
        if place is not None:
            command += ["--" + name, ",".join(repr(float(v)) for v in numbers_of(place, 3, name))]
    if options is not None:
        command += ["--options", json.dumps(options)]
    exact = _draw(command + ["--view", "truth"], timeout_s)
    return Masks(exact, {name: _draw(command + ["--view", "mask", "--filter", name], timeout_s) for name in filters})


def _draw(command: list[str], timeout_s: float) -> NDArray[np.float32]:
    from PIL import Image

    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "picture.png")
        # Arguments as a list: no shell reads them.
        run = subprocess.run(command + ["--out", path], capture_output=True, text=True, timeout=timeout_s)
        if run.returncode != 0:
            raise GnomonError("scene", run.stderr.strip().split("\n")[-1] or "gnomon view ended with %d" % run.returncode)
        with Image.open(path) as image:
            colors = np.asarray(image.convert("RGB"), dtype=np.float64)
    along = _LIT - _SHADOW
    mask = ((colors - _SHADOW) @ along / (along @ along)).astype(np.float32)
    mask[(colors == _SKY).all(axis=-1) | (colors == _UNDECIDED).all(axis=-1)] = -1.0
    return np.clip(mask, -1.0, 1.0)
