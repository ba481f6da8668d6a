"""Junctions: the contact points of a pair of objects, and those of all pairs as arrays."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.contact.geometry.vectors import Triple
from scene2hap.scene.objects import Contact

Pair = tuple[str, str]


def pair_of(x: str, y: str) -> Pair:
    """Return two ids as a pair, the lower one first."""
    return (x, y) if x < y else (y, x)


class Junction(NamedTuple):
    """The contact points of a pair (a, b), a < b: world position [m], weight (0..1), normal from a to b and area [m2].

    The points of a found contact share one normal and have no areas. An engine may give both for each point.
    """

    points_m: tuple[Triple, ...]
    weights: tuple[float, ...]
    normals: tuple[Triple | None, ...]
    areas_m2: tuple[float | None, ...] = ()

    def contacts(self, pair: Pair) -> tuple[Contact, ...]:
        """Return the points as `Contact` objects."""
        areas = self.areas_m2 or (None,) * len(self.points_m)
        rows = zip(self.points_m, self.normals, areas, self.weights, strict=True)
        return tuple(Contact(*pair, point, normal, area, weight) for point, normal, area, weight in rows)


def junctions_of(contacts: Iterable[Contact]) -> dict[Pair, Junction]:
    """Group given contacts by pair, with a < b. Points are sorted, so that the order of the input has no effect."""
    pairs: dict[Pair, list[tuple[Triple, float, Triple | None, float | None]]] = {}
    for one in contacts:
        normal = one.normal
        if normal is not None and one.a > one.b:
            normal = (-normal[0], -normal[1], -normal[2])
        pairs.setdefault(pair_of(one.a, one.b), []).append((one.point_m, one.weight, normal, one.area_m2))
    found = {}
    for pair, several in pairs.items():
        several.sort(key=lambda row: row[0])
        points_m, weights, normals, areas_m2 = zip(*several, strict=True)
        found[pair] = Junction(points_m, weights, normals, areas_m2)
    return found


@dataclass(frozen=True, eq=False)
class ContactArrays:
    """All contact points of a scene at one time, sorted by pair.

    ids : object ids; a, b (n,) : rows of the two objects in `ids`; points_m (n, 3) world [m]; weights (n,) [-];
    normals (n, 3) from a to b, nan where unknown.
    """

    ids: tuple[str, ...]
    a: NDArray[np.intp]
    b: NDArray[np.intp]
    points_m: NDArray[np.float64]
    weights: NDArray[np.float64]
    normals: NDArray[np.float64]

    @classmethod
    def of(cls, ids: Iterable[str], junctions: Mapping[Pair, Junction]) -> ContactArrays:
        """Build the arrays of junctions between the objects `ids`."""
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
