"""From packed glTF and URDF files to WAV files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import soundfile

from scene2hap import HapticBundle, HapticSession, Touch, WavSink, bake, load_scene

DATA = Path(__file__).parents[1] / "data"
FILES = [DATA / "meshopt" / "quantised.glb", DATA / "urdf" / "laundry" / "laundry.urdf"]

# Baking with offline backends warns that all other objects are silent.
pytestmark = pytest.mark.filterwarnings("ignore:none of:scene2hap.SceneWarning")


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_washing_machine_is_felt_on_its_housing_and_the_floor(path: Path, tmp_path: Path) -> None:
    if path.suffix == ".urdf":
        pytest.importorskip("collada", reason="needs the extra dae")
    scene = load_scene(path)
    bundle = HapticBundle.load(bake(scene).save(tmp_path / "b"))
    assert bundle.snapshot == scene
    assert bundle.objects["washing_machine"].vibrates
    assert not bundle.objects["floor"].vibrates
    sink = WavSink(tmp_path / "out.wav")
    with HapticSession(bundle, sink=sink) as session:
        machine, floor = (scene.object(key).bounds_m for key in ("washing_machine", "floor"))
        top, up = machine.mean(axis=0), 1 if scene.up_axis == "y" else 2
        top[up] = machine[1, up]
        below = top.copy()
        below[up] = floor[1, up]
        session.update(
            touches=[
                Touch("left", "washing_machine", tuple(top.tolist())),
                Touch("right", "floor", tuple(below.tolist())),
            ]
        )
        sink.pull_s(1.0)
    samples, rate_hz = soundfile.read(tmp_path / "out.wav")
    assert samples.shape[1] == 2
    assert len(samples) >= rate_hz
    assert np.isfinite(samples).all()
    assert (np.abs(samples).max(axis=0) > 1e-4).all()
