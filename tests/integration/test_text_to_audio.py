"""TextToAudio against real processes: a fake generator of many manners, and the runners that come along."""

from __future__ import annotations

import ast
import json
import os
import subprocess
import sys
import time
import traceback
from pathlib import Path
from typing import Any

import pytest

from scene2hap.audio.sources import SOURCES
from scene2hap.audio.sources.text_to_audio import TextToAudio, UnusableTake
from scene2hap.audio.sources.text_to_audio.process import environment
from scene2hap.errors import BackendError, BackendUnavailable, BadAnswer, ConfigError
from scene2hap.haptics import VibrationDescription

GENERATOR = Path(__file__).parents[1] / "fake_generator.py"
RUNNERS = Path(__file__).parents[2] / "src" / "scene2hap" / "audio" / "sources" / "runners"
posix = pytest.mark.skipif(os.name != "posix", reason="process groups, links and pipes of POSIX")


@pytest.fixture(autouse=True)
def _own_folders(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    work = tmp_path / "work"
    work.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(work))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "home-cache"))
    monkeypatch.setenv("FAKE_COUNTER", str(tmp_path / "counter.jsonl"))
    monkeypatch.setenv("FAKE_PID", str(tmp_path / "pid"))


def describe(sentence: str = "fan humming softly", **changes: Any) -> VibrationDescription:
    fields = {"intensity": 0.5, "size_m": (0.3, 0.3, 0.1), "seed": 7} | changes
    return VibrationDescription("fan", "on", sentence, "fan humming", **fields)


def generator(tmp_path: Path, manner: str = "good", **settings: Any) -> TextToAudio:
    defaults = {"count": 2, "duration_s": 3.0, "timeout_s": 10.0, "cache": tmp_path / "cache"}
    return TextToAudio([sys.executable, "-S", str(GENERATOR), manner], **{**defaults, **settings})


def failed(tmp_path: Path, manner: str, **settings: Any) -> BackendError:
    with pytest.raises(BackendError) as caught:
        generator(tmp_path, manner, **settings).find(describe())
    assert_nothing_left(tmp_path)
    assert not list((tmp_path / "cache").rglob("*.json")), "nothing of it is kept"
    return caught.value


def assert_nothing_left(tmp_path: Path) -> None:
    assert list((tmp_path / "work").iterdir()) == []


def runs(tmp_path: Path) -> list[dict[str, Any]]:
    counter = tmp_path / "counter.jsonl"
    return [json.loads(line) for line in counter.read_text().splitlines()] if counter.exists() else []


# generating


def test_the_sentence_goes_out_and_sounds_with_their_origin_come_in(tmp_path: Path) -> None:
    clips = generator(tmp_path).find(describe())
    (asked,) = runs(tmp_path)
    del asked["environment"]
    assert asked == {
        "contract": "scene2hap/text-to-audio",
        "version": 1,
        "prompt": "fan humming softly",
        "count": 2,
        "duration_s": 3.0,
        "seed": 7,
    }
    assert [clip.duration_s for clip in clips] == [3.0, 3.0]
    assert [clip.credit.title for clip in clips] == ["fan humming softly, take 1", "fan humming softly, take 2"]
    credit = clips[0].credit
    assert (credit.author, credit.licence, credit.address) == ("fake-1", "CC0-1.0", "https://example.org/fake")
    assert (credit.query, credit.origin) == ("fan humming softly", "text_to_audio")
    assert_nothing_left(tmp_path)


def test_five_takes_unless_told_otherwise(tmp_path: Path) -> None:
    source = TextToAudio([sys.executable, "-S", str(GENERATOR), "good"], cache=tmp_path / "cache")
    assert len(source.find(describe())) == 5
    assert [(run["count"], run["duration_s"]) for run in runs(tmp_path)] == [(5, 5.0)]


def test_what_was_generated_is_not_generated_again(tmp_path: Path) -> None:
    first = generator(tmp_path).find(describe())
    again = generator(tmp_path).find(describe())
    assert len(runs(tmp_path)) == 1
    assert [clip.credit for clip in again] == [clip.credit for clip in first]
    assert all((a.samples == b.samples).all() for a, b in zip(again, first, strict=True))
    generator(tmp_path).find(describe(seed=8))
    generator(tmp_path).find(describe("fan rattling"))
    generator(tmp_path, count=3).find(describe())
    generator(tmp_path, "more").find(describe())
    assert len(runs(tmp_path)) == 5, "seed, words, count and program each matter"


@pytest.mark.parametrize(
    "junk",
    [b"", b"{}", b'{"files": ["0.wav"]}', b'{"files": ["../x"], "credits": [{}]}', b'{"files": 3, "credits": 3}'],
)
def test_a_damaged_entry_is_generated_again(tmp_path: Path, junk: bytes) -> None:
    generator(tmp_path).find(describe())
    (entry,) = (tmp_path / "cache").rglob("takes.json")
    entry.write_bytes(junk)
    assert len(generator(tmp_path).find(describe())) == 2
    assert len(runs(tmp_path)) == 2


def test_a_damaged_take_is_generated_again(tmp_path: Path) -> None:
    generator(tmp_path).find(describe())
    next((tmp_path / "cache").rglob("1.wav")).write_bytes(b"RIFF")
    assert len(generator(tmp_path).find(describe())) == 2
    assert len(runs(tmp_path)) == 2


def test_paths_go_where_the_command_says(tmp_path: Path) -> None:
    swapped = "import sys; a = sys.argv; sys.argv = ['', 'good', a[2][2:], a[1][2:]]; exec(open(a[3]).read())"
    command = [sys.executable, "-S", "-c", swapped, "o={folder}", "i={request}", str(GENERATOR)]
    assert len(TextToAudio(command, count=1, cache=tmp_path / "cache").find(describe())) == 1


def test_nothing_to_say_nothing_to_make(tmp_path: Path) -> None:
    silent = VibrationDescription("", "", " \n", " ", 0.5, (0.0, 0.0, 0.0))
    assert generator(tmp_path).find(silent) == []
    assert runs(tmp_path) == []


def test_one_bad_take_spoils_no_other_and_no_more_than_asked_are_read(tmp_path: Path) -> None:
    with pytest.warns(UnusableTake, match="skipped take 2"):
        assert len(generator(tmp_path, "one-junk", count=3).find(describe())) == 2
    assert len(generator(tmp_path, "more").find(describe())) == 2


def test_a_model_that_does_not_say_who_it_is(tmp_path: Path) -> None:
    credit = generator(tmp_path, "nameless").find(describe())[0].credit
    assert (credit.author, credit.licence, credit.address) == ("an unnamed model", "free as in beer", "")


def test_the_program_sees_no_keys_but_those_it_is_given(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("OPENAI_API_KEY", "FREESOUND_TOKEN", "HF_TOKEN", "AWS_SECRET_ACCESS_KEY", "DB_PASSWORD", "HF_HOME"):
        monkeypatch.setenv(name, "0123456789")
    generator(tmp_path).find(describe())
    seen = set(runs(tmp_path)[0]["environment"])
    assert {"HF_TOKEN", "HF_HOME", "PATH"} <= seen
    assert seen.isdisjoint({"OPENAI_API_KEY", "FREESOUND_TOKEN", "AWS_SECRET_ACCESS_KEY", "DB_PASSWORD"})
    assert environment((), {"HF_TOKEN": "x", "LANG": "C"}) == {"LANG": "C"}


# programs that misbehave


def test_one_that_hangs_is_ended(tmp_path: Path) -> None:
    start = time.monotonic()
    assert "did not finish within 0.3 s" in str(failed(tmp_path, "hang", timeout_s=0.3))
    assert time.monotonic() - start < 30.0, "the program sleeps for a minute"


@posix
@pytest.mark.parametrize("timeout_s", [10.0, 0.01])
def test_what_it_started_ends_with_it(tmp_path: Path, timeout_s: float) -> None:
    if timeout_s > 1.0:
        generator(tmp_path, "orphan", timeout_s=timeout_s).find(describe())
    else:
        code = (
            "import os, subprocess, sys, time;"
            "child = subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(60)']);"
            "open(os.environ['FAKE_PID'], 'w').write(str(child.pid)); time.sleep(60)"
        )
        with pytest.raises(BackendUnavailable, match="did not finish"):
            TextToAudio([sys.executable, "-S", "-c", code], timeout_s=1.0, cache=tmp_path / "cache").find(describe())
    child = int((tmp_path / "pid").read_text())
    deadline = time.monotonic() + 10.0
    while is_running(child):
        assert time.monotonic() < deadline, "the child runs on"
        time.sleep(0.01)


def is_running(process: int) -> bool:
    """Whether a process is there and not merely waiting for somebody to note its end."""
    try:
        stat = Path(f"/proc/{process}/stat")
        if Path("/proc/self/stat").exists():
            return stat.read_text().rsplit(")", 1)[1].split()[0] != "Z"
        os.kill(process, 0)
    except (FileNotFoundError, ProcessLookupError):
        return False
    return True


def test_one_that_dies_is_quoted_without_its_key(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HF_TOKEN", "hf_0123456789abcdef")
    error = failed(tmp_path, "die")
    assert "ended with status 3. It said last: loading the model CUDA out of memory, key ******" in str(error)
    assert "hf_0123456789abcdef" not in "".join(traceback.format_exception(error))


@posix
def test_one_that_is_killed(tmp_path: Path) -> None:
    assert "was ended by signal 9 (out of memory?)" in str(failed(tmp_path, "killed"))


@pytest.mark.parametrize(
    ("manner", "said"),
    [
        ("gigabytes", "above 1000 files or 20 MB"),
        ("sparse", "files of 10000 MB in all"),
        ("flood", "above 1000 files or 20 MB"),
        ("litter", "wrote 1001 files"),
    ],
)
def test_one_that_writes_too_much_is_ended(tmp_path: Path, manner: str, said: str) -> None:
    assert said in str(failed(tmp_path, manner, max_bytes=20_000_000))


@pytest.mark.parametrize(
    ("manner", "said"),
    [
        ("silent", "left no reply.json"),
        ("not-json", "reply.json of the generator"),
        ("huge-reply", "left no reply.json .*at most 1000000 are read"),
        ("other-version", "version 2; it must be"),
        ("no-files", "names no files"),
        ("error", "the generator says: no GPU for you"),
    ],
)
def test_one_that_breaks_the_contract(tmp_path: Path, manner: str, said: str) -> None:
    with pytest.raises(BackendError, match=said):
        raise failed(tmp_path, manner)


@pytest.mark.parametrize(
    ("manner", "said"),
    [
        ("junk-sounds", "is not a readable sound"),
        ("long", "lasts 61 s; it must be at most 60 s"),
        ("not-finite", "every sample must be finite"),
        ("outside", "must be a plain name in the reply's folder"),
        ("absent", "cannot be read"),
        pytest.param("link", "is not a plain file", marks=posix),
        pytest.param("pipe", "is not a plain file", marks=posix),
    ],
)
def test_one_whose_sounds_are_none(tmp_path: Path, manner: str, said: str) -> None:
    with pytest.warns(UnusableTake, match=said):
        error = failed(tmp_path, manner)
    assert isinstance(error, BadAnswer)
    assert "can be used" in str(error)


def test_one_that_is_not_there_is_tried_once(tmp_path: Path) -> None:
    source = TextToAudio(["/no/such/program"], cache=tmp_path / "cache")
    for _ in range(2):
        with pytest.raises(BackendUnavailable, match=r"cannot start '/no/such/program': No such file.*Check `command`"):
            source.find(describe())
    assert_nothing_left(tmp_path)


def test_one_that_fails_twice_in_a_row_is_not_started_again(tmp_path: Path) -> None:
    source = generator(tmp_path, "silent")
    for _ in range(4):
        with pytest.raises(BadAnswer, match=r"left no reply\.json"):
            source.find(describe())
    assert len(runs(tmp_path)) == 2


@pytest.mark.parametrize(
    "settings",
    [
        {},
        {"command": ["a"], "runner": "audiogen"},
        {"command": "python run.py"},
        {"command": []},
        {"command": ["python", 3]},
        {"runner": "musicgen"},
        {"command": ["a"], "count": 6},
        {"command": ["a"], "count": 1.5},
        {"command": ["a"], "duration_s": 2.0},
        {"command": ["a"], "timeout_s": 0.0},
        {"command": ["a"], "max_bytes": 0},
    ],
    ids=str,
)
def test_settings_that_cannot_work_are_refused(settings: dict[str, Any]) -> None:
    with pytest.raises(ConfigError, match="command|runner|count|duration_s|timeout_s|max_bytes"):
        SOURCES.build({"kind": "text_to_audio", **settings})


# the runners


@pytest.mark.parametrize("runner", ["audiogen", "stable_audio"])
def test_runners_explain_and_check_themselves_without_a_model(tmp_path: Path, runner: str) -> None:
    script = [sys.executable, "-S", str(RUNNERS / f"{runner}.py")]
    told = subprocess.run([*script, "--help"], capture_output=True, text=True, check=True).stdout
    assert all(word in told for word in ("REQUEST FOLDER", "--check", "--rehearse", "--model", "--device"))
    check = json.loads(subprocess.run([*script, "--check"], capture_output=True, text=True, check=True).stdout)
    assert (check["contract"], check["version"]) == ("scene2hap/text-to-audio", 1)
    assert check["rehearsal"] == "passed"
    assert "torch" in check["missing"]  # -S hides whatever is installed
    assert subprocess.run(script, capture_output=True).returncode == 2


@pytest.mark.parametrize("runner", ["audiogen", "stable_audio"])
def test_runners_rehearse_for_the_source(tmp_path: Path, runner: str) -> None:
    source = TextToAudio(
        runner=runner, python=sys.executable, options=["--rehearse"], count=2, duration_s=3.0, cache=tmp_path / "cache"
    )
    first, second = source.find(describe())
    assert first.credit.author.startswith("rehearsal of ")
    assert first.duration_s == 3.0
    assert (first.samples != second.samples).any()


@pytest.mark.parametrize("script", sorted(RUNNERS.glob("*.py")), ids=lambda path: path.name)
def test_runners_are_written_for_the_python_of_their_models(script: Path) -> None:
    tree = ast.parse(script.read_text(encoding="utf-8"), feature_version=(3, 9))
    imported = {node.names[0].name.split(".")[0] for node in ast.walk(tree) if isinstance(node, ast.Import)}
    imported |= {str(node.module).split(".")[0] for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    assert "__future__" in imported, "annotations of newer Pythons must not be evaluated"
    models = {"torch", "audiocraft", "stable_audio_3"}
    assert imported - models - {"contract"} <= set(sys.stdlib_module_names)


TORCH = """
seeds = []
def manual_seed(seed): seeds.append(seed)
class Tensor:
    def __init__(self, channels): self.channels = channels
    def detach(self): return self
    def cpu(self): return self
    def float(self): return self
    def tolist(self): return self.channels
"""
AUDIOCRAFT = """
import torch
class AudioGen:
    sample_rate = 16000
    @classmethod
    def get_pretrained(cls, name, device=None):
        assert name == "facebook/audiogen-medium" and device is None
        return cls()
    def set_generation_params(self, duration): self.n = round(duration * self.sample_rate)
    def generate(self, prompts):
        assert prompts == ["fan humming softly"] * 2 and torch.seeds == [7]
        return [torch.Tensor([[0.5 * (i % 160 < 80) for i in range(self.n)]]) for _ in prompts]
"""
STABLE_AUDIO = """
import torch
class Model:
    sample_rate = 44100
class StableAudioModel:
    model = Model()
    @classmethod
    def from_pretrained(cls, name):
        assert name == "small-sfx"
        return cls()
    def generate(self, prompt, duration, steps, seed, batch_size):
        assert (prompt, steps, seed, batch_size) == ("fan humming softly", 8, 7, 2)
        n = round(duration * 44100)
        left, right = [2.0 * (i % 441 < 220) for i in range(n)], [0.0] * n
        return [torch.Tensor([left, right]) for _ in range(batch_size)]
"""


@pytest.mark.parametrize(
    ("runner", "package", "code", "rate", "licence", "peak"),
    [
        ("audiogen", "audiocraft/models.py", AUDIOCRAFT, 16000, "CC-BY-NC-4.0", 0.5),
        # Twice full scale on the left, silence on the right: scaled down to 1, mixed to 1/2.
        ("stable_audio", "stable_audio_3.py", STABLE_AUDIO, 44100, "Stability AI Community License", 0.5),
    ],
)
def test_runners_ask_their_libraries_as_documented(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    runner: str,
    package: str,
    code: str,
    rate: int,
    licence: str,
    peak: float,
) -> None:
    """The libraries are played by stand-ins that take just the arguments of their documentation."""
    module = tmp_path / "site" / package
    module.parent.mkdir(parents=True)
    module.write_text(code)
    (tmp_path / "site" / "torch.py").write_text(TORCH)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path / "site"))
    source = TextToAudio(runner=runner, python=sys.executable, count=2, duration_s=3.0, cache=tmp_path / "cache")
    clips = source.find(describe())
    assert [(clip.sample_rate_hz, clip.duration_s, clip.credit.licence) for clip in clips] == [(rate, 3.0, licence)] * 2
    assert abs(clips[0].samples).max() == pytest.approx(peak, abs=1e-4)


def test_a_runner_without_its_model_says_what_is_missing(tmp_path: Path) -> None:
    source = TextToAudio(runner="audiogen", python=sys.executable, cache=tmp_path / "cache")
    with pytest.raises(BackendUnavailable, match="No module named '(torch|audiocraft)'"):
        source.find(describe())


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"contract": "x"}, "no request of"),
        ({"version": 2}, "version is 2"),
        ({"count": 9}, "count must be"),
        ({"duration_s": "long"}, "misuses"),
        ({"seed": None}, "misuses"),
    ],
)
def test_runners_refuse_requests_that_make_no_sense(tmp_path: Path, change: dict[str, Any], said: str) -> None:
    asked = {"contract": "scene2hap/text-to-audio", "version": 1, "prompt": "a", "count": 1, "duration_s": 1, "seed": 0}
    (tmp_path / "request.json").write_text(json.dumps({**asked, **change}))
    script = [sys.executable, "-S", str(RUNNERS / "audiogen.py"), "--rehearse", str(tmp_path / "request.json")]
    assert subprocess.run([*script, str(tmp_path)], capture_output=True).returncode == 1
    assert said in json.loads((tmp_path / "reply.json").read_text())["error"]
