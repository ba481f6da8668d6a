"""Replacing a baked loop by a hand-made haptic clip."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from scene2hap import Box, HapticBundle, SceneObject, SceneSnapshot, bake, rebake
from scene2hap.cli import main
from scene2hap.clips.haptic_clip import ClipMetadata, Curve, HapticClip, Transient
from scene2hap.clips.haptic_format import compose_haptic
from scene2hap.clips.reading import read_haptic_clip
from scene2hap.errors import AudioError, ClipError


@pytest.fixture(scope="module")
def baked() -> HapticBundle:
    return bake(SceneSnapshot.build([SceneObject("kettle", geometry=Box((0.2, 0.25, 0.2)))]))


@pytest.fixture
def clip(tmp_path: Path) -> Path:
    """A clip file: a hum of a second that swells, with a knock in its middle."""
    amplitude = Curve(np.array([0.0, 0.5, 1.003]), np.array([0.2, 0.8, 0.3]))
    made = HapticClip(amplitude, None, (Transient(0.5, 1.0, 0.4),), about=ClipMetadata(author="Ada"))
    path = tmp_path / "kettle.haptic"
    path.write_text(json.dumps(compose_haptic(made)))
    return path


def test_a_clip_is_looped_whole_and_felt_as_it_is(baked: HapticBundle, clip: Path, tmp_path: Path) -> None:
    bundle = rebake(baked.override("kettle", clip=clip))
    drawn = rebake(baked.override("kettle", clip=read_haptic_clip(clip)))
    np.testing.assert_array_equal(first_loop(drawn), first_loop(bundle))
    (loop,) = bundle.loops["kettle"].values()
    x = loop.tactile.samples
    assert 0.98 <= loop.tactile.duration_s <= 1.003  # cut by at most the rest of its last cycle
    assert loop.tactile.credit.author == "Ada"
    assert "kettle, by Ada" in bundle_credits(bundle.save(tmp_path / "a"))
    # The loop has the clip's shape: the level in each tenth of a second, relative to the first.
    level = [float(np.abs(part).max()) for part in np.array_split(x[: 8000 - 8000 % 10], 10)]
    assert np.argmax(level) == 5  # the knock
    assert level[4] / level[0] == pytest.approx((0.2 + 0.6 * 0.95) / (0.2 + 0.6 * 0.2), rel=0.15)
    # The step at the wrap is not larger than steps within the loop.
    assert abs(x[0] - x[-1]) <= 1.05 * np.abs(np.diff(x)).max()


def test_haptic_clip_is_kept_by_save_and_rebake(baked: HapticBundle, clip: Path, tmp_path: Path) -> None:
    made = rebake(baked.override("kettle", clip=clip))
    made.save(tmp_path / "kept")
    loaded = HapticBundle.load(tmp_path / "kept")
    wish = loaded.overrides["kettle"].clip
    assert wish is not None
    assert wish.is_vibration
    for again in (rebake(loaded), rebake(loaded.override("kettle", gain_db=-3.0))):
        (old,), (new,) = made.loops["kettle"].values(), again.loops["kettle"].values()
        np.testing.assert_allclose(new.tactile.samples, old.tactile.samples, atol=2e-7)


def test_command_line_accepts_a_haptic_clip(baked: HapticBundle, clip: Path, tmp_path: Path) -> None:
    folder = str(baked.save(tmp_path / "b"))
    assert main(["edit", folder, "sound", "kettle", str(clip), "-q"]) == 0
    (loop,) = HapticBundle.load(folder).loops["kettle"].values()
    assert loop.audible.credit.origin == "haptic clip, scene2hap"


def test_clips_that_cannot_be_used_are_refused(baked: HapticBundle, tmp_path: Path) -> None:
    with pytest.raises(ClipError, match="absent.haptic"):
        baked.override("kettle", clip=tmp_path / "absent.haptic")
    short = tmp_path / "short.haptic"
    made = HapticClip(Curve(np.array([0.0, 0.05]), np.array([1.0, 1.0])))
    short.write_text(json.dumps(compose_haptic(made)))
    with pytest.raises(
        AudioError, match=r"'kettle': the sound .*short.haptic lasts 0.05 s; it must last at least 0.1 s"
    ):
        baked.override("kettle", clip=short)


def first_loop(bundle: HapticBundle) -> np.ndarray:
    (loop,) = bundle.loops["kettle"].values()
    return loop.tactile.samples


def bundle_credits(folder: Path) -> str:
    return (folder / "credits.txt").read_text(encoding="utf-8")
