"""From the contacts of a scene to the joints that couple its bodies, and to what a source can reach through them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from scene2hap.materials import Material
from scene2hap.propagation.contact_law import ContactLaw
from scene2hap.propagation.coupling import Joint
from scene2hap.propagation.protocol import ContactNetwork
from scene2hap.scene.snapshot import Contact

SAME_POINT_M = 1e-6
"""Contacts of one pair that are nearer than this are one."""


def joints_of(network: ContactNetwork, carriers: Collection[str], law: ContactLaw) -> list[Joint]:
    """The joints between bodies that carry vibration, in an order that does not depend on the contacts' order.

    A contact's weight scales its stiffness; without weight it is none. Coinciding contacts of a pair act side by side,
    so that their stiffnesses add up.
    """
    pairs: dict[tuple[str, str], list[Contact]] = defaultdict(list)
    for contact in network.contacts:
        if contact.weight > 0 and contact.a in carriers and contact.b in carriers:
            first, second = sorted((contact.a, contact.b))
            pairs[first, second].append(contact)
    touching: dict[str, list[Contact]] = defaultdict(list)
    for pair, contacts in pairs.items():
        contacts.sort(key=lambda one: (one.point_m, one.weight, one.area_m2 or 0.0))
        for object_id in pair:
            touching[object_id] += contacts
    places = {
        object_id: iter(network.on_body(object_id, [one.point_m for one in contacts]).tolist())
        for object_id, contacts in touching.items()
    }
    joints: list[Joint] = []
    for (a, b), contacts in pairs.items():
        materials = (_material(network, a), _material(network, b))
        joints += _merged(
            _joint(a, b, next(places[a]), next(places[b]), contact, materials, law) for contact in contacts
        )
    joints.sort(key=lambda joint: (joint.a, joint.b))
    return joints


def reached(joints: Sequence[Joint], source_ids: Iterable[str]) -> list[tuple[list[str], list[Joint]]]:
    """Groups of bodies that hang together and hold a source: their sources, and all of their joints."""
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


def _joint(
    a: str,
    b: str,
    at_a: Sequence[float],
    at_b: Sequence[float],
    contact: Contact,
    materials: tuple[Material | None, Material | None],
    law: ContactLaw,
) -> Joint:
    stiffness, loss = law.stiffness(*materials, contact.area_m2)
    return Joint(a, b, (at_a[0], at_a[1]), (at_b[0], at_b[1]), contact.weight * stiffness, loss)


def _merged(joints: Iterable[Joint]) -> list[Joint]:
    kept: list[Joint] = []
    for joint in joints:
        for i, other in enumerate(kept):
            apart = np.subtract((*joint.point_a_m, *joint.point_b_m), (*other.point_a_m, *other.point_b_m))
            if np.abs(apart).max() <= SAME_POINT_M:
                kept[i] = replace(other, stiffness_n_m=other.stiffness_n_m + joint.stiffness_n_m)
                break
        else:
            kept.append(joint)
    return kept


def _material(network: ContactNetwork, object_id: str) -> Material | None:
    body = network.bodies.get(object_id)
    return body.material if body is not None else None
