"""How does a call of C become one of Python? Structs by their defaults, refusals as GnomonError, names as indices."""
from __future__ import annotations

import ctypes
import os
import re
from typing import Any, Callable, Optional

import numpy as np

from . import _layout as c

lib = ctypes.CDLL(os.environ.get("GNOMON_LIBRARY") or os.path.join(os.path.dirname(os.path.abspath(__file__)), "libgnomon.so.0"))

for _name, (_returns, _parameters) in c.calls.items():
    _function = getattr(lib, _name)
    _function.restype = _returns
    _function.argtypes = [kind for _, kind in _parameters]

# Fields whose value is an index into a list, but has a name here.
_LISTS = {"warp": c.WARPS, "warp_shape": c.SHAPES, "shape": c.SHAPES, "fit": c.FITS, "split_scheme": c.SPLITS,
          "split_partition": c.PARTITIONS, "split_selection": c.SELECTIONS, "selection": c.SELECTIONS,
          "warp_objective": c.OBJECTIVES, "policy": c.PAGE_POLICIES, "status": c.STATUSES}
_RANGES = ("automatic", "receivers", "camera")


class GnomonError(ValueError):
    """What a call refuses. field: its name in the C header, such as "camera.far_depth"."""

    def __init__(self, field: str, message: Optional[str] = None) -> None:
        super().__init__(message or "not usable: " + field)
        self.field = field


GnomonError.__module__ = "gnomon"


def call(name: str, *arguments: Any) -> int:
    """Calls a function whose last parameter is the name of what it refuses. Structs go by reference."""
    field = ctypes.c_char_p()
    passed = []
    for one, (parameter, kind) in zip(arguments, c.calls[name][1]):
        if isinstance(one, (ctypes.Structure, ctypes.Array)):
            one = ctypes.byref(one)
        elif kind in (ctypes.c_int32, ctypes.c_int64):
            bits = 8 * ctypes.sizeof(kind)
            if not -(2 ** (bits - 1)) <= one < 2 ** (bits - 1):
                # ctypes would keep its lower bits.
                raise GnomonError(parameter, "%s: expected a whole number of %d bits" % (parameter, bits))
        passed.append(one)
    status = getattr(lib, name)(*passed, ctypes.byref(field))
    if status == c.OUT_OF_MEMORY:
        raise MemoryError(name)
    if status == c.INVALID_INPUT:
        raise GnomonError((field.value or b"?").decode())
    return status


def make(name: str) -> Any:
    """A struct with its defaults."""
    struct = getattr(c, name)()
    getattr(lib, "gnomon_%s_default" % name)(ctypes.byref(struct), ctypes.sizeof(struct))
    return struct


def fields_of(struct: Any) -> dict[str, Any]:
    """Names of a struct's fields, with their types."""
    return {field[0]: field[1] for field in struct._fields_}


def set_fields(struct: Any, fields: dict[str, Any]) -> Any:
    """Sets fields of a struct; refuses what it has none of, and values that do not fit."""
    kinds = fields_of(struct)
    for name, value in fields.items():
        path = "%s.%s" % (type(struct).__name__, name)
        kind = kinds.get(name)
        if kind is None or name in ("size", "reserved") or kind is ctypes.c_void_p:
            raise GnomonError(path, "%s has no field '%s'" % (type(struct).__name__, name))
        if name in _LISTS and (value is None or isinstance(value, str)):
            value = c.DEFAULT if value is None else find(_LISTS[name], value, path)
        elif name == "split_range" and isinstance(value, str):
            if value not in _RANGES:
                raise GnomonError(path, "%s: there is no '%s'" % (path, value))
            value = _RANGES.index(value)
        if hasattr(kind, "_length_"):
            array = np.asarray(value, dtype=np.float64).ravel()
            if len(array) != kind._length_:
                raise GnomonError(path, "%s: expected %d numbers" % (path, kind._length_))
            getattr(struct, name)[:] = array.tolist()
        elif kind in (ctypes.c_double, ctypes.c_float):
            setattr(struct, name, float(value))
        else:
            # ctypes would keep the lower bits of a number that is too large.
            bits = 8 * ctypes.sizeof(kind)
            whole = int(value)
            if whole != value or not -(2 ** (bits - 1)) <= whole < 2 ** (bits - 1):
                raise GnomonError(path, "%s: expected a whole number of %d bits" % (path, bits))
            setattr(struct, name, whole)
    return struct


def set_options(struct: Any, options: dict[str, Any]) -> Any:
    """The same of plan options: prune takes names, clip_space a dictionary of flags."""
    options = dict(options)
    prune, space = options.pop("prune", None), options.pop("clip_space", None)
    set_fields(struct, options)
    if prune is not None:
        struct.prune = 0
        for rule in prune:
            struct.prune |= 1 << find(c.PRUNE_RULES, rule, "plan_options.prune")
    if space is not None:
        set_fields(struct.clip_space, space)
    return struct


def options_of(struct: Any) -> dict[str, Any]:
    """The reverse: plan options that set_options makes the same struct of."""
    found: dict[str, Any] = {}
    for name, kind in fields_of(struct).items():
        value = getattr(struct, name)
        if name == "prune":
            found[name] = [rule for i, rule in enumerate(strings("prune_rules")) if value >> i & 1]
        elif name == "clip_space":
            found[name] = {flag: bool(getattr(value, flag)) for flag in fields_of(value) if flag != "reserved"}
        elif name == "split_range":
            found[name] = _RANGES[value]
        elif hasattr(kind, "_length_"):
            found[name] = np.ctypeslib.as_array(value).tolist()
        elif name not in ("size", "reserved"):
            found[name] = name_of(struct, name, value)
    return found


def find(which: int, name: str, field: str) -> int:
    """Index of a name in a list."""
    index = lib.gnomon_find(which, name.encode()) if isinstance(name, str) else c.UNKNOWN
    if index == c.UNKNOWN:
        raise GnomonError(field, "%s: there is no '%s'" % (field, name))
    return index


def name_of(struct: Any, field: str, value: Any) -> Any:
    """The name of an index, or the value itself."""
    if field not in _LISTS:
        return value
    name = lib.gnomon_name(_LISTS[field], value)
    return name.decode() if name is not None else None


def strings(what: str) -> dict[str, str]:
    """Names of a list, with one line about each."""
    which = getattr(c, what.upper(), None) if re.fullmatch("warps|shapes|fits|splits|partitions|selections|objectives|prune_rules|page_policies", what) else None
    if which is None:
        raise GnomonError("list", "there is no list '%s'" % what)
    return {lib.gnomon_name(which, i).decode(): lib.gnomon_summary(which, i).decode() for i in range(lib.gnomon_count(which))}


def array_of(values: Any, name: str, kind: Any = None) -> Any:
    """Values as an array: the same memory where they are one of this kind."""
    try:
        return np.ascontiguousarray(values, dtype=kind)
    except (TypeError, ValueError):
        raise GnomonError(name, "%s: expected an array of numbers" % name) from None


def whole(value: Any, name: str) -> int:
    """A whole number: int() would cut a fraction, and read a text."""
    try:
        if int(value) == value:
            return int(value)
    except (TypeError, ValueError, OverflowError):
        pass
    raise GnomonError(name, "%s: expected a whole number" % name)


def _rows(values: Any, each: int, name: str) -> Any:
    array = array_of(values, name, np.float64)
    if array.size == 0:
        return array.reshape(0, each)
    if array.ndim != 2 or array.shape[1] != each:
        raise GnomonError(name, "%s: expected the shape (n, %d)" % (name, each))
    return array


def boxes_of(values: Any, name: str) -> Any:
    """Boxes as an array of shape (n, 6): the same memory where it is one already."""
    return _rows(values, 6, name)


def points_of(values: Any, name: str) -> Any:
    """The same of points, (n, 3)."""
    return _rows(values, 3, name)


def planes_of(values: Any, name: str) -> Any:
    """The same of planes, (n, 4)."""
    return _rows(values, 4, name)


def numbers_of(values: Any, count: int, name: str) -> Any:
    """So many numbers, in an array of their own where they are none."""
    array = array_of(values, name, np.float64)
    if array.shape != (count,):
        raise GnomonError(name, "%s: expected %d numbers" % (name, count))
    return array


def expect(value: Any, kind: Any, name: str) -> Any:
    """A value of this class: C would take any address."""
    if not isinstance(value, kind):
        raise GnomonError(name, "%s: expected a %s, not a %s" % (name, kind.__name__, type(value).__name__))
    return value


class Handle:
    """Owns memory of the library, and frees it with itself."""

    def __init__(self, place: Optional[int], destroy: Callable[[Any], None]) -> None:
        self._place, self._destroy = place, destroy
        if not place:
            raise MemoryError(type(self).__name__)

    @property
    def place(self) -> int:
        """Where it lies."""
        if self._place is None:
            raise GnomonError("closed", "used after close()")
        return self._place

    def close(self) -> None:
        """Frees it at once; it cannot be used any more."""
        if getattr(self, "_place", None):
            self._destroy(self._place)
        self._place = None

    def __del__(self) -> None:
        self.close()
