"""Touches and moves over time, from a file: what a game would say, written down.

docs/touches.md describes the JSON and CSV forms. Times are seconds from the start, points are world metres at that
moment. A hand that has touched an object stays on it, and goes along when it moves, until it lifts or touches
something else.
"""

from __future__ import annotations

import csv
import json
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any, Literal, Protocol

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Discriminator, Field, Tag, ValidationError, model_validator

from scene2hap.devices.protocol import Block
from scene2hap.errors import SessionError
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import SceneSnapshot
from scene2hap.session import HapticFrame, HapticSession, Touch

FORMAT = "scene2hap/touches"
VERSION = 1

_Point = tuple[float, float, float]
_ACTIONS = ("touch", "lift", "move", "source")


class _Step(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    time_s: float = Field(ge=0.0)


class TouchStep(_Step):
    """A hand touches an object: at a point, or in the middle of its dominant surface.

    With `glide_s` a hand that is on the object already slides there in that time.
    """

    hand: str
    touch: str
    point_m: _Point | None = None
    glide_s: float = Field(0.0, ge=0.0)


class LiftStep(_Step):
    """A hand lets go."""

    hand: str
    lift: Literal[True]


class MoveStep(_Step):
    """An object goes to a place, or by an offset, in `glide_s` seconds; `rotation_xyzw` None keeps its rotation."""

    move: str
    to_m: _Point | None = None
    by_m: _Point | None = None
    rotation_xyzw: tuple[float, float, float, float] | None = None
    glide_s: float = Field(0.0, ge=0.0)

    @model_validator(mode="after")
    def _one_target(self) -> MoveStep:
        if (self.to_m is None) == (self.by_m is None):
            raise ValueError("give either to_m or by_m")
        return self


class SourceStep(_Step):
    """A source is switched on or off, to a state, or to a level."""

    source: str
    on: bool | None = None
    state: str | None = None
    gain_db: float | None = None


def _action(step: Any) -> str | None:
    keys = step if isinstance(step, dict) else getattr(type(step), "model_fields", {})
    return next((action for action in _ACTIONS if action in keys), None)


Step = Annotated[
    Annotated[TouchStep, Tag("touch")]
    | Annotated[LiftStep, Tag("lift")]
    | Annotated[MoveStep, Tag("move")]
    | Annotated[SourceStep, Tag("source")],
    Discriminator(_action),
]


class TouchTrack(BaseModel):
    """Steps in order of time, and how long it all lasts."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    format: Literal["scene2hap/touches"] = FORMAT
    version: Literal[1] = VERSION
    duration_s: float = Field(gt=0.0, allow_inf_nan=False)
    steps: tuple[Step, ...]

    @model_validator(mode="after")
    def _in_order(self) -> TouchTrack:
        for number, (earlier, later) in enumerate(zip(self.steps, self.steps[1:], strict=False), start=2):
            if later.time_s < earlier.time_s:
                raise ValueError(f"step {number} is at {later.time_s} s, before the one above it at {earlier.time_s} s")
        if self.steps and self.steps[-1].time_s > self.duration_s:
            raise ValueError(f"the last step is at {self.steps[-1].time_s} s, after the end at {self.duration_s} s")
        return self

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> TouchTrack:
        """Read a .json or .csv file.

        Raises: SessionError: it cannot be read, or a step is wrong; the message names step and field.
        """
        path = Path(path)
        try:
            text = path.read_text(encoding="utf-8-sig")
            document = _from_csv(text) if path.suffix.lower() == ".csv" else json.loads(text)
        except (OSError, UnicodeDecodeError, ValueError) as cause:
            raise SessionError(f"{path} cannot be read as touches: {cause}. See docs/touches.md.") from cause
        return cls.parse(document, str(path))

    @classmethod
    def parse(cls, document: Any, name: str = "touches") -> TouchTrack:
        """A track from plain values. Raises: SessionError."""
        try:
            return cls.model_validate(document)
        except ValidationError as cause:
            problem = cause.errors()[0]
            where = [f"step {part + 1}" if isinstance(part, int) else str(part) for part in problem["loc"]]
            place = ", ".join(part for part in where if part not in {"steps", *_ACTIONS}) or "whole file"
            reason = problem["msg"].removeprefix("Value error, ")
            raise SessionError(f"{name}: {place}: {reason}. See docs/touches.md.") from cause


def _from_csv(text: str) -> dict[str, Any]:
    """A CSV file: a row per step, empty cells left out; a row with time_s alone ends the track."""
    steps: list[dict[str, Any]] = []
    for row in csv.DictReader(text.splitlines()):
        cells = {key.strip(): value.strip() for key, value in row.items() if key and value and value.strip()}
        step: dict[str, Any] = {key: value for key, value in cells.items() if key not in _VECTOR_CELLS}
        for name, columns in _VECTORS.items():
            if any(column in cells for column in columns):
                step[name] = [cells.get(column, "0") for column in columns]
        steps.append(step)
    if not steps or set(steps[-1]) != {"time_s"}:
        raise ValueError("the last row must hold time_s alone, the end of the track")
    return {"duration_s": steps[-1]["time_s"], "steps": steps[:-1]}


_VECTORS = {
    "point_m": ("x_m", "y_m", "z_m"),
    "to_m": ("to_x_m", "to_y_m", "to_z_m"),
    "by_m": ("by_x_m", "by_y_m", "by_z_m"),
    "rotation_xyzw": ("qx", "qy", "qz", "qw"),
}
_VECTOR_CELLS = {column for columns in _VECTORS.values() for column in columns}


class PullSink(Protocol):
    """A sink without a clock of its own, such as WavSink and MemorySink."""

    def pull(self, n_frames: int) -> Block:
        """Take the next frames."""
        ...


@dataclass(frozen=True)
class PlayedFrame:
    """One update of a played track: when [s], where the hands were, and what they were given."""

    time_s: float
    touches: tuple[Touch, ...]
    frame: HapticFrame
    samples: Block


def play_track(
    session: HapticSession,
    track: TouchTrack,
    sink: PullSink,
    *,
    update_rate_hz: float = 100.0,
    on_frame: Callable[[PlayedFrame], None] | None = None,
) -> None:
    """Play a track on a started session, as a game of `update_rate_hz` frames per second would, into its sink.

    Raises: SessionError, UnknownObject: a step names a hand or an object that is not there.
    """
    stage = _Stage(session.snapshot)
    rate = session.config.sample_rate_hz
    origin = session.position
    n_frames = max(1, round(track.duration_s * update_rate_hz))
    waiting = list(track.steps)
    for i in range(n_frames):
        time_s = i / update_rate_hz
        while waiting and waiting[0].time_s <= time_s + 1e-9:
            stage.take(waiting.pop(0), session)
        begin = origin + round(time_s * rate)
        end = origin + round(min((i + 1) / update_rate_hz, track.duration_s) * rate)
        touches = stage.touches(time_s)
        frame = session.update(stage.moved(time_s), touches, at_sample=begin)
        samples = sink.pull(end - begin)
        if on_frame is not None:
            on_frame(PlayedFrame(time_s, touches, frame, samples))


@dataclass
class _Glide:
    """A straight way from one point to another."""

    start_s: float
    duration_s: float
    begin: NDArray[np.float64]
    end: NDArray[np.float64]

    def at(self, time_s: float) -> NDArray[np.float64]:
        if self.duration_s <= 0:
            return self.end
        done = min(max((time_s - self.start_s) / self.duration_s, 0.0), 1.0)
        return self.begin + done * (self.end - self.begin)

    def is_over(self, time_s: float) -> bool:
        return time_s >= self.start_s + self.duration_s


@dataclass
class _Stage:
    """Where objects and hands are, as the steps go by."""

    scene: SceneSnapshot
    poses: dict[str, Pose] = field(default_factory=dict)
    moves: dict[str, _Glide] = field(default_factory=dict)
    hands: dict[str, tuple[str, _Glide]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.poses = {item.id: item.pose for item in self.scene.objects}

    def take(self, step: Any, session: HapticSession) -> None:
        if isinstance(step, TouchStep):
            self._touch(step)
        elif isinstance(step, LiftStep):
            self.hands.pop(step.hand, None)
        elif isinstance(step, MoveStep):
            self._move(step)
        else:
            session.set_source(step.source, on=step.on, state=step.state, gain_db=step.gain_db)

    def moved(self, time_s: float) -> dict[str, Pose]:
        """Poses of the objects that are under way; called once per frame, before what is over is forgotten."""
        for object_id, glide in list(self.moves.items()):
            position = glide.at(time_s)
            self.poses[object_id] = Pose(_triple(position), self.poses[object_id].rotation_xyzw)
        under_way = {object_id: self.poses[object_id] for object_id in self.moves}
        self.moves = {object_id: glide for object_id, glide in self.moves.items() if not glide.is_over(time_s)}
        return under_way

    def touches(self, time_s: float) -> tuple[Touch, ...]:
        return tuple(
            Touch(hand, object_id, _triple(self._pose_at(object_id, time_s).to_world(glide.at(time_s))))
            for hand, (object_id, glide) in self.hands.items()
        )

    def _touch(self, step: TouchStep) -> None:
        item = self.scene.object(step.touch)
        pose = self._pose_at(item.id, step.time_s)
        if step.point_m is not None:
            target = pose.to_own(step.point_m)
        else:
            surface = item.surface
            target = surface.pose.to_world([surface.length_m / 2, surface.width_m / 2, surface.thickness_m / 2])
        begin = target
        if step.hand in self.hands and self.hands[step.hand][0] == item.id:
            begin = self.hands[step.hand][1].at(step.time_s)
        self.hands[step.hand] = (item.id, _Glide(step.time_s, step.glide_s, begin, target))

    def _move(self, step: MoveStep) -> None:
        item = self.scene.object(step.move)
        pose = self._pose_at(item.id, step.time_s)
        begin = np.asarray(pose.position_m)
        end = np.asarray(step.to_m) if step.to_m is not None else begin + np.asarray(step.by_m)
        self.poses[item.id] = Pose(pose.position_m, step.rotation_xyzw or pose.rotation_xyzw)
        self.moves[item.id] = _Glide(step.time_s, step.glide_s, begin, end)

    def _pose_at(self, object_id: str, time_s: float) -> Pose:
        pose = self.poses[object_id]
        glide = self.moves.get(object_id)
        return pose if glide is None else Pose(_triple(glide.at(time_s)), pose.rotation_xyzw)


def _triple(values: NDArray[np.float64] | Sequence[float]) -> tuple[float, float, float]:
    return (float(values[0]), float(values[1]), float(values[2]))
