"""Ctrl-C and SIGTERM end the program quietly with status 130 or 143, wherever it is, and with the answers paid for."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest
import soundfile

from batch_server import answered
from foreground import IN_FOREGROUND
from llm_server import Asked, Scripted, serving
from small_kitchen import small_kitchen

pytestmark = pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGINT for one process")

# Python ends an interrupted program by the signal itself if the interrupt came within `exec` or `eval`; shells report
# 130 for both.
ENDS = {130, -signal.SIGINT}
PREPARED = "import sys, types; import scene2hap.__main__ as program; cli = types.ModuleType('scene2hap.cli')"
IN_CALLBACK = f"""{PREPARED}
class Waits:
    def __del__(self):
        print("ready", flush=True)
        import time
        time.sleep(1)
def run():
    import time
    Waits()
    time.sleep(60)
    return 0
cli.main = run
sys.modules["scene2hap.cli"] = cli
sys.exit(program.main())
"""
DURING_IMPORT = """import sys, time
class Finder:
    def find_spec(self, name, path, target=None):
        if name == "scene2hap.cli":
            print("ready", flush=True)
            time.sleep(60)
sys.meta_path.insert(0, Finder())
import scene2hap.__main__ as program
sys.exit(program.main())
"""


WHOLE_PROGRAM = """import sys
import scene2hap.__main__ as program
print("ready", flush=True)
sys.exit(program.main())
"""


def interrupted(
    *arguments: str, after_s: float = 0.2, with_children: bool = False, by: signal.Signals = signal.SIGINT
) -> tuple[int, str]:
    """Start Python, interrupt it some time after its first line of output, and return its status and errors.

    A terminal interrupts children as well.
    """
    command = [sys.executable, "-c", IN_FOREGROUND, *arguments]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    ) as process:
        try:
            assert process.stdout is not None
            process.stdout.readline()
            time.sleep(after_s)
            (os.killpg if with_children else os.kill)(process.pid, by)
            _, errors = process.communicate(timeout=120)
        finally:
            process.kill()
    return process.returncode, errors


@pytest.mark.parametrize("script", [DURING_IMPORT, IN_CALLBACK], ids=["during imports", "in a destructor"])
def test_an_interrupt_ends_the_program_quietly(script: str) -> None:
    status, errors = interrupted("-c", script)
    assert status in ENDS
    assert errors == "scene2hap: interrupted.\n"


def test_ctrl_break_of_windows_ends_the_program_as_sigterm_does() -> None:
    """Python knows SIGBREAK on Windows alone, where another program can send no other signal."""
    status, errors = interrupted(
        "-c", "import signal; signal.SIGBREAK = signal.SIGUSR1\n" + IN_CALLBACK, by=signal.SIGUSR1
    )
    assert (status, errors) == (143, "scene2hap: interrupted.\n")


AS_ON_WINDOWS = """import asyncio
def lacks(*_):
    raise NotImplementedError
asyncio.SelectorEventLoop.add_signal_handler = lacks
"""


@pytest.mark.parametrize(
    ("system", "by"), [("", signal.SIGTERM), (AS_ON_WINDOWS, signal.SIGINT)], ids=["posix", "windows"]
)
def test_a_bridge_ends_without_an_error(system: str, by: signal.Signals) -> None:
    """Loops of Windows take no handlers of signals: Ctrl-C ended the bridge with status 130 and an error."""
    program = system + WHOLE_PROGRAM.replace('print("ready", flush=True)\n', "")
    assert interrupted("-c", program, "bridge", "--port", "0", by=by) == (0, "")


@pytest.mark.parametrize("after_s", [0.1, 0.6, 2.0, 3.0])
def test_a_command_ends_quietly_whenever_it_is_interrupted(after_s: float, tmp_path: Path) -> None:
    """The command waits for an interrupt at its end."""
    scene = Path(__file__).parents[2] / "scene2hap" / "demo" / "kitchen.glb"
    arguments = ["bridge", "--port", "0"] if after_s > 2.5 else ["bake", str(scene), "-o", str(tmp_path / "bundle")]
    status, errors = interrupted("-c", WHOLE_PROGRAM, *arguments, after_s=after_s)
    assert status in {0, *ENDS}
    assert "Traceback" not in errors
    assert "ignored" not in errors
    assert not (tmp_path / "bundle").exists() or status == 0


BAKE_IN_WORKERS = """import sys
from scene2hap.baking.many.pool import Pool
import scene2hap.__main__ as program
run = Pool.run
async def said(self, task, *arguments):
    print("ready", flush=True)
    return await run(self, task, *arguments)
Pool.run = said
sys.exit(program.main())
"""


def test_worker_processes_end_quietly_with_the_program(tmp_path: Path) -> None:
    """Each worker printed a traceback, and bakes that had begun went on."""
    scene = Path(__file__).parents[2] / "scene2hap" / "demo" / "kitchen.glb"
    scenes = [shutil.copy(scene, tmp_path / f"kitchen_{number}.glb") for number in range(8)]
    command = ["bake-many", *map(str, scenes), "-o", str(tmp_path / "out"), "--executor", "processes:2"]
    status, errors = interrupted("-c", BAKE_IN_WORKERS, *command, after_s=3.0, with_children=True)
    assert status in ENDS
    assert errors in ("scene2hap: interrupted.\n", "scene2hap: error: interrupted; no file was left incomplete.\n")
    assert not list(tmp_path.glob("out/kitchen_7.bundle"))


CONVERSION_OF_ONE_FILE = """import sys
from scene2hap.audio.conversion import batch
import scene2hap.__main__ as program
result = batch._result
def said(*arguments):
    print("ready", flush=True)
    return result(*arguments)
batch._result = said
sys.exit(program.main())
"""


@pytest.mark.parametrize("with_children", [True, False], ids=["terminal", "kill"])
def test_conversion_ends_with_the_files_that_it_has_made(with_children: bool, tmp_path: Path) -> None:
    """The workers made all files that they had begun or were about to begin: up to five of the ten."""
    noise = np.random.default_rng(1).uniform(-0.5, 0.5, 60 * 48000)
    (tmp_path / "in").mkdir()
    soundfile.write(tmp_path / "in" / "0.wav", noise, 48000)
    for number in range(1, 10):
        shutil.copy(tmp_path / "in" / "0.wav", tmp_path / "in" / f"{number}.wav")
    command = ["convert", str(tmp_path / "in"), "-o", str(tmp_path / "out"), "--workers", "2"]
    status, errors = interrupted("-c", CONVERSION_OF_ONE_FILE, *command, after_s=0.0, with_children=with_children)
    assert status in ENDS
    assert errors == "scene2hap: error: interrupted; no file was left incomplete.\n"
    made = [path.name for path in (tmp_path / "out").iterdir()]
    assert 1 <= len(made) <= 3  # each worker may end a file before the signal comes
    assert not [name for name in made if name.startswith(".")]


IN_BACKGROUND = """import os, signal, sys
signal.signal(signal.SIGINT, signal.SIG_IGN)
os.execv(sys.executable, [sys.executable, *sys.argv[1:]])
"""


@pytest.mark.parametrize("shell", [IN_FOREGROUND, IN_BACKGROUND], ids=["foreground", "background"])
def test_sigterm_keeps_the_answers_that_are_paid_for(shell: str, tmp_path: Path) -> None:
    scene = small_kitchen(tmp_path / "kitchen.glb", "smartphone")
    began, go_on = threading.Event(), threading.Event()

    def slow(asked: Asked) -> Scripted:
        began.set()
        go_on.wait(60.0)
        return answered(asked)

    with serving(by=slow) as server:
        arguments = ["bake", str(scene), "-o", str(tmp_path / "bundle"), "--cache", str(tmp_path / "cache")]
        arguments += ["--llm", "local:scripted", "--base-url", f"{server.base_url}/v1", "--no-pictures"]
        command = [sys.executable, "-c", shell, "-c", WHOLE_PROGRAM, *arguments]
        with subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
        ) as process:
            try:
                assert began.wait(60.0)
                process.send_signal(signal.SIGTERM)
                assert process.stderr is not None
                told = process.stderr.readline()
                go_on.set()
                _, errors = process.communicate(timeout=120)
            finally:
                process.kill()
    assert process.returncode == 143
    assert "1 question to the model will be answered first" in told + errors
    assert len(list((tmp_path / "cache").glob("*.json"))) == 1
    assert len(server.asked) == 1
