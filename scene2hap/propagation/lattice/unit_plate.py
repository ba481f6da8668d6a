"""Plates of unit size: plates of one shape share a lattice, whatever their size, thickness or material."""

from __future__ import annotations

from functools import lru_cache

from scene2hap.materials import Material
from scene2hap.propagation.plate import Plate
from scene2hap.scene.surface.outline import Outline, Ring


@lru_cache(maxsize=64)
def of_size_one(plate: Plate) -> tuple[Plate, float]:
    """Return a plate of the same shape, of 1 m and of a material with the same Poisson's ratio, and the size of the
    given plate [m]. Corners are rounded to a thousand millionth, so that rounding makes no other shape."""
    size_m = max(plate.extent_m)
    outline = plate.outline
    if outline is not None:
        outline = outline_of(
            tuple(tuple((round(x / size_m, 9), round(y / size_m, 9)) for x, y in ring) for ring in outline.rings_m)
        )
    material = Material("any", 1e3, 1e9, plate.material.poisson_ratio, 0.0)
    length_m, width_m = plate.length_m / size_m, plate.width_m / size_m
    return Plate(length_m, width_m, 1e-3, material, plate.boundary, outline=outline), size_m


@lru_cache(maxsize=32)
def outline_of(rings_m: tuple[Ring, ...]) -> Outline:
    """Outline shared by all plates of a shape, so that it is checked and measured once."""
    return Outline(rings_m)
