"""The command ``scene2hap convert``: files, folders, tables, JSON and errors."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import soundfile

from scene2hap import audio
from scene2hap.audio.conversion import Conversion
from scene2hap.audio.tactile import CONVERTERS, DEFAULT_CONVERTER
from scene2hap.audio.threshold import threshold_db
from scene2hap.baking import BakeConfig
from scene2hap.cli import main

pytestmark = pytest.mark.filterwarnings("ignore::scene2hap.audio.conversion.LevelWarning")

RATE = 8000


def hum(path: Path, frequency_hz: float = 98.0) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    soundfile.write(path, 0.5 * np.sin(2 * np.pi * frequency_hz * np.arange(3 * RATE) / RATE), RATE)
    return path


def test_command_converts_a_file_and_prints_a_table(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    source, output = hum(Path("hum.wav")), Path("felt.flac")
    assert main(["convert", str(source), "-o", str(output), "--picture"]) == 0
    shown = capsys.readouterr().out
    assert "1 file, 3.0 s of sound" in shown
    felt, _ = soundfile.read(output)
    assert len(felt) == 3 * RATE
    # 0.5 is -6.0 dB; the other values are from the file.
    cells = ("felt.flac", "3.00", "-6.0", f"{20 * np.log10(np.abs(felt).max()):.1f}", "98.00")
    assert [cell in shown for cell in cells] == [True] * 5
    assert output.with_suffix(".png").stat().st_size > 10_000


def test_converter_actuator_and_format_are_chosen_by_name(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = hum(tmp_path / "in" / "hum.wav").parent
    response = tmp_path / "mine.csv"
    response.write_text("Hz,dB\n50,-10\n150,0\n400,-8\n")
    chosen = ["--converter", '{"kind": "svf_bandpass", "q": 5}', "--actuator", str(response), "--format", "flac"]
    chosen += ["--intensity", "0.05"]
    assert main(["convert", str(folder), "-o", str(tmp_path / "out"), "--json", "--workers", "1", *chosen]) == 0
    [made] = json.loads(capsys.readouterr().out)["converted"]
    assert made["output"] == str(tmp_path / "out" / "hum.flac")
    assert made["frequency_out_hz"] == pytest.approx(98.0, abs=0.02)
    # The response is 3.9 dB lower at 98 Hz, so that the drive must be 3.9 dB higher than at 0 dB.
    assert made["level_db"] == pytest.approx(made["asked_level_db"], abs=0.1)
    assert 20 * np.log10(made["peak_out"]) == pytest.approx(threshold_db(98.0) + made["asked_level_db"] + 3.9, abs=2.5)


def test_bad_file_is_reported_and_others_are_converted(tmp_path: Path) -> None:
    good, bad = hum(tmp_path / "good.wav"), tmp_path / "bad.wav"
    bad.write_text("not a sound")
    command = [sys.executable, "-m", "scene2hap", "convert", str(bad), str(good), "-o", str(tmp_path / "out")]
    run = subprocess.run([*command, "--json", "--workers", "2"], capture_output=True, text=True, check=False)
    assert run.returncode == 1
    assert "bad.wav: not a readable sound" in run.stderr
    assert "1 of 2 files were not converted" in run.stderr
    assert "Traceback" not in run.stderr
    outcome = json.loads(run.stdout)
    assert [row["source"] for row in outcome["failed"]] == [str(bad)]
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["good.wav"]


def test_existing_files_are_kept_unless_forced(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    source, output = hum(tmp_path / "hum.wav"), tmp_path / "felt.wav"
    output.write_bytes(b"mine")
    assert main(["convert", str(source), "-o", str(output), "-q"]) == 1
    assert "--force" in capsys.readouterr().err
    assert output.read_bytes() == b"mine"
    assert main(["convert", str(source), "-o", str(output), "-q", "--force"]) == 0
    assert soundfile.info(output).frames == 3 * RATE


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (["--converter", "nope"], "no kind 'nope'"),
        (["--converter", "{broken"], "--converter is no JSON"),
        (["--actuator", "nope"], "actuator is 'nope'"),
        (["--intensity", "2"], "intensity is 2"),
        (["--workers", "0"], "--workers is 0"),
    ],
)
def test_invalid_settings_give_a_one_line_error(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], reason: str
) -> None:
    source = hum(tmp_path / "hum.wav")
    assert main(["convert", str(source), "-o", str(tmp_path / "out"), *arguments]) == 1
    told = capsys.readouterr().err
    assert reason in told
    assert told.count("error:") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["hum.wav"]


def test_one_converter_is_the_default_everywhere(tmp_path: Path) -> None:
    """The command, the functions and baking use the same default, which docs/conversion.md names."""
    source = hum(tmp_path / "hum.wav")
    by_name = audio.convert(source, tmp_path / "a.wav", converter=DEFAULT_CONVERTER).output.read_bytes()
    assert audio.convert(source, tmp_path / "b.wav").output.read_bytes() == by_name
    (many,) = audio.convert_files([source], tmp_path / "c.wav")
    assert isinstance(many, Conversion)
    assert many.output.read_bytes() == by_name
    assert main(["convert", str(source), "-o", str(tmp_path / "d.wav"), "-q"]) == 0
    assert (tmp_path / "d.wav").read_bytes() == by_name
    assert BakeConfig().tactile == CONVERTERS.build(DEFAULT_CONVERTER)
    page = (Path(__file__).parents[2] / "docs" / "conversion.md").read_text(encoding="utf-8")
    assert re.findall(r"^\| `(\w+)` \(default\)", page, re.MULTILINE) == [DEFAULT_CONVERTER]
