"""The play of hinges, and chains of objects that hinges join."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from scene2hap.scene.objects import SceneObject

HINGE_PLAY_M = 0.01
"""Distance of a hinge's two points, and of the boxes of its two objects, at which it ceases to hold [m] (assumed: doors
have gaps of 2 to 5 mm, and engines keep the points of joints within millimetres)."""


class KinematicChain(NamedTuple):
    """Objects that hinges join, directly or by others: their ids in scene order, and the number of objects of its
    longest series, in which each is held on the one before."""

    ids: tuple[str, ...]
    n_in_series: int


def kinematic_chains(objects: Sequence[SceneObject]) -> dict[str, KinematicChain]:
    """Return the chain of each object that is held by a hinge or holds another, by the object's id."""
    before = series({item.id: item.hinge.to for item in objects if item.hinge is not None})
    members = dict[str, list[str]]()
    for item in objects:
        first, _ = before.get(item.id, (item.id, 0))
        members.setdefault(first, []).append(item.id)
    found = dict[str, KinematicChain]()
    for together in members.values():
        if len(together) > 1:
            chain = KinematicChain(tuple(together), max(before[x][1] for x in together if x in before) + 1)
            found.update(dict.fromkeys(together, chain))
    return found


def series(on: Mapping[str, str]) -> dict[str, tuple[str, int]]:
    """Return of each held object, by its id, the id of the first object of its chain, and the number of objects before
    it, each held on the one before. Objects that hold each other have the least id of their ring.

    Parameters: on : the id of the object that holds each held object.
    """
    found: dict[str, tuple[str, int]] = {}
    for x in on:
        passed: dict[str, None] = {}
        while x in on and x not in passed and x not in found:
            passed[x] = None
            x = on[x]
        way = list(passed)
        if x in passed:
            ring = way[way.index(x) :]
            found.update(dict.fromkeys(ring, (min(ring), len(ring) - 1)))
            way = way[: -len(ring)]
        first, n = found.get(x, (x, 0))
        found.update((held, (first, n + k)) for k, held in enumerate(reversed(way), 1))
    return found
