"""Integrals of products of splines over pieces of cells, pixel by pixel.

Every spline of a cell is a spline along x times one along y. The integral of a product over a pixel is therefore an
integral along x times one along y. Pixels of a cut cell are added up by the share of each that lies within; a whole
cell takes the sums over all pixels at once.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scene2hap.common.arrays import Floats
from scene2hap.propagation.lattice.cell_pieces import PIXELS, CellPieces
from scene2hap.propagation.lattice.spline_axis import SplineAxis

Term = tuple[float, tuple[str, str], tuple[str, str]]
"""A factor, two functions along x and two along y, by their names in `PixelProducts.slices`."""
_PLACES, _WEIGHTS = np.polynomial.legendre.leggauss(4)


@dataclass(frozen=True, eq=False)
class PixelProducts:
    """Integrals over the pixels along one axis.

    lines : between pixels, which include the axis's own [m]; products : of each two functions of a cell (n_cells,
    PIXELS, n, n); slices : which of these n functions are the splines of degrees 1, 2 and 3 ("1", "2", "3"), and the
    first and second derivatives of those of degree 3 ("slope", "bend").
    """

    lines: Floats
    products: Floats
    slices: dict[str, slice]

    @classmethod
    def of(cls, axis: SplineAxis) -> PixelProducts:
        """Integrate over `PIXELS` pixels in each cell of an axis."""
        h = np.diff(axis.lines)[:, None] / PIXELS
        n = len(h)
        lines = np.append(axis.lines[:-1, None] + h * np.arange(PIXELS), axis.lines[-1])
        step = np.diff(lines)[:, None]
        x = (lines[:-1, None] + step * (_PLACES + 1) / 2).ravel()
        linear, quadratic, cubic = (each.reshape(n, -1, each.shape[1]) for each in axis.splines(x)[1].values())
        functions = {
            "1": linear,
            "2": quadratic,
            "3": cubic,
            "slope": quadratic @ axis.slope_of_cells,
            "bend": linear @ axis.bend_of_cells,
        }
        values = np.concatenate(list(functions.values()), axis=2).reshape(n * PIXELS, 4, -1)
        products = values.transpose(0, 2, 1) @ ((step * _WEIGHTS / 2)[..., None] * values)
        ends = np.cumsum([each.shape[2] for each in functions.values()]).tolist()
        slices = {name: slice(end - functions[name].shape[2], end) for name, end in zip(functions, ends, strict=True)}
        return cls(lines, products.reshape(n, PIXELS, *products.shape[1:]), slices)

    def of_pair(self, pair: tuple[str, str]) -> Floats:
        """Integrals of the products of two functions (n_cells, PIXELS, a, b)."""
        return self.products[:, :, self.slices[pair[0]], self.slices[pair[1]]]


class PieceIntegrals:
    """Integrals over pieces of cells."""

    def __init__(self, pieces: CellPieces, x: PixelProducts, y: PixelProducts) -> None:
        self._axes = x, y
        self._cell, self._shares = pieces.cell, pieces.shares
        self._whole, self._cut = np.flatnonzero(pieces.is_whole), np.flatnonzero(~pieces.is_whole)

    def of(self, *terms: Term) -> Floats:
        """Integrals of the sum of terms (n_pieces, a, b, c, d): the product of functions a along x and c along y of a
        cell, times the product of b along x and d along y."""
        x = [factor * self._axes[0].of_pair(pair) for factor, pair, _ in terms]
        y = [self._axes[1].of_pair(pair) for _, _, pair in terms]
        along, across = (np.stack(each, axis=2).reshape(len(each[0]), PIXELS, len(terms), -1) for each in (x, y))
        found = np.empty((len(self._cell), along.shape[3], across.shape[3]))
        cell_x, cell_y = self._cell[self._whole].T
        found[self._whole] = along.sum(axis=1)[cell_x].transpose(0, 2, 1) @ across.sum(axis=1)[cell_y]
        if len(self._cut):
            cell_x, cell_y = self._cell[self._cut].T
            shared = self._shares[self._cut] @ across.reshape(len(across), PIXELS, -1)[cell_y]
            shared = shared.reshape(len(self._cut), PIXELS * len(terms), -1)
            found[self._cut] = along.reshape(len(along), PIXELS * len(terms), -1)[cell_x].transpose(0, 2, 1) @ shared
        return found.reshape(-1, *x[0].shape[2:], *y[0].shape[2:])
