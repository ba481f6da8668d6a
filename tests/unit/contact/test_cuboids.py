"""Distances and contact points of two cuboids, against bounded least squares and points listed by hand."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from numpy.typing import NDArray
from scipy.optimize import lsq_linear

from contact_scenes import box
from scene2hap.contact.body import Body
from scene2hap.contact.mesh_distance import MeshPair
from scene2hap.scene.pose import Pose

Floats = NDArray[np.float64]
Case = tuple[Floats, Floats, Pose]
SLACK_M = 0.01
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


def mesh_pair(case: Case) -> MeshPair:
    host, guest, pose = case
    a = Body.of(box("a", tuple(host.tolist()), (0, 0, 0)), 1)
    b = Body.of(box("b", tuple(guest.tolist()), pose.position_m, pose.rotation_xyzw), 1)
    return MeshPair(a, b)


def solid_distance_m(case: Case) -> float:
    """The least distance of the two solids, 0 if they overlap, by bounded least squares."""
    host, guest, pose = case
    half = np.concatenate([host, guest]) / 2
    best = lsq_linear(np.hstack([np.eye(3), -pose.rotation]), np.array(pose.position_m), (-half, half), tol=1e-14)
    return math.sqrt(2 * best.cost)


@pytest.mark.parametrize("plain", [False, True])
@given(seed=SEEDS)
@settings(max_examples=4)
def test_distances_of_cuboids_apart_are_those_of_bounded_least_squares(plain: bool, seed: int) -> None:
    for case in cases(seed, 12, plain):
        expected = solid_distance_m(case)
        if expected > 1e-6:
            gap = mesh_pair(case).gap(10.0)
            assert gap is not None
            assert gap.distance_m == pytest.approx(expected, abs=1e-7)
            assert np.linalg.norm(gap.way_m) == pytest.approx(expected, abs=1e-7)


def off_surface(point: Floats, half: Floats) -> float:
    beyond = np.abs(point) - half
    outside = float(np.linalg.norm(np.maximum(beyond, 0.0)))
    return outside if outside > 0 else -float(beyond.max())


@pytest.mark.parametrize("plain", [False, True])
@given(seed=SEEDS)
@settings(max_examples=5)
def test_contact_points_end_on_both_surfaces_within_reach(plain: bool, seed: int) -> None:
    for host, guest, pose in cases(seed, 25, plain):
        pair = mesh_pair((host, guest, pose))
        gap = pair.gap(0.1)
        if gap is None:
            continue
        within_m = gap.distance_m + SLACK_M
        ends = pair.patch((0.0, 0.0, 0.0), within_m)
        assert 1 <= len(ends) <= 4
        for on_host, on_guest in ends:
            assert off_surface(np.array(on_host), host / 2) == pytest.approx(0.0, abs=1e-9)
            assert off_surface(pose.to_own(np.array([on_guest]))[0], guest / 2) == pytest.approx(0.0, abs=1e-9)
            assert math.dist(on_host, on_guest) <= within_m + 1e-9


def corners(case: Case, within_m: float = 0.05, slack_m: float = 0.001) -> set[tuple[float, ...]]:
    pair = mesh_pair(case)
    gap = pair.gap(within_m)
    assert gap is not None
    ends = pair.patch((0.0, 0.0, 0.0), gap.distance_m + slack_m)
    return {tuple((np.round(one.middle_m, 6) + 0.0).tolist()) for one in ends}


def test_box_over_an_edge_touches_in_the_overlap() -> None:
    case = (np.array([2.0, 0.1, 2.0]), np.array([0.4, 0.1, 0.2]), Pose((1.0, 0.102, 0.0)))
    assert corners(case) == {(x, 0.051, z) for x in (0.8, 1.0) for z in (-0.1, 0.1)}


def test_crossing_bars_touch_at_the_crossing() -> None:
    bars = np.array([1.0, 0.02, 0.02]), np.array([0.02, 0.02, 1.0])
    for height, middle in ((0.02, 0.01), (0.021, 0.0105)):
        assert corners((*bars, Pose((0.0, height, 0.0)))) == {
            (x, middle, z) for x in (-0.01, 0.01) for z in (-0.01, 0.01)
        }


def test_blocks_corner_to_corner_touch_along_the_edges_that_face_each_other() -> None:
    cube = np.array([0.2, 0.2, 0.2])
    assert corners((cube, cube, Pose((0.203, 0.1, 0.204)))) == {(0.1015, y, 0.102) for y in (0.0, 0.1)}


def test_a_post_through_a_plate_touches_where_it_runs_through() -> None:
    found = corners((np.array([1.0, 0.02, 1.0]), np.array([0.1, 0.9, 0.1]), Pose()), slack_m=0.0)
    assert len(found) == 4
    assert {(abs(x), abs(y), abs(z)) for x, y, z in found} == {(0.05, 0.01, 0.05)}


def test_a_cuboid_near_a_side_inside_another_touches_that_side() -> None:
    case = (np.array([1.0, 1.0, 1.0]), np.array([0.2, 0.2, 0.2]), Pose((0.399, 0.1, 0.0)))
    gap = mesh_pair(case).gap(0.05)
    assert gap is not None
    assert gap.distance_m == pytest.approx(0.001)
    assert gap.way_m == pytest.approx((-0.001, 0.0, 0.0))
    assert corners(case) == {(0.4995, y, z) for y in (0.0, 0.2) for z in (-0.1, 0.1)}
