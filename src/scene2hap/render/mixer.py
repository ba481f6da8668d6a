"""Gains and loops in, samples for every hand out.

Every change of gains is spread over a raised cosine, and changes that overlap add up:

    g(t) = g_0 + sum_j (g_j - g_{j-1}) r((t - t_j) / T)      r(x) = (1 - cos(pi x)) / 2 on [0, 1]

so that a mix is one matrix product of all pending gain steps with the loops, each step then weighed by its ramp.
A stepped gain would put sidebands into the tactile band; see Kaaresoja 2014 and Okamoto 2009 for the time budget.

Threads: `set_gains` (game) appends to a deque and `render` (audio) pops from it; neither waits for the other.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scene2hap.render.limiter import soft_limit
from scene2hap.render.loop_bank import LoopBank


@dataclass(frozen=True, eq=False)
class _Step:
    """From `start` on, the gains grow by `delta` (n_hands, n_rows)."""

    start: int
    delta: NDArray[np.float32]


class Mixer:
    """The running mix of `n_hands` outputs.

    Parameters: ramp_frames : frames over which a gain change is spread, >= 1.
    """

    def __init__(self, bank: LoopBank, n_hands: int, ramp_frames: int) -> None:
        self._bank = bank
        self._n_hands = n_hands
        self._ramp_frames = ramp_frames
        self._incoming: deque[tuple[int, NDArray[np.float32]]] = deque()
        self._target = np.zeros((n_hands, bank.n_rows), dtype=np.float32)
        self._settled = self._target
        self._steps: list[_Step] = []
        self._position = 0

    @property
    def position(self) -> int:
        """The frame that the next `render` begins with."""
        return self._position

    def set_gains(self, gains: NDArray[np.float32], at_frame: int) -> None:
        """Move to gains (n_hands, n_rows) from a frame on; frames in the past count as the next one."""
        self._incoming.append((at_frame, gains))

    def render(self, n_frames: int) -> NDArray[np.float32]:
        """The next samples (n_frames, n_hands) float32 in [-1, 1]."""
        begin, end = self._position, self._position + n_frames
        while self._incoming and self._incoming[0][0] < end:
            at_frame, gains = self._incoming.popleft()
            self._steps.append(_Step(max(at_frame, begin), gains - self._target))
            self._target = gains
        mix = self._mix(self._bank.read(begin, n_frames), begin)
        self._settle(end)
        self._position = end
        return soft_limit(mix).T

    def _mix(self, loops: NDArray[np.float32], begin: int) -> NDArray[np.float32]:
        n_frames = loops.shape[1]
        if not self._steps and not self._settled.any():
            return np.zeros((self._n_hands, n_frames), dtype=np.float32)
        gains = np.concatenate([self._settled, *(step.delta for step in self._steps)])
        parts = (gains @ loops).reshape(len(self._steps) + 1, self._n_hands, n_frames)
        mix: NDArray[np.float32] = parts[0].copy()
        frames = np.arange(begin, begin + n_frames)
        for step, part in zip(self._steps, parts[1:], strict=True):
            phase = np.clip((frames - step.start + 1) / self._ramp_frames, 0.0, 1.0)
            mix += part * (0.5 - 0.5 * np.cos(math.pi * phase)).astype(np.float32)
        return mix

    def _settle(self, end: int) -> None:
        """Fold in the steps whose ramps have ended."""
        running = [step for step in self._steps if step.start + self._ramp_frames > end]
        if not running:
            # The sum of all steps, without the rounding of adding them up.
            self._settled = self._target
        elif len(running) < len(self._steps):
            ended = [step.delta for step in self._steps if step.start + self._ramp_frames <= end]
            self._settled = self._settled + np.sum(ended, axis=0, dtype=np.float32)
        self._steps = running
