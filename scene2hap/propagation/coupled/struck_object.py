"""An object of a scene, prepared for forces at any of its points.

    Y_c(x, x') = Y(x, x') - Y(x, x_j) H Y(x_j, x')        gain(x) = rms |omega^2 Y_c(x, p)| / rms |omega^2 Y_c(p, p)|

over the band around a frequency (`sampling.AROUND`): the acceleration that arrives over that of the struck point. All
joints of the scene are solved in advance, at frequencies that cover every impact; a strike costs the receptance of the
object alone at a few points.

Letters: Y, Y_c [m/N] receptance of the object alone and coupled, p the struck point, x_j its joints, H [N/m] by which
these hold it (`coupling.JointForces`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scene2hap.haptics import Bands
from scene2hap.propagation.bands.sampling import AROUND
from scene2hap.propagation.coupled.coupling import ElasticBody
from scene2hap.propagation.inclined_body import InclinedBody

Floats = NDArray[np.float64]

IMPACT_BANDS = Bands((20.0, 40.0, 80.0, 160.0, 320.0, 480.0))
"""What bursts have, from `impact.SLOWEST_HZ` to `impact.HIGHEST_MODE_HZ`, and a quarter of an octave on either side. A
lower component, which is not felt, counts as one of 24 Hz."""

DENSITY = 0.6
"""Frequencies over what `sampling` takes by itself, for 0.3 dB: twice exp(-pi 0.6 / 0.55) of a resonance's power."""
_QUICK = 200_000


class StruckObject:
    """Gains on an object from impacts on it.

    Parameters: body; joints_m : as of its `coupling.Ends`; held : H (n_frequencies, n_joints, n_joints) at frequencies
    (n_frequencies,) [Hz] that rise.
    """

    def __init__(
        self, body: ElasticBody, joints_m: Floats, held: NDArray[np.complex128], frequencies_hz: Floats
    ) -> None:
        self._body, self._joints_m, self._held = body, joints_m, held
        self._frequencies_hz = frequencies_hz
        between = (frequencies_hz[1:] + frequencies_hz[:-1]) / 2
        # Each frequency stands for the step between these (n_frequencies + 1,).
        self._ends_hz = np.concatenate([frequencies_hz[:1], between, frequencies_hz[-1:]])

    @property
    def is_quick(self) -> bool:
        """True if `gains` takes no longer than a game can spare in a frame, some 2 ms."""
        return self._held.size < _QUICK

    def gains(self, struck_m: Floats, felt_m: Floats, frequencies_hz: Floats) -> Floats:
        """Acceleration at points over that of the struck point.

        Parameters: struck_m : (1, 2), felt_m : (n_points, 2) [m], in the object's own coordinates; frequencies_hz :
        (n_frequencies,) > 0 [Hz], middles of bands.
        Returns: (n_points, n_frequencies) float64 [-], >= 0; 1 at the struck point, and 0 where that is held still.
        """
        bands = [self._band(f) for f in frequencies_hz.tolist()]
        squares = np.zeros((len(felt_m) + 1, len(bands)))
        begin, end = min(at.start for at, _ in bands), max(at.stop for at, _ in bands)
        power = self._moved(struck_m, felt_m, slice(begin, end)) ** 2
        for column, (at, covered_hz) in enumerate(bands):
            squares[:, column] = covered_hz @ power[at.start - begin : at.stop - begin]
        itself = squares[0]
        return np.sqrt(squares[1:] / np.where(itself > 0, itself, np.inf))

    def _band(self, frequency_hz: float) -> tuple[slice, Floats]:
        """Return the frequencies of the band around one, and how much of the step of each it covers [Hz]."""
        low, high = AROUND.around_hz(max(frequency_hz, IMPACT_BANDS.edges_hz[0] * 1.2))
        begin, end = np.searchsorted(self._ends_hz, (low, high)).tolist()
        at = slice(max(begin - 1, 0), min(end, len(self._frequencies_hz)))
        lower, upper = self._ends_hz[at], self._ends_hz[at.start + 1 : at.stop + 1]
        return at, np.minimum(upper, high) - np.maximum(lower, low)

    def _moved(self, struck_m: Floats, felt_m: Floats, used: slice) -> Floats:
        """Magnitudes of the accelerations of the struck point and of the others (n_used, 1 + n_points)."""
        points, f = np.concatenate([struck_m, felt_m]), self._frequencies_hz[used]
        # An inclined body has a port for each direction; the impact pushes along the normal, which is the first.
        ports = self._body.felt(points) if isinstance(self._body, InclinedBody) else points
        pushed = ports[:1].copy()
        towards = self._body.receptance(ports, self._joints_m, f)
        moved = self._body.receptance(ports, pushed, f)
        moved = moved - towards @ (self._held[used] @ towards[:, :1].transpose(0, 2, 1))
        lengths: Floats = np.linalg.norm(moved[:, :, 0].reshape(len(f), -1, len(points)), axis=1)
        return lengths * f[:, None] ** 2
