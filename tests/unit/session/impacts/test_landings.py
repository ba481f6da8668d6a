"""Detection of landings: which motions count as a landing."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from typing import Any

import numpy as np
import pytest

from contact_scenes import Triple, box, boxes, thing
from cup_over_table import state_of
from scene2hap.scene.objects import Contact, SceneObject
from scene2hap.scene.pose import Pose
from scene2hap.scene.shapes import TriMesh
from scene2hap.session.impacts.landings import Landing, Landings
from scene2hap.session.present_scene.scene_state import SceneState

PERIOD_S = 1 / 90
Path = Iterator[tuple[float, float, float]]
RESTS_M = 0.76
"""Height of the cup's centre on the table."""


def room(*more: SceneObject, without: str | None = None) -> SceneState:
    usual = (
        box("floor", (4.0, 0.1, 4.0), (0, -0.05, 0)),
        box("table", (1.2, 0.7, 0.8), (0, 0.35, 0)),
        box("wall", (0.1, 3.0, 4.0), (0.71, 1.5, 0)),
        box("cup", (0.08, 0.12, 0.08), (0.0, RESTS_M, 0.0)),
        box("book", (0.2, 0.03, 0.15), (-0.4, 0.715, 0.2)),
    )
    return state_of(*(one for one in usual if one.id != without), *more)


def landings_of(path: Path, *, moved: str = "cup", period_s: float = PERIOD_S, clock: bool = True) -> list[Landing]:
    """The landings while an object moves along a path, and for half a second afterwards."""
    state = room()
    landings, found, time_s, last = Landings(state, period_s), list[Landing](), 0.0, None
    at = [*path]
    for position in [*at, *[None] * 45]:
        poses = {} if position is None else {moved: Pose(position)}
        last = position or last
        landings.begin(poses, time_s)
        state.graph.update(poses)
        found += landings.look(poses, time_s)
        time_s += period_s if clock else 0.0
    return found


def landings_in(state: SceneState, frames: Iterable[tuple[Any, ...]]) -> list[Landing]:
    """What lands in frames of a time [s], poses and contacts (none: they are found), and in half a second more."""
    landings, found, time_s = Landings(state, PERIOD_S), list[Landing](), 0.0
    given = [*frames]
    for time_s, poses, *contacts in [*given, *((given[-1][0] + (i + 1) * PERIOD_S, {}) for i in range(45))]:
        landings.begin(poses, time_s)
        state.graph.update(poses, contacts=contacts[0] if contacts else None)
        found += landings.look(poses, time_s)
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
    assert found[0].speed_m_s == pytest.approx(math.sqrt(2 * 9.81 * height_m), rel=1e-6)
    assert found[0].point_m[1] == pytest.approx(0.7, abs=1e-3)


def speeds_of(height_m: Callable[[float], float], lasts_s: float, frames_hz: int, noise_m: float) -> list[float]:
    """The speeds of landings of the cup in frames of unequal length, begun at ten times, after 0.2 s at rest."""
    found = []
    for seed in range(10):
        rng = np.random.default_rng(seed)
        times = np.cumsum(rng.uniform(0.7, 1.3, round((lasts_s + 0.3) * frames_hz)) / frames_hz)
        at = rng.normal(0.0, noise_m, (len(times), 3))
        at[:, 1] += [RESTS_M + height_m(t - 0.2) for t in times.tolist()]
        frames = [(t, {"cup": Pose(tuple(here))}) for t, here in zip(times.tolist(), at.tolist(), strict=True)]
        found += [one.speed_m_s for one in landings_in(room(), frames)[:1]]
    return found


@pytest.mark.parametrize(("frames_hz", "height_m"), [(30, 0.1), (60, 0.03), (90, 0.02), (90, 0.03), (120, 0.02)])
@pytest.mark.parametrize(("noise_m", "bias", "scatter"), [(0.0, 0.03, 0.05), (3e-4, 0.06, 0.1)])
def test_speed_of_a_short_fall_is_that_at_its_end(
    frames_hz: int, height_m: float, noise_m: float, bias: float, scatter: float
) -> None:
    """Its mean speed is half of that."""
    fell_at = math.sqrt(2 * 9.81 * height_m)
    speeds = speeds_of(lambda t: height_m - 9.81 / 2 * min(max(t, 0.0), fell_at / 9.81) ** 2, 0.3, frames_hz, noise_m)
    assert len(speeds) >= 8
    assert np.mean(speeds) == pytest.approx(fell_at, rel=bias)
    assert np.std(speeds) < scatter * fell_at


@pytest.mark.parametrize("frames_hz", [60, 90, 120])
@pytest.mark.parametrize("noise_m", [0.0, 3e-4])
@pytest.mark.parametrize(("share", "most"), [(0.5, 1.05), (0.75, 1.3)])
def test_hand_that_slows_down_before_it_meets_the_table_is_not_taken_for_a_fall(
    frames_hz: int, noise_m: float, share: float, most: float
) -> None:
    """A stroke of 25 cm in 0.4 s, least jerk, ends at a share of its way. A fall would gain 0.5 m/s in 50 ms."""
    stroke_m, stroke_s = 0.25, 0.4
    shares = np.linspace(0.0, 1.0, 10_001)
    done = float(shares[np.searchsorted(shares**3 * (10 - 15 * shares + 6 * shares**2), share)])
    speed_m_s = 30 * stroke_m / stroke_s * (done * (1 - done)) ** 2

    def height_m(t: float) -> float:
        s = min(max(t / stroke_s, 0.0), done)
        return stroke_m * (share - s**3 * (10 - 15 * s + 6 * s * s))

    speeds = speeds_of(height_m, 0.4, frames_hz, noise_m)
    assert len(speeds) == 10
    assert 0.85 * speed_m_s < np.mean(speeds) < most * speed_m_s


@pytest.mark.parametrize("frames_hz", [30, 60, 90])
@pytest.mark.parametrize("begins", [0.1, 0.3, 0.5, 0.7, 0.9])
def test_a_landing_early_in_a_frame_is_as_fast_as_one_late_in_it(begins: float, frames_hz: int) -> None:
    times = [(step + begins) / frames_hz - 0.3 for step in range(frames_hz)]
    (found,) = landings_of(((0.0, RESTS_M + max(0.0, -1.5 * t), 0.0) for t in times), period_s=1 / frames_hz)
    assert found.speed_m_s == pytest.approx(1.5, rel=0.02)


@pytest.mark.parametrize("frames_hz", [30, 60, 90, 120])
def test_a_landing_soon_after_a_motion_began_is_about_as_fast_as_a_later_one(frames_hz: int) -> None:
    """The control period, 20 ms, says nothing of the time in which the first step was made. Two steps may be a fall,
    which gains as much in a frame as this tolerance."""
    speed_m_s = 2.1
    rests_m = RESTS_M + 2.5 * speed_m_s / frames_hz  # it lands in the third frame
    state = room(box("cup", (0.08, 0.12, 0.08), (0.0, rests_m, 0.0)), without="cup")
    landings, found = Landings(state, 0.02), list[Landing]()
    for frame in range(60):
        fell_m = speed_m_s * max(0, frame - 20) / frames_hz
        poses = {"cup": Pose((0.0, max(RESTS_M, rests_m - fell_m), 0.0))} if frame > 20 else {}
        landings.begin(poses, frame / frames_hz)
        state.graph.update(poses)
        found += landings.look(poses, frame / frames_hz)
    (one,) = found
    assert one.speed_m_s == pytest.approx(speed_m_s, abs=9.81 / frames_hz)


@pytest.mark.parametrize("physics_hz", [50, 45, 40])
@pytest.mark.parametrize("height_m", [0.04, 0.05, 0.06])
@pytest.mark.parametrize("phase", [0.0, 0.2, 0.4, 0.6, 0.8])
def test_object_does_not_land_in_mid_air_where_slower_physics_misses_a_frame(
    physics_hz: int, height_m: float, phase: float
) -> None:
    """A fall in frames at 60 Hz."""
    frames, shown = [], 0.0
    for frame in range(60):
        time_s = frame / 60
        if (steps := math.floor(time_s * physics_hz + phase)) > shown:
            shown = steps
            fallen = min(height_m, 9.81 / 2 * (max(0.0, steps / physics_hz) ** 2))
            frames.append((time_s, {"cup": Pose((0.0, RESTS_M + height_m - fallen, 0.0))}))
        else:
            frames.append((time_s, {}))
    state = room()
    state.graph.update({"cup": Pose((0.0, RESTS_M + height_m, 0.0))})
    landings, when = Landings(state, 1 / 60), list[float]()
    for time_s, poses in frames:
        landings.begin(poses, time_s)
        state.graph.update(poses)
        when += [time_s] * len(landings.look(poses, time_s))
    assert len(when) == 1
    fall_s = math.sqrt(2 * height_m / 9.81)
    assert fall_s - 2 / physics_hz <= when[0] <= fall_s + 2 / physics_hz + 2 / 60


@pytest.mark.parametrize(("frames_hz", "least_m_s"), [(30, 0.3), (60, 0.25), (90, 0.167), (120, 0.125)])
def test_slowest_landing_does_not_depend_on_the_time_in_a_frame(frames_hz: int, least_m_s: float) -> None:
    for speed, n_landings in ((0.95 * least_m_s, 0), (1.05 * least_m_s, 1)):
        n_steps = math.ceil(0.05 / speed * frames_hz)
        for begins in np.arange(0.025, 1.0, 0.05).tolist():
            times = [(step + begins - n_steps) / frames_hz for step in range(n_steps + 5)]
            path = ((0.0, RESTS_M + max(0.0, -speed * t), 0.0) for t in times)
            assert len(landings_of(path, period_s=1 / frames_hz)) == n_landings


@pytest.mark.parametrize("names", ["abcd", "efgh", "ijkl", "mnop", "qrst", "uvwx"])
def test_object_that_lands_on_several_lands_on_the_first_by_id(names: str) -> None:
    """The order of the graph's contacts depends on the hash seed, which differs in each run of Python."""
    blocks = [box(name, (0.1, 0.5, 0.1), (0.3 * i, 0.25, 0)) for i, name in enumerate(names)]
    state = state_of(*blocks, box("tray", (1.4, 0.04, 0.2), (0.45, 0.82, 0)))
    frames = [(i * PERIOD_S, {"tray": Pose((0.45, y, 0.0))}) for i, (_, y, _) in enumerate(fall(0.3, PERIOD_S, 0.52))]
    assert [(one.object_id, one.onto) for one in landings_in(state, frames)] == [("tray", names[0])]


def lands_in(path: Path) -> int:
    """The number of the frame in which the cup lands."""
    state = room()
    landings, when = Landings(state, PERIOD_S), []
    for step, position in enumerate(path):
        poses = {"cup": Pose(position)}
        landings.begin(poses, step * PERIOD_S)
        state.graph.update(poses)
        if landings.look(poses, step * PERIOD_S):
            when.append(step)
    (step,) = when
    return step


def test_object_lands_with_the_first_frame_at_rest() -> None:
    came_to_rest = math.ceil(math.sqrt(2 * 0.3 / 9.81) / PERIOD_S)
    assert lands_in(fall(0.3, PERIOD_S)) in (came_to_rest, came_to_rest + 1)


def test_a_frame_without_a_step_delays_no_landing_a_fifth_of_a_second_later() -> None:
    steps = [*fall(9.81 * (20.9 * PERIOD_S) ** 2 / 2, PERIOD_S)]  # so that its last step is almost whole
    assert lands_in(iter([*steps[:3], *steps[2:]])) == lands_in(iter(steps)) + 1


def test_a_pause_of_more_than_a_tenth_of_a_second_delays_no_landing_after_it() -> None:
    """It is no gap between steps of slow physics. After more than 12 frames the motion would be forgotten."""
    steps = [*fall(9.81 * (20.9 * PERIOD_S) ** 2 / 2, PERIOD_S)]
    assert lands_in(iter([*steps[:3], *[steps[2]] * 11, *steps[3:]])) == lands_in(iter(steps)) + 11


@pytest.mark.parametrize("held", range(1, 12))
@pytest.mark.parametrize("carried_m", [(0.0, -0.1), (0.3, 0.0), (0.2, -0.05)])
def test_object_that_is_held_still_before_it_falls_lands_as_early(carried_m: tuple[float, float], held: int) -> None:
    """A hold is no gap between steps of slow physics."""
    steps = [*fall(9.81 * (12.9 * PERIOD_S) ** 2 / 2, PERIOD_S)]  # so that its last step is almost whole
    (x, y, z), *_ = steps
    brought = [(x + carried_m[0] * i / 15, y + carried_m[1] * i / 15, z) for i in range(15, 0, -1)]
    assert lands_in(iter([*brought, *[steps[0]] * held, *steps])) == len(brought) + held + lands_in(iter(steps))


def test_stopped_clock_counts_as_the_usual_frame_time() -> None:
    (landing,) = landings_of(fall(0.4, PERIOD_S), clock=False)
    assert landing.speed_m_s == pytest.approx(math.sqrt(2 * 9.81 * 0.4), rel=0.3)


def test_teleported_object_does_not_land() -> None:
    assert landings_of(iter([(0.0, 2.0, 0.0), (0.0, RESTS_M, 0.0)])) == []


@pytest.mark.parametrize("frames_hz", [60, 90, 120])
def test_trembling_object_that_is_teleported_does_not_land(frames_hz: int) -> None:
    """Tracking was lost for a while, or the game puts a tracked object in its place."""
    for seed in range(10):
        at = np.random.default_rng(seed).normal((0.0, RESTS_M, 0.0), 3e-4, (40, 3))
        at[:20, 1] += 0.05
        assert landings_of(map(tuple, at.tolist()), period_s=1 / frames_hz) == []


@pytest.mark.parametrize("n_steps", [2, 4, 6])
@pytest.mark.parametrize("height_m", [0.02, 0.03, 0.04, 0.06])
def test_lifted_object_that_stops_at_once_does_not_land(height_m: float, n_steps: int) -> None:
    """Game engines move objects from one pose to another at a constant speed."""
    path = ((-0.4, 0.715 + height_m * min(1.0, step / n_steps), 0.2) for step in range(20))
    assert landings_of(path, moved="book") == []


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


@pytest.mark.parametrize("begins", [0.0, 0.3, 0.6, 0.9])
@pytest.mark.parametrize("across_m_s", [0.0, 0.02, 0.06])
def test_low_bounce_with_a_slow_drift_lands(across_m_s: float, begins: float) -> None:
    """At its highest point it goes on sideways, and at its end it is about where it began."""
    meets_s = np.cumsum([0.0, *(2 * up / 9.81 for up in (0.45, 0.225, 0.1125))]).tolist()
    path = []
    for frame in range(60):
        t = (frame + begins) * PERIOD_S - 0.2
        n = sum(t > meets for meets in meets_s)
        y = 0.04 - 9.81 / 2 * max(0.0, t + math.sqrt(0.08 / 9.81)) ** 2 if n == 0 else 0.0
        if 0 < n < 4:
            y = 0.9 / 2**n * (t - meets_s[n - 1]) - 9.81 / 2 * (t - meets_s[n - 1]) ** 2
        path.append((across_m_s * t, RESTS_M + y, 0.0))
    fast = [one for one in landings_of(iter(path)) if one.speed_m_s > 0.3]
    assert [one.speed_m_s for one in fast[1:]] == pytest.approx([0.45], rel=0.1)


def test_physics_at_half_the_update_rate_gives_one_landing() -> None:
    every_second = [position for position in fall(0.4, 2 * PERIOD_S) for _ in range(2)]
    found = landings_of(iter(every_second))
    assert [one.onto for one in found] == ["table"]


@pytest.mark.parametrize("updates_hz", [200, 300, 500, 1000, 2000])
@pytest.mark.parametrize("height_m", [0.05, 0.13, 0.4])
def test_object_that_a_soft_contact_stops_lands_once_at_any_rate_of_updates(height_m: float, updates_hz: int) -> None:
    """A game may update after each step of MuJoCo, whose contacts take some 10 ms to stop an object."""
    fell_at, lasts_s = math.sqrt(2 * 9.81 * height_m), 0.012
    fell_s, path = fell_at / 9.81, []
    for step in range(round(0.5 * updates_hz)):
        t = step / updates_hz
        after_s = min(max(t - fell_s, 0.0), lasts_s)
        sunk_m = fell_at * after_s * (1 - after_s / lasts_s) ** 2
        path.append((0.0, RESTS_M - sunk_m + max(0.0, height_m - 9.81 * t * t / 2) * (t < fell_s), 0.0))
    found = landings_of(iter(path), period_s=1 / updates_hz)
    assert [one.onto for one in found] == ["table"]
    assert 0.6 * fell_at <= found[0].speed_m_s <= 1.1 * fell_at


@pytest.mark.parametrize("phase", range(5))
def test_object_that_moves_in_some_of_many_updates_lands(phase: int) -> None:
    """A game of 1000 updates a second may move each object in every fifth of them."""
    frames: list[tuple[float, dict[str, Pose]]] = [(i / 1000, {}) for i in range(500)]
    for step, position in enumerate(fall(0.4, 1 / 200)):
        time_s, _ = frames[5 * step + phase]
        frames[5 * step + phase] = time_s, {"cup": Pose(position)}
    (landing,) = landings_in(room(), frames)
    assert landing.onto == "table"
    assert 0.5 <= landing.speed_m_s / math.sqrt(2 * 9.81 * 0.4) <= 1.05


@pytest.mark.parametrize("updates_hz", [300, 500, 1000])
def test_contact_in_any_update_of_a_fast_bounce_counts(updates_hz: int) -> None:
    """A ball that bounces off within 2 ms is out of reach by the end of the step, whose contacts an engine gives."""
    frames = []
    for step in range(round(0.4 * updates_hz)):
        t = step / updates_hz - 0.2
        y = RESTS_M + (-4.0 * t if t < 0 else 3.0 * t)
        poses = {"cup": Pose((0.0, y, 0.0))}
        touching = (
            [Contact("cup", "table", (0.0, 0.7, 0.0), (0.0, -1.0, 0.0))] if y - RESTS_M < 4.0 / updates_hz else []
        )
        frames.append((t, poses, touching))
    assert [one.onto for one in landings_in(room(), frames)] == ["table"]


def test_object_thrown_at_a_wall_lands_on_the_wall() -> None:
    thrown = [(0.2 + min(0.42, 0.03 * step), RESTS_M + 0.3, 0.0) for step in range(25)]
    assert [one.onto for one in landings_of(iter(thrown))] == ["wall"]


@pytest.mark.parametrize("frames_hz", [30, 60, 90])
@pytest.mark.parametrize("begins", [0.1, 0.3, 0.5, 0.7, 0.9])
def test_turning_object_that_bounces_as_high_as_it_fell_lands(begins: float, frames_hz: int) -> None:
    """Over the bounce its middle approaches the table by nothing, as that of an object that rolls."""
    frames = []
    for step in range(round(0.4 * frames_hz)):
        t = (step + begins) / frames_hz - 0.2
        pose = Pose((0.0, RESTS_M + 2.5 * abs(t), 0.0), about_z(0.1 * t))
        meets = Contact("cup", "table", (0.0, 0.7, 0.0), (0.0, -1.0, 0.0))
        frames.append((step / frames_hz, {"cup": pose}, [meets] if abs(t) < 1 / frames_hz else []))
    assert [one.onto for one in landings_in(room(), frames)] == ["table"]


@pytest.mark.parametrize("begins", [0.88, 0.92, 0.96])
def test_object_that_slides_on_a_table_bounces_off_a_wall(begins: float) -> None:
    """It is within 4 mm of the wall in one frame, out of reach in the next, and touches the table in all."""
    times = [(step + begins) * PERIOD_S - 0.1 for step in range(30)]
    path = [(0.62 + (2.4 * t if t < 0 else -1.5 * t), RESTS_M, 0.0) for t in times]
    assert [one.onto for one in landings_of(iter(path))] == ["wall"]


def test_object_put_down_gently_does_not_land() -> None:
    def lowered() -> Path:  # minimum jerk over 0.6 s, like a hand (Flash and Hogan 1985)
        for step in range(60):
            s = min(1.0, step * PERIOD_S / 0.6)
            yield 0.0, RESTS_M + 0.25 * (1 - s**3 * (10 - 15 * s + 6 * s * s)), 0.0

    assert landings_of(lowered()) == []


@pytest.mark.parametrize("frames_hz", [90, 120])
def test_object_put_down_gently_by_a_tracked_hand_seldom_lands(frames_hz: int) -> None:
    """The noise of a tracker alone makes differences of speed of 0.09 m/s at 120 Hz, as a braking hand does."""
    s = np.minimum(np.arange(1.2 * frames_hz) / frames_hz / 0.6, 1.0)
    height_m = 0.25 * (1 - s**3 * (10 - 15 * s + 6 * s * s))
    found = 0
    for seed in range(20):
        at = np.random.default_rng(seed).normal((0.0, RESTS_M, 0.0), 3e-4, (len(s), 3))
        at[:, 1] += height_m
        found += len(landings_of(map(tuple, at.tolist()), period_s=1 / frames_hz))
    assert found <= 4


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


@pytest.mark.parametrize(("kind", "n_paths"), [(rests, 1), (jitters, 150), (slides, 150)])
def test_resting_sliding_or_jittering_object_does_not_land(
    kind: Callable[[np.random.Generator], Path], n_paths: int
) -> None:
    rng = np.random.default_rng(7)
    assert [landings_of(kind(rng)) for _ in range(n_paths)] == [[]] * n_paths


def test_objects_carried_together_do_not_land() -> None:
    state = room()
    state.graph.update({"cup": Pose((-0.4, 0.79, 0.2))})
    frames = []
    for step in range(40):
        y = max(0.0, 0.5 - 0.03 * step) + 0.3
        frames.append((step * PERIOD_S, {"cup": Pose((-0.4, 0.79 + y, 0.2)), "book": Pose((-0.4, 0.715 + y, 0.2))}))
    assert landings_in(state, frames) == []


def test_dropped_stack_lands_with_its_lowest_object() -> None:
    frames = []
    for step in range(40):
        y = max(0.0, 0.5 - 0.03 * step)
        frames.append((step * PERIOD_S, {"cup": Pose((-0.4, 0.79 + y, 0.2)), "book": Pose((-0.4, 0.715 + y, 0.2))}))
    found = landings_in(room(), frames)
    assert [(one.object_id, one.onto) for one in found] == [("book", "table")]


def test_object_removed_while_falling_does_not_land() -> None:
    state = room()
    landings = Landings(state, PERIOD_S)
    for step in range(3):
        poses = {"cup": Pose((0.0, 1.2 - 0.03 * step, 0.0))}
        landings.begin(poses, step * PERIOD_S)
        state.graph.update(poses)
        landings.look(poses, step * PERIOD_S)
    state.graph.update({}, removed=["cup"])
    landings.begin({}, 3 * PERIOD_S)
    assert landings.look({}, 3 * PERIOD_S) == []


def test_object_removed_between_two_updates_of_a_step_is_landed_on_no_more() -> None:
    """The cup falls onto a book that slides in the air, and that is removed as the cup flies up again."""
    state = room()
    landings, found = Landings(state, PERIOD_S), list[Landing]()
    for step, height_m in enumerate([0.12, 0.09, 0.06, 0.03, 0.0, 0.0, 0.03, 0.06, 0.09]):
        poses = {"cup": Pose((-0.4, 1.075 + height_m, 0.2)), "book": Pose((-0.4 + 0.001 * step, 1.0, 0.2))}
        moved = {object_id: pose for object_id, pose in poses.items() if object_id in state.objects}
        time_s = (step - (step > 4)) * PERIOD_S  # updates 4 and 5 are of one step
        landings.begin(moved, time_s)
        state.graph.update(moved)
        found += landings.look(moved, time_s)
        if step == 5:
            assert state.graph.beside["cup"].keys() == {"book"}
            state.remove("book")
    assert found == []


@pytest.mark.parametrize("height_m", [0.05, 0.1, 0.2, 0.8])
@pytest.mark.parametrize(("physics_hz", "frames_hz"), [(50, 60), (50, 72), (60, 90), (30, 90), (20, 60), (60, 144)])
def test_physics_slower_than_the_frames_gives_one_landing(height_m: float, physics_hz: int, frames_hz: int) -> None:
    steps = [*fall(height_m, 1 / physics_hz)]
    for begins in (0.1, 0.4, 0.8):
        at = [int(i * physics_hz / frames_hz + begins) for i in range(len(steps) * frames_hz // physics_hz)]
        found = landings_of((steps[i] for i in at if i < len(steps)), period_s=1 / frames_hz)
        assert [one.onto for one in found] == ["table"]


def lowered_m(time_s: float) -> float:
    """Height over the table of what a hand puts down in 0.6 s: least jerk (Flash and Hogan 1985)."""
    s = min(1.0, time_s / 0.6)
    return 0.25 * (1 - s**3 * (10 - 15 * s + 6 * s * s))


@pytest.mark.parametrize("frames_hz", [60, 72, 90, 120])
def test_object_put_down_gently_by_slower_physics_does_not_land(frames_hz: int) -> None:
    times = [math.floor(i / frames_hz * 50) / 50 for i in range(frames_hz)]
    assert landings_of(((0.0, RESTS_M + lowered_m(t), 0.0) for t in times), period_s=1 / frames_hz) == []


def test_object_put_down_gently_does_not_land_after_a_long_frame() -> None:
    rng = np.random.default_rng(3)
    for _ in range(20):
        lasts_s = np.where(rng.random(120) < 0.15, rng.uniform(3.0, 6.0, 120), 1.0) * PERIOD_S
        times = np.cumsum(lasts_s)
        frames = [(t, {"cup": Pose((0.0, RESTS_M + lowered_m(t), 0.0))}) for t in times[times < 1.0].tolist()]
        assert landings_in(room(), frames) == []


@pytest.mark.parametrize("frames_hz", [60, 90, 120])
def test_object_that_a_hand_moves_up_and_down_over_a_table_does_not_land(frames_hz: int) -> None:
    times = np.arange(0.0, 3.0, 1 / frames_hz).tolist()
    shaken = ((0.0, RESTS_M + 0.024 + 0.02 * math.sin(2 * math.pi * 3 * t), 0.0) for t in times)
    assert landings_of(shaken, period_s=1 / frames_hz) == []


@pytest.mark.parametrize("begins", [0.0, 0.2, 0.4, 0.6, 0.8])
def test_fast_bounce_lands(begins: float) -> None:
    # At 60 Hz, it is 73 mm above the table before it bounces, or 51 mm after it.
    fast, meets_s = 4.4, 0.3
    times = [(i + begins) / 60 - meets_s for i in range(30)]
    path = [(0.0, RESTS_M + (-fast * t if t < 0 else 0.7 * fast * t), 0.0) for t in times]
    assert [one.onto for one in landings_of(iter(path), period_s=1 / 60)] == ["table"]


def test_two_objects_that_meet_land_once() -> None:
    frames = []
    for step in range(40):
        x = max(0.05, 0.25 - 0.01 * step)
        frames.append(
            (step * PERIOD_S, {"cup": Pose((0.1 - x, RESTS_M, 0.3)), "mug": Pose((0.1 + x - 0.01, RESTS_M, 0.3))})
        )
    state = room(box("mug", (0.1, 0.12, 0.08), (0.4, RESTS_M, 0.3)))
    (landing,) = landings_in(state, frames)
    assert {landing.object_id, landing.onto} == {"cup", "mug"}


def about_z(angle_rad: float) -> tuple[float, float, float, float]:
    return 0.0, 0.0, math.sin(angle_rad / 2), math.cos(angle_rad / 2)


def test_lid_whose_origin_is_its_hinge_lands() -> None:
    lid = boxes("lid", ((0.4, 0.02, 0.3), (0.2, 0.0, 0.0)), at_m=(-0.2, 0.71, 0.0))
    angles = [max(0.0, 1.2 - 15 * (step * PERIOD_S) ** 2 / 2) for step in range(60)]
    frames = [(step * PERIOD_S, {"lid": Pose((-0.2, 0.71, 0.0), about_z(angle))}) for step, angle in enumerate(angles)]
    found = landings_in(room(lid, without="cup"), frames)
    assert [(one.object_id, one.onto) for one in found] == [("lid", "table")]


def slammed_door(stop_s: float = 0.5) -> tuple[SceneState, list[tuple[float, dict[str, Pose]]]]:
    """A room door of 0.9 m that turns by 90 degrees about its hinge, against a strip at its other edge."""
    door = box("door", (0.04, 2.0, 0.9), (0.0, 1.005, 0.45))
    strip = box("strip", (0.02, 1.95, 0.04), (0.03, 1.0, 0.86))
    ground = box("floor", (4.0, 0.1, 4.0), (0, -0.05, 0))
    frames = []
    for step in range(round(stop_s / PERIOD_S) + 1):
        pivot = Pose.from_yaw((0.0, 0.0, 0.0), -math.pi / 2 * max(0.0, 1 - step * PERIOD_S / stop_s))
        frames.append((step * PERIOD_S, {"door": pivot.compose(Pose((0.0, 1.005, 0.45)))}))
    return state_of(ground, door, strip), frames


def test_door_that_slams_against_a_strip_at_its_edge_lands_on_it() -> None:
    """The strip is beside the door's edge, so that the way from the door's middle to it runs along the door."""
    found = landings_in(*slammed_door())
    assert [(one.object_id, one.onto) for one in found] == [("door", "strip")]
    assert found[0].speed_m_s == pytest.approx(0.86 * math.pi / 2 / 0.5, rel=0.1)


def test_door_that_is_closed_gently_does_not_land() -> None:
    assert not landings_in(*slammed_door(20.0))


def can(radius_m: float, height_m: float) -> TriMesh:
    """A cylinder along z."""
    around = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    ring = np.stack([radius_m * np.cos(around), radius_m * np.sin(around), np.full(24, height_m / 2)], axis=1)
    i, j = np.arange(24), (np.arange(24) + 1) % 24
    sides = np.concatenate([np.stack([i, j, 24 + j], 1), np.stack([i, 24 + j, 24 + i], 1)])
    ends = [
        np.stack([np.full(22, k), k + i[1:23], k + i[2:24]], 1)[:, order]
        for k, order in ((0, [0, 2, 1]), (24, [0, 1, 2]))
    ]
    return TriMesh(np.concatenate([ring * (1, 1, -1), ring]), np.concatenate([sides, *ends]))


@pytest.mark.parametrize(("thickness_m", "engine"), [(0.002, True), (0.004, False)])
def test_coin_that_sinks_into_the_table_lands_once(thickness_m: float, engine: bool) -> None:
    """Without contacts of an engine, a coin as a whole below the table is like one that was lifted from beneath."""
    # MuJoCo with default settings lets it sink by 9 mm after a fall from 10 cm, and lifts it again.
    heights_mm = (51.6, 40.2, 27.6, 13.7, -1.4, -9.0, -9.4, -7.8, -5.8, -4.1, -2.9, -2.0, -1.3, -0.9, -0.6, -0.4, -0.2)
    flat = (math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5))
    frames = []
    for i, height_m in enumerate(height_mm / 1e3 for height_mm in heights_mm):
        poses = {"coin": Pose((0.3, 0.7 + thickness_m / 2 + height_m, 0.0), flat)}
        meets = [Contact("coin", "table", (0.3, 0.7 + height_m / 2, 0.0), (0.0, -1.0, 0.0))] if height_m < 0 else []
        frames.append((i * PERIOD_S, poses, meets if engine else None))
    found = landings_in(room(thing("coin", can(0.012, thickness_m), frames[0][1]["coin"])), frames)
    assert [(one.object_id, one.onto) for one in found] == [("coin", "table")]


@pytest.mark.parametrize("spin_rad_s", [0.0, 15.0, 50.0])
def test_spin_of_a_round_object_does_not_add_to_its_speed(spin_rad_s: float) -> None:
    roll = thing("roll", can(0.06, 0.2), Pose((0.0, 0.91, 0.0)))
    heights_m = [y for _, y, _ in fall(0.15, PERIOD_S, 0.76)]
    poses = [Pose((0.0, y, 0.0), about_z(spin_rad_s * i * PERIOD_S)) for i, y in enumerate(heights_m)]
    (found,) = landings_in(room(roll, without="cup"), [(i * PERIOD_S, {"roll": one}) for i, one in enumerate(poses)])
    assert found.speed_m_s == pytest.approx(math.sqrt(2 * 9.81 * 0.15), rel=0.25)


@pytest.mark.parametrize("period_s", [1 / 90, 1 / 30])
@pytest.mark.parametrize("spin_rad_s", [-15.0, 0.0, 15.0])
def test_spin_of_a_round_object_that_is_thrown_does_not_add_to_its_speed(spin_rad_s: float, period_s: float) -> None:
    roll = thing("roll", can(0.06, 0.2), Pose((-1.5, 0.36, 1.5)))
    fell_at = math.sqrt(2 * 9.81 * 0.3)
    frames = []
    for step in range(round(0.5 / period_s)):
        flown_s = min(step * period_s, fell_at / 9.81)
        at_m = (-1.5 + 1.2 * flown_s, 0.36 - 9.81 * flown_s**2 / 2, 1.5)
        frames.append((step * period_s, {"roll": Pose(at_m, about_z(spin_rad_s * flown_s))}))
    (found,) = landings_in(room(roll, without="cup"), frames)
    assert found.speed_m_s == pytest.approx(fell_at, rel=0.25)


def test_block_that_slides_on_a_tray_lands_on_its_rim() -> None:
    state = state_of(box("block", (0.06, 0.06, 0.06), (0.0, 0.03, 0.0)), box("tray", (0.8, 0.02, 0.6), (0, -0.01, 0)))
    frames = []
    for frame in range(45):
        x = min(0.01 * frame, 0.35)
        contacts = [Contact("block", "tray", (x + dx, 0.0, 0.0), (0.0, -1.0, 0.0)) for dx in (-0.03, 0.03)]
        if x == 0.35:
            contacts.append(Contact("block", "tray", (0.38, 0.03, 0.0), (1.0, 0.0, 0.0)))
        frames.append((frame * PERIOD_S, {"block": Pose((x, 0.03, 0.0))}, contacts))
    found = landings_in(state, frames)
    assert [(one.object_id, one.onto, one.point_m) for one in found] == [("block", "tray", (0.38, 0.03, 0.0))]
    assert found[0].speed_m_s == pytest.approx(0.9)


@pytest.mark.parametrize("speed_m_s", [0.2, 0.8, 2.0])
def test_rolling_object_that_stops_does_not_land(speed_m_s: float) -> None:
    steps = range(int(0.6 / speed_m_s / PERIOD_S))
    frames = []
    for step in steps:
        rolled_m = speed_m_s * step * PERIOD_S
        pose = Pose((-0.3 + rolled_m, 0.75, -0.25), about_z(-rolled_m / 0.05))
        frames.append((step * PERIOD_S, {"can": pose}))
    assert landings_in(room(thing("can", can(0.05, 0.12), Pose((-0.3, 0.75, -0.25)))), frames) == []


def test_object_lands_among_many_that_rest_and_are_given_in_every_frame() -> None:
    standing = [
        box(f"brick {i:03}", (0.1, 0.06, 0.06), (-1.9 + 0.12 * (i % 30), 0.03, 1.0 + 0.1 * (i // 30)))
        for i in range(200)
    ]
    state = room(*standing)
    resting = {one.id: one.pose for one in standing}
    frames = [(i * PERIOD_S, {**resting, "cup": Pose(at)}) for i, at in enumerate(fall(0.4, PERIOD_S))]
    assert [(one.object_id, one.onto) for one in landings_in(state, frames)] == [("cup", "table")]


Motion = Callable[[float], Triple]


AT_FIRST = {object_id: room().poses[object_id].position_m for object_id in ("floor", "table", "wall", "cup", "book")}


def positions_aboard(vehicle: Motion, in_it: Motion, time_s: float) -> dict[str, Triple]:
    """Positions in a room that moves as a whole, while the cup moves in it along a path of its own."""
    x, y, z = vehicle(time_s)
    return {key: (x + u, y + v, z + w) for key, (u, v, w) in (AT_FIRST | {"cup": in_it(time_s)}).items()}


def aboard(vehicle: Motion, in_it: Motion, times: Iterable[float]) -> list[Landing]:
    """The landings in such a room."""
    frames = ((time_s, positions_aboard(vehicle, in_it, time_s)) for time_s in times)
    return landings_in(
        room(), [(time_s, {key: Pose(at) for key, at in positions.items()}) for time_s, positions in frames]
    )


def dropped(time_s: float) -> Triple:
    """At rest 0.3 m above the table, dropped after half a second."""
    return 0.0, RESTS_M + max(0.0, 0.3 - 9.81 * max(0.0, time_s - 0.5) ** 2 / 2), 0.0


def carried(time_s: float) -> Triple:
    return 0.0, RESTS_M + lowered_m(time_s - 0.5 if time_s > 0.5 else 0.0), 0.0


VEHICLES: dict[str, Motion] = {
    "train": lambda t: (0.0, 0.0, 30.0 * t),
    "train that brakes": lambda t: (0.0, 0.0, 30.0 * min(t, 0.9)),
    "lift up": lambda t: (0.0, 2.5 * t, 0.0),
    "lift down": lambda t: (0.0, -2.5 * t, 0.0),
    "boat": lambda t: (0.0, 0.3 * math.sin(3 * t), 8.0 * t),
    "bumpy road": lambda t: (0.0, 0.01 * math.sin(50 * t), 15.0 * t),
}


def unequal_times(seed: int) -> list[float]:
    times: list[float] = np.cumsum(np.random.default_rng(seed).uniform(0.7, 1.3, 170) * PERIOD_S).tolist()
    return times


@pytest.mark.parametrize("vehicle", VEHICLES)
def test_object_dropped_in_a_vehicle_lands_once(vehicle: str) -> None:
    for seed in range(3):
        found = aboard(VEHICLES[vehicle], dropped, unequal_times(seed))
        assert [{one.object_id, one.onto} for one in found] == [{"cup", "table"}]
        assert found[0].speed_m_s == pytest.approx(math.sqrt(2 * 9.81 * 0.3), rel=0.3)


@pytest.mark.parametrize("vehicle", ["train", "lift up", "boat"])
def test_object_dropped_in_a_vehicle_lands_once_though_all_trembles(vehicle: str) -> None:
    """By 0.1 mm and 0.1 mrad, as a physics engine lets objects at rest tremble."""
    for seed in range(8):
        shake = np.random.default_rng(seed)
        frames = []
        for time_s in (np.arange(42, 80) * PERIOD_S).tolist():  # the cup falls from frame 45 to 67
            poses = {}
            for object_id, (x, y, z) in positions_aboard(VEHICLES[vehicle], dropped, time_s).items():
                a, b, c, d, e, f = (1e-4 * shake.uniform(-1, 1, 6)).tolist()
                poses[object_id] = Pose((x + a, y + b, z + c), (d / 2, e / 2, f / 2, 1.0))
            frames.append((time_s, poses))
        assert [(one.object_id, one.onto) for one in landings_in(room(), frames)] == [("cup", "table")]


@pytest.mark.parametrize("vehicle", VEHICLES)
@pytest.mark.parametrize("in_it", [carried, lambda t: (0.0, RESTS_M, 0.0)])
def test_object_put_down_or_at_rest_in_a_vehicle_does_not_land(vehicle: str, in_it: Motion) -> None:
    assert [aboard(VEHICLES[vehicle], in_it, unequal_times(seed)) for seed in range(3)] == [[]] * 3


@pytest.mark.parametrize("rises_m_s", [-2.5, 0.0, 2.5])
def test_object_that_tumbles_in_a_lift_lands(rises_m_s: float) -> None:
    times = [i * PERIOD_S for i in range(90)]
    frames = []
    state = room()
    for t in times:
        rest = {one: state.poses[one].position_m for one in ("floor", "table", "wall", "book")}
        turns = about_z(3.0 * min(t, 0.5 + math.sqrt(2 * 0.3 / 9.81)))
        poses = {one: Pose((x, y + rises_m_s * t, z)) for one, (x, y, z) in rest.items()}
        x, y, z = dropped(t)
        frames.append((t, {**poses, "cup": Pose((x, y + rises_m_s * t + 0.005, z), turns)}))
    first, *_ = landings_in(state, frames)
    assert {first.object_id, first.onto} == {"cup", "table"}
