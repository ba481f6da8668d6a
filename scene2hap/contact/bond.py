"""How strongly two things are in contact and by what: one lies on the other, hangs from it, or touches it."""

from __future__ import annotations

import math
from typing import NamedTuple

from scene2hap.contact.junction import Junction
from scene2hap.contact.level import Aside, Rest, rest_points
from scene2hap.contact.pair import BodyPair
from scene2hap.contact.support import CLEAR_M
from scene2hap.contact.vectors import Triple


class Bond(NamedTuple):
    """How much two objects are in contact, the way [m] that takes the pair's `a` to its `b`, and the normal; whether
    the faller `lies` on the other with a level base face."""

    weight: float
    way_m: Triple
    normal: Triple | None
    lies: bool
    faller: str

    @property
    def normals(self) -> tuple[Triple | None, ...]:
        """The normal, for as many points as there may be."""
        return (self.normal,) * 4


class Plan(NamedTuple):
    """How a pair touches: by which bond; its points lie as `rest` or `side` tells, or are to be asked for."""

    body_pair: BodyPair
    bond: Bond
    within_m: float
    rest: Rest | None
    side: Aside | None

    def junction(self) -> Junction | None:
        """Where the pair touches, None if nowhere."""
        body_pair, bond = self.body_pair, self.bond
        if self.rest is not None:
            x, y = (body_pair.a, body_pair.b) if bond.faller == body_pair.a.id else (body_pair.b, body_pair.a)
            points = rest_points(x, y, self.rest)
        elif self.side is not None:
            points = self.side.points
        else:
            points = body_pair.points(bond.way_m, self.within_m)
        n = len(points)
        return Junction(points, (bond.weight,) * n, (bond.normal,) * n) if points else None


NO_WAY: Triple = (0.0, 0.0, 0.0)
NO_BOND = Bond(0.0, NO_WAY, None, False, "")


def priority(bond: Bond) -> tuple[float, bool]:
    """Sort key: the larger weight wins; on a tie, the bond that has a normal."""
    return (bond.weight, bond.normal is not None)


def direction(distance_m: float, way_m: Triple) -> Triple | None:
    """The normal along the way between two surfaces, if that has a direction."""
    if distance_m < CLEAR_M:
        return None
    x, y, z = way_m
    length = math.sqrt(x * x + y * y + z * z)
    return (x / length, y / length, z / length)
