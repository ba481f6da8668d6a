"""Figure of a bundle: the scene from above with its sources, and the loops of each. Needs the extra `plots`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from scene2hap.audio.plots import draw_loop
from scene2hap.bundle.contents import BundleContents
from scene2hap.common import checks
from scene2hap.common.arrays import Floats
from scene2hap.common.plots import TOUCH, add_legend, new_figure, plain, set_note, set_title
from scene2hap.errors import BundleError
from scene2hap.scene.from_above import NOTHING, TopView
from scene2hap.scene.plots import draw_edges, draw_values

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure, SubFigure

MOST_SOURCES = 8
"""Most sources drawn by default: more do not fit on a page."""
_MOST_LISTED = 24
_CELLS = 320
_MARK_CELLS = 12
"""Distance of sources that share a mark, such as a loudspeaker on another: about the size of a mark."""


def plot_bundle(
    bundle: BundleContents, sources: Sequence[str] | None, up_to_m: float | None, figure: Figure | SubFigure | None
) -> Figure | SubFigure:
    """Draw the plan, and below it a row for each source. See `HapticBundle.plot`."""
    shown = _chosen(bundle, sources)
    n_rows = max(1, len(shown))
    figure = new_figure(10.0, 4.4 + 2.1 * n_rows) if figure is None else figure
    grid = figure.add_gridspec(1 + 2 * n_rows, 2, height_ratios=[4.2, *[1.0] * (2 * n_rows)])
    top = grid[0, :].subgridspec(1, 2, width_ratios=(3.0, 1.0))
    _draw_plan(figure.add_subplot(top[0]), figure.add_subplot(top[1]), bundle, up_to_m)
    if not shown:
        axes = figure.add_subplot(grid[1:, :])
        axes.set_axis_off()
        set_note(axes, "Nothing in this bundle vibrates.")
    for row, object_id in enumerate(shown):
        above, below = (figure.add_subplot(grid[1 + 2 * row + half, 0]) for half in (0, 1))
        spectra = figure.add_subplot(grid[1 + 2 * row : 3 + 2 * row, 1])
        state, loop = next(iter(bundle.loops[object_id].items()))
        frequencies_hz = (loop.frequency_raw_hz, loop.frequency_tactile_hz)
        draw_loop(
            above, below, spectra, loop.audible.samples, loop.tactile.samples, loop.tactile.sample_rate_hz,
            frequencies_hz,
        )  # fmt: skip
        above.tick_params(labelbottom=False)
        above.set(xlabel="", ylabel="sound\n[full scale]")
        below.set_ylabel("vibration\n[full scale]")
        spectra.set_ylabel("level\n[dB re full scale]")
        others = len(bundle.loops[object_id]) - 1
        more = f", first of {others + 1} states" if others else ""
        set_title(above, f"{plain(object_id)} ({plain(state, 16)}{more})")
    return figure


def _chosen(bundle: BundleContents, sources: Sequence[str] | None) -> list[str]:
    """Return the sources to draw. Raises: BundleError: an id is not a source."""
    if sources is None:
        return [key for key, states in bundle.loops.items() if states][:MOST_SOURCES]
    chosen = [sources] if isinstance(sources, str) else checks.items("sources", sources, error=BundleError)
    for object_id in chosen:
        if not isinstance(object_id, str) or not bundle.loops.get(object_id):
            near = checks.did_you_mean(object_id, bundle.loops, "Sources are the objects with loops.")
            raise BundleError(f"no source {checks.represented(object_id)} in this bundle. {near}")
    return list(chosen)


def _marks(middles: Sequence[Floats], apart_m: float) -> list[tuple[str, Floats]]:
    """Return marks with the numbers of the sources, from 1, and their places. Sources less than `apart_m` from the
    first of a mark share this mark."""
    marks: list[tuple[list[str], Floats]] = []
    for k, middle in enumerate(middles, start=1):
        for numbers, place in marks:
            if np.linalg.norm(middle - place) < apart_m:
                numbers.append(str(k))
                break
        else:
            marks.append(([str(k)], middle))
    return [(", ".join(numbers), place) for numbers, place in marks]


def _draw_plan(axes: Axes, beside: Axes, bundle: BundleContents, up_to_m: float | None) -> None:
    """Draw surfaces by their height above the lowest point, darker if lower; number the sources, and list them."""
    from matplotlib.lines import Line2D

    scene = bundle.snapshot
    view = TopView.of(scene, _CELLS, up_to_m)
    height = np.where(view.top == NOTHING, np.nan, view.height_m)
    height -= min(float(item.bounds_m[0, view.up]) for item in scene.objects)
    highest = 1e-3 if np.isnan(height).all() else max(float(np.nanmax(height)), 1e-3)
    # Keep the highest surface darker than a white page, and the lowest one lighter than black.
    image = draw_values(axes, view, height, cmap="Greys_r", vmin=-0.3 * highest, vmax=1.15 * highest)
    bar = axes.figure.colorbar(image, ax=axes, label="height of the surface [m]", shrink=0.85)
    bar.ax.set_ylim(0.0, highest)
    draw_edges(axes, view, colors="black", linewidths=0.4)
    sources = [key for key, states in bundle.loops.items() if states]
    number = {item.id: k for k, item in enumerate(scene.objects)}
    is_source = np.isin(view.top, [number[key] for key in sources])
    draw_edges(axes, view, is_source, colors=TOUCH, linewidths=1.6)
    middles = [scene.object(key).bounds_m.mean(axis=0)[list(view.level)] for key in sources]
    for numbers, (x, y) in _marks(middles, _MARK_CELLS * view.cell_m):
        mark = {"boxstyle": "round,pad=0.25", "facecolor": TOUCH, "edgecolor": "white"}
        axes.annotate(numbers, (x, y), color="white", fontsize=7, ha="center", va="center_baseline", bbox=mark)
    handles = [Line2D([], [], marker="o", linestyle="none", color=TOUCH) for _ in sources]
    labels = [f"{k}  {plain(key, 28)}" for k, key in enumerate(sources, start=1)]
    if handles:
        more = len(handles) - _MOST_LISTED
        title = f"sources ({more} more not listed)" if more > 0 else "sources"
        add_legend(beside, handles[:_MOST_LISTED], labels[:_MOST_LISTED], title=title, loc="center")
    beside.set_axis_off()
    below = ", below the ceiling" if view.is_uncovered else ""
    set_title(axes, f"{plain(scene.name)} from above{below}")
