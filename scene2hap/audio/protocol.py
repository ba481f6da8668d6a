"""Interfaces of sound sources and of converters from sound to vibration."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol, runtime_checkable

import numpy as np

from scene2hap.audio.clip import AudioClip, Samples
from scene2hap.common import checks
from scene2hap.common.calls import clear_construction
from scene2hap.errors import AudioError
from scene2hap.haptics import ActuatorProfile, VibrationDescription
from scene2hap.plugins import Members, lacking


@runtime_checkable
class AudioSource(Protocol):
    """Interface of sources that find or generate sounds for a description."""

    def find(self, description: VibrationDescription, /) -> list[AudioClip]:
        """Return candidates, best first; an empty list if there are none. Raises: BackendUnavailable, AudioError."""
        ...


@runtime_checkable
class NamedSounds(Protocol):
    """Interface that a source may have too: its sounds have names, which may be those of single objects."""

    def names(self) -> frozenset[str]:
        """Return the names of all sounds, as `str.casefold` writes them. Raises: ConfigError."""
        ...


@clear_construction
@dataclass(frozen=True)
class ConversionContext:
    """Data for a converter: the actuator, the intensity, and the frequencies of the source and of its neighbours.

    actuator : the profile to convert for; intensity : of the source, above 0, up to 1 [-]; neighbours_hz : dominant
    frequencies of the scene's other sources [Hz]; unused with a `target_hz`, which already takes them into account.
    own_hz : the source's dominant frequency, from an analysis of the whole sound; None to track it while it plays;
    target_hz : the frequency at which the source is to be felt, None if the converter may choose; rough_hz : a stronger
    component that is too low to be felt as a tone, None without one. All [Hz]. band_q : largest Q of a band that holds
    the source's moving pitch, with `own_hz` in its middle; None if the pitch does not move [-]. band_db : level of the
    band that is kept, relative to the whole sound; None if unknown [dB].
    """

    actuator: ActuatorProfile = field(default_factory=ActuatorProfile)
    intensity: float = 1.0
    neighbours_hz: tuple[float, ...] = ()
    own_hz: float | None = None
    target_hz: float | None = None
    rough_hz: float | None = None
    band_q: float | None = None
    band_db: float | None = None

    def __post_init__(self) -> None:
        for name in ("own_hz", "target_hz", "rough_hz"):
            if getattr(self, name) is not None:
                checks.number(name, getattr(self, name), "Hz", above=0.0, error=AudioError)
        if self.band_q is not None:
            checks.number("band_q", self.band_q, "-", at_least=0.1, at_most=100.0, error=AudioError)
        if self.band_db is not None:
            checks.number("band_db", self.band_db, "dB", error=AudioError)
        for i, neighbour in enumerate(checks.items("neighbours_hz", self.neighbours_hz, error=AudioError)):
            checks.number(f"neighbours_hz[{i}]", neighbour, "Hz", above=0.0, error=AudioError)


class TactileStream(Protocol):
    """A running conversion. It keeps its state between blocks, so that the block size has no effect on the result."""

    def process(self, block: Samples, /) -> Samples:
        """Return the next samples (n,) float32 in [-1, 1]; `block` stays as it is.

        Raises: AudioError: not finite, or not one channel.
        """
        ...

    def finish(self) -> Samples:
        """Return the samples (m,) float32 that the latency has held back; empty for filters without latency."""
        ...


@runtime_checkable
class TactileConverter(Protocol):
    """Interface of converters from sound to a vibrotactile signal.

    Set `follows_target = True` if it moves a source to `target_hz`, and `keeps_roughness = True` if `rough_hz` is felt.
    """

    def stream(self, sample_rate_hz: int, context: ConversionContext, /) -> TactileStream:
        """Start a conversion at a sample rate. Several may run at once, each in its own thread."""
        ...


def follows_target(converter: object) -> bool:
    """Return True if a converter declares that it moves a source to `target_hz`."""
    return bool(getattr(converter, "follows_target", False))


def follows_component(converter: object, context: ConversionContext) -> bool:
    """Return True if the converter makes the vibration of the component that the analysis of the whole sound chose."""
    return context.band_db is not None and follows_target(converter)


_STREAM: Members = {"process": ("block",), "finish": ()}


def opened_stream(converter: TactileConverter, sample_rate_hz: int, context: ConversionContext) -> TactileStream:
    """Start a conversion. Raises: AudioError: the converter did not return a `TactileStream`."""
    stream = converter.stream(sample_rate_hz, context)
    if problem := lacking(stream, _STREAM):
        raise AudioError(f"{type(converter).__name__}.stream gave no TactileStream: {problem}")
    return stream


def one_channel(converter: TactileConverter, block: Samples) -> Samples:
    """Return a block from a converter's stream as float32 (n,).

    Raises: AudioError: it has another shape or type, or a sample that is not finite.
    """
    try:
        found: Samples | None = np.asarray(block, dtype=np.float32)
    except (TypeError, ValueError):
        found = None
    if found is None or found.ndim != 1:
        raise AudioError(
            f"the stream of {type(converter).__name__} gave {checks.described(block)}; it must give samples (n,)."
        )
    if not np.isfinite(found).all():
        raise AudioError(f"the stream of {type(converter).__name__} gave a sample that is not finite.")
    return found


def require_in_step(converter: TactileConverter, n_made: int, n_given: int) -> None:
    """Compare the numbers of samples of a whole conversion. Raises: AudioError: they differ."""
    if n_made != n_given:
        raise AudioError(
            f"{type(converter).__name__} made {n_made} samples of {n_given}; touch must stay in step with sound. "
            "Its stream must return as many samples as it was given, counting finish()."
        )
