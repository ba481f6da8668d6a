"""Mechanical impedance of a hand: a chain of masses, springs and dampers, the last of which end at a fixed point.

    Z_n = j omega m_n + c_n + k_n / (j omega)
    Z_i = j omega m_i + 1 / (1 / Z_(i+1) + 1 / (c_i + k_i / (j omega)))          Z = Z_1

Letters: Z [N s/m] force over velocity where the hand touches, m [kg], c [N s/m], k [N/m]. Time runs as e^{+j omega t}.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scene2hap.common import checks
from scene2hap.common.calls import clear_construction
from scene2hap.errors import ConfigError


@clear_construction
@dataclass(frozen=True)
class Hand:
    """A hand as a mechanical load on the touched object: a chain of masses, springs and dampers.

    Parameters: masses_kg : at least one, >= 0, the first touches the object; stiffnesses_n_m, dampings_n_s_m : as many,
    >= 0, of the spring and the damper behind each mass; the last ones end at a fixed point. `PALM` and `FINGERTIP` are
    measured hands.
    Raises: ConfigError: a value is out of bounds, or the lengths differ.
    """

    masses_kg: Sequence[float]
    stiffnesses_n_m: Sequence[float]
    dampings_n_s_m: Sequence[float]

    def __post_init__(self) -> None:
        counts = set()
        for field, unit in zip(fields(self), ("kg", "N/m", "N s/m"), strict=True):
            values = checks.items(field.name, getattr(self, field.name), error=ConfigError)
            kept = tuple(
                checks.number(f"{field.name}[{i}]", value, unit, at_least=0.0, at_most=1e12, error=ConfigError)
                for i, value in enumerate(values)
            )
            counts.add(len(kept))
            object.__setattr__(self, field.name, kept)
        if len(counts) > 1 or 0 in counts:
            raise ConfigError(
                f"a hand has {len(self.masses_kg)} masses, {len(self.stiffnesses_n_m)} stiffnesses and "
                f"{len(self.dampings_n_s_m)} dampings; it must have as many of each, at least one."
            )

    def impedance_n_s_m(self, frequencies_hz: NDArray[np.float64]) -> NDArray[np.complex128]:
        """Return the impedance Z at frequencies (n_frequencies,) > 0 [Hz], complex128 [N s/m], real part >= 0."""
        j_omega = 2j * math.pi * np.asarray(frequencies_hz, dtype=np.float64)
        behind: NDArray[np.complex128] | None = None
        for mass, stiffness, damping in reversed(
            list(zip(self.masses_kg, self.stiffnesses_n_m, self.dampings_n_s_m, strict=True))
        ):
            link = damping + stiffness / j_omega
            if behind is not None:
                both = link + behind
                link = link * behind / np.where(both == 0, 1.0, both)
            behind = j_omega * mass + link
        assert behind is not None
        return behind


PALM = Hand((0.0299, 0.6623, 2.9023), (5335.0, 299_400.0, 2495.0), (227.5, 380.6, 30.3))
"""The palm of a man who grips with 25-50 N, along the forearm: 165-250 N s/m from 10 Hz to 500 Hz.

Source: ISO 10068:1998, annex C, model 1, axis z_h, of three masses; grip and push as in its clause 4. The values are
quoted from papers that use the model; the standard itself was not at hand.
"""
FINGERTIP = Hand((0.006,), (500.0,), (5.0,))
"""The tip of an index finger that presses with a few newtons, along its normal: 5-20 N s/m from 10 Hz to 500 Hz.

Source: Hajian, Howe, Identification of the mechanical impedance at the human finger tip, J. Biomech. Eng. 119 (1997)
109: in extension 3.5-8.7 g, 4-7.4 N s/m and 255-1255 N/m, as quoted by later papers; the values here are in the middle.
"""
HANDS = {"palm": PALM, "fingertip": FINGERTIP}


GivenHand = Hand | Mapping[str, Any] | str | None
"""A hand, its settings, its name in `HANDS`, or None."""


def checked_hand(hand: GivenHand) -> Hand | None:
    """Convert a setting to a hand. Raises: ConfigError."""
    if hand is None or isinstance(hand, Hand):
        return hand
    if isinstance(hand, str) and hand in HANDS:
        return HANDS[hand]
    if isinstance(hand, Mapping):
        try:
            return Hand(**hand)
        except TypeError:
            pass  # the error below names the settings
    raise ConfigError(
        f"hand is {checks.shown(hand)}; it must be one of {', '.join(map(repr, HANDS))}, a Hand, its settings "
        "masses_kg, stiffnesses_n_m and dampings_n_s_m, or None."
    )
