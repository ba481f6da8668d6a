"""Audio clips: sounds in memory, with their credits."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, overload

import numpy as np
from numpy.typing import ArrayLike

from scene2hap.common import checks
from scene2hap.common.arrays import Floats32, floats
from scene2hap.common.calls import clear_construction
from scene2hap.errors import AudioError

if TYPE_CHECKING:
    from matplotlib.figure import Figure, SubFigure

Samples = Floats32


@clear_construction
@dataclass(frozen=True)
class Credit:
    """The author, licence and origin of a sound; written next to the haptics.

    `query` is the search, `origin` the kind of source that answered ("freesound", "library", ...).
    """

    title: str
    author: str
    licence: str
    address: str = ""
    query: str = ""
    origin: str = ""

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            checks.text(f"{name} of a credit", value, error=AudioError)


MAX_SAMPLE_RATE_HZ = 1_000_000
"""Highest sample rate [Hz] (assumed: no recorder samples faster). It bounds the lengths of filters and seams."""


@clear_construction
@dataclass(frozen=True, eq=False)
class AudioClip:
    """A mono sound: float32 samples (n_samples,), nominally in [-1, 1].

    `is_vibration` marks a vibration signal, such as a hand-made haptic clip: it is looped whole and not converted.
    `loop` are the samples [first, end) that a person has marked as its loop; None if a seam is to be found.
    Clips are equal if all of this is equal, sample by sample.
    Raises: AudioError: no samples, a value that is not finite, a sample rate outside of 1 to `MAX_SAMPLE_RATE_HZ`, or a
    loop outside of the samples.
    """

    samples: Samples
    sample_rate_hz: int
    credit: Credit = field(default_factory=lambda: Credit("untitled", "unknown", "unknown"))
    is_vibration: bool = False
    loop: tuple[int, int] | None = None

    if TYPE_CHECKING:

        def __init__(
            self,
            samples: ArrayLike,
            sample_rate_hz: int,
            credit: Credit = ...,
            is_vibration: bool = False,
            loop: tuple[int, int] | None = None,
        ) -> None: ...

    def __post_init__(self) -> None:
        most_hz = MAX_SAMPLE_RATE_HZ
        rate = checks.whole("sample_rate_hz", self.sample_rate_hz, "Hz", at_least=1, at_most=most_hz, error=AudioError)
        # Frozen samples are shared, not copied: one recording may serve many sources.
        samples = self.samples if _is_frozen(self.samples) else _as_float32(self.samples)
        if samples.ndim != 1:
            raise AudioError(f"samples has shape {samples.shape}; a clip is mono, (n_samples,). Mix channels first.")
        if samples.size == 0:
            raise AudioError(f"{self.credit.title!r} has no samples; use a sound that is longer than 0 s.")
        if not np.isfinite(samples).all():
            first = int(np.argmin(np.isfinite(samples)))
            raise AudioError(f"{self.credit.title!r}: sample {first} is {samples[first]}; every sample must be finite.")
        if self.loop is not None:
            edges = checks.items("loop", self.loop, error=AudioError)
            if len(edges) != 2:
                raise AudioError(f"loop is {checks.represented(self.loop)}; it must be its first sample and its end.")
            n = len(samples)
            end = checks.whole("end of the loop", edges[1], "samples", at_least=1, at_most=n, error=AudioError)
            first = checks.whole(
                "first sample of the loop", edges[0], "samples", at_least=0, at_most=end - 1, error=AudioError
            )
            object.__setattr__(self, "loop", (first, end))
        samples.flags.writeable = False
        object.__setattr__(self, "samples", samples)
        object.__setattr__(self, "sample_rate_hz", rate)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, AudioClip):
            return NotImplemented
        return self is other or (self._about == other._about and np.array_equal(self.samples, other.samples))

    def __hash__(self) -> int:
        return hash(self._about)  # Hashing all samples would take milliseconds.

    @property
    def _about(self) -> tuple[object, ...]:
        return len(self.samples), self.sample_rate_hz, self.credit, self.is_vibration, self.loop

    def __repr__(self) -> str:
        return f"AudioClip({self.credit.title!r}, {self.duration_s:.3g} s, {self.sample_rate_hz} Hz)"

    @property
    def duration_s(self) -> float:
        """Length [s]."""
        return len(self.samples) / self.sample_rate_hz

    def part(self, first: int, end: int) -> AudioClip:
        """Return the samples [first, end), with the part of the loop that lies in them, if any."""
        low, high = (min(max(edge, first), end) - first for edge in self.loop or (0, 0))
        return replace(self, samples=self.samples[first:end], loop=(low, high) if low < high else None)

    @overload
    def plot(self, *, title: str | None = None, figure: None = None) -> Figure: ...
    @overload
    def plot(self, *, title: str | None = None, figure: Figure | SubFigure) -> Figure | SubFigure: ...
    def plot(self, *, title: str | None = None, figure: Figure | SubFigure | None = None) -> Figure | SubFigure:
        """Draw the waveform [full scale] over the spectrogram, and the spectrum with the threshold of touch [dB].

        Parameters: title : the title of the sound if None; figure : an empty matplotlib figure to draw into, such as
        one of `Figure.subfigures`; None for a new one.
        Returns: the figure, made without pyplot. Raises: MissingExtra: matplotlib is not installed.
        """
        from scene2hap.audio.plots import plot_clip  # by need: the extra `plots`

        title = self.credit.title if title is None else title
        return plot_clip(self.samples, self.sample_rate_hz, title, is_felt=self.is_vibration, figure=figure)


def _is_frozen(samples: object) -> bool:
    """Return True if an array is read-only and owns its samples, so that no other array can change them."""
    return (
        isinstance(samples, np.ndarray)
        and samples.dtype == np.float32
        and samples.base is None
        and not samples.flags.writeable
    )


def _as_float32(samples: object) -> Samples:
    """Return a copy as float32; too large values become infinite. Raises: AudioError: they are not numbers, or they are
    whole numbers of a file, such as 16384 of int16."""
    table = floats("samples", samples, "-", error=AudioError)
    kind = samples.dtype if isinstance(samples, np.ndarray) else None
    if kind is not None and kind.kind in "iu" and table.size and max(table.max(), -table.min()) > 1.0:
        how = f"samples / {2 ** (8 * kind.itemsize - 1)}" if kind.kind == "i" else "(samples - 128) / 128"
        raise AudioError(f"samples are {kind}; they must be floats with a full scale of 1, such as {how}.")
    with np.errstate(over="ignore"):
        return np.array(table, dtype=np.float32)
