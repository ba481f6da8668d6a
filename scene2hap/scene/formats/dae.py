"""COLLADA files as authored trees, read by pycollada.

We call pycollada directly, since trimesh's reader (5.2) drops the names of nodes. pycollada opens no image. Skinned and
animated geometry is left out.

Source: COLLADA 1.4.1 specification (Khronos, 2008), chapter 5: <asset>, <node>, <instance_geometry>.
"""

from __future__ import annotations

import io
import re
import warnings
from dataclasses import replace
from importlib import import_module
from typing import Any

import numpy as np

from scene2hap.errors import MissingExtra, SceneError, SceneFormatError
from scene2hap.scene import limits
from scene2hap.scene.formats.dae_materials import DaeMaterials
from scene2hap.scene.formats.polygons import triangulated
from scene2hap.scene.looks.texture_files import TextureFiles
from scene2hap.scene.tree import AuthoredNode, AuthoredScene, Piece

_ENCODING = re.compile(rb"(?:\xef\xbb\xbf)?\s*<\?xml[^>]*?encoding\s*=\s*[\"']([^\"']*)")
_LIKE_ASCII = re.compile(
    rb"utf-?8|(us-)?ascii|iso-8859-\d+|latin-?1|(windows-|cp)125\d|shift_jis|euc-\w+|gb\w+|big5", re.IGNORECASE
)

# Exporters on systems with a decimal comma write "0,5". Numbers are divided by spaces, so no comma divides them.
_DECIMAL_COMMA = re.compile(rb"<(?:float_array|matrix|translate|rotate|scale|float|color)\b[^>]*>[^<]*\d,\d")


def read_dae(data: bytes, name: str, textures: TextureFiles) -> AuthoredScene:
    """Return the file's scene with its looks; `up_axis` and `unit_m` come from <asset>.

    Raises: MissingExtra: pycollada is not installed. SceneFormatError: the file is not COLLADA, or broken. SceneError:
    its up axis is X.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # pycollada 0.9 uses what Python 3.15 deprecates
            collada: Any = import_module("collada")
    except ImportError as cause:
        raise MissingExtra(
            f"{name!r} is COLLADA, and its reader is not installed. Run: pip install pycollada"
        ) from cause
    # A document type could name other files or expand without end, and pycollada unpacks archives. COLLADA needs
    # neither. We search in ASCII, so encodings that could hide a document type (UTF-16, UTF-7) are refused.
    encoding = _ENCODING.match(data)
    if (
        not data.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<")
        or re.search(rb"<!(DOCTYPE|ENTITY)|\x00", data)
        or (encoding is not None and not _LIKE_ASCII.fullmatch(encoding[1]))
    ):
        raise SceneFormatError(
            f"{name!r} is not COLLADA: it must be XML without a document type. Save it as UTF-8 if it is."
        )
    if _DECIMAL_COMMA.search(data):
        data = re.sub(rb"(?<=\d),(?=\d)", b".", data)
    tolerated = [collada.common.DaeUnsupportedError, collada.common.DaeBrokenRefError]
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            document = collada.Collada(io.BytesIO(data), ignore=tolerated)
            reader = _Reader(collada, DaeMaterials(collada, textures))
            roots = [] if document.scene is None else document.scene.nodes
            nodes = tuple(node for root in roots for node in reader.nodes(root, 1))
            up_axis, unit = document.assetInfo.upaxis, document.assetInfo.unitmeter
    except SceneError:
        raise
    # pycollada raises its own errors, and broken numbers and references may raise any error in it.
    except Exception as cause:
        raise SceneFormatError(f"{name!r} cannot be read as COLLADA: {cause}.") from cause
    if up_axis == collada.asset.UP_AXIS.X_UP:
        raise SceneError(f"{name!r} has X up; scene2hap knows Y and Z. Export it with Y or Z up.")
    is_z_up = up_axis == collada.asset.UP_AXIS.Z_UP
    unit_m = None if unit is None else float(unit)
    return AuthoredScene(nodes, "z" if is_z_up else "y", unit_m, textures.left_out)


class _Reader:
    """Convert pycollada's nodes to authored nodes."""

    def __init__(self, collada: Any, materials: DaeMaterials) -> None:
        self._scene, self._collada, self._materials = collada.scene, collada, materials
        self._size = limits.TreeSize()

    def nodes(self, node: Any, depth: int) -> tuple[AuthoredNode, ...]:
        """Convert a node to one authored node. Cameras, lights and controllers give an empty tuple."""
        if not isinstance(node, self._scene.Node | self._scene.NodeNode):
            return ()
        # A node may instantiate itself, so the depth is bounded before anything else.
        self._size.add_nodes(1, depth)
        actual = node.node if isinstance(node, self._scene.NodeNode) else node
        name = (actual.name or "").strip()
        pieces = tuple(
            piece
            for child in actual.children
            if isinstance(child, self._scene.GeometryNode)
            for piece in self._pieces(child, f"node {name!r}")
        )
        children = tuple(below for child in actual.children for below in self.nodes(child, depth + 1))
        return (AuthoredNode(name, np.array(actual.matrix, dtype=np.float64), pieces, children),)

    def _triangle_set(self, polygons: Any) -> Any:
        """Return polygons as triangles. pycollada cuts any polygon as a fan, which leaves a concave one."""
        which, counts = polygons.vertex_index, np.asarray(polygons.vcounts, dtype=np.int64)
        points = np.asarray([] if polygons.vertex is None else polygons.vertex, dtype=np.float64).reshape(-1, 3)
        is_sound = len(points) > 0 and counts.min() >= 0 and counts.sum() == len(which)
        if not (is_sound and which.min() >= 0 and which.max() < len(points)):
            return polygons.triangleset()  # empty, or refused later
        corners, _ = triangulated(points, counts, np.asarray(which, dtype=np.int64))
        rows = polygons.index[corners.ravel()].ravel()
        return self._collada.triangleset.TriangleSet(polygons.sources, polygons.material, rows, polygons.xmlnode)

    def _pieces(self, drawn: Any, place: str) -> list[Piece]:
        links = {link.symbol: link for link in drawn.materials}
        pieces = []
        for i, primitive in enumerate(drawn.geometry.primitives):
            if isinstance(primitive, self._collada.polylist.Polylist | self._collada.polygons.Polygons):
                primitive = self._triangle_set(primitive)
            if not isinstance(primitive, self._collada.triangleset.TriangleSet) or primitive.vertex is None:
                continue  # lines
            self._size.add_triangles(len(primitive.vertex_index))
            link = links.get(primitive.material)
            material = str((primitive.material or "") if link is None else link.target.name or link.target.id)
            key = (drawn.geometry.id, i)
            piece = Piece.checked(key, primitive.vertex, primitive.vertex_index, material, place)
            if link is not None:
                piece = replace(piece, appearance=self._materials.appearance(primitive, link))
            pieces.append(piece)
        return [piece for piece in pieces if len(piece.faces)]
