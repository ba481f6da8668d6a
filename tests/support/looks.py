"""Textures of known pixels, and the colours that a loaded object shows at the corners of its faces."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray
from PIL import Image

from gltf_builder import Gltf
from scene2hap.scene.load import TextureWarning, load_scene
from scene2hap.scene.looks.appearance import Appearance
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.snapshot import SceneSnapshot

RED, GREEN, BLUE, WHITE = (255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255)
PIXELS = np.array([[RED, GREEN], [BLUE, WHITE]], np.uint8)
"""Upper left, upper right, lower left and lower right of a texture."""

QUAD = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]])
"""A square in x (to the right) and y (up)."""
QUAD_FACES = np.array([[0, 1, 2], [0, 2, 3]])
QUAD_UV = np.array([[0.25, 0.75], [0.75, 0.75], [0.75, 0.25], [0.25, 0.25]])
"""The image upright on the square: each corner at the middle of a pixel, v running down."""
UPRIGHT = {(0.0, 0.0): BLUE, (1.0, 0.0): WHITE, (1.0, 1.0): GREEN, (0.0, 1.0): RED}
"""The colour at each corner of the square with `QUAD_UV`."""


def image_file(pixels: NDArray[np.uint8] = PIXELS, kind: str = "PNG") -> bytes:
    """An image file, lossless unless it is JPEG."""
    out = io.BytesIO()
    Image.fromarray(pixels).save(out, kind, **({"lossless": True} if kind == "WEBP" else {}))
    return out.getvalue()


def quad(material: dict[str, Any] | None, *, uv: ArrayLike = QUAD_UV, **attributes: int) -> Gltf:
    """A textured square without its image and without a node."""
    gltf = Gltf()
    places = {"POSITION": gltf.accessor(QUAD, "f4", "VEC3"), "TEXCOORD_0": gltf.accessor(uv, "f4", "VEC2")}
    order = gltf.accessor(QUAD_FACES.reshape(-1), "u2", "SCALAR")
    primitive: dict[str, Any] = {"attributes": {**places, **attributes}, "indices": order}
    if material is not None:
        gltf.header["materials"] = [material]
        primitive["material"] = 0
    gltf.mesh(primitive)
    gltf.header["textures"] = [{"source": 0}]
    gltf.header["images"] = []
    return gltf


def embedded(gltf: Gltf, content: bytes) -> Gltf:
    gltf.header["images"].append({"bufferView": gltf.view(np.frombuffer(content, np.uint8), "u1")})
    return gltf


def pbr(**row: Any) -> dict[str, Any]:
    return {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, **row}}


def one(gltf: Gltf, folder: Path, name: str = "scene.glb", **node: Any) -> SceneObject:
    gltf.node("square", mesh=0, root=True, **node)
    (item,) = load_scene(gltf.write(folder / name)).objects
    return item


def beside(tmp_path: Path, uri: str) -> Path:
    """Write a scene that refers to the image `uri` into the folder `models`."""
    home = tmp_path / "models"
    home.mkdir()
    gltf = quad(pbr(baseColorFactor=[1.0, 0.0, 0.0, 1.0]))
    gltf.header["images"] = [{"uri": uri}]
    gltf.node("square", mesh=0, root=True)
    return gltf.write(home / "scene.gltf")


def looks(item: SceneObject) -> Appearance:
    """The object's appearance, which it must have."""
    assert item.appearance is not None
    assert len(item.appearance.face_material) == len(item.geometry.mesh.faces)
    return item.appearance


def shown(item: SceneObject) -> dict[tuple[float, float], tuple[int, ...]]:
    """The texture's colour at each corner (x, y) [m] of a flat object; all faces at a corner must agree."""
    appearance = looks(item)
    assert appearance.uv is not None
    points = np.round(item.pose.to_world(item.geometry.mesh.vertices_m), 6)
    colors: dict[tuple[float, float], tuple[int, ...]] = {}
    for face, number, uv in zip(item.geometry.mesh.faces, appearance.face_material, appearance.uv, strict=True):
        texture = appearance.materials[number].texture
        assert texture is not None
        height, width = texture.shape[:2]
        for vertex, (u, v) in zip(face, uv.tolist(), strict=True):
            texel = texture[int(v % 1.0 * height), int(u % 1.0 * width)]
            place = (float(points[vertex, 0]), float(points[vertex, 1]))
            assert colors.setdefault(place, tuple(texel.tolist())) == tuple(texel.tolist())
    return colors


def refused(path: Path, **options: Any) -> tuple[SceneSnapshot, str]:
    """The scene, and the one warning that it gave."""
    with pytest.warns(TextureWarning) as caught:
        scene = load_scene(path, unit_m=1.0, **options)
    assert len(caught) == 1
    return scene, str(caught[0].message)
