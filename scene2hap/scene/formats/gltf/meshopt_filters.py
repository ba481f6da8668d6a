"""Filters of meshopt attributes: unit vectors, quaternions, numbers and colours in fewer bits.

Source: glTF extensions EXT_meshopt_compression and KHR_meshopt_compression, appendix "Filters".
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Bytes, Floats


def filtered(elements: Bytes, name: str) -> Bytes:
    """Undo a filter of elements (n, stride): OCTAHEDRAL, QUATERNION, EXPONENTIAL or COLOR.

    Raises: ValueError: there is no such filter, or none for elements of this stride.
    """
    if name not in _FILTERS:
        raise ValueError(f"filter {name!r}; it must be NONE, {', '.join(_FILTERS)}")
    undo, strides = _FILTERS[name]
    stride = elements.shape[1]
    if stride not in strides:
        known = " or ".join(map(str, strides))
        raise ValueError(f"filter {name} of elements of {stride} bytes; they must have {known}")
    # Broken values divide by zero and overflow. The code that uses them refuses the results.
    with np.errstate(all="ignore"):
        return np.ascontiguousarray(undo(elements)).view(np.uint8)


def _octahedral(elements: Bytes) -> NDArray[Any]:
    """Return unit vectors from points on an unfolded octahedron; the fourth number is unchanged."""
    dtype = np.dtype("<i1" if elements.shape[1] == 4 else "<i2")
    stored = elements.view(dtype)
    largest = np.iinfo(dtype).max
    xy, one = stored[:, :2].astype(np.float64), stored[:, 2:3]
    xy /= one
    z = 1.0 - np.abs(xy).sum(axis=1, keepdims=True)
    fold = np.maximum(-z, 0.0)
    vectors = np.concatenate((xy - np.where(xy >= 0, fold, -fold), z), axis=1)
    result = stored.copy()
    result[:, :3] = _whole(vectors * (largest / np.linalg.norm(vectors, axis=1, keepdims=True)), dtype)
    return result


def _quaternion(elements: Bytes) -> NDArray[Any]:
    """Return unit quaternions from their three smaller components. The fourth number holds their scale, and the place
    of the largest component."""
    stored = elements.view("<i2").astype(np.int64)
    scale = np.sqrt(0.5) / (stored[:, 3] | 3)
    small = stored[:, :3] * scale[:, None]
    largest = np.sqrt(np.maximum(0.0, 1.0 - (small**2).sum(axis=1)))
    result = np.empty((len(stored), 4), "<i2")
    rows, place = np.arange(len(stored)), stored[:, 3] & 3
    for i in range(3):
        result[rows, (place + 1 + i) & 3] = _whole(small[:, i] * 32767.0, result.dtype)
    result[rows, place] = _whole(largest * 32767.0, result.dtype)
    return result


def _exponential(elements: Bytes) -> NDArray[Any]:
    """Return floating-point numbers from 8 bits of exponent above 24 bits of mantissa."""
    stored = elements.view("<i4")
    mantissa = (stored << 8) >> 8
    values: NDArray[Any] = np.ldexp(mantissa.astype(np.float64), stored >> 24).astype("<f4")
    return values


def _color(elements: Bytes) -> NDArray[Any]:
    """Return RGBA from YCoCg and alpha. The highest bit of alpha shows how many bits all channels have."""
    bits = 2 * elements.shape[1]
    unsigned, signed = elements.view(f"<u{bits // 8}").astype(np.int64), elements.view(f"<i{bits // 8}")
    y, alpha = unsigned[:, 0], unsigned[:, 3]
    co, cg = signed[:, 1].astype(np.int64), signed[:, 2].astype(np.int64)
    # frexp gives the number of bits of a whole number, 0 for 0.
    largest = (1 << np.frexp(alpha)[1].astype(np.int64)) - 1
    kept = alpha & (largest >> 1)
    rgba = np.stack((y + co - cg, y + cg, y - co - cg, kept << 1 | kept & 1), axis=1)
    return _whole(rgba * (((1 << bits) - 1) / largest[:, None]), np.dtype(f"<u{bits // 8}"))


def _whole(values: Floats, dtype: np.dtype[Any]) -> NDArray[Any]:
    """Round numbers to a whole-number type. Numbers that are not finite become 0, others are clipped to the type's
    range."""
    bound = np.iinfo(dtype)
    rounded = np.floor(np.nan_to_num(values, nan=0.0, posinf=0.0, neginf=0.0) + 0.5)
    return np.clip(rounded, bound.min, bound.max).astype(dtype)


_FILTERS = {
    "OCTAHEDRAL": (_octahedral, (4, 8)),
    "QUATERNION": (_quaternion, (8,)),
    "EXPONENTIAL": (_exponential, tuple(range(4, 257, 4))),
    "COLOR": (_color, (4, 8)),
}
