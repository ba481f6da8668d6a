"""Soft layers such as carpets and mats, pressed onto their support by the objects that stand on them.

The contacts of a layer with its support are at the ends of their common area. Between these contacts the layer sags,
and touches its support if the sag exceeds the unevenness of surfaces. The sag of a simply supported square plate is

    w = a^2 / D (0.0116 F + 0.00406 q a^2)

The contact above a layer has Hertz's stiffness, which includes what yields around the spot. Through the layer the force
spreads in a cone, by half a right angle, from the spot to a larger area of the support. The spring below is a column of
that area, without the narrow part of the cone, which Hertz's stiffness includes:

    k = pi E (r + h)^2 / h                    of the whole cone it would be pi E r (r + h) / h

Letters: w [m], a [m] the layer's shorter side, D [N m], F [N] force in the middle, q [N/m2] weight per area, k [N/m],
E [Pa], r [m] radius of the spot, h [m] thickness.
Source: Timoshenko, Woinowsky-Krieger, Theory of Plates and Shells (1959), sections 30 and 34, tables 8 and 23, for the
sag; the cone is that of bolted members (Shigley, Mechanical Engineering Design, chapter 8), the column assumed.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from operator import itemgetter

import numpy as np

from scene2hap.contact.junction import Pair, pair_of
from scene2hap.propagation.bodies.idealisation import is_compact, no_heavier_than_object
from scene2hap.propagation.coupled.contact_stiffness import STANDARD_GRAVITY_M_S2, ContactLaw
from scene2hap.propagation.plate import Plate
from scene2hap.propagation.protocol import ContactNetwork
from scene2hap.scene.geometry import Vector, dot
from scene2hap.scene.objects import Contact
from scene2hap.scene.pose import Pose

UNEVEN_M = 1e-3
"""Distance of two surfaces that touch at their highest points [m]. Assumed; flatness tolerances of finished floors are
2 mm over 0.1 m (DIN 18202, from memory)."""
_OPPOSITE = 0.9  # Part of one normal along the other.
_SLACK = 1e-6  # of a side

Spring = tuple[float, float]
"""Stiffness [N/m] and loss factor."""


def pressed_through(
    network: ContactNetwork,
    contacts: Mapping[Pair, Sequence[Contact]],
    preloads_n: Mapping[Pair, float],
    law: ContactLaw,
) -> dict[Pair, list[tuple[Contact, Spring]]]:
    """Return further contacts of layers with their supports, each with its spring, by sorted pair.

    Parameters: contacts : by sorted pair; preloads_n : on each contact of a pair [N].
    """
    beside: dict[str, list[str]] = {}
    for a, b in contacts:
        beside.setdefault(a, []).append(b)
        beside.setdefault(b, []).append(a)
    layers: dict[str, Plate] = {}
    sagging_n: dict[str, float] = {}
    for key, others in beside.items():
        plate = _layer(network, key) if len(others) > 1 else None
        if plate is None:
            continue
        least_n = _sagging_n(plate)
        if max(preloads_n[pair_of(key, other)] for other in others) >= least_n:
            layers[key], sagging_n[key] = plate, least_n
    # By direction, since hundreds of objects may stand on one face of a layer, and none of them is below another.
    beds: dict[str, dict[Vector, list[tuple[str, _Bed]]]] = {}
    for layer in layers:
        facing = beds.setdefault(layer, {})
        for under in sorted(beside[layer]):
            bed = _Bed.of(network, layer, under, contacts[pair_of(layer, under)])
            if bed is not None:
                facing.setdefault(bed.away, []).append((under, bed))
    waiting = deque(
        (by, layer, contact, preloads_n[pair_of(by, layer)])
        for layer in sorted(layers)
        for by in sorted(beside[layer])
        if preloads_n[pair_of(by, layer)] >= sagging_n[layer]
        for contact in contacts[pair_of(by, layer)]
    )
    found: dict[Pair, list[tuple[Contact, Spring]]] = {}
    seen: set[tuple[Pair, Vector]] = set()
    while waiting:
        by, layer, contact, force_n = waiting.popleft()
        towards = _outwards(layer, contact)
        if towards is None:
            continue
        opposite = [one for away, several in beds[layer].items() if dot(towards, away) <= -_OPPOSITE for one in several]
        for under, bed in sorted(opposite, key=itemgetter(0)):
            pair, point_m = pair_of(layer, under), bed.below(contact.point_m)
            if under == by or point_m is None or (pair, point_m) in seen:
                continue
            seen.add((pair, point_m))
            normal = _turned(bed.away, pair[0] != layer)
            own = Contact(*pair, point_m, normal, weight=contact.weight)
            found.setdefault(pair, []).append((own, through(layers[layer], force_n, law)))
            if force_n >= sagging_n.get(under, math.inf):
                waiting.append((layer, under, own, force_n))
    return found


def sag_m(plate: Plate, force_n: float) -> float:
    """Return the sag of a layer between its ends under a force and its weight [m]."""
    by_weight_m, per_n = _sags(plate)
    return by_weight_m + per_n * force_n


def _sags(plate: Plate) -> tuple[float, float]:
    """Return the sag of a layer between its ends under its weight [m], and by each newton in its middle [m/N]."""
    side = min(plate.extent_m)
    weight_n_m2 = STANDARD_GRAVITY_M_S2 * plate.material.density_kg_m3 * plate.thickness_m
    yielding = side**2 / plate.bending_stiffness_nm
    return 0.00406 * weight_n_m2 * side**2 * yielding, 0.0116 * yielding


@lru_cache(maxsize=4096)
def through(plate: Plate, force_n: float, law: ContactLaw) -> Spring:
    """Return the spring of a layer and its support below a pressed point."""
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


@lru_cache(maxsize=4096)
def _sagging_n(plate: Plate) -> float:
    """Return the force under which a layer sags onto its support [N]; 0 or less if its weight suffices."""
    by_weight_m, per_n = _sags(plate)
    return (UNEVEN_M - by_weight_m) / per_n


@dataclass(frozen=True, eq=False)
class _Bed:
    """Where a layer lies on an object: the area between its contacts, in the frame of the layer.

    Parameters: pose : of the layer; away : the normal out of the layer; low_m, high_m : corners of the area;
    height_m : of the contacts; most_m : the farthest that a pressed point may be from the mid-plane; facing : pose and
    size of a plate that must be there, None for a compact object.
    """

    pose: Pose
    away: Vector
    low_m: tuple[float, float]
    high_m: tuple[float, float]
    height_m: float
    most_m: float
    facing: tuple[Pose, float, float] | None

    @classmethod
    def of(cls, network: ContactNetwork, layer: str, under: str, contacts: Sequence[Contact]) -> _Bed | None:
        """Return None if the contacts are not all on one side of the layer, near it, and on a face of the object."""
        body, pose, other = network.bodies[layer], network.poses[layer], network.bodies.get(under)
        away = _outwards(layer, contacts[0])
        if not isinstance(body, Plate) or other is None or away is None:
            return None
        for one in contacts:
            normal = _outwards(layer, one)
            if normal is None or dot(normal, away) < _OPPOSITE:
                return None
        own = pose.to_own([one.point_m for one in contacts])
        if (np.abs(own[:, 2]) > body.thickness_m).any():
            return None
        facing = None
        if isinstance(other, Plate) and under in network.poses and not is_compact(other):
            facing = network.poses[under], other.length_m, other.width_m
            if abs(dot(facing[0].rotation[:, 2].tolist(), away)) < _OPPOSITE:
                return None  # a wall, which carries at its edge alone
        (x0, y0, _), (x1, y1, _) = own.min(axis=0).tolist(), own.max(axis=0).tolist()
        slack = _SLACK * max(body.extent_m)
        low, high = (x0 - slack, y0 - slack), (x1 + slack, y1 + slack)
        return cls(pose, away, low, high, float(own[:, 2].mean()), body.thickness_m, facing)

    def below(self, pressed_m: Vector) -> Vector | None:
        """Return where a layer that is pressed at a point of its other face is pressed onto the object; None if it is
        not."""
        x, y, z = self.pose.to_own([pressed_m])[0].tolist()
        is_around = self.low_m[0] <= x <= self.high_m[0] and self.low_m[1] <= y <= self.high_m[1]
        if abs(z) > self.most_m or not is_around:
            return None
        a, b, c = self.pose.to_world([(x, y, self.height_m)])[0].tolist()
        if self.facing is not None:
            pose, length, width = self.facing
            u, v, _ = pose.to_own([(a, b, c)])[0].tolist()
            slack = _SLACK * max(length, width)
            if not (-slack <= u <= length + slack and -slack <= v <= width + slack):
                return None
        return (a, b, c)


def _outwards(object_id: str, contact: Contact) -> Vector | None:
    return _turned(contact.normal, contact.a != object_id)


def _turned(normal: Vector | None, is_turned: bool) -> Vector | None:
    if normal is None or not is_turned:
        return normal
    x, y, z = normal
    return (-x, -y, -z)
