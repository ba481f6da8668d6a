"""The rungs of `auto`: models of one plate from the cheapest to `ModalPlate`, and bounds on their errors against it.

    rigid     moves as a whole               error 250 dB (f / f_1)^2 M / m, calibrated
    infinite  has no edges                   error is the level above the floor of -40 dB, derived (`auto_level`)
    lattice   `MassSpringDamper`             for plates with an outline that are not rigid
    coarse    modes of a small basis         error `MODAL_DB`, calibrated
    medium    ...
    modal     `ModalPlate`                   reference for all errors

Every modal rung sums single resonances, the static response of all stiffer modes, and the near field; the rungs differ
in their polynomial bases. Errors are those of band gains, floored at -40 dB re the source, in the worst band.
Calibrated bounds are at least the 99th percentile over 600 draws of `benchmarks/auto_fidelity.py --calibrate`, none of
which is among the draws that it reports. The rigid rung errs most if a source resonates on several feet, especially
near a corner: by 210 dB (f / f_1)^2 at worst in 600 draws.

Letters: f [Hz] top frequency, f_1 [Hz] first bending mode, m [kg] mass of the plate, M [kg] mass that strains it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from scene2hap.propagation.bodies.infinite_body import InfiniteBody
from scene2hap.propagation.bodies.modal_body import modal_body
from scene2hap.propagation.bodies.rigid import RigidMotion
from scene2hap.propagation.elastic_body import ElasticBody
from scene2hap.propagation.lattice.lattice_modes import lowest_frequencies_hz
from scene2hap.propagation.mass_spring_damper import MassSpringDamper
from scene2hap.propagation.modal.estimates import beam_hz, first_bending_hz
from scene2hap.propagation.modal.modes import FINE, Fineness
from scene2hap.propagation.plate import Plate

FLOOR_DB = -40.0
"""Floor of gains in errors, re the source: lower gains count as this."""
RIGID_DB = 250.0
"""Error of the rigid rung where the top frequency is that of the first bending mode [dB]: 210 at worst in 600 draws."""
FINENESS = {
    "coarse": Fineness(1.1 / math.pi, 3, 6, least_wider=0),
    "medium": Fineness(1.45 / math.pi, 3, 12, least_wider=0),
    "modal": FINE,
}
MODAL_DB = {
    "held, and quiet": {"coarse": 0.75, "medium": 0.4},
    "held": {"coarse": 5.0, "medium": 2.3},
    "free": {"coarse": 4.6, "medium": 0.9},
}
"""Error of each basis by the plate's edges: "free" has two free edges or more; the rest is "held", and quiet if sources
cannot raise its level above `QUIET_DB`. Near a held edge a plate hardly moves, and small bases err most there."""
QUIET_DB = 5.0
"""Largest gain of a quiet plate [dB]; see `MODAL_DB`."""
_COARSE_CELLS = 4
"""Resolution of a lattice that gives the first bending mode of an outline within some percent."""


@dataclass(frozen=True)
class Choice:
    """Model of an object: its rung, the bound on its error [dB], and why."""

    object_id: str
    rung: str
    bound_db: float
    why: str

    def __str__(self) -> str:
        return f"{self.object_id}: {self.rung}, within {self.bound_db:.2g} dB: {self.why}"


@dataclass(frozen=True)
class PlateCase:
    """A plate for which a rung is chosen.

    top_hz : highest frequency of the bands [Hz]; peak_db : bound on the gain (`auto_level`), infinite if unknown [dB];
    load_kg : largest mass with which other objects may pull at it at `top_hz` [kg].
    """

    plate: Plate
    loss_factor: float
    top_hz: float
    peak_db: float = math.inf
    load_kg: float = 0.0

    def choose(self, object_id: str, tolerance_db: float, *, may_be_infinite: bool = True) -> Choice:
        """Choose the cheapest rung whose bound is within the tolerance [dB]; `ModalPlate` if none is."""
        ratio = self._bending(tolerance_db)
        if RIGID_DB * ratio**2 <= tolerance_db:
            why = f"{self.top_hz:g} Hz is {ratio:.2g} of its first bending mode under its load"
            return Choice(object_id, "rigid", RIGID_DB * ratio**2, why)
        if self.plate.outline is not None:
            return Choice(object_id, "lattice", 0.0, "its outline is no rectangle")
        above = max(0.0, self.peak_db - FLOOR_DB)
        if may_be_infinite and above <= tolerance_db:
            why = f"at most {self.peak_db:.0f} dB anywhere on it, and {FLOOR_DB:g} dB counts as none"
            return Choice(object_id, "infinite", above, why)
        held = self.held
        for rung, bound in MODAL_DB[held].items():
            if bound <= tolerance_db:
                return Choice(object_id, rung, bound, f"the smallest basis that serves a plate that is {held}")
        return Choice(object_id, "modal", 0.0, f"no smaller basis serves a plate that is {held}")

    def _bending(self, tolerance_db: float) -> float:
        """Ratio of the top frequency to the first bending mode's; infinite for a held plate or above a simple bound.

        All mass that a plate carries strains it, so the mode counts as lower by the root of the masses' ratio.
        """
        carried = (max(self.plate.moving_mass_kg, self.plate.mass_kg) + self.load_kg) / self.plate.mass_kg
        top_hz = self.top_hz * math.sqrt(carried)
        if self.plate.edges != "FFFF" or RIGID_DB * (top_hz / beam_hz(self.plate)) ** 2 > tolerance_db:
            return math.inf
        if self.plate.outline is not None and len(self.plate.outline.inward[0]):
            # Arms of an L, tongues beside a slot and rings bend at lower frequencies than the rectangle.
            return top_hz / float(lowest_frequencies_hz(self.plate, _COARSE_CELLS, 4)[3])
        return top_hz / first_bending_hz(replace(self.plate, outline=None))

    @property
    def held(self) -> str:
        """Key of the plate's row in `MODAL_DB`."""
        if self.plate.edges.count("F") >= 2:
            return "free"
        return "held, and quiet" if self.peak_db < QUIET_DB else "held"


def body_of(rung: str, plate: Plate, max_frequency_hz: float, loss_factor: float) -> ElasticBody:
    """Make the body of a plate by the model of a rung, for frequencies up to `max_frequency_hz` [Hz]."""
    if rung == "rigid":
        return RigidMotion.of_thin(plate)
    if rung == "infinite":
        return InfiniteBody(plate, loss_factor)
    if rung == "lattice":
        return MassSpringDamper(loss_floor=loss_factor).elastic_body(plate, max_frequency_hz)
    return modal_body(plate, max_frequency_hz, loss_factor, FINENESS[rung])
