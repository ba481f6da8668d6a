"""Replacing the bundle of a running session, from Python and from disk."""

from __future__ import annotations

import json
import os
import sys
import time
import warnings
from concurrent.futures import Future
from dataclasses import replace
from pathlib import Path
from types import FrameType
from typing import Any

import numpy as np
import pytest

from scene2hap import (
    AudioClip,
    BundleWatch,
    HapticBundle,
    HapticLoop,
    HapticSession,
    Pose,
    SceneWarning,
    Touch,
)
from scene2hap.errors import BundleError
from scene2hap.session import bundle_watch
from scene2hap.session.mix import loop_mixers, prepared_loops
from scenes import RATE, table_with_two_phones


def buzz(frequency_hz: float) -> HapticLoop:
    samples = (0.4 * np.sin(2 * np.pi * frequency_hz * np.arange(RATE) / RATE)).astype(np.float32)
    return HapticLoop(AudioClip(samples, RATE), AudioClip(samples, RATE), frequency_hz, frequency_hz)


def with_loops(bundle: HapticBundle, source: str, **loops: HapticLoop) -> HapticBundle:
    return replace(bundle, loops={**bundle.loops, source: loops})


@pytest.fixture
def bundle() -> HapticBundle:
    return table_with_two_phones()[1]


def felt(session: HapticSession, source: str) -> float:
    session.wait_prepared()
    touch = Touch("left", source, session.poses[source].position_m)
    session.update(touches=[touch])
    session.render(9600)
    session.update(touches=[touch])
    return float(np.abs(session.render(9600)[:, 0]).max())


def test_use_bundle_replaces_changed_loops_only(bundle: HapticBundle) -> None:
    source, other = bundle.loops
    session = HapticSession(bundle)
    place = Pose((*session.poses[source].position_m[:2], session.poses[source].position_m[2] + 0.001))
    session.update({source: place})
    session.set_source(other, on=False)
    session.use_bundle(with_loops(bundle, source, ringing=buzz(60.0)))
    assert session.poses[source] == place
    assert set(session.source_ids) == {source, other}
    assert felt(session, source) == pytest.approx(0.4, rel=0.02)
    assert felt(session, other) < 0.4 * 10 ** (-60 / 20) or not session._sources[other].is_on


def test_a_source_is_felt_while_a_worker_prepares_its_new_loop(
    bundle: HapticBundle, monkeypatch: pytest.MonkeyPatch
) -> None:
    source = next(iter(bundle.loops))
    session = HapticSession(bundle)
    before = felt(session, source)
    prepared: Future[prepared_loops.PreparedLoop] = Future()
    monkeypatch.setattr(loop_mixers, "order", lambda *_: prepared)
    touch, edited = Touch("left", source, session.poses[source].position_m), buzz(60.0)
    for times in (0.5, 1.0):  # a second edit comes before the first is prepared
        samples = (times * edited.tactile.samples).astype(np.float32)
        loop = replace(edited, tactile=AudioClip(samples, RATE))
        session.use_bundle(with_loops(bundle, source, ringing=loop))
        for _ in range(20):
            session.update(touches=[touch])
            assert np.abs(session.render(960)[:, 0]).max() == pytest.approx(before, rel=0.1)
    rate_hz = session.config.tactile_rate_hz
    prepared.set_result(prepared_loops.prepare(loop.tactile, session.config.bands, rate_hz))
    peaks = []
    for _ in range(20):
        session.update(touches=[touch])
        peaks.append(np.abs(session.render(960)[:, 0]).max())
    assert min(peaks) > 0.2
    assert peaks[-1] == pytest.approx(0.4, rel=0.02)


def test_use_bundle_warns_of_no_added_object(bundle: HapticBundle) -> None:
    """A source becomes an unknown object, as when the correction of its name is undone."""
    source = next(iter(bundle.loops))
    unknown = replace(bundle.objects[source], object_category="unknown", material=None, vibrates=False, states=())
    others = {key: states for key, states in bundle.loops.items() if key != source}
    session = HapticSession(bundle)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        session.use_bundle(replace(bundle, objects={**bundle.objects, source: unknown}, loops=others))
    assert source not in session.source_ids
    item = replace(bundle.snapshot.object(source), id="another", name="another")
    with pytest.warns(SceneWarning, match="'another', of unknown material, is added without loops"):
        session.add(item, unknown)


def test_use_bundle_keeps_states_set_by_the_game(bundle: HapticBundle) -> None:
    source = next(iter(bundle.loops))
    both = with_loops(bundle, source, low=buzz(60.0), high=buzz(90.0))
    session = HapticSession(both)
    session.set_source(source, state="high", gain_db=-6.0)
    session.use_bundle(with_loops(bundle, source, low=buzz(70.0), high=buzz(95.0)))
    assert session._sources[source].state == "high"
    assert session._sources[source].level.factor == pytest.approx(10 ** (-6 / 20))
    session = HapticSession(both)
    session.use_bundle(with_loops(bundle, source, high=buzz(90.0), low=buzz(60.0)))
    assert session._sources[source].state == "high"
    session.use_bundle(with_loops(bundle, source, off_peak=buzz(80.0)))
    assert session._sources[source].state == "off_peak"


def test_use_bundle_applies_levels_mutes_and_silence(bundle: HapticBundle) -> None:
    source, other = bundle.loops
    session = HapticSession(bundle)
    before = felt(session, source)
    session.use_bundle(bundle.override(source, gain_db=-6.0))
    assert felt(session, source) == pytest.approx(before * 10 ** (-6 / 20), rel=1e-3)
    session.use_bundle(bundle.override(source, muted=True))
    assert felt(session, source) < 1e-6
    session.use_bundle(bundle.override(source, vibrates=False).override(other, vibrates=False))
    assert session.source_ids == ()
    session.use_bundle(bundle)
    assert felt(session, source) == pytest.approx(before, rel=1e-3)


def test_use_bundle_keeps_removed_objects_removed(bundle: HapticBundle) -> None:
    source = next(iter(bundle.loops))
    session = HapticSession(bundle)
    session.remove(source)
    session.use_bundle(with_loops(bundle, source, ringing=buzz(60.0)))
    assert source not in session.object_ids
    session.add(bundle.snapshot.object(source))
    assert felt(session, source) == pytest.approx(0.4, rel=0.02)


def test_a_scene_of_one_object_takes_a_corrected_bundle(bundle: HapticBundle) -> None:
    from scene2hap import SceneSnapshot

    source = next(iter(bundle.loops))
    alone = SceneSnapshot("one", bundle.snapshot.up_axis, (bundle.snapshot.object(source),))
    one = replace(
        bundle, snapshot=alone, objects={source: bundle.objects[source]}, loops={source: bundle.loops[source]}
    )
    session = HapticSession(one)
    session.use_bundle(with_loops(one, source, ringing=buzz(60.0)))
    assert felt(session, source) == pytest.approx(0.4, rel=0.02)


def test_another_scene_is_refused(bundle: HapticBundle) -> None:
    from scene2hap import SceneObject, SceneSnapshot
    from scene2hap.scene.shapes import Box

    other = SceneSnapshot.build([SceneObject("lamp", geometry=Box((0.2, 0.2, 0.3)))])
    session = HapticSession(bundle)
    with pytest.raises(BundleError, match="another scene"):
        session.use_bundle(HapticBundle(other, "room", {}, {}))
    with pytest.raises(BundleError, match="must be a HapticBundle"):
        session.use_bundle("kitchen.bundle")


def until(condition: object, watch: BundleWatch) -> None:
    end = time.monotonic() + 60
    while not condition():
        assert time.monotonic() < end, watch.problem
        time.sleep(0.01)


def test_a_saved_bundle_and_one_edited_by_hand_are_followed(bundle: HapticBundle, tmp_path: Path) -> None:
    source = next(iter(bundle.loops))
    folder = bundle.save(tmp_path / "b")
    session = HapticSession(folder)
    with BundleWatch(session, folder) as watch:
        assert not watch.update()
        bundle.override(source, gain_db=-6.0).save(folder)
        until(watch.update, watch)
        assert session._sources[source].level.factor == pytest.approx(10 ** (-6 / 20))

        rows = json.loads((folder / "overrides.json").read_text(encoding="utf-8"))
        rows[source]["gain_db"] = -12.0
        (folder / "overrides.json").write_text(json.dumps(rows), encoding="utf-8")
        until(watch.update, watch)
        assert session._sources[source].level.factor == pytest.approx(10 ** (-12 / 20))

        (folder / "overrides.json").write_text("{half", encoding="utf-8")
        until(lambda: watch.problem, watch)
        assert not watch.update()
        assert "overrides.json" in watch.problem
        bundle.save(folder)
        until(watch.update, watch)
        assert watch.problem == ""
    watch.close()


def test_a_folder_that_is_gone_while_it_is_listed_does_not_end_the_watch(
    bundle: HapticBundle, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As while a bundle is replaced: the parent is listed before, and its folder after."""
    folder = bundle.save(tmp_path / "b")
    session, listed, n_gone = HapticSession(folder), os.scandir, 0

    def scandir(path: str) -> Any:
        nonlocal n_gone
        if os.path.basename(path) == "sounds":
            n_gone += 1
            raise FileNotFoundError(path)
        return listed(path)

    with BundleWatch(session, folder) as watch:
        with monkeypatch.context() as patched:
            patched.setattr(os, "scandir", scandir)
            until(lambda: n_gone > 2, watch)
        bundle.override(next(iter(bundle.loops)), gain_db=-6.0).save(folder)
        until(watch.update, watch)


@pytest.mark.parametrize("step", range(20))
def test_a_bundle_that_is_read_during_an_update_is_not_lost(bundle: HapticBundle, tmp_path: Path, step: int) -> None:
    """The worker may publish a bundle between any two steps of `update` in Python's interpreter."""
    watch = BundleWatch(HapticSession(bundle), bundle.save(tmp_path / "b"))
    watch.close()
    n_steps = 0

    def between_steps(frame: FrameType, event: str, _: object) -> object:
        nonlocal n_steps
        frame.f_trace_opcodes = True
        if event == "opcode" and frame.f_code.co_filename == bundle_watch.__file__:
            n_steps += 1
            if n_steps == step + 1:
                watch._load()
        return between_steps

    before = sys.gettrace()
    sys.settrace(between_steps)
    was_new = watch.update()
    sys.settrace(before)
    if n_steps > step:
        assert was_new or watch.update()


def test_following_a_bundle_needs_a_folder(bundle: HapticBundle, tmp_path: Path) -> None:
    with pytest.raises(BundleError, match="no folder"):
        BundleWatch(HapticSession(bundle), tmp_path / "none")
