"""What finds or makes a sound, and what turns it into touch."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol, runtime_checkable

from scene2hap.audio.clip import AudioClip, Samples
from scene2hap.haptics import ActuatorProfile, VibrationDescription


@runtime_checkable
class AudioSource(Protocol):
    """Finds or makes sounds for a description."""

    def find(self, description: VibrationDescription) -> list[AudioClip]:
        """Candidates, best first; empty where it has none. Raises: BackendUnavailable, AudioError."""
        ...


@dataclass(frozen=True)
class ConversionContext:
    """What a converter is told: the actuator, the source's intensity 0..1, and the scene's other sources' dominant
    frequencies [Hz]."""

    actuator: ActuatorProfile = field(default_factory=ActuatorProfile)
    intensity: float = 1.0
    neighbours_hz: tuple[float, ...] = ()


class TactileStream(Protocol):
    """A conversion under way; carries state from block to block, so that block size never matters."""

    def process(self, block: Samples) -> Samples:
        """The next samples (n,) float32."""
        ...

    def finish(self) -> Samples:
        """What is still held back, (m,) float32; empty for filters without latency."""
        ...


@runtime_checkable
class TactileConverter(Protocol):
    """Turns sound into a vibrotactile signal."""

    def stream(self, sample_rate_hz: int, context: ConversionContext) -> TactileStream:
        """A fresh conversion at that rate."""
        ...
