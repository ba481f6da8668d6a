"""Impacts whose gains a worker prepares: the session goes on meanwhile."""

from __future__ import annotations

from threading import Event, Thread
from typing import Any

import numpy as np
import pytest

from scene2hap import (
    HapticSession,
    ModalPlate,
    Touch,
)
from scene2hap.render.bursts import wave_of
from scene2hap.session.impacts import felt_impacts
from scene2hap.session.impacts.felt_impacts import Impact, struck_later
from scenes import table_with_two_phones
from struck_table import NEAR, RATE, STRUCK, rendered, session, touches


def test_worker_prepares_impacts_for_models_without_a_live_field() -> None:
    made = session(propagation="modal_plate")
    made.update(touches=touches())
    impact = made.strike("table", STRUCK, with_object="cup", speed_m_s=1.0)
    assert made.wait_prepared(30.0)
    assert set(impact.felt) == {"left", "right"}
    assert rendered(made, 0.1).any()


def held_up(monkeypatch: pytest.MonkeyPatch) -> tuple[HapticSession, Event]:
    """A session of which each impact waits for a worker, which waits for the event."""
    made, go_on = session(propagation=ModalPlate()), Event()

    def later(*given: Any) -> Any:
        prepared = struck_later(*given)
        return lambda: prepared() if go_on.wait(10.0) else None

    made._impacts._ahead = None
    monkeypatch.setattr(felt_impacts, "struck_later", later)
    return made, go_on


def test_impact_that_a_worker_prepares_sounds_before_the_next_update_which_reports_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    made, go_on = held_up(monkeypatch)
    made.update(touches=touches())
    made.wait_prepared()
    impact = made.strike("table", STRUCK)
    ((_, job),) = made._impacts._waiting
    go_on.set()
    job.result(30.0)
    assert rendered(made, 0.2).any(axis=0).all()
    assert not impact.felt  # a game may iterate over it, so only its own thread changes it
    made.update(touches=touches())
    assert set(impact.felt) == {"left", "right"}
    assert made.impacts == (impact,)
    assert made.stats.impacts_felt == 1


def test_impact_that_a_worker_prepares_in_a_pause_is_not_felt(monkeypatch: pytest.MonkeyPatch) -> None:
    made, go_on = held_up(monkeypatch)
    made.update(touches=touches())
    made.wait_prepared()
    impact = made.strike("table", STRUCK)
    made.pause()
    go_on.set()
    made.wait_prepared()
    assert impact.felt == {}
    assert made.impacts == ()
    made.resume()
    assert not rendered(made, 0.2).any()


def test_burst_that_a_worker_starts_as_a_pause_begins_does_not_play_on_after_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    made = session()
    playback, wave = made._playback, wave_of(100.0, 0.5, RATE)
    worker = Thread(target=lambda: playback.start_burst([wave], {playback.outputs["left"]: [0.5]}, 0))
    fade = playback._bursts.fade

    def slow_fade(given: Any) -> None:
        fade(given)
        worker.start()
        worker.join(0.1)

    monkeypatch.setattr(playback._bursts, "fade", slow_fade)
    made.pause()
    worker.join()
    rendered(made, 0.2)
    made.resume()
    assert not rendered(made, 0.2).any()


def test_impact_for_which_a_model_fails_is_counted_as_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    made, _ = held_up(monkeypatch)
    monkeypatch.setattr(felt_impacts, "struck_later", lambda *given: lambda: 1 / 0)
    made.update(touches=touches())
    assert not made.strike("table", STRUCK).felt
    assert made.wait_prepared(30.0)
    assert made.stats.impacts_left_out == 1


@pytest.mark.parametrize("propagation", ["exponential_plate", "modal_plate"])
@pytest.mark.parametrize(
    ("touching", "removed", "added", "channel"),
    [
        ("right", ("left",), (), 1),
        ("right", ("left", "mid"), ("mid", "left"), 0),
        ("mid", ("left",), ("left",), 0),
        ("left", (), ("foot",), 0),
        ("left", ("left",), (), None),
        ("left", ("left",), ("left",), None),
    ],
)
def test_strike_after_hands_have_changed_is_felt_by_the_hand_that_touches(
    touching: str, removed: tuple[str, ...], added: tuple[str, ...], channel: int | None, propagation: str
) -> None:
    scene, bundle = table_with_two_phones()
    made = HapticSession(scene, bundle, {"propagation": propagation}, hands=("left", "mid", "right"))
    for source_id in made.source_ids:
        made.set_source(source_id, on=False)
    made.update(touches=[Touch(touching, "table", NEAR)])
    assert made.wait_prepared(30.0)
    for hand in removed:
        made.remove_hand(hand)
    for hand in added:
        made.add_hand(hand)
    impact = made.strike("table", STRUCK, with_object="cup", speed_m_s=1.0)
    feeling = () if channel is None else (channel,)
    assert [*impact.felt] == [made.hands[i] for i in feeling]
    assert tuple(np.flatnonzero(rendered(made, 0.2).any(axis=0))) == feeling
    for i, hand in enumerate(made.hands):
        assert bool(made.explain(hand).touches) == (i in feeling)


@pytest.mark.parametrize("touching", ["left", "right"])
def test_impact_that_a_worker_prepares_while_a_hand_is_removed_is_felt_by_its_hand(
    touching: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    made, go_on = held_up(monkeypatch)
    made.update(touches=[Touch(touching, "table", NEAR)])
    made.wait_prepared()
    made.strike("table", STRUCK)
    made.remove_hand("left")
    go_on.set()
    made.wait_prepared()
    assert rendered(made, 0.2).any() == (touching == "right")


def test_strike_while_another_thread_changes_the_hands_is_felt_by_its_hand(monkeypatch: pytest.MonkeyPatch) -> None:
    made = session()
    made.update(touches=[Touch("right", "table", NEAR)])
    struck: list[Impact] = []
    for name in ("add_hand", "remove_hand"):
        change = getattr(made._mixers, name)

        def changed(*hand: Any, change: Any = change) -> None:
            change(*hand)
            # The mix has the new hands here, and the session still the former ones.
            struck.append(made.strike("table", STRUCK, with_object=(None, "cup")[len(struck)]))

        monkeypatch.setattr(made._mixers, name, changed)
    made.add_hand("foot")
    made.remove_hand("left")
    assert [[*impact.felt] for impact in struck] == [["right"], ["right"]]
    mixed = rendered(made, 0.2)
    assert mixed[:, made.hands.index("right")].any()
    assert not mixed[:, made.hands.index("foot")].any()


@pytest.mark.parametrize(("late_s", "is_felt"), [(0.2, True), (0.4, False)])
def test_impact_that_a_worker_prepares_too_late_is_left_out(
    late_s: float, is_felt: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A burst is late if its gains are; 0.4 s after the knock it would feel like another one."""
    made, go_on = held_up(monkeypatch)
    made.update(touches=touches())
    made.wait_prepared()
    impact = made.strike("table", STRUCK)
    assert not rendered(made, late_s).any()
    go_on.set()
    made.wait_prepared()
    assert bool(impact.felt) == rendered(made, 0.2).any() == is_felt
    assert made.stats.impacts_left_out == (not is_felt)
