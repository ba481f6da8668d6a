"""Hinges: bodies that are held by a pivot on another body, while their hinge's two points meet."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Mapping

from scene2hap.contact.body import Body, apart_by
from scene2hap.contact.geometry.vectors import Triple
from scene2hap.scene.hinges import HINGE_PLAY_M, series
from scene2hap.scene.objects import Contact, Hinge
from scene2hap.scene.pose import Pose, in_world


def are_hinged(x: Body, y: Body) -> bool:
    """Return True if one of two bodies has a hinge to the other."""
    return (x.hinge is not None and x.hinge.to == y.id) or (y.hinge is not None and y.hinge.to == x.id)


def pivot_m(x: Body, y: Body) -> Triple | None:
    """Return the point half way between the two points of a hinge of x or y [m]; None without one that holds."""
    if not are_hinged(x, y) or apart_by(x, y, HINGE_PLAY_M):
        return None
    body, other = (x, y) if x.hinge is not None and x.hinge.to == y.id else (y, x)
    hinge = body.hinge
    assert hinge is not None
    return _between(body.to_world(hinge.point_m), other.to_world(hinge.other_point_m))


def contacts_at(
    hinges: Mapping[str, Hinge], poses: Mapping[str, Pose], of: Collection[str] | None = None
) -> Iterator[Contact]:
    """Yield the contacts at hinges that hold: engines report none there.

    Parameters: hinges : by the id of the held object; of : only those with one of these objects; None means all.
    """
    for x, hinge in hinges.items():
        if hinge.to in poses and (of is None or x in of or hinge.to in of):
            point_m = _between(in_world(hinge.point_m, poses[x]), in_world(hinge.other_point_m, poses[hinge.to]))
            if point_m is not None:
                yield Contact(x, hinge.to, point_m)


def _between(here: Triple, there: Triple) -> Triple | None:
    """Return the point half way between the two points of a hinge [m]; None if the hinge does not hold."""
    (a, b, c), (d, e, f) = here, there
    return ((a + d) / 2, (b + e) / 2, (c + f) / 2) if math.dist(here, there) < HINGE_PLAY_M else None


class HingedBodies:
    """The bodies that hinges hold on others at their present poses: `on` has the id of the other by their own.

    Bodies that hinges join, directly or by others, are a chain. They touch at their hinges alone.

    Parameters: bodies : all bodies, changed by the caller.
    """

    def __init__(self, bodies: Mapping[str, Body]) -> None:
        self._bodies = bodies
        self.on: dict[str, str] = {}
        # From the id of a body to those of the bodies with hinges to it.
        self._with_hinge_to: dict[str, set[str]] = {}
        # From the id of each of them to that of the first body of its chain.
        self._first: dict[str, str] = {}

    def add(self, body: Body) -> None:
        """Add a body that may have a hinge."""
        if body.hinge is not None:
            self._with_hinge_to.setdefault(body.hinge.to, set()).add(body.id)

    def remove(self, body: Body) -> None:
        """Remove a body that was added, before the next `update`."""
        if body.hinge is not None:
            others = self._with_hinge_to[body.hinge.to]
            others.remove(body.id)
            if not others:
                del self._with_hinge_to[body.hinge.to]

    def are_chained(self, x: str, y: str) -> bool:
        """Return True if two bodies are of one chain."""
        first = self._first
        return bool(first) and first.get(x, x) == first.get(y, y)

    def update(self, changed: Iterable[str]) -> list[str]:
        """Look again at bodies that were added, moved or removed. Returns the ids of those whose chain is another."""
        if not self._with_hinge_to and not self.on:
            return []
        affected = set(changed)
        affected.update(*(self._with_hinge_to.get(x, ()) for x in affected))
        before = dict(self.on)
        for x in affected:
            self._update(x)
        if self.on == before:
            return []
        past, self._first = self._first, {x: first for x, (first, _) in series(self.on).items()}
        ids = past.keys() | self._first.keys() | (before.keys() ^ self.on.keys())
        return sorted(x for x in ids if x in self._bodies and past.get(x) != self._first.get(x))

    def _update(self, x: str) -> None:
        self.on.pop(x, None)
        body = self._bodies.get(x)
        other = None if body is None or body.hinge is None else self._bodies.get(body.hinge.to)
        if body is not None and other is not None and pivot_m(body, other) is not None:
            self.on[x] = other.id
