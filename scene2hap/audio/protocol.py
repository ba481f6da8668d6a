"""Interfaces of sound sources and of converters from sound to vibration."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol, runtime_checkable

import numpy as np

from scene2hap import checks
from scene2hap.audio.clip import AudioClip, Samples
from scene2hap.calls import clear_construction
from scene2hap.errors import AudioError
from scene2hap.haptics import ActuatorProfile, VibrationDescription
from scene2hap.plugins import Members, lacking


@runtime_checkable
class AudioSource(Protocol):
    """Finds or makes sounds for a description."""

    def find(self, description: VibrationDescription) -> list[AudioClip]:
        """Candidates, best first; empty where it has none. Raises: BackendUnavailable, AudioError."""
        ...


@clear_construction
@dataclass(frozen=True)
class ConversionContext:
    """The scene, as far as a converter needs it.

    actuator : what it converts for; intensity : of the source, 0..1; neighbours_hz : dominant frequencies of the
    scene's other sources [Hz]; unused if `target_hz` is given, which takes them into account.
    own_hz : the source's own dominant frequency where somebody has looked at the whole sound, None to find out while
    it plays; target_hz : where that frequency is to be felt, None to leave that to the converter; rough_hz : a stronger
    component of the sound that is too low to be felt as itself, None if there is none.
    """

    actuator: ActuatorProfile = field(default_factory=ActuatorProfile)
    intensity: float = 1.0
    neighbours_hz: tuple[float, ...] = ()
    own_hz: float | None = None
    target_hz: float | None = None
    rough_hz: float | None = None

    def __post_init__(self) -> None:
        for name in ("own_hz", "target_hz", "rough_hz"):
            if getattr(self, name) is not None:
                checks.number(name, getattr(self, name), "Hz", above=0.0, error=AudioError)
        for i, neighbour in enumerate(checks.items("neighbours_hz", self.neighbours_hz, error=AudioError)):
            checks.number(f"neighbours_hz[{i}]", neighbour, "Hz", above=0.0, error=AudioError)


class TactileStream(Protocol):
    """A conversion under way; carries state from block to block, so that block size never matters."""

    def process(self, block: Samples) -> Samples:
        """The next samples (n,) float32 in [-1, 1]. Raises: AudioError: a sample is not finite, or not one channel."""
        ...

    def finish(self) -> Samples:
        """What is still held back, (m,) float32; empty for filters without latency."""
        ...


@runtime_checkable
class TactileConverter(Protocol):
    """Turns sound into a vibrotactile signal. One that moves a source to `target_hz` says `follows_target = True`."""

    def stream(self, sample_rate_hz: int, context: ConversionContext) -> TactileStream:
        """A fresh conversion at that rate. Several may run at once, in threads of their own."""
        ...


_STREAM: Members = {"process": ("block",), "finish": ()}


def opened_stream(converter: TactileConverter, sample_rate_hz: int, context: ConversionContext) -> TactileStream:
    """A fresh conversion. Raises: AudioError: what the converter gave is none."""
    stream = converter.stream(sample_rate_hz, context)
    if problem := lacking(stream, _STREAM):
        raise AudioError(f"{type(converter).__name__}.stream gave no TactileStream: {problem}")
    return stream


def one_channel(converter: TactileConverter, block: Samples) -> Samples:
    """What a converter's stream gave, as float32 (n,). Raises: AudioError: it is no row of samples."""
    try:
        found: Samples | None = np.asarray(block, dtype=np.float32)
    except (TypeError, ValueError):
        found = None
    if found is None or found.ndim != 1:
        raise AudioError(
            f"the stream of {type(converter).__name__} gave {checks.described(block)}; it must give samples (n,)."
        )
    return found
