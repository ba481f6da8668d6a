"""The example games in MuJoCo and Panda3D, run without a window, and their output files."""

from __future__ import annotations

import math
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import soundfile
from PIL import Image

from host import rasteriser_problem
from pasted import run_pasted
from scene2hap.render.safety import FADE_OUT_S

ROOT = Path(__file__).parents[2]
SILENT = 2.0**-17
"""Amplitude that counts as silence, re full scale: a quarter of a 16-bit step, like the last samples of filters."""


def run(example: str, *arguments: str | Path, folder: Path, **environment: str) -> str:
    command = [sys.executable, "-W", "error", ROOT / "examples" / example, *arguments]
    own = {key: value for key, value in os.environ.items() if key != "DISPLAY"}
    done = subprocess.run(
        list(map(str, command)), cwd=folder, capture_output=True, text=True, env={**own, **environment}
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    return done.stdout


def felt(path: Path, seconds: float) -> tuple[np.ndarray, int]:
    """Read a WAV file, and check its duration, and that its samples (n, 2) are finite and within full scale."""
    samples, rate = soundfile.read(path)
    assert samples.shape[1] == 2
    assert len(samples) == pytest.approx(seconds * rate + FADE_OUT_S * rate, abs=0.05 * rate)
    assert np.isfinite(samples).all()
    assert np.abs(samples).max() <= 1.0
    return samples, rate


def peak(samples: np.ndarray) -> float:
    return float(np.abs(samples).max())


def spectrum_peak_hz(samples: np.ndarray, rate: int) -> float:
    """The frequency of the strongest partial, to a fraction of a hertz."""
    spectrum = np.abs(np.fft.rfft(samples * np.hanning(len(samples)), 16 * len(samples)))
    return float(spectrum.argmax() * rate / (16 * len(samples)))


# -- MuJoCo ----------------------------------------------------------------------------------------------------------

# The table top of the example, 3 cm of wood; constants of softwood from the table of materials.
DENSITY_KG_M3, MODULUS_PA, POISSON, THICKNESS_M = 600.0, 10e9, 0.35, 0.03
PHONE_HALF_M, BESIDE_M = (0.075, 0.035), 0.12


def wavenumber_rad_m(frequency_hz: float) -> float:
    """Wavenumber of bending waves in the table top: k^4 = rho h omega^2 / D."""
    stiffness = MODULUS_PA * THICKNESS_M**3 / (12 * (1 - POISSON**2))
    return float((DENSITY_KG_M3 * THICKNESS_M * (2 * math.pi * frequency_hz) ** 2 / stiffness) ** 0.25)


def to_phone_m(distance_m: float) -> float:
    """Distance to the phone's nearest corner, from a hand at a distance from its middle and 12 cm to its side."""
    along = math.sqrt(max(distance_m**2 - BESIDE_M**2, 0.0))
    return math.hypot(min(abs(along - end) for end in (-PHONE_HALF_M[0], PHONE_HALF_M[0])), BESIDE_M - PHONE_HALF_M[1])


@pytest.fixture(scope="module")
def kitchen(tmp_path_factory: pytest.TempPathFactory) -> tuple[dict[float, dict[str, tuple[float, float]]], Path]:
    """The output of the MuJoCo game: (distance [m], gain) by time [s] and hand, and its WAV of 8 s."""
    pytest.importorskip("mujoco", reason="needs the extra mujoco")
    folder = tmp_path_factory.mktemp("kitchen")
    code = (ROOT / "examples" / "mujoco_kitchen.py").read_text(encoding="utf-8")
    told = run_pasted(code, folder, "--headless", "-o", "kitchen.wav")
    assert told.endswith("wrote kitchen.wav\n")
    assert {path.name for path in folder.iterdir()} == {"kitchen.wav"}
    rows = re.findall(r"at ([\d.]+) s: left ([\d.]+) m: ([\d.]+); right ([\d.]+) m: ([\d.]+)", told)
    found = {float(t): {"left": (float(a), float(b)), "right": (float(c), float(d))} for t, a, b, c, d in rows}
    assert len(found) == 16
    return found, folder / "kitchen.wav"


def test_gain_falls_with_distance_as_the_model_predicts(
    kitchen: tuple[dict[float, dict[str, tuple[float, float]]], Path],
) -> None:
    told, wav = kitchen
    samples, rate = felt(wav, 8.0)
    k = wavenumber_rad_m(spectrum_peak_hz(samples[rate : 2 * rate, 0], rate))
    left = {t: row["left"] for t, row in told.items()}
    assert left[0.5] == (0.12, 0.0)  # above the table
    assert left[2.0][0] == pytest.approx(0.12, abs=0.001)
    gains = [left[t][1] for t in (2.0, 2.5, 3.0, 3.5)]
    assert gains == sorted(gains, reverse=True)
    # Pushed at 0.55 m/s against a friction coefficient of 0.04, the phone slides v^2 / (2 mu g).
    slid_m = 0.55**2 / (2 * 0.04 * 9.81)
    assert left[4.0][0] == pytest.approx(math.hypot(slid_m, BESIDE_M), rel=0.02)
    for t in (1.0, 2.0, 3.5, 4.0, 5.0, 6.0):
        distance_m, gain = left[t]
        assert gain == pytest.approx(math.exp(-k * to_phone_m(distance_m)), rel=0.03), t
    # The phone's pulses fall with the gain; the refrigerator adds a few per cent.
    fall = peak(samples[4 * rate : 6 * rate, 0]) / peak(samples[rate : 2 * rate, 0])
    assert fall == pytest.approx(left[5.0][1] / left[2.0][1], rel=0.1)


def test_a_hand_that_follows_the_phone_keeps_its_gain(
    kitchen: tuple[dict[float, dict[str, tuple[float, float]]], Path],
) -> None:
    told, wav = kitchen
    samples, rate = felt(wav, 8.0)
    assert told[5.0]["right"] == pytest.approx(told[2.0]["right"], rel=0.02)
    assert peak(samples[4 * rate : 6 * rate, 1]) == pytest.approx(peak(samples[rate : 2 * rate, 1]), rel=0.05)
    # At the end, the left hand moves to the phone.
    assert told[8.0]["left"] == pytest.approx(told[2.0]["left"], rel=0.02)
    # Nothing is felt before a hand is on the table: hands come down from 9 cm at 5 / s.
    assert peak(samples[: rate // 5]) <= SILENT


def drawing_problem(how: str) -> str:
    """Why MuJoCo cannot draw by EGL or OSMesa here; empty if it can."""
    code = "import mujoco; mujoco.Renderer(mujoco.MjModel.from_xml_string('<mujoco/>'), 8, 8).close()"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, env={**os.environ, "MUJOCO_GL": how})
    return "" if done.returncode == 0 else f"MuJoCo cannot draw by {how}"


def test_a_picture_of_the_mujoco_kitchen(tmp_path: Path) -> None:
    pytest.importorskip("mujoco", reason="needs the extra mujoco")
    how = next((how for how in ("egl", "osmesa") if not drawing_problem(how)), None)
    if how is None:
        pytest.skip("MuJoCo needs the system packages libegl1 and libgl1-mesa-dri, or libosmesa6, to draw")
    # Headless, as there is no display.
    run("mujoco_kitchen.py", "--seconds", "0.1", "--picture", "view.png", folder=tmp_path, MUJOCO_GL=how)
    felt(tmp_path / "kitchen.wav", 0.1)
    with Image.open(tmp_path / "view.png") as picture:
        assert picture.size == (960, 600)
        assert seen(picture, (190, 128, 76)) > 0.1  # the lit wood of the table


# -- Panda3D ---------------------------------------------------------------------------------------------------------


def seen(picture: Image.Image, rgb: tuple[int, int, int]) -> float:
    """The share of pixels whose hue is near a colour's."""
    pixels = np.asarray(picture.convert("RGB"), float)
    ratio = pixels / np.maximum(pixels.sum(axis=2, keepdims=True), 1.0)
    return float((np.abs(ratio - np.array(rgb) / sum(rgb)).max(axis=2) < 0.03).mean())


def intervals(told: str) -> list[tuple[float, float, str]]:
    """Begin [s], end [s] and object of each touch of the walker."""
    rows = [(float(t), what) for t, what in re.findall(r"at ([\d.]+) s: ([\w ;]+?) ?(?:\(|$)", told, re.MULTILINE)]
    ends = [*[t for t, _ in rows[1:]], 16.0]
    return [(begin, end, what) for (begin, what), end in zip(rows, ends, strict=True)]


def test_walker_feels_only_touched_objects(tmp_path: Path) -> None:
    pytest.importorskip("panda3d", reason="needs the extra panda3d")
    told = run("panda3d_walk.py", "--headless", "-o", "walk.wav", folder=tmp_path)
    assert {path.name for path in tmp_path.iterdir()} == {"walk.wav"}
    samples, rate = felt(tmp_path / "walk.wav", 16.0)
    found = intervals(told)
    assert [what for _, _, what in found if what != "nothing touched"] == [
        "right hand on wooden table",
        "left hand on wooden table",
        "left hand on washing machine",
        "right hand on wooden shelf",
    ]
    levels, peaks_hz = [], []
    for begin, end, what in found:
        # Gains fade within 20 ms, the DC block has a time constant of 35 ms, and a session begins with a fade.
        part = samples[round((begin + 0.2) * rate) : round((end - 0.1) * rate)]
        if what == "nothing touched":
            assert peak(part) <= SILENT, (begin, end)
            continue
        assert end - begin == pytest.approx(2.0, abs=0.03)
        touching, idle = part.T if what.startswith("left") else part.T[::-1]
        assert peak(idle) <= SILENT
        levels.append(peak(touching))
        peaks_hz.append(spectrum_peak_hz(touching, rate))
    near_phone, far_end, machine, shelf = levels
    # Phone, washing machine and fan have different frequencies; both ends of the table have the phone's.
    phone, again, washing, fan = peaks_hz
    assert again == pytest.approx(phone, rel=0.02)
    assert min(abs(math.log2(a / b)) for a, b in [(phone, washing), (phone, fan), (washing, fan)]) > 0.1
    # Distances from the phone's corners, 3.5 cm and 7.5 cm off its middle, on the same wood as in the kitchen.
    k = wavenumber_rad_m(phone)
    near_m = math.dist((0.3 + 0.035, -0.1 - 0.075), (0.45, -0.15))
    far_m = math.dist((0.3 - 0.035, -0.1 - 0.075), (-0.55, -0.15))
    said = re.search(r"right hand on wooden table \(([\d.]+) of smartphone", told)
    assert said is not None
    assert float(said[1]) == pytest.approx(math.exp(-k * near_m), abs=0.015)
    assert far_end / near_phone == pytest.approx(math.exp(-k * (far_m - near_m)), rel=0.1)
    assert machine > near_phone > far_end > 0.001
    assert shelf > 0.001


@pytest.mark.skipif(bool(rasteriser_problem()), reason=rasteriser_problem())
def test_picture_of_the_view_of_the_walker(tmp_path: Path) -> None:
    told = run("panda3d_walk.py", "--headless", "--seconds", "1", "--picture", "view.png", folder=tmp_path)
    felt(tmp_path / "walk.wav", 1.0)
    assert told.splitlines()[-2].split(" s: ")[1].startswith("right hand on wooden table")
    with Image.open(tmp_path / "view.png") as picture:
        assert picture.size == (960, 600)
        assert seen(picture, (158, 107, 64)) > 0.2  # the wood of the table
