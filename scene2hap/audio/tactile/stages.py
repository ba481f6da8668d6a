"""Building blocks of converters: stages in float64, and the stream that feeds blocks to them.

A stage's output does not depend on the block size, bit for bit: recursive filters keep their state, oscillators are
looked up by sample number in tables of a fixed size, and sums have a fixed order.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence

import numpy as np

from scene2hap.audio.clip import Samples
from scene2hap.audio.tactile.sections import through_sections
from scene2hap.common.arrays import Floats
from scene2hap.errors import AudioError

_CACHED = 65_536
"""Samples per pass: passes that fit the processor's cache are twice as fast as one pass over a long sound."""


class Stage(ABC):
    """One step of a conversion."""

    @abstractmethod
    def run(self, x: Floats) -> Floats:
        """Return the next samples (n,); a stage with latency holds some back."""

    def rest(self) -> Floats:
        """Return the samples that were held back; none without latency."""
        return np.empty(0)


class StageStream:
    """A `TactileStream` over stages in series, which checks its input and clips its output.

    `n_clipped` counts the samples that were clipped to full scale.
    """

    def __init__(self, *stages: Stage) -> None:
        self.stages = stages
        self._chain = Chain(stages)
        self.n_clipped: int = 0

    def process(self, block: Samples) -> Samples:
        """Return the next samples; computed in float64. Raises: AudioError: not finite, or not one channel."""
        x = np.asarray(block)
        if x.ndim != 1:
            raise AudioError(f"block has shape {x.shape}; a stream converts one channel, (n,). Use a stream for each.")
        if not np.isfinite(x).all():
            first = int(np.argmin(np.isfinite(x)))
            raise AudioError(f"sample {first} of the block is {x[first]}; every sample must be finite. Mend the sound.")
        passes = (x[at : at + _CACHED].astype(np.float64) for at in range(0, len(x), _CACHED))
        parts = [self._clipped(self._chain.run(one)) for one in passes]
        if not parts:
            return np.empty(0, dtype=np.float32)
        return parts[0] if len(parts) == 1 else np.concatenate(parts)

    def finish(self) -> Samples:
        """Return the samples that are still held back."""
        return self._clipped(self._chain.rest())

    def _clipped(self, x: Floats) -> Samples:
        if x.size and (size := np.abs(x)).max() > 1.0:
            self.n_clipped += int(np.count_nonzero(size > 1.0))
            x = np.clip(x, -1.0, 1.0)
        return x.astype(np.float32)


class Chain(Stage):
    """Stages in series, as one stage."""

    def __init__(self, stages: Sequence[Stage]) -> None:
        self.stages = stages

    def run(self, x: Floats) -> Floats:
        """Return the next samples; stages with latency hold some back."""
        for stage in self.stages:
            if x.size == 0:
                break
            x = stage.run(x)
        return x

    def rest(self) -> Floats:
        """Return the samples that all stages have held back."""
        left = np.empty(0)
        for stage in self.stages:
            left = np.concatenate([stage.run(left), stage.rest()]) if left.size else stage.rest()
        return left


class InStep(Stage):
    """A stage whose output comes some samples late, in step with its input: it holds as many samples back."""

    def __init__(self, stage: Stage, n_late: int) -> None:
        self._stage, self._n_late = stage, n_late
        self._n_dropped = 0

    def run(self, x: Floats) -> Floats:
        """Return as many samples as given, at first fewer."""
        y = self._stage.run(x)
        n = min(self._n_late - self._n_dropped, len(y))
        self._n_dropped += n
        return y[n:]

    def rest(self) -> Floats:
        """Return the samples that were held back, as if silence followed."""
        return self._stage.run(np.zeros(self._n_late))[self._n_late - self._n_dropped :]


class WholeSteps(Stage):
    """Holds samples back until a step of them is complete, and returns whole steps.

    Stages that decide by steps make nothing of less. Small blocks then cost them no calls.
    """

    def __init__(self, step: int) -> None:
        self._step = step
        self._held: list[Floats] = []
        self._n_held = 0

    def run(self, x: Floats) -> Floats:
        """Return the steps that are complete now."""
        self._held.append(x)
        self._n_held += len(x)
        if self._n_held < self._step:
            return x[:0]
        held = np.concatenate(self._held)
        self._n_held %= self._step
        n = len(held) - self._n_held
        self._held = [held[n:]]
        return held[:n]

    def rest(self) -> Floats:
        """Return the samples of the incomplete step."""
        return np.concatenate([np.empty(0), *self._held])


class SosStage(Stage):
    """A filter of second-order sections (n_sections, 6) with carried state."""

    def __init__(self, sections: Floats) -> None:
        self.sections = sections
        self.state: Floats = np.zeros((len(sections), 2))
        self._rows = self.state[:, None]  # as `through_sections` needs it

    def run(self, x: Floats) -> Floats:
        """Return as many samples as given."""
        if x.size == 0:
            return x
        y: Floats = through_sections(self.sections, x[None], self._rows)[0]
        return y


class Scaled(Stage):
    """A constant gain [-]."""

    def __init__(self, gain: float) -> None:
        self._gain = gain

    def run(self, x: Floats) -> Floats:
        """Return as many samples as given."""
        return self._gain * x
