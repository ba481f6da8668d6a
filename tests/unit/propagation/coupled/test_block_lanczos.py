"""Block Lanczos eigensolver, against dense solutions."""

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.sparse import csr_array, diags_array, kron
from scipy.sparse.linalg import splu

from scene2hap.propagation.lattice.block_lanczos import largest

Floats = np.ndarray


def chain(n: int) -> csr_array:
    """Stiffness of a row of masses joined by springs, fixed at both ends."""
    return csr_array(diags_array([-np.ones(n - 1), 2 * np.ones(n), -np.ones(n - 1)], offsets=(-1, 0, 1)))


def problem(kind: str) -> tuple[csr_array, csr_array]:
    """Stiffness and mass matrices of a problem."""
    if kind == "square":  # each eigenvalue twice, except those on the diagonal
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
@pytest.mark.parametrize("guess", [0.3, 1.0, 3.0])
def test_block_lanczos_finds_all_that_a_dense_solver_finds(kind: str, count: int, guess: float) -> None:
    """The result does not depend on the guessed number of modes."""
    stiffness, masses = problem(kind)
    solve = splu(stiffness.tocsc()).solve
    exact = eigh(stiffness.toarray(), masses.toarray())[0]
    least = 2 / exact[count - 1 : count + 1].sum() if count < len(exact) else 0.0
    vectors = largest(solve, masses, least, guess * count)
    assert vectors.shape[0] == stiffness.shape[0]
    n = vectors.shape[1]
    assert count <= n <= count + 1
    assert np.allclose(vectors.T @ (masses @ vectors), np.eye(n), atol=1e-9)
    found = np.einsum("in,in->n", vectors, stiffness @ vectors)
    assert np.allclose(found, exact[:n], rtol=1e-8)


def test_block_lanczos_is_deterministic() -> None:
    stiffness, masses = problem("square")
    solve = splu(stiffness.tocsc()).solve
    assert np.array_equal(largest(solve, masses, 5.0, 12), largest(solve, masses, 5.0, 12))


def test_close_eigenvalues_are_separated() -> None:
    """A soft row on a stiff ground: eigenvalues that differ by about a millionth are separated."""
    stiffness, masses = problem("row")
    shift = 1e6
    solve = splu((stiffness + shift * masses).tocsc()).solve
    expected = eigh(stiffness.toarray(), masses.toarray())[0][:7]
    vectors = largest(solve, masses, 1 / (shift + expected[5:7].mean()), 6)[:, :6]
    projected = vectors.T @ (stiffness @ vectors)
    assert np.allclose(np.linalg.eigvalsh(projected), expected[:6], rtol=1e-3)
