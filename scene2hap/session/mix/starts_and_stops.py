"""Starts and stops of sources, some of which switch themselves on and off in cycles, like a refrigerator.

All times are on `render`'s clock, which does not advance in a pause. A source that is switched off during its start
stops from its present amplitude, and the other way round. Starts and stops follow the curve of the recording, if any.
"""

from __future__ import annotations

import zlib

from scene2hap.contact_needs import meets
from scene2hap.render.transition import STEADY, STILL, Running, Transition, TransitionCurve
from scene2hap.session.mix.loop_mixers import Clock, LoopMixers
from scene2hap.session.mix.sources import LoopRow, Source, SourceProgress, Sources
from scene2hap.session.present_scene.scene_state import SceneState


class Switching:
    """Starts and stops the sources of a session: by hand, in cycles, and with the contacts that they need.

    A source with cycles begins within its on-time, at a point that depends on its id alone, so that two refrigerators
    do not start together. A new source, before its first update, is switched at once.
    """

    def __init__(
        self, sources: Sources, mixers: LoopMixers, clock: Clock, state: SceneState, sample_rate_hz: int
    ) -> None:
        self._sources, self._mixers, self._clock, self._state = sources, mixers, clock, state
        self._rate_hz = sample_rate_hz
        self._transitions: dict[str, Transition] = {}
        # Where a source's on-time or off-time ends [frames], and the source, since another may get the same id. Parts
        # of a frame are kept, since they add up. It ends at the nearest frame: 1.1 s are 52800.00000000001 frames.
        self._turns: dict[str, tuple[float, Source]] = {}
        # Starts and stops of a saved game, which go on once the contacts of the sources are known.
        self._resumed: dict[str, tuple[Running, Source]] = {}
        # Ids of the sources that the data above are of, and of those at the last update.
        self._known: tuple[str, ...] | None = None
        self._updated: tuple[str, ...] | None = None
        # Sources with a state that needs a contact, and the contacts for which they were last checked, None if they
        # must be checked again.
        self._needing: list[str] = []
        self._topology: int | None = None

    def set(
        self,
        source_id: str,
        on: bool | None,
        state: str | None,
        gain_db: float | None,
        mute: bool | None,
        progress: SourceProgress | None = None,
    ) -> bool:
        """Set the arguments that are not None. A person who switches a source on, or to another state, begins a new
        on-time, unless the source is new. Returns true if this changed its state. Raises: see `Sources.set`."""
        source, now = self._sources[source_id], self._clock.now
        was_running = source.is_running
        is_other_state = self._sources.set(source_id, on, state, gain_db, mute)
        if is_other_state:
            source.has_contact = self._has_contact(source_id, source)
            # A state that lacks its contact has not run, so it does not stop.
            was_running = was_running and source.has_contact
        # The turn of a state must not outlive it: another one may run all the time.
        if source.is_on and (on is not None or is_other_state):
            source.is_resting = False
            self._begin_turn(source_id, source, now, _first_share(source_id) if source.is_new else 0.0)
        if on is not None or is_other_state:
            self._resumed.pop(source_id, None)
        if progress is not None:
            self._resume(source_id, source, now, progress)
        self._topology = None  # other sources may need a contact with this one, switched on
        self._follow(source_id, source, was_running, now)
        return is_other_state

    def advance(self, now: int) -> bool:
        """Apply an update: end finished starts and stops, and switch sources whose contacts have changed, or whose
        on-time or off-time is over. Returns true if any changed."""
        is_other_contact = self.follow_contacts(now)
        resumed, self._resumed = self._resumed, {}
        for source_id, (running, source) in resumed.items():
            if self._sources.get(source_id) is source:
                self._begin_transition(source_id, source, now, running)
        over = [source_id for source_id, one in self._transitions.items() if now >= self._mixers.end_frame(one)]
        for source_id in over:
            del self._transitions[source_id]
            if source_id in self._sources:
                self._sources.play_transition(source_id, None)
        if over:
            self._mixers.change_rows(self._sources.rows(), now)
        due = [source_id for source_id, (end, _) in self._turns.items() if now >= round(end)]
        for source_id in due:
            source = self._sources[source_id]
            was_running = source.is_running
            self._begin_next_turn(source_id, source, now)
            self._follow(source_id, source, was_running, now)
        if self._updated is not self._known:
            self._updated = self._known
            for source_id in self._sources.ids:
                self._sources[source_id].is_new = False
        return is_other_contact or bool(resumed or over or due)

    def follow_contacts(self, now: int) -> bool:
        """Start and stop sources that got or lost the contact that they need. Returns true if there are any."""
        if self._known is not self._sources.ids:
            self._follow_sources(now)
        topology = self._state.graph.topology
        if self._topology == topology:
            return False
        self._topology = topology
        is_any = False
        for source_id in self._needing:
            source = self._sources[source_id]
            was_running = source.is_running
            source.has_contact = self._has_contact(source_id, source)
            is_any = is_any or source.is_running != was_running
            self._follow(source_id, source, was_running, now)
        return is_any

    def running(self, source_id: str) -> Running:
        """Speed and amplitude of a source that is on, or that still stops."""
        transition = self._transitions.get(source_id)
        return STEADY if transition is None else self._mixers.running(transition, self._clock.now)

    def progress(self, source_id: str) -> SourceProgress:
        """How far a source is in its start or stop and in its cycle. Raises: UnknownObject."""
        source, (end, turning) = self._sources[source_id], self._turns.get(source_id, (0, None))
        left_s = max(0, end - self._clock.now) / self._rate_hz if turning is source else None
        if source.transition_row is None:
            return SourceProgress(None, None, source.is_resting, left_s)
        speed, amplitude = self.running(source_id)
        return SourceProgress(min(1.0, speed), min(1.0, amplitude), source.is_resting, left_s)

    def go_on(self, source_id: str, before: Source, progress: SourceProgress) -> None:
        """Let a source whose loops were exchanged go on in its start or stop and in its cycle."""
        self._sources.go_on(source_id, before)
        source = self._sources[source_id]
        if not source.is_new:
            self._resume_turn(source_id, source, self._clock.now, progress)

    def _resume(self, source_id: str, source: Source, now: int, progress: SourceProgress) -> None:
        """Let a source go on where that of a saved game was."""
        self._resume_turn(source_id, source, now, progress)
        if progress.speed is not None and progress.amplitude is not None:
            self._resumed[source_id] = (Running(progress.speed, progress.amplitude), source)

    def _resume_turn(self, source_id: str, source: Source, now: int, progress: SourceProgress) -> None:
        """Let a source go on in its on-time or off-time."""
        source.is_resting = progress.is_resting
        self._begin_turn(source_id, source, now, 0.0)
        if source_id not in self._turns:
            source.is_resting = False  # the state has no cycle any more
        elif progress.turn_left_s is not None:
            end, _ = self._turns[source_id]
            self._turns[source_id] = (min(end, now + progress.turn_left_s * self._rate_hz), source)

    def _follow_sources(self, now: int) -> None:
        """Update the stored data after sources were added or removed."""
        self._known, self._topology = self._sources.ids, None
        self._needing = [x for x in self._known if any(self._sources[x].needs.values())]
        self._transitions = {
            x: one for x, one in self._transitions.items() if x in self._sources and self._sources[x].transition_row
        }
        before, self._turns = self._turns, {}
        for source_id in self._known:
            source = self._sources[source_id]
            if source_id in before and before[source_id][1] is source:
                self._turns[source_id] = before[source_id]
            else:
                self._begin_turn(source_id, source, now, _first_share(source_id))

    def _begin_turn(self, source_id: str, source: Source, now: int, share: float) -> None:
        """Begin an on-time or off-time, of which a share has already passed."""
        turns = self._turns_of(source)
        if turns is None:
            self._turns.pop(source_id, None)
        else:
            self._turns[source_id] = (now + (1 - share) * turns[source.is_resting], source)

    def _begin_next_turn(self, source_id: str, source: Source, now: int) -> None:
        """Begin the on-time or off-time that `now` is in.

        It begins at the end of the last one, not at this update. Otherwise each would be late by a part of a frame, and
        a pattern of a second would be late by half a minute after an hour.
        """
        turns = self._turns_of(source)
        if turns is None:
            del self._turns[source_id]
            return
        end, _ = self._turns[source_id]
        end += (now - end) // sum(turns) * sum(turns)  # a stall of the game may last many turns
        while now >= round(end):
            source.is_resting = not source.is_resting
            end += turns[source.is_resting]
        self._turns[source_id] = (end, source)

    def _turns_of(self, source: Source) -> tuple[float, float] | None:
        """Durations of the on-time and the off-time of the present state [frames], None for one without a cycle."""
        inferred = source.inferred.get(source.state)
        if inferred is None or inferred.on_s is None or inferred.off_s is None:
            return None
        return inferred.on_s * self._rate_hz, inferred.off_s * self._rate_hz

    def _has_contact(self, source_id: str, source: Source) -> bool:
        """Whether a source has the contact that its state needs, if any.

        A contact with a source that is switched off does not count: no pan sizzles on a cold stove.
        """
        needed = source.needs.get(source.state)
        return needed is None or any(
            meets(needed, other, self._state.category(other))
            for other in self._state.graph.beside.get(source_id, ())
            if other not in self._sources or self._sources[other].is_on
        )

    def _follow(self, source_id: str, source: Source, was_running: bool, now: int) -> None:
        """Begin a start or a stop if a source was switched."""
        if source.is_running != was_running and not source.is_new:
            self._begin_transition(source_id, source, now)

    def _begin_transition(self, source_id: str, source: Source, now: int, since: Running | None = None) -> None:
        """Begin a start or a stop at the present speed and amplitude, or at given ones."""
        goes_up = source.is_running
        before = self._transitions.pop(source_id, None)
        if source.transition_row is None or since is not None:
            before = None  # that of another state, which ended with it, or of a game that was replaced
        if since is None:
            at_rest = STILL if goes_up else STEADY
            since = at_rest if before is None else self._mixers.running(before, now)
        self._sources.play_transition(source_id, None)
        inferred = source.inferred.get(source.state)
        lasts_s = 0.0 if inferred is None else inferred.start_up_s if goes_up else inferred.wind_down_s
        is_there = since.amplitude >= 1.0 if goes_up else since.amplitude <= 0.0
        if inferred is not None and lasts_s > 0.0 and not is_there:
            steady = source.row
            row = LoopRow(source_id, source.state, steady.loop)
            course = TransitionCurve(
                goes_up, inferred.spins, steady.loop.start_up if goes_up else steady.loop.wind_down
            )
            transition = self._mixers.start_transition(row, steady, now, lasts_s, course, since, before)
            if transition is not None:
                self._transitions[source_id] = transition
                self._sources.play_transition(source_id, row)
        self._mixers.change_rows(self._sources.rows(), now)


def _first_share(source_id: str) -> float:
    """Return the share of its on-time that has passed when a source is added."""
    return zlib.crc32(source_id.encode()) / 2**32
