"""How an object counts: as a plate that bends or as a rigid body, and the plate of a hollow object.

A plate is no heavier than its object:

    h' = min(h, m / (rho A))

Two sheets at a distance h that are joined bend nearly as a plate of thickness h; two separate sheets bend as plates of
h'/2 each. The stiffness of one plate of h' is between both; at half the mass it is close to their geometric mean.

Letters: h [m] thickness of the object's surface, h' [m] of the plate, m [kg], rho [kg/m3], A [m2] area.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

from scene2hap.propagation.modal.estimates import beam_hz, first_bending_hz
from scene2hap.propagation.plate import Plate

_THICK = 1 / 5
"""Largest thickness over a side for which thin-plate theory is valid along the side."""
COMPACT_HZ, HOLLOW_HZ = 10_000.0, 2000.0
"""Frequencies of the first mode above which a free body counts as rigid for all that a hand feels, up to 1 kHz. A small
plate with a first mode below 10 kHz yields about as much as its contacts, which shifts resonances: with a first mode at
2-5 kHz, the error would be 1-12 dB at the 95th percentile (docs/figures/accuracy.md). For hollow bodies, mass matters
more than bending."""
BOX_HZ = 100.0
"""First mode of a solid beam above which a thick hollow body is a rigid box. Assumed: it is above that of cushions of
foam, at 3-80 Hz, and below that of cases, cabinets and bathtubs, at 140 Hz or more."""
ESTIMATE = 2.0
"""Largest mass of a solid plate over the estimated mass of its object. Of the lexicon's masses, 84 to 100 % are within
this factor (docs/figures/inference.md); beyond it the measured thickness is that of a hollow object."""

THINNEST = 0.01
"""Smallest part of the measured thickness, such as a shell of 0.7 mm around 0.07 m; assumed. A mass that requires less
is probably a mistake."""


def is_hollow(plate: Plate) -> bool:
    """Whether a plate would weigh more than its object, as with a bowl or a refrigerator."""
    return plate.moving_mass_kg < plate.mass_kg


def is_too_thick(plate: Plate) -> bool:
    """Whether thin-plate theory is not valid along the longer side of a solid plate, or either side of a hollow one."""
    side = min(plate.extent_m) if is_hollow(plate) else max(plate.extent_m)
    return plate.thickness_m > _THICK * side


def is_stiff(plate: Plate, above_hz: float) -> bool:
    """Whether the first mode of a free plate is above a frequency [Hz]."""
    return beam_hz(plate) >= above_hz and first_bending_hz(plate) > above_hz


@lru_cache(maxsize=4096)
def is_compact(plate: Plate) -> bool:
    """Whether a plate is so stiff that it moves as a rigid body. False for a plate that is held at an edge: as a rigid
    body it would not move at all.

    A thick solid plate bends by its first mode, as a thin one: beyond the range of thin-plate theory, but a block of
    foam is nearer to that than to a rigid body. A thick hollow one is a box, stiffer than a plate of its mass.
    """
    if plate.edges != "FFFF":
        return False
    if not is_hollow(plate):
        return is_stiff(plate, COMPACT_HZ)
    is_box = is_too_thick(plate) and beam_hz(plate) >= BOX_HZ
    return is_box or is_stiff(plate, HOLLOW_HZ)


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
