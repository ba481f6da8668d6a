"""A plate as masses on a grid, held in shape by bending and twisting springs.

    U = D/2 sum over springs of w_s e_s^2,  e = B u          K = B^T W B          M = m * area of each node

Every node has two bending springs over it and its neighbours, e = u_xx and e = u_yy, coupled by Poisson's ratio, and
every cell a twisting spring over its corners, e = u_xy: the energy of the plate by central differences and the
trapezoidal rule. So K is symmetric and never negative whatever the edges, and its error falls as the square of the
cell (derived here; measured in tests/physics/test_mass_spring_damper.py).

Edges need no equations of their own. Across a free edge the moment vanishes, u_xx = -nu u_yy, which leaves the spring
along it with 1 - nu^2; a simply supported edge holds its nodes; a clamped one mirrors the first node inside.

Letters: u [m] deflection, e [1/m] curvature, W [m^2] weights, D [N m] bending stiffness, m [kg/m2] mass per area,
nu [-] Poisson's ratio, h [m] cell.
Source: for the energy, Timoshenko and Woinowsky-Krieger, Theory of Plates and Shells, section 4.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from scene2hap.errors import ModelDomainError
from scene2hap.propagation.plate import Plate

if TYPE_CHECKING:
    from scipy.sparse import csr_array

LONGEST = 16
"""Cells along the longer side, in resolutions: on plates more slender than that they are longer than wide."""
MOST_NODES = 100_000
"""Nodes beyond which a lattice is refused: its factors then fill about a gigabyte."""


@dataclass(frozen=True, eq=False)
class Lattice:
    """Masses and springs of one plate, for D = 1 and m = 1.

    cells : along length and width; springs : B, sparse (n_springs, n_nodes) [m^-2]; weights : W, sparse, symmetric
    (n_springs, n_springs) [m^2]; areas_m2 : (n_nodes,) [m^2]; number : (nodes along length, along width) index of each
    node of the grid, -1 where an edge holds it.
    """

    plate: Plate
    cells: tuple[int, int]
    springs: csr_array
    weights: csr_array
    areas_m2: NDArray[np.float64]
    number: NDArray[np.intp]

    @property
    def n_nodes(self) -> int:
        """Nodes that can move."""
        return len(self.areas_m2)

    @property
    def cell_m(self) -> tuple[float, float]:
        """Sides of a cell [m]."""
        return self.plate.length_m / self.cells[0], self.plate.width_m / self.cells[1]

    @cached_property
    def stiffness(self) -> csr_array:
        """K = B^T W B, sparse (n_nodes, n_nodes) [m^-2]; times D it is the force per deflection."""
        from scipy.sparse import csr_array

        return csr_array(self.springs.T @ self.weights @ self.springs)

    @property
    def stiffest_k4(self) -> float:
        """A bound near the largest eigenvalue of K over the areas [m^-4]: neighbours swinging against each other."""
        return 16 * sum(h**-2 for h in self.cell_m) ** 2

    def restoring(self, deflections: NDArray[np.float64]) -> NDArray[np.float64]:
        """K u by way of the springs, which keeps the digits of long waves that differences of K would lose."""
        forces: NDArray[np.float64] = self.springs.T @ (self.weights @ (self.springs @ deflections))
        return forces

    def interpolation(self, points_m: NDArray[np.float64]) -> csr_array:
        """Deflection at points from that of the nodes, sparse (n_points, n_nodes); its transpose spreads a force.

        Cubic over the nearest four nodes of each axis. Used both ways, it leaves receptances reciprocal and passive.
        """
        from scipy.sparse import csr_array

        at_x, share_x = _cubic(points_m[:, 0] / self.cell_m[0], self.cells[0])
        at_y, share_y = _cubic(points_m[:, 1] / self.cell_m[1], self.cells[1])
        node = self.number[at_x[:, :, None], at_y[:, None, :]].reshape(len(points_m), 16)
        share = (share_x[:, :, None] * share_y[:, None, :]).reshape(len(points_m), 16)
        moves = node >= 0
        point = np.broadcast_to(np.arange(len(points_m))[:, None], node.shape)
        return csr_array((share[moves], (point[moves], node[moves])), shape=(len(points_m), self.n_nodes))


def cells_of(plate: Plate, resolution: int) -> tuple[int, int]:
    """Cells along length and width: `resolution` along the shorter side and, up to `LONGEST`, square ones."""
    shorter = min(plate.length_m, plate.width_m)
    along, across = (
        min(math.ceil(side / shorter * resolution * (1 - 1e-9)), LONGEST * resolution)
        for side in (plate.length_m, plate.width_m)
    )
    return along, across


@lru_cache(maxsize=16)
def bending_lattice(plate: Plate, resolution: int) -> Lattice:
    """The lattice of a plate, see `cells_of`.

    Raises: ModelDomainError: it has more than `MOST_NODES` nodes.
    """
    from scipy.sparse import block_array, csr_array, diags_array, kron

    nx, ny = cells_of(plate, resolution)
    if (nx + 1) * (ny + 1) > MOST_NODES:
        raise ModelDomainError(
            f"a lattice of {nx} × {ny} cells has {(nx + 1) * (ny + 1)} nodes; at most {MOST_NODES} are allowed. Ask "
            f"for a resolution below {resolution}, or use ModalPlate."
        )
    nu = plate.material.poisson_ratio
    x, y = _Axis.of(nx, plate.length_m, plate.edges[:2]), _Axis.of(ny, plate.width_m, plate.edges[2:])
    moves = np.outer(x.moves, y.moves).ravel()

    bend_x, bend_y = kron(x.bend, diags_array(np.ones(ny + 1))), kron(diags_array(np.ones(nx + 1)), y.bend)
    springs = block_array([[bend_x], [bend_y], [kron(x.slope, y.slope)]], format="csr")[:, moves]
    area = np.outer(x.share, y.share)
    along_x, along_y = area * (1 - nu**2 * y.free), area * (1 - nu**2 * x.free[:, None])
    poisson = nu * area * ~x.free[:, None] * ~y.free
    twist = np.full(nx * ny, 2 * (1 - nu) * plate.length_m * plate.width_m / (nx * ny))
    weights = block_array(
        [
            [diags_array(along_x.ravel()), diags_array(poisson.ravel()), None],
            [diags_array(poisson.ravel()), diags_array(along_y.ravel()), None],
            [None, None, diags_array(twist)],
        ],
        format="csr",
    )
    number = np.where(moves, np.cumsum(moves) - 1, -1).reshape(nx + 1, ny + 1)
    return Lattice(plate, (nx, ny), csr_array(springs), csr_array(weights), area.ravel()[moves], number)


@dataclass(frozen=True, eq=False)
class _Axis:
    """Differences along one coordinate of n cells.

    bend : second, at nodes, (n + 1, n + 1) [m^-2], without a row of its own where an edge is free or supported;
    slope : first, over cells, (n, n + 1) [m^-1]; share : length that belongs to each node [m]; free : whether it is an
    end without moment; moves : whether its edge lets it.
    """

    bend: csr_array
    slope: csr_array
    share: NDArray[np.float64]
    free: NDArray[np.bool_]
    moves: NDArray[np.bool_]

    @classmethod
    def of(cls, n: int, length_m: float, edges: str) -> _Axis:
        from scipy.sparse import csr_array, diags_array

        h = length_m / n
        middle, beside = np.full(n + 1, -2.0), np.ones((2, n))
        for end, edge in ((0, edges[0]), (-1, edges[1])):
            clamped = edge == "C"
            middle[end] = -2.0 * clamped
            beside[-1 if end == 0 else 0, end] = 2.0 * clamped  # the mirrored node counts twice
        bend = diags_array([beside[0], middle, beside[1]], offsets=[-1, 0, 1]) / h**2
        slope = diags_array(np.outer([-1.0, 1.0], np.ones(n)), offsets=[0, 1], shape=(n, n + 1)) / h
        share = np.full(n + 1, h)
        share[[0, -1]] /= 2
        free = np.zeros(n + 1, dtype=np.bool_)
        free[[0, -1]] = edges[0] == "F", edges[1] == "F"
        moves = np.ones(n + 1, dtype=np.bool_)
        moves[[0, -1]] = free[[0, -1]]
        return cls(csr_array(bend), csr_array(slope), share, free, moves)


def _cubic(at: NDArray[np.float64], n: int) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Nodes and Lagrange's weights (n_points, 4) for coordinates in cells, 0..n, on an axis of n >= 3 cells."""
    near = np.rint(at)
    at = np.where(np.abs(at - near) < 1e-9, near, at)  # an edge that holds its nodes holds points on it altogether
    first = np.clip(np.floor(at).astype(np.intp) - 1, 0, n - 3)
    t = np.clip(at, 0.0, n) - first
    weights = np.stack(
        [
            -(t - 1) * (t - 2) * (t - 3) / 6,
            t * (t - 2) * (t - 3) / 2,
            -t * (t - 1) * (t - 3) / 2,
            t * (t - 1) * (t - 2) / 6,
        ],
        axis=1,
    )
    return first[:, None] + np.arange(4), weights
