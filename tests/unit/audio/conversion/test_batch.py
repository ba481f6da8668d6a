from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import soundfile

from scene2hap import audio
from scene2hap.audio.conversion import Conversion, Failure, batch
from scene2hap.errors import AudioError, ConfigError

RATE = 8000
TONE = 0.4 * np.sin(2 * np.pi * 100 * np.arange(RATE) / RATE)


def write(path: Path) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    soundfile.write(path, TONE, RATE)
    return path


def test_batch_keeps_folder_structure_and_goes_on_after_a_failure(tmp_path: Path) -> None:
    write(tmp_path / "in" / "a.wav")
    write(tmp_path / "in" / "deep" / "b.flac")
    (tmp_path / "in" / "notes.txt").write_text("not a sound, and not asked for")
    (tmp_path / "in" / "broken.wav").write_text("not a sound")
    single = write(tmp_path / "c.ogg")
    told: list[tuple[int, int]] = []
    outcomes = audio.convert_files(
        [tmp_path / "in", single, tmp_path / "absent.wav"],
        tmp_path / "out",
        workers=1,
        progress=lambda name, done, total: told.append((done, total)),
    )
    assert [type(outcome) for outcome in outcomes] == [Conversion, Failure, Conversion, Conversion, Failure]
    written = sorted(str(path.relative_to(tmp_path / "out")) for path in (tmp_path / "out").rglob("*.*"))
    assert written == ["a.wav", "c.wav", "deep/b.wav"]
    reasons = [outcome.reason for outcome in outcomes if isinstance(outcome, Failure)]
    assert "broken.wav: not a readable sound" in reasons[0]
    assert "absent.wav is not a file" in reasons[1]
    assert told == [(i, 5) for i in range(1, 6)]


def test_several_worker_processes_write_the_same_bytes_as_one(tmp_path: Path) -> None:
    sources = [write(tmp_path / name) for name in ("a.wav", "b.wav", "c.wav")]
    sources[1].write_text("not a sound")
    for workers in (1, 2):
        outcomes = audio.convert_files(sources, tmp_path / str(workers), workers=workers)
        assert [type(outcome) for outcome in outcomes] == [Conversion, Failure, Conversion]
    for name in ("a.wav", "c.wav"):
        assert (tmp_path / "1" / name).read_bytes() == (tmp_path / "2" / name).read_bytes()


def test_short_sounds_start_no_processes_and_many_bytes_of_them_do(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A process takes half a second to start, and a sound of some seconds 0.04 s to convert."""
    begun = []

    def refused(n_workers: int) -> None:
        begun.append(n_workers)
        raise AudioError("no pool in this test")

    monkeypatch.setattr(batch, "worker_processes", refused)
    monkeypatch.setattr(batch.os, "cpu_count", lambda: 4)
    sources = [write(tmp_path / f"{n}.wav") for n in range(5)]
    assert all(isinstance(one, Conversion) for one in audio.convert_files(sources, tmp_path / "short"))
    assert not begun
    monkeypatch.setattr(batch, "_WORTH_BYTES", 2 * sources[0].stat().st_size)
    with pytest.raises(AudioError, match="no pool"):
        audio.convert_files(sources, tmp_path / "long")
    assert begun == [3]  # five sounds, two of which are worth a process
    with pytest.raises(AudioError, match="no pool"):
        audio.convert_files(sources, tmp_path / "asked", workers=2)
    assert begun == [3, 2]


def test_second_run_skips_outputs_of_the_first_run(tmp_path: Path) -> None:
    write(tmp_path / "a.wav")
    for _ in range(2):
        outcomes = audio.convert_files([tmp_path], tmp_path / "felt", workers=1, overwrite=True)
        assert [outcome.source.name for outcome in outcomes] == ["a.wav"]


def test_batch_refuses_second_source_with_the_same_output_name(tmp_path: Path) -> None:
    one, other = write(tmp_path / "1" / "a.wav"), write(tmp_path / "2" / "a.flac")
    first, second = audio.convert_files([one, other], tmp_path / "out", workers=1)
    assert isinstance(first, Conversion)
    assert isinstance(second, Failure)
    assert "Rename one" in second.reason


def test_batch_refuses_invalid_arguments_before_writing_any_file(tmp_path: Path) -> None:
    source = write(tmp_path / "a.wav")
    with pytest.raises(AudioError, match="one file, and there is more than one to make"):
        audio.convert_files([source, source], tmp_path / "out.wav")
    with pytest.raises(AudioError, match="one file, and there is more than one to make"):
        audio.convert_files([tmp_path], source)
    with pytest.raises(AudioError, match=r"no sound file in '.*empty'\. Give WAV"):
        (tmp_path / "empty").mkdir()
        audio.convert_files([tmp_path / "empty"], tmp_path / "out")
    with pytest.raises(AudioError, match=r"suffix is '\.aac'"):
        audio.convert_files([source], tmp_path / "out", suffix=".aac")
    with pytest.raises(ConfigError, match="no kind 'nope'"):
        audio.convert_files([source], tmp_path / "out", converter="nope")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.wav", "empty"]


def test_folders_of_other_kinds_of_sound_are_converted(tmp_path: Path) -> None:
    write(tmp_path / "in" / "hum.aiff")
    write(tmp_path / "in" / "buzz.au")
    (tmp_path / "in" / "notes.txt").write_text("no sound")
    made = audio.convert_files([tmp_path / "in"], tmp_path / "out", workers=1)
    assert [outcome.source.name for outcome in made] == ["buzz.au", "hum.aiff"]
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["buzz.wav", "hum.wav"]


@pytest.mark.parametrize("name", ["felt.xyz", "felt.png"])
def test_an_output_file_of_unknown_format_is_refused(tmp_path: Path, name: str) -> None:
    """It became a folder of this name, without a word."""
    (failure,) = audio.convert_files([write(tmp_path / "hum.wav")], tmp_path / name)
    assert isinstance(failure, Failure)
    assert "must end in one of .wav, .flac, .ogg, .mp3, or be a folder that exists" in failure.reason
    assert not (tmp_path / name).exists()
    (tmp_path / name).mkdir()
    (made,) = audio.convert_files([tmp_path / "hum.wav"], tmp_path / name)
    assert isinstance(made, Conversion)
    assert made.output == tmp_path / name / "hum.wav"


def test_a_script_without_a_guard_of_its_entry_gets_failures_with_advice(tmp_path: Path) -> None:
    """Its workers end before they make the output folder."""
    for i in range(2):
        write(tmp_path / f"{i}.wav")
    script = tmp_path / "unguarded.py"
    script.write_text(
        "import sys\nfrom scene2hap.audio import convert_files\n"
        "for one in convert_files(sys.argv[2:], sys.argv[1], workers=2):\n    print(one.reason)\n",
        encoding="utf-8",
    )
    command = [sys.executable, str(script), str(tmp_path / "out"), str(tmp_path / "0.wav"), str(tmp_path / "1.wav")]
    run = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)
    assert run.stdout.count("__main__") == 2
