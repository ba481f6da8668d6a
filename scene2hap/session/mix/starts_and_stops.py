"""Starts and stops of sources, some of which switch themselves on and off in cycles, like a refrigerator.

All times are on `render`'s clock, which does not advance in a pause. A source that is switched off during its start
stops from its present amplitude, and the other way round. Starts and stops follow the curve of the recording, if any.
"""

from __future__ import annotations

import zlib
from dataclasses import dataclass

from scene2hap.render.passage import STEADY, STILL, Course, Passage, Running
from scene2hap.session.mix.playback import Playback
from scene2hap.session.mix.sources import LoopRow, Source, Sources


@dataclass(frozen=True, eq=False)
class _Passing:
    passage: Passage
    end_frame: int


class Switching:
    """Starts and stops the sources of a session.

    A source with cycles begins within its on-time, at a point that depends on its id alone, so that two refrigerators
    do not start together.
    """

    def __init__(self, sources: Sources, playback: Playback, sample_rate_hz: int) -> None:
        self._sources, self._playback, self._rate_hz = sources, playback, sample_rate_hz
        self._passing: dict[str, _Passing] = {}
        # The frame at which a source's on-time or off-time ends, and the source, since another may get the same id.
        self._turns: dict[str, tuple[int, Source]] = {}
        self._known: tuple[str, ...] | None = None

    def switched(self, source_id: str, was_running: bool, now: int, *, by_hand: bool, at_once: bool) -> None:
        """Start or stop a source if it was switched. A person who switches it on, or to another state, begins a new
        on-time. `at_once` leaves out the start or stop itself."""
        source = self._sources[source_id]
        if by_hand and source.is_on and source.is_resting:
            source.is_resting = False
        if by_hand and source.is_on:
            self._begin_turn(source_id, source, now, 0.0)
        if source.is_running != was_running:
            self._pass(source_id, source, now, at_once=at_once)

    def advance(self, now: int) -> bool:
        """End finished starts and stops, and switch sources whose on-time or off-time is over. True if any changed."""
        if self._known is not self._sources.ids:
            self._look_around(now)
        over = [source_id for source_id, one in self._passing.items() if now >= one.end_frame]
        for source_id in over:
            del self._passing[source_id]
            if source_id in self._sources:
                self._sources.let_pass(source_id, None)
        if over:
            self._playback.change_rows(self._sources.rows(), now)
        due = [source_id for source_id, (end, _) in self._turns.items() if now >= end]
        for source_id in due:
            source = self._sources[source_id]
            was_running = source.is_running
            source.is_resting = not source.is_resting
            self._begin_turn(source_id, source, now, 0.0)
            self.switched(source_id, was_running, now, by_hand=False, at_once=False)
        return bool(over or due)

    def running(self, source_id: str, now: int) -> Running:
        """Speed and amplitude of a source that is on, or that still stops."""
        passing = self._passing.get(source_id)
        return STEADY if passing is None else self._playback.running(passing.passage, now)

    def _look_around(self, now: int) -> None:
        """Update the stored data after sources were added or removed."""
        self._known = self._sources.ids
        self._passing = {x: one for x, one in self._passing.items() if x in self._sources and self._sources[x].passing}
        before, self._turns = self._turns, {}
        for source_id in self._known:
            source = self._sources[source_id]
            if source_id in before and before[source_id][1] is source:
                self._turns[source_id] = before[source_id]
            else:
                self._begin_turn(source_id, source, now, zlib.crc32(source_id.encode()) / 2**32)

    def _begin_turn(self, source_id: str, source: Source, now: int, share: float) -> None:
        """Begin an on-time or off-time, of which a share has already passed."""
        inferred = source.inferred.get(source.state)
        lasts_s = None if inferred is None else inferred.off_s if source.is_resting else inferred.on_s
        if lasts_s is None:
            self._turns.pop(source_id, None)
        else:
            self._turns[source_id] = (now + round((1 - share) * lasts_s * self._rate_hz), source)

    def _pass(self, source_id: str, source: Source, now: int, *, at_once: bool) -> None:
        """Begin a start or a stop."""
        inferred, goes_up = source.inferred.get(source.state), source.is_running
        before = self._passing.pop(source_id, None)
        at_rest = STILL if goes_up else STEADY
        since = at_rest if before is None else self._playback.running(before.passage, now)
        self._sources.let_pass(source_id, None)
        lasts_s = 0.0 if inferred is None or at_once else inferred.start_up_s if goes_up else inferred.wind_down_s
        is_there = since.amplitude >= 1.0 if goes_up else since.amplitude <= 0.0
        if inferred is not None and lasts_s > 0.0 and not is_there:
            steady = source.row
            row = LoopRow(source_id, source.state, steady.loop)
            course = Course(goes_up, inferred.spins, steady.loop.start_up if goes_up else steady.loop.wind_down)
            after = None if before is None else before.passage
            passage = self._playback.pass_over(row, steady, now, lasts_s, course, since, after)
            if passage is not None:
                self._passing[source_id] = _Passing(passage, self._playback.end_frame(passage))
                self._sources.let_pass(source_id, row)
        self._playback.change_rows(self._sources.rows(), now)
