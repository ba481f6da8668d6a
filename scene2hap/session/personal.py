"""The profile of a person, applied: to gains before they are mixed, and to the mix as a limit.

Pruning works with the highest level of any hand and band, which is part of each source's level; hands and bands get
their share of it afterwards. Sources are thus left out only where no hand would feel them.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from scene2hap.devices.protocol import Block
from scene2hap.haptics import Bands
from scene2hap.render.limiter import soft_limit
from scene2hap.session.frame import Gains
from scene2hap.session.hand_gains import HandGains
from scene2hap.session.sources import LoopRow
from scene2hap.session.user_profile import UserProfile

FULL_SCALE_S = 0.05
"""Time over which a limit moves by full scale, so that a change of profile does not click."""


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
        self.highest = factors.max(axis=(0, 2))
        self.shares = (factors / self.highest[None, :, None]).astype(np.float32)

    def applied(self, gained: HandGains) -> HandGains:
        """Gains of all hands with each hand's and band's share of the level."""
        shares, full = self.shares, gained.full
        mixed = gained.mixed * (shares if gained.columns is None else shares[:, list(gained.columns)])
        return HandGains(lambda: _given(full) * shares, mixed, gained.columns)


class PersonalLimit:
    """Holds each output within its limit by the soft limiter.

    `limits` (n_hands,) [-] may be replaced at any time; the limit in force moves to them along a line.
    """

    def __init__(self, limits: NDArray[np.float64], sample_rate_hz: float) -> None:
        self.limits = limits
        self._now = limits
        self._step = 1.0 / (FULL_SCALE_S * sample_rate_hz)

    def applied(self, mix: Block) -> Block:
        """The mix (n_frames, n_hands) within the limits."""
        wanted = self.limits
        if len(self._now) != len(wanted):  # a hand came or went, and the output was silent meanwhile
            self._now = wanted
        if not len(mix) or ((self._now == 1.0).all() and (wanted == 1.0).all()):
            return mix
        farthest = self._step * np.arange(1, len(mix) + 1)[:, None]
        limits = self._now + np.clip(wanted - self._now, -farthest, farthest)
        self._now = limits[-1]
        held: Block = (soft_limit((mix / limits).astype(np.float32)) * limits).astype(np.float32)
        return held


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


def _given(gains: object) -> Gains:
    found: Gains = gains() if callable(gains) else gains  # type: ignore[assignment]  # a function or the gains
    return found
