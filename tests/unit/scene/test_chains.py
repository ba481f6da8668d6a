"""Chains: objects that hinges join, directly or by others."""

from collections.abc import Mapping
from dataclasses import replace

from scene2hap import Hinge
from scene2hap.scene.hinges import Chain, chains, series
from scripted_backend import box


def test_a_chain_has_all_objects_that_hinges_join_and_its_longest_series() -> None:
    on: Mapping[str, str] = {"hand": "arm", "arm": "base", "head": "base", "door": "cabinet"}
    ids = ("hand", "mug", "base", "cabinet", "arm", "head", "door")
    items = [
        replace(box(x, (0.1, 0.1, 0.1), (0.0, 0.0, 0.0)), hinge=Hinge(on[x], (0, 0, 0), (0, 0, 0)) if x in on else None)
        for x in ids
    ]
    robot, cabinet = Chain(("hand", "base", "arm", "head"), 3), Chain(("cabinet", "door"), 2)
    assert chains(items) == {**dict.fromkeys(robot.ids, robot), **dict.fromkeys(cabinet.ids, cabinet)}


def test_objects_that_hang_on_each_other_have_the_least_id_of_their_ring() -> None:
    assert series({"d": "c", "c": "a", "a": "b", "b": "c", "e": "f"}) == {
        **dict.fromkeys("abc", ("a", 2)),
        "d": ("a", 3),
        "e": ("f", 1),
    }


def test_long_ropes_take_time_in_proportion_to_their_length() -> None:
    n = 20_000
    rope = {str(i): str(i - 1) for i in range(n, 0, -1)}
    assert series(rope) == {str(i): ("0", i) for i in range(1, n + 1)}
