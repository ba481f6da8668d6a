"""Detection of landings: which motions count as a landing."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np
import pytest

from contact_scenes import box, scene
from scene2hap.contact.graph import ContactGraph
from scene2hap.scene.pose import Pose
from scene2hap.session.landings import Landing, Landings

PERIOD_S = 1 / 90
Path = Iterator[tuple[float, float, float]]
RESTS_M = 0.76
"""Height of the cup's centre on the table."""


def room() -> ContactGraph:
    return ContactGraph(
        scene(
            box("floor", (4.0, 0.1, 4.0), (0, -0.05, 0)),
            box("table", (1.2, 0.7, 0.8), (0, 0.35, 0)),
            box("wall", (0.1, 3.0, 4.0), (0.71, 1.5, 0)),
            box("cup", (0.08, 0.12, 0.08), (0.0, RESTS_M, 0.0)),
            box("book", (0.2, 0.03, 0.15), (-0.4, 0.715, 0.2)),
        )
    )


def _middle(object_id: str) -> tuple[float, float, float]:
    return 0.0, 0.0, 0.0  # boxes are centred


def landings_of(path: Path, *, moved: str = "cup", period_s: float = PERIOD_S, clock: bool = True) -> list[Landing]:
    """The landings while an object moves along a path, and for half a second afterwards."""
    graph = room()
    landings, found, time_s, last = Landings(graph, _middle, period_s), list[Landing](), 0.0, None
    at = [*path]
    for position in [*at, *[None] * 45]:
        poses = {} if position is None else {moved: Pose(position)}
        last = position or last
        landings.begin(poses, time_s)
        graph.update(poses)
        found += landings.look(poses, time_s)
        time_s += period_s if clock else 0.0
    return found


def fall(height_m: float, period_s: float, onto_m: float = RESTS_M) -> Path:
    """A free fall from above the table that ends at rest."""
    step = 0
    while (y := height_m - 9.81 * (step * period_s) ** 2 / 2) > 0:
        yield 0.0, onto_m + y, 0.0
        step += 1
    for _ in range(5):
        yield 0.0, onto_m, 0.0


@pytest.mark.parametrize("period_s", [1 / 200, 1 / 90, 1 / 60, 1 / 30])
@pytest.mark.parametrize("height_m", [0.02, 0.05, 0.13, 0.4, 1.0])
def test_dropped_object_lands_once(height_m: float, period_s: float) -> None:
    found = landings_of(fall(height_m, period_s), period_s=period_s)
    assert [(one.object_id, one.onto) for one in found] == [("cup", "table")]
    fell_at = math.sqrt(2 * 9.81 * height_m)
    assert 0.5 * fell_at <= found[0].speed_m_s <= 1.05 * fell_at
    assert found[0].point_m[1] == pytest.approx(0.7, abs=1e-3)


def test_object_lands_with_the_first_frame_at_rest() -> None:
    graph = room()
    landings = Landings(graph, _middle, PERIOD_S)
    when = []
    for step, position in enumerate(fall(0.3, PERIOD_S)):
        poses = {"cup": Pose(position)}
        landings.begin(poses, step * PERIOD_S)
        graph.update(poses)
        if landings.look(poses, step * PERIOD_S):
            when.append(step)
    (step,) = when
    came_to_rest = math.ceil(math.sqrt(2 * 0.3 / 9.81) / PERIOD_S)
    assert step in (came_to_rest, came_to_rest + 1)


def test_stopped_clock_counts_as_the_usual_frame_time() -> None:
    (landing,) = landings_of(fall(0.4, PERIOD_S), clock=False)
    assert landing.speed_m_s == pytest.approx(math.sqrt(2 * 9.81 * 0.4), rel=0.3)


def test_teleported_object_does_not_land() -> None:
    assert landings_of(iter([(0.0, 2.0, 0.0), (0.0, RESTS_M, 0.0)])) == []


def test_each_bounce_lands() -> None:
    def bouncing() -> Path:
        yield from fall(0.4, PERIOD_S)
        for step in range(100):
            y = 1.2 * step * PERIOD_S - 9.81 * (step * PERIOD_S) ** 2 / 2
            if step and y <= 0:
                break
            yield 0.0, RESTS_M + y, 0.0
        yield 0.0, RESTS_M, 0.0

    assert [one.onto for one in landings_of(bouncing())] == ["table", "table"]


def test_physics_at_half_the_update_rate_gives_one_landing() -> None:
    every_second = [position for position in fall(0.4, 2 * PERIOD_S) for _ in range(2)]
    found = landings_of(iter(every_second))
    assert [one.onto for one in found] == ["table"]


def test_object_thrown_at_a_wall_lands_on_the_wall() -> None:
    thrown = [(0.2 + min(0.42, 0.03 * step), RESTS_M + 0.3, 0.0) for step in range(25)]
    assert [one.onto for one in landings_of(iter(thrown))] == ["wall"]


def test_object_put_down_gently_does_not_land() -> None:
    def lowered() -> Path:  # minimum jerk over 0.6 s, like a hand (Flash and Hogan 1985)
        for step in range(60):
            s = min(1.0, step * PERIOD_S / 0.6)
            yield 0.0, RESTS_M + 0.25 * (1 - s**3 * (10 - 15 * s + 6 * s * s)), 0.0

    assert landings_of(lowered()) == []


def rests(rng: np.random.Generator) -> Path:
    for _ in range(20):
        yield 0.0, RESTS_M, 0.0


def jitters(rng: np.random.Generator) -> Path:
    for x, y, z in rng.uniform(-0.0005, 0.0005, (40, 3)) if rng.random() < 0.5 else rng.uniform(-1e-3, 1e-3, (40, 3)):
        yield x, RESTS_M + y, z


def slides(rng: np.random.Generator) -> Path:
    """Sliding at up to 2 m/s in changing directions with sudden stops, never to the wall or the book."""
    at = np.array([0.0, 0.0])
    for _ in range(4):
        speed = rng.uniform(-2.0, 2.0, 2)
        for _ in range(rng.integers(2, 12)):
            at = np.clip(at + speed * PERIOD_S, -0.2, 0.3)
            yield float(at[0]), RESTS_M + rng.uniform(-1e-3, 1e-3), float(at[1])
        for _ in range(rng.integers(0, 5)):
            yield float(at[0]), RESTS_M, float(at[1])


@pytest.mark.parametrize("kind", [rests, jitters, slides])
def test_resting_sliding_or_jittering_object_does_not_land(kind: Callable[[np.random.Generator], Path]) -> None:
    rng = np.random.default_rng(7)
    assert [landings_of(kind(rng)) for _ in range(335)] == [[]] * 335


def test_objects_carried_together_do_not_land() -> None:
    graph = room()
    landings = Landings(graph, _middle, PERIOD_S)
    graph.update({"cup": Pose((-0.4, 0.79, 0.2))})
    found = []
    for step in range(40):
        y = max(0.0, 0.5 - 0.03 * step) + 0.3
        poses = {"cup": Pose((-0.4, 0.79 + y, 0.2)), "book": Pose((-0.4, 0.715 + y, 0.2))}
        landings.begin(poses, step * PERIOD_S)
        graph.update(poses)
        found += landings.look(poses, step * PERIOD_S)
    assert found == []


def test_dropped_stack_lands_with_its_lowest_object() -> None:
    graph = room()
    landings = Landings(graph, _middle, PERIOD_S)
    found = []
    for step in range(40):
        y = max(0.0, 0.5 - 0.03 * step)
        poses = {"cup": Pose((-0.4, 0.79 + y, 0.2)), "book": Pose((-0.4, 0.715 + y, 0.2))}
        landings.begin(poses, step * PERIOD_S)
        graph.update(poses)
        found += landings.look(poses, step * PERIOD_S)
    assert [(one.object_id, one.onto) for one in found] == [("book", "table")]


def test_object_removed_while_falling_does_not_land() -> None:
    graph = room()
    landings = Landings(graph, _middle, PERIOD_S)
    for step in range(3):
        poses = {"cup": Pose((0.0, 1.2 - 0.03 * step, 0.0))}
        landings.begin(poses, step * PERIOD_S)
        graph.update(poses)
        landings.look(poses, step * PERIOD_S)
    graph.update({}, removed=["cup"])
    landings.begin({}, 3 * PERIOD_S)
    assert landings.look({}, 3 * PERIOD_S) == []
