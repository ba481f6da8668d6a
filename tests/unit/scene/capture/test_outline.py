"""Outlines, against an independent dilation by distance."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.ndimage import distance_transform_edt

from scene2hap.scene.capture.shot_rendering import mark


@pytest.mark.parametrize("width", [1, 2, 4, 7])
@pytest.mark.parametrize("seed", range(3))
def test_outline_covers_pixels_within_its_width(width: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    is_target = rng.random((60, 60)) < 0.01
    is_target[20:30, 55:] = True
    distance = distance_transform_edt(~is_target)
    # A tolerance of half a pixel, since pixels have a size.
    picture = np.zeros((60, 60, 3), np.uint8)
    mark(picture, is_target, width, (255, 0, 190))
    np.testing.assert_array_equal(picture[..., 0] == 255, (distance > 0) & (distance <= width + 0.5))


def test_invisible_target_has_no_outline() -> None:
    picture = np.zeros((8, 8, 3), np.uint8)
    mark(picture, np.zeros((8, 8), bool), 3, (255, 0, 190))
    assert not picture.any()


def test_outline_leaves_the_target_unchanged() -> None:
    picture = np.full((9, 9, 3), 50, np.uint8)
    is_target = np.zeros((9, 9), bool)
    is_target[4, 4] = True
    mark(picture, is_target, 1, (255, 0, 190))
    assert tuple(picture[4, 4]) == (50, 50, 50)
    assert (picture == (255, 0, 190)).all(axis=2).sum() == 8
    assert tuple(picture[2, 2]) == (50, 50, 50)
