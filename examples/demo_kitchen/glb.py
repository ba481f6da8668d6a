"""Writes things to a binary glTF 2.0 file: a node each, a mesh per distinct shape, a primitive per colour.

The same things give the same bytes: coordinates are kept to the micrometre and the JSON's order is that of the things.
Source: Khronos, glTF 2.0 specification, sections 3.6 (binary data), 3.7 (geometry), 4.4 (GLB).
"""

from __future__ import annotations

import json
import struct
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import cos, radians, sin
from typing import Any

import numpy as np
from numpy.typing import NDArray

from demo_kitchen.shapes import Part, Point

_FLOAT32, _UINT16 = 5126, 5123
_VERTEX_BUFFER, _INDEX_BUFFER = 34962, 34963


@dataclass(frozen=True)
class Colour:
    """A flat surface: linear red, green, blue [-]; how metallic and how rough it is [-]."""

    rgb: Point
    metallic: float = 0.0
    roughness: float = 0.8


@dataclass(frozen=True)
class Node:
    """A named shape at its pivot [m], turned about the vertical."""

    name: str
    shape: Sequence[Part]
    position_m: Point
    yaw_deg: float = 0.0

    def to_world(self) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """Vertices (n, 3) [m] in the world, as the file rounds them, and triangles (m, 3)."""
        vertices = [_rounded(part.vertices_m).astype(np.float64) for part in self.shape]
        starts = np.cumsum([0, *map(len, vertices)])
        faces = np.concatenate([part.faces + start for part, start in zip(self.shape, starts, strict=False)])
        c, s = cos(radians(self.yaw_deg)), sin(radians(self.yaw_deg))
        turn = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
        return np.concatenate(vertices) @ turn.T + self.position_m, faces


def encode(scene_name: str, nodes: Iterable[Node], palette: Mapping[str, Colour]) -> bytes:
    """The bytes of a .glb file."""
    vertices, indices = bytearray(), bytearray()
    accessors: list[dict[str, Any]] = []
    meshes: list[dict[str, Any]] = []
    mesh_of: dict[bytes, int] = {}
    rows: list[dict[str, Any]] = []
    used: list[str] = []

    def primitive(colour: str, parts: list[Part]) -> dict[str, Any]:
        if colour not in used:
            used.append(colour)
        points = np.concatenate([_rounded(part.vertices_m) for part in parts])
        starts = np.cumsum([0, *(len(part.vertices_m) for part in parts)])
        corners = np.concatenate([part.faces + start for part, start in zip(parts, starts, strict=False)])
        bounds = {"min": _decimals(points.min(axis=0)), "max": _decimals(points.max(axis=0))}
        place = {"bufferView": 0, "byteOffset": len(vertices), "componentType": _FLOAT32}
        accessors.append({**place, "count": len(points), "type": "VEC3", **bounds})
        place = {"bufferView": 1, "byteOffset": len(indices), "componentType": _UINT16}
        accessors.append({**place, "count": corners.size, "type": "SCALAR"})
        vertices.extend(points.astype("<f4").tobytes())
        indices.extend(corners.astype("<u2").tobytes())
        position = len(accessors) - 2
        return {"attributes": {"POSITION": position}, "indices": position + 1, "material": used.index(colour)}

    for node in nodes:
        content = b"".join(part.colour.encode() + part.vertices_m.tobytes() for part in node.shape)
        if content not in mesh_of:
            mesh_of[content] = len(meshes)
            by_colour: dict[str, list[Part]] = {}
            for part in node.shape:
                by_colour.setdefault(part.colour, []).append(part)
            primitives = [primitive(colour, parts) for colour, parts in by_colour.items()]
            meshes.append({"name": node.name, "primitives": primitives})
        row: dict[str, Any] = {"name": node.name, "mesh": mesh_of[content], "translation": list(node.position_m)}
        if node.yaw_deg:
            half = radians(node.yaw_deg) / 2
            row["rotation"] = [0.0, round(sin(half), 12), 0.0, round(cos(half), 12)]
        rows.append(row)

    indices.extend(bytes(-len(indices) % 4))
    document = {
        "asset": {"version": "2.0", "generator": "scene2hap examples/build_demo_kitchen.py"},
        "scene": 0,
        "scenes": [{"name": scene_name, "nodes": list(range(len(rows)))}],
        "nodes": rows,
        "meshes": meshes,
        "materials": [_material(name, palette[name]) for name in used],
        "accessors": accessors,
        "bufferViews": [
            {"buffer": 0, "byteLength": len(vertices), "target": _VERTEX_BUFFER},
            {"buffer": 0, "byteOffset": len(vertices), "byteLength": len(indices), "target": _INDEX_BUFFER},
        ],
        "buffers": [{"byteLength": len(vertices) + len(indices)}],
    }
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    chunks = _chunk(b"JSON", text) + _chunk(b"BIN\0", bytes(vertices + indices))
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def _chunk(kind: bytes, content: bytes) -> bytes:
    return struct.pack("<I4s", len(content), kind) + content


def _material(name: str, colour: Colour) -> dict[str, Any]:
    surface = {
        "baseColorFactor": [*colour.rgb, 1.0],
        "metallicFactor": colour.metallic,
        "roughnessFactor": colour.roughness,
    }
    return {"name": name, "pbrMetallicRoughness": surface}


def _rounded(vertices_m: NDArray[np.float64]) -> NDArray[np.float32]:
    return (np.round(vertices_m, 6) + 0.0).astype(np.float32)


def _decimals(point: NDArray[np.float32]) -> list[float]:
    return [round(float(value), 6) for value in point]
