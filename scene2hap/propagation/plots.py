"""Map of a source's gain over a plate. Needs the extra `plots`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap.common import checks
from scene2hap.common.plots import add_legend, new_figure, plain, set_title
from scene2hap.errors import ModelDomainError
from scene2hap.propagation.plate import Plate
from scene2hap.propagation.points import as_points
from scene2hap.propagation.protocol import ContactNetwork, PropagationField

if TYPE_CHECKING:
    from matplotlib.figure import Figure

RANGE_DB = 40.0
"""Range of the colours below the loudest place [dB]."""
CELLS = 64
"""Cells of the map along the longer side."""


def plot_field(
    field: PropagationField,
    network: ContactNetwork,
    object_id: str,
    *,
    source_id: str | None = None,
    band: int = 0,
    touch_m: ArrayLike | None = None,
    title: str = "",
) -> Figure:
    """Draw the attenuation over a plate as a map in dB, within its outline, with contacts of the source and a touch.

    Parameters: field : prepared from `network`, by any model; object_id : a plate of the network; source_id : one of
    the field's sources, by default the first; band : index of the field's band; touch_m : (3,) or (n, 3) [m], world.
    Returns: a matplotlib Figure, made without pyplot.
    Raises: MissingExtra: matplotlib is not installed. ModelDomainError: no plate of that id, no such source or
    band, or a field without sources.
    """
    plate = network.bodies.get(object_id)
    if not isinstance(plate, Plate):
        plates = sorted(key for key, body in network.bodies.items() if isinstance(body, Plate))
        raise ModelDomainError(f"object {object_id!r} is no plate of this network; its plates are {plates}.")
    if not field.source_ids:
        raise ModelDomainError("the field has no source, so there is nothing to draw; prepare it with an Excitation.")
    source = field.source_ids[0] if source_id is None else source_id
    if source not in field.source_ids:
        raise ModelDomainError(f"source {source!r} is none of this field's; they are {list(field.source_ids)}.")
    gains = _map(field, network, object_id, plate)
    last = gains.shape[3] - 1
    chosen = checks.whole("band", band, "-", at_least=0, at_most=last, error=ModelDomainError)
    drawn = gains[:, :, field.source_ids.index(source), chosen]
    loudest = 20 * math.log10(np.nanmax(drawn, initial=0.0) or 1.0)  # where nothing arrives, the source's own level
    level_db = 20 * np.log10(np.maximum(drawn, 1e-30))

    figure = new_figure(7.5, 1.4 + 5.5 * min(1.2, max(0.25, plate.width_m / plate.length_m)))
    axes = figure.add_subplot()
    image = axes.imshow(
        level_db.T, origin="lower", extent=(0, plate.length_m, 0, plate.width_m), cmap="viridis",
        vmin=loudest - RANGE_DB, vmax=loudest, interpolation="bilinear" if plate.outline is None else "nearest",
    )  # fmt: skip
    figure.colorbar(image, ax=axes, label="attenuation [dB]", shrink=0.8)
    feet = _feet(network, object_id, source)
    marks = axes.plot(*feet.T, "o", color="white", markeredgecolor="black")
    if touch_m is not None:
        touched = network.on_body(object_id, as_points(touch_m, 3))
        marks += axes.plot(*touched.T, "X", color="tab:red", markeredgecolor="white", markersize=10)
    axes.set(xlabel="length [m]", ylabel="width [m]")
    set_title(axes, plain(title, 120) if title else f"{plain(source)} on {plain(object_id)}")
    add_legend(axes, marks, [f"{plain(source)} rests here", "touch"][: len(marks)], loc="upper right")
    return figure


def _map(field: PropagationField, network: ContactNetwork, object_id: str, plate: Plate) -> NDArray[np.float64]:
    """Gains at the centres of cells (n_x, n_y, n_sources, n_bands), NaN beside the plate's outline."""
    longer = max(plate.length_m, plate.width_m)
    x, y = (
        (np.arange(n) + 0.5) / n * side
        for side in (plate.length_m, plate.width_m)
        for n in (max(4, math.ceil(CELLS * side / longer)),)
    )
    points = np.stack([*np.meshgrid(x, y, indexing="ij"), np.zeros((len(x), len(y)))], axis=-1).reshape(-1, 3)
    pose = network.poses.get(object_id)
    gains = field.attenuation(object_id, points if pose is None else pose.to_world(points))
    if plate.outline is not None:
        gains = np.where(plate.outline.holds(points[:, :2])[:, None, None], gains, np.nan)
    return gains.reshape(len(x), len(y), *gains.shape[1:])


def _feet(network: ContactNetwork, object_id: str, source_id: str) -> NDArray[np.float64]:
    points = [one.point_m for one in network.contacts if {one.a, one.b} == {object_id, source_id}]
    return network.on_body(object_id, points) if points else np.empty((0, 2))
