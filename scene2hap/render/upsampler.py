"""Resampling from the tactile rate to the session's rate, seamless between cells.

    y[m] = sum_j h[p + j up] x[q - j]        q = m down // up,  p = m down mod up,  up / down = f_out / f_in

h is a Kaiser-windowed low-pass at rate up f_in: flat to 1 kHz, with images (above f_in / 2) at -80 dB or less. It is
symmetric, so the delay is one number for all frequencies. Output m needs no input later than q, which is not later than
m itself: the filter is causal.

The outputs of a cell are one product Y = X B^T with a banded matrix. It is the same for every cell if the rates divide,
else one of few. Its shape is the same for every cell, so the bits do not depend on the sizes of the requested blocks.

Source: Crochiere and Rabiner, Multirate Digital Signal Processing (1983), section 2.3. Symbols: x, X inputs, y, Y
outputs, h taps, B matrix, m frame of the output, q sample of the input, p phase.
"""

from __future__ import annotations

import math
from collections.abc import Collection

import numpy as np
from numpy.typing import NDArray

from scene2hap.compiled import compiled
from scene2hap.render.loop_bank import CELL, Block

PASS_HZ = 1000.0
"""End of the filter's flat pass band [Hz]; higher frequencies are not felt."""

IMAGE_DB = 80.0
"""Least attenuation of images [dB]: below the threshold of touch (45 dB below full scale) and hardly audible."""

_MOST_KEPT = 64
"""Most matrices that are cached; 44.1 kHz has 10. Rates with a small common divisor have up to f_in matrices, which are
made on demand."""


@compiled
class PolyphaseFilter:
    """The outputs of a cell, as one product with a banded matrix.

    Parameters: h : taps (n_taps * up,); n_frames : number of outputs; offsets : the expected offsets, whose matrices
        are made in advance.
    """

    def __init__(self, h: Block, up: int, down: int, n_frames: int, offsets: Collection[int]) -> None:
        # scipy.linalg is slow to import, and a program that imports a session may never play it.
        from scipy.linalg.blas import sgemm

        self._sgemm = sgemm
        self._h, self._up, self._down, self._n_frames = h, up, down, n_frames
        self._n_taps = len(h) // up
        self._kept = {offset: self._matrix(offset) for offset in offsets}

    def advance(self, X: Block) -> None:
        """Shift X, the inputs of a cell and earlier ones, by one cell. The earlier ones are still needed by the next
        outputs."""
        X[:, :-CELL] = X[:, CELL:]

    def fill(self, Y: Block, X: Block, offset: int) -> None:
        """Fill Y (n_channels, n_frames) from X (n_channels, n_taps - 1 + CELL), the inputs of a cell and earlier ones.

        Parameters: offset : distance of the first output from the cell's first input, in units of 1 / (up f_in).
        """
        B = self._kept[offset] if self._kept else self._matrix(offset)
        self._sgemm(1.0, B.T, X.T, 0.0, Y.T, 1, 0, 1)

    def _matrix(self, offset: int) -> Block:
        """Return the taps (n_frames, n_taps - 1 + CELL) from inputs to outputs."""
        B = np.zeros((self._n_frames, self._n_taps - 1 + CELL), dtype=np.float32)
        for frame, row in enumerate(B):
            newest, phase = divmod(offset + frame * self._down, self._up)
            # The last output of some cells belongs to the next one; it is not used.
            if newest < CELL:
                row[newest : newest + self._n_taps] = self._h[phase :: self._up][::-1]
        return B


class Upsampler:
    """A streaming converter for n_channels that takes its input in cells of CELL samples; f_out >= f_in.

    `cell` (n_channels, CELL) receives the input; it is the end of all `inputs`. `delay_s` is the delay of a signal;
    `up` / `down` is the ratio of the rates. With equal rates samples are unchanged and without delay.
    """

    def __init__(self, rate_in_hz: int, rate_out_hz: int, n_channels: int) -> None:
        common = math.gcd(rate_in_hz, rate_out_hz)
        self.up: int = rate_out_hz // common
        self.down: int = rate_in_hz // common
        h = interpolation_filter(rate_in_hz, self.up)
        n_taps = len(h) // self.up
        self.delay_s: float = (len(h) - 1) / 2 / (rate_in_hz * self.up)
        self.inputs: NDArray[np.float32] = np.zeros((n_channels, n_taps - 1 + CELL), dtype=np.float32)
        self._Y = np.zeros((n_channels, -(-CELL * self.up // self.down)), dtype=np.float32)
        self.cell: NDArray[np.float32] = self.inputs[:, n_taps - 1 :]
        n_kinds = self.down // math.gcd(self.down, CELL * self.up)
        kinds = {self._offset(k * CELL) for k in range(n_kinds)} if n_kinds <= _MOST_KEPT else set[int]()
        self.filter: PolyphaseFilter = PolyphaseFilter(
            h.astype(np.float32), self.up, self.down, self._Y.shape[1], kinds
        )

    def input_of(self, frame: int) -> int:
        """Return the newest input that an output needs."""
        return frame * self.down // self.up

    def first_output_of(self, sample: int) -> int:
        """Return the first output that needs an input."""
        return -(-sample * self.up // self.down)

    def next_cell(self) -> None:
        """Advance by CELL inputs. Inputs that outputs still need are kept."""
        self.filter.advance(self.inputs)

    def outputs(self, cell_begin: int) -> Block:
        """Return all outputs (n_channels, n_frames) whose newest input is in the cell. The buffer is reused."""
        self.filter.fill(self._Y, self.inputs, self._offset(cell_begin))
        return self._Y

    def _offset(self, sample: int) -> int:
        return self.first_output_of(sample) * self.down - sample * self.up


def interpolation_filter(rate_in_hz: int, up: int) -> NDArray[np.float64]:
    """Return the low-pass h (n_taps * up,) at rate up * rate_in_hz. Each of its phases has a gain of 1 at 0 Hz."""
    if up == 1:
        return np.ones(1)
    from scipy.signal import firwin, kaiserord

    nyquist_hz = rate_in_hz / 2
    pass_hz = min(PASS_HZ, 0.8 * nyquist_hz)
    rate_hz = rate_in_hz * up
    # A margin of 2 dB: Kaiser's formula is an estimate, and normalising each phase adds a small error.
    n_wanted, beta = kaiserord(IMAGE_DB + 2, (nyquist_hz - pass_hz) / (rate_hz / 2))
    n_taps = -(-n_wanted // up)
    h = firwin(n_taps * up, (nyquist_hz + pass_hz) / 2, window=("kaiser", beta), fs=rate_hz)
    phases = h.reshape(n_taps, up)
    return np.asarray(phases / phases.sum(axis=0)).ravel()
