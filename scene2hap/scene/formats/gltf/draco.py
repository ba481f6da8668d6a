"""Draco-compressed primitives of glTF.

We do not use trimesh's reader (5.2), which turns data that it cannot decode into zeros without an error.

Source: glTF extension KHR_draco_mesh_compression, whose bitstreams have version 2.2; Draco bitstream specification,
sections 4 (header, metadata) and 5 (connectivity).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Floats, Ints
from scene2hap.errors import MissingExtra, SceneFormatError
from scene2hap.scene.formats.gltf.accessors import unpacked, view
from scene2hap.scene.formats.gltf.container import GltfFile, Json

DRACO = "KHR_draco_mesh_compression"
_VERSION = (2, 2)
_MESH, _EDGEBREAKER, _HAS_METADATA = 1, 1, 0x8000


@dataclass(frozen=True, eq=False)
class DracoMesh:
    """A decoded primitive: positions (n, 3) float64, triangles (m, 3) int64, and other attributes by their number."""

    points: Floats
    faces: Ints
    _attributes: dict[int, NDArray[Any]]

    def vectors(self, number: object, what: str) -> Floats:
        """Return the values (n, columns) of an attribute. Whole numbers are divided by the largest of their type.

        Raises: SceneFormatError: there is no attribute of that number; the message begins with `what`.
        """
        if not isinstance(number, int) or number not in self._attributes:
            raise SceneFormatError(
                f"{what} are attribute {number!r} of Draco data that has {sorted(self._attributes)}."
            )
        return unpacked(self._attributes[number])


def draco(file: GltfFile, extension: Json, place: str) -> DracoMesh:
    """Return the primitive that `extension` refers to. Primitives that share a buffer view share the decoded mesh.

    Raises: MissingExtra: DracoPy is not installed. SceneFormatError: the data is broken. SceneError: it would unpack to
    too many triangles.
    """
    number = extension.get("bufferView")
    file.row("bufferViews", number, place)
    if number not in file.unpacked:
        mesh = file.unpacked[number] = _decoded(file, number, place)
        # The first use was checked against the budget of packed triangles. Only further uses count against `triangles`.
        file.triangles.stored += 2 * len(mesh.faces)
    known: DracoMesh = file.unpacked[number]
    return known


def _decoded(file: GltfFile, number: object, place: str) -> DracoMesh:
    try:
        import DracoPy
    except ImportError as cause:
        raise MissingExtra(
            f"{place} is compressed with {DRACO}, and the decoder is not installed. Run: pip install DracoPy"
        ) from cause
    data = bytes(view(file, number, place)[0])
    try:
        n_faces, n_points = _promised(data)
    except (IndexError, ValueError, RecursionError) as cause:
        raise SceneFormatError(f"{place}: its Draco data cannot be decoded, by its header: {cause}.") from cause
    file.packed_triangles.spend(max(n_faces, n_points), place)
    try:
        decoded = DracoPy.decode(data)
        points = np.asarray(decoded.points, dtype=np.float64).reshape(-1, 3)
        faces = np.asarray(decoded.faces, dtype=np.int64).reshape(-1, 3)
        # Releases before 1.5 have positions only.
        attributes = {int(row["unique_id"]): np.asarray(row["data"]) for row in getattr(decoded, "attributes", ())}
    # For broken data DracoPy raises its own classes, ValueError and plain Exception.
    except Exception as cause:
        raise SceneFormatError(f"{place}: its Draco data cannot be decoded: {cause}.") from cause
    return DracoMesh(points, faces, attributes)


def _promised(data: bytes) -> tuple[int, int]:
    """Return the numbers of triangles and points in the header of Draco data. The decoder allocates them before it
    reads on.

    Raises: ValueError, IndexError: it is no header of a mesh.
    """
    if data[:5] != b"DRACO" or (data[5], data[6]) != _VERSION or data[7] != _MESH:
        raise ValueError("it must be a mesh of bitstream version 2.2")
    at = 11
    if int.from_bytes(data[9:11], "little") & _HAS_METADATA:
        n_of_attributes, at = _number(data, at)
        for _ in range(n_of_attributes):
            at = _behind_metadata(data, _number(data, at)[1])
        at = _behind_metadata(data, at)
    if data[8] == _EDGEBREAKER:
        n_points, at = _number(data, at + 1)
        return _number(data, at)[0], n_points
    n_faces, at = _number(data, at)
    return n_faces, _number(data, at)[0]


def _number(data: bytes, at: int) -> tuple[int, int]:
    """Return a whole number stored with seven bits a byte, the lowest first, and the position after it."""
    value = 0
    for i in range(10):
        value |= (data[at + i] & 0x7F) << (7 * i)
        if data[at + i] < 0x80:
            return value, at + i + 1
    raise ValueError("a number has more than ten bytes")


def _behind_metadata(data: bytes, at: int) -> int:
    """Return the end of the metadata element that begins at a byte: names with values, then names with elements."""
    n_values, at = _number(data, at)
    for _ in range(n_values):
        length, at = _number(data, at + 1 + data[at])
        at += length
    n_elements, at = _number(data, at)
    for _ in range(n_elements):
        at = _behind_metadata(data, at + 1 + data[at])
    return at
