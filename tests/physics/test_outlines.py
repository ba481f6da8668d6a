"""Plates with outlines other than rectangles, against tables, finite elements and the same plates rotated."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from numpy.typing import NDArray
from scipy.optimize import brentq
from scipy.special import iv, ivp, jv, jvp

from plate_fe import fe_receptance_within, outline_mesh, refined_at
from scene2hap import (
    AutoFidelity,
    Bands,
    Contact,
    ContactNetwork,
    Excitation,
    Material,
    ModalPlate,
    Outline,
    Plate,
    RigidBody,
)
from scene2hap.errors import ModelDomainError
from scene2hap.propagation.lattice.bending_lattice import bending_lattice
from scene2hap.propagation.mass_spring_damper import MassSpringDamper

MATERIAL = Material("test", 2500.0, 70e9, 0.33, loss_factor=0.02)
Floats = NDArray[np.float64]


def outlined(outline: Outline, thickness_m: float = 0.006) -> Plate:
    return Plate.of_outline(outline, thickness_m, MATERIAL)


def disc(radius_m: float, n: int = 256) -> Outline:
    turn = np.arange(n) * 2 * math.pi / n
    corners = radius_m * np.column_stack([1 + np.cos(turn), 1 + np.sin(turn)])
    return Outline((corners.tolist(),))


L = Outline((((0, 0), (1.0, 0), (1.0, 0.4), (0.5, 0.4), (0.5, 0.9), (0, 0.9)),))
SINK = Outline((((0, 0), (1.0, 0), (1.0, 0.6), (0, 0.6)), ((0.3, 0.15), (0.7, 0.15), (0.7, 0.45), (0.3, 0.45))))

HOLE = [(0.65 + 0.12 * math.cos(k * math.pi / 12), 0.5 + 0.12 * math.sin(k * math.pi / 12)) for k in range(24)]
DISC_WITH_HOLE = Outline((disc(0.45).rings_m[0], HOLE))


def p95_db(found: NDArray[np.complex128], expected: NDArray[np.complex128]) -> float:
    return float(np.quantile(np.abs(20 * np.log10(np.abs(found / expected))), 0.95))


def disc_roots(n: int, nu: float) -> list[float]:
    """omega a^2 sqrt(m / D) of a free disc's modes of n nodal diameters, below 45: w = A J_n(k r) + B I_n(k r) without
    moment and edge shear at r = a = 1. Source: Leissa, Vibration of Plates (NASA SP-160, 1969), section 2.1."""

    def edge(k: float) -> float:
        loads = []
        for value, derivative, sign in ((jv, jvp, -1.0), (iv, ivp, 1.0)):
            w, slope, bend = value(n, k), k * derivative(n, k, 1), k**2 * derivative(n, k, 2)
            moment = bend + nu * (slope - n**2 * w)
            shear = sign * k**2 * slope - (1 - nu) * n**2 * (slope - w)
            loads.append((moment, shear))
        return float(loads[0][0] * loads[1][1] - loads[0][1] * loads[1][0])

    at = np.linspace(0.5, math.sqrt(45.0), 2000)
    sign = np.sign([edge(float(k)) for k in at])
    return [brentq(edge, *at[i : i + 2]) ** 2 for i in np.flatnonzero(sign[:-1] * sign[1:] < 0)]


def test_a_free_disc_has_the_frequencies_of_bessels_functions() -> None:
    plate = outlined(disc(0.4))
    found = MassSpringDamper().natural_frequencies_hz(plate, 16)
    scale = 2 * math.pi * 0.4**2 * plate.wavenumber_per_root_omega**2
    exact = sorted(root for n in range(7) for root in disc_roots(n, 0.33) * (1 if n == 0 else 2))
    assert exact[0] == pytest.approx(5.25, abs=0.02)  # the value of Leissa's table
    assert np.abs(found[:3]).max() == 0.0
    np.testing.assert_allclose(found[3:] * scale, exact[:13], rtol=3e-3)


@pytest.mark.parametrize("outline", [disc(0.4), L, SINK, DISC_WITH_HOLE], ids=["disc", "L", "sink", "hole"])
def test_errors_fall_with_the_cell(outline: Outline) -> None:
    """Errors against a fine lattice fall with order 1.8 or more, also with unbounded curvature at notches."""
    plate = outlined(outline)
    exact = MassSpringDamper(40).natural_frequencies_hz(plate, 16)[3:]
    errors = [np.abs(MassSpringDamper(n).natural_frequencies_hz(plate, 16)[3:] / exact - 1).max() for n in (4, 8, 16)]
    assert errors[0] / errors[1] > 2**1.8
    assert errors[1] / errors[2] > 2**1.8


def test_rectangular_outline_equals_the_rectangle() -> None:
    outline = Outline((((0, 0), (0.9, 0), (0.9, 0.6), (0, 0.6)),))
    f, points = np.geomspace(20.0, 600.0, 40), np.array([[0.1, 0.2], [0.9, 0.6], [0.45, 0.3]])
    found = MassSpringDamper().plate_receptance(outlined(outline), points[0], points, f)
    expected = MassSpringDamper().plate_receptance(Plate(0.9, 0.6, 0.006, MATERIAL), points[0], points, f)
    np.testing.assert_allclose(found, expected, rtol=1e-5)


def test_l_shape_agrees_with_finite_elements() -> None:
    mesh = outline_mesh(np.linspace(0, 1.0, 11), np.linspace(0, 0.9, 10), lambda x, y: (x > 0.5) & (y > 0.4))
    points, f = np.array([[0.1, 0.1], [0.9, 0.35], [0.1, 0.85], [0.5, 0.4], [0.45, 0.2]]), np.geomspace(15, 300, 25)
    expected = fe_receptance_within(outlined(L), refined_at(mesh, [(0.5, 0.4)], 2), points[0], points, f, 0.02)
    assert p95_db(MassSpringDamper(12).plate_receptance(outlined(L), points[0], points, f), expected) < 1.0


@pytest.mark.parametrize("resolution", [4, 8])
def test_a_round_lattice_has_the_inertia_of_a_disc(resolution: int) -> None:
    """Area and inertia of the polygon about its middle; misplaced pixels of the rim would change them."""
    lattice, n, radius_m = bending_lattice(outlined(disc(0.4)), resolution), 256, 0.4
    rng = np.random.default_rng(1)
    r, turn = 0.99 * radius_m * np.sqrt(rng.random(3000)), 2 * math.pi * rng.random(3000)
    x, y = r * np.cos(turn), r * np.sin(turn)
    look = lattice.interpolation(radius_m + np.column_stack([x, y])).toarray()
    tilt, one = (np.linalg.lstsq(look, w, rcond=None)[0] for w in (x, np.ones_like(x)))
    area_m2 = n / 2 * radius_m**2 * math.sin(2 * math.pi / n)
    assert one @ lattice.masses @ one == pytest.approx(area_m2, rel=5e-4)
    inertia_m4 = area_m2 * radius_m**2 * (2 + math.cos(2 * math.pi / n)) / 12
    assert tilt @ lattice.masses @ tilt == pytest.approx(inertia_m4, rel=5e-4)


@pytest.mark.parametrize("angle", [0.3, 0.5 * math.pi, 2.0])
@pytest.mark.parametrize("outline", [L, SINK], ids=["L", "sink"])
def test_result_does_not_depend_on_rotation_against_the_grid(outline: Outline, angle: float) -> None:
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    rings = [np.array(ring) @ turn.T for ring in outline.rings_m]
    low = np.concatenate(rings).min(axis=0)
    other = outlined(Outline(tuple((ring - low).tolist() for ring in rings)))
    points, f = np.array([[0.1, 0.1], [0.05, 0.55], [0.9, 0.05]]), np.geomspace(20.0, 250.0, 30)
    turned = points @ turn.T - low
    one = MassSpringDamper(16).plate_receptance(outlined(outline), points[0], points, f)
    assert p95_db(MassSpringDamper(16).plate_receptance(other, turned[0], turned, f), one) < 0.6


def test_a_round_hole_is_fine_enough_at_the_default_resolution() -> None:
    """The hole's rim has no notch, and the cells of the bounding box are as large as its radius."""
    plate = outlined(DISC_WITH_HOLE)
    points, f = np.array([[0.2, 0.3], [0.45, 0.1], [0.8, 0.5], [0.45, 0.8]]), np.geomspace(20.0, 400.0, 60)
    exact = MassSpringDamper(24).plate_receptance(plate, points[0], points, f)
    assert p95_db(MassSpringDamper().plate_receptance(plate, points[0], points, f), exact) < 1.0


@pytest.mark.parametrize("width_m", [0.002, 0.005])
@pytest.mark.parametrize("degrees", [20, 45])
def test_a_slanted_slot_answers_as_a_straight_one(degrees: float, width_m: float) -> None:
    """Also for a slot thinner than the pixels of the cells that it crosses, with about the same number of nodes."""
    turn = np.radians(degrees)
    matrix = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    slot = [(0.0, 0.25 + width_m), (0.5, 0.25 + width_m), (0.5, 0.25), (0.0, 0.25)]
    ring = np.array([(0, 0), (0.8, 0), (0.8, 0.5), (0, 0.5), *slot])
    low = (ring @ matrix.T).min(axis=0)
    straight, slanted = outlined(Outline((ring.tolist(),))), outlined(Outline(((ring @ matrix.T - low).tolist(),)))
    assert bending_lattice(slanted, 8).n_nodes <= 1.1 * bending_lattice(straight, 8).n_nodes
    points, f = np.array([[0.1, 0.1], [0.1, 0.4], [0.7, 0.3], [0.4, 0.2]]), np.geomspace(20.0, 300.0, 40)
    expected = MassSpringDamper().plate_receptance(straight, points[0], points, f)
    at = points @ matrix.T - low
    assert p95_db(MassSpringDamper().plate_receptance(slanted, at[0], at, f), expected) < 0.3


def test_a_thin_slot_across_the_grid_separates_its_sides() -> None:
    """The grid follows the slot 100 mm wide, so that the slot of 3 mm crosses the grid at an angle."""
    middle, turn = np.array([0.3, 0.3]), math.radians(25)
    along, across = np.array([math.cos(turn), math.sin(turn)]), np.array([-math.sin(turn), math.cos(turn)])
    thin = [
        middle + a * along + b * across for a, b in ((-0.2, -0.0015), (0.2, -0.0015), (0.2, 0.0015), (-0.2, 0.0015))
    ]
    wide = [(0.7, 0.1), (0.8, 0.1), (0.8, 0.6), (0.7, 0.6)]
    plate = outlined(Outline((((0, 0), (1, 0), (1, 0.7), (0, 0.7)), np.array(thin).tolist(), wide)))
    lattice = bending_lattice(plate, 8)
    below, above = (lattice.interpolation((middle + side * across)[None]) for side in (-0.02, 0.02))
    assert set(below.indices).isdisjoint(above.indices)
    points, f = np.array([[0.1, 0.4], [0.4, 0.2], [0.9, 0.6]]), np.geomspace(20.0, 300.0, 40)
    exact = MassSpringDamper(24).plate_receptance(plate, points[0], points, f)
    assert p95_db(MassSpringDamper().plate_receptance(plate, points[0], points, f), exact) < 3.0


def test_outline_measures_its_notches_curves_slant_and_width() -> None:
    corners, radii = disc(0.4).inward
    assert len(corners) == len(radii) == 0
    round_hole = Outline((((0, 0), (2, 0), (2, 2), (0, 2)), disc(0.5).rings_m[0]))
    corners, radii = round_hole.inward
    assert len(corners) == 256
    np.testing.assert_allclose(radii, 0.5, rtol=1e-3)
    assert len(round_hole.notches_m) == 0
    assert L.slant_rad == pytest.approx(0.0, abs=1e-9)
    slanted = L.turned(0.3)[0]
    assert slanted.slant_rad == pytest.approx(0.3)
    assert slanted.area_m2 == pytest.approx(L.area_m2, rel=1e-3)
    assert slanted.width_m == pytest.approx(L.width_m)
    assert SINK.width_m == pytest.approx(0.6)


def test_slot_separates_both_sides() -> None:
    """The two sides of a slot of 1 mm share no nodes, except around its end."""
    comb = Outline((((0, 0), (1.0, 0), (1.0, 0.1), (0.1, 0.1), (0.1, 0.101), (1.0, 0.101), (1.0, 0.2), (0, 0.2)),))
    lattice = bending_lattice(outlined(comb), 8)
    for x, is_apart in ((0.05, False), (0.6, True), (0.95, True)):
        below, above = lattice.interpolation(np.array([[x, 0.099], [x, 0.102]]))
        assert set(below.indices).isdisjoint(above.indices) is is_apart


@settings(max_examples=15)
@given(
    radii=st.lists(st.floats(0.25, 1.0), min_size=3, max_size=9),
    hole=st.floats(0.0, 0.6),
    shares=st.lists(st.tuples(st.floats(0.0, 1.0), st.floats(0.65, 0.95)), min_size=3, max_size=3),
)
def test_any_outline_is_reciprocal_and_passive(
    radii: list[float], hole: float, shares: list[tuple[float, float]]
) -> None:
    """Stars of random radii, with a star-shaped hole."""
    turn = np.arange(len(radii)) * 2 * math.pi / len(radii)
    star = np.array(radii)[:, None] * np.column_stack([np.cos(turn), np.sin(turn)])
    low = star.min(axis=0)
    rings = [star - low] + ([hole * star - low] if hole > 0.05 else [])
    plate = outlined(Outline(tuple(ring.tolist() for ring in rings)))
    # Points on rays to the corners, outside the hole.
    points = np.array([star[int(share * (len(star) - 1))] * out - low for share, out in shares])
    f = np.array([7.0, 60.0, 150.0])
    Y = np.stack([MassSpringDamper().plate_receptance(plate, point, points, f) for point in points], axis=1)
    assert np.isfinite(Y).all()
    size = np.abs(Y).max(axis=(0, 1))
    np.testing.assert_allclose(Y / size, Y.transpose(1, 0, 2) / size, atol=1e-7)
    for k in range(len(f)):
        assert np.linalg.eigvalsh(-(Y[..., k] - Y[..., k].conj().T) / 2j).min() > -1e-6 * size[k]


def test_other_models_refuse_or_explain_outlines() -> None:
    plate = outlined(disc(0.4))
    with pytest.raises(ModelDomainError, match="ModalPlate is for rectangles"):
        ModalPlate().plate_receptance(plate, [0.4, 0.4], [0.4, 0.4], [100.0])
    with pytest.raises(ModelDomainError, match="or of its outline"):
        MassSpringDamper().plate_receptance(plate, [0.4, 0.4], [0.02, 0.02], [100.0])
    with pytest.raises(ModelDomainError, match="free edges"):
        replace(plate, boundary="CFFF")
    with pytest.raises(ModelDomainError, match=r"must be within .* Plate.of_outline"):
        replace(plate, length_m=0.5)


def test_auto_fidelity_takes_the_lattice_where_there_is_an_outline() -> None:
    model = AutoFidelity()
    assert model.choose(outlined(disc(0.4)), 500.0).rung == "lattice"
    assert model.choose(outlined(disc(0.04)), 200.0).rung == "rigid"
    comb = Outline((((0, 0), (0.2, 0), (0.2, 0.02), (0.02, 0.02), (0.02, 0.03), (0.2, 0.03), (0.2, 0.05), (0, 0.05)),))
    solid = Plate(0.2, 0.05, 0.006, MATERIAL)
    top_hz = 40.0
    assert model.choose(solid, top_hz).rung == "rigid"
    assert model.choose(outlined(comb), top_hz).rung == "lattice"  # its tongues bend at lower frequencies


def test_a_round_table_in_a_scene() -> None:
    """A phone on a disc: AutoFidelity gives the lattice's field, and points beyond the rim are moved to the rim."""
    table = outlined(disc(0.4), 0.01)
    network = ContactNetwork({"phone": RigidBody(0.2), "table": table}, [Contact("phone", "table", (0.4, 0.6, 0.0))])
    excitation = [Excitation("phone", 150.0, 150.0, 0.2)]
    field = MassSpringDamper().prepare(network, excitation, Bands((100.0, 200.0)))
    touches = np.array([[0.4, 0.1, 0.0], [0.7, 0.4, 0.0], [0.01, 0.01, 0.0]])
    gains = field.attenuation("table", touches)
    assert (gains > 0).all()
    auto = AutoFidelity().prepare(network, excitation, Bands((100.0, 200.0)))
    assert auto.choices["table"].rung == "lattice"
    np.testing.assert_allclose(auto.attenuation("table", touches), gains, rtol=0.03)
