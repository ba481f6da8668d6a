"""The plate of a hollow object: no heavier than the object itself.

    h' = min(h, m / (rho A))

Two sheets at a distance h that are joined bend nearly as a plate of thickness h; two separate sheets bend as plates of
h'/2 each. The stiffness of one plate of h' is between both; at half the mass it is close to their geometric mean.

Letters: h [m] thickness of the object's surface, h' [m] of the plate, m [kg], rho [kg/m3], A [m2] area.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

from scene2hap.propagation.plate import Plate

ESTIMATE = 2.0
"""Largest mass of a solid plate over the estimated mass of its object. Of the lexicon's masses, 84 to 100 % are within
this factor (docs/figures/inference.md); beyond it the measured thickness is that of a hollow object."""

THINNEST = 0.01
"""Smallest part of the measured thickness, such as a shell of 0.7 mm around 0.07 m; assumed. A mass that requires less
is probably a mistake."""


@lru_cache(maxsize=4096)
def no_heavier_than_object(plate: Plate) -> Plate:
    """Return a free plate as thin as the mass of its object requires, within `THINNEST`.

    A plate that is held at an edge does not move as a whole, and is returned unchanged.
    """
    if plate.object_mass_kg is None or plate.edges != "FFFF":
        return plate
    most_kg = plate.object_mass_kg * (ESTIMATE if plate.mass_is_estimate else 1.0)
    if plate.mass_kg <= most_kg:
        return plate
    return replace(plate, thickness_m=plate.thickness_m * max(most_kg / plate.mass_kg, THINNEST))
