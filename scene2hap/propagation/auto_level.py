"""Upper bound on a plate's level relative to its sources, known before the scene is solved.

    g(f) <= F_b Y_inf B            F_b = 1 / |1 / K - 1 / (omega^2 m)|          Y_inf = 1 / (8 D k^2)
    B = max(r^2, 8 r / (pi omega n eta) sqrt(min(1, pi eta f / (2 b))))

F_b is the blocked force, per unit of free motion, of a source of mass m behind contacts of stiffness K. Y_inf is the
receptance of the plate without edges. B is the factor by which a resonance exceeds Y_inf at modal density n: a mode
whose shape is twice its mean at both points, 4 / (eta omega M), over the mean mobility pi n / (2 M), as the rms over a
band of width b. At a free edge a mode is sqrt(2) times as large as inside, for each axis that ends there. A plate
without reflections yields 3.7 times as much at an edge, and 10 times at a corner (nu = 0.3). So r has a factor of
sqrt(2) for each axis with a free end, since the hand may be anywhere. It has another if the source stands within a
quarter wave of that end. Below its first resonance omega_1 a held plate yields less, Y_0 / (1 - omega^2 / omega_1^2) at
most, where Y_0 is its greatest static receptance: no mode exceeds its static part by a larger factor. Derived here.
The bound exceeded the loudest gain, also at edges and corners, in every draw of tests/physics/test_auto_fidelity.py.

Letters: g [-] gain, F_b [N/m], m [kg], M [kg] mass of the plate, K [N/m] complex, Y [m/N], D [N m], k [rad/m],
n [s/rad], eta [-], b [Hz].
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import reduce
from operator import add

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap.haptics import Bands
from scene2hap.propagation.coupled.coupling import Joint
from scene2hap.propagation.modal.estimates import first_bending_hz, largest_static_receptance_m_n, n_rigid_motions
from scene2hap.propagation.plate import Plate

N_FREQUENCIES = 40
"""Frequencies at which the bound is evaluated, if bands have edges; it is smooth in frequency (assumed)."""
_NARROWEST = 10.0
"""Ratio of sides above which the static receptance would take a large matrix; it is then not used."""


def peak_level_db(
    plate: Plate,
    loss_factor: float,
    pushed_by: Sequence[tuple[float, list[Joint]]],
    places_m: ArrayLike,
    bands: Bands,
    own_hz: list[float],
) -> float:
    """Upper bound on the gain anywhere on a plate that sources push [dB].

    Parameters: pushed_by : mass [kg] of each source on the plate, and its joints there; places_m : (n, 2) positions of
    all these joints on the plate [m]; own_hz : frequencies of the sources [Hz], used if `bands` has no edges.
    """
    edges = bands.widths_hz()
    f = np.geomspace(edges[0, 0], edges[-1, 1], N_FREQUENCIES) if len(edges) else np.array(own_hz)
    share = float(((edges[:, 1] - edges[:, 0]) / edges[:, 0]).min()) if len(edges) else 1e-9
    omega = 2 * math.pi * f
    force = np.max([_push(omega, mass, joints) for mass, joints in pushed_by], axis=0)
    rise = _rise_at_hand(plate) * _rise_at(plate, np.asarray(places_m, dtype=np.float64), omega)
    return float(20 * np.log10((force * _receptance(plate, loss_factor, omega, share, rise)).max()))


def _rise_at_hand(plate: Plate) -> float:
    return math.sqrt(2.0) ** sum("F" in plate.edges[axis : axis + 2] for axis in (0, 2))


def _rise_at(plate: Plate, places_m: NDArray[np.float64], omega: NDArray[np.float64]) -> NDArray[np.float64]:
    """Factor (n_frequencies,) by which free edges within a quarter wave raise the receptance at pushed points."""
    quarter_m = math.pi / 2 / np.asarray(plate.wavenumber_rad_m(omega / (2 * math.pi)))
    rise = np.ones(len(omega))
    for axis, side_m in enumerate((plate.length_m, plate.width_m)):
        first, last = plate.edges[2 * axis], plate.edges[2 * axis + 1]
        along = places_m[:, axis]
        ends = [along.min()] * (first == "F") + [side_m - along.max()] * (last == "F")
        rise *= np.where(quarter_m >= min(ends, default=math.inf), math.sqrt(2.0), 1.0)
    return rise


def _push(omega: NDArray[np.float64], mass_kg: float, joints: list[Joint]) -> NDArray[np.float64]:
    # Not `sum`, which rounds complex numbers otherwise from Python 3.14 on.
    stiffness = reduce(add, (joint.stiffness_n_m * complex(1, joint.loss_factor) for joint in joints))
    force: NDArray[np.float64] = 1 / np.abs(1 / stiffness - 1 / (omega**2 * mass_kg))
    return force


def _receptance(
    plate: Plate, eta: float, omega: NDArray[np.float64], share: float, rise: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Upper bound on the receptance of a plate (n_frequencies,) [m/N]."""
    D = plate.bending_stiffness_nm
    m = plate.material.density_kg_m3 * plate.thickness_m
    n = plate.length_m * plate.width_m / (4 * math.pi) * math.sqrt(m / D)
    boost = 8 / (math.pi * omega * n * eta) * math.sqrt(min(1.0, math.pi * eta / (2 * share)))
    bound: NDArray[np.float64] = np.maximum(rise**2, rise * boost) / (8 * np.sqrt(D * m) * omega)
    # A plate clamped all round is the stiffest; its omega_1 is at most 36 sqrt(D / m) / (shorter side)^2.
    shorter_m, longer_m = sorted((plate.length_m, plate.width_m))
    may_be_below = omega[0] < 36.0 / shorter_m**2 * math.sqrt(D / m)
    if n_rigid_motions(plate) == 0 and may_be_below and longer_m <= _NARROWEST * shorter_m:
        below = 1 - (omega / (2 * math.pi * first_bending_hz(plate))) ** 2
        static = 1.04 * largest_static_receptance_m_n(plate) / np.where(below > 0, below, 1.0)
        bound = np.where(below > 0, np.minimum(bound, static), bound)
    return bound
