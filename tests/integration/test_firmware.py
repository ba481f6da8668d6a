"""The firmware's code, compiled for the host, as the device of a serial sink."""

import shutil
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest

from host import terminal_problem
from scene2hap.devices.framing.frames import pcm, to_wire
from scene2hap.devices.framing.link_messages import Hello
from scene2hap.devices.protocol import SinkEvent, SinkFormat
from scene2hap.devices.serial_amp import SerialAmplifierSink
from scene2hap.devices.serial_port import SerialPort
from serial_bench import eventually

HOST = Path(__file__).parents[2] / "firmware" / "host" / "main.cpp"
COMPILER = shutil.which("c++") or shutil.which("g++") or shutil.which("clang++")

pytestmark = [
    pytest.mark.skipif(bool(terminal_problem()), reason=terminal_problem()),
    pytest.mark.skipif(COMPILER is None, reason="no C++ compiler"),
]


@pytest.fixture(scope="module")
def amplifier(tmp_path_factory: pytest.TempPathFactory) -> Path:
    program = tmp_path_factory.mktemp("firmware") / "amplifier"
    flags = ["-std=c++17", "-O1", "-Wall", "-Wextra", "-Werror", "-fsanitize=undefined", "-fno-sanitize-recover"]
    subprocess.run([str(COMPILER), *flags, "-o", str(program), str(HOST)], check=True)
    return program


def test_a_lost_frame_and_an_underrun_leave_no_step(amplifier: Path, tmp_path: Path) -> None:
    heard = tmp_path / "heard.raw"
    with heard.open("wb") as out:
        program = subprocess.Popen([str(amplifier)], stdin=subprocess.PIPE, stdout=out, stderr=subprocess.PIPE)
        assert program.stderr is not None
        assert program.stdin is not None
        try:
            port = SerialPort(program.stderr.readline().decode().strip(), 921600)
            port.write(to_wire(Hello(0, 2).to_frame()))
            time.sleep(0.1)
            # Frame 2 is lost, the queue runs dry after frame 3, and frame 4 comes late.
            for sequence, level, pause_s in ((1, 0.9, 0.0), (3, -0.9, 0.045), (4, 0.9, 0.2)):
                block = np.full((64, 2), level, dtype=np.float32)
                port.write(to_wire(pcm(block, sequence=sequence)))
                time.sleep(pause_s)
            port.close()
        finally:
            program.stdin.close()
            program.stderr.close()
            assert program.wait(60) == 0
    left = np.fromfile(heard, dtype="<i2").reshape(-1, 2)[:, 0] / 32767
    assert left.max() > 0.89
    assert left.min() < -0.89
    assert np.abs(np.diff(left)).max() <= 1.8 / 20 + 1e-3  # 5 ms are 20 frames


def test_firmware_plays_the_sent_samples(amplifier: Path, tmp_path: Path) -> None:
    events: list[SinkEvent] = []
    position = [0]

    def counting(n_frames: int) -> "np.ndarray[tuple[int, int], np.dtype[np.float32]]":
        place = np.arange(position[0], position[0] + n_frames) % 30000 + 1
        position[0] += n_frames
        return (np.stack([place, -place], axis=1) / 32767).astype(np.float32)

    heard = tmp_path / "heard.raw"
    with heard.open("wb") as out:
        program = subprocess.Popen([str(amplifier)], stdin=subprocess.PIPE, stdout=out, stderr=subprocess.PIPE)
        assert program.stderr is not None
        assert program.stdin is not None
        port = program.stderr.readline().decode().strip()
        try:
            for _ in range(2):  # the second connection begins with a new hello and new sequence numbers
                with SerialAmplifierSink(port, buffer_s=0.05, on_event=events.append) as sink:
                    sink.open(SinkFormat(4000, ("left", "right")))
                    sink.start(counting)
                    assert eventually(lambda sink=sink: sink.stats.frames >= 4000)  # bound early
                    assert sink.stats.latency_s is not None
            time.sleep(0.2)  # for the firmware's ramp to zero
        finally:
            program.stdin.close()
            errors = program.stderr.read()
            program.stderr.close()
            assert program.wait(60) == 0
    assert errors == b""
    assert [event.kind for event in events] == ["connected", "connected"]
    left, right = np.fromfile(heard, dtype="<i2").reshape(-1, 2).astype(int).T
    np.testing.assert_array_equal(right, -left)
    # The mix rises by one per sample; an underrun ramps down, then the mix continues where it was.
    steps = np.diff(left)
    assert (steps == 1).sum() > 6000
    assert not left[-1]
