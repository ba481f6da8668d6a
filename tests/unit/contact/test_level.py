"""Closed-form contacts of upright bodies, from their outlines, agree with the triangles of `MeshPair`."""

import math

import numpy as np
import pytest
import trimesh
from hypothesis import assume, given, settings, strategies as st

from contact_scenes import box, boxes, thing
from scene2hap.contact.base_face import outline
from scene2hap.contact.body import Body
from scene2hap.contact.geometry.level_plane import clipped
from scene2hap.contact.graph import ContactGraph
from scene2hap.contact.mesh_distance import MeshPair
from scene2hap.contact.pair import rest_on, rest_points
from scene2hap.contact.rule import TOUCH_M, fall_reach_m
from scene2hap.scene.pose import Pose
from scene2hap.scene.shapes import Box, TriMesh
from scene2hap.scene.snapshot import SceneSnapshot

TURNS = st.floats(-3.0, 3.0)
PLACES = st.tuples(st.floats(-0.6, 0.6), st.floats(-0.5, 0.5))


def block(name: str, size: tuple[float, float, float], at: tuple[float, float, float], turn: float) -> Body:
    return Body.of(box(name, size, at, (0.0, math.sin(turn / 2), 0.0, math.cos(turn / 2))), 1)


@given(PLACES, TURNS, TURNS, st.floats(-0.003, 0.03))
@settings(max_examples=80)
def test_a_block_falls_onto_another_as_its_triangles_do(
    at: tuple[float, float], turn_x: float, turn_y: float, gap: float
) -> None:
    lower = block("lower", (0.8, 0.2, 0.5), (0.0, 0.1, 0.0), turn_y)
    upper = block("upper", (0.3, 0.1, 0.2), (at[0], 0.25 + gap, at[1]), turn_x)
    rest = rest_on(upper, lower)
    least = MeshPair(upper, lower).first_drop_m(upper, fall_reach_m(upper.size_m), TOUCH_M)
    # An overlap of the rims by up to 0.1 mm may or may not count.
    if (rest is None) != math.isinf(least):
        moved = block("upper", (0.2998, 0.1, 0.1998), upper.position_m, turn_x)
        assume((rest_on(moved, lower) is None) == math.isinf(least))
    elif rest is not None:
        assert rest.fall_m == pytest.approx(gap, abs=1e-12)
        assert least == pytest.approx(gap, abs=1e-9)
        points = np.array(rest_points(upper, lower, rest, 0.0))
        for body, half in ((upper, (0.15, 0.05, 0.1)), (lower, (0.4, 0.1, 0.25))):
            own = np.abs(body.pose.to_own(points))
            assert (own[:, [0, 2]] <= np.array(half)[[0, 2]] + 1e-9).all()
        assert points[:, 1] == pytest.approx(0.2 + gap / 2)


def test_a_hexagon_cut_into_triangles_is_filled() -> None:
    ring = [(math.cos(k * math.pi / 3), 0.0, math.sin(k * math.pi / 3)) for k in range(6)]
    faces = np.array([[0, k, k + 1] for k in range(1, 5)])
    assert Body.of(thing("lid", TriMesh(np.array(ring), faces), Pose()), 1).stance.posed_base_face.is_filled


def test_a_turned_block_beside_another_does_not_rest_on_it() -> None:
    """Turned by 20 degrees, its corner reaches 0.128 m from its middle; the circle around it 0.141 m."""
    lower, turn = block("lower", (0.8, 0.2, 0.5), (0.0, 0.1, 0.0), 0.0), math.radians(20)
    for reach_m, rests in ((0.125, True), (0.130, False)):
        upper = block("upper", (0.2, 0.1, 0.2), (0.0, 0.25, 0.25 + reach_m), turn)
        assert (rest_on(upper, lower) is not None) == rests


def test_the_outline_of_a_grid_is_its_four_corners() -> None:
    grid = np.array([(x, y) for x in (0.0, 1.0, 2.0) for y in (0.0, 1.0, 2.0)])
    assert grid[outline(grid.tolist())].tolist() == [[0, 0], [2, 0], [2, 2], [0, 2]]


@given(st.lists(st.tuples(st.integers(0, 3), st.floats(0.001, 0.999)), max_size=12), st.integers(0, 2**32 - 1))
@settings(max_examples=300)
def test_the_outline_of_a_square_is_its_corners_whatever_rounding_does_to_points_on_its_sides(
    on_sides: list[tuple[int, float]], seed: int
) -> None:
    rng = np.random.default_rng(seed)
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
    sides = [square[k] * (1 - share) + square[k - 1] * share for k, share in on_sides]
    points = np.array([*square, *sides]) + rng.uniform(-2e-8, 2e-8, (4 + len(sides), 2))
    assert sorted(outline(points.tolist())) == [0, 1, 2, 3]


@given(st.integers(2, 9), st.integers(0, 2**32 - 1))
def test_the_outline_of_points_on_a_line_is_its_ends(n: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    share = np.array([0.0, 1.0, *rng.uniform(0.01, 0.99, n - 2)])[:, None]
    points = share * rng.normal(size=2) + rng.uniform(-1e-8, 1e-8, (n, 2))
    assert sorted(outline(points.tolist())) == [0, 1]


def test_contact_points_are_the_same_with_y_and_with_z_up() -> None:
    """All corners of an octagonal base at the edge of a floor are as far from its middle."""
    angle = (np.arange(8) + 0.5) * math.pi / 4
    ring = np.stack([0.2 * np.cos(angle), np.zeros(8), 0.2 * np.sin(angle)], axis=1)
    base = trimesh.convex.convex_hull(np.concatenate([ring, ring + np.array([0.0, 0.3, 0.0])]))
    tub = thing("tub", TriMesh(base.vertices, base.faces), Pose((0.50001 - float(ring[0, 0]), 0.0, 0.0)))
    floor = box("floor", (1.0, 0.1, 2.0), (0.0, -0.05, 0.0))
    turn = Pose((0.0, 0.0, 0.0), (math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)))
    turned = [thing(one.id, one.geometry, turn.compose(one.pose)) for one in (tub, floor)]
    still = ContactGraph(SceneSnapshot("y", "y", (tub, floor)))
    lying = ContactGraph(SceneSnapshot("z", "z", tuple(turned)))
    expected = turn.to_world([one.point_m for one in still.contacts])
    found = [one.point_m for one in lying.contacts]
    np.testing.assert_allclose(sorted(np.round(found, 6).tolist()), sorted(np.round(expected, 6).tolist()), atol=2e-6)


def test_a_side_cut_into_pieces_has_no_corner_where_rounding_bends_it() -> None:
    turn = np.array([[math.cos(0.3), -math.sin(0.3)], [math.sin(0.3), math.cos(0.3)]])
    line = np.linspace(0.0, 1.0, 8)[:, None]
    sides = np.concatenate([line * [1.0, 0.0], line * [0.0, 0.2], line * [1.0, 0.0] + [0.0, 0.2]])
    points = np.concatenate([sides, [[1.0, 0.1]]]) @ turn
    points = points.astype(np.float32).astype(np.float64)
    assert {tuple(np.round(points[row] @ turn.T, 3) + 0.0) for row in outline(points.tolist())} == {
        (0.0, 0.0),
        (1.0, 0.0),
        (1.0, 0.2),
        (0.0, 0.2),
    }


def test_contact_points_of_a_level_face_do_not_depend_on_its_triangles() -> None:
    """Four corners of a plank, although its middle is farther from two of them than the other two are."""
    plank = Box((1.0, 0.05, 0.1)).mesh
    corners = plank.vertices_m[plank.faces]
    middles = corners.mean(axis=1)
    cut = [np.stack([a, b, middles], axis=1) for a, b in ((corners[:, k], corners[:, k - 2]) for k in range(3))]
    finer = TriMesh(np.concatenate(cut).reshape(-1, 3), np.arange(9 * len(corners)).reshape(-1, 3))
    floor = box("floor", (3.0, 0.1, 3.0), (0.0, -0.05, 0.0))
    plain, fine = (
        ContactGraph(SceneSnapshot("planks", "y", (floor, thing("plank", mesh, Pose((0.2, 0.025, 0.1))))))
        for mesh in (plank, finer)
    )
    assert [one.point_m for one in fine.contacts] == [one.point_m for one in plain.contacts]


def test_a_clipped_square_loses_its_corner() -> None:
    square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
    ring = clipped(square, 0.0, 0.0, [(-math.sqrt(0.5), -math.sqrt(0.5), -1.5 * math.sqrt(0.5))], 0.0)
    assert {(round(u, 9), round(v, 9)) for u, v in ring} == {(0, 0), (1, 0), (1, 0.5), (0.5, 1), (0, 1)}


@pytest.mark.parametrize(
    ("out_m", "right_side"),
    [(0.0009, {(-0.0009, -1.0), (0.0009, 1.0)}), (0.003, {(-0.003, -1.0), (0.0, 0.0), (0.0, 1.0)})],
)
def test_a_corner_up_to_the_slack_outside_an_edge_is_kept(out_m: float, right_side: set[tuple[float, float]]) -> None:
    """The right side of a strip crosses an edge at u = 0. Beyond the slack of 1 mm the strip is cut at that edge."""
    strip = [(-0.1, -1.0), (-out_m, -1.0), (out_m, 1.0), (-0.1, 1.0)]
    ring = clipped(strip, 0.0, 0.0, [(-1.0, 0.0, 0.0)], 0.001)
    assert {(round(u, 9), round(v, 9)) for u, v in ring} == right_side | {(-0.1, -1.0), (-0.1, 1.0)}


def test_a_leaning_body_stands_on_its_lowest_edge() -> None:
    angle = 0.3
    leaning = Body.of(
        box("leaning", (0.1, 0.2, 0.3), (0, 0, 0), (math.sin(angle / 2), 0.0, 0.0, math.cos(angle / 2))), 1
    )
    posed_base_face = leaning.stance.posed_base_face
    # The lowest edge along x after the rotation from y to z by the angle.
    height, z = -0.1 * math.cos(angle) - 0.15 * math.sin(angle), -0.1 * math.sin(angle) + 0.15 * math.cos(angle)
    assert posed_base_face.height == pytest.approx(height)
    assert sorted(posed_base_face.points) == [pytest.approx((-0.05, z)), pytest.approx((0.05, z))]
    floor = block("floor", (1, 1, 1), (0, -0.7, 0), 0.0)
    rest = rest_on(leaning, floor)
    assert rest is not None
    assert rest.fall_m == pytest.approx(height + 0.2)
    assert rest.wholly
    told = MeshPair(leaning, floor).drops(leaning, fall_reach_m(leaning.size_m), TOUCH_M)
    assert told is not None
    assert rest.fall_m == pytest.approx(told.min(), abs=1e-4)  # triangles are tested slightly smaller
    # Half over an edge, the closed form does not apply.
    assert rest_on(leaning, block("floor", (1, 1, 1), (0.5, -0.7, 0), 0.0)) is None


def test_feet_that_are_a_little_uneven_all_stand() -> None:
    legs = [((0.04, 0.4, 0.04), (x, 0.2 + 0.001 * (x * z > 0), z)) for x in (-0.2, 0.2) for z in (-0.2, 0.2)]
    stool = Body.of(boxes("stool", *legs, ((0.44, 0.04, 0.44), (0.0, 0.42, 0.0))), 1)
    assert {(round(u, 1), round(v, 1)) for u, v in stool.stance.posed_base_face.points} == {
        (-0.2, -0.2),
        (-0.2, 0.2),
        (0.2, -0.2),
        (0.2, 0.2),
    }
    assert stool.stance.posed_base_face.height == pytest.approx(0.0, abs=1e-9)
    assert not stool.stance.posed_base_face.is_filled


def test_a_box_around_a_turned_body_holds_it() -> None:
    rng = np.random.default_rng(2)
    for _ in range(50):
        item = box("b", (0.1, 0.4, 0.2), (1, 2, 3), rng.normal(size=4).tolist())
        body = Body.of(item, 1).at(Pose((3.0, 1.0, 2.0), item.pose.rotation_xyzw))
        corners = body.pose.to_world(body.shape.corners)
        assert body.low == pytest.approx(corners.min(axis=0))
        assert body.high == pytest.approx(corners.max(axis=0))


@pytest.mark.parametrize("cut", [(0, 1, 2, 3), (1, 2, 3, 0)])
@pytest.mark.parametrize("tilt_rad", [(1e-4, 1e-4), (1e-4, -1e-4), (-1e-4, 1e-4), (1.2e-4, 0.8e-4)])
def test_a_flat_face_is_level_as_a_whole_or_not_at_all(
    cut: tuple[int, int, int, int], tilt_rad: tuple[float, float]
) -> None:
    # A physics engine tilts what rests by some 0.1 mrad. The plate stands on its four corners, however it is cut.
    corners = [(x, y, z) for y in (0.0, 0.01) for x, z in ((-0.2, -0.15), (0.2, -0.15), (0.2, 0.15), (-0.2, 0.15))]
    faces = [[first + cut[k] for k in half] for first in (0, 4) for half in ((0, 1, 2), (0, 2, 3))]
    plate = thing("plate", TriMesh(np.array(corners), np.array(faces)), Pose())
    table = thing("table", TriMesh(np.array(corners) * (3, 1, 2) - (0.0, 0.01, 0.0), np.array(faces)), Pose())
    vehicle = Pose.from_euler((3.0, 1.0, -2.0), tilt_rad, order="xz")
    posed = [thing(x.id, x.geometry, vehicle.compose(x.pose)) for x in (plate, table)]
    own = vehicle.to_own(ContactGraph(SceneSnapshot("tilted", "y", tuple(posed))).arrays.points_m)
    assert sorted(map(tuple, np.round(own[:, [0, 2]], 3))) == [(-0.2, -0.15), (-0.2, 0.15), (0.2, -0.15), (0.2, 0.15)]
