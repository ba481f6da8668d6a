"""Decoders of meshopt data: attributes (versions 0 and 1), triangles and indices.

We do not use the PyPI package `meshoptimizer` (0.2.30a0): it is an alpha release without wheels, and installing it
takes a C++ compiler. Data is untrusted. Every read is checked against the end of the data, and no allocation exceeds
the size that the caller requested. Callers bound `count * stride`.

Source: glTF extensions EXT_meshopt_compression and KHR_meshopt_compression, appendix "Bitstream".
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from itertools import repeat
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Bytes

# First bytes of data: kind of codec and version.
_ATTRIBUTES, _TRIANGLES, _INDICES = (0xA0, 0xA1), 0xE1, 0xD1
# An attribute block has at most this many elements and at most this many bytes.
_BLOCK_ELEMENTS, _BLOCK_BYTES = 256, 8192
_GROUP = 16
# Bits of a delta, by the two header bits of its group: version 0, then version 1 with control 0 and 1.
_BITS = ((0, 2, 4, 8), (0, 1, 2, 4), (1, 2, 4, 8))
_ALL_ZERO, _VERBATIM = 2, 3
# Least number of bytes at the end of attribute data, with the first element in them. Shorter tails are padded.
_SHORTEST_TAIL = (32, 24)
# One channel of a block reads at most this many bytes: 16 groups of 24.
_MOST_OF_A_CHANNEL = 512
# Groups that are unpacked at once. This bounds the memory beside the result.
_GROUPS_AT_ONCE = 1 << 16
_TRIANGLES_AT_ONCE = 1 << 16
_CODES_BEHIND_TRIANGLES, _BYTES_BEHIND_INDICES = 16, 4
_WORD = 0xFFFFFFFF


def attributes(data: bytes, count: int, stride: int) -> Bytes:
    """Decode elements (count, stride) of attribute data; `stride` in bytes is a multiple of 4 up to 256.

    Raises: ValueError: the data is broken.
    """
    if stride % 4 or not 0 < stride <= 256:
        raise ValueError(f"attributes of {stride} bytes; they must have 4, 8, ... 256")
    if not data or data[0] not in _ATTRIBUTES:
        raise ValueError(f"attributes begin with {data[:1]!r}; they must begin with 0xa0 or 0xa1")
    version = data[0] & 1
    tail = stride + stride // 4 * version
    end = len(data) - max(tail, _SHORTEST_TAIL[version])
    if end < 1:
        raise ValueError(f"attributes of {stride} bytes in data of {len(data)} bytes: cut short")
    first = np.frombuffer(data, np.uint8, stride, len(data) - tail)
    channels = data[len(data) - tail + stride :] if version else bytes(stride // 4)
    deltas = np.empty((stride, count), np.uint8)
    at, done = 1, 0
    reader = _GroupReader(data, end)
    per_block = min(_BLOCK_BYTES // stride // _GROUP * _GROUP, _BLOCK_ELEMENTS)
    blocks_at_once = max(1, _GROUPS_AT_ONCE * _GROUP // (per_block * stride))
    while done < count:
        # Blocks of equal length are unpacked together; the last may be shorter.
        n_elements = min(per_block, count - done)
        n_blocks = max(1, min(blocks_at_once, (count - done) // per_block))
        for _ in range(n_blocks):
            at = reader.walk_block(at, n_elements, stride, version)
        n = n_blocks * n_elements
        groups = reader.unpack().reshape(n_blocks, stride, -1)[:, :, :n_elements]
        deltas[:, done : done + n] = groups.transpose(1, 0, 2).reshape(stride, n)
        done += n
    if at != end:
        raise ValueError(f"attributes end at byte {at} of their data; they must end at {end}")
    return _summed(deltas, first, channels)


class _GroupReader:
    """Reader that finds groups of 16 deltas in attribute data, and unpacks all groups found since the last call.

    The end of a group depends on the number of its deltas that are stored in full behind it. These numbers are computed
    in advance for a group at any byte, so that finding a group is one addition.
    """

    def __init__(self, data: bytes, end: int) -> None:
        self._data, self._end = data, end
        # A broken group may reach beyond the data. It reads zeros there, and its end is checked later.
        self._bytes = np.frombuffer(data + bytes(_MOST_OF_A_CHANNEL + 32), np.uint8)
        self._sizes = {0: bytes(len(data) + _MOST_OF_A_CHANNEL), 8: bytes([_GROUP]) * (len(data) + _MOST_OF_A_CHANNEL)}
        self._starts: list[int] = []
        self._bits: list[int] = []

    def walk_block(self, at: int, n_elements: int, stride: int, version: int) -> int:
        """Find the groups of a block that begins at a byte. Returns its end. Raises: ValueError: it is cut short."""
        n_groups = -(-n_elements // _GROUP)
        n_headers = -(-n_groups // 4)
        control, at = at, at + stride // 4 * version
        if at > self._end:
            raise ValueError("attributes are cut short")
        for channel in range(stride):
            mode = self._data[control + channel // 4] >> channel % 4 * 2 & 3 if version else 0
            if mode == _ALL_ZERO:
                self._starts += repeat(at, n_groups)
                self._bits += repeat(0, n_groups)
            elif mode == _VERBATIM:
                self._starts += range(at, at + n_elements, _GROUP)
                self._bits += repeat(8, n_groups)
                at += n_elements
            else:
                bits = _BITS[0 if not version else mode + 1]
                headers, at = self._data[at : at + n_headers], at + n_headers
                widths = [bits[header >> shift & 3] for header in headers for shift in (0, 2, 4, 6)][:n_groups]
                for width in widths:
                    self._starts.append(at)
                    at += self._sizes_of(width)[at]
                self._bits += widths
            if at > self._end:
                raise ValueError("attributes are cut short")
        return at

    def _sizes_of(self, width: int) -> bytes:
        """Return the size [bytes] of a group of `width`-bit deltas, by the byte at which it begins."""
        if width not in self._sizes:
            n, full = 2 * width, _N_FULL[width][self._bytes]
            sizes = np.full(len(full) - n, n, np.uint8)
            for i in range(n):
                sizes += full[i : i - n]
            self._sizes[width] = sizes.tobytes()
        return self._sizes[width]

    def unpack(self) -> Bytes:
        """Return the deltas (n, 16) of all groups found since the last call."""
        starts, bits = np.array(self._starts, np.int64), np.array(self._bits, np.uint8)
        self._starts, self._bits = [], []
        deltas = np.zeros((len(starts), _GROUP), np.uint8)
        for width in (1, 2, 4, 8):
            rows = np.flatnonzero(bits == width)
            at = starts[rows, None]
            packed = self._bytes[at + np.arange(2 * width)]
            if width == 8:
                deltas[rows] = packed
                continue
            fields = _FIELDS[width][packed].reshape(-1, _GROUP)
            is_full = fields == (1 << width) - 1
            behind = np.cumsum(is_full, axis=1) + (at + (2 * width - 1))
            fields[is_full] = self._bytes[behind[is_full]]
            deltas[rows] = fields
        return deltas


def _fields(width: int) -> Bytes:
    """Return the fields (256, 8 / width) of each byte. Single bits begin with the lowest, others with the highest."""
    shifts = np.arange(8) if width == 1 else np.arange(8 - width, -1, -width)
    return (np.arange(256)[:, None] >> shifts & ((1 << width) - 1)).astype(np.uint8)


_FIELDS = {width: _fields(width) for width in (1, 2, 4)}
# Number of fields of each byte that mean "stored in full".
_N_FULL = {width: (fields == (1 << width) - 1).sum(axis=1).astype(np.uint8) for width, fields in _FIELDS.items()}


def _summed(deltas: Bytes, first: Bytes, channels: bytes) -> Bytes:
    """Return elements (n, stride) from deltas (stride, n). Each word is a difference from the element before it."""
    stride, n = deltas.shape
    if all(channel & 3 == 0 for channel in channels):
        steps = _unzigzag(deltas)
        np.cumsum(steps, axis=1, dtype=np.uint8, out=steps)
        steps += first[:, None]
        return np.ascontiguousarray(steps.T)
    result = np.empty((n, stride), np.uint8)
    for word, channel in enumerate(channels):
        rows, kind = slice(4 * word, 4 * word + 4), channel & 3
        if kind == 3:
            raise ValueError(f"attributes of channel kind {channel:#x}; 0, 1 and 2 are known")
        dtype = np.dtype(("<u1", "<u2", "<u4")[kind])
        steps = np.ascontiguousarray(deltas[rows].T).view(dtype)
        before = np.ascontiguousarray(first[rows]).view(dtype)
        if kind == 2:
            turn = channel >> 4
            steps = (steps >> turn) | (steps << (32 - turn & 31))
            values = np.bitwise_xor.accumulate(steps, axis=0) ^ before
        else:
            values = np.cumsum(_unzigzag(steps), axis=0, dtype=dtype) + before
        result[:, rows] = np.ascontiguousarray(values).view(np.uint8)
    return result


def _unzigzag(values: NDArray[Any]) -> NDArray[Any]:
    """Return differences, wrapped around as unsigned, of numbers that carry their sign in the lowest bit."""
    return (values >> 1) ^ (0 - (values & 1))


def triangles(data: bytes, count: int) -> NDArray[np.uint32]:
    """Decode vertex numbers (count,) of a list of triangles.

    Raises: ValueError: the data is broken.
    """
    n_triangles, rest = divmod(count, 3)
    if rest:
        raise ValueError(f"triangles of {count} indices; their number must be a multiple of 3")
    if not data or data[0] != _TRIANGLES:
        raise ValueError(f"triangles begin with {data[:1]!r}; they must begin with 0xe1")
    end = len(data) - _CODES_BEHIND_TRIANGLES
    if end < 1 + n_triangles:
        raise ValueError(f"{n_triangles} triangles in data of {len(data)} bytes: cut short")
    result = np.empty(count, np.uint32)
    begin = 0
    try:
        for rows in _triangle_rows(data, n_triangles, end):
            # Broken data may count beyond 32 bits; the format wraps around there.
            result[begin : begin + len(rows)] = np.array(rows, np.int64) & _WORD
            begin += len(rows)
    except IndexError as cause:
        raise ValueError("triangles are cut short") from cause
    return result


def _triangle_rows(data: bytes, n_triangles: int, end: int) -> Iterator[list[int]]:
    """Yield vertex numbers of `_TRIANGLES_AT_ONCE` triangles at a time, three each.

    A triangle reuses one of the last 16 edges, or some of the last 16 vertices. A new vertex is the next number that no
    triangle has used, or is stored as a difference from the last stored number.
    """
    edges = deque(repeat((_WORD, _WORD), 16), maxlen=16)
    vertices = deque(repeat(_WORD, 16), maxlen=16)
    push_edge, push = edges.append, vertices.append
    following = last = 0
    at = 1 + n_triangles
    pairs = data[end:]

    def stored() -> int:
        nonlocal at, last
        value = 0
        for shift in (0, 7, 14, 21, 28):
            byte = data[at]
            at += 1
            value |= (byte & 0x7F) << shift
            if byte < 0x80:
                break
        value &= _WORD
        last += value >> 1 ^ -(value & 1)
        return last

    for begin in range(1, 1 + n_triangles, _TRIANGLES_AT_ONCE):
        rows: list[int] = []
        put = rows.extend
        for code in data[begin : min(begin + _TRIANGLES_AT_ONCE, 1 + n_triangles)]:
            if code < 0xF0:
                a, b = edges[~(code >> 4)]
                kind = code & 15
                if kind == 0:
                    c = following
                    following += 1
                    push(c)
                elif kind < 13:
                    c = vertices[~kind]
                else:
                    if kind == 15:
                        c = stored()
                    else:
                        last += 1 if kind == 14 else -1
                        c = last
                    push(c)
                push_edge((c, b))
                push_edge((a, c))
            else:
                kind = code & 15
                if kind < 14:
                    pair = pairs[kind]
                else:
                    pair = data[at]
                    at += 1
                    if pair == 0:
                        following = 0
                if kind == 15:
                    a = stored()
                else:
                    a = following
                    following += 1
                high, low = pair >> 4, pair & 15
                if high == 0:
                    b = following
                    following += 1
                else:
                    b = stored() if high == 15 and kind >= 14 else vertices[-high]
                if low == 0:
                    c = following
                    following += 1
                else:
                    c = stored() if low == 15 and kind >= 14 else vertices[-low]
                push(a)
                if high == 0 or (high == 15 and kind >= 14):
                    push(b)
                if low == 0 or (low == 15 and kind >= 14):
                    push(c)
                push_edge((b, a))
                push_edge((c, b))
                push_edge((a, c))
            put((a, b, c))
        # A table follows the numbers, and they must not extend into it.
        if at > end:
            raise ValueError("triangles are cut short")
        yield rows
    if at != end:
        raise ValueError(f"triangles end at byte {at} of their data; they must end at {end}")


def indices(data: bytes, count: int) -> NDArray[np.uint32]:
    """Decode the numbers (count,) of a sequence of differences from two baselines.

    Raises: ValueError: the data is broken.
    """
    if not data or data[0] != _INDICES:
        raise ValueError(f"indices begin with {data[:1]!r}; they must begin with 0xd1")
    stored = np.frombuffer(data, np.uint8)[1 : max(len(data) - _BYTES_BEHIND_INDICES, 1)]
    ends = np.flatnonzero(stored < 0x80)
    if len(ends) != count or ends[-1] != len(stored) - 1:
        raise ValueError(f"{count} indices in data that has {len(ends)}")
    begins = np.concatenate(([0], ends[:-1] + 1))
    lengths = ends - begins + 1
    if lengths.max() > 5:
        raise ValueError(f"an index of {lengths.max()} bytes; up to 5 are used")
    values = np.zeros(count, np.int64)
    for i in range(5):
        has = lengths > i
        values[has] |= (stored[begins[has] + i].astype(np.int64) & 0x7F) << 7 * i
    values &= _WORD
    baseline, values = values & 1, values >> 1
    steps = values >> 1 ^ -(values & 1)
    sums = [np.cumsum(np.where(baseline == i, steps, 0)) for i in (0, 1)]
    return (np.where(baseline == 1, sums[1], sums[0]) & _WORD).astype(np.uint32)
