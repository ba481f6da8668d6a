"""Splines, assembled sums and factors of a lattice, each against scipy."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import BSpline
from scipy.sparse import csr_array, diags_array

from scene2hap import Outline, Plate
from scene2hap.materials import Material
from scene2hap.propagation.lattice import factors
from scene2hap.propagation.lattice.assembly import Pattern
from scene2hap.propagation.lattice.bending_lattice import bending_lattice
from scene2hap.propagation.lattice.factors import BandFactors, positive_factors
from scene2hap.propagation.lattice.spline_axis import SplineAxis

LINES = np.array([0.0, 0.1, 0.15, 0.4, 0.7, 0.72, 1.0])


@pytest.mark.parametrize("degree", [1, 2, 3])
def test_splines_are_those_of_de_boor(degree: int) -> None:
    x = np.append(np.random.default_rng(1).uniform(0.0, 1.0, 50), LINES)
    cell, values = SplineAxis.of(LINES).splines(x)
    expected = BSpline.design_matrix(x, np.pad(LINES, degree, mode="edge"), degree).toarray()
    found = np.zeros_like(expected)
    np.put_along_axis(found, cell[:, None] + np.arange(degree + 1), values[degree], axis=1)
    np.testing.assert_allclose(found, expected, atol=1e-15)


def test_strains_are_the_derivatives_of_the_deflection() -> None:
    axis, rng = SplineAxis.of(LINES), np.random.default_rng(2)
    c = rng.standard_normal(axis.n_nodes)
    x = rng.uniform(0.0, 1.0, 20)
    cell, values = axis.splines(x)
    own = c[cell[:, None] + np.arange(4)]
    spline = BSpline(np.pad(LINES, 3, mode="edge"), c, 3)
    slope = np.einsum("pi,pij,pj->p", values[2], axis.slope_of_cells[cell], own)
    bend = np.einsum("pi,pij,pj->p", values[1], axis.bend_of_cells[cell], own)
    np.testing.assert_allclose(slope, spline(x, 1), rtol=1e-10)
    np.testing.assert_allclose(bend, spline(x, 2), rtol=1e-10)


def test_sums_count_copies_at_one_place_apart() -> None:
    """Three pieces of two by two nodes in a grid of three columns; a cut separates the last two."""
    number = np.array([[0, 1, 4, 5], [1, 2, 5, 6], [1, 3, 5, 7]])
    place = np.array([0, 1, 2, 2, 7, 8, 9, 9])
    values = np.random.default_rng(3).standard_normal((3, 2, 2, 2, 2))
    row, column, (found,) = Pattern(number, np.array([0, 1, 7, 8]), place).summed([(values, 0, 0)])
    expected = np.zeros((8, 8))
    for piece, each in zip(number, values.transpose(0, 1, 3, 2, 4).reshape(3, 4, 4), strict=True):
        expected[np.ix_(piece, piece)] += each
    dense = np.zeros((8, 8))
    dense[row, column] = found
    np.testing.assert_allclose(dense, expected, atol=1e-15)
    assert (np.diff(row * 8 + column) > 0).all()


def test_stiffness_is_that_of_the_springs() -> None:
    rings = (((0, 0), (1.0, 0.1), (0.9, 0.7), (0.0, 0.6)), ((0.3, 0.3), (0.6, 0.3), (0.6, 0.32), (0.3, 0.32)))
    lattice = bending_lattice(Plate.of_outline(Outline(rings), 0.01, Material("test", 2500.0, 70e9, 0.3)), 8)
    by_springs = (lattice.springs.T @ lattice.weights @ lattice.springs).toarray()
    stiffness = lattice.stiffness.toarray()
    np.testing.assert_allclose(stiffness, by_springs, atol=1e-12 * np.abs(by_springs).max())
    np.testing.assert_allclose(lattice.weights.toarray(), lattice.weights.toarray().T, atol=1e-15)


@pytest.mark.parametrize("most", [factors.MOST_IN_BAND, 0])
def test_factors_in_a_band_and_sparse_ones_solve(most: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(factors, "MOST_IN_BAND", most)
    matrix = csr_array(
        diags_array([[5.0] * 40, [-1.0] * 39, [-1.0] * 39, [0.5] * 35, [0.5] * 35], offsets=[0, 1, -1, 5, -5])
    )
    found = positive_factors(matrix)
    assert isinstance(found, BandFactors) == (most > 0)
    rhs = np.random.default_rng(4).standard_normal((40, 3))
    for b in (rhs, rhs[:, 0]):
        np.testing.assert_allclose(found.solve(b), np.linalg.solve(matrix.toarray(), b), rtol=1e-10, atol=1e-12)


def test_a_matrix_that_is_not_positive_takes_sparse_factors() -> None:
    matrix = csr_array(diags_array([1.0, -2.0, 3.0]))
    np.testing.assert_allclose(positive_factors(matrix).solve(np.ones(3)), [1.0, -0.5, 1 / 3])
