"""The commands and code of docs/designer.md run as written."""

from __future__ import annotations

import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import soundfile

from command_line_page import PAGE, page
from foreground import IN_FOREGROUND
from pasted import run_pasted
from scene2hap import (
    Box,
    BundleWatch,
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
from scene2hap.audio.encoding import encoded
from scene2hap.audio.sensation import LevelWarning
from scene2hap.baking.config import BakeConfig
from scene2hap.bundle import BundleWarning
from scene2hap.cli import main
from scene2hap.cli.settings import TABLES, setting_rows
from scene2hap.session import SessionConfig
from small_kitchen import small_kitchen

pytestmark = pytest.mark.usefixtures("short_tones")

TEXT = (Path(__file__).parents[2] / "docs" / "designer.md").read_text(encoding="utf-8")

NAMED = ("handheld_fan", "smartphone", "dining_table", "microwave", "fruit_bowl", "cooker_hood", "saucepan")
"""The objects of the demo kitchen that the commands of the page name."""


def tone(path: Path, frequency_hz: float) -> Path:
    t = np.arange(2 * 44100) / 44100
    path.write_bytes(encoded((0.5 * np.sin(2 * np.pi * frequency_hz * t)).astype(np.float32), 44100))
    return path


@pytest.fixture(scope="module")
def baked(tmp_path_factory: pytest.TempPathFactory) -> Path:
    work = tmp_path_factory.mktemp("baked")
    scene = load_scene(small_kitchen(work / "kitchen.glb", "floor", "dining_table", "smartphone"))
    return bake(scene).save(work / "kitchen.bundle")


@pytest.fixture
def folder(baked: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the bundle of a smartphone on a table in the working folder."""
    monkeypatch.chdir(tmp_path)
    return shutil.copytree(baked, tmp_path / "kitchen.bundle")


@pytest.fixture
def fan(tmp_path: Path) -> Path:
    """The bundle of a fan beside a refrigerator."""
    things = [
        SceneObject("handheld_fan", "Handheld fan", Pose((0.0, 0.1, 0.0)), Box((0.1, 0.2, 0.06))),
        SceneObject("refrigerator", "Refrigerator", Pose((2.0, 0.9, 0.0)), Box((0.7, 1.8, 0.7))),
    ]
    return bake(SceneSnapshot.build(things)).save(tmp_path / "fan.bundle")


def outcome(capsys: pytest.CaptureFixture[str], *words: str) -> dict[str, object]:
    capsys.readouterr()
    assert main([*words, "--json"]) == 0
    found: dict[str, object] = json.loads(capsys.readouterr().out)
    return found


def test_designer_page_runs_as_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    small_kitchen(tmp_path / "kitchen.glb", *NAMED, "worktop")
    (tmp_path / "my_sounds").mkdir()
    tone(tmp_path / "my_sounds" / "smartphone buzzing.wav", 180.0)
    tone(tmp_path / "my_fan.wav", 110.0)
    lines = re.findall(r"^scene2hap .*$", TEXT, re.MULTILINE)
    assert len(lines) > 12
    for line in lines:
        words = shlex.split(line, comments=True)[1:]
        if words[0] != "play" and "--watch" not in words:  # these need a terminal, and run until stopped
            briefly = ["--seconds", "0.2", "--sink", "memory"] if words[0] == "audition" else []
            assert main([*words, *briefly, "-q"]) == 0, line
    bundle = HapticBundle.load("kitchen.bundle")
    assert bundle.is_muted("microwave")
    assert not {"cooker_hood", "saucepan"} & bundle.loops.keys()
    (code,) = re.findall(r"```python\n(.*?)```", TEXT, re.DOTALL)
    run_pasted(code, tmp_path)


def test_intensity_changes_the_level_of_one_state(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    before = HapticBundle.load(folder)
    (state,) = before.loops["smartphone"]
    words = ["edit", str(folder), "intensity", "smartphone", "0.1", "--state", state]
    remade = outcome(capsys, *words)["remade"]
    assert isinstance(remade, dict)
    assert remade["smartphone"] == {state: ["intensity"]}
    after = HapticBundle.load(folder)
    assert after.objects["smartphone"].states[0].intensity == 0.1
    assert after.objects["smartphone"].provenance["intensity"] == "user"
    quiet, loud = (np.abs(one.loops["smartphone"][state].tactile.samples).max() for one in (after, before))
    assert quiet < 0.5 * loud


def test_pitch_moves_the_felt_frequency_within_the_band(fan: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["edit", str(fan), "pitch", "handheld_fan", "90", "-q"]) == 0
    loop = HapticBundle.load(fan).loops["handheld_fan"]["on"]
    spectrum = np.abs(np.fft.rfft(loop.tactile.samples))
    strongest_hz = spectrum.argmax() * loop.tactile.sample_rate_hz / len(loop.tactile.samples)
    assert strongest_hz == pytest.approx(90.0, rel=0.05)
    with (
        pytest.warns(BundleWarning, match="plays 130 to 230 Hz. The loop is at 130 Hz"),
        pytest.warns(LevelWarning, match="has its pitch at 130 Hz, but is felt 10 dB weaker"),
    ):
        rebaked = rebake(str(fan), {"actuator": "lra"})
    assert rebaked.loops["handheld_fan"]["on"].frequency_tactile_hz == pytest.approx(130.0, rel=0.05)
    with pytest.warns(BundleWarning, match="Lowpass does not move sources"):
        rebake(str(fan), {"tactile": "lowpass"})
    assert main(["edit", str(fan), "rebake", "--actuator", "lra", "-q"]) == 0
    assert main(["edit", str(fan), "pitch", "handheld_fan", "90"]) == 1
    assert "130 to 230 Hz" in capsys.readouterr().err


def test_locked_loops_refuse_changes(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["edit", str(folder), "lock", "smartphone", "-q"]) == 0
    for verb, value in (("intensity", "0.1"), ("pitch", "90"), ("sound", str(tone(folder.parent / "s.wav", 90.0)))):
        assert main(["edit", str(folder), verb, "smartphone", value]) == 1
        assert "locked" in capsys.readouterr().err
    assert main(["edit", str(folder), "gain", "smartphone", "-3", "-q"]) == 0


def test_a_muted_source_is_silent_until_the_game_unmutes_it(folder: Path) -> None:
    assert main(["edit", str(folder), "mute", "smartphone", "-q"]) == 0
    bundle = HapticBundle.load(folder)
    session = HapticSession(bundle)
    touch = Touch("left", "smartphone", bundle.snapshot.object("smartphone").pose.position_m)
    assert session.update(touches=[touch]).gain("left", "smartphone") == 0.0
    session.set_source("smartphone", mute=False)
    assert session.update(touches=[touch]).gain("left", "smartphone") > 0.1


def test_audition_takes_a_profile_of_the_other_hand_without_a_warning(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    profile = Path("ada.json")
    hands = {"left": {"gain_db": -20.0}, "right": {"gain_db": -6.0}}
    peaks = []
    for named in ({}, {"left": hands["left"]}, hands):
        profile.write_text(json.dumps({"user": {"hands": named}}), encoding="utf-8")
        words = ["audition", str(folder), "smartphone", "-o", "phone.wav", "--seconds", "1", "--profile", str(profile)]
        assert main([*words, "-q"]) == 0
        assert capsys.readouterr().err == ""
        peaks.append(float(np.abs(soundfile.read("phone.wav")[0]).max()))
    assert peaks[1] == peaks[0]  # the hand of an audition is the right one
    assert peaks[2] == pytest.approx(peaks[0] * 10 ** (-6 / 20), rel=0.01)


def test_audition_writes_one_source_alone(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["edit", str(folder), "mute", "smartphone", "-q"]) == 0  # an audition also plays muted sources
    assert outcome(capsys, "audition", str(folder), "smartphone", "-o", "phone.wav", "--seconds", "2")["wav"]
    samples, rate = soundfile.read("phone.wav")
    assert len(samples) >= 2 * rate
    loop = HapticBundle.load(folder).loops["smartphone"]["ringing"].tactile
    assert np.abs(samples).max() == pytest.approx(np.abs(loop.samples).max(), rel=0.1)
    assert main(["audition", str(folder), "dining_table", "-o", "none.wav"]) == 1
    assert "no source 'dining_table'" in capsys.readouterr().err
    no_port = '{"kind": "serial", "port": "/dev/none"}'
    assert main(["audition", str(folder), "smartphone", "--seconds", "0.1", "--sink", no_port]) == 1
    told = " ".join(capsys.readouterr().err.split())
    assert "nothing was played: no serial port /dev/none" in told
    assert told.endswith("Connect the actuator, or write a file with -o.")
    assert "Trying again" not in told
    assert not Path("none.wav").exists()


def test_lists_show_the_accepted_settings(capsys: pytest.CaptureFixture[str]) -> None:
    lists = outcome(capsys, "list")
    assert list(lists) == ["materials", "actuators", "kinds"]
    for name in ("actuators", "kinds"):
        rows = lists[name]
        assert isinstance(rows, list)
        assert all(isinstance(row, dict) and all(key[0] != ">" for key in row) for row in rows)
    assert {"lra", "voice_coil"} <= {row["actuator"] for row in lists["actuators"]}
    kinds = {(row["setting"], row["kind"]) for row in lists["kinds"]}
    assert {("llm", "lexicon"), ("tactile", "adaptive"), ("propagation", "modal_plate"), ("sink", "wav")} <= kinds


def test_every_setting_is_listed_with_its_meaning(capsys: pytest.CaptureFixture[str]) -> None:
    shown = outcome(capsys, "settings")
    assert list(shown) == list(TABLES)
    for name, settings in (("bake", BakeConfig), ("session", SessionConfig)):
        rows = [*setting_rows(settings)]
        assert shown[name] == rows
        assert {row["setting"].partition(".")[0] for row in rows} == set(settings.model_fields)
        for row in rows:
            assert row["meaning"], f"the docstring says nothing of {row['setting']}"
            assert row["type"]
    named = {row["setting"]: row["default"] for row in shown["session"]}
    SessionConfig(**{name: named[name] for name in ("propagation", "bands", "actuator")})  # kinds, not classes


def test_the_page_of_the_command_line_is_up_to_date() -> None:
    assert PAGE.read_text(encoding="utf-8") == page(), "run: python tests/support/command_line_page.py"


def test_help_names_the_documentation(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["--help"])
    assert "docs/README.md" in capsys.readouterr().out


@pytest.mark.skipif(sys.platform == "win32", reason="Ctrl-C is sent as a signal")
def test_a_saved_sound_reaches_a_running_session(fan: Path) -> None:
    """An audio editor saves a file, `edit --watch` makes the loop, and a session that watches the bundle plays it."""
    sound = tone(fan.parent / "mine.wav", 110.0)
    words = ["-m", "scene2hap", "edit", str(fan), "sound", "handheld_fan", str(sound), "--watch"]
    command = [sys.executable, "-c", IN_FOREGROUND, *words]
    session = HapticSession(fan)
    # The watch starts first, since it ignores files saved before.
    with BundleWatch(session, fan) as watch:
        edit = subprocess.Popen(command, env={**os.environ, "PYTHONUNBUFFERED": "1"}, stdout=subprocess.PIPE, text=True)
        try:
            for frequency_hz in (110.0, 170.0):
                if frequency_hz != 110.0:
                    assert edit.stdout is not None
                    while "watching" not in edit.stdout.readline():
                        pass
                    tone(sound, frequency_hz)
                until = time.monotonic() + 120
                while not watch.update():
                    assert time.monotonic() < until, watch.problem
                    time.sleep(0.02)
                (loop,) = session._bundle.loops["handheld_fan"].values()
                assert loop.frequency_raw_hz == pytest.approx(frequency_hz, rel=0.02)
        finally:
            edit.send_signal(signal.SIGINT)
    try:
        edit.communicate(timeout=120)
    finally:
        edit.kill()
    assert edit.returncode == 0
