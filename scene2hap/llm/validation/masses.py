"""Masses from a model or a table, compared with the size of the object."""

from __future__ import annotations

import math
from collections.abc import Sequence

LEAST_DENSITY_KG_M3, MOST_DENSITY_KG_M3 = 0.5, 25_000.0
"""Bounds on mass over volume of the bounding box: a lampshade has some 10, solid tungsten 19,000. Assumed."""


def mass_fault(mass_kg: float, whole_m: Sequence[float]) -> str:
    """Return the reason why an object of this size cannot have this mass; "" if it can.

    Parameters: mass_kg [kg]; whole_m : edges of the box around the object [m]. If an edge is 0, the result is "".
    """
    volume_m3 = math.prod(whole_m)
    if volume_m3 <= 0.0:
        return ""
    low, high = LEAST_DENSITY_KG_M3 * volume_m3, MOST_DENSITY_KG_M3 * volume_m3
    if low <= mass_kg <= high:
        return ""
    size = " by ".join(f"{edge:.3g}" for edge in whole_m)
    return f"{mass_kg:.3g} kg, but a box of {size} m weighs {low:.2g} to {high:.2g} kg"


def bounded_mass_kg(mass_kg: float, whole_m: Sequence[float], density_kg_m3: float) -> float:
    """Return the smaller of a usual mass and the mass of the solid box [kg]: one shelf board weighs less than a shelf.

    Parameters: density_kg_m3 : of the object's material. A box without volume sets no bound.
    """
    return min(mass_kg, math.prod(whole_m) * density_kg_m3 or math.inf)
