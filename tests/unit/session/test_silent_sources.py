"""Sources that are silent by themselves: what `source` and `explain` say of them, and calls that fail as a whole."""

from dataclasses import replace

import pytest

from scene2hap import HapticBundle, HapticSession, Pose, Touch
from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.audio.sensation import Sensation
from scene2hap.errors import SessionError
from scenes import box, haptics, scene, tone_loop

ON_PAN = [Touch("left", "pan", (0.0, 0.93, 0.0))]
LIFTED = Pose((0.0, 1.5, 0.0))
SETTLED = Pose((0.0, 0.915, 0.0))


def humming_hob(*, hob_s: tuple[float, float] | None = None, hum: HapticLoop | None = None) -> HapticSession:
    """A pan that sizzles on a humming hob. `hob_s` : on-time and off-time of the hob."""
    snapshot = scene(box("hob", (0.6, 0.9, 0.6), (0.0, 0.45, 0.0)), box("pan", (0.2, 0.03, 0.2), SETTLED.position_m))
    hob, pan = haptics("steel", (0.6, 0.6, 0.9), "on"), haptics("steel", (0.2, 0.2, 0.03), "sizzling")
    if hob_s is not None:
        hob = replace(hob, states=(replace(hob.states[0], on_s=hob_s[0], off_s=hob_s[1]),))
    pan = replace(pan, states=(replace(pan.states[0], needs_contact="hob"),))
    loops = {"pan": {"sizzling": tone_loop(100)}, "hob": {"on": hum or tone_loop(50)}}
    bundle = HapticBundle(snapshot, "kitchen", {"hob": hob, "pan": pan}, loops)
    return HapticSession(snapshot, bundle, {"prepare": "blocking"})


def test_a_source_runs_while_it_is_on_and_has_its_contact() -> None:
    session = humming_hob()
    assert session.source("pan").is_running
    session.update({"pan": LIFTED})
    lifted = session.source("pan")
    assert lifted.is_on
    assert not lifted.is_running
    session.update({"pan": SETTLED})
    assert session.source("pan").is_running
    session.set_source("hob", on=False)
    session.update()
    assert not session.source("hob").is_running
    assert not session.source("pan").is_running, "its hob is off"
    session.set_source("hob", on=True, mute=True)
    session.update()
    assert session.source("hob").is_running, "a muted source runs: its sound may be played"


def test_a_source_does_not_run_in_its_off_time() -> None:
    session = humming_hob(hob_s=(10.0, 5.0))
    seen = []
    for _ in range(60):
        session.update()
        seen.append(session.source("hob").is_running)
        session.render_s(0.5)
    assert session.source("hob").is_on
    assert 15 <= seen.count(False) <= 20, "5 s of 15, in 30 s"


def reasons(session: HapticSession) -> tuple[str, ...]:
    """Why the left hand, on the pan, does not feel what it might."""
    session.update(touches=ON_PAN)
    return session.explain("left").reasons


def test_a_touched_source_that_is_silent_is_explained_beside_another_that_is_felt() -> None:
    session = humming_hob()
    assert reasons(session) == ()
    session.set_source("pan", mute=True)
    assert reasons(session) == ("Touched, but muted: 'pan'; call `set_source` with mute false.",)
    assert [one.source_id for one in session.explain("left").felt] == ["hob"]
    session.set_source("pan", mute=False, on=False)
    assert reasons(session) == ("Touched, but off: 'pan'; call `set_source` with on true.",)


def test_sources_too_weak_to_be_felt_do_not_hide_why_the_others_are_silent() -> None:
    session = humming_hob(hum=replace(tone_loop(50), felt=Sensation(10.0, 10.0)))
    session.set_source("pan", on=False)
    session.set_source("hob", gain_db=-30.0)
    assert reasons(session) == ("Connected, but off: 'pan'; call `set_source` with on true.",)
    (hob,) = session.explain("left").felt
    assert hob.is_too_weak


@pytest.mark.parametrize("wrong", [{"mute": "yes"}, {"on": 1, "gain_db": -6.0}, {"gain_db": 500.0, "mute": True}])
def test_a_call_that_fails_changes_nothing(wrong: dict[str, object]) -> None:
    session = humming_hob()
    before = session.source("pan")
    with pytest.raises(SessionError):
        session.set_source("pan", **{"gain_db": -6.0, **wrong})  # type: ignore[arg-type]  # wrong on purpose
    assert session.source("pan") == before
    with pytest.raises(SessionError):
        session.set_user(gain_db=-6.0, mute="yes")  # type: ignore[arg-type]  # wrong on purpose
    assert session.update(touches=ON_PAN).gain("left", "pan") == 1.0


def test_an_unknown_state_is_refused_with_the_switch() -> None:
    """None of the states that the message names switches a source off."""
    with pytest.raises(SessionError, match="no state 'off'; it has .* `on` switches it on and off"):
        humming_hob().set_source("hob", state="off")
    with pytest.raises(SessionError, match=r"no state 'zorgon'; it has '[^`]*'\.$"):
        humming_hob().set_source("hob", state="zorgon")
