"""Sparse elimination of the system of all joints, against LAPACK on the dense matrix."""

import numpy as np
import pytest

from scene2hap.propagation.coupled import elimination
from scene2hap.propagation.coupled.elimination import Element, inverse, solve
from scene2hap.propagation.coupled.elimination_order import merged_fronts, pattern_of

N_F = 40


def room(rng: np.random.Generator, pairs: list[tuple[int, int]]) -> list[Element]:
    """Elements with one row per pair of bodies and random symmetric matrices."""
    elements = []
    for body in range(1 + max(max(pair) for pair in pairs)):
        rows = np.array([row for row, pair in enumerate(pairs) if body in pair], dtype=np.intp)
        matrix = rng.normal(size=(2, N_F, len(rows), len(rows)))
        signs = np.array([1.0 if body == pairs[row][0] else -1.0 for row in rows])
        real, imaginary = matrix + matrix.transpose(0, 1, 3, 2)
        elements.append(Element(rows, signs, real + 1j * imaginary))
    return elements


def whole(elements: list[Element], compliance: np.ndarray, free: np.ndarray) -> np.ndarray:
    n = len(compliance)
    system = np.zeros((N_F, n, n), dtype=np.complex128)
    for element in elements:
        signed = np.multiply.outer(element.signs, element.signs) * element.receptance
        system[:, element.rows[:, None], element.rows] += signed
    system[:, np.arange(n), np.arange(n)] += compliance.T
    return np.linalg.solve(system, np.broadcast_to(free, (N_F, *free.shape)))


PAIRS = {
    "chain": [(i, i + 1) for i in range(12)],
    "ring": [(i, (i + 1) % 9) for i in range(9)],
    "four feet each": [(i, i + 1) for i in range(6) for _ in range(4)],
    "all on a floor": [(0, i) for i in range(1, 15) for _ in range(3)] + [(3, 4), (5, 6), (5, 9)],
    "two apart": [(0, 1), (1, 2), (3, 4), (3, 4)],
}


@pytest.mark.parametrize("shape", PAIRS)
def test_elimination_equals_lapack(shape: str) -> None:
    rng = np.random.default_rng(11)
    elements = room(rng, PAIRS[shape])
    n = len(PAIRS[shape])
    compliance = 4 + rng.normal(size=(n, N_F)) + 1j * rng.normal(size=(n, N_F))
    free = np.sign(rng.normal(size=(n, 3)))
    expected = whole(elements, compliance, free)
    found = solve(elements, compliance, free).transpose(2, 0, 1)
    assert (np.abs(found - expected) <= 1e-9 * np.abs(expected).max(axis=(1, 2), keepdims=True)).all()


@pytest.mark.parametrize("shape", PAIRS)
@pytest.mark.parametrize("worst_growth", [elimination.WORST_GROWTH, 3.0])
def test_the_inverse_among_the_joints_of_a_body(
    shape: str, worst_growth: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also with a low growth limit, by which many frequencies are solved again."""
    monkeypatch.setattr(elimination, "WORST_GROWTH", worst_growth)
    rng = np.random.default_rng(12)
    elements = room(rng, PAIRS[shape])
    n = len(PAIRS[shape])
    compliance = 4 + rng.normal(size=(n, N_F)) + 1j * rng.normal(size=(n, N_F))
    expected = whole(elements, compliance, np.eye(n))
    columns = np.array([n - 1, 2])
    solved, inverses = inverse(elements, compliance, columns, range(1, len(elements)))
    largest = np.abs(expected).max(axis=(1, 2), keepdims=True)
    assert (np.abs(solved.transpose(2, 0, 1) - expected[:, :, columns]) <= 1e-8 * largest).all()
    assert inverses.keys() == set(range(1, len(elements)))
    for k, found in inverses.items():
        rows = elements[k].rows
        assert (np.abs(found - expected[:, rows[:, None], rows]) <= 1e-8 * largest).all()


@pytest.mark.parametrize("slack", [0.0, elimination.SLACK])
def test_pivots_that_vanish_at_some_frequencies(slack: float, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(elimination, "SLACK", slack)
    rng = np.random.default_rng(3)
    elements = room(rng, PAIRS["chain"])
    compliance = np.zeros((12, N_F), dtype=np.complex128)
    for row, (a, b) in enumerate(PAIRS["chain"]):
        own = sum(
            element.receptance[:, list(element.rows).index(row), list(element.rows).index(row)]
            for element in (elements[a], elements[b])
        )
        compliance[row, 7] = -own[7]
        compliance[row, 9] = 1e-14 - own[9]
    free = np.ones((12, 1))
    expected = whole(elements, compliance, free)
    np.testing.assert_allclose(solve(elements, compliance, free).transpose(2, 0, 1), expected, rtol=1e-7)


def test_every_joint_is_eliminated_once_and_fronts_stay_narrow() -> None:
    """Forty objects with four feet each stand on eight shelves on a floor: no front is wider than 32 rows."""
    pairs = [(1 + i // 5, 9 + i) for i in range(40) for _ in range(4)] + [
        (0, 1 + i) for i in range(8) for _ in range(4)
    ]
    rows_of = tuple(tuple(row for row, pair in enumerate(pairs) if body in pair) for body in range(49))
    fronts = merged_fronts(rows_of)
    assert sorted(row for shared, _ in fronts for row in shared) == list(range(len(pairs)))
    assert max(len(shared) + len(others) for shared, others in fronts) <= 32


@pytest.mark.parametrize("shape", PAIRS)
def test_the_pattern_holds_every_entry_of_the_factor(shape: str) -> None:
    pairs = PAIRS[shape]
    bodies = range(1 + max(max(pair) for pair in pairs))
    rows_of = tuple(tuple(row for row, pair in enumerate(pairs) if body in pair) for body in bodies)
    pattern, n = pattern_of(rows_of), len(pairs)
    filled = np.zeros((n, n), dtype=bool)
    for rows in rows_of:
        places = pattern.place[list(rows)]
        filled[places[:, None], places] = True
    for i in range(n):
        after = i + 1 + np.flatnonzero(filled[i, i + 1 :])
        filled[after[:, None], after] = True
    assert (pattern.entry[np.triu(filled)] >= 0).all()
    for i in range(n):
        own = pattern.columns[pattern.begins[i] : pattern.begins[i + 1]]
        assert own[0] == i
        assert (np.diff(own) > 0).all()
        np.testing.assert_array_equal(pattern.entry[i, own], np.arange(pattern.begins[i], pattern.begins[i + 1]))


@pytest.mark.parametrize("shape", PAIRS)
def test_sources_that_move_some_rows_only(shape: str) -> None:
    rng = np.random.default_rng(7)
    pairs = PAIRS[shape]
    elements, n = room(rng, pairs), len(pairs)
    compliance = 4 + rng.normal(size=(n, N_F)) + 1j * rng.normal(size=(n, N_F))
    free = np.zeros((n, 4))  # the last source moves nothing
    for column, body in enumerate((0, pairs[-1][1], pairs[n // 2][0])):
        free[elements[body].rows, column] = elements[body].signs
    expected = whole(elements, compliance, free)
    found = solve(elements, compliance, free).transpose(2, 0, 1)
    assert (np.abs(found - expected) <= 1e-9 * np.abs(expected).max(axis=(1, 2), keepdims=True)).all()
    assert not found[:, :, 3].any()


@pytest.mark.parametrize("n_f", [1, 2, 3, 4, 5])
def test_results_do_not_depend_on_frequency_batches(n_f: int) -> None:
    rng = np.random.default_rng(2)
    elements = room(rng, PAIRS["ring"])
    compliance = 4 + rng.normal(size=(9, N_F)) + 1j * rng.normal(size=(9, N_F))
    free = np.sign(rng.normal(size=(9, 2)))
    few = [Element(one.rows, one.signs, one.receptance[3 : 3 + n_f]) for one in elements]
    found = solve(few, compliance[:, 3 : 3 + n_f], free)
    np.testing.assert_allclose(found, solve(elements, compliance, free)[:, :, 3 : 3 + n_f], rtol=1e-12)


def test_dense_systems_are_in_memory_a_few_at_a_time(monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(4)
    elements, n = room(rng, PAIRS["chain"]), 12
    diagonal = 4 + rng.normal(size=(n, N_F)) + 1j * rng.normal(size=(n, N_F))
    monkeypatch.setattr(elimination, "_DENSE", 3 * n**2)
    parts = list(elimination.dense(elements, diagonal, np.arange(5, 30)))
    assert max(len(at) for at, _ in parts) <= 3
    np.testing.assert_array_equal(np.concatenate([at for at, _ in parts]), np.arange(5, 30))
    expected = whole(elements, diagonal, np.eye(n))[5:30]
    np.testing.assert_allclose(np.linalg.inv(np.concatenate([system for _, system in parts])), expected, rtol=1e-9)
    assert not list(elimination.dense(elements, diagonal, np.arange(0)))


def test_systems_that_are_nearly_full_are_left_to_lapack(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of bodies that all stand on one floor; forces and parts of the inverse are those of the kernel."""
    rng = np.random.default_rng(8)
    pairs = [(0, i) for i in range(1, 30) for _ in range(3)]
    elements, n = room(rng, pairs), len(pairs)
    compliance = 40 + rng.normal(size=(n, N_F)) + 1j * rng.normal(size=(n, N_F))
    free = np.sign(rng.normal(size=(n, 2)))
    columns = np.array([4, 1])

    def solved() -> list[np.ndarray]:
        both, parts = inverse(elements, compliance, columns, [0, 3])
        alone, _ = inverse(elements, compliance, columns, [])
        return [solve(elements, compliance, free), both, alone, parts[0], parts[3]]

    by_kernel = solved()
    monkeypatch.setattr(elimination, "CACHE_BYTES", 0)
    pattern = pattern_of(tuple(tuple(element.rows.tolist()) for element in elements))
    assert elimination.is_nearly_full(pattern, 2, inverts=False)
    assert elimination.is_nearly_full(pattern, 2, inverts=True)
    for one, other in zip(by_kernel, solved(), strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-9, atol=1e-12)
