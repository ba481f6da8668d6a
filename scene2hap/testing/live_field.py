"""The contract of `LiveModel`: a live field answers as a prepared one, also after the contacts have changed."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from scene2hap.contact.graph import ContactGraph
from scene2hap.haptics import Bands
from scene2hap.propagation.live import LiveField, LiveModel, PathCostField, PointField, TouchedPoint
from scene2hap.propagation.protocol import ContactNetwork, Excitation
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose
from scene2hap.scene.shapes import Box
from scene2hap.scene.snapshot import SceneSnapshot

Hands = Sequence[Sequence[TouchedPoint]]
Prepared = Callable[[ContactNetwork, Hands], NDArray[np.float64]]
"""Returns what a prepared field has at each hand (n_hands, n_sources, n_bands), in the order of the excitations."""


def check_live_field(
    model: LiveModel,
    network: ContactNetwork,
    sources: Sequence[Excitation],
    hands: Hands,
    bands: Bands,
    prepared: Prepared,
) -> None:
    """Check the live field of a scene at hands of which the first is on the first source, and the last touches nothing.

    Raises: AssertionError: names the broken promise.
    """
    name = f"the live field of {type(model).__name__}"
    boxes = [
        SceneObject(object_id, pose=Pose(middle_m), geometry=Box((0.1, 0.1, 0.1)))
        for object_id, middle_m in network.middles_m.items()
    ]
    graph = ContactGraph(SceneSnapshot.build(boxes, contacts=list(network.contacts)))
    field = model.live(graph, network.bodies, sources, bands)
    ids = [source.source_id for source in sources]
    assert sorted(field.source_ids) == sorted(ids), f"{name} has the sources {field.source_ids}; it must have {ids}"
    columns = [field.source_ids.index(source_id) for source_id in ids]

    def answers(given: Hands) -> NDArray[np.float64]:
        found = np.asarray(field.strongest(given))
        shape = (len(given), len(ids), bands.n_bands)
        assert found.shape == shape, f"{name} has shape {found.shape}; it must be {shape}: hands, sources and bands"
        assert found.dtype == np.float64, f"{name} is {found.dtype}; it must be float64"
        assert np.isfinite(found).all(), f"{name} holds a value that is not finite"
        assert (found >= 0).all(), f"{name} holds {found.min():.3g}; it must be at least 0"
        assert (found <= field.most).all(), f"{name} holds {found.max():.6g}, more than its `most`, {field.most:.6g}"
        return found[:, columns]

    first = answers(hands)
    whole = first.copy()
    assert np.allclose(whole[0, 0], 1.0, atol=1e-9), (
        f"{name}: a source is felt on itself by {whole[0, 0].max():.6g}; it must be 1"
    )
    assert not whole[-1].any(), f"{name}: a hand that touches nothing feels {whole[-1].max():.3g}"
    _require_alike(whole, prepared(network, hands), f"{name} differs from the prepared field")
    alone = np.concatenate([answers([hand]) for hand in hands])
    _require_alike(alone, whole, f"{name}: a hand's answer depends on the others")
    assert np.array_equal(first, whole), f"{name}: a query changes the array of the one before; return a new array"
    _hold_costs(field, hands, name)
    _hold_points(field, hands, name)
    graph.update({}, contacts=[])
    apart = ContactNetwork(network.bodies, (), network.poses, network.up_axis, network.middles_m)
    _require_alike(answers(hands), prepared(apart, hands), f"{name} does not follow contacts that end")
    graph.update({}, contacts=list(network.contacts))
    _require_alike(answers(hands), whole, f"{name} does not follow contacts that begin")


def _hold_costs(field: LiveField, hands: Hands, name: str) -> None:
    """A field with path costs, if it is one, must have the gains of its costs, also up to a limit."""
    if not isinstance(field, PathCostField):
        return
    costs = field.path_costs(hands)
    gains = field.strongest(hands)
    _require_alike(field.at(costs), gains, f"{name}: strongest(hands) is not at(path_costs(hands))")
    every = list(range(len(field.source_ids)))
    for column in every:
        of_one = field.at([[row[column]] for row in costs], [column])
        _require_alike(of_one, gains[:, [column]], f"{name}: at(costs, columns) differs from at(costs)")
    finite = [cost for row in costs for cost in row if cost < np.inf]
    limit = max(finite, default=0.0)
    limited = field.path_costs(hands, [limit] * len(every), [every] * len(hands))
    _require_alike(field.at(limited), gains, f"{name}: costs up to a limit differ from those without one")


def _hold_points(field: LiveField, hands: Hands, name: str) -> None:
    """A field with gains of points, if it is one, has a gain of 1 at the point itself, and 0 where nothing touches."""
    if not isinstance(field, PointField):
        return
    object_id, point_m = hands[0][0]
    frequencies_hz = np.array([60.0, 250.0])
    found = np.asarray(field.from_point(object_id, point_m, hands, frequencies_hz))
    shape = (len(hands), len(frequencies_hz))
    assert found.shape == shape, f"from_point of {name} has shape {found.shape}; it must be {shape}: hands, frequencies"
    assert np.isfinite(found).all(), f"from_point of {name} holds a value that is not finite"
    assert (found >= 0).all(), f"from_point of {name} holds {found.min():.3g}; it must be at least 0"
    assert np.allclose(found[0], 1.0, atol=1e-9), (
        f"from_point of {name} has {found[0].max():.6g} at the point; it must be 1"
    )
    assert not found[-1].any(), f"from_point of {name} arrives at a hand that touches nothing"


def _require_alike(found: NDArray[np.float64], wanted: NDArray[np.float64], problem: str) -> None:
    off = np.abs(np.asarray(found) - wanted)
    assert np.allclose(found, wanted, rtol=1e-6, atol=1e-12), f"{problem}, by up to {off.max():.3g}"
