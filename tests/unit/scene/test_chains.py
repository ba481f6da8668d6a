"""Chains: objects that hinges join, directly or by others."""

from collections.abc import Iterator, Mapping
from dataclasses import replace

from scene2hap import ContactGraph, Hinge, SceneSnapshot
from scene2hap.llm.chain.sharing import copies
from scene2hap.scene.hinges import KinematicChain, kinematic_chains, series
from scripted_backend import box


def test_a_chain_has_all_objects_that_hinges_join_and_its_longest_series() -> None:
    on: Mapping[str, str] = {"hand": "arm", "arm": "base", "head": "base", "door": "cabinet"}
    ids = ("hand", "mug", "base", "cabinet", "arm", "head", "door")
    items = [
        replace(box(x, (0.1, 0.1, 0.1), (0.0, 0.0, 0.0)), hinge=Hinge(on[x], (0, 0, 0), (0, 0, 0)) if x in on else None)
        for x in ids
    ]
    robot, cabinet = KinematicChain(("hand", "base", "arm", "head"), 3), KinematicChain(("cabinet", "door"), 2)
    assert kinematic_chains(items) == {**dict.fromkeys(robot.ids, robot), **dict.fromkeys(cabinet.ids, cabinet)}


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


def test_the_kinds_of_a_chain_are_read_once_for_all_of_its_objects() -> None:
    class Ids(tuple[str, ...]):
        n_read = 0

        def __iter__(self) -> Iterator[str]:
            self.n_read += 1
            return super().__iter__()

    rope = SceneSnapshot.build([box(f"link {k}", (0.1, 0.1, 0.1), (0.2 * k, 0.0, 0.0)) for k in range(9)])
    ids = Ids(item.id for item in rope.objects)
    shared = copies(rope, ContactGraph(rope), dict.fromkeys(ids, KinematicChain(ids, 9)))
    assert set(shared.values()) == {"link 0"}
    assert ids.n_read <= 3
