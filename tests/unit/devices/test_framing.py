"""COBS, checksums and frames: published vectors, bytes computed by hand, round trips, and damaged bytes."""

import math
import struct
import zlib

import numpy as np
import pytest
from hypothesis import given, strategies as st

from scene2hap.devices.framing import cobs
from scene2hap.devices.framing.frames import (
    MAX_PAYLOAD,
    Frame,
    FrameParser,
    FrameType,
    SampleFormat,
    from_datagram,
    message,
    pcm,
    samples,
    to_datagram,
    to_int16,
    to_wire,
    with_crc32,
    without_crc32,
)
from scene2hap.devices.framing.link_messages import Credit, DeviceFormat, Hello, is_newer
from scene2hap.errors import DeviceError
from wire_damage import damaged

# Cheshire and Baker's cases, as listed in the Wikipedia article "Consistent Overhead Byte Stuffing".
COBS_VECTORS = [
    ("00", "0101"),
    ("0000", "010101"),
    ("001100", "01021101"),
    ("11220033", "0311220233"),
    ("11223344", "0511223344"),
    ("11000000", "0211010101"),
    (bytes(range(1, 255)).hex(), "ff" + bytes(range(1, 255)).hex()),
    (bytes(range(255)).hex(), "01ff" + bytes(range(1, 255)).hex()),
    (bytes(range(1, 256)).hex(), "ff" + bytes(range(1, 255)).hex() + "02ff"),
    (bytes([*range(2, 256), 0]).hex(), "ff" + bytes(range(2, 256)).hex() + "0101"),
    (bytes([*range(3, 256), 0, 1]).hex(), "fe" + bytes(range(3, 256)).hex() + "0201"),
]


@pytest.mark.parametrize(("plain", "stuffed"), COBS_VECTORS)
def test_cobs_vectors(plain: str, stuffed: str) -> None:
    assert cobs.encode(bytes.fromhex(plain)).hex() == stuffed
    assert cobs.decode(bytes.fromhex(stuffed)) == bytes.fromhex(plain)


@given(st.lists(st.sampled_from([b"\0", b"\x01", b"ab", b"\xff" * 253, b"\xfe" * 254])).map(b"".join) | st.binary())
def test_cobs_round_trip(data: bytes) -> None:
    stuffed = cobs.encode(data)
    assert 0 not in stuffed
    assert len(stuffed) <= len(data) + 1 + math.ceil(len(data) / 254)
    assert cobs.decode(stuffed) == data


@pytest.mark.parametrize("broken", [b"", b"\x00", b"\x02", b"\x03\x11", b"\x02\x11\x00", b"\x01\x05\x11"])
def test_cobs_refuses_invalid_encodings(broken: bytes) -> None:
    assert cobs.decode(broken) is None


def test_checksums_have_the_published_values() -> None:
    assert with_crc32(b"123456789")[-4:] == bytes.fromhex("2639f4cb")  # CBF43926, the check value of the catalogue
    assert without_crc32(with_crc32(b"")) == b""
    assert without_crc32(b"abc") is None


def test_a_pcm_frame_worked_by_hand() -> None:
    """Source: docs/serial-protocol.md, "A frame, byte by byte"."""
    block = np.array([[1.0, -1.0], [0.0, 0.5]], dtype=np.float32)
    body = bytes.fromhex("01 03 0201 02 01 0200 78563412 ff7f 0180 0000 0040")
    datagram = to_datagram(pcm(block, sequence=0x0102, time_us=0x12345678))
    assert datagram == body + struct.pack("<I", zlib.crc32(body))
    # The body's only zeros are its 8th byte, both bytes of the third sample and the low byte of the fourth.
    crc = datagram[-4:]
    assert 0 not in crc
    by_hand = b"\0" + b"\x08" + body[:7] + b"\x09" + body[8:16] + b"\x01" + b"\x01" + b"\x06" + body[19:] + crc + b"\0"
    assert to_wire(pcm(block, sequence=0x0102, time_us=0x12345678)) == by_hand


def test_link_messages_worked_by_hand() -> None:
    assert Hello(4000, 2).to_frame().payload.hex() == "a00f000002"
    assert DeviceFormat(4000, 2, 400, 128).to_frame().payload.hex() == "a00f00000290018000"
    credit = Credit(0x0201, 3, 320, 80, 5, 6, 7)
    assert credit.to_frame().payload.hex() == "0102034001500005000000" + "06000000" + "07000000"
    for told in (Hello(1, 2), DeviceFormat(1, 2, 3, 4), credit):
        assert type(told).from_frame(told.to_frame()) == told
        assert type(told).from_frame(message(FrameType.MUTE)) is None


@given(
    st.integers(0, 65535),
    st.integers(0, 2**32 - 1),
    st.sampled_from([SampleFormat.INT16, SampleFormat.FLOAT32]),
    st.integers(1, 12).flatmap(lambda c: st.binary(max_size=20 * c).map(lambda raw: (raw, c))),
)
def test_frames_round_trip(sequence: int, time_us: int, format: SampleFormat, raw: tuple[bytes, int]) -> None:
    data, channels = raw
    block = (np.frombuffer(data[: len(data) // channels * channels], dtype=np.int8) / np.float32(128)).reshape(
        -1, channels
    )
    frame = pcm(block, sequence=sequence, time_us=time_us, format=format)
    assert from_datagram(to_datagram(frame)) == frame
    assert list(FrameParser().feed(to_wire(frame))) == [frame]
    np.testing.assert_allclose(samples(frame), block, atol=0 if format is SampleFormat.FLOAT32 else 0.51 / 32767)


@given(st.sampled_from(FrameType).filter(lambda t: t is not FrameType.PCM), st.binary(max_size=MAX_PAYLOAD))
def test_messages_round_trip(type: FrameType, payload: bytes) -> None:
    frame = message(type, payload, sequence=7, time_us=9)
    assert list(FrameParser().feed(to_wire(frame))) == [frame]


def test_sixteen_bits_are_exact_and_clipped() -> None:
    every = np.arange(-32767, 32768).astype(np.float32) / np.float32(32767)
    np.testing.assert_array_equal(np.frombuffer(to_int16(every[:, None]), "<i2"), np.arange(-32767, 32768))
    odd = np.array([[2.0, -2.0, np.nan, np.inf, -np.inf]], dtype=np.float32)
    np.testing.assert_array_equal(np.frombuffer(to_int16(odd), "<i2"), [32767, -32767, 0, 32767, -32767])


def test_payload_above_the_limit_is_refused() -> None:
    with pytest.raises(DeviceError, match="at most 1024"):
        pcm(np.zeros((300, 2), dtype=np.float32), sequence=0)
    with pytest.raises(DeviceError, match="must be 4"):
        Frame(FrameType.PCM, channels=2, format=SampleFormat.INT16, count=1, payload=b"abc")


def test_parser_returns_the_same_frames_for_any_chunk_sizes() -> None:
    rng = np.random.default_rng(1)
    frames = [message(FrameType.STREAM, rng.bytes(int(rng.integers(60))), sequence=k) for k in range(50)]
    stream = b"".join(map(to_wire, frames))
    parser = FrameParser()
    found = []
    start = 0
    while start < len(stream):
        end = start + int(rng.integers(1, 9))
        found += parser.feed(stream[start:end])
        start = end
    assert found == frames
    assert parser.damaged == 0


def test_parser_drops_damaged_frames_and_returns_the_others() -> None:
    rng = np.random.default_rng(2)
    parser = FrameParser()
    recent: list[Frame] = []
    untouched = missed = accepted = 0
    frames = [pcm(rng.uniform(-1, 1, (8, 2)).astype(np.float32), sequence=k) for k in range(5000)]
    for frame, (data, touched) in zip(frames, damaged(map(to_wire, frames), 0.01, rng), strict=True):
        recent = [*recent[-3:], frame]
        found = list(parser.feed(data))
        assert all(frame in recent for frame in found)
        untouched += not touched
        missed += not touched and recent[-1] not in found
        accepted += len(found)
    assert 0.55 < untouched / 5000 < 0.65  # 0.99^51
    # Each frame begins with a zero, so that damaged bytes before it do no harm.
    assert missed == 0
    assert accepted >= untouched


@given(st.binary(max_size=400))
def test_decoders_accept_arbitrary_bytes_without_raising(data: bytes) -> None:
    cobs.decode(data)
    from_datagram(data)
    from_datagram(with_crc32(data))
    list(FrameParser().feed(b"\0" + data + b"\0"))


def test_parser_drops_frames_that_are_too_long() -> None:
    parser = FrameParser()
    for _ in range(1000):
        assert list(parser.feed(b"\x55" * 1000)) == []
    frame = message(FrameType.MUTE)
    assert list(parser.feed(to_wire(frame))) == [frame]
    assert parser.damaged == 1


def test_sequence_numbers_wrap() -> None:
    assert is_newer(0, 65535)
    assert is_newer(5, 4)
    assert not is_newer(4, 4)
    assert not is_newer(65535, 0)
