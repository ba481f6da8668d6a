"""Fields prepared on a worker while the last field stays in use."""

import re
import subprocess
import sys
import threading
import time
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from scene2hap import Bands, HapticSession, Pose, Touch
from scene2hap.errors import ModelDomainError
from scene2hap.session.fields.keeper import FieldWarning
from scenes import RATE, box, haptics, table_with_two_phones, tone_loop

ON_TABLE = Touch("left", "table", (0.8, 0.72, 0.4))
SECONDS = 60.0


class Field:
    """A field whose gain is the number of contacts over ten for every touch; records the touched points."""

    def __init__(self, source_ids: tuple[str, ...], n_contacts: int) -> None:
        self.source_ids, self.n_contacts = source_ids, n_contacts
        self.asked: list[Any] = []

    def attenuation(self, object_id: str, points_m: Any) -> np.ndarray:
        self.asked += np.asarray(points_m).tolist()
        return np.full((len(points_m), len(self.source_ids), 1), self.n_contacts / 10)


class SlowField(Field):
    """A field whose queries take 50 ms; after this time it records the result of `look`."""

    def __init__(self, source_ids: tuple[str, ...], look: Callable[[], int]) -> None:
        super().__init__(source_ids, 1)
        self.look, self.seen = look, list[int]()

    def attenuation(self, object_id: str, points_m: Any) -> np.ndarray:
        time.sleep(0.05)
        self.seen.append(self.look())
        return super().attenuation(object_id, points_m)


class Gated:
    """A model that prepares its first field at once, and each later field only when `gate` is open."""

    def __init__(self) -> None:
        self.gate, self.entered = threading.Event(), threading.Semaphore(0)
        self.threads: list[int] = []
        self.fields: list[Field] = []
        self.problem: Exception | None = None
        self.told: list[set[str]] = []

    def prepare(self, network: Any, excitations: Any, bands: Bands) -> Field:
        self.threads.append(threading.get_ident())
        self.told.append(set(network.bodies))
        if self.fields:
            self.entered.release()
            assert self.gate.wait(SECONDS)
            if self.problem is not None:
                raise self.problem
        field = Field(tuple(x.source_id for x in excitations), len(network.contacts))
        self.fields.append(field)
        return field


def gated(**config: object) -> tuple[HapticSession, Gated]:
    model = Gated()
    session = HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE, "propagation": model, **config})
    assert session.wait_prepared(SECONDS)
    return session, model


def shifted(x: float) -> dict[str, Pose]:
    return {"phone": Pose((x, 0.725, 0.4))}


def test_update_does_not_block_and_uses_the_last_field() -> None:
    s, model = gated()
    first = s.update(touches=[ON_TABLE]).gains
    s.update(shifted(0.2), [ON_TABLE])
    assert model.entered.acquire(timeout=SECONDS)
    # The worker is inside the model now; updates are not blocked.
    np.testing.assert_array_equal(s.update(touches=[ON_TABLE]).gains, first)
    assert s.stats.fields_prepared == 1
    assert s.stats.field_age_s > 0
    assert not s.wait_prepared(0.0)
    model.gate.set()
    assert s.wait_prepared(SECONDS)
    assert s.stats.fields_prepared == 2
    assert s.stats.field_age_s == 0
    assert 0 < s.stats.field_latency_s < SECONDS
    assert threading.get_ident() not in model.threads


def test_sources_are_felt_on_themselves_before_the_first_field() -> None:
    may_go, threads = threading.Event(), list[int]()

    class Model:
        def prepare(self, network: Any, excitations: Any, bands: Bands) -> Field:
            threads.append(threading.get_ident())
            assert may_go.wait(SECONDS)
            return Field(tuple(x.source_id for x in excitations), 1)

    s = HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE, "propagation": Model()})
    frame = s.update(touches=[ON_TABLE, Touch("right", "phone", (0.1, 0.73, 0.4))])
    assert (frame.gain("left", "phone"), frame.gain("right", "phone")) == (0.0, 1.0)
    assert (s.stats.fields_prepared, s.wait_prepared(0.0)) == (0, False)
    may_go.set()
    assert s.wait_prepared(SECONDS)
    assert s.update(touches=[ON_TABLE]).gain("left", "phone") > 0.0
    assert s.stats.fields_prepared == len(threads) == 1
    assert threads != [threading.get_ident()]


def test_failure_of_the_first_field_is_reported() -> None:
    class Model:
        def prepare(self, network: Any, excitations: Any, bands: Bands) -> Field:
            raise ModelDomainError("the table is too thick")

    settings = {"sample_rate_hz": RATE, "propagation": Model()}
    s = HapticSession(*table_with_two_phones(), settings)
    with pytest.warns(RuntimeWarning, match="each source is felt on itself alone: the table is too thick"):
        assert s.wait_prepared(SECONDS)
    assert s.stats.fields_failed == 1
    with pytest.raises(ModelDomainError, match="the table is too thick"):
        HapticSession(*table_with_two_phones(), {**settings, "prepare": "blocking"})


def test_only_the_newest_scene_state_is_prepared() -> None:
    s, model = gated()
    s.update(shifted(0.2))
    assert model.entered.acquire(timeout=SECONDS)
    for i in range(20):
        s.update(shifted(0.21 + 0.01 * i))
    model.gate.set()
    assert s.wait_prepared(SECONDS)
    assert len(model.fields) == 3
    assert s.stats.fields_prepared <= 3


def test_touched_objects_are_prepared_before_all_others() -> None:
    s, model = gated()
    model.gate.set()
    s.add(box("shelf", (1.0, 0.02, 0.4), (9.0, 1.0, 0.4)), haptics("oak", (1.0, 0.4, 0.02)))
    s.add(
        box("fan", (0.1, 0.2, 0.1), (9.0, 1.11, 0.4)), haptics("plastic", (0.2, 0.1, 0.1), "on"), {"on": tone_loop(90)}
    )
    assert s.wait_prepared(SECONDS)
    everything = model.told[-1]
    assert {"table", "phone", "shelf", "fan"} <= everything
    s.update(touches=[ON_TABLE])
    n_before, n_fields = len(model.told), s.stats.fields_prepared
    on_shelf = Touch("right", "shelf", (8.7, 1.01, 0.4))
    s.update(shifted(0.2), [ON_TABLE])
    assert s.wait_prepared(SECONDS)
    assert model.told[n_before:] == [everything - {"shelf", "fan"}, everything]
    # The worker has already computed the gains at the touched point.
    assert [0.8, 0.72, 0.4] in model.fields[-1].asked
    assert s.stats.fields_prepared > n_fields
    assert s.update(touches=[ON_TABLE, on_shelf]).gain("right", "fan") > 0.0


class Expectant(Field):
    """A field that records each call of `expect` and its thread."""

    def __init__(self, source_ids: tuple[str, ...], n_contacts: int) -> None:
        super().__init__(source_ids, n_contacts)
        self.expected: list[tuple[str, int]] = []
        self.has_been_told = threading.Semaphore(0)

    def expect(self, object_id: str) -> None:
        self.expected.append((object_id, threading.get_ident()))
        self.has_been_told.release()


def test_wait_prepared_includes_the_expect_call_of_touched_objects() -> None:
    may_go = threading.Event()

    class Slow(Field):
        def expect(self, object_id: str) -> None:
            assert may_go.wait(SECONDS)

    class Model:
        def prepare(self, network: Any, excitations: Any, bands: Bands) -> Slow:
            return Slow(tuple(x.source_id for x in excitations), 1)

    s = HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE, "propagation": Model()})
    assert s.wait_prepared(SECONDS)
    s.update(touches=[ON_TABLE])
    assert not s.wait_prepared(0.05)
    may_go.set()
    assert s.wait_prepared(SECONDS)


def test_expect_is_called_once_and_not_on_the_game_thread() -> None:
    field = Expectant(("phone", "other phone"), 1)

    class Model:
        def prepare(self, network: Any, excitations: Any, bands: Bands) -> Expectant:
            field.source_ids = tuple(x.source_id for x in excitations)
            return field

    s = HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE, "propagation": Model()})
    for _ in range(3):
        s.update(touches=[ON_TABLE])
    assert field.has_been_told.acquire(timeout=SECONDS)
    s.update(touches=[Touch("left", "table", (0.7, 0.72, 0.4)), Touch("right", "phone", (0.5, 0.73, 0.4))])
    assert field.has_been_told.acquire(timeout=SECONDS)
    assert field.has_been_told.acquire(timeout=SECONDS)
    s.update(touches=[ON_TABLE])
    # All touched objects are announced again when a newly touched one is added; known ones cost no time.
    assert [object_id for object_id, _ in field.expected] == ["table", "table", "phone"]
    assert threading.get_ident() not in {thread for _, thread in field.expected}
    # A new field gets `expect` before it is used.
    s.update(shifted(0.2), [ON_TABLE])
    assert field.has_been_told.acquire(timeout=SECONDS)


def test_blocking_mode_prepares_in_update() -> None:
    s, model = gated(prepare="blocking")
    model.gate.set()
    s.update(shifted(0.2))
    assert s.stats.fields_prepared == 2
    assert set(model.threads) == {threading.get_ident()}


def test_exponential_plate_follows_changes_immediately() -> None:
    s = HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE})
    before = s.update(touches=[ON_TABLE]).gain("left", "phone")
    assert s.update(shifted(0.3), [ON_TABLE]).gain("left", "phone") > before
    assert s.stats.field_age_s == 0


def test_gains_over_a_lost_contact_fade_out_in_20_ms() -> None:
    s, model = gated()
    s.update(touches=[ON_TABLE])
    s.render(RATE)
    lifted = s.update({"phone": Pose((0.1, 1.2, 0.4))}, [ON_TABLE])
    assert lifted.gain("left", "phone") == 0.0
    assert lifted.gain("left", "alarm") > 0.0
    s.set_source("alarm", mute=True)
    s.update(touches=[ON_TABLE])
    out = s.render(RATE)[:, 0]
    assert np.abs(out[:40]).max() > 0.01
    assert not out[round(0.021 * RATE) :].any()
    # The lifted phone keeps its gain at the hand. Put down, it is felt through the table when the worker is done.
    held = s.update(touches=[Touch("left", "phone", (0.1, 1.205, 0.4))])
    assert held.gain("left", "phone") == 1.0
    model.gate.set()
    s.update(shifted(0.1), [ON_TABLE])
    assert s.wait_prepared(SECONDS)
    assert s.update(touches=[ON_TABLE]).gain("left", "phone") > 0.0


def test_stale_field_is_queried_at_the_pose_that_it_was_prepared_for() -> None:
    s, model = gated()
    turned = Pose((3.0, 0.725, 0.4), (0.0, 0.5**0.5, 0.0, 0.5**0.5))
    everything = {item.id: turned.compose(Pose((-0.1, -0.725, -0.4))).compose(item.pose) for item in s.snapshot.objects}
    point = turned.compose(Pose((-0.1, -0.725, -0.4))).to_world([[0.8, 0.72, 0.4]])[0]
    s.update(everything, [Touch("left", "table", tuple(point.tolist()))])
    np.testing.assert_allclose(model.fields[0].asked[-1], [0.8, 0.72, 0.4], atol=1e-12)
    model.gate.set()


def test_sources_can_change_while_a_field_is_stale() -> None:
    s, model = gated()
    gain = s.update(touches=[ON_TABLE]).gain("left", "alarm")
    s.add(
        box("fan", (0.1, 0.2, 0.1), (0.8, 0.82, 0.6)), haptics("plastic", (0.2, 0.1, 0.1), "on"), {"on": tone_loop(90)}
    )
    s.remove("phone")
    frame = s.update(touches=[ON_TABLE, Touch("right", "fan", (0.8, 0.92, 0.6))])
    assert frame.sources == ("alarm", "fan")
    assert frame.gain("left", "alarm") == gain
    assert frame.gain("left", "fan") == 0.0
    assert frame.gain("right", "fan") == 1.0
    model.gate.set()
    assert s.wait_prepared(SECONDS)
    assert s.update(touches=[ON_TABLE]).gain("left", "fan") > 0.0


def test_a_model_that_keeps_failing_is_warned_of_once_at_the_line_of_the_game() -> None:
    s, model = gated()
    model.gate.set()
    assert s.wait_prepared(SECONDS)
    for _ in range(2):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            for number in range(4):
                model.problem = ModelDomainError(f"the phone is too thick, {number}")
                s.update(shifted(0.1 * number + 0.1))
                assert s.wait_prepared(SECONDS)
        assert [(one.category, one.filename) for one in caught] == [(FieldWarning, __file__)]
        assert s.stats.fields_failed >= 2
        model.problem = None
        s.update(shifted(0.6))
        assert s.wait_prepared(SECONDS)


def test_an_error_of_a_guest_is_explained_with_the_line_that_raised_it() -> None:
    class Model:
        def prepare(self, network: Any, excitations: Any, bands: Bands) -> Field:
            return self._found({})

        def _found(self, places: dict[str, Field]) -> Field:
            return places["drone"]

    s = HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE, "propagation": Model()})
    line = Model._found.__code__.co_firstlineno + 1
    message = re.escape(f"felt on itself alone: KeyError('drone') at {__file__}:{line}")
    with pytest.warns(FieldWarning, match=message):
        assert s.wait_prepared(SECONDS)
    s.update(touches=[ON_TABLE])
    explained = s.explain("left")
    assert explained.failure == explained.reasons[0]
    assert re.search(message, explained.text)
    assert "being prepared" not in explained.text
    assert not explained.is_current


def test_update_goes_on_after_an_error_of_a_model_that_blocks() -> None:
    s, model = gated(prepare="blocking")
    model.gate.set()
    s.update(touches=[ON_TABLE])
    model.problem = ModelDomainError("the phone is too thick")
    with pytest.raises(ModelDomainError):
        s.update(shifted(0.2), [ON_TABLE])
    s.update(touches=[ON_TABLE])
    assert s.stats.skipped.unchanged_frames == 0
    s.add(box("fan", (0.1, 0.1, 0.1), (0.8, 0.77, 0.4)), None, {"on": tone_loop(100)})
    with pytest.raises(ModelDomainError):
        s.update(touches=[ON_TABLE])
    frame = s.update(touches=[ON_TABLE])
    assert frame.gain("left", "phone") > 0.0
    assert frame.gain("left", "fan") == 0.0  # unknown to the last field


def test_failing_model_keeps_the_last_field() -> None:
    s, model = gated()
    gains = s.update(touches=[ON_TABLE]).gains
    model.problem = ModelDomainError("the phone is too thick")
    model.gate.set()
    s.update(shifted(0.2))
    with pytest.warns(RuntimeWarning, match="the last one plays on: the phone is too thick"):
        assert s.wait_prepared(SECONDS)
    np.testing.assert_array_equal(s.update(touches=[ON_TABLE]).gains, gains)
    assert s.stats.fields_failed == 1
    assert s.stats.last_failure == "the phone is too thick"
    assert s.explain("left").felt
    assert "the last one plays on: the phone is too thick" in s.explain("left").failure
    assert s.stats.field_age_s > 0
    model.problem = None
    s.update(shifted(0.3))
    assert s.wait_prepared(SECONDS)
    assert s.stats.field_age_s == 0
    assert s.explain("left").failure == ""


def test_failing_model_without_worker_raises_in_update() -> None:
    s, model = gated(prepare="blocking")
    model.problem = ModelDomainError("the phone is too thick")
    model.gate.set()
    with pytest.raises(ModelDomainError, match="too thick"):
        s.update(shifted(0.2))


@pytest.mark.parametrize("shape", [(1, 2, 2), (1, 3, 1), (2, 2, 1), (1, 2)])
def test_field_result_of_wrong_shape_raises_a_session_error(shape: tuple[int, ...]) -> None:
    class Wrong(Field):
        def attenuation(self, object_id: str, points_m: Any) -> np.ndarray:
            return np.ones(shape)

    class Model:
        def prepare(self, network: Any, excitations: Any, bands: Bands) -> Field:
            return Wrong(tuple(x.source_id for x in excitations), 1)

    s = HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE, "propagation": Model(), "prepare": "blocking"})
    with pytest.raises(ModelDomainError, match=r"shape .* must be \(1, 2, 1\)"):
        s.update(touches=[ON_TABLE])


def test_worker_starts_after_the_requesting_update_has_returned() -> None:
    class Model(Gated):
        def prepare(self, network: Any, excitations: Any, bands: Bands) -> Field:
            self.threads.append(threading.get_ident())
            field = SlowField(tuple(x.source_id for x in excitations), lambda: len(self.threads))
            self.fields.append(field)
            return field

    model = Model()
    s = HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE, "propagation": model})
    assert s.wait_prepared(SECONDS)
    s.update(shifted(0.2), [ON_TABLE])
    first = model.fields[0]
    assert isinstance(first, SlowField)
    assert first.seen == [1]
    assert s.wait_prepared(SECONDS)
    assert len(model.threads) > 1


A_GAME_THAT_ENDS = """
import threading, time
from scene2hap import HapticSession
from scenes import RATE, table_with_two_phones

has_begun = threading.Event()

class Endless:
    def prepare(self, network, excitations, bands):
        has_begun.set()
        try:
            while True:
                time.sleep(0.001)
        finally:
            print("the worker leaves", flush=True)

config = {"sample_rate_hz": RATE, "propagation": Endless(), "prepare": "background"}
session = HapticSession(*table_with_two_phones(), config)
assert has_begun.wait(60.0)
print("the game ends", flush=True)
"""


def test_a_worker_leaves_its_work_before_the_interpreter_exits() -> None:
    """A worker stopped within a solver would print unrelated errors, and a model may prepare for minutes."""
    support = Path(__file__).parents[3] / "support"
    game = [sys.executable, "-W", "ignore", "-c", A_GAME_THAT_ENDS]
    run = subprocess.run(game, capture_output=True, text=True, check=True, cwd=support, timeout=120)
    assert run.stdout.split("\n") == ["the game ends", "the worker leaves", ""]
    assert run.stderr == ""
