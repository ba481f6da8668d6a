"""Mats and carpets: what stands on a soft layer reaches the floor below through the layer's thickness."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from scene2hap import (
    AutoFidelity,
    Bands,
    Contact,
    ContactNetwork,
    Excitation,
    ModalPlate,
    Plate,
    Pose,
    RigidBody,
    materials,
)
from scene2hap.propagation.coupled import layers
from scene2hap.propagation.coupled.contact_stiffness import HARD_PLASTIC, ContactLaw
from scene2hap.propagation.coupled.joints import joints_of
from scene2hap.propagation.coupled.layers import UNEVEN_M, sag_m

CORK, CONCRETE, OAK = (materials.lookup(name) for name in ("cork", "concrete", "oak"))
UP = (0.0, 0.0, 1.0)
FLOOR = Plate(4.0, 3.0, 0.2, CONCRETE)
FEET = [(0.15, 0.15), (0.55, 0.15), (0.15, 0.55), (0.55, 0.55)]
MASS_KG, LAW = 20.0, ContactLaw(preload_n=50.0)


def stacked(*layers: Plate) -> ContactNetwork:
    """A machine on layers, from the lowest up, on a floor; each lies on its corners."""
    bodies, poses, contacts, below, z = {"floor": FLOOR}, {"floor": Pose((-1.5, -1.0, -0.1))}, [], "floor", 0.0
    for k, layer in enumerate(layers):
        name = f"layer {k}"
        corners = [(x, y, z) for x in (0.0, layer.length_m) for y in (0.0, layer.width_m)]
        contacts += [Contact(below, name, at, UP) for at in corners]
        bodies[name], poses[name] = layer, Pose((0.0, 0.0, z + layer.thickness_m / 2))
        below, z = name, z + layer.thickness_m
    contacts += [Contact(below, "machine", (x, y, z), UP) for x, y in FEET]
    return ContactNetwork(bodies, tuple(contacts), poses)


def joints_between(network: ContactNetwork, a: str, b: str) -> int:
    joints = joints_of(network, {*network.bodies, "machine"}, LAW, {})
    return sum({joint.a, joint.b} == {a, b} for joint in joints)


def mat(thickness_m: float = 0.008, material: materials.Material = CORK) -> Plate:
    return Plate(0.7, 0.7, thickness_m, material)


def hertz(one: materials.Material, other: materials.Material) -> complex:
    compliance: complex = sum(
        (1 - m.poisson_ratio**2) / (m.youngs_modulus_pa * (1 + 1j * m.loss_factor)) for m in (one, other)
    )
    modulus = 1 / compliance
    stiffness: float = (6 * LAW.preload_n * LAW.tip_radius_m * abs(modulus) ** 2) ** (1 / 3)
    return stiffness * (1 + 1j * max(modulus.imag / modulus.real, LAW.loss_floor))


@pytest.mark.parametrize("model", [ModalPlate(contact=LAW), AutoFidelity(contact=LAW)])
@pytest.mark.parametrize("low_hz", [20.0, 40.0])
def test_a_machine_on_a_mat_is_a_mass_on_springs_in_series(model: ModalPlate, low_hz: float) -> None:
    """On a floor that hardly yields, a free mass pushes by k / (k - m omega^2): by k of four feet, or with k of four
    places of the mat in series. The mat alone would carry the machine by its corners, 40 dB lower."""
    band = Bands((low_hz, 1.05 * low_hz))
    source, at = [Excitation("machine", low_hz, low_hz, MASS_KG)], [[2.0, 1.0, -0.1], [-1.0, 0.5, -0.1]]
    on_mat, bare = (
        model.prepare(network, source, band).attenuation("floor", at)[:, 0, 0]
        for network in (stacked(mat()), stacked())
    )
    E, h = CORK.youngs_modulus_pa, 0.008
    spot = (0.75 * LAW.preload_n * LAW.tip_radius_m * (1 - CORK.poisson_ratio**2) / E) ** (1 / 3)
    through = math.pi * E * (spot + h) ** 2 / h * (1 + 1j * CORK.loss_factor)
    inertia = MASS_KG * (2 * math.pi * low_hz * 1.025) ** 2
    soft, hard = 4 / (1 / hertz(HARD_PLASTIC, CORK) + 1 / through), 4 * hertz(HARD_PLASTIC, CONCRETE)
    expected = abs(soft / (soft - inertia)) / abs(hard / (hard - inertia))
    np.testing.assert_allclose(20 * np.log10(on_mat / bare), 20 * math.log10(expected), atol=1.0)


def test_sag_is_that_of_the_series_of_navier() -> None:
    """w = sum of P_mn / (D pi^4 (m^2 + n^2)^2 / a^4) in the middle, m and n odd."""
    plate, force_n = replace(mat(), width_m=0.7), 30.0
    a, D = 0.7, plate.bending_stiffness_nm
    weight = 9.80665 * CORK.density_kg_m3 * plate.thickness_m
    m, n = np.meshgrid(np.arange(1, 200, 2), np.arange(1, 200, 2))
    signs = (-1.0) ** ((m - 1) // 2 + (n - 1) // 2)
    load = 4 * force_n / a**2 + 16 * weight * signs / (math.pi**2 * m * n)
    expected = (load * a**4 / (D * math.pi**4 * (m**2 + n**2) ** 2)).sum()
    assert sag_m(plate, force_n) == pytest.approx(expected, rel=5e-3)


def test_stiff_boards_touch_at_their_own_contacts_only() -> None:
    board = mat(0.02, OAK)
    assert sag_m(board, LAW.preload_n) < UNEVEN_M < sag_m(mat(), LAW.preload_n)
    assert joints_between(stacked(board), "floor", "layer 0") == 4
    assert joints_between(stacked(mat()), "floor", "layer 0") == 8


def test_a_layer_that_lies_flat_by_its_weight_is_pressed_by_any_load() -> None:
    """A slab of 100 km weighs so much that a newton more does not change its sag in floating point."""
    assert joints_between(stacked(Plate(1e5, 1e5, 1e3, OAK)), "floor", "layer 0") == 8


def test_layers_on_layers_are_pressed_too() -> None:
    network = stacked(mat(), mat(0.006))
    assert joints_between(network, "layer 0", "layer 1") == joints_between(network, "floor", "layer 0") == 8


def test_only_what_lies_flat_below_the_pressed_place_is_pressed() -> None:
    network = stacked(mat())
    aside = [replace(one, point_m=(2.0, 0.3, 0.008)) if one.b == "machine" else one for one in network.contacts]
    assert joints_between(replace(network, contacts=tuple(aside)), "floor", "layer 0") == 4
    unknown = [replace(one, normal=None) for one in network.contacts]
    assert joints_between(replace(network, contacts=tuple(unknown)), "floor", "layer 0") == 4
    legs = [replace(one, point_m=(*one.point_m[:2], -0.4)) if one.a == "floor" else one for one in network.contacts]
    assert joints_between(replace(network, contacts=tuple(legs)), "floor", "layer 0") == 4
    wall = replace(network, poses={**network.poses, "floor": Pose((-1.5, -1.0, -0.1), (0.5**0.5, 0.0, 0.0, 0.5**0.5))})
    assert joints_between(wall, "floor", "layer 0") == 4
    small = replace(network, bodies={**network.bodies, "floor": Plate(1.6, 1.1, 0.2, CONCRETE)})
    assert joints_between(small, "floor", "layer 0") == 4
    rigid = replace(network, bodies={**network.bodies, "layer 0": RigidBody(1.0)})
    assert joints_between(rigid, "floor", "layer 0") == 4


def test_joints_do_not_depend_on_the_order_of_contacts() -> None:
    network = stacked(mat(), mat(0.006))
    names = {*network.bodies, "machine"}
    turned = replace(network, contacts=network.contacts[::-1])
    assert joints_of(network, names, LAW, {}) == joints_of(turned, names, LAW, {})


def test_objects_on_one_face_are_not_below_each_other(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without this, hundreds of objects on a floor that sags cost a second."""
    calls: list[object] = []
    below = layers._Bed.below
    monkeypatch.setattr(layers._Bed, "below", lambda *args: calls.append(args) or below(*args))
    assert joints_between(stacked(mat()), "layer 0", "floor") == 8
    assert calls, "the floor is below what presses the mat"
    calls.clear()
    boards = {f"board {k}": RigidBody(20.0, (0.3, 0.3, 0.3)) for k in range(6)}
    bodies: dict[str, Plate | RigidBody] = {"floor": Plate(4.0, 3.0, 0.02, OAK), **boards}
    contacts = [Contact("floor", key, (0.5 * k + x, 0.5, 0.02), UP) for k, key in enumerate(boards) for x in (0.0, 0.3)]
    poses = {"floor": Pose(), **{key: Pose((0.5 * k, 0.5, 0.02)) for k, key in enumerate(boards)}}
    joints = joints_of(ContactNetwork(bodies, contacts, poses), bodies.keys(), LAW, {})
    assert len(joints) == len(contacts)
    assert not calls
