"""docs/formats: the C programs compile and read exported files, and the commands name existing kinds."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from scene2hap.clips.haptic_clip import Curve, HapticClip, Transient
from scene2hap.export import EXPORTS, Channel, Track
from scene2hap.export.curves import CurveSettings

FOLDER = Path(__file__).parents[2] / "docs" / "formats"
PAGES = {page.stem: page.read_text(encoding="utf-8") for page in sorted(FOLDER.glob("*.md"))}
KIND_PAGES = {"haptic", "ahap", "hjif", "openxr", "android", "dualsense", "pcm"}
COMPILER = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
RATE_HZ = 8000

needs_compiler = pytest.mark.skipif(COMPILER is None, reason="no C compiler; install gcc")


def blocks(page: str) -> list[tuple[str, str, str]]:
    """Language, code, and the next three lines of text, for each block of code on a page."""
    found = re.finditer(r"^```(\w+)\n(.*?)^```\n", PAGES[page], re.DOTALL | re.MULTILINE)
    return [(one[1], one[2], "\n".join(PAGES[page][one.end() :].splitlines()[:3])) for one in found]


def programs() -> dict[str, str]:
    pattern = r"^<!-- compiled: (\w+) -->\n```c\n(.*?)^```\n"
    return {one[1]: one[2] for text in PAGES.values() for one in re.finditer(pattern, text, re.DOTALL | re.MULTILINE)}


@pytest.fixture(scope="module")
def compiled(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    folder = tmp_path_factory.mktemp("programs")
    made = {}
    for name, code in programs().items():
        source, made[name] = folder / f"{name}.c", folder / name
        source.write_text(code, encoding="utf-8")
        flags = ["-std=c11", "-Wall", "-Wextra", "-Werror", "-O1"]
        done = subprocess.run(
            [str(COMPILER), *flags, "-o", str(made[name]), str(source), "-lm"], capture_output=True, text=True
        )
        assert done.returncode == 0, f"{name}: {done.stderr}"
    return made


def lines(program: Path, *files: Path) -> list[list[str]]:
    """Run a program on files. Returns the words of each line that it prints."""
    done = subprocess.run([str(program), *map(str, files)], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return [line.split() for line in done.stdout.splitlines()]


def pairs(words: list[str]) -> dict[str, float]:
    """Parse words in which names and numbers alternate."""
    return {name: float(value) for name, value in zip(words[::2], words[1::2], strict=True)}


def exported(spec: str | dict[str, Any], track: Track, folder: Path) -> list[Path]:
    exporter: Any = EXPORTS.build(spec)
    paths = []
    for name, content in exporter.export(track).files.items():
        paths.append(folder / name)
        paths[-1].write_bytes(content)
    return paths


def signal(duration_s: float) -> np.ndarray:
    """A hum whose level rises and falls three times a second, with one pulse."""
    t = np.arange(round(duration_s * RATE_HZ)) / RATE_HZ
    x = (0.4 + 0.3 * np.sin(2 * np.pi * 3.0 * t)) * np.sin(2 * np.pi * 120.0 * t)
    start = len(t) // 2
    x[start : start + 160] += 0.25 * np.sin(2 * np.pi * 200.0 * t[:160])
    return x


@pytest.fixture(scope="module")
def loop() -> Track:
    return Track("fan.on", {"": Channel(signal(2.0), RATE_HZ, is_loop=True)})


@pytest.fixture(scope="module")
def hands() -> Track:
    """Two hands of different duration; the right one has hand-drawn curves and transients."""
    drawn = HapticClip(
        Curve(np.array([0.0, 0.3, 0.3, 1.1]), np.array([0.2, 0.9, 0.1, 0.4])),
        Curve(np.array([0.0, 0.7]), np.array([0.1, 0.8])),
        (Transient(0.25, 1.0, 0.7), Transient(0.9, 0.6, 0.0)),
    )
    return Track("tour", {"left": Channel(signal(1.5), RATE_HZ), "right": Channel(signal(1.1), RATE_HZ, clip=drawn)})


@pytest.fixture(scope="module")
def long() -> Track:
    """A track with more points than one parametric call holds, and more steps than one call of the envelope."""
    return Track("long", {"": Channel(signal(40.7), RATE_HZ)})


def squares(values: Any) -> float:
    return float((np.asarray(values, dtype=np.float32).astype(np.float64) ** 2).sum())


@needs_compiler
@pytest.mark.parametrize("name", ["loop", "hands"])
def test_pcm_reader_of_the_page_works(
    name: str, compiled: dict[str, Path], tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    header, samples = exported({"kind": "pcm", "sample_rate_hz": 3000}, request.getfixturevalue(name), tmp_path)
    told = json.loads(header.read_text(encoding="utf-8"))
    frames = np.fromfile(samples, dtype="<f4").reshape(-1, len(told["channels"]))
    first, *channels = lines(compiled["read_pcm"], header, samples)
    assert pairs(first) == {"frames": len(frames), "rate_hz": 3000.0, "loop": float(told["loop"])}
    assert len(channels) == len(told["channels"])
    for i, words in enumerate(channels):
        assert pairs(words)["channel"] == i
        assert pairs(words)["squares"] == pytest.approx(squares(frames[:, i]), rel=1e-6)
        assert pairs(words)["squares"] > 1.0


@needs_compiler
def test_the_pcm_reader_refuses_samples_of_another_length(
    compiled: dict[str, Path], loop: Track, tmp_path: Path
) -> None:
    header, samples = exported("pcm", loop, tmp_path)
    samples.write_bytes(samples.read_bytes()[:-4])
    done = subprocess.run([compiled["read_pcm"], header, samples], capture_output=True, text=True)
    assert done.returncode == 1
    assert "another length" in done.stderr


@needs_compiler
@pytest.mark.parametrize("profile", ["Simple Parametric", "Main"])
@pytest.mark.parametrize("name", ["loop", "hands"])
def test_hjif_reader_of_the_page_works(
    name: str, profile: str, compiled: dict[str, Path], tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    (path,) = exported({"kind": "hjif", "profile": profile}, request.getfixturevalue(name), tmp_path)
    told = json.loads(path.read_text(encoding="utf-8"))
    wanted = [
        (
            channel["id"],
            band["band_type"],
            (effect["position"] + frame["relative_position"]) / told["timescale"],
            frame["amplitude_modulation"],
            frame["frequency_modulation"],
        )
        for channel in told["perceptions"][0]["channels"]
        for band in channel["bands"]
        for effect in band["effects"]
        for frame in effect["keyframes"]
    ]
    found = lines(compiled["list_keyframes"], path)
    assert [(int(one[0]), one[1], int(one[4])) for one in found] == [(one[0], one[1], one[4]) for one in wanted]
    assert [float(one[2]) for one in found] == pytest.approx([one[2] for one in wanted])
    assert [float(one[3]) for one in found] == pytest.approx([one[3] for one in wanted])
    if name == "hands":
        assert sum(one[:2] == ["1", "Transient"] for one in found) == 2


@needs_compiler
def test_the_reader_of_openxr_samples(compiled: dict[str, Path], long: Track, tmp_path: Path) -> None:
    header, raw = sorted(exported("openxr_pcm", long, tmp_path), key=lambda path: path.suffix, reverse=True)
    told = json.loads(header.read_text(encoding="utf-8"))
    samples = np.fromfile(raw, dtype="<f4")
    assert len(samples) == told["sample_count"]
    parts = [samples[first : first + told["buffer_size"]] for first in range(0, len(samples), told["buffer_size"])]
    found = [pairs(words[1:]) for words in lines(compiled["read_openxr"], header, raw)]
    assert len(found) == len(parts) > 10
    for i, (one, part) in enumerate(zip(found, parts, strict=True)):
        assert (one["rate_hz"], one["append"], one["samples"]) == (told["sample_rate_hz"], i > 0, len(part))
        assert one["squares"] == pytest.approx(squares(part), rel=1e-6)


@needs_compiler
@pytest.mark.parametrize("name", ["loop", "long"])
def test_the_reader_of_openxr_amplitudes(
    name: str, compiled: dict[str, Path], tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    (path,) = exported("openxr_envelope", request.getfixturevalue(name), tmp_path)
    calls = json.loads(path.read_text(encoding="utf-8"))["calls"]
    found = [pairs(words[1:]) for words in lines(compiled["read_openxr"], path)]
    assert len(found) == len(calls) == (1 if name == "loop" else 3)
    for one, call in zip(found, calls, strict=True):
        assert (one["duration_ns"], one["amplitudes"]) == (call["duration_ns"], len(call["amplitudes"]))
        assert one["squares"] == pytest.approx(squares(call["amplitudes"]), rel=1e-6)


@needs_compiler
@pytest.mark.parametrize("name", ["loop", "hands", "long"])
def test_the_reader_of_openxr_points(
    name: str, compiled: dict[str, Path], tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    types = ["none", "first", "intermediate", "last"]
    for path in exported("openxr_parametric", request.getfixturevalue(name), tmp_path):
        calls = json.loads(path.read_text(encoding="utf-8"))["calls"]
        found = [pairs(words[1:]) for words in lines(compiled["read_openxr"], path)]
        assert len(found) == len(calls)
        for one, call in zip(found, calls, strict=True):
            assert one["type"] == types.index(call["stream_frame_type"])
            assert (one["min_hz"], one["max_hz"]) == (call["min_frequency_hz"], call["max_frequency_hz"])
            assert one["amplitudes"] == len(call["amplitude_points"])
            assert one["frequencies"] == len(call["frequency_points"])
            assert one["transients"] == len(call["transients"])
            assert one["last_ns"] == call["amplitude_points"][-1]["time_ns"]
            total = sum(row["value"] for row in call["amplitude_points"] + call["frequency_points"])
            total += sum(row["amplitude"] + row["frequency"] for row in call["transients"])
            assert one["sum"] == pytest.approx(total, rel=1e-5, abs=1e-6)
        if name == "long":
            assert {one["type"] for one in found} == {1, 2, 3}
            assert sum(one["amplitudes"] for one in found) > 500
        if path.stem == "tour.right":
            assert sum(one["transients"] for one in found) == 2


def test_the_pages_are_there_and_programs_are_marked() -> None:
    assert set(PAGES) == KIND_PAGES
    assert set(programs()) == {"read_pcm", "list_keyframes", "read_openxr"}


@pytest.mark.parametrize("page", sorted(PAGES))
def test_a_page_names_its_command(page: str) -> None:
    """Every kind and its settings after `--to` build an exporter."""
    assert "scene2hap export" in PAGES[page]
    given = re.findall(r"--to (?:'(\{.*?\})'|(\w+))", PAGES[page])
    assert given
    for spec, kind in given:
        EXPORTS.build(json.loads(spec) if spec else kind)


@pytest.mark.parametrize("page", sorted(PAGES))
def test_loaders_say_whether_they_are_compiled(page: str) -> None:
    marked = set(programs().values())
    for language, code, below in blocks(page):
        if language in ("csharp", "swift", "kotlin") or (language == "c" and code not in marked):
            assert "Not compiled by our tests." in below, code[:200]
        elif language == "c":
            assert "Compiled and run by our tests." in below, code[:200]
        elif language == "python":
            assert "Not run by our tests" in below, code[:200]


def test_every_kind_has_a_page() -> None:
    text = "\n".join(PAGES.values())
    for kind in EXPORTS.builtins:
        assert re.search(rf"--to (?:{kind}\b|'\{{\"kind\": \"{kind}\")", text), f"no command exports {kind}"


def test_every_setting_of_curves_is_explained() -> None:
    for setting in fields(CurveSettings):
        row = re.search(rf"^\| `{setting.name}` \| ([^|]*) \|", PAGES["haptic"], re.MULTILINE)
        assert row, f"docs/formats/haptic.md does not explain {setting.name}"
        default = list(setting.default) if isinstance(setting.default, tuple) else setting.default
        assert json.loads(row[1]) == default
