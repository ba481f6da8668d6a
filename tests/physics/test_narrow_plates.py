"""Narrow plates fixed along their long edges; and passivity: no plate gives energy to its driving forces."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

from scene2hap import ModalPlate
from scene2hap.errors import ModelDomainError
from scene2hap.propagation.auto_rungs import FINENESS
from scene2hap.propagation.bodies.modal_body import modal_body
from scene2hap.propagation.domain import SlowPlateWarning
from scene2hap.propagation.modal.modes import QUICK_BLOCK, largest_block
from scene2hap.propagation.plate import Plate

pytestmark = pytest.mark.filterwarnings("ignore::scene2hap.propagation.domain.SlowPlateWarning")

# Deflection of an infinite strip of width b under a force F in its middle, w D / (F b^2), Poisson's ratio 0.3.
# Source: Timoshenko, Woinowsky-Krieger, Theory of Plates and Shells (1959), tables 23 and 37, b/a of infinity.
STRIPS = {"C": 0.00725, "S": 0.01695}
F_HZ = np.geomspace(1.0, 400.0, 8)


def compliance(plate: Plate, x: float, y: float) -> float:
    """Static deflection at a driven point, times D / b^2."""
    at = np.array([[x * plate.length_m, y * plate.width_m]])
    deflection = ModalPlate().plate_receptance(plate, at[0], at, [1.0])[0, 0].real
    return float(deflection * plate.bending_stiffness_nm / plate.width_m**2)


@pytest.mark.parametrize("aspect", [5, 10, 20, 50])
@pytest.mark.parametrize("held", ["C", "S"])
@pytest.mark.parametrize("ends", ["FF", "SS", "CC"])
def test_a_narrow_plate_held_on_both_long_edges_is_a_strip(ends: str, held: str, aspect: int) -> None:
    plate = Plate(1.0, 1.0 / aspect, 0.002, "steel", ends + 2 * held)
    for x in (0.5, 0.37):
        assert 20 * np.log10(compliance(plate, x, 0.5) / STRIPS[held]) == pytest.approx(0.0, abs=0.25)


@pytest.mark.parametrize("held", ["C", "S"])
def test_narrow_plate_held_on_the_other_two_edges_is_a_strip(held: str) -> None:
    plate = Plate(0.05, 1.0, 0.002, "steel", 2 * held + "FF")
    at = np.array([[0.025, 0.5]])
    deflection = ModalPlate().plate_receptance(plate, at[0], at, [1.0])[0, 0].real
    assert deflection * plate.bending_stiffness_nm / 0.05**2 == pytest.approx(STRIPS[held], rel=0.03)


def test_response_of_a_narrow_shelf_does_not_depend_on_its_length() -> None:
    """A plate fixed along one long edge carries vibration only a short way along this edge."""
    answers = [compliance(Plate(length, 0.05, 0.002, "steel", "FFCF"), 0.5, 0.5) for length in (0.5, 1.0, 2.0)]
    np.testing.assert_allclose(answers, answers[1], rtol=0.02)


@pytest.mark.parametrize("rung", FINENESS)
@pytest.mark.parametrize("aspect", [1.0, 5.0, 30.0])
@pytest.mark.parametrize("edges", ["CCFF", "SCFF", "FFSS", "CFCF", "CCCC"])
def test_held_edge_is_at_rest_and_the_plate_is_passive(edges: str, aspect: float, rung: str) -> None:
    """The near field's image in one edge must vanish at the opposite edge, which is close on a narrow plate."""
    plate = Plate(1.0, 1.0 / aspect, 0.1 / aspect, "oak", edges)
    inside = [(0.11, 0.58), (0.05, 0.9), (0.5, 0.5), (0.93, 0.3)]
    held = {0: (0.0, 0.7), 1: (1.0, 0.3), 2: (0.4, 0.0), 3: (0.6, 1.0)}
    points = np.array([*inside, *(at for side, at in held.items() if edges[side] != "F")]) * plate.extent_m
    f = np.array([10.0, 1e3])
    receptance = modal_body(plate, float(f.max()), 0.05, FINENESS[rung]).receptance(points, points, f)
    size = np.abs(receptance).max(axis=(1, 2))
    assert (np.abs(receptance[:, len(inside) :]).max(axis=(1, 2)) < 1e-9 * size).all()
    gained = np.linalg.eigvalsh((receptance - receptance.conj().transpose(0, 2, 1)) / 2j)
    assert (gained.max(axis=1) < 1e-9 * size).all()


@pytest.mark.parametrize("rung", FINENESS)
@pytest.mark.parametrize("edges", ["CCFF", "SSFF", "CFFF", "FFFF"])
def test_energy_gain_by_truncated_near_fields_is_below_the_stated_bound(edges: str, rung: str) -> None:
    """The bound for clustered points and free edges is 2e-5 of the largest receptance (docs/physical-models.md)."""
    rng = np.random.default_rng(4)
    for _ in range(10):
        aspect = np.exp(rng.uniform(np.log(2), np.log(40)))
        plate = Plate(1.0, 1.0 / aspect, 0.1 / aspect, "oak", edges)
        spread = 10 ** rng.uniform(-3.0, -0.5, (1, 2))
        points = np.clip(rng.uniform(0, 1, 2) + spread * rng.normal(size=(6, 2)), 0, 1) * plate.extent_m
        f = np.array([2.0, 200.0])
        receptance = modal_body(plate, float(f.max()), 0.05, FINENESS[rung]).receptance(points, points, f)
        gained = np.linalg.eigvalsh((receptance - receptance.conj().transpose(0, 2, 1)) / 2j).max(axis=1)
        assert (gained < 2e-5 * np.abs(receptance).max(axis=(1, 2))).all()


@pytest.mark.filterwarnings("ignore::scene2hap.propagation.domain.ThinPlateWarning")
@settings(max_examples=8, suppress_health_check=[HealthCheck.too_slow])
@given(
    aspect=st.floats(0.0, 1.2).map(lambda x: 10.0**x),
    edges=st.text("FSC", min_size=4, max_size=4),
    x=st.sampled_from([0.0, 0.001, 0.02, 0.37, 0.5, 1.0]),
    y=st.sampled_from([0.0, 0.001, 0.004, 0.03, 0.25, 0.5, 1.0]),
    material=st.sampled_from(["steel", "oak", "rubber"]),
)
def test_driven_point_only_absorbs_energy(aspect: float, edges: str, x: float, y: float, material: str) -> None:
    plate = Plate(0.6, 0.6 / aspect, 0.006, material, edges)
    at = np.array([[x * plate.length_m, y * plate.width_m]])
    try:
        receptance = ModalPlate().plate_receptance(plate, at[0], at, F_HZ)[0]
    except ModelDomainError:
        assert largest_block(plate, 1.5 * F_HZ[-1]) > 1500
        return
    mobility = 2j * np.pi * F_HZ * receptance
    assert (mobility.real >= -1e-6 * np.abs(mobility)).all()


def test_plate_too_narrow_for_its_edges_is_refused() -> None:
    plate = Plate(1.0, 0.002, 0.001, "steel", "FFCC")
    with pytest.raises(ModelDomainError, match="too narrow for edges that hold it .FFCC.; widen it"):
        compliance(plate, 0.5, 0.5)
    with pytest.raises(ModelDomainError, match="too narrow"):
        modal_body(plate, 1000.0, 0.01)


def test_a_plate_that_needs_many_functions_at_any_frequency_is_a_body() -> None:
    plate = Plate(1.0, 0.02, 0.002, "steel", "FFCF")
    assert largest_block(plate, 0.0) > QUICK_BLOCK
    points = np.array([[0.5, 0.01], [0.52, 0.02]])
    answer = modal_body(plate, 400.0, 0.01).receptance(points, points, np.array([100.0]))[0]
    alone = ModalPlate(loss_floor=0.01).plate_receptance(plate, points[0], points, [100.0])[:, 0]
    np.testing.assert_allclose(answer[:, 0], alone, rtol=0.02)


def test_slow_plate_warns_once() -> None:
    plate = Plate(1.0, 0.0213, 0.002, "steel", "FFCF")
    with pytest.warns(SlowPlateWarning, match=r"functions in one eigenproblem of a plate of 1 × 0\.0213"):
        ModalPlate().plate_receptance(plate, [0.5, 0.01], [[0.5, 0.01]], [50.0])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ModalPlate().plate_receptance(plate, [0.5, 0.01], [[0.5, 0.01]], [50.0])
