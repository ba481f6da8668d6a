"""One contract for both of every pair of kernels: the compiled one answers as the plain one does."""

from __future__ import annotations

import math
import os
from collections import deque
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scene2hap.audio.clip import AudioClip
from scene2hap.compiled import KERNELS
from scene2hap.contact.body import shape_of
from scene2hap.contact.junction import Junction
from scene2hap.contact.stance import Stance
from scene2hap.contact.track import Bounds
from scene2hap.haptics import Bands
from scene2hap.propagation.near_field import table
from scene2hap.propagation.walk import Door, Ends, Exit
from scene2hap.render.loop_bank import CELL, LoopBank
from scene2hap.render.playhead import Change
from scene2hap.render.tactile_mix import Gains
from scene2hap.render.upsampler import Upsampler
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import Box, TriMesh

PACKAGE = Path(__file__).parents[2] / "src" / "scene2hap"
SOURCES = sorted(PACKAGE.rglob("_*.pyx"))
for source in SOURCES:
    module = ".".join(source.relative_to(PACKAGE.parent).with_suffix("").parts)
    import_module(module.replace("._", "."))

seeds = st.integers(0, 2**32 - 1)
steady = settings(derandomize=True, deadline=None, max_examples=60)


def both(name: str) -> tuple[Callable[..., Any], Callable[..., Any]]:
    """A plain kernel and its compiled twin."""
    plain, twin = KERNELS[f"scene2hap.{name}"]
    if twin is None:
        wish = os.environ.get("SCENE2HAP_COMPILED", "")
        assert wish != "1", f"{name} has no compiled twin, and SCENE2HAP_COMPILED=1 demands one"
        pytest.skip("built or run without compiled kernels; install a C compiler and build again to compare them")
    return plain, twin


def test_every_kernel_has_a_twin_in_the_source() -> None:
    assert len(KERNELS) > 10
    for name in KERNELS:
        home, _, kernel = name.rpartition(".")
        room, _, module = home.removeprefix("scene2hap.").rpartition(".")
        text = (PACKAGE / room.replace(".", "/") / f"_{module}.pyx").read_text(encoding="utf-8")
        assert f"def {kernel}(" in text or f"cdef class {kernel}:" in text, name


def test_all_are_compared_here() -> None:
    text = Path(__file__).read_text(encoding="utf-8")
    assert [name for name in KERNELS if f'both("{name.removeprefix("scene2hap.")}")' not in text] == []


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
@given(seed=seeds, is_through=st.booleans())
def test_short_ways_over_contacts_that_move(seed: int, is_through: bool) -> None:
    rng = np.random.default_rng(seed)
    crossing = {0.5: 0.3, 1.0: 0.0, 0.0: math.inf}

    def junction() -> Junction:
        n = int(rng.integers(1, 5))
        return Junction(tuple(places(rng, n)), tuple(rng.choice([0.0, 0.5, 1.0], n).tolist()), (None,) * n)

    out, into = {"via": junction()}, {"via": junction()}
    ways = [
        kind("via", out, into, 0.7 if is_through else None, crossing) for kind in both("propagation.short_way.ShortWay")
    ]
    for _ in range(6):
        if rng.random() < 0.5:
            (out if rng.random() < 0.5 else into)["via"] = junction()
        (point,), price = places(rng, 1), float(rng.uniform(0, 3))
        limit, known = rng.choice([0.5, 3.0, math.inf], 2).tolist()
        told, compiled = (way.least_cost(price, point, limit, known) for way in ways)
        assert compiled == pytest.approx(told, rel=1e-14)
        assert [cost for _, cost in ways[1].entries] == pytest.approx([cost for _, cost in ways[0].entries], rel=1e-14)
        assert [place for place, _ in ways[1].entries] == [place for place, _ in ways[0].entries]


@steady
@given(seed=seeds, is_through=st.booleans())
def test_what_short_ways_there_are(seed: int, is_through: bool) -> None:
    rng = np.random.default_rng(seed)
    prices, one = {"a": 1.0, "b": 2.0, "x": 0.5}, Junction(((0.0, 0.0, 0.0),), (1.0,), (None,))
    plain, twin = both("propagation.short_way.ways_between")
    out, into = {"x": one, "c": one}, {"c": one}
    known: list[list[Any]] = [[], []]
    for _ in range(4):
        for beside, others in ((out, ["a", "b", "c", "x"]), (into, ["a", "b", "c"])):
            other = str(rng.choice(others))
            _ = beside.pop(other) if other in beside else beside.setdefault(other, one)
        before = [{way.via: way for way in ways} for ways in known]
        known = [
            find(out, into, "x", prices, {1.0: 0.0}, ways, is_through=is_through)
            for find, ways in zip((plain, twin), known, strict=True)
        ]
        assert [way.via for way in known[0]] == [way.via for way in known[1]]
        for ways, last in zip(known, before, strict=True):
            assert all(way is last[way.via] for way in ways if way.via in last)


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
@given(seed=seeds, n=st.integers(0, 3))
def test_what_is_within_its_horizon(seed: int, n: int) -> None:
    rng = np.random.default_rng(seed)
    prices = rng.choice([0.0, 1.0, 2.0, math.inf], (n, 5)).tolist()
    horizon = rng.choice([-1.0, 0.0, 1.5, math.inf], 5).tolist()
    sought = [frozenset(rng.choice(5, int(rng.integers(0, 5)), replace=False).tolist()) for _ in range(n)]
    plain, twin = both("session.horizon.within")
    assert twin(prices, horizon, sought) == plain(prices, horizon, sought)


@steady
@given(lengths=st.lists(st.one_of(st.just(0.0), st.just(math.inf), st.floats(1e-6, 1e3)), max_size=9))
def test_gains_of_bands(lengths: list[float]) -> None:
    plain, compiled = (kind(np.geomspace(10.0, 80.0, 21))(lengths) for kind in both("propagation.band_rms.BandRms"))
    np.testing.assert_allclose(compiled, plain, rtol=1e-10, atol=1e-300)


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
        tracks = [kind(bounds, stance) for kind in kinds]
        for _ in range(8):
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
@given(seed=seeds)
def test_zones_that_meet(seed: int) -> None:
    rng = np.random.default_rng(seed)
    zones = [kind() for kind in both("contact.zones.Zones")]
    for row in (*range(70), *rng.integers(0, 70, 20).tolist()):
        low = rng.integers(0, 9, 3).astype(float)
        high = low + rng.integers(0, 5, 3)
        for one in zones:
            one.put(row, tuple(low.tolist()), tuple(high.tolist()))
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


@steady
@given(seed=seeds, n=st.integers(0, 3))
def test_silent_bands(seed: int, n: int) -> None:
    rng = np.random.default_rng(seed)
    least = rng.choice([0.0, 0.5, np.inf], (4, 5)).astype(np.float32)
    columns = None if rng.random() < 0.3 else sorted(rng.choice(4, int(rng.integers(0, 5)), replace=False).tolist())
    gains = rng.choice([0.0, 0.4, 0.5, 0.6, np.nan], (n, 4 if columns is None else len(columns), 5)).astype(np.float32)
    plain, twin = both("session.audibility.silence")
    told, compiled = gains.copy(), gains.copy()
    assert twin(compiled, least, columns) == plain(told, least, columns)
    np.testing.assert_array_equal(compiled, told)


@steady
@given(seed=seeds, n=st.integers(0, 3), m=st.integers(0, 4), has_peaks=st.booleans(), has_least=st.booleans())
def test_what_is_worth_mixing(seed: int, n: int, m: int, has_peaks: bool, has_least: bool) -> None:
    rng = np.random.default_rng(seed)
    gains = rng.choice([0.0, 1e-9, 0.1, 0.5], (n, m, 5), p=[0.6, 0.1, 0.2, 0.1]).astype(np.float32)
    peaks = rng.uniform(0, 2, (m, 5)).astype(np.float32) if has_peaks else None
    least = rng.choice([0.0, 0.2, np.inf], (m, 5)).astype(np.float32) if has_least else None
    told, compiled = (kind(gains, peaks, 0.3, least) for kind in both("session.audibility.sifted"))
    np.testing.assert_array_equal(compiled[0], told[0])
    assert compiled[0].flags.c_contiguous
    assert compiled[1:] == told[1:]


@steady
@given(seed=seeds, n=st.integers(0, 3))
def test_caps(seed: int, n: int) -> None:
    gains = np.random.default_rng(seed).choice([-1.0, -0.0, 0.0, 0.5, 2.0, 3.0, np.nan, np.inf], (n, 4, 5))
    told, compiled = gains.copy(), gains.copy()
    plain, twin = both("session.touch_gains.cap")
    assert twin(compiled, 2.0) == plain(told, 2.0)
    np.testing.assert_array_equal(compiled, told)


@steady
@given(seed=seeds, begin=st.one_of(st.integers(0, 10**6), st.integers(2**58, 2**60)))
def test_cells_of_loops(seed: int, begin: int) -> None:
    rng = np.random.default_rng(seed)
    length = int(rng.integers(1, 200))
    samples = rng.normal(size=(length + CELL, 3)).astype(np.float32)
    fade = np.linspace(0, 1, CELL, dtype=np.float32)
    numerator, denominator = rng.choice([(1, 1), (441, 440), (40001, 44100)])
    cells = []
    for loop_kind, read in zip(both("render.loop_bank.StoredLoop"), both("render.loop_bank.read"), strict=True):
        loop = loop_kind(samples, length, int(numerator), int(denominator), fade)
        cell = np.full((9, CELL), np.nan, dtype=np.float32)
        read([loop, None, loop], begin, cell)
        again = np.empty((3, CELL), dtype=np.float32)
        loop.fill(begin, again)
        np.testing.assert_array_equal(cell, np.concatenate([again, np.zeros_like(again), again]))
        cells.append(cell)
        read([], begin, np.empty((0, CELL), dtype=np.float32))
    np.testing.assert_allclose(cells[1], cells[0], atol=1e-6)


@steady
@given(seed=seeds)
def test_gains_on_their_way(seed: int) -> None:
    rng = np.random.default_rng(seed)
    n_loops, n_bands, n_hands, n_slots, ramp = 5, 4, 2, 6, 80
    rise = np.concatenate([np.zeros(CELL), np.linspace(0, 1, ramp), np.ones(CELL)]).astype(np.float32)
    n_rows = n_loops * n_bands
    products = [
        kind(n_rows, n_rows + n_bands, n_slots, n_hands, rise) for kind in both("render.ramped_product.RampedProduct")
    ]
    held, begin = [(0, 0)], 0
    for _ in range(8):
        n_used = n_bands * int(rng.integers(0, n_loops + 1))
        samples, is_new = rng.normal(size=(n_rows, CELL)), rng.random() < 0.7 and len(held) < n_slots
        begin += CELL
        if is_new:
            held.append((len(held), begin + int(rng.integers(0, CELL))))
        values = rng.normal(size=(n_hands, 2, n_bands)).astype(np.float32)
        loops = rng.choice(n_loops + 1, 2, replace=False).tolist()
        first = int(rng.choice([0, 7]))
        mixes = []
        for product in products:
            product.loops[:] = samples
            if is_new:
                product.set(held[-1][0], values, loops, n_used)
            x = np.zeros((n_hands, CELL), dtype=np.float32)
            slots, starts = ([pair[k] for pair in held[-3:]] for k in (0, 1))
            starts = [max(start, begin - ramp) for start in starts]
            product.mix(x, n_used, slots, starts, begin, first)
            mixes.append(x)
        np.testing.assert_allclose(mixes[1], mixes[0], atol=1e-5)
        assert (mixes[1][:, :first] == 0).all()


def clips(rng: np.random.Generator, n: int) -> list[AudioClip]:
    return [AudioClip(rng.uniform(-0.4, 0.4, int(rng.integers(300, 900))).astype(np.float32), 8000) for _ in range(n)]


@pytest.mark.parametrize("rate_hz", [48000, 44100, 8000])
@pytest.mark.parametrize("is_skipping", [True, False])
def test_mixes_that_gains_come_to(rate_hz: int, is_skipping: bool) -> None:
    rng = np.random.default_rng(rate_hz)
    bank, incoming, playheads, mixes = LoopBank(clips(rng, 4), Bands.dominant(), 8000), [], [], []
    for mix_kind, kind in zip(both("render.tactile_mix.TactileMix"), both("render.playhead.Playhead"), strict=True):
        upsampler = Upsampler(8000, rate_hz, 2)
        # Few slots, so that some gains have to wait for one.
        mixes.append(mix_kind(bank, 2, 12, upsampler.cell, is_skipping=is_skipping))
        incoming.append(deque[Change]())
        playheads.append(kind(mixes[-1], upsampler, incoming[-1], (8000, rate_hz)))
    for _ in range(300):
        for _ in range(int(rng.choice([0, 1, 3]))):
            loops = sorted(rng.choice(4, int(rng.integers(0, 5)), replace=False).tolist())
            values = rng.uniform(0, 1.2, (2, len(loops), 1)).astype(np.float32)
            gains = Gains.of(values, loops, loops if is_skipping else range(4))
            assert gains is not None
            at_frame = playheads[0].position + int(rng.choice([-50, 0, 20, 300, 10**25]))
            for queue in incoming:
                if queue and queue[-1].at_frame > 10**20:
                    queue.pop()
                queue.append(Change(at_frame, gains))
        told = np.full((int(rng.integers(0, 300)), 2), np.nan, dtype=np.float32)
        compiled = np.full_like(told, np.nan)
        playheads[0].render_into(told)
        playheads[1].render_into(compiled)
        np.testing.assert_allclose(compiled, told, atol=2e-6)
    counts = [(mix.n_cells, mix.n_rows_mixed, mix.n_merged) for mix in mixes]
    assert counts[0] == counts[1]
    assert counts[0][0] > 100
    assert counts[0][2] > 0
    assert playheads[0].position == playheads[1].position


@pytest.mark.parametrize(("up", "down"), [(6, 1), (441, 80), (1, 1)])
def test_outputs_of_cells(up: int, down: int) -> None:
    rng = np.random.default_rng(up)
    h = rng.normal(size=14 * up).astype(np.float32)
    x = rng.normal(size=(2, 13 + CELL)).astype(np.float32)
    n_frames = -(-CELL * up // down)
    plain, twin = (kind(h, up, down, n_frames, ()) for kind in both("render.upsampler.PolyphaseFilter"))
    for offset in range(0, down, 7):
        told, compiled = np.empty((2, 2, n_frames), dtype=np.float32)
        plain.fill(told, x, offset)
        twin.fill(compiled, x, offset)
        np.testing.assert_allclose(compiled, told, atol=1e-5)


@steady
@given(seed=seeds)
def test_the_limiter(seed: int) -> None:
    mix = np.random.default_rng(seed).normal(size=(2, 50)).astype(np.float32)
    told, compiled = mix.copy(), mix.copy()
    for limit, block in zip(both("render.limiter.limit_in_place"), (told, compiled), strict=True):
        limit(block, np.empty_like(block), 0.7)
    np.testing.assert_allclose(compiled, told, atol=1e-6)


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
