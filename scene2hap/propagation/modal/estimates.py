"""Numbers of a plate that are known without its modes: how many there are, the first one, the greatest deflection.

Letters: k [rad/m] wavenumber, s [m^-4] shift of `mode_block`.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from scene2hap.propagation.modal.mode_block import cholesky
from scene2hap.propagation.modal.ritz import axis_bases, products, stiffness
from scene2hap.propagation.plate import Plate

SHIFT = 1e-2
"""s over k^4 of the highest mode wanted. Tuned: anywhere between 1e-4 and 1 the frequencies agree to 1e-9."""
_NARROWEST = 1e-3
"""Width over length of the narrowest strip with free long edges for which `first_bending_hz` is computed: it bends as a
beam, as do all narrower ones, and rounding hides the modes of a strip of 1e-5."""


def n_rigid_motions(plate: Plate) -> int:
    """Number of motions without bending that the edges allow: 3 if all are free, 1 about a single hinge, else 0."""
    return {"FFFF": 3, "FFFS": 1}.get("".join(sorted(plate.edges)), 0)


def n_modes_to(plate: Plate, k: float) -> float:
    """Approximate number of modes of a plate with free edges up to a wavenumber [rad/m] (Weyl)."""
    return (plate.area_m2 * k**2 + 2 * sum(plate.extent_m) * k) / (4 * math.pi)


def wavenumber_of_mode(plate: Plate, n_modes: float) -> float:
    """The wavenumber [rad/m] at which `n_modes_to` is `n_modes`."""
    area, edge = plate.area_m2, 2 * sum(plate.extent_m)
    return edge / (2 * area) * (math.sqrt(1 + 16 * math.pi * area * n_modes / edge**2) - 1)


def beam_hz(plate: Plate) -> float:
    """Upper bound on `first_bending_hz` of a plate with free edges [Hz]: the first mode of a free beam along its longer
    side, which is a trial deflection (Rayleigh)."""
    return 22.374 / (max(plate.extent_m) * plate.wavenumber_per_root_omega) ** 2 / (2 * math.pi)


@lru_cache(maxsize=4096)
def first_bending_hz(plate: Plate) -> float:
    """Lowest natural frequency above 0 [Hz], from above, at a thousandth of the cost of all modes.

    It is within 1e-3; on a strip with clamped ends within 1.1e-2. A strip narrower than
    `_NARROWEST` counts as one of this width.
    """
    from scipy.linalg.lapack import dpotri

    pairs, nu, longest = (plate.edges[:2], plate.edges[2:]), plate.material.poisson_ratio, max(plate.extent_m)
    sides = (plate.length_m, plate.width_m)
    least = [_NARROWEST * longest if pair == "FF" else 0.0 for pair in pairs]
    x, y = (axis_bases(*of_axis, 8) for of_axis in zip(pairs, map(max, sides, least), strict=True))
    shift = SHIFT * (math.pi / longest) ** 4
    compliances = [dpotri(cholesky(u, v, nu, shift), lower=1, overwrite_c=1)[0] for u in x for v in y]
    k4 = np.sort(np.concatenate([1 / np.linalg.eigvalsh(one) - shift for one in compliances]))
    return float(math.sqrt(k4[n_rigid_motions(plate)]) / plate.wavenumber_per_root_omega**2 / (2 * math.pi))


@lru_cache(maxsize=4096)
def largest_static_receptance_m_n(plate: Plate) -> float:
    """Greatest deflection under a constant force at the same point of a held plate [m/N], within 4 % from below."""
    shorter = min(plate.length_m, plate.width_m)
    bases_x, bases_y = (
        axis_bases(edges, side_m, 8 * math.ceil(side_m / shorter))
        for edges, side_m in ((plate.edges[:2], plate.length_m), (plate.edges[2:], plate.width_m))
    )
    parts = np.linspace(0.0, 1.0, 9)
    points = np.array([(x * plate.length_m, y * plate.width_m) for x in parts for y in parts])
    found = np.zeros(len(points))
    for u in bases_x:
        for v in bases_y:
            shapes = products(u, v, points)
            found += (shapes.T * np.linalg.solve(stiffness(u, v, plate.material.poisson_ratio), shapes.T)).sum(axis=0)
    return float(found.max()) / plate.bending_stiffness_nm
