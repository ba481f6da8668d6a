"""Impacts in a session: which hands feel them, how strongly and when, and their limits."""

from __future__ import annotations

import math
from dataclasses import replace
from threading import Event, Thread
from typing import Any

import numpy as np
import pytest

from scene2hap import (
    ActuatorProfile,
    AutoFidelity,
    Box,
    ExponentialPlate,
    HapticSession,
    InfinitePlate,
    MassSpringDamper,
    ModalPlate,
    Pose,
    SceneObject,
    SceneSnapshot,
    SceneWarning,
    Touch,
    UserProfile,
    bake,
)
from scene2hap.audio.actuators import response_db
from scene2hap.audio.threshold import threshold_db
from scene2hap.errors import SessionError, UnknownObject
from scene2hap.propagation.coupled import impact_solution
from scene2hap.propagation.coupled.hand import PALM
from scene2hap.propagation.impact import Burst, burst_of
from scene2hap.propagation.plate import Plate
from scene2hap.render.bursts import wave_of
from scene2hap.session.deadline import Deadline
from scene2hap.session.impacts import felt_impacts
from scene2hap.session.impacts.felt_impacts import LEAST_INTERVAL_S, MOST_PLAYING, PEAK, Impact, struck_later
from scene2hap.session.impacts.gains import Floats
from scenes import table_with_two_phones

RATE = 48_000
TOP_M = 0.72
NEAR, FAR = (0.5, TOP_M, 0.4), (1.0, TOP_M, 0.4)
STRUCK = (0.4, TOP_M, 0.4)


PHYSICAL = (ModalPlate(), InfinitePlate(), MassSpringDamper(), AutoFidelity(), ModalPlate(hand=PALM))


def session(**settings: Any) -> HapticSession:
    scene, bundle = table_with_two_phones()
    made = HapticSession(scene, bundle, settings)
    made.update()
    made.wait_prepared()
    # These tests are about impacts, so sources are off.
    for source_id in made.source_ids:
        made.set_source(source_id, on=False)
    return made


def touches(near: tuple[float, float, float] = NEAR, far: tuple[float, float, float] = FAR) -> list[Touch]:
    return [Touch("left", "table", near), Touch("right", "table", far)]


def rendered(made: HapticSession, seconds: float = 0.6) -> np.ndarray:
    return np.concatenate([made.render(480) for _ in range(round(seconds * RATE / 480))])


def amplitudes(samples: np.ndarray, burst: Any) -> np.ndarray:
    """Amplitudes of a burst's decaying sines in some samples, by least squares (n_hands, n)."""
    waves = [wave_of(f, t, RATE) for f, t in zip(burst.frequencies_hz.tolist(), burst.decays_s.tolist(), strict=True)]
    columns = np.zeros((len(samples), len(waves)))
    for k, wave in enumerate(waves):
        columns[: len(wave), k] = wave[: len(samples)]
    return np.linalg.lstsq(columns, samples.astype(float), rcond=None)[0].T


def burst_at(made: HapticSession, point_m: tuple[float, float, float]) -> Any:
    state = made._state
    return burst_of(
        state.bodies["table"], state.on_plate("table", point_m), state.bodies["cup"], speed_m_s=1.0, is_finger=False
    )


def test_impact_gain_falls_with_distance_by_the_papers_law() -> None:
    made = session(propagation=ExponentialPlate())
    made.update(touches=touches())
    made.strike("table", STRUCK, with_object="cup", speed_m_s=1.0)
    burst = burst_at(made, STRUCK)
    found = amplitudes(rendered(made), burst)
    plate = made._state.bodies["table"]
    assert isinstance(plate, Plate)
    expected_db = -20 / math.log(10) * plate.wavenumber_rad_m(burst.frequencies_hz) * 0.5
    np.testing.assert_allclose(20 * np.log10(found[1] / found[0]), expected_db, atol=0.2)


@pytest.mark.parametrize("model", PHYSICAL[:4], ids=lambda one: one.kind)
def test_impact_gain_follows_the_physical_model(model: Any) -> None:
    reference = ModalPlate() if isinstance(model, AutoFidelity) else model
    scene, bundle = table_with_two_phones()
    alone = HapticSession(scene, bundle, {"propagation": model, "prepare": "blocking"})
    # On a table without contacts, the gain is the model's response of a single plate.
    away = {x: Pose((10.0 + i, 10.0, 10.0)) for i, x in enumerate(("phone", "alarm", "block"))}
    alone.update(away, touches())
    burst, hands = burst_at(alone, STRUCK), [[("table", NEAR)], [("table", FAR)]]
    gains = struck_later(model, alone._state, "table", STRUCK, hands, burst.frequencies_hz)()
    plate = alone._state.bodies["table"]
    assert isinstance(plate, Plate)
    at, near, far = (np.array(alone._state.on_plate("table", point)) for point in (STRUCK, NEAR, FAR))
    for k, f in enumerate(burst.frequencies_hz):
        band = np.linspace(f * 2**-0.25, f * 2**0.25, 400)
        # The acceleration for a force that is equal at all frequencies of the band.
        itself, *others = (
            np.sqrt((np.abs(reference.plate_receptance(plate, at, [to], band) * band**2) ** 2).mean())
            for to in (at, near, far)
        )
        for found, one in zip(gains[:, k], others, strict=True):
            assert 20 * abs(math.log10(found / (one / itself))) < 1.0


class StillWhereStruck:
    """A guest's model and field: nothing at the struck point, half on the block."""

    def prepare(self, network: object, excitations: Any, bands: object) -> Any:
        self.n = len(excitations)
        return self

    def attenuation(self, object_id: str, points_m: np.ndarray) -> np.ndarray:
        return np.full((len(points_m), self.n, 1), 0.5 if object_id == "block" else 0.0)


def test_impact_without_vibration_at_the_struck_point_is_felt_on_the_struck_object_alone() -> None:
    """Gains are relative to the struck point. Without vibration there is no ratio, but the knock itself is felt."""
    state, f = session()._state, np.array([100.0, 200.0])
    hands = [[("table", NEAR)], [("block", FAR)]]
    gains = struck_later(StillWhereStruck(), state, "table", STRUCK, hands, f)()
    np.testing.assert_array_equal(gains, [[1.0, 1.0], [0.0, 0.0]])


@pytest.mark.parametrize("model", [ModalPlate(), InfinitePlate()])
def test_prepared_touched_object_feels_an_impact_with_the_next_block(
    model: ModalPlate | InfinitePlate,
) -> None:
    scene, bundle = table_with_two_phones()
    made = HapticSession(scene, bundle, {"propagation": model, "gain_limit_db": None})
    for source_id in made.source_ids:
        made.set_source(source_id, on=False)
    away = {x: Pose((10.0 + i, 10.0, 10.0)) for i, x in enumerate(("phone", "alarm", "block"))}
    made.update(away, touches())
    assert made.wait_prepared(30.0)
    impact = made.strike("table", STRUCK, with_object="cup", speed_m_s=1.0)
    assert set(impact.felt) == {"left", "right"}
    burst = burst_at(made, STRUCK)
    found = amplitudes(rendered(made), burst)
    plate = made._state.bodies["table"]
    assert isinstance(plate, Plate)
    at, near, far = (np.array(made._state.on_plate("table", point)) for point in (STRUCK, NEAR, FAR))
    for k, f in enumerate(burst.frequencies_hz):
        band = np.linspace(f * 2**-0.25, f * 2**0.25, 400)
        one, other = (
            np.sqrt((np.abs(model.plate_receptance(plate, at, [to], band) * band**2) ** 2).mean()) for to in (near, far)
        )
        assert 20 * abs(math.log10(found[1, k] / found[0, k] * one / other)) < 1.0


def test_prepared_impact_equals_the_field_of_the_impact_alone() -> None:
    """The scene is a table on a block, with two phones on the table."""
    for model in PHYSICAL:
        scene, bundle = table_with_two_phones()
        made = HapticSession(scene, bundle, {"propagation": model})
        made.update(touches=touches())
        assert made.wait_prepared(60.0)
        assert made._impacts._ahead is not None
        burst, hands = burst_at(made, STRUCK), {"left": [("table", NEAR)], "right": [("table", FAR), ("table", STRUCK)]}
        f = burst.frequencies_hz
        expected = struck_later(model, made._state, "table", STRUCK, [*hands.values()], f)()
        answer = made._impacts._ahead.answer("table", STRUCK, hands, f)
        assert answer is not None
        assert list(answer.among) == ["left", "right"]
        found = answer.gains
        assert np.abs(20 * np.log10(found / expected)).max() < 0.5
        assert (found[1] > 0.999).all()  # this hand touches the struck point


@pytest.mark.filterwarnings("ignore:of 2 objects none vibrates")
def test_a_strike_on_an_upright_board_pushes_along_its_normal_alone() -> None:
    """What strikes a board aside stands on nothing, but the board does not carry its weight."""
    floor = SceneObject("ceramic floor", pose=Pose((0.0, -0.05, 0.0)), geometry=Box((2.0, 0.1, 2.0)))
    board = SceneObject("oak board", pose=Pose((0.0, 0.6, 0.0)), geometry=Box((1.0, 1.2, 0.03)))
    model = ModalPlate()
    made = HapticSession(bake(SceneSnapshot.build([floor, board])), config={"propagation": model})
    struck, hand = (0.2, 0.7, 0.015), [("oak board", (-0.2, 0.4, 0.015))]
    made.update(touches=[Touch("left", *hand[0])])
    assert made.wait_prepared(60.0)
    assert made._impacts._ahead is not None
    f = np.array([60.0, 120.0, 240.0])
    expected = struck_later(model, made._state, "oak board", struck, [hand], f)()
    answer = made._impacts._ahead.answer("oak board", struck, {"left": hand}, f)
    assert answer is not None
    assert np.abs(20 * np.log10(answer.gains / expected)).max() < 0.5


def test_last_prepared_impact_is_used_until_a_new_one_is_ready() -> None:
    made = session(propagation="modal_plate")
    made.update(touches=touches())
    assert made.wait_prepared(30.0)
    made.update({"cup": Pose((0.6, TOP_M + 0.05, 0.4))}, touches())
    first = made.strike("table", STRUCK, with_object="cup", speed_m_s=1.0)
    assert set(first.felt) == {"left", "right"}
    rendered(made, 1.0)
    assert made.wait_prepared(30.0)
    second = made.strike("table", STRUCK, with_object="cup", speed_m_s=1.0)
    assert set(second.felt) == {"left", "right"}
    assert second.felt != first.felt


@pytest.mark.parametrize("model", PHYSICAL, ids=lambda one: f"{one.kind} {'under a hand' if one.hand else ''}")
@pytest.mark.parametrize(
    ("touched", "struck"), [("cup", "table"), ("phone", "table"), ("phone", "cup"), ("table", "cup")]
)
def test_a_hand_on_another_object_feels_an_impact_with_the_next_block_as_the_model_says(
    model: Any, touched: str, struck: str
) -> None:
    """The scene is a table with a phone and a cup, which has the mass of a box."""
    scene, bundle = table_with_two_phones()
    made = HapticSession(scene, bundle, {"propagation": model, "gain_limit_db": None}, hands=("hand",))
    for source_id in made.source_ids:
        made.set_source(source_id, on=False)
    places = {"table": STRUCK, "cup": (0.6, TOP_M + 0.05, 0.4), "phone": (0.1, TOP_M + 0.005, 0.4)}
    x, y, z = places[touched]
    hand = (x + 0.02, y, z + 0.01)
    made.update({"cup": Pose(places["cup"])}, [Touch("hand", touched, hand)])
    assert made.wait_prepared(60.0)
    impact = made.strike(struck, places[struck], speed_m_s=3.0)
    assert set(impact.felt) == {"hand"}
    assert made.render(256).any()

    state = made._state
    burst = burst_of(state.bodies[struck], state.on_plate(struck, places[struck]), speed_m_s=3.0, is_finger=True)
    f, weights = burst.frequencies_hz, burst.accelerations_m_s2**2
    own = struck_later(model, state, struck, places[struck], [[(touched, hand)]], f)()
    assert made._impacts._ahead is not None
    answer = made._impacts._ahead.answer(struck, places[struck], {"left": [(touched, hand)]}, f)
    assert answer is not None
    expected, found = (float((weights * gains[0] ** 2).sum()) for gains in (own, answer.gains))
    assert abs(10 * math.log10(found / expected)) < 0.5


def test_hands_on_several_objects_feel_an_impact_at_once_and_it_counts_once() -> None:
    made = session(propagation="modal_plate")
    both = [Touch("left", "table", NEAR), Touch("right", "phone", made._state.poses["phone"].position_m)]
    made.update(touches=both)
    assert made.wait_prepared(30.0)
    impact = made.strike("table", STRUCK, with_object="cup", speed_m_s=2.0)
    assert set(impact.felt) == {"left", "right"}
    assert made.wait_prepared(30.0)
    assert made.stats.impacts_felt == 1
    assert made.impacts == (impact,)


def test_a_hand_on_two_objects_feels_the_larger_answer() -> None:
    made = session(propagation="modal_plate")
    phone = made._state.poses["phone"].position_m
    made.update(touches=[Touch("left", "table", FAR), Touch("left", "phone", phone)])
    assert made.wait_prepared(30.0)
    ahead, f = made._impacts._ahead, np.array([60.0, 150.0])
    assert ahead is not None
    answers = [
        ahead.answer("table", STRUCK, {"left": hand}, f)
        for hand in ([("table", FAR)], [("phone", phone)], [("table", FAR), ("phone", phone)])
    ]
    one, other, both = (answer.gains[0] for answer in answers if answer is not None)
    np.testing.assert_allclose(both, np.maximum(one, other))


def test_without_memory_for_a_pair_a_worker_prepares_the_impact(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(impact_solution, "MOST_HELD_BYTES", 0)
    made = session(propagation="modal_plate")
    made.update(touches=touches())
    assert made.wait_prepared(30.0)
    impact = made.strike("table", STRUCK, with_object="cup", speed_m_s=2.0)
    assert made.wait_prepared(30.0)
    assert set(impact.felt) == {"left", "right"}


def test_an_object_that_is_touched_next_is_prepared_beside_the_last_ones() -> None:
    made = session(propagation="modal_plate")
    phone = made._state.poses["phone"].position_m
    for touched, point in (("table", NEAR), ("phone", phone), ("cup", made._state.poses["cup"].position_m)):
        made.update(touches=[Touch("left", touched, point)])
        assert made.wait_prepared(30.0)
    made.update(touches=[Touch("left", "phone", phone)])
    assert made._impacts._ahead is not None
    assert made._impacts._ahead.wait(Deadline(0.0))
    assert made.strike("table", STRUCK, with_object="cup", speed_m_s=2.0).felt


@pytest.mark.parametrize("kind", ["exponential_plate", "no_propagation", "full_propagation"])
def test_an_impact_sounds_with_the_next_block_and_ends(kind: str) -> None:
    """Also with the control conditions of the paper, so that no participant tells them apart by their delay."""
    made = session(propagation=kind)
    made.update(touches=touches())
    made.render(256)
    impact = made.strike("table", STRUCK, with_object="cup")
    assert impact.at_sample == 256
    assert made.render(256)[:, 0].any()
    rendered(made, 1.0)
    assert not made.render(480).any()


def test_rendered_peak_of_a_burst_equals_the_reported_level() -> None:
    made, blocks = session(), []
    made.update(touches=touches())
    impact = made.strike("table", STRUCK, with_object="cup", speed_m_s=2.0)
    blocks = rendered(made)
    assert np.abs(blocks[:, 0]).max() == pytest.approx(impact.felt["left"])
    assert np.abs(blocks).max() <= PEAK * 1.001
    power = np.abs(np.fft.rfft(blocks[:, 0], 1 << 17)) ** 2
    above = np.fft.rfftfreq(1 << 17, 1 / RATE) > 1000
    assert 10 * math.log10(power[above].sum() / power.sum()) < -60.0


@pytest.mark.parametrize("actuator", ["flat", "lra"])
def test_harder_strikes_are_felt_more_within_full_scale(actuator: str) -> None:
    felt = []
    for speed in (0.01, 0.1, 10.0, 1e4):
        made = session(actuator=actuator)
        made.update(touches=touches())
        felt.append(made.strike("table", STRUCK, with_object="cup", speed_m_s=speed).felt["left"])
    assert felt[0] < felt[1] < felt[2] <= PEAK
    assert felt[3] == pytest.approx(felt[2], rel=0.01)
    # 2:1 of the acceleration, which grows by the speed and, as the contact gets shorter, by up to speed^0.4 more.
    assert 10.0 <= 20 * math.log10(felt[1] / felt[0]) <= 14.0


@pytest.mark.parametrize("band_hz", [(10.0, 60.0), (40.0, 800.0), (130.0, 230.0), (700.0, 1000.0), (2.0, 20.0)])
@pytest.mark.parametrize("striker", [None, "cup"])
def test_impact_is_felt_in_the_band_of_any_actuator(band_hz: tuple[float, float], striker: str | None) -> None:
    made = session(actuator={"min_frequency_hz": band_hz[0], "max_frequency_hz": band_hz[1]})
    made.update(touches=touches(STRUCK, STRUCK))
    impact = made.strike("table", STRUCK, with_object=striker, speed_m_s=1.0)
    samples = rendered(made)
    assert impact.felt["left"] > 0.02
    assert np.abs(samples).max() == pytest.approx(impact.felt["left"])
    power = np.abs(np.fft.rfft(samples[:, 0], 1 << 17)) ** 2
    strongest_hz = float(np.fft.rfftfreq(1 << 17, 1 / RATE)[power.argmax()])
    # A decay of some cycles has a width in frequency.
    assert 0.8 * band_hz[0] <= strongest_hz <= 1.25 * band_hz[1]


def played(made: HapticSession, burst: Burst) -> tuple[Floats, Floats, Floats]:
    """Frequencies [Hz] at which a session plays a burst, amplitudes there [-], and their sensation levels [dB]."""
    waves, ((*amplitudes,),) = made._impacts._levels(burst, ["left"], None)
    spectra = [np.abs(np.fft.rfft(wave, 1 << 17)) for wave in waves]
    played_hz = np.array([one.argmax() for one in spectra]) * RATE / (1 << 17)
    drive_db, actuator = 20 * np.log10(amplitudes), made._impacts._config.actuator
    return played_hz, np.array(amplitudes), drive_db + response_db(actuator, played_hz) - threshold_db(played_hz)


def burst_of_one(frequency_hz: float) -> Burst:
    return Burst(np.array([frequency_hz]), np.array([0.1]), np.array([200.0]))


@pytest.mark.parametrize("actuator", ["drake_hf", "voice_coil", "lra"])
def test_impact_has_the_level_of_a_flat_actuator_where_the_actuator_reaches_it(actuator: str) -> None:
    resonant, flat = session(actuator=actuator), session()
    for frequency_hz in (40.0, 60.0, 80.0, 120.0, 175.0, 250.0, 400.0):
        burst = burst_of_one(frequency_hz)
        (hz,), (amplitude,), (felt_db,) = played(resonant, burst)
        (own_hz,), (flat_amplitude,), (expected_db,) = played(flat, burst)
        assert own_hz == pytest.approx(frequency_hz, rel=0.02)
        profile = resonant._impacts._config.actuator
        assert 0.98 * profile.min_frequency_hz <= hz <= 1.02 * profile.max_frequency_hz
        # It is weaker only if the drive of an impact of its strength is at its bound.
        assert felt_db <= expected_db + 0.5
        assert felt_db > expected_db - 0.5 or amplitude == pytest.approx(PEAK * math.sqrt(0.2), rel=1e-3)
        assert amplitude <= PEAK * math.sqrt(0.2) * 1.001
        assert felt_db > expected_db - 10.5
        assert flat_amplitude == pytest.approx(PEAK * math.sqrt(0.2))


def test_hard_and_soft_impacts_differ_on_a_resonant_actuator_by_a_jnd_in_frequency() -> None:
    made = session(actuator="lra")
    (soft_hz,), (hard_hz,) = (played(made, burst_of_one(hz))[0] for hz in (70.0, 250.0))
    assert hard_hz > 1.22 * soft_hz


def test_impact_of_modes_too_slow_to_be_felt_is_not_played_faster() -> None:
    made = session(actuator="lra")
    _, ((slow, fast),) = made._impacts._levels(
        Burst(np.array([4.0, 150.0]), np.array([0.1, 0.1]), np.array([50.0, 50.0])), ["left"], None
    )
    assert slow == 0.0 < fast


def test_strike_accepts_a_finger_or_an_impulse() -> None:
    made = session()
    made.update(touches=touches())
    knock = made.strike("table", STRUCK)
    assert knock.speed_m_s == 0.5
    assert knock.frequency_hz < 150
    assert knock.felt["left"] > 0.005
    made.render_s(0.1)
    assert made.strike("table", STRUCK, impulse_n_s=1.0).felt["left"] > knock.felt["left"]


def test_impact_on_an_untouched_object_is_not_felt() -> None:
    made = session()
    made.update()
    assert made.strike("table", STRUCK).felt == {}
    assert not rendered(made, 0.1).any()
    made.update(touches=[Touch("left", "cup", (5.0, 0.05, 5.0))])
    assert made.strike("table", STRUCK).felt == {}
    assert (made.stats.impacts, made.stats.impacts_felt) == (2, 0)


@pytest.mark.parametrize("propagation", ["exponential_plate", "no_propagation", "modal_plate"])
def test_struck_object_of_unknown_material_is_felt_on_itself(propagation: str) -> None:
    made = session(propagation=propagation, prepare="blocking")
    made.update(touches=[Touch("left", "block", (0.8, 0.5, 0.6))])  # of unknown material
    assert made.strike("block", (0.8, 0.5, 0.6)).felt["left"] > 0.005


def _put(made: HapticSession, name: str, size_m: tuple[float, float, float], mass_kg: float | None = None) -> str:
    """Add an object of unknown material, far from everything. Returns its id."""
    with pytest.warns(SceneWarning, match="nothing is known"):
        made.add(SceneObject(name, pose=Pose((9.0, 5.0, 9.0)), geometry=Box(size_m), mass_kg=mass_kg))
    return name


def test_striker_of_unknown_material_strikes_as_hard_as_its_size_or_mass_lets_it() -> None:
    made = session()
    feather = _put(made, "feather", (0.1, 0.005, 0.02))
    crate = _put(made, "crate", (0.5, 0.5, 0.5))
    weight = _put(made, "weight", (0.1, 0.005, 0.02), mass_kg=5.0)
    made.update(touches=touches())
    felt = {}
    for striker in (feather, crate, weight, "cup"):
        felt[striker] = made.strike("table", STRUCK, with_object=striker, speed_m_s=1.0).felt["left"]
    assert felt[feather] < felt["cup"] < felt[crate]
    assert felt[feather] < 0.2 * felt[weight]


def test_struck_object_of_unknown_material_has_its_own_mass() -> None:
    """A finger shakes an empty box more than a safe of the same size."""
    made, felt = session(), {}
    for name, mass_kg in (("box", 0.2), ("safe", 60.0)):
        _put(made, name, (0.3, 0.3, 0.3), mass_kg)
        made.update(touches=[Touch("left", name, (9.0, 5.15, 9.0))])
        felt[name] = made.strike(name, (9.0, 5.15, 9.0)).felt["left"]
    assert felt["safe"] < 0.3 * felt["box"]


def test_landing_of_unknown_material_is_as_a_strike_with_it() -> None:
    made = session()
    feather, crate = _put(made, "feather", (0.1, 0.005, 0.02)), _put(made, "crate", (0.1, 0.1, 0.1), mass_kg=3.0)
    found = {}
    for name, height_m in ((feather, 0.005), (crate, 0.1)):
        for above_m in (0.1, 0.08, 0.06, 0.04, 0.02, 0.0, 0.0, 0.0):
            made.update({name: Pose((0.4, TOP_M + height_m / 2 + above_m, 0.4))}, touches())
            made.render_s(1 / 90)
        found[name] = made.explain("left").impacts[0].felt["left"]
        made.update({name: Pose((9.0, 5.0, 9.0))}, touches())
        made.render_s(1.1)
    assert found[feather] < 0.3 * found[crate]


@pytest.mark.parametrize("settings", [{"prepare": "blocking"}, {"gain_limit_db": None}], ids=["blocking", "ahead"])
def test_neighbours_of_unknown_material_do_not_change_an_impact(settings: dict[str, Any]) -> None:
    felt = []
    for gone in (("phone", "alarm"), ("phone", "alarm", "block")):  # the table stands on the block, or on nothing
        made = session(propagation="modal_plate", **settings)
        for object_id in gone:
            made.remove(object_id)
        made.update(touches=touches())
        made.wait_prepared()
        felt.append(made.strike("table", STRUCK))
        made.wait_prepared()
    on_block, alone = (impact.felt for impact in felt)
    assert on_block == pytest.approx(alone, rel=1e-6)
    assert on_block["left"] != on_block["right"]


def test_worker_prepares_impacts_for_models_without_a_live_field() -> None:
    made = session(propagation="modal_plate")
    made.update(touches=touches())
    impact = made.strike("table", STRUCK, with_object="cup", speed_m_s=1.0)
    assert made.wait_prepared(30.0)
    assert set(impact.felt) == {"left", "right"}
    assert rendered(made, 0.1).any()


@pytest.mark.parametrize("lasts_s", [0.0, 0.5])
def test_an_impact_after_a_pause_is_felt_though_others_were_before_it(lasts_s: float) -> None:
    made = session()
    made.update(touches=touches())
    made.strike("table", STRUCK)
    rendered(made)
    made.pause()
    made.render(round(lasts_s * RATE))
    made.resume()
    made.update(touches=touches())
    impact = made.strike("table", STRUCK, with_object="phone")
    assert np.abs(rendered(made)).max() >= 0.99 * impact.felt["left"]


def test_pause_and_mute_silence_impacts() -> None:
    made = session()
    made.update(touches=touches())
    made.strike("table", STRUCK, speed_m_s=3.0)
    made.pause()
    made.render_s(0.3)
    assert made.strike("table", STRUCK).felt == {}
    made.resume()
    made.update(touches=touches())
    assert not made.render_s(0.1).any()
    made.set_user(mute=True)
    made.update(touches=touches())
    assert made.strike("table", STRUCK).felt == {}


def test_levels_of_the_user_hold_for_impacts() -> None:
    made = session()
    made.update(touches=touches(NEAR, NEAR))
    plain = made.strike("table", STRUCK).felt["left"]
    made.render_s(0.5)
    made.set_user(profile=UserProfile(gain_db=-6.0, hands={"right": {"gain_db": -6.0}}))
    made.update(touches=touches(NEAR, NEAR))
    felt = made.strike("table", STRUCK).felt
    assert 20 * math.log10(felt["left"] / plain) == pytest.approx(-6.0)
    assert 20 * math.log10(felt["right"] / plain) == pytest.approx(-12.0)


def test_impacts_in_fast_succession_are_merged() -> None:
    made = session()
    made.update(touches=touches())
    made.strike("table", STRUCK)
    assert made.strike("table", STRUCK).felt == {}
    assert made.strike("table", STRUCK, with_object="cup").felt  # another pair
    for share, is_felt in ((0.9, False), (0.1, True)):
        made.render_s(share * LEAST_INTERVAL_S)
        made.update(touches=touches())
        assert bool(made.strike("table", STRUCK).felt) == is_felt
    stats = made.stats
    assert (stats.impacts, stats.impacts_felt, stats.impacts_left_out) == (3, 3, 0)


@pytest.mark.parametrize("frames_hz", [20, 30, 60, 90])
@pytest.mark.parametrize("pair", [("table", "cup"), ("cup", "table")])
@pytest.mark.parametrize("when", ["before", "after"])
def test_a_strike_of_a_landing_that_the_session_finds_too_is_one_impact(
    when: str, pair: tuple[str, str], frames_hz: int
) -> None:
    made = session()
    struck, striker = pair
    has_landed = False
    for frame in range(frames_hz):
        above_m = max(0.0, 0.4 - 9.81 * (frame / frames_hz) ** 2 / 2)
        lands, has_landed = above_m == 0.0 and not has_landed, above_m == 0.0
        if lands and when == "before":
            made.strike(struck, STRUCK, with_object=striker, speed_m_s=1.0)
        made.update({"cup": Pose((0.45, TOP_M + 0.05 + above_m, 0.4))}, touches())
        if lands and when == "after":
            made.strike(struck, STRUCK, with_object=striker, speed_m_s=1.0)
        made.render_s(1 / frames_hz)
    stats = made.stats
    assert (stats.impacts, stats.impacts_felt, stats.impacts_left_out) == (1, 1, 0)


def test_an_impact_that_nobody_could_feel_is_felt_if_it_is_reported_again_with_a_hand() -> None:
    made = session()
    assert not made.strike("table", STRUCK).felt
    made.update(touches=touches())
    assert made.strike("table", STRUCK).felt
    stats = made.stats
    assert (stats.impacts, stats.impacts_felt, stats.impacts_left_out) == (1, 1, 0)


def test_impacts_are_compensated_for_the_actuators_response() -> None:
    """Where the actuator is 9 dB weaker, the drive is 9 dB stronger relative to the other components."""
    edges_hz, levels_db = (20.0, 120.0, 400.0, 1000.0), (0.0, 0.0, -9.0, -9.0)
    weak_above = ActuatorProfile("weak above", response_db=tuple(zip(edges_hz, levels_db, strict=True)))
    found = []
    for actuator in (ActuatorProfile(), weak_above):
        made = session(actuator=actuator)
        made.update(touches=touches(STRUCK, STRUCK))
        made.strike("table", STRUCK, with_object="cup", speed_m_s=1.0)
        burst = burst_at(made, STRUCK)
        found.append(amplitudes(rendered(made), burst)[0])
    boost_db = -np.interp(np.log(burst.frequencies_hz), np.log(edges_hz), levels_db)
    assert np.ptp(boost_db) > 3.0
    strong = found[0] > 1e-3 * found[0].max()
    raised_db = 20 * np.log10(found[1] / found[0])[strong] - boost_db[strong]
    assert np.ptp(raised_db) < 0.5  # the peak is the same


def held_up(monkeypatch: pytest.MonkeyPatch) -> tuple[HapticSession, Event]:
    """A session of which each impact waits for a worker, which waits for the event."""
    made, go_on = session(propagation=ModalPlate()), Event()

    def later(*given: Any) -> Any:
        prepared = struck_later(*given)
        return lambda: prepared() if go_on.wait(10.0) else None

    made._impacts._ahead = None
    monkeypatch.setattr(felt_impacts, "struck_later", later)
    return made, go_on


def test_impact_that_a_worker_prepares_sounds_before_the_next_update_which_reports_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    made, go_on = held_up(monkeypatch)
    made.update(touches=touches())
    made.wait_prepared()
    impact = made.strike("table", STRUCK)
    ((_, job),) = made._impacts._waiting
    go_on.set()
    job.result(30.0)
    assert rendered(made, 0.2).any(axis=0).all()
    assert not impact.felt  # a game may iterate over it, so only its own thread changes it
    made.update(touches=touches())
    assert set(impact.felt) == {"left", "right"}
    assert made.impacts == (impact,)
    assert made.stats.impacts_felt == 1


def test_impact_that_a_worker_prepares_in_a_pause_is_not_felt(monkeypatch: pytest.MonkeyPatch) -> None:
    made, go_on = held_up(monkeypatch)
    made.update(touches=touches())
    made.wait_prepared()
    impact = made.strike("table", STRUCK)
    made.pause()
    go_on.set()
    made.wait_prepared()
    assert impact.felt == {}
    assert made.impacts == ()
    made.resume()
    assert not rendered(made, 0.2).any()


def test_burst_that_a_worker_starts_as_a_pause_begins_does_not_play_on_after_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    made = session()
    playback, wave = made._playback, wave_of(100.0, 0.5, RATE)
    worker = Thread(target=lambda: playback.start_burst([wave], {playback.outputs["left"]: [0.5]}, 0))
    fade = playback._bursts.fade

    def slow_fade(given: Any) -> None:
        fade(given)
        worker.start()
        worker.join(0.1)

    monkeypatch.setattr(playback._bursts, "fade", slow_fade)
    made.pause()
    worker.join()
    rendered(made, 0.2)
    made.resume()
    assert not rendered(made, 0.2).any()


def test_impact_for_which_a_model_fails_is_counted_as_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    made, _ = held_up(monkeypatch)
    monkeypatch.setattr(felt_impacts, "struck_later", lambda *given: lambda: 1 / 0)
    made.update(touches=touches())
    assert not made.strike("table", STRUCK).felt
    assert made.wait_prepared(30.0)
    assert made.stats.impacts_left_out == 1


@pytest.mark.parametrize("propagation", ["exponential_plate", "modal_plate"])
@pytest.mark.parametrize(
    ("touching", "removed", "added", "channel"),
    [
        ("right", ("left",), (), 1),
        ("right", ("left", "mid"), ("mid", "left"), 0),
        ("mid", ("left",), ("left",), 0),
        ("left", (), ("foot",), 0),
        ("left", ("left",), (), None),
        ("left", ("left",), ("left",), None),
    ],
)
def test_strike_after_hands_have_changed_is_felt_by_the_hand_that_touches(
    touching: str, removed: tuple[str, ...], added: tuple[str, ...], channel: int | None, propagation: str
) -> None:
    scene, bundle = table_with_two_phones()
    made = HapticSession(scene, bundle, {"propagation": propagation}, hands=("left", "mid", "right"))
    for source_id in made.source_ids:
        made.set_source(source_id, on=False)
    made.update(touches=[Touch(touching, "table", NEAR)])
    assert made.wait_prepared(30.0)
    for hand in removed:
        made.remove_hand(hand)
    for hand in added:
        made.add_hand(hand)
    impact = made.strike("table", STRUCK, with_object="cup", speed_m_s=1.0)
    feeling = () if channel is None else (channel,)
    assert [*impact.felt] == [made.hands[i] for i in feeling]
    assert tuple(np.flatnonzero(rendered(made, 0.2).any(axis=0))) == feeling
    for i, hand in enumerate(made.hands):
        assert bool(made.explain(hand).touches) == (i in feeling)


@pytest.mark.parametrize("touching", ["left", "right"])
def test_impact_that_a_worker_prepares_while_a_hand_is_removed_is_felt_by_its_hand(
    touching: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    made, go_on = held_up(monkeypatch)
    made.update(touches=[Touch(touching, "table", NEAR)])
    made.wait_prepared()
    made.strike("table", STRUCK)
    made.remove_hand("left")
    go_on.set()
    made.wait_prepared()
    assert rendered(made, 0.2).any() == (touching == "right")


def test_strike_while_another_thread_changes_the_hands_is_felt_by_its_hand(monkeypatch: pytest.MonkeyPatch) -> None:
    made = session()
    made.update(touches=[Touch("right", "table", NEAR)])
    struck: list[Impact] = []
    for name in ("add_hand", "remove_hand"):
        change = getattr(made._playback, name)

        def changed(*hand: Any, change: Any = change) -> None:
            change(*hand)
            # The mix has the new hands here, and the session still the former ones.
            struck.append(made.strike("table", STRUCK, with_object=(None, "cup")[len(struck)]))

        monkeypatch.setattr(made._playback, name, changed)
    made.add_hand("foot")
    made.remove_hand("left")
    assert [[*impact.felt] for impact in struck] == [["right"], ["right"]]
    mixed = rendered(made, 0.2)
    assert mixed[:, made.hands.index("right")].any()
    assert not mixed[:, made.hands.index("foot")].any()


@pytest.mark.parametrize(("late_s", "is_felt"), [(0.2, True), (0.4, False)])
def test_impact_that_a_worker_prepares_too_late_is_left_out(
    late_s: float, is_felt: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A burst is late if its gains are; 0.4 s after the knock it would feel like another one."""
    made, go_on = held_up(monkeypatch)
    made.update(touches=touches())
    made.wait_prepared()
    impact = made.strike("table", STRUCK)
    assert not rendered(made, late_s).any()
    go_on.set()
    made.wait_prepared()
    assert bool(impact.felt) == rendered(made, 0.2).any() == is_felt
    assert made.stats.impacts_left_out == (not is_felt)


def test_impacts_beyond_the_most_that_play_are_left_out_and_end_none_that_plays() -> None:
    made = HapticSession(*table_with_two_phones())
    made.update(touches=touches())
    for i in range(MOST_PLAYING + 8):
        made.add(SceneObject(f"cup {i}", pose=Pose((9.0, 0.1 * i, 9.0)), geometry=Box((0.05, 0.05, 0.05))))
    for source_id in made.source_ids:
        made.set_source(source_id, on=False)
    made.update(touches=touches())
    felt = [bool(made.strike("table", STRUCK, with_object=f"cup {i}").felt) for i in range(MOST_PLAYING + 8)]
    assert felt == [True] * MOST_PLAYING + [False] * 8
    assert made.stats.impacts_left_out == 8
    rendered(made, 2.0)
    made.update(touches=touches())
    assert made.strike("table", STRUCK, with_object="cup 39").felt


def test_many_impacts_stay_within_full_scale() -> None:
    made, blocks = session(), []
    rng = np.random.default_rng(3)
    for _ in range(100):
        made.update(touches=touches())
        for x, z in rng.uniform(-0.1, 0.1, (5, 2)).tolist():
            made.strike("table", (0.5 + x, TOP_M, 0.4 + z), with_object="cup", speed_m_s=float(rng.uniform(0.1, 20.0)))
        blocks.append(made.render(480))
    mix = np.concatenate(blocks)
    assert np.isfinite(mix).all()
    assert 0.05 < np.abs(mix).max() <= 1.0


def test_landings_are_felt_explained_and_can_be_disabled() -> None:
    def drop(**settings: Any) -> tuple[HapticSession, list[Impact]]:
        made, told = session(**settings), []
        for step in range(60):
            height = max(0.0, 0.4 - 9.81 * (step / 90) ** 2 / 2)
            made.update({"cup": Pose((0.45, TOP_M + 0.05 + height, 0.4))}, touches())
            made.render_s(1 / 90)
            told += [x for x in made.explain("left").impacts if x not in told]
        return made, told

    made, told = drop()
    (impact,) = told
    assert (impact.object_id, impact.with_object) == ("table", "cup")
    assert impact.speed_m_s == pytest.approx(math.sqrt(2 * 9.81 * 0.4), rel=0.01)
    assert made.stats.impacts == 1
    assert "table struck by cup" in made.explain("left").text
    assert "impacts" in made.explain("left").to_data()
    made, told = drop(impacts=False)
    assert told == []
    assert made.stats.impacts == 0


@pytest.mark.parametrize("height_m", [0.01, 0.03])
def test_landing_after_a_short_fall_from_rest_has_its_speed(height_m: float) -> None:
    """The first step counts, whose time is that of the update."""
    made = session()
    rest = [height_m] * 15  # longer than the gap after which a motion has ended
    for above_m in [*rest, *(max(0.0, height_m - 9.81 * (step / 90) ** 2 / 2) for step in range(1, 20))]:
        made.update({"cup": Pose((0.45, TOP_M + 0.05 + above_m, 0.4))}, touches())
        made.render_s(1 / 90)
    (impact,) = made.explain("left").impacts
    assert impact.speed_m_s is not None
    assert impact.speed_m_s == pytest.approx(math.sqrt(2 * 9.81 * height_m), rel=0.01)


def test_hands_can_change_during_a_burst() -> None:
    made = session()
    made.update(touches=touches())
    made.strike("table", STRUCK, speed_m_s=2.0)
    made.add_hand("foot")
    assert made.render(480)[:, 0].any()
    made.remove_hand("left")
    assert made.render(480).shape == (480, 2)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"speed_m_s": -1.0}, "above 0"),
        ({"speed_m_s": math.nan}, "finite"),
        ({"impulse_n_s": 0.0}, "above 0"),
        ({"speed_m_s": 1.0, "impulse_n_s": 1.0}, "one of them"),
    ],
)
def test_invalid_strike_is_refused(given: dict[str, float], said: str) -> None:
    with pytest.raises(SessionError, match=said):
        session().strike("table", STRUCK, **given)


def test_strike_on_a_missing_object_is_refused() -> None:
    made = session()
    with pytest.raises(UnknownObject, match="tabel"):
        made.strike("tabel", STRUCK)
    with pytest.raises(UnknownObject, match="mug"):
        made.strike("table", STRUCK, with_object="mug")
    with pytest.raises(SessionError, match="the struck object itself"):
        made.strike("table", STRUCK, with_object="table")
    with pytest.raises(SessionError, match="point_m"):
        made.strike("table", (0.0, 1.0))


def test_hand_on_a_long_striking_object_feels_the_impact_near_the_struck_point() -> None:
    """A beam that falls flat onto a rail touches it at its ends, metres from the middle, where the hand is."""
    beam, rail = SceneObject("wooden beam", geometry=Box((3.0, 0.04, 0.04))), Box((3.0, 0.03, 0.04))
    at_m = (0.0, 0.035, 0.0)
    scene = SceneSnapshot.build(
        [replace(beam, pose=Pose(at_m)), SceneObject("wooden rail", geometry=rail), phone_apart()],
    )
    made = HapticSession(scene, bake(scene))
    made.update(
        touches=[Touch("left", "wooden beam", (0.1, 0.05, 0.0)), Touch("right", "wooden beam", (1.4, 0.05, 0.0))]
    )
    struck = made.strike("wooden rail", (0.0, 0.015, 0.0), with_object="wooden beam", speed_m_s=1.0)
    made.render_s(LEAST_INTERVAL_S)
    itself = made.strike("wooden beam", (0.0, 0.015, 0.0), with_object="wooden rail", speed_m_s=1.0)
    assert struck.felt["left"] > 0.3 * itself.felt["left"]
    assert struck.felt["left"] > 2 * struck.felt.get("right", 0.0)


def phone_apart() -> SceneObject:
    return SceneObject("smartphone", pose=Pose((0.0, 0.0, 2.0)), geometry=Box((0.07, 0.008, 0.15)))


def test_no_impact_is_reported_beyond_full_scale() -> None:
    made = session()
    made.update(touches=[Touch("left", "table", NEAR)])
    made.set_user(gain_db=40.0)
    assert made.strike("table", STRUCK, speed_m_s=5.0).felt == {"left": 1.0}
    assert np.abs(made.render_s(0.1)).max() <= 1.0
