"""Draco-compressed primitives of glTF.

Read here rather than by trimesh (5.2), which turns data that it cannot decode into zeros without an error.

Source: glTF extension KHR_draco_mesh_compression.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scene2hap.errors import MissingExtra, SceneFormatError
from scene2hap.scene import limits
from scene2hap.scene.gltf_accessors import unpacked, view
from scene2hap.scene.gltf_container import GltfFile, Json

DRACO = "KHR_draco_mesh_compression"


@dataclass(frozen=True, eq=False)
class DracoMesh:
    """A decoded primitive: positions (n, 3) float64, triangles (m, 3) int64, and other attributes by their number."""

    points: NDArray[np.float64]
    faces: NDArray[np.int64]
    _attributes: dict[int, NDArray[Any]]

    def vectors(self, number: object, what: str) -> NDArray[np.float64]:
        """Values (n, columns) of an attribute, whole numbers as parts of the largest.

        Raises: SceneFormatError: there is no attribute of that number; the message names `what` wanted it.
        """
        if not isinstance(number, int) or number not in self._attributes:
            raise SceneFormatError(
                f"{what} are attribute {number!r} of Draco data that has {sorted(self._attributes)}."
            )
        return unpacked(self._attributes[number])


def draco(file: GltfFile, extension: Json, place: str) -> DracoMesh:
    """The primitive that `extension` refers to.

    Raises: MissingExtra: DracoPy is not installed. SceneFormatError: the data is broken.
    """
    try:
        import DracoPy
    except ImportError as cause:
        raise MissingExtra(
            f"{place} is compressed with {DRACO}, and the decoder is not installed. Run: pip install DracoPy"
        ) from cause
    data = view(file, extension.get("bufferView"), place)[0]
    try:
        decoded = DracoPy.decode(bytes(data))
        points = np.asarray(decoded.points, dtype=np.float64).reshape(-1, 3)
        faces = np.asarray(decoded.faces, dtype=np.int64).reshape(-1, 3)
        # Releases before 1.5 tell positions alone.
        attributes = {int(row["unique_id"]): np.asarray(row["data"]) for row in getattr(decoded, "attributes", ())}
    # DracoPy raises its own classes, ValueError and plain Exception for broken data.
    except Exception as cause:
        raise SceneFormatError(f"{place}: its Draco data cannot be decoded: {cause}.") from cause
    limits.at_most(f"the triangles of {place}", len(faces), "MAX_TRIANGLES")
    return DracoMesh(points, faces, attributes)
