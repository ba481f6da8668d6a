"""Sound files of every container, folders of sounds, and replies of sound services."""

from __future__ import annotations

import io
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from stress.hostile.reader import add, writes


def _tone(container: str, subtype: str, channels: int = 1) -> Callable[[], bytes]:
    def content() -> bytes:
        import soundfile

        t = np.arange(4800) / 8000
        samples = np.stack([0.4 * np.sin(2 * np.pi * (100 + 50 * c) * t) for c in range(channels)], axis=1)
        out = io.BytesIO()
        soundfile.write(out, samples, 8000, subtype=subtype, format=container)
        return out.getvalue()

    return content


def _converted(path: Path) -> object:
    from scene2hap.audio.conversion import convert
    from scene2hap.audio.files import read_clip

    clip = read_clip(path)
    done = convert(path, path.parent / "felt.out.wav", overwrite=True)
    return clip, done, read_clip(path.parent / "felt.out.wav").samples


for _suffix, _container, _subtype, _channels in (
    ("wav", "WAV", "PCM_16", 1), ("wav", "WAV", "FLOAT", 2), ("wav", "WAVEX", "PCM_24", 2),
    ("wav", "WAV", "IMA_ADPCM", 1), ("wav", "RF64", "PCM_16", 1), ("w64", "W64", "DOUBLE", 1),
    ("flac", "FLAC", "PCM_16", 2), ("ogg", "OGG", "VORBIS", 1), ("opus", "OGG", "OPUS", 1),
    ("mp3", "MP3", "MPEG_LAYER_III", 1), ("aiff", "AIFF", "PCM_16", 2), ("au", "AU", "ULAW", 1),
    ("caf", "CAF", "ALAC_16", 1),
):  # fmt: skip
    add(f"{_container} {_subtype}", writes(f"tone.{_suffix}", _tone(_container, _subtype, _channels)), _converted)


def _library(folder: Path) -> Path:
    (folder / "hum.wav").write_bytes(_tone("WAV", "PCM_16")())
    (folder / "sub").mkdir()
    (folder / "sub" / "fan.flac").write_bytes(_tone("FLAC", "PCM_16")())
    (folder / "sounds.csv").write_text(
        "file,keywords,title,author,licence,address\nhum.wav,fan hum,Hum,me,CC0,https://a.b/c\n"
        'sub/fan.flac,"fan, blows",Fan,you,CC BY,\n'
    )
    return folder


def _found(folder: Path) -> object:
    from scene2hap.audio.sources.library import FolderLibrary

    return FolderLibrary(folder).find(_description())


def _description() -> Any:
    from scene2hap.haptics import VibrationDescription

    return VibrationDescription("fan", "on", "A fan hums.", "fan hum", 0.5, (0.2, 0.2, 0.2))


add("sound library", _library, _found, "sounds.csv", "sounds.csv", "*.wav")


def _generated(folder: Path) -> Path:
    (folder / "a.wav").write_bytes(_tone("WAV", "PCM_16")())
    from scene2hap.audio.sources.text_to_audio.contract import CONTRACT, REPLY_NAME, VERSION

    said = {"contract": CONTRACT, "version": VERSION, "model": "m", "licence": "CC0", "files": ["a.wav"]}
    (folder / REPLY_NAME).write_text(json.dumps(said))
    return folder


def _reply_read(folder: Path) -> object:
    from scene2hap.audio.clip import Credit
    from scene2hap.audio.sources.disk_cache import Store
    from scene2hap.audio.sources.text_to_audio.contract import read_file, read_reply

    reply = read_reply(folder)
    store = Store(folder / "kept")
    return reply, [store.keep_clip(f"{i}.wav", read_file(folder, name), Credit("a", "b", "c"))
                   for i, name in enumerate(reply.files)]  # fmt: skip


add("generator's reply", _generated, _reply_read, names_file=False)


def _freesound(folder: Path) -> Path:
    sound = {
        "id": 1, "name": "Fan", "username": "me", "license": "http://creativecommons.org/publicdomain/zero/1.0/",
        "url": "https://freesound.org/s/1/", "duration": 3.0, "previews": {"preview-hq-ogg": "https://a.b/c.ogg"},
    }  # fmt: skip
    (folder / "found.json").write_text(json.dumps({"count": 1, "results": [sound, sound]}))
    return folder / "found.json"


def _searched(path: Path) -> object:
    from scene2hap.audio.sources.disk_cache import Store
    from scene2hap.audio.sources.freesound.sounds import read_sounds

    document = Store(path.parent).document(path.name)
    sounds = read_sounds(document.get("results") if isinstance(document, dict) else document) or []
    return [(sound, sound.credit("fan"), sound.licence, sound.preview) for sound in sounds]


add("Freesound", _freesound, _searched)
