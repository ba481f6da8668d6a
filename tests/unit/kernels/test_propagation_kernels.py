"""Kernels of `propagation`: each compiled kernel gives the results of its plain twin."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from kernels import both, seeds, steady
from scene2hap.contact.junction import Junction
from scene2hap.propagation.coupled.elimination import Element, dense
from scene2hap.propagation.coupled.elimination_order import pattern_of
from scene2hap.propagation.modal.near_field import table
from scene2hap.propagation.paths.prepared_paths import ContactSides, Network
from scene2hap.scene.objects import Contact


def places(rng: np.random.Generator, n: int) -> list[tuple[float, float, float]]:
    return [(x, y, z) for x, y, z in rng.normal(size=(n, 3)).tolist()]


@steady
@given(seed=seeds, on_grid=st.booleans())
def test_kernels_find_the_same_costs_from_a_source(seed: int, on_grid: bool) -> None:
    rng = np.random.default_rng(seed)
    ids = [f"x{i}" for i in range(8)]
    cost_per_m = {x: float(rng.choice([0.0, rng.uniform(0.1, 2)])) for x in ids[:-1]}
    points = rng.integers(0, 3, (30, 3)) if on_grid else rng.normal(size=(30, 3))  # on a grid many paths are equal
    pairs = [rng.choice(ids, 2, replace=False).tolist() for _ in points]
    contacts = [Contact(a, b, tuple(point)) for (a, b), point in zip(pairs, points.tolist(), strict=True)]
    sides = ContactSides.of(contacts, rng.choice([0.0, 0.3, math.inf], len(contacts)))
    network, n_sides = Network.of(cost_per_m, sides), 2 * len(contacts)
    found = []
    for kernel in both("propagation.paths.prepared_paths.search"):
        costs, hops, before = np.full(n_sides, np.inf), np.zeros(n_sides, dtype=np.intp), np.zeros(n_sides, np.intp)
        kernel(network, sides.by_object.get("x0", np.empty(0, dtype=np.intp)), costs, hops, before)
        found.append((costs.tolist(), hops.tolist(), before.tolist()))
    plain, twin = found
    assert twin == plain
    # Over the side before, each side costs what it is said to cost, and no more contacts.
    costs, hops, before = twin
    for side in range(n_sides):
        if hops[side] > 1 and costs[side] < math.inf:
            through = sides.owner[side ^ 1]
            assert sides.owner[before[side]] == through
            m = math.dist(points[before[side] // 2], points[side // 2])
            cost = costs[before[side]] + cost_per_m[through] * m + sides.crossing[side // 2]
            assert cost == pytest.approx(costs[side], rel=1e-11)
            assert 0 < hops[before[side]] < hops[side]


@steady
@given(seed=seeds, on_grid=st.booleans(), n_entries=st.integers(0, 40))
def test_kernels_find_the_same_entries_into_an_object(seed: int, on_grid: bool, n_entries: int) -> None:
    rng = np.random.default_rng(seed)
    points, entries = (
        rng.integers(0, 4, (n, 3)).astype(float) if on_grid else rng.normal(size=(n, 3)) for n in (19, n_entries)
    )
    costs = rng.choice([0.0, 1.0, 2.0, math.inf], (3, n_entries)) if on_grid else rng.random((3, n_entries))
    hops, cost_per_m = rng.integers(0, 3, (3, n_entries)), float(rng.choice([0.0, 1.0]))
    found = []
    for kernel in both("propagation.paths.prepared_paths.nearest_entries"):
        best, least = np.empty((3, 19), dtype=np.intp), np.empty((3, 19))
        kernel(points, entries, cost_per_m, costs, hops, best, least)
        found.append((best.tolist(), least.tolist()))
    (plain, lowest), twin = found
    assert twin == (plain, lowest)
    for row, chosen in enumerate(plain):
        for point, entry, cost in zip(points, chosen, lowest[row], strict=True):
            every = [c + cost_per_m * math.dist(point, at) for c, at in zip(costs[row], entries, strict=True)]
            least = min(every, default=math.inf)
            equal = [k for k, cost in enumerate(every) if cost <= least * (1.0 + 1e-12) < math.inf]
            assert cost == pytest.approx(least, rel=1e-12)
            assert entry == (min(equal, key=lambda k: (hops[row, k], k)) if equal else -1)


@steady
@given(seed=seeds, max_hops=st.sampled_from([1, 2, 3, 4, None]))
def test_kernels_find_the_same_paths_as_contacts_change(seed: int, max_hops: int | None) -> None:
    rng = np.random.default_rng(seed)
    ids = [f"x{i}" for i in range(9)]
    cost_per_m = {x: float(rng.choice([0.0, rng.uniform(0.1, 2)])) for x in ids[:-2]}
    rows = {"x0": 0, "x5": 1, "x8": 2}
    crossing = {0.5: 0.3, 1.0: 0.0, 0.0: math.inf}
    beside: dict[str, dict[str, Junction]] = {}

    def change() -> tuple[str, str]:
        a, b = sorted(rng.choice(ids, 2, replace=False).tolist())
        if rng.random() < 0.4 and b in beside.get(a, {}):
            del beside[a][b], beside[b][a]
        else:
            n = int(rng.integers(1, 5))
            weights = tuple(rng.choice([0.0, 0.5, 1.0], n).tolist())
            junction = Junction(tuple(places(rng, n)), weights, (None,) * n)
            beside.setdefault(a, {})[b] = beside.setdefault(b, {})[a] = junction
        return a, b

    for _ in range(12):
        change()
    kinds = both("propagation.paths.contact_paths.ContactPaths")
    networks = [kind(cost_per_m, rows, crossing, max_hops) for kind in kinds]
    for step in range(10):
        pairs = [change() for _ in range(rng.integers(0, 4))] if step else None
        touched = [(str(rng.choice([*ids, "nobody"])), place) for place in places(rng, int(rng.integers(0, 3)))]
        limits = rng.choice([0.5, 3.0, math.inf], 3).tolist() if rng.random() < 0.7 else None
        among = {0, 2} if rng.random() < 0.3 else None
        if rng.random() < 0.3:
            cost_per_m = {x: round(float(rng.uniform(0.0, 2.0)), 1) for x in ids if rng.random() < 0.8}
            rows = {x: row for row, x in enumerate(rng.permutation(ids)[:3].tolist())}
            for network in networks:
                network.use(cost_per_m, rows)
        for network in networks:
            network.update(None if rng.random() < 0.2 else pairs, beside)
        plain, twin = (network.cheapest(touched, limits, among) for network in networks)
        assert twin == pytest.approx(plain, rel=1e-12)
        for kind, kept in zip(kinds, (plain, twin), strict=True):
            fresh = kind(cost_per_m, rows, crossing, max_hops)
            fresh.update(None, beside)
            assert fresh.cheapest(touched, limits, among) == kept


@steady
@given(lengths=st.lists(st.one_of(st.just(0.0), st.just(math.inf), st.floats(1e-6, 1e3)), max_size=9))
def test_kernels_find_the_same_band_gains(lengths: list[float]) -> None:
    plain, compiled = (
        kind(np.geomspace(10.0, 80.0, 21))(lengths) for kind in both("propagation.bands.band_rms.BandRms")
    )
    np.testing.assert_allclose(compiled, plain, rtol=1e-10, atol=1e-300)


@steady
@given(seed=seeds)
def test_near_field_kernels_agree(seed: int) -> None:
    rng = np.random.default_rng(seed)
    drives, cut2 = rng.uniform(0, [1.0, 2 / 3], (4, 2)), rng.uniform(10, 1e4, 4)
    numbers = (drives, rng.normal(size=4), rng.normal(size=4), cut2, (2.0, 3.0, 30.0, 20.0), table())
    points = np.concatenate([rng.uniform(0, [1.0, 2 / 3], (5, 2)), [[0.0, 0.0], drives[0]]])
    plain, twin = (kind(*numbers) for kind in both("propagation.modal.near_field.Dimples"))
    k2 = rng.uniform(0.1, 5.0, 4)
    told, compiled = ((*dimples.at(points), dimples.near(points, k2)) for dimples in (plain, twin))
    for one, other in zip(told, compiled, strict=True):
        np.testing.assert_allclose(other, one, rtol=1e-9, atol=1e-9)


@steady
@given(seed=seeds, n=st.integers(0, 3))
def test_kernels_find_the_same_products_of_cosines(seed: int, n: int) -> None:
    points = np.random.default_rng(seed).uniform(-0.1, 1.1, (n, 2))
    found = [np.empty((n, 20)), np.empty((n, 20))]
    for fill, one in zip(both("propagation.modal.plate_terms.fill_cosines"), found, strict=True):
        fill(one, points, 2.0, 2.0, 5, 4)
    np.testing.assert_allclose(found[1], found[0], atol=1e-13)


@steady
@given(seed=seeds, n=st.integers(0, 3), dtype=st.sampled_from([np.float32, np.float64]))
def test_kernels_contract_forces_alike(seed: int, n: int, dtype: type) -> None:
    rng = np.random.default_rng(seed)
    n_forces, n_columns, k2 = int(rng.integers(0, 4)), int(rng.integers(0, 5)), rng.uniform(0.1, 5.0, 4)
    drives, cut2 = rng.uniform(0, 1, (n_forces, 2)), rng.uniform(10, 1e4, n_forces)
    near = (drives, rng.normal(size=4), rng.normal(size=4), cut2, (2.0, 2.0, 30.0, 20.0))
    smooth, beyond = (rng.normal(size=(rows, n_columns)).astype(dtype) for rows in (20, 4 * n_forces))
    points = rng.uniform(0, 1, (n, 2))
    dimples = both("propagation.modal.near_field.Dimples")
    contracted = both("propagation.modal.plate_terms.ContractedShapes")
    told, compiled = (
        kind((2.0, 2.0, 5, 4), smooth, own(*near, table()), k2, beyond)(points)
        for kind, own in zip(contracted, dimples, strict=True)
    )
    assert compiled.dtype == told.dtype == dtype
    close = 1e-9 if dtype is np.float64 else 1e-4
    np.testing.assert_allclose(compiled, told, rtol=close, atol=close)


@steady
@given(seed=seeds, n_own=st.lists(st.integers(0, 6), min_size=1, max_size=4), n=st.integers(0, 3))
def test_kernels_find_the_same_lengths_in_bands(seed: int, n_own: list[int], n: int) -> None:
    rng = np.random.default_rng(seed)
    factors = [np.triu(rng.normal(size=(n, k, k))) for k in n_own]
    values, mixing = (rng.normal(size=size).astype(np.float32) for size in ((2, 3), (3, sum(n_own))))
    told, compiled = (
        kind(lambda _: values, mixing, factors)(np.empty((2, 2)))
        for kind in both("propagation.bands.band_shapes.BandLengths")
    )
    np.testing.assert_allclose(compiled, told, rtol=1e-4, atol=1e-4)


@steady
@given(seed=seeds, n=st.integers(0, 3), own=st.integers(-1, 4))
def test_object_response_kernels_agree(seed: int, n: int, own: int) -> None:
    rng = np.random.default_rng(seed)
    columns = rng.choice(5, int(rng.integers(0, 5)), replace=False)
    arriving = rng.uniform(0, 1, (n, len(columns), 3))
    told, compiled = (
        kind(lambda points: points[:, :2], lambda _: arriving, columns, (5, 3), own)(np.zeros((n, 3)))
        for kind in both("propagation.coupled.solved_object.ObjectResponse")
    )
    np.testing.assert_array_equal(compiled, told)


@steady
@given(seed=seeds, n=st.integers(0, 3), m=st.integers(0, 3))
def test_kernels_find_the_same_magnitudes(seed: int, n: int, m: int) -> None:
    pairs = np.random.default_rng(seed).normal(size=(n, 2 * m))
    told, compiled = (
        kind(lambda _: pairs)(np.empty((n, 2))) for kind in both("propagation.coupled.solved_object.Magnitudes")
    )
    np.testing.assert_allclose(compiled, told, rtol=1e-14)


def test_compiled_factorisation_solves_systems_that_are_dense_in_plain_python() -> None:
    rng = np.random.default_rng(5)
    rows = [[0, 1, 2, 3], [0, 4], [1, 5], [2, 3, 4, 5]]
    elements = []
    for own in rows:
        real, imaginary = rng.normal(size=(2, 6, len(own), len(own)))
        receptance = real + real.transpose(0, 2, 1) + 1j * (imaginary + imaginary.transpose(0, 2, 1))
        elements.append(Element(np.array(own), rng.choice([-1.0, 1.0], len(own)), receptance))
    diagonal = 9.0 + rng.normal(size=(6, 6)) + 0j
    free, pattern = rng.normal(size=(6, 2)), pattern_of(tuple(map(tuple, rows)))
    forces = np.full((6, 2, 6), np.nan, dtype=np.complex128)
    plain, twin = both("propagation.coupled.elimination.factored")
    assert not plain(elements, diagonal, free, pattern, 1e4, forces, {}).any()
    assert twin(elements, diagonal, free, pattern, 1e4, forces, {}).all()
    ((_, system),) = dense(elements, diagonal, np.arange(6))
    np.testing.assert_allclose(forces, np.linalg.solve(system, free + 0j).transpose(1, 2, 0), rtol=1e-12)
    assert not twin(elements, diagonal, free, pattern, 1e-9, forces, {}).any()
    forces[:] = 0.0
    diagonal[:, 2] = np.nan
    assert twin(elements, diagonal, free, pattern, 1e4, forces, {}).tolist() == [k != 2 for k in range(6)]
