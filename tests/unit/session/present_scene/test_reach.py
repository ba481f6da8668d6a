"""Connected groups of objects, updated as contacts change, against networkx."""

import networkx as nx
import numpy as np
import pytest

from scene2hap.contact.graph import ContactChange
from scene2hap.session.present_scene.reach import Reach, reach_over

NAMES = [f"x{i:02d}" for i in range(24)]
SOURCES = ("x00", "x07", "x13", "elsewhere")
# Two objects do not transmit vibration.
CARRIERS = {*NAMES, "elsewhere"} - {"x05", "x11"}


def beside_of(pairs: set[tuple[str, str]]) -> dict[str, set[str]]:
    beside: dict[str, set[str]] = {}
    for a, b in pairs:
        beside.setdefault(a, set()).add(b)
        beside.setdefault(b, set()).add(a)
    return beside


def check(reach: Reach, pairs: set[tuple[str, str]]) -> None:
    graph = nx.Graph([pair for pair in pairs if CARRIERS.issuperset(pair)])
    reached = set()
    for name in (*NAMES, "elsewhere", "nobody"):
        together = nx.node_connected_component(graph, name) if name in graph else set()
        known = {i for i, source in enumerate(SOURCES) if source in together}
        assert reach.sources(name) == known
        assert reach.has(name) == bool(known)
        if reach.has(name):
            reached |= together
        assert reach.objects_near([name]) == (together if reach.has(name) else set())
    assert reach.objects == reached == reach_over(pairs, CARRIERS, SOURCES).objects
    assert reach.n_without([]) == len(reached)
    assert reach.n_without(["elsewhere"]) == len(reached & set(NAMES))


@pytest.mark.parametrize("n_pairs", [8, 25, 60])
def test_groups_follow_contacts(n_pairs: int) -> None:
    rng = np.random.default_rng(n_pairs)

    def some(n: int) -> set[tuple[str, str]]:
        ends = (sorted(rng.choice(NAMES, 2, replace=False).tolist()) for _ in range(n))
        return {(a, b) for a, b in ends}

    pairs = some(n_pairs)
    beside = beside_of(pairs)
    reach = Reach(beside, CARRIERS, SOURCES)
    check(reach, pairs)
    for _ in range(60):
        went = {pair for pair in pairs if rng.random() < rng.choice([0.02, 0.3])}
        came = some(int(rng.integers(0, 1 + len(went)))) - pairs
        pairs = (pairs - went) | came
        beside.clear()
        beside.update(beside_of(pairs))
        change = ContactChange(frozenset(came), frozenset(went))
        reach.follow(change)
        check(reach, pairs)


def test_change_affects_only_groups_that_contain_a_source() -> None:
    pairs = {("x00", "x01"), ("x01", "x02"), ("x03", "x04")}
    reach = Reach(beside_of(pairs), CARRIERS, SOURCES)
    assert reach.concerns(ContactChange(shifted=frozenset({("x01", "x02")})))
    assert not reach.concerns(ContactChange(shifted=frozenset({("x03", "x04")})))
    assert not reach.concerns(ContactChange())
