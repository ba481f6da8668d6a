"""Invariants of the dominant surface for any shape of a kind, at any place and rotation."""

from __future__ import annotations

import numpy as np
import trimesh
from hypothesis import assume, given, settings, strategies as st

from scene2hap.scene.pose import Pose
from scene2hap.scene.shapes import Box, DominantSurface, TriMesh
from scene2hap.scene.surface.dominant_surface import RAYS_PER_SIDE, dominant_surface

common = settings(max_examples=20)
edges = st.floats(0.05, 3.0)
thin = st.floats(0.002, 0.04)
fractions = st.floats(0.0, 1.0)
seeds = st.integers(0, 2**32 - 1)

Size = tuple[float, float, float]


def turned(mesh: TriMesh, seed: int) -> tuple[TriMesh, Pose]:
    """The mesh under a random pose, with rotations drawn uniformly."""
    rng = np.random.default_rng(seed)
    x, y, z, w = rng.normal(size=4)
    pose = Pose(tuple(rng.uniform(-5, 5, size=3)), (x, y, z, w))
    return TriMesh(pose.to_world(mesh.vertices_m), mesh.faces), pose


def boxes(*parts: tuple[Size, Size]) -> TriMesh:
    meshes = [(Box(size).mesh.vertices_m + middle, Box(size).mesh.faces) for size, middle in parts]
    faces = np.concatenate([faces + 8 * i for i, (_, faces) in enumerate(meshes)])
    return TriMesh(np.concatenate([points for points, _ in meshes]), faces)


def size(surface: DominantSurface) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    return np.array([surface.length_m, surface.width_m, surface.thickness_m])


def middle(surface: DominantSurface) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    centre: np.ndarray[tuple[int], np.dtype[np.float64]] = surface.pose.to_world(
        [[surface.length_m / 2, surface.width_m / 2, 0.0]]
    )[0]
    return centre


@given(edges, edges, edges, seeds)
@common
def test_size_of_a_box_is_its_sorted_edges(x: float, y: float, z: float, seed: int) -> None:
    mesh, pose = turned(Box((x, y, z)).mesh, seed)
    surface = dominant_surface(mesh)
    # Faces whose areas differ by less than 1 % count as equal; any of them may be the surface.
    a, b, c = sorted((x, y, z), reverse=True)
    assume(b / c > 1.02 or b / c < 1 + 1e-9)
    np.testing.assert_allclose(size(surface), [a, b, c], atol=1e-9)
    np.testing.assert_allclose(middle(surface), pose.position_m, atol=1e-9)
    assert surface.flags == ()


@given(st.floats(0.5, 3.0), st.floats(0.5, 1.0), thin, st.floats(0.3, 1.0), st.floats(0.02, 0.08), seeds)
@common
def test_surface_of_a_slab_on_legs_is_the_slab(
    length: float, share: float, thickness: float, height: float, leg: float, seed: int
) -> None:
    width = length * share
    assume(height < width)
    corners = [(sx * (length - leg) / 2, sy * (width - leg) / 2) for sx in (-1, 1) for sy in (-1, 1)]
    legs = [((leg, leg, height), (x, y, -height / 2)) for x, y in corners]
    mesh, pose = turned(boxes(((length, width, thickness), (0.0, 0.0, thickness / 2)), *legs), seed)
    surface = dominant_surface(mesh, up=pose.rotation[:, 2])
    np.testing.assert_allclose(size(surface), [length, width, thickness], atol=1e-9)
    np.testing.assert_allclose(middle(surface), pose.to_world([[0.0, 0.0, thickness / 2]])[0], atol=1e-9)
    np.testing.assert_allclose(surface.pose.rotation[:, 2], pose.rotation[:, 2], atol=1e-9)


@given(st.floats(0.3, 2.0), st.floats(0.3, 2.0), st.floats(0.3, 2.0), st.floats(0.002, 0.02), seeds)
@common
def test_thickness_of_a_hollow_box_is_its_wall(x: float, y: float, z: float, wall: float, seed: int) -> None:
    a, b, c = sorted((x, y, z), reverse=True)
    assume(b / c > 1.02)
    outer, inner = Box((x, y, z)).mesh, Box((x - 2 * wall, y - 2 * wall, z - 2 * wall)).mesh
    vertices = np.concatenate((outer.vertices_m, inner.vertices_m))
    mesh, _ = turned(TriMesh(vertices, np.concatenate((outer.faces, inner.faces[:, ::-1] + 8))), seed)
    np.testing.assert_allclose(size(dominant_surface(mesh)), [a, b, wall], atol=1e-9)


@given(st.floats(0.05, 1.0), st.floats(0.02, 0.2), seeds)
@settings(max_examples=8)
def test_size_of_a_bowl_is_its_rim_and_wall_within_a_ray_spacing(radius: float, wall_share: float, seed: int) -> None:
    """Half a sphere with a wall: chords of the rim, and the median over the area of the vertical wall length."""
    inner = radius * (1 - wall_share)
    angle = np.linspace(0, np.pi / 2, 25)
    profile = np.stack((np.sin(angle), -np.cos(angle)), axis=1)
    bowl = trimesh.creation.revolve(np.concatenate((radius * profile, inner * profile[::-1])), sections=64)
    mesh, _ = turned(TriMesh(bowl.vertices, bowl.faces), seed)
    area = radius**2 * (np.arange(5000) + 0.5) / 5000
    wall = np.sqrt(radius**2 - area) - np.sqrt(np.maximum(inner**2 - area, 0.0))
    chord = np.sqrt(3) * radius
    spacing = 2 * radius / RAYS_PER_SIDE
    np.testing.assert_allclose(size(dominant_surface(mesh)), [chord, chord, np.median(wall)], atol=spacing)


@given(edges, edges, seeds)
@common
def test_a_sheet_has_no_thickness(x: float, y: float, seed: int) -> None:
    sheet = TriMesh([[0, 0, 0], [x, 0, 0], [x, y, 0], [0, y, 0]], [[0, 1, 2], [0, 2, 3]])
    mesh, _ = turned(sheet, seed)
    surface = dominant_surface(mesh)
    np.testing.assert_allclose(size(surface), [max(x, y), min(x, y), 0.0], atol=1e-9)
    assert surface.flags == ("open-mesh", "zero-thickness")


@given(st.integers(0, 2**32 - 1), st.integers(1, 40), st.floats(-8, 5))
@settings(max_examples=40)
def test_any_triangles_have_a_surface_inside_their_box(seed: int, n: int, power: float) -> None:
    """Random triangles give a surface without a warning: orthogonal axes, length >= width, within the diagonal."""
    rng = np.random.default_rng(seed)
    vertices = rng.normal(size=(max(3, n), 3)) * 10.0**power * rng.choice([1.0, 1e-9, 0.0], size=3, p=[0.8, 0.1, 0.1])
    mesh = TriMesh(vertices, rng.integers(0, len(vertices), size=(n, 3)))
    surface = dominant_surface(mesh, up=rng.normal(size=3))
    diagonal = float(np.linalg.norm(np.ptp(mesh.bounds_m, axis=0)))
    assert diagonal * (1 + 1e-6) >= surface.length_m >= surface.width_m >= 0.0
    assert 0.0 <= surface.thickness_m <= diagonal * (1 + 1e-6)
    np.testing.assert_allclose(surface.pose.rotation @ surface.pose.rotation.T, np.eye(3), atol=1e-9)


@given(seeds, st.floats(0.01, 100.0))
@settings(max_examples=15)
def test_surface_scales_with_the_object(seed: int, factor: float) -> None:
    rng = np.random.default_rng(seed)
    hull = trimesh.Trimesh(rng.normal(size=(30, 3)) * [1.0, 0.7, 0.2]).convex_hull
    small = dominant_surface(TriMesh(hull.vertices, hull.faces))
    large = dominant_surface(TriMesh(hull.vertices * factor, hull.faces))
    np.testing.assert_allclose(size(large), factor * size(small), rtol=1e-6)
    assert large.flags == small.flags


@given(st.floats(0.6, 1.0), st.floats(0.6, 0.95), st.floats(0.2, 0.3), thin, st.permutations(range(3)), seeds)
@common
def test_a_cabinet_has_one_size_in_every_frame(
    height: float, share: float, depth: float, door: float, order: list[int], seed: int
) -> None:
    """The door, with a gap and a body behind it and a knob on it, not the thinner back panel. Axes are exchanged and
    mirrored."""
    width = height * share
    front = depth / 2 + 0.01 + door
    back = -depth / 2 - 0.01 - door / 4
    assume(width > 1.05 * (front + 0.03 - back))
    mesh = boxes(
        ((width, height, depth), (0.0, 0.0, 0.0)),
        ((width, height, door), (0.0, 0.0, front - door / 2)),
        ((width, height, door / 2), (0.0, 0.0, back)),
        ((width / 9, height / 7, 0.03), (width / 5, 0.1, front + 0.015)),
    )
    mapping = np.eye(3)[order] * np.random.default_rng(seed).choice([-1.0, 1.0], size=3)[:, None]
    faces = mesh.faces if np.linalg.det(mapping) > 0 else mesh.faces[:, ::-1]
    surface = dominant_surface(TriMesh(mesh.vertices_m @ mapping.T, faces), up=mapping[:, 1])
    np.testing.assert_allclose(size(surface), [height, width, door], atol=1e-9)
    np.testing.assert_allclose(middle(surface) @ mapping, [0.0, 0.0, front - door / 2], atol=1e-9)
    np.testing.assert_array_equal(size(surface), size(dominant_surface(mesh, up=(0.0, 1.0, 0.0))))


@given(st.integers(3, 12), st.floats(1.0, 3.0), st.floats(-1e-4, 1e-4), st.floats(-1e-4, 1e-4))
@common
def test_a_trembling_bottle_keeps_its_side(n: int, height: float, x: float, z: float) -> None:
    """Two sides are equal and level but for the tilt, which must not choose between them."""
    angle = np.pi / (2 * n) * np.arange(4 * n)
    around = np.stack((np.cos(angle), np.full(4 * n, height), np.sin(angle)), axis=1)
    bottle = trimesh.convex.convex_hull(np.concatenate((around, around * [1.0, -1.0, 1.0])))
    mesh = TriMesh(bottle.vertices, bottle.faces)
    still, tilted = (dominant_surface(mesh, up=up) for up in ((0.0, 1.0, 0.0), (x, 1.0, z)))
    np.testing.assert_array_equal(tilted.pose.rotation, still.pose.rotation)


@given(st.floats(0.6, 1.0), st.floats(0.6, 0.95), st.floats(0.2, 0.3), thin, seeds)
@common
def test_rounding_does_not_choose_between_equal_front_and_back(
    height: float, share: float, depth: float, door: float, seed: int
) -> None:
    """The back is a little smaller, so that a choice is seen; every triangle is cut at a point inside it."""
    width, at = height * share, depth / 2 + 0.01 + door / 2
    assume(width > 1.05 * (2 * at + door))
    mesh = boxes(
        ((width, height, depth), (0.0, 0.0, 0.0)),
        ((width, height, door), (0.0, 0.0, at)),
        ((0.99 * width, 0.99 * height, door), (0.0, 0.0, -at)),
    )
    n, share_of = len(mesh.vertices_m), np.random.default_rng(seed).dirichlet([3, 3, 3], len(mesh.faces))
    inside = (mesh.vertices_m[mesh.faces] * share_of[..., None]).sum(axis=1)
    rows = n + np.arange(len(mesh.faces))
    pieces = [np.column_stack([mesh.faces[:, k], mesh.faces[:, k - 2], rows]) for k in range(3)]
    cut = TriMesh(np.concatenate([mesh.vertices_m, inside]), np.concatenate(pieces))
    up = (0.0, 1.0, 0.0)
    np.testing.assert_allclose(size(dominant_surface(cut, up=up)), size(dominant_surface(mesh, up=up)), atol=1e-9)
