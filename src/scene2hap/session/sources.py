"""The vibrating objects of a session: their state, their level, and whether they may be heard."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from scene2hap import checks
from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.bundle import HapticBundle
from scene2hap.contact.graph import ContactGraph
from scene2hap.errors import SessionError, UnknownObject
from scene2hap.session.config import MAX_GAIN_DB
from scene2hap.session.frame import unknown_source


@dataclass
class Level:
    """A volume knob in decibels with a mute switch."""

    factor_unmuted: float = 1.0
    is_muted: bool = False

    def set(self, gain_db: float | None, mute: bool | None) -> None:
        """Turn what is not None. Raises: SessionError: the gain is out of bounds."""
        if gain_db is not None:
            hint = "Use mute for silence."
            bounded = checks.number("gain_db", gain_db, "dB", at_most=MAX_GAIN_DB, error=SessionError, hint=hint)
            self.factor_unmuted = 10 ** (bounded / 20)
        if mute is not None:
            self.is_muted = mute

    @property
    def factor(self) -> float:
        """What signals are multiplied with [-]."""
        return 0.0 if self.is_muted else self.factor_unmuted


@dataclass
class _Source:
    state: str
    is_on: bool = True
    level: Level = field(default_factory=Level)


class Sources:
    """The sources of a bundle, in its order; all on at first, each in its first state."""

    def __init__(self, bundle: HapticBundle) -> None:
        self._bundle = bundle
        self._sources = {
            object_id: _Source(next(iter(states)), level=Level(10 ** (bundle.gain_db(object_id) / 20)))
            for object_id, states in bundle.loops.items()
        }
        self.ids = tuple(self._sources)
        self.user = Level()
        self._rows = [(object_id, state) for object_id, states in bundle.loops.items() for state in states]

    def loop(self, source_id: str) -> HapticLoop:
        """The loop of the state that the source is in."""
        return self._bundle.loops[source_id][self._sources[source_id].state]

    def loops(self) -> Mapping[str, HapticLoop]:
        """The current loop of each source."""
        return {source_id: self.loop(source_id) for source_id in self.ids}

    def all_loops(self) -> list[HapticLoop]:
        """The loop of every state of every source: the rows of the mix."""
        return [self._bundle.loops[source_id][state] for source_id, state in self._rows]

    def active_row(self, source_id: str) -> int:
        """The row of the state that a source is in. Raises: UnknownObject."""
        return self._rows.index((source_id, self._known(source_id).state))

    def active_rows(self) -> list[int]:
        """The row of each source, in their order."""
        return [self.active_row(source_id) for source_id in self.ids]

    def set_state(self, source_id: str, state: str) -> bool:
        """Put a source into a state; true if that is another one.

        Raises: UnknownObject; SessionError: it has no such state.
        """
        source = self._known(source_id)
        states = self._bundle.loops[source_id]
        if state not in states:
            raise SessionError(f"{source_id!r} has no state {state!r}; it has {', '.join(map(repr, states))}.")
        is_other = state != source.state
        source.state = state
        return is_other

    def set(self, source_id: str, on: bool | None, gain_db: float | None, mute: bool | None) -> None:
        """Switch a source, or set its level. Raises: UnknownObject; SessionError: the gain is out of bounds."""
        source = self._known(source_id)
        if on is not None:
            source.is_on = on
        source.level.set(gain_db, mute)

    def factor(self, source_id: str, graph: ContactGraph) -> float:
        """What the source's signal is multiplied with now: 0 when off, muted, or without the contact it needs."""
        source = self._sources[source_id]
        if not source.is_on or not self._has_needed_contact(source_id, graph):
            return 0.0
        return source.level.factor * self.user.factor

    def _known(self, source_id: str) -> _Source:
        try:
            return self._sources[source_id]
        except KeyError:
            raise UnknownObject(unknown_source(source_id, self.ids)) from None

    def _has_needed_contact(self, source_id: str, graph: ContactGraph) -> bool:
        state = self._sources[source_id].state
        needed = next(item.needs_contact for item in self._bundle.objects[source_id].states if item.name == state)
        return needed is None or any(needed in (other, self._category(other)) for other in graph.neighbours(source_id))

    def _category(self, object_id: str) -> str:
        haptics = self._bundle.objects.get(object_id)
        return haptics.object_category if haptics else ""
