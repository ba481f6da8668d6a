"""Which object of a pair stands on the other, and the load on the contacts of the pair.

A contact carries what stands above it: an object passes its own weight, and that of all that stands on it, to the
objects below it, in equal shares over its contacts with them. The normals of the contacts and the up axis tell which
object is above; without normals, contacts at one height between the middles of both objects do. Otherwise the lighter
object of a pair counts as the one that rests on the other, by its own weight alone: the up axis is unknown, the two
touch sideways, the lower one hangs, or a ring of objects lies on itself.
"""

from __future__ import annotations

import math
from collections import Counter, defaultdict
from collections.abc import Collection, Mapping, Sequence, Set
from typing import NamedTuple

from scene2hap.contact.junction import Pair
from scene2hap.propagation.coupled.contact_stiffness import ContactLaw
from scene2hap.propagation.plate import Plate
from scene2hap.propagation.protocol import Body, ContactNetwork, sides_m
from scene2hap.scene.geometry import Vector
from scene2hap.scene.objects import VERTICAL, Contact

_STEEP = 0.5
"""A contact carries weight if at least this part of its normal is vertical, up to a slope of 60 degrees. Assumed; on
steeper ones, objects lean or are held."""
_ONE_HEIGHT_M = 0.01
"""Largest difference in height of contacts without normals on which an object stands. Assumed; objects that are flush
side by side touch over their height."""


class PairLoad(NamedTuple):
    """Which object of a pair stands on the other, and the load on each of their contacts.

    upper : id of the object on top, None if unknown; preload_n : on each contact [N]; hangs : whether the lighter
    object stands on nothing, so that the other one, beside or above it, holds its weight.
    """

    upper: str | None
    preload_n: float
    hangs: bool = False


def standings(
    network: ContactNetwork, pairs: Mapping[Pair, Sequence[Contact]], law: ContactLaw, source_kg: Mapping[str, float]
) -> dict[Pair, PairLoad]:
    """Return who stands on whom, for pairs with contacts of a weight above 0.

    Parameters: source_kg : mass with which each source moves [kg].
    """
    ids = {object_id for pair in pairs for object_id in pair}
    stated_kg = {object_id: _stated_mass_kg(network.bodies.get(object_id)) for object_id in ids}
    masses_kg = {key: _moving_kg(network, key, source_kg) if kg is None else kg for key, kg in stated_kg.items()}
    stated = {object_id for object_id, kg in stated_kg.items() if kg is not None}
    below = _supports(network, pairs, masses_kg)
    found = _from_above(below, masses_kg, stated, law)
    for pair, contacts in pairs.items():
        if pair not in found:
            one = _lighter(pair, len(contacts), masses_kg, stated, law)
            found[pair] = one._replace(
                hangs=network.up_axis is not None and _hangs_beside(network, pair, below, masses_kg)
            )
    return found


class _Support(NamedTuple):
    """The contacts that carry an object on one below it. weight : their sum; most : the largest."""

    upper: str
    lower: str
    weight: float
    most: float


def _supports(
    network: ContactNetwork, pairs: Mapping[Pair, Sequence[Contact]], masses_kg: Mapping[str, float]
) -> dict[str, dict[Pair, _Support]]:
    """The supports of each object that stands."""
    below: dict[str, dict[Pair, _Support]] = defaultdict(dict)
    if network.up_axis is None:
        return below
    up = VERTICAL[network.up_axis]
    for pair, contacts in pairs.items():
        carrying: dict[str, list[float]] = {pair[0]: [], pair[1]: []}
        by_place = _upper_by_place(network, pair, contacts, up)
        for one in contacts:
            upper = by_place if one.normal is None else _upper_by_normal(one, one.normal[up])
            if upper is not None:
                carrying[upper].append(one.weight)
        (less, lower), (more, upper) = sorted((math.fsum(several), key) for key, several in carrying.items())
        if more > less:
            below[upper][pair] = _Support(upper, lower, more, max(carrying[upper]))
    hanging = [
        (upper, pair)
        for upper, supports in below.items()
        for pair, one in supports.items()
        if one.lower not in below and _hangs(one, supports.values(), below, masses_kg)
    ]
    for upper, pair in hanging:
        del below[upper][pair]
    return below


def _upper_by_normal(contact: Contact, rise: float) -> str | None:
    if abs(rise) < _STEEP:
        return None
    return contact.b if rise > 0 else contact.a


def _upper_by_place(network: ContactNetwork, pair: Pair, contacts: Sequence[Contact], up: int) -> str | None:
    """The object whose middle is above contacts below which the other's is, if they have no normals and one height."""
    if any(one.normal is not None for one in contacts) or not all(key in network.poses for key in pair):
        return None
    (low_m, _), (high_m, upper) = sorted((_middle_m(network, key)[up], key) for key in pair)
    heights_m = [one.point_m[up] for one in contacts]
    is_level = max(heights_m) - min(heights_m) <= _ONE_HEIGHT_M
    return upper if is_level and low_m < min(heights_m) and max(heights_m) < high_m else None


def _middle_m(network: ContactNetwork, object_id: str) -> Vector:
    """Middle of a body in the world [m]; its position if it has no size."""
    length, width = sides_m(network.bodies.get(object_id)) or (0.0, 0.0)
    x, y, z = network.poses[object_id].to_world([(length / 2, width / 2, 0.0)])[0].tolist()
    return x, y, z


def _hangs(
    one: _Support,
    others: Collection[_Support],
    below: Mapping[str, object],
    masses_kg: Mapping[str, float],
) -> bool:
    """Whether an object with nothing below it hangs from a heavier one, which something else carries: a lamp from a
    ceiling on walls."""
    kg = masses_kg[one.upper]
    return masses_kg[one.lower] < kg and any(
        other.lower in below or masses_kg[other.lower] >= kg for other in others if other is not one
    )


def _hangs_beside(
    network: ContactNetwork, pair: Pair, below: Mapping[str, object], masses_kg: Mapping[str, float]
) -> bool:
    """Whether the lighter object of a pair has nothing below it. One without a body, such as what strikes another, is
    not held at its contact."""
    least_kg = min(masses_kg[key] for key in pair)
    return any(masses_kg[key] == least_kg and key in network.bodies and not below.get(key) for key in pair)


def _from_above(
    below: Mapping[str, Mapping[Pair, _Support]], masses_kg: Mapping[str, float], stated: Set[str], law: ContactLaw
) -> dict[Pair, PairLoad]:
    """Loads of the pairs whose upper object is known, from the top down; none of a ring of objects, or below one."""
    n_above = Counter(one.lower for supports in below.values() for one in supports.values())
    passed_kg: dict[str, list[float]] = defaultdict(list)
    is_known = set(stated)
    found: dict[Pair, PairLoad] = {}
    ready = [upper for upper in below if not n_above[upper]]
    while ready:
        upper = ready.pop()
        supports = below[upper]
        load_kg = masses_kg[upper] + math.fsum(passed_kg[upper])  # in any order the same sum
        # A hand that lifts an object takes the rest of its weight.
        most = max((one.most for one in supports.values()), default=1.0)
        n_contacts = math.fsum(one.weight for one in supports.values()) / most
        for pair, one in supports.items():
            lower = one.lower
            known = [load_kg] if upper in is_known or lower in stated else []
            found[pair] = PairLoad(upper, law.preload(known, n_contacts))
            passed_kg[lower].append(load_kg * one.weight / n_contacts)
            if upper in is_known:
                is_known.add(lower)
            n_above[lower] -= 1
            if not n_above[lower] and lower in below:
                ready.append(lower)
    return found


def _lighter(
    pair: Pair, n_contacts: int, masses_kg: Mapping[str, float], stated: Set[str], law: ContactLaw
) -> PairLoad:
    """The lighter object of a pair rests on the other; unknown if no mass is stated, or both are equal.

    If one mass is stated, the other object counts as heavy as it moves: a phone on a table of 25 kg does not press as
    the table would.
    """
    if stated.isdisjoint(pair):
        return PairLoad(None, law.preload([], n_contacts))
    a, b = (masses_kg[object_id] for object_id in pair)
    upper = None if a == b else pair[a > b]
    return PairLoad(upper, law.preload([a, b], n_contacts))


def _moving_kg(network: ContactNetwork, object_id: str, source_kg: Mapping[str, float]) -> float:
    body = network.bodies.get(object_id)
    return source_kg.get(object_id, math.inf if body is None else body.moving_mass_kg)


def _stated_mass_kg(body: Body | None) -> float | None:
    """Stated mass of a whole object [kg], None if there is none."""
    if isinstance(body, Plate):
        return body.object_mass_kg
    return None if body is None else body.mass_kg
