"""Bounds, or axis-aligned boxes: arrays (2, n_axes) of the lowest and the highest corner."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Bounds = NDArray[np.float64]


def bounds_of(points: ArrayLike) -> Bounds:
    """Return the bounds of points (n, n_axes), n >= 1."""
    found = np.asarray(points)
    return np.array([found.min(axis=0), found.max(axis=0)], dtype=np.float64)


def joined(bounds: ArrayLike) -> Bounds:
    """Return the bounds (2, n_axes) of several (n, 2, n_axes), n >= 1."""
    found = np.asarray(bounds, dtype=np.float64)
    return np.array([found[:, 0].min(axis=0), found[:, 1].max(axis=0)])


def distances(a: Bounds, b: Bounds) -> NDArray[np.float64]:
    """Return the distances (...) of boxes a (..., 2, n_axes) from boxes b, broadcast; 0 where they overlap."""
    gaps = np.maximum(np.maximum(a[..., 0, :] - b[..., 1, :], b[..., 0, :] - a[..., 1, :]), 0.0)
    apart: NDArray[np.float64] = np.linalg.norm(gaps, axis=-1)
    return apart
