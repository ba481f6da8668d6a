"""Map from above of the level at which a hand would feel a source on each surface. Needs the extra `plots`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from scene2hap.common import checks
from scene2hap.common.plots import TOUCH, add_legend, new_figure, plain, set_title
from scene2hap.errors import SessionError
from scene2hap.scene.from_above import NOTHING, TopView
from scene2hap.scene.plots import EMPTY, LINES, draw_edges, draw_values
from scene2hap.scene.snapshot import SceneSnapshot
from scene2hap.session.frame import Touch

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure, SubFigure

_LABEL_IN = 0.5
"""Height of the ticks and the label of an axis [inch]."""
RANGE_DB = 60.0
"""Range of the colours below the highest level [dB]: full scale is 45 dB over the threshold of touch."""
_AT_ONCE = 8192
"""Most points of one query, since a query for a large grid would need large arrays for all sources."""


def plot_felt(
    scene: SceneSnapshot,
    source_id: str,
    hand: str,
    gains_of: Callable[[Sequence[Touch]], NDArray[np.float64]],
    *,
    is_current: bool,
    cells: int,
    up_to_m: float | None,
    axes: Axes | None,
) -> Figure | SubFigure:
    """Colour the uppermost surfaces by level. See `HapticSession.plot_felt`.

    Parameters: gains_of : returns the gains (n_points,) [-] of that source at that hand for touches.
    Raises: SessionError: fewer than 4 cells or more than 2000, or `up_to_m` is no height.
    """
    cells = checks.whole("cells", cells, "-", at_least=4, at_most=2000, error=SessionError)
    if up_to_m is not None:
        up_to_m = checks.number("up_to_m", up_to_m, "m", error=SessionError)
    figure = new_figure(8.0, 5.0) if axes is None else axes.figure
    axes = figure.add_subplot() if axes is None else axes
    from matplotlib.colors import ListedColormap  # after `new_figure`, which says if matplotlib is missing

    view = TopView.of(scene, cells, up_to_m)
    gains = _gains(view, hand, gains_of)
    with np.errstate(divide="ignore"):
        level_db = 20.0 * np.log10(gains)
    level_db[~np.isfinite(level_db)] = np.nan
    draw_values(axes, view, np.where(view.top == NOTHING, np.nan, 1.0), cmap=ListedColormap([EMPTY]), zorder=0)
    highest = 0.0 if np.isnan(level_db).all() else float(np.nanmax(level_db))
    image = draw_values(axes, view, level_db, cmap="viridis", vmin=highest - RANGE_DB, vmax=highest, zorder=1)
    figure.colorbar(image, ax=axes, extend="min", label="level at the hand [dB re the source itself]", shrink=0.9)
    draw_edges(axes, view, colors=LINES, linewidths=0.5, zorder=2)
    _draw_legend(axes, view, source_id, has_silence=bool((np.isnan(level_db) & (view.top != NOTHING)).any()))
    late = "" if is_current else "\n(of an earlier scene state)"
    below = ", below the ceiling" if view.is_uncovered else ""
    set_title(axes, f"{plain(source_id)}, level at the hand '{plain(hand, 16)}'{below}{late}")
    return figure


def _gains(view: TopView, hand: str, gains_of: Callable[[Sequence[Touch]], NDArray[np.float64]]) -> NDArray[np.float64]:
    """Gains (n_rows, n_columns) [-] at the middles of cells, 0 where there is no surface."""
    cells, points_m = view.points_m()
    ids = [item.id for item in view.scene.objects]
    numbers = view.top.ravel()[cells]
    # Points are sorted by object, since a model answers these queries fastest.
    order = np.argsort(numbers, kind="stable")
    places = zip(numbers[order].tolist(), points_m[order].tolist(), strict=True)
    touches = [Touch(hand, ids[number], (x, y, z)) for number, (x, y, z) in places]
    gains = np.zeros(view.top.size)
    for start in range(0, len(touches), _AT_ONCE):
        part = slice(start, start + _AT_ONCE)
        gains[cells[order[part]]] = gains_of(touches[part])
    return gains.reshape(view.top.shape)


def _draw_legend(axes: Axes, view: TopView, source_id: str, *, has_silence: bool) -> None:
    from matplotlib.patches import Patch
    from matplotlib.transforms import ScaledTranslation

    item = view.scene.object(source_id)
    of_source = view.top == next(k for k, one in enumerate(view.scene.objects) if one.id == source_id)
    draw_edges(axes, view, of_source, colors=TOUCH, linewidths=2.0, zorder=3)
    middle = item.bounds_m.mean(axis=0)[list(view.level)]
    (mark,) = axes.plot(*middle, "X", color=TOUCH, markeredgecolor="white", markersize=9, zorder=4)
    handles: list[object] = [mark]
    labels = [plain(source_id)]
    if has_silence:
        handles.append(Patch(facecolor=EMPTY, edgecolor=LINES))
        labels.append("nothing arrives (below -140 dB)")
    # Below the label of the axis, whose distance in inches does not depend on the height of the axes.
    below = axes.transAxes + ScaledTranslation(0.0, -_LABEL_IN, axes.figure.dpi_scale_trans)
    add_legend(axes, handles, labels, loc="upper center", bbox_to_anchor=(0.5, 0.0), bbox_transform=below, ncols=2)
