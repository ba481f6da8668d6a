"""Lanczos' method in blocks against dense solutions."""

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.sparse import csr_array, diags_array, kron
from scipy.sparse.linalg import splu

from scene2hap.propagation.lattice.block_lanczos import largest

Floats = np.ndarray


def chain(n: int) -> csr_array:
    """Springs along a row of masses, held at its ends."""
    return csr_array(diags_array([-np.ones(n - 1), 2 * np.ones(n), -np.ones(n - 1)], offsets=(-1, 0, 1)))


def problem(kind: str) -> tuple[csr_array, csr_array]:
    """Stiffness and masses."""
    if kind == "square":  # each value twice, but for those on the diagonal
        one = chain(17)
        eye = diags_array(np.ones(17))
        n = 17 * 17
        return csr_array(kron(one, eye) + kron(eye, one)), csr_array(diags_array(np.ones(n)))
    n = {"row": 240, "few": 9}[kind]
    masses = diags_array(
        [0.2 * np.ones(n - 1), 1 + 0.5 * np.cos(np.arange(n)), 0.2 * np.ones(n - 1)], offsets=(-1, 0, 1)
    )
    return chain(n), csr_array(masses)


@pytest.mark.parametrize(("kind", "count"), [("row", 5), ("row", 47), ("square", 24), ("few", 4), ("few", 9)])
def test_block_lanczos_equals_a_dense_solver(kind: str, count: int) -> None:
    stiffness, masses = problem(kind)
    solve = splu(stiffness.tocsc()).solve
    vectors = largest(solve, masses, count)
    expected = eigh(stiffness.toarray(), masses.toarray())[0][:count]
    assert vectors.shape == (stiffness.shape[0], count)
    assert np.allclose(vectors.T @ (masses @ vectors), np.eye(count), atol=1e-9)
    found = np.einsum("in,in->n", vectors, stiffness @ vectors)
    assert np.allclose(found, expected, rtol=1e-8)


def test_block_lanczos_is_deterministic() -> None:
    stiffness, masses = problem("square")
    solve = splu(stiffness.tocsc()).solve
    assert np.array_equal(largest(solve, masses, 12), largest(solve, masses, 12))


def test_close_eigenvalues_are_separated() -> None:
    """A stiff ground under a soft row: the values are alike to a millionth, and still told apart."""
    stiffness, masses = problem("row")
    shift = 1e6
    solve = splu((stiffness + shift * masses).tocsc()).solve
    vectors = largest(solve, masses, 6)
    projected = vectors.T @ (stiffness @ vectors)
    expected = eigh(stiffness.toarray(), masses.toarray())[0][:6]
    assert np.allclose(np.linalg.eigvalsh(projected), expected, rtol=1e-3)
