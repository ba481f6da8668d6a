"""The frame of a mesh: the axes of the tightest box around it, their order and their signs.

Axes are rows of a matrix (3, 3), in the mesh's own frame.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from scene2hap.common.arrays import Floats, Ints

LIFTED = 0.1
"""Least cosine between the vertical and a normal that is not level (84 degrees; tuned on real scenes)."""

# Tuned on real scenes; a factor of two in any of them matters little.
_OWN_FRAME_GAIN = 0.95  # another frame replaces the author's axes only if its box is smaller than this share
_LIFT_DIGITS = 3  # digits of the cosines between the vertical and axes, by which these are ordered
_SAME_DIRECTION_RAD = np.deg2rad(1.0)
_SIDES_TRIED = 12


def tightest_frame(points: Floats, faces: Ints) -> Floats:
    """Return axes (3, 3), one per row, of the tightest of three boxes around points (3, n) with triangles `faces` (3,
    m).

    The author's own axes are kept unless another box is clearly smaller, since legs and handles tilt any fitted box
    slightly.
    """

    def volume(axes: Floats) -> float:
        size = np.ptp(axes @ points, axis=1)
        return float(np.prod(np.maximum(size, 1e-3 * size.max())))

    own = np.eye(3)
    fitted = min(_fitted_frames(points[:, faces]), key=volume, default=own)
    return fitted if volume(fitted) < _OWN_FRAME_GAIN * volume(own) else own


def _fitted_frames(triangles: Floats) -> Iterator[Floats]:
    """Yield frames that rotate with triangles (3, 3, m): along the principal axes, and along the largest flat faces."""
    b, c = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    doubled = np.stack([b[i - 2] * c[i - 1] - b[i - 1] * c[i - 2] for i in range(3)])
    area = np.sqrt((doubled**2).sum(axis=0))
    with_area = area > 0
    if not with_area.any():
        return
    area, normals = area[with_area], doubled[:, with_area] / area[with_area]
    spread = _surface_spread(triangles[:, :, with_area], area)
    yield np.linalg.eigh(spread)[1].T

    first = _largest_direction(normals, area)
    across = np.flatnonzero(np.abs(first @ normals) < _SAME_DIRECTION_RAD)
    level = np.linalg.svd(first[None])[2][1:]
    if len(across):
        seconds = (level @ _largest_direction(normals[:, across], area[across]))[:, None]
    else:
        # The face of a sheet does not show its rotation, but one of its edges may.
        sides = level @ (np.roll(triangles, -1, axis=1) - triangles).reshape(3, -1)
        longest = sides[:, np.argsort(-np.hypot(*sides), kind="stable")[:_SIDES_TRIED]]
        seconds = np.column_stack((np.linalg.eigh(level @ spread @ level.T)[1], longest[:, longest.any(axis=0)]))
    for second in (seconds / np.hypot(*seconds)).T @ level:
        yield np.stack((first, second, np.cross(first, second)))


def _surface_spread(triangles: Floats, area: Floats) -> Floats:
    """Return the second moments (3, 3) of the surface about its centre, independent of its triangulation.

    integral of x x^T over a triangle = A/12 (a a^T + b b^T + c c^T + s s^T), s = a + b + c.
    """
    weight = area / area.sum()
    centre = (triangles.sum(axis=1) @ weight) / 3
    a, b, c = np.moveaxis(triangles - centre[:, None, None], 1, 0)
    spread: Floats = sum((x * weight) @ x.T for x in (a, b, c, a + b + c)) / 12
    return spread


def _largest_direction(normals: Floats, area: Floats) -> Floats:
    """Return the unit direction that most area faces, from normals (3, m). Opposite directions count as one."""
    strongest = np.abs(normals).argmax(axis=0)
    one_way = normals * np.sign(normals[strongest, np.arange(len(area))])
    cell = np.array([1, 2048, 2048**2]) @ np.round(one_way * 500).astype(np.int64)
    _, group = np.unique(cell, return_inverse=True)
    seed = one_way[:, group == np.bincount(group, area).argmax()].mean(axis=1)
    cosine = (seed / np.linalg.norm(seed)) @ one_way
    direction: Floats = one_way @ (area * np.sign(cosine) * (np.abs(cosine) > np.cos(_SAME_DIRECTION_RAD)))
    return direction / np.linalg.norm(direction)


def facing(axes: Floats, axis: int, points: Floats) -> Floats:
    """Return the axes with `axis` as w, in right-handed order u, v, w, one per row.

    Points (3, n) extend at least as far along u as along v.
    """
    u, v, w = np.roll(axes, 2 - axis, axis=0)
    if np.ptp(v @ points) > np.ptp(u @ points):
        u, v = v, u
    return np.stack((np.cross(v, w), v, w))


def pointing(axes: Floats, upwards: Floats) -> Floats:
    """Return the axes, each signed so that it points up. A level axis points along the author's axes."""
    strongest = axes[np.arange(3), np.abs(axes).argmax(axis=1)]
    lift = axes @ upwards
    sign = np.where(np.abs(lift) > LIFTED, np.sign(lift), np.sign(strongest))
    return axes * sign[:, None]


def by_uprightness(axes: Floats, upwards: Floats) -> list[int]:
    """Return axis numbers, the least upright first. So among equal areas, the most upright axis comes last and wins.

    Axes about as upright as each other keep their order: a tilt of some microradians must not choose another side.
    """
    lift = np.abs(axes @ upwards).round(_LIFT_DIGITS)
    return [int(axis) for axis in np.argsort(lift, kind="stable")]
