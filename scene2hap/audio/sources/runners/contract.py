"""Shared part of all runners: read the request, write sounds and the reply, rehearse without a model.

It uses only the standard library of Python 3.9 on, since runners run in the environments of their models, where
scene2hap is not installed. The contract is described in docs/sound-sources.md.
"""

from __future__ import annotations

import argparse
import array
import hashlib
import importlib.util
import json
import math
import os
import platform
import sys
import tempfile
import wave
from collections.abc import Callable, Sequence
from typing import Any

CONTRACT = "scene2hap/text-to-audio"
VERSION = 1
LONGEST_S = 60.0
MOST = 5


class RequestError(Exception):
    """A request that cannot be read."""


class Request:
    """A request for `count` takes of `duration_s` [s], described by `prompt`, repeatable by `seed`."""

    def __init__(self, document: Any) -> None:
        if not isinstance(document, dict) or document.get("contract") != CONTRACT:
            raise RequestError(f"this is no request of {CONTRACT}")
        if document.get("version") != VERSION:
            raise RequestError(f"version is {document.get('version')!r}; this runner speaks version {VERSION}")
        try:
            self.prompt: str = str(document["prompt"])
            self.count: int = int(document["count"])
            self.duration_s: float = float(document["duration_s"])
            self.seed: int = int(document["seed"])
        except (KeyError, TypeError, ValueError) as cause:
            raise RequestError(f"the request lacks or misuses {cause}") from cause
        if not (1 <= self.count <= MOST and 0.0 < self.duration_s <= LONGEST_S):
            raise RequestError(f"count must be 1 to {MOST}, duration_s above 0 and at most {LONGEST_S:g}")


# Python 3.9 evaluates these, so the types are plain: a take is a list of channels of samples in [-1, 1].
Takes = Sequence[Sequence[Sequence[float]]]
Generate = Callable[[Request, argparse.Namespace], "tuple[int, Takes]"]


def main(
    description: str, licence: str, address: str, packages: Sequence[str], generate: Generate, default_model: str
) -> int:
    """Read the command line, make the sounds, write the reply. Returns: the exit status.

    `generate` returns the sample rate [Hz] and the takes. It imports the model's `packages` itself, so that all other
    functions work without them.
    """
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("request", nargs="?", help="the request, a JSON file")
    parser.add_argument("folder", nargs="?", help="an empty folder for the sounds and reply.json")
    parser.add_argument("--model", default=default_model, help="default: %(default)s")
    parser.add_argument("--device", default="", help="such as cuda, cuda:1 or cpu; default: as the library picks")
    parser.add_argument("--rehearse", action="store_true", help="make tones and load no model")
    parser.add_argument("--check", action="store_true", help="rehearse in a temporary folder, say what is missing, end")
    arguments = parser.parse_args()
    origin = {"model": arguments.model, "licence": licence, "address": address}
    if arguments.check:
        return check(origin, packages)
    if arguments.request is None or arguments.folder is None:
        parser.error("a request and a folder are needed (or --check)")
    if arguments.rehearse:
        origin = {"model": f"rehearsal of {arguments.model}", "licence": "CC0-1.0", "address": ""}
    return serve(arguments, origin, tones if arguments.rehearse else generate)


def serve(arguments: argparse.Namespace, origin: dict[str, str], make: Generate) -> int:
    """Answer one request. Returns: status 0 with sounds, 1 with an error; a reply is written in both cases."""
    reply: dict[str, Any] = {"contract": CONTRACT, "version": VERSION}
    status = 0
    try:
        with open(arguments.request, encoding="utf-8") as file:
            request = Request(json.load(file))
        rate, takes = make(request, arguments)
        names = []
        for index, take in enumerate(takes):
            names.append(f"{index}.wav")
            write_wav(os.path.join(arguments.folder, names[-1]), take, int(rate))
        reply.update(origin, files=names)
    except Exception as cause:  # whatever a model's library raises
        reply["error"] = f"{type(cause).__name__}: {cause}"
        print(reply["error"], file=sys.stderr)
        status = 1
    write_reply(arguments.folder, reply)
    return status


def write_reply(folder: str, reply: dict[str, Any]) -> None:
    """Write the reply, whole or not at all. It is written last."""
    draft = os.path.join(folder, "reply.json.part")
    with open(draft, "w", encoding="utf-8") as file:
        json.dump(reply, file, indent=1)
    os.replace(draft, os.path.join(folder, "reply.json"))


def write_wav(path: str, channels: Sequence[Sequence[float]], rate: int) -> None:
    """Write a take in 16 bits. A take beyond full scale is scaled down; one that is not finite is an error."""
    if not channels or not channels[0] or not all(math.isfinite(sum(channel)) for channel in channels):
        raise ValueError("the model made a take that is empty or not finite")
    peak = max(max(map(abs, channel)) for channel in channels)
    scale = 32767.0 / max(peak, 1.0)
    interleaved = array.array("h", bytes(2 * len(channels) * len(channels[0])))
    for index, channel in enumerate(channels):
        interleaved[index :: len(channels)] = array.array("h", [round(scale * sample) for sample in channel])
    if sys.byteorder == "big":
        interleaved.byteswap()
    with wave.open(path, "wb") as file:
        file.setnchannels(len(channels))
        file.setsampwidth(2)
        file.setframerate(rate)
        file.writeframes(interleaved.tobytes())


def tones(request: Request, arguments: argparse.Namespace) -> tuple[int, Takes]:
    """Return takes for --rehearse: hums of four partials, whose pitch follows from prompt, seed and take."""
    rate = 16000
    takes = []
    for index in range(request.count):
        seed = f"{request.prompt}/{request.seed}/{index}".encode()
        turn = 2.0 * math.pi * (60.0 + hashlib.sha256(seed).digest()[0] / 2.0) / rate
        n = round(request.duration_s * rate)
        takes.append([[0.2 * sum(math.sin(k * turn * i) / k for k in (1, 2, 3, 4)) for i in range(n)]])
    return rate, takes


def check(origin: dict[str, str], packages: Sequence[str]) -> int:
    """Serve a request with tones, and print the result and missing packages as JSON."""
    missing = [name for name in packages if importlib.util.find_spec(name) is None]
    with tempfile.TemporaryDirectory() as folder:
        request = os.path.join(folder, "request.json")
        document = {
            "contract": CONTRACT,
            "version": VERSION,
            "prompt": "a hum",
            "count": 1,
            "duration_s": 0.5,
            "seed": 0,
        }
        with open(request, "w", encoding="utf-8") as file:
            json.dump(document, file)
        status = serve(argparse.Namespace(request=request, folder=folder), origin, tones)
    found: dict[str, Any] = {"contract": CONTRACT, "version": VERSION, "python": platform.python_version(), **origin}
    print(json.dumps({**found, "missing": missing, "rehearsal": "failed" if status else "passed"}, indent=1))
    return status
