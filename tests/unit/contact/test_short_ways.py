"""The short ways of a frame end where building from nothing does, and are taken where they should be."""

import math
from dataclasses import replace
from typing import Any

import pytest

from contact_scenes import box, boxes, floor, on_floor, scene
from scene2hap.contact import finder
from scene2hap.contact.body import Body
from scene2hap.contact.broad_phase import BroadPhase
from scene2hap.contact.glide import Glide
from scene2hap.contact.graph import ContactGraph
from scene2hap.contact.short_ways import ShortWays
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import SceneObject

TABLE = on_floor("table", (1.0, 0.7, 1.0), 0, 0)
CUP = box("cup", (0.08, 0.1, 0.08), (0.2, 0.75, 0.1))
JAR = box("jar", (0.1, 0.2, 0.1), (0.0, 0.8, 0.0))
IN_THE_AIR = {"cup": Pose((0.2, 1.2, 0.1))}


def yaw(angle: float) -> tuple[float, float, float, float]:
    return (0.0, math.sin(angle / 2), 0.0, math.cos(angle / 2))


def is_as_built(graph: ContactGraph, *objects: SceneObject) -> bool:
    return graph.contacts == ContactGraph(scene(*objects).with_poses(graph.poses)).contacts


@pytest.mark.parametrize(
    ("others", "moved", "lands_shortly"),
    [
        pytest.param([], {"cup": Pose((0.1, 0.75, -0.1))}, True, id="on the table"),
        pytest.param([], {"cup": Pose((0.1, 0.7505, -0.1), yaw(0.4))}, True, id="half a millimetre above it, turned"),
        pytest.param([], {"cup": Pose((0.1, 0.79, -0.1))}, False, id="too high"),
        pytest.param([], {"cup": Pose((0.5, 0.75, 0.0))}, False, id="over the rim"),
        pytest.param([JAR], {"cup": Pose((0.0, 0.95, 0.0))}, True, id="on the jar"),
        pytest.param([JAR], {"cup": Pose((0.2, 0.75, 0.0))}, True, id="beside the jar"),
        pytest.param([JAR], {"cup": Pose((0.08, 0.95, 0.0))}, False, id="over the jar's rim"),
        pytest.param([], {"cup": Pose((1.1, 0.75, 0.0)), "table": Pose((1.0, 0.35, 0.0))}, True, id="the table comes"),
        pytest.param([], {"cup": Pose((0.0, 0.75, 0.0)), "table": Pose((2.0, 0.35, 0.0))}, False, id="the table goes"),
    ],
)
def test_landing(
    others: list[SceneObject], moved: dict[str, Pose], lands_shortly: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    landed, land = list[bool](), ShortWays._land

    def watched(*given: Any) -> bool:
        landed.append(land(*given))
        return landed[-1]

    monkeypatch.setattr(ShortWays, "_land", watched)
    objects = [floor(), TABLE, CUP, *others]
    graph = ContactGraph(scene(*objects))
    graph.update(IN_THE_AIR)
    landed.clear()
    graph.update(moved)
    assert any(landed) == lands_shortly
    assert is_as_built(graph, *objects)
    # And what was found there holds as it goes on.
    x, y, z = moved["cup"].position_m
    for step in range(1, 4):
        graph.update({"cup": Pose((x + 0.004 * step, y, z), moved["cup"].rotation_xyzw)})
        assert is_as_built(graph, *objects)
    graph.update(IN_THE_AIR)
    assert is_as_built(graph, *objects)


@pytest.mark.parametrize(
    ("gap_m", "floats"), [pytest.param(0.2, True, id="far from the wall"), pytest.param(0.006, False, id="on the wall")]
)
def test_what_is_lifted_floats_unless_it_may_hang(gap_m: float, floats: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    floated, float_ = list[bool](), ShortWays._float

    def watched(*given: Any) -> bool:
        floated.append(float_(*given))
        return floated[-1]

    wall = box("wall", (2.0, 3.0, 0.1), (0.0, 1.5, -0.55))
    objects = [floor(), TABLE, CUP, wall]
    graph = ContactGraph(scene(*objects))
    monkeypatch.setattr(ShortWays, "_float", watched)
    change = graph.update({"cup": Pose((0.2, 1.2, -0.46 + gap_m))})
    assert floated == [floats]
    assert change.vanished == {("cup", "table")}
    assert ("wall" in graph.neighbours("cup")) != floats
    assert is_as_built(graph, *objects)


def test_what_is_lifted_and_put_down_again_keeps_its_neighbours(monkeypatch: pytest.MonkeyPatch) -> None:
    """A hand's breadth over the table and higher, over and over: nobody is looked for anew, and no way is long."""
    drawn, long_ways = list[dict[str, set[str]]](), list[bool]()
    put, take = BroadPhase.update, ShortWays.take
    monkeypatch.setattr(BroadPhase, "update", lambda *given: drawn.append(put(*given)) or drawn[-1])
    monkeypatch.setattr(ShortWays, "take", lambda *given: long_ways.append(not take(*given)) or not long_ways[-1])
    objects = [floor(), TABLE, CUP, box("wide", (0.3, 0.1, 0.3), (-0.3, 0.75, 0.1))]
    graph = ContactGraph(scene(*objects))
    for lifted_m in (0.0, 0.28, 0.0, 0.12):
        graph.update({"cup": Pose((0.2, 0.75 + lifted_m, 0.11))})
    for step in range(40):
        lifted_m = (0.28, 0.12, 0.0)[step % 3]
        drawn.clear()
        long_ways.clear()
        graph.update({"cup": Pose((0.2, 0.75 + lifted_m, 0.1 + 0.0004 * step))})
        assert not any(drawn)
        assert not any(long_ways)
        assert graph.neighbours("cup") == (() if lifted_m else ("table",))
        assert is_as_built(graph, *objects)
        drawn.clear()


@pytest.mark.parametrize(("bears", "floats"), [(False, True), (True, False)], ids=["alone", "with a coin on it"])
def test_what_is_lifted_from_below_another_does_not_float(
    bears: bool, floats: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What it bore is to be asked what holds it now."""
    floated, float_ = list[bool](), ShortWays._float
    coin = box("coin", (0.02, 0.002, 0.02), (0.2, 0.801, 0.1))
    objects = [floor(), TABLE, CUP, *([coin] if bears else [])]
    graph = ContactGraph(scene(*objects))
    graph.update({"cup": Pose((0.2, 0.75, 0.101))})
    monkeypatch.setattr(ShortWays, "_float", lambda *given: floated.append(float_(*given)) or floated[-1])
    graph.update({"cup": Pose((0.2, 1.0, 0.1))})
    assert any(floated) == floats
    assert is_as_built(graph, *objects)


@pytest.mark.parametrize("apart_m", [0.3, 0.24])
def test_a_glide_goes_on_while_others_pass_by(apart_m: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """A crate is pushed to and fro; two cups pass by, one of them lifted and put down again."""
    table = on_floor("table", (2.0, 0.7, 1.0), 0, 0)
    objects = [floor(), table, box("crate", (0.1, 0.1, 0.1), (-0.4, 0.75, 0.0)), CUP, replace(CUP, id="other cup")]
    graph = ContactGraph(scene(*objects))
    not_gliding, at = list[str](), Body.at

    def watched(self: Body, pose: Pose) -> Body:
        not_gliding.append(self.id)
        return at(self, pose)

    monkeypatch.setattr(Body, "at", watched)
    for step in range(90):
        moved = {
            "crate": Pose((-0.4 + 0.04 * math.sin(0.3 * step), 0.75, 0.0)),
            "cup": Pose((-0.7 + 0.006 * step, 0.75 + (0.5 if step % 9 > 5 else 0.0), apart_m)),
            "other cup": Pose((-0.1 - 0.006 * step, 0.75, -apart_m)),
        }
        graph.update(moved)
        assert is_as_built(graph, *objects)
    # At first, and where it leaves what was drawn around it.
    assert not_gliding.count("crate") <= 3
    # Each time that it is lifted or put down, and as it goes on.
    assert not_gliding.count("cup") <= 35


def test_a_ledge_is_known_beside_sides_as_high_as_itself() -> None:
    """A goblet slides along a board of two halves, until its bowl, but not its foot, is over the slit between them."""
    board = boxes("board", *(((0.4, 0.02, 0.4), (x, 0.0, 0.0)) for x in (-0.21, 0.21)), at_m=(0.0, 0.01, 0.0))
    parts = (((0.08, 0.1, 0.08), (0.0, 0.05, 0.0)), ((0.2, 0.05, 0.2), (0.0, 0.125, 0.0)))
    goblet = boxes("goblet", *parts, at_m=(-0.3, 0.02, 0.0))
    graph = ContactGraph(scene(board, goblet))
    for step in range(60):
        graph.update({"goblet": Pose((-0.3 + 0.005 * step, 0.02, 0.0))})
        assert is_as_built(graph, board, goblet)


@pytest.mark.parametrize("angle", [0.0, 0.6])
def test_a_glide_goes_on_to_the_rim(angle: float, monkeypatch: pytest.MonkeyPatch) -> None:
    stepped, step = list[bool](), Glide.step

    def watched(*given: Any) -> bool:
        stepped.append(step(*given))
        return stepped[-1]

    monkeypatch.setattr(Glide, "step", watched)
    objects = [floor(), TABLE, box("sheet", (0.3, 0.004, 0.1), (0.0, 0.702, 0.0))]
    graph = ContactGraph(scene(*objects))
    reach_m = 0.15 * math.sin(angle) + 0.05 * math.cos(angle)
    ends = []
    for step_no in range(120):
        z = 0.005 * step_no
        graph.update({"sheet": Pose((0.0, 0.702, z), yaw(angle))})
        assert is_as_built(graph, *objects)
        if stepped and stepped.pop():
            ends.append(z)
        stepped.clear()
    # To the rim but for a step, where a circle around the sheet ends at 0.34.
    assert 0.5 - reach_m - 0.0051 <= max(ends) <= 0.5 - reach_m
    assert len(ends) > 0.8 * max(ends) / 0.005


@pytest.mark.parametrize("also_moves", [False, True], ids=["along one that stays", "along one that comes nearer"])
def test_a_block_that_slides_along_others_is_followed_in_its_glide(
    also_moves: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It comes, touches, goes on and leaves; the long way is gone where it begins and where it comes to another."""
    blocks = [box("near", (0.1, 0.1, 0.1), (0.0, 0.75, 0.0)), box("far", (0.1, 0.02, 0.1), (0.3, 0.71, 0.3))]
    objects = [floor(), TABLE, *blocks, box("crate", (0.1, 0.1, 0.1), (-0.3, 0.75, 0.102))]
    graph = ContactGraph(scene(*objects))
    long_ways, take_in = list[int](), finder.ContactFinder._take_in

    def watched(self: finder.ContactFinder, *given: Any) -> None:
        if self is graph._finder:
            long_ways.append(len(touching))
        take_in(self, *given)

    monkeypatch.setattr(finder.ContactFinder, "_take_in", watched)
    touching = list[bool]()
    for step in range(120):
        moved = {"crate": Pose((-0.3 + 0.005 * step, 0.75, 0.102))}
        if also_moves:
            moved["near"] = Pose((0.0, 0.75, 0.001 * math.sin(step / 3)))
        graph.update(moved)
        assert is_as_built(graph, *objects)
        touching.append("near" in graph.neighbours("crate"))
    # While less than 5 mm is between them, along the diagonal before and after.
    first, last = touching.index(True), 119 - touching[::-1].index(True)
    assert 39 <= first <= 40
    assert 80 <= last <= 81
    # But where it leaves what was drawn around it, some 6 cm, it is looked around anew.
    assert len([step for step in long_ways if first < step <= last + 1]) <= 8


def test_what_is_below_a_support_matters_once_that_is_gone(monkeypatch: pytest.MonkeyPatch) -> None:
    """A jar slides over a worktop that is 20 mm thick, from above one cupboard to above another; then it has none."""
    objects = [
        floor(),
        box("cupboard", (0.5, 0.7, 0.6), (-0.25, 0.35, 0.0)),
        box("drawers", (0.5, 0.7, 0.6), (0.26, 0.35, 0.0)),
        box("worktop", (1.1, 0.02, 0.7), (0.0, 0.71, 0.0)),
        box("jar", (0.3, 0.3, 0.3), (-0.3, 0.87, 0.0)),
    ]
    graph = ContactGraph(scene(*objects))
    long_ways, take = list[bool](), ShortWays.take

    def watched(self: ShortWays, *given: Any) -> bool:
        taken = take(self, *given)
        if self is graph._finder._short_ways:
            long_ways.append(not taken)
        return taken

    monkeypatch.setattr(ShortWays, "take", watched)
    for step in range(1, 121):
        graph.update({"jar": Pose((-0.3 + 0.005 * step, 0.87, 0.0))})
        assert is_as_built(graph, *objects)
        assert graph.neighbours("jar") == ("worktop",)
    assert not any(long_ways)
    graph.update({"worktop": Pose((0.0, 0.71, 3.0))})
    assert is_as_built(graph, *objects)
    assert graph.neighbours("jar") == ("drawers",)


def test_what_is_below_a_support_is_asked_where_things_are_then() -> None:
    """A jar slides over a cupboard that nothing holds, is asked about when a lamp beside it goes, and slides on, out
    over the cupboard's side; then it has no worktop any more."""
    lamp = box("lamp", (0.1, 0.1, 0.1), (-0.4, 0.77, 0.24))
    objects = [
        box("cupboard", (0.5, 0.7, 0.6), (-0.25, 0.35, 0.0)),
        box("worktop", (1.1, 0.02, 0.7), (0.0, 0.71, 0.0)),
        box("jar", (0.3, 0.3, 0.3), (-0.175, 0.87, 0.0)),
    ]
    graph = ContactGraph(scene(*objects, lamp))
    for step in range(1, 13):
        graph.update({"jar": Pose((-0.175 + 0.004 * step, 0.87, 0.0))}, removed=["lamp"] if step == 4 else ())
        assert is_as_built(graph, *objects, *([lamp] if step < 4 else []))
    graph.update({}, removed=["worktop"])
    assert is_as_built(graph, *[item for item in objects if item.id != "worktop"])
    assert graph.neighbours("jar") == ("cupboard",)


@pytest.mark.parametrize("goes_away", [False, True], ids=["at once", "once it is far away"])
def test_a_block_beside_a_glide_may_be_removed(goes_away: bool) -> None:
    """While a crate slides near it, touching it or not."""
    for gap_m in (0.002, 0.02):
        near, crate = box("near", (0.1, 0.1, 0.1), (0.0, 0.75, 0.0)), box("crate", (0.1, 0.1, 0.1), (0.0, 0.75, 0.102))
        objects = [floor(), TABLE, near, crate]
        graph = ContactGraph(scene(*objects))
        # It comes to touch, so that its glide reckons with the block, and goes off a little again.
        for step in range(6):
            graph.update({"crate": Pose((0.003 * step, 0.75, 0.102))})
        graph.update({"crate": Pose((0.0, 0.75, 0.1 + gap_m))})
        if goes_away:
            graph.update({"near": Pose((3.0, 0.05, 3.0))})
        graph.update({}, removed=["near"])
        for step in range(4):
            graph.update({"crate": Pose((0.002 * step, 0.75, 0.1 + gap_m))})
            assert is_as_built(graph, floor(), TABLE, crate)
        graph.update({}, added=[near])
        assert is_as_built(graph, *objects)
