"""The contract of `PropagationModel`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from scene2hap.errors import Scene2HapError, failure_of
from scene2hap.haptics import Bands
from scene2hap.materials import lookup
from scene2hap.plugins import lacking
from scene2hap.propagation import MODELS
from scene2hap.propagation.live import LiveModel, live_model
from scene2hap.propagation.plate import Plate, RigidBody
from scene2hap.propagation.protocol import (
    ContactNetwork,
    Excitation,
    PropagationField,
    PropagationModel,
    checked_field,
    follows_poses,
)
from scene2hap.scene.objects import Contact
from scene2hap.scene.pose import Pose
from scene2hap.testing.live_field import Hands, check_live_field

_TURNED = (-0.5, -0.5, -0.5, 0.5)  # turns a plate's normal to y, which is up
_MIDDLES_M = {
    "table": (0.6, 0.36, 0.35),
    "shelf": (4.4, 1.2, 0.15),
    "phone": (0.23, 0.724, 0.27),
    "fan": (2.0, 0.9, 1.0),
    "cup": (3.0, 0.9, 1.0),
}
_NETWORK = ContactNetwork(
    {
        "table": Plate(1.2, 0.7, 0.03, lookup("oak")),
        "shelf": Plate(0.8, 0.3, 0.018, lookup("plywood")),
        "phone": RigidBody(0.2, (0.15, 0.07, 0.008)),
    },
    [Contact("phone", "table", (x, 0.72, z)) for x in (0.2, 0.26) for z in (0.2, 0.34)],
    {"table": Pose((0.0, 0.705, 0.0), _TURNED), "shelf": Pose((4.0, 1.2, 0.0), _TURNED)},
    middles_m=_MIDDLES_M,
)
_EMPTY = ContactNetwork({}, middles_m=_MIDDLES_M)
_WITH_ENDS_SWAPPED = replace(_NETWORK, contacts=[replace(one, a=one.b, b=one.a) for one in _NETWORK.contacts])
_PHONE, _FAN = Excitation("phone", 180.0, 180.0, 0.2), Excitation("fan", 47.0, 94.0, 1.5)
_ON_TABLE = [(0.3, 0.72, 0.3), (0.9, 0.72, 0.5), (0.0, 0.72, 0.0)]
_BANDS = (Bands.dominant(), Bands((40.0, 80.0, 160.0, 320.0)))

_PROMISES = {
    "fan": "source 'fan' has no body; a source may have none and touch nothing. Places are in network.middles_m",
    "phone": "source 'phone' may have no pose, since it is no plate, and no body. Places are in network.middles_m",
    "cup": "object 'cup' is in no network; a field must answer there too, with 0 if nothing arrives",
    "shelf": "object 'shelf' has no contacts; a field must answer there too, with 0 if nothing arrives",
}


def check_propagation_model(model: PropagationModel) -> None:
    """Check a model against its protocol: a phone on a table, a fan without contacts, a shelf out of reach.

    Networks without sources, without bodies, and queries without points are checked too. Where no contacts lead, a gain
    must be 0, unless the model declares `follows_poses`. A live field must answer as a prepared one.
    Raises: AssertionError: names the broken promise.
    """
    problem = lacking(model, MODELS.members)
    assert not problem, problem
    for bands in _BANDS:
        _hold_answers(model, bands)
        if live_model(model) is not None:
            _hold_live(model, bands)
        for network, sources in ((_NETWORK, ()), (_EMPTY, (_FAN,)), (_EMPTY, ())):
            _answers(model, _prepared(model, network, sources, bands), "table", _ON_TABLE, len(sources), bands)


def _hold_answers(model: PropagationModel, bands: Bands) -> None:
    name, sources = type(model).__name__, (_FAN, _PHONE)
    field = checked_field(model, _prepared(model, _NETWORK, sources, bands), sources)
    order = {source_id: column for column, source_id in enumerate(field.source_ids)}

    def answers(object_id: str, points: Sequence[tuple[float, float, float]]) -> NDArray[np.float64]:
        return _answers(model, field, object_id, points, len(sources), bands)

    first = answers("table", _ON_TABLE)
    table = first.copy()
    own = answers("phone", _ON_TABLE)[:, order["phone"]]
    worst = own.flat[np.abs(own - 1.0).argmax()]
    assert abs(worst - 1.0) <= 1e-9, f"{name}: a source is felt on itself by {worst:.12g}; it must be 1"
    else_declare = "it must be 0, or the class declare follows_poses = True, if vibration needs no contacts"
    needs_contacts = not follows_poses(model)
    for object_id in ("shelf", "cup"):
        far = answers(object_id, _ON_TABLE)
        is_kept = not (needs_contacts and far.any())
        assert is_kept, f"{name}: {far.max():.3g} arrives on {object_id!r}, which nothing reaches; {else_declare}"
    assert np.array_equal(first, table), f"{name}: a query changes the array of the one before; return a new array"
    lone = table[:, order["fan"]]
    is_kept = not (needs_contacts and lone.any())
    assert is_kept, f"{name}: {lone.max():.3g} of a source that touches nothing arrives; {else_declare}"
    assert answers("table", []).size == 0, f"{name} answers for no point"
    one_by_one = np.concatenate([answers("table", [point]) for point in _ON_TABLE])
    assert np.allclose(one_by_one, table, rtol=1e-6, atol=1e-12), f"{name}: a point's answer depends on the others"
    again = _prepared(model, _NETWORK, sources, bands)
    same = np.array_equal(_answers(model, again, "table", _ON_TABLE, len(sources), bands), table)
    assert same, f"{name}: the same scene, prepared again, answers otherwise"
    turned = _prepared(model, _WITH_ENDS_SWAPPED, sources, bands)
    same = np.allclose(_answers(model, turned, "table", _ON_TABLE, len(sources), bands), table, rtol=1e-6, atol=1e-12)
    assert same, f"{name}: with a and b of each contact swapped, it answers otherwise; a contact has no direction"
    _prepared(model, _EMPTY, sources[::-1], bands)
    same = np.array_equal(answers("table", _ON_TABLE), table)
    assert same, f"{name}: preparing another scene changes a field; it must hold all that it needs of its own scene"
    with ThreadPoolExecutor(2) as threads:
        for found in threads.map(lambda _: answers("table", _ON_TABLE), range(4)):
            assert np.allclose(found, table, rtol=1e-6, atol=1e-12), f"{name}: two threads at once get other answers"


def _hold_live(model: PropagationModel, bands: Bands) -> None:
    assert isinstance(model, LiveModel)
    sources = (_PHONE, _FAN)
    hands = [[("phone", _ON_TABLE[0])], [("table", point) for point in _ON_TABLE], [("shelf", _ON_TABLE[0])], []]

    def prepared(network: ContactNetwork, hands: Hands) -> NDArray[np.float64]:
        field = _prepared(model, network, sources, bands)
        order = [field.source_ids.index(source.source_id) for source in sources]
        found = np.zeros((len(hands), len(sources), bands.n_bands))
        for hand, touched in zip(found, hands, strict=True):
            for object_id, point in touched:
                np.maximum(hand, _answers(model, field, object_id, [point], len(sources), bands)[0, order], out=hand)
        return found

    with _must_not_raise(f"the live field of {type(model).__name__}"):
        check_live_field(model, _NETWORK, sources, hands, bands, prepared)


def _prepared(
    model: PropagationModel, network: ContactNetwork, sources: Sequence[Excitation], bands: Bands
) -> PropagationField:
    with _must_not_raise(f"{type(model).__name__}.prepare"):
        return model.prepare(network, sources, bands)


@contextmanager
def _must_not_raise(called: str) -> Iterator[None]:
    """Turn an error of a guest into the promise that it breaks. Our errors pass: a model may refuse a scene."""
    try:
        yield
    except (Scene2HapError, AssertionError):
        raise
    except Exception as problem:
        key = problem.args[0] if isinstance(problem, KeyError) and problem.args else ""
        raise AssertionError(f"{called} raised {failure_of(problem)}; {_PROMISES.get(key, 'it must not')}") from problem


def _answers(
    model: PropagationModel,
    field: PropagationField,
    object_id: str,
    points: Sequence[tuple[float, float, float]],
    n_sources: int,
    bands: Bands,
) -> NDArray[np.float64]:
    by, given = f"attenuation of {type(model).__name__}'s field", np.array(points, dtype=np.float64).reshape(-1, 3)
    kept = given.copy()
    with _must_not_raise(f"attenuation of {type(model).__name__}'s field at {object_id!r}"):
        found = np.asarray(field.attenuation(object_id, given))
    shape = (len(points), n_sources, bands.n_bands)
    assert found.shape == shape, f"{by} has shape {found.shape}; it must be {shape}: points, sources and bands"
    assert found.dtype == np.float64, f"{by} is {found.dtype}; it must be float64"
    assert np.isfinite(found).all(), f"{by} holds a value that is not finite"
    assert (found >= 0).all(), f"{by} holds {found.min():.3g}; it must be at least 0"
    assert np.array_equal(given, kept), f"{by} changed the points that it was given"
    return found
