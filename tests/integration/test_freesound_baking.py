"""A bake continues with the next sound source if a sound service fails."""

from __future__ import annotations

import sys
import warnings
from pathlib import Path
from typing import Any

import pytest

from freesound_server import TOKEN, Page, host, hum, refused, result, results
from scene2hap import HapticBundle, bake
from scene2hap.audio.sources.chain import SourceWarning
from scene2hap.errors import AudioError
from scenes import box, scene

pytestmark = pytest.mark.usefixtures("short_tones")

GENERATOR = Path(__file__).parents[1] / "support" / "fake_generator.py"
KITCHEN = scene(
    box("refrigerator", (0.6, 1.8, 0.6), (0.0, 0.9, 0.0)),
    box("kettle", (0.2, 0.25, 0.2), (2.0, 0.95, 0.0)),
    box("table", (1.2, 0.8, 0.8), (2.0, 0.4, 0.0)),
)
VIBRATING = ("refrigerator", "kettle")


@pytest.fixture(autouse=True)
def _plain_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FREESOUND_TOKEN", TOKEN)
    for name in ("HTTP_PROXY", "HTTPS_PROXY", "ALL_PROXY"):
        monkeypatch.delenv(name, raising=False)
        monkeypatch.delenv(name.lower(), raising=False)


def freesound(port: int, tmp_path: Path) -> dict[str, Any]:
    return {
        "kind": "freesound",
        "base_url": f"http://127.0.0.1:{port}/apiv2",
        "cache": tmp_path / "freesound",
        "timeout_s": 1.0,
        "sleep": lambda seconds: None,
    }


def generator(manner: str, tmp_path: Path) -> dict[str, Any]:
    return {
        "kind": "text_to_audio",
        "command": [sys.executable, "-S", str(GENERATOR), manner],
        "cache": tmp_path / "generated",
        "timeout_s": 1.0 if manner == "hang" else 30.0,
        "max_bytes": 20_000_000,
        "count": 2,
    }


def origins(bundle: HapticBundle) -> dict[str, str]:
    return {name: loop.audible.credit.origin for name, states in bundle.loops.items() for loop in states.values()}


def test_bake_generates_only_sounds_that_were_not_found(tmp_path: Path) -> None:
    with host(Page(hum(4.0))) as cdn:
        row = result(7, f"http://localhost:{cdn.port}/7.ogg", name="Fridge", username="bob")

        def search(get: Any) -> Page:
            return results(row) if "refrigerator" in get.query["query"] else results()

        with host(by=search) as api:
            bundle = bake(KITCHEN, {"audio": [freesound(api.port, tmp_path), generator("good", tmp_path)]})
    assert origins(bundle) == {"refrigerator": "freesound", "kettle": "text_to_audio"}
    bundle.save(tmp_path / "bundle")
    credits_ = (tmp_path / "bundle" / "credits.txt").read_text()
    assert "Fridge, by bob, CC0-1.0, https://freesound.org/people/ann/sounds/7/" in credits_
    assert "by fake-1, CC0-1.0, https://example.org/fake" in credits_
    loaded = HapticBundle.load(tmp_path / "bundle")
    assert loaded.credits == bundle.credits
    assert {credit.query for credit in loaded.credits} >= {"refrigerator humming"}


@pytest.mark.parametrize("page", [refused(401), refused(503), Page(b"<html>")], ids=["401", "503", "junk"])
def test_a_service_that_fails_leaves_the_bake_to_the_next(tmp_path: Path, page: Page) -> None:
    with host(page) as api, pytest.warns(SourceWarning, match="no sound from Freesound") as caught:
        bundle = bake(KITCHEN, {"audio": [freesound(api.port, tmp_path), "synth"]})
    assert origins(bundle) == dict.fromkeys(VIBRATING, "synth")
    assert all(TOKEN not in str(warning.message) for warning in caught)
    assert len(api.asked) <= 3, "one object's failure, retries included, is enough for all"


@pytest.mark.parametrize("manner", ["hang", "gigabytes", "junk-sounds"])
def test_a_generator_that_fails_leaves_the_bake_to_the_next(tmp_path: Path, manner: str) -> None:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        bundle = bake(KITCHEN, {"audio": [generator(manner, tmp_path), "synth"]})
    assert origins(bundle) == dict.fromkeys(VIBRATING, "synth")
    assert [str(w.message).split(":")[0] for w in caught if w.category is SourceWarning] == list(VIBRATING)


def test_bake_without_sounds_reports_the_failure_of_each_source(tmp_path: Path) -> None:
    with (
        host(refused(401)) as api,
        pytest.warns(SourceWarning),
        pytest.raises(AudioError, match=r"'refrigerator'.*Freesound failed: .*401.*TextToAudio failed: .*status 3"),
    ):
        bake(KITCHEN, {"audio": [freesound(api.port, tmp_path), generator("die", tmp_path)]})
