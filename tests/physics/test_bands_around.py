"""Gains over a band around the dominant frequency, against single frequencies within the band."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from scene2hap import Bands, Contact, ContactNetwork, Excitation, ModalPlate, Plate, Pose, materials
from scene2hap.propagation.bands.sampling import Sampling
from scene2hap.propagation.protocol import CarryingField, ExpectantField

EXACT, HALF = Bands.dominant(), Bands.dominant(octaves=0.5)
POINTS = np.array([[0.2, 0.6, 0.0], [0.9, 0.1, 0.0], [1.1, 0.65, 0.0], [0.55, 0.32, 0.0]])
SOURCES = [Excitation("phone", 150.0, 150.0, 0.2), Excitation("pump", 95.0, 95.0, 1.5)]


def table() -> ContactNetwork:
    top = Plate(1.2, 0.7, 0.02, materials.lookup("oak"))
    tray = Plate(0.4, 0.3, 0.003, materials.lookup("steel"))
    feet = [Contact("top", "tray", (0.4 + x, 0.3 + y, 0.0)) for x in (0.05, 0.35) for y in (0.04, 0.26)]
    stands = [Contact("pump", "tray", (0.5, 0.4, 0.0)), Contact("phone", "top", (0.2, 0.2, 0.0))]
    return ContactNetwork({"top": top, "tray": tray}, [*feet, *stands], {"tray": Pose((0.4, 0.3, 0.0))})


def rms_of_single(source: int, object_id: str, low_hz: float, high_hz: float, n: int) -> NDArray[np.float64]:
    """RMS of the gains at n single frequencies."""
    squares = np.zeros(len(POINTS))
    for f in low_hz + (high_hz - low_hz) * (np.arange(n) + 0.5) / n:
        one = replace(SOURCES[source], frequency_tactile_hz=float(f))
        others = [other for other in SOURCES if other.source_id != one.source_id]
        field = ModalPlate().prepare(table(), [one, *others], EXACT)
        squares += field.attenuation(object_id, POINTS)[:, field.source_ids.index(one.source_id), 0] ** 2
    return np.sqrt(squares / n)


@pytest.mark.parametrize("is_expected", [False, True])
def test_the_gain_is_the_rms_over_the_band(is_expected: bool) -> None:
    field = ModalPlate().prepare(table(), SOURCES, HALF)
    if is_expected:
        assert isinstance(field, ExpectantField)
        field.expect("top")
    found = field.attenuation("top", POINTS)
    assert found.shape == (4, 2, 1)
    for k, source in enumerate(SOURCES):
        f = source.frequency_tactile_hz
        expected = rms_of_single(k, "top", f * 2**-0.25, f * 2**0.25, 150)
        assert 20 * np.log10(found[:, k, 0] / expected) == pytest.approx(0.0, abs=0.15)


def test_gain_of_a_source_does_not_depend_on_other_sources() -> None:
    both = ModalPlate().prepare(table(), SOURCES, HALF).attenuation("top", POINTS)
    turned = ModalPlate().prepare(table(), SOURCES[::-1], HALF).attenuation("top", POINTS)
    np.testing.assert_allclose(both, turned[:, ::-1], rtol=1e-9)
    # A source with another dominant frequency adds its frequencies to the solved ones.
    more = [*SOURCES, Excitation("fan", 118.0, 118.0, 1.0)]
    network = table()
    network = replace(network, contacts=[*network.contacts, Contact("fan", "elsewhere", (5.0, 5.0, 0.0))])
    three = ModalPlate().prepare(network, more, HALF).attenuation("top", POINTS)
    np.testing.assert_allclose(three[:, :2], both, rtol=1e-9)


def test_source_has_unit_gain_and_carrier_shares_sum_up() -> None:
    field = ModalPlate().prepare(table(), SOURCES, HALF)
    np.testing.assert_array_equal(field.attenuation("pump", POINTS)[:, 1], 1.0)
    assert isinstance(field, CarryingField)
    carriers = field.carriers("top", "pump", 0)
    assert {one.by for one in carriers} <= {"tray", "phone"}
    assert sum(one.share for one in carriers) == pytest.approx(1.0)


def test_the_band_makes_levels_steady_where_moduli_are_not_known() -> None:
    """Levels over 30 % of Young's modulus, rms over materials and frequencies; more in `benchmarks/bands.py`."""

    def spread_db(bands: Bands, material: str, thickness_m: float, f: float) -> float:
        known, levels = materials.lookup(material), []
        for factor in np.linspace(0.7, 1.3, 7):
            modulus_pa = known.youngs_modulus_pa * float(factor)
            top = Plate(1.2, 0.7, thickness_m, replace(known, youngs_modulus_pa=modulus_pa))
            network = ContactNetwork({"top": top}, [Contact("phone", "top", (0.3, 0.25, 0.0))])
            field = ModalPlate().prepare(network, [Excitation("phone", f, f, 0.2)], bands)
            levels.append(20 * np.log10(field.attenuation("top", POINTS)[:, 0, 0]))
        return float(np.std(np.array(levels) - np.mean(levels, axis=0)))

    plates = ("oak", 0.018), ("steel", 0.002), ("glass", 0.006)
    cases = [(*plate, float(f)) for plate in plates for f in np.geomspace(80.0, 320.0, 5)]
    single, half = (np.sqrt(np.mean([spread_db(bands, *case) ** 2 for case in cases])) for bands in (EXACT, HALF))
    assert half <= 4.0
    assert single > 6.0


def test_overlapping_bands_share_frequencies() -> None:
    sources = [Excitation(f"s{n}", f, f) for n, f in enumerate((100.0, 100.0, 110.0, 400.0))]
    sampling = Sampling.of(HALF, sources, 0.02)
    assert not sampling.is_shared
    assert not sampling.is_single
    assert sampling.bands[0].at == sampling.bands[1].at
    alone = [len(Sampling.of(HALF, [one], 0.02).frequencies_hz) for one in sources]
    assert len(sampling.frequencies_hz) < sum(alone) - alone[0]
    for source, (at, weights) in zip(sources, sampling.bands, strict=True):
        low, high = HALF.around_hz(source.frequency_tactile_hz)
        f = sampling.frequencies_hz[at]
        assert weights.sum() == pytest.approx(1.0)
        # The weighted centre equals the centre of the band within part of a step.
        assert weights @ f == pytest.approx((low + high) / 2, rel=1e-3)
        assert low * 0.98 < f.min() < f.max() < high * 1.02
