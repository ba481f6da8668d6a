"""Interfaces of a single body: its receptance, and what a body may offer besides to be evaluated faster.

A body that is a sum of shape functions has a `ResponseBasis`. The deflection at any frequency is a weighted sum of the
shapes. All sums that do not depend on the touched point (over contacts, sources, frequencies) are computed before a
touch. Other bodies may be `Contractible` or `Piecewise`. A `SpatialBody` moves in three directions.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple, Protocol, TypeVar, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Complex, Floats

AnyFloat = TypeVar("AnyFloat", np.float32, np.float64)

DeflectionFunction = Callable[[Floats], Floats]
"""Function from points (n_points, 2) [m] to deflections (n_points, 2 n_frequencies), with real and imaginary parts
alternating."""

MOST_CONTRACTED = 64
"""Most frequencies at which `contracted` sums in advance: an object keeps up to some 100 kB for each. More are summed
at every touch."""


class ElasticBody(Protocol):
    """Interface of a single body that a model provides for coupling."""

    @property
    def loss_factor(self) -> float:
        """Smallest loss factor of the resonances [-], infinite without any; it decides how finely bands are sampled."""
        ...

    def receptance(self, points_m: Floats, forces_m: Floats, frequencies_hz: Floats) -> Complex:
        """Deflection at points per force at others.

        Parameters: points_m : (n_points, 2), forces_m : (n_forces, 2) [m], in the body's own coordinates, such as from
        a plate's corner along length and width; frequencies_hz : (n_frequencies,) > 0 [Hz].
        Returns: (n_frequencies, n_points, n_forces) complex128 [m/N]. If points and forces are the same, it is
        symmetric, and for a body that gains no energy its imaginary part is negative semidefinite.
        """
        ...


class SpatialBody:
    """Base of bodies that move in three directions. Points of such an `ElasticBody` are ports (n, 6): x, y and height
    over the mid-plane [m], and a unit direction, all in the body's coordinates.

    A base and not a protocol, since every touch under a hand asks for it: a protocol takes microseconds to check.
    """

    def felt(self, points_m: Floats) -> Floats:
        """Ports (3 n, 6) of points (n, 2) [m] in three directions: all points along the normal, then along y and x."""
        n = len(points_m)
        flat = np.column_stack([points_m, np.zeros(n)])
        return np.concatenate([np.column_stack([flat, np.tile(axis, (n, 1))]) for axis in np.eye(3)[::-1]])


class ResponseBasis(Protocol):
    """Shape functions s_i(x) that span a body's deflection under forces:  u(x, f) = sum over i of s_i(x) W_i(f)."""

    @property
    def sizes(self) -> Floats:
        """Typical magnitude of each shape (n_shapes,), to compare their contributions."""
        ...

    def weights(self, frequencies_hz: Floats, forces: Complex) -> Complex:
        """W (n_shapes, n, n_f) under forces (n_forces, n, n_f) at frequencies (n_f,) [Hz]."""
        ...

    def mixed(self, weights: NDArray[AnyFloat]) -> Callable[[Floats], NDArray[AnyFloat]]:
        """Sums of the shapes with weights (n_shapes, n), as a function from points (n_points, 2) [m] to (n_points, n),
        in the precision of the weights."""
        ...


@runtime_checkable
class HasResponseBasis(Protocol):
    """A body whose deflection under any forces is a sum of shape functions."""

    def response_basis(self, forces_m: Floats) -> ResponseBasis:
        """The shapes for forces at points (n_forces, 2) [m]."""
        ...


@runtime_checkable
class Contractible(Protocol):
    """A body without a `ResponseBasis` that can sum over known forces before the touched point is known."""

    def under(self, forces_m: Floats, frequencies_hz: Floats, forces: Complex) -> DeflectionFunction:
        """Deflection under forces (n_forces, n_frequencies) at points (n_forces, 2) [m]."""
        ...


@runtime_checkable
class Piecewise(Protocol):
    """A body that returns its receptance a few frequencies at a time, each part used while it is in the cache."""

    def pieces(self, points_m: Floats, forces_m: Floats, frequencies_hz: Floats) -> Iterator[tuple[slice, Complex]]:
        """Yield each part of the frequencies and the receptance there, see `ElasticBody.receptance`."""
        ...


class SeparatedReceptance(NamedTuple):
    """Receptance of a body among n of its points, as sums of terms that depend on points or on frequencies only.

        Y(x_i, x_j) = sum over modes of shapes_i shapes_j resonance(f)  +  sum over m of smooth_ijm between_m(f)

    shapes : (n, n_modes); resonance : (n_modes, n_f), not 0; smooth : (n, n, n_smooth), symmetric, small; between :
    (n_smooth, n_f).
    """

    shapes: Floats
    resonance: Complex
    smooth: Floats
    between: Complex


@runtime_checkable
class Separable(Protocol):
    """A body that returns its receptance among many points without summing it at any frequency."""

    def separated(self, points_m: Floats, frequencies_hz: Floats) -> SeparatedReceptance | None:
        """The receptance among points (n, 2) [m]; None if a part of the body is not separable."""
        ...


def pieces(
    body: ElasticBody, points_m: Floats, forces_m: Floats, frequencies_hz: Floats
) -> Iterator[tuple[slice, Complex]]:
    """See `Piecewise.pieces`; any other body gives all frequencies at once."""
    if isinstance(body, Piecewise):
        return body.pieces(points_m, forces_m, frequencies_hz)
    return iter([(slice(None), np.ascontiguousarray(body.receptance(points_m, forces_m, frequencies_hz)))])


def contracted(body: ElasticBody, forces_m: Floats, frequencies_hz: Floats, forces: Complex) -> DeflectionFunction:
    """Deflection under known forces as a function of points, see `Contractible.under`; other bodies sum over contacts
    at each query."""
    if len(frequencies_hz) <= MOST_CONTRACTED:
        if isinstance(body, HasResponseBasis):
            basis = body.response_basis(forces_m)
            return basis.mixed(basis.weights(frequencies_hz, forces[:, None])[:, 0].view(np.float64))
        if isinstance(body, Contractible):
            return body.under(forces_m, frequencies_hz, forces)

    def summed(points_m: Floats) -> Floats:
        receptance = body.receptance(points_m, forces_m, frequencies_hz)
        return np.ascontiguousarray(np.einsum("fpc,cf->pf", receptance, forces)).view(np.float64)

    return summed


def felt_ports(body: ElasticBody, points_m: Floats) -> Floats:
    """Points of a body, or the ports of a `SpatialBody`: one for each direction at each point."""
    return body.felt(points_m) if isinstance(body, SpatialBody) else points_m


def real_times(matrix: Floats, columns: Complex) -> Complex:
    """Multiply a real matrix (m, n) by complex columns (n, ...), at half the cost of a complex product."""
    flat = np.ascontiguousarray(columns).reshape(len(columns), math.prod(columns.shape[1:])).view(np.float64)
    return (matrix @ flat).view(np.complex128).reshape(len(matrix), *columns.shape[1:])
