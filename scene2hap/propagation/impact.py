"""The response of a body to an impact: a few decaying sines at the struck point.

Two bodies that meet at a speed v exchange the momentum J = (1 + e) v mu with 1 / mu = 1/m + 1/m_s. By Hertz's law they
touch for the time T, and the force is about a half sine of f_c = 1 / (2 T). The struck point then vibrates with the
accelerations

    contact     2 pi f_c J (1/m + pi f_c Y)        T = 2.87 (mu^2 / (R E*^2 v))^(1/5),   Y = 1 / (8 sqrt(D m'))
    modes       2 pi f_n J phi_n^2 S(f_n)          f_n of a plate that is supported along its edges

A free body keeps the velocity J/m. It counts as the amplitude of a sine at f_c, with twice the acceleration of the half
sine, which the body has only during the contact.

R and E* are those of the contacts of resting objects (`coupled.contact_stiffness`): any two objects meet at a tip of 5
mm. A fingertip is a linear spring k instead, with T = pi sqrt(mu / k) at any speed.

Y is the mobility of a plate without edges; during an impact, a large plate has the same mobility. The share of the
impact at frequency f is S(f) = |cos(pi f T) / (1 - (2 f T)^2)|: a rubber ball excites no high mode. Furniture stands on
legs, so its edges are between free and supported. The modes of a supported plate are used, since they are known in
closed form, without an eigenproblem when something lands. Like all modes they rise with stiffness and fall with size
and weight.

Letters: J [N s], e [-] restitution, m, m_s [kg] of the struck body and of the striker, k [N/m], D [N m], m' [kg/m2],
phi [kg^-1/2].
Source: Cremer, Heckl, Petersson, Structure-Borne Sound, chapters 3 and 5, for both mobilities; Johnson, Contact
Mechanics (1985), eq. 11.24, for T; Goldsmith, Impact (1960), chapter 4, for the half sine.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from scene2hap.common.arrays import Floats
from scene2hap.materials import Material
from scene2hap.propagation.bodies.idealisation import is_too_thick
from scene2hap.propagation.coupled.contact_stiffness import ContactLaw, contact_modulus_pa
from scene2hap.propagation.plate import Plate
from scene2hap.propagation.protocol import Body

RESTITUTION = 0.3
"""Coefficient of restitution of cups, books and tools on furniture; assumed (0 is clay, 0.9 a glass ball on steel)."""
SLOWEST_HZ, FASTEST_HZ = 30.0, 250.0
"""Bounds on the frequency of a contact [Hz]: a slower contact is a push; a faster one is a click, and is played where
touch is most sensitive."""
HIGHEST_MODE_HZ = 400.0
"""Highest mode that is used [Hz]; above, touch is less sensitive, and onsets become audible."""
CONTACT_LOSS = 0.3
"""Loss factor of a contact that separates again [-]: it rings for a cycle or two; assumed."""
SHORTEST_S, LONGEST_S = 0.008, 0.1
"""Bounds on the time in which a mode falls to 1/e [s]: a shorter decay is a click; a longer one is damped by hands and
by objects on the plate; assumed."""
MOST_MODES = 5
"""Most modes of a burst: each is a sine to sum for each hand, and weaker ones are hidden by the first (assumed)."""
LEAST_SHARE = 0.01
"""Modes below this part of the strongest one are left out: the struck point is on a node of theirs."""
HERTZ = 2.87
"""T (R E*^2 v / mu^2)^(1/5) of two elastic bodies [-]."""
SLOWEST_M_S = 1e-3
"""Speed below which the duration of a contact no longer grows [m/s]: nothing is felt of it."""
STEPS_PER_OCTAVE = 24
"""Steps in which the frequency of a contact is rounded: by 1.5 %, where 22 % are just noticed. Objects that land again
and again have the same few waves and excited modes, which are cached."""
FINGER_KG, FINGER_N_M = 0.1, 2e4
"""Mass and stiffness of the default striker: a fingertip with part of the hand, soft enough for a thud of 70 Hz;
assumed."""


@dataclass(frozen=True, eq=False)
class Burst:
    """Decaying sines at a struck point: first the contact, then the modes from the strongest.

    frequencies_hz, decays_s (to 1/e), accelerations_m_s2 (initial amplitudes) : (n,) float64, n >= 1.
    """

    frequencies_hz: Floats
    decays_s: Floats
    accelerations_m_s2: Floats


def burst_of(
    struck: Body | None,
    at_m: tuple[float, float] | None,
    striker: Body | None = None,
    *,
    speed_m_s: float = 0.0,
    impulse_n_s: float | None = None,
    is_finger: bool = False,
) -> Burst:
    """Compute the vibration of the struck point after an impact on a body.

    Parameters: struck : the struck body, None for one of unknown material, which counts as hard plastic with the
    striker's mass; at_m : struck point from the corner of a plate along length and width [m], None for its middle;
    striker : the other body, None for an unknown one or a finger; speed_m_s : speed at which they meet; impulse_n_s :
    exchanged momentum, instead of a speed, which follows from it.
    """
    per_kg, contact_hz = _contact(struck, striker, is_finger)
    if impulse_n_s is None:
        momentum = (1 + RESTITUTION) * speed_m_s / per_kg
    else:
        momentum, speed_m_s = impulse_n_s, impulse_n_s * per_kg / (1 + RESTITUTION)
    if not is_finger:
        steps = STEPS_PER_OCTAVE * math.log2(contact_hz * max(speed_m_s, SLOWEST_M_S) ** 0.2)
        contact_hz = 2 ** (round(steps) / STEPS_PER_OCTAVE)
    felt_hz = min(max(contact_hz, SLOWEST_HZ), FASTEST_HZ)
    yields = 1 / _masses_kg(struck, striker, is_finger)[0]
    modes = np.empty((3, 0))
    if isinstance(struck, Plate):
        per_area = struck.mass_kg / struck.area_m2
        yields += math.pi * felt_hz / (8 * math.sqrt(struck.bending_stiffness_nm * per_area))
        modes = _modes(struck, at_m, 1 / (2 * contact_hz))
    contact = (felt_hz, 2 / (CONTACT_LOSS * 2 * math.pi * felt_hz), 2 * math.pi * felt_hz * yields)
    f, decays, accelerations = np.concatenate([np.array(contact)[:, None], modes], axis=1)
    return Burst(f, decays, momentum * accelerations)


@lru_cache(maxsize=1024)
def _contact(struck: Body | None, striker: Body | None, is_finger: bool) -> tuple[float, float]:
    """1 / mu [1/kg], and f_c at 1 m/s [Hz]."""
    struck_kg, striker_kg = _masses_kg(struck, striker, is_finger)
    per_kg = 1 / striker_kg + 1 / struck_kg
    if is_finger:
        return per_kg, math.sqrt(FINGER_N_M * per_kg) / (2 * math.pi)
    modulus_pa = abs(contact_modulus_pa(_material(struck), _material(striker)))
    lasts_s: float = HERTZ * (ContactLaw().tip_radius_m * (modulus_pa * per_kg) ** 2) ** -0.2
    return per_kg, 1 / (2 * lasts_s)


def _masses_kg(struck: Body | None, striker: Body | None, is_finger: bool) -> tuple[float, float]:
    """m and m_s [kg]."""
    striker_kg = FINGER_KG if is_finger else 1.0 if striker is None else striker.moving_mass_kg
    return striker_kg if struck is None else struck.moving_mass_kg, striker_kg


def _material(body: Body | None) -> Material | None:
    return None if body is None else body.material


def _modes(plate: Plate, at_m: tuple[float, float] | None, lasts_s: float) -> Floats:
    """Frequency [Hz], decay [s] and acceleration per momentum [m/s2 / (N s)] of the strongest modes (3, n)."""
    modes = _supported(plate, lasts_s)
    x, y = (plate.length_m / 2, plate.width_m / 2) if at_m is None else at_m
    along, across = np.sin(modes.along * x) ** 2, np.sin(modes.across * y) ** 2
    # Ranked by velocity, since the threshold of touch is about proportional to frequency.
    velocities: Floats = (along[:, None] * across * modes.velocities).ravel()
    n_weaker = len(velocities) - MOST_MODES
    strongest = velocities.argpartition(n_weaker)[n_weaker:] if n_weaker > 0 else np.arange(len(velocities))
    strongest = strongest[(-velocities[strongest]).argsort(kind="stable")]
    its = velocities[strongest]
    n = int((its > LEAST_SHARE * its[0]).sum()) if len(its) else 0
    found: Floats = modes.per_velocity[:, strongest[:n]]
    found[2] *= its[:n]
    return found


class _Supported(NamedTuple):
    """Modes of a plate with supported edges after an impact of some duration.

    along (m,), across (n,) : wavenumbers along its length and width [rad/m]; velocities (m, n) : velocity of each
    mode's antinode per momentum [m/s / (N s)], 0 above `HIGHEST_MODE_HZ`; per_velocity (3, m n) : frequency [Hz], decay
    [s] and acceleration per velocity [rad/s].
    """

    along: Floats
    across: Floats
    velocities: Floats
    per_velocity: Floats


@lru_cache(maxsize=1024)
def _supported(plate: Plate, lasts_s: float) -> _Supported:
    """The modes up to `HIGHEST_MODE_HZ` and some above; none for a plate that is too thick to bend.

    Cached: the same objects land again and again on the same plates.
    """
    length, width = plate.extent_m
    if is_too_thick(plate):
        return _Supported(np.empty(0), np.empty(0), np.empty((0, 0)), np.empty((3, 0)))
    lowest = math.pi / 2 / plate.wavenumber_per_root_omega**2
    # At most 40 per side, which include the strongest modes of a floor.
    m, n = (min(40, int(side * math.sqrt(HIGHEST_MODE_HZ / lowest)) + 1) for side in (length, width))
    along: Floats = np.arange(1, m + 1, dtype=np.float64) * (math.pi / length)
    across: Floats = np.arange(1, n + 1, dtype=np.float64) * (math.pi / width)
    f: Floats = lowest / np.pi**2 * (along[:, None] ** 2 + across**2)
    velocities: Floats = 4 / plate.mass_kg * np.where(f <= HIGHEST_MODE_HZ, _share(f * lasts_s), 0.0)
    decays = np.clip(1 / (np.pi * f * max(plate.material.loss_factor, 1e-6)), SHORTEST_S, LONGEST_S)
    per_velocity = np.stack([f.ravel(), decays.ravel(), 2 * np.pi * f.ravel()])
    return _Supported(along, across, velocities, per_velocity)


def _share(cycles: Floats) -> Floats:
    """S at f T = `cycles`; its limit at a half is pi / 4."""
    near = np.abs(cycles - 0.5) < 1e-6
    safe = np.where(near, 0.0, cycles)
    return np.where(near, math.pi / 4, np.abs(np.cos(math.pi * safe) / (1 - (2 * safe) ** 2)))
