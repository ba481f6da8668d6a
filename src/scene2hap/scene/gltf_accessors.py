"""The arrays of a glTF file: accessors, sparse and quantised ones included, and Draco-compressed meshes.

Read here rather than by trimesh (5.2), which ignores sparse values, leaves quantised positions 32767 times too large
and turns Draco data that it cannot decode into zeros, each without an error.

Source: glTF 2.0 specification, section 3.6.2; extensions KHR_mesh_quantization and KHR_draco_mesh_compression.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scene2hap.errors import MissingExtra, SceneFormatError
from scene2hap.scene import limits
from scene2hap.scene.gltf_container import GltfFile, Json, natural

_DTYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_COLUMNS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
DRACO = "KHR_draco_mesh_compression"


def positions(file: GltfFile, number: object, place: str) -> NDArray[np.float64]:
    """Vertex positions (n, 3) float64 of an accessor, in the mesh's own unit."""
    values, row = _values(file, number, place)
    if row.get("type") != "VEC3":
        raise SceneFormatError(f"{place}: positions are {row.get('type')!r}; they must be 'VEC3'.")
    result = values.astype(np.float64)
    if row.get("normalized") is True and values.dtype.kind in "iu":
        largest = np.iinfo(np.dtype(values.dtype.str)).max
        # A signed type has one value below -1, which counts as -1.
        result = np.maximum(result / largest, -1.0)
    return result


def indices(file: GltfFile, number: object, place: str) -> NDArray[np.int64]:
    """Vertex numbers (n,) of an accessor."""
    values, row = _values(file, number, place)
    if row.get("type") != "SCALAR" or values.dtype.kind != "u":
        raise SceneFormatError(f"{place}: indices must be unsigned scalars.")
    return values[:, 0].astype(np.int64)


def draco(file: GltfFile, extension: Json, place: str) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Positions (n, 3) and triangles (m, 3) of a Draco-compressed primitive.

    Raises: MissingExtra: DracoPy is not installed. SceneFormatError: the data is broken.
    """
    try:
        import DracoPy
    except ImportError as cause:
        raise MissingExtra(
            f"{place} is compressed with {DRACO}, and the decoder is not installed. Run: pip install DracoPy"
        ) from cause
    data = _view(file, extension.get("bufferView"), place)[0]
    try:
        decoded = DracoPy.decode(bytes(data))
        points = np.asarray(decoded.points, dtype=np.float64).reshape(-1, 3)
        faces = np.asarray(decoded.faces, dtype=np.int64).reshape(-1, 3)
    # DracoPy raises its own classes, ValueError and plain Exception for broken data.
    except Exception as cause:
        raise SceneFormatError(f"{place}: its Draco data cannot be decoded: {cause}.") from cause
    limits.at_most(f"the triangles of {place}", len(faces), "MAX_TRIANGLES")
    return points, faces


def _values(file: GltfFile, number: object, place: str) -> tuple[NDArray[np.generic], Json]:
    """The stored values (count, columns) of an accessor with its sparse ones filled in, and its row."""
    row = file.row("accessors", number, place)
    place = f"{place}, accessors[{number}]"
    kind = row.get("type")
    if not isinstance(kind, str) or kind not in _COLUMNS:
        raise SceneFormatError(f"{place}.type is {kind!r}; it must be one of {', '.join(_COLUMNS)}.")
    columns = _COLUMNS[kind]
    count = natural(row.get("count"), f"{place}.count", at_least=1)
    limits.at_most(f"{place}.count", count, "MAX_TRIANGLES")
    dtype = _dtype(row, place)
    if "bufferView" in row:
        values = _strided(file, row, count, columns, dtype, place)
    else:
        values = np.zeros((count, columns), dtype)
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
    """Values (count, columns) that `row` (an accessor, or half of a sparse one) places in a buffer view."""
    data, stride = _view(file, row.get("bufferView"), place)
    item = columns * dtype.itemsize
    stride = stride or item
    offset = natural(row.get("byteOffset", 0), f"{place}.byteOffset")
    end = offset + (count - 1) * stride + item
    if stride < item or end > len(data):
        raise SceneFormatError(f"{place} wants bytes {offset} to {end} of a buffer view of {len(data)} bytes.")
    return np.ndarray((count, columns), dtype, data, offset, (stride, dtype.itemsize))


def _view(file: GltfFile, number: object, place: str) -> tuple[memoryview, int]:
    """The bytes of a buffer view, and its stride (0 for tightly packed)."""
    row = file.row("bufferViews", number, place)
    place = f"bufferViews[{number}]"
    file.row("buffers", row.get("buffer"), place)
    data = memoryview(file.buffer(row["buffer"]))
    start = natural(row.get("byteOffset", 0), f"{place}.byteOffset")
    length = natural(row.get("byteLength"), f"{place}.byteLength")
    if start + length > len(data):
        raise SceneFormatError(f"{place} wants bytes {start} to {start + length} of a buffer of {len(data)}.")
    return data[start : start + length], natural(row.get("byteStride", 0), f"{place}.byteStride")
