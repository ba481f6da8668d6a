"""Free space around a guest body, against a search of all triangles of its host."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from contact_scenes import box, boxes, chair, house, pairs, scene
from scene2hap.contact import free_space
from scene2hap.contact.body import Body, Stance
from scene2hap.contact.free_space import FreeSpace
from scene2hap.contact.graph import ContactGraph
from scene2hap.contact.ledge import FreeRegion, FreeRegions, VerticalAxis
from scene2hap.contact.mesh_distance import MeshPair
from scene2hap.contact.rule import TOUCH_M, fall_reach_m, hang_reach_m
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose

HOUSE = house()
SHELF = boxes("shelf", *(((0.8, 0.02, 0.4), (0.0, h, 0.0)) for h in (0.01, 0.4, 0.8)))


def turned(angle: float) -> tuple[float, float, float, float]:
    return (0.0, math.sin(angle / 2), 0.0, math.cos(angle / 2))


PLACES = st.tuples(
    st.floats(-1.6, 1.6),
    st.sampled_from([0.0, 0.0, 0.004, 0.03, 0.12, 0.13, 0.6, 0.9, 0.91, 2.1]),
    st.floats(-1.6, 1.6),
)
TURNS = st.sampled_from([0.0, 0.0, 0.5, math.pi / 2, 2.0])
SIZES = st.sampled_from([(0.1, 0.1, 0.1), (0.3, 0.2, 0.1), (0.5, 0.02, 0.5)])


@given(PLACES, TURNS, TURNS, SIZES, st.tuples(*[st.floats(-0.05, 0.05)] * 2))
@settings(max_examples=400)
def test_free_space_agrees_with_triangles(
    at: tuple[float, float, float],
    turn: float,
    turn_of_all: float,
    size: tuple[float, float, float],
    step: tuple[float, float],
) -> None:
    """Compare at a place, and at a second place nearby, where the first free region may still be valid."""
    all_of_it = Pose((0.3, 0.1, -0.2), turned(turn_of_all))
    host = Body.of(replace(HOUSE, pose=all_of_it), 1)
    for dx, dz in ((0.0, 0.0), step):
        place = Pose((at[0] + dx, at[1] + size[1] / 2, at[2] + dz), turned(turn))
        guest = Body.of(replace(box("guest", size, (0, 0, 0)), pose=all_of_it.compose(place)), 1)
        reach_m = fall_reach_m(guest.size_m)
        meeting = MeshPair(guest, host)
        told = meeting.drops(guest, reach_m, TOUCH_M)
        known = FreeSpace(guest, host).region_below
        if known is not None and known.top_m is None:
            assert told is None
        elif known is not None and known.top_m is not None:
            fall_m = guest.position_m[1] + guest.stance.posed_base_face.height - host.position_m[1] - known.top_m
            if -0.004 <= fall_m <= reach_m - 1e-9:
                assert told is not None
                assert told.min() == pytest.approx(fall_m, abs=1e-9)
        if FreeSpace(guest, host).empty_region is not None:
            assert told is None
            assert meeting.gap(hang_reach_m(guest.size_m)) is None


def test_most_of_a_room_needs_no_triangles(monkeypatch: pytest.MonkeyPatch) -> None:
    met: list[object] = []
    made = MeshPair.__init__

    def watched(self: MeshPair, *args: Body) -> None:
        met.append(self)
        made(self, *args)

    monkeypatch.setattr(MeshPair, "__init__", watched)
    graph = ContactGraph(scene(HOUSE, chair((-0.2, 0.0, 0.9)), box("pan", (0.2, 0.1, 0.2), (1.2, 0.955, 0.1))))
    assert pairs(graph) == {("chair", "house"), ("house", "pan")}
    for k in range(30):
        graph.update(
            {
                "chair": Pose((-0.2 - 0.02 * k, 0.0, 0.9 - 0.04 * k)),
                "pan": Pose((1.2, 1.1 + 0.01 * k, 0.1 - 0.03 * k)),
            }
        )
    assert pairs(graph) == {("chair", "house")}
    assert not met


def test_an_object_between_boards_stands_on_the_lower() -> None:
    graph = ContactGraph(scene(SHELF, box("pot", (0.1, 0.1, 0.1), (0.1, 0.463, 0.0))))
    (points, _), junction = graph.patch("pot", "shelf"), graph.junctions["pot", "shelf"]
    assert junction.weights[0] == 1.0
    assert junction.normals[0] == (0.0, -1.0, 0.0)
    assert {tuple(p) for p in points.round(4).tolist()} == {
        (x, -0.0515, z) for x in (-0.05, 0.05) for z in (-0.05, 0.05)
    }


def alone(*things: SceneObject) -> ContactGraph:
    """The contact graph from triangles only, without free regions."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Stance, "upright", None)
        return ContactGraph(scene(*things))


@pytest.mark.parametrize("depth_m", [0.001, 0.0035, 0.015, 0.0235, 0.03, 0.05])
def test_contacts_of_an_object_sunk_in_a_ledge_agree_with_triangles(depth_m: float) -> None:
    """A plate 20 mm thick in a podium; up to 4 mm below the podium's top, the plate's top counts as sunk in."""
    plate = box("plate", (0.1, 0.02, 0.1), (-1.1, 0.13 - depth_m, -1.1))
    told, by_triangles = ContactGraph(scene(HOUSE, plate)), alone(HOUSE, plate)
    assert pairs(told) == pairs(by_triangles)
    for pair, junction in told.junctions.items():
        other = by_triangles.junctions[pair]
        assert junction.weights == pytest.approx(other.weights, abs=1e-6)
        assert junction.normals[0] == pytest.approx(other.normals[0])


def test_a_step_in_the_floor_gives_no_free_region() -> None:
    host = Body.of(HOUSE, 1)
    on_podium = Body.of(box("a", (0.2, 0.1, 0.2), (-1.1, 0.17, -1.1)), 1)
    beside = Body.of(box("b", (0.2, 0.1, 0.2), (-0.55, 0.05, -1.1)), 1)
    across = Body.of(box("c", (0.2, 0.1, 0.2), (-0.7, 0.17, -1.1)), 1)
    known = FreeSpace(on_podium, host).region_below
    assert known is not None
    assert known.top_m == pytest.approx(0.12)
    known = FreeSpace(beside, host).region_below
    assert known is not None
    assert known.top_m == 0.0
    # The region ends at the podium and the walls.
    low, high = (side[[known.own.u, known.own.v, known.own.axis]] for side in host.shape.boxes)
    is_within = (np.less(low.T, known.box[1]) & np.greater(high.T, known.box[0])).all(axis=1)
    assert (high[2, is_within] <= 1e-5).all()
    assert FreeSpace(across, host).region_below is None
    assert FreeSpace(on_podium, host).empty_region is None


def test_a_free_region_of_a_floor_serves_other_guests(monkeypatch: pytest.MonkeyPatch) -> None:
    host = Body.of(HOUSE, 1)
    first = FreeSpace(Body.of(box("first", (0.1, 0.1, 0.1), (0.0, 0.05, 0.9)), 1), host).region_below
    monkeypatch.setattr(free_space, "_computed_region", lambda *_: pytest.fail("searched again"))
    for n, x in enumerate((0.1, 0.2, -0.1)):
        guest = Body.of(box(f"copy_{n}", (0.1, 0.1, 0.1), (x, 0.05, 0.9)), 1)
        assert FreeSpace(guest, host).region_below is first


def test_many_guests_keep_few_regions() -> None:
    regions = FreeRegions()
    for n in range(5000):
        new = FreeRegion(VerticalAxis(1, 1, 0, 2), ((n, 0, 0), (n + 1, 1, 1)), None, (0, 0, 0, 0))
        assert regions.find(f"copy_{n}", lambda known: False, lambda new=new: new) is new
    taken = (4990.2, 0.2, 0.2), (4990.4, 0.4, 0.4)
    found = regions.find("other", lambda known: known.holds(taken), lambda: None)
    assert found is not None
    assert found.box[0][0] == 4990
    assert regions.find("other", lambda known: known is found, lambda: None) is found
    assert regions.find("old", lambda known: known.box[0][0] == 0, lambda: None) is None


def test_a_leaning_host_has_no_free_region() -> None:
    leaning = Body.of(house((0.05, 0.0, 0.0, 1.0)), 1)
    guest = Body.of(box("a", (0.2, 0.1, 0.2), (0.0, 1.0, 0.0)), 1)
    assert FreeSpace(guest, leaning).region_below is None
    assert FreeSpace(guest, leaning).empty_region is None


NAMES = ["crate", "chair", "pot", "stick", "mat"]
MOVES = st.dictionaries(
    st.sampled_from(NAMES), st.tuples(PLACES, TURNS, st.sampled_from([0.0, 0.0, 0.0, 0.2])), min_size=1, max_size=4
)


@given(MOVES, TURNS)
@settings(max_examples=150)
def test_contacts_of_a_room_equal_those_by_triangles_alone(
    moves: dict[str, tuple[tuple[float, float, float], float, float]], turn: float
) -> None:
    things: list[SceneObject] = [
        HOUSE,
        replace(SHELF, pose=Pose((-0.3, 0.0, -0.2), turned(turn))),
        box("crate", (0.2, 0.2, 0.2), (-1.1, 0.22, -1.1)),
        chair((-0.2, 0.0, 0.9)),
        box("pot", (0.12, 0.1, 0.12), (-0.3, 0.46, -0.2)),
        box("stick", (0.02, 0.5, 0.02), (1.0, 0.26, 0.2)),
        box("mat", (0.6, 0.01, 0.6), (0.9, 0.005, -0.9)),
    ]
    for k, item in enumerate(things):
        if item.id in moves:
            (x, y, z), about, lean = moves[item.id]
            y += 0.0 if item.id == "chair" else float(np.ptp(item.bounds_m, axis=0)[1]) / 2
            rotation = Pose((0, 0, 0), turned(about)).compose(Pose((0, 0, 0), (lean, 0.0, 0.0, 1.0))).rotation_xyzw
            things[k] = replace(item, pose=Pose((x, y, z), rotation))
    told, by_triangles = ContactGraph(scene(*things)), alone(*things)
    for pair in told.junctions.keys() | by_triangles.junctions.keys():
        one, other = (
            graph.junctions[pair].weights[0] if pair in graph.junctions else 0.0 for graph in (told, by_triangles)
        )
        # Triangles of a leaning object are tested slightly smaller, so that they hover slightly higher.
        assert one == pytest.approx(other, abs=0.06), pair


def pen(x: float) -> SceneObject:
    """One object of two walls 0.78 m apart."""
    return boxes("pen", *(((0.02, 0.2, 0.8), (dx, 0.1, 0.0)) for dx in (-0.4, 0.4)), at_m=(x, 0.0, 0.3))


def test_a_guest_moving_in_free_space_notices_that_its_host_has_moved() -> None:
    """Between two walls, one box slides and another hangs in the air; then a wall moves close to them."""
    low, high = box("low", (0.1, 0.1, 0.1), (-0.19, 0.05, 0.55)), box("high", (0.1, 0.1, 0.1), (-0.19, 0.17, 0.05))
    graph = ContactGraph(scene(HOUSE, pen(-0.5), low, high))
    # After its first move, a body may move on without a new neighbour search.
    graph.update({"pen": Pose((-0.501, 0.0, 0.3))})
    shift = 0.0
    for k in range(6):
        shift = 0.0001 * k
        graph.update({"low": Pose((-0.19 + shift, 0.05, 0.55)), "high": Pose((-0.19 + shift, 0.17, 0.05))})
    assert pairs(graph) == {("house", "low"), ("house", "pen")}
    # The wall moves from 30 to 12 mm distance, and the boxes move 10 mm towards it.
    places = {
        "pen": Pose((-0.518, 0.0, 0.3)),
        "low": Pose((-0.18 + shift, 0.05, 0.55)),
        "high": Pose((-0.18 + shift, 0.17, 0.05)),
    }
    for name, pose in places.items():
        graph.update({name: pose})
    moved = [replace(item, pose=places[item.id]) for item in (pen(-0.5), low, high)]
    assert graph.contacts == ContactGraph(scene(HOUSE, *moved)).contacts
    assert pairs(graph) == {("house", "low"), ("house", "pen"), ("low", "pen"), ("high", "pen")}


def test_an_object_from_below_a_ledge_does_not_stand_on_it() -> None:
    """A slab has moved through a floor, which may then fall onto it; it rises again above the floor's lower face."""
    base, slab = box("base", (3.0, 0.1, 3.0), (0.0, -0.05, 0.0)), box("slab", (0.5, 0.04, 0.4), (0.0, 0.02, 0.0))
    graph = ContactGraph(scene(base, slab))
    for height in (-0.092, -0.064):
        place = Pose((0.35, height, -0.02), turned(0.67))
        graph.update({"slab": place})
        assert graph.contacts == ContactGraph(scene(base, replace(slab, pose=place))).contacts
