"""Sound files of hours, with wrong lengths, or without sound, for `convert`, as sound folder and as a user's clip."""

# ruff: noqa: E501  # tables of cases

from __future__ import annotations

import os
import random
import struct
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import numpy as np
import soundfile

from stress.attacks import bundles
from stress.attacks.attack import Attack, in_turn
from stress.attacks.judging import printed, wav_is_harmless


def attacks(seed: int, work: Path) -> Iterator[Attack]:
    """Attacks by a file of each kind in turn, for a use drawn from the seed. Without end."""
    room = bundles.sound(work)
    for number, kind, folder, rng in in_turn("sounds", _KINDS, seed, work):
        made = kind(folder, rng)
        use = rng.choice(["convert", "convert", "folder", "convert folder", "clip", "more", "table"])
        name = f"{number} {kind.__name__.strip('_')} as {use}"
        # Reading two minutes of sound, an accepted length, takes some seconds.
        yield Attack("sounds", name, (), call=partial(_used, made, use, work, room), seconds=8.0, untouched=(room,))


def _used(path: Path, use: str, work: Path, room: Path) -> int:
    from scene2hap.cli import main

    if use == "clip":
        return _clip(path, room)
    out, argv = Path("out"), ["convert", str(path), "-o", "out.wav", "--workers", "1"]
    if use == "more":
        argv = [
            "convert",
            str(path),
            str(path),
            "-o",
            "out",
            "--mono",
            "--picture",
            "--workers",
            "1",
            "--format",
            "flac",
        ]
    elif use == "convert folder":
        argv = ["convert", str(path.parent), "-o", "out", "--workers", "1"]
    elif use == "folder":
        argv = ["bake", str(work / "scene.json"), "-o", "out", "--sounds", str(path.parent)]
    elif use == "table":
        folder = Path("sounds")
        folder.mkdir()
        for given in path.parent.iterdir():
            (folder / given.name).symlink_to(given)
        (folder / "sounds.csv").write_text(
            f"file,keywords\n{path.name},fan humming\n../../thesis.txt,phone vibrating\n/dev/zero,phone\n"
        )
        argv = ["bake", str(work / "scene.json"), "-o", "out", "--sounds", "sounds"]
    try:
        status = main(argv)
    except SystemExit as ended:
        status = ended.code if isinstance(ended.code, int) else 1
    written = [Path("out.wav"), *out.rglob("*.wav"), *out.rglob("*.flac")]
    if not all(map(wav_is_harmless, written)):
        raise AssertionError("written samples are not finite, or outside of [-1, 1]")
    return status


def _clip(path: Path, room: Path) -> int:
    from scene2hap import HapticBundle, rebake
    from scene2hap.audio.files import read_clip
    from scene2hap.errors import Scene2HapError

    try:
        bundle = rebake(HapticBundle.load(room).override("phone", clip=read_clip(path)))
    except Scene2HapError as error:
        return printed(error)
    samples = [loop.tactile.samples for states in bundle.loops.values() for loop in states.values()]
    if not all(np.isfinite(block).all() and np.abs(block).max(initial=0.0) <= 1.0 for block in samples):
        raise AssertionError("a loop is no number, or outside of [-1, 1]")
    return 0


def _header(rate: int, channels: int, bits: int, code: int, size: int, riff: bytes = b"RIFF") -> bytes:
    align = channels * bits // 8
    rest = struct.pack("<HHIIHH", code, channels & 0xFFFF, rate, rate * align & 0xFFFFFFFF, align & 0xFFFF, bits)
    return (
        riff
        + struct.pack("<I", 0xFFFFFFFF)
        + b"WAVEfmt "
        + struct.pack("<I", 16)
        + rest
        + b"data"
        + struct.pack("<I", size)
    )


def _lying_wave(folder: Path, rng: random.Random) -> Path:
    rate, channels = rng.choice([0, 1, 7, 8000, 192_000, 10**9, 2**32 - 1]), rng.choice([0, 1, 2, 255, 1024, 65_535])
    bits, code = rng.choice([0, 1, 8, 16, 24, 32, 64, 999]), rng.choice([1, 3, 2, 6, 17, 0xFFFE, 0x55])
    size = rng.choice([0, 1, 2**31, 2**32 - 1])
    path = folder / "fan humming.wav"
    path.write_bytes(
        _header(rate, channels, bits, code, size, rng.choice([b"RIFF", b"RIFX", b"RF64"]))
        + rng.randbytes(rng.choice([0, 3, 99_999]))
    )
    return path


def _sparse_wave(folder: Path, rng: random.Random) -> Path:
    """A sparse file of hours of zeros, which takes no disk space."""
    path = folder / "fan humming.wav"
    path.write_bytes(_header(rng.choice([8000, 48_000]), rng.choice([1, 8]), 16, 1, 2**32 - 100))
    os.truncate(path, rng.choice([2**28, 2**32, 2**36]))
    return path


def _odd_floats(folder: Path, rng: random.Random) -> Path:
    value = rng.choice([float("nan"), float("inf"), -float("inf"), 1e38, 1e-45, 1e300, -2.0])
    samples = np.zeros(48_000 * 4)
    samples[:: rng.choice([1, 100, 10**5])] = value
    path = folder / "fan humming.wav"
    with np.errstate(over="ignore"):
        soundfile.write(path, samples, 48_000, subtype=rng.choice(["DOUBLE", "FLOAT"]))
    return path


def _flac(path: Path, rate: int, channels: int, seconds: float) -> Path:
    with soundfile.SoundFile(path, "w", rate, channels, "PCM_16", format="FLAC") as file:
        block, left = np.zeros((1 << 20, channels), np.int16), int(rate * seconds)
        while left > 0:
            file.write(block[:left])
            left -= len(block)
    return path


def _long_flac(folder: Path, rng: random.Random) -> Path:
    rate, channels, hours = rng.choice(
        [(1000, 1, 12.0), (8000, 1, 3.0), (8000, 8, 1.0), (96_000, 2, 0.2), (655_350, 8, 0.02)]
    )
    return _flac(folder / "fan humming.flac", rate, channels, hours * 3600)


def _claiming_flac(folder: Path, rng: random.Random) -> Path:
    """A FLAC file whose STREAMINFO states up to 2^36 - 1 samples, none, or another rate."""
    path = _flac(folder / "fan humming.flac", 48_000, 1, 4.0)
    data = bytearray(path.read_bytes())
    word = int.from_bytes(data[18:26], "big")
    if rng.random() < 0.6:
        word = word & ~(2**36 - 1) | rng.choice([2**36 - 1, 0, 1, 2**31, 10**10])
    else:
        word = word & (2**44 - 1) | rng.choice([0, 1, 655_350, 2**20 - 1]) << 44
    data[18:26] = word.to_bytes(8, "big")
    path.write_bytes(data)
    return path


def _long_ogg(folder: Path, rng: random.Random) -> Path:
    path = folder / "fan humming.ogg"
    with soundfile.SoundFile(path, "w", 8000, 1, "VORBIS", format="OGG") as file:
        for _ in range(rng.choice([1, 60])):
            file.write(np.zeros(8000 * 10, np.float32))
    data = bytearray(path.read_bytes())
    if rng.random() < 0.7:
        at = data.rfind(b"OggS")
        data[at + 6 : at + 14] = struct.pack("<q", rng.choice([2**62, -1, 0, 2**40]))
        path.write_bytes(data)
    return path


def _long_mp3(folder: Path, rng: random.Random) -> Path:
    path = folder / "fan humming.mp3"
    with soundfile.SoundFile(path, "w", 8000, 1, "MPEG_LAYER_III", format="MP3") as file:
        for _ in range(rng.choice([1, 360])):
            file.write(np.zeros(8000 * 10, np.float32))
    data = path.read_bytes()
    kind = rng.choice(["as it is", "tag", "frames", "junk"])
    if kind == "tag":
        data = b"ID3\x04\0\0\x7f\x7f\x7f\x7f" + data
    elif kind == "frames":
        at = data.find(b"Xing") if b"Xing" in data else data.find(b"Info")
        if at > 0:
            data = data[: at + 8] + b"\xff" * 8 + data[at + 16 :]
    elif kind == "junk":
        data = data[:200] + rng.randbytes(200_000) + data[200:]
    path.write_bytes(data)
    return path


def _other_formats(folder: Path, rng: random.Random) -> Path:
    """Formats that libsndfile reads by content, under any file name."""
    kind, subtype = rng.choice(
        [
            ("AIFF", "PCM_16"),
            ("W64", "PCM_16"),
            ("CAF", "PCM_16"),
            ("AU", "FLOAT"),
            ("RF64", "DOUBLE"),
            ("MAT5", "DOUBLE"),
            ("PAF", "PCM_16"),
        ]
    )
    path = folder / f"fan humming.{rng.choice(['wav', 'flac', 'ogg', 'mp3', 'raw', 'aiff'])}"
    soundfile.write(path, np.zeros((4000, 2)), 8000, subtype=subtype, format=kind)
    data = bytearray(path.read_bytes())
    for _ in range(rng.choice([0, 4, 60])):
        data[rng.randrange(min(100, len(data)))] = rng.choice([0, 255, 127])
    path.write_bytes(data)
    return path


def _short(folder: Path, rng: random.Random) -> Path:
    path = folder / "fan humming.wav"
    soundfile.write(
        path,
        np.full((rng.choice([0, 1, 2, 9, 100]), rng.choice([1, 2])), 0.5),
        rng.choice([1, 100, 8000, 48_000]),
        subtype="PCM_16",
    )
    return path


def _rates(folder: Path, rng: random.Random) -> Path:
    """Valid sounds of unusual rates and many channels."""
    rate, channels = rng.choice([(1, 1), (50, 2), (2000, 1), (10**6, 1), (2**31 - 1, 1), (48_000, 64), (48_000, 1024)])
    path = folder / "fan humming.wav"
    soundfile.write(path, np.random.default_rng(0).uniform(-1, 1, (20_000, channels)), rate, subtype="PCM_16")
    return path


def _no_sound(folder: Path, rng: random.Random) -> Path:
    path = folder / "fan humming.wav"
    kind = rng.choice(["pipe", "zero", "folder", "loop", "nowhere", "empty", "text", "dark", "null"])
    if kind == "pipe":
        os.mkfifo(path)
    elif kind in ("zero", "null"):
        path.symlink_to(f"/dev/{kind}")
    elif kind == "folder":
        path.mkdir()
    elif kind == "loop":
        path.symlink_to(path)
        (folder / "within").symlink_to(folder)
    elif kind == "nowhere":
        path.symlink_to("nowhere")
    else:
        path.write_bytes(b"" if kind == "empty" else b"\0" * 10**6 if kind == "dark" else b"a,b\n" * 10**5)
    return path


def _many(folder: Path, rng: random.Random) -> Path:
    """A folder of thousands of files, or of odd names."""
    first = folder / "fan humming.wav"
    soundfile.write(first, np.full(200, 0.5), 8000, subtype="PCM_16")
    if rng.random() < 0.5:
        for number in range(2000):
            os.link(first, folder / f"fan humming {number}.wav")
    else:
        for name in (
            b"fan \xff.wav",
            b"fan \x1b[2J.wav",
            b"fan\nhum.wav",
            b"-o.wav",
            b"FAN HUMMING.wav",
            "fan é.wav".encode(),
            b"fan" * 60 + b".wav",
        ):
            os.link(os.fsencode(first), os.fsencode(folder) + b"/" + name)
    return first


_KINDS: tuple[Callable[[Path, random.Random], Path], ...] = (
    _lying_wave, _sparse_wave, _odd_floats, _long_flac, _claiming_flac, _long_ogg, _long_mp3, _other_formats, _short, _rates, _no_sound, _many,
)  # fmt: skip
