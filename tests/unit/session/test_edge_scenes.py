"""Sessions of scenes that are empty of sources or contacts, or nearly so."""

import dataclasses

import numpy as np
import pytest

from edge_scenes import EDGE_SCENES, on_top_of
from scene2hap import Contact, HapticSession, Pose, Touch
from scene2hap.errors import SessionError, UnknownObject
from scene2hap.propagation import MODELS
from scenes import RATE, box, haptics, tone_loop

# Two seconds are enough on an idle processor; on a busy one it may take minutes.
PATIENCE_S = 600.0

pytestmark = pytest.mark.filterwarnings("ignore::scene2hap.propagation.domain.ThinPlateWarning")


def session_of(name: str, **config: object) -> HapticSession:
    return HapticSession(*EDGE_SCENES[name](), {"sample_rate_hz": RATE, **config})


def live(session: HapticSession) -> None:
    """Call once everything that a game may call."""
    scene = session.snapshot
    first, last = scene.objects[0], scene.objects[-1]
    touches = [Touch("left", first.id, on_top_of(first)), Touch("right", last.id, on_top_of(last))]
    x, y, z = last.pose.position_m
    for moved in (
        {},
        {last.id: Pose((x, y + 1.0, z))},
        {last.id: last.pose},
        {item.id: item.pose for item in scene.objects},
    ):
        frame = session.update(moved, touches)
        assert frame.gains.shape == (2, len(session.source_ids), session.config.bands.n_bands)
        assert np.isfinite(session.render(400)).all()
        assert str(session.explain("left"))
        assert str(session.explain("right"))
    session.update(contacts=[])
    session.update(touches=touches)
    if first is not last:
        session.update(contacts=[Contact(first.id, last.id, on_top_of(first))], touches=touches)
    session.pause()
    session.resume()
    session.set_user(gain_db=-6.0)
    session.add_hand("foot")
    visitor = box("visitor", (0.1, 0.1, 0.1), (0.8, 0.77, 0.4))
    session.add(visitor, haptics("plastic", (0.1, 0.1, 0.1), "on"), {"on": tone_loop(180)})
    assert session.wait_prepared(PATIENCE_S)
    assert session.update(touches=[Touch("left", "visitor", (0.8, 0.77, 0.4))]).gain("left", "visitor") > 0.5
    assert session.render(4000).any()
    session.remove("visitor")
    session.remove_hand("foot")
    session.update({last.id: Pose((x, y + 1.0, z))}, touches)
    assert np.isfinite(session.render(400)).all()
    assert session.wait_prepared(PATIENCE_S)
    assert session.stats.fields_failed == 0


@pytest.mark.parametrize("kind", MODELS.kinds())
@pytest.mark.parametrize("name", EDGE_SCENES)
def test_edge_scenes_survive_every_session_call(name: str, kind: str) -> None:
    live(session_of(name, propagation=kind, prepare="blocking"))


@pytest.mark.parametrize("prepare", ["background", "blocking"])
@pytest.mark.parametrize("skip", [True, False])
@pytest.mark.parametrize("name", EDGE_SCENES)
def test_edge_scenes_work_with_every_skip_and_prepare_setting(name: str, skip: bool, prepare: str) -> None:
    live(session_of(name, propagation="infinite_plate", skip=skip, prepare=prepare, bands="third-octaves"))


@pytest.mark.parametrize("name", EDGE_SCENES)
def test_every_source_is_felt_on_itself_in_full(name: str) -> None:
    session = session_of(name)
    for source_id in session.source_ids:
        at = on_top_of(session.snapshot.object(source_id))
        is_waiting = name == "no_contact" and source_id == "pan"
        assert session.update(touches=[Touch("left", source_id, at)]).gain("left", source_id) == float(not is_waiting)


def test_source_that_needs_contact_starts_with_its_first_contact() -> None:
    session = session_of("no_contact")
    session.update({"pan": Pose((1.0, 0.725, 0.4))}, [Touch("left", "pan", (1.0, 0.73, 0.4))])
    assert session.update(touches=[Touch("left", "table", (1.2, 0.72, 0.4))]).gain("left", "pan") > 0.0


@pytest.mark.parametrize("name", ["no_source", "all_unknown", "one_silent_object"])
def test_silent_scene_renders_silence_and_warns(name: str) -> None:
    session = session_of(name)
    item = session.snapshot.objects[0]
    frame = session.update(touches=[Touch("left", item.id, on_top_of(item))])
    assert session.source_ids == frame.sources == ()
    assert not session.render(1000).any()
    assert "feels nothing" in str(session.explain("left"))
    with pytest.raises(UnknownObject, match="nothing in this scene vibrates"):
        session.set_source("radio", on=True)


def test_last_object_cannot_be_removed() -> None:
    for name in ("one_object", "one_silent_object"):
        session = session_of(name)
        with pytest.raises(SessionError, match="last object"):
            session.remove(session.snapshot.objects[0].id)


def test_bundle_with_states_without_loops_is_played() -> None:
    snapshot, bundle = EDGE_SCENES["one_object"]()
    session = HapticSession(snapshot, dataclasses.replace(bundle, loops={"phone": {}}), {"sample_rate_hz": RATE})
    assert session.source_ids == ()
    live(session)
