"""Primitive shapes as triangles that face outwards, in their own frame [m].

Round shapes are inscribed: their corners are on the true surface, and the middle of a face is up to 0.5 % of the radius
below it. Along x, y and z they have the extent of the true shape.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from scene2hap.common.arrays import Floats, Ints32
from scene2hap.scene.shapes import Box

SIDES = 32
"""Corners around a round shape; a multiple of 4 (tuned: a mug's rim off by 0.2 mm)."""

Triangles = tuple[Floats, Ints32]
"""Vertices (n, 3) float64 and faces (m, 3) int32."""


def box(half_m: ArrayLike) -> Triangles:
    """Return a cuboid with half edges (3,) along x, y, z."""
    x, y, z = 2 * np.asarray(half_m, dtype=np.float64)
    mesh = Box((x, y, z)).mesh
    return mesh.vertices_m, mesh.faces


def ellipsoid(half_m: ArrayLike) -> Triangles:
    """Return an ellipsoid with half axes (3,) along x, y, z; a sphere if they are equal."""
    angles = np.linspace(-np.pi / 2, np.pi / 2, SIDES // 2 + 1)[1:-1]
    vertices, faces = _turned(np.cos(angles), np.sin(angles), -1.0, 1.0)
    return vertices * np.asarray(half_m, dtype=np.float64), faces


def cylinder(radius_m: float, half_length_m: float, top_radius_m: float | None = None) -> Triangles:
    """Return a closed cylinder along z; with another radius at its top, a truncated cone."""
    rims = np.array([-half_length_m, half_length_m])
    radii = np.array([radius_m, radius_m if top_radius_m is None else top_radius_m])
    return _turned(radii, rims, -half_length_m, half_length_m)


def cone(radius_m: float, half_length_m: float) -> Triangles:
    """Return a closed cone along z, its base below and its tip above."""
    return _turned(np.array([radius_m]), np.array([-half_length_m]), -half_length_m, half_length_m)


def capsule(radius_m: float, half_length_m: float, top_radius_m: float | None = None) -> Triangles:
    """Return a cylinder or truncated cone along z with half spheres at its ends, beyond its half length."""
    top_m = radius_m if top_radius_m is None else top_radius_m
    angles = np.linspace(0.0, np.pi / 2, SIDES // 4 + 1)[:-1]
    out, up = np.cos(angles), np.sin(angles)
    radii = np.concatenate((radius_m * out[::-1], top_m * out))
    heights = np.concatenate((-half_length_m - radius_m * up[::-1], half_length_m + top_m * up))
    return _turned(radii, heights, -half_length_m - radius_m, half_length_m + top_m)


def rectangle(half_x_m: float, half_y_m: float) -> Triangles:
    """Return a sheet in the x-y plane without thickness, facing +z."""
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=np.float64)
    return corners * [half_x_m, half_y_m, 1.0], np.array([[0, 1, 2], [0, 2, 3]], dtype=np.int32)


def terrain(heights_m: Floats, half_x_m: float, half_y_m: float) -> Triangles:
    """Return a sheet of heights (n_rows, n_columns) over the x-y plane, rows along y, facing up."""
    n_rows, n_columns = heights_m.shape
    y, x = np.meshgrid(
        np.linspace(-half_y_m, half_y_m, n_rows), np.linspace(-half_x_m, half_x_m, n_columns), indexing="ij"
    )
    number = np.arange(heights_m.size, dtype=np.int32).reshape(heights_m.shape)
    a, b, c, d = number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]
    faces = np.stack((a, b, c, a, c, d), axis=-1).reshape(-1, 3)
    return np.stack((x, y, heights_m), axis=-1).reshape(-1, 3), faces


def _turned(radii: Floats, heights: Floats, bottom: float, top: float) -> Triangles:
    """Return the surface of a profile rotated about z: rings of radii (k,) at rising heights (k,) between two tips."""
    k, angles = len(radii), np.arange(SIDES) * (2 * np.pi / SIDES)
    rings = np.stack(
        (np.outer(radii, np.cos(angles)), np.outer(radii, np.sin(angles)), np.repeat(heights[:, None], SIDES, axis=1)),
        axis=-1,
    )
    vertices = np.concatenate((rings.reshape(-1, 3), [[0.0, 0.0, bottom], [0.0, 0.0, top]]))
    number = np.arange(k * SIDES, dtype=np.int32).reshape(k, SIDES)
    after = np.roll(number, -1, axis=1)
    a, b, c, d = number[:-1], after[:-1], after[1:], number[1:]
    low, high = np.full(SIDES, k * SIDES), np.full(SIDES, k * SIDES + 1)
    faces = np.concatenate(
        (
            np.stack((a, b, c, a, c, d), axis=-1).reshape(-1, 3),
            np.stack((low, after[0], number[0]), axis=-1),
            np.stack((high, number[-1], after[-1]), axis=-1),
        )
    )
    return vertices, faces.astype(np.int32)
