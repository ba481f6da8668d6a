"""Outlines: coverage, notches, and measurement on meshes."""

import math

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings, strategies as st

from scene2hap import TriMesh
from scene2hap.errors import SceneError
from scene2hap.scene.surface.dominant_surface import dominant_surface
from scene2hap.scene.surface.outline import Outline

SQUARE = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
L = ((0.0, 0.0), (1.0, 0.0), (1.0, 0.4), (0.5, 0.4), (0.5, 1.0), (0.0, 1.0))
HOLE = ((0.1, 0.1), (0.3, 0.1), (0.3, 0.15), (0.1, 0.15))


def test_outline_excludes_its_hole() -> None:
    outline = Outline((L, HOLE))
    assert outline.area_m2 == pytest.approx(0.4 + 0.3 - 0.01, rel=1e-3)
    assert outline.holds(np.array([[0.2, 0.12], [0.2, 0.3], [0.7, 0.7], [0.7, 0.2]])).tolist() == [
        False,
        True,
        False,
        True,
    ]
    assert outline.distance_m(np.array([[0.7, 0.7], [0.2, 0.125], [0.05, 0.9]])) == pytest.approx([0.2, 0.025, 0.0])


def test_moments_of_a_triangle_are_those_of_a_handbook() -> None:
    a, b = 1.2, 0.6
    middle, products = Outline((((0.0, 0.0), (a, 0.0), (0.0, b)),)).moments
    assert middle == pytest.approx([a / 3, b / 3], rel=1e-3)
    np.testing.assert_allclose(products, [[a**2 / 18, -a * b / 36], [-a * b / 36, b**2 / 18]], rtol=1e-3)


@settings(max_examples=50)
@given(st.lists(st.floats(0.2, 1.0), min_size=3, max_size=12), st.integers(1, 40), st.integers(1, 40), st.booleans())
def test_pixel_coverage_sums_to_the_area(radii: list[float], nx: int, ny: int, backwards: bool) -> None:
    """Any star, grid of pixels and direction of the outline, against the shoelace formula."""
    turn = np.arange(len(radii)) * 2 * math.pi / len(radii)
    star = np.array(radii)[:, None] * np.column_stack([np.cos(turn), np.sin(turn)])
    outline = Outline(((star[::-1] if backwards else star).tolist(),))
    x0, y0, x1, y1 = outline.box_m
    shares, _ = outline.covered(np.linspace(x0, x1, nx + 1), np.linspace(y0, y1, ny + 1))
    assert ((shares >= 0) & (shares <= 1)).all()
    area = abs(float(star[:, 0] @ np.roll(star[:, 1], -1) - star[:, 1] @ np.roll(star[:, 0], -1))) / 2
    found = shares.sum() * (x1 - x0) * (y1 - y0) / (nx * ny)
    assert found == pytest.approx(area, abs=(x1 - x0) * (y1 - y0) / (8 * ny))


def test_centroids_of_pixels_are_those_of_the_covered_parts() -> None:
    """A triangle over four pixels, against the shoelace formula for each part."""
    outline = Outline((((0.0, 0.0), (2.0, 0.0), (0.0, 2.0)),))
    lines = np.array([0.0, 1.0, 2.0])
    shares, off = outline.covered(lines, lines)
    np.testing.assert_allclose(shares, [[1.0, 0.5], [0.5, 0.0]])
    np.testing.assert_allclose(off[:, 0, 0], 0.0, atol=1e-12)
    np.testing.assert_allclose(off[:, 0, 1], -1 / 6, atol=0.02)
    np.testing.assert_allclose(off[:, 1, 0], -1 / 6, atol=0.02)
    np.testing.assert_array_equal(off[:, 1, 1], 0.0)


@settings(max_examples=50)
@given(st.lists(st.floats(0.2, 1.0), min_size=3, max_size=12), st.integers(20, 40), st.booleans())
def test_pixels_keep_the_centroid_of_the_area(radii: list[float], n: int, backwards: bool) -> None:
    turn = np.arange(len(radii)) * 2 * math.pi / len(radii)
    star = np.array(radii)[:, None] * np.column_stack([np.cos(turn), np.sin(turn)])
    outline = Outline(((star[::-1] if backwards else star).tolist(),))
    x0, y0, x1, y1 = outline.box_m
    x, y = np.linspace(x0, x1, n + 1), np.linspace(y0, y1, n + 1)
    shares, off = outline.covered(x, y)
    assert np.abs(off).max() <= 0.5
    middle = np.stack(np.meshgrid((x[1:] + x[:-1]) / 2, (y[1:] + y[:-1]) / 2, indexing="ij"))
    side = np.array([x[1] - x[0], y[1] - y[0]])[:, None, None]
    found = ((middle + off * side) * shares).sum(axis=(1, 2)) / shares.sum()
    other = np.roll(star, -1, axis=0)
    cross = star[:, 0] * other[:, 1] - other[:, 0] * star[:, 1]
    centroid = ((star + other) * cross[:, None]).sum(axis=0) / (3 * cross.sum())
    np.testing.assert_allclose(found, centroid, atol=2 / n**2)


def test_notches_are_corners_that_point_inwards() -> None:
    assert Outline((SQUARE,)).notches_m.shape == (0, 2)
    assert Outline((L,)).notches_m.tolist() == [[0.5, 0.4]]
    assert Outline((L[::-1],)).notches_m.tolist() == [[0.5, 0.4]]
    assert len(Outline((SQUARE, HOLE)).notches_m) == 4
    turn = np.arange(64) * 2 * math.pi / 64
    ring = np.column_stack([np.cos(turn), np.sin(turn)])
    assert len(Outline((ring.tolist(), (0.5 * ring).tolist())).notches_m) == 0  # curves have no notches


def test_corners_of_a_curve_do_not_depend_on_where_its_ring_begins() -> None:
    """A square with half a disc cut out of one side."""
    turn = np.linspace(np.pi, 0.0, 13)
    bite = np.column_stack([0.5 + 0.2 * np.cos(turn), 0.2 * np.sin(turn)])
    ring = np.concatenate([bite, [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.0, 0.0)]])
    inward = {tuple(corner) for corner in bite[1:-1].tolist()}
    for start in range(len(ring)):
        corners, radii_m = Outline((np.roll(ring, start, axis=0),)).inward
        assert {tuple(corner) for corner in corners.tolist()} == inward
        assert radii_m == pytest.approx(0.2, rel=0.02)


@pytest.mark.parametrize("angle_rad", [-0.7, 0.0, 0.3])
def test_slant_is_that_of_the_sides_of_notches(angle_rad: float) -> None:
    assert Outline((SQUARE,)).turned(angle_rad)[0].slant_rad == 0.0
    assert Outline((L,)).turned(angle_rad)[0].slant_rad == pytest.approx(angle_rad)


@pytest.mark.parametrize(
    ("rings", "words"),
    [
        ((), "has 0 corners; it must have 3"),
        ((SQUARE[:2],), "ring 0 .* at least 3 corners"),
        ((((0, 0), (1, 0), (2, 0)),), "must have an area"),
        ((SQUARE, SQUARE), "covers 0 m2 of 1 × 1 m; it must have an area"),
        ((((0, 0), (1, 0), (math.nan, 1)),), "finite"),
        (("round",), "ring 0"),
    ],
)
def test_invalid_outlines_are_refused(rings: object, words: str) -> None:
    with pytest.raises(SceneError, match=words):
        Outline(rings)


def mesh_of(mesh: trimesh.Trimesh) -> TriMesh:
    return TriMesh(mesh.vertices, mesh.faces)


def test_round_table_top_has_a_round_outline() -> None:
    top = trimesh.creation.cylinder(radius=0.45, height=0.03, sections=48)
    top.apply_translation((0.1, -0.2, 0.7))
    leg = trimesh.creation.cylinder(radius=0.04, height=0.66, sections=12)
    leg.apply_translation((0.1, -0.2, 0.355))
    surface = dominant_surface(mesh_of(trimesh.util.concatenate([top, leg])), up=(0.0, 0.0, 1.0))
    outline = surface.outline
    assert outline is not None
    assert outline.area_m2 == pytest.approx(math.pi * 0.45**2, rel=0.02)
    x0, y0, x1, y1 = outline.box_m
    middle = surface.pose.to_world(np.array([[(x0 + x1) / 2, (y0 + y1) / 2, 0.0]]))[0]
    assert middle == pytest.approx((0.1, -0.2, 0.7), abs=2e-3)
    assert (x1 - x0, y1 - y0) == pytest.approx((0.9, 0.9), rel=0.01)


def test_a_narrow_l_keeps_its_outline() -> None:
    # A worktop of 60 cm along two walls fills 44 % of its box.
    ring = np.array([(0, 0), (3, 0), (3, 0.6), (0.6, 0.6), (0.6, 2), (0, 2)])
    cap = np.array([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)])
    lower, upper = np.insert(ring, 2, 0.0, axis=1), np.insert(ring, 2, 0.04, axis=1)
    sides = [face for i in range(6) for j in [(i + 1) % 6] for face in ((i, j, 6 + j), (i, 6 + j, 6 + i))]
    surface = dominant_surface(TriMesh(np.concatenate([lower, upper]), np.concatenate([cap[:, ::-1], cap + 6, sides])))
    assert surface.outline is not None
    assert surface.outline.area_m2 == pytest.approx(2.64, rel=2e-3)


def test_l_shape_keeps_its_outline_in_any_pose() -> None:
    slabs = [trimesh.creation.box((1.6, 0.6, 0.03)), trimesh.creation.box((0.6, 1.0, 0.03))]
    slabs[1].apply_translation((-0.5, 0.8, 0.0))
    # Two slabs that share an inner face have no closed outline ring, so a single L is built.
    ring = np.array([(-0.8, -0.3), (0.8, -0.3), (0.8, 0.3), (-0.2, 0.3), (-0.2, 1.3), (-0.8, 1.3)])
    faces = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)]
    vertices = np.concatenate([np.column_stack([ring, np.full(6, z)]) for z in (-0.015, 0.015)])
    sides = [tri for k in range(6) for tri in ((k, (k + 1) % 6, k + 6), ((k + 1) % 6, (k + 1) % 6 + 6, k + 6))]
    caps = [(c, b, a) for a, b, c in faces] + [(a + 6, b + 6, c + 6) for a, b, c in faces]
    for angle in (0.0, 0.7):
        turn = trimesh.transformations.rotation_matrix(angle, (0, 0, 1))[:3, :3]
        surface = dominant_surface(TriMesh(vertices @ turn.T, np.array(sides + caps)), up=(0.0, 0.0, 1.0))
        assert surface.outline is not None
        assert surface.outline.area_m2 == pytest.approx(1.6 * 0.6 + 0.6, rel=5e-3)
        (x, y), *more = surface.outline.notches_m
        assert not more
        at = surface.pose.to_world(np.array([[x, y, 0.0]]))[0]
        assert at == pytest.approx(turn @ (-0.2, 0.3, 0.0), abs=3e-3)
    assert dominant_surface(mesh_of(slabs[0]), up=(0.0, 0.0, 1.0)).outline is None


def test_outline_contains_holes_but_not_inner_hollows() -> None:
    """Two slabs with equal outer outlines: one has a hole, the other an inner hollow that is not visible from above."""
    turn = np.arange(24) * 2 * math.pi / 24
    outer = 0.5 * np.column_stack([np.cos(turn), np.sin(turn)])

    def shell(ring: np.ndarray, low: float, high: float, *, inside_out: bool, caps: bool) -> trimesh.Trimesh:
        n = len(ring)
        vertices = np.concatenate([np.column_stack([ring, np.full(n, z)]) for z in (low, high)])
        faces = [f for k in range(n) for f in ((k, (k + 1) % n, k + n), ((k + 1) % n, (k + 1) % n + n, k + n))]
        if caps:
            faces += [(0, k + 1, k) for k in range(1, n - 1)] + [(n, n + k, n + k + 1) for k in range(1, n - 1)]
        mesh = trimesh.Trimesh(vertices, faces, process=False)
        if inside_out:
            mesh.invert()
        return mesh

    def ring_cap(z: float, *, up: bool) -> trimesh.Trimesh:
        vertices = np.column_stack([np.concatenate([outer, 0.6 * outer]), np.full(48, z)])
        quads = [(k, (k + 1) % 24, 24 + (k + 1) % 24, 24 + k) for k in range(24)]
        faces = [f for a, b, c, d in quads for f in ((a, b, c), (a, c, d))]
        mesh = trimesh.Trimesh(vertices, faces, process=False)
        if not up:
            mesh.invert()
        return mesh

    sides = shell(outer, -0.05, 0.05, inside_out=False, caps=False)
    bore = shell(0.6 * outer, -0.05, 0.05, inside_out=True, caps=False)
    pierced = trimesh.util.concatenate([sides, bore, ring_cap(0.05, up=True), ring_cap(-0.05, up=False)])
    hollow = trimesh.util.concatenate(
        [
            shell(outer, -0.05, 0.05, inside_out=False, caps=True),
            shell(0.6 * outer, -0.03, 0.03, inside_out=True, caps=True),
        ]
    )
    areas = []
    for mesh in (pierced, hollow):
        outline = dominant_surface(mesh_of(mesh), up=(0.0, 0.0, 1.0)).outline
        areas.append(0.0 if outline is None else outline.area_m2)
    disc = 12 * 0.25 * math.sin(2 * math.pi / 24)
    assert areas[0] == pytest.approx(disc * (1 - 0.36), rel=0.02)
    assert areas[1] in (0.0, pytest.approx(disc, rel=0.02))


@pytest.mark.parametrize("shape", ["box", "ball", "sheet"])
def test_box_ball_and_sheet_have_no_outline(shape: str) -> None:
    meshes = {
        "box": trimesh.creation.box((1.0, 0.6, 0.03)).subdivide(),
        "ball": trimesh.creation.icosphere(radius=0.2),
        "sheet": trimesh.Trimesh([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 3)]),
    }
    assert dominant_surface(mesh_of(meshes[shape]), up=(0.0, 0.0, 1.0)).outline is None
