"""Lattices of the mass-spring-damper model: properties that hold for every plate."""

import itertools
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from numpy.typing import NDArray
from scipy.linalg import eigh

from scene2hap import Material, Outline, Plate
from scene2hap.propagation.lattice.bending_lattice import LONGEST, bending_lattice, cells_of, lines_of
from scene2hap.propagation.lattice.lattice import Lattice
from scene2hap.propagation.lattice.lattice_modes import _modes_up_to, lattice_modes, lowest_frequencies_hz

MATERIAL = Material("test", 2500.0, 70e9, 0.3)
Floats = NDArray[np.float64]


def nodes_of(lattice: Lattice, w: Callable[[Floats, Floats], Floats]) -> Floats:
    """Node values (n_nodes,) of a deflection that is cubic, or nearly cubic, along x and along y."""
    x, y = (np.linspace(0, side, 80) for side in (lattice.plate.length_m, lattice.plate.width_m))
    at = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
    found = np.linalg.lstsq(lattice.interpolation(at).toarray(), w(*at.T), rcond=None)[0]
    return np.asarray(found)


@pytest.mark.parametrize("boundary", ["".join(edges) for edges in itertools.product("FSC", repeat=4)])
def test_every_boundary_is_symmetric_and_never_negative(boundary: str) -> None:
    lattice = bending_lattice(Plate(1.0, 0.8, 0.01, MATERIAL, boundary), 4)
    K = lattice.stiffness.toarray()
    np.testing.assert_allclose(K, K.T, atol=1e-12 * np.abs(K).max())
    values = np.linalg.eigvalsh(K)
    assert values[0] > -1e-12 * values[-1]
    rigid = {"FFFF": 3, "FFFS": 1}.get("".join(sorted(boundary)), 0)
    assert np.count_nonzero(values < 1e-9 * values[-1]) == rigid


def test_free_lattices_hold_the_mass_and_do_not_resist_planes() -> None:
    lattice = bending_lattice(Plate(1.3, 0.7, 0.01, MATERIAL), 9)
    one, x = nodes_of(lattice, lambda x, y: 0 * x + 1), nodes_of(lattice, lambda x, y: x)
    assert one @ lattice.masses @ one == pytest.approx(1.3 * 0.7, rel=1e-10)
    assert one @ lattice.masses @ x == pytest.approx(1.3 * 0.7 * 0.65, rel=1e-10)
    assert x @ lattice.masses @ x == pytest.approx(1.3**3 / 3 * 0.7, rel=1e-10)
    plane = nodes_of(lattice, lambda x, y: 0.3 - 2.0 * x + 0.7 * y)
    assert np.abs(lattice.restoring(plane)).max() < 1e-9 * np.abs(lattice.stiffness).max()
    curved = nodes_of(lattice, lambda x, y: x * x * y)
    np.testing.assert_allclose(lattice.restoring(curved), lattice.stiffness @ curved, atol=1e-7)


def test_springs_keep_the_digits_that_rounding_of_the_stiffness_takes() -> None:
    """The longest wave along a strip of 1000 to 1; a table does not need this precision."""
    table, strip = (bending_lattice(Plate(1.0, width_m, 0.01, MATERIAL), 8) for width_m in (0.5, 0.001))
    assert table.is_clear
    assert not strip.is_clear
    assert table.rounding_k4 < 1e-9 * strip.rounding_k4
    knots = np.pad(lines_of(strip.plate, 8)[0], 3, mode="edge")
    along = (knots[1:-3] + knots[2:-2] + knots[3:-1]) / 3  # node values of the deflection w = x
    w = np.repeat(along, strip.n_nodes // len(along))
    area = strip.plate.area_m2
    by_springs, by_stiffness = abs(w @ strip.restoring(w)) / area, abs(w @ (strip.stiffness @ w)) / area
    assert by_springs < 1e-3
    assert 1e-3 * strip.rounding_k4 < by_stiffness < strip.rounding_k4


@pytest.mark.parametrize("nu", [-0.99, 0.0, 0.3, 0.499])
def test_twist_stores_exactly_its_energy(nu: float) -> None:
    """w = x y bends nowhere and twists by 1 everywhere: U = D (1 - nu) times the area."""
    plate = Plate(1.3, 0.7, 0.01, Material("t", 2500.0, 70e9, nu))
    lattice = bending_lattice(plate, 7)
    w = nodes_of(lattice, lambda x, y: x * y)
    assert w @ lattice.restoring(w) / 2 == pytest.approx((1 - nu) * 1.3 * 0.7, rel=1e-10)


def test_clamps_hold_the_slope() -> None:
    """w = x^2 (1 - x)^2 between clamps, constant along the free width, nu = 0: U = 1/2 integral w''^2 = 2/5."""
    errors = []
    for resolution in (4, 8, 16):
        lattice = bending_lattice(Plate(1.0, 1.0, 0.01, Material("t", 2500.0, 70e9, 0.0), "CCFF"), resolution)
        w = nodes_of(lattice, lambda x, y: x**2 * (1 - x) ** 2)
        errors.append(abs(w @ lattice.restoring(w) / 2 / 0.4 - 1))
        ends = np.array([[0.0, 0.3], [1.0, 0.7], [1e-7, 0.5], [1 - 1e-7, 0.2]])
        assert np.abs(lattice.interpolation(ends) @ w).max() < 1e-12
    assert errors[1] < errors[0] / 3.5
    assert errors[2] < errors[1] / 3.5
    assert errors[2] < 1e-3


@settings(max_examples=25)
@given(st.lists(st.tuples(st.floats(0.0, 1.0), st.floats(0.0, 1.0)), min_size=1, max_size=5), st.integers(4, 12))
def test_interpolation_is_exact_for_cubics(places: list[tuple[float, float]], resolution: int) -> None:
    lattice = bending_lattice(Plate(1.3, 0.7, 0.01, MATERIAL), resolution)
    points = np.array(places) * [1.3, 0.7]

    def w(x: Floats, y: Floats) -> Floats:
        return 1 - x + 2 * y + x * y**2 - 3 * x**3 * y**3

    np.testing.assert_allclose(lattice.interpolation(points) @ nodes_of(lattice, w), w(*points.T), atol=1e-9)


def test_slender_plates_get_longer_cells() -> None:
    assert cells_of(Plate(1.0, 0.25, 0.01, MATERIAL), 8) == (32, 8)
    assert cells_of(Plate(0.001, 1.0, 0.01, MATERIAL), 8) == (8, 8 * LONGEST)


@pytest.mark.parametrize("size", [(1.0, 1.0), (1.0, 0.02)])
def test_lattice_finds_every_mode(size: tuple[float, float]) -> None:
    """Compared with a dense eigensolver; squares have pairs of equal modes."""
    plate = Plate(*size, 0.01, MATERIAL)
    resolution = 25 if size[1] == 1.0 else 5
    lattice = bending_lattice(plate, resolution)
    dense = eigh(lattice.stiffness.toarray(), lattice.masses.toarray(), eigvals_only=True)
    frequencies = np.sqrt(np.maximum(dense, 0.0)) / plate.wavenumber_per_root_omega**2 / (2 * np.pi)
    found = lowest_frequencies_hz(plate, resolution, 20)
    np.testing.assert_allclose(found[3:], frequencies[3:20], rtol=1e-5)
    modes = lattice_modes(plate, resolution, found[15])
    np.testing.assert_allclose(modes.frequencies_hz[3:], frequencies[3 : len(modes.k4)], rtol=1e-5)
    assert modes.k4[-1] < dense[len(modes.k4)] * (1 + 1e-9)
    np.testing.assert_allclose(modes.shapes.T @ (lattice.masses @ modes.shapes), np.eye(len(modes.k4)), atol=1e-9)


@pytest.mark.parametrize("side_m", [0.5, 0.53, 0.61])
@pytest.mark.parametrize("thickness_m", [0.002, 0.004])
def test_no_mode_of_a_symmetric_plate_is_missed(side_m: float, thickness_m: float) -> None:
    """A square with a square hole has pairs of equal modes."""
    a, b = (side_m - 0.2) / 2, (side_m + 0.2) / 2
    rings = ([(0, 0), (side_m, 0), (side_m, side_m), (0, side_m)], [(a, a), (b, a), (b, b), (a, b)])
    plate = Plate.of_outline(Outline(rings), thickness_m, MATERIAL)
    modes = lattice_modes(plate, 8, 400.0)
    lattice = modes.lattice
    k4 = eigh(lattice.stiffness.toarray(), lattice.masses.toarray(), eigvals_only=True)
    n = len(modes.k4)
    np.testing.assert_allclose(modes.k4[3:], k4[3:n], rtol=1e-5)
    assert modes.k4[-1] < k4[n]


def test_plates_of_one_shape_share_their_modes() -> None:
    """Two discs of different sizes, thicknesses and materials are solved once, and have different frequencies."""
    turn = np.linspace(0.0, 2 * np.pi, 48, endpoint=False)
    circle = np.column_stack([np.cos(turn), np.sin(turn)])
    small, large = (
        Plate.of_outline(Outline(((size_m * circle).tolist(),)), thickness_m, material)
        for size_m, thickness_m, material in (
            (0.13, 0.004, MATERIAL),
            (0.7, 0.02, replace(MATERIAL, density_kg_m3=900.0)),
        )
    )
    _modes_up_to.cache_clear()
    for plate in (small, large):
        lattice = bending_lattice(plate, 8)
        k4 = eigh(lattice.stiffness.toarray(), lattice.masses.toarray(), eigvals_only=True)
        frequencies = np.sqrt(np.maximum(k4, 0.0)) / plate.wavenumber_per_root_omega**2 / (2 * np.pi)
        modes = lattice_modes(plate, 8, frequencies[5])
        np.testing.assert_allclose(modes.frequencies_hz[3:], frequencies[3 : len(modes.k4)], rtol=1e-6)
        points = plate.extent_m * np.array([[0.5, 0.5], [0.9, 0.5], [0.3, 0.2]])
        own = lattice.interpolation(points) @ eigh(lattice.stiffness.toarray(), lattice.masses.toarray())[1][:, 5]
        np.testing.assert_allclose(
            np.abs(modes.lattice.interpolation(points) @ modes.shapes[:, 5]), np.abs(own), rtol=1e-5
        )
    assert _modes_up_to.cache_info().misses == 1
