"""Latency from the request for a signal to its recording at an input: by a cable, or a sound server's monitor.

A sink reports the latency that its driver states. A loop-back measures the whole latency, with parts that the driver
does not report.

    with Recorder(find_input(None), 48000, 2) as recorder:
        ...                                     # play the pattern, and note when its first samples are requested
    measure_latency(recorder.recording(), requested_at_s, pattern).latency_s

The time of a frame is that at which the driver delivered its block. Drivers also report the time at the converter, but
not reliably: PulseAudio behind ALSA reports times up to 15 ms after the delivery of the block.
"""

from __future__ import annotations

import math
import re
import time
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from scene2hap.devices import portaudio
from scene2hap.devices.portaudio import Card
from scene2hap.errors import DeviceError, DeviceNotFound

FOUND_FROM = 0.3
"""Least correlation of a found pattern [-]; other sounds may then be 10 dB louder.

The sweep of `scene2hap doctor` (2 s, 40 to 400 Hz) reaches 0.12 in noise of its own band and 0.06 in mains hum.
"""

LONGEST_S = 1.0
"""Latest arrival that is searched for [s]."""

BLOCK_FRAMES = 256

_LOOP_BACKS = re.compile(r"loop.?back|monitor|stereo.?mix", re.IGNORECASE)
_NEAR_S = 0.25

_SILENT = 1e-9
"""Least energy of a stretch relative to the loudest one. Below it there are only rounding errors."""


@dataclass(frozen=True)
class CorrelationPeak:
    """The best match of a pattern in a recording: first frame, correlation [-1, 1], and gain of the recording."""

    frame: int
    correlation: float
    gain: float


@dataclass(frozen=True)
class Recording:
    """A recording from an input.

    `samples` (n_frames, n_channels) float32; `handed_over_s` (n_blocks,), the delivery times of blocks [s, on
    `time.monotonic`]; `n_heard` (n_blocks,), the number of frames received by then; `block_s`, the length of a block;
    `gaps`, the number of times that the driver reported lost frames.
    """

    device: str
    rate_hz: int
    samples: NDArray[np.float32]
    handed_over_s: NDArray[np.float64]
    n_heard: NDArray[np.int64]
    block_s: float
    gaps: int = 0

    def time_of(self, frame: int) -> float:
        """Return the latest time at which a frame had arrived [s, monotonic]; it may have arrived one block earlier."""
        near = _near((self.n_heard - frame) / self.rate_hz)
        # Blocks are delivered late, never early, so the earliest time that any block allows is the best estimate.
        return float(np.min((self.handed_over_s - (self.n_heard - frame) / self.rate_hz)[near]))

    def frame_at(self, time_s: float) -> int:
        """Return the frame that arrived at a time [s, monotonic]; the first or the last outside of the recording."""
        near = _near(self.handed_over_s - time_s)
        frame = math.floor(np.max((self.n_heard - (self.handed_over_s - time_s) * self.rate_hz)[near]))
        return min(max(frame, 0), len(self.samples))


def _near(apart_s: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return a mask of the nearby blocks, which give the time of a frame. Farther blocks may be behind a gap."""
    apart_s = np.abs(apart_s)
    return np.asarray(apart_s <= max(_NEAR_S, float(apart_s.min())))


@dataclass(frozen=True)
class Latency:
    """The latency of a pattern at an input after its request.

    `latency_s` is None if no correlation reaches `FOUND_FROM`. It may be too long by `uncertainty_s`, a recorded block.
    `channel` is the input's, from 1; `gain_db` is from pattern to input. `correlation` in [-1, 1] is negative if a
    cable or the input inverts the signal.
    """

    latency_s: float | None
    uncertainty_s: float
    correlation: float
    channel: int
    gain_db: float | None


def correlation_peak(heard: NDArray[np.floating], pattern: NDArray[np.floating]) -> CorrelationPeak:
    """Search a pattern in a recording, at any level and polarity.

        r[k] = sum_i x[k + i] p[i] / (|p| sqrt(sum_i x[k + i]^2)), at the k of the largest |r|

    Parameters: heard : (n,); pattern : (m,), not all zero.
    Returns: the highest peak; frame 0 and correlation 0 if n < m or the recording is silent.
    Source: normalised cross-correlation, e.g. Lewis 1995, Fast Template Matching.
    """
    x, p = np.asarray(heard, dtype=np.float64), np.asarray(pattern, dtype=np.float64)
    if len(x) < len(p) or not x.any():
        return CorrelationPeak(0, 0.0, 0.0)
    n = 1 << (len(x) - 1).bit_length()  # this wraps around only at lags that are cut off
    products = np.fft.irfft(np.fft.rfft(x, n) * np.conj(np.fft.rfft(p, n)), n)[: len(x) - len(p) + 1]
    sums = np.concatenate([[0.0], np.cumsum(x**2)])
    energy = sums[len(p) :] - sums[: -len(p)]
    own = float(p @ p)
    r = products / np.sqrt(own * np.maximum(energy, _SILENT * energy.max()))
    frame = int(np.argmax(np.abs(r)))
    return CorrelationPeak(frame, float(np.clip(r[frame], -1.0, 1.0)), float(abs(products[frame])) / own)


def measure_latency(recording: Recording, requested_at_s: float, pattern: NDArray[np.floating]) -> Latency:
    """Search a pattern (m,) with the recording's rate on every channel, from the time [s] of its request."""
    margin = round(recording.block_s * recording.rate_hz)
    begin = max(0, recording.frame_at(requested_at_s) - margin)
    end = begin + len(pattern) + round(LONGEST_S * recording.rate_hz) + 2 * margin
    peaks = [correlation_peak(channel, pattern) for channel in recording.samples[begin:end].T]
    best = max(range(len(peaks)), key=lambda index: abs(peaks[index].correlation))
    peak = peaks[best]
    if abs(peak.correlation) < FOUND_FROM:
        return Latency(None, recording.block_s, peak.correlation, best + 1, None)
    latency_s = recording.time_of(begin + peak.frame) - requested_at_s
    return Latency(latency_s, recording.block_s, peak.correlation, best + 1, 20 * math.log10(peak.gain))


def find_input(device: str | int | None) -> Card:
    """Return the input with an index, or with a name that is or contains `device`; None for a probable loop-back.

    If no input looks like one, None gives the system's default, which may be the monitor of a sound server.
    Raises: DeviceNotFound; MissingExtra; DeviceError: there is no PortAudio.
    """
    portaudio.restart_if_idle()
    known = portaudio.inputs()
    found = _match(device, known)
    if found is None:
        wanted = "no default input" if device is None else f"no input {device!r}"
        raise DeviceNotFound(f"{wanted} among the sound cards. Known: {'; '.join(map(str, known)) or 'none'}.")
    return found


class Recorder:
    """A context manager that records an input.

    Parameters: card : from `find_input`; rate_hz : requested rate, if impossible the card's own is used; n_channels :
        requested number, limited to the card's.
    Raises: DeviceError: the input cannot be opened.
    """

    def __init__(self, card: Card, rate_hz: int, n_channels: int) -> None:
        self._card = card
        self._rate_hz = rate_hz
        self._n_channels = min(n_channels, card.n_channels)
        self._blocks: list[tuple[float, NDArray[np.float32]]] = []
        self._block_s = 0.0
        self._gaps = 0
        self._stream: Any = None

    def __enter__(self) -> Self:
        self._stream, self._rate_hz = portaudio.open_recording(
            self._card, self._n_channels, self._rate_hz, BLOCK_FRAMES, self._hear
        )
        self._block_s = max(BLOCK_FRAMES / self._rate_hz, float(self._stream.latency))
        return self

    def __exit__(self, *_: object) -> None:
        stream, self._stream = self._stream, None
        portaudio.close_stream(stream)

    def recording(self) -> Recording:
        """Return the recording so far. Raises: DeviceError: no block has arrived."""
        blocks = list(self._blocks)
        if not blocks:
            raise DeviceError(f"input {self._card.name!r} gave no samples; try another with --loop-back INPUT.")
        return Recording(
            device=self._card.name,
            rate_hz=self._rate_hz,
            samples=np.concatenate([block for _, block in blocks]),
            handed_over_s=np.array([at_s for at_s, _ in blocks]),
            n_heard=np.cumsum([len(block) for _, block in blocks]),
            block_s=self._block_s,
            gaps=self._gaps,
        )

    def _hear(self, block: NDArray[np.float32], n_frames: int, when: Any, status: Any) -> None:
        self._blocks.append((time.monotonic(), block.copy()))
        if status.input_overflow:
            self._gaps += 1


def _match(device: str | int | None, known: list[Card]) -> Card | None:
    if device is not None:
        return portaudio.named(device, known)
    loop_backs = [card for card in known if _LOOP_BACKS.search(card.name)]
    return loop_backs[0] if loop_backs else portaudio.named(portaudio.default_input(), known)
