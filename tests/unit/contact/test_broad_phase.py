"""Neighbour lists: no relevant neighbour is ever missing, for any motion."""

import numpy as np

from contact_scenes import box
from scene2hap.contact.body import Body
from scene2hap.contact.broad_phase import SKIN_M, BroadPhase
from scene2hap.scene.pose import Pose


def meet(x: Body, y: Body, margin: float) -> bool:
    apart = [max(x.low[k] - y.high[k], y.low[k] - x.high[k]) for k in range(3)]
    return max(apart) <= margin


def test_neighbour_lists_are_complete_and_symmetric() -> None:
    rng = np.random.default_rng(4)
    margin = 0.05
    bodies = {f"b{i}": Body.of(box(f"b{i}", (0.2, 0.1, 0.2), tuple(rng.uniform(0, 2, 3))), 1) for i in range(80)}
    phase = BroadPhase(1, lambda _: (margin, 0.0))
    phase.update(list(bodies.values()))
    for step in range(60):
        movers = rng.choice(sorted(bodies), 4, replace=False).tolist()
        if step % 10 == 9:
            gone = movers.pop()
            neighbours = set(phase.neighbours[gone])
            assert phase.remove(gone) == neighbours
            del bodies[gone]
        moved = []
        for name in movers:
            at = np.array(bodies[name].position_m) + rng.normal(scale=SKIN_M / 2, size=3)
            bodies[name] = bodies[name].at(Pose(tuple(at.tolist())))
            moved.append(bodies[name])
        before = {name: set(phase.neighbours[name]) for name in movers}
        left = phase.update(moved)
        # A separated pair is reported once, by one of its two bodies.
        reported = {frozenset((x, y)) for x, others in left.items() for y in others}
        assert reported == {frozenset((x, y)) for x in movers for y in before[x] - phase.neighbours[x]}
        assert len(reported) == sum(map(len, left.values()))
        for x in bodies:
            must = {y for y in bodies if y != x and meet(bodies[x], bodies[y], 2 * margin)}
            assert must <= phase.neighbours[x]
            assert all(x in phase.neighbours[y] for y in phase.neighbours[x])
            may = {y for y in bodies if y != x and meet(bodies[x], bodies[y], 2 * margin + 2 * (SKIN_M + 0.36) + 1e-9)}
            assert phase.neighbours[x] <= may


def test_a_body_within_its_inner_box_is_not_searched_again() -> None:
    phase = BroadPhase(1, lambda _: (0.01, 0.02))
    body = Body.of(box("b", (0.1, 0.1, 0.1), (0, 0, 0)), 1)
    assert phase.update([body]) == {"b": set()}
    assert phase.update([body.at(Pose((0.001, 0, 0)))]) == {"b": set()}  # only the first fat box is tight
    assert phase.update([body.at(Pose((0.9 * SKIN_M, 0, 0)))]) == {}
    assert "b" in phase.update([body.at(Pose((1.1 * SKIN_M + 0.001, 0, 0)))])
    # Going back needs no new list, nor does repeated lifting and putting down.
    assert phase.update([body.at(Pose((0.2 * SKIN_M, 0, 0)))]) == {}
    assert "b" in phase.update([body.at(Pose((0.2 * SKIN_M, 0.25, 0)))])
    assert phase.update([body.at(Pose((0.2 * SKIN_M, 0, 0)))]) == {}
    assert phase.update([body.at(Pose((0.2 * SKIN_M, 0.25, 0)))]) == {}
    assert "b" in phase.update([body.at(Pose((0.2 * SKIN_M, 0.5, 0)))])
    assert "b" in phase.update([body.at(Pose((0.2 * SKIN_M, 0, 0)))])
