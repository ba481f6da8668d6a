"""Arrays of numbers: their types, and the arrays that users and files give."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from types import NoneType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scene2hap.common import checks
from scene2hap.errors import Scene2HapError

Floats = NDArray[np.float64]
Floats32 = NDArray[np.float32]
Complex = NDArray[np.complex128]
Ints = NDArray[np.int64]
Ints32 = NDArray[np.int32]
Bytes = NDArray[np.uint8]
Indices = NDArray[np.intp]
"""Places in other arrays."""
Bools = NDArray[np.bool_]

_LONGEST_REASON = 200


def floats(name: str, value: object, unit: str, *, error: type[Scene2HapError]) -> Floats:
    """Return `value` as an array of float64, without a copy if it is one. The caller checks shape and values.

    Raises: `error`: not a table of real numbers, or some of them are masked.
    """
    if type(value) is np.ndarray and value.dtype == np.float64:
        return value
    try:
        _require_numbers(value if isinstance(value, list | tuple) else [value])
        found = np.asanyarray(value)
        if found.dtype.kind not in "iufO":
            raise TypeError(f"{found.dtype} is no type of real numbers")
        if isinstance(found, np.ma.MaskedArray) and np.ma.is_masked(found):
            raise TypeError("some of them are masked")
        if found.dtype.kind == "O":
            _require_numbers(found.ravel().tolist())
        with np.errstate(over="ignore"):
            return np.asarray(found, dtype=np.float64)
    except Exception as cause:  # too many digits, or any error from a foreign type
        reason = str(cause)[:_LONGEST_REASON] or type(cause).__name__
        raise error(f"{name} is not a table of numbers{'' if unit == '-' else f' [{unit}]'}: {reason}.") from cause


def _require_numbers(rows: Sequence[Any]) -> None:
    """Raise a TypeError if nested lists are ragged, or hold None or True, which NumPy takes for NaN and 1."""
    for _level in range(_MOST_LEVELS):
        kinds = {*map(type, rows)}
        nested = {kind for kind in kinds if issubclass(kind, list | tuple)}  # also named tuples
        if not nested or nested < kinds:
            break
        if len({*map(len, rows)}) > 1:
            raise TypeError(_RAGGED)
        rows = [*chain.from_iterable(rows)]
    else:
        raise TypeError("its lists are nested too deeply")
    if nested and kinds - nested <= {float, int}:  # NumPy joins lists and arrays
        raise TypeError(_RAGGED)
    for kind in kinds - {float, int}:
        if issubclass(kind, bool | np.bool_ | str | bytes | NoneType | dict):
            raise TypeError(f"it has {checks.described(next(item for item in rows if type(item) is kind))}")


_RAGGED = "its rows are not equally long"
_MOST_LEVELS = 32
"""Most lists within lists; assumed: far more than any table has. A list that holds itself has endlessly many."""
