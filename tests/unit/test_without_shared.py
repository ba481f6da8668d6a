"""Report how many collected test cases are left out without the folder `../shared`."""

from __future__ import annotations

import pytest

import others


@pytest.mark.parametrize("folder", ["scenes", "audio"])
def test_tests_skip_without_the_shared_folder(folder: str) -> None:
    assert set(others.LEFT_OUT) <= {"scenes", "audio"}
    if others.LEFT_OUT[folder]:
        own = {"scenes": "the rooms of tests/rooms", "audio": "the sounds of tests/own_sounds.py"}[folder]
        pytest.skip(f"{others.LEFT_OUT[folder]} further cases of tests that ran over {own} need ../shared/{folder}")
