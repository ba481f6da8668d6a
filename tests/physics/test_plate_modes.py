"""Plate modes, against published tables, closed forms and finite elements."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from plate_fe import fe_frequencies_hz
from scene2hap import Material, Plate, plate_modes
from scene2hap.errors import ModelDomainError
from scene2hap.propagation.modal import modes as modes_module
from scene2hap.propagation.modal.plate_terms import PlateTerms

MATERIAL = Material("test", 2500.0, 70e9, 0.3, loss_factor=0.02)

# lambda = omega a^2 sqrt(m / D) of a square, nu = 0.3, converged by an independent 18 x 18 Ritz; SSSS in closed form.
# Leissa lists edges around the plate (x=0, y=0, x=a, y=b), we list x, x, y, y: his SCSC is our SSCC, SFSF our SSFF.
TABLE = {
    "SSSS": [19.7392, 49.3480, 49.3480, 78.9568, 98.6960, 98.6960, 128.305, 128.305],
    "CCCC": [35.9852, 73.3939, 73.3939, 108.2165, 131.5808, 132.2048, 165.000, 165.000],
    "FFFF": [0.0, 0.0, 0.0, 13.4682, 19.5961, 24.2702, 34.8009, 34.8009, 61.0932, 61.0932, 63.686, 69.265],
    "CFFF": [3.4710, 8.5064, 21.284, 27.199, 30.955, 54.185],
    "SSCC": [28.9509, 54.7431, 69.3270, 94.5853, 102.2162, 129.0955],
    "SSFF": [9.6314, 16.1348, 36.7256, 38.9450, 46.7381, 70.7401],
    "SSSC": [23.6463, 51.6743, 58.6464, 86.1345, 100.2698, 113.228],
}
# Leissa, J. Sound Vib. 31 (1973) 257: fewer terms, so his values are up to 1 % too high.
LEISSA = {
    "CCCC": [35.992, 73.413, 73.413, 108.27, 131.64, 132.24],
    "FFFF": [0.0, 0.0, 0.0, 13.489, 19.789, 24.432, 35.024, 35.024, 61.526],
    "CFFF": [3.4917, 8.5246, 21.429, 27.331, 31.111, 54.443],
}
BEAMS = {  # beta L of slender beams; a wide edge clamped or free at x, free along y
    "FFFF": [4.7300407, 7.8532046, 10.9956078],
    "CCFF": [4.7300407, 7.8532046, 10.9956078],
    "CFFF": [1.8751041, 4.6940911, 7.8547574],
    "CSFF": [3.9266023, 7.0685827],
}


def plate(boundary: str, length_m: float = 1.0, width_m: float = 1.0, nu: float = 0.3) -> Plate:
    return Plate(length_m, width_m, 0.01, replace(MATERIAL, poisson_ratio=nu), boundary)


def lambdas(of: Plate, n_modes: int) -> NDArray[np.float64]:
    """omega L^2 sqrt(m / D) of the plate's lowest modes."""
    m = of.material.density_kg_m3 * of.thickness_m
    D = of.material.youngs_modulus_pa * of.thickness_m**3 / (12 * (1 - of.material.poisson_ratio**2))
    return 2 * np.pi * plate_modes(of, n_modes).frequencies_hz * of.length_m**2 * np.sqrt(m / D)


@pytest.mark.parametrize("boundary", TABLE)
def test_square_plates(boundary: str) -> None:
    expected = TABLE[boundary]
    np.testing.assert_allclose(lambdas(plate(boundary), len(expected)), expected, rtol=1e-4, atol=1e-9)


@pytest.mark.parametrize("boundary", LEISSA)
def test_leissa_is_an_upper_bound(boundary: str) -> None:
    expected = np.array(LEISSA[boundary])
    found = lambdas(plate(boundary), len(expected))
    assert (found <= expected).all()
    np.testing.assert_allclose(found, expected, rtol=0.011)


def test_points_may_lie_beyond_an_edge_by_rounding() -> None:
    modes = plate_modes(plate("FFFF", 2.0), 5)
    corners = np.array([[0.0, 0.0], [2.0, 1.0]])
    beyond = corners + np.array([[-5e-7], [5e-7]])
    np.testing.assert_array_equal(modes.shapes(beyond), modes.shapes(corners))


def test_free_square_of_another_poisson_ratio() -> None:
    """The value 14.1 of handbooks is for nu = 0.225."""
    assert lambdas(plate("FFFF", nu=0.225), 4)[3] == pytest.approx(14.116, rel=1e-4)


@pytest.mark.parametrize("aspect", [1.0, 1.5, 0.4, 3.7])
def test_rectangles_on_hinges(aspect: float) -> None:
    i, j = np.indices((40, 40)) + 1
    expected = np.sort((np.pi**2 * (i**2 + (aspect * j) ** 2)).ravel())[:40]
    np.testing.assert_allclose(lambdas(plate("SSSS", 1.0, 1.0 / aspect), 40), expected, rtol=1e-6)


def test_published_glass_pane() -> None:
    """15 mm glass, 1.1 x 1.5 m (geometry of Vigran, Building Acoustics, Fig. 3.23)."""
    glass = Plate(1.1, 1.5, 0.015, Material("glass", 2500.0, 70e9, 0.22), "simply-supported")
    expected = [46.89, 96.08, 138.37, 178.07, 187.56]
    np.testing.assert_allclose(plate_modes(glass, 5).frequencies_hz, expected, rtol=2e-4)


@pytest.mark.parametrize(
    ("boundary", "count"), [("FFFF", 3), ("SFFF", 1), ("FFFS", 1), ("SSFF", 0), ("SFSF", 0), ("CFFF", 0)]
)
def test_rigid_motions(boundary: str, count: int) -> None:
    modes = plate_modes(plate(boundary, 1.0, 0.6), 6)
    assert np.count_nonzero(modes.frequencies_hz == 0) == count
    assert (modes.frequencies_hz[count:] > 1.0).all()
    # A rigid motion is a plane: the deflections at three corners determine the fourth.
    corners = modes.shapes([[0.0, 0.0], [1.0, 0.0], [0.0, 0.6], [1.0, 0.6]])[:, :count]
    np.testing.assert_allclose(corners[3], corners[1] + corners[2] - corners[0], atol=1e-6)


@pytest.mark.parametrize("boundary", BEAMS)
def test_a_slender_plate_is_a_beam(boundary: str) -> None:
    """A strip 200 times as long as wide; with nu = 0 it bends like a beam."""
    expected = np.array(BEAMS[boundary])
    strip = lambdas(plate(boundary, 1.0, 0.005, nu=0.0), 8)
    np.testing.assert_allclose(np.sqrt(strip[strip > 1e-6])[: len(expected)], expected, rtol=1e-5)


@pytest.mark.parametrize("boundary", ["FFFF", "CFSF", "SCFC"])
def test_modal_mass_is_one_kilogram(boundary: str) -> None:
    of = plate(boundary, 1.3, 0.7)
    modes = plate_modes(of, max_frequency_hz=900.0)
    assert len(modes.frequencies_hz) > 20
    nodes, weights = np.polynomial.legendre.leggauss(60)
    x, y = 1.3 * (nodes + 1) / 2, 0.7 * (nodes + 1) / 2
    points = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
    mass = np.outer(weights, weights).ravel() * (1.3 * 0.7 / 4) * 2500.0 * 0.01
    shapes = modes.shapes(points)
    np.testing.assert_allclose(shapes.T @ (mass[:, None] * shapes), np.eye(shapes.shape[1]), atol=1e-9)


def test_shapes_meet_their_edges() -> None:
    """Clamped at x=0 (no deflection, no slope), hinged at y=0, free elsewhere."""
    modes = plate_modes(plate("CFSF", 1.0, 0.6), 10)
    y = np.linspace(0.05, 0.55, 7)
    inside = np.abs(modes.shapes(np.column_stack([np.full(7, 0.5), y]))).max()
    assert np.abs(modes.shapes(np.column_stack([np.zeros(7), y]))).max() < 1e-9 * inside
    near = 1e-4
    assert np.abs(modes.shapes(np.column_stack([np.full(7, near), y]))).max() < 100 * near**2 * inside
    hinge = np.abs(modes.shapes(np.column_stack([y, np.zeros(7)])))
    assert hinge.max() < 1e-9 * inside
    assert np.abs(modes.shapes([[1.0, 0.6]])).min() > 1e-3 * inside


@pytest.mark.parametrize("boundary", ["CFSF", "SCFF", "FFFF", "SSCF"])
def test_turning_the_plate_changes_nothing(boundary: str) -> None:
    one = plate_modes(plate(boundary, 1.1, 0.6), 20)
    turned = plate_modes(plate(boundary[2:] + boundary[:2], 0.6, 1.1), 20)
    np.testing.assert_allclose(turned.frequencies_hz, one.frequencies_hz, rtol=1e-7)
    points = np.array([[0.2, 0.1], [0.7, 0.6], [1.1, 0.3]])
    elastic = one.frequencies_hz > 0  # rigid motions share a frequency, so their shapes may be mixed
    np.testing.assert_allclose(
        np.abs(turned.shapes(points[:, ::-1])[:, elastic]), np.abs(one.shapes(points)[:, elastic]), atol=1e-5
    )


@pytest.mark.parametrize(
    ("change", "factor"),
    [("E", 2.0**0.5), ("rho", 2.0**-0.5), ("h", 2.0), ("size", 0.25)],
)
def test_scaling(change: str, factor: float) -> None:
    """Double E, rho, h or both sides."""
    one = plate("CFSF", 0.9, 0.5)
    m = one.material
    other = {
        "E": replace(one, material=replace(m, youngs_modulus_pa=2 * m.youngs_modulus_pa)),
        "rho": replace(one, material=replace(m, density_kg_m3=2 * m.density_kg_m3)),
        "h": replace(one, thickness_m=2 * one.thickness_m),
        "size": replace(one, length_m=1.8, width_m=1.0),
    }[change]
    np.testing.assert_allclose(
        plate_modes(other, 15).frequencies_hz, factor * plate_modes(one, 15).frequencies_hz, rtol=1e-9
    )


@pytest.mark.parametrize(
    ("boundary", "length_m", "width_m", "nu"),
    [("CSFC", 0.7, 0.5, 0.0), ("CFSF", 0.6, 0.45, 0.42), ("SCFF", 0.9, 0.5, 0.15)],
)
def test_finite_elements(boundary: str, length_m: float, width_m: float, nu: float) -> None:
    of = plate(boundary, length_m, width_m, nu)
    np.testing.assert_allclose(plate_modes(of, 12).frequencies_hz, fe_frequencies_hz(of, (8, 6), 12), rtol=1e-3)


def test_models_and_callers_share_the_modes_of_a_plate() -> None:
    oak = Plate(0.71, 0.43, 0.01, "oak")
    assert PlateTerms(oak, 400.0).modes is plate_modes(oak, max_frequency_hz=modes_module.MARGIN * 400.0)


@pytest.mark.parametrize("boundary", ["FFFF", "CFFF", "CSFC"])
def test_every_mode_up_to_the_top_is_converged(boundary: str, monkeypatch: pytest.MonkeyPatch) -> None:
    of = plate(boundary, 1.2, 0.8)
    found = plate_modes(of, max_frequency_hz=1500.0).frequencies_hz
    more = modes_module._n_terms
    monkeypatch.setattr(modes_module, "_n_terms", lambda *args: more(*args) + 10)
    finer = modes_module.modes_up_to.__wrapped__(of, 1500.0, modes_module.FINE).frequencies_hz
    assert len(found) > 30
    np.testing.assert_allclose(found, finer[: len(found)], rtol=1e-3)
    assert len(finer) - len(found) <= 1  # one mode may move below the limit


def test_modes_by_count_and_by_frequency_agree() -> None:
    of = plate("FFFF", 1.0, 0.7)
    up_to = plate_modes(of, max_frequency_hz=300.0)
    counted = plate_modes(of, len(up_to.frequencies_hz))
    assert len(counted.frequencies_hz) == len(up_to.frequencies_hz)
    np.testing.assert_allclose(counted.frequencies_hz, up_to.frequencies_hz, rtol=1e-3)
    assert up_to.frequencies_hz.max() <= 300.0
    assert counted.shapes([0.1, 0.2]).shape == (1, len(counted.frequencies_hz))
    assert len(plate_modes(plate("CCCC"), max_frequency_hz=0.0).frequencies_hz) == 0


@pytest.mark.parametrize(
    "question", [{}, {"n_modes": 3, "max_frequency_hz": 10.0}, {"n_modes": 0}, {"max_frequency_hz": -1.0}]
)
def test_invalid_mode_requests_are_refused(question: dict[str, float]) -> None:
    with pytest.raises(ModelDomainError, match="n_modes|max_frequency_hz"):
        plate_modes(plate("FFFF"), **question)


def test_a_foil_is_refused_before_it_fills_the_memory() -> None:
    with pytest.raises(ModelDomainError, match="InfinitePlate"):
        plate_modes(Plate(50.0, 50.0, 1e-5, MATERIAL), max_frequency_hz=1000.0)


def test_points_off_the_plate_are_refused() -> None:
    modes = plate_modes(plate("FFFF", 1.0, 0.7), 4)
    with pytest.raises(ModelDomainError, match=r"\(1.2, 0.1\) m lies outside"):
        modes.shapes([[0.5, 0.5], [1.2, 0.1]])


def test_first_modes_of_a_small_stiff_plate_are_found_at_very_high_frequencies() -> None:
    plate = Plate(0.0144, 0.0144, 0.0104, Material("light and stiff", 1.0, 1e14, 0.3))
    softer = replace(plate, material=replace(plate.material, youngs_modulus_pa=1e8))
    found = plate_modes(plate, 8).frequencies_hz
    assert found[-1] > 1e8
    np.testing.assert_allclose(found, 1000 * plate_modes(softer, 8).frequencies_hz, rtol=1e-9)
