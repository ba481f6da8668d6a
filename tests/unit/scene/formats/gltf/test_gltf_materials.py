"""glTF appearances: the colour at each corner of a face, compared with hand-written pixels."""

from __future__ import annotations

import base64
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gltf_builder import Gltf
from looks import (
    BLUE,
    GREEN,
    PIXELS,
    QUAD,
    QUAD_FACES,
    QUAD_UV,
    RED,
    UPRIGHT,
    WHITE,
    beside,
    embedded,
    image_file,
    looks,
    one,
    pbr,
    quad,
    refused,
    shown,
)
from scene2hap.scene.load import load_scene
from scene2hap.scene.looks.appearance import srgb

# -- where images come from ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["PNG", "WEBP", "BMP", "TGA", "TIFF"])
def test_texture_coordinates_map_corners_to_pixels(tmp_path: Path, kind: str) -> None:
    item = one(embedded(quad(pbr()), image_file(kind=kind)), tmp_path)
    assert shown(item) == UPRIGHT
    assert looks(item).materials[0].color_rgba == (1.0, 1.0, 1.0, 1.0)


def test_an_image_may_be_a_data_uri(tmp_path: Path) -> None:
    gltf = quad(pbr())
    gltf.header["images"] = [{"uri": "data:image/png;base64," + base64.b64encode(image_file()).decode()}]
    assert shown(one(gltf, tmp_path)) == UPRIGHT


@pytest.mark.parametrize("uri", ["wood floor.png", "wood%20floor.png", "./wood%20floor.png"])
def test_an_image_may_be_a_file_of_any_name(tmp_path: Path, uri: str) -> None:
    (tmp_path / "wood floor.png").write_bytes(image_file())
    gltf = quad(pbr())
    gltf.header["images"] = [{"uri": uri}]
    assert shown(one(gltf, tmp_path, "scene.gltf")) == UPRIGHT


def test_webp_texture_is_read_through_its_extension(tmp_path: Path) -> None:
    gltf = embedded(embedded(quad(pbr()), b"no image"), image_file(kind="WEBP"))
    gltf.header["textures"] = [{"source": 0, "extensions": {"EXT_texture_webp": {"source": 1}}}]
    assert shown(one(gltf, tmp_path)) == UPRIGHT


def test_sibling_folder_is_read_with_a_common_assets_root(tmp_path: Path) -> None:
    path = beside(tmp_path, "../textures/x.png")
    (tmp_path / "textures").mkdir()
    (tmp_path / "textures" / "x.png").write_bytes(image_file())
    assert shown(load_scene(path, assets_root=tmp_path).objects[0]) == UPRIGHT


# -- colours ---------------------------------------------------------------------------------------------------------


def test_colour_factors_are_linear_light() -> None:
    """Linear light 0.2140 is sRGB 0.5 (IEC 61966-2-1); 0.002 lies on the linear part, 12.92 x."""
    np.testing.assert_allclose(srgb([0.0, 0.002, 0.21404114, 1.0, 7.0]), [0.0, 0.02584, 0.5, 1.0, 1.0], atol=1e-6)


@pytest.mark.parametrize(
    ("mode", "opacity"), [({}, 1.0), ({"alphaMode": "BLEND"}, 0.25), ({"alphaMode": "MASK"}, 0.25)]
)
def test_opacity_is_used_only_with_alpha_mode(tmp_path: Path, mode: dict[str, str], opacity: float) -> None:
    material = {"pbrMetallicRoughness": {"baseColorFactor": [0.21404114, 0.0, 1.0, 0.25]}, **mode}
    item = one(quad(material), tmp_path)
    assert looks(item).materials[0].color_rgba == pytest.approx((0.5, 0.0, 1.0, opacity), abs=1e-6)
    assert looks(item).uv is None


@pytest.mark.parametrize(("mode", "channels"), [("OPAQUE", 3), ("BLEND", 4)])
def test_texture_keeps_its_alpha_channel_only_with_alpha_mode(tmp_path: Path, mode: str, channels: int) -> None:
    clear = np.dstack((PIXELS, np.full((2, 2), 0, np.uint8)))
    item = one(embedded(quad({**pbr(), "alphaMode": mode}), image_file(clear)), tmp_path)
    texture = looks(item).materials[0].texture
    assert texture is not None
    np.testing.assert_array_equal(texture, clear[..., :channels])


def test_older_materials_have_a_diffuse_colour(tmp_path: Path) -> None:
    older = {"diffuseFactor": [0.21404114, 0.21404114, 0.21404114, 0.5], "diffuseTexture": {"index": 0}}
    material = {"alphaMode": "BLEND", "extensions": {"KHR_materials_pbrSpecularGlossiness": older}}
    item = one(embedded(quad(material), image_file()), tmp_path)
    assert looks(item).materials[0].color_rgba == pytest.approx((0.5, 0.5, 0.5, 0.5), abs=1e-6)
    assert shown(item) == UPRIGHT


def test_object_without_material_has_no_appearance(tmp_path: Path) -> None:
    assert one(quad(None), tmp_path).appearance is None


def test_vertex_colours_become_face_colours(tmp_path: Path) -> None:
    gltf = quad({"pbrMetallicRoughness": {"baseColorFactor": [1.0, 1.0, 0.0, 1.0]}})
    # The first face has corners 0, 1, 2, the second 0, 2, 3: linear means of (2/3, 1/3, 1/3) and (1/3, 0, 2/3).
    colors = np.array([[1, 0, 1, 1], [1, 1, 0, 1], [0, 0, 0, 1], [0, 0, 1, 1]]) * 255
    number = gltf.accessor(colors, "u1", "VEC4", normalized=True)
    gltf.header["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = number
    appearance = looks(one(gltf, tmp_path))
    rgba = np.array([appearance.materials[i].color_rgba for i in appearance.face_material])
    # sRGB of 1/3 is 0.6120, of 2/3 0.8325.
    np.testing.assert_allclose(rgba, [[0.8325, 0.6120, 0.0, 1.0], [0.6120, 0.0, 0.0, 1.0]], atol=0.003)


def test_white_vertex_colours_keep_the_material(tmp_path: Path) -> None:
    gltf = embedded(quad(pbr()), image_file())
    number = gltf.accessor(np.ones((4, 3)), "f4", "VEC3")
    gltf.header["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = number
    item = one(gltf, tmp_path)
    assert len(looks(item).materials) == 1
    assert shown(item) == UPRIGHT


# -- texture coordinates ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("scale", [[-1.0, 1.0, 1.0], [1.0, -1.0, 1.0], [-1.0, -1.0, -1.0]])
def test_mirrored_node_keeps_texture_coordinates(tmp_path: Path, scale: list[float]) -> None:
    item = one(embedded(quad(pbr()), image_file()), tmp_path, scale=scale)
    expected = {(x * scale[0], y * scale[1]): color for (x, y), color in UPRIGHT.items()}
    assert shown(item) == expected


def test_texture_uses_the_named_coordinate_set(tmp_path: Path) -> None:
    gltf = embedded(quad(pbr(baseColorTexture={"index": 0, "texCoord": 1}), uv=np.full((4, 2), 0.25)), image_file())
    number = gltf.accessor(np.round(QUAD_UV * 65535), "u2", "VEC2", normalized=True)
    gltf.header["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = number
    assert shown(one(gltf, tmp_path)) == UPRIGHT


@pytest.mark.parametrize(
    ("transform", "expected"),
    [
        # The specification's example: only the lower left quadrant (here blue) of the image is used.
        ({"offset": [0, 1], "rotation": np.pi / 2, "scale": [0.5, 0.5]}, [BLUE] * 4),
        # The specification's example: v runs up.
        ({"offset": [0, 1], "scale": [1, -1]}, [RED, GREEN, WHITE, BLUE]),
        ({"offset": [0.5, 0]}, [WHITE, BLUE, RED, GREEN]),
        # Counter-clockwise by a quarter on an image whose v runs down: u' = v, v' = 1 - u.
        ({"offset": [0, 1], "rotation": np.pi / 2}, [WHITE, GREEN, RED, BLUE]),
        ({"texCoord": 0}, [BLUE, WHITE, GREEN, RED]),
    ],
)
def test_texture_transform_is_applied(
    tmp_path: Path, transform: dict[str, Any], expected: list[tuple[int, ...]]
) -> None:
    info = {"index": 0, "extensions": {"KHR_texture_transform": transform}}
    item = one(embedded(quad(pbr(baseColorTexture=info)), image_file()), tmp_path)
    assert shown(item) == dict(zip(map(tuple, QUAD[:, :2].tolist()), expected, strict=True))


def test_unused_vertices_do_not_shift_coordinates(tmp_path: Path) -> None:
    gltf = embedded(quad(pbr()), image_file())
    only = gltf.accessor(np.array([0, 2, 3]), "u2", "SCALAR")
    gltf.header["meshes"][0]["primitives"][0]["indices"] = only
    expected = {place: color for place, color in UPRIGHT.items() if place != (1.0, 0.0)}
    assert shown(one(gltf, tmp_path)) == expected


def test_draco_mesh_keeps_texture_coordinates(tmp_path: Path) -> None:
    draco_py = pytest.importorskip("DracoPy", reason="DracoPy is not installed")
    data = draco_py.encode(
        QUAD.astype(np.float32),
        faces=QUAD_FACES.astype(np.uint32),
        tex_coord=QUAD_UV,
        quantization_bits=14,
    )
    kinds = {row["attribute_type"]: row["unique_id"] for row in draco_py.decode(data).attributes}
    gltf = embedded(quad(pbr()), image_file())
    numbers = {"POSITION": kinds[0], "TEXCOORD_0": kinds[3]}
    compressed = {"bufferView": gltf.view(np.frombuffer(data, np.uint8), "u1"), "attributes": numbers}
    gltf.header["meshes"][0]["primitives"][0]["extensions"] = {"KHR_draco_mesh_compression": compressed}
    gltf.header["extensionsRequired"] = ["KHR_draco_mesh_compression"]
    gltf.node("square", mesh=0, root=True)
    assert shown(load_scene(gltf.write(tmp_path / "scene.glb")).objects[0]) == UPRIGHT
    numbers["TEXCOORD_0"] = 42
    _, message = refused(gltf.write(tmp_path / "scene.glb"))
    assert "attribute 42 of Draco data" in message


# -- sharing ---------------------------------------------------------------------------------------------------------


def keys(gltf: Gltf, path: Path) -> list[str]:
    return [item.instance_key for item in load_scene(gltf.write(path)).objects]


def test_instances_share_looks_and_key(tmp_path: Path) -> None:
    gltf = embedded(quad(pbr()), image_file())
    for i in range(3):
        gltf.node(f"square{i}", mesh=0, root=True, translation=[2.0 * i, 0.0, 0.0], rotation=[0.0, 0.6, 0.0, 0.8])
    objects = load_scene(gltf.write(tmp_path / "scene.glb")).objects
    assert len({item.instance_key for item in objects}) == 1
    assert len({id(item.appearance) for item in objects}) == 1


def two_squares(first: dict[str, Any], second: dict[str, Any], *images: bytes) -> Gltf:
    """Two equal squares with two materials; image i is texture i."""
    gltf = quad(first)
    gltf.header["materials"].append(second)
    primitive = {**gltf.header["meshes"][0]["primitives"][0], "material": 1}
    gltf.mesh(primitive)
    for content in images:
        embedded(gltf, content)
    gltf.header["textures"] = [{"source": i} for i in range(len(images))]
    for mesh in range(2):
        gltf.node(f"square{mesh}", mesh=mesh, root=True)
    return gltf


def test_instance_keys_differ_by_content_of_colours_and_textures(tmp_path: Path) -> None:
    path = tmp_path / "scene.glb"
    red, green = ({"pbrMetallicRoughness": {"baseColorFactor": color}} for color in ([1, 0, 0, 1], [0, 1, 0, 1]))
    first, second = keys(two_squares(red, green), path)
    assert first != second
    assert keys(two_squares(red, dict(red)), path) == [first, first]
    other = pbr(baseColorTexture={"index": 1})
    mirrored = np.ascontiguousarray(PIXELS[:, ::-1])
    first, second = keys(two_squares(pbr(), other, image_file(), image_file(mirrored)), path)
    assert first != second
    assert keys(two_squares(pbr(), other, image_file(), image_file()), path) == [first, first]


def test_duplicate_images_become_one_texture(tmp_path: Path) -> None:
    gltf = two_squares(pbr(), pbr(baseColorTexture={"index": 1}), image_file(), image_file())
    first, second = load_scene(gltf.write(tmp_path / "scene.glb")).objects
    assert looks(first).materials[0].texture is looks(second).materials[0].texture


def test_instance_keys_differ_by_texture_coordinates(tmp_path: Path) -> None:
    """Asset kits use one image for all models: equal crates differ only by their coordinates."""
    gltf = two_squares(pbr(), pbr(), image_file())
    elsewhere = gltf.accessor(QUAD_UV + 0.5, "f4", "VEC2")
    primitive = gltf.header["meshes"][1]["primitives"][0]
    primitive["attributes"] = {**primitive["attributes"], "TEXCOORD_0": elsewhere}
    first, second = load_scene(gltf.write(tmp_path / "scene.glb")).objects
    assert first.geometry is second.geometry
    assert first.instance_key != second.instance_key


def test_parts_of_an_object_keep_their_own_materials(tmp_path: Path) -> None:
    gltf = embedded(quad(pbr()), image_file())
    plain = {"pbrMetallicRoughness": {"baseColorFactor": [0.0, 0.0, 0.0, 1.0]}}
    gltf.header["materials"].append(plain)
    primitive = gltf.header["meshes"][0]["primitives"][0]
    without = {
        "attributes": {"POSITION": gltf.accessor(QUAD, "f4", "VEC3")},
        "indices": primitive["indices"],
    }
    gltf.header["meshes"][0]["primitives"] += [{**without, "material": 1}, dict(without)]
    appearance = looks(one(gltf, tmp_path))
    assert appearance.face_material.tolist() == [0, 0, 1, 1, 2, 2]
    assert appearance.materials[1].color_rgba == (0.0, 0.0, 0.0, 1.0)
    assert appearance.materials[2].color_rgba == (0.8, 0.8, 0.8, 1.0)
    assert appearance.uv is not None
    assert not appearance.uv[2:].any()
