"""One mixer of a session, which has several once hands or many loops came while it played."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scene2hap.devices.protocol import Block
from scene2hap.render.mixer import Mixer
from scene2hap.session.config import MIN_RAMP_S, SessionConfig
from scene2hap.session.slot_bank import SlotBank


class Deck:
    """A mixer for some hands and a bank.

    Parameters: hands : a token for each output; position : the frame of the session's clock at which it may begin.
    """

    def __init__(self, config: SessionConfig, bank: SlotBank, hands: tuple[int, ...], position: int) -> None:
        rate = config.sample_rate_hz
        # A whole number of tactile samples, so that its loops are in phase with everyone's.
        unit = rate // math.gcd(rate, bank.sample_rate_hz)
        self._begin = -(-position // unit) * unit
        self.bank = bank.shifted(self._begin * bank.sample_rate_hz // rate)
        self.hands = hands
        self.mixer = Mixer(
            self.bank,
            len(hands),
            sample_rate_hz=rate,
            ramp_s=max(config.control_period_s, MIN_RAMP_S),
            skip_silent=config.skip.silent_bands,
        )
        self._gains = np.zeros((len(hands), len(bank), config.bands.n_bands), dtype=np.float32)
        self._place: tuple[Any, ...] = ()
        self._last_told = b""
        self._last_where: tuple[list[int], list[int]] | None = None

    def move_to(self, gains: NDArray[np.float32], slots: list[int], hands: list[int], at_frame: int) -> None:
        """Move to gains (n_hands, n_slots, n_bands) of some slots for some of its hands, and to 0 for the rest."""
        told, where = gains.tobytes(), (slots, hands)
        if where != self._last_where:
            self._gains.fill(0.0)
            self._place = np.ix_(hands, slots) if len(hands) < len(self.hands) else (slice(None), _compact(slots))
        elif told == self._last_told:
            return
        self._gains[self._place] = gains
        self._send(at_frame)
        self._last_told, self._last_where = told, where

    def fade(self, slots: list[int], at_frame: int) -> None:
        """Move to 0 for some slots alone."""
        self._gains[:, slots] = 0.0
        self._send(at_frame)

    def silence(self, at_frame: int) -> None:
        """Move to 0."""
        self._gains.fill(0.0)
        self._send(at_frame)

    def render(self, position: int, n_frames: int) -> Block:
        """Samples (n_frames, n_hands) from a frame of the session's clock on, which only goes forward."""
        behind = position - self._begin - self.mixer.position
        if behind == 0:
            return self.mixer.render(n_frames)
        if behind > 0:
            self.mixer.render(behind)
            return self.mixer.render(n_frames)
        n_waiting = min(n_frames, -behind)
        silence = np.zeros((n_waiting, len(self.hands)), dtype=np.float32)
        return np.concatenate([silence, self.mixer.render(n_frames - n_waiting)])

    def _send(self, at_frame: int) -> None:
        # The mixer takes a copy.
        self.mixer.set_gains(self._gains.reshape(len(self.hands), -1), at_frame - self._begin)
        self._last_where = None


def _compact(slots: list[int]) -> slice | list[int]:
    """Slots in a row as a slice, which numpy is quicker with."""
    first, n = slots[0] if slots else 0, len(slots)
    return slice(first, first + n) if slots == list(range(first, first + n)) else slots
