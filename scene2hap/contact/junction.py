"""Where two objects touch: the graph's own record of a pair, and all of them as arrays."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.contact.vectors import Triple
from scene2hap.scene.objects import Contact

Pair = tuple[str, str]


def pair_of(x: str, y: str) -> Pair:
    """The pair of two ids, lower one first."""
    return (x, y) if x < y else (y, x)


class Junction(NamedTuple):
    """The contacts of a pair (a, b), a < b, point by point: where in the world [m], how much of a contact, the normal
    from a to b, and the area [m2]; the last two are one for all, or one for each point where an engine gives them."""

    points_m: tuple[Triple, ...]
    weights: tuple[float, ...]
    normals: tuple[Triple | None, ...]
    areas_m2: tuple[float | None, ...] = ()

    def contacts(self, pair: Pair) -> tuple[Contact, ...]:
        """The same, spelled out."""
        areas = self.areas_m2 or (None,) * len(self.points_m)
        rows = zip(self.points_m, self.normals, areas, self.weights, strict=True)
        return tuple(Contact(*pair, point, normal, area, weight) for point, normal, area, weight in rows)


def junctions_of(contacts: Iterable[Contact]) -> dict[Pair, Junction]:
    """Given contacts by pair with a < b, in an order that does not depend on the giver's."""
    pairs: dict[Pair, list[Contact]] = {}
    for contact in contacts:
        if contact.a > contact.b:
            x = contact.normal
            turned = None if x is None else (-x[0], -x[1], -x[2])
            contact = replace(contact, a=contact.b, b=contact.a, normal=turned)
        pairs.setdefault((contact.a, contact.b), []).append(contact)
    found = {}
    for pair, several in pairs.items():
        several.sort(key=lambda one: one.point_m)
        found[pair] = Junction(
            tuple(one.point_m for one in several),
            tuple(one.weight for one in several),
            tuple(one.normal for one in several),
            tuple(one.area_m2 for one in several),
        )
    return found


@dataclass(frozen=True, eq=False)
class ContactArrays:
    """All contact points of a moment, sorted by pair.

    `ids` : the objects' ids; `a`, `b` (n,) : rows of the two objects in `ids`; `points_m` (n, 3) world [m];
    `weights` (n,) [-]; `normals` (n, 3) from a to b, nan where unknown.
    """

    ids: tuple[str, ...]
    a: NDArray[np.intp]
    b: NDArray[np.intp]
    points_m: NDArray[np.float64]
    weights: NDArray[np.float64]
    normals: NDArray[np.float64]

    @classmethod
    def of(cls, ids: Iterable[str], junctions: Mapping[Pair, Junction]) -> ContactArrays:
        """The arrays of these junctions between the objects of these ids."""
        ids = tuple(ids)
        row = {object_id: i for i, object_id in enumerate(ids)}
        ordered = sorted(junctions.items())
        nowhere = (np.nan,) * 3
        return cls(
            ids,
            np.array([row[a] for (a, _), one in ordered for _ in one.points_m], dtype=np.intp),
            np.array([row[b] for (_, b), one in ordered for _ in one.points_m], dtype=np.intp),
            np.array([point for _, one in ordered for point in one.points_m], dtype=np.float64).reshape(-1, 3),
            np.array([weight for _, one in ordered for weight in one.weights], dtype=np.float64),
            np.array([x or nowhere for _, one in ordered for x in one.normals], dtype=np.float64).reshape(-1, 3),
        )
