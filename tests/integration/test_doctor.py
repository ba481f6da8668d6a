"""`scene2hap doctor`, as a person runs it."""

import json
from pathlib import Path

import numpy as np
import pytest
import soundfile

from scene2hap.cli import doctor, main


def test_it_tells_every_extra(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["doctor", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert {"dae", "mujoco", "panda3d", "pictures", "serial", "soundcard"} <= {row["extra"] for row in told["extras"]}
    assert set(told) >= {"sound_cards", "serial_ports", "python"}


def test_a_missing_package_is_told_with_its_command(monkeypatch: pytest.MonkeyPatch) -> None:
    def absent(name: str) -> str:
        raise doctor.metadata.PackageNotFoundError(name)

    monkeypatch.setattr(doctor.metadata, "version", absent)
    hints = {row["extra"]: row["hint"] for row in doctor.extras()}
    assert hints["soundcard"] == 'pip install "scene2hap[soundcard]"'


def test_the_sweep_visits_one_hand_after_the_other_and_is_quiet(tmp_path: Path) -> None:
    path = tmp_path / "sweep.wav"
    assert main(["doctor", "-q", "--sweep", json.dumps({"kind": "wav", "path": str(path)})]) == 0
    samples, rate = soundfile.read(path)
    turn = round((doctor.SWEEP_S + doctor.PAUSE_S) * rate)
    peaks = np.array([np.abs(samples[i * turn : (i + 1) * turn]).max(axis=0) for i in range(2)])
    assert peaks[0] == pytest.approx([0.1, 0.0], abs=2e-3)
    assert peaks[1] == pytest.approx([0.0, 0.1], abs=2e-3)
    # The frequency rises by the same factor in equal times: zero crossings of the first and the last fifth of a second.
    crossings = np.flatnonzero(np.diff(np.signbit(samples[: round(2 * rate), 0]))) / rate
    early, late = ((crossings < 0.3) & (crossings > 0.1)).sum(), ((crossings > 1.7) & (crossings < 1.9)).sum()
    assert late / early == pytest.approx(10 ** (1.6 / 2.0), rel=0.1)


@pytest.mark.parametrize(("sink", "sentence"), [("nothing", "nothing"), ("{oops", "no JSON")])
def test_a_sink_that_is_none(sink: str, sentence: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["doctor", "-q", "--sweep", sink]) == 1
    assert sentence in capsys.readouterr().err
