"""The command line itself: invalid arguments, folders of other programs, and output streams that are closed or full."""

from __future__ import annotations

import itertools
import json
import os
import random
import shlex
import sys
from collections.abc import Iterator
from pathlib import Path

from stress.attacks import bundles
from stress.attacks.attack import Attack

_NUMBERS = ("nan", "inf", "-inf", "-1", "0", "1e400", "1e-400", "9" * 5000, "", "x", "²", "1_000", "0x10", "٣")
# None of these paths is outside of the case's folder and writable for the user who runs the campaign.
_WORDS = (
    "", " ", "-", "--", "\n", "\x1b[2J", "é" * 300, "a" * 5000, "/dev/null", "/dev/full",
    "{", '{"kind": 1}', "{" * 2000, "[]", "null", "no:such", "http://", "kind:\ud800", ".", "~",
    "$HOME", "*", "CON", "NUL", "scene.json", "room", "thesis", "bundle.json",
)  # fmt: skip
_OPTIONS = {
    "bake": ("-o", "--prompt", "--llm", "--base-url", "--max-cost", "--cache", "--sounds", "--settings", "--unit-m",
             "--assets-root", "--up-axis", "--group", "--dry-run", "--json", "-q"),
    "inspect": ("--pictures", "--unit-m", "--assets-root", "--up-axis", "--group", "--json"),
    "report": ("--json", "-q"),
    "convert": ("-o", "--converter", "--actuator", "--intensity", "--format", "--workers", "--mono", "--json"),
    "render": ("-o", "--settings", "--json"),
    "play": ("--settings", "--json"),
    "demo": ("--no-such", "--help"),
}  # fmt: skip
_REDIRECTIONS = (
    "> /dev/full", "2> /dev/full", "> /dev/full 2>&1", ">&-", "2>&-", "<&-", "<&- >&- 2>&-", "| head -c 1", "| true",
    "2>&1 | head -c 1", "> /dev/null",
)  # fmt: skip


def attacks(seed: int, work: Path) -> Iterator[Attack]:
    """Attacks by streams, arguments and output folders, in turn. Without end."""
    room = bundles.sound(work)
    for number in itertools.count():
        rng = random.Random(f"command_line/{seed}/{number}")
        yield (_streams, _arguments, _arguments, _places)[number % 4](number, rng, work, room)


def _arguments(number: int, rng: random.Random, work: Path, room: Path) -> Attack:
    command = rng.choice(list(_OPTIONS))
    words = [command]
    good = [str(work / "scene.json"), str(room)]
    words += rng.choices([*good, *good, *_WORDS], k=rng.choice([0, 1, 1, 2]))
    for option in rng.choices(_OPTIONS[command], k=rng.choice([0, 1, 2])):
        words.append(option)
        if option not in ("--json", "-q", "--mono", "--dry-run", "--help", "--no-such"):
            words.append(rng.choice([*_NUMBERS, *_WORDS, *good]))
    return Attack("command_line", f"{number} {shlex.join(words)[:80]!a}", ("scene2hap", *words), untouched=(room,))


def _places(number: int, rng: random.Random, work: Path, room: Path) -> Attack:
    """Folders with files of a user, given as the output folder of a bake."""
    folder = work / str(number) / "thesis"
    folder.mkdir(parents=True)
    (folder / "chapter.txt").write_text("ten years")
    (folder / "figures").mkdir()
    kind = rng.choice(["foreign", "list", "damaged", "newer", "none", "link", "file", "pipe", "here", "named"])
    target = str(folder)
    if kind in ("foreign", "list", "damaged", "newer"):
        newer = json.dumps({"format": "scene2hap/bundle", "version": 2, "files": ["chapter.txt"]})
        said = {"foreign": '{"name": "app"}', "list": "[1]", "damaged": '{"format": "scene2hap/bun', "newer": newer}
        (folder / "bundle.json").write_text(said[kind])
    elif kind == "link":
        (work / str(number) / "link").symlink_to(folder)
        target = str(work / str(number) / "link")
    elif kind == "file":
        target = str(folder / "chapter.txt")
    elif kind == "pipe":
        os.mkfifo(folder / "bundle.json")
    elif kind == "here":
        target = "."
    elif kind == "named":
        target = str(folder / "chapter.txt" / rng.choice(["x", "../y/..", "x" * 300]))
    argv = ("scene2hap", "bake", str(work / "scene.json"), "-o", target)
    return Attack("command_line", f"{number} bake over {kind}", argv, untouched=(work / str(number),))


def _streams(number: int, rng: random.Random, work: Path, room: Path) -> Attack:
    words = rng.choice([["inspect", str(room)], ["inspect", str(room), "--json"], ["report", str(room)], ["--help"],
                        ["--version"], ["inspect", "nowhere"], ["no-such"], []])  # fmt: skip
    encoding = rng.choice(["utf-8", "cp1252", "ascii", "shift_jis", "latin-1"])
    where = rng.choice(_REDIRECTIONS)
    run = shlex.join([sys.executable, "-m", "scene2hap", *words])
    unbuffered = rng.choice(["", "1"])
    # By default a pipeline returns the status of its last command, the reader, which does not matter here.
    shell = f"export PYTHONIOENCODING={encoding} PYTHONUNBUFFERED={unbuffered}; set -o pipefail; {run} {where}"
    # If standard error is closed or full, scene2hap cannot print its error message.
    message = "; status=$?; case $status in 1 | 2) echo 'scene2hap: error: as stated' >&2;; esac; exit $status"
    name = f"{number} {words[:1]} {where} {encoding}"
    return Attack("command_line", name, ("bash", "-c", shell + message), untouched=(room,))
