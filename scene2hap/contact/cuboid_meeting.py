"""Distance and contact points of pairs of cuboids, leaning or not: `MeshPair` in closed form, for many pairs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from scene2hap.contact.body import Body
from scene2hap.contact.cuboid_patch import patches
from scene2hap.contact.cuboids import Pairs, gaps, times
from scene2hap.contact.mesh_distance import ROUNDING_M, Gap
from scene2hap.contact.support import TOUCH_M
from scene2hap.contact.vectors import Floats, Triple, dot

Couple = tuple[Body, Body]


class _Posed:
    """Couples in the frame of the larger, the host; of equals the first. Ways (3, n) [m] are those that each a goes."""

    def __init__(self, couples: Sequence[Couple], ways_m: Floats | None = None) -> None:
        hosts_first = [b.size_m <= a.size_m for a, b in couples]
        self.sign = np.where(hosts_first, 1.0, -1.0)
        a, b = (np.array([_row(couple[k]) for couple in couples]).T for k in (0, 1))
        if ways_m is not None:
            a[9:12] += ways_m
        self.host, guest = np.where(hosts_first, a, b), np.where(hosts_first, b, a)
        self.axes = self.host[:9].reshape(3, 3, -1)
        turn = dot(self.axes[:, :, None], guest[:9].reshape(3, 3, -1)[:, None])
        shift = dot(self.axes, (guest[9:12] - self.host[9:12])[:, None])
        self.pairs = Pairs.of(turn, shift, self.host[12:], guest[12:])


def gaps_of(couples: Sequence[Couple], within_m: float) -> list[Gap | None]:
    """For each couple (a, b) its least distance and the way from a to b, if it is at most `within_m`."""
    found: list[Gap | None] = [None] * len(couples)
    if couples:
        posed = _Posed(couples)
        rows, near = gaps(posed.pairs, max(within_m, ROUNDING_M))
        ways = times(posed.axes[..., rows], (near.way_m * posed.sign[rows])[:, None])[:, 0].T.tolist()
        for row, distance_m, (x, y, z) in zip(rows.tolist(), near.distance_m.tolist(), ways, strict=True):
            found[row] = Gap(distance_m, (x, y, z)) if distance_m > ROUNDING_M else Gap(0.0, (0.0, 0.0, 0.0))
    return found


def points_of(
    couples: Sequence[Couple], ways_m: Sequence[Triple], within_m: Sequence[float]
) -> list[tuple[Triple, ...]]:
    """For each couple (a, b) points half way between the surfaces where they are at most so far apart once a has gone
    its way."""
    found: list[tuple[Triple, ...]] = [()] * len(couples)
    if not couples:
        return found
    ways, reach = np.array(ways_m).T, np.array(within_m)
    posed = _Posed(couples, ways)
    rows, near = gaps(posed.pairs, float(reach.max()))
    close = np.flatnonzero(near.distance_m <= reach[rows])
    rows, near = rows[close], near.rows(close)
    if not len(rows):
        return found
    spots = patches(posed.pairs.rows(rows), near, reach[rows], TOUCH_M)
    placed = posed.host[9:12, rows][:, None] + times(posed.axes[..., rows], spots.points_m) - ways[:, None, rows] / 2
    for row, several, n in zip(
        rows.tolist(), placed.transpose(2, 1, 0).tolist(), spots.counts.sum(axis=0).tolist(), strict=True
    ):
        found[row] = tuple([(x, y, z) for x, y, z in several[:n]])
    return found


def _row(body: Body) -> tuple[float, ...]:
    """Axes, middle and half edges in a row."""
    one, two, three = body.stance.rows
    (mx, my, mz), (x, y, z) = body.shape.middle, body.position_m
    middle = [c + a * mx + b * my + d * mz for c, (a, b, d) in zip((x, y, z), body.stance.rows, strict=True)]
    return (*one, *two, *three, *middle, *body.shape.half)
