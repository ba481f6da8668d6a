"""Triangle meshes as binary PLY files without loss of precision, so that bundles open in any mesh viewer.

Files are written with doubles; float files, such as Blender's, are read too. trimesh reads more kinds, but it writes
single precision, and its import would take the playing side a quarter of a second.
"""

from __future__ import annotations

import re

import numpy as np

from scene2hap.errors import SceneFormatError
from scene2hap.scene.shapes import TriMesh

_TYPES = {
    **dict.fromkeys(("char", "int8"), "i1"),
    **dict.fromkeys(("uchar", "uint8"), "u1"),
    **dict.fromkeys(("short", "int16"), "<i2"),
    **dict.fromkeys(("ushort", "uint16"), "<u2"),
    **dict.fromkeys(("int", "int32"), "<i4"),
    **dict.fromkeys(("uint", "uint32"), "<u4"),
    **dict.fromkeys(("float", "float32"), "<f4"),
    **dict.fromkeys(("double", "float64"), "<f8"),
}
_HEADER = re.compile(
    rb"ply\nformat binary_little_endian 1\.0\n(?:comment[^\n]*\n)*"
    rb"element vertex (\d+)\n((?:property \w+ \w+\n)+)"
    rb"element face (\d+)\nproperty list (\w+) (\w+) vertex_ind(?:ex|ices)\nend_header\n"
)


def encode_ply(mesh: TriMesh) -> bytes:
    """Return the mesh as a binary PLY file: double vertices, int faces."""
    faces = np.empty(len(mesh.faces), dtype=[("n", "u1"), ("corners", "<i4", 3)])
    faces["n"], faces["corners"] = 3, mesh.faces
    header = (
        "ply\nformat binary_little_endian 1.0\ncomment metres, scene2hap\n"
        f"element vertex {len(mesh.vertices_m)}\nproperty double x\nproperty double y\nproperty double z\n"
        f"element face {len(mesh.faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    return header.encode("ascii") + mesh.vertices_m.astype("<f8").tobytes() + faces.tobytes()


def decode_ply(data: bytes) -> TriMesh:
    """Return the mesh in a binary PLY file of triangles.

    Raises: SceneFormatError: another kind of PLY, cut short, or faces that are not triangles.
    """
    header = _HEADER.match(data)
    try:
        if header is None:
            raise ValueError("the header is not that of a binary little-endian mesh of vertices and faces")
        n_vertices, n_faces = int(header[1]), int(header[3])
        properties = [line.split() for line in header[2].decode("ascii").splitlines()]
        vertex_type = np.dtype([(name, _TYPES[kind]) for _, kind, name in properties])
        face_type = np.dtype([("n", _TYPES[header[4].decode()]), ("corners", _TYPES[header[5].decode()], 3)])
        vertices = np.frombuffer(data, vertex_type, n_vertices, header.end())
        faces = np.frombuffer(data, face_type, n_faces, header.end() + vertices.nbytes)
        if (faces["n"] != 3).any():
            raise ValueError("a face has other than three corners")
        table = np.stack([vertices["x"], vertices["y"], vertices["z"]], axis=1)
    except (ValueError, KeyError, TypeError) as cause:
        raise SceneFormatError(
            f"not a mesh that bundles hold: {cause}. Export it as binary PLY, triangulated, faces only."
        ) from cause
    return TriMesh(table, faces["corners"])
