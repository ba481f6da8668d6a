"""The included runners, with stubs of their models' libraries."""

from __future__ import annotations

import ast
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from generator_asking import describe
from scene2hap.audio.sources.text_to_audio import TextToAudio
from scene2hap.errors import BackendUnavailable

RUNNERS = Path(__file__).parents[3] / "scene2hap" / "audio" / "sources" / "runners"


@pytest.mark.parametrize("runner", ["audiogen", "stable_audio"])
def test_runners_explain_and_check_themselves_without_a_model(tmp_path: Path, runner: str) -> None:
    script = [sys.executable, "-S", str(RUNNERS / f"{runner}.py")]
    told = subprocess.run([*script, "--help"], capture_output=True, text=True, check=True).stdout
    assert all(word in told for word in ("REQUEST FOLDER", "--check", "--rehearse", "--model", "--device"))
    check = json.loads(subprocess.run([*script, "--check"], capture_output=True, text=True, check=True).stdout)
    assert (check["contract"], check["version"]) == ("scene2hap/text-to-audio", 1)
    assert check["rehearsal"] == "passed"
    assert "torch" in check["missing"]  # -S hides installed packages
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
        # Twice full scale on the left, silence on the right: scaled to 1, and mixed to 1/2.
        ("stable_audio", "stable_audio_3.py", STABLE_AUDIO, 44100, "Stability AI Community License", 0.5),
    ],
)
def test_runners_call_their_libraries_as_documented(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    runner: str,
    package: str,
    code: str,
    rate: int,
    licence: str,
    peak: float,
) -> None:
    """The stubs of the libraries accept only the arguments of their documentation."""
    module = tmp_path / "site" / package
    module.parent.mkdir(parents=True)
    module.write_text(code)
    (tmp_path / "site" / "torch.py").write_text(TORCH)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path / "site"))
    source = TextToAudio(runner=runner, python=sys.executable, count=2, duration_s=3.0, cache=tmp_path / "cache")
    clips = source.find(describe())
    assert [(clip.sample_rate_hz, clip.duration_s, clip.credit.licence) for clip in clips] == [(rate, 3.0, licence)] * 2
    assert abs(clips[0].samples).max() == pytest.approx(peak, abs=1e-4)


def test_runner_names_its_missing_model(tmp_path: Path) -> None:
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
def test_runners_refuse_invalid_requests(tmp_path: Path, change: dict[str, Any], said: str) -> None:
    asked = {"contract": "scene2hap/text-to-audio", "version": 1, "prompt": "a", "count": 1, "duration_s": 1, "seed": 0}
    (tmp_path / "request.json").write_text(json.dumps({**asked, **change}))
    script = [sys.executable, "-S", str(RUNNERS / "audiogen.py"), "--rehearse", str(tmp_path / "request.json")]
    assert subprocess.run([*script, str(tmp_path)], capture_output=True).returncode == 1
    assert said in json.loads((tmp_path / "reply.json").read_text())["error"]
