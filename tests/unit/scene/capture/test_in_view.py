"""Culling of triangles: no culled triangle covers a pixel for any camera, checked with the rasteriser."""

from __future__ import annotations

from importlib import import_module

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from host import rasteriser_problem
from scene2hap.scene.capture.panda3d_in_view import extents, in_view
from scene2hap.scene.capture.views import Camera, frame

CENTRE = frame(np.array([(-1.0, -1, -1), (1, 1, 1)]), 20.0, 30.0, "y", 0.8, 64)


def visible(triangles: np.ndarray, camera: Camera) -> np.ndarray:
    by_axis = np.ascontiguousarray(triangles.astype(np.float32).transpose(2, 1, 0))
    return in_view(extents(by_axis, camera), camera)


def placed(camera: Camera, *corners: tuple[float, float, float]) -> np.ndarray:
    """A triangle (1, 3, 3) whose corners have the given pixels and depths."""
    points = []
    for column, row, depth in corners:
        x = camera.centre[0] + (column / camera.size_px - 0.5) * 2 * camera.half
        y = camera.centre[1] - (row / camera.size_px - 0.5) * 2 * camera.half
        points.append(camera.eye_m + depth * (x * camera.axes[0] + y * camera.axes[1] + camera.axes[2]))
    return np.array([points])


@pytest.mark.parametrize(
    ("corners", "expected"),
    [
        ([(10, 10, 5), (20, 10, 5), (10, 20, 5)], True),
        ([(10.3, 10.3, 5), (10.7, 10.4, 5), (10.5, 10.7, 5)], False),
        ([(10.3, 10.3, 5), (30.7, 10.4, 5), (20.5, 10.7, 5)], False),
        ([(-30, 10, 5), (-5, 10, 5), (-10, 20, 5)], False),
        ([(90, 10, 5), (70, 10, 5), (80, 20, 5)], False),
        ([(-900, -900, 5), (900, -900, 5), (0, 900, 5)], True),
        ([(10, 10, -5), (20, 10, -5), (10, 20, -5)], False),
        ([(10, 10, -5), (20, 10, 5), (10, 20, 5)], True),
    ],
    ids=["plain", "in one pixel", "in one row", "left", "right", "over all", "behind", "through the eye's plane"],
)
def test_triangle_is_visible_if_it_covers_a_pixel(corners: list[tuple[float, float, float]], expected: bool) -> None:
    assert visible(placed(CENTRE, *corners), CENTRE).tolist() == [expected]


def test_extents_are_shared_by_cameras_at_one_position() -> None:
    triangles = np.random.default_rng(0).normal(size=(400, 1, 3)) + np.random.default_rng(1).normal(
        size=(400, 3, 3), scale=0.05
    )
    seen = extents(np.ascontiguousarray(triangles.astype(np.float32).transpose(2, 1, 0)), CENTRE)
    for camera in (CENTRE.widened(2.5), CENTRE.resized(512), CENTRE.at_pixel(np.array([20.0, 30.0]))):
        np.testing.assert_array_equal(in_view(seen, camera), visible(triangles, camera))


@pytest.mark.skipif(bool(rasteriser_problem()), reason=rasteriser_problem())
@settings(max_examples=60)
@given(
    seed=st.integers(0, 2**32 - 1),
    size_m=st.sampled_from([0.01, 0.1, 1.0]),
    azimuth_deg=st.floats(0, 360),
    elevation_deg=st.floats(-80, 80),
    widening=st.sampled_from([0.3, 1.0, 2.5]),
)
def test_culled_triangles_cover_no_pixel(
    seed: int, size_m: float, azimuth_deg: float, elevation_deg: float, widening: float
) -> None:
    screen = import_module("scene2hap.scene.capture.panda3d_screen").Screen(8.0)
    rng = np.random.default_rng(seed)
    triangles = rng.uniform(-2, 2, (300, 1, 3)) + rng.normal(scale=size_m, size=(300, 3, 3))
    target = rng.uniform(-1, 1, (8, 3))
    camera = frame(target, azimuth_deg, elevation_deg, "y", 0.8, 64).widened(widening)
    left_out = triangles[~visible(triangles, camera)]
    corners = np.concatenate((left_out, np.zeros((len(left_out), 3, 2))), axis=2).astype(np.float32)
    colors = np.full((len(corners), 4), 255, np.uint8)
    pixels = screen.draw(camera, corners, colors, [(len(corners), None)], (0, 0, 0))
    assert not pixels.any()
