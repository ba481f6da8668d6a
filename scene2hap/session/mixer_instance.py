"""One mixer of a session. A session gets further mixers if hands or many loops come while it plays."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from scene2hap.devices.protocol import Block
from scene2hap.render.mixer import Mixer
from scene2hap.session.config import MIN_RAMP_S, SessionConfig
from scene2hap.session.slot_bank import SlotBank


class MixerInstance:
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
        self._nothing = np.zeros((len(hands), 0, config.bands.n_bands), dtype=np.float32)
        # The target gains and their slots, and the request that they came from: an equal request is skipped.
        self._gains, self._slots = self._nothing, list[int]()
        self._last_request: tuple[bytes, list[int], list[int]] | None = None

    def move_to(self, gains: NDArray[np.float32], slots: list[int], hands: list[int], at_frame: int) -> None:
        """Move to gains (n_hands, n_slots, n_bands) of some slots for some of its hands, and to 0 for the rest."""
        request = (gains.tobytes(), slots, hands)
        if request == self._last_request:
            return
        if len(hands) < len(self.hands):
            some, gains = gains, np.zeros((len(self.hands), *gains.shape[1:]), dtype=np.float32)
            gains[hands] = some
        self._send(gains, slots, at_frame)
        self._last_request = request

    def fade(self, slots: list[int], at_frame: int) -> None:
        """Move to 0 for some slots alone."""
        kept = [i for i, slot in enumerate(self._slots) if slot not in slots]
        self._send(self._gains[:, kept], [self._slots[i] for i in kept], at_frame)

    def silence(self, at_frame: int) -> None:
        """Move to 0."""
        self._send(self._nothing, [], at_frame)

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

    def _send(self, gains: NDArray[np.float32], slots: list[int], at_frame: int) -> None:
        self.mixer.set_loops(gains, slots, at_frame - self._begin)
        self._gains, self._slots, self._last_request = gains, slots, None
