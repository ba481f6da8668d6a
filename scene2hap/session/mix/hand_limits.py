"""The limits of the person who plays, on the mix of a session without a sink. A sink has them in its safety layer."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from scene2hap.devices.protocol import Block
from scene2hap.render.guards import PeakGuard


class HandLimits:
    """Holds each output within its limit. Hands may come and go while the audio thread renders.

    Call `hold` on the game's thread and `pass_through` on the audio thread, which alone changes the guard. Parameters:
    hands : a token for each output; limits : their limits at first [-].
    """

    def __init__(self, sample_rate_hz: int, hands: Sequence[int], limits: Mapping[int, float]) -> None:
        self._hands, self._limits, self._applied = tuple(hands), limits, limits
        self._guard = PeakGuard(self._of(self._hands, limits), sample_rate_hz, len(self._hands))

    def hold(self, limits: Mapping[int, float]) -> None:
        """Hold each output within a limit [-], by its token; limits change without a click."""
        self._limits = limits

    def pass_through(self, mix: Block, hands: tuple[int, ...]) -> Block:
        """Return a mix (n_frames, n_hands) of these outputs within their limits."""
        limits = self._limits
        if hands != self._hands:
            former = [self._hands.index(hand) if hand in self._hands else None for hand in hands]
            self._guard.rearrange(former, self._of(hands, limits))
        elif limits is not self._applied:
            self._guard.limit = self._of(hands, limits)
        self._hands, self._applied = hands, limits
        return self._guard.pass_through(mix.astype(np.float64)).astype(np.float32)

    @staticmethod
    def _of(hands: Sequence[int], limits: Mapping[int, float]) -> NDArray[np.float64]:
        # A hand that was just added has no limit yet, and no gains either.
        return np.array([limits.get(hand, 1.0) for hand in hands])
