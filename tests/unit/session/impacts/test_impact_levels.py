"""How strongly hands feel impacts: gains of the models, actuators, materials and masses."""

from __future__ import annotations

import math
from concurrent.futures import Future
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from scene2hap import (
    ActuatorProfile,
    AutoFidelity,
    Box,
    ExponentialPlate,
    HapticSession,
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
from scene2hap.propagation.impact import Burst
from scene2hap.propagation.plate import Plate
from scene2hap.session.impacts.felt_impacts import LEAST_INTERVAL_S, PEAK, struck_later
from scene2hap.session.impacts.gains import Floats
from scenes import table_with_two_phones, tone_loop
from struck_table import FAR, NEAR, PHYSICAL, RATE, STRUCK, TOP_M, amplitudes, burst_at, rendered, session, touches


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


PROFILES = {
    "none": None,
    "of all": UserProfile(gain_db=12.0, curve_db=[(20.0, -6.0), (80.0, 9.0), (300.0, 0.0)]),
    "of a hand": UserProfile(hands={"left": {"gain_db": 12.0}, "right": {"gain_db": -20.0}}),
    "of a device": UserProfile(gain_db=-20.0, devices={"lra": {"curve_db": [(100.0, 12.0)]}, "other": {}}),
}


@pytest.mark.parametrize("profile", PROFILES.values(), ids=PROFILES)
@pytest.mark.parametrize("actuator", ["flat", "lra", "voice_coil", {"min_frequency_hz": 60.0}])
@pytest.mark.parametrize("gain_db", [-12.0, 0.0, 20.0])
def test_no_impact_is_dismissed_that_a_hand_would_feel(gain_db: float, actuator: Any, profile: Any) -> None:
    """The bound that dismisses faint impacts is above the levels at which they play."""
    made, rng = session(actuator=actuator), np.random.default_rng(5)
    made.set_user(gain_db=gain_db)
    for n in (1, 2, 3, 6) * 3:
        f, decays_s = rng.uniform(5, 400, n), rng.uniform(0.008, 0.1, n)
        burst = Burst(f, decays_s, 10 ** rng.uniform(-3, 4) * 10 ** rng.uniform(-2, 0, n))
        _, levels = made._impacts._levels(burst, ["left", "right"], profile)
        assert (levels <= made._impacts._most(burst, profile)).all()


def test_an_impact_that_waits_is_played_at_the_level_of_its_start(monkeypatch: pytest.MonkeyPatch) -> None:
    """As any vibration: the level may have been set meanwhile."""
    made, jobs = session(propagation=ModalPlate(), prepare="background"), []
    made.update(touches=touches())
    made.wait_prepared()
    monkeypatch.setattr(made._impacts, "_ahead", None)
    monkeypatch.setattr(made._impacts._workers, "submit", lambda job: jobs.append(job) or Future())
    made.set_user(gain_db=-70.0)
    made.strike("table", STRUCK, with_object="cup", speed_m_s=1.0)
    made.set_user(gain_db=0.0)
    felt = [job() for job in jobs]
    assert [one["left"] > 0.01 for one in felt] == [True]


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


def test_an_impact_on_a_loud_hand_keeps_its_shape() -> None:
    """The limiter's curve began at -3 dB, and took the peaks of a mix with an impact."""
    scene, bundle = table_with_two_phones()
    loops = {x: {state: tone_loop(90, 0.9) for state in its} for x, its in bundle.loops.items()}
    heard = []
    for is_loud, is_struck in ((True, False), (False, True), (True, True)):
        made = HapticSession(scene, replace(bundle, loops=loops), hands=("left",))
        for source_id in made.source_ids:
            made.set_source(source_id, on=is_loud)
        made.update(touches=[Touch("left", "phone", scene.objects[2].pose.position_m), Touch("left", "table", NEAR)])
        made.render(RATE)
        if is_struck:
            made.strike("table", (NEAR[0], TOP_M, 0.42), with_object="cup", speed_m_s=6.0)
        heard.append(made.render(RATE // 2)[:, 0].astype(float))
    tone, impact, both = heard
    share = (both - tone) @ impact / (impact @ impact)
    np.testing.assert_allclose(both - tone, share * impact, atol=1e-4)
    assert np.abs(both).max() > 0.75


@pytest.mark.parametrize("block", [64, 4800])
def test_impacts_of_one_update_on_a_loud_hand_are_not_limited(block: int) -> None:
    """Together they exceeded full scale in short blocks, and the limiter's curve made a click of -13 dB."""
    scene, bundle = table_with_two_phones()
    loops = {x: {state: tone_loop(90, 0.6) for state in its} for x, its in bundle.loops.items()}
    made = HapticSession(scene, replace(bundle, loops=loops), hands=("left",))
    made.update(touches=[Touch("left", "phone", scene.objects[2].pose.position_m), Touch("left", "table", NEAR)])
    loudest = np.abs(made.render(RATE)[RATE // 2 :]).max()
    for i, striker in enumerate((None, "cup", "alarm")):
        made.strike("table", (NEAR[0], TOP_M, 0.4 + 0.01 * i), with_object=striker, speed_m_s=3.0)
    heard = np.concatenate([made.render(block) for _ in range(9600 // block)])
    # 0.95, from where sums are limited
    assert loudest + 0.1 < np.abs(heard).max() < 0.951
