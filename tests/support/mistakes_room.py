"""Run the code of usual mistakes in a small room, and write their error messages to docs/errors.md."""

from __future__ import annotations

import ast
import asyncio
import contextlib
import gc
import io
import json
import os
import shlex
import tempfile
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import soundfile

import scene2hap
from gltf_builder import Gltf
from more_mistakes import MORE_TOPICS
from scene2hap import cli, materials
from scene2hap.errors import Scene2HapError
from usual_mistakes import TOPICS, Mistake

ALL_TOPICS = {**TOPICS, **MORE_TOPICS}

TOP = (0.3, 0.75, 0.3)
"""A point on the table's top, beside the phone."""

_BOXES = {  # size and centre, y up [m]
    "table": ((1.6, 0.05, 0.8), (0.8, 0.725, 0.4)),
    "phone": ((0.08, 0.01, 0.15), (0.1, 0.755, 0.4)),
    "mug": ((0.08, 0.1, 0.08), (1.2, 0.8, 0.4)),
    "lamp": ((0.3, 1.5, 0.3), (3.0, 0.75, 3.0)),
}


class Refused(Scene2HapError):
    """The error message of a failed command line."""


class Usage(Exception):
    """The message of argparse on wrong arguments."""


class Answer(NamedTuple):
    """The outcome of a mistake: type and message of the error or warning; None and "" if the code worked."""

    kind: type[BaseException] | None = None
    sentence: str = ""

    @property
    def is_ours(self) -> bool:
        """Whether the error is a `Scene2HapError`."""
        return self.kind is not None and issubclass(self.kind, Scene2HapError)

    @property
    def is_warning(self) -> bool:
        """Whether the code worked, with a warning."""
        return self.kind is not None and issubclass(self.kind, Warning)


class Room:
    """A folder with a scene, its bundle and other files, and the names that the code may use."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        _write_glb(folder / "kitchen.glb", _BOXES)
        _write_glb(folder / "other.glb", {"chair": _BOXES["lamp"]})
        self.scene = scene2hap.load_scene(folder / "kitchen.glb")
        self.other_scene = scene2hap.load_scene(folder / "other.glb")
        self.bundle = scene2hap.bake(self.scene)
        self.bundle.save(folder / "kitchen.bundle")
        self.prefab = scene2hap.bake_object(scene2hap.SceneObject("radio", geometry=scene2hap.Box((0.2, 0.1, 0.1))))
        (folder / "settings.json").write_text(json.dumps({"session": {"propagation": "full_propagation"}}))
        (folder / "settings.toml").write_text('[session]\npropagation = "full_propagation"\n')
        (folder / "flat.toml").write_text('propagation = "full_propagation"\n')
        soundfile.write(folder / "tap.wav", np.sin(np.arange(48000) / 30) / 2, 48000)
        for name in ("photo.png", "room.blend", "room.fbx"):
            (folder / name).write_bytes(b"not a scene")

    def answer(self, code: str) -> Answer:
        """Run lines of code in the folder. Returns their outcome."""
        with _inside(self.folder), contextlib.ExitStack() as life, warnings.catch_warnings():
            names = self._names(life, code)
            warnings.simplefilter("ignore", RuntimeWarning)  # "coroutine was never awaited" is part of a mistake
            warnings.simplefilter("ignore", ResourceWarning)  # and so is a file that nobody closes
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always", UserWarning)
                try:
                    exec(code, names)
                except (Exception, asyncio.CancelledError) as error:
                    return Answer(type(error), str(error))
                finally:
                    gc.collect(0)
        ours = [one for one in caught if issubclass(one.category, UserWarning)]
        return Answer(ours[0].category, str(ours[0].message)) if ours else Answer()

    def _names(self, life: contextlib.ExitStack, code: str) -> dict[str, Any]:
        """The names that the code may use; sessions only if it does, since most code needs none."""
        names = {name: getattr(scene2hap, name) for name in vars(scene2hap)["__all__"]}
        names |= {
            "scene": self.scene,
            "other_scene": self.other_scene,
            "bundle": self.bundle,
            "TOP": TOP,
            "np": np,
            "materials": materials,
            "prefab": self.prefab,
            "PLATE": scene2hap.Plate(1.0, 0.6, 0.02, "oak"),
            "shell": shell,
        }
        if "session" in code:
            names["session"] = scene2hap.HapticSession(self.scene, self.bundle)
        if "started" in code or "sink" in code:
            names["sink"] = scene2hap.MemorySink()
            names["started"] = scene2hap.HapticSession(self.scene, self.bundle, sink=names["sink"])
            names["started"].start()
            life.callback(names["started"].stop)
        names["new_object"] = scene2hap.SceneObject(
            "vase",
            "vase",
            scene2hap.Pose((1.0, 0.8, 0.2)),
            self.scene.object("mug").geometry,
            self.scene.object("mug").surface,
        )
        return names


def shell(*arguments: str) -> None:
    """Run the command line. Raises: Refused: the command failed; Usage: its arguments are wrong."""
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()) as errors:
        try:
            status = cli.main(arguments)
        except SystemExit as end:
            status = int(end.code or 0)
    if status:
        kind = Usage if status == 2 else Refused
        raise kind(next(line for line in errors.getvalue().splitlines() if "error: " in line))


def _write_glb(path: Path, boxes: dict[str, Any]) -> None:
    gltf = Gltf()
    for name, (size, centre) in boxes.items():
        corner = [c - s / 2 for c, s in zip(centre, size, strict=True)]
        gltf.node(name, mesh=gltf.cube(), root=True, translation=corner, scale=list(size))
    gltf.write(path)


@contextlib.contextmanager
def _inside(folder: Path) -> Iterator[None]:
    before = Path.cwd()
    os.chdir(folder)
    try:
        yield
    finally:
        os.chdir(before)


def is_answered(mistake: Mistake, answer: Answer) -> bool:
    """Whether the outcome is as expected: it works, or its error or warning contains the expected words."""
    if not mistake.words:
        return answer.kind is None
    is_right_kind = answer.is_warning if mistake.is_warning else answer.is_ours or mistake.is_python
    return is_right_kind and all(word in answer.sentence for word in mistake.words)


ON_PAGE = """
load_scene('kichen.glb')
load_scene('room.blend')
bake('kitchen.bundle')
bake(scene, llm='lexicon')
HapticBundle.load('kitchen.glb')
bundle.override('phone', gain=0.5)
HapticSession(scene)
HapticSession(scene, bundle, {'propogation': 'modal_plate'})
HapticSession(scene, bundle, {'propagation': 'ModalPlate'})
session.start()
session.update({'tabel': Pose((0, 0, 0))})
session.update({'mug': (0.2, 0.8, 0)})
session.update(touches=[{'hand': 'left', 'object_id': 'table', 'point_m': TOP}])
session.update(touches=[Touch('left', 'table', (300, 750, 300))])
session.update(at_sample=4800); session.update(at_sample=10)
session.render(48000 / 90)
session.add(new_object)
session.spawn(bundle, 'x', Pose())
Touch('left', 'table', 0.3, 0.75, 0.3)
Pose((0, 0, 0), (0, 90, 0, 0))
Pose.from_yaw((0, 0, 0), 90)
SceneSnapshot.build([SceneObject('table', geometry=Box((1200, 720, 700)))])
bundle.override('mug', mass_kg=220)
session.set_source('phone', gain_db=50)
bake(scene, {'actuator': {'resonance_hz': 0.15}})
Material('wood', 700, 11, 0.3, 0.01)
materials.lookup('wod')
session.udpate({})
bundle.objects['phon']
export_bundle(bundle, 'out', 'quest')
shell('bake', 'kitchen.glb')
""".strip().splitlines()
"""The code of the mistakes that docs/errors.md shows: common ones, each with another message."""

BEGIN, END = "<!-- tests/support/mistakes_room.py writes what follows -->\n", "<!-- until here -->\n"


def page_table(room: Room) -> str:
    """The table of docs/errors.md. Raises: KeyError: a mistake that no test runs."""
    known = {_cell(mistake.code): mistake for mistakes in ALL_TOPICS.values() for mistake in mistakes}
    lines = ["", "| you write | you get |", "|---|---|"]
    for code in ON_PAGE:
        kind, sentence = room.answer(known[code].code)
        assert kind is not None, code
        if kind is Refused:
            lines.append(f"| `{_command(code)}` | {_cell(sentence)} |")
        else:
            lines.append(f"| `{code}` | `{kind.__name__}`: {_cell(sentence)} |")
    return "\n".join([*lines, "", ""])


def _command(code: str) -> str:
    """`shell('bake', 'x.glb')` as a user types it in a shell."""
    return shlex.join(["scene2hap", *ast.literal_eval(f"[{code.removeprefix('shell(').removesuffix(')')}]")])


def with_table(page: str, table: str) -> str:
    """Replace the table between the marks of a page."""
    before, rest = page.split(BEGIN)
    return before + BEGIN + table + END + rest.split(END)[1]


def _cell(text: str) -> str:
    return text.replace("|", "\\|").replace("\n", "; ").replace(";     ", "; ")


if __name__ == "__main__":
    page = Path(__file__).parents[2] / "docs" / "errors.md"
    with tempfile.TemporaryDirectory() as folder:
        page.write_text(with_table(page.read_text("utf-8"), page_table(Room(Path(folder)))), "utf-8")
