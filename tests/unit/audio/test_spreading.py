from __future__ import annotations

import math
from itertools import combinations, permutations

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from scene2hap.audio.actuators import ACTUATORS
from scene2hap.audio.levels import drive_db, sensation_level_db
from scene2hap.audio.spreading import FeltSource, Placement, SpreadLimits, spread
from scene2hap.audio.spreading.linear_programme import LinearProgramme
from scene2hap.audio.spreading.placements import LEVEL_STEP_DB, Outcome, Problem
from scene2hap.errors import ConfigError
from scene2hap.haptics import ActuatorProfile

FLAT = ActuatorProfile()


def lacking(places: list[Placement], weber: float = 0.22, jnd_db: float = 2.5) -> int:
    """The number of pairs that are neither two JNDs of frequency apart, nor one JND of frequency and two of level."""
    count = 0
    for one, other in combinations(places, 2):
        jnds = abs(math.log(one.target_hz / other.target_hz)) / math.log1p(weber)
        levels = abs(one.level_db - other.level_db) / jnd_db
        count += not (jnds >= 2 or (jnds >= 1 and levels >= 2))
    return count


def test_spread_moves_equal_sources_to_the_least_distinct_distance() -> None:
    places = spread([FeltSource(200.0, 20.0, "a"), FeltSource(200.0, 20.0, "b")])
    low, high = sorted(place.target_hz for place in places)
    assert high / low == pytest.approx(1.25**2, rel=0.01)
    assert [place.level_db for place in places] == [20.0, 20.0]


@pytest.mark.parametrize(
    ("apart_jnds", "apart_steps", "lacks_jnds"),
    [(0.0, 0.0, 2.0), (1.5, 0.0, 0.5), (2.0, 0.0, 0.0), (1.0, 2.0, 0.0), (0.4, 2.0, 0.6), (1.0, 1.5, 0.5)],
)
def test_outcome_lacks_what_a_pair_needs_for_two_jnds(apart_jnds: float, apart_steps: float, lacks_jnds: float) -> None:
    """Two in frequency, or one in frequency and two in level; whichever is nearer."""
    problem = Problem.of([FeltSource(100.0, 25.0), FeltSource(100.0, 25.0)], ActuatorProfile(), SpreadLimits(), 0.2)
    x = problem.x0 + np.array([0.0, apart_jnds]) * problem.jnd_oct
    level_db = np.array([25.0, 25.0 - apart_steps * LEVEL_STEP_DB])
    assert Outcome(problem, x, level_db).shortage_oct == pytest.approx(lacks_jnds * problem.jnd_oct)


def test_spread_keeps_sources_that_are_distinct() -> None:
    """Frequencies are equal to the last digit; in an earlier version a rounding error counted as a shift."""
    sources = [FeltSource(99.99970832649828, 20.0), FeltSource(160.1, 20.0), FeltSource(251.3, 12.0)]
    for source, place in zip(sources, spread(sources), strict=True):
        assert place.target_hz == source.own_hz
        assert place.level_db == pytest.approx(source.level_db)


def test_spread_keeps_groups_together_and_obeys_zero_limits() -> None:
    sources = [FeltSource(200.0, 20.0, "fan"), FeltSource(205.0, 20.0, "fan")]
    assert [round(place.target_hz, 6) for place in spread(sources)] == [200.0, 205.0]
    still = spread(
        [FeltSource(200.0, 20.0, "a"), FeltSource(200.0, 20.0, "b")], limits=SpreadLimits(octaves=0, level_db=0)
    )
    assert still == (Placement(200.0, 20.0), Placement(200.0, 20.0))
    assert spread([]) == ()


def test_spread_gives_equal_sources_of_a_group_one_frequency() -> None:
    one, two, _ = spread(
        [FeltSource(200.0, 20.0, "fan"), FeltSource(200.0, 20.0, "fan"), FeltSource(205.0, 20.0, "pump")]
    )
    assert one == two


def test_of_two_equal_sources_the_one_that_can_be_louder_becomes_the_stronger() -> None:
    """Limits of 0.2 octaves need two JNDs of level, and a crest of 10 dB leaves no headroom to be louder."""
    peaky, even = FeltSource(200.0, 31.0, "a", crest_db=10.0), FeltSource(200.0, 31.0, "b")
    for sources in ([peaky, even], [even, peaky]):
        places = dict(zip(sources, spread(sources, limits=SpreadLimits(octaves=0.2)), strict=True))
        assert lacking(list(places.values())) == 0
        assert places[even].level_db > 31.0 > places[peaky].level_db


@pytest.mark.parametrize("n_sources", [2, 4, 6, 12])
def test_a_placement_does_not_depend_on_the_order_of_sources(n_sources: int) -> None:
    rng = np.random.default_rng(n_sources)
    for _ in range(2 if n_sources < 6 else 1):  # six take seconds
        sources = [FeltSource(rng.uniform(100, 300), rng.choice([15.0, 20.0, 25.0]), f"{i}") for i in range(n_sources)]
        shuffled = [sources[i] for i in rng.permutation(n_sources)]
        assert dict(zip(sources, spread(sources), strict=True)) == dict(zip(shuffled, spread(shuffled), strict=True))


def test_spread_keeps_placed_sources_and_moves_others_away() -> None:
    placed, free = spread([FeltSource(200.0, 20.0, "a", is_placed=True), FeltSource(260.0, 20.0, "b")])
    assert placed == Placement(200.0, 20.0)
    assert free.target_hz / 200.0 >= 1.25**2


def test_sources_with_different_rhythms_share_a_frequency_when_space_is_short() -> None:
    """Twelve sources at one frequency cannot all be moved apart, but three of them are distinct by rhythm."""
    steady = [FeltSource(200.0, 20.0, str(i)) for i in range(9)]
    lively = [FeltSource(200.0, 20.0, f"r{i}", rhythm_hz=hz) for i, hz in enumerate((3.0, 10.0, 30.0))]
    places = spread([*steady, *lively])[9:]
    octaves = [abs(math.log2(a.target_hz / b.target_hz)) for a, b in combinations(places, 2)]
    assert min(octaves) < math.log2(1.22)
    few = spread(lively[:2])
    assert abs(math.log2(few[0].target_hz / few[1].target_hz)) > math.log2(1.22)


def test_spread_moves_no_source_beyond_the_drive_limit_of_the_actuator() -> None:
    weak_below = ActuatorProfile("lra", 20.0, 1000.0, 220.0, 6.0)
    level_db = 22.0
    sources = [FeltSource(200.0, level_db, name) for name in "abc"]
    for place in spread(sources, weak_below):
        assert float(drive_db(place.target_hz, place.level_db, weak_below)) <= -6.0


_sources = st.lists(
    st.tuples(st.floats(60, 500), st.floats(0.1, 1.0)).map(lambda v: (v[0], sensation_level_db(v[1]))),
    min_size=2,
    max_size=4,
)


@settings(max_examples=8)
@given(_sources)
def test_spread_keeps_limits_and_the_order_of_levels(drawn: list[tuple[float, float]]) -> None:
    sources = [FeltSource(own_hz, level_db, str(i)) for i, (own_hz, level_db) in enumerate(drawn)]
    places = spread(sources)
    for source, place in zip(sources, places, strict=True):
        assert abs(math.log2(place.target_hz / source.own_hz)) <= 1 / 3
        assert abs(place.level_db - source.level_db) <= 3.0
    for (one, there), (other, here) in combinations(zip(sources, places, strict=True), 2):
        if one.level_db > other.level_db + 1e-6:
            assert there.level_db > here.level_db
    assert places == spread(sources)


def test_spread_of_many_sources_improves_distinctness_within_limits() -> None:
    rng = np.random.default_rng(4)
    sources = [
        FeltSource(float(f), sensation_level_db(float(i)), str(k))
        for k, (f, i) in enumerate(rng.uniform((60, 0.1), (400, 1), (16, 2)))
    ]
    before = [Placement(source.own_hz, source.level_db) for source in sources]
    after = list(spread(sources))
    assert lacking(after) < 0.8 * lacking(before)
    assert after == list(spread(sources))
    for source, place in zip(sources, after, strict=True):
        assert abs(math.log2(place.target_hz / source.own_hz)) <= 1 / 3
        assert abs(place.level_db - source.level_db) <= 3.0


def test_spread_limits_out_of_bounds_are_refused() -> None:
    with pytest.raises(ConfigError, match="spread setting octaves"):
        SpreadLimits.parse({"octaves": 2.0})


def shortage_in_a_row(problem: Problem) -> float:
    """The least, over all orders, of the largest shortage of neighbours [oct], for sources that keep their levels.

    For each order the sources are put as low as a given shortage allows, and this shortage is found by bisection.
    """

    def fits(order: tuple[int, ...], shortage: float) -> bool:
        x = -math.inf
        for i in order:
            x = max(x, float(problem.x_low[i]))
            if x > problem.x_high[i]:
                return False
            x += 2.0 * problem.jnd_oct - shortage
        return True

    low, high = 0.0, 2.0 * problem.jnd_oct
    orders = [*permutations(range(len(problem.x0)))]
    if any(fits(order, 0.0) for order in orders):
        return 0.0
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if any(fits(order, middle) for order in orders) else (middle, high)
    return high


@settings(max_examples=40, deadline=None)
@given(st.lists(st.floats(60.0, 400.0), min_size=2, max_size=5), st.floats(0.05, 1.0))
def test_a_programme_is_infeasible_if_the_sources_do_not_fit_in_a_row(own_hz: list[float], octaves: float) -> None:
    sources = [FeltSource(hz, 20.0, str(i)) for i, hz in enumerate(own_hz)]
    problem = Problem.of(sources, FLAT, SpreadLimits(octaves=octaves, level_db=0.0), 0.22)
    if len(problem.pairs) < math.comb(len(sources), 2):
        return  # some sources cannot meet, so that more than neighbours would have to be compared
    programme, least = LinearProgramme(problem), shortage_in_a_row(problem)
    assert not programme.is_infeasible(least + 1e-3)
    if least > 1e-3:
        assert programme.is_infeasible(least - 1e-3)


@pytest.mark.parametrize("actuator", ["flat", "lra", "drake_hf"])
def test_placements_are_those_of_a_search_that_leaves_out_nothing(
    actuator: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    rng = np.random.default_rng(23)
    profile = ACTUATORS[actuator]
    low, high = max(60.0, profile.min_frequency_hz), min(300.0, profile.max_frequency_hz)
    scenes = [
        [FeltSource(float(rng.uniform(low, high)), float(rng.choice([14.0, 20.0, 26.0])), str(i)) for i in range(n)]
        for n in (2, 2, 3, 3, 4, 4, 5)
    ]
    placed = [spread(sources, profile) for sources in scenes]
    monkeypatch.setattr(LinearProgramme, "is_infeasible", lambda *_: False)
    assert placed == [spread(sources, profile) for sources in scenes]


def test_no_best_placement_is_searched_among_distances_that_do_not_fit(monkeypatch: pytest.MonkeyPatch) -> None:
    """Five sources do not fit into the 0.8 octaves of a small motor: four pairs of neighbours need 2.3 octaves."""
    solved = []
    solve = LinearProgramme.solve
    monkeypatch.setattr(LinearProgramme, "solve", lambda self: solved.append(self) or solve(self))
    spread([FeltSource(hz, 20.0, str(hz)) for hz in (140.0, 150.0, 160.0, 170.0, 180.0)], ACTUATORS["lra"])
    assert len(solved) == 1
