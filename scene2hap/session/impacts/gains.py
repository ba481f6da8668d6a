"""Gains of an impact on an object at each hand, by the model in use.

A live field gives the gains at once (`PointField`), and so does a scene that was prepared around the touched objects
(`preparation`). Other models prepare a field for the impact, with a small source on the struck point. The gains
are relative to that point, so that the mass of the source and the stiffness of its contact have no effect.
"""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Callable, MutableMapping, Sequence
from dataclasses import replace
from typing import cast

import numpy as np

from scene2hap.common.arrays import Floats
from scene2hap.propagation.bands.sampling import AROUND
from scene2hap.propagation.live import PointField, TouchedPoint
from scene2hap.propagation.protocol import (
    ContactNetwork,
    CoupledModel,
    Excitation,
    PropagationField,
    PropagationModel,
    follows_poses,
)
from scene2hap.scene.objects import Contact
from scene2hap.session.present_scene.scene_state import SceneState

Point = tuple[float, float, float]

_STRIKER = "\0striker"
_STRIKER_KG = 1e-6
"""So light that resonances of a thin plate do not change the force: a gram gives 2 dB of error on a waste bin."""


def struck_live(
    field: PointField,
    object_id: str,
    striker_id: str | None,
    point_m: Point,
    hands: Sequence[Sequence[TouchedPoint]],
    frequencies_hz: Floats,
) -> Floats:
    """Gains (n_hands, n_frequencies) [-], >= 0, from a live field, also at hands on the striking object.

    The struck point is on both objects. By the contacts alone, which are at the corners of where two long objects meet,
    the way to a hand on the striking object would lead to a corner and back.
    """
    gains = np.array(field.from_point(object_id, point_m, hands, frequencies_hz))
    on_striker = [[touch for touch in hand if touch[0] == striker_id] for hand in hands]
    if striker_id is not None and any(on_striker):
        np.fmax(gains, field.from_point(striker_id, point_m, on_striker, frequencies_hz), out=gains)
    return at_least_itself(gains, object_id, hands)


def struck_later(
    model: PropagationModel,
    state: SceneState,
    object_id: str,
    point_m: Point,
    hands: Sequence[Sequence[TouchedPoint]],
    frequencies_hz: Floats,
) -> Callable[[], Floats]:
    """Return a function that prepares the model and returns these gains. It may be called later, in any thread."""
    # An object that touches no other of known material is in no network, so the whole scene is prepared for it.
    is_whole = follows_poses(model) or not state.touches_a_body(object_id)
    put_together = state.network(None if is_whole else [object_id])
    touched = {touched_id for hand in hands for touched_id, _ in hand}

    def prepared() -> Floats:
        network = put_together(touched).network
        strikers = [f"{_STRIKER}{i}" for i in range(len(frequencies_hz))]
        contacts = [Contact(striker, object_id, point_m) for striker in strikers]
        excitations = [
            Excitation(striker, f, f, _STRIKER_KG) for striker, f in zip(strikers, frequencies_hz.tolist(), strict=True)
        ]
        # A chain computes no other middle; a cast, since it is typed for writing.
        others_m = cast("MutableMapping[str, Point]", network.middles_m)
        middles_m = ChainMap(dict.fromkeys(strikers, point_m), others_m)
        with_them = replace(network, contacts=(*network.contacts, *contacts), middles_m=middles_m)
        field = _field_of(model, with_them, excitations)
        itself = field.attenuation(object_id, np.array([point_m]))[0, :, 0]
        gains = np.zeros((len(hands), len(frequencies_hz)))
        for row, hand in zip(gains, hands, strict=True):
            for touched_id, touched_m in hand:
                np.fmax(row, field.attenuation(touched_id, np.array([touched_m]))[0, :, 0], out=row)
        # Without vibration on the struck point itself, no gain is relative to it.
        gains = np.divide(gains, itself, out=np.zeros_like(gains), where=itself > 0)
        return at_least_itself(gains, object_id, hands)

    return prepared


def _field_of(model: PropagationModel, network: ContactNetwork, excitations: Sequence[Excitation]) -> PropagationField:
    """Prepare the field of light sources on the struck point.

    The bodies are those of the scene that is prepared in advance (`preparation`). `AutoFidelity.prepare` would choose
    them by the level that the sources bring into a plate: such light ones bring none, so no plate would have edges.
    """
    if isinstance(model, CoupledModel):
        from scene2hap.propagation.coupled.substructuring import prepare_coupled  # by need: the physical models

        return prepare_coupled(model, network, excitations, AROUND, "ignore")
    return model.prepare(network, excitations, AROUND)


def at_least_itself(gains: Floats, object_id: str, hands: Sequence[Sequence[TouchedPoint]]) -> Floats:
    """Set gain 1 at hands on the struck object whose gains are all 0, since the impact itself is always felt."""
    for row, hand in zip(gains, hands, strict=True):
        if not row.any() and any(touched_id == object_id for touched_id, _ in hand):
            row[:] = 1.0
    return gains
