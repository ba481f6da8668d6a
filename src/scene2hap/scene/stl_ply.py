"""STL and PLY files, which hold one mesh each, through trimesh."""

from __future__ import annotations

import io
import logging
import warnings

import numpy as np

from scene2hap.errors import SceneFormatError
from scene2hap.scene.tree import AuthoredNode, AuthoredScene, Piece


def read_stl_ply(data: bytes, file_type: str, name: str) -> AuthoredScene:
    """The triangles of a file as one node called `name`; `file_type` is "stl" or "ply".

    Raises: SceneFormatError: trimesh cannot read it.
    """
    import trimesh

    log = logging.getLogger("trimesh")
    was_disabled = log.disabled
    log.disabled = True
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            # No resolver: neither format needs another file, so none is opened.
            scene = trimesh.load_scene(io.BytesIO(data), file_type=file_type, process=False)
            meshes = [mesh for mesh in scene.geometry.values() if isinstance(mesh, trimesh.Trimesh)]
            tables = [(np.asarray(mesh.vertices), np.asarray(mesh.faces)) for mesh in meshes]
    # Its readers raise whatever the broken bytes lead to.
    except Exception as cause:
        raise SceneFormatError(f"{name!r} cannot be read as {file_type.upper()}: {cause}.") from cause
    finally:
        log.disabled = was_disabled
    pieces = (Piece.checked(i, points, faces, "", name) for i, (points, faces) in enumerate(tables))
    return AuthoredScene((AuthoredNode(name, np.eye(4), tuple(piece for piece in pieces if len(piece.faces))),))
