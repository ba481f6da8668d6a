"""The client for C#, compiled by Mono."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
CLIENT = ROOT / "clients" / "csharp"
TRIALS = ROOT / "tests" / "integration" / "bridge"
COMPILER, RUNTIME = shutil.which("mcs"), shutil.which("mono")
needs_csharp = pytest.mark.skipif(
    COMPILER is None or RUNTIME is None, reason="no C#; apt-get install --no-install-recommends mono-mcs (7 MB)"
)


def build_programs(folder: Path) -> Path:
    """Compile the example as a game would, and the trials with the Unity component on stubs of Unity."""
    client = [str(CLIENT / f"Scene2Hap{name}.cs") for name in ("Client", "Connection", "Frames", "Json", "WebSocket")]
    own = [str(TRIALS / name) for name in ("unity_stubs.cs", "csharp_trials.cs")]
    # Language version 6, which Unity and all other compilers accept.
    compiler = [str(COMPILER), "-langversion:6", "-warnaserror", "-warn:4"]
    subprocess.run([*compiler, f"-out:{folder / 'game.exe'}", str(CLIENT / "ExampleGame.cs"), *client], check=True)
    unity = ["-define:UNITY_5_3_OR_NEWER", str(CLIENT / "Scene2HapBehaviour.cs"), str(CLIENT / "ExampleGame.cs")]
    subprocess.run([*compiler, f"-out:{folder / 'trials.exe'}", *unity, *client, *own], check=True)
    return folder


def run_trial(
    programs: Path, *arguments: object, given: str = "", token: str = "", timeout_s: float = 120.0
) -> list[str]:
    """Run a trial to its end. Returns its output lines."""
    command = [str(RUNTIME), str(programs / "trials.exe"), *map(str, arguments)]
    # A small nursery, so that little garbage triggers a collection.
    environment = {**os.environ, "SCENE2HAP_TOKEN": token, "MONO_GC_PARAMS": "nursery-size=512k"}
    done = subprocess.run(
        command, input=given, capture_output=True, text=True, timeout=timeout_s, env=environment, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout.splitlines()
