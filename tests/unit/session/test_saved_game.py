"""A game saves a session by its public values and restores it from JSON."""

from __future__ import annotations

import json
from collections.abc import Iterable

import numpy as np
import pytest

from scene2hap import HapticBundle, HapticSession, Pose, SceneSnapshot, Touch
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


def restored(scene: SceneSnapshot, bundle: HapticBundle, text: str) -> HapticSession:
    data, session = json.loads(text), HapticSession(scene, bundle, {"prepare": "blocking"})
    for source_id, settings in data["sources"].items():
        session.set_source(source_id, **settings)
    session.update({id: Pose(*pose) for id, pose in data["poses"].items()})
    return session


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
def test_restored_session_gives_the_same_gains(settings: dict[str, object]) -> None:
    made = HapticSession(*tables(-3.0), {"prepare": "blocking"})
    made.set_source("phone", **settings)  # type: ignore[arg-type]
    made.update({"cup": Pose((5.0, 0.5, 5.0))})
    again = restored(*tables(-3.0), saved(made))
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
