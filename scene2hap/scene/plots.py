"""Axes that show a scene from above. Needs the extra `plots`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from scene2hap.common.arrays import Bools, Floats
from scene2hap.scene.from_above import TopView

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LINES = "0.5"
EMPTY = "0.82"
"""Greys of outlines, and of surfaces without a value. Both are visible on light and dark pages."""


def draw_values(axes: Axes, view: TopView, values: Floats, **options: Any) -> Any:
    """Draw values (n_rows, n_columns) of a view's cells as colours, in metres. NaN is not drawn.

    Parameters: options : of `Axes.imshow`.
    Returns: the image.
    """
    left, right, lower, upper = view.extent_m
    image = axes.imshow(
        np.ma.masked_invalid(values), origin="lower", extent=(left, right, lower, upper), interpolation="nearest",
        **options,
    )  # fmt: skip
    names = ["xyz"[axis] for axis in view.level]
    axes.set(xlabel=f"{names[0]} [m]", ylabel=f"{names[1]} [m]", xlim=(left, right), ylim=(lower, upper))
    if names[1] == "z":  # with y up and x to the right, z points down in a view from above
        axes.invert_yaxis()
    axes.set_aspect("equal")
    return image


def draw_edges(axes: Axes, view: TopView, among: Bools | None = None, **options: Any) -> Any:
    """Draw lines between objects, or around a set of cells (n_rows, n_columns). Returns: the LineCollection."""
    from matplotlib.collections import LineCollection

    return axes.add_collection(LineCollection(list(view.edges_m(among)), **options), autolim=False)
