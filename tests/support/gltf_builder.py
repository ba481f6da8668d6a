"""Build glTF files by hand, so that tests know their content and can damage one place in them."""

from __future__ import annotations

import base64
import copy
import json
import struct
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

Json = dict[str, Any]

CUBE = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
"""The corners of the unit cube."""
_CUBE_SIDES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
CUBE_FACES = np.array([face for a, b, c, d in _CUBE_SIDES for face in ((a, b, c), (a, c, d))])
"""The twelve triangles of the cube, facing outwards."""


class Gltf:
    """A header and its one buffer; tests may change `header` before they write it."""

    def __init__(self) -> None:
        self.header: Json = {
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": []}],
            "nodes": [],
            "meshes": [],
            "accessors": [],
            "bufferViews": [],
            "buffers": [{"byteLength": 0}],
        }
        self.buffer = bytearray()

    def view(self, array: ArrayLike, dtype: str, **fields: Any) -> int:
        """Append values as a buffer view. Returns its number."""
        data = np.asarray(array).astype(dtype).tobytes()
        self.buffer += b"\0" * (-len(self.buffer) % 4)
        row = {"buffer": 0, "byteOffset": len(self.buffer), "byteLength": len(data), **fields}
        self.buffer += data
        self.header["buffers"][0]["byteLength"] = len(self.buffer)
        return self._append("bufferViews", row)

    def accessor(self, array: ArrayLike, dtype: str, kind: str, **fields: Any) -> int:
        """Append values as an accessor. Returns its number."""
        codes = {"i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123, "u4": 5125, "f4": 5126}
        row = {"bufferView": self.view(array, "<" + dtype), "componentType": codes[dtype], "type": kind}
        return self._append("accessors", {**row, "count": len(np.asarray(array)), **fields})

    def mesh(self, *primitives: Json, name: str | None = None) -> int:
        """Append a mesh. Returns its number."""
        return self._append("meshes", {"primitives": list(primitives), **({"name": name} if name else {})})

    def cube(self, **primitive: Any) -> int:
        """Append the unit cube as a mesh. Returns its number."""
        positions = self.accessor(CUBE, "f4", "VEC3")
        indices = self.accessor(CUBE_FACES.reshape(-1), "u2", "SCALAR")
        return self.mesh({"attributes": {"POSITION": positions}, "indices": indices, **primitive})

    def node(
        self,
        name: str | None = None,
        *,
        mesh: int | None = None,
        children: Sequence[int] = (),
        root: bool = False,
        **row: Any,
    ) -> int:
        """Append a node, and list it in the scene if it is a root. Returns its number."""
        if name is not None:
            row["name"] = name
        if mesh is not None:
            row["mesh"] = mesh
        if children:
            row["children"] = list(children)
        number = self._append("nodes", row)
        if root:
            self.header["scenes"][0]["nodes"].append(number)
        return number

    def glb(self) -> bytes:
        """The file as GLB."""
        return glb_bytes(self.header, bytes(self.buffer))

    def write(self, path: Path) -> Path:
        """Write GLB, or .gltf with its buffer in a file beside it, by the suffix. Returns the path."""
        if path.suffix == ".glb":
            path.write_bytes(self.glb())
            return path
        header = copy.deepcopy(self.header)
        header["buffers"][0].setdefault("uri", path.stem + ".bin")
        path.write_text(json.dumps(header), encoding="utf-8")
        path.with_suffix(".bin").write_bytes(bytes(self.buffer))
        return path

    def data_uri(self) -> str:
        """The buffer as a data: URI."""
        return "data:application/octet-stream;base64," + base64.b64encode(self.buffer).decode("ascii")

    def _append(self, table: str, row: Json) -> int:
        self.header[table].append(row)
        return len(self.header[table]) - 1


def glb_bytes(header: Json, binary: bytes) -> bytes:
    """A GLB with this header and this binary chunk."""
    text = json.dumps(header).encode("utf-8")
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    length = 12 + 8 + len(text) + 8 + len(binary)
    return (
        struct.pack("<4sII", b"glTF", 2, length)
        + struct.pack("<I4s", len(text), b"JSON")
        + text
        + struct.pack("<I4s", len(binary), b"BIN\0")
        + binary
    )


def one_cube(name: str | None = "cube", **node: Any) -> Gltf:
    """A scene of one unit cube."""
    gltf = Gltf()
    gltf.node(name, mesh=gltf.cube(), root=True, **node)
    return gltf
