"""Points at which an object is entered, and what ways from them through the object cost."""

from __future__ import annotations

import math
from collections.abc import Iterable

from scene2hap.compiled import compiled

Triple = tuple[float, float, float]
Entries = list[tuple[Triple, float]]
"""Points at which an object is entered, each with what the way there costs."""


@compiled
def least_cost(entries: Entries, price_per_m: float, point_m: Triple) -> float:
    """What the cheapest way to a point from any of these entries costs, inf for none."""
    # A few dozen entries: plain numbers are faster than numpy's calls.
    return min([cost + price_per_m * math.dist(place, point_m) for place, cost in entries], default=math.inf)


@compiled
def is_within(entries: Entries, price_per_m: float, point_m: Triple, cost: float) -> bool:
    """Whether a point costs no more from one of these entries.

    A straight way through an object is never longer than one by another point, so that such a one leads nowhere new.
    """
    for place, entered_cost in entries:  # noqa: SIM110  # `any` takes twice as long
        if entered_cost + price_per_m * math.dist(place, point_m) <= cost:
            return True
    return False


@compiled
def nearest_m(points_m: Iterable[Triple], point_m: Triple) -> float:
    """How far the nearest of some points is."""
    return min([math.dist(place, point_m) for place in points_m])
