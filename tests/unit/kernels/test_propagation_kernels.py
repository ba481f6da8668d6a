"""The kernels of `propagation`: the compiled one of every pair answers as the plain one does."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kernels import both, seeds, steady
from scene2hap.contact.junction import Junction
from scene2hap.propagation.near_field import table
from scene2hap.propagation.walk import Door, Ends, Exit
from scene2hap.scene.pose import Pose


def places(rng: np.random.Generator, n: int) -> list[tuple[float, float, float]]:
    return [(x, y, z) for x, y, z in rng.normal(size=(n, 3)).tolist()]


@steady
@given(seed=seeds, n=st.integers(0, 6))
def test_ways_through_an_object(seed: int, n: int) -> None:
    rng = np.random.default_rng(seed)
    entries = list(zip(places(rng, n), rng.uniform(0, 2, n).tolist(), strict=True))
    (point,), price = places(rng, 1), float(rng.uniform(0, 3))
    plain, twin = both("propagation.entries.least_cost")
    least = plain(entries, price, point)
    assert twin(entries, price, point) == pytest.approx(least, rel=1e-14)
    plain, twin = both("propagation.entries.is_within")
    for cost in (0.99 * least, 1.01 * least):
        assert twin(entries, price, point, cost) is plain(entries, price, point, cost)
    if n:
        plain, twin = both("propagation.entries.nearest_m")
        nearby = tuple(place for place, _ in entries)
        assert twin(nearby, point) == pytest.approx(plain(nearby, point), rel=1e-14)


@steady
@given(seed=seeds, is_through=st.booleans(), object_id=st.sampled_from(["a", "b", "floor"]))
def test_ways_over_contacts_that_come_and_go_and_move(seed: int, is_through: bool, object_id: str) -> None:
    rng = np.random.default_rng(seed)
    prices, rows = {"a": 1.0, "b": 2.0, "floor": 0.5}, {"a": 0, "c": 1, "b": 2}
    ids = [*prices, "c", "d"]
    crossing = {0.5: 0.3, 1.0: 0.0, 0.0: math.inf}
    beside: dict[str, dict[str, Junction]] = {}

    def junction() -> Junction:
        n = int(rng.integers(1, 5))
        return Junction(tuple(places(rng, n)), tuple(rng.choice([0.0, 0.5, 1.0], n).tolist()), (None,) * n)

    def change() -> tuple[str, str]:
        a, b = sorted(rng.choice(ids, 2, replace=False).tolist())
        if rng.random() < 0.4 and b in beside.get(a, {}):
            del beside[a][b], beside[b][a]
        else:
            beside.setdefault(a, {})[b] = beside.setdefault(b, {})[a] = junction()
        return a, b

    for _ in range(6):
        change()
    kinds = both("propagation.short_way.WaysInto")
    plain, twin = (kind(object_id, rows, beside, prices, crossing, is_through=is_through) for kind in kinds)
    for _ in range(8):
        turned = [change() for _ in range(rng.integers(0, 3))]
        for ways in (plain, twin):
            ways.follow(turned if rng.random() < 0.9 else None)
        (point,) = places(rng, 1)
        limits = rng.choice([0.5, 3.0, math.inf], 3).tolist() if rng.random() < 0.7 else None
        told, compiled = (rng.choice([0.7, 2.0, math.inf], 3).tolist() for _ in range(2))
        compiled[:] = told
        plain.lower(told, point, limits)
        twin.lower(compiled, point, limits)
        assert compiled == pytest.approx(told, rel=1e-14)
        anew = kinds[0](object_id, rows, beside, prices, crossing, is_through=is_through)
        if limits is None:
            found = [math.inf] * 3
            anew.lower(found, point, None)
            assert all(x <= y * (1 + 1e-14) for x, y in zip(told, found, strict=True))


@steady
@given(seed=seeds, has_ends=st.booleans())
def test_walks_over_contacts(seed: int, has_ends: bool) -> None:
    rng = np.random.default_rng(seed)
    ids = [f"x{i}" for i in range(8)]
    prices = {x: float(rng.uniform(0.1, 2)) for x in ids[:-1]}
    out: dict[str, list[Exit]] = {x: [] for x in ids}
    for _ in range(14):
        a, b = rng.choice(ids, 2, replace=False).tolist()
        shared = list(zip(places(rng, 2), rng.uniform(0, 0.5, 2).tolist(), strict=True))
        for here, there in ((a, b), (b, a)):
            several = [Door(here, there, place, crossing) for place, crossing in shared]
            out[here].append(Exit(there, prices.get(there, 0.0), several))
    starts = [(0.0, Door("", "x0", places(rng, 1)[0], 0.0))]
    limit = float(rng.choice([1.0, 4.0, math.inf]))
    arrivals = []
    for walk in both("propagation.walk.walked"):
        balls = dict.fromkeys(ids[4:], ((0.0, 0.0, 0.0), 6.0))
        ends = Ends(dict.fromkeys(balls, limit), balls, min(prices.values())) if has_ends else None
        arrivals.append(walk(starts, out.__getitem__, prices, limit, ends))
    plain, compiled = arrivals
    assert [arrival[1:] for arrival in compiled] == [arrival[1:] for arrival in plain]
    assert [cost for cost, *_ in compiled] == pytest.approx([cost for cost, *_ in plain], rel=1e-12)


def test_doors() -> None:
    told, compiled = (kind("cup", "table", (1.0, 2.0, 3.0), 0.5) for kind in both("propagation.walk.Door"))
    for name in ("out_of", "into", "place", "crossing"):
        assert getattr(compiled, name) == getattr(told, name)


@steady
@given(lengths=st.lists(st.one_of(st.just(0.0), st.just(math.inf), st.floats(1e-6, 1e3)), max_size=9))
def test_gains_of_bands(lengths: list[float]) -> None:
    plain, compiled = (kind(np.geomspace(10.0, 80.0, 21))(lengths) for kind in both("propagation.band_rms.BandRms"))
    np.testing.assert_allclose(compiled, plain, rtol=1e-10, atol=1e-300)


@steady
@given(seed=seeds)
def test_near_fields(seed: int) -> None:
    rng = np.random.default_rng(seed)
    x, y, cut2 = rng.uniform(-1, 3, (4, 3)), rng.uniform(-1, 3, (4, 3)), rng.uniform(10, 1e4, 4)
    numbers = (x, y, rng.normal(size=3), rng.normal(size=3), cut2, (2.0, 3.0, 30.0, 20.0), table())
    points = np.concatenate([rng.uniform(0, [1.0, 2 / 3], (5, 2)), [[0.0, 0.0], [x[0, 0], y[0, 0]]]])
    plain, twin = (kind(*numbers) for kind in both("propagation.near_field.Dimples"))
    k2 = rng.uniform(0.1, 5.0, 4)
    told, compiled = ((*dimples.at(points), dimples.near(points, k2)) for dimples in (plain, twin))
    for one, other in zip(told, compiled, strict=True):
        np.testing.assert_allclose(other, one, rtol=1e-9, atol=1e-9)


@steady
@given(seed=seeds, n=st.integers(0, 3))
def test_products_of_cosines(seed: int, n: int) -> None:
    points = np.random.default_rng(seed).uniform(-0.1, 1.1, (n, 2))
    found = [np.empty((n, 20)), np.empty((n, 20))]
    for fill, one in zip(both("propagation.plate_terms.fill_cosines"), found, strict=True):
        fill(one, points, 2.0, 2.0, 5, 4)
    np.testing.assert_allclose(found[1], found[0], atol=1e-13)


@steady
@given(seed=seeds, n=st.integers(0, 3), dtype=st.sampled_from([np.float32, np.float64]))
def test_forces_folded(seed: int, n: int, dtype: type) -> None:
    rng = np.random.default_rng(seed)
    n_forces, n_columns, k2 = int(rng.integers(0, 4)), int(rng.integers(0, 5)), rng.uniform(0.1, 5.0, 4)
    x, y = rng.uniform(0, 1, (2, n_forces, 3))
    near = (x, y, rng.normal(size=3), rng.normal(size=3), rng.uniform(10, 1e4, n_forces), (2.0, 2.0, 30.0, 20.0))
    smooth, beyond = (rng.normal(size=(rows, n_columns)).astype(dtype) for rows in (20, 4 * n_forces))
    points = rng.uniform(0, 1, (n, 2))
    dimples = both("propagation.near_field.Dimples")
    folded = both("propagation.plate_terms.Folded")
    told, compiled = (
        kind((2.0, 2.0, 5, 4), smooth, own(*near, table()), k2, beyond)(points)
        for kind, own in zip(folded, dimples, strict=True)
    )
    assert compiled.dtype == told.dtype == dtype
    close = 1e-9 if dtype is np.float64 else 1e-4
    np.testing.assert_allclose(compiled, told, rtol=close, atol=close)


@steady
@given(seed=seeds, n_own=st.lists(st.integers(0, 6), min_size=1, max_size=4), n=st.integers(0, 3))
def test_lengths_in_bands(seed: int, n_own: list[int], n: int) -> None:
    rng = np.random.default_rng(seed)
    factors = [np.triu(rng.normal(size=(n, k, k))) for k in n_own]
    values, mixing = (rng.normal(size=size).astype(np.float32) for size in ((2, 3), (3, sum(n_own))))
    told, compiled = (
        kind(lambda _: values, mixing, factors)(np.empty((2, 2)))
        for kind in both("propagation.band_shapes.BandLengths")
    )
    np.testing.assert_allclose(compiled, told, rtol=1e-4, atol=1e-4)


@steady
@given(seed=seeds, n=st.integers(0, 3), own=st.integers(-1, 4))
def test_what_an_object_is_asked(seed: int, n: int, own: int) -> None:
    rng = np.random.default_rng(seed)
    columns = rng.choice(5, int(rng.integers(0, 5)), replace=False)
    arriving = rng.uniform(0, 1, (n, len(columns), 3))
    told, compiled = (
        kind(lambda points: points[:, :2], lambda _: arriving, columns, (5, 3), own)(np.zeros((n, 3)))
        for kind in both("propagation.asked.Asked")
    )
    np.testing.assert_array_equal(compiled, told)


@steady
@given(seed=seeds, n=st.integers(0, 3), m=st.integers(0, 3))
def test_sizes_of_complex_numbers(seed: int, n: int, m: int) -> None:
    pairs = np.random.default_rng(seed).normal(size=(n, 2 * m))
    told, compiled = (kind(lambda _: pairs)(np.empty((n, 2))) for kind in both("propagation.asked.Magnitudes"))
    np.testing.assert_allclose(compiled, told, rtol=1e-14)


@pytest.mark.parametrize(
    "points",
    [
        [(0.0, 1.0, 2.0)],
        [(0.0, 1.0, 2.0), (3.0, 4.0, 5.0)],
        [],
        [(0.0, 1.0)],
        [(0.0, 1.0, 2.0), (3.0, 4.0)],
        [[0.0, 1.0, 2.0]],
        [(0, 1, 2)],
        [(0.0, math.nan, 1.0)],
        [(0.0, 1.0, math.inf)],
        ((0.0, 1.0, 2.0),),
        (0.0, 1.0, 2.0),
        np.zeros((2, 3)),
        [(0.0, 1.0, "2")],
    ],
    ids=str,
)
def test_points_as_they_mostly_come(points: Any) -> None:
    told, compiled = (take(points, 3) for take in both("propagation.points.of_tuples"))
    if told is None:
        assert compiled is None
    else:
        np.testing.assert_array_equal(compiled, told)


@pytest.mark.parametrize("odd", [0.0, 1e200, -1e308, math.inf, -math.inf, math.nan])
def test_finite_points(odd: float) -> None:
    plain, twin = both("propagation.points.are_finite")
    for n in range(3):
        points = np.ones((n, 3))
        points[n // 2 :, 1] = odd
        assert twin(points) == plain(points)


@steady
@given(seed=seeds, n=st.integers(0, 4))
def test_points_in_a_rectangle(seed: int, n: int) -> None:
    rng = np.random.default_rng(seed)
    pose = Pose(tuple(rng.normal(size=3).tolist()), tuple(rng.normal(size=4).tolist()))
    points = rng.normal(size=(n, 3))
    told, compiled = (kind(pose, 0.8, 0.5)(points) for kind in both("propagation.points.InRectangle"))
    np.testing.assert_allclose(compiled, told, atol=1e-14)
