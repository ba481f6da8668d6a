"""Warnings of silent objects: one sentence for those that cannot be felt, none for carriers and sources."""

import warnings
from dataclasses import replace

import pytest

from scene2hap import (
    Box,
    HapticBundle,
    HapticSession,
    MemorySink,
    ObjectHaptics,
    Pose,
    SceneObject,
    SceneSnapshot,
    SceneWarning,
    Touch,
    bake,
    bake_object,
)

TABLE = SceneObject("table", pose=Pose((0.0, 0.7, 0.0)), geometry=Box((1.6, 0.04, 0.8)))
PHONE = SceneObject("phone", pose=Pose((0.5, 0.725, 0.2)), geometry=Box((0.08, 0.01, 0.15)))
VASE = SceneObject("vase", pose=Pose((-0.5, 0.8, 0.2)), geometry=Box((0.1, 0.15, 0.1)))
ON_TABLE = [Touch("left", "table", (0.3, 0.72, 0.1))]


@pytest.fixture(scope="module")
def bundle() -> HapticBundle:
    return bake(SceneSnapshot.build([TABLE, PHONE]))


@pytest.fixture(scope="module")
def silent() -> HapticBundle:
    return bake_object(TABLE)


def test_session_without_sources_warns_once(silent: HapticBundle) -> None:
    with pytest.warns(
        SceneWarning, match="of 1 objects none vibrates.*`vibrates` true by `override`.*`rebake`"
    ) as caught:
        HapticSession(silent, sink=MemorySink()).start()
    assert caught[0].filename == __file__
    session = HapticSession(silent)
    with pytest.warns(SceneWarning, match="none vibrates"):
        session.update(touches=ON_TABLE)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        session.update(touches=ON_TABLE)


@pytest.mark.filterwarnings("error::scene2hap.SceneWarning")
def test_session_filled_before_start_does_not_warn(silent: HapticBundle, bundle: HapticBundle) -> None:
    session = HapticSession(silent, sink=MemorySink())
    session.add(PHONE, bundle.objects["phone"], bundle.loops["phone"])
    with session:
        session.update(touches=ON_TABLE)


def test_adding_an_object_without_data_warns(bundle: HapticBundle) -> None:
    with pytest.warns(SceneWarning, match="'vase', of which nothing is known, is added without") as caught:
        HapticSession(bundle).add(VASE)
    assert caught[0].filename == __file__


def test_adding_a_source_without_loops_warns(bundle: HapticBundle) -> None:
    with pytest.warns(SceneWarning, match="'vase', of which the haptics say.*stays silent.*`haptics` and `loops`"):
        HapticSession(bundle).add(VASE, bundle.objects["phone"])


def test_adding_an_object_of_unknown_material_warns(bundle: HapticBundle) -> None:
    unknown: ObjectHaptics = replace(bundle.objects["table"], material=None)
    with pytest.warns(SceneWarning, match="of unknown material, is added without loops: it neither"):
        HapticSession(bundle).add(VASE, unknown)


def test_warning_names_a_few_of_many_silent_objects(bundle: HapticBundle) -> None:
    session = HapticSession(bundle)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        for k in range(15):
            session.add(replace(VASE, id=f"vase {k}", pose=Pose((k, 5.0, 0.0))))
    assert len(caught) == 10
    assert str(caught[-1].message).endswith("Further silent objects are not named.")


@pytest.mark.filterwarnings("error::scene2hap.SceneWarning")
def test_adding_a_carrier_or_a_source_does_not_warn(bundle: HapticBundle) -> None:
    session = HapticSession(bundle)
    session.add(VASE, bundle.objects["table"])
    session.remove("phone")
    session.add(PHONE)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SceneWarning)
        prefab = bake_object(replace(VASE, id="oak table", name="oak table"))
    session.spawn(prefab, "table 2", Pose((3.0, 0.0, 0.0)))


def silence_warnings(session: HapticSession, n_updates: int) -> list[str]:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        for _ in range(n_updates):
            session.update(touches=ON_TABLE)
    return [str(one.message) for one in caught]


def test_a_sink_that_is_never_started_is_named_once(bundle: HapticBundle) -> None:
    (said,) = silence_warnings(HapticSession(bundle, sink=MemorySink()), 300)
    assert "never started" in said
    assert "call start()" in said


def test_a_session_that_plays_or_has_played_is_not_named(bundle: HapticBundle) -> None:
    assert not silence_warnings(HapticSession(bundle), 100)
    assert not silence_warnings(HapticSession(bundle, sink=MemorySink()), 10)  # before the start
    rendered = HapticSession(bundle, sink=MemorySink())
    rendered.render(100)
    assert not silence_warnings(rendered, 100)
    with HapticSession(bundle, sink=MemorySink()) as started:
        assert not silence_warnings(started, 100)
    assert not silence_warnings(started, 100)
