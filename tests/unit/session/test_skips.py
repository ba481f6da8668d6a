"""Skipped work: each skip counts its savings, can be switched off, and stays within its stated error."""

from threading import Event
from typing import Any

import numpy as np
import pytest

from scene2hap import Bands, HapticSession, Pose, Touch
from scene2hap.audio.levels import threshold_db
from scene2hap.errors import ConfigError
from scenes import RATE, table_with_two_phones

ON_TABLE = Touch("left", "table", (0.8, 0.72, 0.4))
ON_CUP = Touch("right", "cup", (5.0, 0.1, 5.0))


class Watched:
    """The paper's law; records the objects that it gets and each query."""

    def __init__(self) -> None:
        from scene2hap import ExponentialPlate

        self._law = ExponentialPlate()
        self.bodies: list[set[str]] = []
        self.asked: list[str] = []

    def prepare(self, network: Any, excitations: Any, bands: Bands) -> "Watched":
        self.bodies.append(set(network.bodies))
        self._field = self._law.prepare(network, excitations, bands)
        self.source_ids = self._field.source_ids
        return self

    def attenuation(self, object_id: str, points_m: Any) -> np.ndarray:
        self.asked.append(object_id)
        return self._field.attenuation(object_id, points_m)


def session(skip: object, model: object = "exponential_plate", **config: object) -> HapticSession:
    settings = {"sample_rate_hz": RATE, "skip": skip, "propagation": model, "prepare": "blocking", **config}
    return HapticSession(*table_with_two_phones(), settings)


def only(name: str) -> dict[str, bool]:
    names = ("unreachable", "below_threshold", "silent_bands", "idle_hands", "unchanged_frames")
    return {each: each == name for each in names}


@pytest.mark.parametrize("skip", [False, only("unreachable")])
def test_objects_that_no_source_reaches_are_skipped(skip: Any) -> None:
    model = Watched()
    s = session(skip, model)
    gains = s.update(touches=[ON_TABLE, ON_CUP]).gains
    s.update({"cup": Pose((6.0, 0.05, 5.0))}, [ON_TABLE, ON_CUP])
    np.testing.assert_array_equal(gains[1], 0.0)
    reached = {"table", "phone", "alarm"}
    counts = s.stats.skipped
    if skip:
        assert model.bodies == [reached]
        assert set(model.asked) == {"table"}
        assert (counts.unreachable_objects, counts.unreachable_touches) == (1, 2)
    else:
        assert model.bodies[0] == {*reached, "cup"}
        assert set(model.asked) == {"table", "cup"}
        assert (counts.unreachable_objects, counts.unreachable_touches) == (0, 0)


@pytest.mark.parametrize("skip", [False, only("unreachable")])
def test_contact_changes_that_no_source_reaches_prepare_nothing(skip: Any) -> None:
    s = session(skip)
    # The block moves onto the cup; then the cup is shifted below it.
    s.update({"block": Pose((5.0, 0.45, 5.0))})
    before = s.stats
    s.update({"cup": Pose((5.01, 0.05, 5.0))})
    assert s.stats.fields_prepared - before.fields_prepared == (0 if skip else 1)
    out_of_reach = s.stats.skipped.changes_out_of_reach - before.skipped.changes_out_of_reach
    assert out_of_reach == (1 if skip else 0)


@pytest.mark.parametrize(
    "skip", [False, only("below_threshold"), {**only("below_threshold"), "idle_hands": True}], ids=["no", "all", "near"]
)
def test_sources_that_are_not_felt_are_not_mixed(skip: Any) -> None:
    s = session(skip)
    # The limit is 10 dB below the threshold, shared by two sources; tested 1 dB below and above.
    peak, edge = 0.3, 10 ** (-10 / 20) / 2 * 10 ** (float(threshold_db(100)) / 20)
    on_phone = [Touch("left", "phone", (0.1, 0.73, 0.4))]
    s.set_source("alarm", mute=True)
    levels = []
    for offset_db in (-1.0, 1.0):
        s.set_source("phone", gain_db=20 * np.log10(edge / peak) + offset_db)
        frame = s.update(touches=on_phone)
        assert frame.gain("left", "phone") > 0
        s.render(RATE)
        levels.append(np.abs(s.render(RATE)).max())
    assert levels[1] > 0
    assert (levels[0] == 0) == bool(skip)
    assert s.stats.skipped.below_threshold == (1 if skip else 0)


@pytest.mark.parametrize("skip", [False, only("silent_bands")])
def test_silent_bands_are_not_mixed(skip: Any) -> None:
    s = session(skip, bands=Bands.third_octaves())
    frame = s.update(touches=[Touch("left", "phone", (0.1, 0.73, 0.4))])
    assert (frame.gains[0, 0] == 1).all()
    out = s.render(RATE)
    whole = session(False, bands=Bands.third_octaves())
    whole.update(touches=[Touch("left", "phone", (0.1, 0.73, 0.4))])
    np.testing.assert_allclose(out, whole.render(RATE), atol=40e-7)
    counts = s.stats.skipped
    # A tone of 100 Hz lies on the edge of two bands; in all other bands it is below rounding.
    assert (counts.silent_bands > 15) == bool(skip)
    assert (counts.rows_not_mixed > 0) == bool(skip)


@pytest.mark.parametrize("skip", [False, only("idle_hands")])
def test_idle_hands_are_not_computed(skip: Any) -> None:
    s = session(skip)
    s.update(touches=[ON_TABLE])
    s.update()
    assert s.stats.skipped.idle_hands == (3 if skip else 0)


@pytest.mark.parametrize("skip", [False, only("unchanged_frames")])
def test_unchanged_frames_are_not_computed_again(skip: Any) -> None:
    model = Watched()
    s = session(skip, model)
    for _ in range(5):
        s.update(touches=[ON_TABLE])
    assert len(model.asked) == (1 if skip else 5)
    assert s.stats.skipped.unchanged_frames == (4 if skip else 0)
    assert s.stats.updates == 5
    # Every input of a frame causes a new computation.
    s.set_source("phone", gain_db=-6.0)
    assert s.update(touches=[ON_TABLE]).gain("left", "phone") < 1
    quiet = s.update(touches=[ON_TABLE]).gain("left", "phone")
    s.set_user(gain_db=-6.0)
    assert s.update(touches=[ON_TABLE]).gain("left", "phone") == pytest.approx(quiet * 10**-0.3)
    moved = s.update({"phone": Pose((0.3, 0.725, 0.4))}, [ON_TABLE]).gain("left", "phone")
    assert moved != s.update({"phone": Pose((0.2, 0.725, 0.4))}, [ON_TABLE]).gain("left", "phone")
    assert not s.update().gains.any()


def test_moved_object_is_evaluated_again_in_an_outdated_field(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its touch is at another place of it, also if the contacts and all other touched objects stay."""
    model, may_prepare = Watched(), Event()
    may_prepare.set()
    prepare = model.prepare
    monkeypatch.setattr(model, "prepare", lambda *given: may_prepare.wait(30.0) and prepare(*given))
    s = session(only("unchanged_frames"), model, prepare="background")
    touches = [ON_TABLE, Touch("right", "cup", (0.8, 0.82, 0.4))]
    s.update({"cup": Pose((0.8, 0.77, 0.4))}, touches)
    assert s.wait_prepared(30.0)
    may_prepare.clear()
    n_asked = []
    for x in (0.8, 0.81):  # lifted off the table
        s.update({"cup": Pose((x, 1.5, 0.4))}, touches)
        n_asked.append(len(model.asked))
    assert not s.is_current
    may_prepare.set()
    assert n_asked[0] < n_asked[1]


def test_gains_are_kept_when_contacts_change_that_no_source_reaches() -> None:
    model = Watched()
    s = session(True, model)
    s.update({"block": Pose((5.0, 0.45, 5.0))}, [ON_TABLE])
    gains, n_asked = s.update(touches=[ON_TABLE]).gains, len(model.asked)
    before = s.stats.skipped
    frame = s.update({"cup": Pose((5.01, 0.05, 5.0))}, [ON_TABLE])
    assert s.stats.skipped.changes_out_of_reach == before.changes_out_of_reach + 1
    assert s.stats.skipped.unchanged_frames == before.unchanged_frames + 1
    assert len(model.asked) == n_asked
    np.testing.assert_array_equal(frame.gains, gains)
    # The cup moves to the table and transmits the vibration.
    on_cup = Touch("right", "cup", (0.8, 0.82, 0.4))
    assert s.update({"cup": Pose((0.8, 0.77, 0.4))}, [ON_TABLE, on_cup]).gains[1].any()


def test_an_unknown_skip_is_refused() -> None:
    with pytest.raises(ConfigError, match="silence"):
        session({"silence": True})
