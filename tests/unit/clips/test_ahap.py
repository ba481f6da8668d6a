"""AHAP files: published pairs, limits of events and curves, and unusual files as Apple's player plays them."""

from __future__ import annotations

import itertools
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from others import SHARED, needed
from scene2hap.clips.ahap import compose_ahap, read_ahap
from scene2hap.clips.haptic_clip import ClipWarning, Curve, HapticClip, Transient
from scene2hap.clips.haptic_format import read_haptic
from scene2hap.clips.reading import read_haptic_clip
from scene2hap.clips.synthesis import synthesize
from scene2hap.errors import ClipError

SAMPLES = SHARED / "formats" / "haptic"
PAIRS = {
    "16_points": ("16_points",),
    "2_points": ("2_points",),
    "valid_v1": ("valid_v1_continuous", "valid_v1_transients"),
}


def control_points(document: dict[str, Any], control: str, *, absolute: bool) -> list[tuple[float, float]]:
    """Points of all curves of a control, with times from the file's beginning; `absolute`: the file has such times."""
    found: list[tuple[float, float]] = []
    for item in document["Pattern"]:
        curve = item.get("ParameterCurve")
        if curve and curve["ParameterID"] == control:
            start = 0.0 if absolute else curve["Time"]
            found += [
                (round(start + one["Time"], 9), one["ParameterValue"]) for one in curve["ParameterCurveControlPoints"]
            ]
    return list(dict.fromkeys(found))


def put(folder: Path, documents: dict[str, Any], stem: str = "x") -> Path:
    for ending, document in documents.items():
        (folder / f"{stem}{ending}.ahap").write_text(json.dumps(document))
    return folder / f"{stem}{next(iter(documents))}.ahap"


@pytest.mark.filterwarnings("ignore::scene2hap.clips.haptic_clip.ClipWarning")  # for 2_points
@pytest.mark.parametrize("name", PAIRS)
def test_published_pairs_give_equal_clips(name: str) -> None:
    ours = compose_ahap(read_haptic(needed(SAMPLES / f"{name}.haptic")))
    theirs = [json.loads((SAMPLES / f"{part}.ahap").read_text()) for part in PAIRS[name]]
    for control in ("HapticIntensityControl", "HapticSharpnessControl"):
        mine = np.array(control_points(ours[next(iter(ours))], control, absolute=False))
        other = np.array(control_points(theirs[0], control, absolute=True))
        np.testing.assert_allclose(mine, other, atol=1e-3)
    transients = [item["Event"] for one in ours.values() for item in one["Pattern"] if is_transient(item)]
    expected = [item["Event"] for one in theirs for item in one["Pattern"] if is_transient(item)]
    assert len(transients) == len(expected)
    for mine, other in zip(transients, expected, strict=True):
        assert mine["Time"] == pytest.approx(other["Time"], abs=1e-3)
        for a, b in zip(mine["EventParameters"], other["EventParameters"], strict=True):
            assert a["ParameterID"] == b["ParameterID"]
            assert a["ParameterValue"] == pytest.approx(b["ParameterValue"], abs=1e-3)


def is_transient(item: dict[str, Any]) -> bool:
    return bool(item.get("Event", {}).get("EventType") == "HapticTransient")


@pytest.mark.parametrize("name", ["16_points", "2_points", "studio_export", "valid_v1_continuous"])
def test_ahap_round_trip_is_exact(name: str, tmp_path: Path) -> None:
    first = compose_ahap(read_haptic_clip(needed(SAMPLES / f"{name}.ahap")))
    assert compose_ahap(read_ahap(put(tmp_path, first))) == first


def test_long_clips_are_split_without_a_gap(tmp_path: Path) -> None:
    times = np.linspace(0.0, 70.0, 201)
    values = 0.5 + 0.4 * np.sin(times)
    clip = HapticClip(Curve(times, values, 2.0), Curve(times[::3], values[::3], 2.0))
    (document,) = compose_ahap(clip).values()
    events = [item["Event"] for item in document["Pattern"] if "Event" in item]
    assert [event["EventDuration"] for event in events] == [30.0, 30.0, 10.0]
    assert [event["Time"] for event in events] == [0.0, 30.0, 60.0]
    curves = [item["ParameterCurve"] for item in document["Pattern"] if "ParameterCurve" in item]
    assert max(len(curve["ParameterCurveControlPoints"]) for curve in curves) == 16
    for one, other in itertools.pairwise(curves):
        if one["ParameterID"] == other["ParameterID"]:
            end, start = one["ParameterCurveControlPoints"][-1], other["ParameterCurveControlPoints"][0]
            assert one["Time"] + end["Time"] == pytest.approx(other["Time"], abs=1e-9)
            assert start["Time"] == 0.0
            assert end["ParameterValue"] == start["ParameterValue"]
    read = read_ahap(put(tmp_path, {"": document}))
    t = np.linspace(0.0, 70.0, 4001)
    np.testing.assert_allclose(read.amplitude.at(t), clip.amplitude.at(t), atol=1e-9)


def item(kind: str, time: float, duration: float | None = None, **parameters: float) -> dict[str, Any]:
    event: dict[str, Any] = {"Time": time, "EventType": f"Haptic{kind}"}
    if duration is not None:
        event["EventDuration"] = duration
    event["EventParameters"] = [{"ParameterID": f"Haptic{k}", "ParameterValue": v} for k, v in parameters.items()]
    return {"Event": event}


def curve(control: str, time: float, *points: tuple[float, float]) -> dict[str, Any]:
    rows = [{"Time": t, "ParameterValue": v} for t, v in points]
    return {
        "ParameterCurve": {"ParameterID": f"Haptic{control}Control", "Time": time, "ParameterCurveControlPoints": rows}
    }


def clip_of(folder: Path, *pattern: dict[str, Any]) -> HapticClip:
    return read_ahap(put(folder, {"": {"Version": 1.0, "Pattern": list(pattern)}}))


def test_events_follow_one_another_pause_and_overlap(tmp_path: Path) -> None:
    clip = clip_of(
        tmp_path,
        item("Continuous", 0.0, 1.0, Intensity=0.5, Sharpness=0.3),
        item("Continuous", 2.0, 2.0, Intensity=0.4, Sharpness=0.8),
        item("Continuous", 3.0, 1.0, Intensity=0.4, Sharpness=0.8),
    )
    np.testing.assert_allclose(np.sqrt(clip.amplitude.at([0.5, 1.5, 2.5, 3.5])), [0.5, 0.0, 0.4, 0.8])
    assert clip.duration_s == 4.0
    assert clip.frequency is not None
    np.testing.assert_allclose(np.sqrt(clip.frequency.at([0.5, 2.5])), [0.3, 0.8])


def test_curves_apply_to_all_events_and_start_neutral(tmp_path: Path) -> None:
    clip = clip_of(
        tmp_path,
        item("Continuous", 0.0, 4.0, Intensity=0.8, Sharpness=0.2),
        item("Transient", 3.0, Intensity=1.0, Sharpness=0.4),
        curve("Intensity", 1.0, (0.0, 1.0), (2.0, 0.5)),
        curve("Sharpness", 1.0, (0.0, 0.0), (2.0, 0.3)),
    )
    np.testing.assert_allclose(np.sqrt(clip.amplitude.at([0.5, 2.0, 3.5])), [0.8, 0.8 * 0.75, 0.4])
    assert clip.frequency is not None
    np.testing.assert_allclose(np.sqrt(clip.frequency.at([0.5, 2.0, 3.5])), [0.2, 0.35, 0.5])
    (pulse,) = clip.transients
    assert (pulse.amplitude, pulse.frequency) == pytest.approx((0.25, 0.7))


def test_times_from_the_beginning_of_the_file_are_recognised(tmp_path: Path) -> None:
    event = item("Continuous", 0.0, 3.0, Intensity=1.0, Sharpness=0.0)
    absolute = clip_of(tmp_path, event, curve("Intensity", 1.0, (1.0, 1.0), (2.0, 0.0)))
    relative = clip_of(tmp_path, event, curve("Intensity", 1.0, (0.0, 1.0), (1.0, 0.0)))
    t = np.linspace(0.0, 3.0, 301)
    np.testing.assert_allclose(absolute.amplitude.at(t), relative.amplitude.at(t))


def test_a_curve_that_begins_later_leaves_the_sharpness_of_the_event_before(tmp_path: Path) -> None:
    event = item("Continuous", 0.0, 2.0, Intensity=1.0, Sharpness=0.0)
    clip = clip_of(tmp_path, event, curve("Sharpness", 1.0, (0.0, 0.0), (0.5, 1.0)))
    np.testing.assert_allclose(clip.frequency_hz([0.0, 0.9, 1.0, 1.6]), [55.0, 55.0, 55.0, 200.0])
    t = np.arange(8000) / 8000
    np.testing.assert_allclose(synthesize(clip)[:8000], np.sin(2 * np.pi * 55.0 * t), atol=1e-6)


def test_missing_and_out_of_range_values_follow_the_phone(tmp_path: Path) -> None:
    clip = clip_of(tmp_path, {"Event": {"EventType": "HapticContinuous", "EventDuration": 1}, "Extra": 1})
    assert clip.frequency is not None
    assert (clip.amplitude.at([0.5])[0], clip.frequency.at([0.5])[0]) == (1.0, 0.25)
    with pytest.warns(ClipWarning, match=r"x.ahap: an event lasts 90 s; the player ends it after 30 s"):
        loud = clip_of(tmp_path, item("Continuous", 0.0, 90.0, Intensity=3.0, Sharpness=-1.0))
    assert (loud.amplitude.at([0.5])[0], loud.duration_s) == (1.0, 30.0)
    with pytest.warns(ClipWarning, match="an event of type 'AudioCustom' in it is not played"):
        clip_of(tmp_path, item("Transient", 0.1, Intensity=1.0), {"Event": {"Time": 0, "EventType": "AudioCustom"}})


def test_a_value_holds_until_the_next_parameter_or_curve(tmp_path: Path) -> None:
    """In an earlier version it moved in a line towards the next one, which nobody drew."""

    def parameter(time_s: float, value: float) -> dict[str, Any]:
        return {"Parameter": {"ParameterID": "HapticIntensityControl", "Time": time_s, "ParameterValue": value}}

    event = item("Continuous", 0.0, 2.0, Intensity=1.0)
    later = curve("Intensity", 1.5, (0.0, 0.8), (0.5, 0.6))
    clip = clip_of(tmp_path, event, later, parameter(1.0, 1.0), parameter(0.5, 0.5))
    roots = np.sqrt(clip.amplitude.at([0.25, 0.75, 0.99, 1.25, 1.49, 1.75]))
    np.testing.assert_allclose(roots, [1.0, 0.5, 0.5, 1.0, 1.0, 0.7], atol=1e-9)


def test_envelope_of_an_event_is_reported_as_not_played(tmp_path: Path) -> None:
    event = item("Continuous", 0.0, 1.0, Intensity=1.0)
    event["Event"]["EventParameters"] += [
        {"ParameterID": "Sustained", "ParameterValue": 1.0},
        {"ParameterID": "AttackTime", "ParameterValue": 0.3},
    ]
    with pytest.warns(ClipWarning, match=r": the parameter 'AttackTime' of an event in it is not played"):
        clip_of(tmp_path, event)


def test_transients_alone_are_a_clip(tmp_path: Path) -> None:
    clip = clip_of(tmp_path, item("Transient", 0.5, Intensity=0.5, Sharpness=0.9))
    assert clip.transients == (Transient(0.5, 0.25, 0.9),)
    assert not clip.amplitude.values.any()
    assert clip.duration_s > 0.5


@pytest.mark.parametrize(
    ("document", "told"),
    [
        ({"signals": {}}, "is no AHAP file: it lacks 'Pattern' and has signals"),
        ({"Pattern": 3}, "Pattern is 3; it must be a list"),
        ({"Pattern": []}, "Pattern has no haptic event"),
        ({"Pattern": [item("Continuous", -1.0, 1.0)]}, r"Pattern\[0\].Event.Time is -1 s; it must be at least 0"),
        ({"Pattern": [item("Continuous", 0.0, float("nan"))]}, r"EventDuration is nan s; it must be finite"),
        (
            {"Pattern": [curve("Intensity", 0.0, (1.0, 1.0), (0.5, 1.0))]},
            r"Points\[1\].Time is 0.5 s; it must not be before",
        ),
        (
            {"Pattern": [item("Continuous", i, 1.0) for i in range(201)]},
            "has 201 continuous events; it must have at most",
        ),
        ({"Pattern": [item("Transient", 0.0)] * 100_001}, "Pattern has 100001 items; it must have at most 100000"),
    ],
)
def test_error_names_file_field_and_bound(tmp_path: Path, document: dict[str, Any], told: str) -> None:
    path = put(tmp_path, {"": document})
    with pytest.raises(ClipError, match=told) as caught:
        read_ahap(path)
    assert str(path) in str(caught.value)


def test_a_curve_that_goes_on_behind_its_events_is_followed_to_their_end(tmp_path: Path) -> None:
    event = item("Continuous", 0.5, 1.5, Intensity=1.0, Sharpness=0.0)
    clip = clip_of(tmp_path, event, curve("Sharpness", 0.0, (0.0, 0.0), (4.0, 1.0)))
    assert clip.frequency is not None
    np.testing.assert_allclose(np.sqrt(clip.frequency.at([0.5, 1.0, 2.0])), [0.125, 0.25, 0.5])
