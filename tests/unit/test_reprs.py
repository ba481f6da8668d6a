"""What public objects show at the prompt and in logs: short, the same in every run, and as it is written in code."""

from __future__ import annotations

import numpy as np
import pytest

from scene2hap import (
    BakeConfig,
    Box,
    ContactGraph,
    EngineLink,
    FunctionBackend,
    HapticSession,
    MemorySink,
    Pose,
    SceneObject,
    SceneSnapshot,
    TeeSink,
    Touch,
    TouchTrack,
    UdpSink,
    WavSink,
)
from scenes import table_with_two_phones


@pytest.mark.parametrize(
    "built",
    [
        Pose(),
        Pose((1, 2, 3)),
        Pose.from_yaw((0.1, 0, 0), 0.3),
        Box((1, 2, 3)),
        SceneObject("oak table", pose=Pose((0, 0.36, 0)), geometry=Box((1.2, 0.72, 0.7))),
        SceneObject("t/1\n", name="oak table", pose=Pose.from_yaw((0, 1, 0), 1), geometry=Box((1, 1, 1)), mass_kg=3),
    ],
    ids=repr,
)
def test_an_object_is_shown_as_it_is_written_in_code(built: object) -> None:
    assert eval(repr(built)) == built
    assert len(repr(built)) < 200


def test_an_object_of_a_scene_leaves_out_what_was_measured() -> None:
    table = SceneObject("oak table", pose=Pose((0, 0.5, 0)), geometry=Box((1, 1, 1)))
    (placed,) = SceneSnapshot.build([table]).objects
    assert repr(placed) == "SceneObject('oak table', pose=Pose((0.0, 0.5, 0.0)), geometry=Box((1.0, 1.0, 1.0)))"


def test_a_hinge_is_shown() -> None:
    wall = SceneObject("wall", geometry=Box((1, 1, 0.1)))
    door = SceneObject("door", pose=Pose((1, 0, 0)), geometry=Box((1, 1, 0.1))).hinged_on(wall, (0.5, 0, 0))
    assert "hinge=Hinge(to='wall'" in repr(door)


class Still:
    """An engine in which nothing moves."""

    def __init__(self, session: HapticSession) -> None:
        self.now = dict(session.poses)

    def poses(self) -> dict[str, Pose]:
        return self.now

    def touches(self) -> list[Touch]:
        return []

    def contacts(self) -> None:
        return None


def test_no_address_of_memory_is_shown() -> None:
    scene, bundle = table_with_two_phones()
    session = HapticSession(scene, bundle)
    link = EngineLink(Still(session), session)
    sinks = [MemorySink(), WavSink("touch.wav"), UdpSink(), TeeSink([MemorySink(), WavSink("b.wav")])]
    backend = FunctionBackend(lambda request: "", model="mine")
    for shown in [*sinks, link, backend, session, session.update(), ContactGraph(scene), BakeConfig()]:
        assert " at 0x" not in repr(shown)
        assert type(shown).__name__ in repr(shown)


def test_settings_of_equal_value_are_shown_equally() -> None:
    assert repr(BakeConfig()) == repr(BakeConfig())


def test_a_sink_in_memory_shows_how_much_it_holds() -> None:
    with HapticSession(*table_with_two_phones(), sink=(sink := MemorySink())):
        sink.pull(100)
        assert repr(sink) == "MemorySink(100 frames of 2 channels)"


def test_a_frame_of_many_sources_is_short() -> None:
    from scene2hap.session.frame import HapticFrame

    sources = tuple(f"fan {k}" for k in range(500))
    frame = HapticFrame(np.zeros((2, 500, 1), np.float32), ("left", "right"), sources)
    assert repr(frame).startswith("HapticFrame(hands left, right; sources fan 0, fan 1, ")
    assert repr(frame).endswith("fan 7 and 492 more)")


def test_reasons_and_digests_do_not_hide_the_other_fields_of_a_bundle() -> None:
    _, bundle = table_with_two_phones()
    for haptics in bundle.objects.values():
        assert "provenance" not in repr(haptics)
        assert "reasons" not in repr(haptics)
        assert "vibrates=" in repr(haptics)
    for states in bundle.loops.values():
        assert all("fingerprint" not in repr(loop) for loop in states.values())


def test_a_long_track_is_shown_by_its_length() -> None:
    steps = [{"time_s": 0.01 * number, "hand": "left", "touch": "table"} for number in range(1000)]
    track = TouchTrack(duration_s=10.0, steps=steps)
    assert repr(track) == str(track) == "TouchTrack(1,000 steps, 10 s)"
