"""The mix of a session with its bursts, which can be paused and held within limits.

Call `render` on the audio thread, `start_burst` on the game's or a worker, everything else on the game's. The audio
thread alone changes `clock.position` and `_frozen_at`. It reads the plan of the mixers, `_paused_from` and `_limits`,
and workers read the outputs; the game's thread replaces each of these as a whole. No thread waits for another.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from threading import Lock

import numpy as np
from numpy.typing import NDArray

from scene2hap.devices.protocol import Block
from scene2hap.render.bursts import HEARD_S, MOST_SUM, Bursts, Fade, PlannedBurst
from scene2hap.render.limiter import soft_limit_sum
from scene2hap.render.loop_bank import position_s
from scene2hap.session.mix.hand_limits import HandLimits
from scene2hap.session.mix.loop_mixers import Clock, LoopMixers, MixingPlan
from scene2hap.session.mix.sources import LoopRow


class Playback:
    """The mix of all loops and bursts, for all hands, on a clock that can be stopped."""

    def __init__(self, sample_rate_hz: int, mixers: LoopMixers, clock: Clock) -> None:
        self._rate_hz, self._mixers = sample_rate_hz, mixers
        self.clock: Clock = clock
        self._paused_from: int | None = None
        self._frozen_at: int | None = None
        self._bursts = Bursts(round(HEARD_S * sample_rate_hz))
        self._pausing = Lock()  # else a worker may start a burst after the fade, which would play on after the pause
        self._limits: HandLimits | None = None

    @property
    def is_paused(self) -> bool:
        """Whether the mix is paused: it fades, or has faded, to silence."""
        return self._paused_from is not None

    def position_s(self, row: LoopRow) -> float:
        """Position of a row in its loop [s]."""
        loop = row.loop.tactile
        return position_s(len(loop.samples), loop.sample_rate_hz, self.clock.position, self._rate_hz)

    @property
    def n_bursts(self) -> int:
        """Number of bursts that are playing, or planned."""
        return self._bursts.n_playing

    @property
    def outputs(self) -> Mapping[str, int]:
        """A token of each present hand's output, for `start_burst`; no later output has the same."""
        return self._mixers.outputs

    def start_burst(
        self, waves: Sequence[NDArray[np.float32]], weights: Mapping[int, Sequence[float]], at_frame: int
    ) -> bool:
        """Add weighted waves (n,) to some of the `outputs`, once, from a frame on. In a pause, return False instead."""
        with self._pausing:
            if self._paused_from is not None:
                return False
            self._bursts.start(PlannedBurst(at_frame, waves, weights))
            return True

    def pause(self) -> None:
        """Fade to silence, then stop the clock."""
        if self._paused_from is None:
            at_frame = self.clock.now
            self._mixers.silence(at_frame)
            with self._pausing:
                self._bursts.fade(Fade(at_frame, self._mixers.fade_frames))
                self._paused_from = at_frame

    def resume(self) -> None:
        """Continue the clock; gains must be set again."""
        self._paused_from = None

    def hold(self, limits: NDArray[np.float64]) -> None:
        """Hold each output within a limit (n_hands,) [-] in `render_held`, see `HandLimits`."""
        by_hand = dict(zip(self._mixers.outputs.values(), limits.tolist(), strict=True))
        if self._limits is None:
            # Limits that come while the mix plays begin at full scale, so that they do not click.
            first = {} if self.clock.position else by_hand
            self._limits = HandLimits(self._rate_hz, tuple(self._mixers.outputs.values()), first)
        self._limits.hold(by_hand)

    def render(self, n_frames: int) -> Block:
        """The next samples (n_frames, n_hands) float32 in [-1, 1]."""
        return self._rendered(self._mixers.plan, n_frames)

    def render_held(self, n_frames: int) -> Block:
        """The next samples as `render` gives them, each output within its limit, if any."""
        plan, limits = self._mixers.plan, self._limits
        mix = self._rendered(plan, n_frames)
        return mix if limits is None else limits.pass_through(mix, plan.hands)

    def _rendered(self, plan: MixingPlan, n_frames: int) -> Block:
        paused_from = self._paused_from
        if paused_from is None:
            self._frozen_at = None
            return self._render(plan, n_frames)
        if self._frozen_at is None:
            self._frozen_at = max(paused_from, self.clock.position) + self._mixers.fade_frames
        n_left = min(n_frames, max(0, self._frozen_at - self.clock.position))
        silence = np.zeros((n_frames - n_left, plan.n_channels), dtype=np.float32)
        return np.concatenate([self._render(plan, n_left), silence])

    def _render(self, plan: MixingPlan, n_frames: int) -> Block:
        mix = loops = plan.render(self.clock.position, n_frames)
        if not self._bursts.are_silent:
            total = loops.copy()
            self._bursts.add_to(total, self.clock.position, plan.hands)
            mix = soft_limit_sum(loops, total, MOST_SUM)
        self._bursts.hear(loops, plan.hands)
        self.clock.position += n_frames
        return mix
