"""What does the program gnomon say? The exact shadow of a glTF file, what a filter makes of it, and what is wrong with the maps of
an engine."""
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
    if (eye is None) != (target is None):
        raise GnomonError("target", "eye and target go together")
    command = [_program(program), "view", os.fspath(scene), "--size", "%dx%d" % (width, height), "--light-elevation-deg",
               str(float(light_elevation_deg)), "--light-azimuth-deg", str(float(light_azimuth_deg)), "--cascades",
               str(int(cascades)), "--map-size", str(int(map_size))]
    for name, place in (("eye", eye), ("target", target)):
        if place is not None:
            command += ["--" + name, ",".join(repr(float(v)) for v in numbers_of(place, 3, name))]
    if options is not None:
        command += ["--options", json.dumps(options)]
    exact = _draw(command + ["--view", "truth"], timeout_s)
    return Masks(exact, {name: _draw(command + ["--view", "mask", "--filter", name], timeout_s) for name in filters})


def judge(capture: Union[str, "os.PathLike[str]", dict[str, Any]], scene: Optional[str] = None, *,
          program: Optional[str] = None, timeout_s: float = 600.0) -> dict[str, Any]:
    """What is wrong with the shadow maps of an engine, how much, where, and what would mend it, by the program gnomon.

    capture: a file of the format gnomon-capture/1, or the same as a dictionary: cameras, lights and maps. Arrays of shape
    (4, 4) in it are matrices, rows first. scene: a glTF file or builtin:NAME that it is of, to draw it as well. program,
    timeout_s: as of masks(). Returns what `gnomon judge --json` prints: lights with their m, and findings with kind, what,
    change, size and unit. Raises GnomonError("capture") with the program's line where it refuses the capture or the scene.
    """
    with tempfile.TemporaryDirectory() as folder:
        path = os.fspath(capture) if not isinstance(capture, dict) else os.path.join(folder, "capture.json")
        if isinstance(capture, dict):
            with open(path, "w", encoding="utf-8") as file:
                json.dump(capture, file, default=_plain)
        text = _run([_program(program), "judge", path, *([scene] if scene is not None else []), "--json"], "capture", timeout_s)
        found: dict[str, Any] = json.loads(text)
        return found


def _plain(value: Any) -> Any:
    """Arrays as a capture has them: matrices column by column."""
    if isinstance(value, np.ndarray):
        return value.T.ravel().tolist() if value.shape == (4, 4) else value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    raise GnomonError("capture", "capture: %s is no number, text, list or array" % type(value).__name__)


def _program(program: Optional[str]) -> str:
    found = program or os.environ.get("GNOMON_PROGRAM") or shutil.which("gnomon")
    if not found or not shutil.which(found):
        raise GnomonError("program", "program: there is no program gnomon; build it, and name it in GNOMON_PROGRAM")
    return found


def _run(command: list[str], field: str, timeout_s: float) -> str:
    """What a command prints. Arguments as a list: no shell reads them."""
    run = subprocess.run(command, capture_output=True, text=True, timeout=timeout_s)
    if run.returncode != 0:
        raise GnomonError(field, run.stderr.strip().split("\n")[-1] or "gnomon %s ended with %d" % (command[1], run.returncode))
    return run.stdout


def _draw(command: list[str], timeout_s: float) -> NDArray[np.float32]:
    from PIL import Image

    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "picture.png")
        _run(command + ["--out", path], "scene", timeout_s)
        with Image.open(path) as image:
            colors = np.asarray(image.convert("RGB"), dtype=np.float64)
    along = _LIT - _SHADOW
    mask = ((colors - _SHADOW) @ along / (along @ along)).astype(np.float32)
    mask[(colors == _SKY).all(axis=-1) | (colors == _UNDECIDED).all(axis=-1)] = -1.0
    return np.clip(mask, -1.0, 1.0)
