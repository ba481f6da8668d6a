"""Every export format: a tour of 15 s, and clips longer than the limit of one call, curve or event."""

from __future__ import annotations

import io
import json
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import soundfile

import haptic_file_checker as checker
from scene2hap.clips.haptic_clip import Curve, HapticClip, Transient
from scene2hap.clips.reading import read_haptic_clip
from scene2hap.clips.synthesis import synthesize
from scene2hap.errors import ConfigError, ExportError
from scene2hap.export import EXPORTS, Channel, Exported, Track
from scene2hap.export.curves import CurveSettings, curves_of
from scene2hap.export.fidelity import fidelity

RATE = 8000


def made(spec: object, track: Track) -> Exported:
    exporter: Any = EXPORTS.build(spec)
    found: Exported = exporter.export(track)
    return found


def hand(duration_s: float, seed: int = 0) -> np.ndarray:
    """The signal of a hand that moves between two sources, with a knock."""
    t = np.arange(round(duration_s * RATE)) / RATE
    rng = np.random.default_rng(seed)
    near = np.interp(t, np.linspace(0, duration_s, 12), rng.random(12))
    x = 0.5 * near * np.sin(2 * np.pi * 90 * t) + 0.3 * (1 - near) * np.sin(2 * np.pi * 170 * t)
    x += 0.1 * rng.standard_normal(len(t))
    x[RATE // 2 : RATE // 2 + 150] += 0.5 * np.sin(2 * np.pi * 150 * t[:150])
    return np.clip(x, -1, 1)


@pytest.fixture(scope="module")
def tour() -> Track:
    return Track("tour", {"left": Channel(hand(15.0), RATE), "right": Channel(hand(15.0, 1), RATE)})


@pytest.fixture(scope="module")
def long() -> Track:
    return Track("long", {"": Channel(hand(70.0), RATE)})


def test_curves_of_a_tour_fit_their_formats(tour: Track) -> None:
    for name, content in made("haptic", tour).files.items():
        document = json.loads(content)
        assert checker.check_haptic(document) == [], name
        assert checker.haptic_duration_s(document) == pytest.approx(15.0)
    files = made("ahap", tour).files
    for hand_name in ("left", "right"):
        documents = [json.loads(content) for name, content in files.items() if name.startswith(f"tour.{hand_name}.")]
        assert all(checker.check_ahap(one) == [] for one in documents)
        assert checker.ahap_duration_s(documents) == pytest.approx(15.0)
    for profile in ("Simple Parametric", "Main"):
        (content,) = made({"kind": "hjif", "profile": profile}, tour).files.values()
        document = json.loads(content)
        assert checker.check_hjif(document, profile) == []
        assert checker.hjif_duration_s(document) == pytest.approx(15.0, abs=1e-3)
        channels = document["perceptions"][0]["channels"]
        assert [one["body_part_target"] for one in channels] == [["Left", "Hand"], ["Right", "Hand"]]
    for content in made("openxr_parametric", tour).files.values():
        document = json.loads(content)
        assert checker.check_openxr_parametric(document) == []
        assert checker.parametric_duration_s(document) == pytest.approx(15.0)


def test_steps_and_samples_of_a_tour_fit_their_formats(tour: Track) -> None:
    for content in made("openxr_envelope", tour).files.values():
        document = json.loads(content)
        assert checker.check_openxr_envelope(document) == []
        assert checker.envelope_duration_s(document) == pytest.approx(15.0)
    for content in made("android", tour).files.values():
        document = json.loads(content)
        assert checker.check_android(document) == []
        assert checker.android_duration_s(document) == pytest.approx(15.0)
    files = made({"kind": "openxr_pcm", "sample_rate_hz": 2000}, tour).files
    for side in ("left", "right"):
        header = json.loads(files[f"tour.{side}.json"])
        assert checker.check_openxr_pcm(header, files[header["samples"]]) == []
        assert header["sample_count"] == 30_000


def test_a_dualsense_plays_the_first_two_channels_of_hands_by_other_names(tour: Track) -> None:
    left, right = tour.channels["left"], tour.channels["right"]
    named = Track("tour", {"thumb": left, "finger": right})
    whole = made("dualsense", named)
    assert set(whole.played) == {"thumb", "finger"}
    assert whole.files == made("dualsense", tour).files


def test_a_dualsense_moves_its_third_and_fourth_channel(tour: Track) -> None:
    frames, rate = soundfile.read(io.BytesIO(made("dualsense", tour).files["tour.wav"]))
    assert rate == 48_000
    assert frames.shape == (15 * 48_000, 4)
    assert not frames[:, :2].any()
    for column, name in ((2, "left"), (3, "right")):
        np.testing.assert_allclose(frames[::6, column], tour.channels[name].samples, atol=0.02)
    single = Track("hum", {"": Channel(hand(1.0), RATE, is_loop=True)})
    both, _ = soundfile.read(io.BytesIO(made("dualsense", single).files["hum.wav"]))
    np.testing.assert_array_equal(both[:, 2], both[:, 3])


@pytest.mark.parametrize("rate", [1000, 8000, 44_100])
def test_wav_and_raw_samples_have_any_rate(tour: Track, rate: int) -> None:
    frames, found = soundfile.read(io.BytesIO(made({"kind": "wav", "sample_rate_hz": rate}, tour).files["tour.wav"]))
    assert (found, frames.shape) == (rate, (15 * rate, 2))
    files = made({"kind": "pcm", "sample_rate_hz": rate}, tour).files
    header = json.loads(files["tour.json"])
    raw = np.frombuffer(files[header["samples"]], dtype="<f4").reshape(-1, 2)
    assert (header["frame_count"], header["channels"]) == (15 * rate, ["left", "right"])
    np.testing.assert_allclose(raw, frames, atol=1e-6)


def test_parts_of_a_long_export_join_without_a_gap(long: Track) -> None:
    exported = made({"kind": "ahap", "tolerance_db": 1.0}, long)
    documents = [json.loads(content) for content in exported.files.values()]
    assert all(checker.check_ahap(one) == [] for one in documents)  # the checker also checks every joint
    events = [item["Event"] for one in documents for item in one["Pattern"] if "Event" in item]
    assert [one["EventDuration"] for one in events if "EventDuration" in one] == [30.0, 30.0, 10.0]
    played = exported.played[""]
    t = np.linspace(0.0, 69.9, 7000)
    intensity = checker.ahap_intensity(documents[0], t)
    np.testing.assert_allclose(intensity**2, played.amplitude.at(t), atol=0.02)

    (content,) = made({"kind": "openxr_envelope", "step_s": 0.005}, long).files.values()
    calls = json.loads(content)["calls"]
    assert [len(call["amplitudes"]) for call in calls] == [4000, 4000, 4000, 2000]
    assert sum(call["duration_ns"] for call in calls) == 70_000_000_000

    (content,) = made("openxr_parametric", long).files.values()
    document = json.loads(content)
    assert checker.check_openxr_parametric(document) == []
    kinds = [call["stream_frame_type"] for call in document["calls"]]
    assert (kinds[0], kinds[-1], set(kinds[1:-1])) == ("first", "last", {"intermediate"})
    (clip,) = (curves_of(one, CurveSettings(range_hz=(20.0, 500.0))) for one in long.channels.values())
    points = [point for call in document["calls"] for point in call["amplitude_points"]]
    times = np.array([point["time_ns"] for point in points]) / 1e9
    joined = np.interp(t, times, [point["value"] for point in points])
    np.testing.assert_allclose(joined, clip.amplitude.at(t), atol=1e-5)
    # A runtime gets frame by frame, and does not interpolate to a point of a later frame.
    for one, call in pairwise(document["calls"]):
        end = one["amplitude_points"][-1]["time_ns"]
        assert one["frequency_points"][-1]["time_ns"] == end
        middle = (end + call["amplitude_points"][-1]["time_ns"]) / 2e9
        rows = [one["frequency_points"][-1], *call["frequency_points"]]
        found = np.interp(middle, [row["time_ns"] / 1e9 for row in rows], [row["value"] for row in rows])
        assert clip.frequency is not None
        assert found == pytest.approx(clip.frequency.at([middle])[0], abs=1e-5)


@pytest.mark.parametrize(("kind", "power"), [("haptic", 2.0), ("ahap", 1.0)])
def test_a_drawn_curve_has_the_reported_error_in_a_format_with_other_lines(
    kind: str, power: float, tmp_path: Path
) -> None:
    """Between two points, AHAP is linear in the root of the amplitude, and .haptic in the amplitude itself."""
    clip = HapticClip(Curve(np.array([0.0, 2.0]), np.array([0.0, 1.0]), power))
    channel = Channel(synthesize(clip), RATE, clip=clip)
    exported = made(kind, Track("drawn", {"": channel}))
    (path,) = (tmp_path / name for name in exported.files)
    path.write_bytes(*exported.files.values())
    found = fidelity(channel, read_haptic_clip(path))
    assert found.median_db > 5.0
    assert fidelity(channel, exported.played[""]).median_db == pytest.approx(found.median_db, abs=0.01)


def test_transients_before_the_amplitude_curve_are_kept(tmp_path: Path) -> None:
    """In AHAP, taps may come before the first continuous event."""
    taps = Transient(0.25, 0.8, 0.5), Transient(0.5, 0.4, 0.5)
    clip = HapticClip(Curve(np.array([1.0, 2.0]), np.array([0.25, 0.25])), transients=taps)
    path = tmp_path / "tap.haptic"
    path.write_bytes(*made("haptic", Track("tap", {"": Channel(synthesize(clip), RATE, clip=clip)})).files.values())
    assert checker.check_haptic(json.loads(path.read_bytes())) == []
    again = read_haptic_clip(path)
    assert again.transients == taps
    np.testing.assert_array_equal(synthesize(again), synthesize(clip))


def test_hjif_plays_the_middle_before_a_frequency_curve_that_begins_later() -> None:
    late = Curve(np.array([1.0, 2.0]), np.array([0.2, 0.8]))
    clip = HapticClip(Curve(np.array([0.0, 2.0]), np.ones(2)), late, range_hz=(50.0, 150.0))
    track = Track("late", {"": Channel(synthesize(clip), RATE, clip=clip)})
    document = json.loads(made("hjif", track).files["late.hjif"])
    (band,) = document["perceptions"][0]["channels"][0]["bands"]
    frames = band["effects"][0]["keyframes"]
    found = [(one["relative_position"], one["frequency_modulation"]) for one in frames]
    assert found == [(0, 100), (1000, 100), (1000, 70), (2000, 130)]


def test_the_report_of_ahap_counts_a_frequency_curve_that_begins_later(tmp_path: Path) -> None:
    """An AHAP player plays sharpness 0 until the curve begins, and a `.haptic` player the middle."""
    late = Curve(np.array([1.0, 2.0]), np.array([0.5, 0.5]))
    clip = HapticClip(Curve(np.array([0.0, 2.0]), np.ones(2)), late)
    channel = Channel(synthesize(clip), RATE, clip=clip)
    exported = made("ahap", Track("late", {"": channel}))
    path = tmp_path / "late.ahap"
    path.write_bytes(exported.files["late.ahap"])
    played = exported.played[""]
    assert isinstance(played, HapticClip)
    t = np.array([0.0, 0.5, 0.99, 1.0, 1.5])
    np.testing.assert_allclose(played.frequency_hz(t), read_haptic_clip(path).frequency_hz(t), atol=1e-4)
    error = fidelity(channel, played)
    assert error.p95_jnd == pytest.approx(np.log(127.5 / 55.0) / np.log(1.22), abs=0.1)
    haptic = fidelity(channel, made("haptic", Track("late", {"": channel})).played[""])
    assert haptic.p95_jnd == pytest.approx(0.0, abs=0.1)


@pytest.mark.parametrize("stream", [False, True])
def test_openxr_plays_the_middle_before_a_frequency_curve_that_begins_later(stream: bool) -> None:
    clip = HapticClip(Curve(np.array([0.0, 2.0]), np.ones(2)), Curve(np.array([1.0, 2.0]), np.array([0.2, 0.8])))
    track = Track("late", {"": Channel(synthesize(clip), RATE, clip=clip)})
    document = json.loads(made({"kind": "openxr_parametric", "stream": stream}, track).files["late.json"])
    assert checker.check_openxr_parametric(document) == []
    points = [point for call in document["calls"] for point in call["frequency_points"]]
    assert {point["value"] for point in points if point["time_ns"] < 1e9} == {0.5}
    assert points[-1] == {"time_ns": 2_000_000_000, "value": 0.8}


def test_stream_frames_have_the_duration_requested_by_the_runtime(tour: Track) -> None:
    spec = {"kind": "openxr_parametric", "stream": True, "first_frame_s": 0.1, "frame_s": 0.02}
    document = json.loads(made(spec, tour).files["tour.left.json"])
    assert checker.check_openxr_parametric(document, first_frame_ns=100_000_000) == []
    ends = np.array([call["amplitude_points"][-1]["time_ns"] for call in document["calls"]])
    assert ends[0] == 100_000_000
    np.testing.assert_array_equal(np.diff(ends)[:-1], 20_000_000)


def test_a_silent_a_single_and_an_unusual_track(tour: Track) -> None:
    silent = Track("silent", {"": Channel(np.zeros(RATE), RATE, is_loop=True)})
    document = json.loads(made("haptic", silent).files["silent.haptic"])
    points = document["signals"]["continuous"]["envelopes"]["amplitude"]
    assert [point["amplitude"] for point in points] == [0.0, 0.0]
    assert set(json.loads(made("android", silent).files["silent.json"])["amplitudes"]) == {0}
    crowd = Track("crowd", {f"finger {i}": Channel(np.zeros(80), RATE) for i in range(128)})
    with pytest.raises(ConfigError, match="crowd has 128 channels; HJIF holds 127"):
        made("hjif", crowd)


@pytest.mark.parametrize(
    ("samples", "rate", "told"),
    [
        (np.zeros((2, 2)), 8000, r"samples has shape \(2, 2\)"),
        (np.zeros(0), 8000, r"samples has shape \(0,\)"),
        (np.array([0.0, np.nan]), 8000, r"samples\[1\] is nan; it must be within 1"),
        (np.array([0.0, 1.5]), 8000, r"samples\[1\] is 1.5; it must be within 1"),
        (np.zeros(10), 0, "sample_rate_hz is 0 Hz; it must be at least 100"),
        (np.zeros(70_000), 100, "the signal lasts 700 s; it must last at most 600 s"),
    ],
)
def test_signals_that_cannot_be_exported_are_refused(samples: np.ndarray, rate: int, told: str) -> None:
    with pytest.raises(ExportError, match=told):
        Channel(samples, rate)
