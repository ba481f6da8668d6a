"""Gains of each source at each contact of a scene at rest, for engines that propagate vibration themselves."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from scene2hap.bundle import HapticBundle
from scene2hap.contact.graph import ContactGraph
from scene2hap.haptics import Bands
from scene2hap.propagation.exponential_plate import ExponentialPlate
from scene2hap.propagation.plate import Plate
from scene2hap.propagation.protocol import ContactNetwork, PropagationModel
from scene2hap.session.present_scene.network import BoxCentres, PlatePoses, body_of, excitations_of

LEAST_GAIN = 1e-3
"""Least gain that is exported [-]: 60 dB below the source nothing is felt."""


class PathEntry(BaseModel):
    """The gain of a source at a contact through which it enters an object (scene at rest, first states)."""

    model_config: ClassVar[ConfigDict] = ConfigDict(frozen=True, extra="forbid")

    source: str
    object_id: str
    by: str  # the object on the other side of the contact
    point_m: tuple[float, float, float]
    gain: float
    # By the paper's law; None for other models, and for objects without a plate.
    decay_per_m: float | None = Field(description="gain(d) = gain * exp(-decay_per_m * d), d metres on the object")


def contact_paths(bundle: HapticBundle, model: PropagationModel | None = None) -> tuple[PathEntry, ...]:
    """Return the gain of each source, in its first state, on both sides of every contact, strongest first by source.

    Parameters: model : of propagation; the paper's law if None.
    """
    model = model or ExponentialPlate()
    scene = bundle.snapshot
    loops = [(key, next(iter(states.values()))) for key, states in bundle.loops.items() if states]
    objects = {item.id: item for item in scene.objects}
    bodies = {key: body_of(bundle.objects.get(key), item.surface) for key, item in objects.items()}
    known = {key: body for key, body in bodies.items() if body is not None}
    poses = {key: item.pose for key, item in objects.items()}
    contacts = ContactGraph(scene).contacts
    corners = PlatePoses(objects, known, poses)
    network = ContactNetwork(known, contacts, corners, scene.up_axis, BoxCentres(objects, poses))
    excitations = excitations_of(loops, known, bundle.objects)
    if not excitations:
        return ()
    field = model.prepare(network, excitations, Bands.dominant())
    law = model if isinstance(model, ExponentialPlate) else None
    hertz = {one.source_id: law.frequency_hz(one) for one in excitations} if law is not None else {}
    found = []
    for contact in contacts:
        for here, there in ((contact.a, contact.b), (contact.b, contact.a)):
            gains = field.attenuation(here, np.array([contact.point_m]))[0, :, 0]
            for source, gain in zip(field.source_ids, gains.tolist(), strict=True):
                if gain < LEAST_GAIN or source == here:
                    continue
                body = known.get(here)
                decay = float(body.wavenumber_rad_m(hertz[source])) if hertz and isinstance(body, Plate) else None
                point_m = contact.point_m
                found.append(
                    PathEntry(source=source, object_id=here, by=there, point_m=point_m, gain=gain, decay_per_m=decay)
                )
    return tuple(sorted(found, key=lambda path: (path.source, -path.gain)))
