"""Options of the exponential law beyond the paper: loss at contacts, floor, and warnings of thick plates."""

import math

import numpy as np
import pytest

from scene2hap import (
    Bands,
    Contact,
    ContactNetwork,
    Excitation,
    ExponentialPlate,
    FullPropagation,
    Plate,
    RigidBody,
    materials,
)
from scene2hap.errors import ConfigError, ModelDomainError, UnknownPlugin
from scene2hap.propagation import MODELS
from scene2hap.propagation.domain import ThinPlateWarning

OAK = materials.lookup("oak")
NETWORK = ContactNetwork(
    {"a": Plate(1, 1, 0.02, OAK), "b": Plate(1, 1, 0.02, OAK), "far": Plate(1, 1, 0.02, OAK)},
    [Contact("s", "a", (0, 0, 0)), Contact("a", "b", (0.3, 0, 0))],
)


def gain(model: ExponentialPlate, on: str, x: float, f: float = 250.0) -> float:
    field = model.prepare(NETWORK, [Excitation("s", f, f)], Bands.dominant())
    return float(field.attenuation(on, [[x, 0, 0]])[0, 0, 0])


def test_loss_of_contacts_is_stated_at_250_hz_and_grows_like_distance() -> None:
    lossy = ExponentialPlate(interface_loss_db=6.0)
    assert 20 * math.log10(gain(lossy, "a", 0.2) / gain(ExponentialPlate(), "a", 0.2)) == pytest.approx(-6.0)
    assert 20 * math.log10(gain(lossy, "b", 0.5) / gain(ExponentialPlate(), "b", 0.5)) == pytest.approx(-12.0)
    # Four times the frequency doubles the wavenumber, and so the loss in decibels.
    at_1000 = gain(lossy, "a", 0.2, 1000.0) / gain(ExponentialPlate(), "a", 0.2, 1000.0)
    assert 20 * math.log10(at_1000) == pytest.approx(-12.0)


@pytest.mark.parametrize("bands", [Bands.dominant(), Bands.third_octaves()])
def test_floor_holds_where_a_source_arrives_and_nowhere_else(bands: Bands) -> None:
    field = ExponentialPlate(floor_db=-20.0).prepare(NETWORK, [Excitation("s", 250.0, 250.0)], bands)
    bare = ExponentialPlate().prepare(NETWORK, [Excitation("s", 250.0, 250.0)], bands)
    points = [[0.01, 0, 0], [50.0, 0, 0]]
    np.testing.assert_array_equal(field.attenuation("a", points), np.maximum(bare.attenuation("a", points), 0.1))
    assert not field.attenuation("far", points).any()
    assert (field.attenuation("s", points) == 1.0).all()


def test_thick_plates_on_request() -> None:
    slab = ContactNetwork({"slab here": Plate(2, 2, 0.3, materials.lookup("concrete"))})
    source = [Excitation("s", 900.0, 900.0)]
    ExponentialPlate().prepare(slab, source, Bands.dominant())
    with pytest.warns(ThinPlateWarning, match="'slab here'"):
        ExponentialPlate(outside_domain="warn").prepare(slab, source, Bands.dominant())
    with pytest.raises(ModelDomainError, match="'slab here'"):
        ExponentialPlate(outside_domain="raise").prepare(slab, source, Bands.dominant())
    ExponentialPlate(outside_domain="raise").prepare(ContactNetwork({"s": RigidBody(1.0)}), source, Bands.dominant())


@pytest.mark.parametrize(
    "settings", [{"interface_loss_db": -1.0}, {"floor_db": 3.0}, {"floor_db": math.nan}, {"outside_domain": "shout"}]
)
def test_settings_out_of_bounds(settings: dict) -> None:
    with pytest.raises(ConfigError, match=next(iter(settings))):
        ExponentialPlate(**settings)


@pytest.mark.parametrize("model", [ExponentialPlate, FullPropagation])
@pytest.mark.parametrize("max_hops", [0, -3, 2.5, "2", 2**31])
def test_the_number_of_contacts_is_whole_and_at_least_one(model: type, max_hops: object) -> None:
    with pytest.raises(ConfigError, match="max_hops"):
        model(max_hops=max_hops)


@pytest.mark.parametrize(
    ("words", "kind"),
    [("none", "no_propagation"), ("full", "full_propagation"), ("attenuated", "exponential_plate"),
     ("Paper", "exponential_plate")],
)  # fmt: skip
def test_the_papers_names_of_its_conditions_suggest_the_kinds(words: str, kind: str) -> None:
    with pytest.raises(UnknownPlugin, match=f"Did you mean '{kind}'"):
        MODELS.build(words)
