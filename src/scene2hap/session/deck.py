"""One mixer of a session, which has several once hands or many loops came while it played."""

from __future__ import annotations

import math

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
        self._told = self._gains.tobytes()

    def move_to(self, gains: NDArray[np.float32], slots: list[int], hands: list[int], at_frame: int) -> None:
        """Move to gains (n_hands, n_slots, n_bands) of some slots for some of its hands, and to 0 for the rest."""
        wanted = np.zeros(self._gains.shape, dtype=np.float32)
        if len(hands) == len(self.hands):
            wanted[:, slots] = gains
        else:
            wanted[np.ix_(hands, slots)] = gains
        self._move(wanted, at_frame)

    def fade(self, slots: list[int], at_frame: int) -> None:
        """Move to 0 for some slots alone."""
        wanted = self._gains.copy()
        wanted[:, slots] = 0.0
        self._move(wanted, at_frame)

    def silence(self, at_frame: int) -> None:
        """Move to 0."""
        self._move(np.zeros_like(self._gains), at_frame)

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

    def _move(self, wanted: NDArray[np.float32], at_frame: int) -> None:
        told = wanted.tobytes()
        if told != self._told:
            self.mixer.set_gains(wanted.reshape(len(self.hands), -1), at_frame - self._begin)
            self._gains, self._told = wanted, told
