"""Buffer views of glTF that are compressed with meshopt, as gltfpack and other tools write them.

Source: glTF extensions EXT_meshopt_compression and KHR_meshopt_compression.
"""

from __future__ import annotations

import numpy as np

from scene2hap.errors import SceneFormatError
from scene2hap.scene import limits
from scene2hap.scene.formats.gltf import meshopt_codec, meshopt_filters
from scene2hap.scene.formats.gltf.container import GltfFile, Json, mapping, natural

MESHOPT = ("KHR_meshopt_compression", "EXT_meshopt_compression")
_INDEX_BYTES = (2, 4)
# In the budgets of accessors, this many decoded bytes count as one stored byte (assumed).
_STORED_PER_DECODED = 2


def meshopt_row(view: Json) -> tuple[str, Json] | None:
    """Return the name of a buffer view's compression extension and its row; None if the view is not compressed."""
    extensions = mapping(view.get("extensions"))
    return next(((name, row) for name in MESHOPT if isinstance(row := extensions.get(name), dict)), None)


def decoded_view(file: GltfFile, number: int, row: Json, place: str) -> memoryview:
    """Return the bytes of buffer view `number`, described by the extension `row`. Each view is decoded once.

    Raises: SceneFormatError: the data is broken. SceneError: it would unpack to too many bytes.
    """
    key = (MESHOPT, number)
    if key not in file.unpacked:
        data = file.unpacked[key] = _decoded(file, row, place)
        # Budgets of accessors depend on the stored bytes. The decoded view counts as stored, since its own budget
        # bounds it.
        for budget in (file.values, file.triangles):
            budget.stored += len(data) // _STORED_PER_DECODED
    known: memoryview = file.unpacked[key]
    return known


def _decoded(file: GltfFile, row: Json, place: str) -> memoryview:
    file.row("buffers", row.get("buffer"), place)
    buffer = file.buffer(row["buffer"])
    start = natural(row.get("byteOffset", 0), f"{place}.byteOffset")
    length = natural(row.get("byteLength"), f"{place}.byteLength")
    if start + length > len(buffer):
        raise SceneFormatError(f"{place} wants bytes {start} to {start + length} of a buffer of {len(buffer)}.")
    stride = natural(row.get("byteStride"), f"{place}.byteStride", at_least=1)
    count = natural(row.get("count"), f"{place}.count", at_least=1)
    limits.at_most(f"{place}.count", count, "MAX_TRIANGLES")
    mode, filter_name = row.get("mode"), row.get("filter", "NONE")
    file.packed_bytes.spend(count * stride, place)
    data = buffer[start : start + length]
    try:
        if mode == "ATTRIBUTES":
            elements = meshopt_codec.attributes(data, count, stride)
            if filter_name != "NONE":
                elements = meshopt_filters.filtered(elements, str(filter_name))
            return memoryview(elements.tobytes())
        if mode not in ("TRIANGLES", "INDICES"):
            raise ValueError(f"mode {mode!r}; it must be ATTRIBUTES, TRIANGLES or INDICES")
        if stride not in _INDEX_BYTES:
            raise ValueError(f"indices of {stride} bytes; they must have 2 or 4")
        if filter_name != "NONE":
            raise ValueError(f"filter {filter_name!r} of {mode}; only ATTRIBUTES have filters")
        decode = meshopt_codec.triangles if mode == "TRIANGLES" else meshopt_codec.indices
        numbers = decode(data, count)
        if numbers.max() >= 1 << 8 * stride:
            raise ValueError(f"index {numbers.max()} in {stride} bytes")
    except ValueError as cause:
        raise SceneFormatError(f"{place}: its meshopt data cannot be decoded: {cause}.") from cause
    return memoryview(numbers.astype(np.dtype(f"<u{stride}")).tobytes())
