"""The reference device meets the requirements of docs/serial-protocol.md, "The device"; with a manual clock."""

import numpy as np
import pytest
from numpy.typing import NDArray

from scene2hap.devices.framing.frames import FrameParser, FrameType, message, pcm, to_wire
from scene2hap.devices.framing.link_messages import GREETED, HEARD, MUTED, Credit, DeviceFormat, Hello
from scene2hap.devices.reference_device import ReferenceDevice


class Bench:
    def __init__(self) -> None:
        self.played: list[NDArray[np.int16]] = []
        self.accepted: list[NDArray[np.int16]] = []
        self.device = ReferenceDevice(1000, 2, 100, on_samples=self.accepted.append, on_output=self.played.append)
        self.parser = FrameParser()

    def say(self, data: bytes, now_s: float) -> None:
        self.device.receive(data, now_s)

    def block(self, sequence: int, n_frames: int = 10, level: float = 1.0) -> bytes:
        return to_wire(pcm(np.full((n_frames, 2), level, dtype=np.float32), sequence=sequence, time_us=sequence))

    def credits(self, now_s: float) -> list[Credit]:
        self.device.advance(now_s)
        found = [Credit.from_frame(frame) for frame in self.parser.feed(self.device.to_send())]
        return [credit for credit in found if credit is not None]

    @property
    def output(self) -> NDArray[np.int16]:
        return np.concatenate(self.played)


HELLO = to_wire(Hello(0, 2).to_frame())


def test_device_answers_hello_and_refuses_frames_before_it() -> None:
    bench = Bench()
    bench.say(bench.block(1), 0.0)
    assert bench.credits(0.0)[-1].flags == MUTED
    bench.say(HELLO, 0.001)
    (frame,) = bench.parser.feed(bench.device.to_send())
    assert DeviceFormat.from_frame(frame) == DeviceFormat(1000, 2, 100, 128)
    assert bench.credits(0.01)[-1].flags == GREETED | MUTED
    assert bench.accepted == []


def test_device_plays_accepted_frames_and_reports_its_queue() -> None:
    bench = Bench()
    bench.say(HELLO + bench.block(9), 0.0)
    (credit,) = bench.credits(0.0)[-1:]
    assert credit == Credit(9, GREETED | HEARD, 90, 10, 10, 0, 0)
    (credit,) = bench.credits(0.0085)[-1:]
    assert (credit.free_frames, credit.queued_frames) == (98, 2)
    np.testing.assert_array_equal(bench.output[4:8], 32767)


def test_the_watchdog_mutes_50_ms_after_the_last_frame() -> None:
    bench = Bench()
    bench.say(HELLO + bench.block(1, 80), 0.0)
    bench.credits(0.0)
    assert not bench.credits(0.049)[-1].flags & MUTED
    assert bench.credits(0.055)[-1].flags & MUTED
    bench.credits(0.08)
    out = bench.output[:, 0].astype(int)
    np.testing.assert_array_equal(out[:5], np.rint(32767 * np.array([1, 2, 3, 4, 5]) / 5))
    assert (out[5:49] == 32767).all()
    # A ramp of 5 ms to zero instead of a step; queued samples are dropped.
    np.testing.assert_array_equal(out[49:55], np.rint(32767 * np.array([4, 3, 2, 1, 0, 0]) / 5))
    assert not out[54:].any()
    bench.say(bench.block(2), 0.081)
    assert not bench.credits(0.086)[-1].flags & MUTED
    assert bench.output[-1, 0] == 32767


def test_a_lost_and_a_refused_frame_leave_no_step() -> None:
    """Samples that do not follow each other meet in a fade of 5 ms; with one sample in 5 it is at most 2 / 5 a step."""
    bench = Bench()
    bench.say(HELLO + bench.block(1, 20) + bench.block(3, 20, -1.0) + bench.block(4, 100), 0.0)
    bench.credits(0.0)
    assert (bench.device.lost, bench.device.refused) == (1, 1)
    bench.credits(0.01)
    bench.say(bench.block(5, 20), 0.01)
    for k in range(11, 61):
        bench.credits(k * 0.001)
    out = bench.output[:, 0] / 32767
    assert np.abs(np.diff(out, prepend=0.0)).max() == pytest.approx(0.4, abs=1e-4)
    np.testing.assert_allclose(out[25:40], -1.0)
    np.testing.assert_allclose(out[45:59], 1.0)


def test_an_underrun_is_counted_once_and_a_greeting_is_none() -> None:
    bench = Bench()
    bench.say(HELLO + bench.block(1, 10), 0.0)
    for k in range(30):
        bench.credits(k * 0.001)
    assert bench.device.underruns == 1
    bench.say(bench.block(2, 10), 0.03)
    bench.say(HELLO, 0.031)
    assert bench.credits(0.04)[-1].underruns == 0


def test_mute_acts_immediately() -> None:
    bench = Bench()
    bench.say(HELLO + bench.block(1, 80), 0.0)
    bench.credits(0.010)
    bench.say(to_wire(message(FrameType.MUTE)), 0.010)
    bench.credits(0.030)
    assert not bench.output[15:].any()


def test_old_sequence_numbers_are_ignored() -> None:
    bench = Bench()
    bench.say(HELLO + bench.block(65535) + bench.block(65535) + bench.block(0) + bench.block(65535), 0.0)
    assert bench.device.accepted_frames == 20
    bench.say(bench.block(3), 0.0)
    assert bench.device.lost == 2


def test_empty_frame_is_answered_with_a_credit() -> None:
    bench = Bench()
    bench.say(HELLO + bench.block(1, 0), 0.0)
    (credit,) = bench.credits(0.0)[-1:]
    assert credit == Credit(1, GREETED | HEARD | MUTED, 100, 0, 0, 0, 0)


def test_device_refuses_frames_beyond_its_queue() -> None:
    bench = Bench()
    bench.say(HELLO + bench.block(1, 60) + bench.block(2, 60), 0.0)
    assert bench.device.refused == 1
    assert bench.credits(0.0)[-1].free_frames == 40


def test_arbitrary_bytes_do_not_crash_the_device() -> None:
    rng = np.random.default_rng(3)
    bench = Bench()
    for k in range(300):
        bench.say(HELLO + rng.bytes(50) + b"\0", k * 0.01)
        bench.credits(k * 0.01)
    assert bench.device.accepted_frames == 0
