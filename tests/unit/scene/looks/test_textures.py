"""Textures of scene files: read lazily, only from allowed folders, and no failure of the load because of them."""

from __future__ import annotations

import io
import struct
import subprocess
import sys
import warnings
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from gltf_builder import Gltf, one_cube
from looks import QUAD_UV, WHITE, beside, embedded, image_file, looks, one, pbr, quad, refused
from scene2hap.scene import limits
from scene2hap.scene.load import TextureWarning, load_scene


def test_texture_outside_the_root_is_skipped_with_the_needed_root(tmp_path: Path) -> None:
    path = beside(tmp_path, "../textures/x.png")
    (tmp_path / "textures").mkdir()
    (tmp_path / "textures" / "x.png").write_bytes(image_file())
    scene, message = refused(path)
    assert "'../textures/x.png', which lies outside" in message
    assert f"assets_root={str(tmp_path.resolve())!r}" in message
    (material,) = looks(scene.objects[0]).materials
    assert (material.color_rgba, material.texture) == ((1.0, 0.0, 0.0, 1.0), None)


@pytest.mark.parametrize(
    ("uri", "reason"),
    [
        ("gone.png", "there is no file '.*gone.png'"),
        ("http://example.org/x.png", "Addresses are never fetched"),
        ("/etc/hostname", "lies outside"),
        ("scene.bin", "'scene.bin' is no image that is read"),
        ("data:image/png;base64,!!", "its data: URI cannot be decoded"),
    ],
)
def test_unreadable_texture_warns_once(tmp_path: Path, uri: str, reason: str) -> None:
    path = beside(tmp_path, uri)
    scene, message = refused(path)
    assert "is read without 1 texture, in plain colours" in message
    with pytest.warns(TextureWarning, match=reason):
        load_scene(path)
    assert looks(scene.objects[0]).uv is None


def test_warning_has_the_line_of_the_load_call(tmp_path: Path) -> None:
    with pytest.warns(TextureWarning) as caught:
        load_scene(beside(tmp_path, "gone.png"))
    assert [warning.filename for warning in caught] == [__file__]


def test_many_bad_textures_give_one_warning(tmp_path: Path) -> None:
    gltf = Gltf()
    gltf.header["images"] = [{"uri": f"gone{i}.png"} for i in range(7)]
    gltf.header["textures"] = [{"source": i} for i in range(7)]
    gltf.header["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": i}}} for i in range(7)]
    for i in range(7):
        gltf.node(f"n{i}", mesh=gltf.cube(material=i), root=True)
    _, message = refused(gltf.write(tmp_path / "scene.glb"))
    assert "without 7 textures" in message
    assert "gone4.png" in message
    assert "gone5.png" not in message
    assert message.endswith("And 2 more.")


def huge_png(width: int, height: int) -> bytes:
    """A PNG whose header states a size, without pixel data."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(b"")) + chunk(b"IEND", b"")


@pytest.mark.parametrize(
    ("size", "reason"), [((8193, 1), "8,193 pixels"), ((12000, 12000), "12,000 pixels"), ((60000, 60000), "no image")]
)
def test_textures_too_large_are_refused_before_they_are_decoded(
    tmp_path: Path, size: tuple[int, int], reason: str
) -> None:
    gltf = embedded(quad(pbr()), huge_png(*size))
    gltf.node("square", mesh=0, root=True)
    _, message = refused(gltf.write(tmp_path / "scene.glb"))
    assert reason in message
    assert "images[0]" in message


def test_texture_limit_can_be_raised(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    gltf = embedded(quad(pbr()), image_file())
    gltf.node("square", mesh=0, root=True)
    path = gltf.write(tmp_path / "scene.glb")
    monkeypatch.setattr(limits, "MAX_TEXTURE_PX", 1)
    _, message = refused(path)
    assert "at most 1 are read (scene2hap.scene.limits.MAX_TEXTURE_PX)" in message


def test_broken_pixels_warn_at_first_access(tmp_path: Path) -> None:
    item = one(embedded(quad(pbr()), huge_png(8, 8)), tmp_path)
    (material,) = looks(item).materials
    with pytest.warns(TextureWarning, match=r"images\[0\]' is left out, its colour stays"):
        assert material.texture is None
    assert material.texture is None


@pytest.mark.parametrize(
    "change",
    [
        {"textures": 5},
        {"textures": [7]},
        {"textures": []},
        {"textures": [{}]},
        {"textures": [{"source": 3}]},
        {"textures": [{"extensions": {"KHR_texture_basisu": {"source": 0}}}]},
        {"images": [{"bufferView": 99}]},
        {"images": [{}]},
        {"materials": [pbr(baseColorFactor="red")]},
        {"materials": [pbr(baseColorTexture={"index": "0"})]},
        {"materials": [pbr(baseColorTexture={"index": 0, "texCoord": 3})]},
        {"materials": [pbr(baseColorTexture={"index": 0, "texCoord": -1})]},
        {"materials": [pbr(baseColorTexture={"index": 0, "extensions": {"KHR_texture_transform": {"scale": 2}}})]},
    ],
)
def test_invalid_appearance_never_fails_the_load(tmp_path: Path, change: dict[str, Any]) -> None:
    gltf = embedded(quad(pbr()), image_file())
    gltf.header.update(change)
    gltf.node("square", mesh=0, root=True)
    scene, _ = refused(gltf.write(tmp_path / "scene.glb"))
    (material,) = looks(scene.objects[0]).materials
    assert (material.color_rgba, material.texture) == ((1.0, 1.0, 1.0, 1.0), None)


def test_coordinates_of_wrong_count_warn(tmp_path: Path) -> None:
    gltf = embedded(quad(pbr(), uv=QUAD_UV[:3]), image_file())
    gltf.node("square", mesh=0, root=True)
    _, message = refused(gltf.write(tmp_path / "scene.glb"))
    assert "TEXCOORD_0 has 3 values for 4 vertices" in message


# -- decoding ---------------------------------------------------------------------------------------------------------


def test_large_images_are_decoded_at_reduced_size(tmp_path: Path) -> None:
    wide = np.zeros((4, 4096, 3), np.uint8)
    wide[:, 2048:] = WHITE
    item = one(embedded(quad(pbr()), image_file(wide)), tmp_path)
    texture = looks(item).materials[0].texture
    assert texture is not None
    assert texture.shape == (1, 1024, 3)
    assert texture[0, [0, 511, 512, 1023], 0].tolist() == [0, 0, 255, 255]


@pytest.mark.parametrize("kind", ["L", "P", "I;16", "LA"])
def test_images_of_every_depth_become_colour(tmp_path: Path, kind: str) -> None:
    grey = np.array([[0, 85], [170, 255]], np.uint8)
    deep = Image.fromarray(grey.astype(np.uint16) * 257)
    image = deep if kind == "I;16" else Image.fromarray(grey).convert(kind)
    out = io.BytesIO()
    image.save(out, "PNG")
    texture = looks(one(embedded(quad(pbr()), out.getvalue()), tmp_path)).materials[0].texture
    assert texture is not None
    np.testing.assert_array_equal(texture, np.repeat(grey[..., None], 3, axis=2))


# -- cost of loading -------------------------------------------------------------------------------------------------


def test_pillow_is_imported_only_for_textures(tmp_path: Path) -> None:
    code = (
        "import sys; from scene2hap.scene.load import load_scene; load_scene(sys.argv[1]); print('PIL' in sys.modules)"
    )

    def imports_pillow(gltf: Gltf) -> str:
        path = gltf.write(tmp_path / "scene.glb")
        done = subprocess.run([sys.executable, "-c", code, str(path)], capture_output=True, text=True, check=True)
        return done.stdout.strip() + done.stderr

    assert imports_pillow(one_cube()) == "False"
    textured = embedded(quad(pbr()), image_file())
    textured.node("square", mesh=0, root=True)
    assert imports_pillow(textured) == "True"


def test_loading_decodes_no_image(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    gltf = embedded(quad(pbr()), huge_png(8, 8))
    gltf.node("square", mesh=0, root=True)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        first, again = (load_scene(gltf.write(tmp_path / "scene.glb")) for _ in range(2))
    assert first.objects[0].instance_key == again.objects[0].instance_key
