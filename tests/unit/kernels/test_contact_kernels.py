"""The kernels of `contact`: the compiled one of every pair answers as the plain one does."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kernels import both, seeds, steady
from scene2hap.contact.body import shape_of
from scene2hap.contact.stance import Stance
from scene2hap.contact.track import Bounds
from scene2hap.scene.snapshot import Box, TriMesh


def turned(rng: np.random.Generator, up_axis: int) -> tuple[float, float, float, float]:
    """A rotation about the vertical, now and then with a little tilt."""
    angle, tilt = rng.uniform(0, 2 * math.pi), rng.choice([0.0, 0.0, 1e-7, 0.3])
    axis = np.where(np.arange(3) == up_axis, 1.0, tilt)
    x, y, z = (axis / np.linalg.norm(axis) * math.sin(angle / 2)).tolist()
    return (x, y, z, math.cos(angle / 2))


@pytest.mark.parametrize("up_axis", [1, 2])
def test_slides_to_the_last_bit(up_axis: int) -> None:
    kinds, box, n_slid = both("contact.track.Track"), Box((0.3, 0.2, 0.1)).mesh, 0
    for seed in range(150):
        rng = np.random.default_rng(seed)
        shape = shape_of(TriMesh(box.vertices_m + rng.uniform(-0.1, 0.1, 3), box.faces))
        first = turned(rng, up_axis)
        stance = Stance(shape, first, up_axis)
        edges = [(1.0, 0.0, -0.8), (-0.6, 0.8, -0.9), (0.0, -1.0, -0.7)][: int(rng.integers(0, 4))]
        bounds = Bounds((-1.0, -1.0, 1.0, 1.0), (-0.6, 0.6), -0.5, edges, stance.low[up_axis] - 0.01, -0.03, 0.06)
        tracks = [kind(stance) for kind in kinds]
        for k in range(8):
            for track in tracks if k % 3 == 0 else ():
                track.bind(bounds._replace(edges=edges[k // 3 :]))
            position = rng.uniform(-0.7, 0.7, 2).tolist()
            position.insert(up_axis, float(rng.choice([0.0, 0.01, 0.4])))
            rotation = first if rng.random() < 0.3 else turned(rng, up_axis)
            told, compiled = (track.slid(tuple(position), rotation) for track in tracks)
            assert compiled == told
            n_slid += told is not None
    assert n_slid > 100


def triangles(rng: np.random.Generator, n: int) -> np.ndarray:
    """Triangles (3, 3, n), some on a coarse grid, so that they are level, parallel, in touch or without area."""
    found = rng.uniform(-1, 1, (3, 3, n))
    coarse = rng.random(n) < 0.7
    found[..., coarse] = rng.integers(-1, 2, (3, 3, int(coarse.sum())))
    return found


@steady
@given(seed=seeds, n=st.integers(0, 20))
def test_triangles_to_the_last_bit(seed: int, n: int) -> None:
    rng = np.random.default_rng(seed)
    p, q = triangles(rng, n), triangles(rng, n)
    with np.errstate(invalid="ignore", divide="ignore"):
        plain, twin = both("contact.triangles.clearances")
        np.testing.assert_array_equal(twin(p, q), plain(p, q))
        told = [[np.empty(n), np.empty((3, n)), np.empty((3, n))] for _ in range(2)]
        for fill, meetings in zip(both("contact.triangles.fill_closest"), told, strict=True):
            fill(*meetings, p, q)
        plain, twin = both("contact.triangles.near_ends")
        for distance_m in (0.0, 0.3, 2.0):
            told[0] += plain(p, q, distance_m)
            told[1] += twin(p, q, distance_m)
        for one, other in zip(*told, strict=True):
            np.testing.assert_array_equal(other, one)
        heights = np.empty((2, 2, n))
        for fill, (low, high) in zip(both("contact.triangles.fill_heights"), heights, strict=True):
            fill(low, high, p, q)
        np.testing.assert_array_equal(heights[1], heights[0])


@steady
@given(seed=seeds, up_axis=st.sampled_from([1, 2]))
def test_soles_on_tops_to_the_last_bit(seed: int, up_axis: int) -> None:
    plain, twin = both("contact.slide.lying")
    rng = np.random.default_rng(seed)
    sole, top = (Stance(shape_of(Box(tuple(rng.uniform(0.1, 2, 3))).mesh), turned(rng, up_axis), up_axis) for _ in "xy")
    places = [tuple(rng.normal(scale=0.3, size=3).tolist()) for _ in "xy"]
    if top.tray is not None:
        told = plain(places[0], sole.footing, places[1], top.tray, up_axis)
        assert twin(places[0], sole.footing, places[1], top.tray, up_axis) == told
        assert len(told[3]) == len(sole.footing.points)


@steady
@given(seed=seeds, up_axis=st.sampled_from([1, 2]))
def test_zones_around_what_wanders_to_the_last_bit(seed: int, up_axis: int) -> None:
    rng = np.random.default_rng(seed)
    zones = [kind(up_axis, 0.25, (0.25, 0.6)) for kind in both("contact.zones.Zones")]
    rows: set[int] = set()
    for row in (*range(70), *rng.integers(0, 70, 40).tolist()):
        if row in rows and rng.random() < 0.2:
            for one in zones:
                one.clear(row)
            rows.discard(row)
            continue
        low = rng.integers(0, 9, 3) + rng.random(3)
        box = [tuple(corner.tolist()) for corner in (low, low + rng.integers(0, 4, 3))]
        if row in rows:
            held = zones[0].holds(row, *box)
            assert zones[1].holds(row, *box) is held
            if held:
                continue
        for one in zones:
            one.draw(row, *box, 0.1, 0.3)
        rows.add(row)
        assert zones[1].room(row) == zones[0].room(row)
        assert zones[0].holds(row, *box)
        assert zones[1].holds(row, *box)
        assert zones[1].meeting(row) == zones[0].meeting(row)
    np.testing.assert_array_equal(zones[1].low, zones[0].low)
    np.testing.assert_array_equal(zones[1].high, zones[0].high)


@steady
@given(seed=seeds)
def test_outlines_beside_each_other_to_the_last_bit(seed: int) -> None:
    rng = np.random.default_rng(seed)
    outlines = []
    for n in rng.integers(3, 9, 2):
        angles = np.sort(rng.uniform(0, 2 * math.pi, n))
        ring = np.stack([np.cos(angles), np.sin(angles)], axis=1) + rng.choice([0.0, 1.0, 2.0, 2.001], 2)
        if rng.random() < 0.5:
            # Squares side by side, as things on a grid are: several ways are equally short.
            ring = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]) + rng.choice([0.0, 1.0, 1.25], 2)
        outlines.append([(u, v) for u, v in ring.tolist()])
    plain, twin = both("contact.outlines.facing")
    for rise_m in (0.0, 0.1):
        given = (*outlines, rise_m, float(rng.choice([0.1, 0.5, 4.0])), 0.01)
        assert twin(*given) == plain(*given)


@steady
@given(seed=seeds, n=st.integers(1, 20), n_axes=st.integers(2, 3))
def test_few_points_that_stand_for_more(seed: int, n: int, n_axes: int) -> None:
    # On a grid many are equally far; some are nearer to each other than is told apart, or a rounding error away.
    rng = np.random.default_rng(seed)
    places = rng.integers(0, 3, (n, n_axes)) * rng.choice([0.1, 0.003, 1e-7]) + rng.choice([0.0, 1e-12, 0.01], (n, 1))
    points = [tuple(place) for place in places.tolist()]
    plain, twin = both("contact.spread.spread_few")
    assert twin(points) == plain(points)
