"""Levels and limits of one person, for each hand, device and frequency.

`UserProfile` holds the settings. `PersonalGains` applies the levels to gains before they are mixed. The peak guard
(`scene2hap.render.guards`) holds the limits. Pruning uses the highest level of any hand and band, which is part of each
source's level. Each hand and band gets its share of that level after pruning. So a source is left out only if no hand
would feel it.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import Field, field_validator

from scene2hap.common import checks
from scene2hap.common.files import write_whole
from scene2hap.common.printable import quoted
from scene2hap.common.settings import Settings
from scene2hap.errors import ConfigError, unwritable
from scene2hap.haptics import Bands
from scene2hap.session.gains.hand_gains import HandGains
from scene2hap.session.mix.sources import LoopRow

MOST_DB = 40.0
"""Bound on every level of a profile: a factor of 100."""

LEAST_AMPLITUDE = 1e-4
"""Smallest limit: -80 dB re full scale, which cannot be felt on any actuator. Mute for silence."""

_MOST_POINTS = 1000


class LevelAndLimit(Settings):
    """A level, also against frequency, and a limit.

    gain_db : level that is added to the level of all vibration [dB].
    max_amplitude : largest sample, as a share of full scale, 0.0001..1 [-].
    curve_db : level against frequency, as points (frequency [Hz], level [dB]) of rising frequency. It is interpolated
        between points over the logarithm of frequency, and constant beyond them.
    """

    of_what = "user"

    gain_db: float = Field(default=0.0, ge=-MOST_DB, le=MOST_DB, allow_inf_nan=False)
    max_amplitude: float = Field(default=1.0, ge=LEAST_AMPLITUDE, le=1.0)
    curve_db: tuple[tuple[float, float], ...] = ()

    @field_validator("curve_db")
    @classmethod
    def _rising(cls, points: tuple[tuple[float, float], ...]) -> tuple[tuple[float, float], ...]:
        checks.items("curve_db", points, at_most=_MOST_POINTS, error=ConfigError)
        for i, (frequency_hz, level_db) in enumerate(points):
            checks.number(f"curve_db[{i}][0]", frequency_hz, "Hz", above=0.0, at_most=1e6, error=ConfigError)
            checks.number(f"curve_db[{i}][1]", level_db, "dB", at_least=-MOST_DB, at_most=MOST_DB, error=ConfigError)
        if any(one[0] >= other[0] for one, other in pairwise(points)):
            raise ConfigError(f"curve_db has frequencies {[f for f, _ in points]} Hz; they must rise.")
        return points

    def _own_level_db(self, at_hz: NDArray[np.float64]) -> NDArray[np.float64]:
        """The level at some frequencies [dB], in their shape, without those of hands and devices."""
        if not self.curve_db:
            return np.full(at_hz.shape, self.gain_db)
        frequency, curve = np.array(self.curve_db).T
        return np.asarray(self.gain_db + np.interp(np.log(np.maximum(at_hz, 1e-9)), np.log(frequency), curve))

    @property
    def _most_own_db(self) -> float:
        return self.gain_db + max((level_db for _, level_db in self.curve_db), default=0.0)


class UserProfile(LevelAndLimit):
    """Levels and limits of one person. Levels add up, and the smallest limit counts.

    gain_db : level of all vibration [dB].
    max_amplitude : largest sample at every hand, 0.0001..1 [-].
    curve_db : level against frequency, for people who feel some frequencies more or less than others.
    hands : levels and a limit for single hands, by name: left/right balance, and the response of each actuator.
    devices : levels and a limit for single devices, by the name of the actuator that the session is set to.
    """

    hands: dict[str, LevelAndLimit] = Field(default_factory=dict)
    devices: dict[str, LevelAndLimit] = Field(default_factory=dict)

    if TYPE_CHECKING:
        # Type checkers do not know which other forms pydantic accepts.
        def __init__(
            self,
            *,
            gain_db: float = 0.0,
            max_amplitude: float = 1.0,
            curve_db: Sequence[Sequence[float]] = (),
            hands: Mapping[str, LevelAndLimit | Mapping[str, Any]] = ...,
            devices: Mapping[str, LevelAndLimit | Mapping[str, Any]] = ...,
        ) -> None: ...

    def level_db(self, hand: str, device: str, frequencies_hz: ArrayLike) -> NDArray[np.float64]:
        """Return the level at a hand, on a device, at some frequencies [dB], in the shape of the frequencies."""
        at_hz = np.asarray(frequencies_hz, dtype=np.float64)
        levels = [one._own_level_db(at_hz) for one in (self, *self._special(hand, device))]
        return np.asarray(sum(levels))

    @property
    def most_level_db(self) -> float:
        """Upper bound of `level_db` at any hand, on any device [dB]."""
        special = (max((one._most_own_db for one in of.values()), default=0.0) for of in (self.hands, self.devices))
        return self._most_own_db + sum(max(0.0, one) for one in special)

    def limits(self, hands: Sequence[str], device: str) -> NDArray[np.float64]:
        """Return the largest sample at each hand on a device (n_hands,), as a share of full scale [-]."""
        return np.array([min(one.max_amplitude for one in (self, *self._special(hand, device))) for hand in hands])

    @property
    def is_neutral(self) -> bool:
        """True if the profile changes nothing."""
        parts = (self, *self.hands.values(), *self.devices.values())
        return all(one.gain_db == 0.0 and one.max_amplitude == 1.0 and not one.curve_db for one in parts)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write all settings that differ from the default as JSON. Raises: ConfigError: the file cannot be written."""
        document: dict[str, Any] = {self.of_what: self.model_dump(mode="json", exclude_defaults=True)}
        file = checks.path("path", path, error=ConfigError)
        if file.suffix != ".json":
            raise ConfigError(f"path is {quoted(file)}; a profile is saved as JSON, in a file that ends in .json.")
        try:
            write_whole(file, json.dumps(document, indent=1, ensure_ascii=False) + "\n")
        except OSError as cause:
            raise ConfigError(unwritable(file, cause)) from cause

    def _special(self, hand: str, device: str) -> Sequence[LevelAndLimit]:
        tables: tuple[tuple[Mapping[str, LevelAndLimit], str], ...] = ((self.hands, hand), (self.devices, device))
        return [table[name] for table, name in tables if name in table]


class PersonalGains:
    """Levels of a profile for some hands and sources.

    highest : (n_sources,) the largest factor of any hand and band [-]; shares : (n_hands, n_sources, n_bands) of it,
    0..1 [-].
    """

    def __init__(
        self, profile: UserProfile, device: str, hands: Sequence[str], rows: Sequence[LoopRow], bands: Bands
    ) -> None:
        felt_hz = _frequencies_hz(rows, bands)
        factors = np.array([10 ** (profile.level_db(hand, device, felt_hz) / 20) for hand in hands])
        self.highest: NDArray[np.float64] = factors.max(axis=(0, 2))
        self.shares: NDArray[np.float32] = (factors / self.highest[None, :, None]).astype(np.float32)

    def applied(self, gained: HandGains) -> HandGains:
        """Multiply the gains of all hands by the share of each hand and band."""
        shares, full = self.shares, gained.full
        mixed = gained.mixed * (shares if gained.columns is None else shares[:, list(gained.columns)])
        return HandGains(lambda: full() * shares, mixed, gained.columns)


def _frequencies_hz(rows: Sequence[LoopRow], bands: Bands) -> NDArray[np.float64]:
    """The frequency at which each source is felt in each band (n_sources, n_bands) [Hz].

    It is the source's own frequency in the band that holds it, and the middle of each other band.
    """
    own = np.array([row.loop.frequency_tactile_hz for row in rows], dtype=np.float64).reshape(-1, 1)
    widths = bands.widths_hz()
    if not len(widths):
        return own
    low, high = widths.T
    return np.where((own >= low) & (own < high), own, np.sqrt(low * high))
