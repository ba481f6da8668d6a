"""Bakes that a client asks for."""

import json
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from bridge_client import Client, Refused
from scene2hap import HapticBundle
from scene2hap.bridge import BridgeServer
from scene2hap.bridge.jobs import MAX_RUNNING

Bridge = Callable[..., BridgeServer]


def test_a_bake_is_that_of_this_process(bridge: Bridge, root: Path, desk: HapticBundle) -> None:
    scene = json.loads(desk.snapshot.to_json())
    with Client(bridge().url) as client:
        job = client.ask("bake", scene=scene, save="made.bundle")["job"]
        baked = client.hear(lambda one: one.get("job") == job and one["type"] == "baked")
        assert [(one["id"], one["vibrates"]) for one in baked["objects"]] == [
            (key, haptics.vibrates) for key, haptics in desk.objects.items()
        ]
        steps = [one for one in client.heard if one["type"] == "progress"]
        assert steps
        assert all(one["job"] == job and one["done"] <= one["of"] for one in steps)
    for name in ("objects.json", "loops.json"):
        assert (root / "made.bundle" / name).read_bytes() == (root / "desk.bundle" / name).read_bytes()


def test_a_scene_file_below_the_root(bridge: Bridge, root: Path, desk: HapticBundle) -> None:
    (root / "desk.json").write_text(desk.snapshot.to_json())
    server = bridge()
    with Client(server.url) as client:
        job = client.bake(path="desk.json", config={"actuator": "lra", "seed": 3})
        assert client.play(job=job)["sources"][0]["id"] == "phone"
    # Whoever connects later may play it too: a game may have been started anew.
    with Client(server.url) as client:
        assert client.play(job=job)["layout"] == 1


def test_settings_of_the_server_are_not_a_client_s(bridge: Bridge, desk: HapticBundle) -> None:
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
        with pytest.raises(Refused, match="one of scene and path"):
            client.ask("bake")


def test_a_bake_that_fails_is_told(bridge: Bridge, desk: HapticBundle) -> None:
    scene = json.loads(desk.snapshot.to_json())
    with Client(bridge().url) as client:
        with pytest.raises(Refused, match="version is 9") as refused:
            client.bake(scene={**scene, "version": 9})
        assert refused.value.kind == "SceneError"
        with pytest.raises(Refused, match="no such file|does not exist|not found|There is no|there is no"):
            client.bake(path="nothing.glb")
        with pytest.raises(Refused, match="telepathy"):
            client.bake(scene=scene, config={"tactile": "telepathy"})
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
        time.sleep(0.2)
        assert not (root / "never.bundle").exists()
        assert not [*server.host.jobs.folder.glob("scene-*.json")]
        for _ in range(MAX_RUNNING):
            client.ask("bake", scene=scene)
        with pytest.raises(Refused, match="running already"):
            client.ask("bake", scene=scene)


def test_a_bake_goes_on_without_its_client(bridge: Bridge, root: Path, desk: HapticBundle) -> None:
    server = bridge()
    with Client(server.url) as client:
        client.ask("bake", scene=json.loads(desk.snapshot.to_json()), save="alone.bundle")
    until = time.monotonic() + 60
    while not (root / "alone.bundle" / "bundle.json").exists() and time.monotonic() < until:
        time.sleep(0.1)
    assert HapticBundle.load(root / "alone.bundle").loops.keys() == desk.loops.keys()
