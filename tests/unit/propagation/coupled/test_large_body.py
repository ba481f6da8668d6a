"""Solver for one body with hundreds of joints, against LAPACK on the dense matrix."""

import numpy as np
import pytest

from scene2hap.propagation.coupled import large_body
from scene2hap.propagation.coupled.elimination import Element
from scene2hap.propagation.elastic_body import SeparatedReceptance

N_F, N_MODES, N_SMOOTH = 5, 7, 2


def symmetric(rng: np.random.Generator, *shape: int) -> np.ndarray:
    matrix = rng.normal(size=shape)
    return matrix + matrix.swapaxes(-1, -2)


class Scene:
    """Twelve objects with 1 to 4 feet on a floor, two of them side by side, and two whose joint is not on the floor."""

    def __init__(self, remainder: float) -> None:
        rng = np.random.default_rng(4)
        pairs = [(0, k) for k in range(1, 13) for _ in range(1 + k % 4)] + [(5, 6), (9, 10), (9, 10)]
        pairs = [pairs[i] for i in rng.permutation(len(pairs))]
        self.n = len(pairs)
        rows = [np.array([row for row, pair in enumerate(pairs) if body in pair]) for body in range(13)]
        signs = [np.array([1.0 if pairs[row][0] == body else -1.0 for row in rows[body]]) for body in range(13)]
        n_own = len(rows[0])
        between = rng.normal(size=(N_SMOOTH, N_F)) * (1 + 0.1j)
        resonance = rng.normal(size=(N_MODES, N_F)) + 1j * rng.normal(size=(N_MODES, N_F))
        smooth = remainder * symmetric(rng, N_SMOOTH, n_own, n_own).transpose(1, 2, 0)
        self.large = SeparatedReceptance(rng.normal(size=(n_own, N_MODES)), resonance, smooth, between)
        self.rows, self.signs = rows[0], signs[0]
        self.others = [
            Element(own, sign, symmetric(rng, N_F, len(own), len(own)) + 0.3j * np.eye(len(own)))
            for own, sign in zip(rows[1:], signs[1:], strict=True)
        ]
        self.compliance = 6 + rng.normal(size=(self.n, N_F)) + 1j * rng.normal(size=(self.n, N_F))
        self.free = np.sign(rng.normal(size=(self.n, 3)))

    def expected(self) -> np.ndarray:
        system = np.zeros((N_F, self.n, self.n), dtype=np.complex128)
        large = self.large
        floor = np.einsum("im,jm,mf->fij", large.shapes, large.shapes, large.resonance)
        floor += np.einsum("ijm,mf->fij", large.smooth, large.between)
        for own in [Element(self.rows, self.signs, floor), *self.others]:
            signs = np.multiply.outer(own.signs, own.signs)
            system[:, own.rows[:, None], own.rows] += signs * own.receptance
        system[:, np.arange(self.n), np.arange(self.n)] += self.compliance.T
        return np.linalg.solve(system, np.broadcast_to(self.free, (N_F, *self.free.shape))).transpose(1, 2, 0)

    def solved(self, wanted: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        args = (self.large, self.rows, self.signs, self.others, self.compliance, self.free, wanted)
        return large_body.solve(*args)


@pytest.mark.parametrize("at_once", [1, 10**9])
def test_equals_lapack(at_once: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(large_body, "AT_ONCE_BYTES", at_once)
    scene = Scene(remainder=0.02)
    expected = scene.expected()
    found, is_solved = scene.solved(np.ones((3, N_F), dtype=bool))
    assert is_solved.all()
    assert np.abs(found - expected).max() <= 1e-9 * np.abs(expected).max()


def test_solves_what_is_wanted_alone() -> None:
    scene = Scene(remainder=0.02)
    wanted = np.array([[1, 1, 0, 0, 0], [0, 0, 0, 1, 1], [0, 0, 0, 0, 0]], dtype=bool)
    found, is_solved = scene.solved(wanted)
    expected = np.where(wanted, scene.expected(), 0.0)
    assert is_solved.all()
    assert not found[:, ~wanted].any()
    assert np.abs(found - expected).max() <= 1e-9 * np.abs(expected).max()


def test_tells_which_frequencies_are_not_solved(monkeypatch: pytest.MonkeyPatch) -> None:
    """With few steps, where the remainder is as large as the rest and does not vanish by chance."""
    monkeypatch.setattr(large_body, "MOST_STEPS", 3)
    scene = Scene(remainder=2.0)
    scene.large.between[:, 1] = 0.0
    found, is_solved = scene.solved(np.ones((3, N_F), dtype=bool))
    assert is_solved.tolist() == [False, True, False, False, False]
    expected = scene.expected()
    assert np.abs((found - expected)[:, :, 1]).max() <= 1e-9 * np.abs(expected[:, :, 1]).max()


def test_gives_up_early_where_nothing_converges(monkeypatch: pytest.MonkeyPatch) -> None:
    steps: list[int] = []
    rest = large_body._Columns._rest
    monkeypatch.setattr(large_body._Columns, "_rest", lambda *args: steps.append(1) or rest(*args))
    _, is_solved = Scene(remainder=20.0).solved(np.ones((3, N_F), dtype=bool))
    assert not is_solved.any()
    assert len(steps) < large_body.MOST_STEPS / 2


def test_blocks_are_what_is_connected_without_the_large_body() -> None:
    several = [np.array(rows) for rows in ([0, 4], [2], [4, 6], [1, 3], [5, 3])]
    found = {tuple(block.tolist()) for block in large_body.blocks_of(several)}
    assert found == {(0, 4, 6), (2,), (1, 3, 5)}
