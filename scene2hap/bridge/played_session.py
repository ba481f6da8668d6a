"""A session that frames of a client drive."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scene2hap.bridge.frame_layout import Layout, Layouts
from scene2hap.bridge.frames import IS_PREPARING, PAUSED, Frame, Gains
from scene2hap.bridge.session_warnings import Tell
from scene2hap.devices.protocol import ActuatorSink, has_clock
from scene2hap.devices.whole_frames import WholeFrames
from scene2hap.engines.changes import Changes
from scene2hap.errors import BridgeError
from scene2hap.scene.pose_table import PoseTable
from scene2hap.session import HapticFrame, HapticSession, Touch
from scene2hap.session.impacts.felt_impacts import Impact
from scene2hap.session.mix.sources import SourceInfo

LONGEST_FRAME_S = 1.0
"""Most time by which the session's clock advances between two frames, for example while a debugger stops the game."""


class PlayedSession:
    """A session, the layout of its frames, and its clock.

    The session's clock follows the times of the frames if there is no sink, or the sink has no clock. Equal frames then
    give equal gains.

    Parameters: sink : the session's sink, not yet started; tell : receives JSON messages for clients.
    """

    def __init__(
        self, session: HapticSession, moving: Sequence[str] | None, sink: ActuatorSink | None, tell: Tell
    ) -> None:
        self.session = session
        self._sink, self._tell = sink, tell
        self._layouts, self._changes = Layouts(), Changes(session)
        self._moving: tuple[str, ...] = ()
        self.use_layout([*session.poses] if moving is None else moving)
        self._frames = WholeFrames(session.config.sample_rate_hz)
        self._time_s: float | None = None
        self._intensities: NDArray[np.float32] = np.zeros(0, np.float32)
        self.sequence: int = 0
        self.n_received: int = 0
        self.n_skipped: int = 0
        self.n_outdated: int = 0
        self.is_paused: bool = False
        self._last_impact: Impact | None = None
        if sink is not None:
            session.start()

    @property
    def may_wait(self) -> bool:
        """True if processing a frame may wait for the preparation of a model."""
        return self.session.config.prepare == "blocking"

    @property
    def layout(self) -> Layout:
        """The present layout."""
        return self._layouts.now

    def use_layout(self, moving: Sequence[str] | None = None) -> None:
        """Set a new layout, since other objects move, or since objects were added or removed.

        Raises: UnknownObject, BridgeError: as `Layouts.change`.
        """
        objects = [*self.session.poses]
        if moving is None:  # keep the moving objects that still exist
            moving = [one for one in self._moving if one in self.session.object_ids]
        self._moving = self._layouts.change(moving, objects, self.session.hands, self.session.source_ids).moving

    def order(self) -> dict[str, Any]:
        """Return the fields of messages with the layout."""
        layout, session = self.layout, self.session
        return {
            "layout": layout.number,
            "objects": [*layout.objects],
            "n_moving": layout.n_moving,
            "hands": [*layout.hands],
            "sources": [_source(session.source(one)) for one in layout.sources],
            "n_bands": session.config.bands.n_bands,
            "sequence": self.sequence,
            "watchdog_s": session.config.watchdog_s,
        }

    def stats(self) -> dict[str, Any]:
        """Return counters of the session, of its frames, and of its sink (None without one)."""
        frames = {"received": self.n_received, "skipped": self.n_skipped, "outdated": self.n_outdated}
        sink = None if self._sink is None else {**asdict(self._sink.stats), **asdict(self.session.safety_stats)}
        return {**asdict(self.session.stats), "frames": frames, "sink": sink}

    def take(self, frame: Frame) -> Gains | None:
        """Process a frame. Returns its gains, None if it is outdated.

        Raises: BridgeError: its counts or indices do not fit its layout; and as `HapticSession.update`.
        """
        layout = self._layouts.of(frame.layout)
        self.n_received += 1
        if layout is None or frame.sequence <= self.sequence:
            self.n_outdated += 1
            return None
        touches = self._touches(frame, layout)
        try:
            moved = self._changes.of(self._poses(frame, layout)) if len(frame.poses) else {}
            found = self.session.update(moved, touches)
        except Exception:
            self._changes.forget()
            raise
        self.sequence = frame.sequence
        intensities = self._go_on(frame.time_s, touches)
        self._tell_impacts()
        return self._gains(found, frame.time_s, intensities)

    def silence(self) -> Gains:
        """Return gains of 0, for a session without a player."""
        shape = len(self.layout.hands), len(self.layout.sources), self.session.config.bands.n_bands
        return Gains(
            self.layout.number,
            self.sequence,
            self.n_skipped,
            self._time_s or 0.0,
            PAUSED,
            np.zeros(shape[0], np.float32),
            np.zeros(shape, np.float32),
        )

    def drop(self) -> None:
        """Count a frame that a newer one has overtaken."""
        self.n_received += 1
        self.n_outdated += 1

    def pause(self) -> None:
        """Fade out all vibration."""
        self.is_paused = True
        self.session.pause()

    def unpause(self) -> None:
        """Continue after a pause."""
        self.is_paused = False
        self.session.resume()

    def close(self) -> None:
        """End the session."""
        self.session.close()

    def _poses(self, frame: Frame, layout: Layout) -> PoseTable:
        if len(frame.poses) != layout.n_moving:
            raise BridgeError(
                f"a frame has {len(frame.poses)} poses; layout {layout.number} has {layout.n_moving} moving objects. "
                "Send a pose for each of them, or none at all."
            )
        return PoseTable(layout.moving, frame.poses[:, :3], frame.poses[:, 3:])

    def _touches(self, frame: Frame, layout: Layout) -> list[Touch]:
        touches = []
        for hand, thing, (x, y, z) in frame.touches.tolist():
            if hand >= len(layout.hands) or thing >= len(layout.objects):
                raise BridgeError(
                    f"a touch is of hand {hand} and object {thing}; layout {layout.number} has {len(layout.hands)} "
                    f"hands and {len(layout.objects)} objects, counted from 0."
                )
            if layout.objects[thing] in self.session.object_ids:  # it may have been removed before the frame arrived
                touches.append(Touch(layout.hands[hand], layout.objects[thing], (x, y, z)))
        return touches

    def _go_on(self, time_s: float, touches: Sequence[Touch]) -> NDArray[np.float32]:
        """Advance the session's clock. Returns the intensity at each hand until the next frame, (n_hands,)."""
        session, silent = self.session, np.zeros(len(self.session.hands), np.float32)
        before_s, self._time_s = self._time_s, time_s
        if self._sink is not None and has_clock(self._sink):
            return silent
        # A game's clock may restart, as at a new level. Sequences tell the order, so this frame begins a new clock.
        if before_s is None or time_s < before_s:
            lasts_s = session.config.control_period_s
        else:
            lasts_s = min(time_s - before_s, LONGEST_FRAME_S)
        n = self._frames.of(lasts_s)
        if self._sink is not None:
            self._sink.pull(n)  # type: ignore[attr-defined]  # no clock
            return silent
        if not n:  # two frames at one time of a coarse clock, or of a game that stands still
            if self.is_paused or len(self._intensities) != len(silent):
                return silent
            touching = {touch.hand for touch in touches}
            return np.where([hand in touching for hand in session.hands], self._intensities, silent)
        block = session.render(n)
        amplitudes: NDArray[np.float32] = np.sqrt(2.0 * (block * block).mean(axis=0))
        self._intensities = np.minimum(amplitudes, np.float32(1.0))
        return self._intensities

    def _gains(self, found: HapticFrame, time_s: float, intensities: NDArray[np.float32]) -> Gains:
        gains = found.gains
        if found.hands != self.layout.hands or found.sources != self.layout.sources:
            raise BridgeError("the session's hands or sources changed without a new layout.")
        flags = (PAUSED if self.is_paused else 0) | (0 if self.session.is_current else IS_PREPARING)
        return Gains(self.layout.number, self.sequence, self.n_skipped, time_s, flags, intensities, gains)

    def _tell_impacts(self) -> None:
        recent = self.session.impacts
        for impact in recent:
            if impact is self._last_impact:
                break
            self._tell(
                {
                    "type": "impact",
                    "object": impact.object_id,
                    "with_object": impact.with_object,
                    "point_m": [*impact.point_m],
                    "frequency_hz": impact.frequency_hz,
                    "felt": dict(impact.felt),
                }
            )
        if recent:
            self._last_impact = recent[0]


def _source(info: SourceInfo) -> dict[str, Any]:
    """Return the fields of a source, without those whose changes send no message, so that they would be old."""
    return {name: value for name, value in asdict(info).items() if name not in ("is_running", "progress")}
