"""Reference `felt_near`: the level near a source is that of the paper's law for every model."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from scene2hap import (
    Bands,
    Contact,
    ContactNetwork,
    Excitation,
    ExponentialPlate,
    FullPropagation,
    HapticSession,
    InfinitePlate,
    ModalPlate,
    NoPropagation,
    Plate,
    Pose,
    PropagationModel,
    Touch,
    materials,
)
from scene2hap.propagation.bands.sampling import AROUND
from scene2hap.propagation.protocol import CarryingField, ExpectantField
from scene2hap.propagation.reference import FeltNear
from scenes import RATE, table_with_two_phones

OAK = materials.lookup("oak")
TURN = Pose((0.3, 0.2, 0.9), (0.0, 0.0, 0.5**0.5, 0.5**0.5))
PHONE, PUMP = Excitation("phone", 150.0, 150.0, 0.2), Excitation("pump", 80.0, 80.0, 1.2)
AT = {"phone": (0.4, 0.3), "pump": (1.0, 0.5)}


def network() -> ContactNetwork:
    """Two sources on a rotated and shifted table."""
    stands = [
        Contact("table", source, tuple(TURN.to_world([[x, y, 0.0]])[0].tolist())) for source, (x, y) in AT.items()
    ]
    return ContactNetwork({"table": Plate(1.4, 0.8, 0.02, OAK)}, stands, {"table": TURN})


def around(source: str) -> Any:
    """Points 0.1 m around a source, listed by hand."""
    x, y = AT[source]
    s = 0.1 * 0.5**0.5
    offsets = [(0.1, 0.0), (s, s), (0.0, 0.1), (-s, s), (-0.1, 0.0), (-s, -s), (0.0, -0.1), (s, -s)]
    return TURN.to_world([[x + dx, y + dy, 0.0] for dx, dy in offsets])


@pytest.mark.parametrize("model", [ModalPlate(), InfinitePlate(), ExponentialPlate(), FullPropagation()], ids=str)
@pytest.mark.parametrize("bands", [AROUND, Bands.dominant(), Bands.third_octaves(20, 500)], ids=["near", "own", "all"])
def test_source_near_its_place_has_the_gain_of_the_law(model: PropagationModel, bands: Bands) -> None:
    field, plain, law = (
        one.prepare(network(), [PHONE, PUMP], bands) for one in (FeltNear(model), model, ExponentialPlate())
    )
    for column, source in enumerate(AT):
        found, expected = (
            np.sqrt(np.mean(one.attenuation("table", around(source))[:, column] ** 2)) for one in (field, law)
        )
        assert found == pytest.approx(expected, rel=1e-9)
        # The model's distribution is unchanged: the ratio is equal in all bands.
        ratio = (
            field.attenuation("table", [[0.5, 1.0, 0.9]])[0, column]
            / (plain.attenuation("table", [[0.5, 1.0, 0.9]])[0, column])
        )
        assert ratio == pytest.approx(np.full(bands.n_bands, ratio[0]), rel=1e-6)
        np.testing.assert_array_equal(field.attenuation(source, [[0.0, 0.0, 0.0]])[0, column], 1.0)


def test_unconnected_sources_are_unchanged() -> None:
    lonely = ContactNetwork({"table": Plate(1.4, 0.8, 0.02, OAK)})
    for model, scene in ((ModalPlate(), lonely), (NoPropagation(), network())):
        field = FeltNear(model).prepare(scene, [PHONE], Bands.dominant())
        np.testing.assert_array_equal(field.attenuation("phone", [[0.0, 0.0, 0.0]]), 1.0)
        np.testing.assert_array_equal(field.attenuation("table", [[0.0, 0.0, 0.0]]), 0.0)
    assert FeltNear(ModalPlate()).prepare(ContactNetwork({}), [], Bands.dominant()).source_ids == ()


def test_wrapper_has_the_optional_methods_of_its_model() -> None:
    field = FeltNear(ModalPlate()).prepare(network(), [PHONE, PUMP], AROUND)
    assert isinstance(field, CarryingField)
    assert [one.by for one in field.carriers("table", "pump", 0)] == ["pump"]
    assert isinstance(field, ExpectantField)
    before = field.attenuation("table", around("phone"))
    field.expect("table")
    np.testing.assert_allclose(field.attenuation("table", around("phone")), before, rtol=2e-3)
    assert not isinstance(FeltNear(NoPropagation()).prepare(network(), [PHONE], AROUND), CarryingField)
    assert FeltNear(ModalPlate()).usual_bands == AROUND


def test_sessions_of_different_models_have_equal_gains_near_the_source() -> None:
    def gain_db(kind: str, reference: str) -> float:
        config = {"sample_rate_hz": RATE, "propagation": kind, "reference": reference, "prepare": "blocking"}
        session = HapticSession(*table_with_two_phones(), {**config, "gain_limit_db": None})
        frame = session.update(touches=[Touch("left", "table", (0.2, 0.72, 0.4))])  # 0.1 m from the phone
        return 20 * float(np.log10(frame.gains[0, session.source_ids.index("phone"), 0]))

    kinds = ("exponential_plate", "modal_plate", "infinite_plate")
    at_source, near = ([gain_db(kind, reference) for kind in kinds] for reference in ("source", "felt_near"))
    assert np.ptp(at_source) > 15.0
    assert np.ptp(near) < 3.0
    assert near[0] == at_source[0]
