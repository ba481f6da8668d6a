"""A game saves a session by its public values and restores it, from JSON or while it plays."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from scene2hap import HapticBundle, HapticSession, MemorySink, Pose, SceneSnapshot, Touch
from scene2hap.errors import SessionError
from scene2hap.session.mix.sources import SourceInfo
from scenes import table_with_two_phones

TOUCHES = [Touch("left", "phone", (0.1, 0.73, 0.4)), Touch("right", "alarm", (1.5, 0.73, 0.4))]


def saved(session: HapticSession) -> str:
    sources = {
        one.id: {
            "on": one.is_on,
            "state": one.state,
            "gain_db": one.gain_db,
            "mute": one.is_muted,
            "progress": one.progress,
        }
        for one in map(session.source, session.source_ids)
    }
    poses = {id: (pose.position_m, pose.rotation_xyzw) for id, pose in session.poses.items()}
    return json.dumps({"sources": sources, "poses": poses})


def take_over(data: dict[str, Any], session: HapticSession) -> None:
    for source_id, settings in data["sources"].items():
        session.set_source(source_id, **settings)
    session.update({id: Pose(*pose) for id, pose in data["poses"].items()})


def tables(first_db: float = 0.0) -> tuple[SceneSnapshot, HapticBundle]:
    scene, bundle = table_with_two_phones()
    return scene, bundle.override("alarm", gain_db=first_db) if first_db else bundle


@pytest.mark.parametrize(
    "settings",
    [
        {},
        {"gain_db": -6.5},
        {"gain_db": -6.0, "mute": True},
        {"on": False},
        {"state": "alarm", "gain_db": 1e-3},
        {"gain_db": -1e6},
    ],
)
def test_restored_session_gives_the_same_gains(settings: dict[str, Any]) -> None:
    made = HapticSession(*tables(-3.0), {"prepare": "blocking"})
    made.set_source("phone", **settings)
    made.update({"cup": Pose((5.0, 0.5, 5.0))})
    again = HapticSession(*tables(-3.0), {"prepare": "blocking"})
    take_over(json.loads(saved(made)), again)
    assert saved(again) == saved(made)
    np.testing.assert_array_equal(again.update(touches=TOUCHES).gains, made.update(touches=TOUCHES).gains)
    for session in (made, again):
        session.set_source("phone", mute=False)
    np.testing.assert_array_equal(again.update(touches=TOUCHES).gains, made.update(touches=TOUCHES).gains)


def machine(**times: Any) -> HapticSession:
    scene, bundle = table_with_two_phones()
    phone = bundle.objects["phone"]
    states = tuple(replace(state, **times) for state in phone.states)
    objects = {**bundle.objects, "phone": replace(phone, states=states)}
    session = HapticSession(scene, replace(bundle, objects=objects), {"prepare": "blocking"})
    session.set_source("alarm", on=False)
    return session


def played(session: HapticSession, seconds: float) -> np.ndarray:
    """RMS of the left hand in steps of 0.1 s, with an update every 20 ms."""
    blocks = []
    for _ in range(round(seconds * 50)):
        session.update(touches=TOUCHES[:1])
        blocks.append(session.render(960)[:, 0])
    rms: np.ndarray = np.sqrt((np.concatenate(blocks).astype(np.float64).reshape(-1, 4800) ** 2).mean(axis=1))
    return rms


@pytest.mark.parametrize("goes_up", [True, False])
@pytest.mark.parametrize("spins", [True, False])
def test_start_or_stop_under_way_goes_on_in_a_restored_session(goes_up: bool, spins: bool) -> None:
    times = {"start_up_s": 3.0, "wind_down_s": 3.0, "spins": spins}
    made, again = machine(**times), machine(**times)
    made.set_source("phone", on=not goes_up)
    played(made, 0.2)
    made.set_source("phone", on=goes_up)
    played(made, 1.0)
    take_over(json.loads(saved(made)), again)
    one, other = made.source("phone"), again.source("phone")
    assert one.is_running == other.is_running == goes_up
    assert one.progress.amplitude is not None
    assert other.progress.amplitude == pytest.approx(one.progress.amplitude, rel=1e-6)
    assert other.progress.speed == pytest.approx(one.progress.speed, rel=1e-6)
    before, after = played(made, 3.0), played(again, 3.0)
    # Without the fade-in of a new session; a stop is steady for 30 ms at first.
    np.testing.assert_allclose(after[1:], before[1:], atol=0.07 * before.max())


def test_cycle_goes_on_in_a_restored_session() -> None:
    times = {"on_s": 2.0, "off_s": 1.5}
    made, again, switched = machine(**times), machine(**times), machine(**times)
    made.set_source("phone", on=True)  # a new on-time
    played(made, 0.2)
    made.set_source("phone", on=True)
    played(made, 2.6)  # 0.6 s of its off-time
    data = saved(made)
    for session in (again, switched):
        take_over(json.loads(data), session)
    assert not again.source("phone").is_running
    before, after = played(made, 6.0), played(again, 6.0)
    np.testing.assert_array_equal(after > 0.01, before > 0.01)
    switched.set_source("phone", on=True)  # a person begins a new on-time, as ever
    assert switched.source("phone").is_running


def test_progress_of_a_state_without_a_cycle_is_left_out() -> None:
    """The bundle may have been baked again since the game was saved."""
    session = machine()
    session.set_source("phone", on=True, progress=[None, None, True, 100.0])
    session.update(touches=TOUCHES)
    assert session.source("phone").is_running
    assert session.source("phone").progress == (None, None, False, None)


@pytest.mark.parametrize(
    "wrong",
    ["half", [0.5], [0.5, None, False, None], [2.0, 0.5, False, None], [None, None, 1, None], [None, None, True, -1.0]],
)
def test_progress_of_another_form_is_refused(wrong: Any) -> None:
    session = machine(on_s=2.0, off_s=1.5)
    with pytest.raises(SessionError, match=r"progress|speed|amplitude|is_resting|turn_left_s"):
        session.set_source("phone", on=False, progress=wrong)
    assert session.source("phone").is_on


def test_level_of_a_source_is_the_bundles_at_first() -> None:
    scene, bundle = tables(-3.0)
    session = HapticSession(scene, bundle)
    assert [(one.gain_db, one.is_muted) for one in infos(session, ("phone", "alarm"))] == [(0.0, False), (-3.0, False)]
    session.set_source("alarm", gain_db=-12.0, mute=True)
    session.set_user(gain_db=-20.0, mute=True)  # the person's, not the source's
    assert [(one.gain_db, one.is_muted) for one in infos(session, ("phone", "alarm"))] == [(0.0, False), (-12.0, True)]


def infos(session: HapticSession, ids: Iterable[str]) -> list[SourceInfo]:
    return [session.source(one) for one in ids]


def require_no_step(parts: list[np.ndarray]) -> None:
    """A step is a second difference far above those of the loop itself; a fade over 8 ms doubles them."""
    bend = np.abs(np.diff(np.concatenate(parts).astype(np.float64), 2))
    assert bend[5_000:].max() < 3 * bend[10_000:20_000].max() < 3e-4


def other_model(old: HapticSession, sink: MemorySink | None = None) -> HapticSession:
    new = HapticSession(*tables(), {"prepare": "blocking", "propagation": "modal_plate"}, sink=sink)
    take_over(json.loads(saved(old)), new)
    return new


def test_another_model_takes_over_a_sink_without_a_step() -> None:
    parts, sink = [], MemorySink()
    session = HapticSession(*tables(), {"prepare": "blocking"}, sink=sink)
    session.set_source("phone", gain_db=-3.0)
    for _ in range(2):
        session.start()
        for _ in range(50):
            session.update(touches=TOUCHES)
            sink.pull(480)
        session.stop()
        parts.append(sink.samples[:, 0])
        session = other_model(session, sink)
    require_no_step(parts)


def test_another_model_takes_over_rendering_without_a_step() -> None:
    def played(session: HapticSession) -> np.ndarray:
        session.update(touches=TOUCHES)
        return session.render(480)[:, 0]

    old = HapticSession(*tables(), {"prepare": "blocking"})
    parts = [played(old) for _ in range(50)]
    new = other_model(old)
    old.pause()
    parts += [played(old) + played(new) for _ in range(10)]
    assert np.abs(old.render(4800)).max() == 0.0
    parts += [played(new) for _ in range(40)]
    require_no_step(parts)
