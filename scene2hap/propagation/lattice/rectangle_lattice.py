"""Lattice of a rectangular plate: all integrals are products of integrals along its two axes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from scene2hap.propagation.lattice.lattice import Lattice, rounding_k4
from scene2hap.propagation.lattice.spline_axis import SplineAxis
from scene2hap.propagation.plate import Plate

if TYPE_CHECKING:
    from scipy.sparse import csr_array


def rectangle_lattice(plate: Plate, axes: tuple[SplineAxis, SplineAxis]) -> Lattice:
    """Return the lattice of a rectangular plate over the lines of these axes, with the edges of the plate."""
    from scipy.sparse import block_array, csr_array, eye_array, kron

    (x, y), nu = axes, plate.material.poisson_ratio
    free_x, free_y = x.free(plate.edges[:2]), y.free(plate.edges[2:])
    at_x, at_y = (csr_array(eye_array(axis.n_nodes))[:, free] for axis, free in ((x, free_x), (y, free_y)))
    bend_x, slope_x = (_sparse(rows)[:, free_x] for rows in (x.bend, x.slope))
    bend_y, slope_y = (_sparse(rows)[:, free_y] for rows in (y.bend, y.slope))
    springs = csr_array(block_array([[kron(bend_x, at_y)], [kron(at_x, bend_y)], [kron(slope_x, slope_y)]]))
    (xx, yy), (mixed_x, mixed_y) = ((axis.products(3, 3) for axis in axes), (axis.products(1, 3) for axis in axes))
    poisson = nu * kron(mixed_x, mixed_y.T)
    weights = csr_array(
        block_array(
            [
                [kron(x.products(1, 1), yy), poisson, None],
                [poisson.T, kron(xx, y.products(1, 1)), None],
                [None, None, 2 * (1 - nu) * kron(x.products(2, 2), y.products(2, 2))],
            ]
        )
    )
    masses = csr_array(kron(xx[free_x, free_x], yy[free_y, free_y]))
    number = np.full((x.n_nodes, y.n_nodes), -1, dtype=np.intp)
    number[free_x, free_y] = np.arange(masses.shape[0]).reshape(number[free_x, free_y].shape)

    def interpolation(points_m: NDArray[np.float64]) -> csr_array:
        (node_x, share_x), (node_y, share_y) = x.at(points_m[:, 0]), y.at(points_m[:, 1])
        node = number[node_x[:, :, None], node_y[:, None, :]].ravel()
        share = (share_x[:, :, None] * share_y[:, None, :]).ravel()
        row = np.repeat(np.arange(len(points_m)), 16)[node >= 0]
        return csr_array((share[node >= 0], (row, node[node >= 0])), shape=(len(points_m), masses.shape[0]))

    cell_m = plate.length_m / (x.n_nodes - 3), plate.width_m / (y.n_nodes - 3)
    stiffness = csr_array(springs.T @ weights @ springs)
    rounding = rounding_k4(stiffness.diagonal(), plate.area_m2)
    return Lattice(plate, cell_m, masses, stiffness, rounding, interpolation, lambda: (springs, weights))


def _sparse(rows: NDArray[np.float64]) -> csr_array:
    """Sparse matrix from the nonzero entries of each row (n, width), from the diagonal on."""
    from scipy.sparse import csr_array

    n, width = rows.shape
    columns = np.arange(n)[:, None] + np.arange(width)
    return csr_array((rows.ravel(), columns.ravel(), width * np.arange(n + 1)), shape=(n, n + width - 1))
