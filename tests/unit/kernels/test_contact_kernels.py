"""Kernels of `contact`: each compiled kernel gives the results of its plain twin."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from kernels import both, seeds, steady
from scene2hap.contact.body import Body, Stance
from scene2hap.contact.certificate import SupportFace
from scene2hap.contact.geometry.vectors import upright_frame
from scene2hap.contact.mesh_distance import ROUNDING_M, MeshPair
from scene2hap.contact.shape import shape_of
from scene2hap.scene.pose import Pose
from scene2hap.scene.shapes import Box, TriMesh


def turned(rng: np.random.Generator, up_axis: int) -> tuple[float, float, float, float]:
    """A rotation about the vertical, sometimes with a small tilt."""
    angle, tilt = rng.uniform(0, 2 * math.pi), rng.choice([0.0, 0.0, 1e-7, 0.3])
    axis = np.where(np.arange(3) == up_axis, 1.0, tilt)
    x, y, z = (axis / np.linalg.norm(axis) * math.sin(angle / 2)).tolist()
    return (x, y, z, math.cos(angle / 2))


@pytest.mark.parametrize("stands", [True, False])
@pytest.mark.parametrize("up_axis", [1, 2])
def test_kernels_track_moves_bit_for_bit(up_axis: int, stands: bool) -> None:
    kinds, box, n_within = both("contact.certificate.Track"), Box((0.3, 0.2, 0.1)).mesh, 0
    for seed in range(150):
        rng = np.random.default_rng(seed)
        shape = shape_of(TriMesh(box.vertices_m + rng.uniform(-0.1, 0.1, 3), box.faces))
        first = turned(rng, up_axis)
        stance = Stance(shape, first, up_axis)
        edges = [(1.0, 0.0, -0.8), (-0.6, 0.8, -0.9), (0.0, -1.0, -0.7)][: int(rng.integers(0, 4))]
        standing = SupportFace(edges, stance.low[up_axis] - 0.01, -0.03, 0.06, -0.5) if stands else None
        walls = [(math.cos(a), math.sin(a), 0.7, bool(a > 3)) for a in rng.uniform(0, 6, int(rng.integers(4)))]
        tracks = [kind(stance, standing) for kind in kinds]
        for k in range(8):
            for track in tracks if k % 3 == 0 else ():
                track.keep_in((-1.0, -1.0, 1.0, 1.0), (-0.6, 0.6), walls[k // 3 :])
            position = rng.uniform(-0.7, 0.7, 2).tolist()
            position.insert(up_axis, float(rng.choice([0.0, 0.01, 0.4])))
            rotation = first if rng.random() < 0.3 else turned(rng, up_axis)
            plain, compiled = (track.moved(tuple(position), rotation) for track in tracks)
            assert compiled == plain
            n_within += plain is not None
    assert n_within > 40


def mesh(rng: np.random.Generator) -> TriMesh:
    """A box, random triangles, such triangles on a coarse grid (many parallel, touching or degenerate), or a floor."""
    kind, n = rng.integers(4), int(rng.integers(1, 60))
    if kind == 0:
        return Box(tuple(rng.choice([0.1, 0.2, 0.3], 3).tolist())).mesh
    if kind < 3:
        corners = rng.uniform(-0.3, 0.3, (3 * n, 3)) if kind == 1 else 0.1 * rng.integers(-2, 3, (3 * n, 3))
        return TriMesh(corners, np.arange(3 * n).reshape(n, 3))
    k = int(rng.integers(1, 12)) if rng.random() < 0.9 else 30
    u, v = (axis.ravel() for axis in np.meshgrid(*[np.linspace(-0.3, 0.3, k + 1)] * 2, indexing="ij"))
    heights = np.round(rng.uniform(0, 0.05, u.size), 2) * rng.integers(0, 2)
    c = (np.arange(k)[:, None] * (k + 1) + np.arange(k)).ravel()
    faces = np.concatenate([np.stack([c, c + 1, c + k + 2], 1), np.stack([c, c + k + 2, c + k + 1], 1)])
    return TriMesh(np.stack([u, heights, v], axis=1), faces)


def mesh_pair(rng: np.random.Generator) -> MeshPair:
    posed = []
    for name in "ab":
        turn = rng.normal(size=4) if rng.random() < 0.5 else np.array([0.0, 0.0, 0.0, 1.0])
        place = np.round(rng.uniform(-0.4, 0.4, 3), int(rng.choice([1, 9])))
        posed.append(Body(name, shape_of(mesh(rng)), Pose(tuple(place.tolist()), tuple(turn.tolist())), 1))
    return MeshPair(*posed)


@settings(max_examples=20)  # of eight pairs each
@given(seed=seeds)
def test_kernels_find_mesh_distances_bit_for_bit(seed: int) -> None:
    for k in range(8):
        rng = np.random.default_rng((seed, k))
        pair = mesh_pair(rng)
        given = (pair.host.shape, pair.guest.shape, pair._turn, pair._shift)
        within_m = float(rng.choice([1e-9, 0.004, 0.05, 0.5]))
        with np.errstate(invalid="ignore", divide="ignore"):
            plain, twin = both("contact.mesh_distance.closest_points")
            told, compiled = plain(*given, within_m), twin(*given, within_m)
            # For surfaces that cut each other, any pair of points is valid.
            assert compiled == told or (told[0] <= ROUNDING_M and compiled[0] <= ROUNDING_M)
            plain, twin = both("contact.mesh_distance.contact_points")
            way = tuple(rng.uniform(-0.05, 0.05, 3).tolist()) if rng.random() < 0.5 else (0.0, 0.0, 0.0)
            args = (*given, way, min(within_m, 0.05), (pair._rows, pair.host.position_m))
            assert twin(*args) == plain(*args)
            plain, twin = both("contact.mesh_distance.drops")
            limits = (float(rng.uniform(-0.4, 0.4)), float(rng.choice([0.01, 0.09])), 0.004)
            args = (*given, upright_frame(pair.host.stance.rows[1]), limits, bool(rng.integers(2)))
            told, compiled = plain(*args), twin(*args)
            assert (told is None) == (compiled is None)
            if told is not None:
                np.testing.assert_array_equal(compiled, told)
            plain, twin = both("contact.mesh_distance.first_drop")
            assert twin(*args) == plain(*args) == (math.inf if told is None else told.min())


@steady
@given(seed=seeds)
def test_kernels_find_the_same_triangles_in_a_box(seed: int) -> None:
    rng = np.random.default_rng(seed)
    tree = shape_of(mesh(rng)).tree
    plain, twin = both("contact.geometry.triangle_tree.meeting")
    for _ in range(8):
        low = np.round(rng.uniform(-0.4, 0.4, 3), int(rng.choice([1, 9])))
        high = low + rng.choice([0.0, 0.1, 0.5])
        every = plain(tree, tuple(low.tolist()), tuple(high.tolist()), 1000)
        np.testing.assert_array_equal(twin(tree, tuple(low.tolist()), tuple(high.tolist()), 1000), every)
        # With more triangles than the limit, any subset is valid.
        some = twin(tree, tuple(low.tolist()), tuple(high.tolist()), 2)
        assert len(some) == min(2, len(every))
        assert set(some) <= set(every)


@steady
@given(seed=seeds)
def test_kernels_find_the_same_rectangles_covered_by_a_ledge(seed: int) -> None:
    rng = np.random.default_rng(seed)
    plain, twin = both("contact.ledge.covers")
    k, n = int(rng.integers(0, 6)), int(rng.integers(0, 9))
    triangles = np.round(rng.uniform(-0.5, 0.5, (k, 3, 2)), 1) if k else np.empty((0, 3, 2))
    rims = np.round(rng.uniform(-0.5, 0.5, (n, 2, 2)), 1)
    for _ in range(20):
        u, v = np.round(rng.uniform(-0.5, 0.5, 2), 1).tolist()
        a, b = rng.choice([0.0, 0.05, 0.1], 2).tolist()
        assert twin(triangles, rims, (u, v, u + a, v + b)) == plain(triangles, rims, (u, v, u + a, v + b))


@steady
@given(seed=seeds)
def test_kernels_intersect_outlines_bit_for_bit(seed: int) -> None:
    rng = np.random.default_rng(seed)
    outlines = []
    for n in rng.choice([1, 2, 3, 4, 5, 60], 2):
        angles = np.sort(rng.uniform(0, 2 * math.pi, int(n)))
        ring = np.stack([np.cos(angles), rng.uniform(size=int(n)), np.sin(angles)], axis=1) + rng.choice([0.0, 0.5], 3)
        rows = Stance(shape_of(Box((0.1, 0.1, 0.1)).mesh), turned(rng, 1), 1).rows
        plain, twin = both("contact.geometry.level_plane.turned_outline")
        outline = plain(ring.tolist(), rows[0], rows[2])
        assert twin(ring.tolist(), rows[0], rows[2]) == outline
        outlines.append(outline)
    plain, twin = both("contact.geometry.level_plane.edges_of")
    edges = plain(outlines[1])
    assert twin(outlines[1]) == edges
    for move in ((0.0, 0.0), tuple(rng.uniform(-1, 1, 2).tolist())):
        plain, twin = both("contact.geometry.level_plane.inside_edges")
        assert twin(outlines[0], *move, edges) == plain(outlines[0], *move, edges)
        plain, twin = both("contact.geometry.level_plane.clipped")
        for slack_m in (0.0, 0.001, 0.3):
            assert twin(outlines[0], *move, edges, slack_m) == plain(outlines[0], *move, edges, slack_m)


@steady
@given(seed=seeds, n=st.integers(1, 60), n_axes=st.integers(2, 3))
def test_kernels_select_the_same_contact_points(seed: int, n: int, n_axes: int) -> None:
    # On a grid many distances are equal; some points are closer than the resolution, or differ by a rounding error.
    rng = np.random.default_rng(seed)
    places = rng.integers(0, 3, (n, n_axes)) * rng.choice([0.1, 0.003, 1e-7]) + rng.choice([0.0, 1e-12, 0.01], (n, 1))
    points = [tuple(place) for place in places.tolist()]
    plain, twin = both("contact.geometry.spread.spread")
    assert twin(points) == plain(points)
    assert twin(points, points[0]) == plain(points, points[0])
