"""Which object stands on which, and the weight on its contacts: statics by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from scene2hap import Contact, ContactNetwork, Excitation, ModalPlate, Plate, Pose, RigidBody, materials
from scene2hap.errors import ModelDomainError
from scene2hap.haptics import Bands
from scene2hap.propagation.coupled.contact_stiffness import STANDARD_GRAVITY_M_S2, ContactLaw
from scene2hap.propagation.coupled.joints import joints_of
from scene2hap.propagation.coupled.standing import standings
from scene2hap.propagation.protocol import Body

LAW, G, UP = ContactLaw(), STANDARD_GRAVITY_M_S2, (0.0, 0.0, 1.0)
ASIDE = (1.0, 0.0, 0.0)
RUBBER, PLYWOOD = materials.lookup("rubber"), materials.lookup("plywood")


def stack(
    masses_kg: dict[str, float], *contacts: tuple[str, str, int], normal: tuple[float, float, float] | None = UP
) -> ContactNetwork:
    """Bodies of some masses, and contacts as (lower, upper, number)."""
    found = [Contact(a, b, (0.1 * k, 0.2, 0.0), normal) for a, b, n in contacts for k in range(n)]
    return ContactNetwork({key: RigidBody(kg) for key, kg in masses_kg.items()}, found, up_axis="z")


def loads(network: ContactNetwork) -> dict[tuple[str, str], tuple[str | None, object]]:
    """Who stands, and the load on each contact in kg, of each pair."""
    pairs: dict[tuple[str, str], list[Contact]] = {}
    for one in network.contacts:
        pairs.setdefault((min(one.a, one.b), max(one.a, one.b)), []).append(one)
    found = standings(network, pairs, LAW, {})
    return {pair: (one.upper, pytest.approx(one.preload_n / G)) for pair, one in found.items()}


@pytest.mark.parametrize("shelf_kg", [5.0, 13.99, 14.0, 14.01, 40.0])
def test_a_heavy_object_stands_on_its_own_feet(shelf_kg: float) -> None:
    """A microwave stands on rubber, whatever the shelf weighs: gains do not step where the masses are equal."""
    shelf = Plate(0.8, 0.45, 0.018, PLYWOOD, object_mass_kg=shelf_kg)
    oven = Plate(0.5, 0.36, 0.28, materials.lookup("steel"), object_mass_kg=14.0, feet=RUBBER)
    contacts = [Contact("shelf", "oven", (x, y, 0.0), UP) for x in (0.06, 0.38) for y in (0.1, 0.5)]
    bodies: dict[str, Body] = {"shelf": shelf, "oven": oven}
    (first, *_) = joints_of(ContactNetwork(bodies, contacts, up_axis="z"), set(bodies), LAW, {})
    assert first.stiffness_n_m == LAW.stiffness(RUBBER, PLYWOOD, None, 14.0 * G / 4)[0]
    turned = [Contact(one.b, one.a, (*one.point_m[:2], 0.0), (0.0, 0.0, -1.0)) for one in contacts[::-1]]
    again = joints_of(ContactNetwork(bodies, turned, up_axis="z"), set(bodies), LAW, {})
    assert {one.stiffness_n_m for one in again} == {first.stiffness_n_m}


def test_a_support_carries_all_that_stands_above() -> None:
    network = stack(
        {"floor": 500, "mat": 2, "machine": 70, "box": 8},
        ("floor", "mat", 4),
        ("mat", "machine", 4),
        ("machine", "box", 1),
    )
    assert loads(network) == {
        ("box", "machine"): ("box", 8.0),
        ("machine", "mat"): ("machine", 78.0 / 4),
        ("floor", "mat"): ("mat", 80.0 / 4),
    }


def test_a_weight_is_divided_over_all_supports() -> None:
    masses_kg = {"left": 1.0, "right": 1.0, "top": 20.0, "floor": 90.0}
    network = stack(masses_kg, ("left", "top", 3), ("right", "top", 1), ("floor", "left", 2), ("floor", "right", 2))
    found = loads(network)
    assert found["left", "top"] == ("top", 5.0)
    assert found["right", "top"] == ("top", 5.0)
    assert found["floor", "left"] == ("left", (1.0 + 15.0) / 2)


def test_where_nobody_is_known_to_be_above_the_lighter_rests() -> None:
    """Without normals or the up axis, at walls, below a ceiling, and in rings."""
    lamp = {"ceiling": 300.0, "lamp": 2.0}
    house = {**lamp, "wall": 900.0, "floor": 800.0}
    for network in (
        stack(lamp, ("ceiling", "lamp", 1), normal=None),
        stack(lamp, ("ceiling", "lamp", 1), normal=ASIDE),
        replace(stack(lamp, ("lamp", "ceiling", 1)), up_axis=None),
        stack(house, ("lamp", "ceiling", 1), ("wall", "ceiling", 2), ("floor", "wall", 4)),
    ):
        assert loads(network)["ceiling", "lamp"] == ("lamp", 2.0)
    ring = {"a": 1.0, "b": 2.0, "c": 3.0, "d": 9.0}
    found = loads(stack(ring, ("a", "b", 1), ("b", "c", 1), ("c", "a", 1), ("d", "a", 1)))
    assert found == {("a", "b"): ("a", 1.0), ("b", "c"): ("b", 2.0), ("a", "c"): ("a", 1.0), ("a", "d"): ("a", 1.0)}
    assert loads(stack({"a": 1.0, "b": 1.0}, ("a", "b", 1), normal=None)) == {("a", "b"): (None, 1.0)}


def test_without_normals_the_places_of_contacts_tell_who_is_above() -> None:
    """A worktop that is flush with a cabinet below it, and both with a wall behind them."""
    cabinet, wall = Plate(0.6, 0.5, 0.02, PLYWOOD, object_mass_kg=20.0), RigidBody(2000.0, (4.0, 0.1, 2.5))
    worktop = Plate(1.8, 0.6, 0.04, PLYWOOD, object_mass_kg=30.0)
    poses = {"cabinet": Pose((0.0, 0.0, 0.43)), "worktop": Pose((0.0, 0.0, 0.88)), "wall": Pose((0.0, 0.6, 1.25))}
    contacts = [Contact("cabinet", "worktop", (x, y, 0.86)) for x in (0.0, 0.6) for y in (0.0, 0.5)]
    contacts += [Contact("cabinet", "wall", (x, 0.5, z)) for x in (0.0, 0.6) for z in (0.0, 0.86)]
    contacts += [Contact("worktop", "wall", (x, 0.6, z)) for x in (0.0, 1.8) for z in (0.86, 0.9)]
    bodies: dict[str, Body] = {"cabinet": cabinet, "worktop": worktop, "wall": wall}
    assert loads(ContactNetwork(bodies, contacts, poses, "z")) == {
        ("cabinet", "worktop"): ("worktop", 7.5),
        ("cabinet", "wall"): ("cabinet", 5.0),
        ("wall", "worktop"): ("worktop", 7.5),
    }


def test_loads_do_not_jump_where_a_contact_vanishes() -> None:
    """A corner that is lifted hands its load to the others; an object that is lifted presses less on what is below."""
    whole = stack({"floor": 200.0, "table": 5.0, "oven": 14.0}, ("floor", "table", 4), ("table", "oven", 4))

    def faded(weight: float, n: int) -> ContactNetwork:
        ovens = [one for one in whole.contacts if one.b == "oven"]
        tables = [one for one in whole.contacts if one.b == "table"]
        fading = [replace(one, weight=weight) for one in ovens[:n]]
        return ContactNetwork(whole.bodies, [*tables, *fading, *ovens[n:]], up_axis="z")

    assert loads(faded(1e-9, 1))["oven", "table"] == ("oven", 14.0 / 3)
    assert loads(faded(0.5, 1))["oven", "table"] == ("oven", 14.0 / 3.5)
    assert loads(faded(0.5, 4)) == {("oven", "table"): ("oven", 3.5), ("floor", "table"): ("table", 3.0)}
    assert loads(faded(1e-9, 4))["floor", "table"] == ("table", 1.25)


def test_a_machine_presses_through_a_light_mat() -> None:
    """Plywood of 2 kg does not sag by its own weight, but does under a machine of 70 kg."""
    board, floor = Plate(0.7, 0.7, 0.009, PLYWOOD, object_mass_kg=2.0), Plate(4, 4, 0.14, materials.lookup("concrete"))
    bodies: dict[str, Body] = {"floor": floor, "board": board, "machine": RigidBody(70.0, (0.5, 0.5, 0.8))}
    contacts = [Contact("floor", "board", (x, y, 0.0), UP) for x in (0.0, 0.7) for y in (0.0, 0.7)]
    contacts += [Contact("board", "machine", (x, y, 0.009), UP) for x in (0.1, 0.6) for y in (0.1, 0.6)]
    poses = {"floor": Pose((-1.7, -1.7, -0.07)), "board": Pose((0, 0, 0.0045)), "machine": Pose((0.1, 0.1, 0.4))}
    network = ContactNetwork(bodies, contacts, poses, "z")
    between = [one for one in joints_of(network, set(bodies), LAW, {}) if {one.a, one.b} == {"board", "floor"}]
    assert len(between) == 8
    known, unknown = (
        ModalPlate()
        .prepare(one, [Excitation("machine", 50.0, 50.0, 70.0)], Bands.dominant())
        .attenuation("floor", np.array([[1.0, 1.0, 0.0]]))
        for one in (network, replace(network, up_axis=None))
    )
    assert known[0, 0, 0] > 2 * unknown[0, 0, 0]


def test_another_up_axis_is_an_error() -> None:
    with pytest.raises(ModelDomainError, match="up_axis is 'x'; it must be 'y', 'z' or None"):
        ContactNetwork({}, up_axis="x")  # type: ignore[arg-type]
