"""Impacts in a session: which are played, counted and reported, and when."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from scene2hap import (
    Box,
    HapticSession,
    Pose,
    SceneObject,
    Touch,
)
from scene2hap.errors import SessionError, UnknownObject
from scene2hap.session.impacts.felt_impacts import LEAST_INTERVAL_S, MOST_PLAYING, Impact
from scenes import table_with_two_phones
from struck_table import RATE, STRUCK, TOP_M, rendered, session, touches


@pytest.mark.parametrize("kind", ["exponential_plate", "no_propagation", "full_propagation"])
def test_an_impact_sounds_with_the_next_block_and_ends(kind: str) -> None:
    """Also with the control conditions of the paper, so that no participant tells them apart by their delay."""
    made = session(propagation=kind)
    made.update(touches=touches())
    made.render(256)
    impact = made.strike("table", STRUCK, with_object="cup")
    assert impact.at_sample == 256
    assert made.render(256)[:, 0].any()
    rendered(made, 1.0)
    assert not made.render(480).any()


def test_strike_accepts_a_finger_or_an_impulse() -> None:
    made = session()
    made.update(touches=touches())
    knock = made.strike("table", STRUCK)
    assert knock.speed_m_s == 0.5
    assert knock.frequency_hz < 150
    assert knock.felt["left"] > 0.005
    made.render_s(0.1)
    assert made.strike("table", STRUCK, impulse_n_s=1.0).felt["left"] > knock.felt["left"]


def test_impact_on_an_untouched_object_is_not_felt() -> None:
    made = session()
    made.update()
    assert made.strike("table", STRUCK).felt == {}
    assert not rendered(made, 0.1).any()
    made.update(touches=[Touch("left", "cup", (5.0, 0.05, 5.0))])
    assert made.strike("table", STRUCK).felt == {}
    assert (made.stats.impacts, made.stats.impacts_felt) == (2, 0)


@pytest.mark.parametrize("lasts_s", [0.0, 0.5])
def test_an_impact_after_a_pause_is_felt_though_others_were_before_it(lasts_s: float) -> None:
    made = session()
    made.update(touches=touches())
    made.strike("table", STRUCK)
    rendered(made)
    made.pause()
    made.render(round(lasts_s * RATE))
    made.resume()
    made.update(touches=touches())
    impact = made.strike("table", STRUCK, with_object="phone")
    assert np.abs(rendered(made)).max() >= 0.99 * impact.felt["left"]


def test_pause_and_mute_silence_impacts() -> None:
    made = session()
    made.update(touches=touches())
    made.strike("table", STRUCK, speed_m_s=3.0)
    made.pause()
    made.render_s(0.3)
    assert made.strike("table", STRUCK).felt == {}
    made.resume()
    made.update(touches=touches())
    assert not made.render_s(0.1).any()
    made.set_user(mute=True)
    made.update(touches=touches())
    assert made.strike("table", STRUCK).felt == {}


def test_impacts_in_fast_succession_are_merged() -> None:
    made = session()
    made.update(touches=touches())
    made.strike("table", STRUCK)
    assert made.strike("table", STRUCK).felt == {}
    assert made.strike("table", STRUCK, with_object="cup").felt  # another pair
    for share, is_felt in ((0.9, False), (0.1, True)):
        made.render_s(share * LEAST_INTERVAL_S)
        made.update(touches=touches())
        assert bool(made.strike("table", STRUCK).felt) == is_felt
    stats = made.stats
    assert (stats.impacts, stats.impacts_felt, stats.impacts_left_out) == (3, 3, 0)


@pytest.mark.parametrize("frames_hz", [20, 30, 60, 90])
@pytest.mark.parametrize("pair", [("table", "cup"), ("cup", "table")])
@pytest.mark.parametrize("when", ["before", "after"])
def test_a_strike_of_a_landing_that_the_session_finds_too_is_one_impact(
    when: str, pair: tuple[str, str], frames_hz: int
) -> None:
    made = session()
    struck, striker = pair
    has_landed = False
    for frame in range(frames_hz):
        above_m = max(0.0, 0.4 - 9.81 * (frame / frames_hz) ** 2 / 2)
        lands, has_landed = above_m == 0.0 and not has_landed, above_m == 0.0
        if lands and when == "before":
            made.strike(struck, STRUCK, with_object=striker, speed_m_s=1.0)
        made.update({"cup": Pose((0.45, TOP_M + 0.05 + above_m, 0.4))}, touches())
        if lands and when == "after":
            made.strike(struck, STRUCK, with_object=striker, speed_m_s=1.0)
        made.render_s(1 / frames_hz)
    stats = made.stats
    assert (stats.impacts, stats.impacts_felt, stats.impacts_left_out) == (1, 1, 0)


def test_an_impact_that_nobody_could_feel_is_felt_if_it_is_reported_again_with_a_hand() -> None:
    made = session()
    assert not made.strike("table", STRUCK).felt
    made.update(touches=touches())
    assert made.strike("table", STRUCK).felt
    stats = made.stats
    assert (stats.impacts, stats.impacts_felt, stats.impacts_left_out) == (1, 1, 0)


def test_impacts_beyond_the_most_that_play_are_left_out_and_end_none_that_plays() -> None:
    made = HapticSession(*table_with_two_phones())
    made.update(touches=touches())
    for i in range(MOST_PLAYING + 8):
        made.add(SceneObject(f"cup {i}", pose=Pose((9.0, 0.1 * i, 9.0)), geometry=Box((0.05, 0.05, 0.05))))
    for source_id in made.source_ids:
        made.set_source(source_id, on=False)
    made.update(touches=touches())
    felt = [bool(made.strike("table", STRUCK, with_object=f"cup {i}").felt) for i in range(MOST_PLAYING + 8)]
    assert felt == [True] * MOST_PLAYING + [False] * 8
    assert made.stats.impacts_left_out == 8
    rendered(made, 2.0)
    made.update(touches=touches())
    assert made.strike("table", STRUCK, with_object="cup 39").felt


def test_landings_are_felt_explained_and_can_be_disabled() -> None:
    def drop(**settings: Any) -> tuple[HapticSession, list[Impact]]:
        made, told = session(**settings), []
        for step in range(60):
            height = max(0.0, 0.4 - 9.81 * (step / 90) ** 2 / 2)
            made.update({"cup": Pose((0.45, TOP_M + 0.05 + height, 0.4))}, touches())
            made.render_s(1 / 90)
            told += [x for x in made.explain("left").impacts if x not in told]
        return made, told

    made, told = drop()
    (impact,) = told
    assert (impact.object_id, impact.with_object) == ("table", "cup")
    assert impact.speed_m_s == pytest.approx(math.sqrt(2 * 9.81 * 0.4), rel=0.01)
    assert made.stats.impacts == 1
    assert "table struck by cup" in made.explain("left").text
    assert "impacts" in made.explain("left").to_data()
    made, told = drop(impacts=False)
    assert told == []
    assert made.stats.impacts == 0


@pytest.mark.parametrize("height_m", [0.01, 0.03])
def test_landing_after_a_short_fall_from_rest_has_its_speed(height_m: float) -> None:
    """The first step counts, whose time is that of the update."""
    made = session()
    rest = [height_m] * 15  # longer than the gap after which a motion has ended
    for above_m in [*rest, *(max(0.0, height_m - 9.81 * (step / 90) ** 2 / 2) for step in range(1, 20))]:
        made.update({"cup": Pose((0.45, TOP_M + 0.05 + above_m, 0.4))}, touches())
        made.render_s(1 / 90)
    (impact,) = made.explain("left").impacts
    assert impact.speed_m_s is not None
    assert impact.speed_m_s == pytest.approx(math.sqrt(2 * 9.81 * height_m), rel=0.01)


def test_hands_can_change_during_a_burst() -> None:
    made = session()
    made.update(touches=touches())
    made.strike("table", STRUCK, speed_m_s=2.0)
    made.add_hand("foot")
    assert made.render(480)[:, 0].any()
    made.remove_hand("left")
    assert made.render(480).shape == (480, 2)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"speed_m_s": -1.0}, "above 0"),
        ({"speed_m_s": math.nan}, "finite"),
        ({"impulse_n_s": 0.0}, "above 0"),
        ({"speed_m_s": 1.0, "impulse_n_s": 1.0}, "one of them"),
    ],
)
def test_invalid_strike_is_refused(given: dict[str, float], said: str) -> None:
    with pytest.raises(SessionError, match=said):
        session().strike("table", STRUCK, **given)


def test_strike_on_a_missing_object_is_refused() -> None:
    made = session()
    with pytest.raises(UnknownObject, match="tabel"):
        made.strike("tabel", STRUCK)
    with pytest.raises(UnknownObject, match="mug"):
        made.strike("table", STRUCK, with_object="mug")
    with pytest.raises(SessionError, match="the struck object itself"):
        made.strike("table", STRUCK, with_object="table")
    with pytest.raises(SessionError, match="point_m"):
        made.strike("table", (0.0, 1.0))
