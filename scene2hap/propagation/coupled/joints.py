"""Joints that couple the bodies of a scene at its contacts, and the groups of bodies that they connect to sources."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cache, lru_cache
from operator import sub

import numpy as np

from scene2hap.contact.junction import Pair, pair_of
from scene2hap.materials import Material
from scene2hap.propagation.coupled.contact_stiffness import FADING_LOSS, ContactLaw
from scene2hap.propagation.coupled.coupling import NORMAL, REVERSED, ForceDirection, Joint
from scene2hap.propagation.coupled.layers import Spring, pressed_through
from scene2hap.propagation.coupled.standing import standings
from scene2hap.propagation.plate import Plate
from scene2hap.propagation.points import as_points
from scene2hap.propagation.protocol import Body, ContactNetwork, placing_of, sides_m
from scene2hap.scene.geometry import dot
from scene2hap.scene.objects import VERTICAL, Contact
from scene2hap.scene.pose import Pose

SAME_POINT_M = 1e-6
"""Contacts of one pair that are closer than this are merged."""
Direction = tuple[float, float, float]
Axes = tuple[Direction, Direction, Direction]
_PLACE_DIGITS = 6  # decimals of a position in metres, as `SAME_POINT_M`
LEVEL = math.cos(math.radians(1.0))
"""A contact counts as normal to a plate if at least this part of its direction is. Gains step by 0.003 dB at this bound
(median of tilted boards; 0.04 dB at the 90th percentile). At 26 degrees they would step by 1.4 dB."""
_AGAINST = -1e-3
"""A direction below this part of another is opposed to it (assumed). Perpendicular ones are not: poses that tremble by
some microradians, as those of a physics engine, would turn them over."""


def joints_of(
    network: ContactNetwork,
    carriers: Collection[str],
    law: ContactLaw,
    source_kg: Mapping[str, float],
) -> list[Joint]:
    """Return the joints between bodies that carry vibration, in an order that does not depend on the contacts' order.

    A contact's weight scales its stiffness, and one that fades loses more (`FADING_LOSS`); a contact of weight 0 makes
    no joint. Contacts of a pair in one place and direction act in parallel, so their stiffnesses add up. A soft layer
    also touches its support below a load (`layers`).

    Parameters: source_kg : mass with which each source moves [kg].
    """
    springs = _springs(network, carriers, law, source_kg)
    touching: dict[str, list[Contact]] = defaultdict(list)
    for pair, several in springs.items():
        for object_id in pair:
            touching[object_id] += [contact for contact, _ in several]
    bodies, poses = network.bodies, network.poses
    # Of each object the end at each of its contacts, taken in the order of the contacts.
    places = {
        object_id: iter(_on_body(bodies.get(object_id), poses.get(object_id), tuple([one.point_m for one in contacts])))
        for object_id, contacts in touching.items()
    }
    directions = {object_id: iter(alongs) for object_id, alongs in _directions(network, touching).items()}
    joints: list[Joint] = []
    for (a, b), several in springs.items():
        found = []
        for contact, (k, loss) in several:
            points_m, alongs = (next(places[a]), next(places[b])), (next(directions[a]), next(directions[b]))
            fading = FADING_LOSS * (1 - contact.weight)
            found.append(Joint(a, b, *points_m, contact.weight * k, loss + fading, 0.0, *alongs))
        joints += _merged(found)
    joints.sort(key=lambda joint: (joint.a, joint.b))
    return joints


def _springs(
    network: ContactNetwork, carriers: Collection[str], law: ContactLaw, source_kg: Mapping[str, float]
) -> dict[Pair, list[tuple[Contact, Spring]]]:
    """Contacts of each pair, those below a pressed layer last, each with its spring at a weight of 1.

    A contact is there once for each of its `_ways`, with that as its normal.
    """
    pairs: dict[Pair, list[Contact]] = defaultdict(list)
    for contact in network.contacts:
        if contact.weight > 0 and contact.a in carriers and contact.b in carriers:
            pairs[pair_of(contact.a, contact.b)].append(contact)
    for contacts in pairs.values():
        contacts.sort(key=lambda one: (one.point_m, one.weight, one.area_m2 or 0.0))
    standing = standings(network, pairs, law, source_kg)
    preloads_n = {pair: own.preload_n for pair, own in standing.items()}
    pressed = pressed_through(network, pairs, preloads_n, law)
    stiffness = cache(law.stiffness)  # joints are of few kinds
    springs: dict[Pair, list[tuple[Contact, Spring]]] = {}
    for pair, contacts in pairs.items():
        upper = standing[pair].upper
        materials = [_material(network, object_id, stands=object_id == upper) for object_id in pair]
        own = [
            (
                one if way is one.normal else replace(one, normal=way),
                stiffness(*materials, one.area_m2, preloads_n[pair]),
            )
            for one in contacts
            for way in _ways(network, one, hangs=standing[pair].hangs)
        ]
        springs[pair] = own + pressed.get(pair, [])
    return springs


def _ways(network: ContactNetwork, contact: Contact, *, hangs: bool) -> list[Direction | None]:
    """Directions of the springs of a contact, orthogonal unit vectors; None if no body has axes, see `_axes`.

    A contact without a normal, where surfaces are flush or intersect, joins them: in the plane of both of their normals
    it yields equally. A contact of an object that hangs holds it along the vertical too, by screws or by friction; that
    is nearly as stiff (Mindlin: 2 (1 - nu) / (2 - nu) of the stiffness along the normal, 0.8).
    """
    if contact.normal is not None:
        along = [contact.normal]
    else:
        along = [own[2] for own in (_axes(network, contact.a), _axes(network, contact.b)) if own is not None]
    if hangs and along and network.up_axis is not None:
        along.append((0.0, 1.0, 0.0) if VERTICAL[network.up_axis] == 1 else (0.0, 0.0, 1.0))
    if len(along) < 2:
        return [*along] or [None]
    found: list[Direction | None] = [along[0]]
    basis = np.array(along[:1])
    for one in along[1:]:
        across = one - (basis @ one) @ basis
        length = float(np.linalg.norm(across))
        if length**2 > 1 - LEVEL**2:
            x, y, z = (across / length).tolist()
            found.append((x, y, z))
            basis = np.vstack([basis, across / length])
    return found


def legs_of(network: ContactNetwork, object_id: str, plate: Plate) -> list[tuple[float, float]]:
    """Contacts of an object farther from its plate's mid-plane than the plate is thick: legs, walls or a frame."""
    pose = network.poses.get(object_id)
    points = [one.point_m for one in network.contacts if object_id in (one.a, one.b) and one.weight > 0]
    if pose is None or not points:
        return []
    heights_m = pose.to_own(points)[:, 2]
    is_far = np.abs(heights_m) > plate.thickness_m
    places = sorted(map(tuple, network.on_body(object_id, points)[is_far].tolist()))
    # One for each place, itself not rounded: where it would be moved to depends on the corner of the plate.
    return sorted({tuple(np.round(place, _PLACE_DIGITS)): place for place in places}.values())


def source_groups(joints: Sequence[Joint], source_ids: Iterable[str]) -> list[tuple[list[str], list[Joint]]]:
    """Connected groups of bodies that contain a source: the sources and the joints of each."""
    beside: Mapping[str, list[int]] = defaultdict(list)
    for row, joint in enumerate(joints):
        beside[joint.a].append(row)
        beside[joint.b].append(row)
    waiting, groups = sorted(set(source_ids)), []
    seen: set[str] = set()
    for start in waiting:
        if start in seen:
            continue
        members, rows, front = {start}, set[int](), [start]
        while front:
            for row in beside[front.pop()]:
                rows.add(row)
                new = {joints[row].a, joints[row].b} - members
                members |= new
                front += new
        seen |= members
        groups.append(([x for x in waiting if x in members], [joints[row] for row in sorted(rows)]))
    return groups


@lru_cache(maxsize=4096)
def _on_body(
    body: Body | None, pose: Pose | None, points_m: tuple[tuple[float, float, float], ...]
) -> tuple[tuple[float, float], ...]:
    """See `ContactNetwork.on_body`. Cached, since most objects stay where they are."""
    return tuple([(x, y) for x, y in placing_of(body, pose)(as_points(points_m, 3)).tolist()])


def _axes(network: ContactNetwork, object_id: str) -> Axes | None:
    """Directions of the length, the width and the normal of a body in the world; None for a body without them."""
    pose = network.poses.get(object_id)
    if pose is None or sides_m(network.bodies.get(object_id)) is None:
        return None
    x, y, z = map(tuple, pose.rotation.T.tolist())
    return x, y, z


def _is_level(normal: Direction, contacts: Sequence[Contact]) -> bool:
    """Whether all contacts are along a normal (`LEVEL`)."""
    return all(one.normal is None or abs(dot(normal, one.normal)) >= LEVEL for one in contacts)


def _directions(network: ContactNetwork, touching: Mapping[str, Sequence[Contact]]) -> dict[str, list[ForceDirection]]:
    """Direction in which each contact acts on each object that it touches: `NORMAL` or `REVERSED` for all contacts of
    an object, unless one differs (`LEVEL`)."""
    axes = {object_id: _axes(network, object_id) for object_id in touching}
    level = {
        object_id: own[2]
        for object_id, own in axes.items()
        if own is not None and _is_level(own[2], touching[object_id])
    }
    return {
        object_id: _directions_on(network, object_id, contacts, axes, level) for object_id, contacts in touching.items()
    }


def _directions_on(
    network: ContactNetwork,
    object_id: str,
    contacts: Sequence[Contact],
    axes: Mapping[str, Axes | None],
    level: Mapping[str, Direction],
) -> list[ForceDirection]:
    """Directions of the contacts of one object.

    Parameters: axes : see `_axes`; level : the normal of each body all of whose contacts are along it.
    """
    own = axes[object_id]
    if own is None:
        return [NORMAL] * len(contacts)
    x, y, z = own
    found = []
    for contact in contacts:
        way = _way(contact)
        along = z if object_id in level else way
        sign = -1.0 if dot(along, way) < _AGAINST else 1.0
        if object_id in level:
            found.append(NORMAL if sign > 0 else REVERSED)
            continue
        (height_m,) = network.poses[object_id].to_own([contact.point_m])[:, 2].tolist()
        found.append(ForceDirection(sign * dot(x, along), sign * dot(y, along), sign * dot(z, along), height_m))
    return found


def _way(contact: Contact) -> Direction:
    """Direction of the spring at a contact, the same for both of its bodies.

    Both signs give the same spring, with one exception: a body without axes has to move in phase at contacts above and
    below it, so that the largest component is positive.
    """
    x, y, z = contact.normal or (0.0, 0.0, 1.0)
    return (x, y, z) if max(x, y, z, key=abs) > 0 else (-x, -y, -z)


def _merged(joints: Sequence[Joint]) -> list[Joint]:
    """Return the joints of a pair, merged where place and direction are the same."""
    if len(joints) == 1:
        return list(joints)
    kept: list[tuple[tuple[float, ...], Joint]] = []
    for joint in joints:
        own = (*joint.point_a_m, *joint.point_b_m, *joint.along_a, *joint.along_b)
        for i, (place, other) in enumerate(kept):
            if max(map(abs, map(sub, own, place))) <= SAME_POINT_M:
                kept[i] = place, _in_parallel(other, joint)
                break
        else:
            kept.append((own, joint))
    return [joint for _, joint in kept]


def _in_parallel(one: Joint, other: Joint) -> Joint:
    total = one.stiffness_n_m + other.stiffness_n_m
    loss = (one.stiffness_n_m * one.loss_factor + other.stiffness_n_m * other.loss_factor) / total
    return replace(one, stiffness_n_m=total, loss_factor=loss)


def _material(network: ContactNetwork, object_id: str, *, stands: bool) -> Material | None:
    """Material of an object at its contacts; that of its feet if it stands on them."""
    body = network.bodies.get(object_id)
    if stands and isinstance(body, Plate) and body.feet is not None:
        return body.feet
    return body.material if body is not None else None
