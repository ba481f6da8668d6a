"""A fake text-to-audio program; its first argument selects a fault: fake_generator.py MANNER REQUEST FOLDER.

It uses only the standard library, so that it starts fast.
"""

from __future__ import annotations

import json
import math
import os
import signal
import struct
import subprocess
import sys
import time
import wave
from pathlib import Path

CONTRACT = {"contract": "scene2hap/text-to-audio", "version": 1}
RATE = 8000


def sound(path: Path, seconds: float, pitch_hz: float = 120.0) -> None:
    half = round(RATE / pitch_hz / 2)
    cycle = struct.pack("<h", 9000) * half + struct.pack("<h", -9000) * half
    samples = (cycle * round(2 * seconds * pitch_hz))[: 2 * round(seconds * RATE)]
    with wave.open(str(path), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(RATE)
        file.writeframes(samples)


def main() -> int:
    manner, asked, place = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    request = json.loads(asked.read_text(encoding="utf-8"))
    reply = {**CONTRACT, "model": "fake-1", "licence": "CC0-1.0", "address": "https://example.org/fake"}
    names = [f"{i}.wav" for i in range(request["count"])]
    counter = os.environ.get("FAKE_COUNTER")
    if counter:
        with open(counter, "a", encoding="utf-8") as file:
            file.write(json.dumps({**request, "environment": sorted(os.environ)}) + "\n")

    if manner == "hang":
        time.sleep(60)
    if manner == "orphan":
        # A child that would outlive its parent by a minute.
        child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"])
        Path(os.environ["FAKE_PID"]).write_text(str(child.pid), encoding="utf-8")
    if manner == "die":
        print("loading the model\nCUDA out of memory, key", os.environ.get("HF_TOKEN", "none"), file=sys.stderr)
        return 3
    if manner == "killed":
        os.kill(os.getpid(), signal.SIGKILL)
    if manner == "flood":
        while True:
            sys.stdout.write("x" * (1 << 20))
    if manner == "gigabytes":
        with (place / "big.bin").open("wb") as file:
            for _ in range(10_000):
                file.write(bytes(1_000_000))
                file.flush()
    if manner == "sparse":
        with (place / "sparse.bin").open("wb") as file:
            file.truncate(10_000_000_000)
    if manner == "litter":
        for i in range(5000):
            (place / f"{i}").touch()
    if manner == "silent":
        return 0
    if manner == "not-json":
        (place / "reply.json").write_bytes(b"\x93NUMPY{")
        return 0
    if manner == "huge-reply":
        (place / "reply.json").write_bytes(b'{"files": [' + b'"a",' * 500_000 + b'"a"]}')
        return 0

    for i, name in enumerate(names):
        sound(place / name, request["duration_s"], 100.0 + 20.0 * i)
    if manner == "junk-sounds":
        for name in names:
            (place / name).write_bytes(b"RIFF junk")
    if manner == "one-junk":
        (place / "1.wav").write_bytes(bytes(1000))
    if manner == "long":
        sound(place / "0.wav", 61.0)
        names = ["0.wav"]
    if manner == "not-finite":
        coding = struct.pack("<4sIHHIIHH", b"fmt ", 16, 3, 1, RATE, 4 * RATE, 4, 32)
        header = struct.pack("<4sI4s", b"RIFF", 36 + 96000, b"WAVE") + coding + struct.pack("<4sI", b"data", 96000)
        (place / "0.wav").write_bytes(header + struct.pack("<f", math.nan) * 24000)
        names = ["0.wav"]
    if manner == "outside":
        names = [f"../../{asked.name}", "/etc/passwd", "..", "a\\b.wav"]
    if manner == "link":
        (place / "link.wav").symlink_to(place / "0.wav")
        names = ["link.wav"]
    if manner == "pipe":
        os.mkfifo(place / "pipe.wav")
        names = ["pipe.wav"]
    if manner == "absent":
        names = ["absent.wav"]
    if manner == "more":
        for i in range(request["count"], 9):
            sound(place / f"{i}.wav", request["duration_s"])
        names = [f"{i}.wav" for i in range(9)]
    if manner == "error":
        reply = {**CONTRACT, "error": "no GPU\nfor you"}
    if manner == "nameless":
        reply = {**CONTRACT, "address": "javascript:alert(1)", "licence": "free\nas in beer"}
    if manner == "other-version":
        reply["version"] = 2
    if manner == "no-number-of-version":
        reply["version"] = True
    if manner == "no-files":
        names = []
    (place / "reply.json").write_text(json.dumps({**reply, "files": names}), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
