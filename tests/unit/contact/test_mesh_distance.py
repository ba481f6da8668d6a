"""Distance, contact points and fall distance of mesh pairs: closed forms of boxes, and invariants of any mesh."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from contact_scenes import Triple, box, boxes
from scene2hap.contact.body import Body
from scene2hap.contact.geometry.boxes import boxes_of
from scene2hap.contact.geometry.spread import MAX_POINTS
from scene2hap.contact.geometry.triangle_tree import TriangleTree
from scene2hap.contact.mesh_distance import MeshPair
from scene2hap.contact.shape import shape_of
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose
from scene2hap.scene.shapes import TriMesh

FAR = 10.0
SIZES = st.tuples(*[st.sampled_from([0.1, 0.3, 1.0])] * 3)
OFFSETS = st.tuples(*[st.sampled_from([-0.9, -0.2, -0.1, 0.0, 0.13, 0.3, 1.2])] * 3)
QUATERNIONS = st.tuples(*[st.integers(-3, 3)] * 4).filter(any)


def meeting(a: SceneObject, b: SceneObject) -> MeshPair:
    return MeshPair(Body.of(a, 1), Body.of(b, 1))


def surface_gap(size_a: Triple, size_b: Triple, offset: Triple) -> float:
    """The distance of the surfaces of two axis-parallel boxes; for a box inside another, to the nearest side."""
    half_a, half_b, between = np.array(size_a) / 2, np.array(size_b) / 2, np.abs(offset)
    outside = np.maximum(between - half_a - half_b, 0.0)
    if outside.any():
        return float(np.linalg.norm(outside))
    for inner, outer in ((half_a, half_b), (half_b, half_a)):
        if (between + inner <= outer).all():
            return float((outer - inner - between).min())
    return 0.0


@given(SIZES, SIZES, OFFSETS, QUATERNIONS)
@settings(max_examples=80)
def test_boxes_turned_together_keep_their_closed_form_gap(
    size_a: Triple, size_b: Triple, offset: Triple, rotation: tuple[float, float, float, float]
) -> None:
    frame = Pose((1.0, -2.0, 3.0), rotation)
    a, b = (Body(x, shape_of(box(x, size, (0, 0, 0)).geometry.mesh), pose, 1) for x, size, pose in (
        ("a", size_a, frame), ("b", size_b, frame.compose(Pose(offset)))))  # fmt: skip
    gap = MeshPair(a, b).gap(FAR)
    assert gap is not None
    expected = surface_gap(size_a, size_b, offset)
    assert gap.distance_m == pytest.approx(expected, abs=1e-12)
    assert np.linalg.norm(gap.way_m) == pytest.approx(expected, abs=1e-12)


def test_distance_vector_leads_from_a_to_b_whichever_is_larger() -> None:
    small, large = box("a", (0.1, 0.1, 0.1), (0, 0, 0)), box("b", (1, 1, 1), (0.75, 0, 0))
    there, back = meeting(small, large).gap(FAR), meeting(large, small).gap(FAR)
    assert there is not None
    assert back is not None
    assert there.way_m == pytest.approx([0.2, 0, 0])
    assert back.way_m == pytest.approx([-0.2, 0, 0])


def test_a_gap_beyond_reach_is_none() -> None:
    a, b = box("a", (1, 1, 1), (0, 0, 0)), box("b", (1, 1, 1), (1.5, 0, 0))
    assert meeting(a, b).gap(0.499) is None
    assert meeting(a, b).gap(0.501) is not None


def test_one_mesh_has_one_shape() -> None:
    first, second = box("a", (1, 1, 1), (0, 0, 0)), box("b", (1, 1, 1), (5, 0, 0))
    assert Body.of(first, 1).shape is Body.of(second, 1).shape


def patch_of(a: SceneObject, b: SceneObject, within_m: float = 0.001, way: Triple = (0, 0, 0)) -> np.ndarray:
    """The points of the contact patch on both surfaces, in world coordinates, (2, n, 3)."""
    ends = meeting(a, b).patch(way, within_m)
    return np.array([[pair[k] for pair in ends] for k in (0, 1)]).reshape(2, -1, 3)


def as_set(points: np.ndarray) -> set[tuple[float, ...]]:
    return {tuple(float(x) + 0.0 for x in row) for row in np.round(points, 9)}


def test_a_box_on_a_table_touches_at_the_corners_of_its_bottom() -> None:
    on_a, on_b = patch_of(box("cup", (0.2, 0.3, 0.1), (0.1, 0.15, 0.2)), box("table", (2, 0.1, 2), (0, -0.05, 0)))
    assert as_set(on_a) == {(0.0, 0.0, 0.15), (0.2, 0.0, 0.15), (0.0, 0.0, 0.25), (0.2, 0.0, 0.25)}
    assert as_set(on_b) == as_set(on_a)


def test_box_over_an_edge_touches_in_the_overlap() -> None:
    on_a, _ = patch_of(box("box", (0.4, 0.1, 0.2), (1.0, 0.05, 0.0)), box("table", (2, 0.1, 2), (0, -0.05, 0)))
    assert as_set(on_a) == {(0.8, 0.0, -0.1), (0.8, 0.0, 0.1), (1.0, 0.0, -0.1), (1.0, 0.0, 0.1)}


def test_crossing_bars_touch_at_the_crossing() -> None:
    on_a, _ = patch_of(box("a", (1, 0.02, 0.02), (0, 0.01, 0)), box("b", (0.02, 0.02, 1), (0, 0.03, 0)))
    assert as_set(on_a) == {(x, 0.02, z) for x in (-0.01, 0.01) for z in (-0.01, 0.01)}


def test_a_tip_touches_at_one_point() -> None:
    standing_on_corner = box("a", (0.1, 0.1, 0.1), (0.3, 0.05 * 3**0.5, 0.2), (0.8804763, 0.0, -0.3647052, 0.2797846))
    lowest = standing_on_corner.bounds_m[0, 1]
    on_a, on_b = patch_of(standing_on_corner, box("b", (1, 0.1, 1), (0, lowest - 0.05, 0)), 1e-4)
    assert len(on_a) == 1
    assert on_a[0, 1] == pytest.approx(lowest)
    assert on_a[0] == pytest.approx(on_b[0], abs=2e-4)


def test_patch_displaces_a_and_returns_points_at_its_present_pose() -> None:
    floating, table = box("a", (0.2, 0.2, 0.2), (0, 0.13, 0)), box("b", (1, 0.1, 1), (0, -0.05, 0))
    assert patch_of(floating, table).shape == (2, 0, 3)
    on_a, on_b = patch_of(floating, table, way=(0, -0.03, 0))
    assert on_a[:, 1] == pytest.approx(0.03)
    assert on_b[:, 1] == pytest.approx(0.0)
    assert as_set(on_a[:, [0, 2]]) == as_set(on_b[:, [0, 2]]) == {(x, z) for x in (-0.1, 0.1) for z in (-0.1, 0.1)}


def test_surfaces_that_cut_each_other_touch_along_the_cut() -> None:
    on_a, _ = patch_of(box("post", (0.1, 1.0, 0.1), (0, 0, 0)), box("plate", (1, 0.02, 1), (0, 0, 0)))
    assert len(on_a) == MAX_POINTS
    # Corners of the post, at the height of one of the plate's faces.
    assert np.abs(on_a[:, [0, 2]]) == pytest.approx(0.05)
    assert np.abs(on_a[:, 1]) == pytest.approx(0.01)


def test_points_are_spread_over_all_feet() -> None:
    legs = [((0.05, 0.5, 0.05), (x, 0.25, z)) for x in (-0.5, 0.5) for z in (-0.3, 0.3)]
    on_a, _ = patch_of(boxes("table", *legs), box("floor", (9, 0.1, 9), (0, -0.05, 0)))
    assert as_set(np.sign(on_a[:, [0, 2]])) == {(x, z) for x in (-1, 1) for z in (-1, 1)}


SHAPES = [
    box("crate", (0.3, 0.2, 0.25), (0, 0, 0)),
    box("plate", (0.4, 0.01, 0.3), (0, 0, 0)),
    boxes(
        "stool", ((0.4, 0.04, 0.4), (0, 0.2, 0)), ((0.05, 0.4, 0.05), (-0.15, 0, 0)), ((0.05, 0.4, 0.05), (0.15, 0, 0))
    ),
]


def heap(seed: int, up_axis: int) -> list[Body]:
    """Objects on, in and above each other, at any tilt."""
    rng = np.random.default_rng(seed)
    found = []
    for k in range(7):
        place, turn = rng.uniform(-0.25, 0.25, 3), rng.normal(size=4)
        if k % 3 == 0:
            turn[:3] *= 0.02
        pose = Pose(tuple(place.tolist()), tuple(turn.tolist()))
        found.append(Body(f"x{k}", shape_of(SHAPES[k % 3].geometry.mesh), pose, up_axis))
    return found


@pytest.mark.parametrize("up_axis", [1, 2])
@given(seed=st.integers(0, 10**6))
@settings(max_examples=25)
def test_an_object_moved_by_its_fall_distance_touches_the_other(up_axis: int, seed: int) -> None:
    """After a move by its fall distance, an object touches the other, as the host or as the guest."""
    bodies, n_fell = heap(seed, up_axis), 0
    for faller in bodies:
        for other in bodies:
            limits = (faller, 0.25 * faller.size_m, 0.004)
            falls_m = MeshPair(faller, other).drops(*limits)
            first_m = MeshPair(faller, other).first_drop_m(*limits)
            assert first_m == (math.inf if falls_m is None else falls_m.min())
            if faller is other or falls_m is None:
                continue
            n_fell += 1
            assert len(falls_m) == faller.shape.triangles.shape[2]
            assert -0.004 <= first_m <= 0.25 * faller.size_m
            assert (falls_m[np.isfinite(falls_m)] <= first_m + 0.004).all()
            x, y, z = faller.position_m
            at = (x, y - first_m, z) if up_axis == 1 else (x, y, z - first_m)
            landed = faller.at(Pose(at, faller.pose.rotation_xyzw))
            # Falling triangles are tested smaller by at most 0.1 mm. A triangle that is sunk in by more than 4 mm at
            # one end and less at the other does not fall.
            assert MeshPair(landed, other).gap(3e-4 if first_m else 0.0043) is not None
    assert n_fell > 5


@given(seed=st.integers(0, 10**6), n=st.integers(1, 300))
@settings(max_examples=60)
def test_a_tree_holds_every_triangle_once_and_boxes_hold_their_children(seed: int, n: int) -> None:
    rng = np.random.default_rng(seed)
    triangles = rng.normal(size=(3, 3, n)) * rng.choice([0.0, 1e-3, 1.0], (3, 1, 1))
    of_triangles = rng.integers(0, 64, n).astype(np.uint8)
    nodes, corners, columns, features = TriangleTree.over(triangles, boxes_of(triangles), of_triangles)
    is_full = columns >= 0
    np.testing.assert_array_equal(features[is_full], of_triangles[columns[is_full]])
    assert sorted(columns[is_full].tolist()) == list(range(n))
    np.testing.assert_array_equal(corners[is_full].reshape(-1, 3, 3), triangles.transpose(2, 1, 0)[columns[is_full]])
    n_leaves = len(columns)
    for k in range(n_leaves - 1):
        assert (nodes[k, :3] == nodes[2 * k + 1 : 2 * k + 3, :3].min(axis=0)).all()
        assert (nodes[k, 3:] == nodes[2 * k + 1 : 2 * k + 3, 3:].max(axis=0)).all()
    for own, ends, full in zip(corners.reshape(-1, 3, 3), nodes[n_leaves - 1 :], is_full, strict=True):
        low, high = ends[:3], ends[3:]
        if full:
            assert (own.min(axis=0) == low).all()
            assert (own.max(axis=0) == high).all()
        else:
            assert (low == np.inf).all()
            assert (high == -np.inf).all()


def wavy(name: str, n: int, place: Triple) -> Body:
    """A sheet of 2 n^2 triangles with waves 3 mm high."""
    u, v = (axis.ravel() for axis in np.meshgrid(*[np.linspace(-0.3, 0.3, n + 1)] * 2, indexing="ij"))
    corner = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    faces = [[corner, corner + 1, corner + n + 2], [corner, corner + n + 2, corner + n + 1]]
    corners = np.stack([u, 0.003 * np.sin(40 * u) * np.cos(30 * v), v], axis=1)
    mesh = TriMesh(corners, np.concatenate([np.stack(three, axis=1) for three in faces]))
    return Body(name, shape_of(mesh), Pose(place, (0.0, 0.0, 0.0, 1.0)), 1)


def test_contact_points_of_dense_meshes_are_as_far_apart_as_any() -> None:
    """Each contact point is the candidate farthest from the points before; candidates are computed piece by piece."""
    sheet, other = wavy("a", 50, (0.0, 0.0, 0.0)), wavy("b", 40, (0.11, 0.002, 0.07))
    chosen = np.array([ends.middle_m for ends in MeshPair(sheet, other).patch((0.0, 0.0, 0.0), 0.001)])
    assert len(chosen) == MAX_POINTS
    pieces = [(low, low + 200) for low in range(0, 3200, 200)]
    candidates = []
    for low, high in pieces:
        piece = TriMesh(other.shape.triangles[:, :, low:high].T.reshape(-1, 3), np.arange(600).reshape(200, 3))
        part = Body("b", shape_of(piece), other.pose, 1)
        candidates += [ends.middle_m for ends in MeshPair(sheet, part).patch((0.0, 0.0, 0.0), 0.001)]
    points = np.array(candidates)
    assert len(points) > 40
    for k in range(1, MAX_POINTS):
        apart = np.linalg.norm(points[:, None] - chosen[:k], axis=2).min(axis=1).max()
        assert np.linalg.norm(chosen[k] - chosen[:k], axis=1).min() >= apart - 1e-6
