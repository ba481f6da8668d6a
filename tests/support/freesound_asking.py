"""Freesound sources for tests: connected to a fake API, with a clock that advances only in `sleep`."""

from __future__ import annotations

import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from freesound_server import TOKEN, Host, Page, host, hum, result, results
from scene2hap.audio.sources.freesound import Freesound
from scene2hap.errors import BackendError
from scene2hap.haptics import VibrationDescription


class Time:
    """A clock that `sleep` advances without waiting."""

    def __init__(self) -> None:
        self.now_s = 1000.0
        self.slept: list[float] = []

    def clock(self) -> float:
        return self.now_s

    def sleep(self, seconds: float) -> None:
        self.slept.append(seconds)
        self.now_s += seconds


def describe(category: str = "electric toothbrush", verb: str = "buzzing") -> VibrationDescription:
    return VibrationDescription(category, "on", f"{category} {verb}", f"{category} {verb}", 0.5, (0.2, 0.03, 0.03))


def freesound(api: Host, tmp_path: Path, time: Time | None = None, **settings: Any) -> Freesound:
    time = time or Time()
    defaults = {"cache": tmp_path / "cache", "timeout_s": 5.0, "clock": time.clock, "sleep": time.sleep}
    return Freesound(**{**defaults, "base_url": f"http://127.0.0.1:{api.port}/apiv2", **settings})


def preview(cdn: Host, name: str = "1.ogg") -> str:
    return f"http://localhost:{cdn.port}/previews/{name}"


@contextmanager
def catalogue(*changes: dict[str, Any], sound: Page | None = None) -> Iterator[tuple[Host, Host]]:
    """An API that finds one sound for each of `changes`, and the host of their previews."""
    with host(sound or Page(hum())) as cdn:
        rows = [result(i, preview(cdn, f"{i}.ogg"), **change) for i, change in enumerate(changes, start=1)]
        with host(results(*rows)) as api:
            yield api, cdn


def failed(tmp_path: Path, *pages: Page, **settings: Any) -> tuple[BackendError, Host, Time]:
    time = Time()
    with host(*pages) as api, pytest.raises(BackendError) as caught:
        freesound(api, tmp_path, time, **settings).find(describe())
    assert TOKEN not in "".join(traceback.format_exception(caught.value))
    return caught.value, api, time
