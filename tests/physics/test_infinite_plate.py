"""The infinite plate, against tabulated values, the wavenumber integral and the asymptotic wave."""

import math
import warnings
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from scene2hap import InfinitePlate, Material, Plate
from scene2hap.errors import ModelDomainError
from scene2hap.propagation.bodies.infinite_body import spreading
from scene2hap.propagation.domain import ThinPlateWarning

LOSSLESS = Material("test", 1000.0, 1e10, 0.3, loss_factor=0.0)
PLATE = Plate(2.0, 1.0, 0.01, LOSSLESS)

# |H0^(2)(x) - (2j/pi) K0(x)|, six digits, checked against the wavenumber integral of the driven plate.
SPREADING = {0.5: 0.949451, 1.0: 0.844079, 2.0: 0.624403, math.pi: 0.461604, 5.0: 0.353948, 10.0: 0.252161}

plates = st.builds(
    Plate,
    length_m=st.floats(0.1, 5.0),
    width_m=st.floats(0.1, 5.0),
    thickness_m=st.floats(1e-4, 0.2),
    material=st.builds(
        Material,
        name=st.just("drawn"),
        density_kg_m3=st.floats(20.0, 20000.0),
        youngs_modulus_pa=st.floats(1e6, 1e12),
        poisson_ratio=st.floats(0.0, 0.49),
        loss_factor=st.floats(0.0, 2.0),
    ),
)


def at_kr(plate: Plate, kr: float, frequency_hz: float = 250.0) -> complex:
    """Transfer at a distance of kr radians, along a slanted line."""
    r = kr / float(plate.wavenumber_rad_m(frequency_hz))
    return complex(InfinitePlate().plate_transfer(plate, [0.0, 0.0], [[0.6 * r, 0.8 * r]], [frequency_hz])[0, 0])


@pytest.mark.parametrize(("kr", "expected"), SPREADING.items())
def test_spreading_table(kr: float, expected: float) -> None:
    assert abs(at_kr(PLATE, kr)) == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("kr", [0.3, 2.0, 7.0])
def test_wavenumber_integral(kr: float) -> None:
    """w(r) = F / (2 pi D) integral of J0(q r) q / (q^4 - k_c^4) dq, by quadrature; the loss keeps it smooth."""
    from scipy.special import j0

    eta = 0.5
    k_c = (1 + 1j * eta) ** -0.25
    q = np.linspace(0.0, 60.0, 600_001)
    integral = np.trapezoid(j0(q * kr) * q / (q**4 - k_c**4), q)
    lossy = replace(PLATE, material=replace(LOSSLESS, loss_factor=eta))
    found = at_kr(lossy, kr) * -1j / (8 * k_c**2)
    assert abs(found - integral / (2 * math.pi)) < 1e-4 * abs(found)


@pytest.mark.parametrize(
    ("thickness_m", "constants", "expected"),
    [
        (0.010, (7850.0, 210e9, 0.30), 1.0174e-4),
        (0.006, (2500.0, 70e9, 0.22), 8.870e-4),
        (0.140, (2300.0, 30e9, 0.20), 2.606e-6),
    ],
    ids=["steel", "glass", "concrete"],
)
def test_point_mobility(thickness_m: float, constants: tuple[float, float, float], expected: float) -> None:
    plate = Plate(3.0, 3.0, thickness_m, Material("test", *constants, loss_factor=0.0))
    # j omega times the receptance at the driven point is Y0 = 1 / (8 sqrt(D m)), real, at every frequency.
    f = np.array([10.0, 100.0, 400.0])
    receptance = InfinitePlate().plate_receptance(plate, [1.0, 1.0], [1.0, 1.0], f)[0]
    mobility = 2j * np.pi * f * receptance
    np.testing.assert_allclose(mobility, expected, rtol=2e-4)  # the precision of the published digits
    np.testing.assert_allclose(mobility, mobility[0].real, rtol=1e-12)


def test_far_field_is_a_cylindrical_wave() -> None:
    for kr in (1.0, 3.0, 30.0):
        assert abs(at_kr(PLATE, kr)) == pytest.approx(math.sqrt(2 / (math.pi * kr)), rel=0.06)
    # e^{+jwt}: the wave travels outwards, so its phase falls by 1 radian per kr.
    assert np.angle(at_kr(PLATE, 30.5) / at_kr(PLATE, 30.0)) == pytest.approx(-0.5, abs=1e-3)


@pytest.mark.parametrize("eta", [0.001, 0.01, 0.1])
def test_loss_decays_by_a_quarter_of_eta_per_radian(eta: float) -> None:
    lossy = replace(PLATE, material=replace(LOSSLESS, loss_factor=eta))
    kr = 20.0
    decay = abs(at_kr(lossy, kr) / at_kr(PLATE, kr))
    assert decay == pytest.approx(math.exp(-eta * kr / 4), rel=eta**2 * kr)


@pytest.mark.parametrize(
    ("change", "factor"),
    [
        ({"frequency_hz": 4.0}, 2.0),
        ({"youngs_modulus_pa": 2.0}, 2**-0.25),
        ({"density_kg_m3": 2.0}, 2**0.25),
        ({"thickness_m": 2.0}, 2**-0.5),
    ],
    ids=lambda case: str(case),
)
def test_transfer_depends_only_on_wavenumber_times_distance(change: dict[str, float], factor: float) -> None:
    """A plate with `factor` times the wavenumber has at a distance r the transfer of the other at `factor` times r."""
    (name, times), r = next(iter(change.items())), 0.2
    f = 100.0
    material = replace(LOSSLESS, loss_factor=0.03)
    plate = replace(PLATE, material=material)
    changed = plate
    if name == "thickness_m":
        changed = replace(plate, thickness_m=times * plate.thickness_m)
    elif name != "frequency_hz":
        changed = replace(plate, material=replace(material, **{name: times * getattr(material, name)}))
    f_changed = f * times if name == "frequency_hz" else f
    here = InfinitePlate().plate_transfer(changed, [0.0, 0.0], [r, 0.0], [f_changed])
    there = InfinitePlate().plate_transfer(plate, [0.0, 0.0], [factor * r, 0.0], [f])
    np.testing.assert_allclose(here, there, rtol=1e-12)


@settings(max_examples=60)
@given(plates, st.floats(0.0, 100.0), st.floats(1e-3, 20000.0))
def test_finite_bounded_and_symmetric_everywhere(plate: Plate, r: float, f: float) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ThinPlateWarning)
        there = InfinitePlate().plate_transfer(plate, [0.0, 0.0], [[0.0, 0.0], [r, 0.0]], [0.0, f])
        receptance = InfinitePlate().plate_receptance(plate, [0.0, 0.0], [[0.0, 0.0], [r, 0.0]], [f])
        back = InfinitePlate().plate_receptance(plate, [r, 0.0], [0.0, 0.0], [f])
    assert np.isfinite(there).all()
    assert np.isfinite(receptance).all()
    assert (np.abs(there) <= 1 + 1e-7).all()
    assert (there[:, 0] == 1).all()
    assert there[0, 1] == 1
    np.testing.assert_allclose(back[0, 0], receptance[1, 0], rtol=1e-13)
    assert receptance[0, 0].imag < 0  # the force does work on the plate, never the reverse


def test_the_smallest_and_the_largest_distance() -> None:
    near = spreading(np.array([0.0, 9.9e-5, 1.01e-4]).astype(complex))
    np.testing.assert_allclose(near, 1.0, atol=1e-7)
    assert np.isfinite(spreading(np.array([1e9, 1e300, 1e12 - 1e11j]).astype(complex))).all()


def test_a_thick_plate_warns_once() -> None:
    """140 mm of concrete: at 1.3 kHz, a wavelength is six thicknesses."""
    slab = Plate(3.0, 2.5, 0.14, Material("concrete", 2300.0, 30e9, 0.2))
    InfinitePlate().plate_transfer(slab, [0.0, 0.0], [1.0, 0.0], [1200.0])
    with pytest.warns(ThinPlateWarning, match=r"above 1.3\de\+03 Hz"):
        InfinitePlate().plate_transfer(slab, [0.0, 0.0], [1.0, 0.0], [1400.0])
    with warnings.catch_warnings(record=True) as again:
        warnings.simplefilter("always")
        InfinitePlate().plate_receptance(slab, [0.0, 0.0], [1.0, 0.0], [1400.0])
    assert not again


@pytest.mark.parametrize("frequencies_hz", [[-1.0], [np.nan], [np.inf], [[1.0, 2.0]]])
def test_refused_frequencies(frequencies_hz: list[float]) -> None:
    with pytest.raises(ModelDomainError, match="frequencies_hz"):
        InfinitePlate().plate_transfer(PLATE, [0.0, 0.0], [1.0, 0.0], frequencies_hz)


def test_receptance_at_0_hz_is_refused() -> None:
    with pytest.raises(ModelDomainError, match="0 Hz"):
        InfinitePlate().plate_receptance(PLATE, [0.0, 0.0], [1.0, 0.0], [0.0, 10.0])
