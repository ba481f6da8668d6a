"""Objects that fall while the session is paused: its clock stands still, but the game may go on."""

import math

import pytest

from scene2hap import HapticSession, Pose, Touch
from scene2hap.session.impacts.felt_impacts import Impact
from scenes import table_with_two_phones

TOP_M = 0.72
HAND = [Touch("left", "table", (0.5, TOP_M, 0.4))]
HEIGHT_M = 0.3
LANDS_S = math.sqrt(2 * HEIGHT_M / 9.81)


def fall(rate_hz: int, paused_at: int, resumed_at: int) -> tuple[Impact, ...]:
    """Let a phone fall on the table from 0.3 m, in a session that is paused between two frames of the fall.

    Returns: the impacts that the hand felt.
    """
    session = HapticSession(*table_with_two_phones())
    phone, *_ = session.source_ids
    lies = session.poses[phone]
    x_m, y_m, z_m = lies.position_m

    def frame(height_m: float) -> None:
        session.render_s(1 / rate_hz)
        session.update({phone: Pose((x_m, y_m + height_m, z_m), lies.rotation_xyzw)}, HAND)

    for _ in range(rate_hz // 2):
        frame(HEIGHT_M)
    for number in range(rate_hz // 2):
        if number == paused_at:
            session.pause()
        if number == resumed_at:
            session.resume()
        frame(max(0.0, HEIGHT_M - 9.81 / 2 * (number / rate_hz) ** 2))
    return session.impacts


@pytest.mark.parametrize("rate_hz", [60, 90, 144])
@pytest.mark.parametrize("later", [1, 2, 3, 5])
def test_a_landing_in_a_pause_is_not_felt_after_it(rate_hz: int, later: int) -> None:
    lands_at = math.ceil(LANDS_S * rate_hz)
    assert not fall(rate_hz, lands_at - 9, lands_at + later + 1)


@pytest.mark.parametrize("rate_hz", [60, 90, 144])
def test_a_landing_soon_after_a_pause_is_no_faster_than_the_fall(rate_hz: int) -> None:
    lands_at = math.ceil(LANDS_S * rate_hz)
    (whole,) = fall(rate_hz, 1000, 1000)
    for before in (3, 4, 6):
        (after,) = fall(rate_hz, lands_at - 9, lands_at - before)
        assert whole.speed_m_s is not None
        assert after.speed_m_s is not None
        # The first step of a motion is taken to last a control period, in which a frame at 144 Hz fits three times.
        assert 0.4 * whole.speed_m_s < after.speed_m_s < 1.15 * whole.speed_m_s
