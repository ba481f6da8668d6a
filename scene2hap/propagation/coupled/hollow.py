"""The plate of a hollow object: no heavier than the object itself.

    h' = min(h, m / (rho A))

Two sheets at a distance h that hold together bend like nearly the whole thickness, each for itself like half of h'.
The stiffness of one sheet of h' lies between, at half the mass close to the geometric mean of both.

Letters: h [m] thickness of the object's surface, h' [m] of the plate, m [kg], rho [kg/m3], A [m2] area.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

from scene2hap.propagation.plate import Plate

ESTIMATE = 2.0
"""A solid plate may weigh so many times the estimated mass of its object. Of the lexicon's masses, 84 to 100 % are
within this factor (docs/figures/inference.md); beyond it the measured thickness is that of a hollow object."""

THINNEST = 0.01
"""Least part of the measured thickness; a shell of 0.7 mm around 0.07 m. A mass that asks for less is rather a mistake.
Assumed."""


@lru_cache(maxsize=4096)
def no_heavier_than_object(plate: Plate) -> Plate:
    """Return a free plate, made as thin as the mass of its object requires, within `THINNEST`.

    One that is held at an edge does not move as a whole, and is left as it is.
    """
    if plate.object_mass_kg is None or plate.edges != "FFFF":
        return plate
    most_kg = plate.object_mass_kg * (ESTIMATE if plate.mass_is_estimate else 1.0)
    if plate.mass_kg <= most_kg:
        return plate
    return replace(plate, thickness_m=plate.thickness_m * max(most_kg / plate.mass_kg, THINNEST))
