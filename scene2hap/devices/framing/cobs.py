"""Consistent overhead byte stuffing: encode any bytes without zeros.

Source: Cheshire and Baker, Consistent Overhead Byte Stuffing, IEEE/ACM Transactions on Networking 7(2), 1999.
"""

from __future__ import annotations

LONGEST_RUN = 254
"""Most bytes of a run without zeros. The overhead is one byte, and at most one more for each such run."""


def encode(data: bytes) -> bytes:
    """Encode bytes without zeros; no delimiter is added."""
    out = bytearray()
    runs = data.split(b"\0")
    for number, run in enumerate(runs):
        while len(run) >= LONGEST_RUN:
            out.append(0xFF)
            out += run[:LONGEST_RUN]
            run = run[LONGEST_RUN:]
            # A full run encodes no zero, so no code follows it at the end of the data.
            if not run and number == len(runs) - 1:
                return bytes(out)
        out.append(len(run) + 1)
        out += run
    return bytes(out)


def decode(data: bytes) -> bytes | None:
    """Decode the bytes of `encode`; None if they are not such bytes."""
    if not data or 0 in data:
        return None
    out = bytearray()
    position, end = 0, len(data)
    while True:
        code = data[position]
        following = position + code
        if following > end:
            return None
        out += data[position + 1 : following]
        position = following
        if position == end:
            return bytes(out)
        if code <= LONGEST_RUN:
            out.append(0)
