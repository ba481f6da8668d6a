"""Traced paths against networkx's shortest paths over the contact points of random scenes."""

from __future__ import annotations

import math
import tracemalloc

import networkx as nx
import numpy as np
import pytest

from scene2hap.propagation.paths.traced_paths import Leg, PathsToPoint, TracedPaths
from scene2hap.scene.objects import Contact

Point = tuple[float, float, float]


def _scene(seed: int) -> tuple[dict[str, float], list[Contact], list[float]]:
    """Random costs per metre of ten objects, and contacts between them."""
    rng = np.random.default_rng(seed)
    ids = [f"o{i}" for i in range(10)]
    cost_per_m = {x: float(rng.uniform(0, 2)) for x in ids[:9]}  # o9 passes nothing on
    contacts = []
    for _ in range(18):
        a, b = sorted(rng.choice(ids, 2, replace=False).tolist())
        contacts.append(Contact(a, b, tuple(rng.uniform(-1, 1, 3).tolist())))
    return cost_per_m, contacts, rng.uniform(0, 0.3, len(contacts)).tolist()


def _expected_cost(
    cost_per_m: dict[str, float], contacts: list[Contact], crossing: list[float], source: str, on: str, point_m: Point
) -> float:
    """The length of the shortest path over nodes (object, contact), a contact point of each of its objects."""
    graph: nx.DiGraph = nx.DiGraph()
    for i, contact in enumerate(contacts):
        for here, there in ((contact.a, contact.b), (contact.b, contact.a)):
            graph.add_edge((here, i), (there, i), weight=crossing[i])
            if here == source:
                graph.add_edge("start", (here, i), weight=0.0)
            if here in cost_per_m and here != source:
                for j, other in enumerate(contacts):
                    if j != i and here in (other.a, other.b):
                        length_m = math.dist(contact.point_m, other.point_m)
                        graph.add_edge((here, i), (here, j), weight=cost_per_m[here] * length_m)
            if here == on and on in cost_per_m:
                graph.add_edge((here, i), "end", weight=cost_per_m[on] * math.dist(contact.point_m, point_m))
    if "start" not in graph or "end" not in graph or not nx.has_path(graph, "start", "end"):
        return math.inf
    return float(nx.shortest_path_length(graph, "start", "end", weight="weight"))


def _costs(
    source: str, legs: tuple[Leg, ...], cost_per_m: dict[str, float], contacts: list[Contact], crossing: list[float]
) -> list[float]:
    """The cost up to the end of each leg, from the objects and points; each entry must be a contact of two objects."""
    cost, costs, behind = 0.0, [], source
    for leg in legs:
        pair = tuple(sorted((behind, leg.object_id)))
        cost += min(
            c for one, c in zip(contacts, crossing, strict=True) if (one.a, one.b, one.point_m) == (*pair, leg.enter_m)
        )
        cost += cost_per_m[leg.object_id] * math.dist(leg.enter_m, leg.leave_m)
        costs.append(cost)
        behind = leg.object_id
    return costs


@pytest.mark.parametrize("seed", range(30))
def test_a_way_costs_what_the_shortest_path_costs(seed: int) -> None:
    cost_per_m, contacts, crossing = _scene(seed)
    sources = ("o0", "o5", "o9", "alone")
    traced = TracedPaths(cost_per_m, contacts, crossing, sources, None)
    points_m = np.random.default_rng(seed + 100).uniform(-1, 1, (3, 3))
    for on in cost_per_m:
        entered = traced.entered(on, points_m)
        for source, sides in zip(sources, entered.tolist(), strict=True):
            if source == on:
                continue
            for side, at in zip(sides, points_m.tolist(), strict=True):
                point_m = (at[0], at[1], at[2])
                expected = _expected_cost(cost_per_m, contacts, crossing, source, on, point_m)
                back = PathsToPoint(cost_per_m, contacts, crossing, None, on, point_m).legs(source)
                if math.isinf(expected):
                    assert (side, back) == (-1, None)
                    continue
                assert back
                way = traced.path(source, side)
                assert (way.objects[0], way.objects[-1]) == (source, on)
                there = tuple(map(Leg, way.objects[1:], way.entries_m, (*way.entries_m[1:], point_m), way.costs))
                for legs in (there, back):
                    assert _costs(source, legs, cost_per_m, contacts, crossing)[-1] == pytest.approx(expected, rel=1e-9)
                within = [cost_per_m[leg.object_id] * math.dist(leg.enter_m, leg.leave_m) for leg in there]
                up_to = np.subtract(_costs(source, there, cost_per_m, contacts, crossing), within).tolist()
                assert way.costs == pytest.approx(up_to, abs=1e-12)
                assert [leg.cost for leg in back] == pytest.approx(_costs(source, back, cost_per_m, contacts, crossing))


def test_a_way_crosses_no_more_contacts_than_allowed() -> None:
    """Three tables in a row beside a long plank: the short cut over the plank has fewer contacts, but costs more."""
    contacts = [
        Contact("phone", "t1", (0.0, 0.0, 0.0)),
        Contact("t1", "t2", (1.0, 0.0, 0.0)),
        Contact("t2", "t3", (2.0, 0.0, 0.0)),
        Contact("plank", "t1", (0.5, 0.0, 0.0)),
        Contact("plank", "t3", (2.5, 0.0, 0.0)),
    ]
    cost_per_m = {"t1": 1.0, "t2": 1.0, "t3": 1.0, "plank": 5.0, "phone": 0.0}
    by_hops = {}
    for max_hops in (None, 3, 2):
        traced = TracedPaths(cost_per_m, contacts, [0.0] * 5, ("phone",), max_hops)
        side = int(traced.entered("t3", np.array([[3.0, 0.0, 0.0]]))[0, 0])
        by_hops[max_hops] = traced.path("phone", side).objects if side >= 0 else ()
        back = PathsToPoint(cost_per_m, contacts, [0.0] * 5, max_hops, "t3", (3.0, 0.0, 0.0)).legs("phone")
        assert tuple(leg.object_id for leg in back or ()) == by_hops[max_hops][1:]
        assert [leg.cost for leg in back or ()] == pytest.approx([1.0, 2.0, 3.0] if back else [])
    assert by_hops == {None: ("phone", "t1", "t2", "t3"), 3: ("phone", "t1", "t2", "t3"), 2: ()}


def test_of_equal_paths_the_one_with_fewer_contacts_is_taken() -> None:
    """A rigid tray between phone and table, at one point with the phone's own foot."""
    contacts = [
        Contact("phone", "tray", (0.0, 0.0, 0.0)),
        Contact("table", "tray", (0.0, 0.0, 0.0)),
        Contact("phone", "table", (0.0, 0.0, 0.0)),
    ]
    traced = TracedPaths({"tray": 0.0, "table": 1.0}, contacts, [0.0] * 3, ("phone",), None)
    side = int(traced.entered("table", np.array([[1.0, 0.0, 0.0]]))[0, 0])
    assert traced.path("phone", side) == (("phone", "table"), ((0.0, 0.0, 0.0),), (0.0,))


@pytest.mark.parametrize("max_hops", [None, 3])
def test_objects_of_a_path_are_those_of_its_way_without_detours(max_hops: int | None) -> None:
    """A steel bar on a rug: from the phone over rug, bar and rug to the cup."""
    contacts = [
        Contact("phone", "rug", (0.0, 0.0, 0.0)),
        Contact("bar", "rug", (0.1, 0.0, 0.0)),
        Contact("bar", "rug", (4.9, 0.0, 0.0)),
        Contact("cup", "rug", (5.0, 0.0, 0.0)),
    ]
    traced = TracedPaths({"rug": 5.0, "bar": 0.1, "cup": 1.0}, contacts, [0.0] * 4, ("phone",), max_hops)
    (on_rug,), (on_cup,) = (traced.entered(x, np.array([[5.0, 0.0, 0.0]]))[0].tolist() for x in ("rug", "cup"))
    assert traced.path("phone", on_rug).objects == ("phone", "rug", "bar", "rug")
    n_crossed = 4 if max_hops is None else 2  # with three contacts the cup is reached over the rug alone
    assert len(traced.path("phone", on_cup).entries_m) == n_crossed
    assert traced.objects("phone", [on_cup, -1, on_rug]) == [("phone", "rug", "cup"), (), ("phone", "rug")]


def test_no_contact_and_no_source_give_no_path() -> None:
    traced = TracedPaths({"table": 1.0}, [], [], ("phone",), None)
    assert traced.entered("table", np.zeros((2, 3))).tolist() == [[-1, -1]]
    assert PathsToPoint({"table": 1.0}, [], [], None, "table", (0.0, 0.0, 0.0)).legs("phone") is None
    assert PathsToPoint({"table": 1.0}, [], [], None, "table", (0.0, 0.0, 0.0)).legs("table") == ()
    assert TracedPaths({"table": 1.0}, [], [], (), None).entered("table", np.zeros((2, 3))).shape == (0, 2)


def test_a_row_of_objects_may_be_longer_than_pythons_stack() -> None:
    n = 1500
    contacts = [Contact(f"o{i:04d}", f"o{i + 1:04d}", (float(i), 0.0, 0.0)) for i in range(n)]
    cost_per_m = {f"o{i:04d}": 0.0 for i in range(n + 1)}
    legs = PathsToPoint(cost_per_m, contacts, [0.1] * n, None, f"o{n:04d}", (float(n), 0.0, 0.0)).legs("o0000")
    assert legs is not None
    assert ["o0000", *(leg.object_id for leg in legs)] == list(cost_per_m)


def test_memory_does_not_grow_with_sources_times_contacts_squared() -> None:
    """Many sources on a floor that conduct better than it, so that a path enters and leaves the floor at all of them.

    An array over sources, contacts and contacts would have 16 MB here, and 50 GB on a floor of a thousand sources.
    """
    rng = np.random.default_rng(1)
    names = [f"o{i}" for i in range(50)]
    contacts = [Contact(name, "floor", (*rng.uniform(0, 9, 2).tolist(), 0.0)) for name in names for _ in range(4)]
    cost_per_m = {"floor": 1.0} | dict.fromkeys(names, 0.1)
    tracemalloc.start()
    try:
        TracedPaths(cost_per_m, contacts, [0.0] * len(contacts), names, None)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < 4e6
