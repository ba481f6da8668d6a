"""Cameras: their position, their framing, and agreement of rays and projection."""

from __future__ import annotations

import numpy as np
import pytest

from scene2hap.scene.capture.views import Camera, axes_of, frame

rng = np.random.default_rng(7)
SHAPES = {
    "cube": np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=np.float64),
    "rod": rng.uniform((-5.0, -0.01, -0.01), (5.0, 0.01, 0.01), (50, 3)) + 3.0,
    "sheet": rng.uniform((-1.0, 0.0, -2.0), (1.0, 0.0, 2.0), (50, 3)),
    "tiny": rng.uniform(-1e-3, 1e-3, (50, 3)) + 100.0,
}


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("elevation", [45.0, -45.0])
@pytest.mark.parametrize("fill", [0.6, 0.9])
def test_larger_extent_fills_the_requested_share_and_is_centred(shape: str, elevation: float, fill: float) -> None:
    camera = frame(SHAPES[shape], 30.0, elevation, "y", fill, 400)
    pixels, depth = camera.project(SHAPES[shape])
    extents = np.ptp(pixels, axis=0)
    assert (depth > 0).all()
    assert extents.max() == pytest.approx(fill * 400)
    np.testing.assert_allclose((pixels.min(axis=0) + pixels.max(axis=0)) / 2, 200.0, atol=1e-6)


@pytest.mark.parametrize("up_axis", ["y", "z"])
@pytest.mark.parametrize("elevation", [45.0, -45.0])
def test_camera_has_the_requested_angle_and_up_direction(up_axis: str, elevation: float) -> None:
    right, up, front = axes_of(up_axis)
    camera = frame(SHAPES["cube"], 0.0, elevation, up_axis, 0.75, 100)
    away = camera.eye_m / np.linalg.norm(camera.eye_m)
    assert away @ up == pytest.approx(np.sin(np.deg2rad(elevation)))
    assert away @ front == pytest.approx(np.cos(np.deg2rad(elevation)))
    pixels, _ = camera.project(np.stack((0.1 * up, -0.1 * up, 0.1 * right)))
    assert pixels[0, 1] < pixels[1, 1]
    assert pixels[2, 0] > 50
    np.testing.assert_allclose(np.cross(camera.axes[0], camera.axes[1]), -camera.axes[2], atol=1e-12)


def test_ray_through_a_pixel_inverts_the_projection() -> None:
    camera = frame(SHAPES["cube"], 77.0, 20.0, "y", 0.7, 64)
    numbers = np.array([0, 63, 1000, 4095])
    for offset in ((0.0, 0.0), (0.25, -0.4)):
        points = camera.eye_m + 3.0 * camera.directions(numbers, offset).astype(np.float64)
        pixels, depth = camera.project(points)
        expected = np.stack((numbers % 64 + 0.5 + offset[0], numbers // 64 + 0.5 + offset[1]), axis=1)
        np.testing.assert_allclose(pixels, expected, atol=1e-3)
        np.testing.assert_allclose(depth, 3.0, rtol=1e-5)


def test_widened_camera_keeps_its_position_and_shows_more() -> None:
    camera = frame(SHAPES["cube"], 30.0, 45.0, "y", 0.75, 200)
    wide = camera.widened(2.5)
    np.testing.assert_array_equal(wide.eye_m, camera.eye_m)
    extents = [np.ptp(one.project(SHAPES["cube"])[0], axis=0).max() for one in (camera, wide)]
    assert extents[0] / extents[1] == pytest.approx(2.5)


def test_window_contains_all_points_and_is_full_for_points_behind_the_camera() -> None:
    camera = frame(SHAPES["cube"], 30.0, 45.0, "y", 0.5, 200)
    top, bottom, left, right = camera.window_of(SHAPES["cube"])
    pixels, _ = camera.project(SHAPES["cube"])
    assert left <= pixels[:, 0].min() <= pixels[:, 0].max() <= right
    assert top <= pixels[:, 1].min() <= pixels[:, 1].max() <= bottom
    assert (bottom - top) * (right - left) < 200 * 200
    behind = camera.eye_m - camera.axes[2]
    assert camera.window_of(behind[None]) == (0, 200, 0, 200)


def test_single_pixel_ray_equals_that_of_the_whole_picture() -> None:
    camera = Camera(np.zeros(3), np.eye(3), np.array([0.1, -0.2]), 0.5, 100)
    point = np.array([[0.3, -0.1, 1.0]])
    spot = camera.at_pixel(camera.project(point)[0][0])
    np.testing.assert_allclose(spot.directions(np.array([0]))[0], point[0], atol=1e-6)
