"""STL and PLY files, which hold one mesh each, read by trimesh."""

from __future__ import annotations

import io
import logging
import re
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import numpy as np

from scene2hap.errors import SceneError, SceneFormatError
from scene2hap.scene.looks.appearance import Appearance, FaceMaterial, painted
from scene2hap.scene.tree import AuthoredNode, AuthoredScene, Piece

_HEADER_BYTES = 1 << 16
# Matches the lines between two solids of a text STL.
_NEXT_SOLID = re.compile(rb"\n[ \t]*endsolid[^\n]*(?:\n[ \t\r]*)*\n[ \t]*solid\b[^\n]*(?=\n)", re.IGNORECASE)
MAX_SOLIDS = 1_000
"""Most solids of a text STL that do not begin on a line of their own; each is read separately (assumed)."""


def read_stl_ply(data: bytes, file_type: str, name: str) -> AuthoredScene:
    """Return the triangles of a file as one node called `name`; `file_type` is "stl" or "ply".

    Raises: SceneFormatError: trimesh cannot read it, or it was cut short.
    """
    import trimesh

    if file_type == "stl":
        data = _as_one_solid(data, name)
    try:
        with _silent_log(), warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            # No resolver: these formats need no other file, so none is opened.
            scene = trimesh.load_scene(io.BytesIO(data), file_type=file_type, process=False)
            meshes = [mesh for mesh in scene.geometry.values() if isinstance(mesh, trimesh.Trimesh)]
            tables = [(np.asarray(mesh.vertices), np.asarray(mesh.faces), _appearance(mesh)) for mesh in meshes]
    # Broken bytes may raise any error in trimesh's readers.
    except Exception as cause:
        raise SceneFormatError(f"{name!r} cannot be read as {file_type.upper()}: {str(cause)[:200]}.") from cause
    # trimesh ignores the number of faces in a text PLY. It checks the numbers in binary PLY and in STL.
    promised = re.search(rb"^element face (\d+)", data[:_HEADER_BYTES], re.MULTILINE) if file_type == "ply" else None
    n_faces = sum(len(faces) for _, faces, _ in tables)
    if promised is not None and n_faces < int(promised[1]):
        raise SceneFormatError(f"{name!r} promises {int(promised[1])} faces and holds {n_faces}: cut short?")
    if file_type == "stl" and not n_faces and not data.lstrip().lower().startswith(b"solid"):
        # If trimesh can guess encodings, it reads a binary file with a wrong count as a text without triangles.
        promised_stl = int.from_bytes(data[80:84], "little")
        if promised_stl:
            raise SceneFormatError(
                f"{name!r} cannot be read as STL: it promises {promised_stl} triangles, which are "
                f"{84 + 50 * promised_stl} bytes, and has {len(data)}. Export it again."
            )
    pieces = (
        replace(Piece.checked(i, points, faces, "", name), appearance=looks)
        for i, (points, faces, looks) in enumerate(tables)
    )
    return AuthoredScene((AuthoredNode(name, np.eye(4), tuple(piece for piece in pieces if len(piece.faces))),))


def _as_one_solid(data: bytes, name: str) -> bytes:
    """Remove the lines between the solids of a text STL, since trimesh takes a millisecond for each. Binary STL is
    unchanged.

    Raises: SceneError: many solids begin within lines.
    """
    if len(data) == 84 + 50 * int.from_bytes(data[80:84], "little"):
        return data
    joined = _NEXT_SOLID.sub(b"", data)
    n_solids = joined.lower().count(b"endsolid")
    if n_solids > MAX_SOLIDS:
        raise SceneError(
            f"{name!r} holds {n_solids:,} solids that do not begin on lines of their own; up to {MAX_SOLIDS:,} are "
            "read. Export it as binary STL."
        )
    return joined


def _appearance(mesh: Any) -> Appearance | None:
    """Return colours of faces, or of vertices as the mean of each face; None if the file has none."""
    if mesh.visual.kind not in ("vertex", "face"):
        return None
    return painted(np.asarray(mesh.visual.face_colors) / 255.0, FaceMaterial((1.0, 1.0, 1.0, 1.0)))


@contextmanager
def _silent_log() -> Iterator[None]:
    """Silence trimesh's logs; our own error states the cause."""
    log, handler = logging.getLogger("trimesh"), logging.NullHandler()
    propagated = log.propagate
    log.addHandler(handler)
    log.propagate = False
    try:
        yield
    finally:
        log.propagate = propagated
        log.removeHandler(handler)
