"""How a vibration is felt: its level, its frequency, and what is said if it is weaker than planned."""

from __future__ import annotations

from dataclasses import dataclass, replace

from scene2hap.audio.protocol import ConversionContext, TactileConverter, follows_target
from scene2hap.audio.threshold import NOTICED_DB, TACTILE_RANGE_HZ
from scene2hap.common import checks
from scene2hap.errors import AudioError


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
