"""The modal plate, against closed forms, finite elements and a far larger basis."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from plate_fe import fe_receptance
from scene2hap import InfinitePlate, Material, ModalPlate, Plate, materials, plate_modes
from scene2hap.propagation.bodies.modal_body import ModalBody
from scene2hap.propagation.modal import modes as modes_module
from scene2hap.propagation.modal.modes import FINE
from scene2hap.propagation.modal.near_field import beyond_cutoff, beyond_cutoff_of_square, table

MATERIAL = Material("test", 2500.0, 70e9, 0.22, loss_factor=0.02)
FURNITURE = {
    "oak table": Plate(1.2, 0.7, 0.025, materials.lookup("oak")),
    "glass top": Plate(0.9, 0.6, 0.006, materials.lookup("glass")),
    "plywood shelf": Plate(0.9, 0.25, 0.018, materials.lookup("plywood"), "SSFF"),
    "steel bracket": Plate(0.4, 0.3, 0.002, materials.lookup("steel"), "CFFF"),
    "clamped pane": Plate(0.6, 0.5, 0.004, materials.lookup("glass"), "clamped"),
}
FREQUENCIES_HZ = np.geomspace(10.0, 1000.0, 120)


def test_little_ripples_along_the_axes_through_a_force() -> None:
    """Truncation of the basis shows most on both lines through the force: 0.83 % if it ends with the modes' basis."""
    plate = Plate(1.2, 0.7, 0.002, materials.lookup("steel"))
    drive, along = np.array([[0.3, 0.2]]), np.linspace(0.05, 0.95, 40)
    x_line = np.column_stack([along * plate.length_m, np.full(40, 0.2)])
    y_line = np.column_stack([np.full(40, 0.3), along * plate.width_m])
    points = np.vstack([x_line, y_line])
    larger = replace(FINE, per_k_length=2 * FINE.per_k_length, least=2 * FINE.least)
    for f in (60.0, 80.0, 300.0, 800.0):
        found, exact = (
            ModalBody(plate, f, 0.02, fineness).receptance(points, drive, np.array([f])) for fineness in (FINE, larger)
        )
        assert np.linalg.norm(found - exact) < 0.0075 * np.linalg.norm(exact)


@pytest.mark.parametrize("poisson_ratio", [0.3, 0.45])
def test_driven_points_near_free_edges_are_those_of_a_far_larger_basis(poisson_ratio: float) -> None:
    """A free edge raises the near field of a force, the more the larger Poisson's ratio. The image in the edge must do
    so too: with the same weight for all ratios, 1.29, errors are 0.035 and 0.039 dB."""
    plate = Plate(0.6, 0.4, 0.01, Material("test", 700.0, 11e9, poisson_ratio, 0.02))
    parts = (0.0, 0.005, 0.01, 0.02, 0.03, 0.05)
    points = np.array([(x * 0.6, 0.17) for x in parts] + [(0.26, y * 0.4) for y in parts])
    f = np.geomspace(20.0, 400.0, 40)
    larger = replace(FINE, per_k_length=2.5 * FINE.per_k_length, least=56)
    body, exact = (ModalBody(plate, 400.0, 0.02, fineness) for fineness in (FINE, larger))
    errors_db = [
        20 * np.log10(np.abs(body.receptance(at, at.copy(), f) / exact.receptance(at, at.copy(), f)))
        for at in points[:, None]
    ]
    assert np.percentile(np.abs(errors_db), 95) < 0.03


def db_apart(one: NDArray[np.complex128], other: NDArray[np.complex128]) -> NDArray[np.float64]:
    return np.abs(20 * np.log10(np.abs(one / other)))


def some_points(plate: Plate, drive_m: NDArray[np.float64], n: int = 12) -> NDArray[np.float64]:
    """The driven point, one a few centimetres away, and random points on the whole plate."""
    size = np.array([plate.length_m, plate.width_m])
    others = np.random.default_rng(5).uniform(0.03, 0.97, (n, 2)) * size
    return np.vstack([drive_m, drive_m + 0.05 * (0.5 * size - drive_m), others])


@pytest.mark.parametrize("name", FURNITURE)
@pytest.mark.parametrize("where", [(0.5, 0.5), (0.31, 0.64), (0.92, 1.0), (0.93, 0.12)])
def test_a_larger_basis_agrees(name: str, where: tuple[float, float], monkeypatch: pytest.MonkeyPatch) -> None:
    plate = FURNITURE[name]
    inset = 0.15 if plate.edges == "CCCC" else 0.0  # near clamped corners motion is small, and errors are larger
    drive = (inset + (1 - 2 * inset) * np.array(where)) * [plate.length_m, plate.width_m]
    points = some_points(plate, drive)
    found = ModalPlate().plate_receptance(plate, drive, points, FREQUENCIES_HZ)
    terms = modes_module._n_terms
    monkeypatch.setattr(modes_module, "_n_terms", lambda *args: 2 * terms(*args))
    monkeypatch.setattr("scene2hap.propagation.modal.modes.modes_up_to", modes_module.modes_up_to.__wrapped__)
    finer = ModalPlate().plate_receptance(plate, drive, points, FREQUENCIES_HZ)
    apart = db_apart(found, finer)
    assert np.median(apart) < 0.1
    assert np.quantile(apart, 0.95) < 0.5
    assert np.median(apart[0]) < 0.1  # the driven point alone, which couples contacts
    assert np.quantile(apart[0], 0.95) < 0.5


@pytest.mark.parametrize(
    "plate",
    [
        Plate(0.9, 0.6, 0.012, replace(MATERIAL, loss_factor=0.01), "FFFF"),
        Plate(0.7, 0.5, 0.010, replace(MATERIAL, poisson_ratio=0.4), "CSFC"),
    ],
    ids=["free", "CSFC"],
)
def test_finite_elements(plate: Plate) -> None:
    drive = np.array([0.25, 0.25]) * [plate.length_m, plate.width_m]  # on a node of the mesh, where it is most accurate
    points = some_points(plate, drive, n=6)
    f = np.geomspace(20.0, 800.0, 25)
    expected = fe_receptance(plate, (12, 8), drive, points, f, plate.material.loss_factor)
    apart = db_apart(ModalPlate().plate_receptance(plate, drive, points, f), expected)
    assert np.median(apart) < 0.1
    assert np.quantile(apart, 0.95) < 0.5


def test_the_closed_form_on_hinges() -> None:
    """Compare with 4 / (m a b) sum of sin sin sin sin / (omega_n^2 (1 + j eta) - omega^2), 400 x 400 terms."""
    plate = Plate(0.8, 0.5, 0.006, MATERIAL, "SSSS")
    m, D = 2500.0 * 0.006, 70e9 * 0.006**3 / (12 * (1 - 0.22**2))
    drive, points = np.array([0.3, 0.2]), np.array([[0.3, 0.2], [0.31, 0.21], [0.6, 0.1]])
    f = np.array([0.0, 37.0, 150.0, 333.0, 800.0])
    i, j = np.arange(1, 401)[:, None], np.arange(1, 401)[None, :]
    omega2 = D / m * ((i * np.pi / 0.8) ** 2 + (j * np.pi / 0.5) ** 2) ** 2

    def shape(x: float, y: float) -> NDArray[np.float64]:
        return np.sin(i * np.pi * x / 0.8) * np.sin(j * np.pi * y / 0.5)

    expected = np.array(
        [
            [
                4 / (m * 0.8 * 0.5) * np.sum(shape(*p) * shape(*drive) / (omega2 * (1 + 0.02j) - w**2))
                for w in 2 * np.pi * f
            ]
            for p in points
        ]
    )
    found = ModalPlate().plate_receptance(plate, drive, points, f)
    assert db_apart(found, expected).max() < 0.1
    np.testing.assert_allclose(
        ModalPlate().plate_transfer(plate, drive, points, f), expected / expected[0], rtol=0.02, atol=0.01
    )


def test_static_deflection_of_a_clamped_square() -> None:
    """Timoshenko and Woinowsky-Krieger, Theory of Plates and Shells, table 37: centre force, w = 0.00560 F a^2 / D."""
    pane = Plate(0.5, 0.5, 0.004, MATERIAL, "CCCC")
    found = ModalPlate().plate_receptance(pane, [0.25, 0.25], [0.25, 0.25], [0.0])[0, 0]
    assert abs(found) * pane.bending_stiffness_nm / 0.25 == pytest.approx(0.00560, rel=2e-3)


def test_a_slow_force_moves_a_free_plate_as_a_body() -> None:
    """-omega^2 times the receptance at the centre tends to 1 / M, and the transfer to that of a rigid rectangle."""
    plate = FURNITURE["oak table"]
    mass = plate.material.density_kg_m3 * plate.length_m * plate.width_m * plate.thickness_m
    centre = [plate.length_m / 2, plate.width_m / 2]
    found = ModalPlate().plate_receptance(plate, centre, centre, [0.1])[0, 0]
    assert -found * (2 * np.pi * 0.1) ** 2 == pytest.approx(1 / mass, rel=1e-4)
    # A force at a corner gives 1/M + 3/M + 3/M there, and 1/M - 3/M - 3/M at the opposite corner.
    far = ModalPlate().plate_transfer(plate, [0.0, 0.0], [[plate.length_m, plate.width_m]], [0.0, 1e-3])
    np.testing.assert_allclose(far, -5 / 7, rtol=1e-6)


def test_modes_are_its_resonances() -> None:
    """With low loss, each well separated mode peaks at its frequency with phi^2 / (eta omega_n^2)."""
    plate = Plate(0.8, 0.5, 0.006, replace(MATERIAL, loss_factor=1e-4), "CFFF")
    modes = plate_modes(plate, 4)
    drive = [0.8, 0.17]
    phi = modes.shapes(drive)[0]
    omega = 2 * np.pi * modes.frequencies_hz
    found = ModalPlate(loss_floor=0.0).plate_receptance(plate, drive, drive, modes.frequencies_hz)[0]
    np.testing.assert_allclose(np.abs(found), phi**2 / (1e-4 * omega**2), rtol=0.02)


def test_averages_to_the_infinite_plate() -> None:
    """The real mobility averaged over some 60 modes is that of the plate without edges, within 10 %."""
    plate = Plate(1.1, 1.5, 0.006, replace(MATERIAL, loss_factor=0.03), "SSSS")
    f = np.linspace(150.0, 1000.0, 600)
    drives = np.random.default_rng(3).uniform(0.2, 0.8, (6, 2)) * [1.1, 1.5]
    mobility = [(2j * np.pi * f * ModalPlate().plate_receptance(plate, d, d, f)[0]).real for d in drives]
    infinite = (2j * np.pi * f * InfinitePlate().plate_receptance(plate, [0, 0], [0, 0], f)[0]).real
    assert np.mean(mobility) / np.mean(infinite) == pytest.approx(1.0, abs=0.1)


def test_transfer_is_one_at_the_driven_point_and_may_exceed_it() -> None:
    plate = FURNITURE["glass top"]
    transfer = ModalPlate().plate_transfer(plate, [0.2, 0.1], some_points(plate, np.array([0.2, 0.1])), FREQUENCIES_HZ)
    assert transfer.shape == (14, 120)
    np.testing.assert_allclose(transfer[0], 1.0, rtol=1e-9)
    assert np.abs(transfer).max() > 3.0


def test_share_beyond_the_cut_off() -> None:
    """Compare with 2 integral from 1 to infinity of J0(a t) / t^3 dt, by quadrature in 1/t."""
    from scipy.special import j0

    t = np.linspace(1e-7, 1.0, 400_001)
    a = np.array([0.0, 0.01, 0.3, 1.0, 4.0, 12.0, 19.0])
    expected = [2 * np.trapezoid(j0(x / t) * t, t) for x in a]
    np.testing.assert_allclose(beyond_cutoff(a), expected, atol=2e-5)
    assert (beyond_cutoff(np.array([21.0, 1e12])) == 0).all()
    many = np.concatenate([[0.0, 20.5, 1e30], 10 ** np.random.default_rng(0).uniform(-6, 2, 2000)])
    np.testing.assert_allclose(beyond_cutoff_of_square(many**2, table()), beyond_cutoff(many), atol=1e-6)
