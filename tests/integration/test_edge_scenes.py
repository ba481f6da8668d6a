"""Edge cases of scenes, from a saved bundle by the command line to a WAV file."""

import json
from pathlib import Path

import numpy as np
import pytest
import soundfile

from edge_scenes import EDGE_SCENES
from scene2hap.cli import main


@pytest.mark.parametrize("name", EDGE_SCENES)
def test_a_track_is_played_on_a_saved_bundle(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scene, bundle = EDGE_SCENES[name]()
    folder = bundle.save(tmp_path / "bundle")
    first, last = scene.objects[0].id, scene.objects[-1].id
    steps = [
        {"time_s": 0.0, "hand": "left", "touch": first},
        {"time_s": 0.1, "hand": "right", "touch": last},
        {"time_s": 0.3, "move": last, "by_m": [0.0, 0.2, 0.0], "glide_s": 0.2},
        {"time_s": 0.6, "hand": "left", "lift": True},
    ]
    touches, wav = tmp_path / "touches.json", tmp_path / "out.wav"
    track = {"format": "scene2hap/touches", "version": 1, "duration_s": 1.0, "steps": steps}
    touches.write_text(json.dumps(track), encoding="utf-8")
    assert main(["render", str(folder), "--touches", str(touches), "-o", str(wav)]) == 0
    samples, _ = soundfile.read(wav)
    assert np.isfinite(samples).all()
    assert samples.any() == (name in ("one_object", "unknown_source", "equal_cubes"))
    capsys.readouterr()
    assert main(["inspect", str(folder)]) == 0
    assert first in capsys.readouterr().out
