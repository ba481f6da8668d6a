"""Contacts of hinged objects: at the pivot alone, as long as the hinge holds."""

import math
import random
from dataclasses import replace

import numpy as np
import pytest

from scene2hap import Box, Contact, ContactGraph, Hinge, Pose, SceneObject, SceneSnapshot
from scene2hap.contact.finder import ContactFinder
from scene2hap.contact.mesh_distance import MeshPair
from scene2hap.errors import SceneError

PIVOT_M = (0.3, 1.0, 0.2)


def cabinet_and_door(angle: float = 0.0, hinge: bool = True) -> list[SceneObject]:
    """A cabinet of 0.6 x 2 x 0.4 m and its door, which turns about an edge of the front by an angle [rad]."""
    cabinet = SceneObject("cabinet", pose=Pose((0.0, 1.0, 0.0)), geometry=Box((0.6, 2.0, 0.4)))
    pose = turned_door(angle)
    door = SceneObject("door", pose=pose, geometry=Box((0.6, 2.0, 0.02)))
    at = Hinge("cabinet", (0.3, 0.0, -0.01), (0.3, 0.0, 0.2))
    floor = SceneObject("floor", pose=Pose((0.0, -0.05, 0.0)), geometry=Box((4.0, 0.1, 4.0)))
    return [cabinet, replace(door, hinge=at) if hinge else door, floor]


def turned_door(angle: float) -> Pose:
    """The pose of the door, whose inner edge stays at the pivot."""
    c, s = math.cos(angle), math.sin(angle)
    x, z = -0.3, 0.01  # from the pivot to the middle of the closed door
    return Pose((0.3 + c * x + s * z, 1.0, 0.2 - s * x + c * z), (0.0, math.sin(angle / 2), 0.0, math.cos(angle / 2)))


@pytest.mark.parametrize("angle", [0.0, 0.4, 1.5])
def test_a_door_touches_its_cabinet_at_the_pivot(angle: float) -> None:
    graph = ContactGraph(SceneSnapshot.build(cabinet_and_door(angle)))
    (contact,) = [one for one in graph.contacts if (one.a, one.b) == ("cabinet", "door")]
    assert contact.point_m == pytest.approx(PIVOT_M, abs=1e-9)
    assert (contact.weight, contact.normal) == (1.0, None)
    # The door's lower edge is level with the floor, and the hinge does not hold it up there.
    assert graph.neighbours("door") == ("cabinet", "floor")
    assert graph.neighbours("cabinet") == ("door", "floor")


@pytest.mark.parametrize(("gap_m", "holds"), [(0.0, True), (0.006, True), (0.0099, True), (0.0101, False)])
def test_doors_have_gaps(gap_m: float, holds: bool) -> None:
    cabinet, door, floor = cabinet_and_door(hinge=False)
    door = replace(door, pose=Pose((0.0, 1.0, 0.21 + gap_m))).hinged_on(cabinet, (0.3, 1.0, 0.2 + gap_m / 2))
    graph = ContactGraph(SceneSnapshot.build([cabinet, door, floor]))
    assert (graph.patch("cabinet", "door")[0].tolist() == [[0.3, 0.0, 0.2 + gap_m / 2]]) == holds
    graph.update({"door": Pose((0.0, 1.0, 1.0))})
    graph.update({"door": door.pose})
    assert (graph.patch("cabinet", "door")[0].tolist() == [[0.3, 0.0, 0.2 + gap_m / 2]]) == holds


def test_a_hinged_object_does_not_stand_on_what_is_below_it() -> None:
    def held(hinge: bool) -> tuple[str, ...]:
        cabinet, door, floor = cabinet_and_door(hinge=hinge)
        raised = [replace(one, pose=Pose(np.add(one.pose.position_m, (0.0, 0.02, 0.0)))) for one in (cabinet, door)]
        return ContactGraph(SceneSnapshot.build([*raised, floor])).neighbours("door")

    assert held(hinge=False) == ("cabinet", "floor")
    assert held(hinge=True) == ("cabinet",)


def test_a_door_that_was_taken_off_is_loose() -> None:
    graph = ContactGraph(SceneSnapshot.build(cabinet_and_door()))
    away = Pose((0.012, 1.0, 0.21))  # both boxes touch, but the points of the hinge are 1.2 cm apart
    graph.update({"door": Pose((1.0, 1.0, 1.0))})
    assert graph.neighbours("door") == ("floor",)
    graph.update({"door": away})
    assert len([one for one in graph.contacts if (one.a, one.b) == ("cabinet", "door")]) != 1
    graph.update({"door": turned_door(0.7)})
    (contact,) = [one for one in graph.contacts if (one.a, one.b) == ("cabinet", "door")]
    assert contact.point_m == pytest.approx(PIVOT_M, abs=1e-9)


def test_a_door_follows_its_cabinet_and_is_loose_without_it() -> None:
    objects = cabinet_and_door()
    graph = ContactGraph(SceneSnapshot.build(objects))
    graph.update({"cabinet": Pose((0.0, 1.0, -1.0))})
    assert graph.neighbours("door") == ("floor",)
    graph.update({"cabinet": Pose((0.0, 1.0, 0.0))})
    assert graph.neighbours("door") == ("cabinet", "floor")
    graph.update({}, removed=["cabinet"])
    assert graph.neighbours("door") == ("floor",)
    graph.update({}, added=[objects[0]])
    assert graph.patch("cabinet", "door")[0].shape == (1, 3)


def test_triangles_of_hinged_objects_are_not_compared(monkeypatch: pytest.MonkeyPatch) -> None:
    graph = ContactGraph(SceneSnapshot.build(cabinet_and_door()))
    met: list[set[str]] = []
    made = MeshPair.__init__

    def watched(self: MeshPair, a: object, b: object) -> None:
        met.append({a.id, b.id})  # type: ignore[attr-defined]
        made(self, a, b)  # type: ignore[arg-type]

    monkeypatch.setattr(MeshPair, "__init__", watched)
    for step in range(1, 20):
        graph.update({"door": turned_door(0.05 * step)})
    assert {"cabinet", "door"} not in met


def test_walks_of_hinged_chains_equal_rebuilt_graphs() -> None:
    """Links that turn, come off, come back, go and return: the poses alone decide."""
    for seed in range(12):
        draw = random.Random(seed)
        links = [SceneObject("table", pose=Pose((0.0, 0.35, 0.0)), geometry=Box((1.2, 0.7, 0.8)))]
        before = "table"
        for number in range(4):
            size = (draw.uniform(0.04, 0.08), draw.uniform(0.1, 0.3), draw.uniform(0.04, 0.08))
            low = (0.0, 0.35, 0.0) if before == "table" else (0.0, links[-1].geometry.size_m[1] / 2, 0.0)  # type: ignore[union-attr]
            hinge = Hinge(before, (0.0, -size[1] / 2 + 0.01, 0.0), low)
            before = f"link{number}"
            links.append(SceneObject(before, geometry=Box(size), hinge=hinge))
        links.append(SceneObject("cup", pose=Pose((0.3, 0.75, 0.0)), geometry=Box((0.08, 0.1, 0.08))))
        scene = {one.id: one for one in posed(links, draw)}
        graph = ContactGraph(SceneSnapshot.build(list(scene.values())))
        out: dict[str, SceneObject] = {}
        for _ in range(25):
            kind = draw.random()
            if kind < 0.15 and not out:
                gone = draw.choice([x for x in scene if x != "table"])
                out[gone] = scene.pop(gone)
                graph.update({}, removed=[gone])
            elif kind < 0.3 and out:
                x, item = out.popitem()
                scene[x] = item
                graph.update({}, added=[item])
            elif kind < 0.5:
                x = draw.choice(list(scene))
                shift = np.array([draw.uniform(-1, 1) for _ in range(3)]) * draw.choice([0.002, 0.02, 0.3])
                scene[x] = replace(scene[x], pose=Pose(scene[x].pose.position_m + shift, scene[x].pose.rotation_xyzw))
                graph.update({x: scene[x].pose})
            else:
                moved = {one.id: one for one in posed([{**scene, **out}[one.id] for one in links], draw)}
                scene = {x: moved[x] for x in scene}
                out = {x: moved[x] for x in out}
                graph.update({x: one.pose for x, one in scene.items()})
            rebuilt = ContactGraph(SceneSnapshot.build(list(scene.values())))
            assert dict(graph.junctions) == dict(rebuilt.junctions)


def posed(links: list[SceneObject], draw: random.Random) -> list[SceneObject]:
    """Turn each hinged link about its pivot by chance; the others stay."""
    placed: dict[str, SceneObject] = {}
    for item in links:
        if item.hinge is not None:
            other = placed[item.hinge.to].pose
            angles = (draw.uniform(-0.8, 0.8), draw.uniform(-3, 3), draw.uniform(-0.8, 0.8))
            turn = Pose.from_euler((0.0, 0.0, 0.0), angles)
            at = other.to_world([item.hinge.other_point_m])[0] - turn.to_world([item.hinge.point_m])[0]
            item = replace(item, pose=Pose(at, turn.rotation_xyzw))
        placed[item.id] = item
    return list(placed.values())


def test_objects_of_one_chain_touch_at_their_hinges_alone() -> None:
    cabinet, door, floor = cabinet_and_door()
    knob = SceneObject("knob", pose=Pose((-0.2, 1.0, 0.235)), geometry=Box((0.04, 0.04, 0.1)))  # reaches into the body
    knob = knob.hinged_on(door, (-0.2, 1.0, 0.22))
    graph = ContactGraph(SceneSnapshot.build([cabinet, door, knob, floor]))
    assert graph.neighbours("knob") == ("door",)
    # Off its door, the knob is in contact with the cabinet behind it, and with the closed door.
    graph.update({"knob": Pose((-0.2, 1.05, 0.235))})
    assert graph.neighbours("knob") == ("cabinet", "door")
    graph.update({"knob": knob.pose, "cabinet": Pose((0.0, 1.0, -1.0))})
    assert graph.neighbours("knob") == ("door",)
    graph.update({"cabinet": cabinet.pose})
    assert graph.neighbours("cabinet") == ("door", "floor")


def test_objects_that_hang_on_each_other_are_a_chain_without_end() -> None:
    a = SceneObject("a", geometry=Box((0.2, 0.2, 0.2)))
    b = SceneObject("b", pose=Pose((0.2, 0.0, 0.0)), geometry=Box((0.2, 0.2, 0.2)))
    a, b = a.hinged_on(b, (0.1, 0.0, 0.0)), b.hinged_on(a, (0.1, 0.0, 0.0))
    graph = ContactGraph(SceneSnapshot.build([a, b]))
    assert graph.patch("a", "b")[0].tolist() == [[0.1, 0.0, 0.0]]
    graph.update({"b": Pose((0.5, 0.0, 0.0))})
    assert not graph.contacts


def test_hinged_objects_that_come_and_go_leave_nothing() -> None:
    cabinet, door, floor = cabinet_and_door()
    graph = ContactGraph(SceneSnapshot.build([cabinet, floor]))
    for number in range(3):
        graph.update({}, added=[replace(door, id=f"door {number}")])
        assert graph.neighbours("cabinet") == (f"door {number}", "floor")
        graph.update({}, removed=[f"door {number}"])
    assert isinstance(graph._finder, ContactFinder)
    hinged = graph._finder._pairs.hinged
    assert not hinged._with_hinge_to
    assert not hinged.on


def test_bad_hinges_are_refused() -> None:
    for words, make in {
        "id of the other object": lambda: Hinge("", (0, 0, 0), (0, 0, 0)),
        "point_m": lambda: Hinge("a", (0, 0), (0, 0, 0)),  # type: ignore[arg-type]
        "other_point_m": lambda: Hinge("a", (0, 0, 0), (0, float("nan"), 0)),
        "is to itself": lambda: SceneObject("a", geometry=Box((1, 1, 1)), hinge=Hinge("a", (0, 0, 0), (0, 0, 0))),
        "must be a Hinge": lambda: SceneObject("a", geometry=Box((1, 1, 1)), hinge="b"),  # type: ignore[arg-type]
    }.items():
        with pytest.raises(SceneError, match=words):
            make()


def test_hinged_on_keeps_that_a_surface_is_still_to_be_measured() -> None:
    cabinet = SceneObject("cabinet", geometry=Box((0.6, 0.4, 2.0)))
    door = SceneObject("door", pose=Pose((0.0, 0.21, 0.0)), geometry=Box((0.6, 0.02, 2.0)))
    plain, held = (
        SceneSnapshot.build([cabinet, one], up_axis="z").object("door")
        for one in (door, door.hinged_on(cabinet, (0.3, 0.2, 0.0)))
    )
    assert held.hinge is not None
    assert held.hinge.point_m == pytest.approx((0.3, -0.01, 0.0))
    assert replace(held, hinge=None) == plain


def test_hinges_that_hold_nothing_are_found() -> None:
    cabinet, door, floor = cabinet_and_door()
    assert not [one for one in SceneSnapshot.build([cabinet, door, floor]).check() if one.kind == "hinge"]
    (alone,) = SceneSnapshot.build([replace(cabinet, id="cabinets"), door, floor]).check()
    assert (alone.kind, alone.object_ids) == ("hinge", ("door",))
    assert "no such object" in alone.sentence
    assert "'cabinets'" in alone.sentence
    far = replace(door, hinge=Hinge("cabinet", (0.3, 0.0, 0.0), (0.3, 0.0, 0.25)))
    (apart,) = SceneSnapshot.build([cabinet, far, floor]).check()
    assert (apart.kind, apart.object_ids) == ("hinge", ("door", "cabinet"))
    assert "0.04 m apart" in apart.sentence


def test_a_hinge_survives_json_and_new_poses() -> None:
    scene = SceneSnapshot.build(cabinet_and_door())
    again = SceneSnapshot.from_json(scene.to_json())
    assert again == scene
    assert again.object("door").hinge == scene.object("door").hinge
    assert scene.with_poses({"door": turned_door(1.0)}).object("door").hinge is not None
    assert '"hinge"' not in SceneSnapshot.build(cabinet_and_door(hinge=False)).to_json()


def test_hinges_hold_also_where_an_engine_gives_the_contacts() -> None:
    cabinet, door, floor = cabinet_and_door()
    on_floor = Contact("floor", "cabinet", (0.0, 0.0, 0.0))
    scene = replace(SceneSnapshot.build([cabinet, door, floor]), contacts=(on_floor,))
    graph = ContactGraph(scene)
    at_pivot = {("cabinet", "door"): [PIVOT_M]}

    def held() -> dict[tuple[str, str], list[tuple[float, ...]]]:
        return {x: [tuple(np.round(p, 9)) for p in y.points_m] for x, y in graph.junctions.items() if "door" in x}

    assert held() == at_pivot
    graph.update({"door": turned_door(0.6)}, contacts=[on_floor])
    assert held() == at_pivot
    graph.update({"door": turned_door(0.9)})  # a frame without a report of the engine
    assert held() == at_pivot
    graph.update({"door": Pose((0.0, 1.0, 0.5))}, contacts=[on_floor])
    assert held() == {}
    change = graph.update({"door": door.pose})
    assert (held(), change.appeared) == (at_pivot, {("cabinet", "door")})
    graph.update({}, contacts=[Contact("door", "cabinet", (-0.3, 1.0, 0.2))])  # it is shut, and touches its frame
    assert held() == {("cabinet", "door"): [(-0.3, 1.0, 0.2), PIVOT_M]}
    graph.update({}, removed=["cabinet"])
    assert held() == {}
    graph.update({}, added=[cabinet])
    assert held() == at_pivot
    graph.update({}, removed=["door"])
    graph.update({}, added=[replace(door, hinge=None)])
    assert held() == {}
