"""USD scenes: the same room as from GLB, and the whole way from a USD file to a sound file."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import soundfile

from rooms import ROOMS, room_file
from scene2hap import HapticBundle, HapticSession, Touch, bake, load_scene
from usd_writing import as_usd, usd

pytestmark = pytest.mark.usefixtures("short_tones")

NAME = next(iter(ROOMS))


@pytest.mark.parametrize("suffix", [".usda", ".usdc"])
def test_room_is_equal_from_glb_and_usd(tmp_path: Path, suffix: str) -> None:
    usd("Usd")
    expected = load_scene(room_file(NAME), unit_m=1.0)
    found = load_scene(as_usd(expected, tmp_path / f"{NAME}{suffix}"), unit_m=1.0)
    assert [(item.id, item.name) for item in found.objects] == [(item.id, item.name) for item in expected.objects]
    assert found.up_axis == expected.up_axis
    for ours, theirs in zip(found.objects, expected.objects, strict=True):
        np.testing.assert_allclose(ours.size_m, theirs.size_m, atol=1e-6)
        np.testing.assert_allclose(ours.bounds_m, theirs.bounds_m, atol=1e-6)
        np.testing.assert_allclose(ours.pose.position_m, theirs.pose.position_m, atol=1e-6)
        np.testing.assert_allclose(ours.pose.rotation, theirs.pose.rotation, atol=1e-6)
        assert len(ours.geometry.mesh.faces) == len(theirs.geometry.mesh.faces)


def test_from_usd_to_a_sound_file(tmp_path: Path) -> None:
    usd("Usd")
    scene = load_scene(as_usd(load_scene(room_file(NAME), unit_m=1.0), tmp_path / f"{NAME}.usdc"), unit_m=1.0)
    bundle = HapticBundle.load(bake(scene).save(tmp_path / "bundle"))
    assert bundle.snapshot == scene
    session = HapticSession(bundle.snapshot, bundle)
    assert set(session.source_ids) == ROOMS[NAME].sources
    source = session.source_ids[0]
    middle = scene.object(source).bounds_m.mean(axis=0)
    session.update(touches=[Touch("right", source, tuple(middle.tolist()))])
    samples = np.concatenate([session.render(480) for _ in range(100)])
    soundfile.write(tmp_path / "felt.wav", samples, 48_000)
    felt, _ = soundfile.read(tmp_path / "felt.wav")
    assert np.isfinite(felt).all()
    assert 0.01 < np.abs(felt).max() <= 1.0


def test_other_formats_do_not_import_the_reader() -> None:
    code = (
        "import sys; from scene2hap import load_scene; load_scene(sys.argv[1], unit_m=1.0); "
        "print([name for name in sys.modules if name.startswith(('pxr', 'scene2hap.scene.formats.usd'))])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, str(room_file(NAME))], capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "[]"
