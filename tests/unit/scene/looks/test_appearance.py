"""Appearances: materials, textures, names, and joining the appearances of parts."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

from looks import PIXELS, image_file
from scene2hap.errors import SceneError
from scene2hap.scene.looks.appearance import Appearance, FaceMaterial, joined
from scene2hap.scene.looks.textures import EncodedTexture

RED = (1.0, 0.0, 0.0, 1.0)


def test_a_texture_may_be_pixels_or_a_file() -> None:
    pixels = FaceMaterial(RED, PIXELS)
    encoded = EncodedTexture.checked(image_file(), "wood")
    file = FaceMaterial(RED, encoded)
    assert pixels.texture is PIXELS
    np.testing.assert_array_equal(file.texture, PIXELS)
    assert file.texture is FaceMaterial(texture=encoded).texture
    assert FaceMaterial().texture is None
    assert [material.has_texture for material in (pixels, file, FaceMaterial())] == [True, True, False]


def test_decoded_texture_is_pickled_in_encoded_form() -> None:
    pixels = np.random.default_rng(2).integers(0, 4, (512, 512, 3)).astype(np.uint8)
    materials = [FaceMaterial(RED, texture) for texture in [EncodedTexture.checked(image_file(pixels), "wood")] * 2]
    np.testing.assert_array_equal(materials[0].texture, pixels)
    sent = pickle.dumps(materials)
    assert len(sent) < pixels.nbytes / 2
    first, second = pickle.loads(sent)
    np.testing.assert_array_equal(first.texture, pixels)
    assert first.texture is second.texture
    assert first.digest == materials[0].digest


def test_materials_are_named_by_colour_and_texture() -> None:
    encoded = EncodedTexture.checked(image_file(), "wood")
    other = EncodedTexture.checked(image_file(PIXELS[::-1].copy()), "wood")
    materials = [
        *(FaceMaterial(), FaceMaterial(RED), FaceMaterial(RED, PIXELS), FaceMaterial(RED, PIXELS[::-1])),
        *(FaceMaterial(RED, PIXELS.reshape(1, 4, 3)), FaceMaterial(RED, encoded), FaceMaterial(RED, other)),
    ]
    assert len({material.digest for material in materials}) == len(materials)
    assert FaceMaterial(RED, EncodedTexture.checked(image_file(), "oak")).digest == materials[5].digest
    assert FaceMaterial(RED, PIXELS.copy()).digest == materials[2].digest


def test_tint_multiplies_the_colour_and_keeps_the_texture() -> None:
    tinted = FaceMaterial((1.0, 0.5, 0.5, 1.0), PIXELS).tinted((0.5, 0.5, 1.0, 0.5))
    assert tinted.color_rgba == (0.5, 0.25, 0.5, 0.5)
    assert tinted.texture is PIXELS


def test_parts_share_materials_when_joined() -> None:
    oak, steel = FaceMaterial(RED), FaceMaterial((0.5, 0.5, 0.5, 1.0))
    first = Appearance((oak, steel), np.array([0, 1], np.int32))
    second = Appearance.plain(steel, 1, np.ones((1, 3, 2), np.float32))
    whole = joined([first, None, second], [2, 1, 1])
    assert whole is not None
    assert whole.materials[:2] == (oak, steel)
    assert whole.face_material.tolist() == [0, 1, 2, 1]
    assert whole.uv is not None
    np.testing.assert_array_equal(whole.uv[:, 0, 0], [0.0, 0.0, 0.0, 1.0])
    assert joined([None, None], [2, 1]) is None


def test_arrays_that_do_not_fit_are_refused() -> None:
    with pytest.raises(SceneError, match="beyond the 1 there are"):
        Appearance((FaceMaterial(),), np.array([1], np.int32))
    with pytest.raises(SceneError, match=r"must be \(1, 3, 2\)"):
        Appearance.plain(FaceMaterial(), 1, np.zeros((2, 3, 2), np.float32))
