"""Times of starts and stops: precedence of recorded, inferred and overridden times."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from scene2hap import HapticBundle, HapticLoop, ObjectHaptics, SourceState, bake, rebake
from scene2hap.audio.run_curve import RunCurve
from scene2hap.baking.recorded_times import NO_RUNS, RECORDING, shown_runs, with_recorded_times
from scene2hap.bundle.differences import differences
from scene2hap.errors import BundleError
from scenes import haptics, tone_loop
from scripted_backend import SCENE
from starting_machines import machine

pytestmark = pytest.mark.usefixtures("short_tones")

START, STOP = RunCurve(2.0, (0.0, 0.4, 1.0)), RunCurve(3.0, (1.0, 0.4, 0.0))
STATE = SourceState("on", 0.5, "fan whirring", "fan whirring", start_up_s=1.0, wind_down_s=4.0, spins=True)

# Some scenes here have objects in the air.
scenes_in_the_air = pytest.mark.filterwarnings("ignore::scene2hap.SceneWarning")


def fan(**state: Any) -> ObjectHaptics:
    return replace(haptics("oak", (0.2, 0.2, 0.1), "on"), states=(replace(STATE, **state),))


def recorded(start: RunCurve | None, stop: RunCurve | None) -> HapticLoop:
    return replace(tone_loop(100.0), start_up=start, wind_down=stop)


def times(found: dict[str, ObjectHaptics]) -> tuple[float, float]:
    (state,) = found["fan"].states
    return state.start_up_s, state.wind_down_s


def test_recorded_times_replace_inferred_times() -> None:
    start, stop = shown_runs((START, STOP), STATE, None)
    assert start is not None
    assert stop is not None
    assert (start.inferred_s, stop.inferred_s) == (1.0, 4.0)
    found = with_recorded_times({"fan": fan()}, {"fan": {"on": recorded(start, stop)}}, {})
    assert times(found) == (2.0, 3.0)
    assert found["fan"].provenance == {"start_up_s": RECORDING, "wind_down_s": RECORDING}


def test_missing_recorded_time_keeps_the_inferred_one() -> None:
    found = with_recorded_times({"fan": fan()}, {"fan": {"on": recorded(START, None)}}, {})
    assert times(found) == (2.0, 4.0)
    assert found["fan"].provenance == {"start_up_s": RECORDING}


def test_edited_time_is_kept_until_the_recording_changes() -> None:
    start, _ = shown_runs((START, None), STATE, None)
    before = {"fan": {"on": recorded(start, None)}}
    edited = fan(start_up_s=7.0)
    same, _ = shown_runs((START, None), edited.states[0], before["fan"]["on"])
    assert same is start
    assert times(with_recorded_times({"fan": edited}, {"fan": {"on": recorded(same, None)}}, before)) == (7.0, 4.0)
    assert times(with_recorded_times({"fan": edited}, {"fan": {"on": recorded(None, None)}}, before)) == (7.0, 4.0)
    other, _ = shown_runs((RunCurve(5.0, (0.0, 1.0)), None), edited.states[0], before["fan"]["on"])
    assert times(with_recorded_times({"fan": edited}, {"fan": {"on": recorded(other, None)}}, before)) == (5.0, 4.0)


def test_recording_without_times_restores_inferred_times() -> None:
    start, _ = shown_runs((START, None), STATE, None)
    before = {"fan": {"on": recorded(start, None)}}
    first = with_recorded_times({"fan": fan()}, before, {})
    found = with_recorded_times(first, {"fan": {"on": recorded(None, None)}}, before)
    assert times(found) == (1.0, 4.0)
    assert found["fan"].provenance == {}


def test_spinning_source_with_constant_pitch_counts_as_faded_by_an_editor() -> None:
    faded = RunCurve(2.0, (0.0, 1.0), (1.0, 1.0))
    assert shown_runs((faded, faded), STATE, None) == NO_RUNS
    start, stop = shown_runs((faded, faded), replace(STATE, spins=False), None)
    assert start is not None
    assert stop is not None


@scenes_in_the_air
def test_user_clip_brings_and_removes_its_recorded_start(tmp_path: Path) -> None:
    bundle = bake(SCENE, {"llm": {"kind": "lexicon"}})
    plain = {state.name: state.start_up_s for state in bundle.objects["phone"].states}
    name = next(iter(plain))
    take = machine(start_s=1.5, frequency_hz=150.0).clip
    own = rebake(bundle.override("phone", clip=take))
    curve = own.loops["phone"][name].start_up
    assert curve is not None
    assert curve.lasts_s == pytest.approx(1.5, rel=0.15)
    assert own.objects["phone"].states[0].start_up_s == curve.lasts_s
    samples = own.loops["phone"][name].audible.samples
    peaks = [np.abs(part).max() for part in np.array_split(samples, 50)]
    assert min(peaks) > 0.6 * max(peaks)  # the loop does not contain the start
    quick = rebake(bundle.override("phone", clip=take, start_up_s=0.5)).objects["phone"].states[0]
    assert quick.start_up_s == 0.5  # a person's time outranks the recording's
    folder = own.save(tmp_path / "own")
    loaded = HapticBundle.load(folder)
    assert loaded.loops["phone"][name].start_up == curve
    remade: dict[str, Any] = {}
    again = rebake(loaded, on_remade=remade.update)
    assert remade == {}
    assert again.loops["phone"][name].start_up == curve
    assert any(row.what == f"start {name}" for row in differences(bundle, again))
    rows = json.loads((folder / "overrides.json").read_text("utf-8"))
    del rows["phone"]
    (folder / "overrides.json").write_text(json.dumps(rows), "utf-8")
    without = rebake(HapticBundle.load(folder))
    assert {state.name: state.start_up_s for state in without.objects["phone"].states} == plain
    assert without.loops["phone"][name].start_up is None


@scenes_in_the_air
def test_old_bundles_have_no_curves_and_invalid_curves_are_refused(tmp_path: Path) -> None:
    folder = bake(SCENE, {"llm": {"kind": "lexicon"}}).save(tmp_path / "b")
    rows = json.loads((folder / "loops.json").read_text("utf-8"))
    row = next(iter(rows["phone"].values()))
    assert "start_up" not in row
    for wrong in ({"lasts_s": 1.0, "amplitude": [0.0, 2.0]}, {"lasts_s": 1.0}, 3, {"amplitude": [0.0, 1.0], "x": 1}):
        row["start_up"] = wrong
        (folder / "loops.json").write_text(json.dumps(rows), "utf-8")
        with pytest.raises(BundleError, match=r"loops\.json"):
            HapticBundle.load(folder)


@scenes_in_the_air
def test_times_are_overridden_by_state_and_bounded() -> None:
    bundle = bake(SCENE, {"llm": {"kind": "lexicon"}})
    name = bundle.objects["phone"].states[0].name
    timed = bundle.override("phone", start_up_s=2.0, wind_down_s={name: 0.0})
    assert (timed.objects["phone"].states[0].start_up_s, timed.objects["phone"].states[0].wind_down_s) == (2.0, 0.0)
    assert timed.objects["phone"].provenance["start_up_s"] == "user"
    with pytest.raises(BundleError, match="at most 30"):
        bundle.override("phone", start_up_s=31.0)
    with pytest.raises(BundleError, match="has no state"):
        bundle.override("phone", wind_down_s={"flying": 1.0})
