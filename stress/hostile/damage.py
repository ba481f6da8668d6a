"""Damage to files and messages: to their bytes, and to the values within JSON, GLB, XML, text, RIFF and WAV.

Structured damage keeps the container valid, so that it reaches the code behind the parser.
"""

from __future__ import annotations

import json
import os
import random
import re
import struct
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

NUMBERS: tuple[Any, ...] = (
    0, -1, 1, 0.0, -0.0, 2**31, 2**63, -(2**70), 10**400, 1e308, -1e308, 1e-320, 5e-324, 1e30, 3.5e38,
    float("nan"), float("inf"), -float("inf"), 0.5, 255, 65536, 10**15,
)  # fmt: skip
VALUES: tuple[Any, ...] = (
    *NUMBERS, None, True, False, "", "x", "\ud800", "\0", "../../../etc/passwd", "/dev/zero", "nan", "1", "1e999",
    "a" * 100_000, [], {}, [[]], [0] * 1000, {"": {}}, [None] * 3, [[[]]], "\x1b[2J", "冷蔵庫", "a\nb", "__class__",
    "{0.__class__}", "%s" * 50, {"file": "x"}, [1, 2, 3], "con", ".", "..", "\u202e",
)  # fmt: skip
_SPELT = (
    b"999999999999", b"-1", b"1e308", b"-1e308", b"1e-320", b"NaN", b"nan", b"Infinity", b"inf", b"-inf", b"9" * 5000,
    b"0", b'""', b"1e999", b"0x10", b"1_0", b"\xd9\xa3", b"1,5", b"4294967296", b"2147483648", b"null", b"[]", b"{}",
)  # fmt: skip
_NUMBER = re.compile(rb"-?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?")
_WORD = re.compile(rb"[A-Za-z_][\w.:-]{1,40}")


def damage(path: Path, rng: random.Random) -> str:
    """Damage a file in place once. Returns the name of the damage."""
    for _ in range(20):
        data = path.read_bytes()
        kind = rng.choice(_fitting(path.suffix.lower(), data))
        try:
            damaged = kind(data, rng)
        except (ArithmeticError, AttributeError, LookupError, RecursionError, StopIteration, TypeError, ValueError):
            continue
        except struct.error:
            continue  # the file is already too damaged for this, or too small
        if damaged != data:
            path.write_bytes(damaged)
            return kind.__name__
    return "nothing"


def odd_file(path: Path, rng: random.Random) -> str:
    """Replace a file by something that is not a file of its kind. Returns what it is."""
    kind = rng.choice(["empty", "folder", "pipe", "loop of links", "link outside", "dangling link", "sparse", "zeros"])
    path.unlink()
    if kind == "empty":
        path.write_bytes(b"")
    elif kind == "folder":
        path.mkdir()
    elif kind == "pipe":
        os.mkfifo(path)
    elif kind == "loop of links":
        path.symlink_to(path.name)
    elif kind == "link outside":
        path.symlink_to("/dev/zero")
    elif kind == "dangling link":
        path.symlink_to("nowhere")
    elif kind == "sparse":  # far more than any reader may take, and nothing on the disk
        with path.open("wb") as file:
            file.truncate(1 << 40)
    else:
        path.write_bytes(bytes(rng.choice([1, 100, 100_000])))
    return kind


# -- bytes ------------------------------------------------------------------------------------------------------------


def flip_bits(data: bytes, rng: random.Random) -> bytes:
    """Flip one or many bits."""
    changed = bytearray(data)
    for _ in range(rng.choice([1, 1, 4, 32, 256])):
        changed[rng.randrange(len(changed))] ^= 1 << rng.randrange(8)
    return bytes(changed)


def truncate(data: bytes, rng: random.Random) -> bytes:
    """Cut off the end, or the beginning."""
    at = rng.randrange(len(data))
    return data[at:] if rng.random() < 0.2 else data[:at]


def repeat(data: bytes, rng: random.Random) -> bytes:
    """Repeat a stretch up to a thousand times."""
    begin = rng.randrange(len(data))
    end = min(len(data), begin + rng.randrange(1, 200))
    return data[:end] + data[begin:end] * rng.choice([1, 10, 1000]) + data[end:]


def append(data: bytes, rng: random.Random) -> bytes:
    """Append rubbish, or the file itself."""
    return data + rng.choice([b"\0", b"\n", b"}", rng.randbytes(100), data, b"\0" * 100_000])


def change_word(data: bytes, rng: random.Random) -> bytes:
    """Replace 16, 32 or 64 bits near the front by an extreme number, where containers have lengths and counts."""
    size, code = rng.choice([(2, "H"), (4, "I"), (4, "f"), (8, "Q"), (8, "d")])
    at = rng.randrange(min(len(data) - size, rng.choice([64, 200, len(data)])))
    numbers: tuple[Any, ...] = (0, 1, len(data), len(data) * 2, (1 << 8 * size) - 1, (1 << 8 * size - 1) - 1)
    if code in "fd":
        numbers = (float("nan"), float("inf"), -1e38, 1e-45, 0.0)
    return data[:at] + struct.pack(f"<{code}", rng.choice(numbers)) + data[at + size :]


def swap_sides(data: bytes, rng: random.Random) -> bytes:
    """Exchange two stretches, as a bad disk exchanges sectors."""
    size = min(512, max(1, len(data) // 4))
    a, b = sorted((rng.randrange(len(data) - size), rng.randrange(len(data) - size)))
    if b < a + size:
        return data
    return data[:a] + data[b : b + size] + data[a + size : b] + data[a : a + size] + data[b + size :]


# -- text -------------------------------------------------------------------------------------------------------------


def change_number(data: bytes, rng: random.Random) -> bytes:
    """Replace a number of a text by an odd one."""
    place = rng.choice(list(_NUMBER.finditer(data[:200_000])))
    return data[: place.start()] + rng.choice(_SPELT) + data[place.end() :]


def change_name(data: bytes, rng: random.Random) -> bytes:
    """Replace a word of a text by another of its words, or by an odd one."""
    words = list(_WORD.finditer(data[:200_000]))
    place = rng.choice(words)
    other = rng.choice(
        [rng.choice(words).group(), b"", b"\xff\xfe", b"../x", b"x" * 10_000, b"&a;", b"\0", b"e\xcc\x81"]
    )
    return data[: place.start()] + other + data[place.end() :]


def change_encoding(data: bytes, rng: random.Random) -> bytes:
    """Write a text in another encoding, or with other ends of lines."""
    kind = rng.choice(["bom", "bom twice", "utf-16", "utf-32", "crlf", "cr", "latin", "nul", "cp1252", "surrogate"])
    if kind in ("utf-16", "utf-32"):
        return data.decode().encode(kind)
    swaps = {"crlf": (b"\n", b"\r\n"), "cr": (b"\n", b"\r")}
    if kind in swaps:
        return data.replace(*swaps[kind])
    if kind.startswith("bom"):
        return b"\xef\xbb\xbf" * (1 + kind.endswith("twice")) + data
    at = rng.randrange(len(data))
    odd = {"latin": b"\xe9", "nul": b"\0", "cp1252": b"\x93x\x94", "surrogate": b"\xed\xa0\x80"}[kind]
    return data[:at] + odd + data[at:]


def change_line(data: bytes, rng: random.Random) -> bytes:
    """Remove, double, exchange, lengthen or empty a line."""
    lines = data.split(b"\n")
    a, b = rng.randrange(len(lines)), rng.randrange(len(lines))
    kind = rng.choice(["remove", "double", "exchange", "lengthen", "empty", "quote"])
    if kind == "remove":
        del lines[a]
    elif kind == "double":
        lines.insert(b, lines[a])
    elif kind == "exchange":
        lines[a], lines[b] = lines[b], lines[a]
    elif kind == "lengthen":
        lines[a] *= rng.choice([2, 1000])
    elif kind == "empty":
        lines[a] = b""
    else:
        lines[a] = b'"' + lines[a]
    return b"\n".join(lines)


def nest(data: bytes, rng: random.Random) -> bytes:
    """Nest brackets or elements deeply within a text."""
    depth = rng.choice([100, 1_500, 10_000, 200_000])
    opening, closing = rng.choice([(b"[", b"]"), (b'{"a":', b"}"), (b"(", b")"), (b"<a>", b"</a>"), (b"a.", b"a = 1")])
    at = rng.choice([found.end() for found in re.finditer(rb"[\[:=,(>]", data[:100_000])])
    inner = b"" if closing != b"}" else b"1"
    return data[:at] + opening * depth + inner + closing * (1 if closing == b"a = 1" else depth) + data[at:]


def entities(data: bytes, rng: random.Random) -> bytes:
    """Add entities to an XML file that expand beyond measure, or that read a file."""
    bomb = b"<!ENTITY a0 'aaaaaaaaaa'>" + b"".join(
        b"<!ENTITY a%d '%s'>" % (i, b"&a%d;" % (i - 1) * 10) for i in range(1, 12)
    )
    inner, use = rng.choice([(bomb, b"&a11;"), (b"<!ENTITY a11 SYSTEM 'file:///etc/passwd'>", b"&a11;")])
    at = data.index(b">", data.index(b"<", 3)) + 1 if data.startswith(b"<?") else data.index(b">") + 1
    return b"<!DOCTYPE x [" + inner + b"]>" + data[:at] + use + data[at:]


# -- JSON -------------------------------------------------------------------------------------------------------------


def places(document: Any, most: int = 20_000) -> Iterator[tuple[Any, Any]]:
    """Yield (container, key) of values of a JSON document, nested ones first come, first served."""
    waiting = [document]
    while waiting and most > 0:
        one = waiting.pop()
        for key in list(one) if isinstance(one, dict) else range(min(len(one), 200)):
            yield one, key
            most -= 1
            if isinstance(one[key], dict | list):
                waiting.append(one[key])


def change_document(document: Any, rng: random.Random) -> Any:
    """Change one value, key or structure of a JSON document in place. Returns the document."""
    found = list(places(document))
    # Values in short containers are as likely as those of long arrays.
    owner, key = rng.choice(found)
    for _ in range(3):
        if len(owner) > 8:
            owner, key = rng.choice(found)
    kind = rng.choice(
        ["value"] * 6 + ["number"] * 3 + ["remove", "copy", "key", "exchange", "wrap", "lengthen", "other"]
    )
    if kind == "value":
        owner[key] = rng.choice(VALUES)
    elif kind == "number":
        numbers = [place for place in found if isinstance(place[0][place[1]], int | float)]
        owner, key = rng.choice(numbers)
        owner[key] = rng.choice([*NUMBERS, -owner[key], owner[key] * 1e6, owner[key] * 1e-6, owner[key] + 1])
    elif kind == "remove":
        del owner[key]
    elif kind == "copy":
        other, name = rng.choice(found)
        owner[key] = json.loads(json.dumps(other[name]))
    elif kind == "key" and isinstance(owner, dict):
        owner[rng.choice(["", "x", "\ud800", "__proto__", key.upper(), f"{key} ", "a" * 10_000])] = owner.pop(key)
    elif kind == "exchange":
        other, name = rng.choice(found)
        owner[key], other[name] = other[name], owner[key]
        json.dumps(document)  # a value within itself raises ValueError
    elif kind == "wrap":
        owner[key] = rng.choice([[owner[key]], {"a": owner[key]}, str(owner[key]), [owner[key]] * 3])
    elif kind == "lengthen" and isinstance(owner[key], str | list):
        owner[key] = owner[key] * rng.choice([2, 300])
    else:
        owner[key] = rng.choice(VALUES)
    return document


def change_json(data: bytes, rng: random.Random) -> bytes:
    """Change one to four values of a JSON file, or of each line of a file of JSON lines."""
    text = data.decode("utf-8-sig")
    try:
        document = json.loads(text)
    except ValueError:
        lines = text.split("\n")
        at = rng.randrange(len(lines))
        lines[at] = json.dumps(change_document(json.loads(lines[at]), rng))
        return "\n".join(lines).encode("utf-8", "surrogatepass")
    for _ in range(rng.choice([1, 1, 1, 4])):
        document = change_document(document, rng)
    text = _spelt(document, rng)
    return text.encode("utf-8", "surrogatepass")


def _spelt(document: Any, rng: random.Random) -> str:
    # 10**400 is written as text, since Python limits the digits of an integer that it writes.
    text = json.dumps(document, ensure_ascii=rng.random() < 0.7)
    if rng.random() < 0.1:  # a key given twice
        return re.sub(r'("\w+": )', lambda found: f"{found[1]}0, {found[1]}", text, count=1)
    return text


def change_whole(data: bytes, rng: random.Random) -> bytes:
    """Replace a JSON document by one of another type."""
    json.loads(data)
    return json.dumps(rng.choice(VALUES)).encode("utf-8", "surrogatepass")


def change_glb(data: bytes, rng: random.Random) -> bytes:
    """Change the JSON of a GLB file, and keep the lengths of its chunks correct."""
    size = struct.unpack_from("<I", data, 12)[0]
    text = json.dumps(change_document(json.loads(data[20 : 20 + size]), rng)).encode()
    text += b" " * (-len(text) % 4)
    rest = data[20 + size :]
    head = b"glTF" + struct.pack("<III", 2, 20 + len(text) + len(rest), len(text)) + b"JSON"
    return head + text + rest


def change_glb_numbers(data: bytes, rng: random.Random) -> bytes:
    """Overwrite numbers in the binary chunk of a GLB file."""
    size = struct.unpack_from("<I", data, 12)[0]
    begin, changed = 28 + size, bytearray(data)
    for _ in range(rng.choice([1, 10, 1000])):
        at = rng.randrange(begin, len(data) - 4) & ~3
        changed[at : at + 4] = struct.pack("<f", rng.choice([float("nan"), float("inf"), 3e38, -3e38, 1e-45, 0.0]))
    return bytes(changed)


# -- sound ------------------------------------------------------------------------------------------------------------


def change_riff(data: bytes, rng: random.Random) -> bytes:
    """Change a field of the format of a RIFF file, its samples, or the order of its chunks; lengths stay correct."""
    chunks: list[tuple[bytes, bytearray]] = []
    at = 12
    while at + 8 <= len(data):
        name, size = data[at : at + 4], struct.unpack_from("<I", data, at + 4)[0]
        chunks.append((name, bytearray(data[at + 8 : at + 8 + size])))
        at += 8 + size + size % 2
    kind = rng.choice(["format", "samples", "remove", "double", "exchange", "name", "empty"])
    k = rng.randrange(len(chunks))
    name, body = chunks[k]
    if kind == "format":
        body = dict(reversed(chunks))[b"fmt "]
        offset, code = rng.choice([(0, "<H"), (2, "<H"), (4, "<I"), (8, "<I"), (12, "<H"), (14, "<H")])
        number = rng.choice([0, 1, 2, 3, 7, 16, 24, 32, 64, 255, 65535, 0xFFFE, 48000])
        struct.pack_into(code, body, offset, number if code == "<H" else rng.choice([number, 2**31, 2**32 - 1, 10**9]))
    elif kind == "samples":
        body = dict(reversed(chunks))[b"data"]
        for _ in range(rng.choice([1, 100, 10_000])):
            offset = rng.randrange(len(body) - 4) & ~3
            struct.pack_into("<f", body, offset, rng.choice([float("nan"), float("inf"), 3e38, -3e38, 1e-45, 1e9]))
    elif kind == "remove":
        del chunks[k]
    elif kind == "double":
        chunks.insert(rng.randrange(len(chunks)), chunks[k])
    elif kind == "exchange":
        rng.shuffle(chunks)
    elif kind == "name":
        chunks[k] = rng.choice([b"data", b"fmt ", b"LIST", b"fact", b"junk", b"\0\0\0\0"]), body
    else:
        chunks[k] = name, bytearray()
    content = b"".join(name + struct.pack("<I", len(held)) + held + b"\0" * (len(held) % 2) for name, held in chunks)
    return data[:4] + struct.pack("<I", len(content) + 4) + data[8:12] + content


Damage = Callable[[bytes, random.Random], bytes]
_OF_BYTES: tuple[Damage, ...] = (flip_bits, truncate, repeat, append, change_word, swap_sides)
_OF_TEXT: tuple[Damage, ...] = (change_number, change_number, change_name, change_encoding, change_line, nest, truncate)


def _fitting(suffix: str, data: bytes) -> tuple[Damage, ...]:
    """Return the damages that fit a file, each as often as it shall be chosen."""
    if data[:4] == b"glTF":
        return (*_OF_BYTES, *(change_glb,) * 8, *(change_glb_numbers,) * 2)
    if data[:4] == b"RIFF":
        return (*_OF_BYTES, *(change_riff,) * 8)
    if data.lstrip(b"\xef\xbb\xbf \n\r\t")[:1] in (b"{", b"["):
        return (*_OF_TEXT, flip_bits, *(change_json,) * 12, change_whole)
    if data.lstrip()[:1] == b"<":
        return (*_OF_TEXT, *_OF_TEXT, flip_bits, entities)
    is_text = b"\0" not in data[:1000] and suffix not in (".bin", ".msg")
    return (*_OF_TEXT, *_OF_TEXT, flip_bits) if is_text else _OF_BYTES
