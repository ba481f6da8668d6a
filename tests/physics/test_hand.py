"""A hand as a load: its impedance, and its effect on plates, against assembled systems."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from scene2hap import (
    AutoFidelity,
    Bands,
    Contact,
    ContactNetwork,
    Excitation,
    Hand,
    InfinitePlate,
    MassSpringDamper,
    ModalPlate,
    Plate,
    Pose,
    RigidBody,
    materials,
)
from scene2hap.errors import ConfigError
from scene2hap.propagation.coupled.coupling import Joint, couple
from scene2hap.propagation.coupled.hand import FINGERTIP, PALM

OAK, STEEL = materials.lookup("oak"), materials.lookup("steel")
FREQUENCIES_HZ = np.geomspace(10.0, 1000.0, 41)
MODELS = [ModalPlate, MassSpringDamper, InfinitePlate, AutoFidelity]


class HandBody:
    """The hand as a body of a scene, with receptance 1 / (j omega Z) at every point."""

    loss_factor = np.inf

    def __init__(self, hand: Hand) -> None:
        self.hand = hand

    def receptance(self, points_m, forces_m, frequencies_hz):
        stiffness = 2j * np.pi * frequencies_hz * self.hand.impedance_n_s_m(frequencies_hz)
        return np.ones((1, len(points_m), len(forces_m))) / stiffness[:, None, None]


def assembled_impedance(hand: Hand, f: float) -> complex:
    """Force at the first mass over its velocity, from the dynamic stiffness of the whole chain."""
    n, omega = len(hand.masses_kg), 2 * np.pi * f
    whole = np.diag([-(omega**2) * m + 0j for m in hand.masses_kg])
    for i, (k, c) in enumerate(zip(hand.stiffnesses_n_m, hand.dampings_n_s_m, strict=True)):
        link = k + 1j * omega * c
        whole[i, i] += link
        if i + 1 < n:
            whole[i + 1, i + 1] += link
            whole[i, i + 1] -= link
            whole[i + 1, i] -= link
    return complex(1 / np.linalg.inv(whole)[0, 0] / (1j * omega))


@pytest.mark.parametrize(
    "hand", [PALM, FINGERTIP, Hand((0.1,), (0.0,), (0.0,)), Hand((0.0, 0.5), (2e3, 0.0), (3.0, 9.0))]
)
def test_impedance(hand: Hand) -> None:
    found = hand.impedance_n_s_m(FREQUENCIES_HZ)
    assert np.allclose(found, [assembled_impedance(hand, f) for f in FREQUENCIES_HZ], rtol=1e-9)
    assert (found.real >= 0).all()


def test_size_of_the_hands() -> None:
    """The standard's curves of palms lie within 100 to 300 N s/m; a fingertip is an order of magnitude below."""
    f = np.geomspace(10.0, 500.0, 30)
    assert ((np.abs(PALM.impedance_n_s_m(f)) > 100) & (np.abs(PALM.impedance_n_s_m(f)) < 300)).all()
    assert (np.abs(FINGERTIP.impedance_n_s_m(f)) < 20).all()


def level_db(gains: NDArray[np.float64]) -> NDArray[np.float64]:
    return 20 * np.log10(gains)


def tray_on_table(table_pose: Pose) -> ContactNetwork:
    """A steel tray on an oak top with three contacts; a phone stands on the tray."""
    bodies = {"top": Plate(1.0, 0.6, 0.02, OAK), "tray": Plate(0.5, 0.4, 0.0015, STEEL)}
    feet = [(0.3, 0.2, 0.0), (0.6, 0.2, 0.0), (0.45, 0.45, 0.0)]
    contacts = [*(Contact("top", "tray", at) for at in feet), Contact("tray", "phone", (0.5, 0.3, 0.0))]
    return ContactNetwork(bodies, contacts, {"top": table_pose, "tray": Pose((0.25, 0.15, 0.0))})


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("touched", ["tray", "top"])
def test_hand_load_equals_a_body_of_the_scene(model: type, touched: str) -> None:
    """A touch loads a point exactly like a rigid joint to a body with the hand's impedance."""
    network, at = tray_on_table(Pose()), (0.55, 0.4, 0.0)
    for f in (25.0, 90.0, 240.0, 610.0):
        source = [Excitation("phone", f, f, 0.2)]
        loaded = model(outside_domain="ignore", hand="palm").prepare(network, source, Bands.dominant())
        solved = loaded.reach[touched]
        load = solved.load
        own = network.on_body(touched, [at])
        joint = Joint(touched, "hand", tuple(own[0].tolist()), (0.0, 0.0))
        whole = couple(
            {**load.group.bodies, "hand": HandBody(PALM)}, [*load.group.joints, joint], ["phone"], np.array([f])
        )
        expected = np.abs(whole.deflection(touched, own)[0, 0, 0])
        found = loaded.attenuation(touched, [at])[0, 0, 0]
        assert found == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("bands", [Bands((90.0, 180.0, 355.0)), Bands.dominant(octaves=0.5)])
def test_bands_are_the_rms_over_frequencies(bands: Bands) -> None:
    """Two compact blocks in contact move as masses, so that the loaded motion has a closed form."""
    network = ContactNetwork({"block": RigidBody(1.5, material=OAK)}, [Contact("block", "phone", (0.0, 0.0, 0.0))])
    source = [Excitation("phone", 170.0, 170.0, 0.2)]
    field = ModalPlate(hand=PALM).prepare(network, source, bands)
    joint = field.reach["block"].joints[0]
    k = joint.stiffness_n_m * complex(1, joint.loss_factor)
    f = field.sampling.frequencies_hz
    omega = 2 * np.pi * f
    # 0.2 kg with free motion 1 drives 1.5 kg and the hand through the spring.
    below = -(omega**2) * 1.5 + 1j * omega * PALM.impedance_n_s_m(f)
    spring = 1 / (1 / k - 1 / (omega**2 * 0.2))
    moved = np.abs(spring / (below + spring))
    found = field.attenuation("block", [[0.0, 0.0, 0.0]])[0, 0]
    for number, (at, weights) in enumerate(field.sampling.bands):
        assert found[number] == pytest.approx(np.sqrt(weights @ moved[at] ** 2), rel=1e-9)


@pytest.mark.parametrize("model", MODELS)
def test_hand_loads_thin_plates_and_not_heavy_ones(model: type) -> None:
    def change_db(plate: Plate, hand: str) -> float:
        network = ContactNetwork({"plate": plate}, [Contact("plate", "phone", (0.2, 0.15, 0.0))])
        source, points = [Excitation("phone", 170.0, 170.0, 0.2)], [[0.35, 0.25, 0.0], [0.5, 0.1, 0.0]]
        free, loaded = (
            model(outside_domain="ignore", hand=one)
            .prepare(network, source, Bands.third_octaves(40, 640))
            .attenuation("plate", points)
            for one in (None, hand)
        )
        return float(np.sqrt(np.mean((level_db(loaded) - level_db(free)) ** 2)))

    steel, oak = Plate(0.6, 0.4, 0.0015, STEEL), Plate(1.2, 0.8, 0.04, OAK)
    assert change_db(steel, "palm") > 3.0
    assert change_db(oak, "palm") < 1.5
    assert change_db(steel, "fingertip") < change_db(steel, "palm") / 3


def test_upright_board_is_loaded_in_three_directions() -> None:
    """A board on its edge: a hand of almost no impedance changes nothing; one of very high impedance stops it."""
    upright = (0.5**0.5, 0.0, 0.0, 0.5**0.5)
    network = ContactNetwork(
        {"top": Plate(1.0, 0.6, 0.02, OAK), "board": Plate(0.6, 0.4, 0.02, OAK)},
        [
            *(Contact("top", "board", (x, 0.3, 0.0), normal=(0.0, 0.0, 1.0)) for x in (0.3, 0.6)),
            Contact("top", "phone", (0.5, 0.5, 0.0), normal=(0.0, 0.0, 1.0)),
        ],
        {"top": Pose(), "board": Pose((0.2, 0.3, 0.0), upright)},
    )
    source, at = [Excitation("phone", 170.0, 170.0, 0.2)], [[0.5, 0.3, 0.2], [0.4, 0.3, 0.1]]
    bands = Bands.third_octaves(100, 400)
    none, nothing, much = (
        ModalPlate(hand=hand).prepare(network, source, bands).attenuation("board", at)
        for hand in (None, Hand((0.0,), (1e-9,), (1e-9,)), Hand((0.0,), (1e12,), (0.0,)))
    )
    assert np.allclose(nothing, none, rtol=1e-6)
    assert (much < 1e-3 * none).all()


def test_loaded_source_keeps_unit_gain_and_unreached_objects_zero() -> None:
    network = tray_on_table(Pose())
    field = ModalPlate(hand="fingertip").prepare(network, [Excitation("phone", 90.0, 90.0, 0.2)], Bands.dominant())
    assert (field.attenuation("phone", [[0.5, 0.3, 0.0]]) == 1.0).all()
    assert not field.attenuation("shelf", [[0.5, 0.3, 0.0]]).any()
    field.expect("tray")
    assert field.attenuation("tray", np.zeros((0, 3))).shape == (0, 1, 1)


@pytest.mark.parametrize("model", MODELS)
def test_settings(model: type) -> None:
    assert model().hand is None
    assert model(hand="palm").hand == PALM
    assert model(hand={"masses_kg": [1], "stiffnesses_n_m": [2], "dampings_n_s_m": [3]}).hand == Hand((1,), (2,), (3,))
    for wrong in ("foot", 7, {"mass": 1.0}, {"masses_kg": [1, 2], "stiffnesses_n_m": [2], "dampings_n_s_m": [3]}):
        with pytest.raises(ConfigError, match="hand"):
            model(hand=wrong)
    with pytest.raises(ConfigError, match="dampings_n_s_m"):
        Hand((1.0,), (1.0,), (-1.0,))
