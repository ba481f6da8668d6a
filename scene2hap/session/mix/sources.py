"""The vibrating objects of a session: their states, levels and switches, and the contacts that they need."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.bundle import HapticBundle
from scene2hap.bundle.override import warn_if_percent
from scene2hap.common import checks
from scene2hap.common.calls import clear_attributes
from scene2hap.errors import SessionError, UnknownObject
from scene2hap.haptics import ObjectHaptics, SourceState
from scene2hap.session.config import MAX_GAIN_DB
from scene2hap.session.unknown_names import RemovedIds, unknown_source


@dataclass
class Level:
    """A volume knob in decibels with a mute switch."""

    gain_db: float = 0.0
    is_muted: bool = False

    @classmethod
    def of(cls, bundle: HapticBundle, object_id: str) -> Level:
        """Return a new knob at the level that a bundle has for a source."""
        return cls(bundle.gain_db(object_id), bundle.is_muted(object_id))

    def set(self, gain_db: float | None, mute: bool | None) -> None:
        """Set the arguments that are not None. Raises: SessionError: the gain is out of bounds."""
        # Checked before anything is set: a call that fails changes nothing.
        is_muted = self.is_muted if mute is None else checks.flag("mute", mute, error=SessionError)
        if gain_db is not None:
            hint = "Use mute for silence."
            # No lower bound: a game turns the position of a fader into decibels, which may be any finite number.
            bounded = checks.number("gain_db", gain_db, "dB", at_most=MAX_GAIN_DB, error=SessionError, hint=hint)
            warn_if_percent(bounded)
            self.gain_db = bounded
        self.is_muted = is_muted

    @property
    def factor(self) -> float:
        """Factor of the signals [-]."""
        return 0.0 if self.is_muted else 10 ** (self.gain_db / 20)


@dataclass(frozen=True, eq=False)
class LoopRow:
    """One state of one source, and a row of the mix. Rows are equal only to themselves."""

    source_id: str
    state: str
    loop: HapticLoop


class SourceProgress(NamedTuple):
    """How far a source is in its start or stop and in its cycle, for a saved game; JSON makes a list of it.

    speed, amplitude : of the start or stop that is under way, re steady running, 0..1 [-]; None if none is.
    is_resting : whether the source is in the off-time of its cycle.
    turn_left_s : rest of the present on-time or off-time [s]; None if its state has no cycle.
    """

    speed: float | None = None
    amplitude: float | None = None
    is_resting: bool = False
    turn_left_s: float | None = None

    @classmethod
    def parse(cls, given: object) -> SourceProgress:
        """Check the values of a progress, or a list of them. Raises: SessionError."""
        if not isinstance(given, list | tuple) or len(given) != len(cls._fields):
            wanted = f"it must be {', '.join(cls._fields)}, as `session.source(id).progress` has them"
            raise SessionError(f"progress is {checks.represented(given)}; {wanted}.")
        speed, amplitude, is_resting, left_s = given
        if speed is not None or amplitude is not None:
            speed = checks.number("speed", speed, "", at_least=0.0, at_most=1.0, error=SessionError)
            amplitude = checks.number("amplitude", amplitude, "", at_least=0.0, at_most=1.0, error=SessionError)
        if left_s is not None:
            left_s = checks.number("turn_left_s", left_s, "s", at_least=0.0, error=SessionError)
        return cls(speed, amplitude, checks.flag("is_resting", is_resting, error=SessionError), left_s)


@clear_attributes
@dataclass(frozen=True)
class SourceInfo:
    """Present state of a source: its state, all of its states, whether it is switched on, the strongest frequency of
    its vibration in this state [Hz], its level [dB], and whether it is muted.

    is_running : whether it is switched on, not in the off-time of its own cycle, and had the contact that it needs at
    the last update. It is true from the beginning of a start, and false from that of a stop.
    progress : how far it is in its start or stop and in its cycle, for `set_source(progress=...)` of another session.
    """

    id: str
    state: str
    states: tuple[str, ...]
    is_on: bool
    frequency_hz: float
    gain_db: float
    is_muted: bool
    is_running: bool
    progress: SourceProgress


@dataclass
class Source:
    """A vibrating object; `needs` is the contact that each state needs, by id or in words.

    inferred : its inferred states, by name; is_resting : whether it is in the off-time of its own cycle (thermostat);
    has_contact : whether it has the contact that its state needs; is_new : before its first update; transition_row :
    the row that is played while it starts or stops. `Switching` sets the last four.
    """

    rows: Mapping[str, LoopRow]
    needs: Mapping[str, str | None]
    state: str
    is_on: bool = True
    level: Level = field(default_factory=Level)
    inferred: Mapping[str, SourceState] = field(default_factory=dict)
    is_resting: bool = False
    has_contact: bool = True
    is_new: bool = True
    transition_row: LoopRow | None = None

    @property
    def row(self) -> LoopRow:
        """The row that is played: that of its state, or of its start or stop."""
        return self.transition_row or self.rows[self.state]

    @property
    def is_running(self) -> bool:
        """Whether it is switched on, not in the off-time of its cycle, and has the contact that it needs."""
        return self.is_on and not self.is_resting and self.has_contact


class Sources:
    """The present sources, in the order in which they were added; each is on at first, in its first state."""

    def __init__(self) -> None:
        self._sources: dict[str, Source] = {}
        # Derived from the sources on demand, since many may come and go between two frames.
        self._ids: tuple[str, ...] | None = None
        self._active_rows: tuple[LoopRow, ...] | None = None
        self._removed = RemovedIds()
        self.user: Level = Level()

    def __contains__(self, object_id: object) -> bool:
        return object_id in self._sources

    def add(
        self,
        object_id: str,
        loops: Mapping[str, HapticLoop],
        haptics: ObjectHaptics | None,
        level: Level | None = None,
    ) -> None:
        """Add a source with a loop for each of its states, at least one."""
        rows = {state: LoopRow(object_id, state, loop) for state, loop in loops.items()}
        inferred = {state.name: state for state in haptics.states} if haptics is not None else {}
        needs = {name: state.needs_contact for name, state in inferred.items()}
        self._sources[object_id] = Source(rows, needs, next(iter(rows)), level=level or Level(), inferred=inferred)
        self._list()

    def remove(self, object_id: str) -> None:
        """Remove a source."""
        del self._sources[object_id]
        self._removed.add(object_id)
        self._list()

    def get(self, object_id: str) -> Source | None:
        """A source; None if the object does not vibrate."""
        return self._sources.get(object_id)

    def go_on(self, source_id: str, before: Source) -> None:
        """Restore switch, level and state of a source whose loops were exchanged. A start or stop that is under way
        ends with the earlier loop. A source in its first state takes the new first state."""
        source = self._sources[source_id]
        source.is_on, source.level = before.is_on, before.level
        source.has_contact, source.is_new = before.has_contact, before.is_new
        if before.state != next(iter(before.rows)) and before.state in source.rows:
            source.state = before.state
        if source.state == before.state:
            source.transition_row = before.transition_row
        self._list()

    def __getitem__(self, source_id: str) -> Source:
        """A source. Raises: UnknownObject."""
        if not isinstance(source_id, str) or source_id not in self._sources:
            raise UnknownObject(unknown_source(source_id, self.ids) + self._removed.hint(source_id))
        return self._sources[source_id]

    def info(self, source_id: str, progress: SourceProgress) -> SourceInfo:
        """A source as it is now. Raises: UnknownObject."""
        source = self[source_id]
        frequency_hz, level = source.rows[source.state].loop.frequency_tactile_hz, source.level
        return SourceInfo(
            source_id,
            source.state,
            tuple(source.rows),
            source.is_on,
            frequency_hz,
            level.gain_db,
            level.is_muted,
            source.is_running,
            progress,
        )

    def rows(self) -> list[LoopRow]:
        """The row of every state of every source."""
        sources = self._sources.values()
        transitions = [source.transition_row for source in sources if source.transition_row is not None]
        return [row for source in sources for row in source.rows.values()] + transitions

    def play_transition(self, source_id: str, row: LoopRow | None) -> None:
        """Play a row while a source starts or stops; None returns to the row of its state."""
        self._sources[source_id].transition_row = row
        self._active_rows = None

    def active_rows(self) -> tuple[LoopRow, ...]:
        """The played row of each source, in the order of `ids`; the same tuple until one changes."""
        if self._active_rows is None:
            self._active_rows = tuple([source.row for source in self._sources.values()])
        return self._active_rows

    def set(self, source_id: str, on: bool | None, state: str | None, gain_db: float | None, mute: bool | None) -> bool:
        """Set the arguments that are not None. Returns true if this changed the state of the source.

        Raises: UnknownObject; SessionError: it has no such state, or the gain is out of bounds.
        """
        source = self[source_id]
        if state is not None and not (isinstance(state, str) and state in source.rows):
            is_switch = isinstance(state, str) and state.lower() in ("on", "off")
            hint = "`on` switches it on and off." if is_switch else checks.did_you_mean(state, source.rows)
            has = ", ".join(map(repr, source.rows))
            raise SessionError(f"{source_id!r} has no state {checks.represented(state)}; it has {has}. {hint}".rstrip())
        is_on = source.is_on if on is None else checks.flag("on", on, error=SessionError)
        source.level.set(gain_db, mute)
        source.is_on = is_on
        if state is None or state == source.state:
            return False
        source.state, source.transition_row = state, None
        self._list()
        return True

    def _list(self) -> None:
        """Drop all values derived from the sources and their states."""
        self._ids = self._active_rows = None

    @property
    def ids(self) -> tuple[str, ...]:
        """The ids in the order in which the sources were added; the same tuple until one is added or removed."""
        if self._ids is None:
            self._ids = tuple(self._sources)
        return self._ids

    def factors(self) -> NDArray[np.float64]:
        """Present factor of each source's signal: 0 when muted, or neither running nor about to stop."""
        user = self.user.factor
        return np.array(
            [
                source.level.factor * user if source.is_running or source.transition_row is not None else 0.0
                for source in self._sources.values()
            ]
        )
