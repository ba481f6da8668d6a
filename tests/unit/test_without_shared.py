"""Report how many collected test cases are left out without the folder `../shared`."""

from __future__ import annotations

import pytest

import others


@pytest.mark.parametrize("folder", ["scenes", "audio"])
def test_tests_skip_without_the_shared_folder(folder: str) -> None:
    assert set(others.LEFT_OUT) <= {"scenes", "audio"}
    if others.LEFT_OUT[folder]:
        own = {"scenes": "rooms", "audio": "own_sounds.py"}[folder]
        ran = f"{others.LEFT_OUT[folder]} further cases of tests that ran over tests/support/{own}"
        pytest.skip(f"{ran} need ../shared/{folder}")
