"""Colour table of the renderers: materials, nearest texels of textures, glass, cut-outs, and light."""

from __future__ import annotations

import numpy as np
import pytest

from scene2hap.scene.capture.colour_table import AMBIENT, HEADLIGHT, SKYLIGHT, Palette, PaletteBuilder, light, neutral
from scene2hap.scene.looks.appearance import FaceMaterial


def palette_of(*materials: FaceMaterial) -> Palette:
    builder = PaletteBuilder()
    for number, material in enumerate(materials):
        assert builder.add(material) == number
    return builder.build()


def texels(*rows: list[tuple[int, ...]]) -> np.ndarray:
    return np.array(rows, dtype=np.uint8)


def test_equal_materials_share_a_row() -> None:
    builder = PaletteBuilder()
    red = (1.0, 0.0, 0.0, 1.0)
    assert [builder.add(FaceMaterial(red)), builder.add(FaceMaterial(red)), builder.add(FaceMaterial())] == [0, 0, 1]
    assert len(builder.keys) == 2


def test_texture_coordinates_start_in_the_upper_left_and_repeat() -> None:
    checker = texels([(10, 0, 0), (20, 0, 0)], [(30, 0, 0), (40, 0, 0)])
    palette = palette_of(FaceMaterial(), FaceMaterial((1, 1, 1, 1), checker))
    uv = np.array([(0.1, 0.1), (0.9, 0.1), (0.1, 0.9), (0.9, 0.9), (1.1, -0.1), (1.0, 1.0), (np.nan, 0.0)], np.float32)
    pattern = palette.pattern(np.full(len(uv), 1, np.int32), uv)
    np.testing.assert_allclose(pattern[:, 0] * 255, [10, 20, 30, 40, 30, 10, 10], atol=1e-4)
    assert palette.is_patterned.tolist() == [False, True]


def test_large_textures_are_shrunk_by_averaging() -> None:
    stripes = np.zeros((1024, 2, 3), np.uint8)
    stripes[::2] = 200
    palette = palette_of(FaceMaterial((1, 1, 1, 1), stripes))
    assert palette.height.tolist() == [512]
    assert set(palette.texels[:, 0].tolist()) == {100}


def test_glass_is_drawn_pale_and_opaque() -> None:
    palette = palette_of(FaceMaterial((0.0, 0.0, 0.0, 0.25)), FaceMaterial((0.0, 0.0, 0.0, 1.0)))
    assert palette.rgb[0] == pytest.approx([0.75 * 0.85] * 3)
    assert palette.rgb[1] == pytest.approx([0.0] * 3)
    assert not palette.is_cutout.any()


def test_a_texture_with_holes_is_a_cutout_and_a_faint_one_is_not() -> None:
    leaf = texels([(0, 90, 0, 255), (0, 0, 0, 0)])
    faint = texels([(0, 90, 0, 60), (0, 90, 0, 60)])
    palette = palette_of(FaceMaterial((1, 1, 1, 1), leaf), FaceMaterial((1, 1, 1, 1), faint))
    assert palette.is_cutout.tolist() == [True, False]


def test_light_depends_on_the_side_seen_and_not_on_the_winding() -> None:
    forward, up = np.array([0.0, -1.0, 0.0]), np.array([0.0, 1.0, 0.0])
    faces = np.array([(0, 1, 0), (0, -1, 0), (1, 0, 0)], np.float32)
    # Seen from above, a level face shows its upper side for both windings.
    expected = [AMBIENT + HEADLIGHT + SKYLIGHT] * 2 + [AMBIENT]
    np.testing.assert_allclose(light(faces, forward, up), expected, rtol=1e-6)
    from_below = AMBIENT + HEADLIGHT - SKYLIGHT
    np.testing.assert_allclose(light(faces[:2], -forward, up), [from_below] * 2, rtol=1e-6)


def test_neutral_colour_depends_only_on_the_key() -> None:
    paints = {neutral(key).color_rgba for key in ("cup", "plate", "pan", "pot")}
    assert len(paints) == 4
    assert neutral("cup").color_rgba == neutral("cup").color_rgba
    assert all(max(paint[:3]) - min(paint[:3]) < 0.25 for paint in paints)
