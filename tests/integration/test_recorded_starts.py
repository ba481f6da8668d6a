"""Recorded starts and stops, from a library file to a session: a machine starts and stops as in its recording."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from scene2hap import HapticBundle, HapticSession, Touch, bake, rebake
from scene2hap.audio.encoding import encoded
from scene2hap.audio.recorded_runs import recorded_runs
from scene2hap.cli import main
from scenes import box, scene
from starting_machines import RATE_HZ as RECORDED_HZ, Signal, machine

RATE_HZ = 48_000
START_S, STOP_S = 2.0, 4.0
# Linear start and stop, unlike the default curves of a session.
TAKE = machine(start_s=START_S, stop_s=STOP_S, rise="linear", fall="linear", n_harmonics=1, seed=3)
ROOM = scene(box("table", (1.6, 0.02, 0.8), (0.8, 0.71, 0.4)), box("fan", (0.2, 0.2, 0.2), (0.4, 0.82, 0.4)))
TOUCH = [Touch("left", "fan", (0.4, 0.92, 0.4))]
WINDOW = RATE_HZ // 10


@pytest.fixture(scope="module")
def baked(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("recorded")
    sounds = folder / "sounds"
    sounds.mkdir()
    (sounds / "fan.wav").write_bytes(encoded(TAKE.clip.samples, RECORDED_HZ))
    made = bake(ROOM, {"llm": {"kind": "lexicon"}, "audio": [{"kind": "library", "folder": sounds}, {"kind": "synth"}]})
    return made.save(folder / "room.bundle")


def feel(session: HapticSession, seconds: float) -> Signal:
    """The samples of the left hand over some seconds."""
    blocks = []
    for _ in range(round(seconds * 50)):
        session.update(touches=TOUCH)
        blocks.append(session.render(RATE_HZ // 50)[:, 0])
    return np.concatenate(blocks).astype(np.float64)


def levels(x: Signal) -> Signal:
    """RMS of windows of 0.1 s."""
    return np.asarray(np.sqrt((x[: len(x) // WINDOW * WINDOW].reshape(-1, WINDOW) ** 2).mean(axis=1)))


def pitches_hz(x: Signal) -> Signal:
    """Pitch of windows of 0.1 s, from the zero crossings between the first and the last of each window."""
    found = []
    for window in x[: len(x) // WINDOW * WINDOW].reshape(-1, WINDOW):
        k = np.flatnonzero(np.signbit(window[1:]) != np.signbit(window[:-1]))
        at = k + window[k] / (window[k] - window[k + 1])
        found.append((len(at) - 1) / 2 / (at[-1] - at[0]) * RATE_HZ if len(at) > 2 else 0.0)
    return np.array(found)


def high_db(x: Signal) -> float:
    power = np.abs(np.fft.rfft(x * np.hanning(len(x)))) ** 2
    return float(10 * np.log10(power[np.fft.rfftfreq(len(x), 1 / RATE_HZ) > 1000].sum() / power.sum()))


def test_bundle_states_the_recorded_times(baked: Path, capsys: pytest.CaptureFixture[str]) -> None:
    bundle = HapticBundle.load(baked)
    (state,) = bundle.objects["fan"].states
    loop = bundle.loops["fan"][state.name]
    assert loop.start_up is not None
    assert loop.wind_down is not None
    assert state.start_up_s == loop.start_up.lasts_s == pytest.approx(START_S, rel=0.15)
    assert state.wind_down_s == loop.wind_down.lasts_s == pytest.approx(STOP_S, rel=0.15)
    assert (loop.start_up.inferred_s, loop.wind_down.inferred_s) == (1.5, 3.0)  # the times of the lexicon's fan
    provenance = bundle.objects["fan"].provenance
    assert provenance["start_up_s"] == provenance["wind_down_s"] == "recording"
    assert "has a start of" in bundle.choices["fan"][state.name]
    assert main(["inspect", str(baked), "--json"]) == 0
    shown = json.loads(capsys.readouterr().out)["objects"]["fan"]["states"][state.name]
    assert shown["start_up_s"] == shown["recorded_start_up_s"] == state.start_up_s


def test_a_hand_feels_the_recorded_start_and_stop(baked: Path) -> None:
    found = recorded_runs(TAKE.clip.samples, RECORDED_HZ)
    assert found.start_up is not None
    assert found.wind_down is not None
    with HapticSession(ROOM, HapticBundle.load(baked), {"prepare": "blocking"}) as session:
        steady = feel(session, 1.0)
        session.set_source("fan", on=False)
        down = feel(session, STOP_S + 1.0)
        session.set_source("fan", on=True)
        up = feel(session, START_S + 1.0)
    level, pitch_hz = levels(steady)[-5:].mean(), pitches_hz(steady)[-5:].mean()
    begin_s = found.first / RECORDED_HZ - found.start_up.lasts_s
    for felt, at_s in ((up, begin_s), (down, found.end / RECORDED_HZ)):
        at = (at_s + (np.arange(len(felt) // WINDOW) + 0.5) * 0.1) * RECORDED_HZ
        amplitude = np.interp(at, np.arange(len(TAKE.amplitude)), TAKE.amplitude)
        speed = np.interp(at, np.arange(len(TAKE.speed)), TAKE.speed)
        is_felt = amplitude > 0.1
        assert np.abs(20 * np.log10(levels(felt)[is_felt] / level / amplitude[is_felt])).max() < 3.0
        assert np.abs(pitches_hz(felt)[is_felt] / pitch_hz / speed[is_felt] - 1).max() < 0.05
    assert np.abs(down[-RATE_HZ // 4 :]).max() == 0.0
    assert levels(up)[-1] == pytest.approx(level, rel=0.1)


def test_interrupted_recorded_starts_cause_no_click(baked: Path) -> None:
    with HapticSession(ROOM, HapticBundle.load(baked), {"prepare": "blocking"}) as session:
        parts = [feel(session, 0.5)]
        for seconds in (1.0, 0.7, 0.3, 0.9, 0.1, 2.5, 5.0, 3.0):
            session.set_source("fan", on=len(parts) % 2 == 0)
            parts.append(feel(session, seconds))
    steady = levels(parts[0])[-1]
    x = np.concatenate(parts)
    assert high_db(x) < -60.0
    ends = np.cumsum([len(part) for part in parts])
    for end in ends[:-1]:  # the level continues without a jump
        before, after = (np.sqrt(np.mean(x[a:b] ** 2)) for a, b in ((end - 2400, end), (end + 1200, end + 3600)))
        assert abs(after - before) < 0.25 * steady


def test_loop_is_at_its_position_after_a_recorded_start(baked: Path) -> None:
    bundle = HapticBundle.load(baked)
    ends = []
    for is_switched in (True, False):
        with HapticSession(ROOM, bundle, {"prepare": "blocking"}) as session:
            feel(session, 0.5)
            for on in (False, True):
                if is_switched:
                    session.set_source("fan", on=on)
                feel(session, STOP_S + 1.0)
            ends.append((session.position_s("fan"), feel(session, 0.2)))
    assert ends[0][0] == ends[1][0]
    np.testing.assert_allclose(ends[0][1], ends[1][1], atol=1e-4)


def test_override_outranks_the_recording_and_a_new_sound_restores_inferred_times(baked: Path, tmp_path: Path) -> None:
    bundle = HapticBundle.load(baked)
    shorter = bundle.override("fan", start_up_s=0.5)
    again = HapticBundle.load(rebake(shorter).save(tmp_path / "b"))
    (state,) = again.objects["fan"].states
    assert state.start_up_s == 0.5
    assert again.objects["fan"].provenance["start_up_s"] == "user"
    assert again.loops["fan"][state.name].start_up == bundle.loops["fan"][state.name].start_up
    steady = machine(n_harmonics=1).clip
    (state,) = rebake(bundle.override("fan", clip=steady)).objects["fan"].states
    assert (state.start_up_s, state.wind_down_s) == (1.5, 3.0)
