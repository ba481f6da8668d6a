"""Points given by callers: their checks, and their positions on a plate."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap.common import checks
from scene2hap.common.arrays import floats
from scene2hap.errors import ModelDomainError
from scene2hap.propagation.plate import Plate, require_plate
from scene2hap.scene.pose import Pose


def as_points(points_m: ArrayLike, dimensions: int) -> NDArray[np.float64]:
    """Convert points to (n_points, dimensions) float64 [m]; a single point may come without outer brackets.

    Raises: ModelDomainError: another shape, or a coordinate that is not finite.
    """
    points = floats("points", points_m, "m", error=ModelDomainError)
    if points.ndim < 2:
        points = points.reshape(1, -1)
    if points.ndim != 2 or points.shape[1] != dimensions:
        raise ModelDomainError(f"points have shape {points.shape}; they must be (n_points, {dimensions}) [m].")
    # A sum of squares is finite only if all its terms are: one quick call is enough, since nearly all points are valid.
    if not math.isfinite(np.vdot(points, points)) and not np.isfinite(points).all():
        raise ModelDomainError("points hold a coordinate that is not finite; every one must be a number [m].")
    return points


def object_points(object_id: object, points_m: ArrayLike) -> NDArray[np.float64]:
    """Convert points on an object to (n_points, 3) float64 [m], see `as_points`.

    Raises: ModelDomainError: also if the id is no text.
    """
    checks.text("object_id", object_id, error=ModelDomainError)
    return as_points(points_m, 3)


def points_on(plate: Plate, points_m: ArrayLike) -> NDArray[np.float64]:
    """Convert points on a plate to (n_points, 2) float64 [m].

    Raises: ModelDomainError: a point outside the plate by more than a millionth of its size: polynomials diverge there.
    """
    require_plate(plate)
    points = as_points(points_m, 2)
    size = np.array([plate.length_m, plate.width_m])
    outside = ((points < -1e-6 * size) | (points > (1 + 1e-6) * size)).any(axis=1)
    if plate.outline is not None:
        outside |= plate.outline.distance_m(points) > 1e-6 * size.max()
    if outside.any():
        x, y = points[outside][0]
        raise ModelDomainError(
            f"point ({x:g}, {y:g}) m lies outside the plate of {plate.length_m:g} × {plate.width_m:g} m"
            f"{'' if plate.outline is None else ', or of its outline'}; points are measured from its corner along "
            "length and width. Move it to the nearest point of the plate."
        )
    return points


class InRectangle:
    """A rectangle in the world, with its corner at `pose`."""

    def __init__(self, pose: Pose, length_m: float, width_m: float) -> None:
        self._corner_m, self._axes = np.array(pose.position_m), pose.rotation[:, :2]
        self._sides_m = np.array([length_m, width_m])

    def __call__(self, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Convert world points (n, 3) to (n, 2) [m] along length and width; those beside it go to its nearest edge."""
        flat: NDArray[np.float64] = (points_m - self._corner_m) @ self._axes
        np.minimum(np.maximum(flat, 0.0, out=flat), self._sides_m, out=flat)
        return flat
