"""Warning of a level that was probably not given in decibels."""

from __future__ import annotations

from scene2hap.common.warning import warn_of

_USUAL_DB = 40.0  # A factor of 100, more than the range from the weakest to the strongest felt vibration.


def warn_if_percent(gain_db: float) -> None:
    """Warn of a level above `_USUAL_DB` [dB], which is probably a percentage. Warns: SceneWarning."""
    if gain_db > _USUAL_DB:
        warn_of(
            f"gain_db is {gain_db:g} dB, a factor of {10 ** (gain_db / 20):.3g}, more than {_USUAL_DB:g} dB; it is in "
            "decibels, not in percent: 0 leaves the level, 6 doubles it, -6 halves it."
        )
