"""The container of a glTF 2.0 file: chunks of a GLB, the JSON header, and the bytes of its buffers.

The file is untrusted. Every length is compared with the number of bytes present. A buffer outside the file is read only
from inside `assets_root`.

Source: glTF 2.0 specification (Khronos, 2.0.1), sections 3.6 and 4.4.
"""

from __future__ import annotations

import base64
import struct
from pathlib import Path
from typing import Any
from urllib.parse import unquote

from scene2hap.common.arrays import Floats
from scene2hap.common.checks import represented
from scene2hap.common.json_texts import read_json
from scene2hap.errors import SceneError, SceneFormatError
from scene2hap.scene import limits
from scene2hap.scene.files import inside, read_bytes

Json = dict[str, Any]

_GLB_MAGIC = b"glTF"
_JSON_CHUNK = 0x4E4F534A
_BIN_CHUNK = 0x004E4942
_TABLES = ("accessors", "buffers", "bufferViews", "materials", "meshes", "nodes", "scenes", "skins")
# Extensions that do not change geometry, by the start of their names.
_HARMLESS = (
    "KHR_materials_",
    "KHR_texture_",
    "EXT_texture_",
    "KHR_lights_",
    "EXT_lights_",
    "KHR_xmp",
    "MSFT_texture_",
    "KHR_node_selectability",
    "KHR_node_hoverability",
)
_UNDERSTOOD = (
    "KHR_draco_mesh_compression",
    "KHR_mesh_quantization",
    "KHR_node_visibility",
    "KHR_animation_pointer",
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "KHR_meshopt_compression",
)


class GltfFile:
    """The header of a glTF file, whose tables are lists of objects, and its buffers, read at the first use."""

    def __init__(self, path: Path, assets_root: Path) -> None:
        self._path, self._assets_root = path, assets_root
        text, self._binary = _split(path.name, read_bytes(path))
        self.header: Json = _header(text)
        self._buffers: dict[int, bytes] = {}
        self._files: dict[str, bytes] = {}
        self.vectors: dict[int, Floats] = {}
        self.unpacked: dict[object, Any] = {}
        stored = len(text) + len(self._binary or b"")
        self.values: limits.Budget = limits.Budget("the numbers in its accessors", 1_000_000, 2.0, stored=stored)
        self.triangles: limits.Budget = limits.Budget("its triangles", 100_000, 0.5, stored=stored)
        self.packed_triangles: limits.Budget = limits.Budget("its packed triangles", 1_000_000, 1.0, stored=stored)
        self.packed_bytes: limits.Budget = limits.Budget("the bytes of its packed views", 16 << 20, 16.0, stored=stored)
        self.image_bytes: limits.Budget = limits.Budget("the bytes of its images", 16 << 20, 4.0, stored=stored)

    def table(self, name: str) -> list[Json]:
        """Return one of the header's tables; empty if the file has none."""
        rows: list[Json] = self.header[name]
        return rows

    def row(self, name: str, number: object, place: str) -> Json:
        """Return row `number` of a table.

        Raises: SceneFormatError: there is no such row; the message names `place`, which refers to it.
        """
        rows = self.table(name)
        if isinstance(number, bool) or not isinstance(number, int) or not 0 <= number < len(rows):
            raise SceneFormatError(
                f"{place} refers to {name}[{represented(number)}]; the file has {len(rows)} {name} (from 0)."
            )
        return rows[number]

    def buffer(self, number: int) -> bytes:
        """Return the bytes of a buffer.

        Raises: SceneFormatError: it has fewer bytes than the header says. SceneError: its file is missing, too large,
        or outside the assets root.
        """
        if number not in self._buffers:
            place = f"buffers[{number}]"
            row = self.row("buffers", number, "a buffer view")
            promised = natural(row.get("byteLength"), f"{place}.byteLength")
            data = self._buffer_bytes(row.get("uri"), number, place)
            if len(data) < promised:
                raise SceneFormatError(f"{place} has {len(data)} bytes, the header promises {promised}: cut short?")
            self._buffers[number] = data
        return self._buffers[number]

    def _buffer_bytes(self, uri: object, number: int, place: str) -> bytes:
        if uri is None:
            if number != 0 or self._binary is None:
                raise SceneFormatError(f"{place} names no file, and the file has no binary chunk for it.")
            return self._binary
        if not isinstance(uri, str):
            raise SceneFormatError(f"{place}.uri is {uri!r}; it must be a file name or a data: URI.")
        if uri.startswith("data:"):
            return data_uri(uri, place)
        if uri not in self._files:
            data = read_bytes(inside(self._assets_root, self._path.parent, uri, place))
            limits.at_most(
                "the bytes of its buffers", sum(map(len, self._files.values())) + len(data), "MAX_FILE_BYTES"
            )
            self._files[uri] = data
            budgets = (self.values, self.triangles, self.packed_triangles, self.packed_bytes, self.image_bytes)
            for budget in budgets:
                budget.stored += len(data)
        return self._files[uri]


def data_uri(uri: str, place: str) -> bytes:
    """Return the bytes in a data: URI.

    Raises: SceneFormatError: it is not base64.
    """
    _, is_base64, payload = uri.partition(";base64,")
    try:
        if not is_base64:
            raise ValueError("only base64 data is understood")
        return base64.b64decode(unquote(payload), validate=True)
    except ValueError as cause:  # also binascii.Error
        raise SceneFormatError(f"{place}: its data: URI cannot be decoded: {cause}.") from cause


def mapping(value: object) -> Json:
    """Return an object of a header; empty if the value is none."""
    return value if isinstance(value, dict) else {}


def natural(value: object, place: str, *, at_least: int = 0) -> int:
    """Return a whole number from a header.

    Raises: SceneFormatError: the value is no whole number, or less than `at_least`.
    """
    # Some exporters write 12.0 for 12.
    if isinstance(value, float) and value.is_integer():
        value = int(value)
    if isinstance(value, bool) or not isinstance(value, int) or value < at_least:
        raise SceneFormatError(f"{place} is {value!r}; it must be a whole number from {at_least}.")
    return value


def _split(name: str, data: bytes) -> tuple[bytes, bytes | None]:
    """Return the JSON text and, for a GLB, the binary chunk."""
    if data[:4] != _GLB_MAGIC:
        if name.lower().endswith(".glb"):
            raise SceneFormatError(f"{name!r} is no GLB: it starts with {data[:4]!r}, not {_GLB_MAGIC!r}.")
        return data, None
    if len(data) < 20:
        raise SceneFormatError(f"{name!r} is a GLB of {len(data)} bytes: cut short before its first chunk.")
    version, length = struct.unpack_from("<II", data, 4)
    if version != 2:
        raise SceneFormatError(f"{name!r} is GLB version {version}; version 2 is read. Export it as glTF 2.0.")
    if length > len(data):
        raise SceneFormatError(f"{name!r} says it has {length} bytes and has {len(data)}: cut short.")
    data = data[:length]  # some tools pad the file; viewers such as three.js ignore what follows
    chunks: dict[int, bytes] = {}
    at = 12
    while at < len(data):
        size, kind = struct.unpack_from("<II", data, at) if at + 8 <= len(data) else (1 << 32, 0)
        if at + 8 + size > len(data):
            raise SceneFormatError(f"{name!r}: the chunk at byte {at} runs past the end of the file.")
        chunks.setdefault(kind, data[at + 8 : at + 8 + size])
        at += 8 + size
    if _JSON_CHUNK not in chunks:
        raise SceneFormatError(f"{name!r} is a GLB without a JSON chunk.")
    return chunks[_JSON_CHUNK], chunks.get(_BIN_CHUNK)


def _header(text: bytes) -> Json:
    """Parse the header and check it. Tables that geometry needs are added if missing; their rows must be objects."""
    try:
        header = read_json(text.decode("utf-8-sig"))
    except ValueError as cause:
        raise SceneFormatError(f"not glTF: its JSON cannot be read: {cause}.") from cause
    if not isinstance(header, dict):
        raise SceneFormatError(f"not glTF: its JSON is a {type(header).__name__}, not an object.")
    version = mapping(header.get("asset")).get("version")
    if not isinstance(version, str) or version.split(".")[0] != "2":
        raise SceneFormatError(f"asset.version is {version!r}; glTF 2.0 is read. Export the scene as glTF 2.0.")
    for name in _TABLES:
        rows = header.setdefault(name, [])
        if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
            raise SceneFormatError(f"{name} must be a list of objects.")
    # A scene can be read without its pictures, so these tables are not checked.
    for name in ("textures", "images"):
        rows = header.get(name)
        header[name] = [mapping(row) for row in rows] if isinstance(rows, list) else []
    limits.at_most("the number of nodes", len(header["nodes"]), "MAX_NODES")
    required = header.get("extensionsRequired", [])
    if not isinstance(required, list):
        raise SceneFormatError("extensionsRequired must be a list of names.")
    unknown = sorted({str(name) for name in required if not str(name).startswith((*_HARMLESS, *_UNDERSTOOD))})
    if unknown:
        raise SceneError(
            f"the file requires {', '.join(unknown)}, which scene2hap cannot read. Export it without, for example "
            "with `gltf-transform copy` or uncompressed from the modelling tool."
        )
    return header
