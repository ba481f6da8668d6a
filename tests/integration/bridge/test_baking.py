"""Bakes requested by a client of the bridge."""

import base64
import io
import json
import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

from bridge_client import Client, Refused
from bridge_frames import encode_picture
from llm_server import GOOD, Asked, Scripted, said, serving as serving_model
from scene2hap import HapticBundle
from scene2hap.bridge import BridgeServer
from scene2hap.bridge.jobs import MAX_RUNNING, Jobs
from serial_bench import eventually

Bridge = Callable[..., BridgeServer]


def test_bake_over_the_bridge_equals_a_local_bake(bridge: Bridge, root: Path, desk: HapticBundle) -> None:
    scene = json.loads(desk.snapshot.to_json())
    scene["objects"][0]["masss_kg"] = scene["objects"][0].pop("mass_kg")  # which a warning tells
    with Client(bridge().url) as client:
        job = client.ask("bake", scene=scene, save="made.bundle")["job"]
        baked = client.hear(lambda one: one.get("job") == job and one["type"] == "baked")
        assert [(one["id"], one["vibrates"]) for one in baked["objects"]] == [
            (key, haptics.vibrates) for key, haptics in desk.objects.items()
        ]
        steps = [one for one in client.heard if one["type"] == "progress"]
        assert steps
        assert all(one["job"] == job and one["done"] <= one["of"] for one in steps)
        (warning,) = [one for one in client.heard if one["type"] == "warning"]
        assert warning["job"] == job
        assert warning["message"] == "the field 'masss_kg' of an object is ignored. Did you mean 'mass_kg'?"
    for name in ("objects.json", "loops.json"):
        assert (root / "made.bundle" / name).read_bytes() == (root / "desk.bundle" / name).read_bytes()


def test_a_bake_from_file_to_file_continues_without_its_client_and_needs_no_temporary_folder(
    bridge: Bridge, root: Path, desk: HapticBundle, monkeypatch: pytest.MonkeyPatch
) -> None:
    (root / "desk.json").write_text(desk.snapshot.to_json())
    monkeypatch.setattr("tempfile.tempdir", str(root / "nowhere"))
    server = bridge()
    with Client(server.url) as first:
        settings = {"actuator": "lra", "seed": 3}
        job = first.ask("bake", path="desk.json", config=settings, save="made.bundle")["job"]
    assert eventually(lambda: not server.connections)
    with Client(server.url) as second:
        assert second.ask("follow", job=job) == {"type": "baking", "job": job, "re": second._id}
        baked = second.hear(lambda one: one.get("job") == job and one["type"] == "baked")
        assert {**second.ask("follow", job=job), "re": None} == {**baked, "re": None}
        for kind, says in (("cancel", "is not running"), ("follow", "bake again")):
            with pytest.raises(Refused, match=says):
                second.ask(kind, job=job if kind == "cancel" else job + 1)
    # A later client can play the baked scene too, since a game may have restarted.
    with Client(server.url) as third:
        order = third.play(job=job)
        assert (order["layout"], order["sources"][0]["id"]) == (1, "phone")
    made = HapticBundle.load(root / "made.bundle")
    assert made.loops.keys() == desk.loops.keys()
    assert made.actuator is not None
    assert made.actuator.name == "lra"


def test_client_cannot_set_server_settings(bridge: Bridge, desk: HapticBundle) -> None:
    scene = json.loads(desk.snapshot.to_json())
    with Client(bridge().url) as client:
        for name, value in (
            ("llm", {"kind": "openai", "base_url": "http://evil.example"}),
            ("cache_dir", "/tmp"),
            ("audio", {"kind": "library", "folder": "/"}),
        ):
            with pytest.raises(Refused, match=f"'{name}' is no setting of a client's bake"):
                client.ask("bake", scene=scene, config={name: value})
        with pytest.raises(Refused, match="a file"):
            client.ask("bake", scene=scene, config={"actuator": "/etc/passwd.csv"})
        with pytest.raises(Refused, match="a file"):
            client.play(bundle="desk.bundle", session={"actuator": "/etc/passwd.csv"})
        with pytest.raises(Refused, match="one of scene and path"):
            client.ask("bake")


def test_a_client_s_settings_outrank_the_server_s(
    bridge: Bridge, desk: HapticBundle, monkeypatch: pytest.MonkeyPatch
) -> None:
    started: list[dict[str, Any]] = []

    def start(jobs: Jobs, wanted: dict[str, Any], *more: object) -> int:
        started.append(wanted["config"])
        return 1

    monkeypatch.setattr(Jobs, "start", start)
    with Client(bridge(bake={"actuator": "flat", "seed": 3}).url) as client:
        client.ask("bake", scene=json.loads(desk.snapshot.to_json()), config={"actuator": "voice_coil"})
    assert started == [{"actuator": "voice_coil", "seed": 3}]


def test_a_failed_bake_is_reported_without_a_name_of_the_servers_files(
    bridge: Bridge, root: Path, desk: HapticBundle
) -> None:
    scene = json.loads(desk.snapshot.to_json())
    wrong = {**scene, "objects": [{**scene["objects"][0], "id": f"box {i}"} for i in range(5001)]}
    (root / "mine.json").write_text(json.dumps(wrong))
    with Client(bridge().url) as client:
        with pytest.raises(Refused, match="^the number of objects is 5,001") as refused:
            client.bake(scene=wrong)
        assert refused.value.kind == "SceneError"
        with pytest.raises(Refused, match="^'mine.json': the number of objects is 5,001"):
            client.bake(path="mine.json")
        with pytest.raises(Refused, match="no job 77"):
            client.ask("play", job=77)


def test_a_bake_is_cancelled(bridge: Bridge, root: Path, desk: HapticBundle) -> None:
    scene = json.loads(desk.snapshot.to_json())
    server = bridge()
    with Client(server.url) as client:
        job = client.ask("bake", scene=scene, save="never.bundle")["job"]
        with pytest.raises(Refused, match="still baking"):
            client.ask("play", job=job)
        assert client.ask("cancel", job=job)["job"] == job
        with pytest.raises(Refused, match="not running"):
            client.ask("cancel", job=job)
        assert not (root / "never.bundle").exists()
        assert not [*server.host.jobs.folder.glob("scene-*.json")]
        for _ in range(MAX_RUNNING):
            client.ask("bake", scene=scene)
        with pytest.raises(Refused, match="running already"):
            client.ask("bake", scene=scene)


def test_an_unusable_save_is_refused_before_the_bake(bridge: Bridge, root: Path, desk: HapticBundle) -> None:
    """A language model may cost money."""
    (root / "desk.json").write_text(desk.snapshot.to_json())
    with Client(bridge().url) as client, pytest.raises(Refused, match="is not a folder"):
        client.ask("bake", path="desk.json", save="desk.json")


def test_a_refused_bake_leaves_no_file_and_keeps_the_pictures(bridge: Bridge, desk: HapticBundle) -> None:
    server, scene = bridge(), json.loads(desk.snapshot.to_json())
    with Client(server.url) as client:
        client.socket.send(encode_picture(b'{"object": "phone", "kind": "isolated", "view": "front"}', png(200)))
        with pytest.raises(Refused, match="not below"):
            client.ask("bake", scene=scene, save="../outside.bundle", pictures=True)
        jobs = [client.ask("bake", scene=scene)["job"] for _ in range(MAX_RUNNING)]
        with pytest.raises(Refused, match="running already"):
            client.ask("bake", scene=scene, pictures=True)
        for job in jobs:
            client.ask("cancel", job=job)
        assert not [*server.host.jobs.folder.glob("scene-*.json")]
        client.ask("bake", scene=scene, pictures=True)  # refused without a picture; it has it still


def test_a_frozen_program_refuses_bakes(bridge: Bridge, desk: HapticBundle, monkeypatch: pytest.MonkeyPatch) -> None:
    """A child would be the program itself once more, not Python."""
    server = bridge()
    monkeypatch.setattr(sys, "frozen", True, raising=False)
    with Client(server.url) as client, pytest.raises(Refused, match="start itself again"):
        client.ask("bake", scene=json.loads(desk.snapshot.to_json()))


def png(shade: int) -> bytes:
    """An image of one colour, as PNG."""
    file = io.BytesIO()
    Image.new("RGB", (64, 48), (shade, 10, 20)).save(file, "PNG")
    return file.getvalue()


def test_pictures_of_the_engine_reach_the_model(bridge: Bridge, desk: HapticBundle, tmp_path: Path) -> None:
    def reply(asked: Asked) -> Scripted:
        name = asked.body["response_format"]["json_schema"]["name"]
        return said(GOOD[name])

    with serving_model(by=reply) as model:
        llm = {"kind": "openai", "model": "gpt-4o", "base_url": model.base_url, "api_key": "sk-of-nobody-0123456789"}
        server = bridge(bake={"llm": llm, "cache_dir": str(tmp_path / "cache")})
        with Client(server.url) as client:
            with pytest.raises(Refused, match="there are no pictures"):
                client.ask("bake", scene=json.loads(desk.snapshot.to_json()), pictures=True)
            for row, file in (
                ({"object": "phone", "kind": "isolated", "view": "front"}, png(200)),
                ({"object": "phone", "kind": "context", "view": "front"}, png(150)),
                ({"kind": "scene", "view": "from the door"}, png(100)),
            ):
                client.socket.send(encode_picture(json.dumps(row).encode(), file))
            for row, file in (
                ({"object": "phone", "kind": "isolated", "view": "back"}, png(1)[:-9]),
                ({"object": "phone", "kind": "portrait", "view": "back"}, png(1)),
                ({"kind": "isolated", "view": "back"}, png(1)),
                ([], png(1)),
            ):
                client.socket.send(encode_picture(json.dumps(row).encode(), file))
                with pytest.raises(Refused):
                    client.hear(lambda one: one["type"] == "error")
            client.bake(scene=json.loads(desk.snapshot.to_json()), pictures=True)
        bodies = [json.dumps(asked.body) for asked in model.asked]
        sent = [base64.b64decode(text) for body in bodies for text in re.findall(r"base64,([^\"]+)", body)]
        shades = {Image.open(io.BytesIO(file)).getpixel((5, 5))[0] for file in sent}
        assert shades == {100, 150, 200}
    assert not [*server.host.jobs.folder.glob("pictures-*")]
