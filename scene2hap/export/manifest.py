"""The manifest of an export: the data with which an engine places the files in its scene.

`manifest.json` in the folder, by the schema in docs/manifest.schema.json.
"""

from __future__ import annotations

from typing import Any, ClassVar, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from scene2hap.bundle import HapticBundle
from scene2hap.common.json_fields import VersionOne
from scene2hap.export.contact_gains import PathEntry, contact_paths
from scene2hap.export.report import ExportReport
from scene2hap.propagation.protocol import PropagationModel
from scene2hap.render.transition import TransitionCurve

FORMAT: Literal["scene2hap/export"] = "scene2hap/export"
VERSION: Literal[1] = 1
NAME = "manifest.json"

_POINTS = 33
"""Points of a start or stop that is not recorded: lines between them are within 0.002 of the curves [-]."""

Triple = tuple[float, float, float]


class _Part(BaseModel):
    """A part of the manifest: frozen, without unknown fields."""

    model_config: ClassVar[ConfigDict] = ConfigDict(frozen=True, extra="forbid")


class FileEntry(_Part):
    """Files of one channel in one format, relative to the folder."""

    kind: str
    channel: str = Field(description='"left", "right", or "" for one that any hand may feel')
    files: tuple[str, ...]


class TransitionEntry(_Part):
    """The course of a start or a stop, at equal steps of its time; linear between them."""

    amplitude: tuple[float, ...] = Field(description="of the vibration, relative to steady running [-]")
    speed: tuple[float, ...] = Field(description="at which the loop is played, relative to steady running [-]")


class StateEntry(_Part):
    """One state in which a source vibrates, with its loop."""

    name: str
    intensity: float
    needs_contact: str | None
    duration_s: float
    frequency_hz: float = Field(description="where it is felt [Hz]")
    level_db: float | None = Field(description="over the threshold of touch, on the actuator [dB]")
    start_up_s: float
    wind_down_s: float
    spins: bool = Field(default=False, description="its pitch rises and falls, like that of a motor")
    start_up: TransitionEntry | None = Field(default=None, description="its start over start_up_s; null: at once")
    wind_down: TransitionEntry | None = Field(default=None, description="its stop over wind_down_s; null: at once")
    on_s: float | None = Field(default=None, description="it runs so long, in turns with off_s [s]; null: always")
    off_s: float | None = Field(default=None, description="it rests so long [s]")
    credit: dict[str, str]
    files: tuple[FileEntry, ...]


class SourceEntry(_Part):
    """An object that vibrates. The first state is the initial one."""

    object_id: str
    gain_db: float = Field(description="a person's level for it, contained in neither files nor paths [dB]")
    muted: bool = Field(description="silent until a game unmutes it")
    states: tuple[StateEntry, ...]


class ObjectEntry(_Part):
    """An object of the scene: its pose in the world [m], and its inferred properties."""

    id: str
    name: str
    category: str
    material: str | None
    position_m: Triple
    rotation_xyzw: tuple[float, float, float, float]
    size_m: Triple
    mass_kg: float | None


class TourEntry(_Part):
    """The vibration of all hands over time, from a file of touches."""

    name: str
    duration_s: float
    files: tuple[FileEntry, ...]


class Manifest(_Part):
    """The content of manifest.json."""

    format: Literal["scene2hap/export"] = FORMAT
    version: VersionOne = VERSION
    scene: str
    scene_category: str
    up_axis: str
    actuator: str | None
    objects: tuple[ObjectEntry, ...]
    sources: tuple[SourceEntry, ...]
    paths: tuple[PathEntry, ...]
    tours: tuple[TourEntry, ...]
    credits: tuple[str, ...]


def manifest_of(
    bundle: HapticBundle,
    report: ExportReport,
    tracks: dict[str, tuple[str, str]],
    tours: dict[str, float],
    model: PropagationModel | None = None,
) -> Manifest:
    """Return the manifest of an export.

    Parameters: tracks : source and state by the name of their track; tours : length [s] by the name of the tour;
        model : of propagation, for the gains.
    """
    files: dict[str, list[FileEntry]] = {}
    for row in report.rows:
        files.setdefault(row.track, []).append(FileEntry(kind=row.kind, channel=row.channel, files=row.files))
    states: dict[str, list[StateEntry]] = {}
    for name, (source, state) in tracks.items():
        states.setdefault(source, []).append(_state(bundle, source, state, tuple(files.get(name, ()))))
    return Manifest(
        scene=bundle.snapshot.name,
        scene_category=bundle.scene_category,
        up_axis=bundle.snapshot.up_axis,
        actuator=bundle.actuator.name if bundle.actuator is not None else None,
        objects=tuple(_object(bundle, item) for item in bundle.snapshot.objects),
        sources=tuple(
            SourceEntry(
                object_id=source, gain_db=bundle.gain_db(source), muted=bundle.is_muted(source), states=tuple(found)
            )
            for source, found in states.items()
        ),
        paths=contact_paths(bundle, model),
        tours=tuple(TourEntry(name=name, duration_s=s, files=tuple(files.get(name, ()))) for name, s in tours.items()),
        credits=tuple(f"{one.title}, by {one.author}, {one.licence}" for one in bundle.credits),
    )


def _state(bundle: HapticBundle, source: str, name: str, files: tuple[FileEntry, ...]) -> StateEntry:
    loop = bundle.loops[source][name]
    inferred = next(one for one in bundle.objects[source].states if one.name == name)
    return StateEntry(
        name=name,
        intensity=inferred.intensity,
        needs_contact=inferred.needs_contact,
        duration_s=loop.tactile.duration_s,
        frequency_hz=loop.frequency_tactile_hz,
        level_db=loop.felt.level_db if loop.felt is not None else None,
        start_up_s=inferred.start_up_s,
        wind_down_s=inferred.wind_down_s,
        spins=inferred.spins,
        start_up=_transition(TransitionCurve(True, inferred.spins, loop.start_up), inferred.start_up_s),
        wind_down=_transition(TransitionCurve(False, inferred.spins, loop.wind_down), inferred.wind_down_s),
        on_s=inferred.on_s,
        off_s=inferred.off_s,
        credit=vars(loop.audible.credit),
        files=files,
    )


def _transition(course: TransitionCurve, lasts_s: float) -> TransitionEntry | None:
    """Return a start or a stop as a session plays it, None if it takes no time."""
    if lasts_s == 0.0:
        return None
    n = _POINTS if course.curve is None else len(course.curve.amplitude)
    shares = np.linspace(0.0, 1.0, n)
    amplitude, speed = (np.round(curve(shares), 5).tolist() for curve in (course.amplitude, course.speed))
    return TransitionEntry(amplitude=tuple(amplitude), speed=tuple(speed))


def _object(bundle: HapticBundle, item: Any) -> ObjectEntry:
    haptics = bundle.objects.get(item.id)
    return ObjectEntry(
        id=item.id,
        name=item.name,
        category=haptics.object_category if haptics is not None else "unknown",
        material=haptics.material.name if haptics is not None and haptics.material is not None else None,
        position_m=item.pose.position_m,
        rotation_xyzw=item.pose.rotation_xyzw,
        size_m=item.size_m,
        mass_kg=haptics.mass_kg if haptics is not None else None,
    )
