"""Separate folders for each test, and the file in which the fake generator records its runs."""

from __future__ import annotations

from pathlib import Path

import pytest


@pytest.fixture(autouse=True)
def _own_folders(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    work = tmp_path / "work"
    work.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(work))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "home-cache"))
    monkeypatch.setenv("FAKE_COUNTER", str(tmp_path / "counter.jsonl"))
    monkeypatch.setenv("FAKE_PID", str(tmp_path / "pid"))
