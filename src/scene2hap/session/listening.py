"""What every hand is given, frame by frame: the field in use, asked about touches, times the level of each source."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np
from numpy.typing import NDArray

from scene2hap.contact.graph import ContactChange
from scene2hap.propagation.live import LiveModel
from scene2hap.propagation.protocol import Excitation
from scene2hap.session.audibility import Audibility
from scene2hap.session.config import SessionConfig
from scene2hap.session.counts import Counts
from scene2hap.session.explain import Explainer, Explanation
from scene2hap.session.field_keeper import FieldKeeper
from scene2hap.session.frame import HapticFrame, SessionStats, Touch
from scene2hap.session.live_keeper import LiveKeeper
from scene2hap.session.network import excitations_of
from scene2hap.session.sources import Sources
from scene2hap.session.stage import Stage
from scene2hap.session.touch_gains import TouchGains

Felt = dict[int, list[Touch]]
"""The touches of each hand that touches anything, by its number, rising."""


class Listening:
    """Turns touches into gains, and leaves out what changes nothing.

    What gains depend on besides the touches is remembered, and forgotten when it changes.
    """

    def __init__(self, config: SessionConfig, stage: Stage, sources: Sources) -> None:
        self._config, self._stage, self._sources = config, stage, sources
        self._counts = Counts()
        self._excitations: Sequence[Excitation] | None = None
        self._gains: TouchGains | None = None
        self._gains_of: object = None
        self._n_unreachable: int | None = None
        self._levels: NDArray[np.float64] | None = None
        self._are_levels_even = False
        self._audibility: Audibility | None = None
        self._felt: Felt = {}
        self._frame = self.silence(())
        self._is_fresh = False
        self._look_around()
        self.keeper = keeper_of(config, stage, self._known_excitations())
        self._count_unreachable()

    def follow(self, change: ContactChange, *, is_other_cast: bool = False) -> None:
        """Take in a change of contacts, after objects came or went; `is_other_cast` if sources did."""
        matters = is_other_cast or not self._config.skip.unreachable or self._reach.concerns(change)
        if is_other_cast:
            self._audibility = self._excitations = None
        if is_other_cast or self._bodies is not self._stage.bodies:
            self._look_around()
        elif change.appeared or change.vanished:
            self._reach.follow(change)
            self._n_unreachable = self._levels = None
        if not change and not is_other_cast:
            return
        self._is_fresh = False
        if matters or self._reach.concerns(change):
            self._ask()
        else:
            self._counts.changes_out_of_reach += 1

    def levels_changed(self, is_other_state: bool = False) -> None:
        """Forget levels; another state vibrates at another frequency, so that the field is another too."""
        self._levels = None
        self._is_fresh = False
        if is_other_state:
            self._audibility = self._excitations = None
            self._ask()

    def frame(
        self, hands: tuple[str, ...], felt: Felt, moved: Collection[str], *, is_paused: bool
    ) -> tuple[HapticFrame, NDArray[np.float32] | None]:
        """What the hands are given, and what of it is worth mixing: None if nothing has changed."""
        if self.keeper.take():
            self._is_fresh = False
        if self._is_unchanged(felt, moved):
            self._counts.unchanged_frames += 1
            return self._frame, None
        self._felt, self._is_fresh = felt, True
        if is_paused:
            self._frame = self.silence(hands)
            return self._frame, None
        told = self._told(len(hands), felt)
        self._frame = HapticFrame(told, hands, self._sources.ids)
        return self._frame, self._worth_mixing(told, list(felt))

    def silence(self, hands: tuple[str, ...]) -> HapticFrame:
        """A frame in which no hand is given anything."""
        return HapticFrame(self._nothing(len(hands)), hands, self._sources.ids)

    def wait(self, timeout_s: float | None) -> bool:
        """Wait for the worker; false after the timeout [s]."""
        in_use, is_over = self.keeper.in_use, self.keeper.wait(timeout_s)
        if self.keeper.in_use is not in_use:
            self._is_fresh = False
        return is_over

    def explain(self, hand: str) -> Explanation:
        """Each source that a hand felt at the last frame, and its way there."""
        felt = (touch for touches in self._felt.values() for touch in touches)
        touches = [touch for touch in felt if touch.hand == hand and touch.object_id in self._stage.objects]
        levels = dict(zip(self._sources.ids, self._known_levels()[:, 0].tolist(), strict=True))
        explainer = Explainer(self._stage, self._sources, self._config.propagation, self._touch_gains(Counts()), levels)
        return explainer.explain(hand, touches, self._frame, self.keeper.is_current)

    def stats(self, updates: int, rows_not_mixed: int) -> SessionStats:
        """What was done so far."""
        keeper = self.keeper
        return SessionStats(
            updates,
            keeper.n_prepared,
            self._counts.gains_capped,
            self._stage.bodiless,
            keeper.age_s,
            keeper.latency_s,
            keeper.n_failed,
            keeper.last_failure,
            self._counts.skipped(rows_not_mixed),
        )

    def _look_around(self) -> None:
        """Find out anew what hangs together."""
        self._bodies, self._reach = self._stage.bodies, self._stage.reach(self._sources.ids)
        self._gains = self._levels = self._n_unreachable = None

    def _ask(self) -> None:
        self.keeper.ask(self._known_excitations())
        self._count_unreachable()

    def _count_unreachable(self) -> None:
        if self._config.skip.unreachable:
            if self._n_unreachable is None:
                self._n_unreachable = len(self._bodies) - self._reach.n_of(self._bodies)
            self._counts.unreachable_objects += self._n_unreachable

    def _known_excitations(self) -> Sequence[Excitation]:
        if self._excitations is None:
            self._excitations = excitations_of(self._sources.active_rows(), self._stage.bodies)
        return self._excitations

    def _is_unchanged(self, felt: Felt, moved: Collection[str]) -> bool:
        if not (self._is_fresh and self._config.skip.unchanged_frames and felt == self._felt):
            return False
        # A field that is not of this moment is asked about where the object was then.
        return not moved or not any(touch.object_id in moved for touches in felt.values() for touch in touches)

    def _told(self, n_hands: int, felt: Felt) -> NDArray[np.float32]:
        if not felt:
            return self._nothing(n_hands)
        if self._gains is None or self._gains_of is not self.keeper.in_use:
            self._gains, self._gains_of = self._touch_gains(self._counts), self.keeper.in_use
        found = self._gains.of(list(felt.values()))
        levels = self._known_levels()
        if not self._are_levels_even:
            found *= levels
        if len(felt) == n_hands:
            return found.astype(np.float32)
        told = self._nothing(n_hands)
        told[list(felt)] = found
        return told

    def _nothing(self, n_hands: int) -> NDArray[np.float32]:
        return np.zeros((n_hands, len(self._sources.ids), self._config.bands.n_bands), dtype=np.float32)

    def _known_levels(self) -> NDArray[np.float64]:
        """What each source's signal is multiplied with (n_sources, 1) [-]."""
        if self._levels is None:
            self._levels = self._sources.factors(self._stage.graph.neighbours, self._stage.category)[:, None]
            self._are_levels_even = bool((self._levels == 1.0).all())
        return self._levels

    def _worth_mixing(self, told: NDArray[np.float32], touching: list[int]) -> NDArray[np.float32]:
        skip = self._config.skip
        is_partly_idle = skip.idle_hands and len(touching) < len(told)
        if is_partly_idle:
            self._counts.idle_hands += len(told) - len(touching)
        if not (skip.below_threshold or skip.silent_bands) or (is_partly_idle and not touching):
            return told
        if self._audibility is None:
            self._audibility = Audibility(self._sources.active_rows(), self._config.bands, skip, self._counts)
        if not is_partly_idle:
            return self._audibility.worth_mixing(told)
        mixed = np.zeros_like(told)
        mixed[touching] = self._audibility.worth_mixing(told[touching])
        return mixed

    def _touch_gains(self, counts: Counts) -> TouchGains:
        config = self._config
        return TouchGains(
            self.keeper.hearing(self._sources.ids, self._reach),
            self._reach,
            counts,
            skips_unreachable=config.skip.unreachable,
            limit=None if config.gain_limit_db is None else 10 ** (config.gain_limit_db / 20),
        )


def keeper_of(config: SessionConfig, stage: Stage, excitations: Sequence[Excitation]) -> FieldKeeper | LiveKeeper:
    """What keeps a field of the configured model at hand: a live one where the model offers it."""
    model, bands = config.propagation, config.bands
    if isinstance(model, LiveModel):
        return LiveKeeper(model, bands, stage, excitations)
    is_background, skips_unreachable = config.prepare == "background", config.skip.unreachable
    return FieldKeeper(
        model, bands, stage, excitations, is_background=is_background, skips_unreachable=skips_unreachable
    )
