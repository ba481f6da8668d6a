"""Times and levels in exported files, read by the rules of each format and not by the library's own readers."""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import pytest
import soundfile
from numpy.typing import NDArray
from scipy.signal import hilbert

from scene2hap.clips.haptic_clip import Curve, HapticClip, Transient
from scene2hap.clips.synthesis import RATE_HZ, synthesize
from scene2hap.export import EXPORTS, Channel, Track
from scene2hap.export.kinds.steps import steps_as_clip

Points = list[tuple[float, float]]
"""Pairs of time [s] and amplitude [-]."""
LEVELS = ((0.1, 0.4, 0.2), (0.6, 1.2, 0.8), (1.4, 1.9, 0.05))
"""Begin and end [s] of steady parts, and their amplitudes [-]."""


def signal(rate: int) -> NDArray[np.float64]:
    t = np.arange(2 * rate) / rate
    amplitude = np.select([t < 0.5, t < 1.3], [0.2, 0.8], 0.05)
    return amplitude * np.sin(2 * np.pi * 150 * t)


def exported(kind: str, track: Track) -> Mapping[str, bytes]:
    files: Mapping[str, bytes] = EXPORTS.build(kind).export(track).files
    return files


def only(files: Mapping[str, bytes]) -> Any:
    (content,) = files.values()
    return json.loads(content)


def of_ahap(files: Mapping[str, bytes]) -> Points:
    curves = [item["ParameterCurve"] for item in only(files)["Pattern"] if "ParameterCurve" in item]
    return [
        (curve["Time"] + point["Time"], point["ParameterValue"] ** 2)  # intensity is the root of an amplitude
        for curve in curves
        if curve["ParameterID"] == "HapticIntensityControl"
        for point in curve["ParameterCurveControlPoints"]
    ]


def of_haptic(files: Mapping[str, bytes]) -> Points:
    points = only(files)["signals"]["continuous"]["envelopes"]["amplitude"]
    return [(point["time"], point["amplitude"]) for point in points]


def of_hjif(files: Mapping[str, bytes]) -> Points:
    document = only(files)
    (effect,) = document["perceptions"][0]["channels"][0]["bands"][0]["effects"]
    ticks = [effect["position"] + frame["relative_position"] for frame in effect["keyframes"]]
    values = [frame["amplitude_modulation"] for frame in effect["keyframes"]]
    return [(tick / document["timescale"], value) for tick, value in zip(ticks, values, strict=True)]


def of_openxr_envelope(files: Mapping[str, bytes]) -> Points:
    points, begin_s = [], 0.0
    for call in only(files)["calls"]:
        step_s = call["duration_ns"] / 1e9 / len(call["amplitudes"])
        points += [(begin_s + (i + 0.5) * step_s, value) for i, value in enumerate(call["amplitudes"])]
        begin_s += call["duration_ns"] / 1e9
    return points


def of_openxr_parametric(files: Mapping[str, bytes]) -> Points:
    calls = only(files)["calls"]
    return [(point["time_ns"] / 1e9, point["value"]) for call in calls for point in call["amplitude_points"]]


def of_android(files: Mapping[str, bytes]) -> Points:
    document = only(files)
    ends_s = np.cumsum(document["timings_ms"]) / 1000
    middles_s = ends_s - np.array(document["timings_ms"]) / 2000
    return list(zip(middles_s.tolist(), (np.array(document["amplitudes"]) / 255).tolist(), strict=True))


def of_samples(samples: NDArray[np.float64], rate: float) -> Points:
    return list(zip((np.arange(len(samples)) / rate).tolist(), np.abs(hilbert(samples)).tolist(), strict=True))


def of_sound(column: int) -> Callable[[Mapping[str, bytes]], Points]:
    def read(files: Mapping[str, bytes]) -> Points:
        (content,) = files.values()
        samples, rate = soundfile.read(io.BytesIO(content), always_2d=True)
        return of_samples(samples[:, column], rate)

    return read


def of_pcm(files: Mapping[str, bytes]) -> Points:
    header = json.loads(files["x.json"])
    return of_samples(np.frombuffer(files[header["samples"]], "<f4").astype(float), header["sample_rate_hz"])


READERS = {
    "ahap": of_ahap,
    "android": of_android,
    "dualsense": of_sound(2),
    "haptic": of_haptic,
    "hjif": of_hjif,
    "openxr_envelope": of_openxr_envelope,
    "openxr_parametric": of_openxr_parametric,
    "openxr_pcm": of_pcm,
    "pcm": of_pcm,
    "wav": of_sound(0),
}


@pytest.mark.parametrize("rate", [8000, 44_100])
@pytest.mark.parametrize("kind", EXPORTS.kinds())
def test_a_file_holds_levels_and_times_of_its_signal(kind: str, rate: int) -> None:
    times_s, values = np.array(READERS[kind](exported(kind, Track("x", {"": Channel(signal(rate), rate)})))).T
    t = np.arange(0.0, 2.0, 0.001)
    amplitude = np.interp(t, times_s, values)
    for begin, end, level in LEVELS:
        found = np.median(amplitude[(t > begin) & (t < end)])
        assert 20 * np.log10(found / level) == pytest.approx(0.0, abs=0.6)
    rises = t[(t > 0.3) & (amplitude > 0.5)][0]
    falls = t[(t > 1.0) & (amplitude < 0.425)][0]
    assert (rises, falls) == pytest.approx((0.5, 1.3), abs=0.005)


TAPS = Transient(0.25, 0.81, 0.4), Transient(0.6183, 0.36, 1.0)


@pytest.fixture(scope="module")
def tapped() -> Track:
    clip = HapticClip(Curve(np.array([0.0, 1.0]), np.array([0.25, 0.25])), transients=TAPS)
    return Track("x", {"": Channel(np.clip(synthesize(clip), -1.0, 1.0), RATE_HZ, clip=clip)})


def test_taps_of_a_clip_are_in_files_that_hold_taps(tapped: Track) -> None:
    (call,) = only(exported("openxr_parametric", tapped))["calls"]
    assert call["transients"] == [
        {"time_ns": 250_000_000, "amplitude": 0.81, "frequency": 0.4},
        {"time_ns": 618_300_000, "amplitude": 0.36, "frequency": 1.0},
    ]
    bands = only(exported("hjif", tapped))["perceptions"][0]["channels"][0]["bands"]
    effects = {band["band_type"]: band["effects"] for band in bands}["Transient"]
    assert [(one["position"], *one["keyframes"]) for one in effects] == [
        (250, {"relative_position": 0, "amplitude_modulation": 0.81, "frequency_modulation": 159}),
        (618, {"relative_position": 0, "amplitude_modulation": 0.36, "frequency_modulation": 300}),
    ]
    assert all(type(one["keyframes"][0]["frequency_modulation"]) is int for one in effects)
    points = only(exported("haptic", tapped))["signals"]["continuous"]["envelopes"]["amplitude"]
    emphases = {point["time"]: point["emphasis"] for point in points if "emphasis" in point}
    assert emphases == {
        0.25: {"amplitude": 0.81, "frequency": 0.4},
        0.6183: {"amplitude": 0.36, "frequency": 1.0},
    }
    pattern = json.loads(exported("ahap", tapped)["x.transients.ahap"])["Pattern"]
    events = [item["Event"] for item in pattern]
    assert {event["EventType"] for event in events} == {"HapticTransient"}
    assert [event["Time"] for event in events] == [0.25, 0.6183]
    parameters = [{one["ParameterID"]: one["ParameterValue"] for one in event["EventParameters"]} for event in events]
    assert [one["HapticIntensity"] for one in parameters] == pytest.approx([0.9, 0.6])


def test_the_last_of_some_steps_lasts_to_the_end() -> None:
    clip = steps_as_clip(np.array([0.2, 0.4, 0.6, 0.8]), 0.01, 0.035)
    assert clip.duration_s == pytest.approx(0.035)
    at_s = np.array([0.005, 0.015, 0.025, 0.034])
    np.testing.assert_allclose(clip.amplitude.at(at_s), [0.2, 0.4, 0.6, 0.8])
