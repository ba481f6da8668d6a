"""Make the pictures of docs/gallery.md from the built-in kitchen and the examples: python docs/pictures/make.py

Needs: pip install 'scene2hap[mujoco,panda3d,plots]', and OpenGL for MuJoCo; without a display, set MUJOCO_GL=egl.
Pictures are small, since they are kept in the repository.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import soundfile
from matplotlib.figure import Figure
from PIL import Image

from scene2hap import HapticSession, bake, load_scene
from scene2hap.demo import kitchen_path

HERE = Path(__file__).parent
EXAMPLES = HERE.parents[1] / "examples"
WIDTH_PX = 900
COLOURS = 64


def shrink(path: Path, name: str) -> None:
    """Save a picture again, narrower and with few colours."""
    picture = Image.open(path).convert("RGB")
    if picture.width > WIDTH_PX:
        picture = picture.resize((WIDTH_PX, round(picture.height * WIDTH_PX / picture.width)), Image.Resampling.LANCZOS)
    picture.quantize(COLOURS, dither=Image.Dither.NONE).save(HERE / name, optimize=True)


def run(script: str, *arguments: str) -> None:
    """Run an example."""
    subprocess.run([sys.executable, str(EXAMPLES / script), *arguments], check=True, stdout=subprocess.DEVNULL)


def draw_levels(wav: Path, title: str, png: Path) -> None:
    """Draw the level of each hand over time, in windows of 50 ms."""
    felt, rate = soundfile.read(wav, always_2d=True)
    size = rate // 20
    windows = felt[: len(felt) // size * size].reshape(-1, size, felt.shape[1])
    levels = 20 * np.log10(np.maximum(np.sqrt((windows**2).mean(axis=1)), 1e-4))
    figure = Figure(figsize=(8, 2.6), layout="constrained")
    axes = figure.add_subplot(title=title, xlabel="time [s]", ylabel="level [dB re full scale]")
    for hand, level in zip(("left hand", "right hand"), levels.T, strict=True):
        axes.plot(np.arange(len(level)) * size / rate, level, label=hand)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))  # beside the curves, which fill the axes
    figure.savefig(png, dpi=110)


def draw_game(folder: Path, name: str, title: str, view_s: float) -> None:
    """Draw what both hands feel in a game, and its view after that many seconds."""
    run(f"{name}.py", "--headless", "-o", str(folder / "game.wav"))
    draw_levels(folder / "game.wav", title, folder / "felt.png")
    shrink(folder / "felt.png", f"{name}_felt.png")
    view = folder / "view.png"
    run(f"{name}.py", "--headless", "--seconds", str(view_s), "-o", str(folder / "game.wav"), "--picture", str(view))
    shrink(view, f"{name}.png")


def main() -> None:
    """Make all of them."""
    with TemporaryDirectory() as name:
        folder = Path(name)
        bundle = bake(load_scene(kitchen_path()))
        HapticSession(bundle).plot_felt("smartphone", up_to_m=2.0).savefig(folder / "felt.png", dpi=110)
        shrink(folder / "felt.png", "kitchen_felt.png")
        demo = [sys.executable, "-m", "scene2hap", "demo", "-o", str(folder / "demo")]
        subprocess.run(demo, check=True, stdout=subprocess.DEVNULL)
        shrink(folder / "demo" / "tour.png", "tour.png")
        run("paper_study2.py", "-o", str(folder / "study2"))
        shrink(folder / "study2" / "levels.png", "study2.png")
        run("game_in_python.py", str(folder / "game.wav"), "13")
        draw_levels(folder / "game.wav", "The phone is lifted and put down", folder / "game.png")
        shrink(folder / "game.png", "game_in_python.png")
        draw_game(folder, "panda3d_walk", "A walk: both ends of the table, the washing machine, the shelf", view_s=2.0)
        draw_game(folder, "mujoco_kitchen", "The phone slides away from the left hand at 2 s", view_s=4.0)


if __name__ == "__main__":
    main()
