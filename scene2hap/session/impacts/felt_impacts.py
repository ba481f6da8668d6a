"""Impacts: a strike or a landing is felt once by each hand that it reaches.

    impact ── propagation.impact ──► Burst (decaying sines) ── model in use ──► at each hand ──► the mix

Bounds: a pair of objects strikes at most once in `LEAST_INTERVAL_S`, and no impact is added while `MOST_PLAYING` bursts
play. At the struck point the peak is at most `PEAK`, as for a source of full intensity. Nothing is computed for
an impact that no hand could feel.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Collection, Mapping
from concurrent.futures import Future, wait
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from scene2hap.audio.actuator_range import nearest_felt_hz
from scene2hap.audio.actuators import is_flat
from scene2hap.audio.levels import TACTILE_HEADROOM_DB, drive_db
from scene2hap.audio.threshold import NOTICED_DB, TACTILE_RANGE_HZ, threshold_db
from scene2hap.common.arrays import Floats
from scene2hap.common.calls import clear_attributes
from scene2hap.common.deadline import Deadline
from scene2hap.common.worker_threads import WorkerPool
from scene2hap.propagation.impact import Burst, burst_of
from scene2hap.propagation.live import PointField, TouchedPoint
from scene2hap.render.bursts import LEAST_SUM, Samples, peak_of, wave_of
from scene2hap.scene.pose import Pose
from scene2hap.session.config import SessionConfig
from scene2hap.session.frame import TouchesByHand
from scene2hap.session.impacts.gains import Point, struck_later, struck_live
from scene2hap.session.impacts.landings import Landings
from scene2hap.session.mix.playback import Playback
from scene2hap.session.mix.sources import Level
from scene2hap.session.present_scene.scene_state import SceneState
from scene2hap.session.user_profile import UserProfile

if TYPE_CHECKING:
    from scene2hap.session.impacts.preparation import ImpactPreparation

PEAK = 10 ** (-TACTILE_HEADROOM_DB / 20)
LOUDEST_M_S2 = 1000.0
"""Acceleration from which on an impact has full strength: that of a cup put down on a steel sheet. Below it, the level
falls by 1 dB for 2 (2:1, usual from sound to touch after Merchel and Altinsoy). A finger and a fallen chair are 80 dB
apart, and an actuator has 40."""
LEAST_INTERVAL_S = 0.03
"""Impacts between the same two objects within this time count as one; assumed: most bursts last as long."""
LEAST_GAIN = 10 ** (-60 / 20)
"""Gain below which an impact is not mixed at a hand: full scale is 45 dB over the threshold."""
MOST_PLAYING = 32
"""Bursts with which no further impact is added. None that plays is ended for another, since that would click."""
MOST_WAITING = 4
"""Most impacts that may wait for a worker."""
LATEST_S = 0.3
"""Longest delay of an impact [s]; assumed: a later one would feel like another impact."""
KEPT = 64
KNOCK_M_S = 0.5
"""Speed of a finger that knocks; assumed."""


@clear_attributes
@dataclass(frozen=True, eq=False)
class Impact:
    """One impact: which objects met, where and how fast, and how strongly each hand feels it.

    Parameters: object_id : the struck object; point_m : the struck point [m], world; with_object : the striking object,
    None if unknown; speed_m_s : at which they met, None if an impulse was given; frequency_hz : of the strongest
    component, also if the actuator plays it at another; at_sample : its time on the clock of `render`; felt : the
    largest sample that the impact adds at each hand [-], without hands that feel nothing. If a worker prepares the
    gains, a later `update` or `wait_prepared` fills in `felt`.
    """

    object_id: str
    point_m: Point
    with_object: str | None
    speed_m_s: float | None
    frequency_hz: float
    at_sample: int
    felt: dict[str, float] = field(default_factory=dict)

    def __str__(self) -> str:
        by = f" by {self.with_object}" if self.with_object is not None else ""
        fast = f" at {self.speed_m_s:.2f} m/s" if self.speed_m_s is not None else ""
        return f"{self.object_id} struck{by}{fast}, {self.frequency_hz:.0f} Hz"


@dataclass(frozen=True)
class Strike:
    """One strike: the struck object, the point, the striking object, and the speed; see `Impact`."""

    object_id: str
    point_m: Point
    with_object: str | None = None
    speed_m_s: float | None = None
    impulse_n_s: float | None = None


@dataclass(frozen=True)
class _Report:
    """The first report of an impact. `is_settled` is true if it was played, or left out."""

    at_frame: int
    is_settled: bool


class Impacts:
    """Finds landings, and turns impacts into bursts of a session's mix.

    Threads: call all methods on the game's thread. A worker that has prepared the gains of an impact starts its burst,
    which need not wait for an update. `take_late` records these impacts.
    Parameters: field : returns the field in use; level : of all vibration.
    """

    def __init__(
        self,
        config: SessionConfig,
        state: SceneState,
        playback: Playback,
        field: Callable[[], object],
        level: Level,
    ) -> None:
        self._config, self._state, self._playback = config, state, playback
        self._field, self._level = field, level
        self._profile: UserProfile | None = None
        self._landings = Landings(state, config.control_period_s) if config.impacts else None
        self._last: dict[frozenset[str | None], _Report] = {}
        self._updated_at = 0
        self._looked_at: object = None
        self._point_field: PointField | None = None
        # Several workers, since preparing a scene in advance, or for an impact, may take longer than another impact may
        # wait.
        self._workers = WorkerPool(3, "impacts")
        self._waiting: list[tuple[Impact, Future[dict[str, float] | None]]] = []
        self._ahead = self._prepared_ahead() if config.prepares_impacts else None
        self._recent: deque[Impact] = deque(maxlen=KEPT)
        self.n_reported: int = 0
        self.n_felt: int = 0
        self.n_left_out: int = 0

    def use_profile(self, profile: UserProfile) -> None:
        """Use the levels of another person for impacts from now on."""
        self._profile = None if profile.is_neutral else profile

    def strike(self, strike: Strike, touches: TouchesByHand, at_frame: int) -> Impact:
        """Play an impact at the hands that touch something."""
        self.take_late()
        impact, burst = self._impact(strike, at_frame)
        if self._is_admitted(strike, touches, at_frame):
            self._play(impact, burst, touches)
        return impact

    def forget_motions(self) -> None:
        """Forget how objects moved up to now, see `Landings.forget`."""
        if self._landings is not None:
            self._landings.forget()

    def begin(self, moved: Mapping[str, Pose], at_frame: int) -> None:
        """Look at the objects that an update is about to move. Call it before the contacts change."""
        if self._landings is not None:
            self._landings.begin(moved, at_frame / self._config.sample_rate_hz)

    def follow(self, moved: Mapping[str, Pose] | None, touches: TouchesByHand, at_frame: int) -> None:
        """Play the landings of an update, and prepare for impacts around the touched objects. Call it in each one."""
        self.take_late()
        if self._landings is not None:
            for one in self._landings.look(moved or {}, at_frame / self._config.sample_rate_hz):
                landing = Strike(one.onto, one.point_m, one.object_id, one.speed_m_s)
                # Checked first, so that nothing is computed for a skipped impact.
                if self._is_admitted(landing, touches, at_frame, self._updated_at):
                    self._play(*self._impact(landing, at_frame), touches)
        self._updated_at = at_frame
        if self._ahead is not None:
            self._ahead.expect({touch.object_id for each in touches.values() for touch in each})

    def _impact(self, strike: Strike, at_frame: int) -> tuple[Impact, Burst]:
        struck = self._state.meeting(strike.object_id)
        striker = None if strike.with_object is None else self._state.meeting(strike.with_object)
        burst = burst_of(
            struck,
            self._state.on_plate(strike.object_id, strike.point_m),
            striker,
            speed_m_s=strike.speed_m_s or 0.0,
            impulse_n_s=strike.impulse_n_s,
            is_finger=strike.with_object is None,
        )
        strongest = float(burst.frequencies_hz[int(np.argmax(burst.accelerations_m_s2))])
        return (
            Impact(strike.object_id, strike.point_m, strike.with_object, strike.speed_m_s, strongest, at_frame),
            burst,
        )

    def _play(self, impact: Impact, burst: Burst, touches: TouchesByHand) -> None:
        at_frame, f, profile = impact.at_sample, burst.frequencies_hz, self._profile
        # A hand may be removed before a worker has the gains, and has another output if it is added again.
        outputs = self._playback.outputs
        touched: dict[str, list[TouchedPoint]] = {
            hand: [(x.object_id, x.point_m) for x in each] for hand, each in touches.items() if hand in outputs
        }

        def started(gains: Floats, begin: int, among: Collection[str]) -> dict[str, float]:
            """Start the burst, in any thread; return the largest sample at each hand that feels it."""
            # Most impacts of a busy scene are too far from every hand.
            if not len(gains) or (gains * self._most(burst, profile)).max() < LEAST_GAIN:
                return {}
            waves, levels = self._levels(burst, [*among], profile)
            weights = levels * self._capped(gains)
            felt = {hand: row for hand, row in zip(among, weights, strict=True) if row.max() >= LEAST_GAIN}
            by_output = {outputs[hand]: row.tolist() for hand, row in felt.items()}
            if not felt or not self._playback.start_burst(waves, by_output, begin):
                return {}
            # The mix ends at full scale, whatever levels were set.
            return {hand: min(1.0, self._peak(waves, row, burst.decays_s)) for hand, row in felt.items()}

        live = self._live()
        if live is not None:
            objects, hands_on = (impact.object_id, impact.with_object), [*touched.values()]
            gains = struck_live(live, *objects, impact.point_m, hands_on, f)
            self._record(impact, started(gains, at_frame, touched))
            return
        left = touched
        if self._ahead is not None:
            answer = self._ahead.answer(impact.object_id, impact.point_m, touched, f)
            if answer is not None:
                self._record(impact, started(answer.gains, at_frame, answer.among))
                left = {hand: its for hand, its in touched.items() if hand not in answer.among}
        if left:
            model, hands_left = self._config.propagation, [*left.values()]
            prepared = struck_later(model, self._state, impact.object_id, impact.point_m, hands_left, f)
            if self._config.prepare == "blocking":
                self._record(impact, started(prepared(), at_frame, left))
            else:
                self._order(impact, prepared, lambda gains, begin: started(gains, begin, left))

    def _live(self) -> PointField | None:
        """The field in use if it is a `PointField`. Cached, since this check takes as long as a faint impact."""
        field_in_use = self._field()
        if field_in_use is not self._looked_at:
            self._looked_at = field_in_use
            self._point_field = field_in_use if isinstance(field_in_use, PointField) else None
        return self._point_field

    def felt_by(self, hand: str) -> tuple[Impact, ...]:
        """The impacts of the last second that a hand felt, the latest first."""
        return tuple(one for one in self.recent() if hand in one.felt)

    def recent(self) -> tuple[Impact, ...]:
        """The impacts of the last second that any hand felt, the latest first."""
        self.take_late()
        since = self._playback.clock.position - self._config.sample_rate_hz
        return tuple(one for one in reversed(self._recent) if one.at_sample >= since)

    def wait(self, end: Deadline) -> bool:
        """Wait for all results of the workers; false after the deadline."""
        are_done = not wait([job for _, job in self._waiting], end.left_s).not_done
        self.take_late()
        return are_done and (self._ahead is None or self._ahead.wait(end))

    def take_late(self) -> None:
        """Record the impacts that workers have finished."""
        for impact, job in [one for one in self._waiting if one[1].done()]:
            self._waiting.remove((impact, job))
            felt = job.result()
            if felt is None:
                self.n_left_out += 1
            else:
                self._record(impact, felt)

    def _most(self, burst: Burst, profile: UserProfile | None) -> Floats | float:
        """Upper bound of `_levels` [-]: of each sine (n,) if the actuator plays all equally well, else of all."""
        actuator, (low_hz, high_hz) = self._config.actuator, TACTILE_RANGE_HZ
        strongest = PEAK / LEAST_SUM * self._strength(burst)
        if profile is not None:
            strongest *= 10 ** (profile.most_level_db / 20)
        is_whole = actuator.min_frequency_hz <= low_hz and actuator.max_frequency_hz >= high_hz
        if not is_whole or not is_flat(actuator):
            return strongest
        accelerations = burst.accelerations_m_s2
        most: Floats = strongest / accelerations.max() * (accelerations * (burst.frequencies_hz >= low_hz))
        return most

    def _strength(self, burst: Burst) -> float:
        """Level of a burst relative to that of full strength [-]."""
        return min(1.0, math.sqrt(burst.accelerations_m_s2.sum() / LOUDEST_M_S2)) * self._level.factor

    def _levels(self, burst: Burst, hands: list[str], profile: UserProfile | None) -> tuple[list[Samples], Floats]:
        """Wave of each sine, and its amplitude (n_hands, n) [-] at each of these hands if it touched the struck point.

        A sine is felt as strongly as on a flat actuator, or as strongly as the actuator can.
        """
        actuator, f, decays_s = self._config.actuator, burst.frequencies_hz, burst.decays_s
        accelerations, waves = burst.accelerations_m_s2, self._waves(f, decays_s)
        drives = accelerations / self._peak(waves, accelerations, decays_s) * PEAK
        felt_db = 20 * np.log10(drives) - threshold_db(f)
        played_hz = nearest_felt_hz(f, felt_db, actuator, -TACTILE_HEADROOM_DB, NOTICED_DB)
        if played_hz is not f or not is_flat(actuator):
            waves = self._waves(played_hz, decays_s)
            drives = 10 ** (drive_db(played_hz, felt_db, actuator) / 20)
            drives *= min(1.0, PEAK / self._peak(waves, drives, decays_s))
        # Too slow to be felt as vibration, wherever it is played.
        drives[f < TACTILE_RANGE_HZ[0]] = 0.0
        # Applied last, so that an actuator's bounds take the same from strong and weak impacts.
        drives *= self._strength(burst)
        if profile is None:
            return waves, drives[None].repeat(len(hands), axis=0)
        return waves, drives * [10 ** (profile.level_db(hand, actuator.name, played_hz) / 20) for hand in hands]

    def _waves(self, frequencies_hz: Floats, decays_s: Floats) -> list[Samples]:
        rate_hz = self._config.sample_rate_hz
        components = zip(frequencies_hz.tolist(), decays_s.tolist(), strict=True)
        return [wave_of(f, decay, rate_hz) for f, decay in components]

    def _peak(self, waves: list[Samples], weights: Floats, decays_s: Floats) -> float:
        return peak_of(waves, weights, decays_s, self._config.sample_rate_hz)

    def _is_admitted(self, strike: Strike, touches: TouchesByHand, at_frame: int, since: float = math.inf) -> bool:
        """Whether an impact may be felt. Counts it, unless it is another report of the last impact of its pair.

        An impact that nobody could feel may be reported again, since a hand may arrive in the same frame.
        Parameters: since : a report from then on is of the same impact; for a landing the update before, since a
        session often finds it one update after a game's physics does.
        """
        # Without an order, since a game may report "cup on table" and the session find "table on cup".
        pair = frozenset((strike.object_id, strike.with_object))
        last = self._last.pop(pair, None)
        soonest = LEAST_INTERVAL_S * self._config.sample_rate_hz
        if last is None or (at_frame - last.at_frame >= soonest and last.at_frame < since):
            self.n_reported += 1
            last = _Report(at_frame, is_settled=False)
        was_settled = last.is_settled
        may_be_felt = bool(touches) and not self._playback.is_paused and bool(self._level.factor)
        self._last[pair] = _Report(last.at_frame, is_settled=was_settled or may_be_felt)
        while len(self._last) > KEPT:
            del self._last[next(iter(self._last))]
        if was_settled or not may_be_felt:
            return False
        if self._playback.n_bursts >= MOST_PLAYING or len(self._waiting) >= MOST_WAITING:
            self.n_left_out += 1
            return False
        return True

    def _capped(self, gains: Floats) -> Floats:
        limit_db = self._config.gain_limit_db
        capped = np.fmax(gains, 0.0)
        return capped if limit_db is None else np.minimum(capped, 10 ** (limit_db / 20))

    def _record(self, impact: Impact, felt: Mapping[str, float]) -> None:
        # An impact may be felt by some hands at once, and by others later.
        if felt and not impact.felt:
            self._recent.append(impact)
            self.n_felt += 1
        impact.felt.update(felt)

    def _order(
        self, impact: Impact, prepared: Callable[[], Floats], started: Callable[[Floats, int], dict[str, float]]
    ) -> None:
        """Let a worker prepare the gains and start the burst, unless the burst is then more than `LATEST_S` late."""
        playback, latest = self._playback, impact.at_sample + round(LATEST_S * self._config.sample_rate_hz)

        def work() -> dict[str, float] | None:
            try:
                gains = prepared()
            except (Exception, SystemExit):  # the field in use fails in the same way, and warns
                return None
            begin = playback.clock.position
            return started(gains, begin) if begin <= latest else None

        self._waiting.append((impact, self._workers.submit(work)))

    def _prepared_ahead(self) -> ImpactPreparation:
        from scene2hap.session.impacts.preparation import ImpactPreparation  # by need: the physical models

        # No reference to this object: only the garbage collector could free such a cycle.
        return ImpactPreparation(self._config.propagation, self._state, self._workers.submit)
