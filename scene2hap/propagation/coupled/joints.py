"""Joints that couple the bodies of a scene at its contacts, and the groups of bodies that they connect to sources."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cache, lru_cache

import numpy as np

from scene2hap.contact.junction import Pair, pair_of
from scene2hap.materials import Material
from scene2hap.propagation.coupled.contact_stiffness import ContactLaw
from scene2hap.propagation.coupled.coupling import NORMAL, Along, Joint
from scene2hap.propagation.coupled.layers import pressed_through
from scene2hap.propagation.plate import Plate
from scene2hap.propagation.protocol import Body, ContactNetwork
from scene2hap.scene.geometry import dot
from scene2hap.scene.objects import Contact
from scene2hap.scene.pose import Pose

SAME_POINT_M = 1e-6
"""Contacts of one pair that are closer than this are merged."""
Direction = tuple[float, float, float]
_PLACE_DIGITS = 6  # decimals of a position in metres, as `SAME_POINT_M`
LEVEL = 0.9
"""A contact counts as normal to a plate if at least this part of its direction is, up to 26 degrees off."""


def joints_of(network: ContactNetwork, carriers: Collection[str], law: ContactLaw) -> list[Joint]:
    """Return the joints between bodies that carry vibration, in an order that does not depend on the contacts' order.

    A contact's weight scales its stiffness; a contact of weight 0 makes no joint. Coinciding contacts of a pair act in
    parallel, so their stiffnesses add up. A soft layer also touches its support below a load (`layers`).
    """
    pairs: dict[Pair, list[Contact]] = defaultdict(list)
    for contact in network.contacts:
        if contact.weight > 0 and contact.a in carriers and contact.b in carriers:
            pairs[pair_of(contact.a, contact.b)].append(contact)
    masses = {object_id: _known_mass_kg(network, object_id) for pair in pairs for object_id in pair}
    preloads_n: dict[Pair, float] = {}
    for pair, contacts in pairs.items():
        contacts.sort(key=lambda one: (one.point_m, one.weight, one.area_m2 or 0.0))
        known = [mass for mass in (masses[pair[0]], masses[pair[1]]) if mass is not None]
        preloads_n[pair] = law.preload(known, len(contacts))
    pressed = pressed_through(network, pairs, preloads_n, law)
    touching: dict[str, list[Contact]] = defaultdict(list)
    for pair, contacts in pairs.items():
        for object_id in pair:
            touching[object_id] += contacts
            touching[object_id] += [one for one, _ in pressed.get(pair, ())]
    bodies, poses = network.bodies, network.poses
    places = {
        object_id: iter(_on_body(bodies.get(object_id), poses.get(object_id), tuple([one.point_m for one in contacts])))
        for object_id, contacts in touching.items()
    }
    axes = {object_id: _level_axis(network, object_id, contacts) for object_id, contacts in touching.items()}
    level = {object_id: axis for object_id, axis in axes.items() if axis is not None}
    directions = {
        object_id: iter(_directions(network, object_id, contacts, level)) for object_id, contacts in touching.items()
    }
    stiffness = cache(law.stiffness)  # joints are of few kinds
    joints: list[Joint] = []
    for (a, b), contacts in pairs.items():
        mass_a, mass_b = masses[a], masses[b]
        # The lighter object stands on the other; if no mass is known, neither stands.
        a_rests = mass_a is not None and (mass_b is None or mass_a < mass_b)
        b_rests = mass_b is not None and not a_rests
        materials = (_material(network, a, stands=a_rests), _material(network, b, stands=b_rests))
        found = []
        springs = [(one, stiffness(*materials, one.area_m2, preloads_n[a, b])) for one in contacts]
        for contact, (k, loss) in [*springs, *pressed.get((a, b), ())]:
            point_a_m, point_b_m, weighed = next(places[a]), next(places[b]), contact.weight * k
            alongs = next(directions[a]), next(directions[b])
            found.append(Joint(a, b, point_a_m, point_b_m, weighed, loss, 0.0, *alongs))
        joints += _merged(found)
    joints.sort(key=lambda joint: (joint.a, joint.b))
    return joints


def legs_of(network: ContactNetwork, object_id: str, plate: Plate) -> list[tuple[float, float]]:
    """Contacts of an object farther from its plate's mid-plane than the plate is thick: legs, walls or a frame."""
    pose = network.poses.get(object_id)
    points = [one.point_m for one in network.contacts if object_id in (one.a, one.b) and one.weight > 0]
    if pose is None or not points:
        return []
    heights_m = pose.to_own(points)[:, 2]
    is_far = np.abs(heights_m) > plate.thickness_m
    places = network.on_body(object_id, points)[is_far].round(_PLACE_DIGITS)
    return sorted(set(map(tuple, places.tolist())))


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
    network = ContactNetwork({} if body is None else {"": body}, (), {} if pose is None else {"": pose})
    return tuple([(x, y) for x, y in network.on_body("", points_m).tolist()])


def _level_axis(network: ContactNetwork, object_id: str, contacts: Sequence[Contact]) -> Direction | None:
    """The normal of a plate, if all its contacts are along it (`LEVEL`); else None."""
    body, pose = network.bodies.get(object_id), network.poses.get(object_id)
    if not isinstance(body, Plate) or pose is None:
        return None
    x, y, z = pose.rotation[:, 2].tolist()
    is_level = all(one.normal is None or abs(dot((x, y, z), one.normal)) >= LEVEL for one in contacts)
    return (x, y, z) if is_level else None


def _directions(
    network: ContactNetwork, object_id: str, contacts: Sequence[Contact], level: Mapping[str, Direction]
) -> Sequence[Along]:
    """Direction in which each contact acts on an object: `NORMAL` for all, unless one differs (`LEVEL`).

    Parameters: level : the normal of each plate all of whose contacts are along it.
    """
    body, pose = network.bodies.get(object_id), network.poses.get(object_id)
    if not isinstance(body, Plate) or pose is None or object_id in level:
        return [NORMAL] * len(contacts)
    x, y, z = pose.rotation.T.tolist()
    found = []
    for contact, height_m in zip(contacts, pose.to_own([one.point_m for one in contacts])[:, 2].tolist(), strict=True):
        # Both signs give the same spring, but both of its bodies must use the same sign: `NORMAL` is that of the plate.
        normal = contact.normal or z
        plate = level.get(contact.a) or level.get(contact.b)
        sign = math.copysign(1.0, max(normal, key=abs) if plate is None else dot(plate, normal))
        found.append(Along(sign * dot(x, normal), sign * dot(y, normal), sign * dot(z, normal), height_m))
    return found


def _merged(joints: Sequence[Joint]) -> list[Joint]:
    if len(joints) == 1:
        return list(joints)
    kept: list[Joint] = []
    for joint in joints:
        own = (*joint.point_a_m, *joint.point_b_m)
        for i, other in enumerate(kept):
            apart = zip(own, (*other.point_a_m, *other.point_b_m), strict=True)
            if all(abs(one - two) <= SAME_POINT_M for one, two in apart):
                kept[i] = replace(other, stiffness_n_m=other.stiffness_n_m + joint.stiffness_n_m)
                break
        else:
            kept.append(joint)
    return kept


def _known_mass_kg(network: ContactNetwork, object_id: str) -> float | None:
    """Stated mass of a whole object [kg], None if there is none."""
    body = network.bodies.get(object_id)
    return body.object_mass_kg if isinstance(body, Plate) else None


def _material(network: ContactNetwork, object_id: str, *, stands: bool) -> Material | None:
    """Material of an object at its contacts; that of its feet if it stands on them."""
    body = network.bodies.get(object_id)
    if stands and isinstance(body, Plate) and body.feet is not None:
        return body.feet
    return body.material if body is not None else None
