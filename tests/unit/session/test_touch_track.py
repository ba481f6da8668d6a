"""Touch files: JSON and CSV give the same track, and errors name the wrong field."""

import json
import os
import re
from pathlib import Path

import pytest

from scene2hap import HapticSession, MemorySink, TouchTrack, play_track
from scene2hap.errors import SessionError, UnknownObject
from scene2hap.render.safety import FADE_OUT_S
from scene2hap.session.touch_track import SourceStep
from scene2hap.session.track_player import PlayedFrame
from scenes import RATE, table_with_two_phones

DOCUMENT = {
    "format": "scene2hap/touches",
    "version": 1,
    "duration_s": 4.0,
    "steps": [
        {"time_s": 0.5, "hand": "left", "touch": "phone"},
        {"time_s": 1.0, "hand": "left", "touch": "table", "point_m": [0.2, 0.72, 0.4]},
        {"time_s": 1.5, "hand": "left", "touch": "table", "point_m": [1.2, 0.72, 0.4], "glide_s": 1.0},
        {"time_s": 2.6, "move": "alarm", "by_m": [0.0, 0.3, 0.0], "glide_s": 0.2},
        {"time_s": 3.0, "source": "phone", "on": False},
        {"time_s": 3.5, "hand": "left", "lift": True},
    ],
}
CSV = """\
time_s,hand,touch,x_m,y_m,z_m,glide_s,move,by_x_m,by_y_m,by_z_m,source,on,lift
0.5,left,phone,,,,,,,,,,,
1.0,left,table,0.2,0.72,0.4,,,,,,,,
1.5,left,table,1.2,0.72,0.4,1.0,,,,,,,
2.6,,,,,,0.2,alarm,0,0.3,0,,,
3.0,,,,,,,,,,,phone,false,
3.5,left,,,,,,,,,,,,true
4.0,,,,,,,,,,,,,
"""


def changed(step: int, **fields: object) -> dict[str, object]:
    steps = [dict(item) for item in DOCUMENT["steps"]]
    steps[step].update(fields)
    return {**DOCUMENT, "steps": steps}


def test_json_and_csv_give_the_same_track(tmp_path: Path) -> None:
    (tmp_path / "touches.json").write_text(json.dumps(DOCUMENT))
    (tmp_path / "touches.csv").write_text(CSV)
    assert TouchTrack.load(tmp_path / "touches.json") == TouchTrack.load(tmp_path / "touches.csv")


@pytest.mark.parametrize(("written", "on"), [("1", True), ("0", False), ("TRUE", True), ("false", False)])
def test_flags_of_a_spreadsheet(tmp_path: Path, written: str, on: bool) -> None:
    (tmp_path / "touches.csv").write_text(f"time_s,source,on\n0.5,fan,{written}\n1,,\n")
    assert TouchTrack.load(tmp_path / "touches.csv").steps == (SourceStep(time_s=0.5, source="fan", on=on),)


def test_csv_of_a_spreadsheet_in_a_country_of_decimal_commas(tmp_path: Path) -> None:
    """As Excel saves it in German: a byte-order mark, semicolons, decimal commas, upper-case truth, empty last rows."""
    (tmp_path / "touches.json").write_text(json.dumps(DOCUMENT))
    german = CSV.replace(",", ";").replace(".", ",").replace("true", "TRUE") + ";" * 13 + "\n"
    for text in (german, german.replace(";", "\t")):
        (tmp_path / "touches.csv").write_text(text, "utf-8-sig", newline="\r\n")
        assert TouchTrack.load(tmp_path / "touches.csv") == TouchTrack.load(tmp_path / "touches.json")
    (tmp_path / "touches.csv").write_text("time_s,hand,touch\n0.5,left,Küche\n1.0,,\n", "cp1252", newline="\n")
    with pytest.raises(SessionError, match="byte 28 is 0xfc, which is not UTF-8; save the text as UTF-8"):
        TouchTrack.load(tmp_path / "touches.csv")


@pytest.mark.parametrize(("duration_s", "update_rate_hz"), [(1.5, 1.0), (1.0, 3.0), (1.4, 3.0), (0.504, 100.0)])
def test_a_track_is_played_to_its_end(duration_s: float, update_rate_hz: float) -> None:
    sink = MemorySink()
    with HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE}, sink=sink) as session:
        track = TouchTrack.parse({"duration_s": duration_s, "steps": []})
        play_track(session, track, sink, update_rate_hz=update_rate_hz)
        assert len(sink.samples) == round(duration_s * RATE)


def play(document: object = DOCUMENT) -> list[PlayedFrame]:
    frames: list[PlayedFrame] = []
    sink = MemorySink()
    with HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE}, sink=sink) as session:
        play_track(session, TouchTrack.parse(document), sink, on_frame=frames.append)
    assert len(sink.samples) == 4 * RATE + round(FADE_OUT_S * RATE)
    return frames


def test_playing_follows_the_steps() -> None:
    frames = {round(played.time_s, 2): played for played in play()}
    assert frames[0.4].touches == ()
    on_phone = frames[0.6]
    assert on_phone.frame.gain("left", "phone") == 1.0
    # Without a point, the touch is at the middle of the dominant surface, here the phone's top.
    assert on_phone.touches[0].point_m == pytest.approx((0.1, 0.73, 0.4))
    assert [frames[t].touches[0].point_m[0] for t in (1.2, 1.5, 1.75, 2.0, 2.5, 2.55)] == pytest.approx(
        [0.2, 0.2, 0.45, 0.7, 1.2, 1.2]
    )
    gains = [frames[t].frame.gain("left", "alarm") for t in (1.2, 1.75, 2.0, 2.5)]
    assert gains == sorted(gains)
    assert frames[2.9].frame.gain("left", "alarm") == 0.0
    assert frames[2.9].frame.gain("left", "phone") > 0.0
    assert frames[3.1].frame.gain("left", "phone") == 0.0
    assert frames[3.6].touches == ()


def test_a_hand_goes_along_with_the_object_it_holds() -> None:
    steps = [
        {"time_s": 0.0, "hand": "left", "touch": "phone", "point_m": [0.12, 0.73, 0.4]},
        {"time_s": 1.0, "move": "phone", "to_m": [0.1, 1.725, 0.4], "glide_s": 1.0},
    ]
    frames = {round(played.time_s, 2): played for played in play({**DOCUMENT, "steps": steps})}
    assert [frames[t].touches[0].point_m[1] for t in (0.5, 1.5, 2.5)] == pytest.approx([0.73, 1.23, 1.73])
    assert all(frames[t].touches[0].point_m[0] == pytest.approx(0.12) for t in (0.5, 1.5, 2.5))


@pytest.mark.parametrize(
    ("document", "sentence"),
    [
        (changed(1, time_s=0.1), r"step 2 is at 0\.1 s, before the one above it at 0\.5 s"),
        (changed(5, time_s=9.0), r"the last step is at 9\.0 s, after the end at 4\.0 s"),
        (changed(0, time_s=-1.0), r"step 1, time_s: it must be at least 0"),
        (changed(3, to_m=[0, 0, 0]), r"step 4: give either to_m or by_m"),
        (changed(2, point_m=[1, 2]), r"step 3, point_m"),
        (changed(0, colour="red"), r"step 1, colour"),
        (changed(1, point_m=[1, True, 2]), r"step 2, point_m\.1: it must be a number.*, got True"),
        (changed(5, lift=1), r"step 6: lift must be true, got 1"),
        (changed(0, time_s="0.5"), r"step 1, time_s: it must be a number.*, got '0\.5'"),
        ({**DOCUMENT, "duration_s": True}, r"duration_s: it must be a number.*, got True"),
        (changed(1, point_m=[1, float("nan"), 2]), r"step 2, point_m\.1: .*finite"),
        ({**DOCUMENT, "steps": [{"time_s": 1.0, "hand": "left"}]}, r"step 1"),
        ({**DOCUMENT, "version": 2}, "version"),
        ({**DOCUMENT, "version": True}, r"version: it must be a whole number.*, got True"),
        ({**DOCUMENT, "duration_s": 0}, "duration_s"),
        ({**DOCUMENT, "duration_s": 1e9}, r"duration_s: it must be at most 600"),
        ({**DOCUMENT, "duration_s": 10**400}, "duration_s"),
        ({**DOCUMENT, "steps": [DOCUMENT["steps"][0]] * 100_001}, r"steps: .*at most 100000 items"),
        ([], "whole file"),
    ],
)
def test_error_names_the_wrong_field(document: object, sentence: str) -> None:
    with pytest.raises(SessionError, match=sentence):
        TouchTrack.parse(document)


@pytest.mark.parametrize(
    ("name", "text"), [("t.json", "{"), ("t.json", "\x00"), ("t.csv", "time_s,hand\n1.0,left\n"), ("t.csv", "")]
)
def test_file_that_is_not_a_track_is_refused(tmp_path: Path, name: str, text: str) -> None:
    (tmp_path / name).write_text(text)
    with pytest.raises(SessionError, match="cannot be read as touches"):
        TouchTrack.load(tmp_path / name)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("time,hand,touch\n0.5,left,cup\n1.0,,\n", "it names 'time', 'hand', 'touch'; name 'time' time_s"),
        ("0.5,left,cup\n1.0,,\n", "must name the columns, time_s among them; it names '0.5', 'left', 'cup'"),
        ("", "the file is empty"),
        ("time_s,hand\n1.0,left\n", "the last row must hold time_s alone"),
        ("time_ms,hand,touch\n500,left,cup\n900,,\n", "name 'time_ms' time_s, and give seconds"),
        ("time_s,hand,touch\n500,left,cup\n1500,,\n", "it must be at most 600.*, got 1500.0. Times are in seconds"),
        ("time_s;source;on\n0,5;fan;WAHR\n1;;\n", "step 1, on: it must be true or false, got 'WAHR'"),
        ("time_s,hand,lift\n0.5,left,VRAI\n1,,\n", "step 1: lift must be true, got 'VRAI'"),
        ("time_s,hand,touch\n0.5 s,left,cup\n1,,\n", "time_s: it must be a number, as 0.5, got '0.5 s'"),
        (
            "time_s,hand,touch\n0.5,left,\n1,,\n",
            "step 1: a step with a hand also has touch, the id of an object, or lift, which is true.",
        ),
        ("time_s,glide_s\n0.5,1\n1,\n", "step 1: a step has one of the fields touch, lift, move, source."),
        ("time_s,hand,touch,x\n0.5,left,cup,3\n1,,,\n", "step 1, x: there is no such field in this step, got 3.0"),
        ("time_s,hand,touch\n0.5,left,cup,0.3\n1,,\n", "line 2 has 4 cells for 3 columns"),
        ("time_s,hand,touch,touch\n0.5,left,cup,pan\n1,,,\n", "two columns are named 'touch'"),
    ],
)
def test_csv_without_its_columns_or_end_says_so(tmp_path: Path, text: str, sentence: str) -> None:
    (tmp_path / "t.csv").write_text(text)
    with pytest.raises(SessionError, match=sentence):
        TouchTrack.load(tmp_path / "t.csv")


def test_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SessionError, match="cannot be read"):
        TouchTrack.load(tmp_path / "nowhere.json")


def test_touch_on_an_unknown_object() -> None:
    with pytest.raises(UnknownObject, match="no object 'tabel'"):
        play(changed(1, touch="tabel"))


@pytest.mark.parametrize("rate_hz", [1e308, 5e-324, 0.0, float("nan"), 48_001])
def test_implausible_rate_is_refused(rate_hz: float) -> None:
    sink = MemorySink()
    with (
        HapticSession(*table_with_two_phones(), {"prepare": "blocking"}, sink=sink) as session,
        pytest.raises(SessionError, match=r"update_rate_hz is .*; it must be"),
    ):
        play_track(session, TouchTrack.parse({"duration_s": 0.1, "steps": []}), sink, update_rate_hz=rate_hz)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")
def test_pipe_is_refused_without_waiting(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "touches.json")
    with pytest.raises(SessionError, match="a pipe or a device"):
        TouchTrack.load(tmp_path / "touches.json")


def test_too_many_steps_are_refused_before_reading() -> None:
    with pytest.raises(SessionError, match="steps: 100001 items; at most 100000 items"):
        TouchTrack.parse({**DOCUMENT, "steps": [{}] * 100_001})


def test_a_track_without_a_single_sample_is_refused() -> None:
    with pytest.raises(SessionError, match=r"duration_s: .*0\.001"):
        TouchTrack.parse({**DOCUMENT, "duration_s": 5e-324, "steps": []})


@pytest.mark.parametrize(
    ("step", "sentence"),
    [
        ({"hand": "left", "touch": "tabel"}, "step 2: the scene has no object 'tabel'"),
        ({"hand": "lft", "touch": "table"}, "step 2: no hand 'lft'"),
        ({"hand": "lft", "lift": True}, "step 2: no hand 'lft'"),
        ({"move": "tabel", "by_m": [0, 0, 0]}, "step 2: the scene has no object 'tabel'"),
        ({"source": "table", "on": False}, "step 2: no source 'table'"),
    ],
)
def test_a_wrong_step_is_named_with_its_file_before_the_first_frame(
    step: dict[str, object], sentence: str, tmp_path: Path
) -> None:
    first = {"time_s": 0.0, "hand": "left", "touch": "table"}
    file = tmp_path / "tour.json"
    file.write_text(json.dumps({"duration_s": 600, "steps": [first, {"time_s": 599.0, **step}]}))
    track = TouchTrack.load(file)
    frames: list[PlayedFrame] = []
    sink = MemorySink()
    with (
        HapticSession(*table_with_two_phones(), sink=sink) as session,
        pytest.raises((SessionError, UnknownObject), match=f"^{re.escape(str(file))}: {sentence}"),
    ):
        play_track(session, track, sink, on_frame=frames.append)
    assert not frames


def test_a_wrong_step_of_a_track_without_a_file_is_named() -> None:
    track = TouchTrack(duration_s=1.0, steps=[{"time_s": 0.0, "hand": "lft", "touch": "table"}])
    sink = MemorySink()
    with (
        HapticSession(*table_with_two_phones(), sink=sink) as session,
        pytest.raises(SessionError, match="^touches: step 1: no hand 'lft'"),
    ):
        play_track(session, track, sink)
