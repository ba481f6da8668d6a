"""Parallel conversion of many sounds gives the results of single conversions."""

import asyncio
from dataclasses import dataclass
from pathlib import Path
from threading import Barrier, BrokenBarrierError

import numpy as np
import pytest
import soundfile

from scene2hap import Box, SceneObject, SceneSnapshot, bake
from scene2hap.audio.clip import AudioClip, Credit, Samples
from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.sources.library import ShortSound
from scene2hap.baking.config import BakeConfig
from scene2hap.baking.fingerprint import CONVERTERS
from scene2hap.baking.loops import Sounds, make_loops
from scene2hap.errors import AudioError
from scene2hap.haptics import ObjectHaptics, SourceState, VibrationDescription
from scene2hap.materials import lookup

RATE = 8000


class Tones:
    """A sound source that makes a tone of the frequency in the keywords."""

    def find(self, description: VibrationDescription) -> list[AudioClip]:
        t = np.arange(3 * RATE) / RATE
        frequency_hz = float(description.keywords.split()[-1])
        return [AudioClip((0.5 * np.sin(2 * np.pi * frequency_hz * t)).astype(np.float32), RATE, Credit("t", "m", "f"))]


@dataclass(frozen=True)
class Through:
    """A converter that passes sound on. It waits for a second stream at a barrier, and fails at given frequencies."""

    barrier: Barrier | None = None
    fails_at_hz: tuple[float, ...] = ()

    def stream(self, sample_rate_hz: int, context: ConversionContext) -> "Through":
        if self.barrier is not None:
            self.barrier.wait(timeout=60.0)
        if context.own_hz is not None and round(context.own_hz) in self.fails_at_hz:
            raise AudioError(f"no {context.own_hz:.0f} Hz")
        return self

    def process(self, block: Samples) -> Samples:
        return block

    def finish(self) -> Samples:
        return np.zeros(0, np.float32)


def loops(n: int, converter: object, told: list[str] | None = None) -> Sounds:
    objects = {
        f"fan_{i}": ObjectHaptics(
            "fan",
            "steel",
            lookup("steel"),
            (0.3, 0.3, 0.01),
            "",
            True,
            (SourceState("on", 0.3, "", f"fan {50 + 7 * i}"),),
        )
        for i in range(n)
    }

    def tell(stage: str, what: str, done: int, total: int) -> None:
        if stage == "touch" and told is not None:
            told.append(f"{what} {done} of {total}")

    return asyncio.run(make_loops(objects, {}, BakeConfig(audio=[Tones()], tactile=converter), tell))


@pytest.fixture(autouse=True)
def _two_processors(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("os.cpu_count", lambda: 2)


def test_two_sounds_are_converted_at_once() -> None:
    try:
        assert len(loops(4, Through(Barrier(2))).loops) == 4
    except BrokenBarrierError:
        pytest.fail("each sound waited for the one before")


def test_parallel_conversions_equal_single_ones_and_report_in_order(monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[str] = []
    together = loops(6, Through(), told).loops
    assert told == [f"fan_{i} {i + 1} of 6" for i in range(6)]
    monkeypatch.setattr("os.cpu_count", lambda: None)
    alone = loops(6, Through()).loops
    assert list(together) == list(alone)
    for object_id, states in together.items():
        other = alone[object_id]["on"]
        assert np.array_equal(states["on"].tactile.samples, other.tactile.samples)
        assert np.array_equal(states["on"].audible.samples, other.audible.samples)
        assert states["on"].fingerprint == other.fingerprint


def test_first_of_several_failures_is_reported() -> None:
    told: list[str] = []
    with pytest.raises(AudioError, match="^'fan_1', state 'on': no 57 Hz$"):
        loops(6, Through(fails_at_hz=(57, 64, 85)), told)
    assert told == ["fan_0 1 of 6"]


def test_plugins_are_searched_once(monkeypatch: pytest.MonkeyPatch) -> None:
    from scene2hap.baking import fingerprint

    asked: list[str] = []
    real = fingerprint.entry_points

    def counted(*, group: str) -> object:
        asked.append(group)
        return real(group=group)

    monkeypatch.setattr(fingerprint, "entry_points", counted)
    loops(5, Through())
    assert asked == [CONVERTERS.name]


def test_an_object_whose_sounds_are_all_too_short_is_named(tmp_path: Path) -> None:
    """The name of the file alone does not tell which object needs a longer sound."""
    soundfile.write(tmp_path / "fan.wav", 0.3 * np.sin(2 * np.pi * 120 * np.arange(48_000) / 48_000), 48_000)
    scene = SceneSnapshot.build([SceneObject("desk fan 7", geometry=Box((0.3, 0.4, 0.2)))])
    said = r"'desk fan 7'.*none of 1 candidate is long enough.*lasts 1\.00 s.*'synth'"
    with pytest.warns(ShortSound), pytest.raises(AudioError, match=said):
        bake(scene, {"audio": {"kind": "library", "folder": str(tmp_path)}})
