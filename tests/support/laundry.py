"""A laundry scene in plain glTF, for comparison with the same scene packed by other tools.

    PYTHONPATH=tests/support python tests/support/laundry.py laundry.glb

writes the file; tests/data/meshopt/README.md says how the packed files were made from it.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import trimesh

from gltf_builder import Gltf
from looks import image_file

IDS = ["floor", "washing_machine", "basket", "ball", "cup", "cup_2"]


def laundry() -> Gltf:
    """A washing machine with its door, a basket, a painted ball, and two cups of one mesh with a texture."""
    gltf = Gltf()
    picture = image_file(np.tile(np.array([[200, 60], [60, 200]], np.uint8)[..., None], 3))
    gltf.header["materials"] = [
        {"name": "white_steel", "pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.9, 0.9, 1.0]}},
        {"name": "glass", "pbrMetallicRoughness": {"baseColorFactor": [0.3, 0.4, 0.5, 1.0]}},
        {"name": "porcelain", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
        {"name": "wood", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.3, 0.1, 1.0]}},
    ]
    gltf.header["images"] = [{"bufferView": gltf.view(np.frombuffer(picture, np.uint8), "u1"), "mimeType": "image/png"}]
    gltf.header["textures"] = [{"source": 0}]

    def mesh(shape: trimesh.Trimesh, material: int, *, is_textured: bool = False, is_painted: bool = False) -> int:
        points = np.asarray(shape.vertices)
        attributes = {
            "POSITION": gltf.accessor(
                points, "f4", "VEC3", min=points.min(axis=0).tolist(), max=points.max(axis=0).tolist()
            ),
            "NORMAL": gltf.accessor(shape.vertex_normals, "f4", "VEC3"),
        }
        if is_textured:
            attributes["TEXCOORD_0"] = gltf.accessor(points[:, :2] * 5.0 + 0.5, "f4", "VEC2")
        if is_painted:
            attributes["COLOR_0"] = gltf.accessor((points - points.min()) / np.ptp(points), "f4", "VEC3")
        faces = gltf.accessor(np.asarray(shape.faces).reshape(-1), "u2", "SCALAR")
        return gltf.mesh({"attributes": attributes, "indices": faces, "material": material})

    box = trimesh.creation.box
    cup = mesh(trimesh.creation.cylinder(0.04, 0.1, sections=12), 2, is_textured=True)
    door = gltf.node(
        "washing_machine_door",
        mesh=mesh(trimesh.creation.cylinder(0.15, 0.02, sections=12), 1),
        translation=[0.0, 0.0, 0.3],
    )
    gltf.node("floor", mesh=mesh(box((3.0, 0.1, 2.0)), 3), translation=[0.0, -0.05, 0.0], root=True)
    machine = mesh(box((0.6, 0.85, 0.58)), 0)
    gltf.node("washing_machine", mesh=machine, children=[door], translation=[0.4, 0.425, -0.3], root=True)
    basket = mesh(trimesh.creation.annulus(0.2, 0.22, 0.3, sections=12), 3)
    gltf.node("basket", mesh=basket, translation=[-0.7, 0.15, 0.1], rotation=[0.6, 0.0, 0.0, 0.8], root=True)
    ball = mesh(trimesh.creation.icosphere(subdivisions=1, radius=0.11), 0, is_painted=True)
    gltf.node("ball", mesh=ball, translation=[-0.2, 0.11, 0.6], root=True)
    gltf.node("cup", mesh=cup, translation=[0.3, 0.9, -0.3], rotation=[0.6, 0.0, 0.0, 0.8], root=True)
    gltf.node("cup_2", mesh=cup, translation=[0.5, 0.9, -0.2], rotation=[0.6, 0.0, 0.0, 0.8], root=True)
    return gltf


if __name__ == "__main__":
    laundry().write(Path(sys.argv[1]))
