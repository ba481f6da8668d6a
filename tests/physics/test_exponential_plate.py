"""The paper's three equations, computed independently of the code in 50-digit decimals."""

from decimal import Decimal, getcontext
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from scene2hap import (
    Bands,
    Contact,
    ContactNetwork,
    Excitation,
    ExponentialPlate,
    FullPropagation,
    NoPropagation,
    Plate,
    materials,
)
from scene2hap.errors import ConfigError, ModelDomainError
from scene2hap.propagation.bands.band_rms import band_rms

getcontext().prec = 50
PI = Decimal("3.1415926535897932384626433832795028841971693993751")
DISTANCES_M = (0.0, 0.4, 0.8, 1.2)

# The surfaces of the paper's second study; materials and distances are the paper's, thickness and frequency are ours.
STUDY_2 = {
    "speaker on a metal table": ("steel", 0.002, 1.6, 0.8, 80.0),
    "smartphone on a wooden table": ("oak", 0.025, 1.6, 0.8, 175.0),
    "washing machine on a wooden floor": ("oak", 0.022, 4.0, 3.0, 20.0),
}


def gamma_by_hand(material: str, thickness_m: float, frequency_hz: float, distance_m: float) -> Decimal:
    """exp(-k d) with k^4 = rho h omega^2 / D and D = E h^3 / (12 (1 - nu^2)), in exact decimals of the floats given."""
    m = materials.lookup(material)
    E, nu, rho = Decimal(m.youngs_modulus_pa), Decimal(m.poisson_ratio), Decimal(m.density_kg_m3)
    h, d, omega = Decimal(thickness_m), Decimal(distance_m), 2 * PI * Decimal(frequency_hz)
    D = E * h**3 / (12 * (1 - nu**2))
    k = (rho * h * omega**2 / D).sqrt().sqrt()
    return (-k * d).exp()


def relative_error(found: float, expected: Decimal) -> float:
    return float(abs(Decimal(found) - expected) / expected)


@pytest.mark.parametrize("surface", STUDY_2)
@pytest.mark.parametrize("distance_m", DISTANCES_M)
def test_transfer_along_one_plate_follows_the_published_law(surface: str, distance_m: float) -> None:
    material, h, length, width, f = STUDY_2[surface]
    plate = Plate(length, width, h, materials.lookup(material))
    # Along both axes and along a slanted line: 3-4-5 triangles keep the distance exact.
    for direction in ((1.0, 0.0), (0.0, 1.0), (0.6, 0.8)):
        point = [[0.2 + distance_m * direction[0], 0.3 + distance_m * direction[1]]]
        found = ExponentialPlate().plate_transfer(plate, [0.2, 0.3], point, [f])
        assert found.shape == (1, 1)
        assert found.imag.max() == 0.0
        travelled = float(np.hypot(point[0][0] - 0.2, point[0][1] - 0.3))
        assert relative_error(float(found[0, 0].real), gamma_by_hand(material, h, f, travelled)) <= 1e-12


@pytest.mark.parametrize("surface", STUDY_2)
@pytest.mark.parametrize("distance_m", DISTANCES_M)
def test_a_source_on_the_surface(surface: str, distance_m: float) -> None:
    material, h, length, width, f = STUDY_2[surface]
    network = ContactNetwork(
        {"table": Plate(length, width, h, materials.lookup(material))}, [Contact("source", "table", (0.0, 0.75, 0.0))]
    )
    field = ExponentialPlate().prepare(network, [Excitation("source", 999.0, f)], Bands.dominant())
    found = field.attenuation("table", [[distance_m, 0.75, 0.0]])
    assert found.shape == (1, 1, 1)
    assert relative_error(float(found[0, 0, 0]), gamma_by_hand(material, h, f, distance_m)) <= 1e-12
    assert field.attenuation("source", [[9.0, 9.0, 9.0]])[0, 0, 0] == 1.0


def test_the_raw_frequency_on_request() -> None:
    network = ContactNetwork({"t": Plate(1, 1, 0.01, materials.lookup("oak"))}, [Contact("s", "t", (0, 0, 0))])
    excitation = [Excitation("s", 50.0, 200.0)]
    raw = ExponentialPlate(frequency="raw").prepare(network, excitation, Bands.dominant())
    felt = ExponentialPlate().prepare(network, excitation, Bands.dominant())
    raw_gain = float(raw.attenuation("t", [[0.3, 0, 0]])[0, 0, 0])
    assert relative_error(raw_gain, gamma_by_hand("oak", 0.01, 50.0, 0.3)) <= 1e-12
    # k ~ sqrt(f): four times the frequency squares the attenuation.
    assert float(felt.attenuation("t", [[0.3, 0, 0]])[0, 0, 0]) == pytest.approx(raw_gain**2, rel=1e-12)


def chain(n: int, weight: float = 1.0) -> ContactNetwork:
    """source - p0 - p1 - ... with 0.3 m between neighbouring contacts on a line."""
    plate = Plate(1.0, 1.0, 0.02, materials.lookup("oak"))
    names = ["source", *(f"p{i}" for i in range(n))]
    contacts = [Contact(a, b, (0.3 * i, 0.0, 0.0), weight=weight) for i, (a, b) in enumerate(pairwise(names))]
    return ContactNetwork(dict.fromkeys(names, plate), contacts)


@pytest.mark.parametrize("n", [1, 2, 3, 6])
def test_attenuation_multiplies_along_a_path(n: int) -> None:
    field = ExponentialPlate().prepare(chain(n), [Excitation("source", 100.0, 100.0)], Bands.dominant())
    found = field.attenuation(f"p{n - 1}", [[0.3 * n, 0.0, 0.0]])[0, 0, 0]
    assert relative_error(float(found), gamma_by_hand("oak", 0.02, 100.0, 0.3) ** n) <= 1e-12


@pytest.mark.parametrize("model", [ExponentialPlate(max_hops=2), FullPropagation(max_hops=2)])
def test_max_hops_counts_contacts(model: ExponentialPlate | FullPropagation) -> None:
    field = model.prepare(chain(4), [Excitation("source", 100.0, 100.0)], Bands.dominant())
    reached = [field.attenuation(f"p{i}", [[0.3 * i, 0, 0]])[0, 0, 0] > 0 for i in range(4)]
    assert reached == [True, True, False, False]


def test_a_longer_way_over_fewer_contacts_counts_where_hops_are_few() -> None:
    plate = Plate(9.0, 9.0, 0.02, materials.lookup("oak"))
    contacts = [
        Contact("s", "a", (0, 0, 0)),
        Contact("a", "b", (0.1, 0, 0)),
        Contact("b", "c", (0.2, 0, 0)),
        Contact("s", "b", (2.0, 0, 0)),
        Contact("c", "d", (0.3, 0, 0)),
    ]
    network = ContactNetwork(dict.fromkeys("abcd", plate), contacts)
    k = float(plate.wavenumber_rad_m(100.0))

    def length_to(model: ExponentialPlate, body: str, x: float) -> float:
        field = model.prepare(network, [Excitation("s", 100.0, 100.0)], Bands.dominant())
        return -np.log(field.attenuation(body, [[x, 0, 0]])[0, 0, 0]) / k

    # The short path s-a-b-c-d crosses 4 contacts; s-b-c-d crosses 3 and is longer.
    assert length_to(ExponentialPlate(), "d", 0.3) == pytest.approx(0.3)
    assert length_to(ExponentialPlate(max_hops=3), "d", 0.3) == pytest.approx(1.8 + 0.1)


def test_the_nearest_of_several_contacts_counts() -> None:
    plate = Plate(1.0, 1.0, 0.02, materials.lookup("oak"))
    feet = [Contact("s", "t", (x, 0.0, 0.0)) for x in (0.0, 0.5, 1.0)]
    field = ExponentialPlate().prepare(
        ContactNetwork({"t": plate}, feet), [Excitation("s", 99.0, 99.0)], Bands.dominant()
    )
    found = field.attenuation("t", [[0.6, 0, 0], [0.9, 0, 0]])[:, 0, 0]
    np.testing.assert_allclose(found, np.exp(-float(plate.wavenumber_rad_m(99.0)) * 0.1), rtol=1e-12)


def test_contact_weight_is_the_loss_at_250_hz_and_weight_zero_removes_it() -> None:
    plain = ExponentialPlate().prepare(chain(1), [Excitation("source", 250.0, 250.0)], Bands.dominant())
    half = ExponentialPlate().prepare(chain(1, 0.5), [Excitation("source", 250.0, 250.0)], Bands.dominant())
    gone = ExponentialPlate().prepare(chain(1, 0.0), [Excitation("source", 250.0, 250.0)], Bands.dominant())
    at = [[0.2, 0.0, 0.0]]
    assert half.attenuation("p0", at) == pytest.approx(0.5 * plain.attenuation("p0", at), rel=1e-12)
    assert gone.attenuation("p0", at) == 0.0


def test_object_without_a_body_can_only_be_a_source() -> None:
    network = chain(3)
    bodies = {name: body for name, body in network.bodies.items() if name not in ("source", "p1")}
    field = ExponentialPlate().prepare(
        ContactNetwork(bodies, network.contacts), [Excitation("source", 100.0, 100.0)], Bands.dominant()
    )
    assert field.attenuation("p0", [[0, 0, 0]]) == 1.0
    assert field.attenuation("p1", [[0, 0, 0]]) == 0.0
    assert field.attenuation("p2", [[0, 0, 0]]) == 0.0


@pytest.mark.parametrize("bands", [Bands.dominant(), Bands.third_octaves(10, 1000)])
def test_control_models_give_full_and_no_propagation(bands: Bands) -> None:
    excitations = [Excitation("source", 100.0, 100.0), Excitation("p2", 80.0, 80.0)]
    network = chain(4)
    cut = ContactNetwork(network.bodies, [c for c in network.contacts if (c.a, c.b) != ("p0", "p1")])
    at = [[7.0, 7.0, 7.0], [0.0, 0.0, 0.0]]
    full = FullPropagation().prepare(cut, excitations, bands)
    none = NoPropagation().prepare(cut, excitations, bands)
    for field in (full, none):
        assert field.attenuation("p0", at).shape == (2, 2, bands.n_bands)
    assert full.attenuation("p0", at)[0, :, 0].tolist() == [1.0, 0.0]
    assert full.attenuation("p3", at)[0, :, 0].tolist() == [0.0, 1.0]
    assert none.attenuation("p0", at)[0, :, 0].tolist() == [0.0, 0.0]
    assert none.attenuation("p2", at)[0, :, 0].tolist() == [0.0, 1.0]


@settings(max_examples=60)
@given(st.floats(0.0, 5.0), st.floats(10.0, 900.0), st.floats(1.01, 4.0))
def test_band_gain_is_the_rms_over_the_band(length: float, low_hz: float, ratio: float) -> None:
    f = np.linspace(low_hz, low_hz * ratio, 20001)
    squares = np.exp(-2 * length * np.sqrt(2 * np.pi * f))
    # Simpson's rule, independent of the closed form.
    weights = np.ones_like(f)
    weights[1:-1:2], weights[2:-1:2] = 4, 2
    expected = np.sqrt((weights * squares).sum() / weights.sum())
    found = band_rms(np.array([length]), np.array([[low_hz, low_hz * ratio]]))
    assert found.shape == (1, 1)
    assert found[0, 0] == pytest.approx(expected, rel=1e-7, abs=1e-30)


def test_band_gain_at_the_ends() -> None:
    edges = Bands.third_octaves(10, 1000).widths_hz()
    assert edges.shape == (20, 2)
    np.testing.assert_array_equal(band_rms(np.array([0.0]), edges), np.ones((1, 20)))
    np.testing.assert_array_equal(band_rms(np.array([np.inf]), edges), np.zeros((1, 20)))


FURNITURE = st.builds(
    Plate,
    st.floats(0.2, 3.0),
    st.floats(0.2, 3.0),
    st.floats(0.001, 0.2),
    st.sampled_from([row.material for row in materials.table()]),
)


@settings(max_examples=80)
@given(FURNITURE, st.floats(10.0, 1000.0))
def test_scaling_of_the_wavenumber(plate: Plate, f: float) -> None:
    k = float(plate.wavenumber_rad_m(f))
    m = plate.material
    thicker = Plate(plate.length_m, plate.width_m, 2 * plate.thickness_m, m)
    stiffer = Plate(
        plate.length_m,
        plate.width_m,
        plate.thickness_m,
        materials.Material("stiffer", m.density_kg_m3, 2 * m.youngs_modulus_pa, m.poisson_ratio),
    )
    assert float(plate.wavenumber_rad_m(4 * f)) == pytest.approx(2 * k, rel=1e-12)
    assert float(thicker.wavenumber_rad_m(f)) == pytest.approx(k / 2**0.5, rel=1e-12)
    assert float(stiffer.wavenumber_rad_m(f)) == pytest.approx(k / 2**0.25, rel=1e-12)


@settings(max_examples=80)
@given(FURNITURE, st.floats(10.0, 1000.0), st.floats(0.0, 2.0), st.floats(0.0, 2.0))
def test_gamma_falls_with_distance_within_0_and_1(plate: Plate, f: float, d1: float, d2: float) -> None:
    near, far, both = ExponentialPlate().plate_transfer(plate, [0, 0], [[d1, 0], [d2, 0], [d1 + d2, 0]], [f])[:, 0].real
    assert 0.0 <= far <= 1.0
    assert (near >= far) == (d1 <= d2) or near == far
    assert both == pytest.approx(near * far, rel=1e-9, abs=1e-300)


def test_published_constants_of_a_steel_plate() -> None:
    # 10 mm steel, 210 GPa, 0.3, 7850 kg/m3: D = 19230.8 N m, k(250 Hz) = 10.018 rad/m.
    plate = Plate(1, 1, 0.01, materials.Material("steel", 7850.0, 210e9, 0.3))
    assert plate.bending_stiffness_nm == pytest.approx(19230.8, rel=1e-5)
    assert float(plate.wavenumber_rad_m(250.0)) == pytest.approx(10.018, rel=1e-4)


@pytest.mark.parametrize("thickness", [0.0, -0.01, float("nan"), float("inf")])
def test_plate_without_thickness(thickness: float) -> None:
    with pytest.raises(ModelDomainError, match=r"thickness_m is .* m; it must be .* \[m\]"):
        Plate(1.0, 1.0, thickness, materials.lookup("oak"))


@pytest.mark.parametrize("boundary", ["welded", "FFF", "FFFX", ""])
def test_unknown_boundary(boundary: str) -> None:
    with pytest.raises(ModelDomainError, match="boundary is"):
        Plate(1.0, 1.0, 0.01, materials.lookup("oak"), boundary)


def test_points_of_the_wrong_shape() -> None:
    plate = Plate(1.0, 1.0, 0.01, materials.lookup("oak"))
    with pytest.raises(ModelDomainError, match=r"\(n_points, 2\)"):
        ExponentialPlate().plate_transfer(plate, [0, 0], [[0, 0, 0]], [100])
    with pytest.raises(ModelDomainError, match="frequency_hz"):
        ExponentialPlate().plate_transfer(plate, [0, 0], [[0, 0]], [-1])


def test_settings_out_of_bounds() -> None:
    with pytest.raises(ConfigError, match="max_hops is 0"):
        ExponentialPlate(max_hops=0)
    with pytest.raises(ConfigError, match="frequency is 'loud'"):
        ExponentialPlate(frequency="loud")
