"""Copies of a prefab: a bundle of one object that a session adds many times."""

import gc
import weakref
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from threading import Event, Thread

import numpy as np
import pytest

from garbage import only_new_garbage
from scene2hap import BakeConfig, HapticBundle, HapticSession, LexiconBackend, Pose, SceneSnapshot, Touch, bake_object
from scene2hap.contact.shape import shape_of
from scene2hap.errors import SceneError, SessionError
from scenes import RATE, box, haptics, table_with_two_phones, tone_loop

AT = Pose((0.8, 0.82, 0.6))
ON_TABLE = [Touch("left", "table", (0.8, 0.72, 0.4))]


@pytest.fixture(autouse=True)
def _only_new_garbage() -> Iterator[None]:
    with only_new_garbage():
        yield


def session() -> HapticSession:
    return HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE})


def fan(frequency_hz: float = 130.0) -> HapticBundle:
    item = box("fan", (0.1, 0.2, 0.1), (0.0, 0.1, 0.0))
    loops = {"fan": {"on": tone_loop(frequency_hz)}}
    return HapticBundle(
        SceneSnapshot("fan", "y", (item,)), "", {"fan": haptics("plastic", (0.2, 0.1, 0.1), "on")}, loops
    )


def test_copy_has_the_gains_of_an_initial_object() -> None:
    prefab, (snapshot, bundle) = fan().override("fan", gain_db=-6.0), table_with_two_phones()
    item = replace(prefab.snapshot.objects[0], id="fan_17", pose=AT)
    whole = replace(snapshot, objects=(*snapshot.objects, item))
    there = HapticSession(
        whole,
        replace(
            bundle,
            snapshot=whole,
            objects={**bundle.objects, "fan_17": prefab.objects["fan"]},
            loops={**bundle.loops, "fan_17": prefab.loops["fan"]},
        ).override("fan_17", gain_db=-6.0),
        {"sample_rate_hz": RATE},
    )
    added = session()
    added.spawn(prefab, "fan_17", AT)
    assert added.wait_prepared(60)
    assert added.source_ids == ("phone", "alarm", "fan_17")
    gains = [one.update(touches=ON_TABLE).gains for one in (there, added)]
    np.testing.assert_array_equal(gains[1], gains[0])
    assert gains[1][0, 2].max() > 0
    np.testing.assert_array_equal(added.render(RATE), there.render(RATE))


def test_a_prefab_is_baked_saved_and_loaded_as_any_bundle(tmp_path: Path) -> None:
    item = box("electric fan", (0.3, 0.4, 0.3), (0.0, 0.2, 0.0))
    prefab = bake_object(item, BakeConfig(llm=LexiconBackend()))
    loaded = HapticBundle.load(prefab.save(tmp_path / "fan.bundle"))
    assert list(loaded.loops) == ["electric fan"]
    s = session()
    s.spawn(loaded, "fan_1", Pose((0.8, 0.92, 0.4)))
    assert "fan_1" in s.source_ids
    assert s.wait_prepared(60)
    with pytest.raises(SceneError, match="must be a SceneObject"):
        bake_object("fan.glb")


def test_copy_of_a_passive_prefab_is_no_source() -> None:
    s = session()
    tray = SceneSnapshot("tray", "y", (box("tray", (0.4, 0.01, 0.3), (0.0, 0.0, 0.0)),))
    prefab = HapticBundle(tray, "", {"tray": haptics("steel", (0.4, 0.3, 0.01))}, {})
    s.spawn(prefab, "tray_1", Pose((0.8, 0.725, 0.4)))
    assert s.source_ids == ("phone", "alarm")
    assert s.update(touches=[Touch("left", "tray_1", (0.8, 0.73, 0.4))]).gain("left", "phone") > 0


def test_used_id_and_invalid_prefab_are_refused_without_change() -> None:
    s, prefab = session(), fan()
    s.spawn(prefab, "fan_1", AT)
    before = s.snapshot
    with pytest.raises(SceneError, match="fan_1"):
        s.spawn(prefab, "fan_1", Pose((5.0, 0.0, 0.0)))
    with pytest.raises(SessionError, match="has 5 objects; it must have one"):
        s.spawn(table_with_two_phones()[1], "fan_2", AT)
    with pytest.raises(SessionError, match="must be a HapticBundle"):
        s.spawn("fan.bundle", "fan_2", AT)
    with pytest.raises(SessionError, match="must be a Pose"):
        s.spawn(prefab, "fan_2", (1.0, 0.0, 0.0))
    assert s.snapshot == before


@pytest.mark.parametrize("n_between", [1, 7])
def test_session_after_many_copies_equals_a_new_session(n_between: int) -> None:
    """After many changes, the gains are bit-identical to those of a new session with the same objects."""
    s, prefabs = session(), (fan(), fan(171.0), bake_object(box("oak tray", (0.2, 0.02, 0.2), (0.0, 0.0, 0.0))))
    rng = np.random.default_rng(3)
    alive: dict[str, HapticBundle] = {}
    for n in range(36):
        if alive and rng.random() < 0.4:
            gone = str(rng.choice(list(alive)))
            s.remove(gone)
            del alive[gone]
        else:
            alive[f"copy_{n}"] = prefab = prefabs[rng.integers(3)]
            x, y, z = rng.uniform((0.1, 0.72, 0.1), (1.4, 0.82, 0.6)).tolist()
            s.spawn(prefab, f"copy_{n}", Pose((x, y, z)))
        if n % n_between == 0:
            assert s.wait_prepared(60)
            new = session()
            for key, prefab in alive.items():
                new.spawn(prefab, key, s.poses[key])
            assert new.wait_prepared(60)
            assert new.source_ids == s.source_ids
            np.testing.assert_array_equal(s.update(touches=ON_TABLE).gains, new.update(touches=ON_TABLE).gains)


def test_many_copies_leak_no_memory() -> None:
    s, prefab = session(), fan(171.0)
    copies: list[weakref.ref[object]] = []
    for n in range(250):
        s.spawn(prefab, f"fan_{n}", Pose((0.3 * (n % 5), 0.82, 0.2)))
        copies.append(weakref.ref(s._state.objects[f"fan_{n}"]))
        if n >= 5:
            s.remove(f"fan_{n - 5}")
        s.update(touches=ON_TABLE)
        s.strike(f"fan_{n}", (0.3 * (n % 5), 0.82, 0.2))
        s.render(400)
    assert s.source_ids == ("phone", "alarm", *(f"fan_{n}" for n in range(245, 250)))
    s.update()
    gc.collect()
    assert sum(copy() is not None for copy in copies) == 5
    assert len(s._mixers._mixers) == 1


def test_copies_leave_nothing_to_the_garbage_collector() -> None:
    s, prefab = session(), fan(176.0)
    s.spawn(prefab, "fan_0", AT)
    assert s.wait_prepared(60)
    gc.collect()
    gc.disable()
    try:
        for n in range(1, 10):
            s.spawn(prefab, f"fan_{n}", AT)
            s.remove(f"fan_{n - 1}")
            s.update(touches=ON_TABLE)
        assert gc.collect() == 0
    finally:
        gc.enable()


def test_two_sessions_share_a_prefab_while_its_copy_is_removed() -> None:
    prefab, first, second = fan(181.0), session(), session()
    first.spawn(prefab, "fan_1", AT)
    first.remove("fan_1")
    second.spawn(prefab, "fan_1", AT)
    assert second.wait_prepared(60)
    first.update(touches=ON_TABLE)
    on_fan = [Touch("left", "fan_1", AT.position_m)]
    second.update(touches=on_fan)
    assert np.abs(second.render(RATE // 4)).max() > 0.2
    first.spawn(prefab, "fan_1", AT)
    first.update(touches=on_fan)
    assert np.abs(first.render(RATE // 4)).max() > 0.2


def test_copies_come_and_go_while_another_thread_renders() -> None:
    s, prefab, ends, failed = session(), fan(191.0), Event(), []

    def render() -> None:
        try:
            while not ends.is_set():
                assert np.isfinite(s.render(160)).all()
        except Exception as problem:
            failed.append(problem)

    audio = Thread(target=render)
    audio.start()
    for n in range(36):
        s.spawn(prefab, f"fan_{n}", AT)
        s.update(touches=ON_TABLE)
        s.remove(f"fan_{n}")
    ends.set()
    audio.join()
    assert not failed


def test_the_recipe_of_the_docs_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    text = (Path(__file__).parents[3] / "docs" / "spawning.md").read_text(encoding="utf-8")
    bakes, plays, first_wave = (part.split("```")[0] for part in text.split("```python\n")[1:])
    names = {"session": session(), "HapticBundle": HapticBundle}
    exec(bakes, names)
    exec(plays.split("...\n")[0], names)
    assert "fan_17" in names["session"].source_ids
    exec(plays.split("...\n")[1], names)
    assert "fan_17" not in names["session"].source_ids
    exec(first_wave, {**names, "Pose": Pose})
    (item,) = names["prefab"].snapshot.objects
    assert shape_of(item.geometry.mesh).is_prepared
    assert "first" not in names["session"].source_ids
