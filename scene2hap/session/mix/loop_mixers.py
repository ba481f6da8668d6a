"""The mixers of a session: loops in the slots of their banks, and the gains at which each hand gets them.

Almost always one mixer plays all loops. A new hand, or more loops than there are slots, get another mixer, in phase
with the first, and the mixes are added. The game's thread calls everything but `MixingPlan.render`: the audio thread
reads an immutable plan, which the game's thread replaces.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from concurrent.futures import Future, wait
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Indices
from scene2hap.common.deadline import Deadline
from scene2hap.devices.protocol import Block
from scene2hap.render.limiter import soft_limit_sum
from scene2hap.render.loop_bank import Slot, SlotBank
from scene2hap.render.mixer import Mixer
from scene2hap.render.transition import Running, Transition, TransitionCurve
from scene2hap.session.config import MIN_RAMP_S, SessionConfig
from scene2hap.session.mix.prepared_loops import PreparedLoop, find, order, prepare
from scene2hap.session.mix.sources import LoopRow

SPARE_SLOTS = 16
"""Least number of empty slots in a new bank; with more loops than this, one empty slot per loop."""

_MOST_ROUTES = 64


class Clock:
    """The clock of `render` [frames]. It does not advance in a pause.

    position : the next frame of `render`, which the audio thread alone changes; updated_at : the frame of the last
    update, which may be later.
    """

    def __init__(self) -> None:
        self.position: int = 0
        self.updated_at: int = 0

    @property
    def now(self) -> int:
        """The next frame of `render`, or that of the last update if it is later: no change is earlier."""
        return max(self.position, self.updated_at)


class MixerInstance:
    """A mixer for some hands and a bank.

    Parameters: hands : a token for each output; position : the frame of the session's clock from which it may begin.
    """

    def __init__(self, config: SessionConfig, bank: SlotBank, hands: tuple[int, ...], position: int) -> None:
        rate = config.sample_rate_hz
        # It begins at a whole number of tactile samples, so that its loops are in phase with those of other mixers,
        # and not after `position`, or its hands and loops would be felt late: up to 10 ms at 44.1 kHz.
        unit = rate // math.gcd(rate, bank.sample_rate_hz)
        self._begin = position // unit * unit
        self.bank: SlotBank = bank.shifted(self._begin * bank.sample_rate_hz // rate)
        self.hands = hands
        self.mixer: Mixer = Mixer(
            self.bank,
            len(hands),
            sample_rate_hz=rate,
            ramp_s=max(config.control_period_s, MIN_RAMP_S),
            skip_silent=config.skip.silent_bands,
        )
        self.mixer.render(position - self._begin)
        self._nothing = np.zeros((len(hands), 0, config.bands.n_bands), dtype=np.float32)
        # The target gains, their slots, and the request for them: an equal request is skipped.
        self._gains, self._slots = self._nothing, list[int]()
        self._last_request: tuple[bytes, list[int], list[int]] | None = None

    def move_to(self, gains: NDArray[np.float32], slots: list[int], hands: list[int], at_frame: int) -> None:
        """Ramp to gains (n_hands, n_slots, n_bands) of some slots for some of its hands, and to 0 for the rest."""
        request = (gains.tobytes(), slots, hands)
        if request == self._last_request:
            return
        if len(hands) < len(self.hands):
            some, gains = gains, np.zeros((len(self.hands), *gains.shape[1:]), dtype=np.float32)
            gains[hands] = some
        self._send(gains, slots, at_frame)
        self._last_request = request

    def fade(self, faded: int, at_frame: int) -> None:
        """Ramp to 0 for one slot only."""
        kept = [i for i, slot in enumerate(self._slots) if slot != faded]
        self._send(self._gains[:, kept], [self._slots[i] for i in kept], at_frame)

    def silence(self, at_frame: int) -> None:
        """Ramp to 0."""
        self._send(self._nothing, [], at_frame)

    def render(self, position: int, n_frames: int) -> Block:
        """Samples (n_frames, n_hands) from frame `position` of the session's clock on; it must not decrease."""
        behind = position - self._begin - self.mixer.position
        if behind > 0:
            self.mixer.render(behind)
        return self.mixer.render(n_frames)

    def _send(self, gains: NDArray[np.float32], slots: list[int], at_frame: int) -> None:
        self.mixer.set_gains(gains, slots, at_frame - self._begin)
        self._gains, self._slots, self._last_request = gains, slots, None


class PlannedMixer(NamedTuple):
    """A mixer, those of its outputs that belong to a present hand, and the channels of these hands."""

    mixer: MixerInstance
    outputs: Indices
    channels: Indices


@dataclass(frozen=True, eq=False)
class MixingPlan:
    """The present outputs, a token for each, and the mixers that play them."""

    hands: tuple[int, ...]
    mixers: tuple[PlannedMixer, ...]

    @property
    def n_channels(self) -> int:
        """Number of outputs."""
        return len(self.hands)

    @classmethod
    def of(cls, mixers: Sequence[MixerInstance], hands: tuple[int, ...]) -> MixingPlan:
        """Return the plan by which mixers play the present hands, given by their tokens."""
        planned = []
        for mixer in mixers:
            present = [(i, hands.index(hand)) for i, hand in enumerate(mixer.hands) if hand in hands]
            outputs, channels = np.array(present, dtype=np.intp).reshape(-1, 2).T
            planned.append(PlannedMixer(mixer, outputs, channels))
        return cls(hands, tuple(planned))

    def render(self, position: int, n_frames: int) -> Block:
        """Samples (n_frames, n_channels) from frame `position` of the session's clock on; it must not decrease."""
        mixer, outputs, _ = self.mixers[0]
        if len(self.mixers) == 1 and len(outputs) == len(mixer.hands):
            return mixer.render(position, n_frames)
        mixes = np.zeros((len(self.mixers), n_frames, self.n_channels), dtype=np.float32)
        for mix, (mixer, outputs, channels) in zip(mixes, self.mixers, strict=True):
            mix[:, channels] = mixer.render(position, n_frames)[:, outputs]
        return soft_limit_sum(np.abs(mixes).max(axis=0), mixes.sum(axis=0))


class _Route(NamedTuple):
    """The part of the gains that one mixer plays.

    columns : of the gains (n_hands, n_columns, n_bands), None for all; slots : of these columns in the mixer's bank;
    outputs : of the mixer; channels : rows of the gains for these outputs, None for all.
    """

    mixer: MixerInstance
    columns: list[int] | None
    slots: list[int]
    outputs: list[int]
    channels: Indices | None


@dataclass(eq=False)
class _Place:
    """Bank and slot of a row, and its peaks (2, n_bands), see `prepared_loops.peaks_of`; `free_at` is the frame at
    which a removed row has faded."""

    bank: SlotBank
    slot: int
    peaks: NDArray[np.float64]
    free_at: int = 0


class LoopMixers:
    """All loops of a session, in the mixers that play them.

    Parameters: rows : loops for which gains may be set; hands : names of the outputs.
    plan : what the audio thread plays; outputs : a token of each present hand's output, no later one has the same;
    fade_frames : after this time a loop that fades is silent.
    """

    def __init__(self, config: SessionConfig, rows: Sequence[LoopRow], hands: Sequence[str], clock: Clock) -> None:
        self._config, self._clock = config, clock
        self._tactile_rate_hz = min(config.tactile_rate_hz, config.sample_rate_hz)
        # Loops that a worker prepares; `take_prepared` adds them.
        self._preparing: dict[LoopRow, Future[PreparedLoop]] = {}
        self.outputs: Mapping[str, int] = {hand: token for token, hand in enumerate(hands)}
        self._next_hand = len(hands)
        self._places: dict[LoopRow, _Place] = {}
        self._retired: list[_Place] = []
        # By columns of the active rows.
        self._routes: dict[tuple[int, ...] | None, list[_Route]] = {}
        self._active: Sequence[LoopRow] = ()
        self._banks = [self._new_bank(len(rows))]
        self._mixers = [MixerInstance(config, self._banks[0], tuple(self.outputs.values()), 0)]
        self.plan: MixingPlan = self._new_plan()
        # Twice the ramp, since gain changes in quick succession may have to wait.
        fade_s = 2 * max(config.control_period_s, MIN_RAMP_S) + self._mixers[0].mixer.delay_s + 0.01
        self.fade_frames: int = round(fade_s * config.sample_rate_hz)
        # The first loops play at once: `change_rows` finds what is prepared here.
        for row in rows:
            self._prepared(row)
        self.change_rows(rows, 0)

    @property
    def rows_not_mixed(self) -> int:
        """Rows times cells that the mixers skipped, since their gains are 0."""
        return sum(mixer.mixer.stats.rows_skipped for mixer in self._mixers)

    def peaks(self, rows: Sequence[LoopRow]) -> NDArray[np.float32]:
        """Peaks (n_rows, 2, n_bands) of what is played, see `prepared_loops.peaks_of`; 0 of rows without a loop yet."""
        n_bands = self._config.bands.n_bands
        silent = np.zeros((2, n_bands))
        found = [self._places[row].peaks if row in self._places else silent for row in rows]
        return np.array(found, dtype=np.float32).reshape(len(rows), 2, n_bands)

    def take_prepared(self) -> bool:
        """Add the loops that are now prepared, silent until gains are set again. Returns false if there are none."""
        ready = [row for row, loop in self._preparing.items() if loop.done()]
        if not ready:
            return False
        self._fade_out([self._places.pop(row) for row in ready if row in self._places], self._clock.now)
        for row in ready:
            loop = self._preparing.pop(row).result()
            self._put_in_slot(row, loop.bank, loop.peaks, len(ready))
        return True

    def wait(self, end: Deadline) -> bool:
        """Wait for loops that are being prepared; false after the deadline."""
        return not wait(self._preparing.values(), end.left_s).not_done

    def set_gains(
        self,
        gains: NDArray[np.float32],
        active: Sequence[LoopRow],
        at_frame: int,
        columns: Sequence[int] | None = None,
    ) -> None:
        """Ramp to gains (n_hands, n_columns, n_bands) of some active rows (None for all), and to 0 for the others."""
        for route in self._routes_of(active, columns):
            played = gains if route.columns is None else gains[:, route.columns]
            played = played if route.channels is None else played[route.channels]
            route.mixer.move_to(played, route.slots, route.outputs, at_frame)

    def silence(self, at_frame: int) -> None:
        """Fade out all loops, until gains are set again."""
        for mixer in self._mixers:
            mixer.silence(at_frame)

    def _routes_of(self, active: Sequence[LoopRow], columns: Sequence[int] | None) -> list[_Route]:
        """The routes of some active rows. Cached, since moving a source repeats a few combinations of rows."""
        if self._active is not active or len(self._routes) >= _MOST_ROUTES:
            self._active = active
            self._routes.clear()
        key = None if columns is None else tuple(columns)
        routes = self._routes.get(key)
        if routes is None:
            rows = active if columns is None else [active[x] for x in columns]
            routes = self._routes[key] = [self._route(rows, planned) for planned in self.plan.mixers]
        return routes

    def _route(self, rows: Sequence[LoopRow], planned: PlannedMixer) -> _Route:
        # Rows whose loops are still being prepared have no place, or that of the row that they replace.
        places = [(i, self._places[row]) for i, row in enumerate(rows) if row in self._places]
        # Mixers of one bank share its slots.
        own = [(i, place.slot) for i, place in places if place.bank.slots is planned.mixer.bank.slots]
        columns = None if len(own) == len(rows) else [i for i, _ in own]
        channels = None if len(self.plan.mixers) == 1 else planned.channels
        return _Route(planned.mixer, columns, [slot for _, slot in own], planned.outputs.tolist(), channels)

    def change_rows(
        self, rows: Sequence[LoopRow], at_frame: int, instead: tuple[LoopRow, LoopRow] | None = None
    ) -> None:
        """Play these rows; fade out all others.

        Loops that are not prepared yet are added by `take_prepared`, unless preparing is set to block.
        Parameters: instead : a new row, and the one that it replaces, whose loop is played until that of the new row is
        prepared.
        """
        bands, rate_hz = self._config.bands, self._tactile_rate_hz
        is_blocking = self._config.prepare == "blocking"
        new = [row for row in rows if row not in self._places and row not in self._preparing]
        loops = [self._prepared(row) if is_blocking else find(row.loop.tactile, bands, rate_hz) for row in new]
        if instead is not None:
            later, earlier = instead
            if earlier in self._places and (later, None) in zip(new, loops, strict=True):
                self._places[later] = self._places.pop(earlier)
                self._routes.clear()
        wanted = set(rows)
        self._fade_out([self._places.pop(row) for row in [*self._places] if row not in wanted], at_frame)
        self._preparing = {row: loop for row, loop in self._preparing.items() if row in wanted}
        for row, loop in zip(new, loops, strict=True):
            if loop is None:
                self._preparing[row] = order(row.loop.tactile, bands, rate_hz)
            else:
                self._put_in_slot(row, loop.bank, loop.peaks, len(new))

    def _fade_out(self, gone: Sequence[_Place], at_frame: int) -> None:
        """Fade out the loops of some slots. Slots whose loops have faded out become free."""
        for place in gone:
            place.free_at = at_frame + self.fade_frames
            for mixer in self._mixers:
                if mixer.bank.slots is place.bank.slots:
                    mixer.fade(place.slot, at_frame)
        position, retired = self._clock.position, [*self._retired, *gone]
        self._retired = [place for place in retired if place.free_at > position]
        for place in retired:
            if place.free_at <= position:
                place.bank.slots[place.slot] = None

    def _prepared(self, row: LoopRow) -> PreparedLoop:
        return prepare(row.loop.tactile, self._config.bands, self._tactile_rate_hz)

    def _put_in_slot(self, row: LoopRow, content: Slot, peaks: NDArray[np.float64], n_wanted: int) -> None:
        bank, slot = self._free_slot(n_wanted)
        bank.slots[slot] = content
        self._places[row] = _Place(bank, slot, peaks)
        self._routes.clear()

    def start_transition(
        self,
        row: LoopRow,
        of: LoopRow,
        at_frame: int,
        lasts_s: float,
        course: TransitionCurve,
        since: Running,
        after: Transition | None,
    ) -> Transition | None:
        """Add a row that plays another row once while it starts or stops, from a frame on; see `Transition`.

        Returns None if the other row is still being prepared.
        """
        if of in self._preparing:
            return None
        loop = self._prepared(of)
        transition = Transition(loop.bank, self._tactile(at_frame), lasts_s, course, since, after)
        self._put_in_slot(row, transition, loop.peaks, 1)
        return transition

    def running(self, transition: Transition, at_frame: int) -> Running:
        """Speed and amplitude of a transition at a frame."""
        return transition.running(self._tactile(at_frame))

    def end_frame(self, transition: Transition) -> int:
        """The frame at which a transition ends."""
        return -(-transition.end * self._config.sample_rate_hz // self._tactile_rate_hz)

    def _tactile(self, frame: int) -> int:
        return frame * self._tactile_rate_hz // self._config.sample_rate_hz

    def add_hand(self, name: str) -> None:
        """Add an output, after the others."""
        token, self._next_hand = self._next_hand, self._next_hand + 1
        self.outputs = {**self.outputs, name: token}
        self._mixers += [MixerInstance(self._config, bank, (token,), self._clock.position) for bank in self._banks]
        self.plan = self._new_plan()

    def remove_hand(self, name: str) -> None:
        """Remove an output."""
        self.outputs = {hand: token for hand, token in self.outputs.items() if hand != name}
        self._mixers = [mixer for mixer in self._mixers if not set(mixer.hands).isdisjoint(self.outputs.values())]
        self.plan = self._new_plan()

    def _new_plan(self) -> MixingPlan:
        self._routes.clear()
        return MixingPlan.of(self._mixers, tuple(self.outputs.values()))

    def _new_bank(self, n_rows: int) -> SlotBank:
        n_slots = n_rows + max(SPARE_SLOTS, n_rows)
        return SlotBank([None] * n_slots, self._config.bands, self._tactile_rate_hz)

    def _free_slot(self, n_wanted: int) -> tuple[SlotBank, int]:
        for bank in self._banks:
            if None in bank.slots:
                return bank, bank.slots.index(None)
        # Each new bank has as many slots as all before it, so that adding many loops one by one needs few mixers.
        bank = self._new_bank(max(n_wanted, len(self._places) // 2))
        self._banks.append(bank)
        self._mixers.append(MixerInstance(self._config, bank, tuple(self.outputs.values()), self._clock.position))
        self.plan = self._new_plan()
        return bank, 0
