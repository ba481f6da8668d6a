"""Contact stiffness by Hertz's law, for two surfaces that meet at a tip under a preload.

    k = 2 E* a       a = (3 F R / (4 |E*|))^(1/3)       1 / E* = sum over both sides of (1 - nu^2) / (E (1 + j eta))

k = (6 E*^2 F R)^(1/3) is Hertz's law, linearised about the preload F. Real surfaces touch only at their highest points,
so the apparent contact area says little about the stiffness. But if this area is smaller than Hertz's spot, it limits
the radius a.

Letters: k [N/m] stiffness, E [Pa], nu [-], eta [-] loss factor, F [N] preload, R [m] radius of the tip, a [m] radius of
the contact spot.
Source: Johnson, Contact Mechanics (1985), section 4.2, and section 3.4 for the flat punch of radius a.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from scene2hap.common import checks
from scene2hap.errors import ConfigError
from scene2hap.materials import Material

HARD_PLASTIC = Material("hard plastic", 1050.0, 2.4e9, 0.35, 0.02)
"""Surface assumed for a body whose material is unknown, such as the case of an appliance (ABS, handbook)."""


STANDARD_GRAVITY_M_S2 = 9.80665
LEAST_PRELOAD_N = 1e-4
"""Smallest preload of a contact [N], as of a crumb; less would be no contact."""
FADING_LOSS = 2.5
"""Loss factor that a contact of weight w gains until it is gone, as a spring w k (1 + j eta (1 - w)); assumed. Its
resonance sweeps down through a source's frequency as the source is lifted. With eta = 2.5 the force there is at most
sqrt(1 + 1 / eta^2) of that at rest, 0.6 dB; above sqrt 8, the spring's magnitude would rise before it falls."""


@dataclass(frozen=True)
class ContactLaw:
    """Stiffness and loss of contacts.

    Parameters: tip_radius_m : > 0 [m], radius of the corner, foot or high point on which an object rests; preload_n :
    > 0 [N], load on a contact where no mass is known (otherwise see `preload`); loss_floor : 0..2 [-], smallest loss
    factor of a contact. Assumed defaults: a quarter of a 0.2 kg phone on a corner of 5 mm, and the loss of a dry joint.
    Raises: ConfigError: a value is out of bounds.
    """

    tip_radius_m: float = 0.005
    preload_n: float = 0.5
    loss_floor: float = 0.05

    def __post_init__(self) -> None:
        checks.number("tip_radius_m", self.tip_radius_m, "m", above=0.0, error=ConfigError)
        checks.number("preload_n", self.preload_n, "N", above=0.0, error=ConfigError)
        checks.number("loss_floor", self.loss_floor, "-", at_least=0.0, at_most=2.0, error=ConfigError)

    def preload(self, masses_kg: Sequence[float], n_contacts: float) -> float:
        """Load on each contact [N]: equal shares of the weight of the lightest mass.

        Parameters: masses_kg : known masses that may press; without any, the load is `preload_n`; n_contacts : a
        contact that fades counts as a part of one.
        """
        if not masses_kg:
            return self.preload_n
        return max(STANDARD_GRAVITY_M_S2 * min(masses_kg) / n_contacts, LEAST_PRELOAD_N)

    def stiffness(
        self, a: Material | None, b: Material | None, area_m2: float | None = None, preload_n: float | None = None
    ) -> tuple[float, float]:
        """Stiffness [N/m] and loss factor [-] of a contact between two materials, each None if unknown.

        Parameters: area_m2 : area of the contact [m2], None if unknown; preload_n : load on the contact [N], None for
        that of the law.
        """
        load_n = self.preload_n if preload_n is None else preload_n
        modulus = contact_modulus_pa(a, b)
        radius_m = (0.75 * load_n * self.tip_radius_m / abs(modulus)) ** (1 / 3)
        if area_m2:
            radius_m = min(radius_m, math.sqrt(area_m2 / math.pi))
        return 2 * modulus.real * radius_m, max(modulus.imag / modulus.real, self.loss_floor)


def contact_modulus_pa(a: Material | None, b: Material | None) -> complex:
    """Return E* of two materials, each None if unknown [Pa]; its imaginary part is the loss."""
    return 1 / sum(
        (1 - m.poisson_ratio**2) / (m.youngs_modulus_pa * complex(1, m.loss_factor))
        for m in (a or HARD_PLASTIC, b or HARD_PLASTIC)
    )


GivenLaw = ContactLaw | Mapping[str, Any]
"""A law of contact, or its settings, such as a table of TOML."""


def checked_law(contact: GivenLaw) -> ContactLaw:
    """Convert a setting to a law. Raises: ConfigError."""
    if isinstance(contact, ContactLaw):
        return contact
    try:
        return ContactLaw(**contact)
    except TypeError as cause:
        raise ConfigError(
            f"contact is {contact!r}; it must be a ContactLaw or its settings tip_radius_m, preload_n and loss_floor."
        ) from cause
