"""Invariants of every export for random tracks and settings; `stress/exports.py` tests thousands."""

from __future__ import annotations

import json
import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from export_draws import CHECKED, problems, random_exporter, random_track
from scene2hap.clips.ahap import compose_ahap, read_ahap
from scene2hap.clips.haptic_clip import RANGE_HZ
from scene2hap.clips.haptic_format import compose_haptic, read_haptic
from scene2hap.export import EXPORTS
from scene2hap.export.fidelity import fidelity

quick = settings(max_examples=20)
many = settings(max_examples=int(os.environ.get("SCENE2HAP_EXPORTS", "140")) // 7)
"""By default 140 exports in total of the seven kinds that have a checker; SCENE2HAP_EXPORTS sets another total."""
seeds = st.integers(0, 2**32 - 1)


@pytest.mark.parametrize("kind", CHECKED)
@given(seed=seeds)
@many
def test_exported_files_are_valid(kind: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    track = random_track(rng)
    exporter, chosen = random_exporter(rng, kind)
    assert problems(kind, chosen, dict(exporter.export(track).files)) == []


@pytest.mark.parametrize("kind", ["haptic", "ahap"])
@given(seed=seeds)
@quick
def test_exported_signal_has_the_reported_error(kind: str, seed: int, tmp_path_factory: pytest.TempPathFactory) -> None:
    rng = np.random.default_rng(seed)
    track = random_track(rng)
    exporter, chosen = random_exporter(rng, kind)
    range_hz = chosen.get("range_hz", RANGE_HZ)
    made, folder = exporter.export(track), tmp_path_factory.mktemp("out")
    for name, content in made.files.items():
        (folder / name).write_bytes(content)
    reader = read_haptic if kind == "haptic" else read_ahap
    for channel, played in made.played.items():
        stem = f"track.{channel}" if channel else "track"
        first = next(name for name in made.files if name.startswith(f"{stem}."))
        clip = replace(reader(folder / first), range_hz=range_hz)  # files do not state it
        reported, found = (fidelity(track.channels[channel], one) for one in (played, clip))
        assert found.median_db <= reported.median_db + 0.01
        assert found.p95_db <= reported.p95_db + 0.01
        again = {"": compose_haptic(clip)} if kind == "haptic" else compose_ahap(clip)
        for ending, document in again.items():
            before = json.loads(made.files[f"{stem}{ending}{Path(first).suffix}"])
            assert json.loads(json.dumps(document)) == before


@given(seed=seeds)
@quick
def test_sample_exports_reproduce_the_signal(seed: int) -> None:
    """WAV, raw PCM and DualSense at the signal's rate or above reproduce it within 0.5 dB (95th percentile)."""
    rng = np.random.default_rng(seed)
    track = random_track(rng, longest_s=1.0)
    for spec in ({"kind": "wav", "sample_rate_hz": 8000}, {"kind": "pcm", "sample_rate_hz": 8000}, "dualsense"):
        made = EXPORTS.build(spec).export(track)
        for name, channel in track.channels.items():
            if name in made.played:
                assert fidelity(channel, made.played[name]).p95_db < 0.5
