"""A program that ends without `session.stop()` fades out on a device, and does not hang."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

PROGRAM = """
import sys, time
import numpy as np
from scene2hap import HapticSession, Touch
from scene2hap.devices.due_frames import FrameClock
from scene2hap.devices.link import LiveSink
from scenes import table_with_two_phones

class Line:
    underruns, latency_s = 0, None

    def connect(self, format, carry_on):
        self.pace, self.sent = FrameClock(format.sample_rate_hz), []
        self.pace.restart(time.monotonic())
        return format.sample_rate_hz

    def wanted(self, timeout_s):
        return self.pace.wait(240, timeout_s)

    def send(self, block):
        self.pace.take(len(block))
        self.sent.append(block.copy())

    def disconnect(self):
        np.save(sys.argv[1], np.concatenate(self.sent))

sink = LiveSink(Line(), "amplifier")
session = HapticSession(*table_with_two_phones(), sink=sink)
session.start()
end = time.monotonic() + 0.4
while time.monotonic() < end or sink.stats.frames < 12000:
    session.update(touches=[Touch("left", "phone", (0.12, 0.73, 0.4))])
    time.sleep(0.01)
"""


@pytest.mark.parametrize(
    ("last_line", "status"),
    [("", 0), ("sys.exit(3)", 3), ("raise KeyboardInterrupt", None)],
    ids=["end of the code", "exit", "interrupt"],
)
def test_a_program_that_ends_while_it_plays_fades_out(last_line: str, status: int | None, tmp_path: Path) -> None:
    played = tmp_path / "played.npy"
    tests = str(Path(__file__).parents[2] / "support")
    program = f"import sys; sys.path.insert(0, {tests!r})\n{PROGRAM}{last_line}"
    done = subprocess.run(
        [sys.executable, "-c", program, str(played)], capture_output=True, text=True, timeout=120, check=False
    )
    assert status is None or done.returncode == status, done.stderr
    sound = np.load(played)[:, 0]
    peak = np.abs(sound).max()
    assert peak > 0.1
    assert sound[-1] == 0.0
    last = int(np.flatnonzero(sound)[-1])
    assert np.abs(sound[last - 48 : last]).max() < 0.1 * peak
