"""Figures of bundles and felt levels, against the session's gains; and the top view that both use."""

import dataclasses
import io
import math

import numpy as np
import pytest

from scene2hap import (
    Box,
    DominantSurface,
    HapticBundle,
    HapticSession,
    Pose,
    SceneObject,
    SceneSnapshot,
    Touch,
    TriMesh,
    UserProfile,
)
from scene2hap.errors import BundleError, SessionError, UnknownObject
from scene2hap.scene.from_above import NOTHING, HighestSurface, TopView
from scenes import RATE, box, haptics, scene, table_with_two_phones, tone_loop

figures = pytest.importorskip("matplotlib.figure", reason="needs the extra plots")

BLOCKING = {"sample_rate_hz": RATE, "prepare": "blocking"}
HOSTILE = ("$\\frac{1}{", "_a$b$^", "<b>&", "\u202egnp\x1b\n", "電話", "y" * 300)


def session(model: str = "exponential_plate", **more: object) -> HapticSession:
    return HapticSession(*table_with_two_phones(), {**BLOCKING, "propagation": model, **more})


def shown_levels(figure: object) -> tuple[np.ndarray, tuple[float, float, float, float]]:
    """The image of levels (n_rows, n_columns) [dB] of a figure, and its edges [m]."""
    image = figure.axes[0].images[1]  # the first image shows the surfaces
    return np.ma.filled(image.get_array(), np.nan), image.get_extent()


@pytest.mark.parametrize("model", ["exponential_plate", "modal_plate"])
def test_levels_are_those_of_the_session_at_random_points(model: str) -> None:
    s = session(model)
    figure = s.plot_felt("phone", cells=60)
    levels, (left, right, lower, upper) = shown_levels(figure)
    view = TopView.of(s.snapshot, 60)
    assert view.extent_m == (left, right, lower, upper)
    cells, points = view.points_m()
    rng = np.random.default_rng(7)
    on_table = [k for k, cell in enumerate(cells) if s.snapshot.objects[view.top.ravel()[cell]].id != "cup"]
    chosen = rng.choice(on_table, 25, replace=False)
    for k in chosen:
        item = s.snapshot.objects[view.top.ravel()[cells[k]]].id
        x, y, z = points[k].tolist()
        gain = s.update(touches=[Touch("left", item, (x, y, z))]).gain("left", "phone")
        assert levels.ravel()[cells[k]] == pytest.approx(20 * math.log10(gain), abs=0.1)
    assert np.isnan(levels.ravel()[cells[[k for k in range(len(cells)) if k not in on_table]]]).all()


def test_a_hand_has_its_own_level_and_playing_goes_on_unchanged() -> None:
    s = HapticSession(
        *table_with_two_phones(), BLOCKING, user=UserProfile.parse({"hands": {"left": {"gain_db": -6.0}}})
    )
    touch = Touch("left", "table", (0.4, 0.72, 0.4))
    before, stats = s.update(touches=[touch]), s.stats
    left, right = (shown_levels(s.plot_felt("phone", hand=hand, cells=20))[0] for hand in s.hands)
    assert np.nanmax(right - left) == pytest.approx(6.0, abs=0.01)
    assert s.stats == stats
    assert s.position == 0
    after = s.update(touches=[touch])
    assert after is before  # nothing was computed again
    s.add_hand("third")  # the profile has no values for this hand
    third = s.would_feel([dataclasses.replace(touch, hand=hand) for hand in ("left", "third")])
    np.testing.assert_allclose(20 * np.log10(third[1] / third[0]), 6.0, atol=0.01)
    assert s.explain("left").touches == ("table",)


@pytest.mark.parametrize("model", ["exponential_plate", "infinite_plate"])
def test_would_feel_equals_the_gains_of_update(model: str) -> None:
    s = session(model)
    touches = [Touch("left", "table", (0.3, 0.72, 0.1)), Touch("right", "phone", (0.1, 0.73, 0.4))]
    touches += [Touch("right", "cup", (5.0, 0.1, 5.0))]
    gains = s.would_feel(touches)
    assert gains.shape == (3, 2, 1)
    for told, touch in zip(gains, touches, strict=True):
        frame = s.update(touches=[touch])
        np.testing.assert_allclose(told, frame.gains[s.hands.index(touch.hand)], rtol=1e-5)
    assert s.would_feel([]).shape == (0, 2, 1)
    with pytest.raises(SessionError, match="third"):
        s.would_feel([Touch("third", "table", (0.0, 0.0, 0.0))])
    with pytest.raises(UnknownObject, match="tabel"):
        s.would_feel([Touch("left", "tabel", (0.0, 0.0, 0.0))])


def test_drawing_does_not_start_the_worker() -> None:
    s = session("modal_plate", prepare="background")
    assert s.wait_prepared(60.0)
    s.plot_felt("phone", cells=10)
    assert not s._hand_frames.keeper.in_use.expected


def test_units_legend_and_axes_of_ones_own() -> None:
    s = session()
    figure = figures.Figure()
    axes = figure.add_subplot()
    assert s.plot_felt("alarm", axes=axes, cells=60) is figure
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x [m]", "z [m]")
    assert figure.axes[1].get_ylabel() == "level at the hand [dB re the source itself]"
    texts = [text.get_text() for text in axes.get_legend().get_texts()]
    assert texts == ["alarm", "nothing arrives (below -140 dB)"]
    assert axes.yaxis_inverted()  # from above, z points towards the reader


def test_mistakes_raise_helpful_errors() -> None:
    s = session()
    with pytest.raises(UnknownObject, match="phone"):
        s.plot_felt("fone")
    with pytest.raises(SessionError, match="hand"):
        s.plot_felt("phone", hand="leftt")
    with pytest.raises(SessionError, match="cells"):
        s.plot_felt("phone", cells=0)
    bundle = table_with_two_phones()[1]
    with pytest.raises(BundleError, match="table"):
        bundle.plot(sources=["table"])
    with pytest.raises(BundleError, match="up_to_m"):
        bundle.plot(up_to_m=math.nan)


def test_a_bundle_has_a_plan_and_a_row_for_each_source() -> None:
    bundle = table_with_two_phones()[1]
    figure = bundle.plot()
    titles = [axes.get_title() for axes in figure.axes]
    assert "test room from above" in titles
    assert "phone (ringing, first of 2 states)" in titles
    assert "alarm (ringing)" in titles
    labels = [label for axes in figure.axes for label in (axes.get_xlabel(), axes.get_ylabel()) if label]
    assert labels
    assert all("[" in label for label in labels), labels
    assert len(bundle.plot(sources=["alarm"]).axes) < len(figure.axes)


def test_a_bundle_without_sources_and_one_with_many_are_drawn() -> None:
    snapshot = scene(*(box(f"phone {k}", (0.1, 0.01, 0.1), (0.2 * k, 0.0, 0.0)) for k in range(30)))
    objects = {item.id: haptics("glass", (0.1, 0.1, 0.01), "on") for item in snapshot.objects}
    silent = HapticBundle(snapshot, "room", objects, {})
    texts = [text.get_text() for axes in silent.plot().axes for text in axes.texts]
    assert "Nothing in this bundle vibrates." in texts
    loop = tone_loop(100.0)
    many = HapticBundle(snapshot, "room", objects, {key: {"on": loop} for key in objects})
    figure = many.plot()
    assert sum(axes.get_title().endswith("(on)") for axes in figure.axes) == 8
    assert figure.axes[1].get_legend().get_title().get_text() == "sources (6 more not listed)"


def test_names_are_drawn_as_plain_text() -> None:
    """The names of the scene, its sources, their states and the hand are hostile texts."""
    quarter_turn = (-(0.5**0.5), 0.0, 0.0, 0.5**0.5)
    surface = DominantSurface(Pose((-0.5, 0.0, 0.5), quarter_turn), 1.0, 1.0, 0.02)
    top = SceneObject("top", pose=Pose((0, 0, 0)), geometry=Box((1.0, 0.02, 1.0)), surface=surface)
    small = Box((0.1, 0.02, 0.1))
    sources = [
        dataclasses.replace(top, id=name, pose=Pose((0.15 * k - 0.4, 0.02, 0.0)), geometry=small)
        for k, name in enumerate(HOSTILE)
    ]
    snapshot = dataclasses.replace(scene(top, *sources), name=HOSTILE[0])
    objects = {"top": haptics("oak", (1.0, 1.0, 0.02))}
    objects |= {name: haptics("oak", (0.1, 0.1, 0.02), name) for name in HOSTILE}
    loop = tone_loop(100.0, seconds=0.1)
    bundle = HapticBundle(snapshot, "room", objects, {name: {name: loop} for name in HOSTILE})
    s = HapticSession(bundle, config=BLOCKING, hands=[HOSTILE[0]])
    first = [s.plot_felt(name, cells=8).axes[0].get_legend().get_texts()[0].get_text() for name in HOSTILE]
    felt, whole = s.plot_felt(HOSTILE[0], cells=8), bundle.plot()
    for figure in (felt, whole):
        figure.savefig(io.BytesIO(), format="png", dpi=20)  # formulas would be parsed when drawn
    listed = [text.get_text() for text in whole.axes[1].get_legend().get_texts()]
    assert [name.split("  ", 1)[1] for name in listed[:3]] == list(HOSTILE[:3]) == first[:3]
    titles = [axes.get_title() for axes in (*whole.axes, *felt.axes)]
    assert not set("".join([*listed, *first, *titles])) & set("\u202e\x1b\n")
    assert max(map(len, [*listed, *first, *titles])) < 100


def view_of(*objects: SceneObject, up_to_m: float | None = None, up_axis: str = "y", cells: int = 40) -> TopView:
    return TopView.of(SceneSnapshot.build(objects, up_axis=up_axis), cells, up_to_m)


def test_view_from_above_shows_the_uppermost_surface() -> None:
    """Compared with boxes, for which the uppermost surface is known."""
    rng = np.random.default_rng(3)
    sizes, places = rng.uniform(0.2, 1.0, (12, 3)), rng.uniform(-1.0, 1.0, (12, 3))
    boxes = [
        SceneObject(f"box {k}", pose=Pose(tuple(at)), geometry=Box(tuple(size)))
        for k, (size, at) in enumerate(zip(sizes.tolist(), places.tolist(), strict=True))
    ]
    view = view_of(*boxes)
    left, _, lower, _ = view.extent_m
    n_rows, n_columns = view.top.shape
    x = left + (np.arange(n_columns) + 0.5) * view.cell_m
    z = lower + (np.arange(n_rows) + 0.5) * view.cell_m
    best, top = np.full(view.top.shape, -np.inf), np.full(view.top.shape, NOTHING)
    for k, (size, at) in enumerate(zip(sizes, places, strict=True)):
        inside = np.outer(np.abs(z - at[2]) <= size[2] / 2, np.abs(x - at[0]) <= size[0] / 2)
        higher = inside & (at[1] + size[1] / 2 > best)
        best[higher], top[higher] = at[1] + size[1] / 2, k
    np.testing.assert_array_equal(view.top, top)
    np.testing.assert_allclose(view.height_m[top >= 0], best[top >= 0])
    cells, points = view.points_m()
    np.testing.assert_allclose(points[:, 1], best.ravel()[cells])
    assert len(view.edges_m()) > len(view.edges_m(view.top == 0)) > 0


def test_a_ceiling_is_left_out_and_z_may_point_up() -> None:
    floor = SceneObject("floor", pose=Pose((0, 0, -0.05)), geometry=Box((4.0, 3.0, 0.1)))
    ceiling = SceneObject("ceiling", pose=Pose((0, 0, 2.5)), geometry=Box((4.0, 3.0, 0.1)))
    assert (view_of(floor, ceiling, up_axis="z").top == 1).all()
    seen = view_of(floor, ceiling, up_axis="z", up_to_m=2.0)
    assert (seen.top == 0).all()
    assert seen.top.shape == (30, 40)
    np.testing.assert_allclose(seen.height_m, 0.0, atol=1e-12)


def furnished(*more: SceneObject) -> SceneSnapshot:
    """A floor with nine crates, walls on two sides, and other objects."""
    floor = SceneObject("floor", pose=Pose((0, -0.05, 0)), geometry=Box((6.0, 0.1, 5.0)))
    walls = [
        SceneObject(f"wall {k}", pose=Pose((x, 1.3, 0)), geometry=Box((0.1, 2.6, 5.0)))
        for k, x in enumerate((-3.0, 3.0))
    ]
    crates = [
        SceneObject(f"crate {k}", pose=Pose((k % 3 - 1.0, 0.25, k // 3 - 1.0)), geometry=Box((0.5, 0.5, 0.5)))
        for k in range(9)
    ]
    return SceneSnapshot.build([floor, *walls, *crates, *more])


def test_a_ceiling_that_hides_the_room_is_left_out() -> None:
    """Also an upper floor of another box above it; the walls stay."""
    covers = [
        SceneObject("ceiling", pose=Pose((0, 2.65, 0)), geometry=Box((6.0, 0.1, 5.0))),
        SceneObject("roof", pose=Pose((0, 3.5, 0)), geometry=Box((6.4, 0.1, 5.4))),
    ]
    view = TopView.of(furnished(*covers), 60)
    assert view.is_uncovered
    seen = {view.scene.objects[k].id for k in np.unique(view.top) if k != NOTHING}
    assert seen == {item.id for item in view.scene.objects} - {"ceiling", "roof"}
    assert TopView.of(furnished(*covers), 60, up_to_m=9.0).top.max() == len(view.scene.objects) - 1


def test_the_ceiling_of_a_room_in_one_piece_is_left_out() -> None:
    inside = Box((6.0, 2.6, 5.0)).mesh
    view = TopView.of(furnished(SceneObject("room", pose=Pose((0, 1.3, 0)), geometry=inside)), 60)
    assert view.is_uncovered
    assert {f"crate {k}" for k in range(9)} < {view.scene.objects[k].id for k in np.unique(view.top)}


def test_a_view_extends_by_equal_lengths_beyond_what_it_shows() -> None:
    x0, x1, z0, z1 = TopView.of(SceneSnapshot.build([SceneObject("mat", geometry=Box((4.0, 0.1, 1.3)))]), 7).extent_m
    assert (x0 + x1, z0 + z1) == pytest.approx((0.0, 0.0), abs=1e-9)
    assert z1 - z0 > 1.3


def test_a_cover_that_hides_a_few_objects_is_drawn() -> None:
    crates = [
        SceneObject(f"crate {k}", pose=Pose((0.9 * k - 3.6, 0.2, -2.8)), geometry=Box((0.4, 0.4, 0.4)))
        for k in range(9)
    ]
    below = [SceneObject(f"pool {k}", pose=Pose((k, 0.1, 0)), geometry=Box((0.9, 0.2, 0.9))) for k in range(3)]
    awning = SceneObject("awning", pose=Pose((0, 2.5, 0.3)), geometry=Box((7.6, 0.05, 5.0)))
    view = TopView.of(SceneSnapshot.build([*crates, *below, awning]), 60)
    assert not view.is_uncovered
    assert "pool 1" not in {view.scene.objects[k].id for k in np.unique(view.top) if k != NOTHING}


def test_terrain_and_table_tops_are_no_ceilings() -> None:
    hill = SceneObject("terrain", pose=Pose((0, -2.5, 0)), geometry=Box((8.0, 5.0, 8.0)))
    assert not TopView.of(furnished(hill), 60).is_uncovered
    assert not TopView.of(furnished(), 60).is_uncovered
    legs = [
        SceneObject(f"leg {k}", pose=Pose((x, 0.36, z)), geometry=Box((0.05, 0.72, 0.05)))
        for k, (x, z) in enumerate([(-0.5, -0.3), (0.5, -0.3), (-0.5, 0.3), (0.5, 0.3)])
    ]
    top = SceneObject("top", pose=Pose((0, 0.73, 0)), geometry=Box((1.2, 0.02, 0.7)))
    assert (view_of(top, *legs).top <= 0).all()


def test_an_endless_floor_is_drawn_around_the_rest_only() -> None:
    floor = SceneObject("floor", geometry=Box((100.0, 0.1, 100.0)))
    table = SceneObject("table", pose=Pose((20, 0.4, 5)), geometry=Box((1.2, 0.7, 0.8)))
    view = view_of(floor, table)
    assert view.extent_m == pytest.approx((18.2, 21.8, 3.4, 6.6), abs=0.05)
    assert set(np.unique(view.top)) == {0, 1}
    assert view_of(SceneObject("floor", geometry=Box((4.0, 0.1, 4.0))), table).extent_m[1] == pytest.approx(
        20.6, abs=0.5
    )
    room = SceneObject("floor", geometry=Box((6.0, 0.1, 6.0)))
    phone = SceneObject("phone", pose=Pose((1, 0.054, 0)), geometry=Box((0.07, 0.008, 0.15)))
    assert view_of(room, phone).extent_m == pytest.approx((-3.0, 3.0, -3.0, 3.0))


def test_flat_upright_and_tiny_things_have_a_view() -> None:
    upright = TriMesh(np.array([[0, 0, 0], [0, 1, 0], [0, 0, 1.0]]), np.array([[0, 1, 2]]))
    view = view_of(SceneObject("wall", geometry=upright))
    assert (view.top == NOTHING).all()
    assert len(view.points_m()[0]) == 0
    assert len(view.edges_m()) == 0


def test_sources_above_each_other_share_a_mark() -> None:
    """A loudspeaker on a subwoofer, and a third source apart."""
    at = {"subwoofer": (0.0, 0.3, 0.0), "speaker": (0.0, 0.9, 0.0), "fan": (3.0, 0.3, 1.0)}
    snapshot = scene(*(box(name, (0.5, 0.6, 0.5), middle) for name, middle in at.items()))
    objects = {name: haptics("oak", (0.6, 0.5, 0.5), "on") for name in at}
    bundle = HapticBundle(snapshot, "room", objects, {name: {"on": tone_loop(100.0)} for name in at})
    assert [text.get_text() for text in bundle.plot().axes[0].texts] == ["1, 2", "3"]


def test_the_legend_of_a_flat_map_is_below_the_label_of_its_axis() -> None:
    snapshot = scene(box("shelf", (9.0, 0.1, 1.5), (0, 0, 0)), box("phone", (8.0, 0.02, 0.1), (0, 0.06, 0)))
    objects = {"shelf": haptics("oak", (9.0, 1.5, 0.1)), "phone": haptics("glass", (8.0, 0.1, 0.02), "on")}
    s = HapticSession(HapticBundle(snapshot, "room", objects, {"phone": {"on": tone_loop(100.0)}}), config=BLOCKING)
    figure = s.plot_felt("phone", cells=20)
    figure.savefig(io.BytesIO(), format="png")
    axes = figure.axes[0]
    assert axes.get_legend().get_window_extent().y1 < axes.xaxis.label.get_window_extent().y0


def test_the_highest_triangle_covers_each_cell() -> None:
    """Compared with barycentric coordinates of every cell in every triangle, slivers and vertical triangles too."""
    rng = np.random.default_rng(8)
    triangles = rng.uniform(-3.0, 15.0, (60, 3, 3))
    triangles[:10, 2, :2] = triangles[:10, 1, :2] * 0.3 + triangles[:10, 0, :2] * 0.7
    triangles[10:20, 2, :2] = triangles[10:20, 1, :2] + 0.02
    found = HighestSurface(12, 9)
    found.add(triangles[:30], np.arange(30))
    found.add(triangles[30:], np.arange(30, 60))
    best, top = np.full((9, 12), -np.inf), np.full((9, 12), NOTHING)
    for row, column in np.ndindex(9, 12):
        for number, corners in enumerate(triangles):
            weights = np.linalg.lstsq(np.vstack([corners[:, :2].T, np.ones(3)]), [column + 0.5, row + 0.5, 1.0])[0]
            height = weights @ corners[:, 2]
            flat = abs(np.linalg.det(np.vstack([corners[:, :2].T, np.ones(3)]))) < 1e-9
            if not flat and weights.min() >= 0 and height > best[row, column]:
                best[row, column], top[row, column] = height, number
    np.testing.assert_array_equal(found.top, top)
    np.testing.assert_allclose(found.height, best)
