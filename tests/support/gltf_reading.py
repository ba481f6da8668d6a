"""Reference reader of glTF files, independent of the library's reader, which tests compare with it."""

from __future__ import annotations

import base64
import json
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray


def header_and_buffer(path: Path) -> tuple[dict[str, Any], bytes]:
    """The JSON and the one buffer of a .glb or .gltf."""
    data = path.read_bytes()
    if data[:4] == b"glTF":
        (length,) = struct.unpack_from("<I", data, 12)
        return json.loads(data[20 : 20 + length]), data[20 + length + 8 :]
    header = json.loads(data)
    uri = header["buffers"][0]["uri"]
    if uri.startswith("data:"):
        return header, base64.b64decode(uri.split(",")[1])
    return header, (path.parent / uri).read_bytes()


def values(header: dict[str, Any], buffer: bytes, number: int) -> NDArray[np.float64]:
    """The rows of an accessor."""
    row = header["accessors"][number]
    view = header["bufferViews"][row["bufferView"]]
    width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[row["type"]]
    dtype = np.dtype({5121: "<u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}[row["componentType"]])
    start = view.get("byteOffset", 0) + row.get("byteOffset", 0)
    stride = view.get("byteStride", width * dtype.itemsize)
    rows = [np.frombuffer(buffer, dtype, width, start + i * stride) for i in range(row["count"])]
    return np.array(rows, dtype=np.float64)


def drawn_triangles(path: Path, textured: bool = False) -> Iterator[NDArray[np.float64]]:
    """World corners (m, 3, 3) of each mesh node; transforms are multiplied from each node up to its root.

    `textured`: only meshes with a texture, with the texture coordinates behind each corner: (m, 3, 5).
    """
    header, buffer = header_and_buffer(path)
    nodes = header["nodes"]
    parent = {child: i for i, node in enumerate(nodes) for child in node.get("children", [])}

    def local(node: dict[str, Any]) -> NDArray[np.float64]:
        if "matrix" in node:
            return np.array(node["matrix"], dtype=np.float64).reshape(4, 4, order="F")
        x, y, z, w = node.get("rotation", (0, 0, 0, 1))
        # R = I + 2 w [q] + 2 [q]^2 with [q] the cross-product matrix of (x, y, z).
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        result = np.eye(4)
        result[:3, :3] = (np.eye(3) + 2 * w * cross + 2 * cross @ cross) @ np.diag(node.get("scale", (1, 1, 1)))
        result[:3, 3] = node.get("translation", (0, 0, 0))
        return result

    for i, node in enumerate(nodes):
        if "mesh" not in node:
            continue
        matrix, at = local(node), i
        while at in parent:
            at = parent[at]
            matrix = local(nodes[at]) @ matrix
        for primitive in header["meshes"][node["mesh"]]["primitives"]:
            points = values(header, buffer, primitive["attributes"]["POSITION"])
            order = np.arange(len(points))
            if "indices" in primitive:
                order = values(header, buffer, primitive["indices"])[:, 0].astype(int)
            corners = (np.c_[points, np.ones(len(points))] @ matrix.T)[:, :3]
            if textured:
                if "baseColorTexture" not in header["materials"][primitive["material"]]["pbrMetallicRoughness"]:
                    continue
                corners = np.c_[corners, values(header, buffer, primitive["attributes"]["TEXCOORD_0"])]
            yield corners[order].reshape(-1, 3, corners.shape[1])


def images_of(header: dict[str, Any], buffer: bytes, material: dict[str, Any], folder: Path) -> set[bytes]:
    """The content of the image file of a material's base colour texture; empty without a texture."""
    info = material["pbrMetallicRoughness"].get("baseColorTexture")
    if info is None:
        return set()
    texture = header["textures"][info["index"]]
    source = texture if "source" in texture else texture["extensions"]["EXT_texture_webp"]
    image = header["images"][source["source"]]
    if "uri" in image:
        return {(folder / image["uri"]).read_bytes()}
    view = header["bufferViews"][image["bufferView"]]
    start = view.get("byteOffset", 0)
    return {buffer[start : start + view["byteLength"]]}
