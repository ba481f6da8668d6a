"""Certificates give the same contacts as a new graph, and skip the narrow phase where they should."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from contact_scenes import box, boxes, floor, on_floor, quads, scene, thing
from scene2hap.contact import certificate_issuer, finder
from scene2hap.contact.body import Body
from scene2hap.contact.certificate import Extent, separated
from scene2hap.contact.graph import ContactGraph
from scene2hap.contact.rule import TOUCH_M
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose
from scene2hap.scene.shapes import TriMesh

TABLE = on_floor("table", (1.0, 0.7, 1.0), 0, 0)
CUP = box("cup", (0.08, 0.1, 0.08), (0.2, 0.75, 0.1))
JAR = box("jar", (0.1, 0.2, 0.1), (0.0, 0.8, 0.0))
IN_THE_AIR = {"cup": Pose((0.2, 1.2, 0.1))}


def yaw(angle: float) -> tuple[float, float, float, float]:
    return (0.0, math.sin(angle / 2), 0.0, math.cos(angle / 2))


def is_as_built(graph: ContactGraph, *objects: SceneObject) -> bool:
    return graph.contacts == ContactGraph(scene(*objects).with_poses(graph.poses)).contacts


Looked = Callable[[ContactGraph], list[str]]


@pytest.fixture
def looked_at(monkeypatch: pytest.MonkeyPatch) -> Looked:
    """Return the ids of the bodies of a graph that entered the narrow phase since the last call, in order."""
    names: dict[int, list[str]] = {}
    look = finder.ContactFinder._pair_with_neighbours

    def watched(self: finder.ContactFinder, body: Body, *given: Any) -> None:
        names.setdefault(id(self), []).append(body.id)
        look(self, body, *given)

    monkeypatch.setattr(finder.ContactFinder, "_pair_with_neighbours", watched)
    return lambda graph: names.pop(id(graph._finder), [])


@pytest.mark.parametrize(
    ("others", "moved", "is_certified"),
    [
        pytest.param([], {"cup": Pose((0.1, 0.75, -0.1))}, True, id="on the table"),
        pytest.param([], {"cup": Pose((0.1, 0.7505, -0.1), yaw(0.4))}, True, id="half a millimetre above it, turned"),
        pytest.param([], {"cup": Pose((0.1, 0.78, -0.1))}, False, id="too high to weigh in full"),
        pytest.param([], {"cup": Pose((0.5, 0.75, 0.0))}, False, id="over the rim"),
        pytest.param([JAR], {"cup": Pose((0.0, 0.95, 0.0))}, True, id="on the jar"),
        pytest.param([JAR], {"cup": Pose((0.2, 0.75, 0.0))}, True, id="near the jar"),
        pytest.param([JAR], {"cup": Pose((0.093, 0.75, 0.0))}, False, id="touching the jar"),
        pytest.param([JAR], {"cup": Pose((0.08, 0.95, 0.0))}, False, id="over the jar's rim"),
        pytest.param([], {"cup": Pose((0.0, 0.75, 0.0)), "table": Pose((2.0, 0.35, 0.0))}, True, id="the table goes"),
    ],
)
def test_landing_body_gets_a_certificate_if_nothing_else_is_near(
    others: list[SceneObject], moved: dict[str, Pose], is_certified: bool, looked_at: Looked
) -> None:
    objects = [floor(), TABLE, CUP, *others]
    graph = ContactGraph(scene(*objects))
    graph.update(IN_THE_AIR)
    looked_at(graph)
    graph.update(moved)
    assert ("cup" not in looked_at(graph)) == is_certified
    assert is_as_built(graph, *objects)
    # The result stays valid while the cup moves on.
    x, y, z = moved["cup"].position_m
    for step in range(1, 4):
        graph.update({"cup": Pose((x + 0.004 * step, y, z), moved["cup"].rotation_xyzw)})
        assert is_as_built(graph, *objects)
    graph.update(IN_THE_AIR)
    assert is_as_built(graph, *objects)


@pytest.mark.parametrize(
    ("gap_m", "is_certified"),
    [pytest.param(0.2, True, id="far from the wall"), pytest.param(0.006, False, id="on the wall")],
)
def test_a_lifted_body_needs_no_narrow_phase_unless_it_may_hang(
    gap_m: float, is_certified: bool, looked_at: Looked
) -> None:
    wall = box("wall", (2.0, 3.0, 0.1), (0.0, 1.5, -0.55))
    objects = [floor(), TABLE, CUP, wall]
    graph = ContactGraph(scene(*objects))
    looked_at(graph)
    change = graph.update({"cup": Pose((0.2, 1.2, -0.46 + gap_m))})
    assert ("cup" not in looked_at(graph)) == is_certified
    assert change.vanished == {("cup", "table")}
    assert ("wall" in graph.neighbours("cup")) != is_certified
    assert is_as_built(graph, *objects)


@pytest.mark.parametrize("apart_m", [0.3, 0.24, 0.12])
def test_a_step_needs_no_narrow_phase_while_others_pass_by(apart_m: float, looked_at: Looked) -> None:
    """A crate moves back and forth; two cups pass by, and one of them is repeatedly lifted and put down."""
    table = on_floor("table", (2.0, 0.7, 1.0), 0, 0)
    objects = [floor(), table, box("crate", (0.1, 0.1, 0.1), (-0.4, 0.75, 0.0)), CUP, replace(CUP, id="other cup")]
    graph = ContactGraph(scene(*objects))
    looked_at(graph)
    for step in range(90):
        moved = {
            "crate": Pose((-0.4 + 0.04 * math.sin(0.3 * step), 0.75, 0.0)),
            "cup": Pose((-0.7 + 0.006 * step, 0.75 + (0.5 if step % 9 > 5 else 0.0), apart_m)),
            "other cup": Pose((-0.1 - 0.006 * step, 0.75, -apart_m)),
        }
        graph.update(moved)
        assert is_as_built(graph, *objects)
    assert not looked_at(graph)


@pytest.mark.parametrize("angle", [0.0, 0.6])
def test_a_certificate_holds_to_the_rim(angle: float, looked_at: Looked) -> None:
    objects = [floor(), TABLE, box("sheet", (0.3, 0.004, 0.1), (0.0, 0.702, 0.0))]
    graph = ContactGraph(scene(*objects))
    reach_m = 0.15 * math.sin(angle) + 0.05 * math.cos(angle)
    certified = []
    for step_no in range(120):
        z = 0.005 * step_no
        looked_at(graph)
        graph.update({"sheet": Pose((0.0, 0.702, z), yaw(angle))})
        assert is_as_built(graph, *objects)
        if "sheet" not in looked_at(graph):
            certified.append(z)
    on_table = [z for z in certified if z < 0.5]
    # Certified to within one step of the rim; a circle around the sheet would end at 0.34.
    assert 0.5 - reach_m - 0.0051 <= max(on_table) <= 0.5 - reach_m
    assert len(on_table) > 0.95 * max(on_table) / 0.005


def test_approaching_bodies_share_the_free_distance(looked_at: Looked) -> None:
    """Two rotated crates approach until they touch: only the last steps need the narrow phase."""
    crate = box("crate", (0.1, 0.1, 0.1), (-0.2, 0.75, 0.0), yaw(0.3))
    objects = [floor(), TABLE, crate, replace(crate, id="other")]
    graph = ContactGraph(scene(*objects[:3]))
    graph.update({}, added=[replace(crate, id="other", pose=Pose((0.2, 0.75, 0.0), yaw(0.3)))])
    steps = {}
    for step in range(60):
        looked_at(graph)
        x = 0.2 - 0.0027 * step
        graph.update({"crate": Pose((-x, 0.75, 0.0), yaw(0.3)), "other": Pose((x, 0.75, 0.0), yaw(0.3))})
        assert is_as_built(graph, *objects)
        steps[step] = bool(looked_at(graph))
    touching = 0.1 * (math.cos(0.3) + 1e-9) / 2
    near = [step for step, looked in steps.items() if looked]
    assert near
    assert min(near) >= next(s for s in steps if 0.2 - 0.0027 * s - touching < 0.009)


def test_a_body_below_a_removed_support_is_checked(looked_at: Looked) -> None:
    """A jar slides over a worktop 20 mm thick, from above one cupboard to above another; then the worktop goes."""
    objects = [
        floor(),
        box("cupboard", (0.5, 0.7, 0.6), (-0.25, 0.35, 0.0)),
        box("drawers", (0.5, 0.7, 0.6), (0.26, 0.35, 0.0)),
        box("worktop", (1.1, 0.02, 0.7), (0.0, 0.71, 0.0)),
        box("jar", (0.3, 0.3, 0.3), (-0.3, 0.87, 0.0)),
    ]
    graph = ContactGraph(scene(*objects))
    looked_at(graph)
    for step in range(1, 121):
        graph.update({"jar": Pose((-0.3 + 0.005 * step, 0.87, 0.0))})
        assert is_as_built(graph, *objects)
        assert graph.neighbours("jar") == ("worktop",)
    assert not looked_at(graph)
    graph.update({"worktop": Pose((0.0, 0.71, 3.0))})
    assert is_as_built(graph, *objects)
    assert graph.neighbours("jar") == ("drawers",)


def test_a_body_below_a_support_is_checked_at_its_present_pose() -> None:
    """A jar slides on a worktop over a cupboard and is checked when a lamp beside it is removed. It slides on, out over
    the cupboard's side; then the worktop is removed."""
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
def test_a_neighbour_may_be_removed_and_come_back(goes_away: bool) -> None:
    """A neighbour is removed and added again while a crate slides near it, with and without contact."""
    for gap_m in (0.002, 0.02):
        near, crate = box("near", (0.1, 0.1, 0.1), (0.0, 0.75, 0.0)), box("crate", (0.1, 0.1, 0.1), (0.0, 0.75, 0.102))
        objects = [floor(), TABLE, near, crate]
        graph = ContactGraph(scene(*objects))
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


def test_larger_neighbours_of_a_body_that_loses_its_support_are_checked(looked_at: Looked) -> None:
    """A crate slides 10 mm beside a picture on a shelf, without contact. Without the shelf, the picture hangs on it."""
    shelf = box("shelf", (0.2, 0.1, 0.1), (-0.25, 0.75, 0.0))
    picture = box("picture", (0.2, 0.2, 0.02), (-0.25, 0.9, 0.0))
    crate = box("crate", (0.3, 0.6, 0.3), (0.0, 1.0, 0.0))
    objects = [floor(), TABLE, crate, picture, shelf]
    graph = ContactGraph(scene(*objects))
    graph.update({"crate": Pose((0.012, 1.0, 0.0))})
    looked_at(graph)
    for step in range(4):
        graph.update({"crate": Pose((0.011, 1.0, 0.001 * step))})
        assert "picture" not in graph.neighbours("crate")
    assert not looked_at(graph)
    graph.update({}, removed=["shelf"])
    assert "picture" in graph.neighbours("crate")
    assert is_as_built(graph, floor(), TABLE, crate, picture)


def test_a_body_on_a_smaller_one_that_loses_its_support_is_checked() -> None:
    """Without the table, the plinth hangs from the pole that stands on it, and not from the wall 12 mm away."""
    plinth, pole = box("plinth", (0.2, 0.05, 0.2), (0.0, 0.725, 0.0)), box("pole", (0.1, 1.0, 0.1), (0.0, 1.25, 0.0))
    wall = box("wall", (2.0, 3.0, 0.1), (0.0, 1.5, -0.162))
    objects = [floor(), TABLE, wall, plinth, pole]
    graph = ContactGraph(scene(*objects))
    graph.update({"pole": Pose((0.001, 1.25, 0.0))})
    graph.update({"pole": Pose((0.002, 1.25, 0.0))})
    graph.update({}, removed=["table"])
    assert graph.neighbours("plinth") == ("pole",)
    assert {contact.normal for contact in graph.contacts if contact.b == "pole"} == {(0.0, 1.0, 0.0)}
    assert is_as_built(graph, floor(), wall, plinth, pole)


def test_bodies_that_move_in_turns_meet_in_the_space_between() -> None:
    """A jar moves 55 mm, then a cup 93 mm, each within the box of its neighbour list: they end 2 mm apart."""
    objects = [floor(), TABLE, replace(CUP, pose=Pose((0.0, 0.75, 0.0))), replace(JAR, pose=Pose((-0.3, 0.8, 0.0)))]
    graph = ContactGraph(scene(*objects))
    moves = [("cup", 0.05), ("cup", 0.1), ("jar", -0.14), ("jar", -0.085), ("cup", 0.007)]
    for name, x in moves:
        graph.update({name: Pose((x, graph.pose(name).position_m[1], 0.0))})
        assert is_as_built(graph, *objects)
    assert "jar" in graph.neighbours("cup")


@pytest.mark.parametrize("flip", [Pose((0.0, 0.0, 0.0)), Pose((0.0, 0.81, 0.0), (1.0, 0.0, 0.0, 0.0))])
@pytest.mark.parametrize("angle", [0.0, 0.2, 1.1])
def test_a_step_in_a_rotated_shelf_needs_no_narrow_phase(angle: float, flip: Pose, looked_at: Looked) -> None:
    """A cup moves back and forth on the middle board of a rotated shelf, upright and upside down."""
    boards = [((0.8, 0.02, 0.3), (0.0, h, 0.0)) for h in (0.01, 0.4, 0.8)]
    sides = [((0.02, 0.8, 0.3), (x, 0.4, 0.0)) for x in (-0.41, 0.41)]
    shelf = replace(boxes("shelf", *boards, *sides), pose=Pose((0.0, 0.0, 0.0), yaw(angle)).compose(flip))
    height_m = 0.47 if flip.position_m[1] else 0.46
    cup = box("cup", (0.08, 0.1, 0.08), (0.0, height_m, 0.0), yaw(angle))
    graph = ContactGraph(scene(shelf, cup))
    looked_at(graph)
    for step in range(60):
        along = 0.2 * math.sin(0.1 * step)
        turn = Pose((0.0, 0.0, 0.0), yaw(angle))
        x, _, z = turn.to_world([along, 0.0, 0.0]).tolist()
        graph.update({"cup": Pose((x, height_m, z), yaw(angle + 0.05 * step))})
        assert graph.neighbours("cup") == ("shelf",)
        assert is_as_built(graph, shelf, cup)
    assert not looked_at(graph)


def test_a_step_on_a_worktop_over_a_cupboard_needs_no_narrow_phase(looked_at: Looked) -> None:
    """The toaster may hover by more than the worktop is thick, but the worktop is between it and the cupboard."""
    cupboard, worktop = on_floor("cupboard", (0.6, 0.86, 0.6), 0, 0), box("worktop", (2.4, 0.04, 0.6), (0.0, 0.88, 0.0))
    objects = [floor(), cupboard, worktop, box("toaster", (0.35, 0.2, 0.2), (0.0, 1.0, 0.0))]
    graph = ContactGraph(scene(*objects))
    looked_at(graph)
    for step in range(40):
        graph.update({"toaster": Pose((0.03 * math.sin(0.1 * step), 1.0, 0.0), yaw(0.02 * step))})
        assert is_as_built(graph, *objects)
    assert not looked_at(graph)


def test_a_step_on_the_floor_of_a_room_without_thickness_needs_no_narrow_phase(looked_at: Looked) -> None:
    """The floor is the lowest part of the room, so neither bottom is higher: the crate must stay inside the room."""
    low, high = ([(x, y, z) for x, z in ((-2.0, -2.0), (2.0, -2.0), (2.0, 2.0), (-2.0, 2.0))] for y in (0.0, 2.5))
    walls = [[low[k - 1], low[k], high[k], high[k - 1]] for k in range(4)]
    room = thing("room", quads(low, *walls), Pose())
    objects = [room, box("crate", (0.3, 0.3, 0.3), (0.5, 0.15, 0.0))]
    graph = ContactGraph(scene(*objects))
    looked_at(graph)
    for step in range(40):
        graph.update({"crate": Pose((0.5 + 0.03 * step, 0.15, 0.02 * step), yaw(0.02 * step))})
        assert graph.neighbours("crate") == ("room",)
        assert is_as_built(graph, *objects)
    assert not looked_at(graph)


def test_round_bodies_turn_beside_each_other_without_a_narrow_phase(looked_at: Looked) -> None:
    """Two cans 1 cm apart: their circles stay apart at any angle, their boxes do not."""
    ring = [(0.05 * math.cos(0.1 * math.pi * k), 0.05 * math.sin(0.1 * math.pi * k)) for k in range(20)]
    corners = [(0.0, 0.0, 0.0), (0.0, 0.1, 0.0), *((u, h, v) for h in (0.0, 0.1) for u, v in ring)]
    faces = [(e, 2 + 20 * e + k, 2 + 20 * e + (k + 1) % 20) for e in (0, 1) for k in range(20)]
    faces += [(2 + k, 2 + (k + 1) % 20, 22 + k) for k in range(20)]
    faces += [(2 + (k + 1) % 20, 22 + (k + 1) % 20, 22 + k) for k in range(20)]
    can = replace(CUP, id="can", geometry=TriMesh(np.array(corners), np.array(faces)), pose=Pose((0.0, 0.7, 0.0)))
    objects = [floor(), TABLE, can, replace(can, id="other", pose=Pose((0.11, 0.7, 0.0)))]
    graph = ContactGraph(scene(*objects))
    for step in range(40):
        turn = yaw(0.05 * step)
        graph.update({"can": Pose((0.0, 0.7, 0.0), turn), "other": Pose((0.11, 0.7, 0.0), turn)})
        assert is_as_built(graph, *objects)
        if step == 0:
            looked_at(graph)
    assert not looked_at(graph)


def test_planes_divide_the_free_distance_in_halves() -> None:
    """Two cubes 60 mm apart: each may move by half of the free distance, one alone by all of it."""
    one, other = (Body.of(box(x, (0.1, 0.1, 0.1), (at, 0.0, 0.0)), 1) for x, at in (("a", 0.0), ("b", 0.16)))
    room = ((-1.0,) * 3, (1.0,) * 3)
    both = [Extent(body, room, -math.inf, False) for body in (one, other)]
    apart = separated(both[0], both[1], TOUCH_M)
    assert apart is not None
    ((n_u, n_v, _, most_m, _),), ((*its_way, its_most_m, _),) = apart
    assert (n_u, n_v) == (1.0, 0.0)
    assert its_way[:2] == [-1.0, 0.0]
    assert most_m == pytest.approx(0.05 + 0.028, abs=1e-5)
    assert its_most_m == pytest.approx(-(0.11 - 0.028), abs=1e-5)
    alone = separated(both[0], Extent.of(other, is_fixed=True), TOUCH_M)
    assert alone is not None
    assert alone.one[0][3] == pytest.approx(0.11 - TOUCH_M, abs=1e-5)
    assert (
        separated(both[0], Extent.of(Body.of(box("c", (0.1, 0.1, 0.1), (0.103, 0.0, 0.0)), 1), is_fixed=True), TOUCH_M)
        is None
    )


def test_no_certificate_relies_on_a_body_that_moves(looked_at: Looked, monkeypatch: pytest.MonkeyPatch) -> None:
    """In a vehicle that moves as a whole each certificate would end in the next frame, after all the work of its proof.

    Once the vehicle stands still, a cup that is pushed gets one soon.
    """
    issued: list[str] = []
    keep = certificate_issuer.Certificate

    def watched(extent: Extent, *given: Any) -> Any:
        issued.append(extent.body.id)
        return keep(extent, *given)

    monkeypatch.setattr(certificate_issuer, "Certificate", watched)
    shelf = boxes(
        "shelf",
        *[((0.6, 0.02, 0.3), (0.0, height, 0.0)) for height in (0.01, 0.4, 0.79)],
        ((0.02, 0.8, 0.3), (0.31, 0.4, 0.0)),
        at_m=(2.0, 0.0, 0.0),
    )
    on_shelf = box("bottle", (0.08, 0.2, 0.08), (2.0, 0.51, 0.0))
    objects = [floor(), TABLE, JAR, CUP, shelf, on_shelf]
    graph = ContactGraph(scene(*objects))
    for frame in range(1, 40):
        vehicle = Pose((0.05 * frame, 0.0, 0.0), yaw(0.01 * frame))
        graph.update({item.id: vehicle.compose(item.pose) for item in objects})
        assert is_as_built(graph, *objects)
    assert not {"table", "cup", "jar", "bottle"}.intersection(issued)
    for frame in range(30):
        looked_at(graph)
        graph.update({"cup": vehicle.compose(Pose((0.2, 0.75, 0.1 + 0.003 * frame)))})
        assert is_as_built(graph, *objects)
    assert "cup" not in looked_at(graph)
