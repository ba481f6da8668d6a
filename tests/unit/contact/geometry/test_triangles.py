"""Distances of triangles, against least squares, linear programs, dense sampling, and cases known by hand."""

import numpy as np
import pytest
from hypothesis import assume, example, given, settings, strategies as st
from numpy.typing import NDArray
from scipy.optimize import linprog, nnls

from scene2hap.contact.geometry.triangles import Meetings, heights, meetings
from scene2hap.contact.geometry.vectors import upright_frame

Floats = NDArray[np.float64]

FLAT = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
COORDINATES = st.lists(st.integers(-8, 8), min_size=18, max_size=18)
SMOOTH = st.integers(0, 10**6)


def axes_first(triangles: object) -> Floats:
    """Convert triangles (n, 3, 3), whose rows are corners, to the layout of the library."""
    return np.array(triangles, dtype=float).transpose(2, 1, 0)


def all_meetings(p: object, q: object) -> Meetings:
    """The meetings of all corners and edges."""
    first, second = axes_first(p), axes_first(q)
    features = np.full(first.shape[2], 0b111_111, dtype=np.uint8)
    return meetings(first, second, features, features)


def one(p: object, q: object) -> tuple[float, Floats, Floats]:
    every = all_meetings([p], [q])
    k = int(every.distance[:, 0].argmin())
    return float(every.distance[k, 0]), every.on_p[:, k, 0], every.on_q[:, k, 0]


def distances(p: object, q: object) -> Floats:
    least: Floats = all_meetings(p, q).distance.min(axis=0)
    return least


def height_range(p: Floats, q: Floats, up: tuple[float, float, float]) -> tuple[Floats, Floats]:
    frame = np.array(upright_frame(up))
    return heights(np.einsum("ab,bcn->acn", frame, p), np.einsum("ab,bcn->acn", frame, q))


def distance_by_least_squares(p: Floats, q: Floats) -> float:
    """min |P a - Q b| over barycentric a, b >= 0 with sum 1: non-negative least squares, sums held by a heavy row."""
    heavy = 1e5
    rows = np.zeros((5, 6))
    rows[:3, :3], rows[:3, 3:] = p.T, -q.T
    rows[3, :3] = rows[4, 3:] = heavy
    x, _ = nnls(rows, np.array([0, 0, 0, heavy, heavy]))
    a, b = x[:3] / x[:3].sum(), x[3:] / x[3:].sum()
    return float(np.linalg.norm(a @ p - b @ q))


def is_on(point: Floats, triangle: Floats) -> bool:
    return distance_by_least_squares(np.array([point] * 3), triangle) < 1e-6


@given(COORDINATES)
@settings(max_examples=200)
@example([0] * 18)
@example([0, 0, 0, 8, 0, 0, 0, 8, 0, 1, 1, -4, 1, 1, 4, 1, 1, 4])
def test_any_two_triangles_are_as_far_apart_as_least_squares_says(numbers: list[int]) -> None:
    # Integers make hard cases common: shared corners, parallel edges, equal planes, degenerate triangles.
    p, q = np.array(numbers, dtype=float).reshape(2, 3, 3) / 8
    distance, on_p, on_q = one(p, q)
    assert distance == pytest.approx(distance_by_least_squares(p, q), abs=1e-6)
    assert np.linalg.norm(on_p - on_q) == pytest.approx(distance, abs=1e-12)
    assert is_on(on_p, p)
    assert is_on(on_q, q)


@given(SMOOTH)
@settings(max_examples=60)
def test_general_triangles_are_as_far_apart_as_least_squares_says(seed: int) -> None:
    p, q = np.random.default_rng(seed).normal(size=(2, 3, 3)) + np.array([[[0.0]], [[1.0]]])
    distance, on_p, on_q = one(p, q)
    assert distance == pytest.approx(distance_by_least_squares(p, q), abs=1e-7)
    assert is_on(on_p, p)
    assert is_on(on_q, q)


def test_no_sampled_pair_of_points_is_nearer() -> None:
    rng = np.random.default_rng(7)
    p, q = rng.normal(size=(2, 10, 3, 3))
    q += [1.5, 0.0, 0.0]
    share = rng.dirichlet([0.5, 0.5, 0.5], size=400)
    samples_p, samples_q = np.einsum("kc,ncx->nkx", share, p), np.einsum("kc,ncx->nkx", share, q)
    apart = np.linalg.norm(samples_p[:, :, None] - samples_q[:, None], axis=-1).min(axis=(1, 2))
    distance = distances(p, q)
    assert (distance <= apart + 1e-12).all()
    # 400 points on a triangle of this size are about 0.15 apart.
    assert (apart - distance < 0.3).all()


@pytest.mark.parametrize(
    ("q", "distance"),
    [
        ([[0.2, 0.2, 0.3], [0.9, 0.2, 0.3], [0.2, 0.9, 0.3]], 0.3),  # faces, parallel
        ([[0.2, 0.2, 0.5], [0.2, 0.3, 2.0], [0.3, 0.2, 2.0]], 0.5),  # a vertex over the inside
        ([[2.0, -1.0, 0.0], [2.0, 1.0, 0.0], [3.0, 0.0, 0.0]], 1.0),  # an edge beside a vertex, in one plane
        ([[0.2, 0.2, -1.0], [0.2, 0.2, 1.0], [5.0, 5.0, 1.0]], 0.0),  # an edge through the face
        ([[0.2, -1.0, 0.1], [0.2, 3.0, 0.1], [0.2, 1.0, 5.0]], 0.1),  # an edge across the whole face
        ([[-1.0, -1.0, 1.0], [-1.0, 2.0, 1.0], [-1.0, 0.0, 4.0]], 2**0.5),  # two parallel edges
        (FLAT, 0.0),
        ([[0.3, 0.3, 0.25]] * 3, 0.25),  # a point
        ([[-1.0, 0.3, 0.25], [1.0, 0.3, 0.25], [0.0, 0.3, 0.25]], 0.25),  # a line
    ],
)
def test_distance_known_by_hand(q: list[list[float]], distance: float) -> None:
    for first, second in ((FLAT, q), (q, FLAT)):
        assert one(first, second)[0] == pytest.approx(distance, abs=1e-12)


def test_every_corner_of_two_faces_on_each_other_is_found() -> None:
    """One triangle extends over the slanted edge of the other; the common patch has the corners listed below."""
    q = np.array([[[0.5, 0.1, 0.0], [2.0, 0.1, 0.0], [0.5, 1.6, 0.0]]])
    every = all_meetings([FLAT], q)
    touching = every.on_p[:, every.distance <= 1e-9].T
    for corner in ([0.5, 0.1, 0.0], [0.9, 0.1, 0.0], [0.5, 0.5, 0.0]):
        assert np.linalg.norm(touching - corner, axis=1).min() < 1e-9


@given(SMOOTH)
@settings(max_examples=60)
def test_height_range_is_the_optimum_of_the_linear_program(seed: int) -> None:
    rng = np.random.default_rng(seed)
    p, q = rng.normal(size=(2, 3, 3))
    up = rng.normal(size=3)
    up /= np.linalg.norm(up)
    across = np.linalg.svd(up[None])[2][1:]
    # Barycentric weights of a point of p and a point of q on one vertical line, with extreme height difference.
    equal = np.vstack([np.hstack([across @ p.T, -across @ q.T]), [1, 1, 1, 0, 0, 0], [0, 0, 0, 1, 1, 1]])
    height = np.concatenate([p @ up, -(q @ up)])
    lowest, highest = (
        linprog(sign * height, A_eq=equal, b_eq=[0, 0, 1, 1], bounds=[(0, 1)] * 6, method="highs") for sign in (1, -1)
    )
    low, high = height_range(axes_first([p]), axes_first([q]), tuple(up.tolist()))
    if lowest.status == 2:
        assert (low[0], high[0]) == (np.inf, -np.inf)
    else:
        assume(highest.fun + lowest.fun < -1e-9)  # a projection that meets in one point may or may not count
        assert low[0] == pytest.approx(lowest.fun, abs=1e-7)
        assert high[0] == pytest.approx(-highest.fun, abs=1e-7)


def test_side_by_side_is_not_over_each_other() -> None:
    beside = axes_first([np.subtract(FLAT, [1.0, 0.0, 0.5])])
    assert np.isinf(height_range(axes_first([FLAT]), beside, (0.0, 0.0, 1.0))[0][0])


def test_an_upright_triangle_stands_on_a_level_one() -> None:
    sheet = axes_first([[[0.2, 0.2, 0.03], [0.4, 0.2, 0.03], [0.3, 0.2, 1.0]]])
    low, high = height_range(sheet, axes_first([FLAT]), (0.0, 0.0, 1.0))
    assert (low[0], high[0]) == (pytest.approx(0.03), pytest.approx(1.0))
