"""The audible and the tactile loop of one state."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, overload

from scene2hap.audio.clip import AudioClip
from scene2hap.audio.protocol import ConversionContext, TactileConverter, follows_target
from scene2hap.audio.run_curve import RunCurve
from scene2hap.audio.threshold import NOTICED_DB, TACTILE_RANGE_HZ
from scene2hap.common import checks
from scene2hap.common.calls import clear_construction
from scene2hap.errors import AudioError

if TYPE_CHECKING:
    from matplotlib.figure import Figure, SubFigure


@dataclass(frozen=True)
class Sensation:
    """How a tactile loop is felt by a hand on the source.

    Parameters: level_db : sensation level over the threshold of touch [dB]; asked_level_db : the planned level, which
    the actuator or the head-room may not allow [dB]; target_hz : the frequency that is felt most, None if unknown [Hz];
    own_hz : the frequency of that component in the sound, None if unknown [Hz]; rough_hz : the component that is felt
    as roughness, None without one [Hz].

    Of a melody, the note that is farthest over the threshold of touch is felt most. Nothing vibrates at the middle of
    its notes, around which the converter keeps a band. Only if the notes are beeps, which share one felt frequency,
    `own_hz` is their middle.
    """

    level_db: float
    asked_level_db: float
    own_hz: float | None = None
    target_hz: float | None = None
    rough_hz: float | None = None

    def __post_init__(self) -> None:
        for name in ("level_db", "asked_level_db"):
            object.__setattr__(self, name, checks.number(name, getattr(self, name), "dB", error=AudioError))
        for name in ("own_hz", "target_hz", "rough_hz"):
            if getattr(self, name) is not None:
                checks.number(name, getattr(self, name), "Hz", above=0.0, error=AudioError)

    @classmethod
    def of(
        cls, level_db: float, asked_level_db: float, converter: TactileConverter, context: ConversionContext
    ) -> Sensation:
        """Return the sensation of a conversion, at the planned frequency; `felt_at` gives the one that is felt most.

        The context's frequencies are left out where the converter ignores them: a low-pass may have removed the
        component that stands for the source.
        """
        if not follows_target(converter) or context.own_hz is None:
            return cls(level_db, asked_level_db)
        rough_hz = context.rough_hz if getattr(converter, "keeps_roughness", False) else None
        return cls(level_db, asked_level_db, context.own_hz, context.target_hz or context.own_hz, rough_hz)

    def felt_at(self, most_felt_hz: float) -> Sensation:
        """Return the sensation with the frequency that is felt most, and with the frequency of this component in the
        sound: all of a band is moved by the same number of hertz."""
        own_hz = self.own_hz
        if own_hz is not None and self.target_hz is not None:
            moved_hz = most_felt_hz - (self.target_hz - own_hz)
            # Below the band that was moved there is a burst, which has no frequency in the sound.
            own_hz = moved_hz if moved_hz >= TACTILE_RANGE_HZ[0] else own_hz
        return replace(self, own_hz=own_hz, target_hz=most_felt_hz)

    def __str__(self) -> str:
        weaker = f" ({self.asked_level_db:.1f} dB planned)" if self.asked_level_db - self.level_db >= NOTICED_DB else ""
        moved = f", moved from {self.own_hz:.0f}" if self.own_hz and self.is_moved else ""
        at = f" at {self.target_hz:.0f} Hz{moved}" if self.target_hz else ""
        rough = f", rough at {self.rough_hz:.0f} Hz" if self.rough_hz else ""
        return f"{self.level_db:.1f} dB over the threshold{weaker}{at}{rough}"

    @property
    def is_moved(self) -> bool:
        """True if it is felt at least 1 Hz away from its frequency in the sound."""
        return self.own_hz is not None and self.target_hz is not None and abs(self.own_hz - self.target_hz) >= 1.0


class LevelWarning(UserWarning):
    """A vibration is felt weaker than planned for its intensity, or not at the pitch that a person gave it."""


def level_of(level_db: float, asked_level_db: float) -> str:
    """Return a felt level as text, with the planned one if a person would notice the difference: "17 of 22"."""
    return f"{level_db:.0f}" + (f" of {asked_level_db:.0f}" if asked_level_db - level_db >= NOTICED_DB else "")


def level_doubt(name: str, level_db: float, asked_level_db: float) -> str:
    """Return the sentence that says by how much the planned level is missed; empty within `NOTICED_DB`."""
    missing_db = asked_level_db - level_db
    if missing_db <= NOTICED_DB:
        return ""
    return (
        f"{name} is felt {missing_db:.0f} dB weaker than planned for its intensity, since its peaks or the "
        "actuator allow no more. Give a smaller intensity, a sound that is steadier, or another converter."
    )


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
