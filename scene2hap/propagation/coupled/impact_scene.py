"""Scene prepared for impacts at any point of its objects and for hands at any point of the touched ones.

    Y_c(q, p) = Y(q, p) - Y(q, x_q) H Y(x_p, p)        gain(q) = rms |omega^2 Y_c(q, p)| / rms |omega^2 Y_c(p, p)|

over the band around a frequency (`sampling.AROUND`): acceleration at the touched point over acceleration at the struck
point. Y(q, p) is 0 if q and p are points of two objects. All joints of the scene are solved in advance
(`impact_solution`), at frequencies that cover every impact. A strike only needs receptances of the uncoupled struck and
touched objects, at a few points.

Letters: Y, Y_c [m/N] receptance of objects alone and coupled, p the struck point, q the touched point, x_p, x_q the
joints of their objects, H [N/m] forces in the joints x_q per free deflection at the joints x_p.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Complex, Floats
from scene2hap.common.blas_threads import one_blas_thread
from scene2hap.contact.junction import Pair
from scene2hap.haptics import Bands
from scene2hap.propagation.bands.sampling import AROUND
from scene2hap.propagation.coupled.hand import Hand
from scene2hap.propagation.coupled.hand_load import loaded, stiffness_of
from scene2hap.propagation.elastic_body import ElasticBody, felt_ports

IMPACT_BANDS = Bands((20.0, 40.0, 80.0, 160.0, 320.0, 480.0))
"""Bands of the components of bursts: from `impact.SLOWEST_HZ` to `impact.HIGHEST_MODE_HZ`, and a quarter of an octave
on either side. A lower component, which is not felt, counts as one of 24 Hz."""

DENSITY = 0.6
"""Frequencies relative to the default of `sampling`, for 0.3 dB: twice exp(-pi 0.6 / 0.55) of a resonance's power."""


@dataclass(frozen=True, eq=False)
class HeldBody:
    """A body and the positions of its joints, (n_joints, 2) [m] or (n_joints, 6), see `coupling.JointEnds`."""

    body: ElasticBody
    joints_m: Floats


class ImpactScene:
    """Gains from impacts on objects to points of touched ones.

    Parameters: bodies : of struck and touched objects; passed : H (n_frequencies, n_joints of the touched, n_joints of
    the struck) of each pair, and of each struck object with itself, at rising frequencies (n_frequencies,) [Hz];
    silent : connected pairs whose impacts are not felt; hand : load at the struck and at touched points.
    """

    def __init__(
        self,
        bodies: Mapping[str, HeldBody],
        passed: Mapping[Pair, Complex],
        silent: Collection[Pair],
        frequencies_hz: Floats,
        hand: Hand | None = None,
    ) -> None:
        self._bodies, self._passed, self._silent, self._hand = bodies, passed, silent, hand
        self._frequencies_hz = frequencies_hz
        between = (frequencies_hz[1:] + frequencies_hz[:-1]) / 2
        # Each frequency represents the interval between two of these ends (n_frequencies + 1,).
        self._ends_hz = np.concatenate([frequencies_hz[:1], between, frequencies_hz[-1:]])

    def knows(self, touched_id: str, struck_id: str) -> bool:
        """Whether `gains` has an answer for a touched object and a struck one."""
        return (touched_id, struck_id) in self._passed or (touched_id, struck_id) in self._silent

    @one_blas_thread
    def gains(
        self, struck_id: str, struck_m: Floats, felt: Sequence[tuple[str, Floats]], frequencies_hz: Floats
    ) -> Floats:
        """Acceleration at points of touched objects over that of the struck point.

        Parameters: struck_m : (1, 2) [m], on the struck object, in its own coordinates; felt : touched objects which
        are known (`knows`), each with a point (1, 2) [m]; frequencies_hz : (n_frequencies,) > 0 [Hz], middles of bands.
        Returns: (n_felt, n_frequencies) float64 [-], >= 0; 1 at the struck point, and 0 if that point is held still.
        """
        gains = np.zeros((len(felt), len(frequencies_hz)))
        rows: dict[str, list[int]] = {}
        for row, (touched_id, _) in enumerate(felt):
            if (touched_id, struck_id) in self._passed:
                rows.setdefault(touched_id, []).append(row)
        if not rows:
            return gains
        bands = [self._band(f) for f in frequencies_hz.tolist()]
        points = {x: np.concatenate([felt[row][1] for row in its]) for x, its in rows.items()}
        used = np.unique(np.concatenate([np.arange(at.start, at.stop) for at, _ in bands]))
        power = self._moved(struck_id, struck_m, points, used) ** 2
        begins = np.searchsorted(used, [at.start for at, _ in bands]).tolist()
        squares = np.array(
            [hz @ power[begin : begin + len(hz)] for begin, (_, hz) in zip(begins, bands, strict=True)]
        ).T
        itself, others = squares[0], [row for its in rows.values() for row in its]
        gains[others] = np.sqrt(squares[1:] / np.where(itself > 0, itself, np.inf))
        return gains

    def _band(self, frequency_hz: float) -> tuple[slice, Floats]:
        """Return the frequencies in the band around one, and how much of the interval of each the band covers [Hz]."""
        low, high = AROUND.around_hz(max(frequency_hz, IMPACT_BANDS.edges_hz[0] * 1.2))
        begin, end = np.searchsorted(self._ends_hz, (low, high)).tolist()
        at = slice(max(begin - 1, 0), min(end, len(self._frequencies_hz)))
        lower, upper = self._ends_hz[at], self._ends_hz[at.start + 1 : at.stop + 1]
        return at, np.minimum(upper, high) - np.maximum(lower, low)

    def _moved(self, struck_id: str, struck_m: Floats, points: Mapping[str, Floats], used: NDArray[np.intp]) -> Floats:
        """Magnitudes of the accelerations of the struck point and of points of each object (n_used, 1 + n_points)."""
        f, struck = self._frequencies_hz[used], self._bodies[struck_id]
        on_it = np.concatenate([struck_m, points[struck_id]]) if struck_id in points else struck_m
        ports = felt_ports(struck.body, on_it)
        # The impact acts along the normal, which is the first direction. A copy, since bodies cache their receptance
        # if points and forces are the same array.
        pushed = ports[:1].copy()
        towards = struck.body.receptance(ports, struck.joints_m, f)
        free = towards[:, :1].transpose(0, 2, 1)
        moved = struck.body.receptance(ports, pushed, f) - towards @ self._forces((struck_id, struck_id), used, free)
        n = len(on_it)
        own = _lengths(self._under_hand(struck_id, ports, n, towards, moved, used), n)
        found = [own[:, :1]]
        for touched_id, places in points.items():
            if touched_id == struck_id:
                found.append(own[:, 1:])
                continue
            touched = self._bodies[touched_id]
            ports = felt_ports(touched.body, places)
            towards = touched.body.receptance(ports, touched.joints_m, f)
            moved = towards @ self._forces((touched_id, struck_id), used, free)
            n = len(places)
            found.append(_lengths(self._under_hand(touched_id, ports, n, towards, moved, used), n))
        return np.concatenate(found, axis=1) * f[:, None] ** 2

    def _forces(self, pair: Pair, used: NDArray[np.intp], free: Complex) -> Complex:
        """Forces in joints at some frequencies: H times free deflections (n_used, n_struck, n)."""
        held = self._passed[pair]
        # Consecutive frequencies are multiplied as one slice, since copying H takes longer than the product.
        ends = np.flatnonzero(np.diff(used, append=-1) != 1) + 1
        forces = np.empty((len(used), held.shape[1], free.shape[2]), dtype=np.complex128)
        for begin, end in pairwise((0, *ends.tolist())):
            np.matmul(held[used[begin] : used[end - 1] + 1], free[begin:end], out=forces[begin:end])
        return forces

    def _under_hand(
        self, object_id: str, ports: Floats, n_points: int, towards: Complex, moved: Complex, used: NDArray[np.intp]
    ) -> Complex:
        """Deflections of the ports of some points (n_used, n_ports, 1) with a hand's load on each point alone, as in a
        model's fields."""
        if self._hand is None:
            return moved
        f, body, pair = self._frequencies_hz[used], self._bodies[object_id].body, (object_id, object_id)
        stiffness, answer = stiffness_of(self._hand, f), np.empty_like(moved)
        for i in range(n_points):
            at = slice(i, None, n_points)
            alone = body.receptance(ports[at], ports[at].copy(), f)
            yielding = alone - towards[:, at] @ self._forces(pair, used, towards[:, at].transpose(0, 2, 1))
            answer[:, at] = loaded(stiffness, yielding, moved[:, at])
        return answer


def _lengths(moved: Complex, n_points: int) -> Floats:
    """Lengths over all directions (n_frequencies, n_points), from deflections (n_frequencies, n_ports, 1)."""
    lengths: Floats = np.linalg.norm(moved[:, :, 0].reshape(len(moved), -1, n_points), axis=1)
    return lengths
