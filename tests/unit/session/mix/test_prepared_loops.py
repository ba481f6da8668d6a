"""Preparation of loops: on which thread, and how often; judged by threads and counts, not by clocks."""

import gc
import threading
from collections.abc import Iterator

import numpy as np
import pytest

from garbage import only_new_garbage
from scene2hap import AudioClip, HapticLoop, HapticSession, Touch
from scene2hap.common.caches import CacheWhileUsed
from scene2hap.haptics import Bands
from scene2hap.session.mix import prepared_loops
from scenes import RATE, box, haptics, table_with_two_phones, tone_loop

ON_FAN = Touch("left", "fan", (0.8, 0.82, 0.6))
SECONDS = 60.0


@pytest.fixture(autouse=True)
def _only_new_garbage() -> Iterator[None]:
    with only_new_garbage():
        yield


class Notes:
    """A record of samples and thread of each prepared loop. A closed gate blocks the worker, not the main thread."""

    def __init__(self) -> None:
        self.threads: list[int] = []
        self.contents: list[bytes] = []
        self.gate = threading.Event()
        self.gate.set()

    def made(self, clip: AudioClip, bands: Bands, rate_hz: int) -> prepared_loops.PreparedLoop:
        self.threads.append(threading.get_ident())
        self.contents.append(clip.samples.tobytes())
        assert threading.current_thread() is threading.main_thread() or self.gate.wait(SECONDS)
        return MADE(clip, bands, rate_hz)


MADE = prepared_loops._made


@pytest.fixture
def notes(monkeypatch: pytest.MonkeyPatch) -> Iterator[Notes]:
    # Wait for loops that earlier tests requested, so that they are not counted here.
    prepared_loops._worker().submit(lambda: None).result(SECONDS)
    noted = Notes()
    monkeypatch.setattr(prepared_loops, "_made", noted.made)
    monkeypatch.setattr(prepared_loops, "_OF_CLIP", {})
    monkeypatch.setattr(prepared_loops, "_BY_CONTENT", CacheWhileUsed(prepared_loops.MOST_BYTES))
    yield noted
    noted.gate.set()


def session(**config: object) -> HapticSession:
    return HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE, **config})


def add_fan(s: HapticSession, frequency_hz: float, name: str = "fan", x: float = 0.8) -> None:
    item = box(name, (0.1, 0.2, 0.1), (x, 0.82, 0.6))
    s.add(item, haptics("plastic", (0.2, 0.1, 0.1), "on"), {"on": tone_loop(frequency_hz)})


def test_a_loop_is_found_as_long_as_its_own_clip_lives(notes: Notes, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without reading samples, since a session looks loops up while it plays; and not under an equal clip that dies."""
    monkeypatch.setattr(prepared_loops._BY_CONTENT, "most_bytes", 0)
    bands = Bands.dominant()
    first, second = tone_loop(150.0).tactile, tone_loop(150.0).tactile
    assert first == second
    prepared_loops.prepare(first, bands, RATE)
    assert prepared_loops.find(second, bands, RATE) is None
    kept = prepared_loops.prepare(second, bands, RATE)
    assert len(notes.contents) == 1
    del first
    gc.collect()
    assert prepared_loops.find(second, bands, RATE) is kept
    del second
    gc.collect()
    assert not prepared_loops._OF_CLIP


def test_newest_loops_are_kept_for_objects_that_come_again(notes: Notes, monkeypatch: pytest.MonkeyPatch) -> None:
    def n_made(*frequencies_hz: float) -> int:
        before = len(notes.contents)
        for frequency_hz in frequencies_hz:  # each clip is gone after its call
            prepared_loops.prepare(tone_loop(frequency_hz).tactile, Bands.dominant(), RATE)
        gc.collect()
        return len(notes.contents) - before

    one = prepared_loops.prepare(tone_loop(150.0).tactile, Bands.dominant(), RATE).bank.nbytes
    assert n_made(160.0, 170.0) == 2
    assert n_made(150.0, 160.0, 170.0) == 0
    monkeypatch.setattr(prepared_loops._BY_CONTENT, "most_bytes", round(2.5 * one))
    assert n_made(160.0) == 0  # and the oldest goes
    assert n_made(160.0, 170.0) == 0
    assert n_made(150.0) == 1


@pytest.mark.parametrize("skip", [True, False])
@pytest.mark.parametrize("bands", ["dominant", "third-octaves"])
def test_loops_are_prepared_on_the_worker_and_played_later(notes: Notes, bands: str, skip: bool) -> None:
    s = session(bands=bands, skip=skip)
    here = threading.get_ident()
    before = len(notes.threads)
    notes.gate.clear()
    add_fan(s, 131.0)
    frame = s.update(touches=[ON_FAN])
    assert frame.gain("left", "fan") == 1.0
    assert s.position_s("fan") == 0.0
    assert str(s.explain("left"))
    assert np.abs(s.render(RATE // 4)[:, 0]).max() < 0.05  # only the phones, weakly
    s.set_source("fan", gain_db=-1.0)
    s.pause()
    s.resume()
    assert not s.wait_prepared(0.0)
    notes.gate.set()
    assert s.wait_prepared(SECONDS)
    s.update(touches=[ON_FAN])
    assert np.abs(s.render(RATE // 2)[:, 0]).max() > 0.2
    assert len(notes.threads) == before + 1
    assert here not in notes.threads[before:]


def test_blocking_mode_prepares_loops_in_update(notes: Notes) -> None:
    s = session(prepare="blocking")
    add_fan(s, 133.0)
    s.update(touches=[ON_FAN])
    assert s.render(RATE // 4)[:, 0].any()
    assert set(notes.threads) == {threading.get_ident()}


def test_loops_of_equal_content_are_prepared_once(notes: Notes) -> None:
    s = session()
    for n in range(5):
        add_fan(s, 137.0, f"fan {n}", 0.3 + 0.2 * n)  # copies, each with its own samples
        assert s.wait_prepared(SECONDS)
    s.remove("fan 0")
    add_fan(s, 137.0, "fan 0", 0.3)
    other = session()
    add_fan(other, 137.0)
    assert other.wait_prepared(SECONDS)
    assert notes.contents.count(tone_loop(137.0).tactile.samples.tobytes()) == 1
    assert len(set(notes.contents)) == len(notes.contents)
    add_fan(s, 137.0, "slower", 0.5)
    session(tactile_rate_hz=4000)  # another rate needs another loop
    assert len(notes.contents) > len(set(notes.contents))


def test_loop_with_known_content_plays_immediately(notes: Notes) -> None:
    s = session()
    loop = tone_loop(139.0)
    item, told = box("fan", (0.1, 0.2, 0.1), (0.8, 0.82, 0.6)), haptics("plastic", (0.2, 0.1, 0.1), "on")
    s.add(item, told, {"on": loop})
    assert s.wait_prepared(SECONDS)
    s.update()
    notes.gate.clear()
    s.remove("fan")
    s.add(item, told, {"on": loop})
    s.update(touches=[ON_FAN])
    assert np.abs(s.render(RATE // 4)[:, 0]).max() > 0.2


def test_source_removed_before_its_loop_is_ready_is_dropped(notes: Notes) -> None:
    s = session()
    notes.gate.clear()
    add_fan(s, 149.0)
    s.update(touches=[ON_FAN])
    s.remove("fan")
    s.update()
    assert s.wait_prepared(SECONDS)
    notes.gate.set()
    assert s.source_ids == ("phone", "alarm")
    assert not s.render(RATE).any()


def test_late_loop_starts_without_a_click(notes: Notes) -> None:
    s = session()
    notes.gate.clear()
    add_fan(s, 151.0)
    parts = []
    for n in range(60):
        if n == 20:
            notes.gate.set()
            assert s.wait_prepared(SECONDS)
        s.update(touches=[ON_FAN])
        parts.append(s.render(161)[:, 0])
    x = np.concatenate(parts)
    assert np.abs(x[-RATE // 4 :]).max() > 0.25
    # No step is larger than the tone's steepest step, with 20 % margin for the ramps.
    assert np.abs(np.diff(x)).max() <= 1.2 * 2 * np.pi * 0.3 * 151.0 / RATE + 0.01


def test_unused_prepared_loops_are_released() -> None:
    for n in range(400):
        samples = np.full(RATE * 8, n / 500, dtype=np.float32)
        clip = AudioClip(samples, RATE)
        prepared_loops.prepare(HapticLoop(clip, clip, 100.0, 100.0).tactile, Bands.dominant(), RATE)
    assert RATE * 8 * 4 < prepared_loops._BY_CONTENT.kept_bytes <= prepared_loops.MOST_BYTES
    assert len(prepared_loops._OF_CLIP) < 400
