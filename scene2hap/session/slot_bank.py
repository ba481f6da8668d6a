"""Loops that come and go under a running mixer.

A mixer reads a fixed number of loops. Some of these slots are empty; a mixer reads none that its gains do not let
through, so that an empty one costs nothing, and may be filled while it plays.
"""

from __future__ import annotations

from collections.abc import Sequence

from scene2hap.haptics import Bands
from scene2hap.render.loop_bank import Block, LoopBank, read


class SlotBank(LoopBank):
    """A `LoopBank` of slots.

    Parameters: slots : a bank of one loop for each slot, None for an empty one; shift : tactile samples by which the
    clock of its mixer lags the session's.
    """

    def __init__(self, slots: list[LoopBank | None], bands: Bands, sample_rate_hz: int, shift: int = 0) -> None:
        super().__init__((), bands, sample_rate_hz)
        self.slots = slots
        self._bands, self._shift = bands, shift

    def shifted(self, shift: int) -> SlotBank:
        """The same slots, for a mixer that began so many tactile samples after the session."""
        return SlotBank(self.slots, self._bands, self.sample_rate_hz, shift)

    def __len__(self) -> int:
        return len(self.slots)

    @property
    def nbytes(self) -> int:
        """Memory that the loops take [byte]."""
        return sum(bank.nbytes for bank in self.slots if bank is not None)

    def read(self, loops: Sequence[int], begin: int, out: Block) -> None:
        """See `LoopBank`; silence from an empty slot."""
        banks = [self.slots[loop] for loop in loops]
        read([None if bank is None else bank.loops[0] for bank in banks], begin + self._shift, out)
