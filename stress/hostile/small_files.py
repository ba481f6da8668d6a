"""Files of touches and of settings, responses of actuators, and prompts."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import numpy as np

from stress.hostile.reader import KEY, add, writes

_STEPS = [
    {"time_s": 0.0, "hand": "left", "touch": "table"},
    {"time_s": 0.02, "hand": "right", "touch": "phone", "point_m": [0.1, 0.73, 0.4]},
    {"time_s": 0.05, "hand": "right", "touch": "phone", "point_m": [0.12, 0.73, 0.4], "glide_s": 0.02},
    {"time_s": 0.08, "move": "phone", "by_m": [0.0, 0.3, 0.0], "glide_s": 0.05, "rotation_xyzw": [0, 0, 0, 1]},
    {"time_s": 0.09, "move": "cup", "to_m": [0.5, 0.8, 0.4]},
    {"time_s": 0.1, "source": "alarm", "on": False, "state": None, "gain_db": -3.0},
    {"time_s": 0.15, "hand": "left", "lift": True},
]


def _track(folder: Path) -> Path:
    document = {"format": "scene2hap/touches", "version": 1, "duration_s": 0.2, "steps": _STEPS}
    (folder / "touches.json").write_text(json.dumps(document))
    return folder / "touches.json"


def _track_csv(folder: Path) -> Path:
    path = folder / "touches.csv"
    path.write_text(
        "time_s,hand,touch,x_m,y_m,z_m,lift\n0,left,table,,,,\n0.1,right,phone,0.1,0.73,0.4,\n0.15,left,,,,,true\n"
        "0.2,,,,,,\n"
    )
    return path


def _toured(path: Path) -> object:
    from scene2hap import HapticSession, MemorySink
    from scene2hap.session.touch_track import TouchTrack
    from scene2hap.session.track_player import PlayedFrame, play_track
    from scenes import table_with_two_phones

    track = TouchTrack.load(path)
    sink, frames = MemorySink(), list[PlayedFrame]()
    if track.duration_s <= 1.0:
        with HapticSession(*table_with_two_phones(), {"prepare": "blocking"}, sink=sink) as session:
            session.start()
            play_track(session, track, sink, on_frame=frames.append)
    return track, frames


add("touches JSON", _track, _toured, names_file=False)
add("touches CSV", _track_csv, _toured, names_file=False)

_TOML = f"""[bake]
enough_candidates = 2
seed = 3
max_cost_usd = 1.5
concurrency = 4
llm = {{kind = "openai", model = "gpt-4o", api_key = "{KEY}", top_p = 0.5}}
audio = [{{kind = "synth"}}]
tactile = {{kind = "envelope"}}
actuator = {{resonance_hz = 150.0, q = 3.0, max_amplitude = 0.9}}
spread = {{octaves = 0.5}}
[bake.prices]
"gpt-4o" = [2.5, 10.0]
[session]
sample_rate_hz = 8000
control_period_s = 0.001
propagation = {{kind = "exponential_plate", max_hops = 3}}
bands = {{kind = "edges", edges_hz = [20.0, 100.0, 500.0]}}
gain_limit_db = 30.0
[user]
gain_db = -6.0
max_amplitude = 0.5
curve_db = [[50.0, 0.0], [200.0, -3.0]]
[user.hands.left]
gain_db = -1.0
"""


def _settings_json(folder: Path) -> Path:
    path = folder / "settings.json"
    path.write_text(json.dumps(tomllib.loads(_TOML)))
    return path


def _set(path: Path) -> object:
    from scene2hap.baking import BakeConfig
    from scene2hap.errors import Scene2HapError
    from scene2hap.session.config import SessionConfig
    from scene2hap.session.user_profile import UserProfile

    found: list[object] = []
    problems = []
    for kind in (BakeConfig, SessionConfig, UserProfile):
        try:
            settings = kind.parse(path)
            found.append({name: getattr(settings, name) for name in type(settings).model_fields if name != "llm"})
        except Scene2HapError as problem:
            problems.append(problem)
    if problems:
        raise problems[0]
    return found


add("settings TOML", writes("settings.toml", _TOML.encode), _set, names_file=False)
add("settings JSON", _settings_json, _set, names_file=False)


def _response(path: Path) -> object:
    from scene2hap.audio.actuators import inverse_db, read_response_csv, response_db

    profile = read_response_csv(path)
    hz = np.array([1.0, 50.0, 200.0, 1000.0])
    return profile, response_db(profile, hz), inverse_db(profile, hz)


add("actuator", writes("amp.csv", lambda: b"Hz,dB\n# measured\n20,-10\n100,-1.5\n200,0\n500,-12\n"), _response)


def _prompts(folder: Path) -> Path:
    from scene2hap.llm.prompts import Prompts

    for name, text in Prompts.load(None).templates.items():
        (folder / f"{name}.txt").write_text(text)
    return folder


def _filled(folder: Path) -> object:
    from llm_server import request
    from scene2hap.llm.prompts import Prompts

    prompts = Prompts.load(folder)
    return [prompts.fill("scene_analyzer", {**request().facts, "object_names": ["a"]})]


add("prompts", _prompts, _filled)
