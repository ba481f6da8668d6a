"""Gains of every hand in each frame: the field at the touches, times the level of each source."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.deadline import Deadline
from scene2hap.contact.graph import ContactChange
from scene2hap.propagation.live import LiveField, PathCostField
from scene2hap.session.config import SessionConfig
from scene2hap.session.fields.requests import FieldProvider, FieldRequests
from scene2hap.session.frame import HapticFrame, Touch, TouchesByHand
from scene2hap.session.gains.audibility import SILENT, Audibility, CutoffCost, arriving
from scene2hap.session.gains.hand_gains import AllGains, GainMethod, HandGains, Loudness, PrunedGains, TouchGains
from scene2hap.session.mix.sources import LoopRow, Sources
from scene2hap.session.present_scene.scene_state import SceneState
from scene2hap.session.stats import Counts, SessionStats
from scene2hap.session.user_profile import PersonalGains, UserProfile

PeaksOf = Callable[[Sequence[LoopRow]], NDArray[np.float32]]
"""Peaks (n_rows, 2, n_bands) of the loops of some rows, 0 for loops that are not ready to be mixed."""


class LastFrame(NamedTuple):
    """What one hand got at the last frame.

    touches : of the hand, of objects that are still there; field : in use, at which `gains` evaluates touches; levels :
    of each source at the hand, by band (n_bands,) [-]; peaks : of each source in each band, in thresholds of touch
    (n_sources, n_bands); is_current, failure : see `Explanation`.
    """

    hand: str
    touches: Sequence[Touch]
    frame: HapticFrame
    field: object
    gains: TouchGains
    levels: Mapping[str, NDArray[np.float64]]
    peaks: NDArray[np.float32]
    is_current: bool
    failure: str


class HandFrames:
    """Turns touches into gains, and skips updates that change nothing.

    What the gains depend on besides the touches is cached, and dropped when its inputs change:
    levels (sources, user), audibility (loops), cut-offs (field, audibility), method (field, levels, audibility, reach).
    hands : names of the outputs; keeper : provides the field.
    """

    def __init__(
        self, config: SessionConfig, state: SceneState, sources: Sources, peaks: PeaksOf, hands: tuple[str, ...]
    ) -> None:
        self._config, self._state, self._sources, self._peaks = config, state, sources, peaks
        self._counts, self._n_updates = Counts(), 0
        self._method: tuple[LiveField, GainMethod] | None = None
        self._levels, self._are_levels_known = np.empty(0), False
        self._profile: UserProfile | None = None
        self.hands: tuple[str, ...] = hands
        self._personal: PersonalGains | None = None
        self._audibility: Audibility | None = None
        self._loudness: Loudness | None = None
        self._cutoff: tuple[PathCostField, CutoffCost] | None = None
        self._touches: TouchesByHand = {}
        self._frame = self.silence()
        # Whether `_frame` holds for `_touches` as long as none of their objects moves.
        self._is_fresh = False
        self._fields = FieldRequests(config, state, sources, self._counts.skipped)
        self.keeper: FieldProvider = self._fields.keeper

    def apply(self, change: ContactChange, *, sources_changed: bool = False) -> None:
        """Apply a change of contacts. `sources_changed` is true if sources were added or removed."""
        if sources_changed:
            self._forget_sources()
        # Also if the model fails, which raises its error here if no worker prepares.
        was_fresh, self._is_fresh = self._is_fresh, False
        if not self._fields.apply(change, sources_changed=sources_changed):
            self._is_fresh = was_fresh

    def loops_changed(self) -> None:
        """Drop caches that depend on the loops, after more loops became ready to be mixed."""
        self._audibility = self._loudness = self._method = None
        self._is_fresh = False

    def levels_changed(self, is_other_state: bool = False) -> None:
        """Drop cached levels. In another state a source has another frequency, which needs a new field."""
        self._are_levels_known = self._is_fresh = False
        if is_other_state:
            self._forget_sources()
            self._fields.states_changed()

    def use_profile(self, profile: UserProfile) -> None:
        """Use the levels of another person."""
        self._profile = None if profile.is_neutral else profile
        self.levels_changed()

    def use_hands(self, hands: tuple[str, ...]) -> None:
        """Use other hands. Those that remain keep their touches."""
        self.hands = hands
        self._touches = {hand: self._touches[hand] for hand in hands if hand in self._touches}
        self.levels_changed()

    def frame(
        self, touches: TouchesByHand, moved: Collection[str], *, is_paused: bool
    ) -> tuple[HapticFrame, HandGains | None]:
        """Gains of the hands, and the part to be mixed; None if nothing has changed."""
        self._catch_up()
        if self.keeper.take():
            self._is_fresh = False
        gained = None
        if self._is_unchanged(touches, moved):
            self._counts.skipped.unchanged_frames += 1
        else:
            self._touches, self._is_fresh = touches, True
            if is_paused:
                self._frame = self.silence()
            else:
                gained = self._gains_of_hands(touches)
                self._frame = HapticFrame(gained.full, self.hands, self._sources.ids)
        self.keeper.order()
        self._n_updates += 1
        return self._frame, gained

    @property
    def touches(self) -> TouchesByHand:
        """The touches of the last frame, of objects that are still there."""
        objects = self._state.objects
        return {hand: [one for one in each if one.object_id in objects] for hand, each in self._touches.items()}

    @property
    def field(self) -> object:
        """The field in use, for the present objects."""
        self._catch_up()
        return self.keeper.field

    def silence(self) -> HapticFrame:
        """A frame in which all gains are 0."""
        return HapticFrame(self._nothing(), self.hands, self._sources.ids)

    def wait(self, end: Deadline) -> bool:
        """Wait for the worker; false after the deadline."""
        # There may be another field now, or `expect` may have changed this one.
        self._is_fresh = False
        self._catch_up()
        return self.keeper.wait(end)

    def last(self, hand: str) -> LastFrame:
        """The last frame of a hand, and the field in use, for a report."""
        self._catch_up()
        keeper, touches = self.keeper, self.touches.get(hand, [])
        at_touches = keeper.for_points(self._sources.ids, self._fields.reach, len(touches))
        return LastFrame(
            hand,
            touches,
            self._frame,
            keeper.field,
            self._touch_gains(at_touches, Counts()),
            self._levels_at(hand),
            self._known_audibility().peaks[:, 0],
            keeper.is_current,
            keeper.failure,
        )

    def would_feel(self, touches: Sequence[Touch]) -> NDArray[np.float64]:
        """Gains (n_touches, n_sources, n_bands) [-] of each touch alone, 0 below -140 dB; no touch is counted."""
        self._catch_up()
        if not touches or not self._sources.ids:
            return np.zeros((len(touches), len(self._sources.ids), self._config.bands.n_bands))
        levels = {hand: np.stack([*self._levels_at(hand).values()]) for hand in {touch.hand for touch in touches}}
        field = self.keeper.for_points(self._sources.ids, self._fields.reach, len(touches))
        cutoff = self._cutoff_of(field)
        limits = None if cutoff is None else cutoff.arrives(np.max([*levels.values()], axis=(0, 2)))
        given = self._touch_gains(field, Counts()).of([[touch] for touch in touches], limits)
        for one, touch in zip(given, touches, strict=True):
            one *= levels[touch.hand]
        return np.where(given < SILENT, 0.0, given)

    def over_threshold_db(self, gains: NDArray[np.float64]) -> NDArray[np.float64]:
        """Levels over the threshold of touch [dB] (..., n_sources), see `HapticSession.over_threshold_db`."""
        felt = [row.loop.felt for row in self._sources.active_rows()]
        full_db = np.array([math.nan if one is None else one.level_db for one in felt])
        amplitudes = arriving(gains, self._known_audibility().peaks[:, 0])
        with np.errstate(divide="ignore"):
            levels_db: NDArray[np.float64] = 20 * np.log10(amplitudes) + full_db
        return levels_db

    def stats(self, rows_not_mixed: int) -> SessionStats:
        """Counters so far."""
        return replace(
            self.keeper.stats,
            updates=self._n_updates,
            gains_capped=self._counts.gains_capped,
            bodiless=self._state.bodiless,
            skipped=replace(self._counts.skipped, rows_not_mixed=rows_not_mixed),
        )

    def _catch_up(self) -> None:
        """Apply the additions and removals of objects and sources since the last frame."""
        if not self._fields.is_caught_up:
            self._method, self._are_levels_known = None, False
            self._fields.catch_up()

    def _forget_sources(self) -> None:
        """Drop caches that depend on the sources and their states."""
        self._audibility = self._loudness = self._method = None

    def _is_unchanged(self, touches: TouchesByHand, moved: Collection[str]) -> bool:
        if not (self._is_fresh and self._config.skip.unchanged_frames and touches == self._touches):
            return False
        # An outdated field is evaluated at the object's former place, so a moved object needs another query.
        return not moved or not any(touch.object_id in moved for each in touches.values() for touch in each)

    def _gains_of_hands(self, touches: TouchesByHand) -> HandGains:
        if not touches:
            silence = self._nothing()
            if self._config.skip.idle_hands:
                self._counts.skipped.idle_hands += len(self.hands)
            return HandGains(lambda: silence, silence)
        self._known_levels()
        field = self.keeper.for_touches(self._sources.ids, self._fields.reach)
        if self._method is None or self._method[0] is not field:
            self._method = (field, self._new_method(field))
        gained = self._method[1].of_hands(self.hands, touches)
        return gained if self._personal is None else self._personal.applied(gained)

    def _new_method(self, field: LiveField) -> GainMethod:
        skip, counts = self._config.skip, self._counts
        gains, audibility = self._touch_gains(field, counts), self._known_audibility()
        if self._loudness is None:
            self._loudness = Loudness(self._levels, audibility)
        loudness = self._loudness
        wants_near = skip.below_threshold and skip.idle_hands and not gains.may_be_capped
        cutoff = self._cutoff_of(field) if wants_near else None
        if cutoff is None:
            return AllGains(gains, loudness, skip, counts.skipped)
        assert isinstance(field, PathCostField)
        return PrunedGains(
            gains,
            field,
            cutoff,
            loudness,
            counts.skipped,
            skips_silent_bands=skip.silent_bands,
            graph=self._state.graph,
        )

    def _known_audibility(self) -> Audibility:
        if self._audibility is None:
            peaks = self._peaks(self._sources.active_rows())
            self._audibility = Audibility(peaks, self._config.skip, self._counts.skipped)
            self._cutoff = None
        return self._audibility

    def _cutoff_of(self, field: LiveField) -> CutoffCost | None:
        """The cut-offs of the sources in a field; None unless it reports path cost."""
        if not isinstance(field, PathCostField):
            return None
        audibility = self._known_audibility()
        if self._cutoff is None or self._cutoff[0] is not field:
            self._cutoff = (field, CutoffCost(field, audibility, self._fields.excitations))
        return self._cutoff[1]

    def _nothing(self) -> NDArray[np.float32]:
        return np.zeros((len(self.hands), len(self._sources.ids), self._config.bands.n_bands), dtype=np.float32)

    def _known_levels(self) -> NDArray[np.float64]:
        """The factor of each source's signal (n_sources,) [-]."""
        if not self._are_levels_known:
            levels = self._sources.factors()
            self._personal = None
            if self._profile is not None:
                config, rows = self._config, self._sources.active_rows()
                self._personal = PersonalGains(self._profile, config.actuator.name, self.hands, rows, config.bands)
                levels *= self._personal.highest
            if not np.array_equal(levels, self._levels):
                self._levels, self._loudness, self._method = levels, None, None
            self._are_levels_known = True
        return self._levels

    def _levels_at(self, hand: str) -> dict[str, NDArray[np.float64]]:
        """The level of each source at a hand, by band (n_bands,) [-]."""
        levels = np.repeat(self._known_levels()[:, None], self._config.bands.n_bands, axis=1)
        if self._personal is not None and hand in self.hands:
            levels *= self._personal.shares[self.hands.index(hand)]
        return dict(zip(self._sources.ids, levels, strict=True))

    def _touch_gains(self, field: LiveField, counts: Counts) -> TouchGains:
        config = self._config
        return TouchGains(
            field,
            (len(self._sources.ids), config.bands.n_bands),
            self._fields.reach,
            counts,
            skips_unreachable=config.skips_unreachable,
            limit=None if config.gain_limit_db is None else 10 ** (config.gain_limit_db / 20),
        )
