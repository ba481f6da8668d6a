"""Feature selection of a mesh: counts of corners and edges known by hand, and equal distances and contacts."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from scene2hap.contact.body import Body
from scene2hap.contact.geometry.features import features_of
from scene2hap.contact.geometry.triangles import meetings
from scene2hap.contact.geometry.vectors import Floats
from scene2hap.contact.mesh_distance import MeshPair
from scene2hap.contact.shape import Shape, shape_of
from scene2hap.scene.pose import Pose
from scene2hap.scene.shapes import Box, TriMesh


def shape(vertices: object, faces: object) -> Shape:
    return shape_of(TriMesh(np.array(vertices, dtype=float), np.array(faces)))


def counts(one: Shape) -> tuple[int, int]:
    """The number of edges and corners that are searched."""
    bits = np.unpackbits(one.features[:, None], axis=1, bitorder="little")
    return int(bits[:, :3].sum()), int(bits[:, 3:6].sum())


def gridded(n: int, height: object = 0.0) -> Shape:
    """A square of 1 m divided into n x n squares, with heights (n + 1, n + 1)."""
    line = np.linspace(0.0, 1.0, n + 1)
    u, v = np.meshgrid(line, line, indexing="ij")
    points = np.stack([u.ravel(), np.broadcast_to(height, u.shape).ravel(), v.ravel()], axis=1)
    cell = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    a, b, c, d = (cell + step for step in (0, n + 1, n + 2, 1))
    return shape(points, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]))


def test_a_box_has_twelve_edges_and_eight_corners() -> None:
    assert counts(shape_of(Box((0.3, 0.2, 0.4)).mesh)) == (12, 8)


def test_triangles_that_share_no_vertex_are_welded_by_place() -> None:
    mesh = Box((0.3, 0.2, 0.4)).mesh
    assert counts(shape(mesh.vertices_m[mesh.faces].reshape(-1, 3), np.arange(36).reshape(12, 3))) == (12, 8)


def test_both_sides_of_a_sheet_count_once() -> None:
    corners = [(0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)]
    assert counts(shape(corners, [(0, 1, 2), (0, 2, 3), (0, 2, 1), (0, 3, 2)])) == (4, 4)


def test_only_the_rim_of_a_flat_grid_is_searched() -> None:
    assert counts(gridded(8)) == (32, 32)


def test_folds_of_any_angle_are_edges() -> None:
    corners = [(0, 0, 0), (1, 0, 0), (0, 0, 1), (1, 0.001, 1)]
    assert counts(shape(corners, [(0, 1, 2), (1, 3, 2)])) == (5, 4)
    back = [(0, 0, 0), (1, 0, 0), (0, 0, 1), (0.2, 0, 0.2)]
    assert counts(shape(back, [(0, 1, 2), (1, 3, 2)])) == (5, 4)


def test_no_edge_of_a_finely_cut_curve_is_flat() -> None:
    """Each edge bends by some 20 nm, but all edges together bend by 0.1 mm."""
    n = 200
    assert counts(gridded(n, 1e-4 * np.linspace(-1, 1, n + 1)[:, None] ** 2)) == (3 * n**2 + 2 * n, (n + 1) ** 2)


def test_strips_between_the_bends_of_a_coarse_curve_are_flat() -> None:
    n = 20
    n_edges, n_corners = counts(gridded(n, 0.1 * np.linspace(-1, 1, n + 1)[:, None] ** 2))
    assert (n_edges, n_corners) == ((n + 1) * n + 2 * n, (n + 1) ** 2)


def test_slender_and_empty_triangles_keep_their_edges() -> None:
    corners = [(0, 0, 0), (1, 0, 0), (2, 0, 0), (1, 0, 1e-7), (1, 0, -1)]
    n_edges, n_corners = counts(shape(corners, [(0, 1, 2), (0, 2, 3), (0, 4, 2)]))
    # The edge from (0, 0, 0) to (2, 0, 0) is shared by three triangles.
    assert (n_edges, n_corners) == (7, 5)


def test_triangles_with_a_corner_twice_add_no_edges() -> None:
    mesh = Box((0.3, 0.2, 0.4)).mesh
    lines = mesh.faces[:, [0, 2, 2]]
    assert counts(shape(mesh.vertices_m, np.concatenate([lines, mesh.faces]))) == (12, 8)


@pytest.mark.parametrize("n", [0, 1])
def test_a_mesh_of_no_triangle_has_no_features_and_a_point_keeps_its_own(n: int) -> None:
    found = features_of(np.zeros((3, 3, n)))
    assert found.tolist() == [0b001_001][:n]


def every_feature(one: Shape) -> Shape:
    """The same triangles with all corners and edges searched."""
    found = Shape(one.triangles, one.corners)
    found.__dict__["features"] = np.full(one.triangles.shape[2], 0b111_111, dtype=np.uint8)
    return found


def prism(n: int) -> Shape:
    """An upright prism whose ends are fans of triangles."""
    angle = 2 * np.pi * np.arange(n) / n
    ring = np.stack([0.2 * np.cos(angle), np.zeros(n), 0.2 * np.sin(angle)], axis=1)
    i, j, k = np.arange(n), (np.arange(n) + 1) % n, np.arange(1, n - 1)
    end = np.stack([0 * k, k, k + 1], 1)
    sides = [np.stack([i, i + n, j], 1), np.stack([j, i + n, j + n], 1)]
    return shape(np.concatenate([ring, ring + np.array([0, 0.1, 0])]), np.concatenate([*sides, end, end[:, ::-1] + n]))


SHAPES = [gridded(6), prism(24), shape_of(Box((0.5, 0.04, 0.3)).mesh), shape_of(Box((0.1, 0.1, 0.1)).mesh)]
PLACES = st.tuples(*[st.sampled_from([-0.3, -0.1, 0.0, 0.04, 0.1, 0.27])] * 3)
TURNS = st.one_of(
    st.sampled_from([(0.0, 0.0, 0.0, 1.0), (0.0, 0.3, 0.0, 1.0)]),
    st.tuples(*[st.floats(-1, 1)] * 4).filter(lambda turn: np.linalg.norm(turn) > 0.1),
)


@given(one=st.sampled_from(SHAPES), other=st.sampled_from(SHAPES), place=PLACES, turn=TURNS)
@settings(max_examples=120)
def test_distance_and_touch_equal_those_of_all_features(
    one: Shape, other: Shape, place: tuple[float, float, float], turn: tuple[float, float, float, float]
) -> None:
    def pair(of: object) -> MeshPair:
        return MeshPair(Body("a", of(one), Pose(), 1), Body("b", of(other), Pose(place, turn), 1))

    few, all_ = pair(lambda x: x), pair(every_feature)
    gap, expected = few.gap(1.0), all_.gap(1.0)
    assert (gap is None) == (expected is None)
    if gap is not None and expected is not None:
        assert gap.distance_m == pytest.approx(expected.distance_m, abs=1e-9)
    assert bool(few.patch((0, 0, 0), 0.001)) == bool(all_.patch((0, 0, 0), 0.001))


def extent(ends: Floats) -> Floats:
    return np.concatenate([ends.min(axis=1), ends.max(axis=1)])


@given(one=st.sampled_from(SHAPES), other=st.sampled_from(SHAPES), place=PLACES, turn=TURNS)
@settings(max_examples=60)
def test_contacts_of_all_features_lie_within_those_of_the_selected_features(
    one: Shape, other: Shape, place: tuple[float, float, float], turn: tuple[float, float, float, float]
) -> None:
    """Where surfaces lie on or cut each other, the outermost contact points are at corners and edges."""
    posed = (Pose(place, turn).rotation @ other.triangles.reshape(3, -1)).reshape(other.triangles.shape)
    posed += np.array(place)[:, None, None]
    i, j = np.divmod(np.arange(one.triangles.shape[2] * posed.shape[2]), posed.shape[2])
    p, q = one.triangles[..., i], posed[..., j]
    everything = np.full(len(i), 0b111_111, dtype=np.uint8)
    found = []
    for of_p, of_q in ((everything, everything), (one.features[i], other.features[j])):
        every = meetings(p, q, of_p, of_q)
        found.append(every.on_p[:, every.distance <= 1e-9])
    wide, near = found
    assert (wide.size > 0) == (near.size > 0)
    if wide.size:
        np.testing.assert_allclose(extent(near), extent(wide), atol=1e-6)
