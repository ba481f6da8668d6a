"""Single path queries on a changing contact graph, against a search of the whole scene."""

import math
from itertools import pairwise

import numpy as np
import pytest

from contact_scenes import box, scene
from scene2hap import Bands, ExponentialPlate, Plate, materials
from scene2hap.compiled import KERNELS
from scene2hap.contact.graph import ContactGraph
from scene2hap.propagation.paths.live_law import LivePaths
from scene2hap.propagation.paths.prepared_paths import arrivals_at, cheapest_arrivals
from scene2hap.scene.objects import Contact
from scene2hap.scene.pose import Pose

SOURCES = ("radio", "phone", "lamp", "fan")
COST_PER_M = {"floor": 0.3, "table": 0.2, "shelf": 0.4, "radio": 0.1, "phone": 0.5, "cup": 0.2}


def crossing(weight: float) -> float:
    return 0.01 - math.log(weight) / 40


def room() -> ContactGraph:
    return ContactGraph(
        scene(
            box("floor", (4.0, 0.1, 4.0), (0, -0.05, 0)),
            box("table", (1.2, 0.7, 0.8), (0, 0.35, 0)),
            box("shelf", (0.6, 1.0, 0.3), (1.2, 0.5, 0)),
            box("radio", (0.2, 0.1, 0.1), (-0.3, 0.75, 0)),
            box("phone", (0.1, 0.01, 0.1), (0.2, 0.705, 0.1)),
            box("cup", (0.08, 0.1, 0.08), (0.2, 0.76, 0.1)),
            box("lamp", (0.1, 0.3, 0.1), (1.2, 1.15, 0)),
            box("fan", (0.1, 0.3, 0.1), (5.0, 5.0, 5.0)),
        )
    )


@pytest.mark.parametrize("max_hops", [1, 2, 3, None])
def test_live_law_equals_a_search_of_the_whole_scene(max_hops: int | None) -> None:
    graph = room()
    paths = LivePaths(graph, COST_PER_M, crossing, SOURCES, max_hops)
    rng = np.random.default_rng(1)
    reached = 0
    for step in range(12):
        lift = 0.3 if step % 4 == 3 else 0.0
        graph.update({"phone": Pose((0.2 + 0.01 * step, 0.705, 0.1)), "radio": Pose((-0.3, 0.75 + lift, 0.02 * step))})
        costs = [crossing(contact.weight) for contact in graph.contacts]
        arrivals = cheapest_arrivals(COST_PER_M, graph.contacts, costs, SOURCES, max_hops)
        for touched in graph.poses:
            for _ in range(2):  # the second query uses results cached by the first
                point = tuple(rng.uniform(-1, 1, 3).tolist())
                found = paths.least_costs([(touched, point)])
                if touched in COST_PER_M:
                    expected = arrivals_at(arrivals, COST_PER_M, SOURCES, touched, [point])[0]
                    np.testing.assert_allclose(found, expected, rtol=1e-12)
                    reached += int(np.isfinite(expected).sum())
                else:
                    assert found == [0.0 if source == touched else math.inf for source in SOURCES]
    assert reached > 100


def test_live_law_accepts_engine_contacts() -> None:
    graph = room()
    paths = LivePaths(graph, COST_PER_M, crossing, SOURCES, 2)
    given = [Contact("radio", "table", (0, 0.7, 0), weight=0.5), Contact("floor", "table", (0, 0, 1))]
    graph.update({}, contacts=given)
    cost = (
        crossing(0.5)
        + COST_PER_M["table"] * math.dist((0, 0.7, 0), (0, 0, 1))
        + crossing(1.0)
        + COST_PER_M["floor"] * 2.0
    )
    for _ in range(2):
        assert paths.least_costs([("floor", (2.0, 0.0, 1.0))]) == pytest.approx(
            [cost, math.inf, math.inf, math.inf], rel=1e-12
        )


def test_pruned_search_finds_every_path() -> None:
    rng = np.random.default_rng(3)
    contacts = [
        Contact(f"t{i:03d}", "floor", (*rng.uniform(0, 9, 2).tolist(), 0.0)) for i in range(60) for _ in range(3)
    ]
    cost_per_m = {"floor": 0.3} | {f"t{i:03d}": float(rng.uniform(0.01, 1)) for i in range(60)}
    arrivals = cheapest_arrivals(cost_per_m, contacts, [0.0] * 180, ["t000"], None)
    import networkx

    graph = networkx.Graph()
    for name in cost_per_m:
        own = [c for c in contacts if name in (c.a, c.b)]
        for i, one in enumerate(own):
            for two in own[:i]:
                apart = math.dist(one.point_m, two.point_m) * (0.0 if name == "t000" else cost_per_m[name])
                graph.add_edge(
                    one.point_m,
                    two.point_m,
                    weight=min(apart, graph.get_edge_data(one.point_m, two.point_m, {"weight": math.inf})["weight"]),
                )
    truth = networkx.multi_source_dijkstra_path_length(graph, {c.point_m for c in contacts if c.a == "t000"})
    for point, cost in zip(arrivals["floor"].points_m.tolist(), arrivals["floor"].costs[0], strict=True):
        best = arrivals_at(arrivals, cost_per_m, ["t000"], "floor", [point])[0, 0]
        assert best == pytest.approx(truth[tuple(point)], abs=1e-12)
        assert cost >= best - 1e-12


@pytest.mark.parametrize("rigid", [{}, {"x3": 0.0}])
def test_path_costs_do_not_depend_on_query_frequency(rigid: dict[str, float]) -> None:
    rng = np.random.default_rng(8)
    names = [f"x{i}" for i in range(12)]
    graph = ContactGraph(scene(*(box(name, (0.1, 0.1, 0.1), (i, 0, 0)) for i, name in enumerate(names))))
    # The last object has no known material.
    cost_per_m = {name: float(rng.uniform(0.05, 1.0)) for name in names[:-1]} | rigid
    sources = ("x0", "x4", "x11")
    paths, limited = (LivePaths(graph, cost_per_m, crossing, sources, None) for _ in range(2))
    limits = [0.2, 0.5, 1.0]
    reached = 0
    for _ in range(30):
        pairs = {tuple(sorted(rng.choice(names, 2, replace=False).tolist())) for _ in range(12)}
        weights = [0.3, 1.0, 1.0]
        given = [Contact(a, b, tuple(rng.uniform(0, 1, 3)), weight=w) for a, b in sorted(pairs) for w in weights]
        graph.update({}, contacts=given)
        arrivals = cheapest_arrivals(cost_per_m, given, [crossing(one.weight) for one in given], sources, None)
        for touched in (*names, *names, *names):
            point = tuple(rng.uniform(0, 1, 3).tolist())
            expected = arrivals_at(arrivals, cost_per_m, sources, touched, [point])[0]
            np.testing.assert_allclose(paths.least_costs([(touched, point)]), expected, rtol=1e-12)
            for found, true, limit in zip(
                limited.least_costs([(touched, point)], limits), expected, limits, strict=True
            ):
                assert found == pytest.approx(true, rel=1e-12) if true <= limit else found > limit
            reached += int(np.isfinite(expected).sum())
    assert reached > 500


@pytest.mark.parametrize("max_hops", [3, None])
def test_an_object_without_a_cost_per_metre_passes_nothing_on(max_hops: int | None) -> None:
    contacts = [Contact("radio", "rug", (0.0, 0.0, 0.0)), Contact("rug", "table", (1.0, 0.0, 0.0))]
    arrivals = cheapest_arrivals({"table": 1.0}, contacts, [0.0, 0.0], ["radio"], max_hops)
    assert not np.isfinite(arrivals["table"].costs).any()


def test_an_impact_falls_off_as_the_paper_says() -> None:
    """exp(-k r) from the struck point to the hand, by the plate's own wavenumber."""
    table, f = Plate(1.2, 0.8, 0.02, materials.lookup("oak")), np.array([50.0, 250.0])
    law = ExponentialPlate().live(room(), {"table": table}, [], Bands.dominant())
    found = law.from_point("table", (0.1, 0.7, 0.0), [[("table", (0.4, 0.7, 0.4))]], f)
    np.testing.assert_allclose(found, [np.exp(-0.5 * table.wavenumber_rad_m(f))], rtol=1e-9)


def test_an_impact_is_not_searched_for_where_it_is_far_too_faint() -> None:
    """Of 10,000 objects, a strike took 2.6 s in the median, and so did the frame in which something landed."""
    graph, oak, f = room(), materials.lookup("oak"), np.array([200.0, 2000.0])
    bodies = {"table": Plate(1.2, 0.8, 0.0005, oak), "cup": Plate(0.1, 0.1, 0.002, oak)}
    bodies["phone"] = Plate(0.1, 0.1, 0.01, oak)
    near, far = ("phone", (0.2, 0.71, 0.1)), (-0.6, 0.7, -0.4)
    law = ExponentialPlate().live(graph, bodies, [], Bands.dominant())
    found = law.from_point("table", far, [[near], [("table", (0.6, 0.7, 0.4))]], f)
    assert not found[0].any()
    # On the struck object itself nothing is left out: only where nothing arrives is a strike felt as if on the point.
    assert 0.0 < found[1, 0] < 1e-7
    with_floor = ExponentialPlate(floor_db=-60.0).live(graph, bodies, [], Bands.dominant())
    assert with_floor.from_point("table", far, [[near]], f).min() == pytest.approx(1e-3)


@pytest.mark.parametrize("max_hops", [1, 2, 3, None])
def test_path_costs_are_exact_up_to_the_cut_off(max_hops: int | None) -> None:
    graph = room()
    limited, free = (LivePaths(graph, COST_PER_M, crossing, SOURCES, max_hops) for _ in range(2))
    rng = np.random.default_rng(2)
    n_within = n_beyond = 0
    for step in range(6):
        graph.update({"phone": Pose((0.2 + 0.01 * step, 0.705, 0.1)), "radio": Pose((-0.3, 0.75, 0.02 * step))})
        limits = rng.uniform(0.0, 0.5, len(SOURCES)).tolist()
        # Often enough that the distances around each source are cached, too.
        for _ in range(12):
            for touched in COST_PER_M:
                point = tuple(rng.uniform(-1, 1, 3).tolist())
                for found, true, limit in zip(
                    limited.least_costs([(touched, point)], limits),
                    free.least_costs([(touched, point)]),
                    limits,
                    strict=True,
                ):
                    if true <= limit:
                        assert found == pytest.approx(true, rel=1e-12)
                        n_within += true > 0
                    else:
                        assert found > limit
                        n_beyond += true < math.inf
    assert min(n_within, n_beyond) > 20


@pytest.mark.parametrize("limits", [None, [9.0]])
def test_no_path_exceeds_max_hops(limits: list[float] | None) -> None:
    names = [f"x{i}" for i in range(5)]
    graph = ContactGraph(scene(*(box(name, (0.1, 0.1, 0.1), (i, 0, 0)) for i, name in enumerate(names))))
    graph.update({}, contacts=[Contact(a, b, (0, 0, 0)) for a, b in pairwise(names)])
    paths = LivePaths(graph, dict.fromkeys(names, 0.1), crossing, ["x0"], 3)
    for _ in range(3):
        assert paths.least_costs([("x3", (0, 0, 0))], limits) == [pytest.approx(3 * crossing(1.0))]
        assert paths.least_costs([("x4", (0, 0, 0))], limits) == [math.inf]


PlainPaths, _ = KERNELS["scene2hap.propagation.paths.contact_paths.ContactPaths"]


class Noted(PlainPaths):
    """The plain search; records the objects that it leaves."""

    left: tuple[str, ...] = ()

    def _neighbours_onward(self, here: str, hops: int) -> object:
        self.left += (here,)
        return super()._neighbours_onward(here, hops)


def floor_with_cups() -> tuple[ContactGraph, dict[str, float]]:
    """A floor with a radio 1 m from its middle on one side, cups of low cost on the other; a fan on a separate mat."""
    cups = [f"cup{i}" for i in range(9)]
    names = ["floor", "radio", "fan", "mat", *cups]
    graph = ContactGraph(scene(*(box(name, (0.1, 0.1, 0.1), (i, 0, 0)) for i, name in enumerate(names))))
    feet = [(x, -0.5 + 0.1 * i, 0.0) for i in range(9) for x in (-0.8, -0.7)]
    given = [Contact(cup, "floor", feet[2 * i + k]) for i, cup in enumerate(cups) for k in (0, 1)]
    given += [Contact("radio", "floor", (1.0, y, 0.0)) for y in (0.0, 0.1)] + [Contact("fan", "mat", (5.0, 0.0, 0.0))]
    graph.update({}, contacts=given)
    return graph, {"floor": 0.3, "radio": 0.2, "mat": 0.2, "fan": 0.2} | dict.fromkeys(cups, 0.1)


def noted(graph: ContactGraph, cost_per_m: dict[str, float], max_hops: int | None = None) -> Noted:
    paths = Noted(cost_per_m, {"radio": 0, "fan": 1}, {1.0: 0.0}, max_hops)
    paths.update(None, graph.beside)
    return paths


def test_search_skips_objects_too_far_from_any_source() -> None:
    graph, cost_per_m = floor_with_cups()
    paths = noted(graph, cost_per_m)
    assert paths.cheapest([("floor", (0, 0, 0))], None, {0})[0] == pytest.approx(0.3)
    assert set(paths.left) == {"floor"}
    # The limit of one source may be too low even if the limit of another is not.
    paths.left = ()
    assert paths.cheapest([("floor", (0, 0, 0))], [0.05, 0.3]) == [math.inf, math.inf]
    assert set(paths.left) <= {"floor"}


def test_search_ignores_sources_not_connected_to_a_touch() -> None:
    graph, cost_per_m = floor_with_cups()
    paths = noted(graph, cost_per_m)
    everywhere = paths.cheapest([("floor", (0, 0, 0))])
    assert everywhere == [pytest.approx(0.3), math.inf]
    assert {"cup0", "cup8"} < set(paths.left)
    paths.left = ()
    assert paths.cheapest([("floor", (0, 0, 0))], None, {0}) == everywhere
    assert set(paths.left) == {"floor"}
    live = LivePaths(graph, cost_per_m, crossing, ["radio", "fan"], None)
    assert live.least_costs([("floor", (0, 0, 0))], None, {0}) == live.least_costs([("floor", (0, 0, 0))])


def test_the_ball_around_a_source_does_not_depend_on_the_version_of_python() -> None:
    """`sum` keeps digits from Python 3.12 on that neither earlier versions nor the compiled kernel keep."""
    graph = ContactGraph(scene(*(box(name, (0.1, 0.1, 0.1), (0, 0, 0)) for name in ("floor", "radio"))))
    feet = [(1e16, 0.0, 0.0), (1.0, 0.0, 0.0), (-1e16, 0.0, 0.0)]
    graph.update({}, contacts=[Contact("radio", "floor", foot) for foot in feet])
    paths = noted(graph, {"floor": 0.3, "radio": 0.2})
    assert paths._ball("radio")[0] == (0.0, 0.0, 0.0)


def test_with_two_contacts_left_only_neighbours_of_sources_are_entered() -> None:
    graph, cost_per_m = floor_with_cups()
    paths = noted(graph, cost_per_m, 2)
    assert paths.cheapest([("floor", (0, 0, 0))]) == [pytest.approx(0.3), math.inf]
    assert set(paths.left) == {"floor"}


@pytest.mark.parametrize("max_hops", [1, 2, 3, None])
def test_several_touches_of_a_hand_have_the_least_of_their_costs(max_hops: int | None) -> None:
    graph = room()
    paths = LivePaths(graph, COST_PER_M, crossing, SOURCES, max_hops)
    touched = [
        ("floor", (0.5, 0.0, 0.0)),
        ("cup", (0.2, 0.8, 0.1)),
        ("floor", (-1.0, 0.0, 0.0)),
        ("fan", (5.0, 5.0, 5.0)),
    ]
    each = [paths.least_costs([touch]) for touch in touched]
    assert paths.least_costs(touched) == [min(costs) for costs in zip(*each, strict=True)]
    assert paths.least_costs([]) == [math.inf] * len(SOURCES)


def test_a_detour_over_more_contacts_does_not_hide_a_dearer_path_over_fewer() -> None:
    """The cheapest path to x2 crosses three contacts; with two left, only the dearer one goes on to the source."""
    names = ["x0", "x1", "x2", "x3", "source"]
    graph = ContactGraph(scene(*(box(name, (0.1, 0.1, 0.1), (i, 0, 0)) for i, name in enumerate(names))))
    pairs = [("x0", "x1"), ("x1", "x2"), ("x2", "x3"), ("source", "x3")]
    given = [Contact(a, b, (float(i), 0.0, 0.0)) for i, (a, b) in enumerate(pairs)]
    given.append(Contact("x0", "x2", (1.0, 1.0, 0.0), weight=0.01))
    graph.update({}, contacts=given)
    cost_per_m = dict.fromkeys(names[:4], 0.001)
    dear, cheap = (
        LivePaths(graph, cost_per_m, crossing, ["source"], n).least_costs([("x0", (0, 0, 0))])[0] for n in (3, 4)
    )
    assert cheap < crossing(0.01) < dear < math.inf
    assert dear == pytest.approx(2 * crossing(1.0) + crossing(0.01) + 0.001 * (2 * math.sqrt(2) + 1), rel=1e-12)


@pytest.mark.parametrize("max_hops", [2, 3, None])
def test_a_network_that_is_updated_answers_as_a_new_one_bit_for_bit(max_hops: int | None) -> None:
    """Random contacts from an engine, given to one search that is kept and to a new search each time."""
    rng = np.random.default_rng(5)
    names = [f"x{i}" for i in range(12)]
    graph = ContactGraph(scene(*(box(name, (0.1, 0.1, 0.1), (i, 0, 0)) for i, name in enumerate(names))))
    cost_per_m = {name: float(rng.uniform(0.05, 0.5)) for name in names[:10]}
    sources, pairs = ["x1", "x7", "x11"], [(a, b) for a in names for b in names if a < b]
    contacts: dict[tuple[str, str], list[Contact]] = {}
    kept = LivePaths(graph, cost_per_m, crossing, sources, max_hops)
    n_finite = 0
    for step in range(200):
        for k in rng.permutation(len(pairs))[: rng.integers(0, 3)]:
            pair = pairs[k]
            if pair in contacts and rng.random() < 0.6:
                del contacts[pair]
            else:
                places = rng.uniform(-1, 1, (int(rng.integers(1, 4)), 3)).tolist()
                contacts[pair] = [
                    Contact(*pair, tuple(place), weight=float(rng.choice([0.5, 1.0]))) for place in places
                ]
        graph.update({}, contacts=[one for several in contacts.values() for one in several])
        if step % 7 < 5 or 100 < step < 130:  # several changes without a query, once more than the log holds
            continue
        fresh = LivePaths(graph, cost_per_m, crossing, sources, max_hops)
        for touched in names[:10]:
            expected = fresh.least_costs([(touched, (0.0, 0.0, 0.0))])
            assert kept.least_costs([(touched, (0.0, 0.0, 0.0))]) == expected
            n_finite += sum(map(math.isfinite, expected))
    assert n_finite > 200


def test_paths_succeed_others_when_objects_and_sources_come_and_go() -> None:
    rng = np.random.default_rng(4)
    graph = room()
    paths, cost_per_m, sources = LivePaths(graph, COST_PER_M, crossing, SOURCES, None), COST_PER_M, SOURCES
    for step in range(60):
        former = paths, cost_per_m, sources
        cost_per_m = {x: per_m for x, per_m in {**COST_PER_M, "lamp": 0.3}.items() if rng.random() < 0.8}
        sources = tuple(rng.permutation([x for x in (*SOURCES, "cup") if rng.random() < 0.7]).tolist())
        paths = LivePaths(graph, cost_per_m, crossing, sources, None)
        paths.succeed(former[0])
        graph.update({"phone": Pose((0.2, 0.705 + 0.2 * (step % 2), 0.1)), "radio": Pose((-0.3, 0.75, 0.005 * step))})
        for touched in COST_PER_M:
            where = [(touched, tuple(rng.uniform(-1, 1, 3).tolist()))]
            # The former ones still answer, of their own sources: the gains of an earlier frame may be read late.
            for one, its_per_m, its_sources in (former, (paths, cost_per_m, sources))[step % 3 == 0 :]:
                fresh = LivePaths(graph, its_per_m, crossing, its_sources, None)
                assert one.least_costs(where) == fresh.least_costs(where)
