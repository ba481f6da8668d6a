"""A game saves a session by its public values and restores it, from JSON or while it plays."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any

import numpy as np
import pytest

from scene2hap import HapticBundle, HapticSession, MemorySink, Pose, SceneSnapshot, Touch
from scene2hap.session.mix.sources import SourceInfo
from scenes import table_with_two_phones

TOUCHES = [Touch("left", "phone", (0.1, 0.73, 0.4)), Touch("right", "alarm", (1.5, 0.73, 0.4))]


def saved(session: HapticSession) -> str:
    sources = {
        one.id: {"on": one.is_on, "state": one.state, "gain_db": one.gain_db, "mute": one.is_muted}
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
