"""Random tracks and exporter settings, and the verdict of an independently written checker."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from haptic_file_checker import (
    check_ahap,
    check_android,
    check_haptic,
    check_hjif,
    check_openxr_envelope,
    check_openxr_parametric,
    check_openxr_pcm,
)
from scene2hap.export import EXPORTS, Channel, Exporter, Track

RATE_HZ = 8000
CHECKED = ("haptic", "ahap", "hjif", "openxr_pcm", "openxr_envelope", "openxr_parametric", "android")


def random_track(rng: np.random.Generator, longest_s: float = 4.0) -> Track:
    """A loop, or one or two hands over time, with random tones, sweeps, noise, beats, pulses, silence and clipping."""
    duration_s = float(rng.choice([0.01, rng.uniform(0.05, 1.0), rng.uniform(0.5, longest_s)]))
    is_loop = bool(rng.random() < 0.5)
    names = [""] if is_loop or rng.random() < 0.5 else ["left", "right"]
    return Track("track", {name: Channel(_signal(rng, duration_s), RATE_HZ, is_loop) for name in names})


def _signal(rng: np.random.Generator, duration_s: float) -> np.ndarray:
    t = np.arange(max(1, round(duration_s * RATE_HZ))) / RATE_HZ
    x = np.zeros(len(t))
    for _ in range(rng.integers(0, 4)):
        hertz = rng.uniform(15.0, 900.0)
        x += rng.uniform(0.0, 0.6) * np.sin(2 * np.pi * (hertz * t + rng.uniform(-30, 30) * t**2 + rng.uniform()))
    x += rng.choice([0.0, 0.01, 0.2]) * rng.standard_normal(len(t))
    if rng.random() < 0.5:
        x *= 1.0 + rng.uniform(0.0, 1.0) * np.sin(2 * np.pi * rng.uniform(0.3, 45.0) * t)
    if rng.random() < 0.3:
        x[: rng.integers(0, len(x) + 1)] = 0.0
    for start in rng.integers(0, len(x), rng.integers(0, 5)):
        end = min(len(x), int(start) + int(rng.integers(20, 300)))
        x[start:end] += rng.uniform(0.2, 1.0) * np.sin(2 * np.pi * rng.uniform(40.0, 300.0) * t[: end - int(start)])
    return np.clip(x, -1.0, 1.0)


def random_exporter(rng: np.random.Generator, kind: str) -> tuple[Exporter, dict[str, Any]]:
    """An exporter of a kind with random settings, and these settings."""
    settings: dict[str, Any] = {}
    if kind in ("haptic", "ahap", "hjif", "openxr_parametric") and rng.random() < 0.6:
        low = float(rng.uniform(10.0, 200.0))
        settings |= {
            "range_hz": (low, low + float(rng.uniform(20.0, 600.0))),
            "tolerance_db": float(rng.uniform(0.05, 3.0)),
            "amplitude_points": int(rng.integers(4, 200)),
            "frequency_points": int(rng.integers(4, 200)),
            "transients": bool(rng.random() < 0.7),
        }
    if kind == "hjif":
        settings["profile"] = str(rng.choice(["Simple Parametric", "Main"]))
    elif kind == "openxr_pcm":
        settings["sample_rate_hz"] = float(rng.choice([500.0, 2000.0, 8000.0]))
    elif kind == "openxr_envelope":
        settings["step_s"] = float(rng.choice([0.001, 0.005, 0.02]))
    elif kind == "openxr_parametric":
        settings |= {"stream": bool(rng.random() < 0.5), "frame_s": float(rng.choice([0.014, 0.05, 0.2]))}
    made: Any = EXPORTS.build({"kind": kind, **settings})
    return made, settings


def problems(kind: str, settings: dict[str, Any], files: dict[str, bytes]) -> list[str]:
    """Every rule that the files of one export break."""
    found: list[str] = []
    for name, content in files.items():
        if name.endswith(".f32"):
            continue
        document = json.loads(content)
        if kind == "haptic":
            found += check_haptic(document)
        elif kind == "ahap":
            found += check_ahap(document)
        elif kind == "hjif":
            found += check_hjif(document, settings.get("profile", "Simple Parametric"))
        elif kind == "openxr_pcm":
            found += check_openxr_pcm(document, files[document["samples"]])
        elif kind == "openxr_envelope":
            found += check_openxr_envelope(document)
        elif kind == "openxr_parametric":
            found += check_openxr_parametric(document)
        else:
            found += check_android(document)
    return found
