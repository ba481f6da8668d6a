"""Soft layers such as carpets and mats: what presses on a layer presses it onto what it lies on.

Contacts hold a layer at the ends of its area alone. Between these it yields, until it meets its support, if it sags
more than surfaces are uneven. The sag of a square plate that is simply supported is

    w = a^2 / D (0.0116 F + 0.00406 q a^2)

The contact above a layer has its yielding. Below it the force has spread by half a right angle, from Hertz's spot to
an area on which the layer lies flat:

    k = pi E (r + h)^2 / h

Letters: w [m], a [m] the layer's shorter side, D [N m], F [N] force in the middle, q [N/m2] weight per area, k [N/m],
E [Pa], r [m] radius of the spot, h [m] thickness.
Source: Timoshenko, Woinowsky-Krieger, Theory of Plates and Shells (1959), sections 30 and 34, tables 8 and 23, for the
sag; the cone is that of bolted members (Shigley, Mechanical Engineering Design, chapter 8).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import lru_cache

import numpy as np

from scene2hap.propagation.coupled.contact_stiffness import STANDARD_GRAVITY_M_S2, ContactLaw
from scene2hap.propagation.coupled.hollow import no_heavier_than_object
from scene2hap.propagation.coupled.rigid import is_compact
from scene2hap.propagation.plate import Plate
from scene2hap.propagation.protocol import ContactNetwork
from scene2hap.scene.objects import Contact

UNEVEN_M = 1e-3
"""How far from each other two surfaces lie that touch at their highest places. Assumed; flatness tolerances of finished
floors are 2 mm over 0.1 m (DIN 18202, from memory)."""
_OPPOSITE = 0.9  # Part of one normal along the other.
_SLACK = 1e-6  # of a side

Pair = tuple[str, str]
Point = tuple[float, float, float]
Spring = tuple[float, float]
"""Stiffness [N/m] and loss factor."""


def pressed_through(
    network: ContactNetwork,
    contacts: Mapping[Pair, Sequence[Contact]],
    preloads_n: Mapping[Pair, float],
    law: ContactLaw,
) -> dict[Pair, list[tuple[Contact, Spring]]]:
    """Return further contacts of layers with what they lie on, each with its spring, by sorted pair.

    Parameters: contacts : by sorted pair; preloads_n : on each contact of a pair [N].
    """
    beside: dict[str, list[str]] = {}
    for a, b in contacts:
        beside.setdefault(a, []).append(b)
        beside.setdefault(b, []).append(a)
    layers = {key: body for key in beside if len(beside[key]) > 1 and (body := _layer(network, key)) is not None}
    waiting = [
        (other, layer, contact, preloads_n[_sorted(other, layer)])
        for layer in sorted(layers)
        for other in sorted(beside[layer])
        for contact in contacts[_sorted(other, layer)]
    ]
    found: dict[Pair, list[tuple[Contact, Spring]]] = {}
    seen: set[tuple[Pair, Point]] = set()
    while waiting:
        by, layer, contact, force_n = waiting.pop(0)
        if sag_m(layers[layer], force_n) < UNEVEN_M:
            continue
        for under in sorted(beside[layer]):
            pair = _sorted(layer, under)
            point_m = _below(network, layer, contact, contacts[pair]) if under != by else None
            if point_m is None or (pair, point_m) in seen:
                continue
            seen.add((pair, point_m))
            normal = contacts[pair][0].normal
            own = Contact(*pair, point_m, _turned(normal, contacts[pair][0].a != pair[0]), weight=contact.weight)
            found.setdefault(pair, []).append((own, through(layers[layer], force_n, law)))
            if under in layers:
                waiting.append((layer, under, own, force_n))
    return found


@lru_cache(maxsize=4096)
def sag_m(plate: Plate, force_n: float) -> float:
    """Return how far a layer sags between its ends under a force and its weight [m]."""
    side = min(plate.extent_m)
    weight_n_m2 = STANDARD_GRAVITY_M_S2 * plate.material.density_kg_m3 * plate.thickness_m
    return side**2 / plate.bending_stiffness_nm * (0.0116 * force_n + 0.00406 * weight_n_m2 * side**2)


@lru_cache(maxsize=4096)
def through(plate: Plate, force_n: float, law: ContactLaw) -> Spring:
    """Return the spring below a layer at a point that is pressed."""
    material, h = plate.material, plate.thickness_m
    modulus = material.youngs_modulus_pa / (1 - material.poisson_ratio**2)
    spot_m = (0.75 * force_n * law.tip_radius_m / modulus) ** (1 / 3)
    stiffness = math.pi * material.youngs_modulus_pa * (spot_m + h) ** 2 / h
    return stiffness, max(material.loss_factor, law.loss_floor)


def _layer(network: ContactNetwork, object_id: str) -> Plate | None:
    body = network.bodies.get(object_id)
    if not isinstance(body, Plate) or object_id not in network.poses or body.edges != "FFFF" or is_compact(body):
        return None
    return no_heavier_than_object(body)


def _below(network: ContactNetwork, layer: str, pressing: Contact, contacts: Sequence[Contact]) -> Point | None:
    """Return where a layer is pressed onto an object, by the contacts with it; None if it is not.

    The object must be on the layer's other side, close by, and around the pressed point.
    """
    body, pose = network.bodies[layer], network.poses[layer]
    assert isinstance(body, Plate)
    towards = _outwards(layer, pressing)
    away = [_outwards(layer, one) for one in contacts]
    if towards is None or any(one is None or np.dot(one, towards) > -_OPPOSITE for one in away):
        return None
    own = pose.to_own([pressing.point_m, *(one.point_m for one in contacts)])
    if (np.abs(own[:, 2]) > body.thickness_m).any():
        return None
    slack = _SLACK * max(body.extent_m)
    low, high = own[1:, :2].min(axis=0) - slack, own[1:, :2].max(axis=0) + slack
    if not ((low <= own[0, :2]) & (own[0, :2] <= high)).all():
        return None
    x, y, z = pose.to_world([(own[0, 0], own[0, 1], own[1:, 2].mean())])[0].tolist()
    return (x, y, z)


def _outwards(object_id: str, contact: Contact) -> Point | None:
    return _turned(contact.normal, contact.a != object_id)


def _turned(normal: Point | None, is_turned: bool) -> Point | None:
    if normal is None or not is_turned:
        return normal
    x, y, z = normal
    return (-x, -y, -z)


def _sorted(a: str, b: str) -> Pair:
    return (a, b) if a < b else (b, a)
