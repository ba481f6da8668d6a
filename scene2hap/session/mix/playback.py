"""The mix of a session, to which loops and hands can be added and removed, and which can be paused.

Almost always one mixer plays all loops, which are stored in the slots of its bank. A new hand, or more loops than there
are slots, get another mixer, in phase with the first, and the mixes are added.

Threads: call `render` on the audio thread, `start_burst` on the game's or a worker, everything else on the game's. The
audio thread reads an immutable plan, which the game's thread replaces. Neither thread waits for the other.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import Future, wait
from dataclasses import dataclass
from threading import Lock
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Indices
from scene2hap.common.deadline import Deadline
from scene2hap.devices.protocol import Block
from scene2hap.render.bursts import HEARD_S, MOST_SUM, Bursts, Fade, PlannedBurst
from scene2hap.render.limiter import soft_limit_sum
from scene2hap.render.loop_bank import Slot, SlotBank, position_s
from scene2hap.render.transition import Running, Transition, TransitionCurve
from scene2hap.session.config import MIN_RAMP_S, SessionConfig
from scene2hap.session.mix.hand_limits import HandLimits
from scene2hap.session.mix.mixing_plan import MixerInstance, MixingPlan, PlannedMixer
from scene2hap.session.mix.prepared_loops import PreparedLoop, find, order, prepare
from scene2hap.session.mix.sources import LoopRow

SPARE_SLOTS = 16
"""Least number of empty slots in a new bank; with more loops than this, one empty slot per loop."""


_MOST_ROUTES = 64


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


class Playback:
    """The mix of all loops and bursts, for all hands.

    Parameters: rows : loops for which gains may be set; hands : names of the outputs.
    """

    def __init__(self, config: SessionConfig, rows: Sequence[LoopRow], hands: Sequence[str]) -> None:
        self._config = config
        self._tactile_rate_hz = min(config.tactile_rate_hz, config.sample_rate_hz)
        # Loops that a worker prepares; `take_prepared` adds them.
        self._preparing: dict[LoopRow, Future[PreparedLoop]] = {}
        # The audio thread alone changes `_position` and `_frozen_at`. It reads `_plan`, `_paused_from` and `_limits`;
        # workers read `_hands`. The game's thread replaces each of these as a whole.
        self._position = 0
        self.updated_at: int = 0
        """The frame of the last update, which may be later than `position`."""
        self._paused_from: int | None = None
        self._frozen_at: int | None = None
        self._hands: Mapping[str, int] = {hand: token for token, hand in enumerate(hands)}
        self._next_hand = len(hands)
        self._places: dict[LoopRow, _Place] = {}
        self._retired: list[_Place] = []
        # By columns of the active rows.
        self._routes: dict[tuple[int, ...] | None, list[_Route]] = {}
        self._active: Sequence[LoopRow] = ()
        self._banks = [self._new_bank(len(rows))]
        self._mixers = [MixerInstance(config, self._banks[0], tuple(self._hands.values()), 0)]
        self._plan = self._new_plan()
        self._bursts = Bursts(round(HEARD_S * config.sample_rate_hz))
        self._pausing = Lock()  # else a worker may start a burst after the fade, which would play on after the pause
        self._limits: HandLimits | None = None
        # Twice the ramp, since gain changes in quick succession may have to wait.
        fade_s = 2 * max(config.control_period_s, MIN_RAMP_S) + self._mixers[0].mixer.delay_s + 0.01
        self._fade_frames = round(fade_s * config.sample_rate_hz)
        # The first loops play at once: `change_rows` finds what is prepared here.
        for row in rows:
            self._prepared(row)
        self.change_rows(rows, 0)

    @property
    def position(self) -> int:
        """The next frame of `render`; it does not advance in a pause."""
        return self._position

    @property
    def now(self) -> int:
        """The next frame of `render`, or that of the last update if it is later: no change is earlier."""
        return max(self._position, self.updated_at)

    @property
    def is_paused(self) -> bool:
        """Whether the mix is paused: it fades, or has faded, to silence."""
        return self._paused_from is not None

    @property
    def rows_not_mixed(self) -> int:
        """Rows times cells that the mixers skipped, since their gains are 0."""
        return sum(mixer.mixer.stats.rows_skipped for mixer in self._mixers)

    def position_s(self, row: LoopRow) -> float:
        """Position of a row in its loop [s]."""
        loop = row.loop.tactile
        return position_s(len(loop.samples), loop.sample_rate_hz, self._position, self._config.sample_rate_hz)

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
        self._fade_out([self._places.pop(row) for row in ready if row in self._places], self.now)
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
        if self._paused_from is not None:
            return
        for route in self._routes_of(active, columns):
            played = gains if route.columns is None else gains[:, route.columns]
            played = played if route.channels is None else played[route.channels]
            route.mixer.move_to(played, route.slots, route.outputs, at_frame)

    @property
    def n_bursts(self) -> int:
        """Number of bursts that are playing, or planned."""
        return self._bursts.n_playing

    @property
    def outputs(self) -> Mapping[str, int]:
        """A token of each present hand's output, for `start_burst`; no later output has the same."""
        return self._hands

    def start_burst(
        self, waves: Sequence[NDArray[np.float32]], weights: Mapping[int, Sequence[float]], at_frame: int
    ) -> bool:
        """Add weighted waves (n,) to some of the `outputs`, once, from a frame on. In a pause, return False instead."""
        with self._pausing:
            if self._paused_from is not None:
                return False
            self._bursts.start(PlannedBurst(at_frame, waves, weights))
            return True

    def _routes_of(self, active: Sequence[LoopRow], columns: Sequence[int] | None) -> list[_Route]:
        """The routes of some active rows. Cached, since moving a source repeats a few combinations of rows."""
        if self._active is not active or len(self._routes) >= _MOST_ROUTES:
            self._active = active
            self._routes.clear()
        key = None if columns is None else tuple(columns)
        routes = self._routes.get(key)
        if routes is None:
            rows = active if columns is None else [active[x] for x in columns]
            routes = self._routes[key] = [self._route(rows, planned) for planned in self._plan.mixers]
        return routes

    def _route(self, rows: Sequence[LoopRow], planned: PlannedMixer) -> _Route:
        # Rows whose loops are still being prepared have no place, or that of the row that they replace.
        places = [(i, self._places[row]) for i, row in enumerate(rows) if row in self._places]
        # Mixers of one bank share its slots.
        own = [(i, place.slot) for i, place in places if place.bank.slots is planned.mixer.bank.slots]
        columns = None if len(own) == len(rows) else [i for i, _ in own]
        channels = None if len(self._plan.mixers) == 1 else planned.channels
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
            place.free_at = at_frame + self._fade_frames
            for mixer in self._mixers:
                if mixer.bank.slots is place.bank.slots:
                    mixer.fade(place.slot, at_frame)
        position, retired = self._position, [*self._retired, *gone]
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
        self._hands = {**self._hands, name: token}
        self._mixers += [MixerInstance(self._config, bank, (token,), self._position) for bank in self._banks]
        self._plan = self._new_plan()

    def remove_hand(self, name: str) -> None:
        """Remove an output."""
        self._hands = {hand: token for hand, token in self._hands.items() if hand != name}
        self._mixers = [mixer for mixer in self._mixers if not set(mixer.hands).isdisjoint(self._hands.values())]
        self._plan = self._new_plan()

    def pause(self) -> None:
        """Fade to silence, then stop the clock."""
        if self._paused_from is None:
            at_frame = self.now
            for mixer in self._mixers:
                mixer.silence(at_frame)
            with self._pausing:
                self._bursts.fade(Fade(at_frame, self._fade_frames))
                self._paused_from = at_frame

    def resume(self) -> None:
        """Continue the clock; gains must be set again."""
        self._paused_from = None

    def hold(self, limits: NDArray[np.float64]) -> None:
        """Hold each output within a limit (n_hands,) [-] in `render_held`, see `HandLimits`."""
        by_hand = dict(zip(self._hands.values(), limits.tolist(), strict=True))
        if self._limits is None:
            # Limits that come while the mix plays begin at full scale, so that they do not click.
            first = {} if self._position else by_hand
            self._limits = HandLimits(self._config.sample_rate_hz, tuple(self._hands.values()), first)
        self._limits.hold(by_hand)

    def render(self, n_frames: int) -> Block:
        """The next samples (n_frames, n_hands) float32 in [-1, 1]."""
        return self._rendered(self._plan, n_frames)

    def render_held(self, n_frames: int) -> Block:
        """The next samples as `render` gives them, each output within its limit, if any."""
        plan, limits = self._plan, self._limits
        mix = self._rendered(plan, n_frames)
        return mix if limits is None else limits.pass_through(mix, plan.hands)

    def _rendered(self, plan: MixingPlan, n_frames: int) -> Block:
        paused_from = self._paused_from
        if paused_from is None:
            self._frozen_at = None
            return self._render(plan, n_frames)
        if self._frozen_at is None:
            self._frozen_at = max(paused_from, self._position) + self._fade_frames
        n_left = min(n_frames, max(0, self._frozen_at - self._position))
        silence = np.zeros((n_frames - n_left, plan.n_channels), dtype=np.float32)
        return np.concatenate([self._render(plan, n_left), silence])

    def _render(self, plan: MixingPlan, n_frames: int) -> Block:
        mix = loops = plan.render(self._position, n_frames)
        if not self._bursts.are_silent:
            total = loops.copy()
            self._bursts.add_to(total, self._position, plan.hands)
            mix = soft_limit_sum(loops, total, MOST_SUM)
        self._bursts.hear(loops, plan.hands)
        self._position += n_frames
        return mix

    def _new_plan(self) -> MixingPlan:
        self._routes.clear()
        return MixingPlan.of(self._mixers, tuple(self._hands.values()))

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
        self._mixers.append(MixerInstance(self._config, bank, tuple(self._hands.values()), self._position))
        self._plan = self._new_plan()
        return bank, 0
