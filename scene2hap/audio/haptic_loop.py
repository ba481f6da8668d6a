"""The audible and the tactile loop of one state."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, overload

from scene2hap.audio.clip import AudioClip
from scene2hap.audio.run_curve import RunCurve
from scene2hap.audio.sensation import Sensation
from scene2hap.common import checks
from scene2hap.common.calls import clear_construction
from scene2hap.errors import AudioError

if TYPE_CHECKING:
    from matplotlib.figure import Figure, SubFigure


@clear_construction
@dataclass(frozen=True)
class HapticLoop:
    """An audible and a tactile loop with the same seam, length and rate, so that they stay synchronous.

    `frequency_raw_hz` is the peak of the audible loop's spectrum, which the paper uses in its attenuation law;
    `frequency_tactile_hz` is the peak of the tactile one, after conversion, that is farthest over the threshold of
    touch; `felt.target_hz` is set to it.
    `source` is the sound before it was cut, None if unknown or for a person's own clip, which the bundle stores;
    `fingerprint` has a digest of each input of the loops, empty if unknown; `felt` is None if unknown.
    `start_up` and `wind_down` are the machine's start and stop in the recording, None if it has none.
    Raises: AudioError: lengths or rates differ, or a frequency is not positive.
    """

    audible: AudioClip
    tactile: AudioClip
    frequency_raw_hz: float
    frequency_tactile_hz: float
    source: AudioClip | None = None
    fingerprint: Mapping[str, str] = field(default_factory=dict, hash=False, repr=False)
    felt: Sensation | None = None
    start_up: RunCurve | None = None
    wind_down: RunCurve | None = None

    def __post_init__(self) -> None:
        for name in ("audible", "tactile"):
            if not isinstance(getattr(self, name), AudioClip):
                given = checks.described(getattr(self, name))
                raise AudioError(f"{name} is {given}; it must be an AudioClip, as AudioClip(samples, sample_rate_hz).")
        shapes = [(len(clip.samples), clip.sample_rate_hz) for clip in (self.audible, self.tactile)]
        if shapes[0] != shapes[1]:
            raise AudioError(
                f"the audible loop has {shapes[0][0]} samples at {shapes[0][1]} Hz, the tactile one {shapes[1][0]} at "
                f"{shapes[1][1]} Hz; both must be equal, or they drift apart. Cut both by the same seam."
            )
        for name in ("frequency_raw_hz", "frequency_tactile_hz"):
            object.__setattr__(self, name, checks.number(name, getattr(self, name), "Hz", above=0.0, error=AudioError))
        if self.felt is not None and self.felt.target_hz != self.frequency_tactile_hz:
            # Planned frequencies, and those of earlier bundles, are the middle of a melody's notes.
            object.__setattr__(self, "felt", self.felt.felt_at(self.frequency_tactile_hz))

    @overload
    def plot(self, *, title: str | None = None, figure: None = None) -> Figure: ...
    @overload
    def plot(self, *, title: str | None = None, figure: Figure | SubFigure) -> Figure | SubFigure: ...
    def plot(self, *, title: str | None = None, figure: Figure | SubFigure | None = None) -> Figure | SubFigure:
        """Draw the sound over the vibration [full scale], and both spectra with the threshold of touch [dB].

        Parameters: title : the title of the sound if None; figure : an empty matplotlib figure to draw into; None for
        a new one.
        Returns: the figure, made without pyplot. Raises: MissingExtra: matplotlib is not installed.
        """
        from scene2hap.audio.plots import plot_loop  # by need: the extra `plots`

        return plot_loop(
            self.audible.samples,
            self.tactile.samples,
            self.tactile.sample_rate_hz,
            self.audible.credit.title if title is None else title,
            (self.frequency_raw_hz, self.frequency_tactile_hz),
            None if self.felt is None else str(self.felt),
            figure=figure,
        )
