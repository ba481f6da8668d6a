"""API keys that a server, a library or a program repeats in other encodings: no shown or stored text may reveal one."""

# ruff: noqa: E501  # tables of cases

from __future__ import annotations

import base64
import binascii
import html
import itertools
import json
import random
import urllib.parse
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

from stress.attacks.attack import Attack

KEY = "sk-attack-0123456789/abcdef+ghij=="
Spelling = Callable[[str], str]


def _folded(text: str, width: int, end: str = "\n") -> str:
    return end.join(text[at : at + width] for at in range(0, len(text), width))


def _base64(data: bytes) -> str:
    return base64.b64encode(data).decode()


SPELLINGS: dict[str, Spelling] = {
    "plain": str, "upper": str.upper, "lower": str.lower, "swapped case": str.swapcase, "reversed": lambda k: k[::-1],
    "percent": lambda k: urllib.parse.quote(k, safe=""), "percent of all": lambda k: "".join(f"%{ord(c):02X}" for c in k),
    "percent twice": lambda k: urllib.parse.quote(urllib.parse.quote(k, safe=""), safe=""),
    "percent of all twice": lambda k: "".join(f"%25{ord(c):02x}" for c in k),
    "base64": lambda k: _base64(k.encode()), "base64 with Bearer": lambda k: _base64(f"Bearer {k}".encode()),
    "base64 of a pair": lambda k: _base64(f"user:{k}".encode()), "base64 within JSON": lambda k: _base64(json.dumps({"a": k, "b": 1}).encode()),
    "base64 url-safe": lambda k: base64.urlsafe_b64encode(b"??" + k.encode() + b">>").decode(), "base64 url-safe bare": lambda k: base64.urlsafe_b64encode(k.encode()).decode().rstrip("="),
    "base64 folded at 76": lambda k: _folded(_base64(b"x" * 50 + k.encode() + b"y" * 50), 76), "base64 folded CRLF": lambda k: _folded(_base64(b"x" * 51 + k.encode() * 2), 64, "\r\n"),
    "base64 folded at 8": lambda k: _folded(_base64(k.encode()), 8), "base64 folded as JSON": lambda k: _folded(_base64(b"x" * 9 + k.encode()), 32, "\\n"),
    "base64 percent": lambda k: urllib.parse.quote(_base64(k.encode()), safe=""), "base64 twice": lambda k: _base64(_base64(k.encode()).encode()),
    "base64 of UTF-16": lambda k: _base64(k.encode("utf-16")), "base64 of UTF-16-LE": lambda k: _base64(k.encode("utf-16-le")), "base64 of UTF-16-BE": lambda k: _base64(k.encode("utf-16-be")),
    "base64 of UTF-32": lambda k: _base64(k.encode("utf-32")), "base64 of reversed": lambda k: _base64(k[::-1].encode()), "base64 of hex": lambda k: _base64(k.encode().hex().encode()),
    "base32": lambda k: base64.b32encode(k.encode()).decode(), "base32 lower": lambda k: base64.b32encode(k.encode()).decode().lower().rstrip("="), "base85": lambda k: base64.b85encode(k.encode()).decode(), "ascii85": lambda k: base64.a85encode(k.encode()).decode(),
    "hex": lambda k: k.encode().hex(), "HEX": lambda k: k.encode().hex().upper(), "hex with colons": lambda k: k.encode().hex(":"), "hex with blanks": lambda k: k.encode().hex(" "),
    "hex with 0x": lambda k: ", ".join(f"0x{b:02x}" for b in k.encode()), "hex of UTF-16": lambda k: k.encode("utf-16-le").hex(), "hex of base64": lambda k: _base64(k.encode()).encode().hex(), "hex of reversed": lambda k: k[::-1].encode().hex(),
    "hexdump": lambda k: "\n".join(f"{at:08x}  {k.encode()[at : at + 16].hex(' ')}  |................|" for at in range(0, len(k), 16)),
    "quoted-printable": lambda k: binascii.b2a_qp(k.encode()).decode(), "quoted-printable of all": lambda k: "".join(f"={ord(c):02X}" for c in k), "quoted-printable soft breaks": lambda k: _folded(k.replace("=", "=3D"), 7, "=\n"), "MIME word": lambda k: f"=?utf-8?B?{_base64(k.encode())}?=",
    "JSON": lambda k: json.dumps(k), "JSON of all": lambda k: "".join(f"\\u{ord(c):04x}" for c in k), "JSON of all twice": lambda k: "".join(f"\\\\u{ord(c):04x}" for c in k), "JSON of slashes": lambda k: k.replace("/", "\\/"),
    "JSON in JSON in JSON": lambda k: json.dumps(json.dumps(json.dumps({"k": "\\" + k}))), "\\x": lambda k: "".join(f"\\x{ord(c):02x}" for c in k), "octal": lambda k: "".join(f"\\{ord(c):03o}" for c in k), "\\u{}": lambda k: "".join(f"\\u{{{ord(c):x}}}" for c in k), "\\U": lambda k: "".join(f"\\U{ord(c):08x}" for c in k),
    "repr of bytes": lambda k: repr(k.encode()), "repr of UTF-16": lambda k: repr(k.encode("utf-16-le")), "UTF-16 as text": lambda k: k.encode("utf-16-le").decode("latin-1"), "list of codes": lambda k: str(list(k.encode())), "list of letters": lambda k: str(list(k)),
    "HTML": html.escape, "HTML of all": lambda k: "".join(f"&#{ord(c)};" for c in k), "HTML of all, hex": lambda k: "".join(f"&#x{ord(c):X};" for c in k), "HTML twice": lambda k: html.escape("".join(f"&#{ord(c)};" for c in k)), "HTML names": lambda k: k.replace("/", "&sol;").replace("+", "&plus;").replace("=", "&equals;").replace("-", "&hyphen;"),
    "split over lines": lambda k: _folded(k, 10), "split CRLF": lambda k: _folded(k, 10, "\r\n"), "split with blanks": lambda k: " ".join(k), "split and indented": lambda k: _folded(k, 10, "\n    "), "split by zero width": lambda k: "\u200b".join(k), "split by soft hyphens": lambda k: "\u00ad".join(k), "split by escapes": lambda k: "\x1b[0m".join(k), "split by NUL": lambda k: "\0".join(k),
    "full width": lambda k: "".join(chr(ord(c) + 0xFEE0) for c in k), "rot13": lambda k: __import__("codecs").encode(k, "rot13"), "quoted list": lambda k: '", "'.join(k), "plus for blank": lambda k: urllib.parse.quote_plus(k), "backslash each": lambda k: "".join("\\" + c for c in k),
    "cut at the end": lambda k: k[:-1], "cut at the start": lambda k: k[1:], "without padding": lambda k: k.rstrip("="), "dashes": lambda k: k.replace("/", "-").replace("+", "_"), "gzip in base64": lambda k: _base64(__import__("gzip").compress(k.encode())), "zlib in hex": lambda k: __import__("zlib").compress(k.encode()).hex(), "JWT": lambda k: f"{base64.urlsafe_b64encode(b'{}').decode()}.{base64.urlsafe_b64encode(json.dumps({'sub': k}).encode()).decode()}.x",
    "uuencode": lambda k: binascii.b2a_uu(k.encode()).decode(), "punycode": lambda k: k.encode("punycode").decode(), "utf-7": lambda k: k.encode("utf-7").decode(), "binary": lambda k: " ".join(f"{b:08b}" for b in k.encode()),
}  # fmt: skip

NOT_COVERED = frozenset({"base85", "ascii85", "uuencode", "rot13", "gzip in base64", "zlib in hex", "hexdump"})
"""Encodings with punctuation, ciphers, compression, and lines of 16 bytes. See `scene2hap.common.key_search`."""
AROUND: dict[str, tuple[str, str]] = {
    "bare": ("", ""), "sentence": ("Incorrect API key provided: ", ". You can find yours at"), "quoted": ('{"error": "', '"}'), "letters": ("abc", "xyz"), "tag": ("<b>", "</b>"),
    "digits": ("12", "34"), "header": ("authorization: Bearer ", "\r\n"), "long": ("word " * 4000, " word" * 4000), "percent": ("%", "%"), "slashes": ("\\" * 9, "\\" * 9), "brackets": ("[b'", "', None]"),
}  # fmt: skip


def attacks(seed: int, work: Path) -> Iterator[Attack]:
    """Attacks by every covered spelling, combined ones included, each in random surroundings. Without end."""
    names = [name for name in SPELLINGS if name not in NOT_COVERED]
    for number in itertools.count():
        rng = random.Random(f"keys/{seed}/{number}")
        name, around = names[number % len(names)], rng.choice(list(AROUND))
        yield Attack("keys", f"{number} {name} ({around})", (), call=partial(scrubbed, name, around))


def shown(name: str, around: str) -> str:
    """Text with a key in a spelling, after scrubbing."""
    from scene2hap.common.secret import Secret

    before, after = AROUND[around]
    return Secret(KEY).scrub(before + SPELLINGS[name](KEY) + after)


def is_shown(name: str, text: str) -> bool:
    """Whether a text still contains half of the spelled key, or more."""
    spelled = SPELLINGS[name](KEY)
    half = len(spelled) // 2
    return any(spelled[at : at + half] in text for at in range(len(spelled) - half + 1))


def scrubbed(name: str, around: str) -> int:
    """Scrub a key. Returns 0. Raises: AssertionError: the key is shown."""
    if is_shown(name, shown(name, around)):
        raise AssertionError(f"the key is shown, {name} in {around}")
    return 0
