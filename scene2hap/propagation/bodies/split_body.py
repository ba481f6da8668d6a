"""A plate that has edges up to a frequency and is infinite above it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scene2hap.common.arrays import Complex, Floats
from scene2hap.propagation.bodies.infinite_body import InfiniteBody
from scene2hap.propagation.elastic_body import DeflectionFunction, ElasticBody, contracted


@dataclass(frozen=True, eq=False)
class SplitBody:
    """An `ElasticBody` that has edges up to `limit_hz` and is infinite above it."""

    below: ElasticBody
    above: InfiniteBody
    limit_hz: float

    @property
    def nbytes(self) -> int:
        """Memory of the body below the limit [byte], 0 if it has no known size."""
        return int(getattr(self.below, "nbytes", 0))

    @property
    def loss_factor(self) -> float:
        """See `ElasticBody`."""
        return self.below.loss_factor

    def receptance(self, points_m: Floats, forces_m: Floats, frequencies_hz: Floats) -> Complex:
        """See `ElasticBody`."""
        is_low = frequencies_hz <= self.limit_hz
        answer = np.empty((len(is_low), len(points_m), len(forces_m)), dtype=np.complex128)
        answer[is_low] = self.below.receptance(points_m, forces_m, frequencies_hz[is_low])
        answer[~is_low] = self.above.receptance(points_m, forces_m, frequencies_hz[~is_low])
        return answer

    def under(self, forces_m: Floats, frequencies_hz: Floats, forces: Complex) -> DeflectionFunction:
        """See `Contractible`."""
        is_low = frequencies_hz <= self.limit_hz
        low = contracted(self.below, forces_m, frequencies_hz[is_low], forces[:, is_low])
        high = contracted(self.above, forces_m, frequencies_hz[~is_low], forces[:, ~is_low])

        def both(points_m: Floats) -> Floats:
            answer = np.empty((len(points_m), len(is_low)), dtype=np.complex128)
            answer[:, is_low], answer[:, ~is_low] = (one(points_m).view(np.complex128) for one in (low, high))
            return answer.view(np.float64)

        return both
