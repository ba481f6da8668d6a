"""Mixers in phase with each other, and the plan by which they play the present hands.

The audio thread reads a plan, which never changes; the game's thread replaces it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Indices
from scene2hap.devices.protocol import Block
from scene2hap.render.limiter import soft_limit_sum
from scene2hap.render.loop_bank import SlotBank
from scene2hap.render.mixer import Mixer
from scene2hap.session.config import MIN_RAMP_S, SessionConfig


class MixerInstance:
    """A mixer for some hands and a bank.

    Parameters: hands : a token for each output; position : the frame of the session's clock from which it may begin.
    """

    def __init__(self, config: SessionConfig, bank: SlotBank, hands: tuple[int, ...], position: int) -> None:
        rate = config.sample_rate_hz
        # It begins at a whole number of tactile samples, so that its loops are in phase with those of other mixers,
        # and not after `position`, or its hands and loops would be felt late: up to 10 ms at 44.1 kHz.
        unit = rate // math.gcd(rate, bank.sample_rate_hz)
        self._begin = position // unit * unit
        self.bank: SlotBank = bank.shifted(self._begin * bank.sample_rate_hz // rate)
        self.hands = hands
        self.mixer: Mixer = Mixer(
            self.bank,
            len(hands),
            sample_rate_hz=rate,
            ramp_s=max(config.control_period_s, MIN_RAMP_S),
            skip_silent=config.skip.silent_bands,
        )
        self.mixer.render(position - self._begin)
        self._nothing = np.zeros((len(hands), 0, config.bands.n_bands), dtype=np.float32)
        # The target gains, their slots, and the request for them: an equal request is skipped.
        self._gains, self._slots = self._nothing, list[int]()
        self._last_request: tuple[bytes, list[int], list[int]] | None = None

    def move_to(self, gains: NDArray[np.float32], slots: list[int], hands: list[int], at_frame: int) -> None:
        """Ramp to gains (n_hands, n_slots, n_bands) of some slots for some of its hands, and to 0 for the rest."""
        request = (gains.tobytes(), slots, hands)
        if request == self._last_request:
            return
        if len(hands) < len(self.hands):
            some, gains = gains, np.zeros((len(self.hands), *gains.shape[1:]), dtype=np.float32)
            gains[hands] = some
        self._send(gains, slots, at_frame)
        self._last_request = request

    def fade(self, faded: int, at_frame: int) -> None:
        """Ramp to 0 for one slot only."""
        kept = [i for i, slot in enumerate(self._slots) if slot != faded]
        self._send(self._gains[:, kept], [self._slots[i] for i in kept], at_frame)

    def silence(self, at_frame: int) -> None:
        """Ramp to 0."""
        self._send(self._nothing, [], at_frame)

    def render(self, position: int, n_frames: int) -> Block:
        """Samples (n_frames, n_hands) from frame `position` of the session's clock on; it must not decrease."""
        behind = position - self._begin - self.mixer.position
        if behind > 0:
            self.mixer.render(behind)
        return self.mixer.render(n_frames)

    def _send(self, gains: NDArray[np.float32], slots: list[int], at_frame: int) -> None:
        self.mixer.set_gains(gains, slots, at_frame - self._begin)
        self._gains, self._slots, self._last_request = gains, slots, None


class PlannedMixer(NamedTuple):
    """A mixer, those of its outputs that belong to a present hand, and the channels of these hands."""

    mixer: MixerInstance
    outputs: Indices
    channels: Indices


@dataclass(frozen=True, eq=False)
class MixingPlan:
    """The present outputs, a token for each, and the mixers that play them."""

    hands: tuple[int, ...]
    mixers: tuple[PlannedMixer, ...]

    @property
    def n_channels(self) -> int:
        """Number of outputs."""
        return len(self.hands)

    @classmethod
    def of(cls, mixers: Sequence[MixerInstance], hands: tuple[int, ...]) -> MixingPlan:
        """Return the plan by which mixers play the present hands, given by their tokens."""
        planned = []
        for mixer in mixers:
            present = [(i, hands.index(hand)) for i, hand in enumerate(mixer.hands) if hand in hands]
            outputs, channels = np.array(present, dtype=np.intp).reshape(-1, 2).T
            planned.append(PlannedMixer(mixer, outputs, channels))
        return cls(hands, tuple(planned))

    def render(self, position: int, n_frames: int) -> Block:
        """Samples (n_frames, n_channels) from frame `position` of the session's clock on; it must not decrease."""
        mixer, outputs, _ = self.mixers[0]
        if len(self.mixers) == 1 and len(outputs) == len(mixer.hands):
            return mixer.render(position, n_frames)
        mixes = np.zeros((len(self.mixers), n_frames, self.n_channels), dtype=np.float32)
        for mix, (mixer, outputs, channels) in zip(mixes, self.mixers, strict=True):
            mix[:, channels] = mixer.render(position, n_frames)[:, outputs]
        return soft_limit_sum(np.abs(mixes).max(axis=0), mixes.sum(axis=0))
