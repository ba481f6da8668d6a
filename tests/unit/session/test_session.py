"""A session on a table with two phones."""

import asyncio
import copy
import math
import os
import pickle
import subprocess
import sys
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
import soundfile

from scene2hap import (
    Bands,
    FullPropagation,
    HapticSession,
    MemorySink,
    NoPropagation,
    Pose,
    Touch,
    WavSink,
    materials,
)
from scene2hap.devices.protocol import Fill
from scene2hap.errors import ConfigError, DeviceError, ModelDomainError, SessionError, UnknownObject
from scene2hap.render.safety import SafetyLayer
from scenes import RATE, box, table_with_two_phones, tone_loop

CONFIG = {"sample_rate_hz": RATE}
ON_TABLE = Touch("left", "table", (0.8, 0.72, 0.4))


def session(**config: object) -> HapticSession:
    return HapticSession(*table_with_two_phones(), {**CONFIG, **config})


def gamma(distance_m: float, frequency_hz: float) -> float:
    """The paper's law on the table top, written out."""
    oak = materials.lookup("oak")
    D = oak.youngs_modulus_pa * 0.02**3 / (12 * (1 - oak.poisson_ratio**2))
    k = (oak.density_kg_m3 * 0.02 * (2 * math.pi * frequency_hz) ** 2 / D) ** 0.25
    return math.exp(-k * distance_m)


def test_gain_on_the_source_is_1_and_hands_are_independent() -> None:
    frame = session().update(touches=[Touch("right", "phone", (0.1, 0.73, 0.4))])
    assert frame.gain("right", "phone") == 1.0
    assert frame.gain("left", "phone") == 0.0
    assert frame.gains.shape == (2, 2, 1)
    assert frame.gains.dtype == np.float32


def test_gain_on_the_table_depends_on_distance_to_the_nearest_contact() -> None:
    frame = session().update(touches=[ON_TABLE])
    # The phones' edges are at x = 0.15 and x = 1.45; the nearest contact points are corners of their footprints.
    corner = math.hypot(0.65, 0.05)
    assert frame.gain("left", "phone") == pytest.approx(gamma(corner, 100), rel=1e-4)
    assert frame.gain("left", "alarm") == pytest.approx(gamma(corner, 160), rel=1e-4)


def test_an_object_of_unknown_material_carries_nothing() -> None:
    s = session()
    assert s.update(touches=[Touch("left", "block", (0.8, 0.3, 0.2))]).gain("left", "phone") == 0.0
    assert s.stats.bodiless == ("block",)


def test_an_object_that_touches_nothing_feels_nothing() -> None:
    frame = session().update(touches=[Touch("left", "cup", (5.0, 0.1, 5.0))])
    assert not frame.gains.any()


def test_lifting_the_hand_ends_the_vibration() -> None:
    s = session()
    s.update(touches=[ON_TABLE])
    s.render(RATE)
    assert not s.update().gains.any()
    s.render(RATE)
    assert not s.render(RATE).any()


def test_lifting_the_phone_removes_its_gain_and_putting_it_back_restores_it() -> None:
    s = session()
    before = s.update(touches=[ON_TABLE]).gains
    home = s.snapshot.object("phone").pose
    lifted = s.update({"phone": Pose((0.1, 1.2, 0.4))}, [ON_TABLE])
    assert lifted.gain("left", "phone") == 0.0
    assert lifted.gain("left", "alarm") > 0.0
    np.testing.assert_array_equal(s.update({"phone": home}, [ON_TABLE]).gains, before)


def test_several_touches_of_a_hand_give_the_largest_gain_per_source() -> None:
    s = session()
    near_phone, near_alarm = Touch("left", "table", (0.2, 0.72, 0.4)), Touch("left", "table", (1.4, 0.72, 0.4))
    both = s.update(touches=[near_phone, near_alarm]).gains[0]
    apart = [s.update(touches=[touch]).gains[0] for touch in (near_phone, near_alarm)]
    np.testing.assert_array_equal(both, np.maximum(*apart))


def test_two_sources_add_exactly_while_quiet() -> None:
    def mix(*on: str) -> np.ndarray:
        s = session()
        for source in s.source_ids:
            s.set_source(source, on=source in on)
        s.update(touches=[ON_TABLE])
        return s.render(2 * RATE)

    both, phone, alarm = mix("phone", "alarm"), mix("phone"), mix("alarm")
    assert np.abs(phone).max() > 0.001
    assert np.abs(alarm).max() > 0.001
    np.testing.assert_allclose(both, phone + alarm, atol=1e-7)


def test_sources_are_switched_muted_and_set_in_level() -> None:
    s = session()
    touch = [Touch("left", "phone", (0.1, 0.73, 0.4))]
    s.set_source("phone", gain_db=-20.0)
    assert s.update(touches=touch).gain("left", "phone") == pytest.approx(0.1)
    s.set_source("phone", mute=True)
    assert s.update(touches=touch).gain("left", "phone") == 0.0
    s.set_source("phone", mute=False, gain_db=0.0)
    s.set_user(gain_db=-6.0)
    assert s.update(touches=touch).gain("left", "phone") == pytest.approx(10 ** (-0.3))
    s.set_user(gain_db=0.0, mute=True)
    assert s.update(touches=touch).gain("left", "phone") == 0.0
    s.set_user(mute=False)
    s.set_source("phone", on=False)
    assert s.update(touches=touch).gain("left", "phone") == 0.0


def test_another_state_plays_another_loop_without_a_click() -> None:
    s = session()
    touch = [Touch("left", "phone", (0.1, 0.73, 0.4))]
    s.update(touches=touch)
    ringing = s.render(RATE)[-800:, 0]
    s.set_source("phone", state="alarm")
    s.update(touches=touch)
    change = s.render(RATE)[:, 0]
    spectrum = [int(np.argmax(np.abs(np.fft.rfft(x)))) * RATE // 800 for x in (ringing, change[-800:])]
    assert spectrum == [100, 240]
    steepest = 0.3 * 2 * np.pi * 240 / RATE
    assert np.abs(np.diff(np.append(ringing[-1:], change))).max() < 1.5 * steepest


def test_position_follows_the_loop() -> None:
    s = session()
    s.render(RATE * 3 // 4)
    assert s.position_s("phone") == pytest.approx(0.25)
    with pytest.raises(UnknownObject, match="no source 'table'; the sources are 'phone', 'alarm'"):
        s.position_s("table")


def test_a_source_that_needs_contact_is_silent_without_it() -> None:
    from scene2hap import HapticBundle
    from scenes import haptics, tone_loop

    snapshot, bundle = table_with_two_phones()
    objects = {**bundle.objects, "phone": haptics("glass", (0.1, 0.1, 0.01), "boiling", needs_contact="table")}
    pan = HapticBundle(snapshot, "room", objects, {"phone": {"boiling": tone_loop(100)}})
    s = HapticSession(snapshot, pan, CONFIG)
    assert s.update(touches=[Touch("left", "phone", (0.1, 0.73, 0.4))]).gain("left", "phone") == 1.0
    lifted = s.update({"phone": Pose((0.1, 1.2, 0.4))}, [Touch("left", "phone", (0.1, 1.2, 0.4))])
    assert lifted.gain("left", "phone") == 0.0


@pytest.mark.parametrize(
    ("model", "expected"),
    [("no_propagation", [0.0, 1.0]), ({"kind": "full_propagation"}, [1.0, 1.0]), (NoPropagation(), [0.0, 1.0])],
)
def test_the_model_is_one_line_of_configuration(model: object, expected: list[float]) -> None:
    s = session(propagation=model, prepare="blocking")
    found = [
        s.update(touches=[touch]).gain("left", "phone")
        for touch in (ON_TABLE, Touch("left", "phone", (0.1, 0.73, 0.4)))
    ]
    assert found == expected


def test_a_live_model_is_scaled_to_the_law_near_its_source() -> None:
    s = session(propagation="full_propagation", reference="felt_near", prepare="blocking")
    near, far = (s.update(touches=[Touch("left", "table", (x, 0.72, 0.4))]).gain("left", "phone") for x in (0.2, 0.8))
    assert 0.5 < near == far < 0.9  # the law's is 0.76 at 5 cm beside the middle of the phone, 0.42 at 20 cm


@pytest.mark.parametrize("bands", [Bands.third_octaves(), "third-octaves"])
def test_true_bands_give_one_gain_per_band(bands: object) -> None:
    s = session(bands=bands, propagation="exponential_plate")
    frame = s.update(touches=[ON_TABLE])
    assert frame.gains.shape == (2, 2, 20)
    assert (np.diff(frame.gains[0, 0]) < 0).all()


def test_gain_limit_caps_and_counts() -> None:
    class Loud:
        """A plugin model whose gains are a given wrong value."""

        def __init__(self, value: float) -> None:
            self.value = value

        def prepare(self, network: object, excitations: list[object], bands: Bands) -> "Loud":
            self.source_ids = tuple(e.source_id for e in excitations)
            return self

        def attenuation(self, object_id: str, points_m: object) -> np.ndarray:
            return np.full((1, 2, 1), self.value)

    capped = session(prepare="blocking", propagation=Loud(3.0))
    assert capped.update(touches=[ON_TABLE]).gain("left", "phone") == 1.0
    assert capped.stats.gains_capped == 2
    lower = session(prepare="blocking", propagation=Loud(3.0), gain_limit_db=-20.0)
    assert lower.update(touches=[ON_TABLE]).gain("left", "phone") == pytest.approx(0.1)
    assert (
        session(prepare="blocking", propagation=Loud(3.0), gain_limit_db=None)
        .update(touches=[ON_TABLE])
        .gain("left", "phone")
        == 3.0
    )
    for nonsense in (math.nan, math.inf, -1.0):
        s = session(prepare="blocking", propagation=Loud(nonsense), gain_limit_db=None)
        s.update(touches=[ON_TABLE])
        out = s.render(4000)
        assert np.isfinite(out).all()
        assert np.abs(out).max() <= 1.0


def test_nothing_is_prepared_again_at_rest() -> None:
    s = session()
    for x in np.linspace(0.3, 1.3, 20):
        s.update(touches=[Touch("left", "table", (float(x), 0.72, 0.4))])
    assert s.stats.fields_prepared == 1
    assert s.stats.updates == 20


def test_sinks_get_the_mix_through_the_safety_layer() -> None:
    sink = MemorySink()
    with HapticSession(*table_with_two_phones(), CONFIG, sink=sink) as s:
        s.update(touches=[ON_TABLE])
        sink.pull(1000)
    alone = session()
    alone.update(touches=[ON_TABLE])
    safe = SafetyLayer(s.config.actuator, RATE, 2).process(alone.render(1000))
    np.testing.assert_array_equal(sink.samples[:1000], safe)
    assert np.abs(safe).max() > 0.001


def test_a_run_that_fails_leaves_no_wav(tmp_path: object) -> None:
    sink = WavSink(f"{tmp_path}/out.wav")
    with pytest.raises(UnknownObject), HapticSession(*table_with_two_phones(), CONFIG, sink=sink) as s:
        sink.pull(10)
        s.update(touches=[Touch("left", "tabel", (0, 0, 0))])
    assert not sink.path.exists()


@pytest.mark.parametrize("end", [KeyboardInterrupt, SystemExit, asyncio.CancelledError, GeneratorExit])
def test_a_game_that_is_ended_from_outside_leaves_its_wav(end: type[BaseException], tmp_path: Path) -> None:
    sink = WavSink(tmp_path / "out.wav")
    with pytest.raises(end), HapticSession(*table_with_two_phones(), CONFIG, sink=sink):
        sink.pull(10)
        raise end
    assert soundfile.info(sink.path).frames >= 10


@pytest.mark.parametrize("end", ["", "raise KeyboardInterrupt"])
def test_a_program_that_does_not_stop_its_session_leaves_its_wav(end: str, tmp_path: Path) -> None:
    script = f"""from scenes import table_with_two_phones
from scene2hap import HapticSession, WavSink
def play():
    sink = WavSink("out.wav")
    HapticSession(*table_with_two_phones(), sink=sink).start()
    sink.pull(48_000)
play()
{end}"""
    path = {"PYTHONPATH": os.pathsep.join(sys.path)}
    subprocess.run([sys.executable, "-c", script], cwd=tmp_path, env=os.environ | path, capture_output=True)
    assert [one.name for one in tmp_path.iterdir()] == ["out.wav"]
    samples, _ = soundfile.read(tmp_path / "out.wav")
    assert len(samples) >= 48_000
    np.testing.assert_allclose(samples[-1], 0, atol=1e-6)  # it fades out


class Journal(MemorySink):
    """A sink of somebody else, with the methods of the protocol alone: `close` does not stop it."""

    def __init__(self, refuses: str = "") -> None:
        super().__init__()
        self.calls: list[str] = []
        self._refuses = refuses

    def _note(self, call: str) -> None:
        self.calls.append(call)
        if call == self._refuses:
            raise DeviceError(f"{call} failed")

    def start(self, fill: Fill) -> None:
        super().start(fill)
        self._note("start")

    def stop(self) -> None:
        self._note("stop")

    def close(self) -> None:
        self._note("close")


def test_a_run_that_fails_stops_a_sink_without_abort() -> None:
    sink = Journal()
    with pytest.raises(ZeroDivisionError), HapticSession(*table_with_two_phones(), CONFIG, sink=sink):
        _ = 1 / 0
    assert sink.calls == ["start", "stop", "close"]


def test_a_sink_that_does_not_start_is_closed() -> None:
    sink = Journal(refuses="start")
    with pytest.raises(DeviceError, match="start failed"):
        HapticSession(*table_with_two_phones(), CONFIG, sink=sink).start()
    assert sink.calls == ["start", "stop", "close"]


def test_a_sink_that_does_not_stop_is_closed() -> None:
    sink = Journal(refuses="stop")
    with pytest.raises(DeviceError, match="stop failed"), HapticSession(*table_with_two_phones(), CONFIG, sink=sink):
        pass
    assert sink.calls == ["start", "stop", "close"]


@pytest.mark.parametrize("bands", ["dominant", "third-octaves"])
def test_complex_gains_of_a_model_are_refused(bands: str) -> None:
    """The real part of a transfer function is 0 at a resonance, where the vibration is strongest."""

    class Transfer:
        def prepare(self, network: Any, excitations: Any, bands: Any) -> Any:
            field = FullPropagation().prepare(network, excitations, bands)
            return Phasors(field.source_ids, lambda *query: 1j * field.attenuation(*query))

    class Phasors(NamedTuple):
        source_ids: tuple[str, ...]
        attenuation: Any

    s = session(propagation=Transfer(), prepare="blocking", bands=bands)
    with pytest.raises(ModelDomainError, match=r"complex numbers; a gain is their magnitude, np.abs\(h\)"):
        s.update(touches=[ON_TABLE])


@pytest.mark.parametrize("model", ["exponential_plate", "infinite_plate", "full_propagation"])
def test_gains_of_a_frame_cannot_be_changed(model: str) -> None:
    """An update without a change returns the last frame, so a change would come back as a gain of the session."""
    s = session(propagation=model, prepare="blocking")
    for touches in ([ON_TABLE], []):
        gains = s.update(touches=touches).gains
        kept = gains.copy()
        with pytest.raises(ValueError, match="read-only"):
            gains *= 100
        np.testing.assert_array_equal(s.update(touches=touches).gains, kept)


def test_touch_on_an_unknown_object_names_the_nearest() -> None:
    with pytest.raises(UnknownObject, match=r"no object 'tabel'. Did you mean 'table'"):
        session().update(touches=[Touch("left", "tabel", (0, 0, 0))])


def test_moving_an_unknown_object() -> None:
    with pytest.raises(UnknownObject, match="no object 'sofa'"):
        session().update({"sofa": Pose()})


def test_unknown_hand() -> None:
    with pytest.raises(SessionError, match=r"no hand 'middle'; this session has 'left', 'right'\. Name .*add_hand"):
        session().update(touches=[Touch("middle", "table", (0, 0, 0))])


def test_time_cannot_go_back() -> None:
    s = session()
    s.update(at_sample=480)
    s.update(at_sample=480)
    with pytest.raises(SessionError, match="at_sample is 479; the last update was at 480"):
        s.update(at_sample=479)


@pytest.mark.parametrize("is_pause", [False, True])
def test_what_has_no_stamp_waits_for_an_update_that_is_stamped_ahead(is_pause: bool) -> None:
    s, touch = session(), [Touch("left", "phone", (0.1, 0.73, 0.4))]
    s.update(touches=touch)
    s.render(4800)
    s.update(touches=touch, at_sample=24_000)
    if is_pause:
        s.pause()
    else:
        s.update()
    heard = s.render(43_200)[:, 0]  # from 4800 on
    assert np.abs(heard[14_400:19_200]).max() > 0.01
    assert np.abs(heard[24_000:]).max() == 0.0


def test_a_touch_point_must_be_finite() -> None:
    with pytest.raises(SessionError, match=r"point_m\[1\] is nan m"):
        Touch("left", "table", (0.0, math.nan, 0.0))


def test_a_state_may_have_an_empty_name() -> None:
    s = session()
    s.add(box("fan", (0.1, 0.1, 0.1), (0.8, 0.77, 0.4)), None, {"on": tone_loop(100), "": tone_loop(170)})
    s.set_source("fan", state="")
    assert (s.source("fan").state, s.source("fan").frequency_hz) == ("", 170)


def test_unknown_state_and_gain_out_of_bounds() -> None:
    s = session()
    with pytest.raises(SessionError, match="no state 'purring'; it has 'ringing', 'alarm'"):
        s.set_source("phone", state="purring")
    with pytest.raises(SessionError, match="gain_db is 200 dB; it must be at most"):
        s.set_source("phone", gain_db=200.0)


@pytest.mark.parametrize(
    ("config", "sentence"),
    [
        ({"sample_rate": 8000}, "sample_rate"),
        ({"sample_rate_hz": 10}, "sample_rate_hz"),
        ({"propagation": "telepathy"}, "no kind 'telepathy'"),
        ({"propagation": {"kind": "exponential_plate", "max_hops": 0}}, "max_hops is 0"),
    ],
)
def test_invalid_settings_are_refused(config: dict[str, object], sentence: str) -> None:
    with pytest.raises(ConfigError, match=sentence):
        HapticSession(*table_with_two_phones(), config)


def test_duplicate_hand_names_are_refused() -> None:
    with pytest.raises(ConfigError, match="hands is"):
        HapticSession(*table_with_two_phones(), hands=("left", "left"))


class Unplugged(MemorySink):
    """A sink that raises when it is stopped."""

    is_closed = False

    def stop(self) -> None:
        raise DeviceError("it was unplugged")

    def close(self) -> None:
        self.is_closed = True


def test_sink_that_raises_at_its_stop_is_closed() -> None:
    scene, bundle = table_with_two_phones()
    sink = Unplugged()
    with pytest.raises(DeviceError, match="unplugged"), HapticSession(scene, bundle, sink=sink):
        pass
    assert sink.is_closed


def test_start_without_a_sink() -> None:
    with pytest.raises(SessionError, match="no sink"):
        session().start()


@pytest.mark.parametrize("hands", ["left", "", (), ("left", "left"), ("left", ""), ("left", 1), 3, None])
def test_hands_given_as_one_string_are_refused(hands: Any) -> None:
    with pytest.raises(ConfigError, match="hands is"):
        HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE}, hands=hands)
    with pytest.raises(ConfigError, match=r"as \['left'\]"):
        HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE}, hands="left")
    assert HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE}, hands=["left"]).hands == ("left",)


@pytest.mark.parametrize("touches", ["left", [("left", "table")], 3])
def test_touches_of_other_types_are_refused(touches: Any) -> None:
    session = HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE})
    with pytest.raises(SessionError, match="must be a list of Touch"):
        session.update(touches=touches)
    assert session.stats.updates == 0


@pytest.mark.parametrize("model", ["exponential_plate", "no_propagation"])
@pytest.mark.parametrize("copied", [copy.deepcopy, lambda frame: pickle.loads(pickle.dumps(frame))])
def test_a_frame_that_is_copied_or_pickled_has_its_gains(copied: Any, model: str) -> None:
    s = HapticSession(*table_with_two_phones(), {"propagation": model})
    kept = copied(s.update(touches=[ON_TABLE]))
    gains = kept.gains.copy()
    s.update(touches=[Touch("left", "phone", (0.12, 0.73, 0.4))])  # the copy needs its session no more
    same = HapticSession(*table_with_two_phones(), {"propagation": model}).update(touches=[ON_TABLE])
    np.testing.assert_array_equal(gains, same.gains)
    assert (kept.hands, kept.sources) == (same.hands, same.sources)
    assert kept.gain("left", "phone") == same.gain("left", "phone")
    with pytest.raises(ValueError, match="read-only"):
        kept.gains[:] = 0
