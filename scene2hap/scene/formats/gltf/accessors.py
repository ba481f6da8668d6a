"""The arrays of a glTF file: accessors, sparse and quantised ones included.

We do not use trimesh's reader (5.2). It ignores sparse values and leaves quantised positions 32767 times too large,
both without an error.

Source: glTF 2.0 specification, section 3.6.2; extensions KHR_mesh_quantization, EXT_meshopt_compression.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Floats, Ints
from scene2hap.errors import SceneFormatError
from scene2hap.scene import limits
from scene2hap.scene.formats.gltf.container import GltfFile, Json, natural
from scene2hap.scene.formats.gltf.meshopt import decoded_view, meshopt_row

_DTYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_COLUMNS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}


def vectors(file: GltfFile, number: object, types: tuple[str, ...], what: str) -> Floats:
    """Return values (n, columns) float64 of an accessor of one of these types. Messages call them `what`."""
    row = file.row("accessors", number, what)
    # Primitives share accessors, so each is read once.
    if id(row) not in file.vectors:
        values = _values(file, number, what)[0]
        file.vectors[id(row)] = unpacked(values) if row.get("normalized") is True else _as_float64(values)
    if row.get("type") not in types:
        raise SceneFormatError(f"{what} are {row.get('type')!r}; they must be {' or '.join(map(repr, types))}.")
    return file.vectors[id(row)]


def _as_float64(values: NDArray[np.generic]) -> Floats:
    # A signalling NaN of damaged data warns in the cast; numbers that are not finite are refused later.
    with np.errstate(invalid="ignore"):
        return values.astype(np.float64)


def unpacked(values: NDArray[np.generic]) -> Floats:
    """Divide whole numbers by the largest number of their type. Other numbers are unchanged."""
    result = _as_float64(values)
    if values.dtype.kind not in "iu":
        return result
    # A signed type has one value below -1; glTF reads it as -1.
    return np.maximum(result / np.iinfo(np.dtype(values.dtype.str)).max, -1.0)


def indices(file: GltfFile, number: object, place: str) -> Ints:
    """Return the vertex numbers (n,) of an accessor."""
    values, row = _values(file, number, place)
    if row.get("type") != "SCALAR" or values.dtype.kind != "u":
        raise SceneFormatError(f"{place}: indices must be unsigned scalars.")
    return values[:, 0].astype(np.int64)


def _values(file: GltfFile, number: object, place: str) -> tuple[NDArray[np.generic], Json]:
    """Return the stored values (count, columns) of an accessor with its sparse values filled in, and its row."""
    row = file.row("accessors", number, place)
    place = f"{place}, accessors[{number}]"
    kind = row.get("type")
    if not isinstance(kind, str) or kind not in _COLUMNS:
        raise SceneFormatError(f"{place}.type is {kind!r}; it must be one of {', '.join(_COLUMNS)}.")
    columns = _COLUMNS[kind]
    count = natural(row.get("count"), f"{place}.count", at_least=1)
    # Indices have three rows for each triangle.
    limits.at_most(f"{place}.count / 3", count // 3, "MAX_TRIANGLES")
    dtype = _dtype(row, place)
    # Stored values are a view and need no memory. Zeros are counted against the budget before they are allocated.
    stored = _strided(file, row, count, columns, dtype, place) if "bufferView" in row else None
    file.values.spend(count * columns, place)
    values = np.zeros((count, columns), dtype) if stored is None else stored
    if "sparse" in row:
        values = _with_sparse(file, values, row["sparse"], f"{place}.sparse")
    return values, row


def _with_sparse(file: GltfFile, values: NDArray[np.generic], sparse: object, place: str) -> NDArray[np.generic]:
    where = sparse.get("indices") if isinstance(sparse, dict) else None
    what = sparse.get("values") if isinstance(sparse, dict) else None
    if not isinstance(sparse, dict) or not isinstance(where, dict) or not isinstance(what, dict):
        raise SceneFormatError(f"{place} must be an object with indices and values.")
    count = natural(sparse.get("count"), f"{place}.count", at_least=1)
    limits.at_most(f"{place}.count", count, "MAX_TRIANGLES")
    rows = _strided(file, where, count, 1, _dtype(where, f"{place}.indices"), f"{place}.indices")[:, 0].astype(np.int64)
    if rows.min() < 0 or rows.max() >= len(values):
        raise SceneFormatError(f"{place} replaces value {rows.max()}; there are {len(values)} (from 0).")
    filled = values.copy()
    filled[rows] = _strided(file, what, count, values.shape[1], values.dtype, f"{place}.values")
    return filled


def _dtype(row: Json, place: str) -> np.dtype[np.generic]:
    code = row.get("componentType")
    if not isinstance(code, int) or code not in _DTYPES:
        raise SceneFormatError(f"{place}.componentType is {code!r}; it must be one of {', '.join(map(str, _DTYPES))}.")
    return np.dtype(_DTYPES[code])


def _strided(
    file: GltfFile, row: Json, count: int, columns: int, dtype: np.dtype[np.generic], place: str
) -> NDArray[np.generic]:
    """Return the values (count, columns) of `row` (an accessor, or half of a sparse one) in its buffer view."""
    data, stride = view(file, row.get("bufferView"), place)
    item = columns * dtype.itemsize
    stride = stride or item
    offset = natural(row.get("byteOffset", 0), f"{place}.byteOffset")
    end = offset + (count - 1) * stride + item
    if stride < item or end > len(data):
        raise SceneFormatError(f"{place} wants bytes {offset} to {end} of a buffer view of {len(data)} bytes.")
    return np.ndarray((count, columns), dtype, data, offset, (stride, dtype.itemsize))


def view(file: GltfFile, number: object, place: str) -> tuple[memoryview, int]:
    """Return the bytes of a buffer view, unpacked if it is compressed, and its stride (0 for tightly packed)."""
    row = file.row("bufferViews", number, place)
    place = f"bufferViews[{number}]"
    length = natural(row.get("byteLength"), f"{place}.byteLength")
    if isinstance(number, int) and (compressed := meshopt_row(row)) is not None:
        # The view's own buffer is for readers without a decoder, and may be empty.
        data, start = decoded_view(file, number, compressed[1], f"{place}.extensions.{compressed[0]}"), 0
    else:
        file.row("buffers", row.get("buffer"), place)
        data = memoryview(file.buffer(row["buffer"]))
        start = natural(row.get("byteOffset", 0), f"{place}.byteOffset")
    if start + length > len(data):
        raise SceneFormatError(f"{place} wants bytes {start} to {start + length} of a buffer of {len(data)}.")
    return data[start : start + length], natural(row.get("byteStride", 0), f"{place}.byteStride")
