"""Colours and textures of MuJoCo models."""

from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image

from mujoco_scenes import scene_of


def png(pixels: list[list[tuple[int, int, int]]]) -> bytes:
    stream = io.BytesIO()
    Image.fromarray(np.array(pixels, dtype=np.uint8)).save(stream, "png")
    return stream.getvalue()


def test_geom_colour_overrides_material_colour() -> None:
    scene = scene_of(
        '<asset><material name="red" rgba="2 0 0 1"/></asset><worldbody>'
        '<body name="a"><geom size="1" material="red"/>'
        '<geom size="1" pos="3 0 0" material="red" rgba="0 1 0 1"/></body>'
        '<body name="b"><geom size="1"/></body></worldbody>'
    )
    a, b = (item.appearance for item in scene.objects)
    assert a is not None
    assert b is not None
    assert [material.color_rgba for material in a.materials] == [(1, 0, 0, 1), (0, 1, 0, 1)]
    assert np.bincount(a.face_material).tolist() == [len(b.face_material)] * 2
    assert b.materials[0].color_rgba == (0.5, 0.5, 0.5, 1)


def test_mesh_texture_follows_the_coordinates_of_the_file() -> None:
    quarters = [[(255, 0, 0), (0, 255, 0)], [(0, 0, 255), (255, 255, 255)]]
    scene = scene_of(
        '<asset><mesh name="wedge" file="wedge.obj"/><mesh name="other" file="wedge.obj" scale="-1 1 1"/>'
        '<texture name="t" type="2d" file="t.png"/>'
        '<material name="m" texture="t" rgba="1 0.5 1 1"/></asset><worldbody>'
        '<body name="a"><geom type="mesh" mesh="other" material="m"/>'
        '<geom type="mesh" mesh="wedge" material="m"/></body></worldbody>',
        {"t.png": png(quarters)},
    )
    look = scene.object("a").appearance
    assert look is not None
    assert look.uv is not None
    (material,) = look.materials
    assert material.color_rgba == (1, 0.5, 1, 1)
    assert material.texture is not None
    np.testing.assert_array_equal(material.texture, quarters)
    # In an OBJ file v goes up: (0.25, 0.75) is the upper left quarter, then upper right, then lower left.
    corners = {tuple(pair) for pair in look.uv.reshape(-1, 2).tolist()}
    assert corners == {(0.25, 0.25), (0.75, 0.25), (0.25, 0.75)}
    # The vertex at the file's origin is always a face's first corner: red.
    mesh = scene.object("a").geometry.mesh
    at_origin = np.isclose(mesh.vertices_m[mesh.faces], 0, atol=1e-6).all(axis=-1)
    assert at_origin.sum() == 6
    np.testing.assert_allclose(look.uv[at_origin], [(0.25, 0.25)] * 6)


def test_texture_without_coordinates_becomes_its_mean_colour() -> None:
    halves = [[(255, 0, 0)] * 2, [(0, 0, 255)] * 2]
    scene = scene_of(
        '<asset><texture name="t" type="2d" file="t.png"/><material name="m" texture="t" rgba="1 1 0.5 1"/></asset>'
        '<worldbody><body name="a"><geom type="box" size="1 1 1" material="m"/></body></worldbody>',
        {"t.png": png(halves)},
    )
    look = scene.object("a").appearance
    assert look is not None
    assert look.uv is None
    assert look.materials[0].texture is None
    assert look.materials[0].color_rgba == pytest.approx((0.5, 0, 0.25, 1))
