"""A plate with edges as an elastic body for coupling, fast at repeated queries."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from weakref import ref

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Complex, Floats
from scene2hap.common.caches import ByteBoundedLru, cached_while_used
from scene2hap.propagation.bands.octaves import OctaveSums
from scene2hap.propagation.bodies.infinite_body import InfiniteBody, SplitBody
from scene2hap.propagation.bodies.many_joints import among, has_many, parts_of
from scene2hap.propagation.elastic_body import AnyFloat, SeparatedReceptance
from scene2hap.propagation.modal.modes import FINE, MARGIN, QUICK_BLOCK, Fineness, largest_block
from scene2hap.propagation.modal.near_field import NearField
from scene2hap.propagation.modal.plate_terms import N_NODES, ContractedShapes, ForcedPlate, PlateTerms
from scene2hap.propagation.plate import Plate

MOST_REMEMBERED = 65_536
"""Complex numbers of the largest receptance among contacts that is cached, 1 MB: objects that stay in place need not be
summed again when others move."""
NO_RETURN = 3.0
"""Decay exponent eta k L / 4 of a wave along the shorter side L above which it has no noticeable echo (26 dB)."""


@cached_while_used
def modal_body(
    plate: Plate, max_frequency_hz: float, loss_factor: float, fineness: Fineness = FINE
) -> ModalBody | SplitBody:
    """Return the body of a plate. Cached, since every change of a contact prepares the scene again.

    A rug or a foil may have too many modes to solve, or so much loss that no wave returns from its edges. It is then a
    `SplitBody`, which ignores the edges at upper frequencies.
    """
    shorter = min(plate.length_m, plate.width_m)
    k = min(float(plate.wavenumber_rad_m(max_frequency_hz)), 4 * NO_RETURN / (loss_factor * shorter))
    limit_hz = plate.frequency_hz(k)
    most = max(QUICK_BLOCK, largest_block(plate, 0.0))  # a narrow plate needs the latter at any frequency
    while largest_block(plate, MARGIN * limit_hz) > most:
        limit_hz *= 0.9
    if limit_hz >= max_frequency_hz * (1 - 1e-9):
        return ModalBody(plate, max_frequency_hz, loss_factor, fineness)
    return SplitBody(ModalBody(plate, limit_hz, loss_factor, fineness), InfiniteBody(plate, loss_factor), limit_hz)


@dataclass(frozen=True, eq=False)
class ModalBasis:
    """A `ResponseBasis`: the plate's modes, and the remaining response to each force."""

    pushed: ForcedPlate
    spectrum: Callable[[Floats], Complex]

    @property
    def sizes(self) -> Floats:
        """See `ResponseBasis`."""
        return self.pushed.sizes

    def weights(self, frequencies_hz: Floats, forces: Complex) -> Complex:
        """See `ResponseBasis`."""
        return self.pushed.weights(self.spectrum(frequencies_hz), forces)

    def mixed(self, weights: NDArray[AnyFloat]) -> ContractedShapes[AnyFloat]:
        """See `ResponseBasis`."""
        return self.pushed.mixed(weights)


@dataclass(frozen=True, eq=False)
class TermsAmong:
    """Terms of a plate among many points.

    shapes : (n, n_modes); smooth : (n, n, N_NODES) terms that are no modes, symmetric; pushed : the plate under forces
    at each part of the points; known : index and forces of each part by its points, which may be repeated.
    """

    shapes: Floats
    smooth: Floats
    pushed: Sequence[ForcedPlate]
    known: Mapping[bytes, tuple[int, ForcedPlate]]

    @property
    def nbytes(self) -> int:
        """Memory [byte]."""
        return self.shapes.nbytes + self.smooth.nbytes + sum(part.nbytes for part in self.pushed)

    def joined(self, points_m: Floats) -> ForcedPlate:
        """The plate under forces at all of the points."""
        rest = np.concatenate([one.rest for one in self.pushed], axis=1)
        near = NearField(self.pushed[0].plate.modes, points_m)
        return replace(self.pushed[0], phi=self.shapes, rest=rest, near=near)

    @classmethod
    def of(cls, plate: PlateTerms, points_m: Floats, last: TermsAmong | None) -> TermsAmong:
        """Compute the terms, with those of the parts that `last` has too. They are the same to the last bit: each
        product is of two parts alone."""
        n, parts = len(points_m), parts_of(points_m)
        keys = [points_m[part].tobytes() for part in parts]
        known = {} if last is None else last.known
        before = [known[key][0] if key in known else -1 for key in keys]
        pushed = [
            known[key][1] if key in known else plate.of_forces(points_m[part].copy())
            for key, part in zip(keys, parts, strict=True)
        ]
        cosines, smooth = plate.cosines(points_m), np.empty((n, n, N_NODES))
        for j, columns in enumerate(parts):
            for i, rows in enumerate(parts[: j + 1]):
                if last is not None and 0 <= before[i] <= before[j]:
                    at, to = before[i], before[j]
                    found = last.smooth[at : at + rows.stop - rows.start, to : to + columns.stop - columns.start]
                else:
                    found = pushed[j].beyond_modes(points_m[rows], cosines[rows])
                    if keys[i] == keys[j]:
                        found = (found + found.transpose(1, 0, 2)) / 2
                smooth[rows, columns], smooth[columns, rows] = found, found.transpose(1, 0, 2)
        now = {key: (part.start, one) for key, part, one in zip(keys, parts, pushed, strict=True)}
        return cls(np.concatenate([one.phi for one in pushed]), smooth, pushed, now)


class ModalBody:
    """An `ElasticBody` by modes, for frequencies up to `max_frequency_hz`."""

    def __init__(self, plate: Plate, max_frequency_hz: float, loss_factor: float, fineness: Fineness = FINE) -> None:
        self.plate = plate
        self.loss_factor = loss_factor
        self.terms: PlateTerms = PlateTerms(plate, max_frequency_hz, fineness)
        self._at_forces = ByteBoundedLru(self._of_forces)
        self._among_forces = ByteBoundedLru(self._symmetric)
        self._among_many = ByteBoundedLru(self._terms_among, room=2)
        self._last_among: Callable[[], TermsAmong | None] = lambda: None
        self._coupled = ByteBoundedLru(self._between, room=2)
        self._sums = ByteBoundedLru(self._sums_at, room=4)

    @property
    def nbytes(self) -> int:
        """Memory [byte], without the cached values, which `ByteBoundedLru` bounds."""
        return self.terms.nbytes

    def receptance(self, points_m: Floats, forces_m: Floats, frequencies_hz: Floats) -> Complex:
        """See `ElasticBody`."""
        if points_m is not forces_m:
            return self._summed(self._at_forces(forces_m)(points_m), frequencies_hz)
        if has_many(points_m):
            found = self._among_many(points_m)
            return among(found.shapes, found.smooth, self.spectrum(frequencies_hz))
        if len(points_m) ** 2 * len(frequencies_hz) <= MOST_REMEMBERED:
            return self._coupled(points_m, frequencies_hz)
        return self._between(points_m, frequencies_hz)

    def separated(self, points_m: Floats, frequencies_hz: Floats) -> SeparatedReceptance:
        """See `Separable`."""
        found, spectrum = self._among_many(points_m), self.spectrum(frequencies_hz)
        n_modes = found.shapes.shape[1]
        return SeparatedReceptance(found.shapes, spectrum[:n_modes], found.smooth, spectrum[n_modes:])

    def pieces(self, points_m: Floats, forces_m: Floats, frequencies_hz: Floats) -> Iterator[tuple[slice, Complex]]:
        """See `Piecewise`."""
        terms = self._at_forces(forces_m)(points_m)
        for part, sums in self._sums(frequencies_hz).pieces(terms.reshape(-1, terms.shape[2])):
            yield part, sums.T.copy().reshape(-1, *terms.shape[:2])

    def response_basis(self, forces_m: Floats) -> ModalBasis:
        """See `HasResponseBasis`."""
        return ModalBasis(self._at_forces(forces_m), self.spectrum)

    def spectrum(self, frequencies_hz: Floats) -> Complex:
        """Value of each of the plate's terms at each frequency (n_terms, n_frequencies)."""
        q, scale = self._damped(frequencies_hz)
        return self.terms.spectrum(q) * scale

    def _between(self, points_m: Floats, frequencies_hz: Floats) -> Complex:
        among = _mirrored(self._sums(frequencies_hz)(self._among_forces(points_m)), len(points_m))
        return among.transpose(2, 0, 1)

    def _summed(self, terms: Floats, frequencies_hz: Floats) -> Complex:
        n_points, n_forces, n_terms = terms.shape
        flat: Complex = self._sums(frequencies_hz)(terms.reshape(-1, n_terms))
        return flat.reshape(n_points, n_forces, len(frequencies_hz)).transpose(2, 0, 1)

    def _sums_at(self, frequencies_hz: Floats) -> OctaveSums:
        return self.terms.sums(*self._damped(frequencies_hz))

    def _symmetric(self, points_m: Floats) -> Floats:
        """Terms of each pair of points (n (n + 1) / 2, n_terms), in the order of `_mirrored`."""
        terms = self._at_forces(points_m)(points_m)
        i, j = np.triu_indices(len(points_m))
        return (terms[i, j] + terms[j, i]) / 2  # of both, although only rounding differs: points have no order

    def _of_forces(self, forces_m: Floats) -> ForcedPlate:
        return self._among_many(forces_m).joined(forces_m) if has_many(forces_m) else self.terms.of_forces(forces_m)

    def _terms_among(self, points_m: Floats) -> TermsAmong:
        found = TermsAmong.of(self.terms, points_m, self._last_among())
        self._last_among = ref(found)
        return found

    def _damped(self, frequencies_hz: Floats) -> tuple[Complex, complex]:
        """q (n_frequencies,) [m^-4], and 1 / D_c [1/(N m)]."""
        loss = complex(1, self.loss_factor)
        q: Complex = (self.plate.wavenumber_rad_m(frequencies_hz) ** 4 / loss).astype(np.complex128)
        return q, 1 / (self.plate.bending_stiffness_nm * loss)


def _mirrored(upper: Complex, n: int) -> Complex:
    """Symmetric matrices (n, n, n_f) from their upper triangles (n (n + 1) / 2, n_f), in the order of
    `numpy.triu_indices`."""
    whole = np.empty((n, n, upper.shape[1]), dtype=np.complex128)
    begin = 0
    for i in range(n):
        row = upper[begin : begin + n - i]
        whole[i, i:] = row
        whole[i:, i] = row
        begin += n - i
    return whole
