"""The checksum that detects damaged bytes."""

from __future__ import annotations

import zlib

CRC_SIZE = 4


def with_crc32(data: bytes) -> bytes:
    """Append the CRC-32 of bytes, little-endian (reflected 0x04C11DB7, as in Ethernet and zip)."""
    return data + zlib.crc32(data).to_bytes(CRC_SIZE, "little")


def without_crc32(data: bytes) -> bytes | None:
    """Return the bytes without their checksum, or None if the checksum is wrong."""
    body = data[:-CRC_SIZE]
    if len(data) < CRC_SIZE or zlib.crc32(body) != int.from_bytes(data[-CRC_SIZE:], "little"):
        return None
    return body
