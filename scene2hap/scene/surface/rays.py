"""Parallel rays against triangles: the points where a grid of rays enters and leaves a mesh, and widths of sections.

The mesh is given in a frame whose third axis is the direction of the rays. So casting is rasterisation: each triangle
is drawn onto the grid once, and a sort along every ray replaces a search tree.

Letters: u, v across the rays and w along them [m]; n rays per side [-]. Triangles are arrays (3, 3, m) of coordinate,
corner and triangle, since vectorised arithmetic is fastest along the last axis.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from scene2hap.common.arrays import Bools, Floats, Ints
from scene2hap.scene.geometry import counted_up

# Pairs of triangle and ray that are tested at once. This bounds memory to about 100 MB (assumed).
_MAX_PAIRS = 1_000_000
# Most pairs in all: this many layers on every ray, and this many pairs per triangle. Meshes with more are not measured
# (assumed: ten times the densest foliage, and some seconds).
_MAX_LAYERS, _MAX_PAIRS_PER_TRIANGLE = 1000, 4
# Greatest offset of a ray from the centre of its cell, in cells. Without it, rays would run along the diagonals of
# quads and meet both triangles or none. The fractions are powers of the plastic number, which fill the plane evenly.
_JITTER = 0.25
# The pattern is its own mirror image, so that a mesh has the same measures whichever way its axes point.
_PLASTIC = (0.7548776662466927, 0.5698402909980532)
# A label is a face without a back at most this far in front of a face that looks the same way [m] (assumed: authors
# lift decals by 0.1 to 1 mm, so that both faces do not flicker).
_LABEL_M = 1e-3
# A mesh whose width is at most this share of its length counts as a line: rounding alone makes it that wide.
_EDGE_ON = 1e-12


@dataclass(frozen=True)
class Hits:
    """The hits of rays on triangles, sorted by ray and then by falling w.

    Parameters: ray : (n_hits,) number of the ray; w : (n_hits,) [m]; side : (n_hits,) +1 if the triangle faces against
        the ray as seen from above, -1 if it faces along it.
    """

    ray: Ints
    w: Floats
    side: Ints

    @cached_property
    def starts(self) -> Ints:
        """Index of the first hit of each ray that has a hit (n_rays,)."""
        return np.flatnonzero(np.diff(self.ray, prepend=-1))


def cast_grid(triangles: Floats, n: int, spend: Callable[[int], None] = lambda n_pairs: None) -> Hits:
    """Return hits of n x n rays that run along w through the bounding rectangle of triangles (3, 3, m) [m].

    There are no hits for a line, or for more than some thousand layers of triangles. `spend` is called with the number
    of ray-triangle pairs before they are tested, and may raise to prevent the tests.
    """
    ray, w, side, _ = _hits(triangles, n, spend)
    return Hits(ray, w, side)


def free_space(triangles: Floats, n: int, spend: Callable[[int], None]) -> Floats:
    """Return how much more free space is before each of the triangles (3, 3, m) than behind it [m3].

    It sums, over the hits of n x n rays along w, the way to the next surface before the triangle less the way behind.
    """
    ray, w, side, triangle = _hits(triangles, n, spend)
    extent_m = np.ptp(triangles, axis=(1, 2))
    is_within = np.diff(ray, prepend=-1, append=-1) == 0
    gap_m = np.where(is_within, -np.diff(w, prepend=0.0, append=0.0), 2 * float(extent_m.max()))
    free_m = np.bincount(triangle, side * (gap_m[:-1] - gap_m[1:]), minlength=triangles.shape[2])
    free_m3: Floats = free_m * float(np.prod(extent_m[:2])) / n**2
    return free_m3


def _hits(triangles: Floats, n: int, spend: Callable[[int], None]) -> tuple[Ints, Floats, Ints, Ints]:
    """Return the ray, w, side and triangle of each hit, in the order of `Hits`."""
    none = np.empty(0, np.int64)
    corners = triangles.reshape(3, -1)
    low = corners.min(axis=1)
    size = corners.max(axis=1) - low
    low, extent = low[:2], size[:2]
    if (extent <= _EDGE_ON * size.max()).any():
        return none, np.empty(0), none, none
    cells = (triangles[:2] - low[:, None, None]) * (n / extent)[:, None, None]
    a, b, c = cells[:, 0], cells[:, 1], cells[:, 2]
    # Twice the signed area; edge-on triangles meet no ray.
    area = _cross(b - a, c - a)
    first = np.ceil(np.minimum(np.minimum(a, b), c) - (0.5 + _JITTER)).astype(np.int64).clip(0)
    last = np.floor(np.maximum(np.maximum(a, b), c) - (0.5 - _JITTER)).astype(np.int64).clip(None, n - 1)
    span = (last - first + 1).clip(0) * (area != 0)
    pairs = span[0] * span[1]
    if pairs.sum() > _MAX_LAYERS * n * n + _MAX_PAIRS_PER_TRIANGLE * len(pairs):
        return none, np.empty(0), none, none
    spend(int(pairs.sum()))
    drawn = np.flatnonzero(pairs)
    breaks = np.flatnonzero(np.diff(np.cumsum(pairs[drawn]) // _MAX_PAIRS)) + 1
    found = [
        _draw(cells[:, :, some], triangles[2][:, some], area[some], first[:, some], span[:, some], some, n)
        for some in np.split(drawn, breaks)
    ]
    ray, w, side, triangle = (np.concatenate(columns) for columns in zip(*found, strict=True))
    order = np.lexsort((-w, ray))
    return ray[order], w[order], side[order], triangle[order]


def _draw(
    cells: Floats, w: Floats, area: Floats, first: Ints, span: Ints, triangle: Ints, n: int
) -> tuple[Ints, Floats, Ints, Ints]:
    """Return rays, heights, sides and triangles of the hits of some triangles, unsorted; u and v are in cells of the
    grid."""
    pairs = span[0] * span[1]
    which, nth = counted_up(pairs)
    across = span[1][which]
    i = first[0][which] + nth // across
    j = first[1][which] + nth % across
    ray = i * n + j
    mirrored = np.minimum(i, n - 1 - i) * n + np.minimum(j, n - 1 - j)
    at = np.stack((_off_centre(i, mirrored, _PLASTIC[0], n), _off_centre(j, mirrored, _PLASTIC[1], n)))
    a, b, c = cells[:, 0, which], cells[:, 1, which], cells[:, 2, which]
    weight_a = _cross(c - b, at - b) / area[which]
    weight_c = _cross(b - a, at - a) / area[which]
    weight_b = 1 - weight_a - weight_c
    inside = np.flatnonzero((weight_a >= 0) & (weight_b >= 0) & (weight_c >= 0))
    which = which[inside]
    height = weight_a[inside] * w[0][which] + weight_b[inside] * w[1][which] + weight_c[inside] * w[2][which]
    return ray[inside], height, np.where(area[which] > 0, 1, -1), triangle[which]


def _off_centre(cell: Ints, mirrored: Ints, fraction: float, n: int) -> Floats:
    off = _JITTER * (2 * np.modf((mirrored + 1) * fraction)[0] - 1)
    place: Floats = cell + 0.5 + np.where(2 * cell < n, off, -off)
    return place


@dataclass(frozen=True)
class Solids:
    """The first solid that each ray meets from above.

    Parameters: top, bottom : (n_rays,) [m] where the ray enters and leaves; bottom is NaN if there is no second hit.
    """

    top: Floats
    bottom: Floats


def first_solids(hits: Hits, tolerance: float) -> Solids:
    """Follow each ray from above until it leaves the first solid, with a winding number that counts faces.

    The winding number joins parts that overlap (legs that extend into a table top) to one solid. Surfaces closer than
    `tolerance` [m] are one. A sheet drawn from both sides is ignored if a solid follows, else it is a solid of no
    thickness. Labels are ignored. If the number never returns to zero (inconsistent faces, or an open mesh), the solid
    ends at the second surface.
    """
    if not len(hits.ray):
        return Solids(hits.w, hits.w)
    new_ray = np.zeros(len(hits.ray), dtype=bool)
    new_ray[hits.starts] = True
    layers = np.flatnonzero(new_ray | (-np.diff(hits.w, prepend=np.inf) > tolerance))
    w = hits.w[layers]
    side = np.add.reduceat(hits.side, layers)
    start = np.flatnonzero(new_ray[layers])
    stop = np.append(start[1:], len(layers))
    side = np.where(_are_labels(w, side, start, stop), 0, side)
    before = np.cumsum(side) - side
    is_out = before + side == np.repeat(before[start], stop - start)

    entered = _next(~is_out, start)
    has_solid = entered < stop
    left = _next(is_out, np.minimum(entered + 1, stop))
    left = np.where(left < stop, left, np.where(entered + 1 < stop, entered + 1, len(w)))
    top = np.where(has_solid, entered, start)
    return Solids(w[top], np.append(w, np.nan)[np.where(has_solid, left, start)])


def _are_labels(w: Floats, side: Ints, start: Ints, stop: Ints) -> Bools:
    """Mark the layers (n,) that are labels: the outer of two near faces that look the same way, one without a back."""
    net = np.repeat(np.add.reduceat(side, start), stop - start)
    is_first = np.repeat(side[start] * net[start] > 0, stop - start)
    is_pair = (side[1:] == side[:-1]) & (side * net > 0)[1:] & (w[:-1] - w[1:] <= _LABEL_M)
    is_pair[start[1:] - 1] = False
    upper, lower = np.append(is_pair, [False]), np.append([False], is_pair)
    return np.where(is_first, upper, lower)


def _next(is_wanted: Bools, start: Ints) -> Ints:
    """Return the first wanted index from each `start` on; the length of `is_wanted` if none follows."""
    places = np.append(np.flatnonzero(is_wanted), len(is_wanted))
    return places[np.searchsorted(places, start)]


def share_open(hits: Hits) -> float:
    """Return the share of rays for which the numbers of entered and left faces differ [-]."""
    return float(np.mean(np.add.reduceat(hits.side, hits.starts) != 0)) if len(hits.ray) else 0.0


def cut(triangles: Floats, height: float) -> Floats:
    """Return segments (2, 2, n) [m], by coordinate and end, where triangles (3, 3, m) cross the plane w = height."""
    above = triangles[2] > height
    n_above = above.sum(axis=0)
    crossing = np.flatnonzero((n_above == 1) | (n_above == 2))
    # One corner is alone on its side of the plane. Both edges that cross the plane end in it.
    alone = np.argmax(above[:, crossing] == (n_above[crossing] == 1), axis=0)
    tip = triangles[:, alone, crossing]
    ends = [triangles[:, (alone + k) % 3, crossing] for k in (1, 2)]
    return np.stack([(tip + (end - tip) * ((height - tip[2]) / (end[2] - tip[2])))[:2] for end in ends], axis=1)


def edges_seen(triangles: Floats) -> Floats:
    """Return edges (2, 2, 3 m) [m], by coordinate and end, of triangles (3, 3, m), seen along w."""
    flat = triangles[:2]
    return np.stack((flat.reshape(2, -1), np.roll(flat, -1, axis=1).reshape(2, -1)), axis=1)


def median_span(segments: Floats, along: int, n: int) -> tuple[float, float] | None:
    """Return median extent and median middle [m] of the chords of n rays in the plane of the segments (2, 2, k).

    The rays run along coordinate `along` at equal distances on the other one. None if no ray meets anything.
    """
    across = segments[1 - along]
    low, high = across.min(initial=np.inf), across.max(initial=-np.inf)
    if not high > low:
        return None
    row = low + (high - low) * (np.arange(n) + 0.5) / n
    # A segment crosses a run of rows: from `first` up to, but not including, `last`.
    first, last = np.searchsorted(row, across.min(axis=0)), np.searchsorted(row, across.max(axis=0))
    which, nth = counted_up(last - first)
    met_row = first[which] + nth
    ahead, aside = segments[along][:, which], across[:, which]
    place = ahead[0] + (ahead[1] - ahead[0]) * ((row[met_row] - aside[0]) / (aside[1] - aside[0]))
    start, end = np.full(n, np.inf), np.full(n, -np.inf)
    np.minimum.at(start, met_row, place)
    np.maximum.at(end, met_row, place)
    start, end = start[end >= start], end[end >= start]
    if not len(start):
        return None
    return float(np.median(end - start)), float(np.median(end + start)) / 2


def _cross(a: Floats, b: Floats) -> Floats:
    product: Floats = a[0] * b[1] - a[1] * b[0]
    return product
