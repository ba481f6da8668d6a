"""The physical models in a session: gains of the demo kitchen, and of a moved table."""

import warnings
from pathlib import Path

import numpy as np
import pytest

from scene2hap import Bands, HapticBundle, HapticSession, Pose, SceneSnapshot, Touch
from scene2hap.propagation.domain import ThinPlateWarning
from scenes import table_with_two_phones

PHYSICAL = ["infinite_plate", "modal_plate", "auto"]


@pytest.fixture(scope="module")
def demo(kitchen_bundle: Path) -> tuple[SceneSnapshot, HapticBundle]:
    bundle = HapticBundle.load(kitchen_bundle)
    return bundle.snapshot, bundle


@pytest.mark.parametrize(
    ("kind", "bands"),
    [
        ("infinite_plate", "dominant"),
        ("modal_plate", "dominant"),
        ("modal_plate", Bands((40.0, 80.0, 160.0))),
        ("auto", "dominant"),
    ],
)
def test_every_object_of_the_demo_kitchen_has_finite_gains(
    demo: tuple[SceneSnapshot, HapticBundle], kind: str, bands: str | Bands
) -> None:
    scene, bundle = demo
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ThinPlateWarning)
        session = HapticSession(scene, bundle, {"propagation": kind, "bands": bands, "prepare": "blocking"})
    reached = 0
    for item in scene.objects:
        top = tuple(item.bounds_m.mean(axis=0).tolist())
        frame = session.update(touches=[Touch("left", item.id, top)])
        assert np.isfinite(frame.gains).all()
        assert (frame.gains >= 0).all()
        assert (frame.gains <= 1).all()
        reached += sum(frame.gain("left", x) > 0 for x in session.source_ids if x != item.id)
        if item.id in session.source_ids:
            assert frame.gain("left", item.id) == 1.0
    assert reached > 0
    out = session.render(4800)
    assert np.isfinite(out).all()
    assert np.abs(out).max() <= 1.0


@pytest.mark.parametrize("kind", PHYSICAL)
def test_plate_coordinates_go_along_with_the_scene(kind: str) -> None:
    scene, bundle = table_with_two_phones()
    config = {"propagation": kind, "bands": Bands.third_octaves(), "prepare": "blocking"}
    session = HapticSession(scene, bundle, config)
    before = session.update(touches=[Touch("left", "table", (0.9, 0.72, 0.5))]).gains
    far = Pose((7.0, 0.0, -3.0), (0.0, np.sqrt(0.5), 0.0, np.sqrt(0.5)))
    moved = {item.id: far.compose(item.pose) for item in scene.objects}
    point = tuple(far.to_world([[0.9, 0.72, 0.5]])[0].tolist())
    after = session.update(moved, [Touch("left", "table", point)]).gains
    assert before.max() > 0
    np.testing.assert_allclose(after, before, rtol=1e-3)


def test_gains_above_1_are_capped_and_counted() -> None:
    scene, bundle = table_with_two_phones()
    model = {"kind": "modal_plate", "contact": {"preload_n": 5.0}}
    settings = {"propagation": model, "bands": Bands.third_octaves(), "prepare": "blocking"}
    touches = [Touch("left", "table", (x, 0.72, 0.05)) for x in (0.0, 0.4, 0.8, 1.2, 1.6)]
    free = HapticSession(scene, bundle, {**settings, "gain_limit_db": None})
    capped = HapticSession(scene, bundle, settings)
    high, low = free.update(touches=touches).gains, capped.update(touches=touches).gains
    assert high.max() > 1
    np.testing.assert_allclose(low, np.minimum(high, 1.0), rtol=1e-6)
    assert capped.stats.gains_capped > 0
    assert free.stats.gains_capped == 0
