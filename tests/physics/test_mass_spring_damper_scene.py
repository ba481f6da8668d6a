"""A scene of lattices coupled by substructuring, against the same masses, springs and dampers in one sparse system."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

from scene2hap import Bands, Contact, ContactNetwork, Excitation, ModalPlate, Plate, RigidBody, materials
from scene2hap.errors import ModelDomainError
from scene2hap.propagation import MODELS
from scene2hap.propagation.coupled.contact_stiffness import ContactLaw
from scene2hap.propagation.lattice.bending_lattice import bending_lattice
from scene2hap.propagation.lattice.stepping import NewmarkStepper, State
from scene2hap.propagation.mass_spring_damper import CoarsenedWarning, MassSpringDamper

TABLE = Plate(1.2, 0.7, 0.025, replace(materials.lookup("oak"), loss_factor=0.03))
TRAY = Plate(0.5, 0.4, 0.006, replace(materials.lookup("glass"), loss_factor=0.02))
FEET = [(0.1, 0.1), (0.4, 0.12), (0.38, 0.3), (0.12, 0.33)]
PHONE_KG = 0.2


def scene() -> ContactNetwork:
    """A phone on a tray on a table, one corner of each at the world's origin."""
    phone = [Contact("phone", "tray", (0.21, 0.17, 0.0))]
    feet = [Contact("table", "tray", (x, y, 0.0)) for x, y in FEET]
    return ContactNetwork({"phone": RigidBody(PHONE_KG), "tray": TRAY, "table": TABLE}, [*phone, *feet])


class Assembled:
    """Mass, stiffness and damping of a chain of bodies with joints between neighbours; the first body is rigid."""

    def __init__(self, plates: list[Plate], resolution: int, mass_kg: float) -> None:
        from scipy.sparse import block_diag, csr_array, diags_array

        self.lattices = [bending_lattice(plate, resolution) for plate in plates]
        areal = [plate.material.density_kg_m3 * plate.thickness_m for plate in plates]
        masses = [lattice.masses * m for lattice, m in zip(self.lattices, areal, strict=True)]
        self.mass = csr_array(block_diag([np.array([[mass_kg]]), *masses]))
        D = [plate.bending_stiffness_nm for plate in plates]
        self.stiffness = [k * lattice.stiffness for k, lattice in zip(D, self.lattices, strict=True)]
        self.losses = [plate.material.loss_factor for plate in plates]
        self.starts = np.cumsum([1, *(lattice.n_nodes for lattice in self.lattices)])
        self._block = lambda blocks: csr_array(block_diag([np.zeros((1, 1)), *blocks]))
        self._diagonal = diags_array

    def at(self, body: int, point_m: tuple[float, float]) -> NDArray[np.float64]:
        """The row that gives the deflection of a body (0 is the rigid one) at a point."""
        row = np.zeros(self.starts[-1])
        if body == 0:
            row[0] = 1.0
        else:
            found = self.lattices[body - 1].interpolation(np.array([point_m])).toarray()[0]
            row[self.starts[body - 1] : self.starts[body]] = found
        return row

    def harmonic(
        self, apart: list[NDArray[np.float64]], joints: list[complex], force: NDArray[np.float64], omega: float
    ) -> NDArray[np.complex128]:
        """Deflections under a force, with joints of the given dynamic stiffnesses."""
        from scipy.sparse import csc_array
        from scipy.sparse.linalg import splu

        bodies = self._block([(1 + 1j * eta) * K for eta, K in zip(self.losses, self.stiffness, strict=True)])
        B = csc_array(np.array(apart))
        whole = bodies + B.T @ self._diagonal(np.array(joints)) @ B - omega**2 * self.mass
        found: NDArray[np.complex128] = splu(csc_array(whole)).solve(force + 0j)
        return found


@pytest.mark.parametrize("frequency_hz", [37.0, 120.0, 333.0])
def test_substructuring_is_the_assembled_scene(frequency_hz: float) -> None:
    omega = 2 * np.pi * frequency_hz
    model = MassSpringDamper(20)
    field = model.prepare(scene(), [Excitation("phone", 99.0, frequency_hz, PHONE_KG)], Bands.dominant())
    touches = np.array([[0.05, 0.05, 0.0], [0.45, 0.35, 0.0], [0.31, 0.2, 0.0]])
    found = {name: field.attenuation(name, touches)[:, 0, 0] for name in ("tray", "table")}

    whole = Assembled([TRAY, TABLE], 20, PHONE_KG)
    law = ContactLaw()
    k_phone, eta_phone = law.stiffness(None, TRAY.material, preload_n=9.80665 * PHONE_KG)
    k_foot, eta_foot = law.stiffness(TRAY.material, TABLE.material)
    apart = [whole.at(0, (0, 0)) - whole.at(1, (0.21, 0.17))] + [whole.at(1, at) - whole.at(2, at) for at in FEET]
    joints = [k_phone * (1 + 1j * eta_phone)] + 4 * [k_foot * (1 + 1j * eta_foot)]
    # This force would move the free phone by 1.
    u = whole.harmonic(apart, joints, -(omega**2) * PHONE_KG * whole.at(0, (0, 0)), omega)
    for body, name in ((1, "tray"), (2, "table")):
        expected = [abs(whole.at(body, (x, y)) @ u) for x, y, _ in touches]
        np.testing.assert_allclose(found[name], expected, rtol=0.01)


def test_a_scene_stepped_in_time_settles_to_its_harmonic_answer() -> None:
    """Newmark steps against a complex solve, for two lossless plates and a body joined by springs and dampers."""
    plates = [replace(plate, material=replace(plate.material, loss_factor=0.0)) for plate in (TRAY, TABLE)]
    whole = Assembled(plates, 6, PHONE_KG)
    apart = [whole.at(0, (0, 0)) - whole.at(1, (0.21, 0.17))] + [whole.at(1, at) - whole.at(2, at) for at in FEET]
    # The table stands on the ground at its corners; dampers there and in the joints damp every mode.
    apart += [whole.at(2, (x, y)) for x in (0.0, 1.2) for y in (0.0, 0.7)] + [whole.at(1, (0.0, 0.4))]
    k, c = 2e4, 30.0
    force, omega, dt = whole.at(0, (0, 0)), 2 * np.pi * 25.0, 1 / 4000
    expected = whole.harmonic(apart, [k + 1j * omega * c] * len(apart), force, omega)

    from scipy.sparse import csr_array

    B = csr_array(np.array(apart))
    K = whole._block(whole.stiffness) + k * (B.T @ B)
    stepper = NewmarkStepper(whole.mass, c * (B.T @ B), K, dt)
    state = State(np.zeros(whole.starts[-1]), np.zeros(whole.starts[-1]))
    forces = [force * np.cos(omega * i * dt) for i in range(6401)]
    total = np.zeros(whole.starts[-1], dtype=complex)
    for i, (now, after) in enumerate(pairwise(forces), start=1):
        state = stepper.step(state, now, after)
        if i > 4800:  # ten periods of 160 steps
            total += 2 / 1600 * state.displacement * np.exp(-1j * omega * i * dt)
    look = np.array([whole.at(0, (0, 0)), whole.at(1, (0.21, 0.17)), whole.at(2, (0.6, 0.35))])
    np.testing.assert_allclose(look @ total, look @ expected, rtol=0.02, atol=0.01 * np.abs(look @ expected).max())


def test_gains_agree_with_the_modal_plate() -> None:
    """Octave bands over the same scene, in dB."""
    bands = Bands((10.0, 20.0, 40.0, 80.0, 160.0, 320.0))
    touches = [[0.05, 0.05, 0.0], [0.45, 0.35, 0.0], [0.31, 0.2, 0.0]]
    answers = [
        model.prepare(scene(), [Excitation("phone", 99.0, 99.0, PHONE_KG)], bands).attenuation("table", touches)
        for model in (MassSpringDamper(16), ModalPlate())
    ]
    assert np.abs(20 * np.log10(answers[0] / answers[1])).max() < 0.2


@pytest.mark.filterwarnings("ignore::scene2hap.propagation.domain.SlowPlateWarning")
def test_model_is_chosen_by_kind_and_refines_thin_plates() -> None:
    model: MassSpringDamper = MODELS.build({"kind": "mass_spring_damper", "resolution": 8})
    foil = Plate(0.4, 0.3, 0.0005, materials.lookup("steel"))
    body = model.elastic_body(foil, 1000.0)
    assert body.modes.lattice.cell_m[1] < foil.width_m / 8
    assert 2 * np.pi / float(foil.wavenumber_rad_m(1000.0)) >= 4 * max(body.modes.lattice.cell_m)
    thinner = replace(foil, thickness_m=1e-6)
    with pytest.warns(CoarsenedWarning, match="as if it had no edges"):
        model.elastic_body(thinner, 1000.0)
    with pytest.raises(ModelDomainError, match="too many for masses and springs"):
        replace(model, outside_domain="raise").elastic_body(thinner, 1000.0)
