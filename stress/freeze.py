"""Freeze a game with PyInstaller, and run it in another folder without an environment. Takes minutes.

    python stress/freeze.py [--onefile]

Needs PyInstaller, and scene2hap installed from a wheel (`pip install .`): PyInstaller finds hooks by the entry points
of installed packages. The game bakes at its first start. It fails unless every compiled kernel of the build is used.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

GAME = """
import sys
from scene2hap import Box, HapticBundle, HapticSession, Pose, SceneObject, SceneSnapshot, Touch, WavSink, bake
from scene2hap.compiled import KERNELS
from scene2hap.demo import kitchen_path

assert kitchen_path().is_file()
objects = [SceneObject("wooden table", pose=Pose((0.0, 0.37, 0.0)), geometry=Box((1.4, 0.74, 0.8))),
           SceneObject("smartphone", pose=Pose((0.2, 0.744, 0.1)), geometry=Box((0.07, 0.008, 0.15)))]
bake(SceneSnapshot.build(objects, name="table")).save("game.bundle")
for model in ("exponential_plate", "modal_plate"):
    sink = WavSink(f"{model}.wav")
    with HapticSession(HapticBundle.load("game.bundle"), config={"propagation": model}, sink=sink) as session:
        session.wait_prepared()
        assert session.update(touches=[Touch("left", "wooden table", (0.3, 0.74, 0.1))]).gain("left", "smartphone") > 0
        sink.pull_s(1)
plain = [name for name, (_, twin) in KERNELS.items() if twin is None]
assert len(plain) == (0 if sys.argv[1] == "compiled" else len(KERNELS)), plain
print(len(KERNELS), "kernels,", sys.argv[1], "and", "frozen" if sys.frozen else "not frozen")
"""


def main() -> None:
    """Freeze and run."""
    from scene2hap.compiled import are_in_use

    with TemporaryDirectory() as folder:
        work, away = Path(folder) / "work", Path(folder) / "away"
        work.mkdir()
        away.mkdir()
        (work / "game.py").write_text(GAME)
        freeze = [sys.executable, "-m", "PyInstaller", "--log-level", "WARN", *sys.argv[1:], "game.py"]
        subprocess.run(freeze, cwd=work, check=True)
        program = next(path for path in (work / "dist").rglob("game*") if path.is_file())
        subprocess.run([program, "compiled" if are_in_use() else "plain"], cwd=away, env={}, check=True)


if __name__ == "__main__":
    main()
