"""Many cuboids at once, against their triangles one pair at a time, and against quadratic programs."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.optimize import lsq_linear

from contact_scenes import box
from scene2hap.contact.body import Body
from scene2hap.contact.geometry.spread import spread_each
from scene2hap.contact.mesh_distance import MeshPair
from scene2hap.contact.stated_tolerance.cuboid_patch import patches
from scene2hap.contact.stated_tolerance.cuboids import Gaps, Pairs, gaps
from scene2hap.scene.pose import Pose

Floats = NDArray[np.float64]
Case = tuple[Floats, Floats, Pose]
SLACK_M, SUNK_M = 0.01, 0.02
SEEDS = st.integers(0, 10**6)


def cases(seed: int, n: int, plain: bool) -> list[Case]:
    """Edges of host and guest [m], and the guest's pose in the host's frame; `plain`: in tenths and right angles."""
    rng = np.random.default_rng(seed)
    found = []
    for _ in range(n):
        host, guest = rng.uniform(0.05, 1.0, (2, 3))
        place, turn = rng.normal(size=3) * 0.6, rng.normal(size=4)
        if plain:
            host, guest, place = np.round(host, 1) + 0.1, np.round(guest, 1) + 0.1, np.round(place, 1)
            turn = rng.integers(-1, 2, 4) + np.array([0, 0, 0, 3.0]) * (rng.random() < 0.5)
            turn = turn if turn.any() else np.array([0, 0, 0, 1.0])
        if np.linalg.norm(guest) > np.linalg.norm(host):
            host, guest = guest, host
        found.append((host, guest, Pose(tuple(place.tolist()), tuple(turn.tolist()))))
    return found


def pairs_of(several: list[Case]) -> Pairs:
    turn = np.stack([pose.rotation for _, _, pose in several], axis=-1)
    shift = np.array([pose.position_m for _, _, pose in several]).T
    return Pairs.of(turn, shift, *(np.stack([case[k] for case in several], axis=-1) / 2 for k in (0, 1)))


def meeting(case: Case) -> MeshPair:
    host, guest, pose = case
    a = Body.of(box("a", tuple(host.tolist()), (0, 0, 0)), 1)
    b = Body.of(box("b", tuple(guest.tolist()), pose.position_m, pose.rotation_xyzw), 1)
    return MeshPair(a, b)


@pytest.mark.parametrize("plain", [False, True])
@given(seed=SEEDS)
@settings(max_examples=3)
def test_distances_and_separations_equal_those_of_triangles(plain: bool, seed: int) -> None:
    several = cases(seed, 30, plain)
    rows, found = gaps(pairs_of(several), 10.0)
    assert rows.tolist() == list(range(30))
    for k, case in enumerate(several):
        told = meeting(case).gap(10.0)
        assert told is not None
        assert found.distance_m[k] == pytest.approx(told.distance_m, abs=1e-9)
        if plain and told.distance_m > 0 and found.least_m[k] <= 0:
            continue  # Inside the other, as near to several of its sides.
        assert found.way_m[:, k] == pytest.approx(told.way_m, abs=1e-9)


@given(seed=SEEDS)
@settings(max_examples=4)
def test_distances_of_cuboids_apart_are_those_of_bounded_least_squares(seed: int) -> None:
    several = cases(seed, 12, plain=False)
    _, found = gaps(pairs_of(several), 10.0)
    for k, (host, guest, pose) in enumerate(several):
        if found.least_m[k] > 0:
            half = np.concatenate([host, guest]) / 2
            table = np.hstack([np.eye(3), -pose.rotation])
            best = lsq_linear(table, np.array(pose.position_m), (-half, half), tol=1e-14)
            assert found.distance_m[k] == pytest.approx(math.sqrt(2 * best.cost), abs=1e-7)


@pytest.mark.parametrize("plain", [False, True])
@given(seed=SEEDS)
@settings(max_examples=4)
def test_a_pair_has_the_same_bits_alone_and_among_others(plain: bool, seed: int) -> None:
    every = pairs_of(cases(seed, 25, plain))
    rows, found = gaps(every, 0.1)
    spots = patches(every.rows(rows), found, found.distance_m + SLACK_M, SUNK_M)
    for place, row in enumerate(rows.tolist()):
        one = every.rows(np.array([row]))
        _, alone = gaps(one, 0.1)
        assert alone.table[:, 0].tolist() == found.table[:, place].tolist()
        spot = patches(one, alone, alone.distance_m + SLACK_M, SUNK_M)
        counts = spots.counts[:, place]
        assert spot.counts[:, 0].tolist() == counts.tolist()
        assert spot.points_m[:, counts, 0].tolist() == spots.points_m[:, counts, place].tolist()


@pytest.mark.parametrize("plain", [False, True])
@given(seed=SEEDS)
@settings(max_examples=4)
def test_stored_ends_give_the_same_points_as_computed_ones(plain: bool, seed: int) -> None:
    every = pairs_of(cases(seed, 40, plain))
    rows, found = gaps(every, 0.1)
    # One at a time, so that each has all its ends known or none.
    for place, row in enumerate(rows.tolist()):
        one, known = every.rows(np.array([row])), found.rows(np.array([place]))
        anew = Gaps(known.table, np.full(1, -1))
        told, again = (patches(one, gap, gap.distance_m + SLACK_M, SUNK_M) for gap in (known, anew))
        assert told.counts.tolist() == again.counts.tolist()
        assert told.points_m[:, told.counts[:, 0]].tolist() == again.points_m[:, told.counts[:, 0]].tolist()


def off_surface(point: Floats, half: Floats) -> float:
    beyond = np.abs(point) - half
    outside = float(np.linalg.norm(np.maximum(beyond, 0.0)))
    return outside if outside > 0 else -float(beyond.max())


@pytest.mark.parametrize("plain", [False, True])
@given(seed=SEEDS)
@settings(max_examples=5)
def test_points_lie_midway_between_the_surfaces_as_far_apart_as_by_triangles(plain: bool, seed: int) -> None:
    several = cases(seed, 25, plain)
    pairs = pairs_of(several)
    rows, found = gaps(pairs, 0.1)
    spots = patches(pairs.rows(rows), found, found.distance_m + SLACK_M, SUNK_M)
    for place, row in enumerate(rows.tolist()):
        host, guest, pose = several[row]
        points = spots.points_m[:, spots.counts[:, place], place].T
        assert 1 <= len(points) <= 4
        gap_m = found.distance_m[place]
        most_m = (gap_m + SLACK_M) / 2 if found.least_m[place] > 0 else max(gap_m + SLACK_M, SUNK_M) / 2
        for point, own in zip(points, pose.to_own(points), strict=True):
            assert off_surface(point, host / 2) <= most_m + 1e-9
            assert off_surface(own, guest / 2) <= most_m + 1e-9
        if found.least_m[place] > -SUNK_M:
            continue
        # Sunk in deeper: the curve of the cut is as wide.
        told = np.array([ends.on_a_m for ends in meeting(several[row]).patch((0.0, 0.0, 0.0), 0.0)])
        if len(told) > 1 and gap_m == 0:
            assert np.linalg.norm(np.ptp(points, axis=0)) >= 0.5 * np.linalg.norm(np.ptp(told, axis=0))


def corners(case: Case, within_m: float = 0.05, slack_m: float = 0.001) -> set[tuple[float, ...]]:
    pairs = pairs_of([case])
    _, found = gaps(pairs, within_m)
    spots = patches(pairs, found, found.distance_m + slack_m, 0.004)
    return {tuple((point + 0.0).tolist()) for point in spots.points_m[:, spots.counts[:, 0], 0].T.round(6)}


def test_box_over_an_edge_touches_in_the_overlap() -> None:
    case = (np.array([2.0, 0.1, 2.0]), np.array([0.4, 0.1, 0.2]), Pose((1.0, 0.102, 0.0)))
    assert corners(case) == {(x, 0.051, z) for x in (0.8, 1.0) for z in (-0.1, 0.1)}


def test_crossing_bars_touch_at_the_crossing_whether_near_or_sunk_in() -> None:
    bars = np.array([1.0, 0.02, 0.02]), np.array([0.02, 0.02, 1.0])
    for height, middle in ((0.02, 0.01), (0.021, 0.0105), (0.019, 0.0095)):
        assert corners((*bars, Pose((0.0, height, 0.0)))) == {
            (x, middle, z) for x in (-0.01, 0.01) for z in (-0.01, 0.01)
        }


def test_blocks_corner_to_corner_touch_along_the_edges_that_face_each_other() -> None:
    cube = np.array([0.2, 0.2, 0.2])
    assert corners((cube, cube, Pose((0.203, 0.1, 0.204)))) == {(0.1015, y, 0.102) for y in (0.0, 0.1)}


def test_a_post_through_a_plate_touches_where_it_runs_through() -> None:
    found = corners((np.array([1.0, 0.02, 1.0]), np.array([0.1, 0.9, 0.1]), Pose()))
    assert len(found) == 4
    assert {(abs(x), abs(y), abs(z)) for x, y, z in found} == {(0.05, 0.01, 0.05)}


def test_a_cuboid_near_a_side_inside_another_touches_that_side() -> None:
    case = (np.array([1.0, 1.0, 1.0]), np.array([0.2, 0.2, 0.2]), Pose((0.399, 0.1, 0.0)))
    _, found = gaps(pairs_of([case]), 0.05)
    assert found.distance_m[0] == pytest.approx(0.001)
    assert found.way_m[:, 0] == pytest.approx((-0.001, 0.0, 0.0))
    assert corners(case) == {(0.4995, y, z) for y in (0.0, 0.2) for z in (-0.1, 0.1)}


def test_selected_points_are_far_apart_and_relevant() -> None:
    line = np.zeros((3, 6, 2))
    line[0] = np.array([0.0, 0.001, 0.5, 1.0, 9.0, 0.25])[:, None]
    counts = np.ones((6, 2), dtype=bool)
    counts[4] = False
    counts[:, 1] = False
    rows, kept = spread_each(line, counts)
    assert sorted(line[0, rows[:, 0], 0].tolist()) == [0.0, 0.25, 0.5, 1.0]
    assert kept.tolist() == [[True, False]] * 4
