"""A session that frames drive, without a server."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import pytest

from bridge_frames import encode_frame
from scene2hap import HapticSession, MemorySink
from scene2hap.bridge.frames import Frame, decode_frame
from scene2hap.bridge.played_session import LONGEST_FRAME_S, PlayedSession
from scene2hap.errors import SessionError
from scenes import table_with_two_phones

MOVING = ("phone", "cup")


@pytest.fixture
def played() -> Iterator[PlayedSession]:
    sink = MemorySink()
    scene, bundle = table_with_two_phones()
    session = HapticSession(scene, bundle, hands=("left",), sink=sink)
    session.wait_prepared()
    made = PlayedSession(session, MOVING, sink, lambda document: None)
    yield made
    made.close()


def frame(
    played: PlayedSession,
    number: int,
    time_s: float,
    touches: Sequence[tuple[int, int, tuple[float, float, float]]] = (),
    **moved: tuple[float, float, float],
) -> Frame:
    at = [moved.get(name, played.session.poses[name].position_m) for name in MOVING]
    poses = np.array([[*point, 0.0, 0.0, 0.0, 1.0] for point in at])
    return decode_frame(encode_frame(played.layout.number, bytes(8), number, time_s, poses, touches))


def test_time_that_a_game_stood_still_is_left_out(played: PlayedSession) -> None:
    sink = played._sink
    assert isinstance(sink, MemorySink)
    played.take(frame(played, 1, 0.0))
    n, rate_hz = len(sink.samples), played.session.config.sample_rate_hz
    played.take(frame(played, 2, 0.25))
    assert len(sink.samples) - n == round(0.25 * rate_hz)
    played.take(frame(played, 3, 100.0))
    assert len(sink.samples) - n == round((0.25 + LONGEST_FRAME_S) * rate_hz)


def test_a_pose_of_a_failed_update_is_passed_on_with_the_next(
    played: PlayedSession, monkeypatch: pytest.MonkeyPatch
) -> None:
    x, y, z = played.session.poses["phone"].position_m

    def fail(*given: object) -> None:
        raise SessionError("no update")

    with monkeypatch.context() as during:
        during.setattr(HapticSession, "update", fail)
        with pytest.raises(SessionError):
            played.take(frame(played, 1, 0.0, phone=(x + 0.1, y, z)))
    played.take(frame(played, 2, 0.02, phone=(x + 0.1, y, z)))
    assert played.session.poses["phone"].position_m == pytest.approx((x + 0.1, y, z))


@pytest.fixture
def game() -> Iterator[PlayedSession]:
    """A session without a sink, whose gains the game plays itself."""
    scene, bundle = table_with_two_phones()
    with HapticSession(scene, bundle, hands=("left",)) as session:
        session.wait_prepared()
        yield PlayedSession(session, MOVING, None, lambda document: None)


def intensity(played: PlayedSession, number: int, time_s: float, *, touches: bool = True) -> float:
    phone = played.layout.objects.index("phone")
    given = [(0, phone, played.session.poses["phone"].position_m)] if touches else []
    found = played.take(frame(played, number, time_s, given))
    assert found is not None
    return float(found.intensities[0])


def test_two_frames_at_one_time_have_the_intensity_of_the_first(game: PlayedSession) -> None:
    """The clock of a game may be coarser than its frames."""
    intensities = [intensity(game, k, time_s) for k, time_s in enumerate((0.0, 0.5, 0.5, 1.0), 1)]
    assert intensities[1] > 0
    assert intensities[2] == intensities[1]


def test_a_paused_game_whose_clock_stands_still_feels_nothing(game: PlayedSession) -> None:
    assert [intensity(game, 1, 0.0), intensity(game, 2, 0.5)][1] > 0
    game.pause()
    assert intensity(game, 3, 0.5) == 0
    game.unpause()
    assert intensity(game, 4, 1.0) > 0


def test_a_lifted_hand_feels_nothing_while_the_clock_stands_still(game: PlayedSession) -> None:
    assert [intensity(game, 1, 0.0), intensity(game, 2, 0.5)][1] > 0
    assert intensity(game, 3, 0.5, touches=False) == 0
