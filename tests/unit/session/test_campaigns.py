"""Short forms of stress/states.py and stress/landings.py, and whether their judges find what is wrong."""

from __future__ import annotations

from types import ModuleType

import numpy as np
import pytest

from scripts import script

pytestmark = pytest.mark.filterwarnings("ignore")


@pytest.fixture(scope="module")
def states() -> ModuleType:
    return script("stress/states.py")


@pytest.fixture(scope="module")
def landings() -> ModuleType:
    return script("stress/landings.py")


@pytest.mark.parametrize(("part", "draws"), [("clicks", 2), ("latency", 1), ("levels", 1)])
def test_a_few_draws_are_within_their_bounds(states: ModuleType, part: str, draws: int) -> None:
    assert states.PARTS[part](3, draws)


def test_a_short_life_is_within_its_bounds(states: ModuleType) -> None:
    assert states.drift(3, 1, hours=0.1)


def test_a_step_of_a_thousandth_is_found_and_an_ideal_fade_is_none(states: ModuleType) -> None:
    t = np.arange(states.RATE) / states.RATE
    up, down = (0.5 - 0.5 * np.cos(np.pi * np.clip((t - begin) / 0.02, 0, 1)) for begin in (0.3, 0.6))
    tone = 0.5 * (up - down) * np.sin(2 * np.pi * 250 * t)
    assert states.steps_db(tone).max() < states.MOST_CLICK_DB
    for height_db in (-59.0, -40.0):
        assert states.steps_db(tone + 10 ** (height_db / 20) * (t > 0.45))[: states.RATE // 2].max() == pytest.approx(
            height_db, abs=0.5
        )


def test_a_gain_that_is_off_by_2_db_is_found(states: ModuleType) -> None:
    heard = np.sin(np.arange(4800))[:, None] * [0.3, 0.15, 0.03 * 10 ** (2 / 20)]
    assert states.differences_db(heard, np.array([0.5, 0.1])) == pytest.approx([0.0, 2.0], abs=1e-6)


def test_a_few_motions_make_the_impacts_that_they_should(
    landings: ModuleType, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("sys.argv", ["landings.py", "--seed", "3", "--quiet", "11", "--falls", "6"])
    assert landings.main() == 0
    assert "no motion is wrong" in capsys.readouterr().out


def test_false_missing_and_repeated_landings_are_found(landings: ModuleType) -> None:
    true = landings.bounces(0.3, 0.5, 0.2)
    found_s = [one.time_s + 0.01 for one in true if one.speed_m_s > 0.4]
    assert landings.judged(true, found_s, 90) == []
    assert landings.judged([], [0.5], 90) == ["an impact at 0.500 s without a landing"]
    assert len(landings.judged(true, [0.3, *found_s], 90)) == 1
    assert len(landings.judged(true, found_s[1:], 90)) == 1
    assert len(landings.judged(true, [found_s[0], *found_s], 90)) == 1
