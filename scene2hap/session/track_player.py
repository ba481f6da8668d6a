"""Play a touch track on a session, as a game would: one update per frame, then the samples up to the next frame."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from scene2hap.common import checks
from scene2hap.common.calls import clear_call
from scene2hap.devices.protocol import Block
from scene2hap.errors import Scene2HapError, SessionError
from scene2hap.scene.geometry import vector
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import SceneSnapshot
from scene2hap.session import HapticFrame, HapticSession, Touch
from scene2hap.session.touch_track import LiftStep, MoveStep, SourceStep, Step, TouchStep, TouchTrack
from scene2hap.session.unknown_names import unknown_hand

MAX_UPDATE_RATE_HZ = 1000.0
"""Assumed: trackers and haptic loops run at no more than 1 kHz."""


class PullSink(Protocol):
    """A sink without a clock, such as WavSink and MemorySink."""

    def pull(self, n_frames: int) -> Block:
        """Take the next frames."""
        ...


@dataclass(frozen=True)
class PlayedFrame:
    """One update of a played track: its time [s], the touches, and the gains and samples of the hands."""

    time_s: float
    touches: tuple[Touch, ...]
    frame: HapticFrame
    samples: Block


@clear_call
def play_track(
    session: HapticSession,
    track: TouchTrack,
    sink: PullSink,
    *,
    update_rate_hz: float = 100.0,
    on_frame: Callable[[PlayedFrame], None] | None = None,
) -> None:
    """Play a track on a started session and into its sink, like a game with `update_rate_hz` frames per second.

    Parameters: on_frame : called with each frame after it was played.
    Raises: SessionError, UnknownObject: a step names an unknown hand, object or state (states are checked in their
    turn, all others before the first frame); SessionError: a rate outside of 1 to `MAX_UPDATE_RATE_HZ`.
    """
    if not isinstance(track, TouchTrack):
        raise SessionError(
            f"track is {checks.described(track)}; it must be a TouchTrack, as TouchTrack.load(path) reads."
        )
    update_rate_hz = checks.number(
        "update_rate_hz", update_rate_hz, "Hz", at_least=1.0, at_most=MAX_UPDATE_RATE_HZ, error=SessionError
    )
    state = _TrackState(session.snapshot)
    rate = session.config.sample_rate_hz
    origin = session.position
    # A last frame that is shorter than the others counts too, or the track would end before its time.
    n_frames = max(1, math.ceil(track.duration_s * update_rate_hz - 1e-9))
    for number, step in enumerate(track.steps, start=1):  # all of them first, since playing may take minutes
        with _naming_step(track, number):
            state.check(step, session)
    waiting = deque(enumerate(track.steps, start=1))
    for i in range(n_frames):
        time_s = i / update_rate_hz
        while waiting and waiting[0][1].time_s <= time_s + 1e-9:
            number, step = waiting.popleft()
            with _naming_step(track, number):
                state.take(step, session)
        begin = origin + round(time_s * rate)
        end = origin + round(min((i + 1) / update_rate_hz, track.duration_s) * rate)
        touches = state.touches(time_s)
        frame = session.update(state.moved(time_s), touches, at_sample=begin)
        samples = sink.pull(end - begin)
        if on_frame is not None:
            on_frame(PlayedFrame(time_s, touches, frame, samples))


@contextmanager
def _naming_step(track: TouchTrack, number: int) -> Iterator[None]:
    """Name file and step in an error, as `TouchTrack.parse` does."""
    try:
        yield
    except Scene2HapError as error:
        error.args = (f"{track.name}: step {number}: {error}",)
        raise


@dataclass
class _Motion:
    """A straight motion from one point to another."""

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
class _TrackState:
    """Poses of the objects and positions of the hands at the present step."""

    scene: SceneSnapshot
    poses: dict[str, Pose] = field(default_factory=dict)
    moves: dict[str, _Motion] = field(default_factory=dict)
    hands: dict[str, tuple[str, _Motion]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.poses = {item.id: item.pose for item in self.scene.objects}

    def check(self, step: Step, session: HapticSession) -> None:
        """Raise an error if the scene lacks the step's object, or the session its hand or its source."""
        if isinstance(step, TouchStep | LiftStep) and step.hand not in session.hands:
            raise SessionError(unknown_hand(step.hand, session.hands))
        if isinstance(step, TouchStep | MoveStep):
            self.scene.object(step.touch if isinstance(step, TouchStep) else step.move)
        elif isinstance(step, SourceStep):
            session.set_source(step.source)  # changes nothing

    def take(self, step: Step, session: HapticSession) -> None:
        if isinstance(step, TouchStep):
            self._touch(step)
        elif isinstance(step, LiftStep):
            self.hands.pop(step.hand, None)
        elif isinstance(step, MoveStep):
            self._move(step)
        else:
            session.set_source(step.source, on=step.on, state=step.state, gain_db=step.gain_db)

    def moved(self, time_s: float) -> dict[str, Pose]:
        """Return the poses of the moving objects, and drop finished motions. Call it once per frame."""
        for object_id, motion in list(self.moves.items()):
            position = motion.at(time_s)
            self.poses[object_id] = Pose(vector(position), self.poses[object_id].rotation_xyzw)
        under_way = {object_id: self.poses[object_id] for object_id in self.moves}
        self.moves = {object_id: motion for object_id, motion in self.moves.items() if not motion.is_over(time_s)}
        return under_way

    def touches(self, time_s: float) -> tuple[Touch, ...]:
        return tuple(
            Touch(hand, object_id, vector(self._pose_at(object_id, time_s).to_world(motion.at(time_s))))
            for hand, (object_id, motion) in self.hands.items()
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
        self.hands[step.hand] = (item.id, _Motion(step.time_s, step.glide_s, begin, target))

    def _move(self, step: MoveStep) -> None:
        item = self.scene.object(step.move)
        pose = self._pose_at(item.id, step.time_s)
        begin = np.asarray(pose.position_m)
        end = np.asarray(step.to_m) if step.to_m is not None else begin + np.asarray(step.by_m)
        self.poses[item.id] = Pose(pose.position_m, step.rotation_xyzw or pose.rotation_xyzw)
        self.moves[item.id] = _Motion(step.time_s, step.glide_s, begin, end)

    def _pose_at(self, object_id: str, time_s: float) -> Pose:
        pose = self.poses[object_id]
        motion = self.moves.get(object_id)
        return pose if motion is None else Pose(vector(motion.at(time_s)), pose.rotation_xyzw)
