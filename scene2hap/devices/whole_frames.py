"""Times as whole numbers of frames. A 90 Hz game needs 533.3 frames of 48 kHz at a time, and 48,000 a second."""

from __future__ import annotations

from abc import ABC, abstractmethod

from scene2hap.common import checks
from scene2hap.devices.protocol import Block
from scene2hap.errors import SessionError

MAX_RENDERED_FRAMES = 1 << 26
"""Most frames of one call: 23 minutes at 48 kHz, half a gigabyte for two hands. A longer time is probably a number of
samples or of milliseconds."""


class WholeFrames:
    """Converter of times [s] to numbers of frames. The remainder, at most half a frame, is added to the next time."""

    def __init__(self, rate_hz: int) -> None:
        self._rate_hz, self._carried = rate_hz, 0.0

    def of(self, seconds: float) -> int:
        """Return the frames that are due after another `seconds` [s].

        Raises: SessionError: no time, or one of more than `MAX_RENDERED_FRAMES`.
        """
        longest_s = MAX_RENDERED_FRAMES // self._rate_hz
        hint = "Give seconds, as 1 / 90 for a frame at 90 Hz; `render` and `pull` take a number of samples."
        time_s = checks.number("seconds", seconds, "s", at_least=0.0, at_most=longest_s, error=SessionError, hint=hint)
        due = time_s * self._rate_hz + self._carried
        n_frames = max(0, round(due))
        self._carried = due - n_frames
        return n_frames


class PulledSink(ABC):
    """A sink without a clock of its own, which is pulled by frames or by time; `open` sets `_whole`."""

    _whole: WholeFrames | None = None

    @abstractmethod
    def pull(self, n_frames: int) -> Block:
        """Request the next frames."""

    def pull_s(self, seconds: float) -> Block:
        """Request the next `seconds` [s]. Fractions of a frame are carried: the sum over calls is exact to a sample."""
        return self.pull(self._whole.of(seconds) if self._whole is not None else 0)
