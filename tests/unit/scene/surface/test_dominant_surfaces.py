"""The dominant surface of shapes whose sizes are known by construction."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray

from scene2hap.scene.pose import Pose
from scene2hap.scene.shapes import Box, DominantSurface, TriMesh
from scene2hap.scene.surface.dominant_surface import dominant_surface

Size = tuple[float, float, float]


def boxes(*parts: tuple[Size, Size]) -> TriMesh:
    """One mesh of cuboids, each (size, centre)."""
    meshes = [(Box(size).mesh.vertices_m + middle, Box(size).mesh.faces) for size, middle in parts]
    vertices = np.concatenate([points for points, _ in meshes])
    return TriMesh(vertices, np.concatenate([faces + 8 * i for i, (_, faces) in enumerate(meshes)]))


def turned(mesh: TriMesh, pose: Pose) -> TriMesh:
    return TriMesh(pose.to_world(mesh.vertices_m), mesh.faces)


def size(surface: DominantSurface) -> list[float]:
    return [surface.length_m, surface.width_m, surface.thickness_m]


def middle(surface: DominantSurface) -> NDArray[np.float64]:
    """The centre of the surface, in the mesh's frame."""
    centre: NDArray[np.float64] = surface.pose.to_world([[surface.length_m / 2, surface.width_m / 2, 0.0]])[0]
    return centre


LEGS = tuple(((0.05, 0.05, 0.7), (x, y, 0.35)) for x in (-0.7, 0.7) for y in (-0.35, 0.35))
TABLE = boxes(((1.6, 0.8, 0.04), (0.0, 0.0, 0.72)), *LEGS)
# The inner cuboid faces inwards, so that the space between both cuboids is a wall.
_inner = Box((0.56, 0.46, 1.76)).mesh
_outer = Box((0.6, 0.5, 1.8)).mesh
HOLLOW = TriMesh(
    np.vstack((_outer.vertices_m, _inner.vertices_m)), np.vstack((_outer.faces, _inner.faces[:, ::-1] + 8))
)
SHEET = TriMesh([[0, 0, 0], [4, 0, 0], [4, 5, 0], [0, 5, 0]], [[0, 1, 2], [0, 2, 3]])
TURN = Pose((3.0, -2.0, 1.0), (0.1, 0.3, -0.2, 0.9))


@pytest.mark.parametrize(
    ("mesh", "expected"),
    [
        (boxes(((0.6, 1.8, 0.5), (1.0, 2.0, 3.0))), [1.8, 0.6, 0.5]),
        (TABLE, [1.6, 0.8, 0.04]),
        (HOLLOW, [1.8, 0.6, 0.02]),
        (SHEET, [5.0, 4.0, 0.0]),
        (boxes(((2.0, 0.9, 0.04), (0.0, 0.0, 0.0)), ((0.12, 0.03, 0.06), (0.8, 0.0, 0.05))), [2.0, 0.9, 0.04]),
        (boxes(((1.0, 0.4, 0.02), (0, 0, 1.5)), ((1.0, 0.4, 0.03), (0, 0, 0.5))), [1.0, 0.4, 0.02]),
    ],
    ids=["box", "table", "hollow", "sheet", "door with a knob", "shelf of two boards"],
)
@pytest.mark.parametrize("pose", [Pose(), TURN], ids=["straight", "turned"])
def test_shapes_made_of_planes_are_exact(mesh: TriMesh, expected: list[float], pose: Pose) -> None:
    assert size(dominant_surface(turned(mesh, pose), up=pose.rotation[:, 2])) == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("pose", [Pose(), TURN], ids=["straight", "turned"])
def test_dominant_surface_of_a_table_is_its_top(pose: Pose) -> None:
    surface = dominant_surface(turned(TABLE, pose), up=pose.rotation[:, 2])
    np.testing.assert_allclose(middle(surface), pose.to_world([[0.0, 0.0, 0.72]])[0], atol=1e-9)
    np.testing.assert_allclose(surface.pose.rotation[:, 2], pose.rotation[:, 2], atol=1e-9)
    assert abs(surface.pose.rotation[:, 0] @ pose.rotation[:, 0]) == pytest.approx(1.0)
    assert np.linalg.det(surface.pose.rotation) == pytest.approx(1.0)


def test_surface_pose_gives_plate_coordinates() -> None:
    surface = dominant_surface(TABLE)
    x, y, z = surface.pose.to_own([[0.3, 0.1, 0.72]])[0]
    assert 0 <= x <= surface.length_m
    assert 0 <= y <= surface.width_m
    assert z == pytest.approx(0.0, abs=1e-12)
    assert {round(x, 9), round(1.6 - x, 9)} == {1.1, 0.5}


def test_up_direction_decides_which_board_is_measured() -> None:
    """A rack of two boards is measured from above, for any up direction."""
    rack = boxes(((1.0, 0.4, 0.02), (0, 0, 1.5)), ((1.0, 0.4, 0.05), (0, 0, 0.5)))
    assert dominant_surface(rack, up=(0, 0, 1)).thickness_m == pytest.approx(0.02)
    assert dominant_surface(rack, up=(0, 0, -1)).thickness_m == pytest.approx(0.05)


def test_upright_normal_is_preferred_among_equal_sides() -> None:
    cube = boxes(((1.0, 1.0, 1.0), (0.0, 0.0, 0.0)))
    for up in np.eye(3):
        np.testing.assert_allclose(dominant_surface(cube, up=up).pose.rotation[:, 2], up, atol=1e-12)


SEAT = ((0.4, 0.4, 0.04), (0.0, 0.0, 0.46))
CHAIR = (
    SEAT,
    *(((0.06, 0.06, 0.44), (x, y, 0.22)) for x in (-0.17, 0.17) for y in (-0.17, 0.17)),
    *(((0.06, 0.06, 0.44), (x, 0.17, 0.70)) for x in (-0.17, 0.17)),
    *(((0.28, 0.03, 0.08), (0.0, 0.17, z)) for z in (0.58, 0.72, 0.86)),
    *(((0.28, 0.02, 0.04), (0.0, y, 0.15)) for y in (-0.17, 0.17)),
)


@pytest.mark.parametrize("pose", [Pose(), Pose((0.0, 0.0, 0.0), (0.0, 0.0, np.sin(0.3), np.cos(0.3)))])
def test_dominant_surface_of_a_chair_is_its_seat(pose: Pose) -> None:
    chair = turned(boxes(*CHAIR), pose)
    assert size(dominant_surface(chair, up=(0, 0, 1))) == pytest.approx(list(SEAT[0]), rel=0.01)


def test_dominant_surface_works_without_an_up_direction() -> None:
    assert dominant_surface(boxes(*CHAIR)).length_m > 0.5


SIDES = tuple(((0.02, 0.6, 0.9), (x, 0.0, 0.45)) for x in (-0.34, 0.34))
BOARDS = tuple(((0.66, 0.6, 0.02), (0.0, 0.0, z)) for z in (0.01, 0.89))


def test_dominant_surface_of_a_cupboard_is_its_back() -> None:
    cupboard = boxes(*SIDES, *BOARDS, ((0.7, 0.02, 0.9), (0.0, 0.31, 0.45)))
    assert size(dominant_surface(cupboard, up=(0, 0, 1))) == pytest.approx([0.9, 0.7, 0.02])


def test_dominant_surface_of_a_bin_is_a_wall() -> None:
    walls = [((0.006, 0.3, 0.4), (x, 0.0, 0.2)) for x in (-0.147, 0.147)]
    walls += [((0.288, 0.006, 0.4), (0.0, y, 0.2)) for y in (-0.147, 0.147)]
    bin_ = boxes(*walls, ((0.288, 0.288, 0.006), (0.0, 0.0, 0.003)))
    assert dominant_surface(bin_, up=(0, 0, 1)).length_m == pytest.approx(0.4)


def test_legs_that_reach_into_the_top_do_not_thicken_it() -> None:
    stuck = boxes(((1.6, 0.8, 0.04), (0.0, 0.0, 0.72)), ((1.2, 0.7, 0.03), (0.0, 0.0, 0.725)), *LEGS)
    assert dominant_surface(stuck).thickness_m == pytest.approx(0.04)


def test_size_of_a_disc_is_its_median_chord() -> None:
    """Half of all chords of a circle are longer than sqrt(3) R."""
    disc = trimesh.creation.cylinder(0.5, 0.03, sections=256)
    surface = dominant_surface(TriMesh(disc.vertices, disc.faces))
    assert surface.length_m == pytest.approx(np.sqrt(3) * 0.5, abs=1.0 / 32)
    assert surface.width_m == pytest.approx(np.sqrt(3) * 0.5, abs=1.0 / 32)
    assert surface.thickness_m == pytest.approx(0.03)


def test_size_of_a_bowl_is_its_rim_chord_and_wall_thickness() -> None:
    """Half a sphere of radius R with a wall of R - r, seen from above. The thickness is the median over the disc of the
    vertical wall length, computed here from evenly spread points."""
    big, small = 0.10, 0.09
    angle = np.linspace(0, np.pi / 2, 40)
    profile = np.vstack(
        (
            np.stack((big * np.sin(angle), -big * np.cos(angle)), axis=1),
            np.stack((small * np.sin(angle), -small * np.cos(angle)), axis=1)[::-1],
        )
    )
    bowl = trimesh.creation.revolve(profile, sections=96)
    surface = dominant_surface(TriMesh(bowl.vertices, bowl.faces))
    radius_2 = big**2 * (np.arange(10_000) + 0.5) / 10_000
    wall = np.sqrt(big**2 - radius_2) - np.sqrt(np.maximum(small**2 - radius_2, 0.0))
    assert surface.thickness_m == pytest.approx(np.median(wall), abs=2 * big / 32)
    assert surface.length_m == pytest.approx(np.sqrt(3) * big, abs=2 * big / 32)
    assert surface.width_m == pytest.approx(np.sqrt(3) * big, abs=2 * big / 32)
    assert surface.flags == ()


@pytest.mark.parametrize(
    ("mesh", "flags"),
    [
        (TABLE, ()),
        (SHEET, ("open-mesh", "zero-thickness")),
        (TriMesh(SHEET.vertices_m, [*SHEET.faces, *SHEET.faces[:, ::-1]]), ("open-mesh", "zero-thickness")),
        (TriMesh(_outer.vertices_m, _outer.faces[2:]), ("open-mesh",)),
        (
            TriMesh([[0, 0, 0], [4, 0, 1], [4, 5, 0], [0, 5, 0]], SHEET.faces),
            ("open-mesh", "box-fallback"),
        ),
        (TriMesh([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]]), ("box-fallback", "zero-thickness")),
    ],
    ids=["closed", "one-sided sheet", "two-sided sheet", "box without a side", "bent sheet", "needle"],
)
def test_flags_mark_doubtful_surfaces(mesh: TriMesh, flags: tuple[str, ...]) -> None:
    assert dominant_surface(mesh).flags == flags


def test_box_without_a_bottom_has_its_height_as_thickness() -> None:
    """A worktop of five faces: no ray from above meets the mesh twice."""
    outer = Box((3.0, 0.6, 0.04)).mesh
    faces = [face for face in outer.faces if not np.allclose(outer.vertices_m[face, 2], -0.02)]
    surface = dominant_surface(TriMesh(outer.vertices_m, faces))
    assert size(surface) == pytest.approx([3.0, 0.6, 0.04])
    assert surface.flags == ("open-mesh", "box-fallback")


def open_crate(edges: Size, missing: Size) -> TriMesh:
    """A box of five sheets: without the side that faces `missing`."""
    box = Box(edges).mesh
    normals = np.cross(*(box.vertices_m[box.faces[:, k]] - box.vertices_m[box.faces[:, 0]] for k in (1, 2)))
    return TriMesh(box.vertices_m, box.faces[normals @ np.array(missing) <= 0])


def bowl_of_one_sheet(radius: float) -> TriMesh:
    ball = trimesh.creation.icosphere(subdivisions=3, radius=radius)
    return TriMesh(ball.vertices, ball.faces[ball.triangles_center[:, 2] < 0])


@pytest.mark.parametrize("pose", [Pose(), TURN], ids=["straight", "turned"])
@pytest.mark.parametrize("is_inside_out", [False, True])
@pytest.mark.parametrize(
    ("mesh", "plate", "height"),
    [
        (open_crate((0.4, 0.3, 0.25), (0, 0, 1)), [0.4, 0.3], -0.125),
        (open_crate((0.4, 0.3, 0.03), (0, 0, 1)), [0.4, 0.3], -0.015),
        (open_crate((0.25, 0.24, 0.6), (0, 0, 1)), [0.6, 0.25], None),
    ],
    ids=["crate", "tray", "tall bin"],
)
def test_a_container_of_one_sheet_has_no_thickness(
    mesh: TriMesh, plate: list[float], height: float | None, is_inside_out: bool, pose: Pose
) -> None:
    mesh = TriMesh(mesh.vertices_m, mesh.faces[:, ::-1]) if is_inside_out else mesh
    surface = dominant_surface(turned(mesh, pose), up=pose.rotation[:, 2])
    assert size(surface) == pytest.approx([*plate, 0.0], abs=1e-9)
    assert surface.flags == ("open-mesh", "zero-thickness")
    if height is not None:
        assert pose.to_own([middle(surface)])[0] == pytest.approx([0.0, 0.0, height], abs=1e-9)


def test_a_bowl_of_one_sheet_has_no_thickness_and_a_cover_has_its_height() -> None:
    bowl = bowl_of_one_sheet(0.1)
    assert dominant_surface(bowl, up=(0, 0, 1)).thickness_m == 0.0
    cover = dominant_surface(bowl, up=(0, 0, -1))
    assert cover.thickness_m == pytest.approx(0.1, rel=0.05)
    assert "box-fallback" in cover.flags


def test_inward_facing_meshes_give_the_same_surface() -> None:
    inside_out = TriMesh(TABLE.vertices_m, TABLE.faces[:, ::-1])
    assert size(dominant_surface(inside_out)) == pytest.approx([1.6, 0.8, 0.04])


PANEL: tuple[Size, Size] = ((0.68, 0.02, 0.38), (0.0, 0.0, 0.26))
STAND = (((0.1, 0.02, 0.05), (0.0, 0.0, 0.045)), ((0.36, 0.14, 0.02), (0.0, 0.0, 0.01)))
HANDLE = (
    ((0.3, 0.02, 0.012), (0.0, 0.0, 0.224)),
    ((0.012, 0.02, 0.04), (-0.144, 0.0, 0.198)),
    ((0.012, 0.02, 0.04), (0.144, 0.0, 0.198)),
)


@pytest.mark.parametrize("pose", [Pose(), TURN])
@pytest.mark.parametrize(
    ("parts", "expected", "at_m"),
    [
        ((PANEL, *STAND), [0.68, 0.38, 0.02], (0.0, 0.0, 0.26)),
        ((((0.3, 0.1, 0.18), (0.0, 0.0, 0.09)), *HANDLE), [0.3, 0.18, 0.1], (0.0, 0.0, 0.09)),
    ],
    ids=["television", "radio"],
)
def test_stand_and_handle_are_not_part_of_the_plate(
    parts: tuple[tuple[Size, Size], ...], expected: list[float], at_m: Size, pose: Pose
) -> None:
    mesh = turned(boxes(*parts), pose)
    surface = dominant_surface(mesh)
    assert size(surface) == pytest.approx(expected, abs=1e-9)
    assert middle(surface) == pytest.approx(pose.to_world([at_m])[0], abs=1e-9)


def test_a_lintel_over_windows_is_level_with_its_wall_and_belongs_to_it() -> None:
    posts = [((0.5, 0.1, 0.7), (x, 0.0, 1.75)) for x in (-1.75, 0.0, 1.75)]
    wall = boxes(((4.0, 0.1, 1.4), (0.0, 0.0, 0.7)), *posts, ((4.0, 0.1, 0.4), (0.0, 0.0, 2.3)))
    assert size(dominant_surface(wall)) == pytest.approx([4.0, 2.5, 0.1])


def hob(*on_it: tuple[Size, Size]) -> TriMesh:
    """A sheet 0.5 m wide with a rim of 40 mm, open below, and objects on it."""
    tray = Box((0.5, 0.45, 0.04)).mesh
    closed = tray.vertices_m[tray.faces].mean(axis=1)[:, 2] > -0.019
    tray = TriMesh(tray.vertices_m, tray.faces[closed])
    if not on_it:
        return tray
    more = boxes(*on_it)
    return TriMesh(
        np.concatenate((tray.vertices_m, more.vertices_m)),
        np.concatenate((tray.faces, more.faces + len(tray.vertices_m))),
    )


def test_burners_and_knobs_do_not_thicken_a_hob_that_is_open_below() -> None:
    burners = [((0.12, 0.12, 0.05), (x, y, 0.045)) for x in (-0.12, 0.12) for y in (-0.11, 0.11)]
    surface = dominant_surface(hob(*burners), up=(0, 0, 1))
    assert size(surface) == pytest.approx([0.5, 0.45, 0.04])
    assert surface.flags == ("open-mesh", "box-fallback")
    assert middle(surface)[2] == pytest.approx(0.0)


def test_a_rim_that_stands_above_an_open_sheet_counts() -> None:
    rims = [((0.5, 0.02, 0.06), (0.0, s * 0.215, 0.05)) for s in (-1, 1)]
    rims += [((0.02, 0.45, 0.06), (s * 0.24, 0.0, 0.05)) for s in (-1, 1)]
    assert size(dominant_surface(hob(*rims), up=(0, 0, 1)))[2] == pytest.approx(0.1)


def test_parts_that_touch_are_one_where_the_file_rounds() -> None:
    """A board under a smaller cushion, stored turned and as float32, 90 m from the origin: some um are between them."""
    mesh = boxes(((1.0, 0.6, 0.018), (0.0, 0.0, 0.0)), ((0.97, 0.58, 0.025), (0.0, 0.0, 0.0215)))
    far = Pose((50.0, 3.0, 80.0), TURN.rotation_xyzw)
    rounded = TriMesh(turned(mesh, far).vertices_m.astype(np.float32), mesh.faces)
    assert dominant_surface(rounded, up=far.rotation[:, 2]).thickness_m == pytest.approx(0.043, abs=2e-5)


@pytest.mark.parametrize("side", [1, -1])
def test_a_label_does_not_count_as_the_top_of_its_board(side: int) -> None:
    """A decal of two triangles, half a millimetre above or below a board of 18 mm."""
    board = Box((0.7, 0.6, 0.018)).mesh
    label = [(x, y, side * 0.0095) for x, y in ((-0.3, -0.25), (0.3, -0.25), (0.3, 0.25), (-0.3, 0.25))]
    faces = np.array([(0, 1, 2), (0, 2, 3)])[:, ::side] + 8
    mesh = TriMesh(np.concatenate((board.vertices_m, label)), np.concatenate((board.faces, faces)))
    for pose in (Pose(), TURN):
        surface = dominant_surface(turned(mesh, pose), up=pose.rotation[:, 2])
        assert size(surface) == pytest.approx([0.7, 0.6, 0.018], rel=1e-6)


def test_l_shape_is_measured_by_its_box_and_flagged() -> None:
    sofa = boxes(((2.4, 0.8, 0.4), (0.0, 0.0, 0.2)), ((0.8, 1.6, 0.4), (-0.8, 1.2, 0.2)))
    surface = dominant_surface(sofa)
    assert size(surface) == pytest.approx([2.4, 2.4, 0.4])
    assert surface.flags == ("box-fallback",)


def test_size_of_a_frame_is_its_outer_size() -> None:
    frame = boxes(
        ((0.6, 0.04, 0.02), (0.0, 0.38, 0.0)),
        ((0.6, 0.04, 0.02), (0.0, -0.38, 0.0)),
        ((0.04, 0.8, 0.02), (0.28, 0.0, 0.0)),
        ((0.04, 0.8, 0.02), (-0.28, 0.0, 0.0)),
    )
    assert size(dominant_surface(frame)) == pytest.approx([0.8, 0.6, 0.02])


def test_unused_vertices_are_ignored() -> None:
    stray = TriMesh([*TABLE.vertices_m.tolist(), [9.0, 9.0, 9.0]], TABLE.faces)
    assert size(dominant_surface(stray)) == pytest.approx([1.6, 0.8, 0.04])


@pytest.mark.parametrize("up", [(0, 1, 0), (0, -1, 0), (0, 0, -1)])
def test_needle_has_length_and_zero_width(up: Size) -> None:
    needle = TriMesh([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]])
    surface = dominant_surface(needle, up=up)
    assert size(surface) == [2.0, 0.0, 0.0]
    np.testing.assert_allclose(middle(surface), [1.0, 0.0, 0.0], atol=1e-12)
