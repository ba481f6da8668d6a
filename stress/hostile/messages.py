"""Messages of clients of the bridge, and bytes of serial and UDP devices."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np

from stress.hostile.reader import add


def _requests(folder: Path) -> Path:
    rows = [
        {"type": "hello", "version": 1, "client": "game", "token": "t", "id": 1},
        {"type": "bake", "path": "a.glb", "config": {"seed": 1}, "user_prompt": "x", "save": "b"},
        {"type": "play", "bundle": "b", "hands": ["left"], "moving": ["phone"], "frames": "newest", "keep_s": 1.0},
        {"type": "set_source", "source": "phone", "on": True, "gain_db": -3.0},
        {"type": "strike", "object": "phone", "point_m": [0, 1, 2], "speed_m_s": 1.0},
        {"type": "spawn", "object": "x", "position_m": [0, 0, 0], "rotation_xyzw": [0, 0, 0, 1], "prefab": "p"},
        {"type": "set_user", "profile": {"gain_db": 1}},
    ]
    for number, row in enumerate(rows):
        (folder / f"{number}.json").write_text(json.dumps(row))
    return folder


def _parsed(folder: Path) -> object:
    from scene2hap.bridge.messages import parse_request, read_document, request_id

    found = []
    for path in sorted(folder.iterdir()):
        document = read_document(path.read_bytes().decode("utf-8", "replace"))
        found.append((request_id(document), parse_request(document)))
    # Free documents within a request are checked by their own readers.
    return [(number, one.model_copy(update={"config": {}, "profile": None, "session": None})) for number, one in found]


add("bridge messages", _requests, _parsed, names_file=False, opens_files=False)


def _frame(folder: Path) -> Path:
    from bridge_frames import encode_frame, encode_picture

    poses = np.array([[0.1, 0.725, 0.4, 0, 0, 0, 1]], np.float32)
    touches = [(0, 0, (0.2, 0.72, 0.4)), (1, 2, (0.1, 0.73, 0.4))]
    (folder / "frame.bin").write_bytes(encode_frame(1, bytes(8), 1, 0.01, poses, touches))
    from looks import image_file

    row = {"object": "phone", "kind": "isolated", "view": "front"}
    picture = image_file(np.zeros((20, 20, 3), np.uint8))
    (folder / "picture.bin").write_bytes(encode_picture(json.dumps(row).encode(), picture))
    return folder


def _taken(folder: Path) -> object:
    from scene2hap import HapticSession
    from scene2hap.bridge.frames import decode_frame, kind_of
    from scene2hap.bridge.pictures import SentPictures
    from scene2hap.bridge.played_session import PlayedSession
    from scenes import table_with_two_phones

    picture, frame = ((folder / name).read_bytes() for name in ("picture.bin", "frame.bin"))
    kind_of(picture)
    SentPictures(lambda: folder).take(picture)
    played = PlayedSession(
        HapticSession(*table_with_two_phones(), {"prepare": "blocking"}), ["phone"], None, lambda document: None
    )
    try:
        return played.take(decode_frame(frame))
    finally:
        played.close()


add("bridge frames", _frame, _taken, "*.bin", names_file=False, opens_files=False)


def _wire(folder: Path) -> Path:
    from scene2hap.devices.framing.frames import pcm, to_datagram, to_wire
    from scene2hap.devices.framing.link_messages import GREETED, HEARD, Credit, DeviceFormat, Hello

    block = np.zeros((16, 2), np.float32)
    frames = [
        Hello(4000, 2).to_frame(),
        DeviceFormat(4000, 2, 400, 128).to_frame(),
        pcm(block, sequence=1, time_us=5),
        Credit(1, GREETED | HEARD, 300, 16, 16, 0, 0).to_frame(7),
    ]
    (folder / "wire.bin").write_bytes(b"".join(map(to_wire, frames)))
    (folder / "datagram.bin").write_bytes(to_datagram(frames[2]))
    return folder


def _heard(folder: Path) -> object:
    """Give the bytes to a device, and to a host that waits for its greeting and then for its credits."""
    from scene2hap.devices.framing.frames import FrameParser, FrameType, from_datagram, samples
    from scene2hap.devices.framing.link_messages import DeviceFormat
    from scene2hap.devices.protocol import SinkFormat
    from scene2hap.devices.reference_device import ReferenceDevice
    from scene2hap.devices.serial_amp import SerialLine

    wire, datagram = ((folder / name).read_bytes() for name in ("wire.bin", "datagram.bin"))
    device = ReferenceDevice()
    device.receive(wire, 0.0)
    device.advance(0.1)
    found: list[object] = [device.to_send()]
    for frame in FrameParser().feed(wire):
        found += [samples(frame)] if frame.type is FrameType.PCM else [DeviceFormat.from_frame(frame)]
    if (one := from_datagram(datagram)) and one.type is FrameType.PCM:
        found.append(samples(one))

    class Port:
        def __init__(self) -> None:
            self.pieces = [wire[at : at + 20] for at in range(0, len(wire), 20)]

        def read(self, timeout_s: float) -> bytes:
            return self.pieces.pop(0) if self.pieces else b""

        def write(self, data: bytes) -> None:
            pass

    line: Any = SerialLine("port", 921600, None, 0.05, 32)
    line._port = Port()
    greet = line._greet
    line._greet = lambda *_: greet(line._port, 2, lambda: bool(line._port.pieces))
    with patch("scene2hap.devices.serial_amp.SerialPort", lambda *_: line._port):
        line.connect(SinkFormat(48000, ("left", "right")), lambda: bool(line._port.pieces))
        while line._port.pieces:
            n = line.wanted(0.0)
            if n:
                line.send(np.zeros((n, 2), np.float32))
    return found, line.latency_s, line.underruns


add("serial and UDP", _wire, _heard, "*.bin", names_file=False, opens_files=False)
