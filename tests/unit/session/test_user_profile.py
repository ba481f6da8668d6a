"""Levels and limits of a user profile; expected values are computed by hand from decibels."""

from __future__ import annotations

import json
import re
import threading
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, strategies as st

from scene2hap import ActuatorProfile, HapticBundle, HapticSession, MemorySink, SceneWarning, Touch, UserProfile
from scene2hap.errors import ConfigError
from scenes import table_with_two_phones

DOCS = Path(__file__).parents[3] / "docs" / "profiles.md"


@pytest.fixture
def bundle() -> HapticBundle:
    return table_with_two_phones()[1]


def touches(bundle: HapticBundle, *hands: str) -> list[Touch]:
    source = next(iter(bundle.loops))
    return [Touch(hand, source, bundle.snapshot.object(source).pose.position_m) for hand in hands]


def gains(bundle: HapticBundle, user: object, config: object = None) -> np.ndarray:
    session = HapticSession(bundle, config=config, user=user)
    return session.update(touches=touches(bundle, "left", "right")).gains


def db(value: float) -> float:
    return 10 ** (value / 20)


def test_levels_of_person_hand_and_device_add_up(bundle: HapticBundle) -> None:
    user = {"gain_db": -3.0, "hands": {"left": {"gain_db": 2.0}}, "devices": {"mine": {"gain_db": -5.0}}}
    config = {"actuator": ActuatorProfile("mine")}
    plain, ours = gains(bundle, None, config), gains(bundle, user, config)
    assert ours[0] == pytest.approx(plain[0] * db(-6.0), rel=1e-5)
    assert ours[1] == pytest.approx(plain[1] * db(-8.0), rel=1e-5)
    assert gains(bundle, user)[1] == pytest.approx(plain[1] * db(-3.0), rel=1e-5)  # on another device


def test_profile_curve_is_read_at_the_felt_frequency(bundle: HapticBundle) -> None:
    source = next(iter(bundle.loops))
    loop = next(iter(bundle.loops[source].values()))
    felt_hz = loop.frequency_tactile_hz
    curve = [(felt_hz / 2, -12.0), (felt_hz * 2, 0.0)]  # half way on a logarithmic axis: -6 dB
    plain, ours = gains(bundle, None), gains(bundle, {"curve_db": curve})
    assert ours[:, 0] == pytest.approx(plain[:, 0] * db(-6.0), rel=1e-5)


def test_curves_of_person_hand_and_device_add_up(bundle: HapticBundle) -> None:
    """Each actuator of a rig has a response of its own, which its hand's curve compensates."""
    source = next(iter(bundle.loops))
    felt_hz = next(iter(bundle.loops[source].values())).frequency_tactile_hz
    around = [(felt_hz / 2, -8.0), (felt_hz * 2, 0.0)]  # half way on a logarithmic axis: -4 dB
    user = {
        "curve_db": [(felt_hz, 1.0)],
        "hands": {"left": {"gain_db": -3.0, "curve_db": around}},
        "devices": {"mine": {"curve_db": [(20.0, -2.0)]}},
    }
    config = {"actuator": ActuatorProfile("mine")}
    plain, ours = gains(bundle, None, config), gains(bundle, user, config)
    assert ours[0, 0] == pytest.approx(plain[0, 0] * db(-4.0 - 3.0 + 1.0 - 2.0), rel=1e-5)
    assert ours[1, 0] == pytest.approx(plain[1, 0] * db(1.0 - 2.0), rel=1e-5)


def test_a_profile_of_one_hands_curve_alone_is_applied(bundle: HapticBundle) -> None:
    user = {"hands": {"right": {"curve_db": [(100.0, -6.0)]}}}
    plain, ours = gains(bundle, None), gains(bundle, user)
    np.testing.assert_array_equal(ours[0], plain[0])
    assert ours[1] == pytest.approx(plain[1] * db(-6.0), rel=1e-5)


def test_the_curve_acts_band_by_band(bundle: HapticBundle) -> None:
    config = {"bands": [50.0, 200.0, 800.0]}
    source = next(iter(bundle.loops))
    loop = next(iter(bundle.loops[source].values()))
    own = loop.frequency_tactile_hz
    plain = gains(bundle, None, config)
    ours = gains(bundle, {"curve_db": [(50.0, 0.0), (800.0, -40.0)]}, config)
    middles = [own if low <= own < high else (low * high) ** 0.5 for low, high in ((50, 200), (200, 800))]
    expected = [db(-40.0 * np.log(f / 50) / np.log(16)) for f in middles]
    assert (ours[:, 0] / plain[:, 0])[0] == pytest.approx(expected, rel=1e-4)


def test_sources_amplified_by_a_profile_are_mixed(bundle: HapticBundle) -> None:
    """A source below the threshold is not mixed; with a profile of +40 dB it is, even if for one hand of two."""
    source, other = bundle.loops
    bundle = bundle.override(other, muted=True)
    faint = bundle.override(source, gain_db=-60.0)

    def peak(user: object) -> float:
        session = HapticSession(faint, user=user)
        for _ in range(3):
            session.update(touches=touches(bundle, "left"))
            mix = session.render(9600)
        return float(np.abs(mix[:, 0]).max())

    assert peak(None) == 0.0
    loud = HapticSession(bundle.override(source, gain_db=-20.0), hands=("left",))
    for _ in range(3):
        loud.update(touches=touches(bundle, "left"))
        expected = float(np.abs(loud.render(9600)).max())
    assert peak({"gain_db": 40.0}) == pytest.approx(expected, rel=1e-3)
    assert peak({"hands": {"left": {"gain_db": 40.0}}}) == pytest.approx(expected, rel=1e-3)


@given(
    limit=st.floats(0.01, 1.0),
    left=st.floats(0.01, 1.0),
    gain=st.floats(-10, 40),
    n_frames=st.integers(1, 3000),
)
def test_no_sample_exceeds_the_smallest_limit(limit: float, left: float, gain: float, n_frames: int) -> None:
    bundle = table_with_two_phones()[1]
    user = {"max_amplitude": limit, "gain_db": gain, "hands": {"left": {"max_amplitude": left}}}
    sink = MemorySink()
    with HapticSession(bundle, sink=sink, user=user) as session:
        session.update(touches=touches(bundle, "left", "right"))
        for _ in range(3):
            sink.pull(n_frames)
    alone = HapticSession(bundle, user=user)
    alone.update(touches=touches(bundle, "left", "right"))
    for mix in (sink.samples, alone.render(6000)):
        peaks = np.abs(mix).max(axis=0)
        assert peaks[0] <= min(limit, left) * (1 + 1e-6)
        assert peaks[1] <= limit * (1 + 1e-6)


def test_profile_change_causes_no_click(bundle: HapticBundle) -> None:
    sink = MemorySink()
    with HapticSession(bundle, sink=sink, hands=("left",)) as session:
        for k in range(60):
            if k in (20, 40):
                session.set_user(profile={"gain_db": 20.0, "max_amplitude": 0.05} if k == 20 else UserProfile())
            session.update(touches=touches(bundle, "left"))
            sink.pull_s(0.02)
    high = np.abs(np.fft.rfft(sink.samples[:, 0] * np.hanning(len(sink.samples))))
    frequency = np.fft.rfftfreq(len(sink.samples), 1 / 48000)
    assert high[frequency > 3000].max() < 1e-3 * high.max()


def test_explanation_includes_the_profile_level(bundle: HapticBundle) -> None:
    session = HapticSession(bundle, user={"hands": {"left": {"gain_db": -7.0}}})
    session.update(touches=touches(bundle, "left", "right"))
    assert session.explain("left").felt[0].level_db == pytest.approx(-7.0, abs=1e-4)
    assert session.explain("right").felt[0].level_db == pytest.approx(0.0, abs=1e-4)


def test_profile_round_trips_through_a_file(tmp_path: Path) -> None:
    user = UserProfile(
        gain_db=-3, curve_db=[(60, 1.0), (100, 0)], hands={"left": {"gain_db": 2}}, devices={"lra": {"gain_db": 6}}
    )
    user.save(tmp_path / "ada.json")
    assert UserProfile.parse(tmp_path / "ada.json") == user
    assert "max_amplitude" not in (tmp_path / "ada.json").read_text(encoding="utf-8")
    (tmp_path / "ada.toml").write_text("[user]\ngain_db = -3.0\n[user.hands.left]\ngain_db = 1.0\n", encoding="utf-8")
    assert UserProfile.parse(str(tmp_path / "ada.toml")).hands["left"].gain_db == 1.0
    with pytest.raises(ConfigError, match="ends in .json"):
        user.save(tmp_path / "ada.toml")
    with pytest.raises(ConfigError, match="cannot be written"):
        user.save(tmp_path / "no" / "ada.json")


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({"gain_db": 50}, "40"),
        ({"max_amplitude": 0.0}, "0.0001"),
        ({"max_amplitude": 1.5}, "1"),
        ({"curve_db": [(100, 0), (60, 0)]}, "rise"),
        ({"curve_db": [(0, 0)]}, "Hz"),
        ({"curve_db": [(100, float("nan"))]}, "dB"),
        ({"hand": {}}, "hands"),
        ({"hands": {"left": {"gain": 3}}}, "gain"),
        ({"hands": {"left": {"curve_db": [(100, 0), (60, 0)]}}}, "rise"),
        (3, "mapping"),
    ],
)
def test_invalid_profile_is_refused(bundle: HapticBundle, wrong: object, says: str) -> None:
    with pytest.raises(ConfigError, match=re.escape(says)):
        HapticSession(bundle, user=wrong)
    session = HapticSession(bundle)
    with pytest.raises(ConfigError):
        session.set_user(gain_db=-3.0, profile=wrong)
    assert session._sources.user.factor == 1.0  # a refused call changes nothing


def test_profile_for_other_hands_is_refused(bundle: HapticBundle) -> None:
    with pytest.warns(SceneWarning, match="'lefft'; this session has 'left', 'right'"):
        HapticSession(bundle, user={"hands": {"lefft": {"gain_db": 3.0}}})


def test_added_hands_get_their_profile_levels(bundle: HapticBundle) -> None:
    session = HapticSession(bundle, hands=("left",), user={"hands": {"left": {}, "foot": {"gain_db": -9.0}}})
    session.add_hand("foot")
    both = session.update(touches=touches(bundle, "left", "foot")).gains
    assert both[1] == pytest.approx(both[0] * db(-9.0), rel=1e-5)
    session.remove_hand("left")
    assert session.update(touches=touches(bundle, "foot")).gains[0] == pytest.approx(both[1], rel=1e-5)
    session.render(100)


def test_code_of_the_profile_page_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, bundle: HapticBundle) -> None:
    monkeypatch.chdir(tmp_path)
    bundle.save(tmp_path / "scene2hap-demo" / "bundle")
    code = "".join(re.findall(r"```python\n(.*?)```", DOCS.read_text(encoding="utf-8"), re.DOTALL))
    exec(compile(code, str(DOCS), "exec"), {})
    assert json.loads((tmp_path / "ada.json").read_text(encoding="utf-8"))["user"]["gain_db"] == -3.0


def test_a_hand_that_comes_leaves_the_limiter_of_the_others_alone() -> None:
    session, blocks = HapticSession(*table_with_two_phones(), user={"max_amplitude": 0.05}), []
    session.wait_prepared()
    for k in range(60):
        session.update(touches=[Touch("left", "phone", (0.1, 0.73, 0.4))])
        if k == 30:
            session.add_hand("third")
        if k == 45:
            session.remove_hand("right")
        blocks.append(session.render(480)[:, 0])
    bends = np.abs(np.diff(np.concatenate(blocks), 2))
    assert bends[9600:].max() < 2 * bends[9600:14000].max()


def test_limits_hold_while_hands_come_and_go_on_another_thread() -> None:
    """A block may be rendered at any moment, such as when there is a new hand that has no limit yet."""
    session, failed = HapticSession(*table_with_two_phones(), user={"max_amplitude": 0.05}), []
    session.wait_prepared()
    is_over = threading.Event()

    def play() -> None:
        while not is_over.is_set():
            try:
                assert np.abs(session.render(64)).max() <= 0.0501
            except Exception as error:
                failed.append(error)

    thread = threading.Thread(target=play)
    thread.start()
    for _ in range(40):
        session.update(touches=[Touch("left", "phone", (0.1, 0.73, 0.4))])
        session.add_hand("third")
        session.remove_hand("third")
    is_over.set()
    thread.join()
    assert not failed


def test_a_file_without_the_table_of_a_profile_is_refused(tmp_path: Path) -> None:
    (tmp_path / "game.toml").write_text("[session]\n")
    with pytest.raises(ConfigError, match="there is no table 'user'"):
        UserProfile.parse(tmp_path / "game.toml")


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"curve_db": {100: 3.0}}, r"curve_db: it must be a list, got \{100: 3\.0\}\."),
        ({"curve_db": [(100, 3.0, 1.0)]}, r"curve_db\.0: it must have at most 2 items, got \[100, 3\.0, 1\.0\]\."),
        ({"gain_db": 41}, r"gain_db: it must be at most 40.*, got 41\."),
        ({"gain_db": "loud"}, r"gain_db: it must be a number.*, got 'loud'\."),
    ],
)
def test_errors_of_a_hand_name_its_setting_and_the_value_once(fields: dict[str, Any], words: str) -> None:
    with pytest.raises(ConfigError, match=f"^user setting {words}$"):
        UserProfile(**fields)
    with pytest.raises(ConfigError, match=f"^user setting hands.left.{words}$"):
        UserProfile(hands={"left": fields})
