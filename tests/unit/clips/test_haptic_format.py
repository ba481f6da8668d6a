"""`.haptic` files: accepted files, error messages of others, and exact round trips."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import soundfile
from hypothesis import given, settings, strategies as st

from others import SHARED, needed
from scene2hap.clips.haptic_clip import ClipWarning, Curve, HapticClip, Transient
from scene2hap.clips.haptic_format import compose_haptic, read_haptic
from scene2hap.clips.reading import read_any_clip, read_haptic_clip
from scene2hap.errors import AudioError, ClipError

SAMPLES = SHARED / "formats" / "haptic"
REFUSED = {
    "invalid_empty_amplitude_envelope",
    "invalid_zero_duration",
    "validation_v1_amplitude",
    "validation_v1_sequence",
}
ACCEPTED = {"16_points", "valid_required_v1", "valid_v1", "validation_v1_optionals"}


def document(amplitude: list[dict[str, Any]], frequency: list[dict[str, Any]] | None = None) -> dict[str, Any]:
    envelopes: dict[str, Any] = {"amplitude": amplitude}
    if frequency is not None:
        envelopes["frequency"] = frequency
    return {"version": {"major": 1}, "signals": {"continuous": {"envelopes": envelopes}}}


def points(*pairs: tuple[float, float]) -> list[dict[str, Any]]:
    return [{"time": time, "amplitude": value} for time, value in pairs]


def put(folder: Path, found: object, name: str = "kettle.haptic") -> Path:
    path = folder / name
    path.write_text(found if isinstance(found, str) else json.dumps(found), encoding="utf-8")
    return path


@pytest.mark.parametrize("name", sorted(ACCEPTED | REFUSED))
def test_published_files_are_accepted_or_refused_as_their_names_say(name: str) -> None:
    path = needed(SAMPLES / f"{name}.haptic")
    if name in ACCEPTED:
        assert len(read_haptic(path).amplitude) >= 2
    else:
        with pytest.raises(ClipError, match=str(path)):
            read_haptic(path)


@pytest.mark.parametrize("name", ["2_points", "invalid_freq_bp_outside_amp_env"])
def test_files_of_earlier_programs_are_read_with_a_warning(name: str) -> None:
    path = needed(SAMPLES / f"{name}.haptic")
    with pytest.warns(ClipWarning, match="lies outside of the amplitude curve"):
        assert read_haptic_clip(path).frequency is not None


WRONG: dict[str, tuple[object, str]] = {
    "no JSON": ('{"version": ', "is no .haptic file, which is JSON"),
    "a list": ("[]", "the whole file is a list; it must be an object"),
    "another format": ({"Version": 1, "Pattern": []}, "lacks 'signals' and has Version, Pattern. Check its suffix"),
    "unknown version": (
        {"version": {"major": 2}, "signals": {}},
        "version.major is 2; it must be 1. Export the clip as version 1",
    ),
    "no version": ({"signals": {}}, "version is missing"),
    "no amplitude": (document([]) | {"signals": {"continuous": {"envelopes": {}}}}, "amplitude is missing"),
    "one point": (document(points((0, 1))), "envelopes.amplitude has 1 points; it must have at least 2"),
    "back in time": (
        document(points((0, 1), (0.2, 1), (0.1, 1))),
        r"amplitude\[2\].time is 0.1 s; it must not be before",
    ),
    "no duration": (document(points((0.5, 1), (0.5, 1))), "lasts 0 s; it must be longer than 0 s"),
    "NaN": (document(points((0, 1), (1, float("nan")))), r"amplitude\[1\].amplitude is nan; it must be finite"),
    "endless": (document(points((0, 1), (float("inf"), 1))), r"amplitude\[1\].time is inf s; it must be finite"),
    "too strong": (document(points((0, 1), (1, 1.5))), r"amplitude\[1\].amplitude is 1.5; it must be at most 1"),
    "below 0": (document(points((0, -0.1), (1, 1))), r"amplitude\[0\].amplitude is -0.1; it must be at least 0"),
    "text": (
        document([*points((0, 1)), {"time": "1", "amplitude": 1}]),
        r"amplitude\[1\].time is '1'; it must be a num",
    ),
    "true": (document([*points((0, 1)), {"time": 1, "amplitude": True}]), r"amplitude\[1\].amplitude is True"),
    "weak emphasis": (
        document([{"time": 0, "amplitude": 0.5, "emphasis": {"amplitude": 0.4, "frequency": 0}}, *points((1, 0))]),
        r"amplitude\[0\].emphasis.amplitude is 0.4; it must be at least that of its point, 0.5",
    ),
    "emphasis without frequency": (
        document([{"time": 0, "amplitude": 0.5, "emphasis": {"amplitude": 0.6}}, *points((1, 0))]),
        r"amplitude\[0\].emphasis.frequency is missing",
    ),
    "frequency back in time": (
        document(points((0, 1), (1, 1)), [{"time": 0.5, "frequency": 1}, {"time": 0.4, "frequency": 1}]),
        r"frequency\[1\].time is 0.4 s; it must not be before",
    ),
    "an hour": (document(points((0, 1), (3600, 1))), r"amplitude\[1\].time is 3600 s; it must be at most 600"),
    "points that are none": (document([1, 2]), r"amplitude\[0\] is 1; it must be an object"),
}


@pytest.mark.parametrize("what", WRONG)
def test_error_names_file_field_and_bound(tmp_path: Path, what: str) -> None:
    found, told = WRONG[what]
    path = put(tmp_path, found)
    with pytest.raises(ClipError, match=told) as caught:
        read_haptic(path)
    assert str(path) in str(caught.value)
    assert len(str(caught.value)) < 500 + len(str(path))


def test_frequency_behind_the_end_is_not_played(tmp_path: Path) -> None:
    path = put(tmp_path, document(points((0, 1), (1, 1)), [{"time": 2, "frequency": 1}]))
    told = r"frequency\[0\].time is 2 s, which lies outside of the amplitude curve, 0 to 1 s. The clip is read without"
    with pytest.warns(ClipWarning, match=told):
        assert read_haptic(path).duration_s == 1.0


def test_excessive_and_invalid_files_are_refused(tmp_path: Path) -> None:
    many = put(tmp_path, document([{"time": 0, "amplitude": 0}] * 1_000_000))
    with pytest.raises(ClipError, match="amplitude has 1000000 items; it must have at most 100000. Split the clip"):
        read_haptic(many)
    wav = tmp_path / "wave.haptic"
    wav.write_bytes(b"RIFF\x24\x00\xff\xfeWAVEfmt ")
    with pytest.raises(ClipError, match="is no .haptic file, which is JSON"):
        read_haptic(wav)
    with pytest.raises(ClipError, match=r"absent.haptic: cannot be read as .haptic"):
        read_haptic(tmp_path / "absent.haptic")
    with pytest.raises(ClipError, match="cannot be read as .haptic: (?i:is a directory)"):
        read_haptic(tmp_path)
    with pytest.raises(ClipError, match=r"suffix .haptic or .ahap"):
        read_haptic_clip(tmp_path / "sound.ogg")
    with pytest.raises(ClipError, match="'kettle' is silent"):
        read_any_clip(put(tmp_path, document(points((0, 0), (1, 0)))))


unit = st.floats(0.0, 1.0)
times = st.lists(st.floats(0.0, 500.0), min_size=2, max_size=12).map(sorted).filter(lambda found: found[0] < found[-1])


@st.composite
def clips(draw: st.DrawFn) -> HapticClip:
    at = draw(times)
    amplitude = [draw(unit) for _ in at]
    frequency = None
    if draw(st.booleans()):
        inside = sorted(draw(st.lists(st.floats(at[0], at[-1]), min_size=1, max_size=8)))
        frequency = Curve(np.array(inside), np.array([draw(unit) for _ in inside]))
    pulses = sorted(set(draw(st.lists(st.floats(at[0], at[-1]), max_size=4))))
    transients = tuple(Transient(time, draw(unit), draw(unit)) for time in pulses)
    return HapticClip(Curve(np.array(at), np.array(amplitude)), frequency, transients)


@settings(max_examples=60)
@given(clip=clips())
def test_haptic_round_trip_is_exact(clip: HapticClip, tmp_path_factory: pytest.TempPathFactory) -> None:
    first = compose_haptic(clip)
    path = put(tmp_path_factory.mktemp("clip"), first)
    read = read_haptic(path)
    assert compose_haptic(read) == first
    t = np.linspace(0.0, clip.duration_s, 200)
    np.testing.assert_allclose(read.amplitude.at(t), clip.amplitude.at(t), atol=1e-9)
    assert [one.time_s for one in read.transients] == [one.time_s for one in clip.transients]


def test_metadata_becomes_the_credit(tmp_path: Path) -> None:
    found = document(points((0, 0.5), (1, 0.5))) | {"metadata": {"editor": "Studio", "author": "Ada", "tags": ["a"]}}
    path = put(tmp_path, found)
    clip = read_any_clip(path)
    assert (clip.credit.title, clip.credit.author, clip.credit.origin) == ("kettle", "Ada", "haptic clip, Studio")
    assert clip.is_vibration
    assert compose_haptic(read_haptic(path))["metadata"]["tags"] == ["a"]
    with pytest.raises(ClipError, match="metadata.author is 3; it must be a text"):
        read_haptic(put(tmp_path, found | {"metadata": {"author": 3}}))


@pytest.mark.parametrize("name", ["fan.hjif", "fan.json", "fan.f32"])
def test_a_file_that_is_neither_clip_nor_sound_is_refused_with_both_lists(tmp_path: Path, name: str) -> None:
    (tmp_path / name).write_text('{"version": "1"}')
    with pytest.raises(
        AudioError, match=r"\(Format not recognised\)\. Use WAV, .* or Opus, or a haptic clip: \.haptic, \.ahap"
    ):
        read_any_clip(tmp_path / name)


def test_a_sound_with_another_suffix_that_cannot_be_used_is_refused_as_a_sound(tmp_path: Path) -> None:
    soundfile.write(tmp_path / "fan.data", np.zeros((10, 80)), 8000, format="WAV")
    with pytest.raises(AudioError, match=r"has 80 channels; it must have at most 64\. Mix some\.$"):
        read_any_clip(tmp_path / "fan.data")
    (tmp_path / "pointer.data").write_text(
        f"version https://git-lfs.github.com/spec/v1\noid sha256:{64 * 'a'}\nsize 9\n"
    )
    with pytest.raises(AudioError, match=r"`git lfs pull` in its repository\.$"):
        read_any_clip(tmp_path / "pointer.data")
