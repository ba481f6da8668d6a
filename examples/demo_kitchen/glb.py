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
        points, faces = _joined(self.shape)
        c, s = cos(radians(self.yaw_deg)), sin(radians(self.yaw_deg))
        turn = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
        return points.astype(np.float64) @ turn.T + np.array(self.position_m), faces


def encode(scene_name: str, nodes: Iterable[Node], palette: Mapping[str, Colour]) -> bytes:
    """The bytes of a .glb file."""
    meshes = _Meshes()
    rows = [_node(node, meshes.index_of(node)) for node in nodes]
    vertices, indices = bytes(meshes.vertices), bytes(meshes.indices) + bytes(-len(meshes.indices) % 4)
    document = {
        "asset": {"version": "2.0", "generator": "scene2hap examples/build_demo_kitchen.py"},
        "scene": 0,
        "scenes": [{"name": scene_name, "nodes": list(range(len(rows)))}],
        "nodes": rows,
        "meshes": meshes.rows,
        "materials": [_material(name, palette[name]) for name in meshes.colours],
        "accessors": meshes.accessors,
        "bufferViews": [
            {"buffer": 0, "byteLength": len(vertices), "byteStride": 12, "target": _VERTEX_BUFFER},
            {"buffer": 0, "byteOffset": len(vertices), "byteLength": len(indices), "target": _INDEX_BUFFER},
        ],
        "buffers": [{"byteLength": len(vertices) + len(indices)}],
    }
    text = json.dumps(document, separators=(",", ":")).encode()
    chunks = _chunk(b"JSON", text + b" " * (-len(text) % 4)) + _chunk(b"BIN\0", vertices + indices)
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


class _Meshes:
    """Meshes as they gather: their rows, the accessors and bytes these refer to, the colours in order of first use."""

    def __init__(self) -> None:
        self.rows: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []
        self.colours: list[str] = []
        self.vertices, self.indices = bytearray(), bytearray()
        self._by_content: dict[bytes, int] = {}

    def index_of(self, node: Node) -> int:
        """The number of a node's mesh, which it shares with the nodes of the same shape and colours."""
        content = b"".join(part.colour.encode() + part.vertices_m.tobytes() for part in node.shape)
        if content not in self._by_content:
            by_colour: dict[str, list[Part]] = {}
            for part in node.shape:
                by_colour.setdefault(part.colour, []).append(part)
            self._by_content[content] = len(self.rows)
            primitives = [self._primitive(colour, parts) for colour, parts in by_colour.items()]
            self.rows.append({"name": node.name, "primitives": primitives})
        return self._by_content[content]

    def _primitive(self, colour: str, parts: Sequence[Part]) -> dict[str, Any]:
        if colour not in self.colours:
            self.colours.append(colour)
        points, corners = _joined(parts)
        bounds = {"min": _decimals(points.min(axis=0)), "max": _decimals(points.max(axis=0))}
        place = {"bufferView": 0, "byteOffset": len(self.vertices), "componentType": _FLOAT32}
        self.accessors.append({**place, "count": len(points), "type": "VEC3", **bounds})
        place = {"bufferView": 1, "byteOffset": len(self.indices), "componentType": _UINT16}
        self.accessors.append({**place, "count": corners.size, "type": "SCALAR"})
        self.vertices += points.astype("<f4").tobytes()
        self.indices += corners.astype("<u2").tobytes()
        position = len(self.accessors) - 2
        material = self.colours.index(colour)
        return {"attributes": {"POSITION": position}, "indices": position + 1, "material": material}


def _joined(parts: Sequence[Part]) -> tuple[NDArray[np.float32], NDArray[np.int64]]:
    starts = np.cumsum([0, *(len(part.vertices_m) for part in parts[:-1])])
    faces = [part.faces + start for part, start in zip(parts, starts, strict=True)]
    points = (np.round(np.concatenate([part.vertices_m for part in parts]), 6) + 0.0).astype(np.float32)
    return points, np.concatenate(faces)


def _node(node: Node, mesh: int) -> dict[str, Any]:
    half = radians(node.yaw_deg) / 2
    turn = {"rotation": [0.0, round(sin(half), 12), 0.0, round(cos(half), 12)]} if node.yaw_deg else {}
    return {"name": node.name, "mesh": mesh, "translation": list(node.position_m), **turn}


def _chunk(kind: bytes, content: bytes) -> bytes:
    return struct.pack("<I4s", len(content), kind) + content


def _material(name: str, colour: Colour) -> dict[str, Any]:
    surface = {
        "baseColorFactor": [*colour.rgb, 1.0],
        "metallicFactor": colour.metallic,
        "roughnessFactor": colour.roughness,
    }
    return {"name": name, "pbrMetallicRoughness": surface}


def _decimals(point: NDArray[np.float32]) -> list[float]:
    return [round(float(value), 6) for value in point]
