"""The audible and the tactile loop of one state."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from scene2hap import checks
from scene2hap.audio.clip import AudioClip
from scene2hap.calls import clear_construction
from scene2hap.errors import AudioError


@clear_construction
@dataclass(frozen=True, eq=False)
class HapticLoop:
    """An audible and a tactile loop with the same seam, length and rate, so that they stay in step for ever.

    `frequency_raw_hz` is the peak of the audible loop's spectrum, which the paper puts into its attenuation law;
    `frequency_tactile_hz` is the peak of the tactile one, after conversion.
    `source` is the sound before it was cut, None for a person's own clip, which the bundle keeps anyway, or
    if unknown; `fingerprint` has a digest of each input of the loops, empty if unknown.
    Raises: AudioError: lengths or rates differ, or a frequency is not positive.
    """

    audible: AudioClip
    tactile: AudioClip
    frequency_raw_hz: float
    frequency_tactile_hz: float
    source: AudioClip | None = None
    fingerprint: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        shapes = [(len(clip.samples), clip.sample_rate_hz) for clip in (self.audible, self.tactile)]
        if shapes[0] != shapes[1]:
            raise AudioError(
                f"the audible loop has {shapes[0][0]} samples at {shapes[0][1]} Hz, the tactile one {shapes[1][0]} at "
                f"{shapes[1][1]} Hz; both must be equal, or they drift apart. Cut both by the same seam."
            )
        for name in ("frequency_raw_hz", "frequency_tactile_hz"):
            object.__setattr__(self, name, checks.number(name, getattr(self, name), "Hz", above=0.0, error=AudioError))
