"""Values that are not numbers or are out of range: scalars, and arrays of a shape."""

# ruff: noqa: E501  # tables of cases

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np


class Raising:
    """An object whose conversion to a number or array raises."""

    def __float__(self) -> float:
        raise RuntimeError("no number")

    __int__ = __index__ = __len__ = __iter__ = __float__  # they never return

    def __array__(self, *_: object, **__: object) -> Any:
        raise RuntimeError("no array")


class Sub(float):
    """A float whose conversion raises."""

    def __float__(self) -> float:
        raise ZeroDivisionError("no number")


SCALARS: dict[str, Any] = {
    "nan": float("nan"), "inf": float("inf"), "-inf": float("-inf"), "-0.0": -0.0, "0": 0, "-1": -1, "1e308": 1e308,
    "-1e308": -1e308, "1e200": 1e200, "1e-320": 1e-320, "1e12": 1e12, "1e9": 1e9, "10**400": 10**400, "10**5000": 10**5000,
    "-(10**400)": -(10**400), "True": True, "'1'": "1", "'x'": "x", "''": "", "surrogate": "\ud800", "nul": "\0",
    "None": None, "bytes": b"1", "list": [], "dict": {}, "nested": [[1.0]], "object": object(), "type": float,
    "float16": np.float16(6e4), "float32nan": np.float32("nan"), "longdouble": np.longdouble("1e4000"),
    "int8": np.int8(-1), "uint64": np.uint64(2**64 - 1), "bool_": np.bool_(True), "complex": 1 + 1j,
    "complex128": np.complex128(1 + 1j), "datetime64": np.datetime64("NaT"), "masked": np.ma.masked,
    "str_": np.str_("1"), "0-d": np.array(0.5), "0-d nan": np.array(np.nan), "0-d object": np.array(None),
    "void": np.void(b"abc"), "decimal": Decimal("1"), "Decimal sNaN": Decimal("sNaN"), "Decimal huge": Decimal("1e9999"),
    "fraction": Fraction(1, 3), "Fraction huge": Fraction(10**400, 1), "raising": Raising(), "sub": Sub(1.0),
    "lambda": lambda: 1, "generator": (x for x in list[float]()), "set": {1}, "slice": slice(None),
    "Ellipsis": ..., "NotImplemented": NotImplemented, "exception": ValueError("x"),
}  # fmt: skip


def arrays(rows: int, columns: int) -> dict[str, Any]:
    """Values that are almost an array of floats of the shape (rows, columns)."""
    whole = np.linspace(0.0, 1.0, rows * columns).reshape(rows, columns)
    read_only = whole.copy()
    read_only.setflags(write=False)
    structured = np.zeros(rows, [("x", float), ("y", float), ("z", float)])
    return {
        "fortran": np.asfortranarray(whole), "read only": read_only, "strided": np.repeat(whole, 2, 0)[::2],
        "backwards": whole[::-1], "broadcast": np.broadcast_to(whole[:1], whole.shape), "big endian": whole.astype(">f8"),
        "float16": whole.astype(np.float16), "longdouble": whole.astype(np.longdouble), "int8": whole.astype(np.int8),
        "bool": whole > 0.5, "complex": whole + 1j, "object": whole.astype(object), "text": whole.astype(str),
        "bytes": whole.astype("S9"), "object of None": np.full(whole.shape, None), "object of lists": np.array([[[]]] * 1, object),
        "masked": np.ma.masked_array(whole, whole > 0.5), "all masked": np.ma.masked_array(whole, np.ones(whole.shape, bool)), "matrix": np.matrix(whole),
        "structured": structured, "datetime": whole.astype("M8[s]"), "nan": whole * np.nan, "inf": whole + np.inf,
        "1e308": whole + 1e308, "-1e308": whole - 1e308, "tiny": whole * 1e-320, "empty": whole[:0], "no columns": whole[:, :0],
        "ragged": [[0.0, 1.0, 2.0], [0.0]], "deep": np.zeros((1,) * 30), "flat": whole.ravel(), "transposed": whole.T,
        "list": whole.tolist(), "strings": [["a", "b", "c"]] * rows, "memoryview": whole.data, "raising": Raising(),
        "huge ints": [[10**400] * columns] * rows, "generator": (row for row in whole), "wide": np.zeros((rows, columns + 1)),
    }  # fmt: skip
