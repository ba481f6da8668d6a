"""The library's PNG files, read by Pillow."""

from __future__ import annotations

from io import BytesIO

import numpy as np
from hypothesis import given, strategies as st
from hypothesis.extra.numpy import array_shapes, arrays
from PIL import Image

from scene2hap.scene.capture.png import png

PICTURES = array_shapes(min_dims=2, max_dims=2, max_side=20).flatmap(lambda size: arrays(np.uint8, (*size, 3)))


def read(file: bytes) -> np.ndarray:
    with Image.open(BytesIO(file)) as image:
        image.verify()
    with Image.open(BytesIO(file)) as image:
        assert (image.format, image.mode) == ("PNG", "RGB")
        return np.asarray(image)


@given(PICTURES)
def test_png_round_trip_keeps_every_pixel(picture: np.ndarray) -> None:
    np.testing.assert_array_equal(read(png(picture)), picture)


@given(PICTURES, st.booleans())
def test_array_view_is_encoded_like_its_copy(picture: np.ndarray, turned: bool) -> None:
    view = picture.transpose(1, 0, 2) if turned else picture[::-1]
    assert png(view) == png(view.copy())


def test_plain_and_shaded_pictures_are_small() -> None:
    plain = np.full((512, 512, 3), 190, np.uint8)
    shaded = np.broadcast_to((np.arange(512) // 2).astype(np.uint8)[None, :, None], (512, 512, 3))
    for picture in (plain, shaded):
        assert len(png(picture)) < 0.02 * picture.size
        np.testing.assert_array_equal(read(png(picture)), picture)
