"""The felt map against sessions: levels and paths, on the demo kitchen and on scenes by others."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from others import SCENES, needed
from scene2hap import (
    AudioClip,
    Box,
    HapticBundle,
    HapticSession,
    Pose,
    SceneObject,
    SceneSnapshot,
    Touch,
    bake,
    load_scene,
    rebake,
)
from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.audio.threshold import threshold_db
from scene2hap.demo import kitchen_path
from scene2hap.report.document import level_bytes
from scene2hap.report.felt_map import ALL_BANDS, ALL_SOURCES, FeltMap, felt_map
from scenes import table_with_two_phones, tone_loop

pytestmark = pytest.mark.usefixtures("short_tones")

N_POINTS = 60
MODEL = "exponential_plate"
LEAST_FELT_DB = -20.0
"""The lowest level of the page's scale."""


def _of_oak(bundle: HapticBundle) -> HapticBundle:
    """Make all unknown objects oak, and let the table `Object_12` hum."""
    for object_id in bundle.objects:
        bundle = bundle.override(object_id, material="oak")
    return rebake(bundle.override("Object_12", vibrates=True))


CASES: dict[str, tuple[Path, float | None, Callable[[HapticBundle], HapticBundle], int]] = {
    "demo_kitchen": (kitchen_path(), None, lambda bundle: bundle, 15),
    "composed_kitchen_kaykit": (
        SCENES / "composed_kitchen_kaykit" / "composed_kitchen_kaykit.glb",
        None,
        lambda bundle: bundle,
        15,
    ),
    "messy_japanese_room": (SCENES / "messy_japanese_room" / "room.glb", 0.1, _of_oak, 6),
}
"""By scene: its file, metres per unit, a change of the bundle, and the least number of levels above -20 dB."""


@pytest.mark.filterwarnings("ignore")  # scenes by others, and points slightly off coarse meshes, cause warnings
@pytest.mark.parametrize("name", CASES)
def test_the_felt_map_has_the_gains_and_paths_of_a_session(name: str, kitchen_bundle: Path) -> None:
    """At 60 points for every source, within 0.1 dB on the page, which stores levels in steps of 1 mdB."""
    path, unit_m, done, least = CASES[name]
    if name == "demo_kitchen":
        bundle = HapticBundle.load(kitchen_bundle)
    else:
        bundle = done(bake(load_scene(needed(path), unit_m=unit_m)))
    felt = felt_map(bundle, most_points=800)
    session = HapticSession(bundle)
    places = [(patch.object_id, point) for patch in felt.patches for point in patch.points_m.tolist()]
    chosen = np.random.default_rng(5).choice(len(places), N_POINTS, replace=False)
    n_felt = 0
    for place in chosen.tolist():
        object_id, (x, y, z) = places[place]
        frame = session.update(touches=[Touch("left", object_id, (x, y, z))])
        for source, loops in bundle.loops.items():
            gain, loop = frame.gain("left", source), next(iter(loops.values()))
            level = felt.levels_db[MODEL][source][ALL_BANDS][place]
            if gain == 0.0:
                assert level == -np.inf
                continue
            assert loop.felt is not None
            expected = 20.0 * np.log10(gain) + loop.felt.level_db
            assert level == pytest.approx(expected, abs=1e-3)
            _assert_path(felt, source, place, object_id, bundle)
            if expected > LEAST_FELT_DB:
                n_felt += 1
                (stored,) = np.frombuffer(level_bytes(np.array([level], np.float32)), "<u2")
                assert (int(stored) - 1) / 65_534 * 70.0 - 20.0 == pytest.approx(expected, abs=0.1)
    assert n_felt >= least


def test_the_bands_of_a_source_share_its_felt_power() -> None:
    """Two tones of equal amplitude are felt by their levels above the threshold of touch."""
    bundle = table_with_two_phones()[1]
    low, high = tone_loop(60.0).tactile, tone_loop(250.0).tactile
    both = AudioClip(low.samples + high.samples, low.sample_rate_hz)
    felt = felt_map(replace(bundle, loops={"phone": {"on": HapticLoop(both, both, 60.0, 60.0)}}), ("no_propagation",))
    of_band = {band: levels.max() for band, levels in felt.levels_db["no_propagation"]["phone"].items()}
    above_db = -threshold_db([60.0, 250.0])
    assert of_band["125-400 Hz"] - of_band["40-125 Hz"] == pytest.approx(above_db[1] - above_db[0], abs=0.01)
    powers = [10.0 ** (level / 10.0) for band, level in of_band.items() if band != ALL_BANDS]
    assert 10.0 * np.log10(sum(powers)) == pytest.approx(of_band[ALL_BANDS], abs=0.01)


def _assert_path(felt: FeltMap, source: str, place: int, object_id: str, bundle: HapticBundle) -> None:
    """Check that a path leads from the source to the object, over each object once, and only over known materials."""
    path = _path(felt, source, place)
    assert (path[0], path[-1]) == (source, object_id)
    assert len(set(path)) == len(path)
    assert all(bundle.objects[passed].material is not None for passed in path[1:])


def _path(felt: FeltMap, source: str, place: int) -> tuple[str, ...]:
    ways = felt.paths[MODEL][source]
    number = int(ways.of_points[place])
    return ways.objects[number - 1] if number else ()


def test_paths_are_those_that_a_session_explains(kitchen_bundle: Path) -> None:
    """Paths are unique here: the kitchen has no two paths of equal loss at these points."""
    bundle = HapticBundle.load(kitchen_bundle)
    for model in (
        {"kind": MODEL},
        {"kind": MODEL, "max_hops": 2, "interface_loss_db": 3.0},
        {"kind": "full_propagation"},
    ):
        felt = felt_map(bundle, [model], most_points=400)
        session = HapticSession(bundle, config={"propagation": model})
        assert session.wait_prepared(60)
        places = [(patch.object_id, point) for patch in felt.patches for point in patch.points_m.tolist()]
        n_compared = 0
        for place in np.random.default_rng(6).choice(len(places), 15, replace=False).tolist():
            object_id, (x, y, z) = places[place]
            session.update(touches=[Touch("left", object_id, (x, y, z))])
            for one in session.explain("left").felt:
                ways = felt.paths[model["kind"]][one.source_id]
                number = int(ways.of_points[place])
                assert ways.objects[number - 1] == tuple(step.object_id for step in one.steps)
                n_compared += 1
        assert n_compared > 25


def _table(**names: str) -> SceneSnapshot:
    """A phone and a plate on a table, and a separate cup."""
    things = {
        "table": ((0.0, 0.4, 0.0), (1.2, 0.8, 0.7)),
        "phone": ((-0.4, 0.81, 0.0), (0.15, 0.02, 0.08)),
        "plate": ((0.3, 0.81, 0.0), (0.2, 0.02, 0.2)),
        "cup": ((3.0, 0.05, 0.0), (0.1, 0.1, 0.1)),
    }
    said = {"table": "oak table", "phone": "smartphone"}
    return SceneSnapshot.build(
        [
            SceneObject(names.get(key, key), said.get(key, key), Pose(at), Box(size))
            for key, (at, size) in things.items()
        ],
        name="room",
    )


def test_path_runs_over_touching_objects() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        felt = felt_map(bake(_table()), most_points=400)
    start, paths = 0, {}
    for patch in felt.patches:
        paths[patch.object_id] = {_path(felt, "phone", start + i) for i in range(len(patch.points_m))}
        start += len(patch.points_m)
    assert paths == {
        "table": {("phone", "table")},
        "phone": {("phone",)},
        "plate": {("phone", "table", "plate")},
        "cup": {()},
    }


def test_a_source_of_unknown_material_is_felt_on_itself() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        bundle = bake(_table())
        phone = replace(bundle.objects["phone"], material=None)
        felt = felt_map(replace(bundle, objects={**bundle.objects, "phone": phone}), [MODEL], most_points=100)
    owners = [patch.object_id for patch in felt.patches for _ in patch.points_m]
    assert {_path(felt, "phone", k) for k, owner in enumerate(owners) if owner == "phone"} == {("phone",)}


def test_resonant_models_have_no_single_path() -> None:
    felt = felt_map(bake(_table()), ["modal_plate"], most_points=40)
    assert felt.models == ("modal_plate",)
    assert felt.paths == {}


def test_a_source_may_be_called_all() -> None:
    """The levels of a source with the id "all" are kept apart from the levels of all sources."""
    felt = felt_map(bake(_table(phone="all")), most_points=200)
    assert felt.sources == (ALL_SOURCES, "all")
    own = felt.levels_db[MODEL]["all"][ALL_BANDS]
    assert np.isfinite(own).any()
    assert felt.levels_db[MODEL][ALL_SOURCES][ALL_BANDS] == pytest.approx(own, abs=1e-4)
    assert set(felt.levels_db[MODEL]) == {"all", ALL_SOURCES}
